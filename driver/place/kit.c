/* Chooses models of kits, and says which of their conditions do not hold. */
#include "driver/place/kit.h"

#include "driver/open/findings.h"

tn_status tn_kit_choose(tn_opened *opened, const char *name, uint32_t *model)
{
    tn_error error;
    tn_status status = tn_kit_model_find(opened->module, name, model, &error);
    if (status != TN_OK)
        tn_report_error(&opened->compilation.diagnostics, &error, opened->path, NULL, 0);
    return status;
}

void tn_kit_report_unmet(tn_opened *opened, const tn_module *module, const tn_kit_condition_record *condition,
                         const tn_kit_model_record *model, const tn_placed_measures *measured, bool placed)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    const tn_span span = {condition->file, condition->begin, condition->end};
    tn_error error;
    tn_kit_fail_condition(module, condition, model, measured, placed, &error);
    tn_diagnostic *d = tn_report(list, error.code, span, "%s", error.message);
    if (error.help[0])
        tn_help(list, d, "%s", error.help);
}

tn_status tn_kit_conditions(tn_opened *opened, uint32_t model, const tn_placed_measures *measured, bool tests,
                            bool placed, tn_kit_tally *tally)
{
    const tn_module *module = opened->module;
    const tn_kit_model_record *record = &module->KIT_MODEL_records[model];
    const tn_kit_condition_record *unmet;
    size_t before = tally->failed;
    uint32_t i = 0;
    while ((unmet = tn_kit_next_unmet(module, record, measured, tests, &i, tally)) != NULL)
        tn_kit_report_unmet(opened, module, unmet, record, measured, placed);
    return tally->failed > before ? TN_INVALID : TN_OK;
}

static tn_status test_model(tn_opened *opened, uint32_t model, tn_watch *watch, tn_kit_tally *tally)
{
    tn_place_rules rules;
    tn_placed_model placed = {0};
    tn_placed_measures measured = {0};
    tn_error error;
    tn_status status = tn_place_rules_of_model(opened->module, model, &rules, &error);
    if (status == TN_OK) {
        tn_place_options options = {.watch = watch};
        status = tn_place_model(opened, &rules, &options, &placed);
        tn_place_rules_clear(&rules);
        if (status != TN_OK) {
            tally->failed++;
            tn_placed_model_clear(&placed);
            return status;
        }
        status = tn_placed_measure(opened->module, &opened->module->KIT_MODEL_records[model], &placed, watch, &measured,
                                   &error);
    }
    if (status != TN_OK)
        tn_report_error(&opened->compilation.diagnostics, &error, opened->path, NULL, 0);
    else
        status = tn_kit_conditions(opened, model, &measured, true, true, tally);
    tn_placed_measures_clear(&measured);
    tn_placed_model_clear(&placed);
    return status;
}

tn_status tn_kit_tests_run(tn_opened *opened, tn_watch *watch, tn_kit_tally *tally)
{
    tn_status worst = TN_OK;
    *tally = (tn_kit_tally){0};
    for (uint32_t i = 0; i < opened->module->KIT_MODEL_count; i++) {
        tn_status status = test_model(opened, i, watch, tally);
        if (status != TN_OK && status != TN_INVALID)
            return status;
        worst = status != TN_OK ? status : worst;
    }
    return worst;
}
