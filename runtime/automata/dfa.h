/* Deterministic complete automata over letters, the fast engine's one data structure.
 *
 * Letters are numbers from 0; what they stand for, the caller knows (for rules about plans: classes of trays). An
 * automaton of a relation (marked.h) has one letter more, the marker. Letters that an automaton does not tell apart
 * share a column: a rule that looks at one thing has two or three columns however many letters the other rules of its
 * file make, so small rules stay small in big rule sets. Products run over the distinct pairs of columns.
 *
 * A tn_dfa is counted: tn_dfa_share adds a holder, tn_dfa_free gives one up. It belongs to one thread while it is being
 * shared; reading is free for all. State 0 is the start. What the minimising functions return is minimal and canonical:
 * states numbered breadth first, columns in the order of their first letter, so that equal languages give equal arrays.
 */
#ifndef TARTAN_AUTOMATA_DFA_H
#define TARTAN_AUTOMATA_DFA_H

#include "runtime/base/watch.h"

#define TN_NO_STATE UINT32_MAX

typedef struct tn_dfa {
    uint32_t uses;
    uint32_t letters;
    uint32_t columns;
    uint32_t states;
    uint32_t *column; /* [letters] */
    uint32_t *delta;  /* [states][columns] */
    uint8_t *accept;  /* [states], 0 or 1 */
} tn_dfa;

/* What constructing automata may cost, and how much it has cost so far. Work is counted, not timed, so that the same
 * rules pass or fail on every machine. */
typedef struct tn_bounds {
    uint32_t max_states;      /* of any intermediate automaton */
    uint64_t max_transitions; /* states times columns of any intermediate automaton */
    uint64_t max_words;       /* of 32 bits, in the sets that name the states of a subset construction */
    uint64_t max_work;        /* elementary steps in all */
    uint64_t work;
    uint32_t longest; /* constructions may be wrong of words with more letters, and so need fewer states; 0: of none */
    tn_watch *watch;  /* or NULL: gives up (TN_STOPPED) once this says so */
} tn_bounds;

/* The defaults for everything but the states: 64 M transitions and as many words (256 MB each), 2 G steps (a minute at
 * most). */
tn_bounds tn_bounds_make(uint32_t max_states);

/* Counts work and compares what a construction has reached with the bounds: TN_OK, or E0802 saying that `what` passed
 * them; or TN_STOPPED. */
tn_status tn_bounds_check(tn_bounds *bounds, const char *what, uint64_t states, uint64_t columns, uint64_t work,
                          tn_error *error);

/* The layers in which a construction finds its states: those of a layer are as many letters from the start. */
typedef struct tn_depth {
    uint32_t to_go; /* layers behind this one */
    uint32_t end;   /* of this one: its last state + 1 */
} tn_depth;

static inline tn_depth tn_depth_begin(const tn_bounds *bounds)
{
    return (tn_depth){bounds->longest ? bounds->longest : UINT32_MAX, 1};
}

/* The state is the next to be gone on from, and `count` are found. Is whatever follows it too long? Then it may lead to
 * itself. */
static inline bool tn_depth_over(tn_depth *depth, uint32_t state, uint32_t count)
{
    if (state == depth->end) {
        depth->end = count;
        depth->to_go--;
    }
    return depth->to_go == 0;
}

/* Room for an automaton, zeroed, one holder; NULL where out of memory. */
tn_dfa *tn_dfa_new(uint32_t letters, uint32_t columns, uint32_t states);
tn_dfa *tn_dfa_share(tn_dfa *dfa);
void tn_dfa_free(tn_dfa *dfa);

static inline uint32_t tn_dfa_read(const tn_dfa *dfa, uint32_t state, uint32_t letter)
{
    return dfa->delta[(size_t)state * dfa->columns + dfa->column[letter]];
}

/* The state that accepts nothing (accepting = 0), or everything (1), of a minimal automaton; TN_NO_STATE where there is
 * none. */
uint32_t tn_dfa_sink(const tn_dfa *dfa, uint8_t accepting);

/* Same language? Both canonical, over the same letters. */
bool tn_dfa_equal(const tn_dfa *a, const tn_dfa *b);

/* The automaton that accepts everything or nothing. */
tn_status tn_dfa_constant(uint32_t letters, bool everything, tn_dfa **out, tn_error *error);

/* A copy of what is reached from `start`, equal columns merged and everything numbered canonically. */
tn_status tn_dfa_tidy(const tn_dfa *dfa, uint32_t start, tn_dfa **out, tn_error *error);

/* The minimal canonical automaton of what `dfa` accepts from state `start`; unreachable states are dropped. */
tn_status tn_dfa_minimise(const tn_dfa *dfa, uint32_t start, tn_dfa **out, tn_error *error);

/* The opposite language; as minimal as its operand. */
tn_status tn_dfa_complement(const tn_dfa *dfa, tn_dfa **out, tn_error *error);

typedef enum tn_dfa_operation { TN_DFA_AND, TN_DFA_OR, TN_DFA_MINUS } tn_dfa_operation;

/* Both, either, or the first without the second; minimal. `what` names the construction in an error. */
tn_status tn_dfa_product(const tn_dfa *a, const tn_dfa *b, tn_dfa_operation operation, const char *what,
                         tn_bounds *bounds, tn_dfa **out, tn_error *error);

/* The coarsest columns that refine those of several automata. */
typedef struct tn_join {
    uint32_t letters;
    uint32_t columns;
    uint32_t parts;
    uint32_t *column; /* [letters] */
    uint32_t *pick;   /* [columns][parts]: the part's column */
    uint32_t *letter; /* [columns]: the first letter */
} tn_join;

/* Joins the first `letters` letters of `parts` automata. `extra` (or NULL) says of each letter what else tells it
 * apart. The last letter gets a column of its own where `apart`. Free with tn_join_clear, also after a failure. */
tn_status tn_join_make(tn_join *join, const tn_dfa *const *parts, uint32_t count, uint32_t letters,
                       const uint32_t *extra, bool apart, tn_error *error);
void tn_join_clear(tn_join *join);

#endif
