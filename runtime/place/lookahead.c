/* Looking ahead: does an alternative fit? Each symbol in it is replaced by its last alternative. */
#include "runtime/place/derivation.h"

#include "runtime/base/array.h"

/* The frame at hand of a lookahead: one of its own, or the derivation's. `kept` counts the derivation's frames that it
 * did not drop. NULL where the last was dropped. */
static tn_frame *trial_frame(derivation *d, size_t kept)
{
    if (d->trial.count > 0)
        return &d->trial.items[d->trial.count - 1];
    return kept > 0 ? &d->frames.items[kept - 1] : NULL;
}

/* One step of a lookahead on a frame of its own or of the derivation; *fits is set to false where a test fails. A frame
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
tn_status tn_look_ahead(derivation *d, uint32_t alternative, bool *fits)
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

bool tn_choose_traced(derivation *d, uint32_t index, uint32_t *chosen)
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

tn_status tn_fits_here(derivation *d, uint32_t alternative, bool *fits)
{
    const tn_trace *trace = &d->traces.traces[alternative];
    if (!trace->known || !traces_do(d))
        return tn_look_ahead(d, alternative, fits);
    *fits = trace_fits(d, trace, &d->frames.items[d->frames.count - 1]);
    return TN_OK;
}
