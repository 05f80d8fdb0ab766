/* Meshes a field: signs of samples, vertices on edges, triangles of cells. */
#include "runtime/field/contour.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/watch.h"
#include "runtime/field/contouring.h"
#include "runtime/math/any_width.h"

/* ==== finds which samples are inside. Blocks whose sign intervals prove are not evaluated: first those of 32 samples a
 * side, then those of 8; what remains is evaluated by rows of 8 x 8 x 4 samples */

#define COARSE 4u                             /* blocks along the side of a coarse one */
#define HALF (TN_ROW / (TN_BLOCK * TN_BLOCK)) /* layers of a row */
_Static_assert(HALF * 2 == TN_BLOCK, "a block is two rows");

/* One thread's memory. */
typedef struct worker {
    tn_field_runner runner;
    tn_interval *registers;
} worker;

typedef struct signs {
    tn_contouring *c;
    worker *workers;
    uint32_t blocks[3];
    uint8_t *coarse;       /* what is proven of each coarse block of the layer at hand, [threads] of them */
    uint64_t *no_values;   /* [layers of blocks] */
    double (*no_value)[3]; /* the first of each layer */
    bool *outside;         /* [layers]: is any sample? */
} signs;

enum { UNKNOWN = 0, INSIDE = 1, OUTSIDE = 2 };

/* What intervals prove of samples first to last of each axis. */
static int prove(const tn_contouring *c, worker *w, const uint32_t first[3], uint32_t size)
{
    double low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        uint32_t last = first[axis] + size - 1, end = c->grid->count[axis] - 1;
        low[axis] = c->places[axis][first[axis]];
        high[axis] = c->places[axis][last < end ? last : end];
    }
    tn_interval bounds = tn_tape_bounds(&c->field->samples, low, high, &c->field->distances, w->registers);
    if (bounds.fails || tn_interval_is_none(bounds))
        return UNKNOWN;
    return bounds.high < 0 ? INSIDE : bounds.low >= 0 ? OUTSIDE : UNKNOWN;
}

/* Puts the coordinates of the row's samples in place: x changes first, then y, then z. Past the end of an axis the last
 * sample is repeated. */
static void place_row(const tn_contouring *c, worker *w, int axis, uint32_t first)
{
    uint32_t end = c->grid->count[axis] - 1, count = axis == 2 ? HALF : TN_BLOCK;
    uint32_t stride = axis == 0 ? 1 : axis == 1 ? TN_BLOCK : TN_BLOCK * TN_BLOCK, filled = count * stride;
    double *out = w->runner.rows.coordinates[axis];
    for (uint32_t i = 0; i < count; i++) {
        double place = c->places[axis][first + i < end ? first + i : end];
        for (uint32_t k = 0; k < stride; k++)
            out[i * stride + k] = place;
    }
    for (; filled < TN_ROW; filled *= 2)
        memcpy(out + filled, out, filled * sizeof *out);
}

/* Which of a row's values are inside, a byte each. Returns whether some have no value. */
TN_ANY_WIDTH static bool test_row(const double *restrict values, uint8_t *restrict inside)
{
    uint64_t none = 0;
    for (uint32_t i = 0; i < TN_ROW; i++) {
        inside[i] = values[i] < 0;
        none |= values[i] != values[i];
    }
    return none != 0;
}

static void note_no_values(signs *s, const double *values, const uint32_t at[3], uint32_t count, uint32_t layer)
{
    const tn_contouring *c = s->c;
    for (uint32_t i = 0; i < count; i++)
        if (values[i] != values[i] && s->no_values[layer]++ == 0)
            for (int axis = 0; axis < 3; axis++)
                s->no_value[layer][axis] = c->places[axis][axis == 0 ? at[0] + i : at[axis]];
}

/* Eight bytes, each 0 or 1, as bits: the first is the lowest. */
static uint64_t bits_of(const uint8_t bytes[TN_BLOCK])
{
    uint64_t bits = 0;
    for (uint32_t i = 0; i < TN_BLOCK; i++)
        bits |= (uint64_t)bytes[i] << 8 * i;
    return bits * 0x0102040810204080 >> 56;
}

/* Writes the signs of one row's samples. */
static void take_row(signs *s, const double *values, const uint32_t first[3], uint32_t layer)
{
    const tn_contouring *c = s->c;
    uint8_t inside[TN_ROW];
    bool some_have_none = test_row(values, inside);
    uint32_t left = c->grid->count[0] - first[0], count = left < TN_BLOCK ? left : TN_BLOCK;
    uint64_t all = ((uint64_t)1 << count) - 1;
    for (uint32_t line = 0; line < TN_ROW / TN_BLOCK; line++) {
        uint32_t y = first[1] + line % TN_BLOCK, z = first[2] + line / TN_BLOCK;
        if (y >= c->grid->count[1] || z >= c->grid->count[2])
            continue;
        uint64_t bits = bits_of(inside + line * TN_BLOCK) & all;
        s->outside[layer] |= bits != all;
        if (some_have_none)
            note_no_values(s, values + line * TN_BLOCK, (uint32_t[3]){first[0], y, z}, count, layer);
        uint64_t *row = c->signs + ((size_t)z * c->grid->count[1] + y) * c->words;
        row[first[0] / 64] |= bits << (first[0] % 64);
    }
}

static void fill_block(const tn_contouring *c, const uint32_t first[3])
{
    uint32_t left = c->grid->count[0] - first[0], count = left < TN_BLOCK ? left : TN_BLOCK;
    uint64_t bits = (((uint64_t)1 << count) - 1) << (first[0] % 64);
    for (uint32_t z = first[2]; z < first[2] + TN_BLOCK && z < c->grid->count[2]; z++)
        for (uint32_t y = first[1]; y < first[1] + TN_BLOCK && y < c->grid->count[1]; y++)
            c->signs[((size_t)z * c->grid->count[1] + y) * c->words + first[0] / 64] |= bits;
}

/* What is proven of the blocks along x at one place: all coarse ones first. */
static uint32_t prove_blocks(signs *s, worker *w, uint32_t by, uint32_t layer, const uint8_t *coarse, uint8_t *known)
{
    const tn_contouring *c = s->c;
    uint32_t unknown = 0;
    for (uint32_t bx = 0; bx < s->blocks[0]; bx++) {
        uint32_t first[3] = {bx * TN_BLOCK, by * TN_BLOCK, layer * TN_BLOCK};
        known[bx] = coarse[bx / COARSE];
        if (known[bx] == UNKNOWN && !c->options->every_sample)
            known[bx] = (uint8_t)prove(c, w, first, TN_BLOCK);
        if (known[bx] == INSIDE)
            fill_block(c, first);
        s->outside[layer] |= known[bx] == OUTSIDE;
        unknown += known[bx] == UNKNOWN;
    }
    return unknown;
}

static void prove_coarse(signs *s, worker *w, uint32_t by, uint32_t layer, uint8_t *coarse)
{
    const tn_contouring *c = s->c;
    for (uint32_t cx = 0; cx * COARSE < s->blocks[0]; cx++) {
        uint32_t side = COARSE * TN_BLOCK, first[3] = {cx * side, by / COARSE * side, layer / COARSE * side};
        coarse[cx] = c->options->every_sample ? UNKNOWN : (uint8_t)prove(c, w, first, side);
    }
}

/* Evaluates the blocks along x of which nothing is proven: what depends on y and z only is computed once. */
static void evaluate_blocks(signs *s, worker *w, uint32_t by, uint32_t layer, const uint8_t *known)
{
    const tn_contouring *c = s->c;
    place_row(c, w, 1, by * TN_BLOCK);
    for (uint32_t half = 0; half < TN_BLOCK; half += HALF) {
        if (layer * TN_BLOCK + half >= c->grid->count[2])
            break;
        place_row(c, w, 2, layer * TN_BLOCK + half);
        tn_field_prepare(&w->runner);
        for (uint32_t bx = 0; bx < s->blocks[0]; bx++) {
            if (known[bx] != UNKNOWN)
                continue;
            uint32_t first[3] = {bx * TN_BLOCK, by * TN_BLOCK, layer * TN_BLOCK + half};
            place_row(c, w, 0, first[0]);
            take_row(s, tn_field_run(&w->runner), first, layer);
        }
    }
}

static tn_status sign_layer(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)error;
    signs *s = context;
    worker *w = &s->workers[thread];
    uint32_t layer = (uint32_t)item;
    uint8_t *known = s->coarse + (size_t)thread * 2 * s->blocks[0], *coarse = known + s->blocks[0];
    for (uint32_t by = 0; by < s->blocks[1]; by++) {
        if (by % COARSE == 0)
            prove_coarse(s, w, by, layer, coarse);
        if (prove_blocks(s, w, by, layer, coarse, known))
            evaluate_blocks(s, w, by, layer, known);
    }
    return TN_OK;
}

/* Samples on the faces of the box are outside; that closes what would leave it. Says whether any is inside then. */
static void close_box(tn_contouring *c)
{
    const uint32_t *n = c->grid->count;
    size_t last = (n[0] - 1) / 64;
    uint64_t low = 1, high = (uint64_t)1 << ((n[0] - 1) % 64);
    for (uint32_t z = 0; z < n[2]; z++)
        for (uint32_t y = 0; y < n[1]; y++) {
            uint64_t *row = c->signs + ((size_t)z * n[1] + y) * c->words, any = 0;
            c->out->cut |= (row[0] & low ? 1u : 0) | (row[last] & high ? 2u : 0);
            if (!c->options->open) {
                row[0] &= ~low;
                row[last] &= ~high;
            }
            bool low_z = z == 0 && !c->flat, high_z = z == n[2] - 1 && !c->flat;
            if (y > 0 && y < n[1] - 1 && !low_z && !high_z)
                continue;
            for (size_t i = 0; i < c->words; i++)
                any |= row[i];
            if (any)
                c->out->cut |= (y == 0 ? 4u : 0) | (y == n[1] - 1 ? 8u : 0) | (low_z ? 16u : 0) | (high_z ? 32u : 0);
            if (!c->options->open)
                memset(row, 0, c->words * sizeof *row);
        }
    for (size_t i = 0; i < (size_t)n[1] * n[2] * c->words && !c->out->inside; i++)
        c->out->inside = c->signs[i] != 0;
}

static void sum_up(signs *s)
{
    tn_contour *out = s->c->out;
    for (uint32_t layer = 0; layer < s->blocks[2]; layer++) {
        if (out->no_values == 0 && s->no_values[layer])
            memcpy(out->no_value, s->no_value[layer], sizeof out->no_value);
        out->no_values += s->no_values[layer];
        out->outside = out->outside || s->outside[layer];
    }
}

static tn_status make_workers(signs *s, tn_error *error)
{
    tn_contouring *c = s->c;
    for (unsigned t = 0; t < c->threads; t++) {
        tn_status status =
            tn_field_runner_new(c->field, &c->field->samples, c->options->interpret, &s->workers[t].runner, error);
        if (status != TN_OK)
            return status;
        s->workers[t].registers = calloc(c->field->samples.register_count, sizeof *s->workers[t].registers);
        if (!s->workers[t].registers)
            return tn_fail_memory(error);
    }
    return TN_OK;
}

tn_status tn_contour_signs(tn_contouring *c, tn_error *error)
{
    signs s = {.c = c, .workers = calloc(c->threads, sizeof *s.workers)};
    for (int axis = 0; axis < 3; axis++)
        s.blocks[axis] = (c->grid->count[axis] + TN_BLOCK - 1) / TN_BLOCK;
    s.coarse = calloc((size_t)c->threads * 2, s.blocks[0]);
    s.no_values = calloc(s.blocks[2], sizeof *s.no_values);
    s.no_value = calloc(s.blocks[2], sizeof *s.no_value);
    s.outside = calloc(s.blocks[2], sizeof *s.outside);
    bool room = s.workers && s.coarse && s.no_values && s.no_value && s.outside;
    tn_status status = room ? make_workers(&s, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_crew_run(c->crew, s.blocks[2], 1, sign_layer, &s, error);
    if (status == TN_OK) {
        sum_up(&s);
        close_box(c);
    }
    for (unsigned t = 0; s.workers && t < c->threads; t++) {
        tn_field_runner_clear(&s.workers[t].runner);
        free(s.workers[t].registers);
    }
    free(s.workers);
    free(s.coarse);
    free(s.no_values);
    free(s.no_value);
    free(s.outside);
    return status;
}

/* ==== finds where edges of the grid cross the surface: a row of edges at once, by halving and a secant at the end */

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

/* ==== meshes a field: signs of samples, vertices on edges, triangles of cells */

void tn_contour_clear(tn_contour *contour)
{
    tn_mesh_clear(&contour->mesh);
    *contour = (tn_contour){0};
}

static tn_status check_size(const tn_field_grid *grid, const tn_contour_options *options, tn_error *error)
{
    uint64_t most = options->samples ? options->samples : TN_SAMPLES_MAX;
    uint64_t samples = (uint64_t)grid->count[0] * grid->count[1] * grid->count[2];
    if (samples <= most)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_FIELD_SAMPLES, "the grid has %u x %u x %u = %llu samples; the limit is %llu",
            grid->count[0], grid->count[1], grid->count[2], (unsigned long long)samples, (unsigned long long)most);
    tn_error_help(error, "take a coarser --grid, or raise --max-samples");
    return TN_LIMIT;
}

tn_status tn_contouring_begin(tn_contouring *c, const double *z, tn_error *error)
{
    const uint32_t *n = c->grid->count;
    tn_status status = check_size(c->grid, c->options, error);
    if (status != TN_OK)
        return status;
    c->threads = c->options->threads ? c->options->threads : tn_crew_default();
    c->crew = tn_crew_new(c->threads, c->field->module->watch);
    c->words = (n[0] + 63) / 64;
    c->signs = calloc(tn_size_of((size_t)n[1] * n[2], c->words), sizeof *c->signs);
    c->first = calloc((size_t)n[1] * n[2], sizeof *c->first);
    c->layer_jumps = calloc(n[2], sizeof *c->layer_jumps);
    c->layer_moved = calloc(n[2], sizeof *c->layer_moved);
    for (int axis = 0; axis < 3; axis++) {
        c->places[axis] = malloc(n[axis] * sizeof *c->places[axis]);
        for (uint32_t i = 0; c->places[axis] && i < n[axis]; i++)
            c->places[axis][i] = axis == 2 && z ? z[i] : tn_field_sample(c->grid, axis, i);
    }
    bool room = c->crew && c->signs && c->first && c->layer_jumps && c->layer_moved && c->places[0] && c->places[1] &&
                c->places[2];
    return room ? TN_OK : tn_fail_memory(error);
}

void tn_contouring_free(tn_contouring *c)
{
    if (c->crew)
        tn_crew_free(c->crew);
    for (int axis = 0; axis < 3; axis++)
        free(c->places[axis]);
    free(c->signs);
    free(c->first);
    free(c->layer_jumps);
    free(c->layer_moved);
    free(c->jumping);
}

void tn_contouring_count(const tn_contouring *c)
{
    for (uint32_t z = 0; z < c->grid->count[2]; z++) {
        c->out->jumps += c->layer_jumps[z];
        c->out->moved += c->layer_moved[z];
    }
    for (uint64_t v = 0; c->out->jumps && v < c->vertex_count; v++)
        if (c->jumping[v / 64] >> (v % 64) & 1) {
            for (int axis = 0; axis < 3; axis++)
                c->out->jump[axis] = c->out->mesh.positions[3 * v + (uint64_t)axis];
            return;
        }
}

/* Leaves out the vertices that no triangle has any more; the others keep their order. */
static tn_status drop_unused(tn_mesh *mesh, tn_error *error)
{
    uint32_t *number = calloc(mesh->vertex_count + 1, sizeof *number), count = 0;
    if (!number)
        return tn_fail_memory(error);
    for (size_t i = 0; i < 3 * mesh->face_count; i++)
        number[mesh->corners[i]] = 1;
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        if (!number[v])
            continue;
        memmove(mesh->positions + 3 * (size_t)count, mesh->positions + 3 * v, 3 * sizeof *mesh->positions);
        number[v] = count++;
    }
    for (size_t i = 0; i < 3 * mesh->face_count; i++)
        mesh->corners[i] = number[mesh->corners[i]];
    mesh->vertex_count = count;
    free(number);
    return TN_OK;
}

tn_status tn_contour_new(const tn_field *field, const tn_field_grid *grid, const tn_contour_options *options,
                         tn_contour *contour, tn_error *error)
{
    static tn_status (*const stages[])(tn_contouring *, tn_error *) = {tn_contour_signs, tn_contour_roots,
                                                                       tn_contour_cells, tn_contour_sharp_cells};
    *contour = (tn_contour){.mesh.watch = field->module->watch};
    for (int axis = 0; axis < 3; axis++)
        contour->spacing = fmax(contour->spacing, (grid->high[axis] - grid->low[axis]) / (grid->count[axis] - 1));
    tn_contouring c = {.field = field, .grid = grid, .options = options, .out = contour};
    tn_status status = tn_contouring_begin(&c, NULL, error);
    for (int i = 0; i < 3 && status == TN_OK; i += i == 0 && options->survey ? 2 : 1) {
        double begun = tn_seconds();
        status = stages[i == 2 && options->sharp ? 3 : i](&c, error);
        if (status == TN_OK && i == 0 && options->between)
            status = tn_contour_missed(&c, error);
        contour->seconds[i] = tn_seconds() - begun;
    }
    if (status == TN_OK)
        tn_contouring_count(&c);
    if (status == TN_OK && options->jumps_open)
        status = drop_unused(&contour->mesh, error);
    tn_contouring_free(&c);
    return status;
}
