/* QUANTITY, SUM and OCCURRENCES: count places of the stretch [x, y) that are in a relation, modulo what the condition
 * can tell apart.
 *
 * Whether a place counts may depend on what comes after it, even after y (the relation may look at the whole word). So
 * a state keeps, for each place read so far, the set of states that the relation's automaton may be in if that place is
 * guessed; places with equal sets have equal futures, so a set is kept once with the number of its places (a multiset
 * of sets). Numbers are kept in N / (threshold ~ threshold + period) of the condition (condition.h): the coarsest count
 * that still decides it. For a relation that looks only at the stretch itself all sets become the one that accepts
 * whatever follows, and the state is one number.
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/automata/explore.h"
#include "runtime/plan/automata/marked.h"
#include "runtime/plan/automata/operand.h"

typedef struct tn_place_count {
    uint32_t set;   /* number in the interner of sets */
    uint32_t count; /* canonical, positive */
} tn_place_count;

typedef struct tn_counting {
    tn_tally tally;
    tn_join join;
    uint32_t marker; /* column of the join */
    tn_operand a;
    const tn_periodic_set *set;
    uint32_t *weight; /* [columns of the join]: what a letter counts, canonical */
    tn_interner sets; /* of states of a */
    tn_pairs members; /* of the set being built */
    tn_key scratch, words;
    tn_place_count *places;
    size_t places_size, places_capacity;
    uint64_t effort;
    bool failed;
} tn_counting;

/* A key is {phase, thread of a, set of guesses under way (TALLY_ENDS), then set and count of each kind of place}. */
enum { PHASE, THREAD, RUNNING, PLACES };
#define NO_SET UINT32_MAX

static uint32_t canonical(const tn_counting *counting, uint64_t n)
{
    const tn_periodic_set *set = counting->set;
    if (n >= set->threshold)
        n = set->threshold + (n - set->threshold) % set->period;
    return (uint32_t)n;
}

/* ---- sets */

static void set_begin(tn_counting *counting)
{
    counting->members.size = 0;
}

static void set_add(tn_counting *counting, uint32_t state)
{
    tn_pairs_add(&counting->members, state, 0);
}

/* The number of the set built, NO_SET where it is empty. A set that accepts whatever follows is the same as that state
 * alone. */
static uint32_t set_end(tn_counting *counting)
{
    tn_pairs *members = &counting->members;
    counting->failed |= members->failed;
    for (size_t i = 0; i < members->size; i++) {
        if (members->data[i] >> 32 == counting->a.everything) {
            members->data[0] = members->data[i];
            members->size = 1;
        }
    }
    if (members->size == 0)
        return NO_SET;
    counting->words.size = 0;
    uint64_t before = members->effort;
    if (!tn_pairs_write(members, &counting->words)) {
        counting->failed = true;
        return NO_SET;
    }
    counting->effort += members->effort - before;
    size_t size = 0;
    for (; size < members->size; size++)
        counting->words.data[size] = counting->words.data[2 * size];
    uint32_t set = tn_intern(&counting->sets, counting->words.data, size);
    counting->failed |= set == UINT32_MAX;
    return set;
}

/* The members of a set, copied: building another may move them. */
static size_t set_members(tn_counting *counting, uint32_t set)
{
    size_t size;
    const uint32_t *members = tn_interned(&counting->sets, set, &size);
    if (!tn_key_copy(&counting->scratch, members, size)) {
        counting->failed = true;
        return 0;
    }
    counting->effort += size;
    return size;
}

static uint32_t read_state(const tn_counting *counting, uint32_t state, uint32_t column)
{
    return tn_operand_read(&counting->a, state, counting->join.pick[column]);
}

/* Adds a state of a guess under way and, since its stretch may end here, the state that it then is in. */
static void set_add_running(tn_counting *counting, uint32_t state)
{
    if (state == counting->a.dead)
        return;
    set_add(counting, state);
    set_add(counting, tn_operand_mark(&counting->a, state));
}

/* A set after one more letter. In phase 1, guesses of TALLY_STARTS that are under way may end. */
static uint32_t set_read(tn_counting *counting, uint32_t set, uint32_t phase, uint32_t column)
{
    size_t size = set_members(counting, set);
    set_begin(counting);
    for (size_t i = 0; i < size; i++) {
        uint32_t state = counting->scratch.data[i];
        uint32_t to = read_state(counting, state, column);
        if (phase == 1 && counting->a.phase[state] == 1)
            set_add_running(counting, to);
        else
            set_add(counting, to);
    }
    return set_end(counting);
}

/* A set without the guesses that are under way (at y: they would end too late). */
static uint32_t set_ended(tn_counting *counting, uint32_t set)
{
    size_t size = set_members(counting, set);
    set_begin(counting);
    for (size_t i = 0; i < size; i++)
        if (counting->a.phase[counting->scratch.data[i]] == 2)
            set_add(counting, counting->scratch.data[i]);
    return set_end(counting);
}

/* ---- places */

static void place_add(tn_counting *counting, uint32_t set, uint32_t count)
{
    if (set == NO_SET || count == 0)
        return;
    if (!tn_array_reserve_from(&counting->places, &counting->places_capacity, 32, counting->places_size, 1,
                               sizeof *counting->places)) {
        counting->failed = true;
        return;
    }
    counting->places[counting->places_size++] = (tn_place_count){set, count};
}

static int compare_places(const void *a, const void *b)
{
    uint32_t x = ((const tn_place_count *)a)->set, y = ((const tn_place_count *)b)->set;
    return (x > y) - (x < y);
}

/* Adds up the places with equal sets and appends them. */
static bool places_write(tn_counting *counting, tn_key *next)
{
    tn_place_count *places = counting->places;
    if (counting->places_size > 1)
        qsort(places, counting->places_size, sizeof *places, compare_places);
    for (size_t i = 0; i < counting->places_size;) {
        uint64_t sum = 0;
        size_t j = i;
        for (; j < counting->places_size && places[j].set == places[i].set; j++)
            sum += places[j].count;
        uint32_t count = canonical(counting, sum);
        if (count > 0 && (!tn_key_push(next, places[i].set) || !tn_key_push(next, count)))
            return false;
        i = j;
    }
    return true;
}

/* The set of the place that the letter just read makes, guessed to start before it (singles: and to end after it). */
static uint32_t new_place(tn_counting *counting, uint32_t thread, uint32_t column)
{
    if (thread == TN_NO_STATE)
        return NO_SET;
    uint32_t state = read_state(counting, tn_operand_mark(&counting->a, thread), column);
    set_begin(counting);
    if (counting->tally == TN_TALLY_STARTS)
        set_add_running(counting, state);
    else
        set_add(counting, tn_operand_mark(&counting->a, state));
    return set_end(counting);
}

/* TALLY_ENDS: the guesses under way after one more letter, with the one that starts before it. */
static uint32_t read_running(tn_counting *counting, uint32_t running, uint32_t thread, uint32_t column)
{
    size_t size = running == NO_SET ? 0 : set_members(counting, running);
    set_begin(counting);
    for (size_t i = 0; i < size; i++)
        set_add(counting, read_state(counting, counting->scratch.data[i], column));
    if (thread != TN_NO_STATE)
        set_add(counting, read_state(counting, tn_operand_mark(&counting->a, thread), column));
    return set_end(counting);
}

/* TALLY_ENDS: the place where the guesses under way end. */
static uint32_t end_running(tn_counting *counting, uint32_t running)
{
    size_t size = running == NO_SET ? 0 : set_members(counting, running);
    set_begin(counting);
    for (size_t i = 0; i < size; i++)
        set_add(counting, tn_operand_mark(&counting->a, counting->scratch.data[i]));
    return set_end(counting);
}

/* ---- the construction */

static bool finish_key(tn_counting *counting, uint32_t phase, uint32_t thread, uint32_t running, tn_key *next)
{
    return !counting->failed && tn_key_push(next, phase) && tn_key_push(next, thread) && tn_key_push(next, running) &&
           places_write(counting, next) && !counting->failed;
}

static bool step_marker(tn_counting *counting, const uint32_t *key, size_t size, tn_key *next)
{
    if (key[PHASE] == 2)
        return true;
    if (key[PHASE] == 0)
        return finish_key(counting, 1, key[THREAD], NO_SET, next);
    for (size_t i = PLACES; i < size; i += 2)
        place_add(counting, set_ended(counting, key[i]), key[i + 1]);
    return finish_key(counting, 2, TN_NO_STATE, NO_SET, next);
}

static bool counting_step(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    tn_counting *counting = context;
    counting->places_size = 0;
    if (size == 0)
        return true;
    if (column == counting->marker)
        return step_marker(counting, key, size, next);
    uint32_t phase = key[PHASE], thread = key[THREAD], running = key[RUNNING];
    for (size_t i = PLACES; i < size; i += 2)
        place_add(counting, set_read(counting, key[i], phase, column), key[i + 1]);
    if (phase == 1 && counting->tally == TN_TALLY_ENDS) {
        running = read_running(counting, running, thread, column);
        place_add(counting, end_running(counting, running), 1);
    } else if (phase == 1) {
        place_add(counting, new_place(counting, thread, column), counting->weight[column]);
    }
    if (thread != TN_NO_STATE)
        thread = read_state(counting, thread, column);
    if (thread == counting->a.dead)
        thread = TN_NO_STATE;
    return finish_key(counting, phase, thread, running, next);
}

static bool counting_accepts(void *context, const uint32_t *key, size_t size)
{
    const tn_counting *counting = context;
    if (size == 0 || key[PHASE] != 2)
        return false;
    uint64_t total = 0;
    for (size_t i = PLACES; i < size; i += 2) {
        size_t members;
        const uint32_t *states = tn_interned(&counting->sets, key[i], &members);
        bool counts = false;
        for (size_t m = 0; m < members; m++)
            counts |= counting->a.dfa->accept[states[m]];
        total += counts ? key[i + 1] : 0;
    }
    return counting->set->holds[canonical(counting, total)];
}

/* Joins the columns with what each letter counts. */
static tn_status prepare_columns(tn_counting *counting, const tn_marked *marked, const tn_dfa *a,
                                 const uint64_t *counts, tn_error *error)
{
    uint32_t *weights = calloc(marked->letters, sizeof *weights);
    if (!weights)
        return tn_fail_memory(error);
    for (uint32_t l = 0; l + 1 < marked->letters; l++)
        weights[l] = canonical(counting, counts ? counts[l] : 1);
    tn_status status = tn_join_make(&counting->join, &a, 1, marked->letters, weights, true, error);
    if (status == TN_OK) {
        counting->marker = counting->join.column[marked->letters - 1];
        counting->weight = calloc(counting->join.columns, sizeof *counting->weight);
        status = counting->weight ? TN_OK : tn_fail_memory(error);
    }
    for (uint32_t c = 0; status == TN_OK && c < counting->join.columns; c++)
        counting->weight[c] = weights[counting->join.letter[c]];
    free(weights);
    return status;
}

static void counting_clear(tn_counting *counting)
{
    tn_join_clear(&counting->join);
    tn_operand_clear(&counting->a);
    tn_interner_clear(&counting->sets);
    tn_pairs_clear(&counting->members);
    free(counting->weight);
    free(counting->scratch.data);
    free(counting->words.data);
    free(counting->places);
}

tn_status tn_marked_count(const tn_marked *marked, const tn_dfa *a, tn_tally tally, const tn_periodic_set *set,
                          const uint64_t *counts, tn_dfa **out, tn_error *error)
{
    tn_counting counting = {.tally = tally, .set = set};
    counting.members.first = &counting.a;
    tn_key start = {0};
    tn_status status = prepare_columns(&counting, marked, a, counts, error);
    if (status == TN_OK)
        status = tn_operand_make(&counting.a, a, error);
    if (status == TN_OK && !finish_key(&counting, 0, counting.a.dead == 0 ? TN_NO_STATE : 0, NO_SET, &start))
        status = tn_fail_memory(error);
    if (status == TN_OK) {
        tn_construction construction = {tally == TN_TALLY_SINGLES ? "quantity" : "occurrences", &counting.join,
                                        &counting, counting_step, counting_accepts};
        status = tn_explore(&construction, &start, &counting.effort, marked->bounds, out, error);
    }
    free(start.data);
    counting_clear(&counting);
    return status;
}
