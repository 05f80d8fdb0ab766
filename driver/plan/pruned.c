/* Says whether a library keeps a plan. */
#include "driver/plan/pruned.h"

#include "driver/plan/clauses.h"

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

static bool describe(const void *context, const tn_sifted *plan, tn_buffer texts[TN_RELAY_TEXTS])
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
                          .plan = describe,
                          .rule_name = clause_name,
                          .context = pruned};
}
