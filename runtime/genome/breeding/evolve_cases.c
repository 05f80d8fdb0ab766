/* The errors of a generation's members in single cases. They are not stored: a run that is made again recalls who the
 * parents were, and finds the errors only of the members that it goes on with. */
#include <math.h>
#include <stdlib.h>

#include "runtime/genome/breeding/evolve_state.h"

static tn_status find_errors(void *context, unsigned thread, size_t item, tn_error *error)
{
    tn_evolution *e = context;
    const tn_individual *member = e->members[item];
    double *errors = malloc(e->evaluator.cases * sizeof *errors);
    if (!errors)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    for (size_t i = 0; i < e->evaluator.cases; i++)
        errors[i] = HUGE_VAL;
    if (member->score.state == TN_SCORED)
        status = e->evaluator.evaluate_cases(e->evaluator.context, thread, member->sentence, member->sentence_size,
                                             errors, error);
    if (status == TN_OK)
        tn_lexicase_put(&e->lexicase, item, errors);
    free(errors);
    return status;
}

tn_status tn_evolution_find_cases(tn_evolution *e, tn_error *error)
{
    uint64_t parents[2];
    tn_selection selection = e->settings.select.selection;
    tn_lexicase_clear(&e->lexicase);
    if ((selection != TN_SELECT_LEXICASE && selection != TN_SELECT_EPSILON_LEXICASE) || e->chosen)
        return TN_OK;
    if (e->recall_parents && e->recall_parents(e->recall_context, e->born[0]->id, parents))
        return TN_OK;
    tn_status status = tn_lexicase_new(e->member_count, e->evaluator.cases, e->threads, &e->lexicase, error);
    if (status == TN_OK)
        status = tn_crew_run(e->crew, e->member_count, 8, find_errors, e, error);
    if (status == TN_OK && selection == TN_SELECT_EPSILON_LEXICASE)
        status = tn_lexicase_find_epsilons(&e->lexicase, error);
    return status;
}
