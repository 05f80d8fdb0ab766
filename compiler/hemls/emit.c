/* From a checked rewrite system to the records of a module. */
#include "compiler/hemls/hemls.h"

static uint32_t label_index(const tn_checked_growth *growth, uint32_t number)
{
    uint32_t index = 0;
    for (const tn_checked_label *label = growth->labels; label && label->number != number; label = label->next)
        index++;
    return index;
}

static uint32_t emit_template(tn_builder *builder, const tn_checked_growth *growth, const tn_checked_template *template)
{
    tn_template_record record = {.segment_first = (uint32_t)tn_builder_count(builder, TN_SECTION_SEGMENT),
                                 .segment_count = template->segment_count,
                                 .branch_first = (uint32_t)tn_builder_count(builder, TN_SECTION_BRANCH),
                                 .branch_count = template->branch_count,
                                 .file = template->span.file,
                                 .begin = template->span.begin,
                                 .end = template->span.end};
    for (uint32_t i = 0; i < template->segment_count; i++) {
        const tn_checked_segment *s = &template->segments[i];
        tn_builder_add_SEGMENT(builder, &(tn_segment_record){label_index(growth, s->number), s->age, s->reversed,
                                                             s->end[0], s->end[1], s->end[2]});
    }
    for (uint32_t i = 0; i < template->branch_count; i++) {
        const tn_checked_branch *b = &template->branches[i];
        tn_builder_add_BRANCH(builder,
                              &(tn_branch_record){b->at, label_index(growth, b->number), b->age, b->side, b->reversed,
                                                  b->turn, b->direction[0], b->direction[1], b->direction[2]});
    }
    return tn_builder_add_TEMPLATE(builder, &record);
}

static void emit_rule(tn_builder *builder, const tn_checked_growth *growth, const tn_checked_rewrite *rule)
{
    tn_rewrite_rule_record record = {.left = rule->left == TN_NO_LABEL ? TN_NO_LABEL : label_index(growth, rule->left),
                                     .right =
                                         rule->right == TN_NO_LABEL ? TN_NO_LABEL : label_index(growth, rule->right),
                                     .alternative_first = (uint32_t)tn_builder_count(builder, TN_SECTION_ALTERNATIVE),
                                     .alternative_count = rule->alternative_count,
                                     .file = rule->span.file,
                                     .begin = rule->span.begin,
                                     .end = rule->span.end};
    for (const tn_checked_alternative *a = rule->alternatives; a; a = a->next) {
        bool conditional = a->choice.comparison != TN_ALWAYS;
        tn_alternative_record one = {.template = emit_template(builder, growth, a->template),
                                     .comparison = a->choice.comparison,
                                     .bound = conditional ? a->choice.value : 0,
                                     .weight = conditional ? 1 : a->choice.value};
        tn_builder_add_ALTERNATIVE(builder, &one);
    }
    tn_builder_add_REWRITE_RULE(builder, &record);
}

static void emit_group(tn_builder *builder, const tn_checked_growth *growth, const tn_checked_group *group)
{
    tn_rewrite_group_record record = {.label_first = (uint32_t)tn_builder_count(builder, TN_SECTION_GROUP_LABEL),
                                      .label_count = group->rules->number_count,
                                      .rule_first = (uint32_t)tn_builder_count(builder, TN_SECTION_REWRITE_RULE),
                                      .rule_count = group->rule_count};
    for (uint32_t i = 0; i < group->rules->number_count; i++)
        tn_builder_add_GROUP_LABEL(builder, &(tn_group_label_record){label_index(growth, group->rules->numbers[i])});
    for (const tn_checked_rewrite *rule = group->rules; rule; rule = rule->next_in_group)
        emit_rule(builder, growth, rule);
    tn_builder_add_REWRITE_GROUP(builder, &record);
}

void tn_emit_growth(tn_builder *builder, const tn_checked_growth *growth)
{
    tn_builder_add_GROWTH(builder,
                          &(tn_growth_record){tn_builder_string(builder, growth->name), growth->branch_angle,
                                              growth->sync, growth->span.file, growth->span.begin, growth->span.end});
    for (const tn_checked_label *label = growth->labels; label; label = label->next)
        tn_builder_add_EDGE_LABEL(builder,
                                  &(tn_edge_label_record){tn_builder_string(builder, label->name), label->number});
    for (uint32_t i = 0; i < growth->axiom_count; i++)
        tn_builder_add_AXIOM(builder,
                             &(tn_axiom_record){label_index(growth, growth->axiom[i]), growth->axiom_reversed[i]});
    for (const tn_checked_group *group = growth->groups; group; group = group->next)
        emit_group(builder, growth, group);
}
