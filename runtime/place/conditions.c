/* Holds what was placed to what its model requires. */
#include "runtime/place/conditions.h"

#include <math.h>
#include <stdio.h>

#include "runtime/module/code.h"
#include "runtime/number/run.h"

bool tn_kit_condition_holds(const tn_module *module, uint32_t function, const tn_placed_measures *measured)
{
    double value = tn_number_run(module->code, module->FUNCTION_records[function].code_begin, measured->terms);
    return value != 0 && !isnan(value);
}

const tn_kit_condition_record *tn_kit_next_unmet(const tn_module *module, const tn_kit_model_record *model,
                                                 const tn_placed_measures *measured, bool tests, uint32_t *i,
                                                 tn_kit_tally *tally)
{
    while (*i < model->condition_count) {
        const tn_kit_condition_record *condition = &module->KIT_CONDITION_records[model->condition_first + (*i)++];
        if (condition->flags & TN_CONDITION_TEST && !tests)
            continue;
        bool holds = tn_kit_condition_holds(module, condition->holds, measured);
        tally->passed += holds;
        tally->failed += !holds;
        if (!holds)
            return condition;
    }
    return NULL;
}

/* ---- words */

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

tn_status tn_kit_fail_condition(const tn_module *module, const tn_kit_condition_record *condition,
                                const tn_kit_model_record *model, const tn_placed_measures *measured, bool placed,
                                tn_error *error)
{
    char found[300];
    write_found(module, condition->holds, measured, found, sizeof found);
    tn_fail(error, TN_INVALID, E_PLACE_CONDITION, "%s %.100s does not meet this: %s", model ? "model" : "the",
            model ? tn_text(module, model->name) : "model", found);
    if (placed)
        tn_error_help(error, "another --seed%s may help",
                      asks_fill(module, condition->holds) ? " or another order of alternatives"
                                                          : ", another order of alternatives, or a larger space");
    return TN_INVALID;
}

/* ---- measuring */

static bool requires_something(const tn_place_rules *rules)
{
    const tn_kit_model_record *model = rules->space;
    for (uint32_t i = 0; model && i < model->condition_count; i++)
        if (!(rules->module->KIT_CONDITION_records[model->condition_first + i].flags & TN_CONDITION_TEST))
            return true;
    return false;
}

tn_status tn_kit_measure_required(const tn_place_rules *rules, const tn_placed_model *model, tn_watch *watch,
                                  bool *required, tn_placed_measures *measured, tn_error *error)
{
    *required = requires_something(rules);
    *measured = (tn_placed_measures){0};
    return *required ? tn_placed_measure(rules->module, rules->space, model, watch, measured, error) : TN_OK;
}
