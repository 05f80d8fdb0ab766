/* REPEATED: stretches cut into several non-empty ones, each in a relation.
 *
 * The cuts are guessed. A guess knows how many stretches end before here, the state of the relation's automaton in the
 * stretch at hand, and its states in those that came before: what lies behind a stretch may matter to it, so that its
 * automaton reads on, and all of them have to accept in the end. An automaton to which only the stretch matters accepts
 * whatever comes behind it, and is forgotten. Ahead of the first marker, and of each cut to come, every guess has read
 * the same letters: one state for all.
 *
 * A key is the phase, the state ahead of the first marker (while a cut may come), then the guesses, sorted: number,
 * state, how many states of earlier stretches, these. Nothing at all: no guess is left. */
#include <stdlib.h>
#include <string.h>

#include "runtime/automata/explore.h"
#include "runtime/automata/marked.h"
#include "runtime/automata/operand.h"
#include "runtime/base/array.h"

typedef struct guess {
    uint32_t done; /* stretches that have ended; of an open number, at most the least */
    uint32_t state;
    size_t first, count; /* of the states of earlier stretches */
} guess;

typedef struct repeating {
    tn_join join;
    uint32_t marker; /* column of the join */
    tn_operand of;
    uint32_t least, most; /* most 0: any number */
    guess *guesses;
    size_t guess_count, guess_room;
    uint32_t *states; /* of earlier stretches, of all guesses */
    size_t state_count, state_room;
    uint64_t effort;
    bool failed;
} repeating;

#define NO_STRETCH (TN_NO_STATE - 1) /* instead of a state, behind the second marker */

/* ---- guesses */

/* Puts a state among those from `first` on, unless it accepts whatever another one accepts; those that do so beside it
 * go. */
static void put_state(repeating *r, size_t first, uint32_t state)
{
    size_t kept = first;
    for (size_t i = first; i < r->state_count; i++)
        if (tn_operand_below(&r->of, r->states[i], state))
            return;
    for (size_t i = first; i < r->state_count; i++)
        if (!tn_operand_below(&r->of, state, r->states[i]))
            r->states[kept++] = r->states[i];
    r->state_count = kept;
    r->states[r->state_count++] = state;
}

/* A guess of earlier stretches that are in these states, and one more in `ended` (NO_STRETCH: none); none at all where
 * one of them is dead. `earlier` may lie in another key, never among the states here. */
static void add_guess(repeating *r, uint32_t done, uint32_t state, const uint32_t *earlier, size_t count,
                      uint32_t ended)
{
    if (state == r->of.dead || ended == r->of.dead)
        return;
    for (size_t i = 0; i < count; i++)
        if (earlier[i] == r->of.dead)
            return;
    if (!tn_array_reserve(&r->guesses, &r->guess_room, r->guess_count, 1, sizeof *r->guesses) ||
        !tn_array_reserve(&r->states, &r->state_room, r->state_count, count + 1, sizeof *r->states)) {
        r->failed = true;
        return;
    }
    size_t first = r->state_count;
    for (size_t i = 0; i <= count; i++) {
        uint32_t one = i < count ? earlier[i] : ended;
        if (one != NO_STRETCH && one != r->of.everything)
            put_state(r, first, one);
    }
    qsort(r->states + first, r->state_count - first, sizeof *r->states, tn_words_compare);
    r->guesses[r->guess_count++] = (guess){done, state, first, r->state_count - first};
}

/* How many stretches have ended with one more, as far as it matters. */
static uint32_t one_more(const repeating *r, uint32_t done)
{
    return r->most == 0 && done >= r->least ? done : done + 1;
}

static bool is_enough(const repeating *r, uint32_t done)
{
    return done >= r->least && (r->most == 0 || done <= r->most);
}

/* Does b accept whatever a accepts? */
static bool is_below(const repeating *r, const guess *a, const guess *b)
{
    bool below = a->done == b->done && (a->state == b->state || (a->state != NO_STRETCH && b->state != NO_STRETCH &&
                                                                 tn_operand_below(&r->of, a->state, b->state)));
    for (size_t i = 0; below && i < b->count; i++) {
        below = false;
        for (size_t k = 0; !below && k < a->count; k++)
            below = tn_operand_below(&r->of, r->states[a->first + k], r->states[b->first + i]);
    }
    return below;
}

/* Drops each guess that another one makes needless. */
static void keep_antichain(repeating *r)
{
    size_t kept = 0;
    for (size_t i = 0; i < r->guess_count; i++) {
        guess it = r->guesses[i];
        bool needless = false;
        for (size_t k = 0; !needless && k < kept; k++)
            needless = is_below(r, &it, &r->guesses[k]);
        r->effort += kept;
        if (needless)
            continue;
        size_t rest = 0;
        for (size_t k = 0; k < kept; k++)
            if (!is_below(r, &r->guesses[k], &it))
                r->guesses[rest++] = r->guesses[k];
        kept = rest;
        r->guesses[kept++] = it;
    }
    r->guess_count = kept;
}

static int compare_guesses(const uint32_t *states, const guess *a, const guess *b)
{
    if (a->done != b->done)
        return a->done < b->done ? -1 : 1;
    if (a->state != b->state)
        return a->state < b->state ? -1 : 1;
    for (size_t i = 0; i < a->count && i < b->count; i++)
        if (states[a->first + i] != states[b->first + i])
            return states[a->first + i] < states[b->first + i] ? -1 : 1;
    return (a->count > b->count) - (a->count < b->count);
}

static void sort_guesses(repeating *r)
{
    for (size_t i = 1; i < r->guess_count; i++) {
        guess it = r->guesses[i];
        size_t at = i;
        for (; at > 0 && compare_guesses(r->states, &it, &r->guesses[at - 1]) < 0; at--)
            r->guesses[at] = r->guesses[at - 1];
        r->guesses[at] = it;
        r->effort += i - at;
    }
}

static bool write_key(repeating *r, uint32_t phase, uint32_t ahead, tn_key *key)
{
    if (!r->failed && r->guess_count > 1) {
        r->failed = !tn_operand_compare(&r->of);
        keep_antichain(r);
        sort_guesses(r);
    }
    if (r->failed)
        return false;
    if (r->guess_count == 0)
        return true;
    bool ok = tn_key_push(key, phase) && tn_key_push(key, ahead);
    for (size_t i = 0; ok && i < r->guess_count; i++) {
        const guess *it = &r->guesses[i];
        ok = tn_key_push(key, it->done) && tn_key_push(key, it->state) && tn_key_push(key, (uint32_t)it->count);
        for (size_t k = 0; ok && k < it->count; k++)
            ok = tn_key_push(key, r->states[it->first + k]);
    }
    return ok;
}

/* ---- steps */

enum { HEAD = 2, GUESS_HEAD = 3 }; /* words of a key before its guesses, of a guess before its states */

/* Reads the marker: the stretch at hand ends, and with it the last one. */
static void end_last(repeating *r, const uint32_t *it)
{
    uint32_t done = one_more(r, it[0]);
    if (is_enough(r, done))
        add_guess(r, 0, NO_STRETCH, it + GUESS_HEAD, it[2], tn_operand_mark(&r->of, it[1]));
}

/* Reads a letter; the stretch at hand may end behind it, and another begin. */
static bool read_letter(repeating *r, const uint32_t *it, uint32_t ahead, uint32_t column, tn_key *earlier)
{
    earlier->size = 0;
    for (size_t i = 0; i < it[2]; i++)
        if (!tn_key_push(earlier, tn_operand_read(&r->of, it[GUESS_HEAD + i], column)))
            return false;
    bool inside = it[1] != NO_STRETCH;
    uint32_t state = inside ? tn_operand_read(&r->of, it[1], column) : NO_STRETCH;
    add_guess(r, it[0], state, earlier->data, earlier->size, NO_STRETCH);
    if (!inside || state == r->of.dead)
        return true;
    uint32_t ended = tn_operand_mark(&r->of, state), done = one_more(r, it[0]);
    if (r->most == 0 || done < r->most)
        add_guess(r, done, tn_operand_mark(&r->of, ahead), earlier->data, earlier->size, ended);
    return true;
}

static bool repeat_step(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    repeating *r = context;
    r->guess_count = r->state_count = 0;
    if (size == 0)
        return true;
    uint32_t phase = key[0], ahead = key[1];
    bool marker = column == r->marker;
    tn_key earlier = {0};
    bool ok = true;
    uint32_t read = marker || phase == 2 ? ahead : tn_operand_read(&r->of, ahead, r->join.pick[column]);
    if (phase == 0) { /* one guess, which stands for all that are to come */
        add_guess(r, 0, marker ? tn_operand_mark(&r->of, ahead) : 0, NULL, 0, NO_STRETCH);
        if (read == r->of.dead)
            r->guess_count = 0;
    }
    for (size_t at = HEAD; ok && phase > 0 && at < size; at += GUESS_HEAD + key[at + 2]) {
        if (marker && phase == 1)
            end_last(r, key + at);
        else if (!marker)
            ok = read_letter(r, key + at, read, r->join.pick[column], &earlier);
    }
    free(earlier.data);
    uint32_t after = phase + marker;
    return ok && write_key(r, after, after == 2 ? 0 : read, next);
}

static bool repeat_accepts(void *context, const uint32_t *key, size_t size)
{
    const repeating *r = context;
    bool accepts = false;
    for (size_t at = HEAD; size > 0 && key[0] == 2 && !accepts && at < size; at += GUESS_HEAD + key[at + 2]) {
        accepts = true;
        for (size_t i = 0; i < key[at + 2]; i++)
            accepts = accepts && r->of.dfa->accept[key[at + GUESS_HEAD + i]];
    }
    return accepts;
}

static tn_status start_key(const repeating *r, tn_key *start, tn_error *error)
{
    static const uint32_t one[HEAD + GUESS_HEAD] = {0};
    return r->of.dead == 0 || tn_key_copy(start, one, HEAD + GUESS_HEAD) ? TN_OK : tn_fail_memory(error);
}

static tn_status repeat(const tn_marked *marked, const tn_dfa *a, uint32_t least, uint32_t most, tn_dfa **out,
                        tn_error *error)
{
    repeating r = {.least = least, .most = most};
    tn_key start = {0};
    tn_status status = tn_join_make(&r.join, &a, 1, marked->letters, NULL, true, error);
    if (status == TN_OK)
        status = tn_operand_make(&r.of, a, error);
    if (status == TN_OK) {
        r.marker = r.join.column[marked->letters - 1];
        status = start_key(&r, &start, error);
    }
    if (status == TN_OK) {
        tn_construction construction = {"repeat", &r.join, &r, repeat_step, repeat_accepts};
        status = tn_explore(&construction, &start, &r.effort, marked->bounds, out, error);
    }
    free(start.data);
    free(r.guesses);
    free(r.states);
    tn_join_clear(&r.join);
    tn_operand_clear(&r.of);
    return status;
}

tn_status tn_marked_repeat(const tn_marked *marked, const tn_dfa *a, uint32_t least, uint32_t most, tn_dfa **out,
                           tn_error *error)
{
    tn_dfa *some = NULL;
    tn_status status = tn_dfa_product(a, marked->nonempty, TN_DFA_AND, "repeat", marked->bounds, &some, error);
    if (status == TN_OK)
        status = repeat(marked, some, least, most, out, error);
    tn_dfa_free(some);
    return status;
}
