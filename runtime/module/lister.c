/* Lists texts, places, records and code: what the listings of all engines are made of. */
#include "runtime/module/lister.h"

#include <inttypes.h>
#include <string.h>

#include "runtime/base/utf8.h"
#include "runtime/module/engine.h"
#include "runtime/module/records.h"

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

/* The name that a record has in the field of that name; nothing where it has none. */
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
