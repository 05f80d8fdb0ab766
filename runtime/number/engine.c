/* Verifies the code of expressions: what they may hold at once. */
#include "runtime/module/engine.h"
#include "runtime/number/run.h"

static tn_status verify_function(const tn_checker *checker, uint32_t function)
{
    if (checker->module->FUNCTION_records[function].stack_max > TN_MEASURE_STACK_MAX)
        return tn_refuse(checker, "an expression's stack passes %u", TN_MEASURE_STACK_MAX);
    return TN_OK;
}

static tn_status check_term(const tn_checker *checker, const tn_instruction *instruction)
{
    const tn_engine *engine =
        tn_engine_of_terms(checker->engines, checker->module->FUNCTION_records[checker->record].kind);
    if (!engine || instruction->first >= engine->term_count)
        return tn_refuse(checker, "nothing of this number is measured");
    return TN_OK;
}

static void list_term(tn_lister *lister, const tn_instruction *instruction)
{
    const tn_engine *engine =
        tn_engine_of_terms(lister->engines, lister->module->FUNCTION_records[lister->function].kind);
    fputs(engine->terms[instruction->first], lister->out);
}

static const tn_operand_rules operands[] = {{TN_OPERANDS_TERM, check_term, list_term}};

extern const tn_engine tn_engine_number;
const tn_engine tn_engine_number = {.name = "number",
                                    .codes = 1u << TN_CODE_MEASURE,
                                    .operands = operands,
                                    .operand_count = sizeof operands / sizeof *operands,
                                    .verify_function = verify_function};
