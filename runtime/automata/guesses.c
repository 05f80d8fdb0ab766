/* Guesses about the places of a relation: sets of states of its automaton, one for each place read so far. */
#include "runtime/automata/guesses.h"

#include <stdlib.h>

tn_status tn_guesses_make(tn_guesses *guesses, const tn_dfa *dfa, tn_tally tally, const tn_join *join, uint32_t part,
                          tn_error *error)
{
    *guesses = (tn_guesses){.tally = tally, .join = join, .part = part};
    guesses->members.first = &guesses->a;
    return tn_operand_make(&guesses->a, dfa, error);
}

void tn_guesses_clear(tn_guesses *guesses)
{
    tn_operand_clear(&guesses->a);
    tn_interner_clear(&guesses->sets);
    tn_pairs_clear(&guesses->members);
    free(guesses->scratch.data);
    free(guesses->words.data);
}

bool tn_guesses_accept(const tn_guesses *guesses, uint32_t set)
{
    size_t members;
    const uint32_t *states = tn_interned(&guesses->sets, set, &members);
    for (size_t m = 0; m < members; m++)
        if (guesses->a.dfa->accept[states[m]])
            return true;
    return false;
}

bool tn_guesses_certain(const tn_guesses *guesses, uint32_t set)
{
    size_t members;
    const uint32_t *states = tn_interned(&guesses->sets, set, &members);
    return members == 1 && states[0] == guesses->a.everything;
}

static void set_begin(tn_guesses *guesses)
{
    guesses->members.size = 0;
}

static void set_add(tn_guesses *guesses, uint32_t state)
{
    tn_pairs_add(&guesses->members, state, 0);
}

/* The number of the set built, TN_NO_GUESSES where it is empty. A set that accepts whatever follows is the same as that
 * state alone. */
static uint32_t set_end(tn_guesses *guesses)
{
    tn_pairs *members = &guesses->members;
    guesses->failed |= members->failed;
    for (size_t i = 0; i < members->size; i++) {
        if (members->data[i] >> 32 == guesses->a.everything) {
            members->data[0] = members->data[i];
            members->size = 1;
        }
    }
    if (members->size == 0)
        return TN_NO_GUESSES;
    guesses->words.size = 0;
    uint64_t before = members->effort;
    if (!tn_pairs_write(members, &guesses->words)) {
        guesses->failed = true;
        return TN_NO_GUESSES;
    }
    guesses->effort += members->effort - before;
    size_t size = 0;
    for (; size < members->size; size++)
        guesses->words.data[size] = guesses->words.data[2 * size];
    uint32_t set = tn_intern(&guesses->sets, guesses->words.data, size);
    guesses->failed |= set == UINT32_MAX;
    return set;
}

/* The members of a set, copied: building another may move them. */
static size_t set_members(tn_guesses *guesses, uint32_t set)
{
    size_t size;
    const uint32_t *members = tn_interned(&guesses->sets, set, &size);
    if (!tn_key_copy(&guesses->scratch, members, size)) {
        guesses->failed = true;
        return 0;
    }
    guesses->effort += size;
    return size;
}

/* Adds a state of a guess under way and, since its stretch may end here, the state that it then is in. */
static void set_add_running(tn_guesses *guesses, uint32_t state)
{
    if (state == guesses->a.dead)
        return;
    set_add(guesses, state);
    set_add(guesses, tn_operand_mark(&guesses->a, state));
}

uint32_t tn_guesses_read(tn_guesses *guesses, uint32_t set, bool inside, uint32_t column)
{
    size_t size = set_members(guesses, set);
    set_begin(guesses);
    for (size_t i = 0; i < size; i++) {
        uint32_t state = guesses->scratch.data[i];
        uint32_t to = tn_guesses_state(guesses, state, column);
        if (inside && guesses->a.phase[state] == 1)
            set_add_running(guesses, to);
        else
            set_add(guesses, to);
    }
    return set_end(guesses);
}

uint32_t tn_guesses_ended(tn_guesses *guesses, uint32_t set)
{
    size_t size = set_members(guesses, set);
    set_begin(guesses);
    for (size_t i = 0; i < size; i++)
        if (guesses->a.phase[guesses->scratch.data[i]] == 2)
            set_add(guesses, guesses->scratch.data[i]);
    return set_end(guesses);
}

uint32_t tn_guesses_new(tn_guesses *guesses, uint32_t thread, uint32_t column)
{
    if (thread == TN_NO_STATE)
        return TN_NO_GUESSES;
    uint32_t state = tn_guesses_state(guesses, tn_operand_mark(&guesses->a, thread), column);
    set_begin(guesses);
    if (guesses->tally == TN_TALLY_STARTS)
        set_add_running(guesses, state);
    else
        set_add(guesses, tn_operand_mark(&guesses->a, state));
    return set_end(guesses);
}

uint32_t tn_guesses_running(tn_guesses *guesses, uint32_t running, uint32_t thread, uint32_t column)
{
    size_t size = running == TN_NO_GUESSES ? 0 : set_members(guesses, running);
    set_begin(guesses);
    for (size_t i = 0; i < size; i++)
        set_add(guesses, tn_guesses_state(guesses, guesses->scratch.data[i], column));
    if (thread != TN_NO_STATE)
        set_add(guesses, tn_guesses_state(guesses, tn_operand_mark(&guesses->a, thread), column));
    return set_end(guesses);
}

uint32_t tn_guesses_end_running(tn_guesses *guesses, uint32_t running)
{
    size_t size = running == TN_NO_GUESSES ? 0 : set_members(guesses, running);
    set_begin(guesses);
    for (size_t i = 0; i < size; i++)
        set_add(guesses, tn_operand_mark(&guesses->a, guesses->scratch.data[i]));
    return set_end(guesses);
}
