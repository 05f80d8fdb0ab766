/* Guesses about which places of a stretch [x, y) are in a relation, while the plan is read from left to right.
 *
 * Whether a place counts may depend on what comes after it, even after y (the relation may look at the whole plan). So
 * for each place read so far the set of states is kept that the relation's automaton may be in if that place is
 * guessed; equal sets have equal futures. Sets are numbers. A tn_guesses borrows its automaton and join; clear it after
 * use.
 */
#ifndef TARTAN_AUTOMATA_GUESSES_H
#define TARTAN_AUTOMATA_GUESSES_H

#include "runtime/automata/marked.h"
#include "runtime/automata/operand.h"

#define TN_NO_GUESSES UINT32_MAX /* the empty set */

typedef struct tn_guesses {
    tn_tally tally;
    const tn_join *join; /* whose columns are read */
    uint32_t part;       /* which part of the join the automaton is */
    tn_operand a;
    tn_interner sets; /* of states of a */
    tn_pairs members; /* of the set being built */
    tn_key scratch, words;
    uint64_t effort;
    bool failed; /* out of memory */
} tn_guesses;

tn_status tn_guesses_make(tn_guesses *guesses, const tn_dfa *dfa, tn_tally tally, const tn_join *join, uint32_t part,
                          tn_error *error);
void tn_guesses_clear(tn_guesses *guesses);

/* The state after one more tray. */
static inline uint32_t tn_guesses_state(const tn_guesses *guesses, uint32_t state, uint32_t column)
{
    return tn_operand_read(&guesses->a, state,
                           guesses->join->pick[(size_t)column * guesses->join->parts + guesses->part]);
}

/* A set after one more tray. Inside of what is counted, guesses of TALLY_STARTS that are under way may end. */
uint32_t tn_guesses_read(tn_guesses *guesses, uint32_t set, bool inside, uint32_t column);

/* A set without the guesses that are under way (at y: they would end too late). */
uint32_t tn_guesses_ended(tn_guesses *guesses, uint32_t set);

/* The set of the place that the tray just read makes, guessed to start before it (singles: and to end after it).
 * thread: the automaton's state before that tray, or TN_NO_STATE. */
uint32_t tn_guesses_new(tn_guesses *guesses, uint32_t thread, uint32_t column);

/* TALLY_ENDS: the guesses under way after one more tray, with the one that starts before it. */
uint32_t tn_guesses_running(tn_guesses *guesses, uint32_t running, uint32_t thread, uint32_t column);

/* TALLY_ENDS: the place where the guesses under way end. */
uint32_t tn_guesses_end_running(tn_guesses *guesses, uint32_t running);

/* Does the place count if the plan ends here; does it count whatever follows? */
bool tn_guesses_accept(const tn_guesses *guesses, uint32_t set);
bool tn_guesses_certain(const tn_guesses *guesses, uint32_t set);

#endif
