/* Measures that no plan has a value of: what a value needs holds of no plan. */
#include "runtime/plan/measure/never.h"

#include "runtime/plan/match/lower.h"
#include "runtime/plan/schema/sum.h"

static bool accepts_nothing(const tn_dfa *dfa)
{
    for (uint32_t s = 0; s < dfa->states; s++) /* automata are minimal: every state is reached */
        if (dfa->accept[s])
            return false;
    return true;
}

static bool holds_of_nothing(const tn_schema *schema, uint32_t function)
{
    tn_classes *classes = NULL;
    tn_lowering *lowering = NULL;
    tn_dfa *dfa = NULL;
    tn_status status = tn_classes_new(schema, &function, 1, &classes, NULL);
    if (status == TN_OK)
        status = tn_lowering_new(classes, 0, &lowering, NULL);
    if (status == TN_OK)
        status = tn_lower(lowering, function, &dfa, NULL);
    bool never = status == TN_OK && accepts_nothing(dfa);
    tn_dfa_free(dfa);
    tn_lowering_free(lowering);
    tn_classes_free(classes);
    return never;
}

bool tn_measure_never(const tn_schema *schema, uint32_t measure)
{
    const tn_module *module = schema->module;
    const tn_sum_record *sum = &module->SUM_records[module->MEASURE_records[measure].sum];
    for (uint32_t i = 0; i < sum->term_count; i++) {
        const tn_term_record *term = &module->TERM_records[sum->term_first + i];
        if (term->kind == TN_SUM_NEEDED && holds_of_nothing(schema, term->part))
            return true;
    }
    return false;
}
