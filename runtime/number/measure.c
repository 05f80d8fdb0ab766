#include "runtime/number/measure.h"

#include <math.h>
#include <string.h>

#include "runtime/base/numeric.h"
#include "runtime/growth/model/records.h"
#include "runtime/module/code.h"

static double of_one(tn_opcode opcode, double a)
{
    switch (opcode) {
    case TN_OP_NEGATE:
        return -a;
    case TN_OP_ABSOLUTE:
        return fabs(a);
    case TN_OP_ROOT:
        return sqrt(a);
    case TN_OP_SQUARE:
        return a * a;
    case TN_OP_EXPONENTIAL:
        return tn_exp(a);
    default:
        return tn_log(a);
    }
}

/* What has no value has none in the smaller or larger of two either. */
static double of_two(tn_opcode opcode, double a, double b)
{
    switch (opcode) {
    case TN_OP_ADD:
        return a + b;
    case TN_OP_SUBTRACT:
        return a - b;
    case TN_OP_MULTIPLY:
        return a * b;
    case TN_OP_DIVIDE:
        return a / b;
    case TN_OP_LEAST:
        return isnan(a) || a < b ? a : b;
    default:
        return isnan(a) || a > b ? a : b;
    }
}

double tn_measure_run(const uint8_t *code, uint32_t offset, const double *terms)
{
    double stack[TN_MEASURE_STACK_MAX], number;
    size_t height = 0;
    for (;;) {
        tn_instruction i = tn_code_read(code, offset);
        offset += i.length;
        switch (i.opcode) {
        case TN_OP_VALUE:
            return stack[0];
        case TN_OP_NUMBER:
            memcpy(&number, &i.first, sizeof number);
            stack[height++] = number;
            break;
        case TN_OP_TERM:
            stack[height++] = terms[i.first];
            break;
        default:
            if (tn_code_effect((uint8_t)i.opcode).pops == 1) {
                stack[height - 1] = of_one(i.opcode, stack[height - 1]);
            } else {
                height--;
                stack[height - 1] = of_two(i.opcode, stack[height - 1], stack[height]);
            }
            break;
        }
    }
}
