/* Chooses models of kits, and says which of their conditions do not hold. */
#include "driver/place/kit.h"

#include "driver/open/open.h"
#include "runtime/module/code.h"
#include "runtime/place/search/search.h"

/* ---- runs a connection grammar and explains where it cannot go on */

tn_span tn_place_step_span(const tn_place_rules *rules, uint32_t step)
{
    const tn_source_map_record *place = tn_module_place(rules->module, rules->steps[step].offset);
    return place ? (tn_span){place->file, place->begin, place->end} : (tn_span){0};
}

/* The production's record says where it was written. */
tn_span tn_place_alternative_span(const tn_place_rules *rules, uint32_t alternative)
{
    const tn_production_record *production = &rules->module->PRODUCTION_records[alternative];
    return (tn_span){production->file, production->begin, production->end};
}

static const char *name_of(const tn_place_rules *rules, uint32_t alternative)
{
    return rules->symbols[tn_place_symbol_of(rules, alternative)].name;
}

static void note_obstacle(tn_diagnostics *list, tn_diagnostic *d, const tn_place_rules *rules,
                          const tn_place_obstacle *obstacle)
{
    if (!obstacle->known)
        return;
    const int32_t *cell = obstacle->cell;
    if (!obstacle->has_step) {
        tn_note(list, d, NULL, "the cell %d %d %d is filled by a bound", cell[0], cell[1], cell[2]);
        return;
    }
    tn_span span = tn_place_step_span(rules, obstacle->step);
    tn_note(list, d, &span, "this filled the cell %d %d %d, after %u part%s", cell[0], cell[1], cell[2],
            obstacle->parts, obstacle->parts == 1 ? "" : "s");
}

static void help_blocked(tn_diagnostics *list, tn_diagnostic *d, const tn_place_symbol *symbol)
{
    if (symbol->drawn)
        tn_help(list, d,
                "what is drawn is not tried first: without its probabilities, %s takes an alternative that fits",
                symbol->name);
    else if (symbol->count == 1)
        tn_help(list, d, "give %s another alternative: one alone is taken whether it fits or not", symbol->name);
    else
        tn_help(list, d,
                "boxes of one alternative are not tried against each other: see that they do not overlap, and "
                "that the last alternative of %s always fits",
                symbol->name);
}

static void report_fault(tn_opened *opened, const tn_place_rules *rules, const tn_placed_model *model,
                         const tn_place_fault *fault, const tn_error *error)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_span span = tn_place_step_span(rules, fault->step), by = tn_place_alternative_span(rules, fault->alternative);
    tn_diagnostic *d = tn_report(list, (tn_code)error->code, span, "%s, after %zu part%s", error->message, model->count,
                                 model->count == 1 ? "" : "s");
    tn_note(list, d, &by, "it is of this alternative of %s", name_of(rules, fault->alternative));
    note_obstacle(list, d, rules, &fault->obstacle);
    if (error->code == E_PLACE_BLOCKED && rules->space)
        tn_help(list, d, "parts with which a model starts lie inside of its space: write `inside room or model(...);`");
    else if (error->code == E_PLACE_BLOCKED)
        help_blocked(list, d, &rules->symbols[tn_place_symbol_of(rules, fault->alternative)]);
    else if (error->code == E_PLACE_FRAME)
        tn_help(list, d, "every ')' needs a '(' before it");
}

/* The same run again, which keeps what it fills. */
static void find_obstacle(const tn_place_rules *rules, const tn_place_options *options, tn_place_fault *fault)
{
    tn_place_options again = *options;
    tn_place_fault found;
    tn_placed_model model;
    tn_error error;
    again.keep_filled = true;
    again.report = NULL;
    if (tn_place_derive(rules, &again, &model, &found, &error) == TN_INVALID)
        fault->obstacle = found.obstacle;
    tn_placed_model_clear(&model);
}

static void warn_of_forced(tn_opened *opened, const tn_place_rules *rules, const tn_placed_model *model)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    if (model->counts.fallbacks == 0)
        return;
    const tn_nonterminal_record *first = &rules->module->NONTERMINAL_records[0];
    tn_diagnostic *d = tn_report(list, W_PLACE_FORCED, (tn_span){first->file, first->begin, first->end},
                                 "%llu time%s no alternative of a symbol fitted, and the last was taken all the same",
                                 (unsigned long long)model->counts.fallbacks, model->counts.fallbacks == 1 ? "" : "s");
    tn_help(list, d, "give the symbol a last alternative that always fits; --trace shows where");
}

static void report_nothing(tn_opened *opened, const tn_place_rules *rules, const tn_error *error)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_span span = tn_place_alternative_span(rules, rules->symbols[rules->start].first);
    tn_help(list, tn_report(list, error->code, span, "%s", error->message), "%s", error->help);
}

tn_status tn_place_model(tn_opened *opened, const tn_place_rules *rules, const tn_place_options *options,
                         tn_placed_model *model)
{
    tn_error error;
    tn_place_fault fault;
    tn_status status = tn_place_run(rules, options, model, &fault, &error);
    if (status == TN_OK)
        warn_of_forced(opened, rules, model);
    if (status == TN_OK || status == TN_STOPPED)
        return status;
    if (status == TN_INVALID && fault.obstacle.known && !options->keep_filled)
        find_obstacle(rules, options, &fault);
    if (status == TN_INVALID && error.code == E_PLACE_NOTHING)
        report_nothing(opened, rules, &error);
    else if (fault.has_step)
        report_fault(opened, rules, model, &fault, &error);
    else
        tn_report_error(&opened->compilation.diagnostics, &error, opened->path, NULL, 0);
    return status;
}

/* ---- chooses models of kits, and says which of their conditions do not hold */

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
