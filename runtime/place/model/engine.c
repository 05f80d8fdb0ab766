/* Verifies and lists the steps of connection grammars. (Their tables, and that productions end, are the grammar
 * engine's.) */
#include <stdlib.h>

#include "runtime/module/engine.h"

/* Sizes keep within their limit, where a move may go farther. */
static tn_status check_vector(const tn_checker *checker, const tn_instruction *instruction)
{
    const tn_vector_record *vector = &checker->module->VECTOR_records[instruction->first];
    bool small = llabs(vector->x) <= TN_PLACE_SIZE_MAX && llabs(vector->y) <= TN_PLACE_SIZE_MAX &&
                 llabs(vector->z) <= TN_PLACE_SIZE_MAX;
    return instruction->opcode == TN_OP_MOVE || small ? TN_OK : tn_refuse(checker, "a box that is too large");
}

static tn_status check_amount(const tn_checker *checker, const tn_instruction *instruction)
{
    int64_t low, high;
    switch (instruction->opcode) {
    case TN_OP_HEADING:
        low = 0;
        high = 3;
        break;
    case TN_OP_COLOUR:
        low = -(int64_t)TN_PLACE_COLOUR_MAX;
        high = TN_PLACE_COLOUR_MAX;
        break;
    case TN_OP_BOUND_BALL:
        low = -TN_PLACE_SIZE_MAX;
        high = TN_PLACE_SIZE_MAX;
        break;
    default:
        return TN_OK;
    }
    return instruction->first >= low && instruction->first <= high
               ? TN_OK
               : tn_refuse(checker, "%lld is not from %lld to %lld", (long long)instruction->first, (long long)low,
                           (long long)high);
}

/* A part has a name. */
static tn_status check_part(const tn_checker *checker, const tn_instruction *instruction)
{
    return !*tn_text(checker->module, (tn_string)instruction->first) ? tn_refuse(checker, "a part without a name")
                                                                     : TN_OK;
}

static void list_vector(tn_lister *lister, const tn_instruction *instruction)
{
    const tn_vector_record *vector = &lister->module->VECTOR_records[instruction->first];
    fprintf(lister->out, "%lld, %lld, %lld", (long long)vector->x, (long long)vector->y, (long long)vector->z);
}

/* The vectors are shown where they are used. */
static void list(tn_lister *lister)
{
    (void)lister;
}

static const tn_section sections[] = {TN_SECTION_VECTOR, TN_SECTION_STRINGS};

static const tn_operand_rules operands[] = {
    {TN_OPERANDS_VECTOR, check_vector, list_vector},
    {TN_OPERANDS_AMOUNT, check_amount, NULL},
    {TN_OPERANDS_PART, check_part, NULL},
};

extern const tn_engine tn_engine_place;
const tn_engine tn_engine_place = {.name = "place",
                                   .sections = sections,
                                   .codes = 1u << TN_CODE_PLACE,
                                   .operands = operands,
                                   .operand_count = sizeof operands / sizeof *operands,
                                   .list = list};
