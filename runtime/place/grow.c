/* Derives a model: pending steps are a stack of places in alternatives, and each step is taken once. Before an
 * alternative is chosen, looking ahead finds out whether it fits. */
#include "runtime/place/grow.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/place/derivation.h"
#include "runtime/place/space.h"

/* ---- what steps do for good: they place parts, and fill cells */

static tn_status take_part(derivation *d, const tn_frame *frame, const char *name)
{
    tn_placed_model *m = d->model;
    if (m->count == d->options.part_limit)
        return tn_past_limit(d, "parts", d->options.part_limit, "part-limit");
    if (!tn_array_reserve(&m->parts, &m->capacity, m->count, 1, sizeof *m->parts))
        return tn_fail_memory(d->error);
    m->parts[m->count++] = (tn_placed_part){*frame, name};
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

static tn_status fill(derivation *d, tn_step_kind kind, const tn_cell_box *box, uint32_t step, uint32_t alternative)
{
    if (tn_step_may_fail(kind) && tn_cells_any(d->cells, box)) {
        tn_status looked = tn_cells_status(d->cells, d->error);
        if (looked != TN_OK)
            return looked;
        *d->fault = (tn_place_fault){true, step, alternative, tn_obstacle_find(d, box)};
        return tn_fail(d->error, TN_INVALID, E_PLACE_BLOCKED, "the place of this box is not free");
    }
    tn_status status = keep_box(d, box, step);
    return status == TN_OK ? tn_cells_fill(d->cells, box, d->error) : status;
}

/* Looks at the cells x, then y, then z ascending, and fills those before the first filled one, as the published program
 * does. */
static tn_status touch(derivation *d, const tn_cell_box *box, uint32_t step, uint32_t alternative)
{
    if (tn_cells_has(d->cells, box->low)) /* as mostly: the first */
        return TN_OK;
    if (!tn_cells_any(d->cells, box)) {
        *d->fault = (tn_place_fault){.has_step = true, .step = step, .alternative = alternative};
        return tn_fail(d->error, TN_INVALID, E_PLACE_BLOCKED, "there is nothing to touch here");
    }
    for (int32_t x = box->low[0]; x < box->high[0]; x++) {
        for (int32_t z = box->low[2]; z < box->high[2]; z++) {
            tn_cell_box one = {{x, box->low[1], z}, {x + 1, box->high[1], z + 1}};
            if (tn_cells_any(d->cells, &one))
                return TN_OK;
            tn_status status = tn_cells_fill(d->cells, &one, d->error);
            if (status != TN_OK)
                return status;
        }
    }
    return TN_OK;
}

/* FILL, FILL_OVER, BLOCK or TOUCH: step `step` of the rules, which `alternative` put there. */
static tn_status take_cells(derivation *d, tn_step_kind kind, const tn_cell_box *box, uint32_t step,
                            uint32_t alternative)
{
    return kind == TN_STEP_TOUCH ? touch(d, box, step, alternative) : fill(d, kind, box, step, alternative);
}

/* ---- looking ahead: does an alternative fit? Each symbol in it is replaced by its last alternative */

/* The frame at hand of a lookahead: one of its own, or the derivation's. `kept` counts the derivation's frames that it
 * did not drop. NULL if the last was dropped. */
static tn_frame *trial_frame(derivation *d, size_t kept)
{
    if (d->trial.count > 0)
        return &d->trial.items[d->trial.count - 1];
    return kept > 0 ? &d->frames.items[kept - 1] : NULL;
}

/* One step of a lookahead on a frame of its own or of the derivation; *fits is set to false if a test fails. A frame
 * of the derivation is copied before it is changed. */
static tn_status try_step(derivation *d, uint32_t index, uint32_t alternative, size_t *kept, bool *fits)
{
    const tn_step *step = &d->rules->steps[index];
    tn_frame *frame = trial_frame(d, *kept);
    if (!frame)
        return tn_no_frame(d, index, alternative);
    switch (step->kind) {
    case TN_STEP_PUSH:
        return tn_frame_push(d, &d->trial, frame);
    case TN_STEP_POP:
        *(d->trial.count > 0 ? &d->trial.count : kept) -= 1;
        return TN_OK;
    case TN_STEP_FILL:
    case TN_STEP_BLOCK:
    case TN_STEP_TOUCH: {
        tn_cell_box box = tn_frame_box(frame, step);
        *fits = tn_cells_any(d->cells, &box) == (step->kind == TN_STEP_TOUCH);
        if (!*fits)
            d->refused = (refusal){index, box};
        return TN_OK;
    }
    case TN_STEP_PART:
        if (!d->options.value)
            return TN_OK;
        if (!tn_array_reserve(&d->ahead_parts, &d->ahead_capacity, d->ahead_count, 1, sizeof *d->ahead_parts))
            return tn_fail_memory(d->error);
        d->ahead_parts[d->ahead_count++] = step->text;
        return TN_OK;
    case TN_STEP_BOUND_BOX:
    case TN_STEP_BOUND_BALL:
        return tn_set_bound(d, frame, step);
    case TN_STEP_MOVE:
    case TN_STEP_TURN:
        if (d->trial.count == 0) { /* the derivation's own frame stays as it is */
            tn_status status = tn_frame_push(d, &d->trial, frame);
            if (status != TN_OK)
                return status;
            (*kept)--;
            frame = trial_frame(d, *kept);
        }
        return tn_frame_step(frame, step) ? TN_OK : tn_too_far(d, index, alternative);
    default:
        return TN_OK;
    }
}

/* Runs a lookahead step by step until something does not fit. */
static tn_status look_ahead(derivation *d, uint32_t alternative, bool *fits)
{
    size_t kept = d->frames.count;
    uint64_t taken = 0;
    uint32_t index, of;
    const tn_step *step;
    d->trial.count = d->ahead.count = d->ahead_count = 0;
    *fits = true;
    tn_status status = tn_pending_push(d, &d->ahead, alternative);
    while (status == TN_OK && *fits && (step = tn_pending_next(d, &d->ahead, &index, &of)) != NULL) {
        if (++taken > d->options.lookahead_limit)
            return tn_no_end(d, alternative, true);
        if (step->kind == TN_STEP_EXPAND) {
            const tn_place_symbol *symbol = &d->rules->symbols[step->index];
            status = tn_pending_push(d, &d->ahead, symbol->first + symbol->count - 1);
            continue;
        }
        status = try_step(d, index, of, &kept, fits);
        if (status == TN_OK && *fits)
            status = tn_bound_empty_world(d);
    }
    return status;
}

/* May what was worked out be relied on here? Whoever looks on is told of every alternative, and where no cell is filled
 * yet, steps have the effect of bound_empty_world. */
static bool traces_do(const derivation *d)
{
    return !d->options.interpret && !d->options.report && d->frames.count > 0 && !tn_world_is_empty(d);
}

/* Does a trace that is known fit at a frame? */
static inline bool trace_fits(derivation *d, const tn_trace *trace, const tn_frame *frame)
{
    const tn_trace_test *test = &d->traces.tests[trace->first], *end = test + trace->count;
    for (; test < end; test++) {
        tn_cell_box box = tn_cell_box_at(test->box, frame);
        if (tn_cells_any(d->cells, &box) != test->filled)
            return false;
    }
    return true;
}

/* The first that fits of alternatives that are traced; the last where none does. */
static uint32_t first_that_fits(derivation *d, const tn_place_symbol *symbol, const tn_frame *frame)
{
    const tn_trace *traces = &d->traces.traces[symbol->first];
    uint32_t next = 0;
    while (next < symbol->count && !trace_fits(d, &traces[next], frame))
        next++;
    bool fits = next < symbol->count;
    d->model->counts.tries += next + fits;
    d->model->counts.fallbacks += !fits;
    return symbol->first + (fits ? next : next - 1);
}

/* Chooses among alternatives whose lookaheads were worked out. False if they were not, or do not say all here. */
static bool choose_traced(derivation *d, uint32_t index, uint32_t *chosen)
{
    const tn_place_symbol *symbol = &d->rules->symbols[index];
    const tn_common *common = &d->traces.common[index];
    if ((!common->known && !common->traced) || !traces_do(d))
        return false;
    const tn_frame *frame = &d->frames.items[d->frames.count - 1];
    if (common->known) {
        tn_cell_box box = tn_cell_box_at(common->box, frame);
        if (tn_cells_any(d->cells, &box)) { /* they were all tried at once */
            d->model->counts.tries += symbol->count;
            *chosen = symbol->first + symbol->count - 1;
            return true;
        }
    }
    if (common->traced)
        *chosen = first_that_fits(d, symbol, frame);
    return common->traced;
}

/* Does an alternative fit? Where it does not, and was looked at step by step, d->refused says why. */
static tn_status fits_here(derivation *d, uint32_t alternative, bool *fits)
{
    const tn_trace *trace = &d->traces.traces[alternative];
    if (!trace->known || !traces_do(d))
        return look_ahead(d, alternative, fits);
    *fits = trace_fits(d, trace, &d->frames.items[d->frames.count - 1]);
    return TN_OK;
}

/* ---- choosing an alternative of a symbol: by a draw, as the first that fits, or by value */

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
    tn_status status = acts ? look_ahead(d, alternative, &fits) : TN_OK;
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
        tn_status status = fits_here(d, *next, fits);
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
    tn_status status = fits_here(d, *chosen, fits);
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
        tn_status status = look_ahead(d, i, &fits);
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
    if (choose_traced(d, index, chosen))
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

/* The alternative by which symbol `index` is expanded, at the last frame; `from` is that which asks for it. */
static tn_status choose_alternative(derivation *d, uint32_t index, uint32_t from, uint32_t *chosen)
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

/* ---- derives by acts: pending acts are a stack of alternatives that were begun, each with the frame at which it began
 */

/* Does no step of an alternative that begins here go too far? */
static inline bool is_near(const derivation *d, const tn_frame *frame)
{
    uint32_t most = (uint32_t)(TN_PLACE_FAR - d->acts.reach), any = 0;
    for (int k = 0; k < 3; k++)
        any |= (uint32_t)frame->at[k] + most > 2 * most;
    return any == 0;
}

/* Begins an alternative. TN_LIMIT, without a message, where it might pass a limit on the way. */
static tn_status begin(derivation *d, uint32_t alternative, const tn_frame *frame, uint32_t depth)
{
    const tn_act_list *list = &d->acts.lists[alternative];
    begun_stack *stack = &d->begun;
    tn_place_counts *counts = &d->model->counts;
    counts->steps += list->steps;
    counts->expansions += list->expansions;
    counts->tries += list->expansions;
    if (counts->steps > d->options.step_limit || depth + list->depth > d->options.frame_limit || !is_near(d, frame))
        return TN_LIMIT;
    if (list->count == 0)
        return TN_OK;
    if (stack->count > 0 && stack->items[stack->count - 1].next == stack->items[stack->count - 1].end)
        stack->count--; /* what is done needs no room */
    if (!tn_array_reserve(&stack->items, &stack->capacity, stack->count, 1, sizeof *stack->items))
        return tn_fail_memory(d->error);
    const tn_act *first = &d->acts.acts[list->first];
    stack->items[stack->count++] = (begun){first, first + list->count, *frame, depth, alternative};
    return TN_OK;
}

/* Expands a symbol: its alternatives are looked at from the one frame that there is. */
static tn_status expand(derivation *d, const tn_act *act, const begun *of)
{
    uint32_t chosen, depth = of->depth + act->depth;
    tn_frame frame = tn_act_frame(act, &of->frame);
    d->frames.items[0] = frame;
    tn_status status = choose_alternative(d, act->symbol, of->alternative, &chosen);
    return status == TN_OK ? begin(d, chosen, &frame, depth) : status;
}

static tn_status take(derivation *d, const tn_act *act, const begun *of)
{
    if (act->kind == TN_STEP_PUSH) /* the end of an alternative */
        return TN_OK;
    if (act->kind == TN_STEP_PART) {
        const tn_frame frame = tn_act_frame(act, &of->frame);
        return take_part(d, &frame, d->rules->steps[act->step].text);
    }
    if (tn_step_is_bound(act->kind)) {
        const tn_frame frame = tn_act_frame(act, &of->frame);
        return tn_set_bound(d, &frame, &d->rules->steps[act->step]);
    }
    const tn_cell_box box = tn_cell_box_at(act->box, &of->frame);
    return take_cells(d, act->kind, &box, act->step, of->alternative);
}

/* Derives by acts from an alternative of the start on, at the only frame that there is; something is filled. TN_INVALID
 * and TN_LIMIT say only that deriving by steps will not come to a good end either. */
static tn_status derive_by_acts(derivation *d, uint32_t alternative)
{
    begun_stack *stack = &d->begun;
    uint64_t done = 0;
    tn_frame origin = d->frames.items[0];
    tn_status status = begin(d, alternative, &origin, 1);
    while (status == TN_OK && stack->count > 0) {
        begun *top = &stack->items[stack->count - 1];
        if (top->next == top->end) {
            stack->count--;
            continue;
        }
        if (++done % TN_PLACE_ASK_EVERY == 0 && (status = tn_look_up(d)) != TN_OK)
            return status;
        const tn_act *act = top->next++;
        d->idle = act->idle + (act->fresh ? 0 : d->idle);
        status = act->kind == TN_STEP_EXPAND ? expand(d, act, top) : take(d, act, top);
    }
    return status;
}

/* ---- derives a model: pending steps are a stack of places in alternatives, and each step is taken once */

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
        return take_part(d, frame, step->text);
    case TN_STEP_FILL:
    case TN_STEP_FILL_OVER:
    case TN_STEP_BLOCK:
    case TN_STEP_TOUCH: {
        tn_cell_box box = tn_frame_box(frame, step);
        return take_cells(d, step->kind, &box, index, alternative);
    }
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

static tn_status push_chosen(derivation *d, uint32_t symbol, uint32_t from)
{
    uint32_t chosen;
    tn_status status = choose_alternative(d, symbol, from, &chosen);
    return status == TN_OK ? tn_pending_push(d, &d->pending, chosen) : status;
}

static tn_status derive_by_steps(derivation *d, uint32_t first)
{
    uint32_t index, alternative;
    const tn_step *step;
    uint64_t done = 0;
    tn_status status = tn_pending_push(d, &d->pending, first);
    while (status == TN_OK && (step = tn_pending_next(d, &d->pending, &index, &alternative)) != NULL) {
        if (++done % TN_PLACE_ASK_EVERY == 0 && (status = tn_look_up(d)) != TN_OK)
            return status;
        if (step->kind == TN_STEP_EXPAND) {
            status = push_chosen(d, step->index, alternative);
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
    return status;
}

/* May the steps in between acts be left out? Not where somebody looks on, nor while a step may bound the world. */
static bool acts_do(const derivation *d)
{
    const tn_place_options *o = &d->options;
    return d->acts.known && !o->interpret && !o->report && !o->value && !o->keep_steps && !o->keep_filled &&
           !tn_world_is_empty(d);
}

/* *acted: by acts. */
static tn_status derive(derivation *d, bool *acted)
{
    uint32_t chosen;
    const tn_frame origin = {.colour = 1};
    tn_status status = tn_frame_push(d, &d->frames, &origin);
    if (status == TN_OK)
        status = choose_alternative(d, d->rules->start, 0, &chosen);
    if (status != TN_OK)
        return status;
    *acted = acts_do(d);
    status = *acted ? derive_by_acts(d, chosen) : derive_by_steps(d, chosen);
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

/* Derives once, by acts where `acts` says so and they do: then *acted is set. */
static tn_status derive_once(const tn_place_rules *rules, const tn_place_options *options, bool acts, bool *acted,
                             tn_placed_model *model, tn_place_fault *fault, tn_error *error)
{
    derivation d = {.rules = rules, .options = filled(options), .model = model, .fault = fault, .error = error};
    tn_space *space = NULL;
    *model = (tn_placed_model){0};
    *fault = (tn_place_fault){0};
    *acted = false;
    d.cells = tn_cells_new(d.options.watch);
    tn_status status = d.cells ? tn_traces_make(rules, &d.traces, error) : tn_fail_memory(error);
    if (status == TN_OK && acts)
        status = tn_acts_make(rules, &d.traces, &d.acts, error);
    if (status == TN_OK && rules->space)
        status = tn_space_new(rules, &space, error);
    if (status == TN_OK) {
        if (space)
            tn_cells_bound(d.cells, tn_space_cells(space));
        tn_mersenne_seed(&d.random, d.options.seed);
        status = derive(&d, acted);
        model->counts.parts = model->count;
        model->counts.cells = tn_cells_count(d.cells);
    }
    tn_cells_free(d.cells);
    tn_space_free(space);
    tn_traces_clear(&d.traces);
    tn_acts_clear(&d.acts);
    free(d.frames.items);
    free(d.trial.items);
    free(d.pending.items);
    free(d.begun.items);
    free(d.ahead.items);
    free(d.boxes.items);
    free(d.ahead_parts);
    return status;
}

/* Where acts do not come to a good end, steps find where exactly it went wrong. */
tn_status tn_place_derive(const tn_place_rules *rules, const tn_place_options *options, tn_placed_model *model,
                          tn_place_fault *fault, tn_error *error)
{
    bool acted;
    tn_status status = derive_once(rules, options, true, &acted, model, fault, error);
    if (!acted || (status != TN_INVALID && status != TN_LIMIT))
        return status;
    tn_placed_model_clear(model);
    return derive_once(rules, options, false, &acted, model, fault, error);
}

void tn_placed_model_clear(tn_placed_model *model)
{
    free(model->parts);
    free(model->steps);
    *model = (tn_placed_model){0};
}
