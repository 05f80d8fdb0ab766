#include "runtime/growth/model/system.h"

#include <stdlib.h>

/* A system and the arrays that it reaches. */
typedef struct room {
    tn_growth_system system;
    tn_growth_label *labels;
    tn_axiom_edge *axiom;
    tn_growth_group *groups;
    uint32_t *group_labels;
    tn_growth_rule *rules;
    tn_alternative *alternatives;
    tn_template *templates;
    tn_template_segment *segments;
    tn_template_branch *branches;
} room;

static void free_room(room *r)
{
    free(r->labels);
    free(r->axiom);
    free(r->groups);
    free(r->group_labels);
    free(r->rules);
    free(r->alternatives);
    free(r->templates);
    free(r->segments);
    free(r->branches);
    free(r);
}

static void *array(size_t count, size_t size)
{
    return calloc(count ? count : 1, size);
}

static room *make_room(const tn_module *module)
{
    room *r = calloc(1, sizeof *r);
    if (!r)
        return NULL;
    r->labels = array(module->EDGE_LABEL_count, sizeof *r->labels);
    r->axiom = array(module->AXIOM_count, sizeof *r->axiom);
    r->groups = array(module->REWRITE_GROUP_count, sizeof *r->groups);
    r->group_labels = array(module->GROUP_LABEL_count, sizeof *r->group_labels);
    r->rules = array(module->REWRITE_RULE_count, sizeof *r->rules);
    r->alternatives = array(module->ALTERNATIVE_count, sizeof *r->alternatives);
    r->templates = array(module->TEMPLATE_count, sizeof *r->templates);
    r->segments = array(module->SEGMENT_count, sizeof *r->segments);
    r->branches = array(module->BRANCH_count, sizeof *r->branches);
    if (r->labels && r->axiom && r->groups && r->group_labels && r->rules && r->alternatives && r->templates &&
        r->segments && r->branches)
        return r;
    free_room(r);
    return NULL;
}

static void read_templates(const tn_module *module, room *r)
{
    for (size_t i = 0; i < module->TEMPLATE_count; i++) {
        const tn_template_record *t = &module->TEMPLATE_records[i];
        r->templates[i] = (tn_template){r->segments + t->segment_first, r->branches + t->branch_first, t->segment_count,
                                        t->branch_count};
    }
    for (size_t i = 0; i < module->SEGMENT_count; i++) {
        const tn_segment_record *s = &module->SEGMENT_records[i];
        r->segments[i] = (tn_template_segment){s->label, (uint8_t)s->age, s->reversed != 0, {s->x, s->y, s->z}};
    }
    for (size_t i = 0; i < module->BRANCH_count; i++) {
        const tn_branch_record *b = &module->BRANCH_records[i];
        r->branches[i] = (tn_template_branch){
            b->at, b->label, (uint8_t)b->age, (uint8_t)b->side, b->reversed != 0, b->turn, {b->x, b->y, b->z}};
    }
}

static void read_rules(const tn_module *module, room *r)
{
    for (size_t i = 0; i < module->ALTERNATIVE_count; i++) {
        const tn_alternative_record *a = &module->ALTERNATIVE_records[i];
        r->alternatives[i] = (tn_alternative){a->template, a->comparison, a->bound, a->weight};
    }
    for (size_t i = 0; i < module->REWRITE_RULE_count; i++) {
        const tn_rewrite_rule_record *rule = &module->REWRITE_RULE_records[i];
        const tn_alternative *first = r->alternatives + rule->alternative_first;
        bool conditional = false;
        for (uint32_t a = 0; a < rule->alternative_count; a++)
            conditional |= first[a].comparison != TN_ALWAYS;
        r->rules[i] = (tn_growth_rule){rule->left, rule->right, first, rule->alternative_count, conditional};
    }
    for (size_t i = 0; i < module->GROUP_LABEL_count; i++)
        r->group_labels[i] = module->GROUP_LABEL_records[i].label;
    for (size_t i = 0; i < module->REWRITE_GROUP_count; i++) {
        const tn_rewrite_group_record *g = &module->REWRITE_GROUP_records[i];
        r->groups[i] = (tn_growth_group){r->group_labels + g->label_first, g->label_count, r->rules + g->rule_first,
                                         g->rule_count};
    }
}

tn_status tn_growth_system_read(const tn_module *module, tn_growth_system **system, tn_error *error)
{
    *system = NULL;
    if (module->GROWTH_count == 0) {
        tn_fail(error, TN_INVALID, TN_CODE_NONE, "there is no rewrite system in this file");
        tn_error_help(error, "a surface grows from a .hemls file, or from a .study file that names one");
        return TN_INVALID;
    }
    room *r = make_room(module);
    if (!r)
        return tn_fail_memory(error);
    const tn_growth_record *growth = &module->GROWTH_records[0];
    for (size_t i = 0; i < module->EDGE_LABEL_count; i++)
        r->labels[i] = (tn_growth_label){module->EDGE_LABEL_records[i].number,
                                         tn_text(module, module->EDGE_LABEL_records[i].name)};
    for (size_t i = 0; i < module->AXIOM_count; i++)
        r->axiom[i] = (tn_axiom_edge){module->AXIOM_records[i].label, module->AXIOM_records[i].reversed != 0};
    read_templates(module, r);
    read_rules(module, r);
    r->system = (tn_growth_system){.name = tn_text(module, growth->name),
                                   .labels = r->labels,
                                   .label_count = (uint32_t)module->EDGE_LABEL_count,
                                   .axiom = r->axiom,
                                   .axiom_count = (uint32_t)module->AXIOM_count,
                                   .groups = r->groups,
                                   .group_count = (uint32_t)module->REWRITE_GROUP_count,
                                   .templates = r->templates,
                                   .template_count = (uint32_t)module->TEMPLATE_count,
                                   .branch_angle = growth->branch_angle,
                                   .sync = growth->sync != 0};
    *system = &r->system;
    return TN_OK;
}

void tn_growth_system_free(tn_growth_system *system)
{
    if (system)
        free_room((room *)system); /* the system is the room's first member */
}
