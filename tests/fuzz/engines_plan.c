/* Schemas, rules and libraries from anywhere: what check, match, explain, draw, export, count, sample, diff, coverage
 * and report do with them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/plan/library.h"
#include "driver/report/report.h"
#include "runtime/base/random.h"
#include "runtime/plan/library/diff.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/parts.h"
#include "runtime/plan/match/rules.h"
#include "runtime/plan/picture/draw.h"
#include "runtime/plan/picture/draw_rule.h"
#include "runtime/plan/schema/sum.h"
#include "runtime/plan/text/export_prolog.h"
#include "runtime/plan/text/export_regex.h"
#include "tests/fuzz/engines.h"

enum {
    SCHEMAS = 8,
    CODES = 4096,
    RULES = 12,
    LIBRARIES = 3,
    PARTS = 6,
    PLANS = 6,
    PLAN_TRAYS = 5,
    LENGTH = 8,
    STATES = 80,
    TABLE = 1 << 20,
    SAMPLES = 2
};

/* ---- schemas */

/* Calls `use` with each schema of a module that can be had. */
static void with_schemas(const tn_module *module, void (*use)(const tn_module *, const tn_schema *, uint32_t))
{
    for (uint32_t i = 0; i < module->SCHEMA_count && i < SCHEMAS; i++) {
        tn_schema *schema;
        if (tn_schema_new(module, i, CODES, &schema, NULL) != TN_OK)
            continue;
        use(module, schema, i);
        tn_schema_free(schema);
    }
}

static size_t random_plan(const tn_schema *schema, uint64_t seed, uint64_t number, tn_tray trays[PLAN_TRAYS])
{
    size_t length = number % (PLAN_TRAYS + 1);
    for (size_t k = 0; k < length; k++)
        trays[k] = (tn_tray)(tn_random64(seed, number, k) % schema->tray_count);
    return length;
}

static void draw_plans(const tn_schema *schema)
{
    tn_picture picture = {0};
    tn_tray trays[2][PLAN_TRAYS];
    tn_drawn_plan plans[2] = {{.trays = trays[0], .number = "1"}, {.trays = trays[1], .heading = "more"}};
    tn_draw_options options = {.number_name = "rank"};
    for (uint64_t i = 0; i < 2; i++)
        plans[i].length = random_plan(schema, 1, 3 + i, trays[i]);
    tn_plans_draw(schema, plans, 2, &options, &picture, NULL);
    fuzz_drawn(&picture);
}

/* A schema has trays, and no more than was asked for. What is written of a plan can be written as JSON too. */
static void use_trays(const tn_module *module, const tn_schema *schema, uint32_t index)
{
    (void)index;
    if (schema->tray_count == 0 || schema->tray_count > CODES)
        fuzz_broken("a schema has no trays, or too many");
    tn_buffer text = {0};
    for (uint64_t i = 0; i < PLANS; i++) {
        tn_tray trays[PLAN_TRAYS];
        tn_plan plan = {0};
        size_t length = random_plan(schema, module->hash, i, trays);
        text.size = 0;
        if (tn_plan_write_json(schema, trays, length, &text) &&
            tn_plan_parse_json(schema, text.data, text.size, PLAN_TRAYS, &plan, NULL) == TN_OK && plan.length != length)
            fuzz_broken("a plan reads back as another");
        free(plan.trays);
        plan = (tn_plan){0};
        text.size = 0;
        if (tn_plan_write_line(schema, trays, length, &text))
            tn_plan_parse_line(schema, text.data ? text.data : "", text.size, PLAN_TRAYS, &plan, NULL);
        free(plan.trays);
    }
    free(text.data);
    if (fuzz_draws(module))
        draw_plans(schema);
}

void fuzz_schema(const tn_module *module)
{
    with_schemas(module, use_trays);
}

/* ---- rules */

/* Both engines on a few plans; where both answer, they answer the same. */
static void match(const tn_schema *schema, uint32_t function)
{
    tn_rules *vm = NULL, *dfa = NULL;
    tn_matcher *by_vm = NULL, *by_dfa = NULL;
    tn_rules_options slow = {TN_ENGINE_VM, STATES, LENGTH, false, TN_SIMD_BEST};
    tn_rules_options fast = {TN_ENGINE_DFA, STATES, LENGTH, true, TN_SIMD_BEST};
    bool both = tn_rules_new(schema, &function, 1, &slow, &vm, NULL) == TN_OK &&
                tn_rules_new(schema, &function, 1, &fast, &dfa, NULL) == TN_OK &&
                tn_matcher_new(vm, &by_vm, NULL) == TN_OK && tn_matcher_new(dfa, &by_dfa, NULL) == TN_OK;
    for (uint64_t i = 0; both && i < PLANS; i++) {
        tn_tray trays[PLAN_TRAYS];
        size_t length = random_plan(schema, function, i, trays);
        uint64_t one = 0, other = 0;
        if (tn_match(by_vm, trays, length, &one, NULL) == TN_OK &&
            tn_match(by_dfa, trays, length, &other, NULL) == TN_OK && one != other)
            fuzz_broken("the engines decide differently");
    }
    tn_matcher_free(by_vm);
    tn_matcher_free(by_dfa);
    tn_rules_free(vm);
    tn_rules_free(dfa);
}

static void read_parts(const tn_module *module, uint32_t function)
{
    tn_parts parts;
    char text[TN_PART_TEXT_MAX];
    if (tn_parts_read(module, function, &parts, NULL) == TN_OK)
        for (uint32_t i = 0; i < parts.count; i++) {
            tn_part_text(&parts, i, text, sizeof text);
            tn_part_unwritten(&parts, i);
            tn_part_size(&parts, i);
        }
    tn_parts_clear(&parts);
}

static void draw_rule(const tn_schema *schema, uint32_t rule)
{
    tn_drawn_rule drawn = tn_drawn_rule_of(schema->module, rule);
    tn_picture picture = {0};
    tn_rules_draw(schema, &drawn, 1, &picture, NULL);
    fuzz_drawn(&picture);
}

static void export_regex(const tn_schema *schema, uint32_t function)
{
    tn_classes *classes = NULL;
    tn_lowering *lowering = NULL;
    tn_dfa *dfa = NULL;
    tn_buffer text = {0};
    if (tn_classes_new(schema, &function, 1, &classes, NULL) == TN_OK &&
        tn_lowering_new(classes, STATES, &lowering, NULL) == TN_OK &&
        tn_lower(lowering, function, &dfa, NULL) == TN_OK && tn_export_regex(dfa, &text, NULL) == TN_OK)
        tn_regex_legend(dfa, classes, &text, NULL);
    free(text.data);
    tn_dfa_free(dfa);
    tn_lowering_free(lowering);
    tn_classes_free(classes);
}

static void export_prolog(const tn_schema *schema)
{
    tn_buffer text = {0};
    tn_export_prolog(schema, &(tn_prolog_options){.fetch = true}, &text, NULL);
    free(text.data);
}

/* ---- explaining */

static void show_explained(const tn_explained *explained)
{
    tn_buffer text = {0};
    tn_picture picture = {0};
    tn_explained_text(explained, true, &text);
    tn_explained_text(explained, false, &text);
    if (fuzz_draws(explained->opened->module))
        tn_explained_draw(explained, true, &picture, NULL);
    fuzz_drawn(&picture);
    free(text.data);
}

/* An explanation decides as the engines do. */
static void check_decision(const tn_schema *schema, const tn_explained *explained)
{
    tn_rules *rules = NULL;
    tn_matcher *matcher = NULL;
    uint64_t bits[4] = {0};
    tn_rules_options options = {TN_ENGINE_VM, STATES, LENGTH, false, TN_SIMD_BEST};
    if (explained->count <= 256 && tn_clause_rules_new(schema, explained->library, &options, &rules, NULL) == TN_OK &&
        tn_matcher_new(rules, &matcher, NULL) == TN_OK &&
        tn_match(matcher, explained->trays, explained->length, bits, NULL) == TN_OK)
        for (size_t i = 0; i < explained->count; i++)
            if (explained->rules[i].drops != tn_clause_drops(schema->module, explained->library, i, bits))
                fuzz_broken("an explanation decides otherwise");
    tn_matcher_free(matcher);
    tn_rules_free(rules);
}

static void explain_library(const tn_opened *opened, const tn_schema *schema, uint32_t index)
{
    const tn_library_record *record = &opened->module->LIBRARY_records[index];
    tn_near_options options = {.max_states = STATES};
    tn_near_finder *finder = NULL;
    tn_near_finder_new(schema, index, &options, &finder, NULL);
    for (uint64_t i = 2; i < PLANS; i += 2) {
        tn_explained explained;
        tn_tray trays[PLAN_TRAYS];
        size_t length = random_plan(schema, opened->module->hash, i, trays);
        if (tn_explained_make(&explained, opened, schema, record, NULL, 0, trays, length, LENGTH, NULL) == TN_OK) {
            check_decision(schema, &explained);
            if (finder)
                tn_explained_near(&explained, finder, 2, NULL);
            show_explained(&explained);
        }
        tn_explained_clear(&explained);
    }
    tn_near_finder_free(finder);
}

static void explain_rule(const tn_opened *opened, const tn_schema *schema, uint32_t rule)
{
    tn_explained explained;
    tn_tray trays[PLAN_TRAYS];
    size_t length = random_plan(schema, opened->module->hash, 5, trays);
    if (tn_explained_make(&explained, opened, schema, NULL, &rule, 1, trays, length, LENGTH, NULL) == TN_OK)
        show_explained(&explained);
    tn_explained_clear(&explained);
}

/* ---- libraries */

/* Ranks are numbers of plans and plans have ranks. */
static void sample(const tn_library *library)
{
    mpz_t ranks[SAMPLES], again;
    tn_tray trays[LENGTH];
    uint32_t length;
    size_t found = 0;
    mpz_init(again);
    for (int i = 0; i < SAMPLES; i++)
        mpz_init(ranks[i]);
    if (tn_library_sample(library, 1, TN_ALL_LENGTHS, SAMPLES, ranks, &found, NULL) == TN_OK)
        for (size_t i = 0; i < found; i++)
            if (!tn_library_unrank(library, ranks[i], trays, &length) || !tn_library_has(library, trays, length) ||
                !tn_library_rank(library, trays, length, again) || mpz_cmp(again, ranks[i]) != 0)
                fuzz_broken("a sampled plan has not the rank that it was sampled by");
    for (int i = 0; i < SAMPLES; i++)
        mpz_clear(ranks[i]);
    mpz_clear(again);
}

/* What a clause keeps out is no less than what only it does. */
static void effects(const tn_library *library)
{
    uint32_t clauses = tn_library_record_of(library)->clause_count, states;
    mpz_t out, only;
    mpz_inits(out, only, NULL);
    for (uint32_t i = 0; i < clauses && i < RULES; i++)
        if (tn_library_effect(library, i, out, only, &states, NULL) == TN_OK && mpz_cmp(out, only) < 0 &&
            mpz_sgn(out) >= 0)
            fuzz_broken("a clause alone keeps out more than it keeps out");
    mpz_clears(out, only, NULL);
}

/* All are kept that are kept: one of each mirror pair is no more. */
static void count(const tn_library *library)
{
    mpz_t kept, mirror;
    char hash[33];
    mpz_inits(kept, mirror, NULL);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    if (tn_library_kept_mirror(library, TN_ALL_LENGTHS, mirror, NULL) == TN_OK && mpz_cmp(kept, mirror) < 0)
        fuzz_broken("there are more mirror pairs than plans");
    tn_library_hash(library, hash);
    mpz_clears(kept, mirror, NULL);
}

/* A library does not differ from itself; from another it may. */
static void compare(const tn_library *before, const tn_library *after)
{
    tn_library_diff *diff;
    mpz_t removed;
    if (tn_library_diff_new(before, after, STATES, NULL, &diff, NULL) != TN_OK)
        return;
    mpz_init(removed);
    tn_library_kept(tn_library_diff_part(diff, TN_DIFF_REMOVED), TN_ALL_LENGTHS, removed);
    if (before == after && (mpz_sgn(removed) != 0 || tn_library_diff_clauses(diff) > 0))
        fuzz_broken("a library differs from itself");
    mpz_clear(removed);
    tn_library_diff_free(diff);
}

static void use_library(const tn_opened *opened, const tn_schema *schema, uint32_t index, const tn_library *before)
{
    tn_library *library;
    tn_library_options options = {.max_states = STATES, .max_length = LENGTH, .max_table = TABLE, .max_eager = 100000};
    explain_library(opened, schema, index);
    if (tn_library_new(schema, index, &options, &library, NULL) != TN_OK)
        return;
    count(library);
    sample(library);
    effects(library);
    compare(library, library);
    if (before)
        compare(before, library);
    tn_library_free(library);
}

/* Each library alone and against the first. */
static void use_libraries(const tn_opened *opened, const tn_schema *schema, uint32_t index)
{
    const tn_module *module = opened->module;
    tn_library_options options = {.max_states = STATES, .max_length = LENGTH, .max_table = TABLE, .max_eager = 100000};
    tn_library *first = NULL;
    for (uint32_t l = 0; l < module->LIBRARY_count && l < LIBRARIES; l++) {
        if (module->LIBRARY_records[l].schema != index)
            continue;
        use_library(opened, schema, l, first);
        if (!first && tn_library_new(schema, l, &options, &first, NULL) != TN_OK)
            first = NULL;
    }
    tn_library_free(first);
}

/* ---- analysis */

static void analyse(const tn_schema *schema)
{
    tn_plan_analysis *analysis;
    tn_plan_analysis_options options = {.max_states = STATES};
    if (tn_plan_analysis_new(schema, &options, &analysis, NULL) != TN_OK)
        return;
    size_t rules = tn_plan_analysis_rule_count(analysis);
    for (size_t i = 0; i < rules && i < PARTS; i++)
        for (size_t j = i + 1; j < rules && j < PARTS; j++) {
            tn_shown_plan examples[3] = {{0}};
            tn_plan_analysis_relation(analysis, i, j);
            if (tn_plan_analysis_examples(analysis, i, j, examples, NULL) == TN_OK)
                for (int e = 0; e < 3; e++)
                    tn_shown_plan_clear(&examples[e]);
        }
    tn_plan_analysis_free(analysis);
}

/* ---- report */

static void write_report(tn_opened *opened, const tn_ready_library *ready)
{
    tn_report_options options = {.seed = 1, .samples = SAMPLES, .max_states = STATES};
    tn_coverage_options coverage = {.max_states = STATES, .imported = true};
    tn_plan_analysis_options analysis = {.max_states = STATES, .library = ready->library};
    tn_plan_analyses analyses = {0};
    tn_covered covered = {0};
    tn_buffer page = {0};
    tn_error error;
    coverage.library = tn_text(opened->module, ready->record->name);
    if (tn_plan_analyse(opened, &analysis, &analyses) == TN_OK &&
        tn_coverage_measure(opened, &coverage, &covered) == TN_OK)
        tn_report_page(opened, ready, &analyses, &covered, &options, &page, &error);
    tn_covered_clear(&covered);
    tn_plan_analyses_free(&analyses);
    free(page.data);
}

/* As `report` makes it, of the first library. */
static void report(tn_opened *opened)
{
    const tn_module *module = opened->module;
    tn_ready_library ready;
    tn_library_options options = {.max_states = STATES, .max_length = LENGTH, .max_table = TABLE};
    if (module->LIBRARY_count == 0)
        return;
    if (tn_library_ready(opened, tn_text(module, module->LIBRARY_records[0].name), &options, &ready) == TN_OK)
        write_report(opened, &ready);
    tn_library_close(&ready);
}

/* ---- all of it */

static bool all_small(const tn_module *module)
{
    for (uint32_t i = 0; i < module->SCHEMA_count; i++) {
        tn_schema *schema;
        if (tn_schema_new(module, i, CODES, &schema, NULL) != TN_OK)
            return false;
        tn_schema_free(schema);
    }
    return module->SCHEMA_count <= SCHEMAS && module->RULE_count <= 4 * RULES;
}

/* As driver/open/open.c opens a module: with its sources, so that findings show their lines. `own` is a copy of it. */
static void open_module(const tn_module *module, tn_module *own, tn_opened *opened)
{
    *own = *module;
    *opened = (tn_opened){.path = "fuzz.tnb", .module = own};
    tn_diagnostics_init(&opened->compilation.diagnostics, &opened->compilation.sources);
    for (size_t i = 0; i < module->SOURCE_count; i++) {
        const char *text = tn_text(module, module->SOURCE_records[i].text);
        uint32_t file;
        if (tn_sources_add(&opened->compilation.sources, tn_text(module, module->SOURCE_records[i].path), text,
                           strlen(text), &file, NULL) != TN_OK)
            return;
    }
}

static void show_findings(tn_opened *opened)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return;
    tn_diagnostics_show(&opened->compilation.diagnostics, &(tn_show_options){.colour = true}, out);
    fclose(out);
    free(text);
}

static void use_rules(const tn_module *module, const tn_schema *schema, uint32_t index)
{
    tn_opened opened;
    tn_module own;
    open_module(module, &own, &opened);
    export_prolog(schema);
    for (uint32_t r = 0; r < module->RULE_count && r < RULES; r++) {
        if (module->RULE_records[r].schema != index)
            continue;
        uint32_t function = module->RULE_records[r].holds;
        match(schema, function);
        read_parts(module, function);
        draw_rule(schema, r);
        export_regex(schema, function);
        explain_rule(&opened, schema, r);
    }
    use_libraries(&opened, schema, index);
    analyse(schema);
    tn_compilation_clear(&opened.compilation);
}

void fuzz_match(const tn_module *module)
{
    with_schemas(module, use_rules);
    if (!all_small(module))
        return;
    tn_opened opened;
    tn_module own;
    open_module(module, &own, &opened);
    report(&opened);
    show_findings(&opened);
    tn_compilation_clear(&opened.compilation);
}

/* ---- sums */

static void use_sums(const tn_module *module, const tn_schema *schema, uint32_t index)
{
    for (uint32_t i = 0; i < module->SUM_count && i < RULES; i++) {
        tn_sum *sum;
        tn_error error;
        if (module->SUM_records[i].schema == index && tn_sum_new(schema, i, &sum, &error) == TN_OK)
            tn_sum_free(sum);
    }
}

void fuzz_sum(const tn_module *module)
{
    with_schemas(module, use_sums);
}
