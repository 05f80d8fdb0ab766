/* Lists a rewrite system and its study. */
#include "runtime/growth/model/list.h"

#include <string.h>

#include "runtime/base/utf8.h"
#include "runtime/growth/model/records.h"

enum { NAME_SHOWN = 60 };

static void write_text(FILE *out, const tn_module *module, tn_string string)
{
    const char *text = tn_text(module, string);
    tn_write_clean(out, text, strnlen(text, NAME_SHOWN));
}

static void write_label(FILE *out, const tn_module *module, uint32_t label)
{
    write_text(out, module, module->EDGE_LABEL_records[label].name);
}

static void write_edge(FILE *out, const tn_module *module, uint32_t label, uint32_t age, uint32_t reversed)
{
    static const char *const ages[] = {"", "_i", "_i+1", "_i-1"};
    fputs(reversed ? "~" : "", out);
    write_label(out, module, label);
    fputs(ages[age], out);
}

static void list_template(FILE *out, const tn_module *module, uint32_t index)
{
    static const char *const sides[] = {"no side", "left", "right"};
    const tn_template_record *template = &module->TEMPLATE_records[index];
    for (uint32_t i = 0; i < template->segment_count; i++) {
        const tn_segment_record *s = &module->SEGMENT_records[template->segment_first + i];
        fputs("      edge ", out);
        write_edge(out, module, s->label, s->age, s->reversed);
        fprintf(out, " to (%.6g, %.6g, %.6g)\n", s->x, s->y, s->z);
    }
    for (uint32_t i = 0; i < template->branch_count; i++) {
        const tn_branch_record *b = &module->BRANCH_records[template->branch_first + i];
        fprintf(out, "      branch at %u, %s: ", b->at, sides[b->side]);
        write_edge(out, module, b->label, b->age, b->reversed);
        fprintf(out, " towards (%.6g, %.6g, %.6g)\n", b->x, b->y, b->z);
    }
}

static void list_alternative(FILE *out, const tn_module *module, uint32_t index)
{
    static const char *const comparisons[] = {"", "<", ">", "="};
    const tn_alternative_record *one = &module->ALTERNATIVE_records[index];
    fprintf(out, "    -> template %u", one->template);
    if (one->comparison != TN_ALWAYS)
        fprintf(out, " if i %s %.15g", comparisons[one->comparison], one->bound);
    else if (one->weight != 1)
        fprintf(out, " weight %.15g", one->weight);
    fputc('\n', out);
    list_template(out, module, one->template);
}

static void list_rule(FILE *out, const tn_module *module, const tn_rewrite_group_record *group, uint32_t index)
{
    const tn_rewrite_rule_record *rule = &module->REWRITE_RULE_records[index];
    fputs("  rewrite", out);
    if (rule->left != TN_NO_LABEL) {
        fputc(' ', out);
        write_label(out, module, rule->left);
        fputs(" <", out);
    }
    for (uint32_t i = 0; i < group->label_count; i++) {
        fputc(' ', out);
        write_label(out, module, module->GROUP_LABEL_records[group->label_first + i].label);
    }
    if (rule->right != TN_NO_LABEL) {
        fputs(" > ", out);
        write_label(out, module, rule->right);
    }
    fputc('\n', out);
    for (uint32_t i = 0; i < rule->alternative_count; i++)
        list_alternative(out, module, rule->alternative_first + i);
}

/* Records that are listed field by field. */
static void list_records(tn_lister *lister, tn_section section)
{
    for (uint32_t i = 0; i < lister->module->tables[section].count && !ferror(lister->out); i++)
        tn_list_record(lister, section, i);
}

static void list_goals(FILE *out, const tn_module *module)
{
    for (size_t i = 0; i < module->GOAL_count; i++) {
        const tn_goal_record *g = &module->GOAL_records[i];
        fputs("  fitness ", out);
        if (g->term < TN_FITNESS_TERM_COUNT) {
            fputs(tn_measured_names[g->term], out);
        } else {
            write_text(out, module, g->name);
            fprintf(out, " = function %u", g->function);
        }
        fprintf(out, " target %.15g weight %.15g\n", g->target, g->weight);
    }
}

static void list_study(FILE *out, const tn_module *module)
{
    const tn_study_record *s = &module->STUDY_records[0];
    fputs("\nstudy ", out);
    write_text(out, module, s->name);
    fprintf(out, "\n  steps %u, scale (%.15g, %.15g, %.15g), start (%.15g, %.15g, %.15g), start length %.15g\n",
            s->steps, s->scale_x, s->scale_y, s->scale_z, s->start_x, s->start_y, s->start_z, s->start_length);
    fprintf(out, "  branch angle %.15g, branch length %.15g, seed %lld, edge limit %lld, flags %u\n", s->branch_angle,
            s->branch_length, (long long)s->seed, (long long)s->edge_limit, s->flags);
}

void tn_growth_list(tn_lister *lister)
{
    const tn_module *module = lister->module;
    FILE *out = lister->out;
    if (module->GROWTH_count == 0)
        return;
    const tn_growth_record *growth = &module->GROWTH_records[0];
    fputs("\nrewrite system ", out);
    write_text(out, module, growth->name);
    fprintf(out, ": branch angle %.15g%s\n  labels", growth->branch_angle, growth->sync ? ", sync" : "");
    for (uint32_t i = 0; i < module->EDGE_LABEL_count; i++) {
        fputc(' ', out);
        write_label(out, module, i);
        fprintf(out, "=%u", module->EDGE_LABEL_records[i].number);
    }
    fputs("\n  seed", out);
    for (size_t i = 0; i < module->AXIOM_count && !ferror(out); i++) {
        fputc(' ', out);
        write_edge(out, module, module->AXIOM_records[i].label, TN_AGE_ZERO, module->AXIOM_records[i].reversed);
    }
    fputc('\n', out);
    for (size_t g = 0; g < module->REWRITE_GROUP_count && !ferror(out); g++)
        for (uint32_t r = 0; r < module->REWRITE_GROUP_records[g].rule_count; r++)
            list_rule(out, module, &module->REWRITE_GROUP_records[g], module->REWRITE_GROUP_records[g].rule_first + r);
    if (module->STUDY_count)
        list_study(out, module);
    list_records(lister, TN_SECTION_FORCE);
    list_records(lister, TN_SECTION_BOUNDARY);
    list_goals(out, module);
}
