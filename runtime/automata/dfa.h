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
    uint32_t longest; /* letters of the longest word that is asked about (see below); 0: words of any length are */
    uint32_t letters; /* of the alphabet, if there is a longest word: an automaton with one more has a marker */
    tn_watch *watch;  /* or NULL: gives up (TN_STOPPED) once this says so */
} tn_bounds;

/* The defaults for everything but the states: 64 M transitions and as many words (256 MB each), 2 G steps (a minute at
 * most). */
tn_bounds tn_bounds_make(uint32_t max_states);

/* Counts work and compares what a construction has reached with the bounds: TN_OK, or E0802 saying that `what` passed
 * them; or TN_STOPPED. */
tn_status tn_bounds_check(tn_bounds *bounds, const char *what, uint64_t states, uint64_t columns, uint64_t work,
                          tn_error *error);

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

/* ---- short words
 *
 * If only words up to a length are asked about (`longest` of tn_bounds), automata become cover automata (Campeanu,
 * Santean, Yu: Minimal cover-automata for finite languages, 2001): a construction goes on from a state only while a
 * word that leads there may have another letter, and what it makes is merged as far as short words do not tell apart
 * (cover.c). A counter then needs no states for numbers that no short word reaches, nor for those whose outcome the
 * letters that may still come cannot change. Markers (marked.h) are no letters here. Of longer words such an automaton
 * may say anything. */

/* How many letters the shortest words have that lead to the states of a construction, which finds them breadth first.
 * All words that lead to a live state have as many markers (marked.h), so that a state is first found by a word with
 * the fewest letters. Zero it, and free with tn_depth_clear. */
typedef struct tn_depth {
    uint32_t longest; /* letters of a word; 0: any number, and nothing is kept */
    uint32_t marker;  /* its column, or TN_NO_STATE */
    uint32_t *letters;
    uint32_t count;
    size_t capacity;
} tn_depth;

/* column: of each letter that the construction reads. False: out of memory. */
bool tn_depth_begin(tn_depth *depth, const tn_bounds *bounds, const uint32_t *column, uint32_t letters);
void tn_depth_clear(tn_depth *depth);

/* Does no word matter that goes on from the state by this column? Then it may lead anywhere. */
static inline bool tn_depth_over(const tn_depth *depth, uint32_t state, uint32_t column)
{
    return depth->longest > 0 && column != depth->marker && depth->letters[state] >= depth->longest;
}

bool tn_depth_add(tn_depth *depth, uint32_t letters);

/* A column of one state leads to another: new ones have the next number. False: out of memory. */
static inline bool tn_depth_found(tn_depth *depth, uint32_t from, uint32_t column, uint32_t to)
{
    return depth->longest == 0 || to < depth->count ||
           tn_depth_add(depth, depth->letters[from] + (column != depth->marker));
}

/* As tn_dfa_minimise from state 0, or, if the bounds say how long words are, an automaton with as few states or fewer
 * that accepts the same of those words. */
tn_status tn_cover_minimise(const tn_dfa *dfa, tn_bounds *bounds, tn_dfa **out, tn_error *error);

#endif
