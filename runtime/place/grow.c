/* Derives a model: pending steps are a stack of places in alternatives, and each step is taken once. */
#include "runtime/place/grow.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/place/derivation.h"
#include "runtime/place/space.h"

enum { ASK_EVERY = 4096, DRAWN_MAX = 64 }; /* DRAWN_MAX: members of a draw that are looked at */

/* ---- expanding */

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
static tn_status choose(derivation *d, const tn_place_symbol *symbol, uint32_t *chosen)
{
    bool fits = false;
    uint32_t end = symbol->first + symbol->count;
    if (d->options.value)
        return choose_best(d, symbol, chosen);
    if (tn_nothing_fits(d, symbol)) { /* they were all tried at once */
        d->model->counts.tries += symbol->count;
        *chosen = end - 1;
        return TN_OK;
    }
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

static tn_status expand(derivation *d, uint32_t index, uint32_t from)
{
    const tn_place_symbol *symbol = &d->rules->symbols[index];
    uint32_t chosen = symbol->first;
    tn_status status = TN_OK;
    if (++d->idle > d->options.lookahead_limit)
        return tn_no_end(d, from, false);
    d->model->counts.expansions++;
    if (symbol->drawn) {
        chosen = draw(d, symbol);
        report(d, TN_PLACE_DRAWN, chosen);
    } else {
        status = symbol->count == 1 ? take_only(d, chosen) : choose(d, symbol, &chosen);
    }
    return status == TN_OK ? tn_pending_push(d, &d->pending, chosen) : status;
}

/* ---- taking steps for good */

static tn_status add_part(derivation *d, const tn_frame *frame, const tn_step *step)
{
    tn_placed_model *m = d->model;
    if (m->count == d->options.part_limit)
        return tn_past_limit(d, "parts", d->options.part_limit, "part-limit");
    if (!tn_array_reserve(&m->parts, &m->capacity, m->count, 1, sizeof *m->parts))
        return tn_fail_memory(d->error);
    m->parts[m->count++] = (tn_placed_part){*frame, step->text};
    return TN_OK;
}

/* Keeps what was filled, where somebody asks what is in the way. */
static tn_status keep_box(derivation *d, const tn_cell_box *box, uint32_t step)
{
    filled_boxes *boxes = &d->boxes;
    if (!d->options.keep_filled)
        return TN_OK;
    if (!tn_array_reserve(&boxes->items, &boxes->capacity, boxes->count, 1, sizeof *boxes->items))
        return tn_fail_memory(d->error);
    boxes->items[boxes->count++] = (filled_box){*box, step, (uint32_t)d->model->count};
    return TN_OK;
}

static tn_status fill(derivation *d, const tn_frame *frame, const tn_step *step, uint32_t index, uint32_t alternative)
{
    tn_cell_box box = tn_frame_box(frame, step);
    if (tn_step_may_fail(step->kind) && tn_cells_any(d->cells, &box)) {
        tn_status looked = tn_cells_status(d->cells, d->error);
        if (looked != TN_OK)
            return looked;
        *d->fault = (tn_place_fault){true, index, alternative, tn_obstacle_find(d, &box)};
        return tn_fail(d->error, TN_INVALID, E_PLACE_BLOCKED, "the place of this box is not free");
    }
    tn_status status = keep_box(d, &box, index);
    if (status != TN_OK)
        return status;
    return tn_cells_fill(d->cells, &box, d->error);
}

/* Looks at the cells x, then y, then z ascending, and fills those before the first filled one, as the published program
 * does. */
static tn_status touch(derivation *d, const tn_frame *frame, const tn_step *step, uint32_t index, uint32_t alternative)
{
    tn_cell_box box = tn_frame_box(frame, step);
    if (!tn_cells_any(d->cells, &box)) {
        *d->fault = (tn_place_fault){.has_step = true, .step = index, .alternative = alternative};
        return tn_fail(d->error, TN_INVALID, E_PLACE_BLOCKED, "there is nothing to touch here");
    }
    for (int32_t x = box.low[0]; x < box.high[0]; x++) {
        for (int32_t z = box.low[2]; z < box.high[2]; z++) {
            tn_cell_box one = {{x, box.low[1], z}, {x + 1, box.high[1], z + 1}};
            if (tn_cells_any(d->cells, &one))
                return TN_OK;
            tn_status status = tn_cells_fill(d->cells, &one, d->error);
            if (status != TN_OK)
                return status;
        }
    }
    return TN_OK;
}

static tn_status take_step(derivation *d, uint32_t index, uint32_t alternative)
{
    const tn_step *step = &d->rules->steps[index];
    if (d->frames.count == 0)
        return tn_no_frame(d, index, alternative);
    tn_frame *frame = &d->frames.items[d->frames.count - 1];
    switch (step->kind) {
    case TN_STEP_PUSH:
        return tn_frame_push(d, &d->frames, frame);
    case TN_STEP_POP:
        d->frames.count--;
        return TN_OK;
    case TN_STEP_PART:
        return add_part(d, frame, step);
    case TN_STEP_FILL:
    case TN_STEP_FILL_OVER:
    case TN_STEP_BLOCK:
        return fill(d, frame, step, index, alternative);
    case TN_STEP_TOUCH:
        return touch(d, frame, step, index, alternative);
    case TN_STEP_BOUND_BOX:
    case TN_STEP_BOUND_BALL:
        return tn_set_bound(d, frame, step);
    default:
        return tn_frame_step(frame, step) ? TN_OK : tn_too_far(d, index, alternative);
    }
}

static tn_status keep_step(derivation *d, uint32_t index)
{
    tn_placed_model *m = d->model;
    size_t taken = (size_t)m->counts.steps;
    if (!d->options.keep_steps)
        return TN_OK;
    if (!tn_array_reserve(&m->steps, &m->step_capacity, taken, 1, sizeof *m->steps))
        return tn_fail_memory(d->error);
    m->steps[taken] = index;
    return TN_OK;
}

/* Tells how many parts there are, and asks whether to go on. */
static tn_status look_up(const derivation *d)
{
    tn_watch_tell(d->options.watch, (double)d->model->count, 0);
    return tn_watch_check(d->options.watch, d->error);
}

static tn_status derive(derivation *d)
{
    uint32_t index, alternative;
    const tn_step *step;
    uint64_t done = 0;
    const tn_frame origin = {.colour = 1};
    tn_status status = tn_frame_push(d, &d->frames, &origin);
    if (status == TN_OK)
        status = expand(d, d->rules->start, 0);
    while (status == TN_OK && (step = tn_pending_next(d, &d->pending, &index, &alternative)) != NULL) {
        if (++done % ASK_EVERY == 0 && (status = look_up(d)) != TN_OK)
            return status;
        if (step->kind == TN_STEP_EXPAND) {
            status = expand(d, step->index, alternative);
            continue;
        }
        if (d->model->counts.steps == d->options.step_limit)
            return tn_past_limit(d, "steps", d->options.step_limit, "step-limit");
        status = take_step(d, index, alternative);
        if (status == TN_OK)
            status = tn_bound_empty_world(d);
        if (status == TN_OK)
            status = keep_step(d, index);
        d->model->counts.steps += status == TN_OK;
        d->idle = 0;
    }
    return status == TN_OK ? tn_cells_status(d->cells, d->error) : status;
}

static uint64_t or_default(uint64_t value, uint64_t usual)
{
    return value ? value : usual;
}

static tn_place_options filled(const tn_place_options *options)
{
    tn_place_options o = options ? *options : (tn_place_options){0};
    o.part_limit = or_default(o.part_limit, 1000000);
    o.step_limit = or_default(o.step_limit, 1000000000);
    o.frame_limit = or_default(o.frame_limit, 1000000);
    o.lookahead_limit = or_default(o.lookahead_limit, 1000000);
    return o;
}

tn_status tn_place_derive(const tn_place_rules *rules, const tn_place_options *options, tn_placed_model *model,
                          tn_place_fault *fault, tn_error *error)
{
    derivation d = {.rules = rules, .options = filled(options), .model = model, .fault = fault, .error = error};
    tn_space *space = NULL;
    *model = (tn_placed_model){0};
    *fault = (tn_place_fault){0};
    d.cells = tn_cells_new(d.options.watch);
    tn_status status = d.cells ? tn_traces_make(rules, &d.traces, error) : tn_fail_memory(error);
    if (status == TN_OK && rules->space)
        status = tn_space_new(rules, &space, error);
    if (status == TN_OK) {
        if (space)
            tn_cells_bound(d.cells, tn_space_cells(space));
        tn_mersenne_seed(&d.random, d.options.seed);
        status = derive(&d);
        model->counts.parts = model->count;
        model->counts.cells = tn_cells_count(d.cells);
    }
    tn_cells_free(d.cells);
    tn_space_free(space);
    tn_traces_clear(&d.traces);
    free(d.frames.items);
    free(d.trial.items);
    free(d.pending.items);
    free(d.ahead.items);
    free(d.boxes.items);
    free(d.ahead_parts);
    return status;
}

void tn_placed_model_clear(tn_placed_model *model)
{
    free(model->parts);
    free(model->steps);
    *model = (tn_placed_model){0};
}
