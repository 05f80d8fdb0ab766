/* Clips boxes by a plane, and integrates over what is left (Bentley, chapter 4.2: keep what is not beyond the plane).
 */
#include "runtime/geometry/union/cut_box.h"

#include <math.h>
#include <string.h>

#include "runtime/math/elementary.h"

/* The corners of each side in order; bit 0 of a corner is high x, bit 1 y, bit 2 z. */
static const uint8_t sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

typedef struct clipping {
    tn_cut_box *cell;
    double s[8];     /* how far beyond the plane each corner is */
    int where[8];    /* -1 kept, 0 on the plane, 1 beyond */
    int place[8][8]; /* what became of a corner [i][i] or a crossing [i][j], i < j; -1: nothing yet */
} clipping;

static double corner_at(const tn_cut_box *cell, int corner, int axis)
{
    return corner >> axis & 1 ? cell->high[axis] : cell->low[axis];
}

static uint8_t add_corner(clipping *c, int i)
{
    tn_cut_box *cell = c->cell;
    if (c->place[i][i] < 0) {
        c->place[i][i] = (int)cell->corner_count;
        for (int k = 0; k < 3; k++)
            cell->at[cell->corner_count][k] = corner_at(cell, i, k);
        cell->corner_count++;
    }
    return (uint8_t)c->place[i][i];
}

/* The two differ in one coordinate only: the others are taken as they are. */
static uint8_t add_crossing(clipping *c, int i, int j)
{
    tn_cut_box *cell = c->cell;
    if (i > j) {
        int other = i;
        i = j;
        j = other;
    }
    if (c->place[i][j] < 0) {
        double t = c->s[i] / (c->s[i] - c->s[j]);
        c->place[i][j] = (int)cell->corner_count;
        for (int k = 0; k < 3; k++) {
            double a = corner_at(cell, i, k), b = corner_at(cell, j, k), x = a == b ? a : a + t * (b - a);
            cell->at[cell->corner_count][k] = x < cell->low[k] ? cell->low[k] : x > cell->high[k] ? cell->high[k] : x;
        }
        cell->corner_count++;
    }
    return (uint8_t)c->place[i][j];
}

static void add_side(clipping *c, int side)
{
    tn_cut_box_face face = {.side = (uint8_t)side};
    for (int m = 0; m < 4; m++) {
        int i = sides[side][m], j = sides[side][(m + 1) % 4];
        if (c->where[i] <= 0)
            face.corner[face.count++] = add_corner(c, i);
        if (c->where[i] * c->where[j] < 0)
            face.corner[face.count++] = add_crossing(c, i, j);
    }
    if (face.count >= 3)
        c->cell->faces[c->cell->face_count++] = face;
}

/* The cap goes along the edges that only one face has. */
static void add_cap(tn_cut_box *cell)
{
    int next[TN_CUT_BOX_CORNERS], start = -1;
    bool edge[TN_CUT_BOX_CORNERS][TN_CUT_BOX_CORNERS] = {{false}};
    tn_cut_box_face cap = {.side = TN_CUT_BOX_CAP};
    memset(next, -1, sizeof next);
    for (uint32_t f = 0; f < cell->face_count; f++)
        for (uint32_t k = 0; k < cell->faces[f].count; k++)
            edge[cell->faces[f].corner[k]][cell->faces[f].corner[(k + 1) % cell->faces[f].count]] = true;
    for (int a = 0; a < TN_CUT_BOX_CORNERS; a++)
        for (int b = 0; b < TN_CUT_BOX_CORNERS; b++)
            if (edge[a][b] && !edge[b][a]) {
                next[b] = a;
                start = b;
            }
    for (int at = start; at >= 0 && cap.count < 8; at = next[at]) {
        if (cap.count > 0 && at == start)
            break;
        cap.corner[cap.count++] = (uint8_t)at;
    }
    if (cap.count >= 3)
        cell->faces[cell->face_count++] = cap;
}

static void add_all(clipping *c)
{
    for (int side = 0; side < 6; side++)
        add_side(c, side);
}

void tn_cut_box_clip(const double low[3], const double high[3], const double *n, double distance, tn_cut_box *cell)
{
    clipping c = {.cell = cell};
    double diagonal = 0;
    bool beyond = false, kept = false;
    memset(cell, 0, sizeof *cell);
    memset(c.place, -1, sizeof c.place);
    for (int k = 0; k < 3; k++) {
        cell->low[k] = low[k];
        cell->high[k] = high[k];
        diagonal += (high[k] - low[k]) * (high[k] - low[k]);
    }
    double near = 1e-9 * sqrt(diagonal);
    for (int i = 0; i < 8; i++) {
        double s = -distance;
        for (int k = 0; n && k < 3; k++)
            s += n[k] * (corner_at(cell, i, k) - (low[k] + high[k]) / 2);
        c.s[i] = s;
        c.where[i] = !n ? -1 : fabs(s) <= near ? 0 : s > 0 ? 1 : -1;
        beyond |= c.where[i] > 0;
        kept |= c.where[i] < 0;
    }
    if (!beyond)
        memset(c.where, -1, sizeof c.where);
    else if (!kept)
        return;
    add_all(&c);
    if (beyond)
        add_cap(cell);
}

void tn_cut_box_mirror(tn_cut_box *cell, int axis)
{
    double low = cell->low[axis];
    cell->low[axis] = -cell->high[axis];
    cell->high[axis] = -low;
    for (uint32_t i = 0; i < cell->corner_count; i++)
        cell->at[i][axis] = -cell->at[i][axis];
    for (uint32_t f = 0; f < cell->face_count; f++) {
        tn_cut_box_face *face = &cell->faces[f];
        if (face->side / 2 == axis)
            face->side ^= 1;
        for (uint32_t a = 0, b = face->count - 1u; a < b; a++, b--) {
            uint8_t other = face->corner[a];
            face->corner[a] = face->corner[b];
            face->corner[b] = other;
        }
    }
}

double tn_cut_boxes_step(const tn_cut_box *cells, size_t count)
{
    double most = 0;
    int exponent;
    for (size_t i = 0; i < count; i++)
        for (int k = 0; cells[i].face_count && k < 3; k++)
            most = fmax(most, fmax(fabs(cells[i].low[k]), fabs(cells[i].high[k])));
    frexp(most, &exponent);
    return ldexp(1, most > 0 ? exponent - 52 : 0);
}

void tn_cut_boxes_bounds(const tn_cut_box *cells, size_t count, double low[3], double high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
    }
    for (size_t i = 0; i < count; i++)
        for (uint32_t v = 0; cells[i].face_count && v < cells[i].corner_count; v++)
            for (int k = 0; k < 3; k++) {
                double at = cells[i].at[v][k];
                low[k] = at < low[k] ? at : low[k];
                high[k] = at > high[k] ? at : high[k];
            }
}

/* A tetrahedron from the first corner o, with edges p[0..2] from there. */
static void add_tetrahedron(const double o[3], const double p[3][3], tn_moments *moments)
{
    double det = p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) - p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
                 p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    double volume = det / 6;
    moments->volume += volume;
    for (int k = 0; k < 3; k++) {
        double a = p[0][k], b = p[1][k], c = p[2][k], sum = a + b + c;
        double first = volume * sum / 4;
        double second = volume * (a * a + b * b + c * c + a * b + a * c + b * c) / 10;
        moments->first[k] += first + volume * o[k];
        moments->second[k] += second + 2 * o[k] * first + o[k] * o[k] * volume;
    }
}

void tn_cut_box_moments(const tn_cut_box *cell, tn_moments *moments)
{
    const double *o = cell->at[0];
    for (uint32_t f = 0; f < cell->face_count; f++) {
        const tn_cut_box_face *face = &cell->faces[f];
        for (uint32_t k = 1; k + 1u < face->count; k++) {
            double p[3][3];
            for (int axis = 0; axis < 3; axis++) {
                p[0][axis] = cell->at[face->corner[0]][axis] - o[axis];
                p[1][axis] = cell->at[face->corner[k]][axis] - o[axis];
                p[2][axis] = cell->at[face->corner[k + 1]][axis] - o[axis];
            }
            add_tetrahedron(o, (const double(*)[3])p, moments);
        }
    }
}

/* ---- turns the angles of a box's plane into its normal */

void tn_normal_of_angles(double a, double b, double normal[3])
{
    normal[0] = tn_cos_degrees(b) * tn_sin_degrees(a);
    normal[1] = tn_sin_degrees(b);
    normal[2] = tn_cos_degrees(b) * tn_cos_degrees(a);
}
