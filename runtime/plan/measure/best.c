/* The best plans of a library: recursive enumeration over its automaton. */
#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"
#include "runtime/base/int128.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/measure/best.h"
#include "runtime/plan/measure/cloud.h"
#include "runtime/plan/measure/weighed_layers.h"

typedef struct tn_best_quotient tn_best_quotient;

static tn_status best_of_mixture(tn_weighed *weighed, const int64_t *times, const bool *most, tn_best **best,
                                 tn_error *error);

/* ---- the best plans by a quotient of two sums A / B, B above 0 */

typedef struct found_plan {
    tn_tray *trays;
    uint32_t length;
    int64_t values[TN_WEIGHED_MAX];
} found_plan;

struct tn_best_quotient {
    tn_weighed *weighed;
    bool most;
    bool most_of_sum[TN_WEIGHED_MAX];
    found_plan *found; /* [wanted], in order */
    size_t count, wanted, given;
    bool all; /* there are no more */
};

enum { FIRST = 16 };

static void clear_found(tn_best_quotient *best)
{
    for (size_t i = 0; i < best->count; i++)
        free(best->found[i].trays);
    free(best->found);
    best->found = NULL;
    best->count = 0;
}

static void best_quotient_free(tn_best_quotient *best)
{
    if (!best)
        return;
    clear_found(best);
    free(best);
}

/* The order of two quotients, as steps of the one sum by steps of the other: the better first. */
static int compare_quotients(const tn_best_quotient *best, const int64_t *a, const int64_t *b)
{
    tn_int128 left = (tn_int128)a[0] * b[1], right = (tn_int128)b[0] * a[1];
    int order = (left > right) - (left < right);
    return best->most ? -order : order;
}

/* The plans that are best by so many times the one sum and so many times the other: as many as are wanted. */
static tn_status find(tn_best_quotient *best, const int64_t *times, size_t wanted, tn_error *error)
{
    tn_best *mixture = NULL;
    uint32_t longest = tn_library_max(tn_weighed_library(best->weighed));
    clear_found(best);
    best->found = calloc(wanted + 1, sizeof *best->found);
    tn_status status =
        best->found ? best_of_mixture(best->weighed, times, best->most_of_sum, &mixture, error) : tn_fail_memory(error);
    for (bool more = true; status == TN_OK && more && best->count < wanted;) {
        found_plan *plan = &best->found[best->count];
        plan->trays = malloc(((size_t)longest + 1) * sizeof *plan->trays);
        if (!plan->trays) {
            status = tn_fail_memory(error);
            break;
        }
        status = tn_best_next(mixture, plan->trays, &plan->length, plan->values, &more, error);
        if (status == TN_OK && more)
            best->count++;
        else
            free(plan->trays);
    }
    tn_best_free(mixture);
    return status;
}

static int64_t divisor(int64_t a, int64_t b)
{
    while (b != 0) {
        int64_t rest = a % b;
        a = b;
        b = rest;
    }
    return llabs(a);
}

/* How many times each sum counts so that 0 is what the quotient of these values has. */
static void find_times(const tn_best_quotient *best, const int64_t *values, int64_t *times)
{
    int64_t common = divisor(values[0], values[1]), sign = best->most ? -1 : 1;
    times[0] = sign * (values[1] / common);
    times[1] = -sign * (values[0] / common);
}

/* By value, further values, length and trays: the order of ranks. */
static int compare_plans(const tn_best_quotient *best, const found_plan *a, const found_plan *b)
{
    int order = compare_quotients(best, a->values, b->values);
    for (uint32_t k = 2; order == 0 && k < tn_weighed_count(best->weighed); k++) {
        order = (a->values[k] > b->values[k]) - (a->values[k] < b->values[k]);
        order = best->most_of_sum[k] ? -order : order;
    }
    if (order == 0)
        order = (a->length > b->length) - (a->length < b->length);
    for (uint32_t i = 0; order == 0 && i < a->length; i++)
        order = (a->trays[i] > b->trays[i]) - (a->trays[i] < b->trays[i]);
    return order;
}

/* Stable and simple: all but those that are better than the last are in order already. */
static void sort(tn_best_quotient *best)
{
    for (size_t i = 1; i < best->count; i++) {
        found_plan plan = best->found[i];
        size_t at = i;
        for (; at > 0 && compare_plans(best, &plan, &best->found[at - 1]) < 0; at--)
            best->found[at] = best->found[at - 1];
        best->found[at] = plan;
    }
}

static size_t worst(const tn_best_quotient *best)
{
    size_t found = 0;
    for (size_t i = 1; i < best->count; i++)
        if (compare_quotients(best, best->found[i].values, best->found[found].values) > 0)
            found = i;
    return found;
}

/* The best, as many as are wanted. */
static tn_status refill(tn_best_quotient *best, size_t wanted, tn_error *error)
{
    int64_t reached[TN_WEIGHED_MAX], times[2] = {best->most ? -1 : 1, 0};
    for (bool first = true;; first = false) {
        tn_status status = find(best, times, wanted, error);
        if (status != TN_OK)
            return status;
        best->all = best->count < wanted;
        if (best->all)
            break;
        const int64_t *now = best->found[worst(best)].values;
        if (!first && compare_quotients(best, now, reached) == 0)
            break;
        memcpy(reached, now, sizeof reached);
        find_times(best, reached, times);
    }
    sort(best);
    best->wanted = wanted;
    return TN_OK;
}

/* No plan divides by less than 0. */
static tn_status check_divisor(tn_best_quotient *best, tn_error *error)
{
    const int64_t times[2] = {0, 1};
    tn_status status = find(best, times, 1, error);
    if (status != TN_OK || best->count == 0 || best->found[0].values[1] > 0)
        return status;
    tn_fail(error, TN_INVALID, E_QUOTIENT, "measure `%.60s` divides by a number that is below 0 for some plans",
            tn_weighed_name(best->weighed, 0));
    tn_error_help(error, "the best are found by quotients of what is above 0: `--where` can leave the other plans out");
    return TN_INVALID;
}

static tn_status best_quotient_new(tn_weighed *weighed, const bool *most, tn_best_quotient **out, tn_error *error)
{
    tn_best_quotient *best = calloc(1, sizeof *best);
    if (!best)
        return tn_fail_memory(error);
    best->weighed = weighed;
    best->most = most[0];
    for (uint32_t k = 1; k < tn_weighed_measures(weighed); k++)
        best->most_of_sum[k + 1] = most[k];
    tn_status status = check_divisor(best, error);
    if (status == TN_OK)
        *out = best;
    else
        best_quotient_free(best);
    return status;
}

static tn_status best_quotient_next(tn_best_quotient *best, tn_tray *trays, uint32_t *length, int64_t *values,
                                    bool *found, tn_error *error)
{
    if (best->given == best->wanted && !best->all) {
        tn_status status = refill(best, best->wanted ? 2 * best->wanted : FIRST, error);
        if (status != TN_OK)
            return status;
    }
    *found = best->given < best->count;
    if (!*found)
        return TN_OK;
    const found_plan *plan = &best->found[best->given++];
    memcpy(trays, plan->trays, plan->length * sizeof *trays);
    memcpy(values, plan->values, sizeof plan->values);
    *length = plan->length;
    return TN_OK;
}

#define NONE UINT32_MAX

enum { PATHS = 8 }; /* that a place has room for at first: most are asked for few */

/* A completion of a place: its tray, then the child's completion of that rank. */
typedef struct path {
    int64_t value[TN_WEIGHED_MAX]; /* with the sign that makes less better */
    tn_tray tray;
    uint32_t child; /* the place after the tray */
    uint32_t rank;
} path;

/* A state with so many trays to come. */
typedef struct place {
    uint32_t left, state;
    path *found; /* in order */
    size_t found_count, found_room;
    path *heap; /* candidates, the best first */
    size_t heap_count, heap_room;
    bool opened, pending; /* pending: the last found still has a successor to be looked for */
    bool possible;
    int64_t least[TN_WEIGHED_MAX]; /* of its completions */
} place;

struct tn_best {
    tn_weighed *weighed;
    const tn_library *library;
    tn_best_quotient *quotient; /* it goes by one; NULL: by sums */
    uint32_t count;             /* of values that are compared */
    int64_t sign[TN_WEIGHED_MAX];
    bool mixed; /* the first value is of two sums */
    int64_t times[2];
    bool overflows;
    tn_numbering numbers; /* left << 32 | state -> place */
    place *places;        /* NULL: not measured yet */
    uint32_t place_count; /* one fewer than the numbers where memory ran out */
    size_t place_room;
    size_t *given; /* [max - min + 1]: plans of each length given so far */
};

static tn_status new_of_sums(tn_weighed *weighed, const bool *most, tn_best **out, tn_error *error)
{
    tn_best *best = calloc(1, sizeof *best);
    if (!best)
        return tn_fail_memory(error);
    best->weighed = weighed;
    best->library = tn_weighed_library(weighed);
    best->count = tn_weighed_count(weighed);
    for (uint32_t k = 0; k < best->count; k++)
        best->sign[k] = most[k] ? -1 : 1;
    *out = best;
    return TN_OK;
}

static tn_status refuse_later(tn_error *error)
{
    tn_fail(error, TN_INVALID, E_QUOTIENT, "a quotient can only be the first measure to go by");
    tn_error_help(error, "name it first, or ask for the front of both measures");
    return TN_INVALID;
}

tn_status tn_best_new(tn_weighed *weighed, const bool *most, tn_best **out, tn_error *error)
{
    bool first = false, over;
    tn_weighed_sum(weighed, 0, &first);
    for (uint32_t k = 1; k < tn_weighed_measures(weighed); k++) {
        tn_weighed_sum(weighed, k, &over);
        if (over)
            return refuse_later(error);
    }
    if (!first)
        return new_of_sums(weighed, most, out, error);
    tn_best *best = calloc(1, sizeof *best);
    tn_status status = best ? best_quotient_new(weighed, most, &best->quotient, error) : tn_fail_memory(error);
    if (status == TN_OK)
        *out = best;
    else
        free(best);
    return status;
}

/* By the first two sums as one, each so many times, as small as can be; then by the other sums. E0424 (TN_LIMIT) where
 * that passes 64 bits. most: of the sums behind them, from index 2 on. */
static tn_status best_of_mixture(tn_weighed *weighed, const int64_t *times, const bool *most, tn_best **out,
                                 tn_error *error)
{
    tn_status status = new_of_sums(weighed, most, out, error);
    if (status != TN_OK)
        return status;
    tn_best *best = *out;
    best->mixed = true;
    memcpy(best->times, times, sizeof best->times);
    best->count--;
    for (uint32_t k = 1; k < best->count; k++)
        best->sign[k] = best->sign[k + 1];
    return TN_OK;
}

void tn_best_free(tn_best *best)
{
    if (!best)
        return;
    best_quotient_free(best->quotient);
    for (uint32_t i = 0; i < best->place_count; i++) {
        free(best->places[i].found);
        free(best->places[i].heap);
    }
    free(best->places);
    free(best->given);
    tn_numbering_clear(&best->numbers);
    free(best);
}

/* ---- order */

static int compare_values(const int64_t *a, const int64_t *b)
{
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        if (a[k] != b[k])
            return a[k] < b[k] ? -1 : 1;
    return 0;
}

/* By value, then tray, then the child's order: that is the order of ranks. */
static bool before(const path *a, const path *b)
{
    int values = compare_values(a->value, b->value);
    if (values != 0)
        return values < 0;
    return a->tray != b->tray ? a->tray < b->tray : a->rank < b->rank;
}

static bool push(place *p, path added)
{
    if (!tn_array_reserve_from(&p->heap, &p->heap_room, PATHS, p->heap_count, 1, sizeof *p->heap))
        return false;
    size_t i = p->heap_count++;
    for (; i > 0 && before(&added, &p->heap[(i - 1) / 2]); i = (i - 1) / 2)
        p->heap[i] = p->heap[(i - 1) / 2];
    p->heap[i] = added;
    return true;
}

static path pop(place *p)
{
    path top = p->heap[0], last = p->heap[--p->heap_count];
    size_t i = 0;
    for (size_t child; (child = 2 * i + 1) < p->heap_count; i = child) {
        if (child + 1 < p->heap_count && before(&p->heap[child + 1], &p->heap[child]))
            child++;
        if (!before(&p->heap[child], &last))
            break;
        p->heap[i] = p->heap[child];
    }
    if (p->heap_count > 0)
        p->heap[i] = last;
    return top;
}

/* ---- places */

static tn_status place_of(tn_best *best, uint32_t left, uint32_t state, uint32_t *index, tn_error *error)
{
    uint32_t before_count = best->numbers.count;
    *index = tn_number(&best->numbers, (uint64_t)left << 32 | state);
    if (*index == NONE)
        return tn_fail_memory(error);
    if (*index < before_count)
        return TN_OK;
    if (!tn_array_reserve_from(&best->places, &best->place_room, 256, *index, 1, sizeof *best->places))
        return tn_fail_memory(error);
    best->places[*index] = (place){.left = left, .state = state};
    best->place_count = *index + 1;
    return TN_OK;
}

/* The first value: so many times the one sum and so many times the other. */
static void add_mixture(tn_best *best, int64_t *value, const int64_t *gain)
{
    int64_t one, other;
    best->overflows |= __builtin_mul_overflow(best->times[0], gain[0], &one) ||
                       __builtin_mul_overflow(best->times[1], gain[1], &other) ||
                       __builtin_add_overflow(one, other, &one) || __builtin_add_overflow(value[0], one, &value[0]);
    for (uint32_t k = 1; k < best->count; k++)
        value[k] += best->sign[k] * gain[k + 1];
}

static void add_gain(tn_best *best, int64_t *value, const int64_t *gain)
{
    if (best->mixed) {
        add_mixture(best, value, gain);
        return;
    }
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        value[k] += best->sign[k] * gain[k];
}

static void set_rest(tn_best *best, uint32_t state, int64_t *value)
{
    int64_t rest[TN_WEIGHED_MAX] = {0};
    for (uint32_t k = 0; k < tn_weighed_count(best->weighed); k++)
        rest[k] = tn_weighed_rest(best->weighed, state, k);
    memset(value, 0, TN_WEIGHED_MAX * sizeof *value);
    add_gain(best, value, rest);
}

/* ---- the least of all completions of each state, from the end of the plans backwards */

typedef struct least_value {
    bool possible;
    int64_t value[TN_WEIGHED_MAX];
} least_value;

static void least_init(const void *context, void *element)
{
    (void)context;
    *(least_value *)element = (least_value){0};
}

static tn_status end(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    tn_best *best = context;
    least_value *made = element;
    (void)error;
    if (layer < best->library->max)
        return TN_OK;
    made->possible = tn_weighed_ends(best->weighed, state);
    set_rest(best, state, made->value);
    return TN_OK;
}

static tn_status extend(void *context, void *sum, const void *element, const tn_walk_edge *edge, tn_error *error)
{
    const least_value *from = element;
    const tn_weighed_edge *label = edge->label;
    least_value *made = sum;
    int64_t value[TN_WEIGHED_MAX];
    (void)error;
    if (!from->possible)
        return TN_OK;
    memcpy(value, from->value, sizeof value);
    add_gain(context, value, label->gain);
    if (!made->possible || compare_values(value, made->value) < 0)
        memcpy(made->value, value, sizeof value);
    made->possible = true;
    return TN_OK;
}

TN_WALK_ALGEBRA(least_algebra, least_init, NULL, end, extend, NULL);

/* The places of a layer. */
static tn_status keep_layer(tn_best *best, const tn_layers *walk, uint32_t layer, tn_error *error)
{
    const tn_walk_layer *nodes = tn_walk_at(walk, layer);
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < nodes->count; i++) {
        const least_value *found = tn_walk_backward_of(walk, layer, i);
        uint32_t index;
        status = place_of(best, best->library->max - layer, nodes->states[i], &index, error);
        if (status != TN_OK)
            break;
        best->places[index].possible = found->possible;
        memcpy(best->places[index].least, found->value, sizeof found->value);
    }
    return status;
}

static tn_status measure(tn_best *best, tn_error *error)
{
    tn_weighed *w = best->weighed;
    tn_layers walk = {0};
    tn_status status = tn_walk_begin(&walk, tn_weighed_last_layer(w), true, error);
    if (status == TN_OK)
        status = tn_walk_forward(&walk, &tn_weighed_to_come, w, NULL, NULL, 0, error);
    if (status == TN_OK)
        status = tn_walk_backward(&walk, &tn_weighed_to_come, w, &least_algebra, best, sizeof(least_value), error);
    for (uint32_t layer = 0; status == TN_OK && layer <= walk.last; layer++)
        status = keep_layer(best, &walk, layer, error);
    tn_walk_clear(&walk, NULL, &least_algebra);
    return status;
}

/* ---- the next completions */

static tn_status ensure(tn_best *best, uint32_t index, size_t rank, bool *there, tn_error *error);

/* The first tray of each letter as a candidate, with its best completion. Others of the letter follow it (succeed). */
static tn_status open_place(tn_best *best, uint32_t index, tn_error *error)
{
    uint32_t left = best->places[index].left, state = best->places[index].state;
    uint32_t letters = tn_weighed_letters(best->weighed);
    tn_status status = TN_OK;
    for (uint32_t l = 0; status == TN_OK && l < letters; l++) {
        uint32_t target, child;
        int64_t gain[TN_WEIGHED_MAX];
        path first = {.tray = tn_weighed_first_tray(best->weighed, l)};
        status = tn_weighed_step(best->weighed, state, l, &target, gain, error);
        if (status != TN_OK || target == NONE || !tn_weighed_alive(best->weighed, left - 1, target))
            continue;
        status = place_of(best, left - 1, target, &child, error);
        if (status != TN_OK || !best->places[child].possible)
            continue;
        first.child = child;
        memcpy(first.value, best->places[child].least, sizeof first.value);
        add_gain(best, first.value, gain);
        if (!push(&best->places[index], first))
            status = tn_fail_memory(error);
    }
    best->places[index].opened = true;
    return status;
}

/* Puts the successors of the last path found among the candidates: the next tray of its letter, which has the same
 * completions; and the same tray with the child's next completion. What the tray adds is what the path has over its
 * child. */
static tn_status succeed(tn_best *best, uint32_t index, tn_error *error)
{
    place *p = &best->places[index];
    path next = p->found[p->found_count - 1];
    bool there;
    p->pending = false;
    path beside = next;
    beside.tray = next.rank == 0 ? tn_weighed_next_tray(best->weighed, next.tray) : best->library->schema->tray_count;
    if (beside.tray < best->library->schema->tray_count && !push(p, beside))
        return tn_fail_memory(error);
    next.rank++;
    tn_status status = ensure(best, next.child, next.rank, &there, error);
    if (status != TN_OK || !there)
        return status;
    const path *of_child = &best->places[next.child].found[next.rank];
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        next.value[k] += of_child[0].value[k] - of_child[-1].value[k];
    return push(&best->places[index], next) ? TN_OK : tn_fail_memory(error);
}

/* Finds the completions of a place up to the given rank; *there: is there one? */
static tn_status ensure(tn_best *best, uint32_t index, size_t rank, bool *there, tn_error *error)
{
    tn_status status = TN_OK;
    place *p = &best->places[index];
    if (p->left == 0 && p->found_count == 0) {
        path end = {.child = NONE};
        set_rest(best, p->state, end.value);
        if (!tn_array_reserve_from(&p->found, &p->found_room, PATHS, 0, 1, sizeof *p->found))
            return tn_fail_memory(error);
        p->found[p->found_count++] = end;
        p->opened = true;
    }
    while (status == TN_OK && best->places[index].found_count <= rank) {
        if (!best->places[index].opened)
            status = open_place(best, index, error);
        if (status == TN_OK && best->places[index].pending)
            status = succeed(best, index, error);
        p = &best->places[index];
        if (status != TN_OK || p->heap_count == 0)
            break;
        if (!tn_array_reserve_from(&p->found, &p->found_room, PATHS, p->found_count, 1, sizeof *p->found))
            return tn_fail_memory(error);
        p->found[p->found_count] = pop(p);
        p->found_count++;
        p->pending = true;
    }
    *there = best->places[index].found_count > rank;
    return status;
}

/* ---- the root: every length's first state */

static tn_status too_fine(tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_FINE, "the sums of a quotient have more digits than it is compared with");
    tn_error_help(error, "use rounder numbers: prices in steps of 10 or 50, lengths in whole units");
    return TN_LIMIT;
}

typedef struct cursor {
    uint32_t left;
    size_t rank;
} cursor;

/* The best not given yet over all lengths: each length's list is walked on its own. */
static tn_status next_length(tn_best *best, const size_t *given, cursor *next, bool *found, tn_error *error)
{
    path least = {0};
    *found = false;
    for (uint32_t n = best->library->min; n <= best->library->max; n++) {
        uint32_t index;
        bool there = false;
        if (!tn_weighed_alive(best->weighed, n, 0))
            continue;
        tn_status status = place_of(best, n, 0, &index, error);
        if (status == TN_OK && best->places[index].possible)
            status = ensure(best, index, given[n - best->library->min], &there, error);
        if (status != TN_OK)
            return status;
        if (!there)
            continue;
        const path *p = &best->places[index].found[given[n - best->library->min]];
        if (*found && compare_values(p->value, least.value) >= 0)
            continue;
        least = *p;
        *found = true;
        *next = (cursor){n, given[n - best->library->min]};
    }
    return TN_OK;
}

/* The trays of a place's completion of the given rank, which is there. */
static tn_status follow(tn_best *best, uint32_t index, size_t rank, tn_tray *trays, tn_error *error)
{
    tn_status status = TN_OK;
    bool there;
    for (uint32_t left = best->places[index].left; status == TN_OK && left > 0; left--) {
        status = ensure(best, index, rank, &there, error);
        if (status != TN_OK)
            break;
        const path *p = &best->places[index].found[rank];
        *trays++ = p->tray;
        index = p->child;
        rank = p->rank;
    }
    return status;
}

tn_status tn_best_next(tn_best *best, tn_tray *trays, uint32_t *length, int64_t *values, bool *found, tn_error *error)
{
    *found = false;
    if (best->quotient)
        return best_quotient_next(best->quotient, trays, length, values, found, error);
    if (best->library->min > best->library->max)
        return TN_OK;
    if (!best->given &&
        !(best->given = calloc((size_t)best->library->max - best->library->min + 1, sizeof *best->given)))
        return tn_fail_memory(error);
    cursor next = {0};
    tn_status status = best->places ? TN_OK : measure(best, error);
    if (status == TN_OK)
        status = next_length(best, best->given, &next, found, error);
    if (status != TN_OK || !*found)
        return status;
    best->given[next.left - best->library->min]++;
    uint32_t index;
    bool valued;
    status = place_of(best, next.left, 0, &index, error);
    for (uint32_t k = 0; status == TN_OK && !best->mixed && k < best->count; k++)
        values[k] = best->sign[k] * best->places[index].found[next.rank].value[k] + tn_weighed_start(best->weighed, k);
    *length = next.left;
    if (status == TN_OK)
        status = follow(best, index, next.rank, trays, error);
    if (status == TN_OK && best->overflows)
        status = too_fine(error);
    return status == TN_OK && best->mixed ? tn_weighed_plan(best->weighed, trays, *length, values, &valued, error)
                                          : status;
}
