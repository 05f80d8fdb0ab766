/* Lists a module: its header, the tables of each engine, the functions, and what else has code. And what the listings
 * of all engines are made of: texts, places, records and code. */
#include "runtime/module/lister.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/utf8.h"
#include "runtime/module/records.h"

/* ==== lists texts, places, records and code: what the listings of all engines are made of */

/* ---- texts and places */

void tn_list_text(tn_lister *lister, const char *text)
{
    size_t size = strnlen(text, TN_TEXT_SHOWN + 1);
    bool cut = size > TN_TEXT_SHOWN;
    tn_write_clean(lister->out, text, cut ? TN_TEXT_SHOWN : size);
    if (cut)
        fputs("...", lister->out);
}

void tn_list_name(tn_lister *lister, tn_string name)
{
    tn_list_text(lister, tn_text(lister->module, name));
}

void tn_list_doc(tn_lister *lister, tn_string doc)
{
    if (doc == 0)
        return;
    fputs(" \"", lister->out);
    tn_list_name(lister, doc);
    fputc('"', lister->out);
}

static bool find_line(tn_lister *lister, uint32_t file, uint32_t offset, size_t *line)
{
    bool found = tn_source_line(lister->lines, file, offset, line);
    lister->failed |= !found;
    return found;
}

void tn_list_place(tn_lister *lister, uint32_t file, uint32_t begin)
{
    fputs("  (", lister->out);
    tn_list_name(lister, lister->module->SOURCE_records[file].path);
    size_t line;
    if (find_line(lister, file, begin, &line))
        fprintf(lister->out, ":%zu", line + 1);
    fputs(")\n", lister->out);
}

/* ---- records */

/* The words that the bits of flags stand for. */
static void list_flags(tn_lister *lister, const char *words, uint32_t bits)
{
    const char *between = "";
    for (; bits && words; bits >>= 1) {
        size_t size = strcspn(words, "|");
        if (bits & 1) {
            fprintf(lister->out, "%s%.*s", between, (int)size, words);
            between = "+";
        }
        words = words[size] ? words + size + 1 : NULL;
    }
}

/* The name that a record has in the field of that name; nothing if it has none. */
static void list_name_of(tn_lister *lister, tn_section section, uint32_t index)
{
    tn_section_info info = tn_section_describe(section);
    const char *records = lister->module->tables[section].records;
    for (size_t i = 0; i < info.members.count; i++) {
        const tn_member *member = &info.members.items[i];
        if (strcmp(member->name, "name") != 0)
            continue;
        fputs(" (", lister->out);
        tn_list_name(lister, (tn_string)tn_member_whole(records + index * info.size, member));
        fputc(')', lister->out);
    }
}

static void list_reference(tn_lister *lister, tn_section section, uint32_t index)
{
    char title[TN_TITLE_MAX];
    tn_section_title(section, title);
    fprintf(lister->out, "%s %" PRIu32, title, index);
    list_name_of(lister, section, index);
}

static void list_whole(tn_lister *lister, const tn_member *member, int64_t value)
{
    if (member->kind == TN_MEMBER_FLAGS)
        list_flags(lister, member->words, (uint32_t)value);
    else if (member->names)
        fputs(member->names[value], lister->out);
    else
        fprintf(lister->out, "%" PRId64, value);
}

/* One field; those of a place are shown together at the line's end. */
static void list_member(tn_lister *lister, const void *record, const tn_member *member)
{
    FILE *out = lister->out;
    if (member->kind == TN_MEMBER_REAL) {
        fprintf(out, "%.15g", tn_member_real(record, member));
        return;
    }
    int64_t value = tn_member_whole(record, member);
    switch (member->kind) {
    case TN_MEMBER_TEXT:
        fputc('"', out);
        tn_list_name(lister, (tn_string)value);
        fputc('"', out);
        break;
    case TN_MEMBER_BITS:
        fprintf(out, "0x%" PRIx64, (uint64_t)value);
        break;
    case TN_MEMBER_REF_OR_NONE:
        if (value == TN_NO_RECORD) {
            fputs("none", out);
            break;
        } /* fall through */
    case TN_MEMBER_REF:
        fprintf(out, "%" PRId64, value);
        list_name_of(lister, member->section, (uint32_t)value);
        break;
    default:
        list_whole(lister, member, value);
        break;
    }
}

/* Empty texts and flags are not, nor is a place, which ends the line. */
static bool is_shown(const void *record, const tn_member *member)
{
    if (member->kind == TN_MEMBER_TEXT || member->kind == TN_MEMBER_FLAGS)
        return tn_member_whole(record, member) != 0;
    return member->kind != TN_MEMBER_FILE && member->kind != TN_MEMBER_BEGIN && member->kind != TN_MEMBER_END;
}

void tn_list_record(tn_lister *lister, tn_section section, uint32_t index)
{
    char title[TN_TITLE_MAX];
    tn_section_info info = tn_section_describe(section);
    const char *record = (const char *)lister->module->tables[section].records + index * info.size;
    const tn_member *place = NULL;
    const char *between = "  ";
    tn_section_title(section, title);
    fprintf(lister->out, "  %s %" PRIu32, title, index);
    for (size_t i = 0; i < info.members.count; i++) {
        const tn_member *member = &info.members.items[i];
        place = member->kind == TN_MEMBER_FILE ? member : place;
        if (!is_shown(record, member))
            continue;
        fprintf(lister->out, "%s%s ", between, member->name);
        list_member(lister, record, member);
        between = ", ";
    }
    if (place)
        tn_list_place(lister, (uint32_t)tn_member_whole(record, place), (uint32_t)tn_member_whole(record, place + 1));
    else
        fputc('\n', lister->out);
}

/* ---- code */

/* Shows the line that a place begins in, unless it was the last one shown. */
static void show_source(tn_lister *lister, const tn_source_map_record *place)
{
    size_t line;
    if (!place || !find_line(lister, place->file, place->begin, &line))
        return;
    if (lister->shown_file == place->file && lister->shown_line == line + 1)
        return;
    lister->shown_file = place->file;
    lister->shown_line = line + 1;
    const char *text = tn_source_line_text(lister->lines, place->file, line);
    size_t size = 0;
    while (size < TN_TEXT_SHOWN && text[size] && text[size] != '\n' && text[size] != '\r')
        size++;
    fputs("  ; ", lister->out);
    tn_list_name(lister, lister->module->SOURCE_records[place->file].path);
    fprintf(lister->out, ":%zu: ", line + 1);
    tn_write_clean(lister->out, text, size);
    fputs(size == TN_TEXT_SHOWN ? "...\n" : "\n", lister->out);
}

void tn_list_function(tn_lister *lister, uint32_t index)
{
    const tn_function_record *function = &lister->module->FUNCTION_records[index];
    const tn_engine *engine = tn_engine_of_code(lister->engines, tn_function_kinds[function->kind].code);
    fprintf(lister->out, "function %" PRIu32 " (%s", index, tn_names_FUNCTION_KIND[function->kind]);
    if (engine->list_function)
        engine->list_function(lister, index);
    if (function->name != 0) {
        fputc(' ', lister->out);
        tn_list_name(lister, function->name);
    }
    fputc(')', lister->out);
}

static void list_operand(tn_lister *lister, const tn_slot *slot, int64_t value, const char *before)
{
    if (slot->kind == TN_SLOT_NOTHING)
        return;
    fputs(before, lister->out);
    if (slot->kind == TN_SLOT_F64)
        fprintf(lister->out, "%.17g", tn_double_of((uint64_t)value));
    else if (slot->kind == TN_SLOT_INDEX && slot->section == TN_SECTION_FUNCTION)
        tn_list_function(lister, (uint32_t)value);
    else if (slot->kind == TN_SLOT_INDEX)
        list_reference(lister, slot->section, (uint32_t)value);
    else if (slot->kind != TN_SLOT_STRING)
        fprintf(lister->out, "%" PRId64, value);
    else {
        fputc('"', lister->out);
        tn_list_name(lister, (tn_string)value);
        fputc('"', lister->out);
    }
}

static void list_instruction(tn_lister *lister, uint32_t offset, const tn_instruction *instruction)
{
    const tn_opcode_info *info = tn_opcode_describe((uint8_t)instruction->opcode);
    const tn_operand_rules *rules = lister->operands[info->operands];
    const tn_slot *slots = tn_operand_slots[info->operands];
    bool bare = slots[0].kind == TN_SLOT_NOTHING;
    fprintf(lister->out, bare ? "  %6u  %s" : "  %6u  %-11s", offset, info->name);
    if (rules && rules->list) {
        fputc(' ', lister->out);
        rules->list(lister, instruction);
    } else {
        list_operand(lister, &slots[0], instruction->first, " ");
        list_operand(lister, &slots[1], instruction->second, ", ");
    }
    fputc('\n', lister->out);
}

void tn_list_code(tn_lister *lister, uint32_t begin, uint32_t end, const tn_source_map_record *place)
{
    for (uint32_t offset = begin; offset < end;) {
        tn_instruction instruction = tn_code_read(lister->module->code, offset);
        show_source(lister, place ? place : tn_module_place(lister->module, offset));
        list_instruction(lister, offset, &instruction);
        offset += instruction.length;
    }
}

/* ==== lists a module: its header, the tables of each engine, the functions, and what else has code */

/* ---- finds the source lines that a listing shows beside instructions */

/* Where the lines of a source start; NULL: not found yet. */
typedef struct starts {
    uint32_t *of;
    size_t count;
} starts;

struct tn_source_lines {
    const tn_module *module;
    starts sources[];
};

tn_source_lines *tn_source_lines_new(const tn_module *module)
{
    tn_source_lines *lines = calloc(1, sizeof *lines + module->SOURCE_count * sizeof *lines->sources);
    if (lines)
        lines->module = module;
    return lines;
}

void tn_source_lines_free(tn_source_lines *lines)
{
    for (size_t i = 0; lines && i < lines->module->SOURCE_count; i++)
        free(lines->sources[i].of);
    free(lines);
}

static const char *text_of(const tn_source_lines *lines, uint32_t source)
{
    return tn_text(lines->module, lines->module->SOURCE_records[source].text);
}

static bool find_starts(const tn_source_lines *lines, uint32_t source, starts *found)
{
    const char *text = text_of(lines, source);
    size_t count = 1;
    for (const char *at = text; (at = strchr(at, '\n')); at++)
        count++;
    *found = (starts){malloc(count * sizeof *found->of), 0};
    if (!found->of)
        return false;
    found->of[found->count++] = 0;
    for (const char *at = text; (at = strchr(at, '\n')); at++)
        found->of[found->count++] = (uint32_t)(at + 1 - text);
    return true;
}

bool tn_source_line(tn_source_lines *lines, uint32_t source, uint32_t offset, size_t *line)
{
    starts *found = &lines->sources[source];
    if (!found->of && !find_starts(lines, source, found))
        return false;
    size_t low = 0, high = found->count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (found->of[middle] <= offset)
            low = middle;
        else
            high = middle;
    }
    *line = low;
    return true;
}

const char *tn_source_line_text(const tn_source_lines *lines, uint32_t source, size_t line)
{
    return text_of(lines, source) + lines->sources[source].of[line];
}

static void list_header(tn_lister *lister)
{
    const tn_module *module = lister->module;
    fprintf(lister->out, "module: format %u, hash %016llx\n", TN_MODULE_FORMAT, (unsigned long long)module->hash);
    for (size_t i = 0; i < module->PRODUCER_count; i++) {
        fputs("written by ", lister->out);
        tn_list_name(lister, module->PRODUCER_records[i].version);
        fprintf(lister->out, " from sources with hash %016llx\n",
                (unsigned long long)module->PRODUCER_records[i].sources_hash);
    }
    for (size_t i = 0; i < module->SOURCE_count; i++) {
        fprintf(lister->out, "source %zu  ", i);
        const char *path = tn_text(module, module->SOURCE_records[i].path);
        tn_list_name(lister, module->SOURCE_records[i].path);
        if (path[0] == '-' && path[1] == '-') { /* what an option said */
            fputc(' ', lister->out);
            tn_list_name(lister, module->SOURCE_records[i].text);
        }
        fputc('\n', lister->out);
    }
}

/* The records of an engine that lists none by itself. */
static void list_sections(tn_lister *lister, const tn_section *sections)
{
    for (; sections && *sections != TN_SECTION_STRINGS; sections++) {
        size_t count = lister->module->tables[*sections].count;
        if (count > 0)
            fprintf(lister->out, "\n%s\n", tn_section_describe(*sections).name);
        for (uint32_t i = 0; i < count && !ferror(lister->out); i++)
            tn_list_record(lister, *sections, i);
    }
}

static void list_function(tn_lister *lister, uint32_t index)
{
    const tn_function_record *function = &lister->module->FUNCTION_records[index];
    fputc('\n', lister->out);
    tn_list_function(lister, index);
    const tn_engine *engine = tn_engine_of_code(lister->engines, tn_function_kinds[function->kind].code);
    if (engine->list_heading)
        engine->list_heading(lister, index);
    fprintf(lister->out, ", stack %u\n", function->stack_max);
    lister->shown_line = 0;
    lister->function = index;
    tn_list_code(lister, function->code_begin, function->code_end, NULL);
}

static void list_module(tn_lister *lister)
{
    const tn_engines *engines = lister->engines;
    list_header(lister);
    for (size_t i = 0; i < engines->count; i++) {
        if (engines->items[i]->list)
            engines->items[i]->list(lister);
        else if (!engines->items[i]->list_code)
            list_sections(lister, engines->items[i]->sections);
    }
    for (uint32_t i = 0; i < lister->module->FUNCTION_count && !ferror(lister->out); i++)
        list_function(lister, i);
    for (size_t i = 0; i < engines->count; i++)
        if (engines->items[i]->list_code)
            engines->items[i]->list_code(lister);
}

/* ---- one record */

/* Marks the functions that a function's code names. They are numbered below it. */
static void mark_callees(const tn_module *module, const tn_function_record *function, bool *needed)
{
    for (uint32_t offset = function->code_begin; offset < function->code_end;) {
        tn_instruction instruction = tn_code_read(module->code, offset);
        const tn_slot *slots = tn_operand_slots[tn_code_operands((uint8_t)instruction.opcode)];
        if (slots[0].kind == TN_SLOT_INDEX && slots[0].section == TN_SECTION_FUNCTION)
            needed[instruction.first] = true;
        if (slots[1].kind == TN_SLOT_INDEX && slots[1].section == TN_SECTION_FUNCTION)
            needed[instruction.second] = true;
        offset += instruction.length;
    }
}

/* Marks the functions that a record refers to. */
static void mark_functions(const tn_module *module, tn_section section, uint32_t index, bool *needed)
{
    tn_section_info info = tn_section_describe(section);
    const char *record = (const char *)module->tables[section].records + index * info.size;
    for (size_t i = 0; i < info.members.count; i++)
        if (info.members.items[i].kind == TN_MEMBER_REF && info.members.items[i].section == TN_SECTION_FUNCTION)
            needed[tn_member_whole(record, &info.members.items[i])] = true;
}

static bool list_one(tn_lister *lister, tn_section section, uint32_t index)
{
    const tn_module *module = lister->module;
    bool *needed = calloc(module->FUNCTION_count + 1, sizeof *needed);
    if (!needed)
        return false;
    mark_functions(module, section, index, needed);
    for (size_t i = module->FUNCTION_count; i-- > 0;)
        if (needed[i])
            mark_callees(module, &module->FUNCTION_records[i], needed);
    const tn_engine *engine = tn_engine_of_section(lister->engines, section);
    if (!engine || !engine->list_record || !engine->list_record(lister, section, index))
        tn_list_record(lister, section, index);
    for (uint32_t i = 0; i < module->FUNCTION_count && !ferror(lister->out); i++)
        if (needed[i])
            list_function(lister, i);
    free(needed);
    return true;
}

/* ---- both */

static bool begin(tn_lister *lister, const tn_module *module, const tn_engines *engines, FILE *out)
{
    *lister = (tn_lister){.module = module, .engines = engines, .out = out, .lines = tn_source_lines_new(module)};
    tn_engines_operands(engines, lister->operands);
    return lister->lines != NULL;
}

static bool end(tn_lister *lister, bool listed)
{
    tn_source_lines_free(lister->lines);
    return listed && !lister->failed && !ferror(lister->out);
}

bool tn_module_list(const tn_module *module, const tn_engines *engines, FILE *out)
{
    tn_lister lister;
    bool ready = begin(&lister, module, engines, out);
    if (ready)
        list_module(&lister);
    return end(&lister, ready);
}

bool tn_module_list_record(const tn_module *module, const tn_engines *engines, tn_section section, uint32_t index,
                           FILE *out)
{
    tn_lister lister;
    bool ready = begin(&lister, module, engines, out) && list_one(&lister, section, index);
    return end(&lister, ready);
}
