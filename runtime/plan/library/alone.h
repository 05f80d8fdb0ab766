/* What a library's clauses do one by one, as automata: the plans that one alone keeps out, and what the others leave of
 * any plans. All is asked within the library's lengths, and from the automata that the library was combined from.
 *
 * To be asked by one thread at a time.
 */
#ifndef TARTAN_PLAN_LIBRARY_ALONE_H
#define TARTAN_PLAN_LIBRARY_ALONE_H

#include "runtime/automata/sparse.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/schema/classes.h"

/* The classes that the automata of the clauses are over, and the automaton of clause i: the library's. */
const tn_classes *tn_library_classes(const tn_library *library);
tn_dfa *tn_library_automaton(const tn_library *library, uint32_t i);

/* The most states that the automaton of one clause may have. */
uint32_t tn_library_max_states(const tn_library *library);

/* Finds what each clause alone keeps out, all by all threads, and counts it; keeps the automata as far as the memory
 * for that goes. For who will ask about many clauses; to be called before tn_library_effect. */
tn_status tn_library_find_alone(const tn_library *library, tn_error *error);

/* *plans: the plans that clause i keeps out and all others keep. The library's, until this is asked again. TN_LIMIT
 * (E0802) as in tn_library_effect, which has counted them. */
tn_status tn_library_alone(const tn_library *library, uint32_t i, const tn_sparse **plans, tn_error *error);

/* Does clause i alone keep out any plan? Counts, where the automaton is not made already. */
tn_status tn_library_alone_any(const tn_library *library, uint32_t i, bool *any, tn_error *error);

/* How many of these plans, over the library's classes, all clauses keep but the `skipped` ones ([clauses]), which are
 * not asked. TN_LIMIT as above. */
tn_status tn_library_count_without(const tn_library *library, const bool *skipped, const tn_dfa *plans, mpz_t count,
                                   tn_error *error);

/* The shortest of these plans that all clauses keep but the `skipped` ones, and of those the first. *found: is there
 * one? The caller frees *trays. TN_LIMIT as above. */
tn_status tn_library_shortest_without(const tn_library *library, const bool *skipped, const tn_dfa *plans,
                                      tn_tray **trays, size_t *length, bool *found, tn_error *error);

/* The shortest plan that the library keeps and `plans` accepts, in the same way. */
tn_status tn_library_kept_shortest(const tn_library *library, const tn_dfa *plans, tn_tray **trays, size_t *length,
                                   bool *found, tn_error *error);

/* How many plans that the library keeps `plans` accepts. */
tn_status tn_library_count_kept(const tn_library *library, const tn_dfa *plans, mpz_t count, tn_error *error);

/* How many plans that clause i alone keeps out `plans` does not accept. */
tn_status tn_library_count_alone_less(const tn_library *library, uint32_t i, const tn_dfa *plans, mpz_t count,
                                      tn_error *error);

/* The shortest plan that clause i alone keeps out, and of those the first. *found: is there one? The caller frees
 * *trays. */
tn_status tn_library_alone_shortest(const tn_library *library, uint32_t i, tn_tray **trays, size_t *length, bool *found,
                                    tn_error *error);

/* The shortest plan that the requirements leave and prune i matches, in the same way. */
tn_status tn_library_pruned_shortest(const tn_library *library, uint32_t i, tn_tray **trays, size_t *length,
                                     bool *found, tn_error *error);

#endif
