/* Parts of rules: specifiers that no tray meets, and distances that hold only where there is no destination. */
#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/plan/analysis/analysis_data.h"

/* A rule or a written-out clause: what stands between `begin` and `end` of its file. */
typedef struct item {
    uint32_t rule, library; /* one of them TN_NO_RECORD */
    uint32_t holds, file, begin, end;
} item;

/* An expression may be in the code twice, once for each judgement; it is looked at once. */
typedef struct places {
    uint8_t *reached; /* [functions] */
    tn_key seen;      /* opcode, begin, end; one after another */
} places;

static bool is_new(places *seen, tn_opcode opcode, const tn_source_map_record *place, bool *fresh)
{
    *fresh = true;
    for (size_t i = 0; i < seen->seen.size; i += 3) {
        const uint32_t *was = seen->seen.data + i;
        if (was[0] == (uint32_t)opcode && was[1] == place->begin && was[2] == place->end)
            *fresh = false;
    }
    return !*fresh || (tn_key_push(&seen->seen, opcode) && tn_key_push(&seen->seen, place->begin) &&
                       tn_key_push(&seen->seen, place->end));
}

static tn_plan_analysis_finding *report(tn_plan_analysis *analysis, const item *it, tn_found found, uint32_t offset,
                                        size_t plans)
{
    tn_plan_analysis_finding *finding = tn_plan_analysis_add(analysis, found, plans);
    if (!finding)
        return NULL;
    finding->rule = it->rule;
    finding->library = it->library;
    finding->offset = offset;
    return finding;
}

/* ---- specifiers */

static tn_status look_at_specifier(tn_plan_analysis *analysis, const item *it, uint32_t spec, uint32_t offset,
                                   tn_error *error)
{
    for (uint32_t c = 0; c < analysis->classes->count; c++)
        if (tn_spec_meets(analysis->schema, spec, analysis->classes->representative[c]))
            return TN_OK;
    return report(analysis, it, TN_FOUND_NO_TRAY, offset, 0) ? TN_OK : tn_fail_memory(error);
}

/* ---- distances */

/* The plans with a stretch of a relation; for the distance of three relations, with a stretch where it holds. */
static tn_status plans_with(const tn_plan_analysis *analysis, tn_dfa *const *parts, bool distance, tn_dfa **out,
                            tn_error *error)
{
    const tn_marked *marked = tn_lowering_marked(analysis->lowering);
    tn_dfa *relation = NULL;
    if (!distance)
        return tn_marked_anywhere(marked, parts[1], out, error);
    tn_status status = tn_marked_distance(marked, parts[0], parts[1], parts[2], false, &relation, error);
    if (status == TN_OK)
        status = tn_marked_anywhere(marked, relation, out, error);
    tn_dfa_free(relation);
    return status;
}

/* Where the distance is all of a function, the reference engine can be asked: it holds somewhere, and nowhere in plans
 * with a destination is what was searched. Elsewhere the plan is not shown. */
static tn_status confirm(const tn_plan_analysis *analysis, tn_shown_plan *plan, uint32_t function, uint32_t offset,
                         tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    const tn_function_record *record = &module->FUNCTION_records[function];
    uint32_t next = offset + tn_code_read(module->code, offset).length;
    plan->shown = record->kind == TN_FUNCTION_WHOLE && tn_code_read(module->code, next).opcode == TN_OP_RETURN;
    if (!plan->shown)
        return TN_OK;
    bool holds = false;
    tn_status status = tn_plan_vm_plan(analysis->vm, plan->trays, plan->length, error);
    for (size_t i = 0; status == TN_OK && !holds && i < plan->length; i++)
        for (size_t j = i + 1; status == TN_OK && !holds && j <= plan->length; j++)
            status = tn_plan_vm_relation(analysis->vm, function, i, j, &holds, error);
    plan->shown = holds;
    return status == TN_LIMIT ? TN_OK : status;
}

static tn_status report_distance(tn_plan_analysis *analysis, const item *it, const tn_key *word, uint32_t function,
                                 uint32_t offset, tn_error *error)
{
    tn_plan_analysis_finding *finding = report(analysis, it, TN_FOUND_VACUOUS, offset, 1);
    if (!finding)
        return tn_fail_memory(error);
    tn_status status = tn_plan_analysis_show(analysis, word, finding->plans, error);
    return status == TN_OK ? confirm(analysis, finding->plans, function, offset, error) : status;
}

static tn_status judge_distance(tn_plan_analysis *analysis, const item *it, const tn_dfa *holding,
                                const tn_dfa *reached, uint32_t function, uint32_t offset, tn_error *error)
{
    tn_search_part parts[2] = {{holding, true}, {reached, true}};
    bool with, without = false;
    tn_key word = {0}, alone = {0};
    tn_status status = tn_plan_analysis_search(analysis, parts, 2, 1, UINT32_MAX, "distance", 0, &word, &with, error);
    if (status == TN_OK && !with)
        status = tn_plan_analysis_search(analysis, parts, 1, 1, UINT32_MAX, "distance", 0, &alone, &without, error);
    if (status == TN_OK && without)
        status = report_distance(analysis, it, &alone, function, offset, error);
    free(word.data);
    free(alone.data);
    return status;
}

static tn_status look_at_distance(tn_plan_analysis *analysis, const item *it, uint32_t function, uint32_t offset,
                                  tn_error *error)
{
    tn_dfa *parts[TN_OPERANDS_MAX] = {NULL}, *holding = NULL, *reached = NULL;
    size_t count;
    tn_error why;
    tn_status status = tn_lower_operands(analysis->lowering, function, offset, parts, &count, &why);
    if (status == TN_OK)
        status = plans_with(analysis, parts, true, &holding, &why);
    if (status == TN_OK)
        status = plans_with(analysis, parts, false, &reached, &why);
    if (status == TN_OK)
        status = judge_distance(analysis, it, holding, reached, function, offset, &why);
    for (size_t i = 0; i < TN_OPERANDS_MAX; i++)
        tn_dfa_free(parts[i]);
    tn_dfa_free(holding);
    tn_dfa_free(reached);
    if (status == TN_LIMIT) {
        why.code_offset = offset;
        return tn_plan_analysis_give_up(analysis, it->rule, it->library, &why, error);
    }
    if (status != TN_OK && error)
        *error = why;
    return status;
}

/* ---- all parts */

static tn_status look_at(tn_plan_analysis *analysis, const item *it, places *seen, uint32_t function, uint32_t offset,
                         const tn_instruction *code, tn_error *error)
{
    if (code->opcode != TN_OP_TRAY && code->opcode != TN_OP_DISTANCE)
        return TN_OK;
    const tn_source_map_record *place = tn_module_place(analysis->schema->module, offset);
    bool fresh;
    if (!place || place->file != it->file || place->begin < it->begin || place->end > it->end)
        return TN_OK;
    if (!is_new(seen, code->opcode, place, &fresh))
        return tn_fail_memory(error);
    if (!fresh)
        return TN_OK;
    return code->opcode == TN_OP_TRAY ? look_at_specifier(analysis, it, (uint32_t)code->first, offset, error)
                                      : look_at_distance(analysis, it, function, offset, error);
}

static tn_status look_through(tn_plan_analysis *analysis, const item *it, places *seen, tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    memset(seen->reached, 0, module->FUNCTION_count);
    seen->reached[it->holds] = 1;
    tn_plan_analysis_mark_called(module, seen->reached);
    for (uint32_t f = 0; f < module->FUNCTION_count; f++) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        for (uint32_t offset = function->code_begin; seen->reached[f] && offset < function->code_end;) {
            tn_instruction code = tn_code_read(module->code, offset);
            tn_status status = look_at(analysis, it, seen, f, offset, &code, error);
            if (status != TN_OK)
                return status;
            offset += code.length;
        }
    }
    return TN_OK;
}

static tn_status look_at_library(tn_plan_analysis *analysis, uint32_t index, places *seen, tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    const tn_library_record *library = &module->LIBRARY_records[index];
    tn_status status = TN_OK;
    for (uint32_t c = 0; status == TN_OK && c < library->clause_count; c++) {
        const tn_clause_record *clause = &module->CLAUSE_records[library->clause_first + c];
        item it = {TN_NO_RECORD, index, clause->holds, clause->file, clause->begin, clause->end};
        status = look_through(analysis, &it, seen, error);
    }
    return status;
}

tn_status tn_plan_analysis_parts(tn_plan_analysis *analysis, tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    places seen = {.reached = malloc(module->FUNCTION_count + 1)};
    tn_status status = seen.reached ? TN_OK : tn_fail_memory(error);
    for (size_t r = 0; status == TN_OK && r < analysis->own_count; r++) {
        const tn_rule_record *rule = &module->RULE_records[analysis->rules[r].record];
        item it = {analysis->rules[r].record, TN_NO_RECORD, rule->holds, rule->file, rule->begin, rule->end};
        if (analysis->rules[r].dfa)
            status = look_through(analysis, &it, &seen, error);
    }
    for (uint32_t l = 0; status == TN_OK && l < module->LIBRARY_count; l++) {
        const tn_library_record *library = &module->LIBRARY_records[l];
        if (library->schema == analysis->schema_index && !(library->flags & TN_IMPORTED))
            status = look_at_library(analysis, l, &seen, error);
    }
    free(seen.reached);
    free(seen.seen.data);
    return status;
}
