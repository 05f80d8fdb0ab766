/* Test cases of measures. */
#include "driver/plan/value_tests.h"

#include <stdlib.h>

#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/named.h"
#include "runtime/plan/text/text.h"

tn_status tn_value_tests_new(tn_value_tests *values, tn_opened *opened, const tn_test_block *tests, tn_error *error)
{
    size_t longest = 0;
    *values = (tn_value_tests){.opened = opened, .tests = tests};
    for (size_t i = 0; i < tests->case_count; i++)
        longest = tests->cases[i].length > longest ? tests->cases[i].length : longest;
    values->trays = malloc(sizeof *values->trays * (longest + 1));
    if (!values->trays)
        return tn_fail_memory(error);
    tn_status status = tn_schema_new(opened->module, tests->schema, 0, &values->schema, error);
    return status == TN_OK ? tn_plan_vm_new(values->schema, longest, &values->vm, error) : status;
}

void tn_value_tests_clear(tn_value_tests *values)
{
    tn_plan_vm_free(values->vm);
    tn_schema_free(values->schema);
    free(values->trays);
    *values = (tn_value_tests){0};
}

/* value: NULL where there is none. */
static const char *report(const tn_value_tests *values, const tn_test_case *test, mpq_srcptr value, const mpq_t wanted)
{
    const tn_measure_record *measure = &values->opened->module->MEASURE_records[values->tests->index];
    tn_amount_unit unit =
        tn_amount_unit_of(values->schema, tn_named_measure_power(values->opened->module, values->tests->index));
    tn_diagnostics *list = &values->opened->compilation.diagnostics;
    tn_buffer is = {0}, should = {0}, plan = {0};
    if (value)
        tn_amount_write(unit, value, &is);
    tn_amount_write(unit, wanted, &should);
    tn_diagnostic *d =
        tn_report(list, E_TEST_FAILED, test->span, "`%s` is %s for this plan, not %s", values->tests->subject,
                  is.data ? is.data : "nothing", should.data ? should.data : "?");
    if (test->doc)
        tn_note(list, d, NULL, "expected because: %s", test->doc);
    if (tn_plan_write_line(values->schema, values->trays, test->length, &plan))
        tn_note(list, d, NULL, "plan: %s", plan.data ? plan.data : "");
    tn_span place = {measure->file, measure->begin, measure->end};
    tn_note(list, d, &place, "`%s`", values->tests->subject);
    free(is.data);
    free(should.data);
    free(plan.data);
    return d->message;
}

tn_status tn_value_test(tn_value_tests *values, size_t i, bool *good, const char **message, tn_error *error)
{
    *message = NULL;
    const tn_test_case *test = &values->tests->cases[i];
    bool has = false;
    for (size_t k = 0; k < test->length; k++)
        values->trays[k] = tn_schema_tray(values->schema, test->values + k * values->schema->field_count);
    mpq_t value, wanted;
    mpq_inits(value, wanted, NULL);
    tn_status status = tn_plan_vm_plan(values->vm, values->trays, test->length, error);
    if (status == TN_OK)
        status = tn_plan_vm_measure(values->vm, values->tests->index, value, &has, error);
    if (status == TN_OK) {
        mpq_set_str(wanted, test->value, 10);
        *good = has && mpq_equal(value, wanted);
        if (!*good && !test->todo)
            *message = report(values, test, has ? value : NULL, wanted);
    }
    mpq_clears(value, wanted, NULL);
    return status;
}
