/* Choosing an alternative of a symbol: by a draw, as the first that fits, or by value. */
#include "runtime/base/random.h"
#include "runtime/place/derivation.h"

enum { DRAWN_MAX = 64 }; /* members of a draw that are looked at */

static uint32_t draw(derivation *d, const tn_place_symbol *symbol)
{
    double u = tn_mersenne_draw(&d->random);
    uint32_t chosen = 0;
    d->model->counts.draws++;
    while (chosen + 1 < symbol->count && !(d->rules->alternatives[symbol->first + chosen].share > u))
        chosen++;
    return symbol->first + chosen;
}

static void report(derivation *d, tn_place_outcome outcome, uint32_t alternative)
{
    if (!d->options.report)
        return;
    tn_place_event event = {.outcome = outcome,
                            .alternative = alternative,
                            .frame = d->frames.count ? &d->frames.items[d->frames.count - 1] : NULL,
                            .parts = d->model->count};
    if (outcome == TN_PLACE_REFUSED) {
        event.step = d->refused.step;
        event.obstacle = tn_obstacle_find(d, &d->refused.box);
    }
    d->options.report(d->options.context, &event);
}

/* One alternative alone is taken in any case: its lookahead is run only for what it does on the way. */
static tn_status take_only(derivation *d, uint32_t alternative)
{
    bool fits, acts = d->traces.traces[alternative].bounds || tn_world_is_empty(d);
    d->model->counts.tries++;
    tn_status status = acts ? tn_look_ahead(d, alternative, &fits) : TN_OK;
    if (status == TN_OK)
        report(d, TN_PLACE_TAKEN, alternative);
    return status;
}

/* The members of a draw that fit, each by its first alternative that does. */
typedef struct drawing {
    uint32_t fits[DRAWN_MAX], count;
    double share[DRAWN_MAX]; /* running sum of the weights */
} drawing;

/* One of those that fit, by weight; keyed by the seed and by how many were drawn before. */
static uint32_t draw_fitting(derivation *d, const drawing *drawn)
{
    double u = (double)(tn_random64(d->options.seed, 0, d->model->counts.draws++) >> 11) * 0x1p-53;
    uint32_t chosen = 0;
    while (chosen + 1 < drawn->count && !(drawn->share[chosen] > u * drawn->share[drawn->count - 1]))
        chosen++;
    return drawn->fits[chosen];
}

/* Tries the draw that begins at alternative *next, and goes past it; *fits: some member did. */
static tn_status choose_drawn(derivation *d, uint32_t end, uint32_t *next, bool *fits, uint32_t *chosen)
{
    const tn_place_alternative *alternatives = d->rules->alternatives;
    drawing drawn = {.count = 0};
    uint32_t taken = 0, before = 0; /* members */
    for (; *next < end && alternatives[*next].member > 0 && alternatives[*next].member >= before; (*next)++) {
        before = alternatives[*next].member;
        if (before == taken || drawn.count == DRAWN_MAX)
            continue;
        d->model->counts.tries++;
        tn_status status = tn_fits_here(d, *next, fits);
        if (status != TN_OK)
            return status;
        if (!*fits) {
            report(d, TN_PLACE_REFUSED, *next);
            continue;
        }
        taken = before;
        drawn.fits[drawn.count] = *next;
        drawn.share[drawn.count] = alternatives[*next].weight + (drawn.count ? drawn.share[drawn.count - 1] : 0);
        drawn.count++;
    }
    *fits = drawn.count > 0;
    if (*fits) {
        *chosen = draw_fitting(d, &drawn);
        report(d, TN_PLACE_DRAWN, *chosen);
    }
    return TN_OK;
}

static tn_status try_one(derivation *d, uint32_t *next, bool *fits, uint32_t *chosen)
{
    d->model->counts.tries++;
    *chosen = (*next)++;
    tn_status status = tn_fits_here(d, *chosen, fits);
    if (status == TN_OK)
        report(d, *fits ? TN_PLACE_TAKEN : TN_PLACE_REFUSED, *chosen);
    return status;
}

static tn_status no_value(derivation *d, const tn_place_symbol *symbol)
{
    tn_fail(d->error, TN_INVALID, E_PLACE_VALUE, "no alternative of %.100s has a fitness of 0 or more", symbol->name);
    tn_error_help(d->error, "the largest is taken where none reaches 1; a comparison is 1 or 0, as `elements <= 30`");
    return TN_INVALID;
}

/* By value: the first of at least 1, else the largest, the last of equals, as in the published program. */
static tn_status choose_best(derivation *d, const tn_place_symbol *symbol, uint32_t *chosen)
{
    double best = 0;
    bool found = false, best_fits = false;
    for (uint32_t i = symbol->first; i < symbol->first + symbol->count && !(found && best >= 1); i++) {
        bool fits;
        d->model->counts.tries++;
        tn_status status = tn_look_ahead(d, i, &fits);
        if (status != TN_OK)
            return status;
        double value = fits ? d->options.value(d->options.context, d->model, d->ahead_parts, d->ahead_count) : 0;
        if (!(value >= best))
            continue;
        found = true;
        best = value;
        best_fits = fits;
        *chosen = i;
    }
    d->model->counts.fallbacks += found && !best_fits;
    return found ? TN_OK : no_value(d, symbol);
}

/* The first alternative that fits, else the last. */
static tn_status choose(derivation *d, uint32_t index, uint32_t *chosen)
{
    const tn_place_symbol *symbol = &d->rules->symbols[index];
    bool fits = false;
    uint32_t end = symbol->first + symbol->count;
    if (d->options.value)
        return choose_best(d, symbol, chosen);
    if (tn_choose_traced(d, index, chosen))
        return TN_OK;
    for (uint32_t next = symbol->first; next < end;) {
        tn_status status = d->rules->alternatives[next].member ? choose_drawn(d, end, &next, &fits, chosen)
                                                               : try_one(d, &next, &fits, chosen);
        if (status != TN_OK || fits)
            return status;
    }
    *chosen = end - 1;
    d->model->counts.fallbacks++;
    report(d, TN_PLACE_FORCED, *chosen);
    return TN_OK;
}

tn_status tn_choose(derivation *d, uint32_t index, uint32_t from, uint32_t *chosen)
{
    const tn_place_symbol *symbol = &d->rules->symbols[index];
    *chosen = symbol->first;
    if (++d->idle > d->options.lookahead_limit)
        return tn_no_end(d, from, false);
    d->model->counts.expansions++;
    if (!symbol->drawn)
        return symbol->count == 1 ? take_only(d, *chosen) : choose(d, index, chosen);
    *chosen = draw(d, symbol);
    report(d, TN_PLACE_DRAWN, *chosen);
    return TN_OK;
}
