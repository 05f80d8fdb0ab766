/* The front end of .solid files: makes the syntax tree, as the parser asks; writes a checked design into a module; lays
 * files out, lists what they have, and compiles them. */
#include <stdio.h>
#include <string.h>

#include "compiler/common/import.h"
#include "compiler/common/layout.h"
#include "compiler/common/notation.h"
#include "compiler/solid/solid.h"

/* ---- makes the syntax tree of .solid files: what the parser calls */

tn_solid_item *tn_solid_item_new(tn_parsing *parse, tn_solid_statement kind, tn_span span)
{
    tn_solid_item *item = TN_NEW(parse->arena, tn_solid_item);
    if (item) {
        item->kind = kind;
        item->span = span;
    }
    return item;
}

tn_solid_part *tn_solid_part_new(tn_parsing *parse, tn_solid_part_kind kind, tn_span span, tn_solid_part *before)
{
    tn_solid_part *part = TN_NEW(parse->arena, tn_solid_part);
    if (part) {
        part->kind = kind;
        part->span = span;
        part->next = before;
    }
    return part;
}

tn_solid_entry *tn_solid_entry_new(tn_parsing *parse, tn_span span)
{
    tn_solid_entry *entry = TN_NEW(parse->arena, tn_solid_entry);
    if (entry)
        entry->span = span;
    return entry;
}

tn_solid_entries tn_solid_entries_add(tn_solid_entries list, tn_solid_entry *entry)
{
    TN_CHAIN(&list, entry);
    return list;
}

tn_solid_design *tn_solid_design_new(tn_parsing *parse)
{
    return TN_NEW(parse->arena, tn_solid_design);
}

void tn_solid_add_item(tn_solid_design *design, tn_solid_item *item)
{
    if (design)
        TN_CHAIN(design, item);
}

void tn_solid_add_design(tn_parsing *parse, tn_solid_design *design)
{
    tn_solid_file *file = parse->result;
    TN_CHAIN(file, design);
}

void tn_solid_add_use(tn_parsing *parse, tn_solid_text path)
{
    tn_solid_file *file = parse->result;
    tn_solid_use *use = TN_NEW(parse->arena, tn_solid_use);
    if (use)
        use->path = path;
    TN_CHAIN(&file->uses, use);
}

/* Is this a word that starts a statement of a design? */
static bool solid_heads(const char *text, size_t size)
{
    return tn_vocabulary_find(&tn_solid_words, text, size, TN_SOLID_AT(LINE), TN_AS_KEYWORDS) != NULL;
}

/* ---- from checked designs to the records of a module. A design that is made from another holds all boxes of both */

typedef struct emitting {
    tn_builder *builder;
    const tn_sources *sources;
    tn_formula formula;
    tn_error *error;
    tn_status status;
} emitting;

static uint32_t emit_function(emitting *e, const char *name, const tn_expression *expression, bool violation)
{
    if (e->status == TN_OK)
        e->status = violation ? tn_expression_violation(expression, true, &e->formula, e->error)
                              : tn_expression_code(expression, &e->formula, e->error);
    return e->status == TN_OK ? tn_formula_emit(e->builder, TN_FUNCTION_SOLID_MEASURE, name, &e->formula) : 0;
}

static void emit_box(emitting *e, const tn_checked_box *box)
{
    tn_box_record record = box->record;
    record.name = tn_builder_string(e->builder, box->item->name.text);
    record.doc = tn_builder_string(e->builder, box->item->doc.text);
    tn_builder_add_BOX(e->builder, &record);
}

static void emit_item(emitting *e, const tn_solid_item *item)
{
    for (const tn_solid_entry *entry = item->entries.first; entry; entry = entry->next) {
        tn_span at = entry->span;
        if (item->kind == TN_SOLID_ASKS) {
            uint32_t function = emit_function(e, NULL, entry->expression, false);
            size_t size = strnlen(entry->words, TN_NAME_MAX);
            tn_solid_measure_record record = {tn_builder_string_n(e->builder, entry->words, size), function, at.file,
                                              at.begin, at.end};
            tn_builder_add_SOLID_MEASURE(e->builder, &record);
        } else if (item->kind == TN_SOLID_REQUIRES) {
            uint32_t holds = emit_function(e, NULL, entry->expression, false);
            uint32_t violation = emit_function(e, NULL, entry->expression, true);
            tn_builder_add_REQUIREMENT(e->builder,
                                       &(tn_requirement_record){holds, violation, at.file, at.begin, at.end});
        }
    }
}

double tn_solid_goal_number(const tn_sources *sources, const tn_solid_item *item, int which, double otherwise)
{
    if (item->given[which].end == item->given[which].begin)
        return otherwise;
    const tn_solid_number *number = &item->number[which];
    const char *text = sources->files[number->digits.file].text + number->digits.begin;
    double value = tn_decimal_value(text, number->digits.end - number->digits.begin);
    return number->negative ? -value : value;
}

static void emit_goal(emitting *e, const tn_solid_item *item)
{
    tn_solid_goal_record record = {.name = tn_builder_string(e->builder, item->name.text),
                                   .function =
                                       emit_function(e, item->name.text, item->entries.first->expression, false),
                                   .target = tn_solid_goal_number(e->sources, item, 0, 0),
                                   .weight = tn_solid_goal_number(e->sources, item, 1, 1),
                                   .file = item->span.file,
                                   .begin = item->span.begin,
                                   .end = item->span.end};
    tn_builder_add_SOLID_GOAL(e->builder, &record);
}

/* What it is made from comes first. Depth is bounded by how many designs there are, each of which names one above it.
 */
static void emit_boxes(emitting *e, const tn_checked_solid *solid)
{
    if (solid->base && !solid->anew)
        emit_boxes(e, solid->base);
    for (const tn_checked_box *box = solid->first; box; box = box->next)
        emit_box(e, box);
}

static void emit_conditions(emitting *e, const tn_checked_solid *solid)
{
    if (solid->base)
        emit_conditions(e, solid->base);
    for (const tn_solid_item *item = solid->design->first; item; item = item->next) {
        if (item->kind == TN_SOLID_AIMS)
            emit_goal(e, item);
        else if (item->kind == TN_SOLID_ASKS || item->kind == TN_SOLID_REQUIRES)
            emit_item(e, item);
    }
}

static void emit_design(emitting *e, const tn_checked_solid *solid)
{
    tn_builder *b = e->builder;
    const tn_solid_design *design = solid->design;
    tn_solid_record record = {.name = tn_builder_string(b, design->name.text),
                              .doc = tn_builder_string(b, design->doc.text),
                              .flags = solid->flags | (solid->imported ? TN_SOLID_IMPORTED : 0),
                              .model = solid->model,
                              .depth = solid->depth,
                              .unit_top = solid->unit.top,
                              .unit_bottom = solid->unit.bottom,
                              .box_first = (uint32_t)tn_builder_count(b, TN_SECTION_BOX),
                              .asked_first = (uint32_t)tn_builder_count(b, TN_SECTION_SOLID_MEASURE),
                              .requirement_first = (uint32_t)tn_builder_count(b, TN_SECTION_REQUIREMENT),
                              .goal_first = (uint32_t)tn_builder_count(b, TN_SECTION_SOLID_GOAL),
                              .file = design->span.file,
                              .begin = design->span.begin,
                              .end = design->span.end};
    emit_boxes(e, solid);
    emit_conditions(e, solid);
    record.box_count = (uint32_t)tn_builder_count(b, TN_SECTION_BOX) - record.box_first;
    record.asked_count = (uint32_t)tn_builder_count(b, TN_SECTION_SOLID_MEASURE) - record.asked_first;
    record.requirement_count = (uint32_t)tn_builder_count(b, TN_SECTION_REQUIREMENT) - record.requirement_first;
    record.goal_count = (uint32_t)tn_builder_count(b, TN_SECTION_SOLID_GOAL) - record.goal_first;
    tn_builder_add_SOLID(b, &record);
}

/* TN_OK or TN_MEMORY. */
static tn_status emit_solids(tn_builder *builder, const tn_sources *sources, const tn_checked_solids *solids,
                             tn_error *error)
{
    emitting e = {.builder = builder, .sources = sources, .error = error, .status = TN_OK};
    for (const tn_checked_solid *solid = solids->first; solid && e.status == TN_OK; solid = solid->next)
        emit_design(&e, solid);
    tn_formula_clear(&e.formula);
    return e.status;
}

/* ---- laying out .solid files: a statement a line; one that is too long goes on where its next part begins */

static bool is_ratio(const tn_format *format, size_t i)
{
    return i >= 2 && tn_format_is(format, i, "/") && tn_format_is(format, i - 2, "unit");
}

static size_t gap_before(const tn_format *format, size_t i)
{
    bool tight = tn_format_is(format, i, ")") || tn_format_is(format, i, ",") || tn_format_is(format, i, ";") ||
                 tn_format_is(format, i - 1, "(") || tn_format_is_minus_sign(format, i - 1) ||
                 tn_format_is(format, i, "..") || tn_format_is(format, i - 1, "..") || is_ratio(format, i) ||
                 is_ratio(format, i - 1) ||
                 (tn_format_is(format, i, "(") && format->tokens[i - 1].kind == TN_TOKEN_NAME);
    return tight ? 0 : 1;
}

/* Where a statement that is too long goes on in the next line. */
static bool at_part(const tn_format *format, size_t i)
{
    bool joins = tn_format_is_word(format, i, &tn_solid_words, TN_SOLID_AT(MEASURED), TN_AS_INFIX);
    return (joins && !tn_format_is(format, i, "in")) || (i > 0 && tn_format_is(format, i - 1, ",")) ||
           tn_format_is_word(format, i, &tn_solid_words, TN_SOLID_AT(BOX) | TN_SOLID_AT(GOAL), TN_AS_MARK);
}

static bool ends_statement(const tn_format *format, size_t i)
{
    static const char *const ends[] = {";", "{", "}", NULL};
    return tn_format_is_any(format, i, ends);
}

/* Lays out a .solid file. */
static void format_solid(tn_format *format)
{
    tn_format_statements(format, &(tn_statement_format){gap_before, at_part, ends_statement});
}

/* Tokens [first, last) on one line, without their comments. */
static const char *line_of(const tn_format *format, tn_arena *arena, size_t first, size_t last)
{
    size_t size = 0;
    for (size_t i = first; i < last; i++)
        size += 1 + format->tokens[i].size;
    char *line = TN_NEW_ARRAY(arena, char, size + 1), *at = line;
    for (size_t i = first; line && i < last; i++) {
        if (i > first && gap_before(format, i))
            *at++ = ' ';
        memcpy(at, format->tokens[i].text, format->tokens[i].size);
        at += format->tokens[i].size;
    }
    return line;
}

void tn_solid_name_measures(tn_arena *arena, const tn_source *source, const tn_tokens *tokens, tn_solid_file *file)
{
    tn_format format = {0};
    size_t i = 0;
    tn_format_take(&format, arena, source, tokens, tn_format_small_letters);
    for (const tn_solid_design *design = file->first; design && !tn_arena_failed(arena); design = design->next)
        for (const tn_solid_item *item = design->first; item; item = item->next)
            for (tn_solid_entry *entry = item->entries.first; entry && item->kind == TN_SOLID_ASKS;
                 entry = entry->next) {
                while (i < format.count && format.tokens[i].offset < entry->span.begin)
                    i++;
                size_t first = i;
                while (i < format.count && format.tokens[i].offset < entry->span.end)
                    i++;
                entry->words = line_of(&format, arena, first, i);
            }
}

/* ---- lists what a .solid file has: designs, and in each its boxes and its other statements */

static size_t statement_end(const tn_listing *listing, size_t i)
{
    while (i < listing->count && !tn_listing_is(listing, i, ";") && !tn_listing_is(listing, i, "}") &&
           !tn_listing_is(listing, i, "{"))
        i++;
    return i;
}

/* A design's statements, from behind its brace; returns where they end. */
static size_t list_statements(tn_listing *listing, size_t i)
{
    while (i < listing->count && !tn_listing_is(listing, i, "}")) {
        size_t end = statement_end(listing, i);
        tn_token token = listing->tokens[i];
        if (end > i && solid_heads(listing->text + token.span.begin, token.span.end - token.span.begin)) {
            bool named = (tn_listing_is(listing, i, "box") || tn_listing_is(listing, i, "fitness")) && end > i + 1;
            tn_listing_add(listing, TN_LISTING_SETTING, i, i + 1 + named, end)->inside = true;
        }
        i = end + (end < listing->count && !tn_listing_is(listing, end, "}"));
    }
    return i < listing->count ? i + 1 : i;
}

/* Lists designs with their statements. */
static void solid_list(tn_listing *listing)
{
    for (size_t i = 0, end; i < listing->count; i = end) {
        end = i + 1;
        if (!tn_listing_is(listing, i, "solid") || i + 1 >= listing->count)
            continue;
        size_t open = statement_end(listing, i);
        if (open >= listing->count || !tn_listing_is(listing, open, "{"))
            continue;
        size_t at = listing->entry_count;
        tn_listing_add(listing, TN_LISTING_BLOCK, i, i + 2, i + 2);
        end = list_statements(listing, open + 1);
        if (at < listing->entry_count)
            listing->entries[at].whole = tn_listing_span(listing, i, end);
    }
}

/* ---- compiles .solid files and what they use; and the front end that the table of notations names */

static const char solid_files[] = ".solid";

/* What importing needs to know of a file. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses, size_t *use_count)
{
    tn_tokens tokens = {.arena = arena};
    tn_solid_file *file = tn_parse_solid(arena, diagnostics, unit->file, &tokens);
    size_t count = 0;
    *use_count = 0;
    if (!file)
        return false;
    tn_solid_name_measures(arena, &diagnostics->sources->files[unit->file], &tokens, file);
    unit->tree = file;
    for (const tn_solid_use *use = file->uses.first; use; use = use->next)
        count++;
    *uses = TN_NEW_ARRAY(arena, tn_use, count + 1);
    if (!*uses)
        return false;
    for (tn_solid_use *use = file->uses.first; use; use = use->next) {
        if (!use->path.text || use->path.text[0] == '\0') {
            tn_diagnostic *d = tn_report(diagnostics, E_IMPORT_NOT_FOUND, use->path.span, "the file has no name");
            tn_help(diagnostics, d, "write its path, or the name of one of the standard library's");
            continue;
        }
        use->use = &(*uses)[(*use_count)++];
        *use->use = (tn_use){use->path.text, use->path.span, NULL, NULL};
    }
    return true;
}

static tn_status emit(tn_compilation *c, const tn_imports *imports, const tn_checked_solids *solids, tn_error *error)
{
    tn_builder *builder = tn_compilation_begin(c, imports, error);
    return builder ? tn_compilation_finish(c, builder, emit_solids(builder, &c->sources, solids, error), error)
                   : TN_MEMORY;
}

static tn_status compile(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_imports imports;
    tn_checked_solids solids = {0};
    tn_diagnostics *diagnostics = &c->diagnostics;
    tn_status status = tn_import_all(c, options, solid_files, parse_unit, &imports);
    bool right = status == TN_OK && tn_check_solids(c->arena, diagnostics, &imports, &solids);
    if (status != TN_OK || tn_arena_failed(c->arena) || diagnostics->failed)
        return tn_fail_memory(error);
    if (!right || diagnostics->error_count > 0 || (options->warnings_are_errors && diagnostics->warning_count > 0))
        return TN_INVALID;
    return emit(c, &imports, &solids, error);
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    reading->tree = tn_parse_solid(arena, diagnostics, reading->file, &reading->tokens);
    return reading->tree != NULL;
}

static bool made(const tn_module *module)
{
    return module->SOLID_count > 0;
}

static const tn_vocabulary_word words[] = {
#define WORD(TEXT, TOKEN, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, USE, 0},
#include "compiler/solid/words.def"
};

static const tn_vocabulary_place places[] = {
#define PLACE(ID, BLOCK, HEADS, WHERE) {BLOCK, HEADS},
#include "compiler/solid/words.def"
};

const tn_vocabulary tn_solid_words = {words, sizeof words / sizeof *words, places, sizeof places / sizeof *places,
                                      false};

extern const tn_front tn_front_solid;
const tn_front tn_front_solid = {
    .read = read,
    .compile = compile,
    .made = made,
    .list = solid_list,
    .words = &tn_solid_words,
    .lay_out = format_solid,
    .spell = tn_format_small_letters,
    .nests = true,
};
