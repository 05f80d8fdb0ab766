/* The errors of a generation's members in single cases. A run that is made again recalls who the parents were, and
 * finds the errors only of the members that it goes on with: those that no score holds are not stored. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    bool scored = member->score.state == TN_SCORED, held = !e->evaluator.evaluate_cases;
    for (size_t i = 0; scored && held && i < e->evaluator.cases; i++)
        errors[i] = member->score.objectives[e->evaluator.objectives + i];
    if (scored && !held)
        status = e->evaluator.evaluate_cases(e->evaluator.context, thread, member->sentence, member->sentence_size,
                                             errors, error);
    if (status == TN_OK)
        tn_lexicase_put(&e->lexicase, item, errors);
    free(errors);
    return status;
}

/* ---- with other ranks: of each member its number, then its errors */

static size_t errors_size(const void *context, size_t item)
{
    const tn_evolution *e = context;
    (void)item;
    return sizeof item + e->evaluator.cases * sizeof(double);
}

static uint8_t *write_errors(const void *context, size_t item, uint8_t *end)
{
    const tn_lexicase *lexicase = &((const tn_evolution *)context)->lexicase;
    memcpy(end, &item, sizeof item);
    end += sizeof item;
    for (size_t i = 0; i < lexicase->cases; i++, end += sizeof(double))
        memcpy(end, &lexicase->errors[i * lexicase->members + item], sizeof(double));
    return end;
}

static const uint8_t *read_errors(void *context, const uint8_t *bytes)
{
    tn_lexicase *lexicase = &((tn_evolution *)context)->lexicase;
    size_t item;
    memcpy(&item, bytes, sizeof item);
    bytes += sizeof item;
    for (size_t i = 0; i < lexicase->cases; i++, bytes += sizeof(double))
        memcpy(&lexicase->errors[i * lexicase->members + item], bytes, sizeof(double));
    return bytes;
}

static tn_status find_all(tn_evolution *e, tn_status status, tn_error *error)
{
    const tn_shared_work work = {.context = e,
                                 .items = e->member_count,
                                 .work = find_errors,
                                 .size = errors_size,
                                 .write = write_errors,
                                 .read = read_errors};
    if (tn_ranks_several(e->settings.ranks))
        return tn_evolution_share(e, status, &work, error);
    if (status == TN_OK)
        status = tn_crew_run(e->crew, e->member_count, 8, find_errors, e, error);
    return status;
}

tn_status tn_evolution_find_cases(tn_evolution *e, tn_status status, tn_error *error)
{
    uint64_t parents[2];
    tn_selection selection = e->settings.select.selection;
    tn_lexicase_clear(&e->lexicase);
    if ((selection != TN_SELECT_LEXICASE && selection != TN_SELECT_EPSILON_LEXICASE) || e->chosen)
        return status;
    if (e->recall_parents && e->recall_parents(e->recall_context, e->born[0]->id, parents))
        return status;
    if (status == TN_OK)
        status = tn_lexicase_new(e->member_count, e->evaluator.cases, e->threads, &e->lexicase, error);
    status = find_all(e, status, error);
    if (status == TN_OK && selection == TN_SELECT_EPSILON_LEXICASE)
        status = tn_lexicase_find_epsilons(&e->lexicase, error);
    return status;
}
