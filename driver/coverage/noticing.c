/* Runs tests again under changed rules. */
#include "driver/coverage/noticing.h"

#include <stdlib.h>
#include <string.h>

#include "driver/house/tests.h"
#include "driver/open/open.h"
#include "driver/plan/tests.h"
#include "runtime/base/array.h"
#include "runtime/plan/match/rules.h"
#include "runtime/plan/match/same.h"

/* How many cases came out so; and which of those about plans, as a hash. */
typedef struct tally {
    size_t passed, failed, todo;
    uint64_t which;
} tally;

/* A block of tests and how it came out. */
typedef struct noticed_block {
    size_t count;    /* functions: one of a rule, or those of a library's clauses */
    size_t words;    /* of 64 bits for a case */
    uint64_t *bits;  /* [cases][words]: what each function said */
    bool *good;      /* [cases] */
    tally otherwise; /* of measures and houses, and with other values of params */
} noticed_block;

struct tn_noticing {
    tn_opened *opened;
    const tn_program *program;
    const tn_module *module;
    const tn_schema *schema;
    uint32_t schema_index;
    noticed_block *blocks; /* [tests] */
};

static bool is_of_rules(const tn_noticing *n, const tn_test_block *block)
{
    return !block->imported && !block->is_measure && !block->of_houses && !block->with &&
           block->schema == n->schema_index;
}

/* The function of number i of a block, in the module at hand. */
static uint32_t function_of(const tn_module *module, const tn_test_block *block, size_t i)
{
    return block->is_library ? module->CLAUSE_records[module->LIBRARY_records[block->index].clause_first + i].holds
                             : module->RULE_records[block->index].holds;
}

/* ---- plans */

/* What some functions say of every case of a block: bit `which[i]` of each case is set to what function i says. */
static tn_status match_cases(const tn_noticing *n, const tn_schema *schema, const tn_test_block *block,
                             const uint32_t *functions, const size_t *which, size_t count, uint64_t *bits, size_t words,
                             tn_error *error)
{
    static const tn_rules_options options = {.engine = TN_ENGINE_VM};
    tn_rules *rules = NULL;
    tn_matcher *matcher = NULL;
    size_t longest = 0;
    for (size_t k = 0; k < block->case_count; k++)
        longest = block->cases[k].length > longest ? block->cases[k].length : longest;
    tn_tray *trays = malloc((longest + 1) * sizeof *trays);
    uint64_t *said = calloc(count / 64 + 1, sizeof *said);
    tn_status status = trays && said ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_rules_new(schema, functions, count, &options, &rules, error);
    if (status == TN_OK)
        status = tn_matcher_new(rules, &matcher, error);
    for (size_t k = 0; status == TN_OK && k < block->case_count; k++) {
        const tn_test_case *test = &block->cases[k];
        for (size_t t = 0; t < test->length; t++)
            trays[t] = tn_schema_tray(schema, test->values + t * schema->field_count);
        status = tn_watch_check(n->module->watch, error);
        if (status == TN_OK)
            status = tn_match(matcher, trays, test->length, said, error);
        for (size_t i = 0; status == TN_OK && i < count; i++) {
            uint64_t *word = &bits[k * words + which[i] / 64], bit = UINT64_C(1) << (which[i] % 64);
            *word = said[i / 64] >> (i % 64) & 1 ? *word | bit : *word & ~bit;
        }
    }
    tn_matcher_free(matcher);
    tn_rules_free(rules);
    free(trays);
    free(said);
    return status;
}

static tn_status run_block(const tn_noticing *n, const tn_test_block *block, noticed_block *made, tn_error *error)
{
    made->count = block->is_library ? n->module->LIBRARY_records[block->index].clause_count : 1;
    made->words = made->count / 64 + 1;
    made->bits = calloc(tn_size_of(block->case_count, made->words) + 1, sizeof *made->bits);
    made->good = calloc(block->case_count + 1, sizeof *made->good);
    uint32_t *functions = calloc(made->count + 1, sizeof *functions);
    size_t *which = calloc(made->count + 1, sizeof *which);
    tn_status status = made->bits && made->good && functions && which ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < made->count; i++) {
        functions[i] = function_of(n->module, block, i);
        which[i] = i;
    }
    if (status == TN_OK)
        status = match_cases(n, n->schema, block, functions, which, made->count, made->bits, made->words, error);
    for (size_t k = 0; status == TN_OK && k < block->case_count; k++)
        made->good[k] = tn_case_comes_out(n->module, block, &block->cases[k], made->bits + k * made->words);
    free(functions);
    free(which);
    return status;
}

/* Which functions of a block are other code in the changed module. */
static tn_status find_changed(const tn_noticing *n, const tn_schema *changed, const tn_test_block *block,
                              const noticed_block *before, uint32_t *functions, size_t *which, size_t *count,
                              tn_error *error)
{
    tn_status status = TN_OK;
    *count = 0;
    for (size_t i = 0; status == TN_OK && i < before->count; i++) {
        uint32_t then = function_of(changed->module, block, i);
        bool same = true;
        status = tn_functions_same(n->module, function_of(n->module, block, i), changed->module, then, &same, error);
        if (status != TN_OK || same)
            continue;
        functions[*count] = then;
        which[(*count)++] = i;
    }
    return status;
}

static bool has_other_lengths(const tn_module *a, const tn_module *b, const tn_test_block *block)
{
    return block->is_library &&
           (a->LIBRARY_records[block->index].trays_min != b->LIBRARY_records[block->index].trays_min ||
            a->LIBRARY_records[block->index].trays_max != b->LIBRARY_records[block->index].trays_max);
}

static tn_status ask_block(const tn_noticing *n, const tn_schema *changed, const tn_test_block *block,
                           const noticed_block *before, bool *notices, tn_error *error)
{
    size_t size = (block->case_count * before->words + 1) * sizeof(uint64_t), count = 0;
    uint32_t *functions = calloc(before->count + 1, sizeof *functions);
    size_t *which = calloc(before->count + 1, sizeof *which);
    uint64_t *bits = malloc(size);
    tn_status status = functions && which && bits ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = find_changed(n, changed, block, before, functions, which, &count, error);
    bool concerned = count > 0 || has_other_lengths(n->module, changed->module, block);
    if (status == TN_OK && concerned) {
        memcpy(bits, before->bits, size - sizeof(uint64_t));
        if (count > 0)
            status = match_cases(n, changed, block, functions, which, count, bits, before->words, error);
        for (size_t k = 0; status == TN_OK && k < block->case_count && !*notices; k++)
            *notices = tn_case_comes_out(changed->module, block, &block->cases[k], bits + k * before->words) !=
                       before->good[k];
    }
    free(functions);
    free(which);
    free(bits);
    return status;
}

/* ---- measures and houses: they are run as always, and counted */

static void count(tally *counts, size_t i, bool good)
{
    counts->passed += good;
    counts->which = (counts->which ^ (2 * i + good + 1)) * UINT64_C(0x9e3779b97f4a7c15); /* 2^64 by the golden ratio */
}

static tn_status run_values(tn_opened *opened, const tn_test_block *block, tally *counts, tn_error *error)
{
    tn_value_tests values = {0};
    tn_status status = tn_value_tests_new(&values, opened, block, error);
    for (size_t i = 0; status == TN_OK && i < block->case_count; i++) {
        bool good = false;
        const char *message;
        status = tn_value_test(&values, i, &good, &message, error);
        count(counts, i, good);
    }
    tn_value_tests_clear(&values);
    return status;
}

/* A block about plans, all of it. */
static tn_status run_rules(tn_opened *opened, const tn_test_block *block, tally *counts, tn_error *error)
{
    tn_noticing n = {.module = opened->module};
    noticed_block made = {0};
    tn_schema *schema = NULL;
    tn_status status = tn_schema_new(opened->module, block->schema, 0, &schema, error);
    n.schema = schema;
    if (status == TN_OK)
        status = run_block(&n, block, &made, error);
    for (size_t k = 0; status == TN_OK && k < block->case_count; k++)
        count(counts, k, made.good[k]);
    free(made.bits);
    free(made.good);
    tn_schema_free(schema);
    return status;
}

static tn_status run_otherwise(tn_opened *opened, const tn_test_block *block, tally *counts, tn_error *error)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_diagnostics said = *list; /* failures were reported when the tests ran */
    tn_diagnostics_init(list, said.sources);
    tn_status status = block->of_houses
                           ? tn_house_tests_run(opened, block, &counts->passed, &counts->failed, &counts->todo, error)
                       : block->is_measure ? run_values(opened, block, counts, error)
                                           : run_rules(opened, block, counts, error);
    tn_diagnostics_clear(list);
    *list = said;
    return status;
}

static bool is_otherwise(const tn_test_block *block)
{
    return !block->imported && (block->is_measure || block->of_houses || block->with);
}

/* ---- the whole */

/* The file, opened once more for one test after another. */
typedef struct reopened {
    const tn_reopen *reopen;
    size_t test;
    tn_opened opened;
    tn_status status;
} reopened;

static void close_again(reopened *again)
{
    if (again->test)
        tn_close(&again->opened);
    again->test = 0;
}

/* How the block of number b comes out, which is not of plans alone, or has values of params of its own. *opens: it
 * compiles with these. */
static tn_status run_in_turn(tn_opened *opened, size_t b, reopened *again, tally *counts, bool *opens, tn_error *error)
{
    const tn_test_block *block = &opened->compilation.program->tests[b];
    *opens = true;
    if (!block->with)
        return run_otherwise(opened, block, counts, error);
    if (again->test != block->with) {
        close_again(again);
        again->test = block->with;
        again->status = again->reopen->open(again->reopen->context, block->with, &again->opened);
    }
    *opens = again->status == TN_OK;
    if (again->status == TN_INVALID)
        return TN_OK;
    if (again->status != TN_OK)
        return tn_open_error(&again->opened, again->status, error);
    return run_otherwise(&again->opened, &again->opened.compilation.program->tests[b], counts, error);
}

static tn_status open_again(void *context, size_t test, tn_opened *opened)
{
    return tn_open_again(context, NULL, NULL, test, opened);
}

tn_status tn_noticing_new(tn_opened *opened, const tn_schema *schema, tn_noticing **noticing, tn_error *error)
{
    const tn_reopen reopen = {open_again, opened};
    reopened again = {.reopen = &reopen};
    tn_noticing *n = calloc(1, sizeof *n);
    if (!n)
        return tn_fail_memory(error);
    *n = (tn_noticing){.opened = opened,
                       .program = opened->compilation.program,
                       .module = opened->module,
                       .schema = schema,
                       .schema_index = (uint32_t)(schema->record - opened->module->SCHEMA_records)};
    n->blocks = calloc(n->program->test_count + 1, sizeof *n->blocks);
    tn_status status = n->blocks ? TN_OK : tn_fail_memory(error);
    for (size_t b = 0; status == TN_OK && b < n->program->test_count; b++) {
        const tn_test_block *block = &n->program->tests[b];
        bool opens;
        if (is_of_rules(n, block))
            status = run_block(n, block, &n->blocks[b], error);
        else if (is_otherwise(block))
            status = run_in_turn(opened, b, &again, &n->blocks[b].otherwise, &opens, error);
    }
    close_again(&again);
    if (status == TN_OK)
        *noticing = n;
    else
        tn_noticing_free(n);
    return status;
}

void tn_noticing_free(tn_noticing *n)
{
    if (!n)
        return;
    for (size_t b = 0; n->blocks && b < n->program->test_count; b++) {
        free(n->blocks[b].bits);
        free(n->blocks[b].good);
    }
    free(n->blocks);
    free(n);
}

tn_status tn_noticing_ask(const tn_noticing *n, tn_opened *changed_file, const tn_schema *changed,
                          const tn_reopen *reopen, bool *notices, tn_error *error)
{
    const tn_program *program = changed_file->compilation.program;
    reopened again = {.reopen = reopen};
    tn_status status = TN_OK;
    *notices = false;
    for (size_t b = 0; status == TN_OK && !*notices && b < program->test_count; b++)
        if (is_of_rules(n, &program->tests[b]))
            status = ask_block(n, changed, &program->tests[b], &n->blocks[b], notices, error);
    for (size_t b = 0; status == TN_OK && !*notices && b < program->test_count; b++) {
        tally counts = {0};
        bool opens;
        if (!is_otherwise(&program->tests[b]))
            continue;
        status = run_in_turn(changed_file, b, &again, &counts, &opens, error);
        *notices = !opens || memcmp(&counts, &n->blocks[b].otherwise, sizeof counts) != 0;
    }
    close_again(&again);
    return status;
}
