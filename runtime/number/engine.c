/* Verifies the code of expressions: what they may hold at once. */
#include "runtime/module/engine.h"
#include "runtime/number/run.h"

static tn_status verify_function(const tn_checker *checker, uint32_t function)
{
    if (checker->module->FUNCTION_records[function].stack_max > TN_MEASURE_STACK_MAX)
        return tn_refuse(checker, "an expression's stack passes %u", TN_MEASURE_STACK_MAX);
    return TN_OK;
}

extern const tn_engine tn_engine_number;
const tn_engine tn_engine_number = {
    .name = "number", .codes = 1u << TN_CODE_MEASURE, .verify_function = verify_function};
