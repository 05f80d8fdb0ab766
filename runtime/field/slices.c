/* Slices a field: signs of samples in each layer, points on the edges between them, and lines through cells. */
#include "runtime/field/slices.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/field/contouring.h"

#define NONE UINT32_MAX

void tn_field_slices_clear(tn_field_slices *slices)
{
    tn_slices_clear(&slices->slices);
    tn_contour_clear(&slices->contour);
}

/* ---- lines through cells */

enum { BOTTOM, TOP, LEFT, RIGHT, NO_EDGE };

/* A cell's corners are bits: 1 at low x and y, 2 at high x, 4 at high y, 8 at both. Its lines go from edge to edge with
 * the inside on the left. Where opposite corners are inside, they are separated, as in the mesh; the two lines then lie
 * on both sides of the diagonal and do not cross. */
static const uint8_t lines_of[16][4] = {
    [0] = {NO_EDGE, NO_EDGE, NO_EDGE, NO_EDGE}, [1] = {BOTTOM, LEFT, NO_EDGE, NO_EDGE},
    [2] = {RIGHT, BOTTOM, NO_EDGE, NO_EDGE},    [3] = {RIGHT, LEFT, NO_EDGE, NO_EDGE},
    [4] = {LEFT, TOP, NO_EDGE, NO_EDGE},        [5] = {BOTTOM, TOP, NO_EDGE, NO_EDGE},
    [6] = {RIGHT, BOTTOM, LEFT, TOP},           [7] = {RIGHT, TOP, NO_EDGE, NO_EDGE},
    [8] = {TOP, RIGHT, NO_EDGE, NO_EDGE},       [9] = {BOTTOM, LEFT, TOP, RIGHT},
    [10] = {TOP, BOTTOM, NO_EDGE, NO_EDGE},     [11] = {TOP, LEFT, NO_EDGE, NO_EDGE},
    [12] = {LEFT, RIGHT, NO_EDGE, NO_EDGE},     [13] = {BOTTOM, RIGHT, NO_EDGE, NO_EDGE},
    [14] = {LEFT, BOTTOM, NO_EDGE, NO_EDGE},    [15] = {NO_EDGE, NO_EDGE, NO_EDGE, NO_EDGE},
};

/* The vertex on the edge from sample x, y along an axis. */
static uint32_t vertex_at(const tn_contouring *c, uint32_t axis, uint32_t x, uint32_t y, uint32_t z)
{
    const uint64_t *row = tn_signs_at(c, y, z), *next = axis == 0 ? NULL : tn_signs_at(c, y + 1, z);
    uint32_t vertex = c->first[(size_t)z * c->grid->count[1] + y][axis];
    for (size_t word = 0; word < x / 64; word++)
        vertex += (uint32_t)__builtin_popcountll(tn_crossing(c, row, next, word));
    uint64_t before = ((uint64_t)1 << x % 64) - 1;
    return vertex + (uint32_t)__builtin_popcountll(tn_crossing(c, row, next, x / 64) & before);
}

static uint32_t vertex_on(const tn_contouring *c, unsigned edge, uint32_t x, uint32_t y, uint32_t z)
{
    return vertex_at(c, edge == LEFT || edge == RIGHT, x + (edge == RIGHT), y + (edge == TOP), z);
}

static unsigned sign_of(const uint64_t *row, uint32_t x)
{
    return row[x / 64] >> (x % 64) & 1;
}

typedef struct tracing {
    const tn_contouring *c;
    uint32_t *next; /* of each vertex the one after it on its line */
} tracing;

static tn_status do_layer(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)thread;
    (void)error;
    const tracing *t = context;
    uint32_t z = (uint32_t)item;
    for (uint32_t y = 0; y + 1 < t->c->grid->count[1]; y++) {
        const uint64_t *low = tn_signs_at(t->c, y, z), *high = tn_signs_at(t->c, y + 1, z);
        for (uint32_t x = 0; x + 1 < t->c->grid->count[0]; x++) {
            const uint8_t *lines = lines_of[sign_of(low, x) | sign_of(low, x + 1) << 1 | sign_of(high, x) << 2 |
                                            sign_of(high, x + 1) << 3];
            for (int k = 0; k < 4 && lines[k] != NO_EDGE; k += 2)
                t->next[vertex_on(t->c, lines[k], x, y, z)] = vertex_on(t->c, lines[k + 1], x, y, z);
        }
    }
    return TN_OK;
}

/* ---- lines */

/* Follows the lines, in order of their first vertices, which are sorted by layers. */
static void gather(const tn_contouring *c, uint32_t *next, tn_slices *slices)
{
    const double *positions = c->out->mesh.positions;
    uint32_t count = 0;
    size_t layer = 0;
    for (uint32_t v = 0; v < c->vertex_count; v++) {
        if (next[v] == NONE)
            continue;
        for (; layer < slices->layer_count && positions[3 * (size_t)v + 2] != slices->heights[layer]; layer++)
            slices->layer_first[layer + 1] = (uint32_t)slices->line_count;
        for (uint32_t at = v, after; next[at] != NONE; at = after) {
            memcpy(slices->points[count++], positions + 3 * (size_t)at, 2 * sizeof(double));
            after = next[at];
            next[at] = NONE;
        }
        slices->line_first[++slices->line_count] = count;
    }
    for (; layer < slices->layer_count; layer++)
        slices->layer_first[layer + 1] = (uint32_t)slices->line_count;
    slices->point_count = count;
}

static tn_status trace(const tn_contouring *c, tn_slices *slices, tn_error *error)
{
    size_t room = (size_t)c->vertex_count + 1;
    tracing t = {c, tn_array_new(room, sizeof *t.next)};
    slices->points = tn_array_new(room, sizeof *slices->points);
    slices->line_first = calloc(room, sizeof *slices->line_first);
    tn_status status = TN_OK;
    if (!t.next || !slices->points || !slices->line_first)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_crew_run(c->crew, slices->layer_count, 1, do_layer, &t, error);
    if (status == TN_OK)
        gather(c, t.next, slices);
    free(t.next);
    return status;
}

tn_status tn_field_slices_new(const tn_field *field, const tn_field_grid *grid, double thickness,
                              const tn_contour_options *options, tn_field_slices *found, tn_error *error)
{
    tn_field_grid layers = *grid;
    tn_slices *slices = &found->slices;
    *found = (tn_field_slices){0};
    tn_status status = tn_slices_layers(grid->low[2], grid->high[2], thickness, slices, error);
    if (status != TN_OK)
        return status;
    layers.count[2] = (uint32_t)slices->layer_count;
    tn_contouring c = {.field = field, .grid = &layers, .options = options, .out = &found->contour, .flat = true};
    status = tn_contouring_begin(&c, slices->heights, error);
    if (status == TN_OK)
        status = tn_contour_signs(&c, error);
    if (status == TN_OK)
        status = tn_contour_roots(&c, error);
    if (status == TN_OK)
        status = trace(&c, slices, error);
    if (status == TN_OK)
        tn_contouring_count(&c);
    tn_contouring_free(&c);
    return status;
}
