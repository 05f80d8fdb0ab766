/* Runs what the engines do on a module from anywhere. */
#include "tests/fuzz/engines.h"

#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/random.h"
#include "runtime/genome/mapping/mapper.h"
#include "runtime/genome/settings.h"
#include "runtime/growth/model/records.h"
#include "runtime/load.h"
#include "runtime/number/run.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/match/rules.h"
#include "runtime/plan/schema/sum.h"
#include "tests/fuzz/grow.h"

enum {
    GRAMMARS = 4,
    CODONS = 8,
    STEPS = 1000,
    SCHEMAS = 8,
    PLANS = 8,
    PLAN_TRAYS = 6,
    STATES = 200,
    RULES = 32,
    CODES = 4096,
    LENGTH = 12
};

/* Both engines on a few plans; where both answer, they answer the same. */
static void match(const tn_schema *schema, uint32_t function)
{
    tn_rules *vm = NULL, *dfa = NULL;
    tn_matcher *by_vm = NULL, *by_dfa = NULL;
    tn_error error;
    bool both =
        tn_rules_new(schema, &function, 1, &(tn_rules_options){TN_ENGINE_VM, STATES, LENGTH, false, TN_SIMD_BEST}, &vm,
                     &error) == TN_OK &&
        tn_rules_new(schema, &function, 1, &(tn_rules_options){TN_ENGINE_DFA, STATES, LENGTH, false, TN_SIMD_BEST},
                     &dfa, &error) == TN_OK &&
        tn_matcher_new(vm, &by_vm, &error) == TN_OK && tn_matcher_new(dfa, &by_dfa, &error) == TN_OK;
    for (uint64_t i = 0; both && i < PLANS; i++) {
        tn_tray trays[PLAN_TRAYS];
        size_t length = i % (PLAN_TRAYS + 1);
        for (size_t k = 0; k < length; k++)
            trays[k] = (tn_tray)(tn_random64(function, i, k) % schema->tray_count);
        uint64_t one = 0, other = 0;
        if (tn_match(by_vm, trays, length, &one, &error) == TN_OK &&
            tn_match(by_dfa, trays, length, &other, &error) == TN_OK && one != other) {
            fprintf(stderr, "the engines decide differently\n");
            abort();
        }
    }
    tn_matcher_free(by_vm);
    tn_matcher_free(by_dfa);
    tn_rules_free(vm);
    tn_rules_free(dfa);
}

static void count(const tn_schema *schema, uint32_t index)
{
    tn_library *library;
    tn_error error;
    tn_library_options options = {.max_states = STATES, .max_length = LENGTH, .max_table = 1u << 20};
    if (tn_library_new(schema, index, &options, &library, &error) != TN_OK)
        return;
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    mpz_clear(kept);
    tn_library_free(library);
}

/* Calls `use` with each schema of a module that can be had. */
static void with_schemas(const tn_module *module, void (*use)(const tn_module *, const tn_schema *, uint32_t))
{
    for (uint32_t i = 0; i < module->SCHEMA_count && i < SCHEMAS; i++) {
        tn_schema *schema;
        tn_error error;
        if (tn_schema_new(module, i, CODES, &schema, &error) != TN_OK)
            continue;
        use(module, schema, i);
        tn_schema_free(schema);
    }
}

static void use_rules(const tn_module *module, const tn_schema *schema, uint32_t index)
{
    for (size_t r = 0; r < module->RULE_count && r < RULES; r++)
        if (module->RULE_records[r].schema == index && schema->tray_count > 0)
            match(schema, module->RULE_records[r].holds);
    for (uint32_t l = 0; l < module->LIBRARY_count && l < RULES; l++)
        if (module->LIBRARY_records[l].schema == index)
            count(schema, l);
}

/* A schema has no more trays than was asked for. */
static void use_trays(const tn_module *module, const tn_schema *schema, uint32_t index)
{
    (void)module;
    (void)index;
    if (schema->tray_count > CODES)
        abort();
}

void fuzz_schema(const tn_module *module)
{
    with_schemas(module, use_trays);
}

void fuzz_match(const tn_module *module)
{
    with_schemas(module, use_rules);
}

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

void fuzz_number(const tn_module *module)
{
    static const double terms[TN_MEASURED_COUNT] = {1, -2, 0, 1e300, 0.5};
    for (size_t i = 0; i < module->FUNCTION_count; i++)
        if (module->FUNCTION_records[i].kind == TN_FUNCTION_MEASURE)
            tn_number_run(module->code, module->FUNCTION_records[i].code_begin, terms);
}

void fuzz_grammar(const tn_module *module)
{
    static const uint64_t codons[CODONS] = {1, 3, 5, 7, 9, 11, 2, 4};
    for (size_t i = 0; i < module->GRAMMAR_count && i < GRAMMARS; i++) {
        tn_grammar *grammar;
        tn_mapping mapping;
        if (tn_grammar_new(module, i, &grammar, NULL) != TN_OK)
            continue;
        tn_map_options options = tn_map_options_of(grammar);
        options.max_steps = STEPS;
        options.record = true;
        tn_mapper *mapper = tn_mapper_new(grammar);
        if (mapper && tn_map_genome(mapper, codons, CODONS, &options, &mapping, NULL) == TN_INVALID)
            abort();
        tn_mapper_free(mapper);
        tn_grammar_free(grammar);
    }
}

void fuzz_growth(const tn_module *module)
{
    grow_module(module);
}

/* What a verified module sets is something that a study could say. */
void fuzz_genome(const tn_module *module)
{
    tn_evolution_study study;
    tn_setting_fault faults[TN_SETTING_FAULTS_MAX];
    if (tn_evolution_study_of(module, &study) && tn_evolution_study_faults(&study, faults) > 0)
        abort();
}

static void list(const tn_module *module)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (out) {
        tn_module_disassemble(module, out);
        fclose(out);
    }
    free(text);
}

void fuzz_engines(const tn_module *module)
{
    list(module);
#define ENGINE(NAME, FUZZ) FUZZ(module);
#include "runtime/engines.def"
}
