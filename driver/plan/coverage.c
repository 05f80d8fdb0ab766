/* Measures which parts of a file's rules its tests notice. */
#include "driver/plan/coverage_parts.h"

#include <stdlib.h>
#include <string.h>

#include "compiler/plan/syntax/program.h"
#include "driver/plan/library.h"
#include "runtime/base/array.h"
#include "runtime/plan/analysis/coverage.h"
#include "runtime/plan/match/parts.h"

/* A test of a rule or a library of plans: what measures come to and what houses are is another matter. */
static bool is_own_test(const tn_covering *m, size_t b)
{
    const tn_test_block *block = &m->opened->compilation.program->tests[b];
    bool of_rules = !block->is_measure && !block->of_houses;
    return of_rules && !block->imported && block->schema == m->schema_index && !m->left_out[b];
}

/* ---- the two sets of functions */

static tn_status cover_library(tn_covering *m, tn_error *error)
{
    const tn_library *library = m->options->automaton;
    const tn_library_options options = {.max_states = m->options->max_states};
    tn_status status = TN_OK;
    if (!library) {
        uint32_t index = (uint32_t)(m->library - m->module->LIBRARY_records);
        status = tn_library_new(m->schema, index, &options, &m->automaton, error);
        library = m->automaton;
    }
    return status == TN_OK ? tn_coverage_of_library(library, &m->plans, error) : status;
}

static size_t clauses_of(const tn_covering *m, const tn_test_block *block)
{
    return block->is_library ? m->module->LIBRARY_records[block->index].clause_count : 1;
}

/* Appends the functions of a block; those of a library's clauses are asked one by one. */
static void add_functions(const tn_covering *m, const tn_test_block *block, uint32_t *functions, size_t *count)
{
    for (size_t i = 0; i < clauses_of(m, block); i++)
        functions[(*count)++] =
            block->is_library
                ? m->module->CLAUSE_records[m->module->LIBRARY_records[block->index].clause_first + i].holds
                : m->module->RULE_records[block->index].holds;
}

/* The trays of the longest plan in a test. */
static size_t longest_case(const tn_program *program)
{
    size_t longest = 0;
    for (size_t b = 0; b < program->test_count; b++)
        for (size_t i = 0; i < program->tests[b].case_count; i++)
            longest = program->tests[b].cases[i].length > longest ? program->tests[b].cases[i].length : longest;
    return longest;
}

/* All blocks together, or, where some clause passes a limit, each by itself: those with such a clause are left out, and
 * that is said. */
static tn_status choose_blocks(tn_covering *m, uint32_t *functions, size_t *count, tn_error *error)
{
    const tn_program *program = m->opened->compilation.program;
    uint32_t longest = (uint32_t)longest_case(program);
    tn_status status = TN_OK;
    *count = 0;
    for (size_t b = 0; status == TN_OK && b < program->test_count; b++) {
        const tn_test_block *block = &program->tests[b];
        tn_coverage *alone = NULL;
        size_t first = *count;
        m->tested[b] = (uint32_t)first;
        if (!is_own_test(m, b))
            continue;
        add_functions(m, block, functions, count);
        status = tn_coverage_new(m->schema, functions + first, *count - first, 0, longest, m->options->max_states,
                                 &alone, error);
        tn_coverage_free(alone);
        if (status == TN_LIMIT) {
            tn_diagnostic *note = tn_finding_limit(m->opened, error, NULL);
            tn_note(&m->opened->compilation.diagnostics, note, NULL, "so whether tests of `%s` notice is not known",
                    block->subject);
            m->left_out[b] = true;
            *count = first;
            status = TN_OK;
        }
    }
    return status;
}

static tn_status cover_tests(tn_covering *m, tn_error *error)
{
    const tn_program *program = m->opened->compilation.program;
    size_t count = 0, all = 0;
    m->tested = calloc(program->test_count + 1, sizeof *m->tested);
    m->left_out = calloc(program->test_count + 1, sizeof *m->left_out);
    if (!m->tested || !m->left_out)
        return tn_fail_memory(error);
    for (size_t b = 0; b < program->test_count; b++)
        all += is_own_test(m, b) ? clauses_of(m, &program->tests[b]) : 0;
    uint32_t *functions = calloc(all + 1, sizeof *functions);
    if (!functions)
        return tn_fail_memory(error);
    for (size_t b = 0; b < program->test_count; b++) {
        m->tested[b] = (uint32_t)count;
        if (is_own_test(m, b))
            add_functions(m, &program->tests[b], functions, &count);
    }
    uint32_t most = m->options->max_states, longest = (uint32_t)longest_case(program);
    tn_status status = count ? tn_coverage_new(m->schema, functions, count, 0, longest, most, &m->tests, error) : TN_OK;
    if (status == TN_LIMIT) {
        status = choose_blocks(m, functions, &count, error);
        if (status == TN_OK && count)
            status = tn_coverage_new(m->schema, functions, count, 0, longest, most, &m->tests, error);
    }
    free(functions);
    return status;
}

/* ---- does a test notice? */

static bool is_dropped(const tn_covering *m, size_t block, const tn_library_record *library, bool without,
                       const tn_tray *trays, size_t length)
{
    for (uint32_t i = 0; i < library->clause_count; i++) {
        bool prunes = m->module->CLAUSE_records[library->clause_first + i].kind == TN_CLAUSE_PRUNE;
        if (tn_coverage_holds(m->tests, m->tested[block] + i, without, trays, length) == prunes)
            return true;
    }
    return false;
}

/* Would one of the clauses that a case names come out otherwise? */
static bool names_flip(const tn_covering *m, size_t block, const tn_library_record *library, const tn_test_case *test,
                       const tn_tray *trays)
{
    for (uint32_t i = 0; i < library->clause_count; i++) {
        const char *name = tn_text(m->module, m->module->CLAUSE_records[library->clause_first + i].name);
        for (size_t k = 0; k < test->by_count; k++)
            if (strcmp(test->by[k], name) == 0 &&
                tn_coverage_holds(m->tests, m->tested[block] + i, false, trays, test->length) !=
                    tn_coverage_holds(m->tests, m->tested[block] + i, true, trays, test->length))
                return true;
    }
    return false;
}

static bool case_notices(const tn_covering *m, size_t b, const tn_test_case *test, tn_tray *trays)
{
    const tn_test_block *block = &m->opened->compilation.program->tests[b];
    for (size_t i = 0; i < test->length; i++)
        trays[i] = tn_schema_tray(m->schema, test->values + i * m->schema->field_count);
    if (!block->is_library)
        return tn_coverage_holds(m->tests, m->tested[b], false, trays, test->length) !=
               tn_coverage_holds(m->tests, m->tested[b], true, trays, test->length);
    const tn_library_record *library = &m->module->LIBRARY_records[block->index];
    if (test->length < library->trays_min || test->length > library->trays_max)
        return false;
    return is_dropped(m, b, library, false, trays, test->length) !=
               is_dropped(m, b, library, true, trays, test->length) ||
           names_flip(m, b, library, test, trays);
}

static tn_status tests_notice(const tn_covering *m, bool *notice, tn_error *error)
{
    const tn_program *program = m->opened->compilation.program;
    size_t longest = longest_case(program);
    tn_tray *trays = malloc((longest + 1) * sizeof *trays);
    *notice = false;
    if (!trays)
        return tn_fail_memory(error);
    for (size_t b = 0; m->tests && b < program->test_count && !*notice; b++)
        for (size_t i = 0; is_own_test(m, b) && i < program->tests[b].case_count && !*notice; i++)
            *notice = case_notices(m, b, &program->tests[b].cases[i], trays);
    free(trays);
    return TN_OK;
}

/* ---- parts */

/* The same part in the other judgement of the rule, and what else was compiled from that place: their instructions. */
static size_t find_offsets(const tn_parts *trees, const tn_part *part, uint32_t *offsets)
{
    const tn_source_map_record *place = tn_module_place(trees[0].module, part->root);
    size_t count = 0;
    for (int t = 0; t < 2; t++)
        for (uint32_t i = 0; i < trees[t].count; i++) {
            const tn_part *other = &trees[t].parts[i];
            const tn_source_map_record *its = tn_module_place(trees[t].module, other->root);
            bool same =
                other->root == part->root || (place && its && other->kind == part->kind && place->file == its->file &&
                                              place->begin == its->begin && place->end == its->end);
            if (same)
                offsets[count++] = other->root;
        }
    return count;
}

static tn_covered_part *add_part(tn_covered *covered)
{
    if (!tn_array_reserve(&covered->parts, &covered->capacity, covered->count, 1, sizeof *covered->parts))
        return NULL;
    tn_covered_part *part = &covered->parts[covered->count++];
    *part = (tn_covered_part){0};
    mpz_init(part->flips);
    return part;
}

/* Forgets the parts from `count` on. */
static void drop_parts(tn_covered *covered, size_t count)
{
    while (covered->count > count) {
        tn_covered_part *part = &covered->parts[--covered->count];
        covered->noticed -= part->noticed;
        free(part->text);
        mpz_clear(part->flips);
    }
}

static tn_status measure_plans(tn_covering *m, const uint32_t *offsets, size_t count, tn_covered_part *made,
                               tn_error *error)
{
    tn_status status = tn_coverage_without(m->plans, offsets, count, error);
    if (status == TN_OK)
        status = tn_coverage_flips(m->plans, made->flips, error);
    if (status == TN_OK && m->tests)
        status = tn_coverage_without(m->tests, offsets, count, error);
    return status == TN_OK ? tests_notice(m, &made->noticed, error) : status;
}

static tn_status measure_part(tn_covering *m, const tn_covered_subject *s, uint32_t index, unsigned depth,
                              uint32_t *offsets, tn_error *error)
{
    const tn_part *part = &s->trees[0].parts[index];
    char text[TN_PART_TEXT_MAX];
    tn_covered_part *made = add_part(m->covered);
    if (!made)
        return tn_fail_memory(error);
    tn_part_text(&s->trees[0], index, text, sizeof text);
    made->function = s->function;
    made->name = s->name;
    made->depth = depth;
    made->kind = tn_part_word(part->kind);
    made->text = strdup(text);
    made->root = part->root;
    made->of_houses = s->of_houses;
    size_t count = find_offsets(s->trees, part, offsets);
    tn_status status = made->text ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && s->of_houses)
        status = tn_measure_dependents(m, s, offsets, count, made, error);
    else if (status == TN_OK)
        status = measure_plans(m, offsets, count, made, error);
    m->covered->noticed += made->noticed;
    return status;
}

static tn_status measure_parts(tn_covering *m, const tn_covered_subject *s, tn_error *error)
{
    uint32_t at = 0;
    uint32_t *offsets = malloc(((size_t)s->trees[0].count + s->trees[1].count + 1) * sizeof *offsets);
    const tn_parts *tree = &s->trees[0];
    const tn_part *parts = tree->parts;
    unsigned depth = 0;
    tn_status status = offsets ? TN_OK : tn_fail_memory(error);
    while (status == TN_OK) {
        if (!tn_part_is_step(tree, at))
            status = measure_part(m, s, at, depth, offsets, error);
        if (parts[at].first != TN_NO_PART) {
            depth += !tn_part_is_step(tree, at);
            at = parts[at].first;
            continue;
        }
        while (at != 0 && parts[at].next == TN_NO_PART) {
            at = parts[at].parent;
            depth -= !tn_part_is_step(tree, at);
        }
        if (at == 0)
            break;
        at = parts[at].next;
    }
    free(offsets);
    return status;
}

/* All parts of a rule or clause; none where one of them passes a limit. */
static tn_status try_subject(tn_covering *m, tn_covered_subject *s, tn_error *error)
{
    size_t before = m->covered->count;
    tn_status (*read_parts)(const tn_module *, uint32_t, tn_parts *, tn_error *) =
        s->of_houses ? tn_parts_read_house : tn_parts_read;
    tn_status status = TN_OK;
    if (!m->library && !s->of_houses) {
        tn_coverage_free(m->plans);
        m->plans = NULL;
        status =
            tn_coverage_new(m->schema, &s->function, 1, 1, TN_COVERAGE_TRAYS, m->options->max_states, &m->plans, error);
    }
    if (status == TN_OK)
        status = read_parts(m->module, s->function, &s->trees[0], error);
    if (status == TN_OK && s->whole != UINT32_MAX)
        status = read_parts(m->module, s->whole, &s->trees[1], error);
    if (status == TN_OK)
        status = measure_parts(m, s, error);
    if (status != TN_OK)
        drop_parts(m->covered, before);
    tn_parts_clear(&s->trees[0]);
    tn_parts_clear(&s->trees[1]);
    return status;
}

tn_status tn_measure_subject(tn_covering *m, tn_covered_subject s, tn_error *error)
{
    tn_status status = try_subject(m, &s, error);
    if (status != TN_LIMIT)
        return status;
    if (error->code_offset == TN_NO_OFFSET && !m->library)
        error->code_offset = m->module->FUNCTION_records[s.function].code_begin;
    tn_span library = {0};
    if (m->library)
        library = (tn_span){m->library->file, m->library->begin, m->library->end};
    tn_diagnostic *note = tn_finding_limit(m->opened, error, m->library ? &library : NULL);
    tn_note(&m->opened->compilation.diagnostics, note, NULL, "`%s` is not analysed", s.name);
    return TN_OK;
}

static bool is_named(const tn_covering *m, const tn_rule_record *rule)
{
    for (uint32_t i = 0; m->library && i < m->library->clause_count; i++)
        if (m->module->CLAUSE_records[m->library->clause_first + i].holds == rule->holds)
            return true;
    return false;
}

static tn_status measure_rules(tn_covering *m, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < m->module->RULE_count; i++) {
        const tn_rule_record *rule = &m->module->RULE_records[i];
        tn_watch_tell(m->module->watch, i, (double)m->module->RULE_count);
        bool wanted = !(rule->flags & TN_IMPORTED) || (m->options->imported && is_named(m, rule));
        if (wanted && rule->schema == m->schema_index)
            status = tn_measure_subject(m,
                                        (tn_covered_subject){.function = rule->holds,
                                                             .whole = rule->whole,
                                                             .name = tn_text(m->module, rule->name)},
                                        error);
    }
    return status;
}

/* The clauses that are more than a rule's name. */
static tn_status measure_clauses(tn_covering *m, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && m->library && i < m->library->clause_count; i++) {
        const tn_clause_record *clause = &m->module->CLAUSE_records[m->library->clause_first + i];
        if (tn_function_rule(m->module, clause->holds) == UINT32_MAX)
            status = tn_measure_subject(m,
                                        (tn_covered_subject){.function = clause->holds,
                                                             .whole = UINT32_MAX,
                                                             .name = tn_text(m->module, clause->name)},
                                        error);
    }
    return status;
}

/* ---- the whole */

static bool has_own_library(const tn_module *module)
{
    for (size_t i = 0; i < module->LIBRARY_count; i++)
        if (!(module->LIBRARY_records[i].flags & TN_IMPORTED))
            return true;
    return false;
}

static tn_status choose(tn_covering *m, const char *name)
{
    uint32_t library;
    if (name || has_own_library(m->module)) {
        tn_status status = tn_library_choose(m->opened, name, &library);
        if (status != TN_OK)
            return status;
        m->library = &m->module->LIBRARY_records[library];
        m->schema_index = m->library->schema;
        return TN_OK;
    }
    for (size_t i = 0; i < m->module->RULE_count; i++)
        if (!(m->module->RULE_records[i].flags & TN_IMPORTED))
            m->schema_index = m->module->RULE_records[i].schema;
    return TN_OK;
}

static tn_status measure(tn_covering *m, tn_error *error)
{
    tn_status status = m->library ? cover_library(m, error) : TN_OK;
    if (status == TN_OK)
        status = cover_tests(m, error);
    if (status == TN_OK)
        status = measure_rules(m, error);
    if (status == TN_OK)
        status = measure_clauses(m, error);
    return status == TN_OK && m->module->FORM_count ? tn_measure_houses(m, error) : status;
}

tn_status tn_coverage_measure(tn_opened *opened, const tn_coverage_options *options, tn_covered *covered)
{
    tn_covering m = {.opened = opened, .module = opened->module, .options = options, .covered = covered};
    tn_error error;
    *covered = (tn_covered){.opened = opened};
    tn_status status = choose(&m, options->library);
    if (status != TN_OK || !opened->compiled || m.module->SCHEMA_count == 0)
        return status;
    covered->library = m.library;
    status = tn_schema_new(m.module, m.schema_index, 0, &m.schema, &error);
    if (status == TN_OK)
        status = measure(&m, &error);
    if (status != TN_OK)
        tn_finding_error(opened, &error);
    tn_coverage_free(m.plans);
    tn_coverage_free(m.tests);
    tn_library_free(m.automaton);
    tn_schema_free(m.schema);
    free(m.tested);
    free(m.left_out);
    return status;
}

void tn_covered_clear(tn_covered *covered)
{
    drop_parts(covered, 0);
    for (size_t i = 0; i < covered->form_count; i++)
        tn_form_coverage_clear(&covered->forms[i]);
    free(covered->forms);
    free(covered->parts);
    *covered = (tn_covered){0};
}
