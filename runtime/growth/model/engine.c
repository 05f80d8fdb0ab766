/* Says what of a module belongs to growing, and how expressions over a surface name what is measured of it. */
#include "runtime/module/engine.h"

#include "runtime/growth/model/list.h"
#include "runtime/growth/model/records.h"
#include "runtime/growth/model/verify.h"

static tn_status check_term(const tn_checker *checker, const tn_instruction *instruction)
{
    return instruction->first < TN_MEASURED_COUNT ? TN_OK : tn_refuse(checker, "nothing of this number is measured");
}

static void list_term(tn_lister *lister, const tn_instruction *instruction)
{
    fputs(tn_measured_names[instruction->first], lister->out);
}

static const tn_section sections[] = {
    TN_SECTION_GROWTH,      TN_SECTION_EDGE_LABEL,   TN_SECTION_AXIOM,       TN_SECTION_REWRITE_GROUP,
    TN_SECTION_GROUP_LABEL, TN_SECTION_REWRITE_RULE, TN_SECTION_ALTERNATIVE, TN_SECTION_TEMPLATE,
    TN_SECTION_SEGMENT,     TN_SECTION_BRANCH,       TN_SECTION_STUDY,       TN_SECTION_FORCE,
    TN_SECTION_BOUNDARY,    TN_SECTION_GOAL,         TN_SECTION_STRINGS,
};

static const tn_operand_rules operands[] = {{TN_OPERANDS_TERM, check_term, list_term}};

extern const tn_engine tn_engine_growth;
const tn_engine tn_engine_growth = {.name = "growth",
                                    .sections = sections,
                                    .operands = operands,
                                    .operand_count = sizeof operands / sizeof *operands,
                                    .verify = tn_growth_verify,
                                    .list_code = tn_growth_list};
