/* Chooses models of kits, and says which of their conditions do not hold. */
#include "driver/place/kit.h"

#include <string.h>

#include "driver/open/findings.h"
#include "runtime/module/code.h"

/* "tower, wall", as far as there is room. */
static void list_models(const tn_module *module, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (uint32_t i = 0; i < module->KIT_MODEL_count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%.60s", i ? ", " : "",
                                 tn_text(module, module->KIT_MODEL_records[i].name));
}

tn_status tn_kit_choose(tn_opened *opened, const char *name, uint32_t *model)
{
    const tn_module *module = opened->module;
    tn_diagnostics *list = &opened->compilation.diagnostics;
    char names[400];
    for (*model = 0; name && *model < module->KIT_MODEL_count; ++*model)
        if (strcmp(tn_text(module, module->KIT_MODEL_records[*model].name), name) == 0)
            return TN_OK;
    *model = 0;
    if (!name && module->KIT_MODEL_count == 1)
        return TN_OK;
    list_models(module, names, sizeof names);
    if (module->KIT_MODEL_count == 0) {
        tn_diagnostic *d =
            tn_report_bare(list, TN_ERROR, E_PLACE_NO_MODEL, "%.200s has no model to place", opened->path);
        tn_help(list, d, "write one: `model tower { inside ring; start stud at (0, 0, 0) by wall; }`");
    } else if (name) {
        tn_diagnostic *d = tn_report_bare(list, TN_ERROR, E_PLACE_NO_MODEL, "there is no model `%.100s`", name);
        tn_help(list, d, "there is: %s", names);
    } else {
        tn_diagnostic *d = tn_report_bare(list, TN_ERROR, E_PLACE_NO_MODEL, "which of its %u models?",
                                          (unsigned)module->KIT_MODEL_count);
        tn_help(list, d, "name one by --model: %s", names);
    }
    return TN_INVALID;
}

/* What was found of each term that a condition names: "components is 3, fill is 0.8". */
static void write_found(const tn_module *module, uint32_t function, const tn_placed_measures *measured, char *text,
                        size_t size)
{
    const tn_function_record *f = &module->FUNCTION_records[function];
    bool seen[TN_PLACED_TERM_COUNT] = {false};
    size_t used = 0;
    text[0] = '\0';
    tn_instruction i;
    for (uint32_t offset = f->code_begin; offset < f->code_end && used < size; offset += i.length) {
        i = tn_code_read(module->code, offset);
        if (i.opcode != TN_OP_TERM || seen[i.first])
            continue;
        seen[i.first] = true;
        double value = measured->terms[i.first];
        size_t slot = (size_t)i.first - TN_PLACED_COUNTED;
        const char *comma = used ? ", " : "";
        if (i.first >= TN_PLACED_COUNTED && slot < module->COUNTED_count)
            used += (size_t)snprintf(text + used, size - used, "%scount(%.60s) is %.10g", comma,
                                     tn_text(module, module->COUNTED_records[slot].part), value);
        else
            used += (size_t)snprintf(text + used, size - used, "%s%s is %.10g", comma, tn_placed_terms[i.first], value);
    }
}

/* Is the condition about the part of the space that is filled? A larger space does not raise that. */
static bool asks_fill(const tn_module *module, uint32_t function)
{
    const tn_function_record *f = &module->FUNCTION_records[function];
    tn_instruction i;
    for (uint32_t offset = f->code_begin; offset < f->code_end; offset += i.length) {
        i = tn_code_read(module->code, offset);
        if (i.opcode == TN_OP_TERM && i.first == TN_PLACED_FILL)
            return true;
    }
    return false;
}

bool tn_kit_holds(tn_opened *opened, const tn_module *module, const tn_kit_condition_record *condition, const char *who,
                  const tn_placed_measures *measured, bool placed)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    char found[300];
    if (tn_kit_condition_holds(module, condition->holds, measured))
        return true;
    write_found(module, condition->holds, measured, found, sizeof found);
    tn_diagnostic *d = tn_report(list, E_PLACE_CONDITION, (tn_span){condition->file, condition->begin, condition->end},
                                 "%s does not meet this: %s", who, found);
    if (placed)
        tn_help(list, d, "another --seed%s may help",
                asks_fill(module, condition->holds) ? " or another order of alternatives"
                                                    : ", another order of alternatives, or a larger space");
    return false;
}

tn_status tn_kit_conditions(tn_opened *opened, uint32_t model, const tn_placed_measures *measured, bool tests,
                            bool placed, tn_kit_tally *tally)
{
    const tn_module *module = opened->module;
    const tn_kit_model_record *record = &module->KIT_MODEL_records[model];
    size_t before = tally->failed;
    char who[140];
    snprintf(who, sizeof who, "model %.100s", tn_text(module, record->name));
    for (uint32_t i = 0; i < record->condition_count; i++) {
        const tn_kit_condition_record *condition = &module->KIT_CONDITION_records[record->condition_first + i];
        if (condition->flags & TN_CONDITION_TEST && !tests)
            continue;
        bool holds = tn_kit_holds(opened, module, condition, who, measured, placed);
        tally->passed += holds;
        tally->failed += !holds;
    }
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
