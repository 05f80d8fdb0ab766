/* Parts of rules: specifiers that no tray meets, and distances that hold only where there is no destination. */
#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/plan/analysis/analysis_data.h"
#include "runtime/plan/match/vm.h"

/* A rule or a written-out clause: what stands between `begin` and `end` of its file. */
typedef struct item {
    uint32_t rule, library; /* one of them TN_NO_RECORD */
    uint32_t holds, file, begin, end;
} item;

/* A specifier or a distance in the code, and the text that it was made from. */
typedef struct part {
    tn_source_map_record place;
    tn_instruction code;
    uint32_t function, offset;
    size_t first; /* of those with this text: an expression may be in the code twice, once for each judgement */
    bool seen;    /* of the first of these: it is looked at once */
} part;

typedef struct code_parts {
    part *all; /* by their places */
    size_t count;
    const part **chosen; /* [count]: those of the item at hand */
    uint8_t *reached;    /* [functions] */
} code_parts;

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
    plan->shown = tn_function_is_whole(record) && tn_code_read(module->code, next).opcode == TN_OP_RETURN;
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

static int compare(uint32_t a, uint32_t b)
{
    return (a > b) - (a < b);
}

static int by_code(const part *a, const part *b)
{
    int order = compare(a->function, b->function);
    return order ? order : compare(a->offset, b->offset);
}

static int by_text(const part *a, const part *b)
{
    int order = compare(a->place.file, b->place.file);
    order = order ? order : compare(a->place.begin, b->place.begin);
    order = order ? order : compare(a->place.end, b->place.end);
    return order ? order : compare((uint32_t)a->code.opcode, (uint32_t)b->code.opcode);
}

static int part_order(const void *a, const void *b)
{
    int order = by_text(a, b);
    return order ? order : by_code(a, b);
}

static int chosen_order(const void *a, const void *b)
{
    return by_code(*(const part *const *)a, *(const part *const *)b);
}

/* How many there are; they go to `all`, if that is not NULL. */
static size_t list_parts(const tn_module *module, part *all)
{
    size_t count = 0;
    for (uint32_t f = 0; f < module->FUNCTION_count; f++) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        for (uint32_t offset = function->code_begin; offset < function->code_end;) {
            tn_instruction code = tn_code_read(module->code, offset);
            bool looked_at = code.opcode == TN_OP_TRAY || code.opcode == TN_OP_DISTANCE;
            const tn_source_map_record *place = looked_at ? tn_module_place(module, offset) : NULL;
            if (place && all)
                all[count] = (part){.place = *place, .code = code, .function = f, .offset = offset};
            count += place != NULL;
            offset += code.length;
        }
    }
    return count;
}

static tn_status parts_init(code_parts *p, const tn_module *module, tn_error *error)
{
    *p = (code_parts){.count = list_parts(module, NULL)};
    p->all = malloc((p->count + 1) * sizeof *p->all);
    p->chosen = malloc((p->count + 1) * sizeof(const part *));
    p->reached = malloc(module->FUNCTION_count + 1);
    if (!p->all || !p->chosen || !p->reached)
        return tn_fail_memory(error);
    list_parts(module, p->all);
    qsort(p->all, p->count, sizeof *p->all, part_order);
    for (size_t i = 0; i < p->count; i++)
        p->all[i].first = i > 0 && by_text(&p->all[i - 1], &p->all[i]) == 0 ? p->all[i - 1].first : i;
    return TN_OK;
}

static void parts_clear(code_parts *p)
{
    free(p->all);
    free(p->chosen);
    free(p->reached);
}

/* Chooses those whose text is within the item, in the order of the code. */
static size_t choose_parts(code_parts *p, const item *it)
{
    size_t low = 0, high = p->count, count = 0;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        const tn_source_map_record *place = &p->all[middle].place;
        if (place->file < it->file || (place->file == it->file && place->begin < it->begin))
            low = middle + 1;
        else
            high = middle;
    }
    for (size_t i = low; i < p->count && p->all[i].place.file == it->file && p->all[i].place.begin <= it->end; i++)
        if (p->all[i].place.end <= it->end)
            p->chosen[count++] = &p->all[i];
    qsort(p->chosen, count, sizeof *p->chosen, chosen_order);
    return count;
}

static tn_status look_through(tn_plan_analysis *analysis, const item *it, code_parts *p, tn_error *error)
{
    size_t count = choose_parts(p, it);
    tn_status status = TN_OK;
    if (count == 0 || p->chosen[0]->function > it->holds)
        return TN_OK;
    uint32_t lowest = p->chosen[0]->function;
    while (lowest > 0 && analysis->schema->module->FUNCTION_records[lowest - 1].kind == TN_FUNCTION_CIRCLE)
        lowest--; /* it may lead to higher ones */
    memset(p->reached + lowest, 0, it->holds - lowest + 1);
    p->reached[it->holds] = 1;
    tn_plan_analysis_mark_called(analysis->schema->module, p->reached, lowest, it->holds + 1);
    for (size_t i = 0; status == TN_OK && i < count && p->chosen[i]->function <= it->holds; i++) {
        const part *one = p->chosen[i];
        if (!p->reached[one->function] || p->all[one->first].seen)
            continue;
        p->all[one->first].seen = true;
        status = one->code.opcode == TN_OP_TRAY
                     ? look_at_specifier(analysis, it, (uint32_t)one->code.first, one->offset, error)
                     : look_at_distance(analysis, it, one->function, one->offset, error);
    }
    return status;
}

static tn_status look_at_library(tn_plan_analysis *analysis, uint32_t index, code_parts *p, tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    const tn_library_record *library = &module->LIBRARY_records[index];
    tn_status status = TN_OK;
    for (uint32_t c = 0; status == TN_OK && c < library->clause_count; c++) {
        const tn_clause_record *clause = &module->CLAUSE_records[library->clause_first + c];
        item it = {TN_NO_RECORD, index, clause->holds, clause->file, clause->begin, clause->end};
        status = look_through(analysis, &it, p, error);
    }
    return status;
}

tn_status tn_plan_analysis_parts(tn_plan_analysis *analysis, tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    code_parts p;
    tn_status status = parts_init(&p, module, error);
    for (size_t r = 0; status == TN_OK && r < analysis->own_count; r++) {
        const tn_rule_record *rule = &module->RULE_records[analysis->rules[r].record];
        item it = {analysis->rules[r].record, TN_NO_RECORD, rule->holds, rule->file, rule->begin, rule->end};
        if (analysis->rules[r].dfa)
            status = look_through(analysis, &it, &p, error);
    }
    for (uint32_t l = 0; status == TN_OK && l < module->LIBRARY_count; l++) {
        const tn_library_record *library = &module->LIBRARY_records[l];
        if (library->schema == analysis->schema_index && !(library->flags & TN_IMPORTED))
            status = look_at_library(analysis, l, &p, error);
    }
    parts_clear(&p);
    return status;
}
