/* Finds the point nearest to some planes, by the eigenvectors of their normal equations. */
#include "runtime/field/feature.h"

#include <math.h>
#include <string.h>

#define SHARP_COSINE 0x1.bb67ae8584caap-1 /* of 30 degrees */
#define DROPPED 0.01                      /* of the largest eigenvalue: a singular value of 0.1, squared */
#define DESCENTS 64                       /* planes differ by 30 degrees at least, so that each halves what is left */
#define FLAT 1e-9                         /* of a plane that does not depend on a coordinate */
#define SWEEPS 8                          /* Jacobi's method ends after 5 or so for matrices of 3 rows */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool tn_feature_is_sharp(const double (*normals)[3], uint32_t count)
{
    bool sharp = false;
    for (uint32_t i = 0; i < count; i++) {
        if (dot(normals[i], normals[i]) == 0)
            return false;
        for (uint32_t k = 0; k < i; k++)
            sharp |= dot(normals[i], normals[k]) < SHARP_COSINE;
    }
    return sharp;
}

/* Turns rows and columns p and q of a symmetric matrix so that m[p][q] becomes 0; v keeps the product of all turns. */
static void turn(double m[3][3], double v[3][3], int p, int q)
{
    if (m[p][q] == 0)
        return;
    double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
    double c = 1 / sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 3; k++) {
        double a = m[k][p], b = m[k][q];
        m[k][p] = c * a - s * b;
        m[k][q] = s * a + c * b;
    }
    for (int k = 0; k < 3; k++) {
        double a = m[p][k], b = m[q][k], e = v[k][p], f = v[k][q];
        m[p][k] = c * a - s * b;
        m[q][k] = s * a + c * b;
        v[k][p] = c * e - s * f;
        v[k][q] = s * e + c * f;
    }
}

/* Sum of the squared distances from the planes, d from the places' mean: d m d - 2 right d, but for a number. */
typedef struct planes {
    double mean[3], m[3][3], right[3];
} planes;

static planes sum_planes(const double (*places)[3], const double (*normals)[3], uint32_t count)
{
    planes s = {0};
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            s.mean[k] += places[i][k] / count;
    for (uint32_t i = 0; i < count; i++) {
        double off = 0;
        for (int k = 0; k < 3; k++)
            off += normals[i][k] * (places[i][k] - s.mean[k]);
        for (int k = 0; k < 3; k++) {
            s.right[k] += normals[i][k] * off;
            for (int l = 0; l < 3; l++)
                s.m[k][l] += normals[i][k] * normals[i][l];
        }
    }
    return s;
}

/* The least of the sum, without what the planes say little about. */
static void solve(const planes *s, double d[3])
{
    double m[3][3], v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    memcpy(m, s->m, sizeof m);
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++)
                turn(m, v, p, q);
    double least = DROPPED * fmax(m[0][0], fmax(m[1][1], m[2][2]));
    d[0] = d[1] = d[2] = 0;
    for (int e = 0; e < 3; e++) {
        if (!(m[e][e] > least))
            continue;
        double along = (v[0][e] * s->right[0] + v[1][e] * s->right[1] + v[2][e] * s->right[2]) / m[e][e];
        for (int k = 0; k < 3; k++)
            d[k] += along * v[k][e];
    }
}

/* Moves d into the box, to where the sum is least there: one coordinate after the other. */
static void keep_within(const planes *s, const double low[3], const double high[3], double d[3])
{
    for (int k = 0; k < 3; k++)
        d[k] = fmin(fmax(d[k], low[k] - s->mean[k]), high[k] - s->mean[k]);
    for (int step = 0; step < DESCENTS; step++)
        for (int k = 0; k < 3; k++) {
            int p = (k + 1) % 3, q = (k + 2) % 3;
            double best = (s->right[k] - s->m[k][p] * d[p] - s->m[k][q] * d[q]) / s->m[k][k];
            if (s->m[k][k] > FLAT)
                d[k] = fmin(fmax(best, low[k] - s->mean[k]), high[k] - s->mean[k]);
        }
}

void tn_feature_point(const double (*places)[3], const double (*normals)[3], uint32_t count, const double low[3],
                      const double high[3], double point[3])
{
    planes s = sum_planes(places, normals, count);
    double d[3];
    bool inside = true;
    solve(&s, d);
    for (int k = 0; k < 3; k++)
        inside = inside && d[k] >= low[k] - s.mean[k] && d[k] <= high[k] - s.mean[k];
    if (!inside)
        keep_within(&s, low, high, d);
    for (int k = 0; k < 3; k++)
        point[k] = fmin(fmax(s.mean[k] + d[k], low[k]), high[k]);
}
