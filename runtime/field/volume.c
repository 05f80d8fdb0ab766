/* Bounds the volume inside a field by halving its box. */
#include "runtime/field/volume.h"

#include <math.h>
#include <stdlib.h>

#define LEVELS_MAX 10u

typedef struct halving {
    const tn_field *field;
    const tn_field_grid *grid;
    tn_interval *registers;
    unsigned levels;
    tn_field_volume sum;
} halving;

/* One of 2^levels + 1 places along an axis: blocks that meet have the same. */
static double place(const halving *h, int axis, uint32_t at)
{
    double parts = (double)(1u << h->levels);
    return (h->grid->low[axis] * (parts - at) + h->grid->high[axis] * at) / parts;
}

static double down(double x)
{
    return nextafter(x, -INFINITY);
}

static double up(double x)
{
    return nextafter(x, INFINITY);
}

static void add(halving *h, const double low[3], const double high[3], bool proven)
{
    double least = 1, most = 1;
    for (int k = 0; k < 3; k++) {
        least = down(least * fmax(down(high[k] - low[k]), 0));
        most = up(most * up(high[k] - low[k]));
    }
    if (proven)
        h->sum.low = down(h->sum.low + fmax(least, 0));
    h->sum.high = up(h->sum.high + most);
}

/* A block of `size` finest parts a side. */
static void halve(halving *h, const uint32_t at[3], uint32_t size)
{
    double low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = place(h, k, at[k]);
        high[k] = place(h, k, at[k] + size);
    }
    tn_interval f = tn_tape_bounds(&h->field->samples, low, high, &h->field->distances, h->registers);
    if (tn_interval_is_none(f) || f.low >= 0)
        return; /* what has no value is outside */
    bool inside = f.high < 0 && !f.fails;
    if (inside || size == 1) {
        add(h, low, high, inside);
        return;
    }
    for (uint32_t part = 0; part < 8; part++) {
        uint32_t half = size / 2;
        halve(h,
              (uint32_t[]){at[0] + (part & 1 ? half : 0), at[1] + (part & 2 ? half : 0), at[2] + (part & 4 ? half : 0)},
              half);
    }
}

tn_status tn_field_volume_bounds(const tn_field *field, const tn_field_grid *grid, tn_field_volume *volume,
                                 tn_error *error)
{
    halving h = {.field = field, .grid = grid};
    uint32_t most = 0;
    for (int k = 0; k < 3; k++)
        most = grid->count[k] > most ? grid->count[k] : most;
    while (h.levels < LEVELS_MAX && (1u << h.levels) < most - 1)
        h.levels++;
    h.registers = calloc(field->samples.register_count + 1u, sizeof *h.registers);
    if (!h.registers)
        return tn_fail_memory(error);
    halve(&h, (uint32_t[]){0, 0, 0}, 1u << h.levels);
    free(h.registers);
    *volume = (tn_field_volume){fmax(h.sum.low, 0), h.sum.high};
    return TN_OK;
}
