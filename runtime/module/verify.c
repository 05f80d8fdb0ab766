/* Verifies a module: its records by their rows, what the engines say of them, and the code. */
#include "runtime/module/verify.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/base/utf8.h"
#include "runtime/module/records.h"

/* ---- verifies the code */

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

static tn_status verify_code(tn_checker *checker)
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

/* ---- verifies the strings, and every field of every record by its row in records.def */

/* A field of a section, in all of its records. */
typedef struct tn_column {
    tn_checker *checker;
    tn_section section;
    const char *records;
    size_t size, count; /* of the records */
    const tn_member *member;
} tn_column;

static const void *record_at(const tn_column *column, size_t index)
{
    return column->records + index * column->size;
}

static uint32_t value_at(const tn_column *column, size_t index, const tn_member *member)
{
    return (uint32_t)tn_member_whole(record_at(column, index), member);
}

/* "rewrite rule 3: " and the reason. */
__attribute__((format(printf, 3, 4))) static tn_status refuse(const tn_column *column, size_t index, const char *format,
                                                              ...)
{
    char what[160], title[TN_TITLE_MAX];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    tn_section_title(column->section, title);
    return tn_refuse(column->checker, "%s %zu: %s", title, index, what);
}

/* ---- strings */

static tn_status check_strings(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    if (module->strings_size == 0 || module->strings[0] != '\0' || module->strings[module->strings_size - 1] != '\0')
        return tn_refuse(checker, "its strings do not begin and end with a zero byte");
    if (!tn_is_utf8(module->strings, module->strings_size))
        return tn_refuse(checker, "its strings are not UTF-8 text");
    return TN_OK;
}

/* A string begins where another ends: no string is the tail of another. */
static tn_status check_texts(const tn_column *column)
{
    const tn_module *module = column->checker->module;
    const tn_member *member = column->member;
    size_t most = (size_t)member->high;
    for (size_t i = 0; i < column->count; i++) {
        tn_string text = value_at(column, i, member);
        if (!is_string(module, text))
            return refuse(column, i, "%s is no string", member->name);
        if (text == 0 && member->low > 0)
            return refuse(column, i, "%s is empty", member->name);
        if (most < UINT32_MAX && strnlen(tn_text(module, text), most + 1) > most)
            return refuse(column, i, "%s has more than %zu bytes", member->name, most);
    }
    return TN_OK;
}

/* ---- numbers */

static tn_status check_wholes(const tn_column *column)
{
    const tn_member *member = column->member;
    if (member->storage == TN_STORAGE_U32 && member->low == 0 && member->high == UINT32_MAX)
        return TN_OK;
    for (size_t i = 0; i < column->count; i++) {
        int64_t value = tn_member_whole(record_at(column, i), member);
        if (value < member->low || value > member->high)
            return refuse(column, i, "%s is %" PRId64 "; %" PRId64 " to %" PRId64 " are possible", member->name, value,
                          member->low, member->high);
        if (member->names && !member->names[value])
            return refuse(column, i, "%s is %" PRId64 ", which nothing has for its number", member->name, value);
    }
    return TN_OK;
}

static tn_status check_reals(const tn_column *column)
{
    const tn_member *member = column->member;
    for (size_t i = 0; i < column->count; i++) {
        double value = tn_member_real(record_at(column, i), member);
        if (!(isfinite(value) && value >= member->least && value <= member->most))
            return refuse(column, i, "%s is %g; %g to %g are possible", member->name, value, member->least,
                          member->most);
    }
    return TN_OK;
}

static tn_status check_flags(const tn_column *column)
{
    for (size_t i = 0; i < column->count; i++)
        if ((value_at(column, i, column->member) & ~(uint32_t)column->member->high) != 0)
            return refuse(column, i, "%s has unknown bits", column->member->name);
    return TN_OK;
}

/* ---- references and runs */

static tn_status check_references(const tn_column *column, bool or_none)
{
    const tn_member *member = column->member;
    size_t total = column->checker->module->tables[member->section].count;
    for (size_t i = 0; i < column->count; i++) {
        uint32_t value = value_at(column, i, member);
        if (value < total || (or_none && value == TN_NO_RECORD))
            continue;
        char title[TN_TITLE_MAX];
        tn_section_title(member->section, title);
        return refuse(column, i, "%s is %s %u, which is not there", member->name, title, value);
    }
    return TN_OK;
}

static tn_status refuse_rest(const tn_column *column)
{
    char title[TN_TITLE_MAX], owner[TN_TITLE_MAX];
    tn_section_title(column->member->section, title);
    tn_section_title(column->section, owner);
    return tn_refuse(column->checker, "it has %s records that belong to no %s record", title, owner);
}

static tn_status refuse_run(const tn_column *column, size_t index)
{
    char title[TN_TITLE_MAX];
    tn_section_title(column->member->section, title);
    return refuse(column, index, "its run of %s records does not follow the one before", title);
}

/* Each record's run begins where that of the record before ends, and the last ends with the section. */
static tn_status check_runs(const tn_column *column)
{
    const tn_member *first = column->member, *counted = first + 1;
    size_t total = column->checker->module->tables[first->section].count, end = 0;
    for (size_t i = 0; i < column->count; i++) {
        uint32_t count = value_at(column, i, counted);
        if (count < counted->low || count > counted->high)
            return refuse(column, i, "%s is %u; %u to %u are possible", counted->name, count, (unsigned)counted->low,
                          (unsigned)counted->high);
        if (value_at(column, i, first) != end || count > total - end)
            return refuse_run(column, i);
        end += count;
    }
    return end == total ? TN_OK : refuse_rest(column);
}

static tn_status check_slices(const tn_column *column)
{
    const tn_member *first = column->member;
    size_t total = column->checker->module->tables[first->section].count;
    for (size_t i = 0; i < column->count; i++) {
        uint32_t begin = value_at(column, i, first), count = value_at(column, i, first + 1);
        if (begin > total || count > total - begin)
            return refuse(column, i, "%s and %s name records that are not there", first->name, first[1].name);
    }
    return TN_OK;
}

/* ---- places */

/* Measures the texts; together they are no longer than a file may be (a text that many records share could otherwise
 * be measured without end). */
static tn_status measure_sources(tn_checker *checker)
{
    const tn_module *module = checker->module;
    size_t left = checker->limits->bytes < UINT32_MAX ? checker->limits->bytes : UINT32_MAX - 1;
    for (size_t i = 0; i < module->SOURCE_count; i++) {
        if (!is_string(module, module->SOURCE_records[i].text))
            return tn_refuse(checker, "source %zu: its text is not a string", i);
        size_t size = strnlen(tn_text(module, module->SOURCE_records[i].text), left + 1);
        if (size > left)
            return tn_fail(checker->error, TN_LIMIT, E_MODULE_TOO_LARGE,
                           "the module's sources together pass the limit of %zu bytes", checker->limits->bytes);
        left -= size;
        checker->sizes[i] = (uint32_t)size;
    }
    return TN_OK;
}

static tn_status check_places(const tn_column *column)
{
    const tn_checker *checker = column->checker;
    const tn_member *member = column->member;
    for (size_t i = 0; i < column->count; i++) {
        uint32_t file = value_at(column, i, member);
        uint32_t begin = value_at(column, i, member + 1), end = value_at(column, i, member + 2);
        if (file >= checker->module->SOURCE_count || begin > end || end > checker->sizes[file])
            return refuse(column, i, "it names a place outside its source");
    }
    return TN_OK;
}

/* ---- all of them */

static tn_status check_column(const tn_column *column)
{
    switch (column->member->kind) {
    case TN_MEMBER_TEXT:
        return check_texts(column);
    case TN_MEMBER_WHOLE:
        return check_wholes(column);
    case TN_MEMBER_REAL:
        return check_reals(column);
    case TN_MEMBER_FLAGS:
        return check_flags(column);
    case TN_MEMBER_REF:
        return check_references(column, false);
    case TN_MEMBER_REF_OR_NONE:
        return check_references(column, true);
    case TN_MEMBER_RUN:
        return check_runs(column);
    case TN_MEMBER_SLICE:
        return check_slices(column);
    case TN_MEMBER_FILE:
        return check_places(column);
    case TN_MEMBER_BITS:
    case TN_MEMBER_REF_AT_TIMES: /* the engine knows when */
    case TN_MEMBER_COUNT:        /* with the run */
    case TN_MEMBER_CODE:         /* with the code */
    case TN_MEMBER_CODE_END:
    case TN_MEMBER_BEGIN: /* with the file */
    case TN_MEMBER_END:
        break;
    }
    return TN_OK;
}

static tn_status check_section(tn_checker *checker, tn_section section)
{
    tn_section_info info = tn_section_describe(section);
    const tn_table *table = &checker->module->tables[section];
    for (size_t i = 0; i < info.members.count; i++) {
        tn_column column = {checker, section, table->records, info.size, table->count, &info.members.items[i]};
        tn_status status = check_column(&column);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status verify_records(tn_checker *checker)
{
    tn_status status = check_strings(checker);
    if (status == TN_OK)
        status = measure_sources(checker);
    for (tn_section i = 0; i < TN_SECTION_COUNT && status == TN_OK; i++)
        status = check_section(checker, i);
    return status;
}

tn_status tn_refuse(const tn_checker *checker, const char *format, ...)
{
    char what[200], where[80] = "", title[TN_TITLE_MAX];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    bool in_code = checker->section != TN_SECTION_STRINGS;
    tn_section_title(checker->section, title);
    if (in_code)
        snprintf(where, sizeof where, "%s %u, code offset %u: ", title, checker->record, checker->offset);
    tn_fail(checker->error, TN_INVALID, E_REFUSED_MODULE, "the module is refused: %s%s", where, what);
    if (in_code && checker->error)
        checker->error->code_offset = checker->offset;
    return TN_INVALID;
}

static int compare_texts(const void *left, const void *right)
{
    const char *const *a = left, *const *b = right;
    return strcmp(*a, *b);
}

tn_status tn_check_different(const tn_checker *checker, const tn_string *texts, size_t stride, size_t count,
                             const char *reason)
{
    if (count < 2)
        return TN_OK;
    const char **sorted = malloc(count * sizeof *sorted);
    if (!sorted)
        return tn_fail_memory(checker->error);
    for (size_t i = 0; i < count; i++) {
        tn_string text;
        memcpy(&text, (const char *)texts + i * stride, sizeof text);
        sorted[i] = tn_text(checker->module, text);
    }
    qsort(sorted, count, sizeof *sorted, compare_texts);
    bool different = true;
    for (size_t i = 1; i < count; i++)
        different = different && strcmp(sorted[i - 1], sorted[i]) != 0;
    free(sorted);
    return different ? TN_OK : tn_refuse(checker, "%s", reason);
}

/* The sections that belong to the module itself. */
static bool is_common(tn_section section)
{
    return section == TN_SECTION_STRINGS || section == TN_SECTION_CODE || section == TN_SECTION_FUNCTION ||
           section == TN_SECTION_SOURCE || section == TN_SECTION_SOURCE_MAP || section == TN_SECTION_PRODUCER;
}

static tn_status check_owners(const tn_checker *checker)
{
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++)
        if (checker->module->tables[i].count > 0 && !is_common(i) && !tn_engine_of_section(checker->engines, i))
            return tn_refuse(checker, "this program lacks the engine of its section %s", tn_section_describe(i).name);
    return TN_OK;
}

static tn_status check_engines(const tn_checker *checker)
{
    for (size_t i = 0; i < checker->engines->count; i++) {
        const tn_engine *engine = checker->engines->items[i];
        tn_status status = engine->verify ? engine->verify(checker) : TN_OK;
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

tn_status tn_module_verify(const tn_module *module, const tn_engines *engines, const tn_module_limits *limits,
                           tn_error *error)
{
    tn_checker checker = {.module = module, .engines = engines, .limits = limits, .error = error};
    tn_engines_operands(engines, checker.operands);
    checker.sizes = calloc(module->SOURCE_count + 1, sizeof *checker.sizes);
    tn_status status = checker.sizes ? check_owners(&checker) : tn_fail_memory(error);
    if (status == TN_OK)
        status = verify_records(&checker);
    if (status == TN_OK && module->PRODUCER_count > 1)
        status = tn_refuse(&checker, "it has more than one producer");
    if (status == TN_OK)
        status = check_engines(&checker);
    if (status == TN_OK)
        status = verify_code(&checker);
    free(checker.sizes);
    return status;
}
