/* Lists a module: its header, the tables of each engine, the functions, and what else has code. */
#include "runtime/module/disasm.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/module/disasm_lines.h"
#include "runtime/module/records.h"

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
