/* Runs the test blocks about houses: each case is the line of a house, and what a rule or a library makes of it. */
#include "driver/house/tests.h"

#include <stdlib.h>
#include <string.h>

#include "driver/house/judge.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/plan/measure/amount.h"

/* What came out of one case. */
typedef struct outcome {
    bool matched, dropped;
    tn_house_clause *clauses; /* of a library */
    size_t count;
    mpq_t value, wanted; /* of a measure, where it is one */
    tn_worth worth;
} outcome;

/* What adds up costs is compared to the cent. */
static tn_status measure_case(tn_house_judge *judge, const tn_test_block *block, const tn_test_case *test,
                              const tn_house *house, outcome *out, tn_error *error)
{
    tn_house_measured measure = tn_house_measured_of(judge->module, block->index);
    mpq_t parts, cost;
    mpq_inits(parts, cost, NULL);
    mpq_set_str(out->wanted, test->value, 10);
    tn_status status = tn_house_rules_start(judge->rules, house, error);
    if (status == TN_OK)
        status = tn_house_rules_measure(judge->rules, measure, out->value, parts, &out->worth, error);
    if (status == TN_OK && mpq_sgn(parts) != 0)
        status = tn_house_rules_cost(judge->rules, cost, error);
    mpq_mul(cost, cost, parts);
    mpq_add(out->value, out->value, cost);
    if (mpq_sgn(parts) != 0)
        tn_round_to_cent(out->value);
    mpq_clears(parts, cost, NULL);
    return status;
}

static tn_status judge_case(tn_house_judge *judge, const tn_test_block *block, const tn_test_case *test,
                            const tn_house *house, outcome *out, tn_error *error)
{
    const tn_module *module = judge->module;
    if (block->is_measure)
        return measure_case(judge, block, test, house, out, error);
    if (block->is_library) {
        tn_status status = tn_house_judge_clauses(judge, &module->HOUSE_LIBRARY_records[block->index], house,
                                                  &out->clauses, &out->count, error);
        for (size_t i = 0; i < out->count; i++)
            out->dropped |= out->clauses[i].drops;
        return status;
    }
    tn_status status = tn_house_rules_start(judge->rules, house, error);
    return status == TN_OK
               ? tn_house_rules_hold(judge->rules, module->HOUSE_RULE_records[block->index].holds, &out->matched, error)
               : status;
}

static bool is_reason(const outcome *out, const char *name)
{
    for (size_t i = 0; i < out->count; i++)
        if (out->clauses[i].drops && strcmp(out->clauses[i].name, name) == 0)
            return true;
    return false;
}

static bool comes_out(const tn_test_case *test, const outcome *out)
{
    if (test->expectation == TN_EXPECT_VALUE)
        return out->worth == TN_HAS_WORTH && mpq_equal(out->value, out->wanted);
    if (test->expectation == TN_EXPECT_MATCH || test->expectation == TN_EXPECT_REJECT)
        return out->matched == (test->expectation == TN_EXPECT_MATCH);
    bool good = out->dropped == (test->expectation == TN_EXPECT_DROP);
    for (size_t i = 0; i < test->by_count; i++)
        good &= is_reason(out, test->by[i]);
    return good;
}

static const char *verb(const tn_test_block *block, const tn_test_case *test, const outcome *out)
{
    if (!block->is_library)
        return test->expectation == TN_EXPECT_MATCH ? "should match this house, and does not"
                                                    : "should not match this house, and does";
    if (test->expectation == TN_EXPECT_KEEP)
        return "should keep this house, and drops it";
    return out->dropped ? "drops this house, but by other clauses" : "should drop this house, and keeps it";
}

static tn_diagnostic *report_value(tn_opened *opened, const tn_house_judge *judge, const tn_test_block *block,
                                   const tn_test_case *test, const outcome *out)
{
    tn_house_measured measure = tn_house_measured_of(judge->module, block->index);
    tn_amount_unit unit = tn_amount_unit_of(judge->schema, judge->module->SUM_records[measure.sum].power);
    tn_buffer is = {0}, should = {0};
    tn_amount_write(unit, out->value, &is);
    tn_amount_write(unit, out->wanted, &should);
    const char *text = out->worth == TN_HAS_WORTH ? is.data : "no number";
    tn_diagnostic *d =
        tn_report(&opened->compilation.diagnostics, E_TEST_FAILED, test->span, "`%s` is %s for this house, not %s",
                  block->subject, text ? text : "?", should.data ? should.data : "?");
    free(is.data);
    free(should.data);
    return d;
}

static void report(tn_opened *opened, const tn_house_judge *judge, const tn_test_block *block, const tn_test_case *test,
                   const outcome *out)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_diagnostic *d = block->is_measure ? report_value(opened, judge, block, test, out)
                                         : tn_report(list, E_TEST_FAILED, test->span, "`%s` %s", block->subject,
                                                     verb(block, test, out));
    if (test->doc)
        tn_note(list, d, NULL, "expected because: %s", test->doc);
    for (size_t i = 0; i < out->count; i++) {
        const tn_house_clause *clause = &out->clauses[i];
        tn_span place = {clause->file, clause->begin, clause->end};
        bool known = clause->file < opened->compilation.sources.count;
        if (clause->drops)
            tn_note(list, d, known ? &place : NULL, "`%s` drops it%s%s", clause->name, *clause->doc ? ": " : "",
                    clause->doc);
    }
}

/* A plan that has several houses, where the line of one of them is wanted. */
static void report_plan(tn_opened *opened, const tn_test_case *test, const tn_error *error)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_diagnostic *d = tn_report(list, E_NOT_A_HOUSE, test->house_place,
                                 "what is tested is about houses, and this is a plan that leaves choices");
    const char *missing = strstr(error->message, ": ");
    if (missing)
        tn_note(list, d, NULL, "%s%s%s", missing + 2, error->help[0] ? ": " : "", error->help);
    tn_help(list, d,
            "write the line of a house: `[plan ; options ; functions ; faces]`; parts at the end may be left out if "
            "they leave no choice");
}

/* The columns of the line become places of the file; that behind its end is the bracket's, where a word is missing. */
static void report_line(tn_opened *opened, const tn_test_case *test, const tn_error *error)
{
    tn_span place = test->house_place;
    uint32_t size = place.end - place.begin;
    if (error->column == size + 1 && test->plan_alone) {
        report_plan(opened, test, error);
        return;
    }
    if (error->column > 0 && error->column <= size + 1) {
        place.end = place.begin + (error->column_end > error->column ? error->column_end - 1 : error->column);
        place.begin += error->column - 1;
    }
    tn_diagnostic *d = tn_report(&opened->compilation.diagnostics, error->code, place, "%s", error->message);
    if (error->help[0])
        tn_help(&opened->compilation.diagnostics, d, "%s", error->help);
}

static tn_status run_case(tn_opened *opened, tn_house_judge *judge, const tn_test_block *block,
                          const tn_test_case *test, bool *good, tn_error *error)
{
    outcome out = {0};
    tn_house house;
    tn_status status =
        tn_house_read_open(&judge->form, test->house, strlen(test->house), TN_HOUSE_TRAYS_DEFAULT, &house, error);
    *good = false;
    mpq_inits(out.value, out.wanted, NULL);
    if (status == TN_OK)
        status = judge_case(judge, block, test, &house, &out, error);
    if (status == TN_INVALID) {
        report_line(opened, test, error);
        status = TN_OK;
    } else if (status == TN_OK) {
        *good = comes_out(test, &out);
        if (!*good && !test->todo)
            report(opened, judge, block, test, &out);
        if (*good && test->todo) {
            tn_diagnostic *d = tn_report(&opened->compilation.diagnostics, E_TEST_FAILED, test->span,
                                         "this test of `%s` is marked `todo` and passes", block->subject);
            tn_help(&opened->compilation.diagnostics, d, "take `todo` away: it is done");
        }
    }
    mpq_clears(out.value, out.wanted, NULL);
    free(out.clauses);
    tn_house_clear(&house);
    return status;
}

tn_status tn_house_tests_run(tn_opened *opened, const tn_test_block *block, size_t *passed, size_t *failed,
                             size_t *todo, tn_error *error)
{
    const tn_module *module = opened->module;
    uint32_t form = block->is_library   ? module->HOUSE_LIBRARY_records[block->index].form
                    : block->is_measure ? module->HOUSE_MEASURE_records[block->index].form
                                        : module->HOUSE_RULE_records[block->index].form;
    tn_house_judge judge;
    tn_status status = tn_house_judge_open(module, form, 0, &judge, error);
    for (size_t i = 0; status == TN_OK && i < block->case_count; i++) {
        const tn_test_case *test = &block->cases[i];
        bool good;
        status = run_case(opened, &judge, block, test, &good, error);
        size_t *counter = test->todo ? (good ? failed : todo) : good ? passed : failed;
        *counter += status == TN_OK;
    }
    tn_house_judge_close(&judge);
    return status;
}
