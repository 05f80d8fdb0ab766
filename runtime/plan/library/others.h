/* A library's clauses in a row, for asking what the others leave where one decides otherwise.
 *
 * Only clause i, applied as number i, keeps out what the clauses before it keep, it does not, and those after it keep.
 * So each answer starts from an automaton that is needed anyway, and goes on with other plans than the library's: an
 * automaton of its own a clause. Most are soon smaller, and of hundreds of prunes most run empty early. What the
 * clauses after it keep is combined beforehand where that is small (sequence.h).
 *
 * Borrows the library; owns the rest. Once made it is only read, so that threads may share it.
 */
#ifndef TARTAN_PLAN_LIBRARY_OTHERS_H
#define TARTAN_PLAN_LIBRARY_OTHERS_H

#include "runtime/plan/library/library_data.h"
#include "runtime/plan/library/sequence.h"

struct tn_others {
    const tn_library *library;
    bool within;          /* only plans of the library's lengths are looked at */
    size_t *order;        /* [applied_count]: the clauses as they are applied here */
    size_t *place;        /* [clause_count]: of each clause in `order`, or SIZE_MAX */
    tn_bounds bounds;     /* of putting them in a row */
    tn_bounds each;       /* of an answer */
    tn_sequence sequence; /* of the clauses in that order */
};

/* Are the plans bounded without the library's lengths too (by totals)? Then what is asked is asked within them at once,
 * since that takes no more states. */
bool tn_others_bounded(const tn_library *library);

/* Puts the clauses in a row. The library keeps what is made (library->late) and frees it. TN_LIMIT (E0802). */
tn_status tn_others_make(const tn_library *library, bool within, const tn_others **others, tn_error *error);
void tn_others_free(tn_others *others);

/* *plans := what the clause applied as this number keeps out and all others keep; the caller's. */
tn_status tn_others_alone(const tn_others *others, size_t number, tn_sparse **plans, tn_error *error);

/* How many plans of the library's lengths that is. First the plans that the clause drops are taken apart by the clauses
 * that drop most of them, which is quick of clauses that alone keep out little; else the last automaton is not made. */
tn_status tn_others_count_alone(const tn_others *others, size_t number, mpz_t count, tn_error *error);

/* *left := these plans that all clauses keep but the `skipped` ones ([clause_count]); the caller's. */
tn_status tn_others_left(const tn_others *others, const bool *skipped, const tn_dfa *plans, tn_sparse **left,
                         tn_error *error);

/* How many of these plans all clauses keep but the `skipped` ones ([clause_count]). */
tn_status tn_others_count(const tn_others *others, const bool *skipped, const tn_dfa *plans, mpz_t count,
                          tn_error *error);

#endif
