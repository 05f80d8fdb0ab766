/* Says what of a module belongs to growing, and what expressions over a surface speak of. */
#include "runtime/module/engine.h"

#include <math.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/base/utf8.h"
#include "runtime/growth/model/records.h"
#include "runtime/growth/model/verify.h"
#include "runtime/module/lister.h"

/* ---- lists a rewrite system and its study */

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

/* The guards of one predecessor, in the order in which they are asked. */
static void list_group(FILE *out, const tn_module *module, const tn_rewrite_group_record *group)
{
    fputs("  rewrite by", out);
    for (uint32_t r = 0; r < group->rule_count; r++)
        fprintf(out, "%s function %u", r > 0 ? ", then" : "",
                module->REWRITE_RULE_records[group->rule_first + r].guard);
    fputc('\n', out);
}

/* Records that are listed field by field. */
static void list_records(tn_lister *lister, tn_section section)
{
    for (uint32_t i = 0; i < lister->module->tables[section].count && !ferror(lister->out); i++)
        tn_list_record(lister, section, i);
}

static void list_measuring(FILE *out, const tn_module *module)
{
    for (size_t i = 0; i < module->MEASURING_count; i++) {
        const tn_measuring_record *m = &module->MEASURING_records[i];
        if (m->kind == TN_MEASURING_SUN) {
            fprintf(out, "  sun (%.15g, %.15g, %.15g)\n", m->x, m->y, m->z);
            continue;
        }
        fputs("  distance to ", out);
        write_text(out, module, m->mesh);
        fputc('\n', out);
    }
}

static void list_goals(FILE *out, const tn_module *module)
{
    for (size_t i = 0; i < module->GOAL_count; i++) {
        const tn_goal_record *g = &module->GOAL_records[i];
        fputs("  fitness ", out);
        if (g->term < TN_FITNESS_TERM_COUNT) {
            fputs(tn_names_MEASURED[g->term], out);
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
    fprintf(out, "  branch angle %.15g, branch length %.15g, seed %llu, edge limit %lld, flags %u\n", s->branch_angle,
            s->branch_length, (unsigned long long)s->seed, (long long)s->edge_limit, s->flags);
}

/* The rewrite system: labels, the functions that are its seed and the guards of each predecessor, and the study with
 * its surroundings and goals. */
static void growth_list(tn_lister *lister)
{
    const tn_module *module = lister->module;
    FILE *out = lister->out;
    if (module->GROWTH_count == 0)
        return;
    const tn_growth_record *growth = &module->GROWTH_records[0];
    fputs("\nrewrite system ", out);
    write_text(out, module, growth->name);
    fprintf(out, ": branch angle %.15g%s", growth->branch_angle, growth->flags & TN_GROWTH_SYNC ? ", sync" : "");
    fputs(growth->flags & TN_GROWTH_EVEN ? ", even" : "", out);
    fputs("\n  labels", out);
    for (uint32_t i = 0; i < module->EDGE_LABEL_count; i++) {
        fputc(' ', out);
        write_label(out, module, i);
        fprintf(out, "=%u", module->EDGE_LABEL_records[i].number);
    }
    fprintf(out, "\n  seed function %u\n", growth->seed);
    for (size_t g = 0; g < module->REWRITE_GROUP_count && !ferror(out); g++)
        list_group(out, module, &module->REWRITE_GROUP_records[g]);
    if (module->STUDY_count)
        list_study(out, module);
    list_records(lister, TN_SECTION_FORCE);
    list_records(lister, TN_SECTION_BOUNDARY);
    list_measuring(out, module);
    list_goals(out, module);
}

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
                                    .list_code = growth_list};
