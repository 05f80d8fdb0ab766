/* Derives a model: pending steps are a stack of places in alternatives, and each step is taken once. */
#include "runtime/place/grow.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/place/derivation.h"
#include "runtime/place/space.h"

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
        return tn_take_part(d, frame, step->text);
    case TN_STEP_FILL:
    case TN_STEP_FILL_OVER:
    case TN_STEP_BLOCK:
    case TN_STEP_TOUCH: {
        tn_cell_box box = tn_frame_box(frame, step);
        return tn_take_cells(d, step->kind, &box, index, alternative);
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
    tn_status status = tn_choose(d, symbol, from, &chosen);
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
        status = tn_choose(d, d->rules->start, 0, &chosen);
    if (status != TN_OK)
        return status;
    *acted = acts_do(d);
    status = *acted ? tn_derive_by_acts(d, chosen) : derive_by_steps(d, chosen);
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
