/* Constructions that guess a non-empty stretch [c, d) of a relation somewhere in the word: SOMEWHERE, and the three
 * ways in which a destination may lie at a gap that fails the separator (DISTANCE): left of the source, right of it, or
 * overlapping it.
 *
 * A state of the subset construction is the phase of the word being read (how many of x and y have passed); the threads
 * of the two automata that no guess has touched yet; and a set of pairs (p, q), one for each guess under way: p is the
 * relation's automaton having read its marker at c (and, once it has one, at d), q the second automaton (of failing
 * gaps), which wants its own two markers where the gap begins and ends. The four constructions differ only in the
 * phases where c and d may lie and in where q is marked.
 */
#include <stdlib.h>

#include "runtime/automata/explore.h"
#include "runtime/automata/marked.h"
#include "runtime/automata/operand.h"

typedef struct tn_guess_plan {
    const char *what;
    uint8_t start_phases, end_phases;                     /* bit f: c, or d, may lie in phase f */
    uint8_t gap_at_start, gap_at_end, gap_at_x, gap_at_y; /* how often the gap's automaton is marked there */
} tn_guess_plan;

/* c < d and x <= c and d <= y */
static const tn_guess_plan inside = {"rule", 1u << 1, 1u << 1, 0, 0, 0, 0};
/* d <= x: the gap is [d, x) */
static const tn_guess_plan to_the_left = {"distance", 1u << 0, 1u << 0, 0, 1, 1, 0};
/* y <= c: the gap is [y, c) */
static const tn_guess_plan to_the_right = {"distance", 1u << 2, 1u << 2, 1, 0, 0, 1};
/* c < y and x < d: the gap is [x, x), or mirrored [y, y) */
static const tn_guess_plan across = {"distance", 1u << 0 | 1u << 1, 1u << 1 | 1u << 2, 0, 0, 2, 0};
static const tn_guess_plan across_mirrored = {"distance", 1u << 0 | 1u << 1, 1u << 1 | 1u << 2, 0, 0, 0, 2};

typedef struct tn_guess {
    const tn_guess_plan *plan;
    tn_join join;
    uint32_t marker;   /* column of the join, or TN_NO_STATE: words without markers, read in phase 1 */
    tn_operand a, gap; /* gap.dfa is NULL where there is none */
    tn_pairs pairs;
} tn_guess;

/* A key is {phase, thread of a, thread of the gap, pairs}; nothing where no guess can succeed any more. */
enum { PHASE, THREAD_A, THREAD_GAP, PAIRS };

static uint32_t mark_gap(const tn_guess *guess, uint32_t q, uint32_t times)
{
    for (; guess->gap.dfa && times > 0; times--)
        q = tn_operand_mark(&guess->gap, q);
    return q;
}

static uint32_t read_gap(const tn_guess *guess, uint32_t q, uint32_t column)
{
    return guess->gap.dfa ? tn_operand_read(&guess->gap, q, guess->join.pick[(size_t)column * 2 + 1]) : q;
}

/* Writes the key of a phase, its threads and the pairs collected. */
static bool write_key(tn_guess *guess, uint32_t phase, uint32_t a, uint32_t gap, tn_key *next)
{
    bool may_start = guess->plan->start_phases >> phase != 0;
    if (!may_start || a == TN_NO_STATE || a == guess->a.dead || (guess->gap.dfa && gap == guess->gap.dead))
        a = gap = TN_NO_STATE;
    if (guess->pairs.failed)
        return false;
    if (a == TN_NO_STATE && guess->pairs.size == 0)
        return true;
    return tn_key_push(next, phase) && tn_key_push(next, a) && tn_key_push(next, gap) &&
           tn_pairs_write(&guess->pairs, next);
}

static bool step_marker(tn_guess *guess, const uint32_t *key, size_t size, tn_key *next)
{
    uint32_t phase = key[PHASE] + 1;
    if (phase == 3)
        return true;
    uint32_t times = phase == 1 ? guess->plan->gap_at_x : guess->plan->gap_at_y;
    bool may_end = guess->plan->end_phases >> phase != 0;
    for (size_t i = PAIRS; i < size; i += 2)
        if (may_end || guess->a.phase[key[i]] == 2)
            tn_pairs_add(&guess->pairs, key[i], mark_gap(guess, key[i + 1], times));
    uint32_t gap = key[THREAD_GAP] == TN_NO_STATE ? TN_NO_STATE : mark_gap(guess, key[THREAD_GAP], times);
    return write_key(guess, phase, key[THREAD_A], gap, next);
}

/* Reads a letter with one guess; where its stretch may end after the letter, adds the guess that it does. */
static void read_pair(tn_guess *guess, uint32_t phase, uint32_t p, uint32_t q, uint32_t column)
{
    bool running = guess->a.phase[p] == 1;
    p = tn_operand_read(&guess->a, p, guess->join.pick[(size_t)column * 2]);
    q = read_gap(guess, q, column);
    tn_pairs_add(&guess->pairs, p, q);
    if (running && p != guess->a.dead && guess->plan->end_phases >> phase & 1)
        tn_pairs_add(&guess->pairs, tn_operand_mark(&guess->a, p), mark_gap(guess, q, guess->plan->gap_at_end));
}

static bool guess_step(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    tn_guess *guess = context;
    guess->pairs.size = 0;
    if (size == 0)
        return true;
    if (column == guess->marker)
        return step_marker(guess, key, size, next);
    uint32_t phase = key[PHASE], a = key[THREAD_A], gap = key[THREAD_GAP];
    for (size_t i = PAIRS; i < size; i += 2)
        read_pair(guess, phase, key[i], key[i + 1], column);
    if (a != TN_NO_STATE) {
        if (guess->plan->start_phases >> phase & 1) { /* c is here, before the letter */
            uint32_t p = tn_operand_mark(&guess->a, a), q = mark_gap(guess, gap, guess->plan->gap_at_start);
            if (p != guess->a.dead && !(guess->gap.dfa && q == guess->gap.dead))
                read_pair(guess, phase, p, q, column);
        }
        a = tn_operand_read(&guess->a, a, guess->join.pick[(size_t)column * 2]);
        gap = read_gap(guess, gap, column);
    }
    return write_key(guess, phase, a, gap, next);
}

static bool guess_accepts(void *context, const uint32_t *key, size_t size)
{
    const tn_guess *guess = context;
    if (size == 0 || (guess->marker != TN_NO_STATE && key[PHASE] != 2))
        return false;
    for (size_t i = PAIRS; i < size; i += 2)
        if (guess->a.dfa->accept[key[i]] && (!guess->gap.dfa || guess->gap.dfa->accept[key[i + 1]]))
            return true;
    return false;
}

/* gap: or NULL. plain: an automaton without the marker, that reads the whole word as the stretch. */
static tn_status guess_stretch(const tn_marked *marked, const tn_guess_plan *plan, const tn_dfa *a, const tn_dfa *gap,
                               bool plain, tn_dfa **out, tn_error *error)
{
    tn_guess guess = {.plan = plan, .marker = TN_NO_STATE};
    const tn_dfa *parts[2] = {a, gap ? gap : a};
    tn_key start = {0};
    uint32_t letters = marked->letters - plain;
    tn_status status = tn_join_make(&guess.join, parts, 2, letters, NULL, !plain, error);
    if (status == TN_OK)
        status = tn_operand_make(&guess.a, a, error);
    if (status == TN_OK && gap)
        status = tn_operand_make(&guess.gap, gap, error);
    if (status == TN_OK) {
        guess.pairs.first = &guess.a;
        guess.pairs.second = gap ? &guess.gap : NULL;
        if (!plain)
            guess.marker = guess.join.column[letters - 1];
        if (!write_key(&guess, plain, 0, 0, &start))
            status = tn_fail_memory(error);
    }
    if (status == TN_OK) {
        tn_construction construction = {plan->what, &guess.join, &guess, guess_step, guess_accepts};
        status = tn_explore(&construction, &start, &guess.pairs.effort, marked->bounds, out, error);
    }
    free(start.data);
    tn_join_clear(&guess.join);
    tn_operand_clear(&guess.a);
    tn_operand_clear(&guess.gap);
    tn_pairs_clear(&guess.pairs);
    return status;
}

tn_status tn_marked_somewhere(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error)
{
    return guess_stretch(marked, &inside, a, NULL, false, out, error);
}

tn_status tn_marked_anywhere(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error)
{
    return guess_stretch(marked, &inside, a, NULL, true, out, error);
}

/* *left := *left less the stretches with a destination that the plan of guessing finds at a failing gap. */
static tn_status less(const tn_marked *marked, const tn_guess_plan *plan, const tn_dfa *destination,
                      const tn_dfa *failing, tn_dfa **left, tn_error *error)
{
    tn_dfa *near = NULL, *rest = NULL;
    tn_status status = guess_stretch(marked, plan, destination, failing, false, &near, error);
    if (status == TN_OK)
        status = tn_dfa_product(*left, near, TN_DFA_MINUS, plan->what, marked->bounds, &rest, error);
    tn_dfa_free(near);
    if (status != TN_OK)
        return status;
    tn_dfa_free(*left);
    *left = rest;
    return TN_OK;
}

/* The source less the stretches with a destination at a failing gap, as each of the plans finds it. */
static tn_status less_all(const tn_marked *marked, const tn_guess_plan *const *plans, const tn_dfa *source,
                          const tn_dfa *destination, const tn_dfa *failing, tn_dfa **out, tn_error *error)
{
    tn_dfa *left = NULL;
    tn_status status =
        tn_dfa_product(source, marked->nonempty, TN_DFA_AND, (*plans)->what, marked->bounds, &left, error);
    for (; status == TN_OK && *plans; plans++)
        status = less(marked, *plans, destination, failing, &left, error);
    if (status != TN_OK)
        tn_dfa_free(left);
    else
        *out = left;
    return status;
}

tn_status tn_marked_distance(const tn_marked *marked, const tn_dfa *source, const tn_dfa *destination,
                             const tn_dfa *separator, bool mirrored, tn_dfa **out, tn_error *error)
{
    const tn_guess_plan *const plans[] = {mirrored ? &across_mirrored : &across, &to_the_left, &to_the_right, NULL};
    tn_dfa *failing = NULL;
    tn_status status = tn_marked_not(marked, separator, &failing, error);
    if (status == TN_OK)
        status = less_all(marked, plans, source, destination, failing, out, error);
    tn_dfa_free(failing);
    return status;
}

static const tn_guess_plan *const around[] = {&to_the_left, &to_the_right, NULL};

tn_status tn_marked_far(const tn_marked *marked, const tn_dfa *source, const tn_dfa *destination,
                        const tn_dfa *separator, tn_dfa **out, tn_error *error)
{
    tn_dfa *failing = NULL;
    tn_status status = tn_marked_not(marked, separator, &failing, error);
    if (status == TN_OK)
        status = less_all(marked, around, source, destination, failing, out, error);
    tn_dfa_free(failing);
    return status;
}

/* What is left of the source without those that have no such destination. */
tn_status tn_marked_near(const tn_marked *marked, const tn_dfa *source, const tn_dfa *destination,
                         const tn_dfa *separator, tn_dfa **out, tn_error *error)
{
    tn_dfa *none = NULL, *nonempty = NULL;
    tn_status status = less_all(marked, around, source, destination, separator, &none, error);
    if (status == TN_OK)
        status = tn_dfa_product(source, marked->nonempty, TN_DFA_AND, "relation", marked->bounds, &nonempty, error);
    if (status == TN_OK)
        status = tn_dfa_product(nonempty, none, TN_DFA_MINUS, "relation", marked->bounds, out, error);
    tn_dfa_free(none);
    tn_dfa_free(nonempty);
    return status;
}
