/* How many plans of a library rules match that are no clauses of it.
 *
 * Such a rule may tell trays apart that the clauses do not. So the library's automata are taken over to the classes
 * that clauses and rules need together: each of those lies in one class of the library.
 */
#include <stdlib.h>

#include "runtime/plan/library/library.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/match/lower.h"

/* Those of the library's clauses and the functions. */
static tn_status joint_classes(const tn_library *library, const uint32_t *functions, size_t count, tn_classes **classes,
                               tn_error *error)
{
    size_t clauses = library->record->clause_count;
    uint32_t *all = malloc((clauses + count + 1) * sizeof *all);
    if (!all)
        return tn_fail_memory(error);
    for (size_t i = 0; i < clauses; i++)
        all[i] = tn_library_clause(library, i)->holds;
    for (size_t i = 0; i < count; i++)
        all[clauses + i] = functions[i];
    tn_status status = tn_classes_new(library->schema, all, clauses + count, classes, error);
    free(all);
    return status;
}

tn_status tn_library_reletter(const tn_library *library, const tn_sparse *sparse, const tn_classes *classes,
                              const tn_tray *map, tn_sparse **out, tn_error *error)
{
    tn_sparse *copy = NULL;
    tn_status status = tn_sparse_copy(sparse, &copy, error);
    if (status != TN_OK)
        return status;
    uint32_t *column = malloc(((size_t)classes->count + 1) * sizeof *column);
    if (!column) {
        tn_sparse_free(copy);
        return tn_fail_memory(error);
    }
    for (uint32_t c = 0; c < classes->count; c++) {
        tn_tray tray = classes->representative[c];
        column[c] = copy->column[tn_class_of(library->classes, map ? map[tray] : tray)];
    }
    free(copy->column);
    copy->column = column;
    copy->letters = classes->count;
    *out = copy;
    return TN_OK;
}

/* matched: how many plans of the library's lengths an automaton and a rule's both accept; negative past a limit. */
static tn_status count_both(const tn_library *library, const tn_classes *classes, const tn_sparse *plans,
                            const tn_dfa *rule, mpz_t matched, tn_error *error)
{
    tn_bounds bounds = tn_library_bounds(library);
    tn_status status = tn_count_both(plans, rule, TN_DFA_AND, classes->size, library->min, library->max, "library",
                                     &bounds, matched, error);
    if (status == TN_LIMIT)
        mpz_set_si(matched, -1);
    return status == TN_LIMIT ? TN_OK : status;
}

static tn_status count_function(const tn_library *library, tn_lowering *lowering, const tn_classes *classes,
                                tn_sparse *const *plans, uint32_t function, mpz_t *matched, tn_error *error)
{
    tn_dfa *rule = NULL;
    tn_status status = tn_lower(lowering, function, &rule, error);
    if (status == TN_LIMIT) {
        mpz_set_si(matched[0], -1);
        mpz_set_si(matched[1], -1);
        return TN_OK;
    }
    for (int i = 0; status == TN_OK && i < 2; i++)
        status = count_both(library, classes, plans[i], rule, matched[i], error);
    tn_dfa_free(rule);
    return status;
}

tn_status tn_library_matches(const tn_library *library, const uint32_t *functions, size_t count, mpz_t *matched,
                             tn_error *error)
{
    tn_classes *classes = NULL;
    tn_lowering *lowering = NULL;
    tn_sparse *plans[2] = {NULL, NULL};
    tn_status status = joint_classes(library, functions, count, &classes, error);
    if (status == TN_OK)
        status = tn_lowering_new(classes, library->max_states, &lowering, error);
    if (status == TN_OK)
        tn_lowering_within(lowering, library->max);
    if (status == TN_OK)
        status = tn_library_reletter(library, library->generator, classes, NULL, &plans[0], error);
    if (status == TN_OK)
        status = tn_library_reletter(library, library->live, classes, NULL, &plans[1], error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = count_function(library, lowering, classes, plans, functions[i], matched + 2 * i, error);
    for (int i = 0; i < 2; i++)
        tn_sparse_free(plans[i]);
    tn_lowering_free(lowering);
    tn_classes_free(classes);
    return status;
}
