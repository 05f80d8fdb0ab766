/* Who has children: orders of merit and draws from them. Lower objectives are better; infinity is the worst. */
#ifndef TARTAN_GENOME_BREEDING_SELECT_H
#define TARTAN_GENOME_BREEDING_SELECT_H

#include <stddef.h>

#include "runtime/base/error.h"
#include "runtime/genome/breeding/chance.h"

#define TN_OBJECTIVES_MAX 8u

typedef enum tn_selection {
    TN_SELECT_TOURNAMENT, /* the best of some drawn at random */
    TN_SELECT_TRUNCATION, /* any of the best share */
    TN_SELECT_ROULETTE,   /* in proportion to how much better than the worst */
    TN_SELECT_NSGA2,      /* tournament by front and crowding; survivors likewise, of parents and children together */
    TN_SELECT_LEXICASE,   /* the best in a random case, of these the best in another, and so on */
    TN_SELECT_EPSILON_LEXICASE, /* likewise, where errors that differ little count as equal */
    TN_SELECT_COUNT
} tn_selection;

/* One individual's merit, as orders compare it: by front, then crowding (more room is better), then objective 0, then
 * index. With one objective, front is 0 and room 0 for all. */
typedef struct tn_merit {
    const double *objectives;
    double violation; /* 0 if all that is required is met */
    uint32_t front;
    double room;
    uint32_t index;
} tn_merit;

/* Fills front and room of each: nondominated sorting and crowding distance (Deb et al., 2002), with constrained
 * domination (the same, section VI): of two with unlike violations the one with the smaller dominates. Quadratic in
 * count. `scratch` has room for 3 * count numbers. */
void tn_nsga2(tn_merit *merits, size_t count, size_t objectives, uint32_t *scratch);

/* Sorts the best to the front. */
void tn_merit_sort(tn_merit *merits, size_t count);

typedef struct tn_select_options {
    tn_selection selection;
    uint32_t tournament; /* how many are drawn */
    double truncation;   /* the share of the best */
} tn_select_options;

/* Draws a place in an order of merit (0 is the best). */
size_t tn_select(const tn_select_options *options, tn_chance *chance, const tn_merit *sorted, size_t count);

/* Lexicase selection (Spector 2012): of all members those that are the best in a case drawn at random, of these those
 * that are the best in another, and so on, until one is left or all cases are through; then one of them is drawn.
 *
 * Epsilon-lexicase (La Cava et al. 2016, semi-dynamic) also keeps who is within epsilon of the best of those left: in
 * each case the median distance of the members' errors from their median. */

#define TN_LEXICASE_ERRORS_MAX ((size_t)1 << 27) /* errors of all members in all cases */

typedef struct tn_lexicase {
    size_t members, cases;
    double *errors;    /* owned: [case][member] */
    double *epsilons;  /* owned: [case]; 0 without epsilon */
    uint32_t *scratch; /* owned: [thread][members + cases] */
    unsigned threads;
} tn_lexicase;

/* TN_LIMIT (E1240) if there are too many errors, TN_MEMORY. Clear it in any case. */
tn_status tn_lexicase_new(size_t members, size_t cases, unsigned threads, tn_lexicase *lexicase, tn_error *error);
void tn_lexicase_clear(tn_lexicase *lexicase);

/* Takes the errors of a member, as many as there are cases. By several threads at once, each with other members. */
void tn_lexicase_put(tn_lexicase *lexicase, size_t member, const double *errors);

/* Once all are there: finds the epsilons. TN_MEMORY, or TN_OK. */
tn_status tn_lexicase_find_epsilons(tn_lexicase *lexicase, tn_error *error);

/* Draws a member. */
size_t tn_lexicase_select(const tn_lexicase *lexicase, unsigned thread, tn_chance *chance);

#endif
