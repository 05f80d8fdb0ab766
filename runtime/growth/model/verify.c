/* The sections of growth: everything that growing relies on. Places and strings have been checked before. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "runtime/growth/model/records.h"
#include "runtime/module/verify.h"

__attribute__((format(printf, 2, 3))) static tn_status refuse(tn_error *error, const char *format, ...)
{
    char what[200];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    return tn_fail(error, TN_INVALID, E_REFUSED_MODULE, "the module is refused: %s", what);
}

/* Is [first, first + count) the stretch that follows `*end` in a section of `total` records? Moves *end on. */
static bool follows(uint32_t first, uint32_t count, size_t total, size_t *end)
{
    if (first != *end || count > total - *end)
        return false;
    *end += count;
    return true;
}

static bool is_coordinate(double value)
{
    return fabs(value) <= TN_COORDINATE_MAX;
}

static bool are_coordinates(double x, double y, double z)
{
    return is_coordinate(x) && is_coordinate(y) && is_coordinate(z);
}

/* ---- the rewrite system */

static tn_status check_system(const tn_module *module, tn_error *error)
{
    const tn_growth_record *growth = &module->GROWTH_records[0];
    if (!(growth->branch_angle >= 0 && growth->branch_angle <= 360) || growth->sync > 1)
        return refuse(error, "its branch angle or its sync is out of range");
    if (module->EDGE_LABEL_count == 0 || module->EDGE_LABEL_count > TN_LABELS_MAX)
        return refuse(error, "it has %zu labels; 1 to %u are possible", module->EDGE_LABEL_count, TN_LABELS_MAX);
    for (size_t i = 0; i < module->EDGE_LABEL_count; i++) {
        if (module->EDGE_LABEL_records[i].name == 0)
            return refuse(error, "label %zu has no name", i);
        if (i > 0 && module->EDGE_LABEL_records[i].number <= module->EDGE_LABEL_records[i - 1].number)
            return refuse(error, "the numbers of its labels do not ascend");
    }
    if (module->AXIOM_count < 3 || module->AXIOM_count > TN_AXIOM_MAX)
        return refuse(error, "its seed has %zu edges; 3 to %u are possible", module->AXIOM_count, TN_AXIOM_MAX);
    for (size_t i = 0; i < module->AXIOM_count; i++)
        if (module->AXIOM_records[i].label >= module->EDGE_LABEL_count || module->AXIOM_records[i].reversed > 1)
            return refuse(error, "edge %zu of its seed is out of range", i);
    return TN_OK;
}

static tn_status check_template(const tn_module *module, size_t index, size_t *segment_end, size_t *branch_end,
                                tn_error *error)
{
    const tn_template_record *template = &module->TEMPLATE_records[index];
    if (template->segment_count == 0 || template->segment_count > TN_TEMPLATE_ITEMS_MAX ||
        template->branch_count > TN_TEMPLATE_ITEMS_MAX)
        return refuse(error, "template %zu has no segments, or more segments or branches than %u", index,
                      TN_TEMPLATE_ITEMS_MAX);
    if (!follows(template->segment_first, template->segment_count, module->SEGMENT_count, segment_end) ||
        !follows(template->branch_first, template->branch_count, module->BRANCH_count, branch_end))
        return refuse(error, "the parts of template %zu do not follow those of the one before", index);
    for (uint32_t i = 0; i < template->segment_count; i++) {
        const tn_segment_record *segment = &module->SEGMENT_records[template->segment_first + i];
        if (segment->label >= module->EDGE_LABEL_count || segment->age >= TN_AGE_CHANGE_COUNT ||
            segment->reversed > 1 || !are_coordinates(segment->x, segment->y, segment->z))
            return refuse(error, "segment %u of template %zu is out of range", i, index);
    }
    for (uint32_t i = 0; i < template->branch_count; i++) {
        const tn_branch_record *branch = &module->BRANCH_records[template->branch_first + i];
        if (branch->at > template->segment_count || branch->label >= module->EDGE_LABEL_count ||
            branch->age >= TN_AGE_CHANGE_COUNT || branch->side >= TN_SIDE_COUNT || branch->reversed > 1 ||
            !are_coordinates(branch->x, branch->y, branch->z))
            return refuse(error, "branch %u of template %zu is out of range", i, index);
    }
    return TN_OK;
}

static tn_status check_rule(const tn_module *module, size_t index, size_t *alternative_end, tn_error *error)
{
    const tn_rewrite_rule_record *rule = &module->REWRITE_RULE_records[index];
    uint32_t contexts[2] = {rule->left, rule->right};
    for (int i = 0; i < 2; i++)
        if (contexts[i] != TN_NO_LABEL && contexts[i] >= module->EDGE_LABEL_count)
            return refuse(error, "the context of rewrite rule %zu is out of range", index);
    if (rule->alternative_count == 0 ||
        !follows(rule->alternative_first, rule->alternative_count, module->ALTERNATIVE_count, alternative_end))
        return refuse(error, "rewrite rule %zu has no alternatives, or not those after the rule before", index);
    for (uint32_t i = 0; i < rule->alternative_count; i++) {
        const tn_alternative_record *one = &module->ALTERNATIVE_records[rule->alternative_first + i];
        if (one->template >= module->TEMPLATE_count || one->comparison >= TN_COMPARISON_COUNT || one->weight < 0 ||
            !is_coordinate(one->weight) || !is_coordinate(one->bound))
            return refuse(error, "alternative %u of rewrite rule %zu is out of range", i, index);
    }
    return TN_OK;
}

static tn_status check_group(const tn_module *module, size_t index, size_t *label_end, size_t *rule_end,
                             tn_error *error)
{
    const tn_rewrite_group_record *group = &module->REWRITE_GROUP_records[index];
    if (group->label_count == 0 || group->label_count > TN_CHAIN_MAX)
        return refuse(error, "predecessor %zu has %u edges; 1 to %u are possible", index, group->label_count,
                      TN_CHAIN_MAX);
    if (group->rule_count == 0 ||
        !follows(group->rule_first, group->rule_count, module->REWRITE_RULE_count, rule_end) ||
        !follows(group->label_first, group->label_count, module->GROUP_LABEL_count, label_end))
        return refuse(error, "predecessor %zu has no rules, or not those after the one before", index);
    for (uint32_t i = 0; i < group->label_count; i++)
        if (module->GROUP_LABEL_records[group->label_first + i].label >= module->EDGE_LABEL_count)
            return refuse(error, "a label of predecessor %zu is out of range", index);
    return TN_OK;
}

static tn_status check_rules(const tn_module *module, tn_error *error)
{
    size_t segments = 0, branches = 0, alternatives = 0, labels = 0, rules = 0;
    tn_status status = TN_OK;
    if (module->TEMPLATE_count > TN_TEMPLATES_MAX)
        return refuse(error, "it has %zu templates; the limit is %u", module->TEMPLATE_count, TN_TEMPLATES_MAX);
    for (size_t i = 0; i < module->TEMPLATE_count && status == TN_OK; i++)
        status = check_template(module, i, &segments, &branches, error);
    for (size_t i = 0; i < module->REWRITE_RULE_count && status == TN_OK; i++)
        status = check_rule(module, i, &alternatives, error);
    for (size_t i = 0; i < module->REWRITE_GROUP_count && status == TN_OK; i++)
        status = check_group(module, i, &labels, &rules, error);
    if (status == TN_OK && (segments != module->SEGMENT_count || branches != module->BRANCH_count ||
                            alternatives != module->ALTERNATIVE_count || labels != module->GROUP_LABEL_count ||
                            rules != module->REWRITE_RULE_count))
        return refuse(error, "it has parts of rewrite rules that belong to none");
    return status;
}

/* ---- the study */

static tn_status check_study(const tn_module *module, tn_error *error)
{
    const tn_study_record *study = &module->STUDY_records[0];
    if (study->steps > TN_STEPS_MAX || (study->flags & ~TN_STUDY_FLAGS) != 0 || study->edge_limit < 0)
        return refuse(error, "its steps, edge limit or flags are out of range");
    if (!(study->scale_x > 0 && study->scale_y > 0 && study->scale_z > 0) ||
        !are_coordinates(study->scale_x, study->scale_y, study->scale_z) ||
        !are_coordinates(study->start_x, study->start_y, study->start_z))
        return refuse(error, "its scale or start is out of range");
    if (!(study->start_length > 0) || !is_coordinate(study->start_length) || !(study->branch_angle <= 360) ||
        !is_coordinate(study->branch_angle) || !is_coordinate(study->branch_length))
        return refuse(error, "its start length, branch angle or branch length is out of range");
    return TN_OK;
}

static tn_status check_boundary(const tn_module *module, size_t index, tn_error *error)
{
    const tn_boundary_record *b = &module->BOUNDARY_records[index];
    if (b->kind >= TN_BOUNDARY_KIND_COUNT || b->mode >= TN_BOUNDARY_MODE_COUNT || b->inside > 1)
        return refuse(error, "boundary %zu is of no known kind", index);
    if (!are_coordinates(b->a_x, b->a_y, b->a_z) || !are_coordinates(b->b_x, b->b_y, b->b_z) ||
        !is_coordinate(b->radius))
        return refuse(error, "boundary %zu is out of range", index);
    bool sound = true;
    if (b->kind == TN_BOUNDARY_PLANE)
        sound = fabs(b->b_x * b->b_x + b->b_y * b->b_y + b->b_z * b->b_z - 1) < 1e-9;
    else if (b->kind == TN_BOUNDARY_BOX)
        sound = b->a_x < b->b_x && b->a_y < b->b_y && b->a_z < b->b_z;
    else if (b->kind == TN_BOUNDARY_SPHERE)
        sound = b->radius > 0;
    else
        sound = b->mesh != 0;
    return sound ? TN_OK : refuse(error, "boundary %zu has no proper shape", index);
}

static tn_status check_surroundings(const tn_module *module, tn_error *error)
{
    if (module->FORCE_count > TN_SURROUNDINGS_MAX || module->BOUNDARY_count > TN_SURROUNDINGS_MAX)
        return refuse(error, "it has more forces or boundaries than %u", TN_SURROUNDINGS_MAX);
    for (size_t i = 0; i < module->FORCE_count; i++) {
        const tn_force_record *force = &module->FORCE_records[i];
        if (force->kind >= TN_FORCE_KIND_COUNT || !are_coordinates(force->x, force->y, force->z) ||
            !is_coordinate(force->strength) || !is_coordinate(force->exponent))
            return refuse(error, "force %zu is out of range", i);
    }
    for (size_t i = 0; i < module->BOUNDARY_count; i++) {
        tn_status status = check_boundary(module, i, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static bool is_expression(const tn_module *module, const tn_goal_record *goal)
{
    return goal->name != 0 && strnlen(tn_text(module, goal->name), TN_NAME_MAX + 1) <= TN_NAME_MAX &&
           goal->function < module->FUNCTION_count &&
           module->FUNCTION_records[goal->function].kind == TN_FUNCTION_MEASURE;
}

static tn_status check_goals(const tn_module *module, tn_error *error)
{
    unsigned seen = 0;
    size_t expressions = 0;
    for (size_t i = 0; i < module->GOAL_count; i++) {
        const tn_goal_record *goal = &module->GOAL_records[i];
        if (goal->term > TN_FITNESS_TERM_COUNT || !is_coordinate(goal->target) || !is_coordinate(goal->weight) ||
            goal->weight < 0 || (goal->term < TN_FITNESS_TERM_COUNT && seen >> goal->term & 1))
            return refuse(error, "fitness goal %zu is out of range or there twice", i);
        if (goal->term < TN_FITNESS_TERM_COUNT)
            seen |= 1u << goal->term;
        else if (!is_expression(module, goal) || ++expressions > TN_EXPRESSIONS_MAX)
            return refuse(error, "fitness goal %zu is no expression, or one too many", i);
    }
    return TN_OK;
}

tn_status tn_verify_growth(const tn_module *module, tn_error *error)
{
    size_t parts = module->EDGE_LABEL_count + module->AXIOM_count + module->REWRITE_GROUP_count +
                   module->GROUP_LABEL_count + module->REWRITE_RULE_count + module->ALTERNATIVE_count +
                   module->TEMPLATE_count + module->SEGMENT_count + module->BRANCH_count + module->STUDY_count +
                   module->FORCE_count + module->BOUNDARY_count + module->GOAL_count;
    if (module->GROWTH_count > 1 || module->STUDY_count > 1)
        return refuse(error, "it has more than one rewrite system or study");
    if (module->GROWTH_count == 0)
        return parts == 0 ? TN_OK : refuse(error, "it has parts of a rewrite system that it does not have");
    tn_status status = check_system(module, error);
    if (status == TN_OK)
        status = check_rules(module, error);
    if (status == TN_OK && module->STUDY_count)
        status = check_study(module, error);
    if (status == TN_OK)
        status = check_surroundings(module, error);
    if (status == TN_OK)
        status = check_goals(module, error);
    return status;
}
