#include "runtime/module/disasm.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/utf8.h"
#include "runtime/genome/list.h"
#include "runtime/growth/model/list.h"
#include "runtime/growth/model/records.h"
#include "runtime/module/code.h"
#include "runtime/module/disasm_lines.h"
#include "runtime/plan/match/condition_text.h"

/* What is listed of one text: a module from anywhere must not make the listing endless. */
enum { TEXT_SHOWN = 240 };

typedef struct tn_lister {
    const tn_module *module;
    FILE *out;
    tn_source_lines *lines;
    uint32_t shown_file; /* the source line that was shown last */
    size_t shown_line;
    bool failed; /* out of memory */
} tn_lister;

/* A line under construction that is cut where it grows too long. */
typedef struct tn_phrase {
    char text[TEXT_SHOWN + 1];
    size_t size;
    bool cut;
} tn_phrase;

static void say(tn_phrase *phrase, const char *text)
{
    if (phrase->cut)
        return;
    size_t size = strlen(text);
    if (size > TEXT_SHOWN - 3 - phrase->size) {
        phrase->cut = true;
        text = "...";
        size = 3;
    }
    memcpy(phrase->text + phrase->size, text, size + 1);
    phrase->size += size;
}

static void write_text(tn_lister *lister, const char *text)
{
    size_t size = strnlen(text, TEXT_SHOWN + 1);
    bool cut = size > TEXT_SHOWN;
    tn_write_clean(lister->out, text, cut ? TEXT_SHOWN : size);
    if (cut)
        fputs("...", lister->out);
}

static void write_name(tn_lister *lister, tn_string name)
{
    write_text(lister, tn_text(lister->module, name));
}

static void write_doc(tn_lister *lister, tn_string doc)
{
    if (doc == 0)
        return;
    fputs(" \"", lister->out);
    write_name(lister, doc);
    fputc('"', lister->out);
}

/* ---- places */

static bool find_line(tn_lister *lister, uint32_t file, uint32_t offset, size_t *line)
{
    bool found = tn_source_line(lister->lines, file, offset, line);
    lister->failed |= !found;
    return found;
}

/* Ends the line of a record with where it comes from. */
static void write_place(tn_lister *lister, uint32_t file, uint32_t begin)
{
    fputs("  (", lister->out);
    write_name(lister, lister->module->SOURCE_records[file].path);
    size_t line;
    if (find_line(lister, file, begin, &line))
        fprintf(lister->out, ":%zu", line + 1);
    fputs(")\n", lister->out);
}

/* ---- specifiers */

static bool has_bit(const tn_module *module, const tn_spec_record *spec, uint32_t bit)
{
    uint64_t word = (uint64_t)module->MASK_records[spec->mask_first + bit / 64].bits;
    return word >> (bit % 64) & 1;
}

/* "width 4'|8'": the values of one field that the specifier allows; nothing where it allows all. */
static void describe_field(const tn_module *module, const tn_spec_record *spec, const tn_field_record *field,
                           uint32_t first_bit, tn_phrase *phrase)
{
    uint32_t allowed = 0;
    for (uint32_t i = 0; i < field->value_count; i++)
        allowed += has_bit(module, spec, first_bit + i);
    if (allowed == field->value_count)
        return;
    say(phrase, phrase->size ? ", " : "");
    say(phrase, tn_text(module, field->name));
    say(phrase, allowed ? " " : " none");
    const char *between = "";
    for (uint32_t i = 0; i < field->value_count && !phrase->cut; i++) {
        if (!has_bit(module, spec, first_bit + i))
            continue;
        say(phrase, between);
        say(phrase, tn_text(module, module->VALUE_records[field->value_first + i].spelling));
        between = "|";
    }
}

static void describe_spec(const tn_module *module, uint32_t index, tn_phrase *phrase)
{
    const tn_spec_record *spec = &module->SPEC_records[index];
    const tn_schema_record *schema = &module->SCHEMA_records[spec->schema];
    uint32_t first_value = module->FIELD_records[schema->field_first].value_first;
    for (uint32_t i = 0; i < schema->field_count && !phrase->cut; i++) {
        const tn_field_record *field = &module->FIELD_records[schema->field_first + i];
        describe_field(module, spec, field, field->value_first - first_value, phrase);
    }
    if (phrase->size == 0)
        say(phrase, "any tray");
}

static void write_spec(tn_lister *lister, uint32_t index)
{
    tn_phrase phrase = {0};
    describe_spec(lister->module, index, &phrase);
    write_text(lister, phrase.text);
}

/* ---- tables */

static void list_header(tn_lister *lister)
{
    const tn_module *module = lister->module;
    fprintf(lister->out, "module: format %u, hash %016llx\n", TN_MODULE_FORMAT, (unsigned long long)module->hash);
    for (size_t i = 0; i < module->PRODUCER_count; i++) {
        fputs("written by ", lister->out);
        write_name(lister, module->PRODUCER_records[i].version);
        fprintf(lister->out, " from sources with hash %016llx\n",
                (unsigned long long)module->PRODUCER_records[i].sources_hash);
    }
    for (size_t i = 0; i < module->SOURCE_count; i++) {
        fprintf(lister->out, "source %zu  ", i);
        write_name(lister, module->SOURCE_records[i].path);
        fprintf(lister->out, "\n");
    }
}

static void list_value(tn_lister *lister, tn_field_kind kind, const tn_value_record *value)
{
    static const char *const roles[] = {"", ", solid", ", void", ", absent"};
    fputs("      ", lister->out);
    write_name(lister, value->spelling);
    if (kind == TN_FIELD_ZONE) {
        fputs("  fill ", lister->out);
        write_name(lister, value->name);
        fprintf(lister->out, ", %lld nm%s", (long long)value->length, roles[value->role]);
    } else if (kind == TN_FIELD_LENGTH) {
        fprintf(lister->out, "  %lld nm", (long long)value->length);
    }
    write_doc(lister, value->doc);
    fputc('\n', lister->out);
}

static void list_field(tn_lister *lister, uint32_t index)
{
    static const char *const kinds[] = {"length", "choice", "flag", "zone"};
    static const char *const roles[] = {
        "", ", role length", ", role level", ", role public-end", ", role great-hall", ", role band"};
    const tn_field_record *field = &lister->module->FIELD_records[index];
    fprintf(lister->out, "  field %u  ", index);
    write_name(lister, field->name);
    fprintf(lister->out, ": %s%s", kinds[field->kind], roles[field->role]);
    write_doc(lister, field->doc);
    fputc('\n', lister->out);
    for (uint32_t i = 0; i < field->value_count; i++)
        list_value(lister, (tn_field_kind)field->kind, &lister->module->VALUE_records[field->value_first + i]);
}

static void list_schema(tn_lister *lister, uint32_t index)
{
    const tn_schema_record *schema = &lister->module->SCHEMA_records[index];
    fprintf(lister->out, "\nschema %u  ", index);
    write_name(lister, schema->name);
    write_doc(lister, schema->doc);
    write_place(lister, schema->file, schema->begin);
    for (uint32_t i = 0; i < schema->field_count; i++)
        list_field(lister, schema->field_first + i);
    for (uint32_t i = 0; i < schema->forbid_count; i++)
        fprintf(lister->out, "  forbids specifier %u\n", schema->forbid_first + i);
}

static void list_specs(tn_lister *lister)
{
    if (lister->module->SPEC_count > 0)
        fputs("\nspecifiers\n", lister->out);
    for (uint32_t i = 0; i < lister->module->SPEC_count; i++) {
        fprintf(lister->out, "  %u  ", i);
        write_spec(lister, i);
        fputc('\n', lister->out);
    }
}

static void list_rule(tn_lister *lister, size_t index)
{
    const tn_rule_record *rule = &lister->module->RULE_records[index];
    fprintf(lister->out, "  %zu  ", index);
    write_name(lister, rule->name);
    write_doc(lister, rule->doc);
    fprintf(lister->out, ": whole function %u, holds function %u%s", rule->whole, rule->holds,
            rule->flags & TN_IMPORTED ? ", imported" : "");
    write_place(lister, rule->file, rule->begin);
}

static void list_rules(tn_lister *lister)
{
    if (lister->module->RULE_count > 0)
        fputs("\nrules\n", lister->out);
    for (size_t i = 0; i < lister->module->RULE_count; i++)
        list_rule(lister, i);
}

static void list_library(tn_lister *lister, size_t index)
{
    static const char *const kinds[] = {"require", "total", "prune"};
    const tn_library_record *library = &lister->module->LIBRARY_records[index];
    fprintf(lister->out, "\nlibrary %zu  ", index);
    write_name(lister, library->name);
    write_doc(lister, library->doc);
    fputs(" using ", lister->out);
    write_name(lister, lister->module->SCHEMA_records[library->schema].name);
    fprintf(lister->out, ": %u..%u trays%s", library->trays_min, library->trays_max,
            library->flags & TN_IMPORTED ? ", imported" : "");
    write_place(lister, library->file, library->begin);
    for (uint32_t i = 0; i < library->clause_count; i++) {
        const tn_clause_record *clause = &lister->module->CLAUSE_records[library->clause_first + i];
        fprintf(lister->out, "  %s ", kinds[clause->kind]);
        write_name(lister, clause->name);
        write_doc(lister, clause->doc);
        fprintf(lister->out, ": function %u", clause->holds);
        write_place(lister, clause->file, clause->begin);
    }
}

/* ---- source lines beside code */

/* Shows the line that a place begins in, unless it was the last one shown. */
static void show_source(tn_lister *lister, const tn_map_record *place)
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
    while (size < TEXT_SHOWN && text[size] && text[size] != '\n' && text[size] != '\r')
        size++;
    fputs("  ; ", lister->out);
    write_name(lister, lister->module->SOURCE_records[place->file].path);
    fprintf(lister->out, ":%zu: ", line + 1);
    tn_write_clean(lister->out, text, size);
    fputs(size == TEXT_SHOWN ? "...\n" : "\n", lister->out);
}

/* ---- code */

static void write_function(tn_lister *lister, uint32_t index)
{
    static const char *const kinds[] = {"whole", "holds", "condition", "measure"};
    const tn_function_record *function = &lister->module->FUNCTION_records[index];
    fprintf(lister->out, "function %u (%s", index, kinds[function->kind]);
    if (function->kind == TN_FUNCTION_CONDITION) {
        char text[TN_CONDITION_TEXT_MAX];
        tn_condition_text(lister->module, index, text);
        fprintf(lister->out, " %s", text);
    }
    if (function->name != 0) {
        fputc(' ', lister->out);
        write_name(lister, function->name);
    }
    fputc(')', lister->out);
}

static double real_of(int64_t bits)
{
    double number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static void write_operands(tn_lister *lister, const tn_instruction *instruction)
{
    FILE *out = lister->out;
    uint32_t index = (uint32_t)instruction->first;
    switch (tn_code_operands((uint8_t)instruction->opcode)) {
    case TN_OPERANDS_NONE:
        break;
    case TN_OPERANDS_SPEC:
        fprintf(out, " spec %u  ", index);
        write_spec(lister, index);
        break;
    case TN_OPERANDS_FUNC:
    case TN_OPERANDS_COND:
        fputc(' ', out);
        write_function(lister, index);
        break;
    case TN_OPERANDS_FIELD_COND:
        fprintf(out, " field %u (", index);
        write_name(lister, lister->module->FIELD_records[index].name);
        fputs("), ", out);
        write_function(lister, (uint32_t)instruction->second);
        break;
    case TN_OPERANDS_INT:
        fprintf(out, " %lld", (long long)instruction->first);
        break;
    case TN_OPERANDS_INT2:
        fprintf(out, " %lld, %lld", (long long)instruction->first, (long long)instruction->second);
        break;
    case TN_OPERANDS_REAL:
        fprintf(out, " %.17g", real_of(instruction->first));
        break;
    case TN_OPERANDS_TERM:
        fprintf(out, " %s", tn_measured_names[index]);
        break;
    case TN_OPERANDS_TEXT:
        fputs(" \"", out);
        write_name(lister, index);
        fputc('"', out);
        break;
    case TN_OPERANDS_SYMBOL:
        fputc(' ', out);
        write_name(lister, lister->module->NONTERMINAL_records[index].name);
        break;
    case TN_OPERANDS_LETTER:
        fprintf(out, " %c", (char)('X' + index));
        break;
    case TN_OPERANDS_BODY:
        fprintf(out, " %u bytes", index);
        break;
    }
}

static void list_function(tn_lister *lister, uint32_t index)
{
    const tn_module *module = lister->module;
    const tn_function_record *function = &module->FUNCTION_records[index];
    fputc('\n', lister->out);
    write_function(lister, index);
    if (function->kind == TN_FUNCTION_WHOLE || function->kind == TN_FUNCTION_HOLDS) {
        fputs(" of ", lister->out);
        write_name(lister, module->SCHEMA_records[function->schema].name);
    }
    fprintf(lister->out, ", stack %u\n", function->stack_max);
    lister->shown_line = 0;
    for (uint32_t offset = function->code_begin; offset < function->code_end;) {
        tn_instruction instruction = tn_code_read(module->code, offset);
        show_source(lister, tn_module_place(module, offset));
        bool bare = tn_code_operands((uint8_t)instruction.opcode) == TN_OPERANDS_NONE;
        fprintf(lister->out, bare ? "  %6u  %s" : "  %6u  %-11s", offset,
                tn_opcode_describe(module->code[offset])->name);
        write_operands(lister, &instruction);
        fputc('\n', lister->out);
        offset += instruction.length;
    }
}

/* ---- grammars */

static void list_nonterminal(tn_lister *lister, uint32_t index)
{
    const tn_module *module = lister->module;
    const tn_nonterminal_record *rule = &module->NONTERMINAL_records[index];
    fputc('\n', lister->out);
    write_name(lister, rule->name);
    fprintf(lister->out, ", productions %u..%u\n", rule->production_first,
            rule->production_first + rule->production_count - 1);
    lister->shown_line = 0;
    for (uint32_t i = 0; i < rule->production_count && !ferror(lister->out); i++) {
        const tn_production_record *production = &module->PRODUCTION_records[rule->production_first + i];
        tn_map_record place = {production->code_begin, production->file, production->begin, production->end};
        show_source(lister, &place);
        for (uint32_t offset = production->code_begin; offset < production->code_end;) {
            tn_instruction instruction = tn_code_read(module->code, offset);
            bool bare = tn_code_operands((uint8_t)instruction.opcode) == TN_OPERANDS_NONE;
            fprintf(lister->out, bare ? "  %6u  %s" : "  %6u  %-11s", offset,
                    tn_opcode_describe((uint8_t)instruction.opcode)->name);
            write_operands(lister, &instruction);
            fputc('\n', lister->out);
            offset += instruction.length;
        }
    }
}

static void list_grammar(tn_lister *lister, size_t index)
{
    static const char *const dialects[] = {"ge", "genr8"}, *const repairs[] = {"genome", "identity", "off"};
    const tn_grammar_record *grammar = &lister->module->GRAMMAR_records[index];
    fprintf(lister->out, "\ngrammar %zu  ", index);
    write_name(lister, grammar->name);
    fprintf(lister->out, ": dialect %s, depth %u, wraps %u, repair %s%s", dialects[grammar->dialect],
            grammar->max_depth, grammar->wraps, repairs[grammar->repair],
            grammar->flags & TN_SKIP_SINGLE ? ", single choices read nothing" : "");
    write_place(lister, grammar->file, grammar->begin);
    for (uint32_t i = 0; i < grammar->rule_count && !ferror(lister->out); i++)
        list_nonterminal(lister, grammar->rule_first + i);
}

static void list_module(tn_lister *lister)
{
    const tn_module *module = lister->module;
    list_header(lister);
    tn_disassemble_settings(module, lister->out);
    for (uint32_t i = 0; i < module->SCHEMA_count; i++)
        list_schema(lister, i);
    list_specs(lister);
    list_rules(lister);
    for (size_t i = 0; i < module->LIBRARY_count; i++)
        list_library(lister, i);
    for (uint32_t i = 0; i < module->FUNCTION_count && !ferror(lister->out); i++)
        list_function(lister, i);
    for (size_t i = 0; i < module->GRAMMAR_count && !ferror(lister->out); i++)
        list_grammar(lister, i);
    tn_disassemble_growth(module, lister->out);
}

/* Marks the functions that a function's code names. They are numbered below it. */
static void mark_callees(const tn_module *module, const tn_function_record *function, bool *needed)
{
    for (uint32_t offset = function->code_begin; offset < function->code_end;) {
        tn_instruction instruction = tn_code_read(module->code, offset);
        tn_operands operands = tn_code_operands((uint8_t)instruction.opcode);
        if (operands == TN_OPERANDS_FUNC || operands == TN_OPERANDS_COND)
            needed[instruction.first] = true;
        else if (operands == TN_OPERANDS_FIELD_COND)
            needed[instruction.second] = true;
        offset += instruction.length;
    }
}

static bool list_rule_code(tn_lister *lister, uint32_t rule)
{
    const tn_module *module = lister->module;
    bool *needed = calloc(module->FUNCTION_count + 1, sizeof *needed);
    if (!needed)
        return false;
    needed[module->RULE_records[rule].whole] = needed[module->RULE_records[rule].holds] = true;
    for (size_t i = module->FUNCTION_count; i-- > 0;)
        if (needed[i])
            mark_callees(module, &module->FUNCTION_records[i], needed);
    list_rule(lister, rule);
    for (uint32_t i = 0; i < module->FUNCTION_count && !ferror(lister->out); i++)
        if (needed[i])
            list_function(lister, i);
    free(needed);
    return true;
}

/* Lists one rule, or (rule = UINT32_MAX) all. */
static bool list(const tn_module *module, uint32_t rule, FILE *out)
{
    tn_lister lister = {.module = module, .out = out};
    lister.lines = tn_source_lines_new(module);
    bool ready = lister.lines != NULL;
    if (ready && rule != UINT32_MAX)
        ready = list_rule_code(&lister, rule);
    else if (ready)
        list_module(&lister);
    tn_source_lines_free(lister.lines);
    return ready && !lister.failed && !ferror(out);
}

bool tn_module_disassemble(const tn_module *module, FILE *out)
{
    return list(module, UINT32_MAX, out);
}

bool tn_module_disassemble_rule(const tn_module *module, uint32_t rule, FILE *out)
{
    return list(module, rule, out);
}
