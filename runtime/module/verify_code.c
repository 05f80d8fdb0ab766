/* Verifies the code: every instruction of every record that has code, in one pass. */
#include <math.h>

#include "runtime/base/bytes.h"
#include "runtime/module/engine.h"
#include "runtime/module/records.h"

/* ---- operands */

static bool is_string(const tn_module *module, int64_t string)
{
    return string < (int64_t)module->strings_size && (string == 0 || module->strings[string - 1] == '\0');
}

static tn_status check_operand(const tn_checker *checker, const tn_slot *slot, int64_t value)
{
    char title[TN_TITLE_MAX];
    switch (slot->kind) {
    case TN_SLOT_F64:
        return isfinite(tn_double_of((uint64_t)value)) ? TN_OK : tn_refuse(checker, "a number that is not finite");
    case TN_SLOT_STRING:
        return is_string(checker->module, value) ? TN_OK
                                                 : tn_refuse(checker, "there is no text at %u", (unsigned)value);
    case TN_SLOT_INDEX:
        if (value < (int64_t)checker->module->tables[slot->section].count)
            return TN_OK;
        tn_section_title(slot->section, title);
        return tn_refuse(checker, "there is no %s %u", title, (unsigned)value);
    case TN_SLOT_NOTHING:
    case TN_SLOT_U32:
    case TN_SLOT_I64:
        break;
    }
    return TN_OK;
}

static tn_status check_operands(const tn_checker *checker, tn_operands kind, const tn_instruction *instruction)
{
    tn_status status = check_operand(checker, &tn_operand_slots[kind][0], instruction->first);
    if (status == TN_OK)
        status = check_operand(checker, &tn_operand_slots[kind][1], instruction->second);
    const tn_operand_rules *rules = checker->operands[kind];
    return status == TN_OK && rules && rules->verify ? rules->verify(checker, instruction) : status;
}

/* ---- instructions */

tn_status tn_code_enter(tn_checker *checker, tn_section section, uint32_t record, uint32_t begin, uint32_t end)
{
    checker->section = section;
    checker->record = record;
    if (begin != checker->offset || end <= begin || end > checker->module->code_size)
        return tn_refuse(checker, "its code is not the stretch after the one before");
    checker->end = end;
    checker->depth = 0;
    return TN_OK;
}

tn_status tn_code_next(const tn_checker *checker, tn_code_kind code, tn_instruction *instruction)
{
    uint8_t opcode = checker->module->code[checker->offset];
    const tn_opcode_info *info = tn_opcode_describe(opcode);
    if (!info)
        return tn_refuse(checker, "%u is no opcode", opcode);
    if (info->code != code)
        return tn_refuse(checker, "%s does not belong in this kind of code", info->name);
    if (info->length > checker->end - checker->offset)
        return tn_refuse(checker, "%s runs past its end", info->name);
    *instruction = tn_code_read(checker->module->code, checker->offset);
    return check_operands(checker, info->operands, instruction);
}

/* The map's records name instructions, in ascending order and each but once. */
tn_status tn_code_pass(tn_checker *checker, const tn_instruction *instruction)
{
    const tn_module *module = checker->module;
    uint32_t next = checker->offset + instruction->length;
    if (checker->map < module->SOURCE_MAP_count && module->SOURCE_MAP_records[checker->map].offset < next) {
        if (module->SOURCE_MAP_records[checker->map].offset != checker->offset)
            return tn_refuse(checker, "the source map's record %zu names no instruction", checker->map);
        checker->map++;
        if (checker->map < module->SOURCE_MAP_count && module->SOURCE_MAP_records[checker->map].offset < next)
            return tn_refuse(checker, "the source map does not ascend at its record %zu", checker->map);
    }
    checker->offset = next;
    return TN_OK;
}

/* ---- functions */

static tn_status check_stack(tn_checker *checker, uint32_t stack_max, tn_opcode opcode, bool last)
{
    const tn_opcode_info *info = tn_opcode_describe((uint8_t)opcode);
    if (checker->depth < info->pops)
        return tn_refuse(checker, "%s takes %u from a stack of %u", info->name, info->pops, checker->depth);
    if (last && checker->depth != info->pops)
        return tn_refuse(checker, "%s leaves %u on the stack", info->name, checker->depth - info->pops);
    checker->depth += (uint32_t)info->pushes - info->pops;
    if (checker->depth > stack_max)
        return tn_refuse(checker, "the stack passes the %u that the function declares", stack_max);
    return TN_OK;
}

static tn_status check_body(tn_checker *checker, const tn_function_record *function)
{
    const tn_function_kind_info *kind = &tn_function_kinds[function->kind];
    while (checker->offset < checker->end) {
        tn_instruction instruction;
        tn_status status = tn_code_next(checker, kind->code, &instruction);
        bool last = status == TN_OK && instruction.opcode == kind->last;
        if (status == TN_OK)
            status = check_stack(checker, function->stack_max, instruction.opcode, last);
        if (status == TN_OK)
            status = tn_code_pass(checker, &instruction);
        if (status != TN_OK)
            return status;
        if (last && checker->offset != checker->end)
            return tn_refuse(checker, "code follows the function's end");
        if (last)
            return TN_OK;
    }
    return tn_refuse(checker, "the function does not end with %s", tn_opcode_describe(kind->last)->name);
}

static tn_status check_function(tn_checker *checker, uint32_t index)
{
    const tn_function_record *function = &checker->module->FUNCTION_records[index];
    tn_code_kind code = tn_function_kinds[function->kind].code;
    const tn_engine *engine = tn_engine_of_code(checker->engines, code);
    tn_status status = tn_code_enter(checker, TN_SECTION_FUNCTION, index, function->code_begin, function->code_end);
    if (status != TN_OK)
        return status;
    if (!engine)
        return tn_refuse(checker, "this program lacks the engine of such functions");
    if (function->stack_max > checker->limits->stack) {
        tn_fail(checker->error, TN_LIMIT, E_MODULE_TOO_LARGE, "function %u declares a stack of %u; the limit is %zu",
                index, function->stack_max, checker->limits->stack);
        tn_error_help(checker->error, "this limit is fixed: give parts of the rule's expression names of their own");
        return TN_LIMIT;
    }
    status = engine->verify_function ? engine->verify_function(checker, index) : TN_OK;
    return status == TN_OK ? check_body(checker, function) : status;
}

static tn_status check_functions(tn_checker *checker)
{
    for (uint32_t i = 0; i < checker->module->FUNCTION_count; i++) {
        tn_status status = check_function(checker, i);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

/* ---- all code */

static bool has_code(tn_section section)
{
    tn_members members = tn_section_describe(section).members;
    for (size_t i = 0; i < members.count; i++)
        if (members.items[i].kind == TN_MEMBER_CODE)
            return true;
    return false;
}

/* The code of an engine's own section; that each section with records has an engine is known. */
static tn_status check_engine_code(tn_checker *checker, tn_section section)
{
    const tn_engine *engine = tn_engine_of_section(checker->engines, section);
    if (!engine->verify_code)
        return tn_refuse(checker, "its engine runs no code of its section %s", tn_section_describe(section).name);
    return engine->verify_code(checker, section);
}

tn_status tn_verify_code(tn_checker *checker)
{
    const tn_module *module = checker->module;
    tn_status status = check_functions(checker);
    for (tn_section i = TN_SECTION_CODE + 1; i < TN_SECTION_COUNT && status == TN_OK; i++)
        if (i != TN_SECTION_FUNCTION && module->tables[i].count > 0 && has_code(i))
            status = check_engine_code(checker, i);
    if (status != TN_OK)
        return status;
    checker->section = TN_SECTION_STRINGS;
    if (checker->offset != module->code_size)
        return tn_refuse(checker, "it has code that belongs to no function or production");
    if (checker->map != module->SOURCE_MAP_count)
        return tn_refuse(checker, "the source map names places past the code");
    for (size_t i = 0; i < checker->engines->count && status == TN_OK; i++)
        if (checker->engines->items[i]->verify_after)
            status = checker->engines->items[i]->verify_after(checker);
    return status;
}
