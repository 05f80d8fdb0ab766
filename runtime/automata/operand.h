/* An automaton of marked words (marked.h) made ready to be read by a subset construction: which phase each state is in,
 * which state is dead, and which states accept less than others.
 *
 * An operand borrows its automaton; clear it after use. It belongs to one thread.
 */
#ifndef TARTAN_AUTOMATA_OPERAND_H
#define TARTAN_AUTOMATA_OPERAND_H

#include "runtime/automata/dfa.h"
#include "runtime/automata/numbering.h"

/* Inclusion is decided for all pairs of states of automata up to this many states: 2,048 squared bits are half a
 * megabyte. */
#define TN_INCLUSION_STATES 2048u

typedef struct tn_operand {
    const tn_dfa *dfa;
    uint32_t dead;       /* TN_NO_STATE: none */
    uint32_t everything; /* the state after both markers that accepts whatever follows; TN_NO_STATE: none */
    uint32_t marker;     /* the marker's column */
    uint8_t *phase;      /* [states]: how many markers have been read; of the dead state: 3 */
    bool compared;       /* have inclusions been looked for? */
    uint64_t *exceeds;   /* [states][words]: bit q of row p: p accepts what q does not. NULL: too many states */
    uint32_t words;
    uint32_t *above_first; /* [states + 1]: where each state's part of `above` begins. NULL: too many states */
    uint32_t *above;       /* the other states that accept whatever the state accepts */
} tn_operand;

/* dfa: a minimal automaton of marked words. */
tn_status tn_operand_make(tn_operand *operand, const tn_dfa *dfa, tn_error *error);
void tn_operand_clear(tn_operand *operand);

static inline uint32_t tn_operand_mark(const tn_operand *operand, uint32_t state)
{
    return operand->dfa->delta[(size_t)state * operand->dfa->columns + operand->marker];
}

static inline uint32_t tn_operand_read(const tn_operand *operand, uint32_t state, uint32_t column)
{
    return operand->dfa->delta[(size_t)state * operand->dfa->columns + column];
}

/* Does q accept whatever p accepts, as far as is known (states of one phase)? */
static inline bool tn_operand_below(const tn_operand *operand, uint32_t p, uint32_t q)
{
    if (p == q)
        return true;
    return operand->exceeds && operand->phase[p] == operand->phase[q] &&
           !(operand->exceeds[(size_t)p * operand->words + q / 64] >> (q % 64) & 1);
}

/* Looks for inclusions, once; false where out of memory. */
bool tn_operand_compare(tn_operand *operand);

/* A set of pairs of states, of one operand or (second NULL: all zero) two, that stands for a state of a subset
 * construction. */
typedef struct tn_pairs {
    tn_operand *first, *second;
    uint64_t *data; /* first state << 32 | second */
    size_t size, capacity;
    uint64_t effort; /* steps spent on canonical forms */
    bool failed;     /* out of memory */
} tn_pairs;

/* Adds a pair unless one of its states is dead. */
void tn_pairs_add(tn_pairs *pairs, uint32_t first, uint32_t second);

/* Sorts, drops doubles, and drops each pair that accepts no more than another one does (an antichain: De Wulf, Doyen,
 * Henzinger, Raskin: Antichains, 2006): the union's language is the same and many sets become one. Then appends the
 * pairs to the key, two words each. */
bool tn_pairs_write(tn_pairs *pairs, tn_key *key);
void tn_pairs_clear(tn_pairs *pairs);

#endif
