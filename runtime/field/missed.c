/* Looks for parts of a form that lie between samples, by intervals: in cells that have nothing inside at any sample of
 * theirs or next to them. (Nearer to the mesh, what bulges through the side of a cell is no part that is missing.) */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/field/contouring.h"

/* How often a layer of blocks may ask for bounds: beside large grids about as long as sampling takes. Where nothing at
 * all was found, more: then it is to be proven that there is nothing. */
#define ASKED_LEAST 8000u
#define EMPTY_SHARE 20u
/* Halvings of one cell. A wall is come to in as many as its thickness has leading zeros, as a share of the cell. */
#define HALVINGS 40u
#define PIECES_MAX (8 * HALVINGS)

typedef struct finding {
    uint64_t cells;
    double at[3];   /* inside, in the first */
    bool undecided; /* something was left open */
} finding;

typedef struct looking {
    const tn_contouring *c;
    tn_interval **registers; /* [thread] */
    finding *found;          /* [layer of blocks] */
    uint32_t layers;
    uint64_t asked_most; /* of a layer */
} looking;

/* One thread's work on a layer. */
typedef struct search {
    const tn_contouring *c;
    tn_interval *registers;
    finding *found;
    uint64_t left; /* bounds that may still be asked for */
} search;

/* A piece of a cell. */
typedef struct piece {
    double low[3], high[3];
    double middle; /* the field there; large where it has no value */
} piece;

enum { UNKNOWN, OUTSIDE, INSIDE };

static int prove(search *s, const double low[3], const double high[3], double *most)
{
    s->left -= s->left > 0;
    tn_interval f = tn_tape_bounds(&s->c->field->samples, low, high, &s->c->field->distances, s->registers);
    *most = f.fails || tn_interval_is_none(f) ? INFINITY : f.high;
    if (tn_interval_is_none(f) || f.low >= 0)
        return OUTSIDE; /* what has no value is outside */
    return *most < 0 ? INSIDE : UNKNOWN;
}

/* ---- one cell */

typedef struct pieces {
    piece items[PIECES_MAX];
    size_t count;
    double inside[3]; /* a place, once one is found */
} pieces;

/* Adds an eighth of a piece, unless it is outside. True if some of it is inside. */
static bool add_piece(search *s, pieces *all, const piece *of, unsigned eighth)
{
    piece p;
    double middle[3], most;
    for (int k = 0; k < 3; k++) {
        double half = .5 * (of->low[k] + of->high[k]);
        p.low[k] = eighth >> k & 1 ? half : of->low[k];
        p.high[k] = eighth >> k & 1 ? of->high[k] : half;
        middle[k] = .5 * (p.low[k] + p.high[k]);
    }
    int known = prove(s, p.low, p.high, &most);
    if (known == UNKNOWN && prove(s, middle, middle, &p.middle) == INSIDE)
        known = INSIDE;
    if (known == INSIDE)
        memcpy(all->inside, middle, sizeof all->inside);
    else if (known == UNKNOWN)
        all->items[all->count++] = p;
    return known == INSIDE;
}

/* Halves what is nearest to the form first. INSIDE where a place is found, OUTSIDE where there is none. */
static int search_cell(search *s, const double low[3], const double high[3], pieces *all)
{
    piece whole;
    memcpy(whole.low, low, sizeof whole.low);
    memcpy(whole.high, high, sizeof whole.high);
    whole.middle = 0;
    all->items[0] = whole;
    all->count = 1;
    for (unsigned i = 0; i < HALVINGS && all->count && s->left; i++) {
        size_t best = 0;
        for (size_t k = 1; k < all->count; k++)
            if (all->items[k].middle < all->items[best].middle)
                best = k;
        piece of = all->items[best];
        all->items[best] = all->items[--all->count];
        for (unsigned eighth = 0; eighth < 8; eighth++)
            if (add_piece(s, all, &of, eighth))
                return INSIDE;
    }
    return all->count ? UNKNOWN : OUTSIDE;
}

/* The samples that a cell has, or has next to it. */
typedef struct around {
    uint32_t from[3], to[3];
} around;

static around around_cell(const tn_contouring *c, const uint32_t at[3])
{
    around a;
    for (int k = 0; k < 3; k++) {
        a.from[k] = at[k] > 0 ? at[k] - 1 : 0;
        a.to[k] = at[k] + 2 < c->grid->count[k] ? at[k] + 2 : c->grid->count[k] - 1;
    }
    return a;
}

/* Are all of them outside? */
static bool is_alone(const tn_contouring *c, const around *a)
{
    for (uint32_t z = a->from[2]; z <= a->to[2]; z++)
        for (uint32_t y = a->from[1]; y <= a->to[1]; y++) {
            const uint64_t *row = tn_signs_at(c, y, z);
            for (uint32_t x = a->from[0]; x <= a->to[0]; x++)
                if (row[x / 64] >> (x % 64) & 1)
                    return false;
        }
    return true;
}

/* Is one of them inside, and taken for outside only since it lies on a face of the box? Then the box cuts the form
 * there, which is told by itself. */
static bool is_cut(search *s, const around *a)
{
    const tn_contouring *c = s->c;
    const uint32_t *n = c->grid->count;
    for (uint32_t z = a->from[2]; z <= a->to[2]; z++)
        for (uint32_t y = a->from[1]; y <= a->to[1]; y++)
            for (uint32_t x = a->from[0]; x <= a->to[0]; x++) {
                const double place[3] = {c->places[0][x], c->places[1][y], c->places[2][z]};
                bool face = x == 0 || y == 0 || z == 0 || x == n[0] - 1 || y == n[1] - 1 || z == n[2] - 1;
                double most;
                if (face && prove(s, place, place, &most) == INSIDE)
                    return true;
            }
    return false;
}

static void look_at_cell(search *s, const around *a, const double low[3], const double high[3])
{
    pieces all;
    if (s->c->out->cut && s->c->out->inside && !s->c->options->open && is_cut(s, a))
        return;
    int known = search_cell(s, low, high, &all);
    s->found->undecided = s->found->undecided || known == UNKNOWN;
    if (known == INSIDE && s->found->cells++ == 0)
        memcpy(s->found->at, all.inside, sizeof all.inside);
}

/* ---- all cells */

/* The cells from `at` on, `size` of them along each axis. */
static void look(search *s, const uint32_t at[3], uint32_t size)
{
    const tn_contouring *c = s->c;
    double low[3], high[3], most;
    for (int k = 0; k < 3; k++) {
        uint32_t last = c->grid->count[k] - 1, end = at[k] + size;
        if (at[k] >= last)
            return;
        low[k] = c->places[k][at[k]];
        high[k] = c->places[k][end < last ? end : last];
    }
    around beside = around_cell(c, at);
    if (size == 1 && !is_alone(c, &beside))
        return;
    if (!s->left)
        s->found->undecided = true;
    if (!s->left || prove(s, low, high, &most) == OUTSIDE || (size > 1 && most < 0))
        return; /* what is inside as a whole has samples */
    if (size == 1) {
        look_at_cell(s, &beside, low, high);
        return;
    }
    for (uint32_t part = 0; part < 8; part++) {
        uint32_t half = size / 2;
        look(s,
             (uint32_t[]){at[0] + (part & 1 ? half : 0), at[1] + (part & 2 ? half : 0), at[2] + (part & 4 ? half : 0)},
             half);
    }
}

static tn_status do_layer(void *context, unsigned thread, size_t layer, tn_error *error)
{
    (void)error;
    looking *l = context;
    search s = {l->c, l->registers[thread], &l->found[layer], l->asked_most};
    for (uint32_t y = 0; y < l->c->grid->count[1]; y += TN_BLOCK)
        for (uint32_t x = 0; x < l->c->grid->count[0]; x += TN_BLOCK)
            look(&s, (uint32_t[]){x, y, (uint32_t)layer * TN_BLOCK}, TN_BLOCK);
    return TN_OK;
}

static void sum_up(const looking *l, tn_contour *out)
{
    bool undecided = false;
    for (uint32_t layer = 0; layer < l->layers; layer++) {
        const finding *f = &l->found[layer];
        if (out->missed == 0 && f->cells)
            memcpy(out->missed_at, f->at, sizeof out->missed_at);
        out->missed += f->cells;
        undecided = undecided || f->undecided;
    }
    out->empty = !out->inside && !out->missed && !undecided;
}

static tn_status check_found(const tn_contour *out, tn_error *error)
{
    if (out->inside || !out->missed)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_FIELD_MISSED,
            "the form lies between the samples: none is inside, but (%.6g, %.6g, %.6g) is", out->missed_at[0],
            out->missed_at[1], out->missed_at[2]);
    tn_error_help(error, "take a finer --grid, or a smaller box around the form");
    return TN_INVALID;
}

tn_status tn_contour_missed(tn_contouring *c, tn_error *error)
{
    const uint32_t *n = c->grid->count;
    looking l = {.c = c, .layers = (n[2] + TN_BLOCK - 1) / TN_BLOCK};
    l.asked_most = (ASKED_LEAST + (uint64_t)n[0] * n[1] / 8) * (c->out->inside ? 1 : EMPTY_SHARE);
    l.registers = calloc(c->threads, sizeof *l.registers);
    l.found = calloc(l.layers, sizeof *l.found);
    tn_status status = l.registers && l.found ? TN_OK : tn_fail_memory(error);
    for (unsigned t = 0; t < c->threads && status == TN_OK; t++) {
        l.registers[t] = calloc(c->field->samples.register_count, sizeof *l.registers[t]);
        if (!l.registers[t])
            status = tn_fail_memory(error);
    }
    if (status == TN_OK)
        status = tn_crew_run(c->crew, l.layers, 1, do_layer, &l, error);
    if (status == TN_OK) {
        sum_up(&l, c->out);
        status = check_found(c->out, error);
    }
    for (unsigned t = 0; l.registers && t < c->threads; t++)
        free(l.registers[t]);
    free(l.registers);
    free(l.found);
    return status;
}
