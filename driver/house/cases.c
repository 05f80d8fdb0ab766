/* Reads the houses of tests, and asks which of their cases come out otherwise without a part of a rule. */
#include "driver/house/cases.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

static uint32_t form_of(const tn_module *module, const tn_test_block *block)
{
    return block->is_library   ? module->HOUSE_LIBRARY_records[block->index].form
           : block->is_measure ? module->HOUSE_MEASURE_records[block->index].form
                               : module->HOUSE_RULE_records[block->index].form;
}

static tn_status read_case(tn_house_cases *cases, const tn_test_block *block, const tn_test_case *test, tn_error *error)
{
    if (!tn_array_reserve(&cases->items, &cases->capacity, cases->count, 1, sizeof *cases->items))
        return tn_fail_memory(error);
    tn_house_case *made = &cases->items[cases->count];
    *made = (tn_house_case){.block = block, .test = test, .form = form_of(cases->opened->module, block)};
    tn_status status = tn_house_read_open(&cases->judges[made->form].form, test->house, strlen(test->house),
                                          TN_HOUSE_TRAYS_DEFAULT, &made->house, error);
    if (status != TN_OK)
        tn_house_clear(&made->house);
    cases->count += status == TN_OK;
    return status == TN_INVALID || status == TN_LIMIT ? TN_OK : status;
}

static tn_status read_block(tn_house_cases *cases, const tn_test_block *block, tn_error *error)
{
    const tn_module *module = cases->opened->module;
    tn_house_judge *judge = &cases->judges[form_of(module, block)];
    tn_status status = judge->module ? TN_OK : tn_house_judge_open(module, form_of(module, block), 0, judge, error);
    for (size_t i = 0; status == TN_OK && i < block->case_count; i++)
        status = read_case(cases, block, &block->cases[i], error);
    return status;
}

tn_status tn_house_cases_read(const tn_opened *opened, tn_house_cases *cases, tn_error *error)
{
    const tn_program *program = opened->compilation.program;
    *cases =
        (tn_house_cases){.opened = opened, .judges = calloc(opened->module->FORM_count + 1, sizeof *cases->judges)};
    tn_status status = cases->judges ? TN_OK : tn_fail_memory(error);
    for (size_t b = 0; status == TN_OK && b < program->test_count; b++)
        if (program->tests[b].of_houses && !program->tests[b].imported && !program->tests[b].with)
            status = read_block(cases, &program->tests[b], error);
    return status;
}

void tn_house_cases_clear(tn_house_cases *cases)
{
    for (size_t i = 0; i < cases->count; i++)
        tn_house_clear(&cases->items[i].house);
    for (size_t i = 0; cases->judges && i < cases->opened->module->FORM_count; i++)
        tn_house_judge_close(&cases->judges[i]);
    free(cases->items);
    free(cases->judges);
    *cases = (tn_house_cases){0};
}

/* ---- what is noticed */

/* What came out of a case of a library, as far as it is asked about: whether the house is kept, and the clauses. */
typedef struct verdict {
    bool holds; /* of a rule */
    tn_house_clause *clauses;
    size_t count;
} verdict;

static tn_status judge_case(tn_house_judge *judge, const tn_house_case *at, verdict *out, tn_error *error)
{
    if (at->block->is_library)
        return tn_house_judge_clauses(judge, &judge->module->HOUSE_LIBRARY_records[at->block->index], &at->house,
                                      &out->clauses, &out->count, error);
    tn_status status = tn_house_rules_start(judge->rules, &at->house, error);
    uint32_t holds = judge->module->HOUSE_RULE_records[at->block->index].holds;
    return status == TN_OK ? tn_house_rules_hold(judge->rules, holds, &out->holds, error) : status;
}

static bool is_kept(const verdict *out)
{
    for (size_t i = 0; i < out->count; i++)
        if (out->clauses[i].drops)
            return false;
    return true;
}

static bool is_named(const tn_test_case *test, const char *name)
{
    for (size_t i = 0; i < test->by_count; i++)
        if (strcmp(test->by[i], name) == 0)
            return true;
    return false;
}

/* Both are about the same clauses. */
static bool differ(const tn_test_case *test, const verdict *a, const verdict *b)
{
    if (a->holds != b->holds || is_kept(a) != is_kept(b))
        return true;
    for (size_t i = 0; i < a->count; i++)
        if (a->clauses[i].drops != b->clauses[i].drops && is_named(test, a->clauses[i].name))
            return true;
    return false;
}

static tn_status case_notices(tn_house_judge *judge, const tn_house_case *at, const uint32_t *offsets, size_t count,
                              bool *notice, tn_error *error)
{
    verdict with = {0}, without = {0};
    tn_status status = judge_case(judge, at, &with, error);
    tn_house_rules_disable(judge->rules, offsets, count);
    if (status == TN_OK)
        status = judge_case(judge, at, &without, error);
    tn_house_rules_disable(judge->rules, NULL, 0);
    if (status == TN_OK)
        *notice = differ(at->test, &with, &without);
    free(with.clauses);
    free(without.clauses);
    return status;
}

tn_status tn_house_cases_notice(tn_house_cases *cases, const uint32_t *offsets, size_t count, bool *notice,
                                tn_error *error)
{
    tn_status status = TN_OK;
    *notice = false;
    for (size_t i = 0; status == TN_OK && !*notice && i < cases->count; i++)
        if (!cases->items[i].block->is_measure)
            status =
                case_notices(&cases->judges[cases->items[i].form], &cases->items[i], offsets, count, notice, error);
    return status;
}
