/* Makes a form ready: its zones from back to front, and the heights of its storeys. */
#include "runtime/house/form/form.h"

#include <string.h>

#include "runtime/module/code.h"

/* ---- functions whose cells are bare */

/* What an answer about a cell of which only the function is known may be. */
typedef struct tn_maybe {
    bool yes, no;
} tn_maybe;

static tn_maybe maybe_of(const tn_instruction *instruction, uint32_t rule)
{
    bool function = instruction->opcode == TN_OP_IS_FOR, is = instruction->first == (int64_t)rule;
    if (instruction->opcode == TN_OP_EVERY)
        return (tn_maybe){.yes = true};
    if (instruction->opcode == TN_OP_IS_VOID)
        return (tn_maybe){.no = true};
    return function ? (tn_maybe){is, !is} : (tn_maybe){true, true};
}

/* May a cell with this function (a CELL_RULE) be one that the code decides on? */
static bool may_be(const tn_module *module, uint32_t decides, uint32_t rule)
{
    tn_maybe stack[TN_DECISION_STACK_MAX];
    size_t depth = 0;
    for (uint32_t at = module->FUNCTION_records[decides].code_begin;;) {
        tn_instruction instruction = tn_code_read(module->code, at);
        at += instruction.length;
        if (instruction.opcode == TN_OP_DECIDE)
            return stack[depth - 1].yes;
        if (instruction.opcode == TN_OP_NONE_OF) {
            stack[depth - 1] = (tn_maybe){stack[depth - 1].no, stack[depth - 1].yes};
        } else if (instruction.opcode == TN_OP_ALL_OF || instruction.opcode == TN_OP_ONE_OF) {
            tn_maybe a = stack[depth - 2], b = stack[depth - 1];
            bool all = instruction.opcode == TN_OP_ALL_OF;
            stack[--depth - 1] =
                all ? (tn_maybe){a.yes && b.yes, a.no || b.no} : (tn_maybe){a.yes || b.yes, a.no && b.no};
        } else {
            stack[depth++] = maybe_of(&instruction, rule);
        }
    }
}

static bool climbs(const tn_house_form *form, const tn_face_line_record *line)
{
    bool any = false;
    for (uint32_t k = 0; line->relation == TN_FACE_UNDER && k < line->kind_count; k++) {
        uint32_t kind = form->module->HOUSE_ITEM_records[line->kind_first + k].number;
        any |= kind == TN_FACE_STAIR || tn_form_flight(form, kind);
    }
    return any;
}

static void take_out(tn_house_form *form, uint32_t function)
{
    form->bare[function / 64] &= ~(UINT64_C(1) << function % 64);
}

static void find_bare(tn_house_form *form)
{
    const tn_module *module = form->module;
    for (uint32_t f = 0; f < tn_form_functions(form); f++)
        if (!tn_form_is_outdoor(form, f))
            form->bare[f / 64] |= UINT64_C(1) << f % 64;
    for (uint32_t t = 0; t < form->record->tile_count; t++) {
        const tn_tile_record *tile = &module->TILE_records[form->record->tile_first + t];
        for (uint32_t i = 0; i < tile->purpose_count; i++)
            take_out(form, module->HOUSE_ITEM_records[tile->purpose_first + i].number);
    }
    for (uint32_t i = 0; i < form->record->face_count; i++) {
        const tn_face_line_record *line = &module->FACE_LINE_records[form->record->face_first + i];
        for (uint32_t f = 0; climbs(form, line) && f < tn_form_functions(form); f++)
            if (may_be(module, line->first, form->record->rule_first + f) ||
                may_be(module, line->second, form->record->rule_first + f))
                take_out(form, f);
    }
}

/* ---- lines of faces */

static bool is_any(const tn_module *module, uint32_t decides)
{
    tn_instruction first = tn_code_read(module->code, module->FUNCTION_records[decides].code_begin);
    return first.opcode == TN_OP_EVERY &&
           module->code[module->FUNCTION_records[decides].code_begin + first.length] == TN_OP_DECIDE;
}

/* Does the decision ask for the function? */
static bool asks_for(const tn_module *module, uint32_t decides, uint32_t rule)
{
    for (uint32_t at = module->FUNCTION_records[decides].code_begin;;) {
        tn_instruction instruction = tn_code_read(module->code, at);
        if (instruction.opcode == TN_OP_DECIDE)
            return false;
        if (instruction.opcode == TN_OP_IS_FOR && instruction.first == (int64_t)rule)
            return true;
        at += instruction.length;
    }
}

bool tn_form_line_names(const tn_house_form *form, const tn_face_line_record *line, uint32_t function)
{
    uint32_t rule = form->record->rule_first + function;
    return asks_for(form->module, line->first, rule) && may_be(form->module, line->first, rule);
}

bool tn_form_names_both(const tn_house_form *form, const tn_face_line_record *line)
{
    return line->second != TN_NO_RECORD && !is_any(form->module, line->first) && !is_any(form->module, line->second);
}

tn_status tn_form_schema(const tn_module *module, uint32_t index, tn_schema **schema, tn_error *error)
{
    tn_status status = tn_schema_new(module, module->FORM_records[index].schema, 0, schema, error);
    if (status != TN_OK)
        return status;
    status = tn_schema_listed(*schema, "a form goes", error);
    if (status != TN_OK) {
        tn_schema_free(*schema);
        *schema = NULL;
    }
    return status;
}

void tn_form_ready(const tn_module *module, uint32_t index, const tn_schema *schema, tn_house_form *form)
{
    const tn_form_record *record = &module->FORM_records[index];
    *form = (tn_house_form){.module = module, .record = record, .schema = schema};
    form->spine = record->spine - schema->record->field_first;
    form->width = tn_schema_length_field(schema);
    for (uint32_t f = 0; f < schema->field_count; f++)
        if (schema->fields[f].kind == TN_FIELD_ZONE)
            form->zones[form->zone_count++] = f;
    uint32_t rule = 0;
    for (uint32_t kind = 0; kind < TN_CELL_RULE_KIND_COUNT; kind++) {
        while (rule < record->rule_count && tn_form_rule(form, rule)->kind == kind)
            rule++;
        form->kinds_end[kind] = rule;
    }
    uint32_t layer = 0;
    for (uint32_t of = 0; of < TN_LAYERED_COUNT; of++) {
        while (layer < record->layer_count && tn_form_layer(form, layer)->of == of)
            layer++;
        form->layers_end[of] = layer;
    }
    for (uint32_t i = 0; i < record->storey_count; i++)
        form->level[i + 1] = form->level[i] + module->STOREY_records[record->storey_first + i].height;
    for (uint32_t f = 0; f < tn_form_functions(form); f++)
        form->has_outdoor |= tn_form_is_outdoor(form, f);
    if (record->way > 0)
        find_bare(form);
}

const char *tn_form_kind_text(const tn_house_form *form, uint32_t kind)
{
    static const char *const words[] = {"wall", "party", "open", "floor", "stair"};
    const tn_opening_record *declared = tn_form_declared(form, kind);
    return declared ? tn_text(form->module, declared->name) : words[kind];
}
