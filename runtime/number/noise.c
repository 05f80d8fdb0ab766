/* Computes gradient noise (Perlin, "Improving noise", 2002) over a lattice whose gradients are chosen by a hash. */
#include "runtime/number/noise.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#define LIMIT 2147483648.0 /* 2^31: beyond, the lattice's points would not be told apart */

/* A place in its cell of the lattice. */
typedef struct cell_place {
    uint32_t corner[3]; /* modulo 2^32 */
    double from[3];     /* the place, from the corner on */
} cell_place;

static bool find_cell(double x, double y, double z, cell_place *cell)
{
    double place[3] = {x, y, z};
    for (int k = 0; k < 3; k++) {
        if (!(fabs(place[k]) < LIMIT))
            return false;
        double corner = floor(place[k]);
        cell->corner[k] = (uint32_t)(int64_t)corner;
        cell->from[k] = place[k] - corner;
    }
    return true;
}

/* The gradient of the cell's corner k, whose bits say on which side it is. */
static const signed char *gradient(const cell_place *cell, unsigned k)
{
    static const signed char gradients[12][3] = {{1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0},
                                                 {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
                                                 {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}};
    uint32_t h = (cell->corner[0] + (k & 1)) * 0x9E3779B1u ^ (cell->corner[1] + (k >> 1 & 1)) * 0x85EBCA77u ^
                 (cell->corner[2] + (k >> 2)) * 0xC2B2AE3Du;
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    h ^= h >> 12;
    h *= 0x297A2D39u;
    h ^= h >> 15;
    return gradients[h % 12];
}

static double corner_value(const cell_place *cell, unsigned k)
{
    const signed char *g = gradient(cell, k);
    const double *q = cell->from;
    return (g[0] * (q[0] - (k & 1)) + g[1] * (q[1] - (k >> 1 & 1))) + g[2] * (q[2] - (k >> 2));
}

static double fade(double t)
{
    return t * t * t * (t * (t * 6 - 15) + 10);
}

double tn_noise(double x, double y, double z)
{
    cell_place cell;
    double values[8];
    if (!find_cell(x, y, z, &cell))
        return NAN;
    for (unsigned k = 0; k < 8; k++)
        values[k] = corner_value(&cell, k);
    for (unsigned axis = 0, count = 4; axis < 3; axis++, count /= 2) {
        double share = fade(cell.from[axis]);
        for (unsigned i = 0; i < count; i++)
            values[i] = values[2 * i] + (values[2 * i + 1] - values[2 * i]) * share;
    }
    return values[0];
}

double tn_noise_slope(double x, double y, double z, double dx, double dy, double dz)
{
    cell_place cell;
    double along[3] = {dx, dy, dz}, share[3], steep[3], slope = 0;
    if (!find_cell(x, y, z, &cell))
        return NAN;
    for (int k = 0; k < 3; k++) {
        double t = cell.from[k];
        share[k] = fade(t);
        steep[k] = 30 * t * t * (t - 1) * (t - 1) * along[k];
    }
    for (unsigned k = 0; k < 8; k++) {
        const signed char *g = gradient(&cell, k);
        double weight[3], value = corner_value(&cell, k);
        for (int axis = 0; axis < 3; axis++)
            weight[axis] = k >> axis & 1 ? share[axis] : 1 - share[axis];
        slope += weight[0] * weight[1] * weight[2] * (g[0] * dx + g[1] * dy + g[2] * dz);
        for (int axis = 0; axis < 3; axis++)
            slope += (k >> axis & 1 ? 1 : -1) * steep[axis] * weight[(axis + 1) % 3] * weight[(axis + 2) % 3] * value;
    }
    return slope;
}
