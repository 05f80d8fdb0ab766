/* Decodes the productions of a connection grammar into symbols, alternatives and steps; and verifies and lists these in
 * a module. */
#include "runtime/place/model/rules.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/module/engine.h"
#include "runtime/module/lister.h"
#include "runtime/module/verify.h"
#include "runtime/place/model/terms.h"
#include "runtime/place/model/turns.h"

/* ==== decodes the productions of a connection grammar into symbols, alternatives and steps */

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

/* ==== verifies and lists the steps of connection grammars. (Their tables, and that productions end, are the grammar
 * engine's.) */

static bool is_small(const tn_checker *checker, int64_t index)
{
    const tn_vector_record *vector = &checker->module->VECTOR_records[index];
    return llabs(vector->x) <= TN_PLACE_SIZE_MAX && llabs(vector->y) <= TN_PLACE_SIZE_MAX &&
           llabs(vector->z) <= TN_PLACE_SIZE_MAX;
}

/* Sizes keep within their limit, where a move may go farther. */
static tn_status check_vector(const tn_checker *checker, const tn_instruction *instruction)
{
    return instruction->opcode == TN_OP_MOVE || is_small(checker, instruction->first)
               ? TN_OK
               : tn_refuse(checker, "a box that is too large");
}

static tn_status check_corners(const tn_checker *checker, const tn_instruction *instruction)
{
    return is_small(checker, instruction->first) && is_small(checker, instruction->second)
               ? TN_OK
               : tn_refuse(checker, "a box that is too large");
}

static tn_status check_amount(const tn_checker *checker, const tn_instruction *instruction)
{
    int64_t low, high;
    switch (instruction->opcode) {
    case TN_OP_HEADING:
        low = 0;
        high = checker->module->KIT_count > 0 ? (int64_t)checker->module->KIT_records[0].turns - 1 : 3;
        break;
    case TN_OP_COLOUR:
        low = -(int64_t)TN_PLACE_COLOUR_MAX;
        high = TN_PLACE_COLOUR_MAX;
        break;
    case TN_OP_BOUND_BALL:
        low = -TN_PLACE_SIZE_MAX;
        high = TN_PLACE_SIZE_MAX;
        break;
    default:
        return TN_OK;
    }
    return instruction->first >= low && instruction->first <= high
               ? TN_OK
               : tn_refuse(checker, "%lld is not from %lld to %lld", (long long)instruction->first, (long long)low,
                           (long long)high);
}

/* A part has a name. */
static tn_status check_part(const tn_checker *checker, const tn_instruction *instruction)
{
    return !*tn_text(checker->module, (tn_string)instruction->first) ? tn_refuse(checker, "a part without a name")
                                                                     : TN_OK;
}

static void list_one(tn_lister *lister, int64_t index)
{
    const tn_vector_record *vector = &lister->module->VECTOR_records[index];
    fprintf(lister->out, "%lld, %lld, %lld", (long long)vector->x, (long long)vector->y, (long long)vector->z);
}

static void list_vector(tn_lister *lister, const tn_instruction *instruction)
{
    list_one(lister, instruction->first);
}

static void list_corners(tn_lister *lister, const tn_instruction *instruction)
{
    list_one(lister, instruction->first);
    fputs(" to ", lister->out);
    list_one(lister, instruction->second);
}

/* ---- kits */

const char *const tn_placed_terms[TN_PLACED_TERM_COUNT] = {
#define X(NAME, NUMBER, WORD) [NUMBER] = (WORD),
    TN_PLACED_TERMS(X)
#undef X
        [TN_PLACED_X] = "x",
    [TN_PLACED_Y] = "y",
    [TN_PLACED_Z] = "z",
#define COUNTED(N) [TN_PLACED_COUNTED + (N)] = "count " #N
#define FOUR(N) COUNTED(N), COUNTED(N + 1), COUNTED(N + 2), COUNTED(N + 3)
    FOUR(0),
    FOUR(4),
    FOUR(8),
    FOUR(12),
    FOUR(16),
    FOUR(20),
    FOUR(24),
    FOUR(28),
#undef FOUR
#undef COUNTED
#define MASK(N) [TN_PLACED_MASK + (N)] = "mask " #N
#define FOUR(N) MASK(N), MASK(N + 1), MASK(N + 2), MASK(N + 3)
#define SIXTEEN(N) FOUR(N), FOUR(N + 4), FOUR(N + 8), FOUR(N + 12)
    SIXTEEN(0),
    SIXTEEN(16),
    SIXTEEN(32),
    SIXTEEN(48),
#undef SIXTEEN
#undef FOUR
#undef MASK
};

static tn_status check_function(const tn_checker *checker, const char *what, uint32_t function)
{
    return checker->module->FUNCTION_records[function].kind == TN_FUNCTION_KIT
               ? TN_OK
               : tn_refuse(checker, "the %s of a model is a function of another kind", what);
}

/* The words hold a bit for each cell, and no more. */
static tn_status check_mask(const tn_checker *checker, const tn_kit_mask_record *mask)
{
    uint64_t layer = (uint64_t)mask->size_x * mask->size_z;
    if (layer > TN_MASK_CELLS_MAX || layer * mask->size_y > TN_MASK_CELLS_MAX)
        return tn_refuse(checker, "a mask of too many cells");
    return mask->word_count == (layer * mask->size_y + 63) / 64
               ? TN_OK
               : tn_refuse(checker, "a mask of %u words", (unsigned)mask->word_count);
}

/* A space asks for masks that are there. */
static tn_status check_space(const tn_checker *checker, uint32_t function)
{
    const tn_module *module = checker->module;
    const tn_function_record *f = &module->FUNCTION_records[function];
    tn_instruction i;
    for (uint32_t offset = f->code_begin; offset < f->code_end; offset += i.length) {
        i = tn_code_read(module->code, offset);
        if (i.opcode == TN_OP_TERM && i.first >= TN_PLACED_MASK &&
            (uint64_t)i.first - TN_PLACED_MASK >= module->KIT_MASK_count)
            return tn_refuse(checker, "a space asks for a mask that is not there");
    }
    return TN_OK;
}

/* A slope has a corner between its sides; its steps are boxes of its part that no slope before it has. */
static tn_status check_slope(const tn_checker *checker, const tn_kit_part_record *part, uint32_t index,
                             uint64_t *next_box)
{
    const tn_part_slope_record *slope = &checker->module->PART_SLOPE_records[index];
    const uint64_t end = (uint64_t)slope->step_first + slope->step_count;
    if (tn_axis_coordinate((tn_axis)slope->side) == tn_axis_coordinate((tn_axis)slope->other))
        return tn_refuse(checker, "a slope between sides that do not meet");
    if (slope->low_x >= slope->high_x || slope->low_y >= slope->high_y || slope->low_z >= slope->high_z)
        return tn_refuse(checker, "a slope without extent");
    if (slope->step_count == 0 || slope->step_first < *next_box || end > (uint64_t)part->box_first + part->box_count)
        return tn_refuse(checker, "a slope whose steps are not those of its part");
    *next_box = end;
    return TN_OK;
}

static tn_status check_slopes(const tn_checker *checker, const tn_kit_part_record *part)
{
    uint64_t next_box = part->box_first;
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < part->slope_count && status == TN_OK; i++)
        status = check_slope(checker, part, part->slope_first + i, &next_box);
    return status;
}

static tn_status check_model(const tn_checker *checker, const tn_kit_model_record *model)
{
    const tn_module *module = checker->module;
    const tn_grammar_record *grammar = module->GRAMMAR_count ? &module->GRAMMAR_records[0] : NULL;
    if (!grammar || grammar->dialect != TN_DIALECT_PLACE || model->start < grammar->rule_first ||
        model->start - grammar->rule_first >= grammar->rule_count)
        return tn_refuse(checker, "a model starts with what is no symbol of a connection grammar");
    if (model->search == TN_SEARCH_BEAM && (model->search_amount == 0 || model->search_amount > TN_BEAM_MAX))
        return tn_refuse(checker, "a beam of %u", (unsigned)model->search_amount);
    tn_status status = check_function(checker, "space", model->space);
    if (status == TN_OK)
        status = check_space(checker, model->space);
    return status == TN_OK && model->objective != TN_NO_RECORD ? check_function(checker, "objective", model->objective)
                                                               : status;
}

static tn_status verify(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    if (module->KIT_count > 1)
        return tn_refuse(checker, "there are %zu kits", (size_t)module->KIT_count);
    const tn_kit_record *kit = module->KIT_count > 0 ? &module->KIT_records[0] : NULL;
    if (kit && kit->turns != 4 && (kit->turns != 24 || kit->unit_x != kit->unit_y || kit->unit_x != kit->unit_z))
        return tn_refuse(checker, "%u turns of a cell", (unsigned)kit->turns);
    if (module->KIT_MASK_count > TN_KIT_MASKS_MAX)
        return tn_refuse(checker, "there are %zu masks", (size_t)module->KIT_MASK_count);
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < module->KIT_MASK_count && status == TN_OK; i++)
        status = check_mask(checker, &module->KIT_MASK_records[i]);
    for (uint32_t i = 0; i < module->KIT_PART_count && status == TN_OK; i++)
        status = check_slopes(checker, &module->KIT_PART_records[i]);
    for (uint32_t i = 0; i < module->KIT_MODEL_count && status == TN_OK; i++)
        status = check_model(checker, &module->KIT_MODEL_records[i]);
    for (uint32_t i = 0; i < module->KIT_CONDITION_count && status == TN_OK; i++) {
        const tn_kit_condition_record *condition = &module->KIT_CONDITION_records[i];
        status = check_function(checker, "condition", condition->holds);
        if (status == TN_OK && condition->violation != TN_NO_RECORD)
            status = check_function(checker, "condition", condition->violation);
    }
    return status;
}

static const tn_section sections[] = {TN_SECTION_VECTOR,     TN_SECTION_KIT,           TN_SECTION_CONNECTOR_TYPE,
                                      TN_SECTION_KIT_PART,   TN_SECTION_PART_BOX,      TN_SECTION_PART_CONNECTOR,
                                      TN_SECTION_KIT_MODEL,  TN_SECTION_KIT_CONDITION, TN_SECTION_COUNTED,
                                      TN_SECTION_KIT_STOCK,  TN_SECTION_KIT_MASK,      TN_SECTION_MASK_WORD,
                                      TN_SECTION_PART_SLOPE, TN_SECTION_STRINGS};

/* The vectors are shown where they are used; the words of masks are not. */
static void list(tn_lister *lister)
{
#define LIST(NAME)                                                                                                     \
    for (uint32_t i = 0; i < lister->module->NAME##_count && !ferror(lister->out); i++)                                \
    tn_list_record(lister, TN_SECTION_##NAME, i)
    LIST(KIT);
    LIST(CONNECTOR_TYPE);
    LIST(KIT_PART);
    LIST(PART_BOX);
    LIST(PART_SLOPE);
    LIST(PART_CONNECTOR);
    LIST(KIT_MODEL);
    LIST(KIT_CONDITION);
    LIST(KIT_STOCK);
    LIST(COUNTED);
    LIST(KIT_MASK);
#undef LIST
}

static const tn_operand_rules operands[] = {
    {TN_OPERANDS_VECTOR, check_vector, list_vector},
    {TN_OPERANDS_CORNERS, check_corners, list_corners},
    {TN_OPERANDS_AMOUNT, check_amount, NULL},
    {TN_OPERANDS_PART, check_part, NULL},
};

extern const tn_engine tn_engine_place;
const tn_engine tn_engine_place = {.name = "place",
                                   .sections = sections,
                                   .codes = 1u << TN_CODE_PLACE,
                                   .operands = operands,
                                   .operand_count = sizeof operands / sizeof *operands,
                                   .terms = tn_placed_terms,
                                   .term_count = TN_PLACED_TERM_COUNT,
                                   .term_kind = TN_FUNCTION_KIT,
                                   .verify = verify,
                                   .list = list};
