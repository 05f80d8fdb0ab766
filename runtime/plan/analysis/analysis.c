/* Searches for plans that decide between rules, and checks each answer with the interpreter. */
#include "runtime/plan/analysis/analysis_data.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/module/code.h"
#include "runtime/plan/match/vm.h"

#define CONFIRM_LENGTH_MAX (1u << 20)        /* of a plan that the reference engine is asked about */
#define CONFIRM_WORK_MAX (UINT64_C(1) << 31) /* word operations, two seconds */

/* Tuples of states of a library's clauses in one search: as many as a library's own automaton may have. */
#define JOINT_STATES_DEFAULT 1000000u

/* ---- findings */

tn_plan_analysis_finding *tn_plan_analysis_add(tn_plan_analysis *analysis, tn_found found, size_t plans)
{
    if (!tn_array_reserve_from(&analysis->findings, &analysis->room, 16, analysis->count, 1,
                               sizeof *analysis->findings))
        return NULL;
    tn_shown_plan *shown = calloc(plans + 1, sizeof *shown);
    if (!shown)
        return NULL;
    tn_plan_analysis_finding *finding = &analysis->findings[analysis->count++];
    *finding = (tn_plan_analysis_finding){.found = found,
                                          .rule = TN_NO_RECORD,
                                          .other = TN_NO_RECORD,
                                          .library = TN_NO_RECORD,
                                          .clause = TN_NO_RECORD,
                                          .offset = TN_NO_OFFSET,
                                          .plans = shown,
                                          .plan_count = plans};
    return finding;
}

void tn_shown_plan_clear(tn_shown_plan *plan)
{
    free(plan->trays);
    *plan = (tn_shown_plan){0};
}

static void finding_clear(tn_plan_analysis_finding *finding)
{
    for (size_t i = 0; i < finding->plan_count; i++)
        tn_shown_plan_clear(&finding->plans[i]);
    free(finding->plans);
    free(finding->reasons);
    free(finding->why);
}

tn_status tn_plan_analysis_give_up(tn_plan_analysis *analysis, uint32_t rule, uint32_t library, const tn_error *why,
                                   tn_error *error)
{
    tn_plan_analysis_finding *finding = tn_plan_analysis_add(analysis, TN_FOUND_NOT_ANALYSED, 0);
    if (!finding)
        return tn_fail_memory(error);
    finding->rule = rule;
    finding->library = library;
    finding->why = malloc(sizeof *finding->why);
    if (!finding->why)
        return tn_fail_memory(error);
    *finding->why = *why;
    return TN_OK;
}

/* ---- plans that show something */

tn_status tn_plan_analysis_search(const tn_plan_analysis *analysis, const tn_search_part *parts, size_t count,
                                  uint32_t min, uint32_t max, const char *what, uint64_t max_work, tn_key *word,
                                  bool *found, tn_error *error)
{
    uint32_t most = count > 2 ? analysis->max_joint : analysis->max_states;
    tn_search search = {.parts = parts,
                        .count = count,
                        .min = min,
                        .max = max,
                        .what = what,
                        .max_states = most,
                        .max_work = max_work,
                        .watch = analysis->schema->module->watch};
    return tn_search_shortest(&search, word, found, error);
}

tn_status tn_plan_analysis_show(const tn_plan_analysis *analysis, const tn_key *word, tn_shown_plan *plan,
                                tn_error *error)
{
    plan->trays = malloc((word->size + 1) * sizeof *plan->trays);
    if (!plan->trays)
        return tn_fail_memory(error);
    for (size_t i = 0; i < word->size; i++)
        plan->trays[i] = analysis->classes->representative[word->data[i]];
    plan->length = word->size;
    plan->shown = true;
    return TN_OK;
}

tn_status tn_plan_analysis_confirm(const tn_plan_analysis *analysis, tn_shown_plan *plan, uint32_t function,
                                   bool expected, tn_error *error)
{
    bool holds = !expected;
    if (!plan->shown)
        return TN_OK;
    tn_status status = tn_plan_vm_plan(analysis->vm, plan->trays, plan->length, error);
    if (status == TN_OK)
        status = tn_plan_vm_holds(analysis->vm, function, &holds, error);
    if (status == TN_LIMIT) {
        plan->shown = false;
        return TN_OK;
    }
    if (status != TN_OK || holds == expected)
        return status;
    const tn_module *module = analysis->schema->module;
    return tn_fail(error, TN_INTERNAL, TN_CODE_NONE,
                   "the two engines disagree about `%.80s`; please report this with the rule file",
                   tn_text(module, module->FUNCTION_records[function].name));
}

/* ---- making */

static bool is_own_library(const tn_plan_analysis *analysis, size_t i)
{
    const tn_library_record *library = &analysis->schema->module->LIBRARY_records[i];
    return library->schema == analysis->schema_index && !(library->flags & TN_IMPORTED);
}

/* Own rules, then used ones. */
static void list_rules(tn_plan_analysis *analysis)
{
    const tn_module *module = analysis->schema->module;
    for (uint32_t imported = 0; imported <= TN_IMPORTED; imported += TN_IMPORTED) {
        for (uint32_t r = 0; r < module->RULE_count; r++) {
            const tn_rule_record *rule = &module->RULE_records[r];
            if (rule->schema != analysis->schema_index || (rule->flags & TN_IMPORTED) != imported)
                continue;
            analysis->rules[analysis->rule_count++] = (tn_plan_analysed_rule){.record = r, .own = !imported};
            analysis->own_count += !imported;
        }
    }
}

/* Which rules the libraries of the named file name. */
static void mark_named(tn_plan_analysis *analysis)
{
    const tn_module *module = analysis->schema->module;
    for (size_t l = 0; l < module->LIBRARY_count; l++) {
        const tn_library_record *library = &module->LIBRARY_records[l];
        for (uint32_t c = 0; is_own_library(analysis, l) && c < library->clause_count; c++)
            for (size_t r = 0; r < analysis->rule_count; r++)
                if (module->RULE_records[analysis->rules[r].record].holds ==
                    module->CLAUSE_records[library->clause_first + c].holds)
                    analysis->rules[r].named = true;
    }
    for (size_t r = 0; r < analysis->rule_count; r++)
        if (analysis->rules[r].own || analysis->rules[r].named)
            analysis->shown[analysis->shown_count++] = r;
}

/* The functions of all rules and of the clauses of the file's libraries. The caller frees the array. */
static uint32_t *list_functions(const tn_plan_analysis *analysis, size_t *count)
{
    const tn_module *module = analysis->schema->module;
    uint32_t *functions = malloc((analysis->rule_count + module->CLAUSE_count + 1) * sizeof *functions);
    *count = 0;
    if (!functions)
        return NULL;
    for (size_t r = 0; r < analysis->rule_count; r++)
        functions[(*count)++] = module->RULE_records[analysis->rules[r].record].holds;
    for (size_t l = 0; l < module->LIBRARY_count; l++) {
        const tn_library_record *library = &module->LIBRARY_records[l];
        for (uint32_t c = 0; is_own_library(analysis, l) && c < library->clause_count; c++)
            functions[(*count)++] = module->CLAUSE_records[library->clause_first + c].holds;
    }
    return functions;
}

/* One pass downwards; *more: a function above the one at hand was marked. */
static void mark_called(const tn_module *module, uint8_t *reached, uint32_t first, uint32_t end, bool *more)
{
    *more = false;
    for (uint32_t f = end; f-- > first;) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        for (uint32_t offset = function->code_begin; reached[f] && offset < function->code_end;) {
            tn_instruction code = tn_code_read(module->code, offset);
            if (tn_code_calls(code.opcode) && code.first >= first && code.first < end) {
                *more |= !reached[code.first] && code.first > f;
                reached[code.first] = 1;
            }
            offset += code.length;
        }
    }
}

void tn_plan_analysis_mark_called(const tn_module *module, uint8_t *reached, uint32_t first, uint32_t end)
{
    bool more = true;
    while (more)
        mark_called(module, reached, first, end, &more);
}

tn_status tn_plan_analysis_needs_length(const tn_module *module, uint32_t function, bool *needs, tn_error *error)
{
    uint8_t *reached = calloc(module->FUNCTION_count + 1, 1);
    *needs = false;
    if (!reached)
        return tn_fail_memory(error);
    reached[function] = 1;
    tn_plan_analysis_mark_called(module, reached, 0, module->FUNCTION_count);
    for (size_t f = 0; f < module->FUNCTION_count; f++) {
        const tn_function_record *record = &module->FUNCTION_records[f];
        for (uint32_t offset = record->code_begin; reached[f] && offset < record->code_end;) {
            tn_instruction code = tn_code_read(module->code, offset);
            *needs |= tn_code_compares(code.opcode) || code.opcode == TN_OP_MIRRORED || code.opcode == TN_OP_AGAIN ||
                      code.opcode == TN_OP_IMAGE;
            offset += code.length;
        }
    }
    free(reached);
    return TN_OK;
}

/* Adds to a set of rules, as bits. Does that change it? */
static bool add_bits(uint64_t *to, const uint64_t *from, size_t words)
{
    uint64_t more = 0;
    for (size_t i = 0; i < words; i++) {
        more |= from[i] & ~to[i];
        to[i] |= from[i];
    }
    return more != 0;
}

/* Adds what the functions are made of by their callees; *more: the callee was a higher one, in a circle. */
static void add_called(const tn_module *module, uint64_t *made, size_t words, bool *more)
{
    *more = false;
    for (size_t f = 0; f < module->FUNCTION_count; f++) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        for (uint32_t offset = function->code_begin; offset < function->code_end;) {
            tn_instruction code = tn_code_read(module->code, offset);
            if (tn_code_calls(code.opcode))
                *more |=
                    add_bits(made + f * words, made + (size_t)code.first * words, words) && code.opcode == TN_OP_AGAIN;
            offset += code.length;
        }
    }
}

/* made: for each function the rules that it is or is made of, `words` words each. Callees have lower numbers: theirs
 * are known, but in circles, which are gone round. */
static void find_made(const tn_plan_analysis *analysis, uint64_t *made, size_t words)
{
    const tn_module *module = analysis->schema->module;
    for (size_t r = 0; r < analysis->rule_count; r++) {
        const tn_rule_record *rule = &module->RULE_records[analysis->rules[r].record];
        made[rule->whole * words + r / 64] |= UINT64_C(1) << (r % 64);
        made[rule->holds * words + r / 64] |= UINT64_C(1) << (r % 64);
    }
    bool more = true;
    while (more)
        add_called(module, made, words, &more);
}

static tn_status find_uses(tn_plan_analysis *analysis, tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    size_t words = analysis->rule_count / 64 + 1;
    uint64_t *made = calloc(module->FUNCTION_count + 1, words * sizeof *made);
    bool ok = made != NULL;
    if (ok)
        find_made(analysis, made, words);
    for (size_t r = 0; ok && r < analysis->rule_count; r++) {
        const tn_rule_record *rule = &module->RULE_records[analysis->rules[r].record];
        uint64_t *uses = analysis->rules[r].uses = calloc(words, sizeof *uses);
        ok = uses != NULL;
        if (!ok)
            break;
        add_bits(uses, made + rule->whole * words, words);
        add_bits(uses, made + rule->holds * words, words);
        uses[r / 64] &= ~(UINT64_C(1) << (r % 64));
    }
    free(made);
    return ok ? TN_OK : tn_fail_memory(error);
}

/* *looked_at: is the rule a comparison of sums, a `mirrored` or one that uses itself, or made of one, that a clause of
 * a library of the file uses? */
static tn_status is_looked_at(const tn_plan_analysis *analysis, const tn_rule_record *rule, bool *looked_at,
                              tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    tn_status status = tn_plan_analysis_needs_length(module, rule->holds, looked_at, error);
    if (status != TN_OK || !*looked_at)
        return status;
    uint8_t *reached = calloc(module->FUNCTION_count + 1, 1);
    if (!reached)
        return tn_fail_memory(error);
    for (size_t l = 0; l < module->LIBRARY_count; l++) {
        const tn_library_record *library = &module->LIBRARY_records[l];
        for (uint32_t c = 0; is_own_library(analysis, l) && c < library->clause_count; c++)
            reached[module->CLAUSE_records[library->clause_first + c].holds] = 1;
    }
    tn_plan_analysis_mark_called(module, reached, 0, module->FUNCTION_count);
    *looked_at = reached[rule->holds] || reached[rule->whole];
    free(reached);
    return TN_OK;
}

/* A rule that has no automaton for plans of any length. That is said, but not of a comparison of sums or a `mirrored`
 * that a library of the file uses: it is looked at there, within the library's lengths. */
static tn_status leave_rule(tn_plan_analysis *analysis, tn_plan_analysed_rule *rule, const tn_error *why,
                            tn_error *error)
{
    bool looked_at;
    rule->why = malloc(sizeof *rule->why);
    if (!rule->why)
        return tn_fail_memory(error);
    *rule->why = *why;
    if (!rule->own)
        return TN_OK;
    tn_status status = is_looked_at(analysis, &analysis->schema->module->RULE_records[rule->record], &looked_at, error);
    if (status != TN_OK || looked_at)
        return status;
    return tn_plan_analysis_give_up(analysis, rule->record, TN_NO_RECORD, why, error);
}

static tn_status lower_rules(tn_plan_analysis *analysis, tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    for (size_t r = 0; r < analysis->rule_count; r++) {
        tn_plan_analysed_rule *rule = &analysis->rules[r];
        tn_error why;
        tn_status status = tn_lower(analysis->lowering, module->RULE_records[rule->record].holds, &rule->dfa, &why);
        if (status == TN_OK)
            continue;
        if (status != TN_LIMIT) {
            if (error)
                *error = why;
            return status;
        }
        status = leave_rule(analysis, rule, &why, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status prepare(tn_plan_analysis *analysis, tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    size_t count;
    analysis->rules = calloc(module->RULE_count + 1, sizeof *analysis->rules);
    analysis->shown = calloc(module->RULE_count + 1, sizeof *analysis->shown);
    if (!analysis->rules || !analysis->shown)
        return tn_fail_memory(error);
    list_rules(analysis);
    mark_named(analysis);
    uint32_t *functions = list_functions(analysis, &count);
    tn_status status = functions ? tn_classes_new(analysis->schema, functions, count, &analysis->classes, error)
                                 : tn_fail_memory(error);
    free(functions);
    if (status == TN_OK)
        status = tn_lowering_new(analysis->classes, analysis->max_states, &analysis->lowering, error);
    if (status == TN_OK)
        status = tn_plan_vm_new(analysis->schema, CONFIRM_LENGTH_MAX, &analysis->vm, error);
    if (status == TN_OK) {
        tn_plan_vm_limit(analysis->vm, 0, CONFIRM_WORK_MAX);
        status = find_uses(analysis, error);
    }
    return status == TN_OK ? lower_rules(analysis, error) : status;
}

tn_status tn_plan_analysis_new(const tn_schema *schema, const tn_plan_analysis_options *options, tn_plan_analysis **out,
                               tn_error *error)
{
    static const tn_plan_analysis_options defaults = {0};
    options = options ? options : &defaults;
    uint32_t max_states = options->max_states;
    tn_plan_analysis *analysis = calloc(1, sizeof *analysis);
    if (!analysis)
        return tn_fail_memory(error);
    analysis->schema = schema;
    analysis->schema_index = (uint32_t)(schema->record - schema->module->SCHEMA_records);
    analysis->asked_states = max_states;
    analysis->threads = options->threads;
    analysis->max_states = max_states ? max_states : TN_STATES_DEFAULT;
    analysis->max_joint = max_states ? max_states : JOINT_STATES_DEFAULT;
    analysis->library = options->library;
    analysis->memory = options->memory;
    analysis->crew = tn_crew_new(options->threads, schema->module->watch);
    tn_status status = analysis->crew ? prepare(analysis, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_plan_analysis_rules(analysis, error);
    if (status == TN_OK)
        status = tn_plan_analysis_parts(analysis, error);
    if (status == TN_OK)
        status = tn_plan_analysis_libraries(analysis, error);
    analysis->library = NULL;
    analysis->memory = NULL;
    tn_crew_free(analysis->crew);
    analysis->crew = NULL;
    if (status != TN_OK) {
        tn_plan_analysis_free(analysis);
        return status;
    }
    *out = analysis;
    return TN_OK;
}

void tn_plan_analysis_free(tn_plan_analysis *analysis)
{
    if (!analysis)
        return;
    for (size_t r = 0; r < analysis->rule_count; r++) {
        tn_plan_analysed_rule *rule = &analysis->rules[r];
        tn_dfa_free(rule->dfa);
        free(rule->why);
        free(rule->match.data);
        free(rule->reject.data);
        free(rule->uses);
    }
    for (size_t i = 0; i < analysis->count; i++)
        finding_clear(&analysis->findings[i]);
    tn_plan_vm_free(analysis->vm);
    tn_lowering_free(analysis->lowering);
    tn_classes_free(analysis->classes);
    free(analysis->rules);
    free(analysis->shown);
    free(analysis->relations);
    free(analysis->findings);
    free(analysis);
}

size_t tn_plan_analysis_count(const tn_plan_analysis *analysis)
{
    return analysis->count;
}

const tn_plan_analysis_finding *tn_plan_analysis_get(const tn_plan_analysis *analysis, size_t i)
{
    return &analysis->findings[i];
}
