/* Verifies what growing relies on in a module's growth sections, beyond what records.def says of each field. */
#include "runtime/growth/model/verify.h"

#include <math.h>

#include "runtime/growth/model/records.h"

/* ---- the rewrite system */

static tn_status check_system(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    if (module->EDGE_LABEL_count == 0 || module->EDGE_LABEL_count > TN_LABELS_MAX)
        return tn_refuse(checker, "it has %zu labels; 1 to %u are possible", module->EDGE_LABEL_count, TN_LABELS_MAX);
    for (size_t i = 1; i < module->EDGE_LABEL_count; i++)
        if (module->EDGE_LABEL_records[i].number <= module->EDGE_LABEL_records[i - 1].number)
            return tn_refuse(checker, "the numbers of its labels do not ascend");
    return TN_OK;
}

/* ---- the study */

static tn_status check_boundary(const tn_checker *checker, size_t index)
{
    const tn_boundary_record *b = &checker->module->BOUNDARY_records[index];
    bool sound = true;
    if (b->kind == TN_BOUNDARY_PLANE)
        sound = fabs(b->b_x * b->b_x + b->b_y * b->b_y + b->b_z * b->b_z - 1) < 1e-9;
    else if (b->kind == TN_BOUNDARY_BOX)
        sound = b->a_x < b->b_x && b->a_y < b->b_y && b->a_z < b->b_z;
    else if (b->kind == TN_BOUNDARY_SPHERE)
        sound = b->radius > 0;
    else
        sound = b->mesh != 0;
    return sound ? TN_OK : tn_refuse(checker, "boundary %zu has no proper shape", index);
}

static tn_status check_surroundings(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    if (module->FORCE_count > TN_SURROUNDINGS_MAX || module->BOUNDARY_count > TN_SURROUNDINGS_MAX)
        return tn_refuse(checker, "it has more forces or boundaries than %u", TN_SURROUNDINGS_MAX);
    for (size_t i = 0; i < module->BOUNDARY_count; i++) {
        tn_status status = check_boundary(checker, i);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status check_measuring(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    bool seen[TN_MEASURING_KIND_COUNT] = {false};
    for (size_t i = 0; i < module->MEASURING_count; i++) {
        const tn_measuring_record *m = &module->MEASURING_records[i];
        bool sound = m->kind == TN_MEASURING_SUN ? m->x * m->x + m->y * m->y + m->z * m->z > 1e-24 : m->mesh != 0;
        if (!sound || seen[m->kind])
            return tn_refuse(checker, "what surfaces are measured with is given twice, or is nothing");
        seen[m->kind] = true;
    }
    return TN_OK;
}

static bool is_expression(const tn_module *module, const tn_goal_record *goal)
{
    return goal->name != 0 && goal->function < module->FUNCTION_count &&
           module->FUNCTION_records[goal->function].kind == TN_FUNCTION_MEASURE;
}

static tn_status check_goals(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    unsigned seen = 0;
    size_t expressions = 0;
    for (size_t i = 0; i < module->GOAL_count; i++) {
        const tn_goal_record *goal = &module->GOAL_records[i];
        if (goal->term == TN_FITNESS_TERM_COUNT) {
            if (!is_expression(module, goal) || ++expressions > TN_EXPRESSIONS_MAX)
                return tn_refuse(checker, "fitness goal %zu is not an expression, or one too many", i);
            continue;
        }
        if (seen >> goal->term & 1)
            return tn_refuse(checker, "fitness goal %zu is given twice", i);
        seen |= 1u << goal->term;
    }
    return TN_OK;
}

static tn_status check_requirements(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    if (module->GROWTH_REQUIREMENT_count > TN_EXPRESSIONS_MAX)
        return tn_refuse(checker, "it has more requirements than %u", TN_EXPRESSIONS_MAX);
    for (size_t i = 0; i < module->GROWTH_REQUIREMENT_count; i++)
        if (module->FUNCTION_records[module->GROWTH_REQUIREMENT_records[i].violation].kind != TN_FUNCTION_MEASURE)
            return tn_refuse(checker, "requirement %zu is not an expression", i);
    return TN_OK;
}

/* ---- all of them */

tn_status tn_growth_verify(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    size_t parts = module->EDGE_LABEL_count + module->REWRITE_GROUP_count + module->REWRITE_RULE_count +
                   module->STUDY_count + module->FORCE_count + module->BOUNDARY_count + module->GOAL_count +
                   module->GROWTH_REQUIREMENT_count + module->MEASURING_count;
    if (module->GROWTH_count > 1 || module->STUDY_count > 1)
        return tn_refuse(checker, "it has more than one rewrite system or study");
    if (module->GROWTH_count == 0)
        return parts == 0 ? TN_OK : tn_refuse(checker, "it has parts of a rewrite system that it does not have");
    tn_status status = check_system(checker);
    if (status == TN_OK)
        status = check_surroundings(checker);
    if (status == TN_OK)
        status = check_measuring(checker);
    if (status == TN_OK)
        status = check_goals(checker);
    return status == TN_OK ? check_requirements(checker) : status;
}
