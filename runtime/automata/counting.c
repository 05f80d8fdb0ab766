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

#include "runtime/automata/explore.h"
#include "runtime/automata/guesses.h"
#include "runtime/automata/marked.h"
#include "runtime/base/array.h"

typedef struct tn_place_count {
    uint32_t set;   /* number in the interner of sets */
    uint32_t count; /* canonical, positive */
} tn_place_count;

typedef struct tn_counting {
    tn_join join;
    uint32_t marker; /* column of the join */
    tn_guesses guesses;
    const tn_periodic_set *set;
    uint32_t *weight; /* [columns of the join]: what a letter counts, canonical */
    tn_place_count *places;
    size_t places_size, places_capacity;
    bool failed;
} tn_counting;

/* A key is {phase, thread of a, set of guesses under way (TALLY_ENDS), then set and count of each kind of place}. */
enum { PHASE, THREAD, RUNNING, PLACES };

static uint32_t canonical(const tn_counting *counting, uint64_t n)
{
    const tn_periodic_set *set = counting->set;
    if (n >= set->threshold)
        n = set->threshold + (n - set->threshold) % set->period;
    return (uint32_t)n;
}

/* ---- places */

static void place_add(tn_counting *counting, uint32_t set, uint32_t count)
{
    if (set == TN_NO_GUESSES || count == 0)
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

/* ---- the construction */

static bool finish_key(tn_counting *counting, uint32_t phase, uint32_t thread, uint32_t running, tn_key *next)
{
    return !counting->failed && !counting->guesses.failed && tn_key_push(next, phase) && tn_key_push(next, thread) &&
           tn_key_push(next, running) && places_write(counting, next) && !counting->guesses.failed;
}

static bool step_marker(tn_counting *counting, const uint32_t *key, size_t size, tn_key *next)
{
    if (key[PHASE] == 2)
        return true;
    if (key[PHASE] == 0)
        return finish_key(counting, 1, key[THREAD], TN_NO_GUESSES, next);
    for (size_t i = PLACES; i < size; i += 2)
        place_add(counting, tn_guesses_ended(&counting->guesses, key[i]), key[i + 1]);
    return finish_key(counting, 2, TN_NO_STATE, TN_NO_GUESSES, next);
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
        place_add(counting, tn_guesses_read(&counting->guesses, key[i], phase == 1, column), key[i + 1]);
    if (phase == 1 && counting->guesses.tally == TN_TALLY_ENDS) {
        running = tn_guesses_running(&counting->guesses, running, thread, column);
        place_add(counting, tn_guesses_end_running(&counting->guesses, running), 1);
    } else if (phase == 1) {
        place_add(counting, tn_guesses_new(&counting->guesses, thread, column), counting->weight[column]);
    }
    if (thread != TN_NO_STATE)
        thread = tn_guesses_state(&counting->guesses, thread, column);
    if (thread == counting->guesses.a.dead)
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
        bool counts = tn_guesses_accept(&counting->guesses, key[i]);
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
    tn_guesses_clear(&counting->guesses);
    free(counting->weight);
    free(counting->places);
}

tn_status tn_marked_count(const tn_marked *marked, const tn_dfa *a, tn_tally tally, const tn_periodic_set *set,
                          const uint64_t *counts, tn_dfa **out, tn_error *error)
{
    tn_counting counting = {.set = set};
    tn_key start = {0};
    tn_status status = prepare_columns(&counting, marked, a, counts, error);
    if (status == TN_OK)
        status = tn_guesses_make(&counting.guesses, a, tally, &counting.join, 0, error);
    if (status == TN_OK &&
        !finish_key(&counting, 0, counting.guesses.a.dead == 0 ? TN_NO_STATE : 0, TN_NO_GUESSES, &start))
        status = tn_fail_memory(error);
    if (status == TN_OK) {
        tn_construction construction = {tally == TN_TALLY_SINGLES ? "quantity" : "occurrences", &counting.join,
                                        &counting, counting_step, counting_accepts};
        status = tn_explore(&construction, &start, &counting.guesses.effort, marked->bounds, out, error);
    }
    free(start.data);
    counting_clear(&counting);
    return status;
}
