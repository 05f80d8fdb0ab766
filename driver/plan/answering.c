/* Says of each plan of a file which rules it matches, or whether a library keeps it. */
#include "driver/plan/answering.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "driver/plan/library.h"

/* ---- what a library keeps */

tn_status tn_pruned_new(const tn_module *module, const tn_ready_library *ready, const tn_library_options *lengths,
                        const tn_rules_options *options, tn_answer_format format, tn_pruned *pruned, tn_error *error)
{
    *pruned = (tn_pruned){.module = module,
                          .ready = ready,
                          .format = format,
                          .trays_min = lengths->override_trays ? lengths->trays_min : ready->record->trays_min,
                          .trays_max = lengths->override_trays ? lengths->trays_max : ready->record->trays_max,
                          .dropped = -1};
    return tn_clause_rules_new(ready->schema, ready->record, options, &pruned->rules, error);
}

void tn_pruned_clear(tn_pruned *pruned)
{
    tn_rules_free(pruned->rules);
    *pruned = (tn_pruned){0};
}

static const char *clause_name(const void *context, size_t i)
{
    const tn_pruned *p = context;
    return tn_text(p->module, p->module->CLAUSE_records[p->ready->record->clause_first + i].name);
}

static bool length_drops(const tn_pruned *p, const tn_sifted *plan)
{
    return plan->length < p->trays_min || plan->length > p->trays_max;
}

static bool drops(const tn_pruned *p, const tn_sifted *plan, size_t i)
{
    return tn_clause_drops(p->module, p->ready->record, i, plan->bits);
}

static bool is_kept(const tn_pruned *p, const tn_sifted *plan)
{
    if (length_drops(p, plan))
        return false;
    for (size_t i = 0; i < p->ready->record->clause_count; i++)
        if (drops(p, plan, i))
            return false;
    return true;
}

/* The names of what drops the plan. */
static bool append_reasons(const tn_pruned *p, const tn_sifted *plan, tn_buffer *out)
{
    const char *between = "";
    bool done = true;
    if (length_drops(p, plan)) {
        done = tn_buffer_printf(out, "trays");
        between = ", ";
    }
    for (size_t i = 0; done && i < p->ready->record->clause_count; i++) {
        if (!drops(p, plan, i))
            continue;
        done = tn_buffer_printf(out, "%s%s", between, clause_name(p, i));
        between = ", ";
    }
    return done;
}

/* {"trays": [...], "dropped_by": [...]} */
static bool append_dropped_json(const tn_pruned *p, const tn_sifted *plan, tn_buffer *out)
{
    tn_json json = tn_json_text(out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_plan_write_trays(p->ready->schema, plan->trays, plan->length, &json);
    tn_json_list(&json, "dropped_by");
    if (length_drops(p, plan))
        tn_json_string(&json, NULL, "trays");
    for (size_t i = 0; i < p->ready->record->clause_count; i++)
        if (drops(p, plan, i))
            tn_json_string(&json, NULL, clause_name(p, i));
    tn_json_list_end(&json);
    tn_json_object_end(&json);
    return !out->failed;
}

/* A dropped plan: as plan lines, a comment with the reasons before it, so that the file can be read again. */
static bool append_dropped(const tn_pruned *p, const tn_sifted *plan, tn_buffer *out)
{
    const tn_schema *schema = p->ready->schema;
    return tn_buffer_printf(out, "# dropped by ") && append_reasons(p, plan, out) && tn_buffer_append(out, "\n", 1) &&
           tn_plan_write_line(schema, plan->trays, plan->length, out);
}

static bool append_kept(const tn_pruned *p, const tn_sifted *plan, tn_buffer *out)
{
    const tn_schema *schema = p->ready->schema;
    return p->format == TN_ANSWER_JSON ? tn_plan_write_json(schema, plan->trays, plan->length, out)
                                       : tn_plan_write_line(schema, plan->trays, plan->length, out);
}

static bool describe_kept(const void *context, const tn_sifted *plan, tn_buffer texts[TN_RELAY_TEXTS])
{
    const tn_pruned *p = context;
    bool kept = is_kept(p, plan);
    if (!kept && p->dropped < 0)
        return true;
    tn_buffer *out = &texts[kept ? 0 : p->dropped];
    bool done = kept                          ? append_kept(p, plan, out)
                : p->format == TN_ANSWER_JSON ? append_dropped_json(p, plan, out)
                                              : append_dropped(p, plan, out);
    return done && tn_buffer_append(out, "\n", 1);
}

tn_answering tn_pruned_answering(const tn_pruned *pruned)
{
    return (tn_answering){.schema = pruned->ready->schema,
                          .rules = pruned->rules,
                          .plan = describe_kept,
                          .rule_name = clause_name,
                          .context = pruned};
}

/* ---- what rules match */

tn_status tn_matched_new(const tn_module *module, const uint32_t *indices, size_t count, uint32_t schema,
                         const tn_rules_options *options, tn_answer_format format, tn_matched *matched, tn_error *error)
{
    *matched = (tn_matched){.module = module, .indices = indices, .count = count, .format = format};
    tn_rules_options asked = *options;
    asked.any = format == TN_ANSWER_ANY;
    uint32_t *functions = malloc(sizeof *functions * (count + 1));
    tn_status status = functions ? tn_schema_new(module, schema, 0, &matched->schema, error) : tn_fail_memory(error);
    for (size_t i = 0; functions && i < count; i++)
        functions[i] = module->RULE_records[indices[i]].holds;
    if (status == TN_OK)
        status = tn_rules_new(matched->schema, functions, count, &asked, &matched->rules, error);
    free(functions);
    return status;
}

void tn_matched_clear(tn_matched *matched)
{
    tn_rules_free(matched->rules);
    tn_schema_free(matched->schema);
    *matched = (tn_matched){0};
}

static const char *rule_name(const void *context, size_t i)
{
    const tn_matched *m = context;
    return tn_text(m->module, m->module->RULE_records[m->indices[i]].name);
}

static bool is_matched(const tn_sifted *plan, size_t i)
{
    return plan->bits[i / 64] >> (i % 64) & 1;
}

/* In one piece: a plan is matched in some nanoseconds, and a call a rule would take longer. */
static bool append_bits(const tn_matched *m, const tn_sifted *plan, tn_buffer *out)
{
    if (!tn_buffer_reserve(out, m->count))
        return false;
    for (size_t i = 0; i < m->count; i++)
        out->data[out->size++] = is_matched(plan, i) ? '1' : '0';
    return true;
}

static bool append_text(tn_buffer *out, const char *text)
{
    return tn_buffer_append(out, text, strlen(text));
}

/* The names of the rules that match, or a dash where there is none. */
static bool append_names(const tn_matched *m, const tn_sifted *plan, tn_buffer *out)
{
    size_t before = out->size;
    for (size_t i = 0; i < m->count; i++) {
        if (!is_matched(plan, i))
            continue;
        if (!append_text(out, out->size > before ? " " : "") || !append_text(out, rule_name(m, i)))
            return false;
    }
    return out->size > before || append_text(out, "-");
}

static bool append_object(const tn_matched *m, const tn_sifted *plan, tn_buffer *out)
{
    tn_json json = tn_json_text(out, TN_JSON_TIGHT);
    tn_buffer line = {0};
    bool done = tn_plan_write_line(m->schema, plan->trays, plan->length, &line);
    tn_json_object(&json, NULL);
    tn_json_count(&json, TN_MATCHED_KEY, plan->line);
    tn_json_string(&json, "plan", line.data ? line.data : "");
    tn_json_list(&json, "rules");
    for (size_t i = 0; i < m->count; i++)
        if (is_matched(plan, i))
            tn_json_string(&json, NULL, rule_name(m, i));
    tn_json_list_end(&json);
    tn_json_object_end(&json);
    free(line.data);
    return done && !out->failed;
}

static bool describe_matched(const void *context, const tn_sifted *plan, tn_buffer texts[TN_RELAY_TEXTS])
{
    const tn_matched *m = context;
    tn_buffer *out = &texts[0];
    bool done;
    if (m->format == TN_ANSWER_BITS)
        done = append_bits(m, plan, out);
    else if (m->format == TN_ANSWER_ANY)
        done = append_text(out, plan->bits[0] ? "1" : "0");
    else if (m->format == TN_ANSWER_NAMES)
        done = append_names(m, plan, out);
    else
        done = append_object(m, plan, out);
    return done && append_text(out, "\n");
}

tn_answering tn_matched_answering(const tn_matched *matched)
{
    return (tn_answering){.schema = matched->schema,
                          .rules = matched->rules,
                          .numbered = matched->format == TN_ANSWER_JSON,
                          .any = matched->format == TN_ANSWER_ANY,
                          .plan = describe_matched,
                          .rule_name = rule_name,
                          .context = matched};
}
