/* Decodes the productions of a connection grammar into symbols, alternatives and steps. */
#include "runtime/place/model/rules.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"

void tn_place_rules_clear(tn_place_rules *rules)
{
    free(rules->symbols);
    free(rules->alternatives);
    free(rules->steps);
    *rules = (tn_place_rules){0};
}

static uint32_t count_steps(const tn_module *module, const tn_production_record *production)
{
    uint32_t count = 0, offset = production->code_begin;
    for (; module->code[offset] != TN_OP_PLACED; count++)
        offset += tn_code_read(module->code, offset).length;
    return count;
}

static void read_vector(const tn_module *module, int64_t index, int32_t to[3])
{
    const tn_vector_record *v = &module->VECTOR_records[index];
    to[0] = (int32_t)v->x;
    to[1] = (int32_t)v->y;
    to[2] = (int32_t)v->z;
}

static tn_step read_step(const tn_module *module, const tn_grammar_record *grammar, const tn_instruction *from,
                         uint32_t offset)
{
    static const uint8_t kinds[TN_OPCODE_COUNT] = {
        [TN_OP_PUSH] = TN_STEP_PUSH,           [TN_OP_POP] = TN_STEP_POP,
        [TN_OP_MOVE] = TN_STEP_MOVE,           [TN_OP_HEADING] = TN_STEP_TURN,
        [TN_OP_COLOUR] = TN_STEP_COLOUR,       [TN_OP_PART] = TN_STEP_PART,
        [TN_OP_FILL] = TN_STEP_FILL,           [TN_OP_FILL_OVER] = TN_STEP_FILL_OVER,
        [TN_OP_BLOCK] = TN_STEP_BLOCK,         [TN_OP_TOUCH] = TN_STEP_TOUCH,
        [TN_OP_BOUND_BOX] = TN_STEP_BOUND_BOX, [TN_OP_BOUND_BALL] = TN_STEP_BOUND_BALL,
        [TN_OP_DERIVE] = TN_STEP_EXPAND,
    };
    tn_step step = {.kind = (tn_step_kind)kinds[from->opcode], .offset = offset};
    switch (tn_opcode_describe((uint8_t)from->opcode)->operands) {
    case TN_OPERANDS_VECTOR:
        read_vector(module, from->first, step.a);
        break;
    case TN_OPERANDS_CORNERS:
        read_vector(module, from->first, step.a);
        read_vector(module, from->second, step.b);
        break;
    case TN_OPERANDS_AMOUNT:
        step.a[0] = (int32_t)from->first;
        break;
    case TN_OPERANDS_PART:
        step.text = tn_text(module, (tn_string)from->first);
        break;
    case TN_OPERANDS_SYMBOL:
        step.index = (uint32_t)from->first - grammar->rule_first;
        break;
    default:
        break;
    }
    return step;
}

static void read_alternative(tn_place_rules *rules, const tn_grammar_record *grammar,
                             const tn_production_record *production)
{
    const tn_module *module = rules->module;
    tn_place_alternative *alternative = &rules->alternatives[rules->alternative_count++];
    uint32_t offset = production->code_begin;
    *alternative = (tn_place_alternative){
        .first = rules->step_count, .offset = offset, .member = production->member, .weight = production->weight};
    while (module->code[offset] != TN_OP_PLACED) {
        tn_instruction instruction = tn_code_read(module->code, offset);
        rules->steps[rules->step_count++] = read_step(module, grammar, &instruction, offset);
        offset += instruction.length;
    }
    alternative->count = rules->step_count - alternative->first;
}

static void read_symbol(tn_place_rules *rules, const tn_grammar_record *grammar, const tn_nonterminal_record *record)
{
    const tn_module *module = rules->module;
    const tn_production_record *productions = &module->PRODUCTION_records[record->production_first];
    tn_place_symbol *symbol = &rules->symbols[rules->symbol_count++];
    double sum = 0;
    bool member = false;
    *symbol = (tn_place_symbol){
        .name = tn_text(module, record->name), .first = rules->alternative_count, .count = record->production_count};
    for (uint32_t i = 0; i < symbol->count; i++) {
        read_alternative(rules, grammar, &productions[i]);
        sum += productions[i].weight;
        member |= productions[i].member > 0;
        rules->alternatives[symbol->first + i].share = sum;
    }
    symbol->drawn = !member && tn_place_draws(sum);
    for (uint32_t i = 0; symbol->drawn && i < symbol->count; i++)
        rules->alternatives[symbol->first + i].share /= sum;
}

tn_status tn_place_rules_make(const tn_module *module, tn_place_rules *rules, tn_error *error)
{
    *rules = (tn_place_rules){.module = module};
    if (!tn_module_has_places(module))
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the module holds no connection grammar");
    const tn_grammar_record *grammar = &module->GRAMMAR_records[0];
    size_t steps = 0;
    for (size_t i = 0; i < module->PRODUCTION_count; i++)
        steps += count_steps(module, &module->PRODUCTION_records[i]);
    rules->symbols = calloc(grammar->rule_count, sizeof *rules->symbols);
    rules->alternatives = calloc(module->PRODUCTION_count, sizeof *rules->alternatives);
    rules->steps = calloc(steps + 1, sizeof *rules->steps);
    if (!rules->symbols || !rules->alternatives || !rules->steps) {
        tn_place_rules_clear(rules);
        return tn_fail_memory(error);
    }
    for (uint32_t i = 0; i < grammar->rule_count; i++)
        read_symbol(rules, grammar, &module->NONTERMINAL_records[grammar->rule_first + i]);
    return TN_OK;
}

uint32_t tn_place_symbol_of(const tn_place_rules *rules, uint32_t alternative)
{
    uint32_t low = 0, high = rules->symbol_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (rules->symbols[middle].first <= alternative)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* "tower, wall", as far as there is room. */
static void list_models(const tn_module *module, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (uint32_t i = 0; i < module->KIT_MODEL_count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%.60s", i ? ", " : "",
                                 tn_text(module, module->KIT_MODEL_records[i].name));
}

tn_status tn_kit_model_find(const tn_module *module, const char *name, uint32_t *model, tn_error *error)
{
    char names[300];
    for (*model = 0; name && *model < module->KIT_MODEL_count; ++*model)
        if (strcmp(tn_text(module, module->KIT_MODEL_records[*model].name), name) == 0)
            return TN_OK;
    *model = 0;
    if (!name && module->KIT_MODEL_count == 1)
        return TN_OK;
    list_models(module, names, sizeof names);
    if (module->KIT_MODEL_count == 0) {
        tn_fail(error, TN_INVALID, E_PLACE_NO_MODEL, "the kit has no model to place");
        tn_error_help(error, "write one: `model tower { inside ring; start stud at (0, 0, 0) by wall; }`");
    } else if (name) {
        tn_fail(error, TN_INVALID, E_PLACE_NO_MODEL, "there is no model `%.100s`", name);
        tn_error_help(error, "there is: %s", names);
    } else {
        tn_fail(error, TN_INVALID, E_PLACE_NO_MODEL, "which of its %u models?", (unsigned)module->KIT_MODEL_count);
        tn_error_help(error, "name one by --model: %s", names);
    }
    return TN_INVALID;
}

tn_status tn_place_rules_of_model(const tn_module *module, uint32_t index, tn_place_rules *rules, tn_error *error)
{
    tn_status status = tn_place_rules_make(module, rules, error);
    if (status != TN_OK)
        return status;
    rules->space = &module->KIT_MODEL_records[index];
    rules->start = rules->space->start - module->GRAMMAR_records[0].rule_first;
    return TN_OK;
}

void tn_place_unit(const tn_module *module, double unit[3])
{
    static const double million = 1e6;
    const tn_kit_record *kit = module->KIT_count ? &module->KIT_records[0] : NULL;
    unit[0] = kit ? (double)kit->unit_x / million : 10;
    unit[1] = kit ? (double)kit->unit_y / million : 8;
    unit[2] = kit ? (double)kit->unit_z / million : 10;
}
