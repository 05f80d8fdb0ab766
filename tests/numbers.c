/* Prints what modules number, from the tables: numbers [MODULE...]
 *
 * Each line is a kind, a name, a number and what else never changes about it ("-": nothing), with tabs between: the
 * operands of an instruction, how a field is stored. With modules: the numbers of the instructions that they hold, each
 * once. tests/modules.py compares the first with tests/modules/numbers.txt, and looks with the second whether the
 * modules kept there hold all of them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/file.h"
#include "runtime/genome/settings.h"
#include "runtime/load.h"
#include "runtime/module/code.h"
#include "runtime/module/engine.h"
#include "runtime/module/records.h"

/* ---- code */

static const char *slot_text(tn_slot slot)
{
    static const char *const words[] = {[TN_SLOT_NOTHING] = "-",
                                        [TN_SLOT_U32] = "u32",
                                        [TN_SLOT_I64] = "i64",
                                        [TN_SLOT_F64] = "f64",
                                        [TN_SLOT_STRING] = "string"};
    return slot.kind == TN_SLOT_INDEX ? tn_section_describe(slot.section).name : words[slot.kind];
}

static void print_code(void)
{
    for (unsigned i = 0; i < TN_OPCODE_COUNT; i++) {
        const tn_opcode_info *info = tn_opcode_describe((uint8_t)i);
        if (!info)
            continue;
        const tn_slot *slots = tn_operand_slots[info->operands];
        printf("instruction\t%s\t%u\t%s", info->name, i, slot_text(slots[0]));
        if (slots[1].kind != TN_SLOT_NOTHING)
            printf(", %s", slot_text(slots[1]));
        putchar('\n');
    }
#define FUNCTION_KIND(NAME, NUMBER, CODE, LAST, WORD) printf("function\t" #NAME "\t%d\t-\n", NUMBER);
#include "runtime/module/opcodes.def"
}

/* ---- records */

static void print_flags(const char *section, const tn_member *member)
{
    unsigned bit = 1;
    for (const char *word = member->words; *word; bit *= 2) {
        int size = (int)strcspn(word, "|");
        printf("flag\t%s:%s:%.*s\t%u\t-\n", section, member->name, size, word, bit);
        word += size + (word[size] == '|');
    }
}

/* A field's number is its place in the record. */
static void print_section(tn_section section)
{
    static const char *const storages[] = {
        [TN_STORAGE_U32] = "u32", [TN_STORAGE_I64] = "i64", [TN_STORAGE_F64] = "f64"};
    tn_section_info info = tn_section_describe(section);
    printf("section\t%s\t%u\t-\n", info.name, info.number);
    for (size_t i = 0; i < info.members.count; i++) {
        const tn_member *member = &info.members.items[i];
        printf("field\t%s:%s\t%zu\t%s\n", info.name, member->name, i, storages[member->storage]);
        if (member->kind == TN_MEMBER_FLAGS)
            print_flags(info.name, member);
    }
}

static void print_records(void)
{
#define VALUE(ID, NUMBER, WORD) printf("value\t%s:" #ID "\t%d\t-\n", enumeration, NUMBER);
#define ENUMERATION(NAME, TYPE, VALUES)                                                                                \
    {                                                                                                                  \
        const char *enumeration = #NAME;                                                                               \
        VALUES                                                                                                         \
    }
#include "runtime/module/values.def"
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++)
        print_section(i);
}

/* ---- what engines number on their own */

static void print_terms(const tn_engine *engine)
{
    for (uint32_t i = 0; i < engine->term_count; i++)
        printf("term\t%s:%s\t%u\t-\n", engine->name, engine->terms[i], (unsigned)i);
}

static void print_choices(const tn_setting_row *row)
{
    char word[32];
    for (uint32_t i = 0; i < tn_setting_choice_count(row); i++) {
        tn_setting_choice_name(row, i, word);
        printf("choice\t%s:%s\t%u\t-\n", row->name, word, (unsigned)i);
    }
}

static void print_engines(void)
{
    const tn_engines *engines = tn_engines_all();
    for (size_t i = 0; i < engines->count; i++)
        print_terms(engines->items[i]);
    for (tn_setting i = 0; i < TN_SETTING_COUNT; i++) {
        if (!tn_setting_rows[i].name)
            continue;
        printf("setting\t%s\t%u\t-\n", tn_setting_rows[i].name, (unsigned)i);
        print_choices(&tn_setting_rows[i]);
    }
}

/* ---- modules */

/* Notes which instructions a module holds. */
static bool note(const char *path, bool held[TN_OPCODE_COUNT])
{
    tn_error error = {0};
    uint8_t *bytes = NULL;
    size_t size;
    tn_module *module = NULL;
    tn_status status = tn_file_read(path, SIZE_MAX, &bytes, &size, &error);
    if (status == TN_OK)
        status = tn_module_load(bytes, size, NULL, &module, &error);
    for (uint32_t at = 0; module && at < module->code_size; at += tn_code_read(module->code, at).length)
        held[module->code[at]] = true;
    if (status != TN_OK)
        fprintf(stderr, "numbers: %s: %s\n", path, error.message);
    tn_module_free(module);
    free(bytes);
    return status == TN_OK;
}

int main(int count, char **arguments)
{
    bool held[TN_OPCODE_COUNT] = {false}, good = true;
    if (count == 1) {
        print_code();
        print_records();
        print_engines();
        return 0;
    }
    for (int i = 1; i < count; i++)
        good = note(arguments[i], held) && good;
    for (unsigned i = 0; i < TN_OPCODE_COUNT; i++)
        if (held[i])
            printf("%u\n", i);
    return good ? 0 : 1;
}
