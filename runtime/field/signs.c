/* Finds which samples are inside. Blocks whose sign intervals prove are not evaluated: first those of 32 samples a
 * side, then those of 8; what remains is evaluated by rows of 8 x 8 x 4 samples. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/field/contour_parts.h"
#include "runtime/numeric/any_width.h"

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

static tn_status do_layer(void *context, unsigned thread, size_t item, tn_error *error)
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
        status = tn_crew_run(c->crew, s.blocks[2], 1, do_layer, &s, error);
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
