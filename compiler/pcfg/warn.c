/* Warns of what a connection grammar says and surely does not mean. */
#include "compiler/pcfg/check.h"
#include "runtime/place/model/frame.h"

/* ---- before the first bound */

static void find_nullable(const tn_pcfg_grammar *g)
{
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t s = 0; s < g->count; s++) {
            tn_pcfg_symbol *symbol = g->symbols[s];
            for (const tn_pcfg_alternative *a = symbol->alternatives.first; a && !symbol->nullable; a = a->next) {
                const tn_pcfg_item *item = a->first;
                while (item && item->kind == TN_PCFG_NAME && tn_pcfg_symbol_of(g, item)->nullable)
                    item = item->next;
                symbol->nullable = !item;
                changed |= symbol->nullable;
            }
        }
    }
}

/* A step that is no bound and can be the first of all; NULL where there is none. */
static const tn_pcfg_item *first_step(const tn_pcfg_grammar *g)
{
    uint32_t *pending = TN_NEW_ARRAY(g->arena, uint32_t, g->count + 1), count = 0;
    if (!pending)
        return NULL;
    pending[count++] = 0;
    g->symbols[0]->visited = true;
    while (count > 0) {
        const tn_pcfg_symbol *symbol = g->symbols[pending[--count]];
        for (const tn_pcfg_alternative *a = symbol->alternatives.first; a; a = a->next) {
            for (const tn_pcfg_item *item = a->first; item; item = item->next) {
                if (item->kind == TN_PCFG_TERMINAL && !tn_step_is_bound(item->step.kind))
                    return item;
                if (item->kind == TN_PCFG_TERMINAL)
                    break;
                tn_pcfg_symbol *next = tn_pcfg_symbol_of(g, item);
                if (!next->visited)
                    pending[count++] = next->index;
                next->visited = true;
                if (!next->nullable)
                    break;
            }
        }
    }
    return NULL;
}

static void check_first_step(const tn_pcfg_grammar *g)
{
    find_nullable(g);
    const tn_pcfg_item *item = first_step(g);
    if (!item)
        return;
    tn_diagnostic *d = tn_report(g->diagnostics, W_PLACE_BEFORE_BOUND, item->span,
                                 "this step can come before the first bound: after it, as nothing is filled, a ball of "
                                 "radius 8 bounds the model too");
    tn_help(g->diagnostics, d, "begin with the bound: %s -> 'PlaceBoundingBox(8,9,8)' ...", g->symbols[0]->name);
}

/* ---- lookaheads */

enum { STEPS_MAX = 4096, FRAMES_MAX = 64, DEPTH_MAX = 64 };

/* A walk through an alternative, each symbol in it replaced by its last alternative. */
typedef struct walk {
    const tn_pcfg_grammar *grammar;
    tn_frame frames[FRAMES_MAX];
    uint32_t depth, steps;
    bool may_fail, fills, stopped;
    tn_cell_box first; /* the first box that must be free */
} walk;

static void take(walk *w, const tn_step *step)
{
    w->may_fail |= tn_step_may_fail(step->kind);
    if (step->kind == TN_STEP_FILL && !w->fills) {
        w->fills = true;
        w->first = tn_frame_box(&w->frames[w->depth], step);
    } else if (step->kind == TN_STEP_PUSH && w->depth + 1 < FRAMES_MAX) {
        w->frames[w->depth + 1] = w->frames[w->depth];
        w->depth++;
    } else if (step->kind == TN_STEP_POP && w->depth > 0) {
        w->depth--;
    } else if (step->kind == TN_STEP_PUSH || step->kind == TN_STEP_POP) {
        w->stopped = true;
    } else {
        w->stopped |= !tn_frame_step(&w->frames[w->depth], step);
    }
}

static void go_through(walk *w, const tn_pcfg_alternative *alternative, uint32_t depth)
{
    for (const tn_pcfg_item *item = alternative->first; item && !w->stopped && !w->fills; item = item->next) {
        w->stopped = ++w->steps > STEPS_MAX || depth > DEPTH_MAX;
        if (item->kind == TN_PCFG_TERMINAL)
            take(w, &item->step);
        else if (!w->stopped)
            go_through(w, tn_pcfg_symbol_of(w->grammar, item)->alternatives.last, depth + 1);
    }
}

static walk look(const tn_pcfg_grammar *g, const tn_pcfg_alternative *alternative)
{
    walk w = {.grammar = g};
    go_through(&w, alternative, 0);
    return w;
}

static void check_close(const tn_pcfg_grammar *g, const tn_pcfg_symbol *symbol)
{
    const tn_pcfg_alternative *last = symbol->alternatives.last;
    if (symbol->drawn || symbol->count < 2 || !look(g, last).may_fail)
        return;
    tn_diagnostic *d =
        tn_report(g->diagnostics, W_PLACE_NO_CLOSE, last->span,
                  "where no alternative of %s fits, this last one is taken although it does not fit", symbol->name);
    tn_help(g->diagnostics, d, "give %s a last alternative that always fits, such as an empty one: %s ->", symbol->name,
            symbol->name);
}

/* Does a box hold one of the eight cells around the place that the symbol is expanded at? */
static bool touches(const tn_cell_box *box)
{
    for (int k = 0; k < 3; k++)
        if (box->low[k] >= 1 || box->high[k] <= -1)
            return false;
    return true;
}

/* Alternatives of a symbol that fills its place should all do so. */
static void check_touch(const tn_pcfg_grammar *g, const tn_pcfg_symbol *symbol)
{
    const tn_pcfg_alternative *touching = NULL;
    for (const tn_pcfg_alternative *a = symbol->alternatives.first; a && !touching; a = a->next) {
        walk w = look(g, a);
        touching = w.fills && touches(&w.first) ? a : NULL;
    }
    for (const tn_pcfg_alternative *a = symbol->alternatives.first; touching && a; a = a->next) {
        walk w = look(g, a);
        if (!w.fills || touches(&w.first))
            continue;
        tn_diagnostic *d = tn_report(g->diagnostics, W_PLACE_NO_TOUCH, a->span,
                                     "this alternative of %s misses its place: its box has the cells %d to %d, %d to "
                                     "%d, %d to %d from there",
                                     symbol->name, w.first.low[0], w.first.high[0] - 1, w.first.low[1],
                                     w.first.high[1] - 1, w.first.low[2], w.first.high[2] - 1);
        tn_note(g->diagnostics, d, &touching->span, "this one touches it");
    }
}

void tn_pcfg_warn(const tn_pcfg_grammar *g)
{
    check_first_step(g);
    for (uint32_t s = 0; s < g->count; s++) {
        if (!g->symbols[s]->reached)
            continue;
        check_close(g, g->symbols[s]);
        check_touch(g, g->symbols[s]);
    }
}
