/* What looking ahead and taking steps share: pending steps, frames, bounds, and what is in the way. */
#include "runtime/place/derivation.h"

#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/place/cells.h"

/* ==== MT19937, from the definition in Matsumoto and Nishimura, "Mersenne Twister" (1998) */

enum { SIZE = 624, MIDDLE = 397 };

void tn_mersenne_seed(tn_mersenne *generator, uint32_t seed)
{
    uint32_t *s = generator->state;
    s[0] = seed;
    for (uint32_t i = 1; i < SIZE; i++)
        s[i] = 1812433253u * (s[i - 1] ^ s[i - 1] >> 30) + i;
    generator->next = SIZE;
}

static void twist(tn_mersenne *generator)
{
    uint32_t *s = generator->state;
    for (uint32_t i = 0; i < SIZE; i++) {
        uint32_t y = (s[i] & 0x80000000u) | (s[(i + 1) % SIZE] & 0x7fffffffu);
        s[i] = s[(i + MIDDLE) % SIZE] ^ y >> 1 ^ (y & 1 ? 0x9908b0dfu : 0);
    }
    generator->next = 0;
}

static uint32_t draw_word(tn_mersenne *generator)
{
    if (generator->next == SIZE)
        twist(generator);
    uint32_t y = generator->state[generator->next++];
    y ^= y >> 11;
    y ^= y << 7 & 0x9d2c5680u;
    y ^= y << 15 & 0xefc60000u;
    return y ^ y >> 18;
}

double tn_mersenne_draw(tn_mersenne *generator)
{
    uint32_t a = draw_word(generator) >> 5, b = draw_word(generator) >> 6;
    return (a * 67108864.0 + b) / 9007199254740992.0;
}

enum { DEFAULT_RADIUS = 8 };

tn_status tn_pending_push(derivation *d, cursor_stack *stack, uint32_t alternative)
{
    const tn_place_alternative *a = &d->rules->alternatives[alternative];
    while (stack->count > 0 && stack->items[stack->count - 1].next == stack->items[stack->count - 1].end)
        stack->count--; /* what is done needs no room: a symbol at an alternative's end is expanded in place */
    if (!tn_array_reserve(&stack->items, &stack->capacity, stack->count, 1, sizeof *stack->items))
        return tn_fail_memory(d->error);
    stack->items[stack->count++] = (cursor){a->first, a->first + a->count, alternative};
    return TN_OK;
}

const tn_step *tn_pending_next(const derivation *d, cursor_stack *stack, uint32_t *index, uint32_t *alternative)
{
    while (stack->count > 0) {
        cursor *top = &stack->items[stack->count - 1];
        if (top->next == top->end) {
            stack->count--;
            continue;
        }
        *alternative = top->alternative;
        *index = top->next++;
        return &d->rules->steps[*index];
    }
    return NULL;
}

tn_status tn_look_up(const derivation *d)
{
    tn_watch_tell(d->options.watch, (double)d->model->count, 0);
    return tn_watch_check(d->options.watch, d->error);
}

tn_status tn_past_limit(derivation *d, const char *what, uint64_t limit, const char *option)
{
    tn_fail(d->error, TN_LIMIT, E_PLACE_LIMIT, "the derivation passes the limit of %llu %s", (unsigned long long)limit,
            what);
    tn_error_help(d->error, "raise the limit with --%s, or change the grammar so that it comes to an end", option);
    return TN_LIMIT;
}

/* ---- what does not end */

/* The steps of a symbol's alternatives, or of its last one: they lie one after the other. */
static cursor steps_of(const tn_place_rules *rules, uint32_t symbol, bool last)
{
    const tn_place_symbol *s = &rules->symbols[symbol];
    const tn_place_alternative *to = &rules->alternatives[s->first + s->count - 1];
    const tn_place_alternative *from = last ? to : &rules->alternatives[s->first];
    return (cursor){from->first, to->first + to->count, symbol};
}

/* Adds "A, B and back to A" of a path of symbols. */
static void write_cycle(const tn_place_rules *rules, const cursor *path, size_t first, size_t count, char *text,
                        size_t size)
{
    size_t used = 0;
    for (size_t i = first; i < count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%.60s", i > first ? " leads to " : "",
                                 rules->symbols[path[i].alternative].name);
    if (used < size)
        snprintf(text + used, size - used, " leads to %.60s", rules->symbols[path[first].alternative].name);
}

/* Depth first from a symbol: the first path that comes back to one of its own symbols. `path` has room for all symbols,
 * `seen` says 0 not yet, 1 on the path, 2 done. */
static bool find_cycle(const tn_place_rules *rules, uint32_t symbol, bool last, cursor *path, uint8_t *seen, char *text,
                       size_t size)
{
    size_t count = 0;
    path[count++] = steps_of(rules, symbol, last);
    seen[symbol] = 1;
    while (count > 0) {
        cursor *top = &path[count - 1];
        if (top->next == top->end) {
            seen[top->alternative] = 2;
            count--;
            continue;
        }
        const tn_step *step = &rules->steps[top->next++];
        if (step->kind != TN_STEP_EXPAND || seen[step->index] == 2)
            continue;
        if (seen[step->index] == 1) {
            size_t first = 0;
            while (path[first].alternative != step->index)
                first++;
            write_cycle(rules, path, first, count, text, size);
            return true;
        }
        seen[step->index] = 1;
        path[count++] = steps_of(rules, step->index, last);
    }
    return false;
}

tn_status tn_no_end(derivation *d, uint32_t alternative, bool lookahead)
{
    const tn_place_rules *rules = d->rules;
    const tn_place_alternative *tried = &rules->alternatives[alternative];
    char text[240] = "";
    cursor *path = calloc(rules->symbol_count, sizeof *path);
    uint8_t *seen = calloc(rules->symbol_count, sizeof *seen);
    bool found = !path || !seen;
    for (uint32_t i = 0; i < tried->count && !found; i++) {
        const tn_step *step = &rules->steps[tried->first + i];
        found = step->kind == TN_STEP_EXPAND && seen[step->index] == 0 &&
                find_cycle(rules, step->index, lookahead, path, seen, text, sizeof text);
    }
    free(path);
    free(seen);
    d->fault->alternative = alternative;
    tn_fail(d->error, TN_LIMIT, E_PLACE_LIMIT, "%s passes the limit of %llu steps%s%s",
            lookahead ? "a lookahead" : "expanding without taking a step",
            (unsigned long long)d->options.lookahead_limit, *text ? ": " : "", text);
    tn_error_help(d->error,
                  lookahead
                      ? "a lookahead puts the last alternative for each symbol: give one of these a last "
                        "alternative that is empty; or raise the limit with --lookahead-limit"
                      : "change the grammar so that it comes to an end, or raise the limit with --lookahead-limit");
    return TN_LIMIT;
}

/* ---- frames */

tn_status tn_frame_push(derivation *d, frame_stack *stack, const tn_frame *frame)
{
    tn_frame copy = *frame; /* the array may move */
    if (stack->count == d->options.frame_limit)
        return tn_past_limit(d, "frames", d->options.frame_limit, "frame-limit");
    if (!tn_array_reserve(&stack->items, &stack->capacity, stack->count, 1, sizeof *stack->items))
        return tn_fail_memory(d->error);
    stack->items[stack->count++] = copy;
    return TN_OK;
}

tn_status tn_no_frame(derivation *d, uint32_t step, uint32_t alternative)
{
    *d->fault = (tn_place_fault){.has_step = true, .step = step, .alternative = alternative};
    return tn_fail(d->error, TN_INVALID, E_PLACE_FRAME, "there is no frame left: a `)` has removed the last one");
}

tn_status tn_too_far(derivation *d, uint32_t step, uint32_t alternative)
{
    *d->fault = (tn_place_fault){.has_step = true, .step = step, .alternative = alternative};
    return tn_fail(d->error, TN_LIMIT, E_PLACE_LIMIT, "the head goes farther than %d cells from the origin",
                   TN_PLACE_FAR);
}

/* ---- cells */

/* After every step a world without a filled cell gets a shell, as in the published program. */
tn_status tn_bound_empty_world(derivation *d)
{
    return !tn_world_is_empty(d) ? TN_OK : tn_bound_ball(d->cells, DEFAULT_RADIUS, d->error);
}

tn_status tn_set_bound(derivation *d, const tn_frame *frame, const tn_step *step)
{
    d->model->counts.bounds++;
    return step->kind == TN_STEP_BOUND_BOX ? tn_bound_box(d->cells, frame, step, d->error)
                                           : tn_bound_ball(d->cells, step->a[0], d->error);
}

tn_place_obstacle tn_obstacle_find(derivation *d, const tn_cell_box *box)
{
    tn_place_obstacle obstacle = {.known = true};
    if (!tn_cells_first(d->cells, box, obstacle.cell))
        return (tn_place_obstacle){0};
    for (size_t i = 0; i < d->boxes.count && !obstacle.has_step; i++) {
        const filled_box *filled = &d->boxes.items[i];
        if (!tn_cell_box_holds(&filled->box, obstacle.cell))
            continue;
        obstacle.has_step = true;
        obstacle.step = filled->step;
        obstacle.parts = filled->parts;
    }
    return obstacle;
}
