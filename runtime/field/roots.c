/* Finds where edges of the grid cross the surface: a row of edges at once, by halving and a secant at the end. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/field/contour_parts.h"
#include "runtime/numeric/any_width.h"

#define HALVINGS 24
#define NEAREST (1.0 / 4096) /* of an edge: vertices keep this distance from samples, so that none meet */
#define JUMP (1.0 / 64)      /* of the largest value on an edge: even a root as steep as a fourth root stays below */

/* A row of edges along one axis. */
typedef struct batch {
    tn_field_runner runner;
    uint32_t count;
    uint32_t vertex[TN_ROW];
    double from[TN_ROW], length[TN_ROW];    /* along the axis */
    double inner[TN_ROW], outer[TN_ROW];    /* the bracket: 0 to 1 */
    double inside[TN_ROW], outside[TN_ROW]; /* its values; not numbers where not known */
    double largest[TN_ROW];                 /* of all values seen */
    double middle[TN_ROW];
} batch;

typedef struct roots {
    tn_contouring *c;
    batch *batches; /* three a thread */
} roots;

/* ---- the roots of a row */

static void start(batch *b, const bool *inside_first)
{
    for (uint32_t i = 0; i < TN_ROW; i++) {
        b->inner[i] = inside_first[i] ? 0 : 1;
        b->outer[i] = inside_first[i] ? 1 : 0;
        b->inside[i] = b->outside[i] = NAN;
        b->largest[i] = 0;
    }
}

/* Has halving moved this end of a bracket? Then its value is known. */
static bool has_moved(double end)
{
    return end > 0 && end < 1;
}

TN_ANY_WIDTH static void find_middles(batch *b, double *restrict place)
{
    for (uint32_t i = 0; i < TN_ROW; i++) {
        b->middle[i] = .5 * (b->inner[i] + b->outer[i]);
        place[i] = b->from[i] + b->middle[i] * b->length[i];
    }
}

TN_ANY_WIDTH static void take_halves(batch *b, const double *restrict values)
{
    for (uint32_t i = 0; i < TN_ROW; i++) {
        double v = values[i], size = fabs(v), t = b->middle[i];
        bool in = v < 0;
        b->inner[i] = in ? t : b->inner[i];
        b->inside[i] = in ? v : b->inside[i];
        b->outer[i] = in ? b->outer[i] : t;
        b->outside[i] = in ? b->outside[i] : v;
        b->largest[i] = size > b->largest[i] ? size : b->largest[i];
    }
}

/* Halves the brackets once. */
static void halve(batch *b, double *place)
{
    find_middles(b, place);
    take_halves(b, tn_field_run(&b->runner));
}

/* For telling jumps: the value at an end that halving never came to is that of the sample. */
static void look_at_ends(batch *b, double *place)
{
    bool missing = false;
    for (uint32_t i = 0; i < b->count; i++)
        missing = missing || !has_moved(b->inner[i]) || !has_moved(b->outer[i]);
    for (int side = 0; missing && side < 2; side++) {
        double *values = side ? b->outside : b->inside;
        const double *t = side ? b->outer : b->inner;
        for (uint32_t i = 0; i < TN_ROW; i++)
            place[i] = b->from[i] + t[i] * b->length[i];
        const double *found = tn_field_run(&b->runner);
        for (uint32_t i = 0; i < b->count; i++) {
            if (has_moved(t[i]))
                continue;
            values[i] = found[i];
            b->largest[i] = fabs(found[i]) > b->largest[i] ? fabs(found[i]) : b->largest[i];
        }
    }
}

/* Where the outer end is inside by its value, the box closes the form there: that is no jump. */
static bool is_jump(const batch *b, uint32_t i)
{
    if (b->outside[i] < 0)
        return false;
    if (!isfinite(b->inside[i]) || !isfinite(b->outside[i]))
        return true;
    return fabs(b->inside[i]) + fabs(b->outside[i]) > JUMP * b->largest[i];
}

TN_ANY_WIDTH static void find_roots(roots *r, batch *b, int axis, uint32_t layer)
{
    tn_contouring *c = r->c;
    double *place = b->runner.rows.coordinates[axis], t[TN_ROW];
    for (uint32_t i = 0; i < b->count; i++) {
        double s = b->inside[i] / (b->inside[i] - b->outside[i]);
        t[i] = .5 * (b->inner[i] + b->outer[i]);
        if (has_moved(b->inner[i]) && has_moved(b->outer[i]) && s >= 0 && s <= 1)
            t[i] = b->inner[i] + s * (b->outer[i] - b->inner[i]);
    }
    look_at_ends(b, place);
    for (uint32_t i = 0; i < b->count; i++) {
        double kept = fmin(fmax(t[i], NEAREST), 1 - NEAREST), *out = c->out->mesh.positions + 3 * (size_t)b->vertex[i];
        c->layer_moved[layer] += kept != t[i];
        for (int k = 0; k < 3; k++)
            out[k] = k == axis ? b->from[i] + kept * b->length[i] : b->runner.rows.coordinates[k][i];
        if (!is_jump(b, i))
            continue;
        c->layer_jumps[layer]++;
        __atomic_fetch_or(&c->jumping[b->vertex[i] / 64], (uint64_t)1 << (b->vertex[i] % 64), __ATOMIC_RELAXED);
    }
}

/* Does the row's edges, and empties it. */
static void flush(roots *r, batch *b, int axis, uint32_t layer, bool *inside_first)
{
    if (b->count == 0)
        return;
    for (uint32_t i = b->count; i < TN_ROW; i++) { /* the rest repeats the last edge */
        b->from[i] = b->from[b->count - 1];
        b->length[i] = b->length[b->count - 1];
        inside_first[i] = inside_first[b->count - 1];
        for (int k = 0; k < 3; k++)
            b->runner.rows.coordinates[k][i] = b->runner.rows.coordinates[k][b->count - 1];
    }
    start(b, inside_first);
    tn_field_prepare(&b->runner);
    for (int i = 0; i < HALVINGS; i++)
        halve(b, b->runner.rows.coordinates[axis]);
    find_roots(r, b, axis, layer);
    b->count = 0;
}

/* ---- edges */

/* The row of samples at the other ends of edges along y or z; NULL along x, and where there is none. */
static const uint64_t *next_row(const tn_contouring *c, int axis, uint32_t y, uint32_t z)
{
    return axis == 1 ? tn_signs_at(c, y + 1, z) : axis == 2 ? tn_signs_at(c, y, z + 1) : NULL;
}

static bool has_edges(const tn_contouring *c, int axis, uint32_t y, uint32_t z)
{
    return axis == 0 || (axis == 1 ? y + 1 < c->grid->count[1] : !c->flat && z + 1 < c->grid->count[2]);
}

/* Adds the crossing edges of a row along an axis to the batch. */
TN_ANY_WIDTH static void add_edges(roots *r, batch *b, int axis, uint32_t y, uint32_t z, bool *inside_first)
{
    const tn_contouring *c = r->c;
    const uint64_t *row = tn_signs_at(c, y, z), *next = next_row(c, axis, y, z);
    uint32_t vertex = c->first[(size_t)z * c->grid->count[1] + y][axis];
    for (size_t word = 0; word < c->words; word++)
        for (uint64_t bits = tn_crossing(c, row, next, word); bits; bits &= bits - 1) {
            uint32_t bit = (uint32_t)__builtin_ctzll(bits), at[3] = {(uint32_t)(64 * word) + bit, y, z};
            uint32_t i = b->count++;
            for (int k = 0; k < 3; k++)
                b->runner.rows.coordinates[k][i] = c->places[k][at[k]];
            b->from[i] = c->places[axis][at[axis]];
            b->length[i] = c->places[axis][at[axis] + 1] - b->from[i];
            b->vertex[i] = vertex++;
            inside_first[i] = row[word] >> bit & 1;
            if (b->count == TN_ROW)
                flush(r, b, axis, z, inside_first);
        }
}

static tn_status do_layer(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)error;
    roots *r = context;
    uint32_t z = (uint32_t)item;
    bool inside_first[TN_ROW];
    for (int axis = 0; axis < 3; axis++) {
        batch *b = &r->batches[3 * thread + (unsigned)axis];
        for (uint32_t y = 0; y < r->c->grid->count[1]; y++)
            if (has_edges(r->c, axis, y, z))
                add_edges(r, b, axis, y, z, inside_first);
        flush(r, b, axis, z, inside_first);
    }
    return TN_OK;
}

/* ---- numbering */

/* By z, then y; in a row the edges along x, those along y, those along z. */
TN_ANY_WIDTH static tn_status number_vertices(tn_contouring *c, tn_error *error)
{
    const uint32_t *n = c->grid->count;
    uint64_t count = 0;
    for (uint32_t z = 0; z < n[2]; z++)
        for (uint32_t y = 0; y < n[1]; y++)
            for (int axis = 0; axis < 3; axis++) {
                c->first[(size_t)z * n[1] + y][axis] = (uint32_t)count;
                if (!has_edges(c, axis, y, z))
                    continue;
                const uint64_t *row = tn_signs_at(c, y, z), *next = next_row(c, axis, y, z);
                for (size_t word = 0; word < c->words; word++)
                    count += (unsigned)__builtin_popcountll(tn_crossing(c, row, next, word));
                if (count > UINT32_MAX - 1)
                    return tn_fail(error, TN_LIMIT, E_FIELD_TRIANGLES, "the mesh has more than %u vertices, the limit",
                                   UINT32_MAX - 1);
            }
    c->vertex_count = count;
    return TN_OK;
}

tn_status tn_contour_roots(tn_contouring *c, tn_error *error)
{
    roots r = {.c = c, .batches = calloc((size_t)c->threads * 3, sizeof *r.batches)};
    tn_status status = number_vertices(c, error);
    if (status == TN_OK) {
        c->out->mesh.vertex_count = (size_t)c->vertex_count;
        c->out->mesh.positions = calloc(tn_as_size(c->vertex_count) + 1, 3 * sizeof(double));
        c->jumping = calloc(tn_as_size(c->vertex_count) / 64 + 1, sizeof *c->jumping);
        if (!r.batches || !c->out->mesh.positions || !c->jumping)
            status = tn_fail_memory(error);
    }
    for (unsigned i = 0; i < 3 * c->threads && status == TN_OK; i++)
        status =
            tn_field_runner_new(c->field, &c->field->along[i % 3], c->options->interpret, &r.batches[i].runner, error);
    if (status == TN_OK)
        status = tn_crew_run(c->crew, c->grid->count[2], 1, do_layer, &r, error);
    for (unsigned i = 0; r.batches && i < 3 * c->threads; i++)
        tn_field_runner_clear(&r.batches[i].runner);
    free(r.batches);
    return status;
}
