/* Lexicase selection (Spector 2012): of all members those that are the best in a case drawn at random, of these those
 * that are the best in another, and so on, until one is left or all cases are through; then one of them is drawn.
 *
 * Epsilon-lexicase (La Cava et al. 2016, semi-dynamic) also keeps who is within epsilon of the best of those left: in
 * each case the median distance of the members' errors from their median.
 */
#ifndef TARTAN_GENOME_BREEDING_LEXICASE_H
#define TARTAN_GENOME_BREEDING_LEXICASE_H

#include "runtime/base/error.h"
#include "runtime/genome/breeding/chance.h"

#define TN_LEXICASE_ERRORS_MAX ((size_t)1 << 27) /* errors of all members in all cases */

typedef struct tn_lexicase {
    size_t members, cases;
    double *errors;    /* owned: [case][member] */
    double *epsilons;  /* owned: [case]; 0 without epsilon */
    uint32_t *scratch; /* owned: [thread][members + cases] */
    unsigned threads;
} tn_lexicase;

/* TN_LIMIT (E1240) where there are too many errors, TN_MEMORY. Clear it in any case. */
tn_status tn_lexicase_new(size_t members, size_t cases, unsigned threads, tn_lexicase *lexicase, tn_error *error);
void tn_lexicase_clear(tn_lexicase *lexicase);

/* Takes the errors of a member, as many as there are cases. By several threads at once, each with other members. */
void tn_lexicase_put(tn_lexicase *lexicase, size_t member, const double *errors);

/* Once all are there: finds the epsilons. TN_MEMORY, or TN_OK. */
tn_status tn_lexicase_find_epsilons(tn_lexicase *lexicase, tn_error *error);

/* Draws a member. */
size_t tn_lexicase_select(const tn_lexicase *lexicase, unsigned thread, tn_chance *chance);

#endif
