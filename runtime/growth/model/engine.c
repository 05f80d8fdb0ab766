/* Says what of a module belongs to growing, and what expressions over a surface speak of. */
#include "runtime/module/engine.h"

#include <math.h>

#include "runtime/base/bytes.h"
#include "runtime/growth/model/list.h"
#include "runtime/growth/model/records.h"
#include "runtime/growth/model/verify.h"

static tn_status check_stroke(const tn_checker *checker, const tn_instruction *instruction)
{
    return instruction->second < TN_AGE_CHANGE_COUNT
               ? TN_OK
               : tn_refuse(checker, "%u says nothing of an age", (unsigned)instruction->second);
}

static tn_status check_angle(const tn_checker *checker, const tn_instruction *instruction)
{
    double degrees = tn_double_of((uint64_t)instruction->first);
    return fabs(degrees) <= 360 ? TN_OK : tn_refuse(checker, "an angle beyond 360 degrees");
}

static tn_status check_successor(const tn_checker *checker, const tn_instruction *instruction)
{
    uint32_t successor = (uint32_t)instruction->first;
    if (successor >= checker->record || checker->module->FUNCTION_records[successor].kind != TN_FUNCTION_SUCCESSOR)
        return tn_refuse(checker, "function %u is not a successor below this function", successor);
    return TN_OK;
}

static void list_label(tn_lister *lister, const tn_instruction *instruction)
{
    tn_list_name(lister, lister->module->EDGE_LABEL_records[instruction->first].name);
}

static void list_stroke(tn_lister *lister, const tn_instruction *instruction)
{
    list_label(lister, instruction);
    fputs(tn_names_AGE_CHANGE[instruction->second], lister->out);
}

static const tn_section sections[] = {
    TN_SECTION_GROWTH,       TN_SECTION_EDGE_LABEL, TN_SECTION_REWRITE_GROUP,
    TN_SECTION_REWRITE_RULE, TN_SECTION_STUDY,      TN_SECTION_FORCE,
    TN_SECTION_BOUNDARY,     TN_SECTION_GOAL,       TN_SECTION_GROWTH_REQUIREMENT,
    TN_SECTION_MEASURING,    TN_SECTION_STRINGS,
};

static const tn_operand_rules operands[] = {{TN_OPERANDS_LABEL, NULL, list_label},
                                            {TN_OPERANDS_STROKE, check_stroke, list_stroke},
                                            {TN_OPERANDS_ANGLE, check_angle, NULL},
                                            {TN_OPERANDS_SUCCESSOR, check_successor, NULL}};

extern const tn_engine tn_engine_growth;
const tn_engine tn_engine_growth = {.name = "growth",
                                    .sections = sections,
                                    .codes = 1u << TN_CODE_TURTLE | 1u << TN_CODE_GUARD,
                                    .operands = operands,
                                    .operand_count = sizeof operands / sizeof *operands,
                                    .terms = tn_names_MEASURED,
                                    .term_count = TN_MEASURED_COUNT,
                                    .term_kind = TN_FUNCTION_MEASURE,
                                    .verify = tn_growth_verify,
                                    .verify_after = tn_growth_verify_whole,
                                    .list_code = tn_growth_list};
