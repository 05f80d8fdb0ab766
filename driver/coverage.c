#include "driver/coverage.h"

#include <stdlib.h>
#include <string.h>

#include "driver/library.h"
#include "runtime/plan/coverage.h"
#include "runtime/plan/parts.h"

#define LABEL_WIDTH 58

/* What is measured: the file's library (or each rule by itself), and its tests. */
typedef struct report {
    tn_opened *opened;
    const tn_module *module;
    const tn_library_record *library; /* or NULL */
    uint32_t schema_index, max_states;
    tn_schema *schema;
    tn_coverage *plans; /* of the library; without one, of the rule at hand */
    tn_coverage *tests; /* of all rules and clauses that tests are of; NULL: there are none */
    uint32_t *tested;   /* per test block: its first clause in `tests` */
    tn_buffer *out;
    size_t uncovered, parts;
} report;

static bool is_own_test(const report *r, const tn_test_block *block)
{
    return !block->imported && block->schema == r->schema_index;
}

/* ---- the two sets of clauses */

static tn_status cover_library(report *r, tn_error *error)
{
    tn_coverage_clause *clauses = calloc((size_t)r->library->clause_count + 1, sizeof *clauses);
    if (!clauses)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < r->library->clause_count; i++) {
        const tn_clause_record *clause = &r->module->CLAUSE_records[r->library->clause_first + i];
        clauses[i] = (tn_coverage_clause){clause->holds, clause->kind != TN_CLAUSE_PRUNE};
    }
    tn_status status = tn_coverage_new(r->schema, clauses, r->library->clause_count, r->library->trays_min,
                                       r->library->trays_max, r->max_states, &r->plans, error);
    free(clauses);
    return status;
}

static size_t clauses_of(const report *r, const tn_test_block *block)
{
    return block->is_library ? r->module->LIBRARY_records[block->index].clause_count : 1;
}

static tn_status cover_tests(report *r, tn_error *error)
{
    const tn_program *program = r->opened->compilation.program;
    size_t count = 0;
    r->tested = calloc(program->test_count + 1, sizeof *r->tested);
    if (!r->tested)
        return tn_fail_memory(error);
    for (size_t b = 0; b < program->test_count; b++) {
        r->tested[b] = (uint32_t)count;
        count += is_own_test(r, &program->tests[b]) ? clauses_of(r, &program->tests[b]) : 0;
    }
    tn_coverage_clause *clauses = calloc(count + 1, sizeof *clauses);
    if (!clauses)
        return tn_fail_memory(error);
    for (size_t b = 0; b < program->test_count; b++) {
        const tn_test_block *block = &program->tests[b];
        for (size_t i = 0; is_own_test(r, block) && i < clauses_of(r, block); i++)
            clauses[r->tested[b] + i].function =
                block->is_library
                    ? r->module->CLAUSE_records[r->module->LIBRARY_records[block->index].clause_first + i].holds
                    : r->module->RULE_records[block->index].holds;
    }
    tn_status status =
        count ? tn_coverage_new(r->schema, clauses, count, 0, 0, r->max_states, &r->tests, error) : TN_OK;
    free(clauses);
    return status;
}

/* ---- does a test notice? */

static bool is_dropped(const report *r, size_t block, const tn_library_record *library, bool without,
                       const tn_tray *trays, size_t length)
{
    for (uint32_t i = 0; i < library->clause_count; i++) {
        bool prunes = r->module->CLAUSE_records[library->clause_first + i].kind == TN_CLAUSE_PRUNE;
        if (tn_coverage_holds(r->tests, r->tested[block] + i, without, trays, length) == prunes)
            return true;
    }
    return false;
}

/* Would one of the clauses that a case names come out otherwise? */
static bool names_flip(const report *r, size_t block, const tn_library_record *library, const tn_test_case *test,
                       const tn_tray *trays)
{
    for (uint32_t i = 0; i < library->clause_count; i++) {
        const char *name = tn_text(r->module, r->module->CLAUSE_records[library->clause_first + i].name);
        for (size_t k = 0; k < test->by_count; k++)
            if (strcmp(test->by[k], name) == 0 &&
                tn_coverage_holds(r->tests, r->tested[block] + i, false, trays, test->length) !=
                    tn_coverage_holds(r->tests, r->tested[block] + i, true, trays, test->length))
                return true;
    }
    return false;
}

static bool case_notices(const report *r, size_t b, const tn_test_case *test, tn_tray *trays)
{
    const tn_test_block *block = &r->opened->compilation.program->tests[b];
    for (size_t i = 0; i < test->length; i++)
        trays[i] = tn_schema_tray(r->schema, test->values + i * r->schema->field_count);
    if (!block->is_library)
        return tn_coverage_holds(r->tests, r->tested[b], false, trays, test->length) !=
               tn_coverage_holds(r->tests, r->tested[b], true, trays, test->length);
    const tn_library_record *library = &r->module->LIBRARY_records[block->index];
    if (test->length < library->trays_min || test->length > library->trays_max)
        return false;
    return is_dropped(r, b, library, false, trays, test->length) !=
               is_dropped(r, b, library, true, trays, test->length) ||
           names_flip(r, b, library, test, trays);
}

static tn_status tests_notice(const report *r, bool *notice, tn_error *error)
{
    const tn_program *program = r->opened->compilation.program;
    size_t longest = 0;
    for (size_t b = 0; b < program->test_count; b++)
        for (size_t i = 0; i < program->tests[b].case_count; i++)
            longest = program->tests[b].cases[i].length > longest ? program->tests[b].cases[i].length : longest;
    tn_tray *trays = malloc((longest + 1) * sizeof *trays);
    *notice = false;
    if (!trays)
        return tn_fail_memory(error);
    for (size_t b = 0; r->tests && b < program->test_count && !*notice; b++)
        for (size_t i = 0; is_own_test(r, &program->tests[b]) && i < program->tests[b].case_count && !*notice; i++)
            *notice = case_notices(r, b, &program->tests[b].cases[i], trays);
    free(trays);
    return TN_OK;
}

/* ---- parts */

/* The same part in the other judgement of the rule, and what else was compiled from that place: their instructions. */
static size_t find_offsets(const tn_parts *trees, const tn_part *part, uint32_t *offsets)
{
    const tn_map_record *place = tn_module_place(trees[0].module, part->root);
    size_t count = 0;
    for (int t = 0; t < 2; t++)
        for (uint32_t i = 0; i < trees[t].count; i++) {
            const tn_part *other = &trees[t].parts[i];
            const tn_map_record *its = tn_module_place(trees[t].module, other->root);
            bool same =
                other->root == part->root || (place && its && other->kind == part->kind && place->file == its->file &&
                                              place->begin == its->begin && place->end == its->end);
            if (same)
                offsets[count++] = other->root;
        }
    return count;
}

static tn_status group_digits(const mpz_t number, char text[], size_t size)
{
    char *plain = mpz_get_str(NULL, 10, number);
    size_t length = plain ? strlen(plain) : 0, used = 0;
    for (size_t i = 0; i < length && used + 2 < size; i++) {
        if (i > 0 && (length - i) % 3 == 0)
            text[used++] = ',';
        text[used++] = plain[i];
    }
    text[used] = '\0';
    free(plain);
    return plain ? TN_OK : TN_MEMORY;
}

static tn_status report_part(report *r, const tn_parts *trees, uint32_t part, unsigned depth, uint32_t *offsets,
                             tn_error *error)
{
    char label[LABEL_WIDTH], digits[160];
    bool notice = false;
    mpz_t flips;
    mpz_init(flips);
    size_t count = find_offsets(trees, &trees[0].parts[part], offsets);
    tn_status status = tn_coverage_without(r->plans, offsets, count, error);
    if (status == TN_OK)
        status = tn_coverage_flips(r->plans, flips, error);
    if (status == TN_OK && r->tests)
        status = tn_coverage_without(r->tests, offsets, count, error);
    if (status == TN_OK)
        status = tests_notice(r, &notice, error);
    if (status == TN_OK) {
        tn_part_text(&trees[0], part, label, sizeof label - 2 * (depth < 8 ? depth : 8));
        bool written = group_digits(flips, digits, sizeof digits) == TN_OK &&
                       tn_buffer_printf(r->out, "  %*s%-*s %26s  %s\n", (int)(2 * depth), "",
                                        LABEL_WIDTH - (int)(2 * depth), label, digits, notice ? "yes" : "no");
        status = written ? TN_OK : tn_fail_memory(error);
        r->parts++;
        r->uncovered += !notice;
    }
    mpz_clear(flips);
    return status;
}

static tn_status report_parts(report *r, const tn_parts *trees, tn_error *error)
{
    uint32_t *offsets = malloc(((size_t)trees[0].count + trees[1].count + 1) * sizeof *offsets), at = 0;
    const tn_part *parts = trees[0].parts;
    unsigned depth = 0;
    tn_status status = offsets ? TN_OK : tn_fail_memory(error);
    while (status == TN_OK) {
        if (!tn_part_unwritten(&trees[0], at))
            status = report_part(r, trees, at, depth, offsets, error);
        if (parts[at].first != TN_NO_PART) {
            at = parts[at].first;
            depth++;
            continue;
        }
        for (; at != 0 && parts[at].next == TN_NO_PART; depth--)
            at = parts[at].parent;
        if (at == 0)
            break;
        at = parts[at].next;
    }
    free(offsets);
    return status;
}

/* One rule with all its parts. */
static tn_status report_rule(report *r, const tn_rule_record *rule, tn_error *error)
{
    tn_parts trees[2] = {{0}, {0}};
    tn_coverage_clause alone = {rule->holds, false};
    tn_status status = TN_OK;
    if (!r->library) {
        tn_coverage_free(r->plans);
        r->plans = NULL;
        status = tn_coverage_new(r->schema, &alone, 1, 1, TN_COVERAGE_TRAYS, r->max_states, &r->plans, error);
    }
    if (status == TN_OK)
        status = tn_parts_read(r->module, rule->holds, &trees[0], error);
    if (status == TN_OK)
        status = tn_parts_read(r->module, rule->whole, &trees[1], error);
    size_t before = r->out->size;
    if (status == TN_OK && !tn_buffer_printf(r->out, "%s\n", tn_text(r->module, rule->name)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = report_parts(r, trees, error);
    if (status != TN_OK)
        r->out->size = before;
    tn_parts_clear(&trees[0]);
    tn_parts_clear(&trees[1]);
    return status;
}

static tn_status report_rules(report *r, tn_error *error)
{
    for (uint32_t i = 0; i < r->module->RULE_count; i++) {
        const tn_rule_record *rule = &r->module->RULE_records[i];
        if ((rule->flags & TN_IMPORTED) || rule->schema != r->schema_index)
            continue;
        tn_status status = report_rule(r, rule, error);
        if (status == TN_LIMIT) {
            tn_diagnostic *note = tn_finding_note(r->opened, error);
            tn_note(&r->opened->compilation.diagnostics, note, NULL, "`%s` is not analysed",
                    tn_text(r->module, rule->name));
        } else if (status != TN_OK) {
            return status;
        }
    }
    return TN_OK;
}

/* ---- the whole */

static bool has_own_library(const tn_module *module)
{
    for (size_t i = 0; i < module->LIBRARY_count; i++)
        if (!(module->LIBRARY_records[i].flags & TN_IMPORTED))
            return true;
    return false;
}

static tn_status choose(report *r, const char *name)
{
    uint32_t library;
    if (name || has_own_library(r->module)) {
        tn_status status = tn_library_choose(r->opened, name, &library);
        if (status != TN_OK)
            return status;
        r->library = &r->module->LIBRARY_records[library];
        r->schema_index = r->library->schema;
        return TN_OK;
    }
    for (size_t i = 0; i < r->module->RULE_count; i++)
        if (!(r->module->RULE_records[i].flags & TN_IMPORTED))
            r->schema_index = r->module->RULE_records[i].schema;
    return TN_OK;
}

static tn_status measure(report *r, tn_error *error)
{
    tn_status status = r->library ? cover_library(r, error) : TN_OK;
    if (status == TN_OK)
        status = cover_tests(r, error);
    if (status != TN_OK)
        return status;
    bool ok = r->library ? tn_buffer_printf(r->out, "coverage in `%s`", tn_text(r->module, r->library->name))
                         : tn_buffer_printf(r->out, "coverage over all plans of 1 to %u trays", TN_COVERAGE_TRAYS);
    ok = ok && tn_buffer_printf(r->out, ": what would change if the part never matched\n%-*s %26s  %s\n",
                                LABEL_WIDTH + 2, "part", "plans decided otherwise", "tests notice");
    if (!ok)
        return tn_fail_memory(error);
    status = report_rules(r, error);
    if (status != TN_OK)
        return status;
    ok = tn_buffer_printf(r->out, "%zu of %zu parts noticed by tests\n", r->parts - r->uncovered, r->parts);
    return ok ? TN_OK : tn_fail_memory(error);
}

tn_status tn_coverage_report(tn_opened *opened, const char *library, uint32_t max_states, tn_buffer *out)
{
    report r = {.opened = opened, .module = opened->module, .max_states = max_states, .out = out};
    tn_error error;
    tn_status status = choose(&r, library);
    if (status != TN_OK || !opened->compiled || r.module->SCHEMA_count == 0)
        return status;
    status = tn_schema_new(r.module, r.schema_index, 0, &r.schema, &error);
    if (status == TN_OK)
        status = measure(&r, &error);
    if (status != TN_OK)
        tn_finding_error(opened, &error);
    tn_coverage_free(r.plans);
    tn_coverage_free(r.tests);
    tn_schema_free(r.schema);
    free(r.tested);
    return status;
}
