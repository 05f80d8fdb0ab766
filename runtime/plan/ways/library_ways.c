/* Counts derivations along the automaton of the kept plans. */
#include "runtime/plan/ways/library_ways.h"

#include <stdlib.h>

#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"
#include "runtime/plan/library/alone.h"
#include "runtime/plan/ways/plan_ways.h"
#include "runtime/plan/ways/rests.h"

/* A place in a layer: a state of the library's automaton with what is to come. */
typedef struct place {
    uint32_t state, ahead;
    uint32_t rests;          /* a rest, or the number of a set of these */
    uint32_t parent, letter; /* how the first plan comes here */
    mpz_t count;
} place;

typedef struct layer {
    tn_numbering numbers; /* of state << 32 | what is to come */
    place *places;
    size_t room;
} layer;

typedef struct walk {
    const tn_library *library;
    const tn_classes *classes;
    uint32_t least, most; /* trays */
    tn_rests *rests;
    tn_projected *projected; /* or NULL */
    tn_interner pairs;       /* ahead, rest */
    tn_interner sets;        /* ahead, then each rest with its number of ways */
    uint64_t steps;
    uint32_t nodes, max_nodes;
    bool too_much;
    layer *layers; /* [most + 1] */
    tn_derived_ways *found;
} walk;

uint32_t tn_library_generator(const tn_library *library)
{
    const tn_module *module = tn_library_schema(library)->module;
    const tn_library_record *record = tn_library_record_of(library);
    for (uint32_t i = 0; record && i < record->clause_count; i++) {
        uint32_t kind = module->CLAUSE_records[record->clause_first + i].kind;
        if (kind == TN_CLAUSE_GENERATE || kind == TN_CLAUSE_ONTO)
            return i;
    }
    return UINT32_MAX;
}

/* ---- what both walks share */

/* After so many trays, does a plan of the library go on with `needed` more at least? */
static bool goes_on(const walk *w, uint32_t trays, uint32_t state, uint32_t needed)
{
    uint32_t left = w->least > trays && w->least - trays > needed ? w->least - trays : needed;
    for (; trays + left <= w->most; left++)
        if (tn_library_lives(w->library, left, state))
            return true;
    return false;
}

static bool may_end(const walk *w, uint32_t trays, uint32_t state)
{
    return trays >= w->least && tn_library_lives(w->library, 0, state);
}

/* The place of a layer, new or old; `next` says where, and how one comes to it. */
static tn_status meet(layer *at, const place *next, uint32_t number, const mpz_t times, tn_error *error)
{
    uint32_t before = at->numbers.count;
    if (!tn_array_reserve(&at->places, &at->room, before, 1, sizeof *at->places))
        return tn_fail_memory(error);
    uint32_t index = tn_number(&at->numbers, (uint64_t)next->state << 32 | number);
    if (index == UINT32_MAX)
        return tn_fail_memory(error);
    place *to = &at->places[index];
    if (index == before) {
        *to = *next;
        mpz_init(to->count);
    }
    mpz_add(to->count, to->count, times);
    return TN_OK;
}

static void clear_layer(layer *at)
{
    for (uint32_t i = 0; i < at->numbers.count; i++)
        mpz_clear(at->places[i].count);
    free(at->places);
    tn_numbering_clear(&at->numbers);
    *at = (layer){0};
}

/* What follows a place by a letter. */
typedef tn_status read_place(walk *w, uint32_t trays, const place *from, place *next, tn_error *error);

static tn_status read_layer(walk *w, uint32_t trays, uint32_t index, read_place *read, tn_error *error)
{
    const place from = w->layers[trays].places[index];
    tn_status status = tn_watch_check(tn_library_schema(w->library)->module->watch, error);
    for (uint32_t l = 0; status == TN_OK && !w->too_much && l < w->classes->count; l++) {
        place next = {.parent = index, .letter = l};
        next.state = tn_library_next(w->library, from.state, w->classes->representative[l]);
        if (!goes_on(w, trays + 1, next.state, 0))
            continue;
        status = tn_rests_ahead(w->rests, from.ahead, l, &next.ahead, error);
        if (status == TN_OK)
            status = read(w, trays, &from, &next, error);
    }
    return status;
}

/* ---- the sum alone: a place has one rest, and its count is of all plans with all derivations that lead to it */

static tn_status meet_rest(walk *w, uint32_t trays, place *next, const mpz_t times, tn_error *error)
{
    const uint32_t words[] = {next->ahead, next->rests};
    uint32_t number = tn_intern(&w->pairs, words, 2);
    layer *at = &w->layers[trays];
    if (number == UINT32_MAX)
        return tn_fail_memory(error);
    if (at->numbers.count < TN_WAYS_PLACES)
        return meet(at, next, number, times, error);
    tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES, "counting the ways of plans of %u trays passes the limit of %u places",
            trays, TN_WAYS_PLACES);
    tn_error_help(error, "give fewer trays with --trays");
    return TN_LIMIT;
}

static tn_status read_sum(walk *w, uint32_t trays, const place *from, place *next, tn_error *error)
{
    const tn_rest_list *list;
    tn_status status = tn_rests_read(w->rests, from->rests, next->letter, next->ahead, &list, error);
    mpz_t times;
    mpz_init(times);
    for (uint32_t i = 0; status == TN_OK && i < list->count; i++) {
        next->rests = list->rests[i];
        if (!goes_on(w, trays + 1, next->state, tn_rests_least(w->rests, next->rests)))
            continue;
        mpz_mul(times, from->count, list->ways[i]);
        mpz_mul_ui(times, times, w->classes->size[next->letter]);
        status = meet_rest(w, trays + 1, next, times, error);
    }
    mpz_clear(times);
    return status;
}

static tn_status sum_ways(walk *w, tn_error *error)
{
    const tn_rest_list *begin;
    tn_status status = tn_rests_begin(w->rests, &begin, error);
    for (uint32_t i = 0; status == TN_OK && i < begin->count; i++) {
        place next = {.ahead = TN_AHEAD_START, .rests = begin->rests[i]};
        status = meet_rest(w, 0, &next, begin->ways[i], error);
    }
    for (uint32_t trays = 0; status == TN_OK && trays <= w->most; trays++) {
        const layer *at = &w->layers[trays];
        for (uint32_t i = 0; trays > 0 && i < at->numbers.count; i++)
            if (may_end(w, trays, at->places[i].state) && tn_rests_end(w->rests, at->places[i].rests))
                mpz_add(w->found->ways, w->found->ways, at->places[i].count);
        for (uint32_t i = 0; status == TN_OK && trays < w->most && i < at->numbers.count; i++)
            status = read_layer(w, trays, i, read_sum, error);
        clear_layer(&w->layers[trays]);
    }
    return status;
}

/* ---- plans told apart: a place has a set of rests, each with its number of ways, and its count is of plans */

/* Limbs as words. */
static bool push_number(tn_key *key, const mpz_t number)
{
    enum { HALVES = sizeof(mp_limb_t) / sizeof(uint32_t) };
    size_t limbs = mpz_size(number);
    bool ok = tn_key_push(key, (uint32_t)limbs);
    for (size_t i = 0; ok && i < limbs; i++) {
        mp_limb_t limb = mpz_getlimbn(number, (mp_size_t)i);
        for (unsigned k = 0; ok && k < HALVES; k++)
            ok = tn_key_push(key, (uint32_t)((uint64_t)limb >> (32 * k)));
    }
    return ok;
}

/* Reads a number of ways back; returns the words that it takes. */
static size_t read_number(const uint32_t *words, mpz_t number)
{
    size_t count = words[0] * (sizeof(mp_limb_t) / sizeof(uint32_t));
    mpz_import(number, count, -1, sizeof(uint32_t), 0, 0, words + 1);
    return count + 1;
}

static tn_status number_set(walk *w, uint32_t ahead, const tn_rest_list *list, uint32_t *number, tn_error *error)
{
    tn_key key = {0};
    bool ok = tn_key_push(&key, ahead);
    for (uint32_t i = 0; ok && i < list->count; i++)
        ok = tn_key_push(&key, list->rests[i]) && push_number(&key, list->ways[i]);
    *number = ok ? tn_intern(&w->sets, key.data, key.size) : UINT32_MAX;
    free(key.data);
    return *number == UINT32_MAX ? tn_fail_memory(error) : TN_OK;
}

/* Meets the place of a set. */
static tn_status meet_set(walk *w, uint32_t trays, place *next, const tn_rest_list *list, const mpz_t plans,
                          tn_error *error)
{
    layer *at = &w->layers[trays];
    uint32_t before = at->numbers.count;
    if (list->count == 0)
        return TN_OK;
    tn_status status = number_set(w, next->ahead, list, &next->rests, error);
    if (status == TN_OK)
        status = meet(at, next, next->rests, plans, error);
    w->nodes += at->numbers.count - before;
    w->too_much = w->nodes > w->max_nodes || w->steps > TN_WAYS_STEPS;
    return status;
}

/* Adds what one rest of a set becomes. */
static tn_status read_rest(walk *w, uint32_t trays, uint32_t rest, const mpz_t ways, const place *next,
                           tn_rest_list *to, tn_error *error)
{
    const tn_rest_list *list;
    tn_status status = tn_rests_read(w->rests, rest, next->letter, next->ahead, &list, error);
    mpz_t all;
    mpz_init(all);
    for (uint32_t i = 0; status == TN_OK && i < list->count; i++) {
        w->steps++;
        if (tn_rests_least(w->rests, list->rests[i]) + trays + 1 > w->most)
            continue;
        mpz_mul(all, ways, list->ways[i]);
        status = tn_rest_list_add(to, list->rests[i], all, error);
    }
    mpz_clear(all);
    return status;
}

static tn_status read_set(walk *w, uint32_t trays, const place *from, place *next, tn_error *error)
{
    tn_rest_list to = {0};
    size_t size;
    tn_interned(&w->sets, from->rests, &size);
    tn_status status = TN_OK;
    mpz_t number;
    mpz_init(number);
    for (size_t i = 1; status == TN_OK && i < size;) {
        const uint32_t *words = tn_interned(&w->sets, from->rests, &size);
        uint32_t rest = words[i];
        i += 1 + read_number(words + i + 1, number);
        status = read_rest(w, trays, rest, number, next, &to, error);
    }
    mpz_mul_ui(number, from->count, w->classes->size[next->letter]);
    if (status == TN_OK)
        status = meet_set(w, trays + 1, next, &to, number, error);
    mpz_clear(number);
    tn_rest_list_clear(&to);
    return status;
}

/* In how many ways a plan that ends in the place is derived. */
static void ways_of(const walk *w, const place *at, mpz_t ways)
{
    size_t size;
    const uint32_t *words = tn_interned(&w->sets, at->rests, &size);
    mpz_t one;
    mpz_init(one);
    mpz_set_ui(ways, 0);
    for (size_t i = 1; i < size;) {
        uint32_t rest = words[i];
        i += 1 + read_number(words + i + 1, one);
        if (tn_rests_end(w->rests, rest))
            mpz_add(ways, ways, one);
    }
    mpz_clear(one);
}

static tn_status add_row(tn_derived_ways *found, const mpz_t ways, const mpz_t plans, tn_error *error)
{
    size_t low = 0, high = found->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (mpz_cmp(found->rows[middle].ways, ways) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    if (low < found->count && mpz_cmp(found->rows[low].ways, ways) == 0) {
        mpz_add(found->rows[low].plans, found->rows[low].plans, plans);
        return TN_OK;
    }
    if (found->count >= TN_WAYS_ROWS) {
        found->has_rows = false;
        return TN_OK;
    }
    if (!tn_array_reserve(&found->rows, &found->room, found->count, 1, sizeof *found->rows))
        return tn_fail_memory(error);
    for (size_t i = found->count++; i > low; i--)
        found->rows[i] = found->rows[i - 1];
    mpz_init_set(found->rows[low].ways, ways);
    mpz_init_set(found->rows[low].plans, plans);
    return TN_OK;
}

/* The plan by which a place was met first. */
static tn_status keep_first(walk *w, uint32_t trays, uint32_t index, tn_error *error)
{
    tn_tray *first = malloc(((size_t)trays + 1) * sizeof *first);
    if (!first)
        return tn_fail_memory(error);
    for (uint32_t t = trays; t > 0; t--) {
        const place *at = &w->layers[t].places[index];
        first[t - 1] = w->classes->representative[at->letter];
        index = at->parent;
    }
    free(w->found->first);
    w->found->first = first;
    w->found->length = trays;
    return TN_OK;
}

/* So many plans are derived in so many ways; in rank order of the first of them. */
static tn_status add_plans(walk *w, const mpz_t ways, const mpz_t plans, uint32_t trays, uint32_t index,
                           tn_error *error)
{
    tn_derived_ways *found = w->found;
    if (mpz_sgn(ways) == 0) /* what the library keeps is derived, so that nothing of this is kept */
        return TN_OK;
    mpz_addmul(found->ways, ways, plans);
    tn_status status = found->has_rows ? add_row(found, ways, plans, error) : TN_OK;
    if (status != TN_OK || mpz_cmp(ways, found->most) <= 0)
        return status;
    mpz_set(found->most, ways);
    return keep_first(w, trays, index, error);
}

static tn_status tell_apart(walk *w, tn_error *error)
{
    const tn_rest_list *begin;
    mpz_t ways;
    mpz_init_set_ui(ways, 1);
    tn_status status = tn_rests_begin(w->rests, &begin, error);
    if (status == TN_OK)
        status = meet_set(w, 0, &(place){.ahead = TN_AHEAD_START}, begin, ways, error);
    for (uint32_t trays = 0; status == TN_OK && !w->too_much && trays <= w->most; trays++) {
        const layer *at = &w->layers[trays];
        for (uint32_t i = 0; trays > 0 && status == TN_OK && i < at->numbers.count; i++) {
            if (!may_end(w, trays, at->places[i].state))
                continue;
            ways_of(w, &at->places[i], ways);
            status = add_plans(w, ways, at->places[i].count, trays, i, error);
        }
        for (uint32_t i = 0; status == TN_OK && !w->too_much && trays < w->most && i < at->numbers.count; i++)
            status = read_layer(w, trays, i, read_set, error);
    }
    mpz_clear(ways);
    return status;
}

/* ---- a library */

/* Forgets which plans have how many ways. */
static void forget_plans(tn_derived_ways *found)
{
    for (size_t i = 0; i < found->count; i++)
        mpz_clears(found->rows[i].ways, found->rows[i].plans, NULL);
    found->count = 0;
    free(found->first);
    found->first = NULL;
    found->length = 0;
    mpz_set_ui(found->most, 0);
    found->has_most = found->has_rows = false;
}

/* The plan without trays, if the library has it. */
static tn_status add_empty(walk *w, const tn_derivation *derivation, tn_error *error)
{
    tn_plan_vm *vm = NULL;
    mpz_t ways, one;
    if (!tn_library_has(w->library, NULL, 0))
        return TN_OK;
    mpz_init(ways);
    mpz_init_set_ui(one, 1);
    tn_status status = w->projected ? tn_projected_ways(w->projected, NULL, 0, ways, error)
                                    : tn_plan_vm_new(tn_library_schema(w->library), 0, &vm, error);
    if (status == TN_OK && !w->projected)
        status = tn_plan_ways(derivation, vm, NULL, 0, ways, error);
    if (status == TN_OK)
        status = add_plans(w, ways, one, 0, 0, error);
    tn_plan_vm_free(vm);
    mpz_clears(ways, one, NULL);
    return status;
}

static tn_status count_ways(walk *w, const tn_derivation *derivation, tn_error *error)
{
    tn_status status = add_empty(w, derivation, error);
    if (status == TN_OK)
        status = tell_apart(w, error);
    if (status == TN_OK && !w->too_much)
        return TN_OK;
    if (status != TN_OK && status != TN_LIMIT)
        return status;
    for (uint32_t n = 0; n <= w->most; n++)
        clear_layer(&w->layers[n]);
    w->too_much = false;
    mpz_set_ui(w->found->ways, 0);
    status = add_empty(w, derivation, error);
    if (status == TN_OK)
        status = sum_ways(w, error);
    forget_plans(w->found);
    return status;
}

static tn_status make_rests(walk *w, const tn_derivation *derivation, tn_error *error)
{
    tn_lowering *lowering = NULL;
    tn_status status = tn_lowering_new(w->classes, tn_library_max_states(w->library), &lowering, error);
    if (status == TN_OK) {
        tn_lowering_within(lowering, w->most);
        status = tn_rests_new(derivation, lowering, w->most, &w->rests, error);
    }
    tn_lowering_free(lowering);
    return status;
}

static void clear_walk(walk *w)
{
    for (uint32_t n = 0; w->layers && n <= w->most; n++)
        clear_layer(&w->layers[n]);
    free(w->layers);
    tn_interner_clear(&w->pairs);
    tn_interner_clear(&w->sets);
    tn_rests_free(w->rests);
    tn_projected_free(w->projected);
}

/* Rests of a library that is projected, over letters that tell apart how many newer trays there are. */
static tn_status make_projected(walk *w, const tn_instruction *image, tn_error *error)
{
    tn_status status = tn_projected_new(tn_library_schema(w->library), image, w->classes,
                                        tn_library_max_states(w->library), w->most, &w->projected, error);
    if (status != TN_OK)
        return status;
    w->classes = w->projected->letters;
    return tn_rests_projected(w->projected, w->most, &w->rests, error);
}

static tn_status generated_ways(const tn_library *library, uint32_t clause, uint32_t max_nodes, tn_derived_ways *found,
                                tn_error *error)
{
    const tn_module *module = tn_library_schema(library)->module;
    const tn_clause_record *record = &module->CLAUSE_records[tn_library_record_of(library)->clause_first + clause];
    walk w = {.library = library,
              .classes = tn_library_classes(library),
              .least = tn_library_min(library),
              .most = tn_library_max(library),
              .max_nodes = max_nodes ? max_nodes : TN_WAYS_NODES,
              .found = found};
    tn_derivation derivation = {0};
    tn_instruction image;
    found->clause = tn_text(module, record->name);
    found->projected = tn_function_is_image(module, record->holds, &image);
    tn_status status = found->projected ? TN_OK : tn_derivation_read(module, record->holds, &derivation, error);
    if (status == TN_OK && !(w.layers = calloc((size_t)w.most + 1, sizeof *w.layers)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = found->projected ? make_projected(&w, &image, error) : make_rests(&w, &derivation, error);
    if (status == TN_OK)
        status = count_ways(&w, &derivation, error);
    clear_walk(&w);
    tn_derivation_clear(&derivation);
    return status;
}

/* Each plan is made in one way: the first has the most. */
static tn_status single_ways(const tn_library *library, tn_derived_ways *found, tn_error *error)
{
    mpz_t zero;
    mpz_set(found->ways, found->plans);
    if (mpz_sgn(found->plans) == 0)
        return TN_OK;
    found->first = malloc(((size_t)tn_library_max(library) + 1) * sizeof *found->first);
    if (!found->first)
        return tn_fail_memory(error);
    mpz_init(zero);
    tn_library_unrank(library, zero, found->first, &found->length);
    mpz_set_ui(found->most, 1);
    tn_status status = add_row(found, found->most, found->plans, error);
    mpz_clear(zero);
    return status;
}

tn_status tn_library_count_ways(const tn_library *library, uint32_t max_nodes, tn_derived_ways *found, tn_error *error)
{
    *found = (tn_derived_ways){.has_most = true, .has_rows = true};
    mpz_inits(found->plans, found->ways, found->most, NULL);
    tn_library_kept(library, TN_ALL_LENGTHS, found->plans);
    uint32_t clause = tn_library_generator(library);
    if (clause == UINT32_MAX)
        return single_ways(library, found, error);
    if (mpz_sgn(found->plans) > 0)
        return generated_ways(library, clause, max_nodes, found, error);
    const tn_module *module = tn_library_schema(library)->module;
    const tn_clause_record *record = &module->CLAUSE_records[tn_library_record_of(library)->clause_first + clause];
    found->clause = tn_text(module, record->name);
    found->projected = record->kind == TN_CLAUSE_ONTO;
    return TN_OK;
}

void tn_derived_ways_clear(tn_derived_ways *found)
{
    for (size_t i = 0; i < found->count; i++)
        mpz_clears(found->rows[i].ways, found->rows[i].plans, NULL);
    free(found->rows);
    free(found->first);
    mpz_clears(found->plans, found->ways, found->most, NULL);
    *found = (tn_derived_ways){0};
}
