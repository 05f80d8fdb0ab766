/* Runs decisions of which only a part is known. */
#include "runtime/house/rule/outcome.h"

static tn_outcome both(tn_outcome a, tn_outcome b)
{
    if (a == TN_OUTCOME_FALSE || b == TN_OUTCOME_FALSE)
        return TN_OUTCOME_FALSE;
    return a == TN_OUTCOME_TRUE && b == TN_OUTCOME_TRUE ? TN_OUTCOME_TRUE : TN_OUTCOME_OPEN;
}

static tn_outcome denied(tn_outcome a)
{
    return a == TN_OUTCOME_OPEN ? TN_OUTCOME_OPEN : a == TN_OUTCOME_TRUE ? TN_OUTCOME_FALSE : TN_OUTCOME_TRUE;
}

tn_outcome tn_outcome_decide(const tn_module *module, uint32_t function, tn_outcome_ask *ask, const void *context)
{
    tn_outcome stack[TN_DECISION_STACK_MAX];
    size_t depth = 0;
    for (uint32_t at = module->FUNCTION_records[function].code_begin;;) {
        tn_instruction op = tn_code_read(module->code, at);
        at += op.length;
        switch (op.opcode) {
        case TN_OP_ALL_OF:
            depth--;
            stack[depth - 1] = both(stack[depth - 1], stack[depth]);
            break;
        case TN_OP_ONE_OF:
            depth--;
            stack[depth - 1] = denied(both(denied(stack[depth - 1]), denied(stack[depth])));
            break;
        case TN_OP_NONE_OF:
            stack[depth - 1] = denied(stack[depth - 1]);
            break;
        case TN_OP_DECIDE:
            return stack[depth - 1];
        default:
            stack[depth++] = ask(context, &op);
        }
    }
}
