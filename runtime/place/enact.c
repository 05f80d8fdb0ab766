/* Derives by acts: pending acts are a stack of alternatives that were begun, each with the frame at which it began. */
#include "runtime/base/array.h"
#include "runtime/place/derivation.h"

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
    tn_status status = tn_choose(d, act->symbol, of->alternative, &chosen);
    return status == TN_OK ? begin(d, chosen, &frame, depth) : status;
}

static tn_status take(derivation *d, const tn_act *act, const begun *of)
{
    if (act->kind == TN_STEP_PUSH) /* the end of an alternative */
        return TN_OK;
    if (act->kind == TN_STEP_PART) {
        const tn_frame frame = tn_act_frame(act, &of->frame);
        return tn_take_part(d, &frame, d->rules->steps[act->step].text);
    }
    if (tn_step_is_bound(act->kind)) {
        const tn_frame frame = tn_act_frame(act, &of->frame);
        return tn_set_bound(d, &frame, &d->rules->steps[act->step]);
    }
    const tn_cell_box box = tn_cell_box_at(act->box, &of->frame);
    return tn_take_cells(d, act->kind, &box, act->step, of->alternative);
}

tn_status tn_derive_by_acts(derivation *d, uint32_t alternative)
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
