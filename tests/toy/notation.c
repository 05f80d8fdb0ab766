/* The toy notation. Each line is a name and a number, and compiles to a counter that the toy engine runs; `#` starts a
 * comment, and `use "FILE"` adds the lines of another file. This file and one row are all that the notation takes. */
#include <stdlib.h>
#include <string.h>

#include "compiler/common/import.h"
#include "compiler/common/lexical.h"
#include "compiler/common/notation.h"

enum { COUNT_MAX = 1000000 };

typedef struct toy_line {
    tn_span name, number;
    uint32_t count;
} toy_line;

typedef struct toy_lines {
    toy_line *items;
    size_t count;
} toy_lines;

typedef struct toy {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    tn_tokens *tokens;
    uint32_t file;
    tn_use *uses;
    size_t use_count;
    toy_lines lines;
} toy;

/* The kind of what is at the start of the text, and its size. */
static tn_token_kind token_at(const char *text, size_t size, size_t *length)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz", digits[] = "0123456789";
    const char *more = strchr(letters, text[0]) ? letters : strchr(digits, text[0]) ? digits : "";
    *length = 1;
    if (text[0] == '#')
        *length = strcspn(text, "\n");
    else if (text[0] == '"')
        *length = 1 + strcspn(text + 1, "\"\n");
    else
        *length += strspn(text + 1, more);
    *length += text[0] == '"' && *length < size && text[*length] == '"';
    return text[0] == '\n'                               ? TN_TOKEN_LINE
           : text[0] == '#'                              ? TN_TOKEN_COMMENT
           : text[0] == '"'                              ? TN_TOKEN_STRING
           : more == digits                              ? TN_TOKEN_NUMBER
           : *length == 3 && memcmp(text, "use", 3) == 0 ? TN_TOKEN_WORD
           : more == letters                             ? TN_TOKEN_NAME
                                                         : TN_TOKEN_STRAY;
}

static void add_counter(toy *t, tn_span name, tn_span number)
{
    const char *text = t->diagnostics->sources->files[t->file].text;
    unsigned long count = strtoul(text + number.begin, NULL, 10); /* ULONG_MAX where it is too large */
    if (name.end - name.begin > TN_NAME_MAX)
        tn_report(t->diagnostics, E_NAME_TOO_LONG, name, "this name has more than %d letters", TN_NAME_MAX);
    else if (count < 1 || count > COUNT_MAX)
        tn_report(t->diagnostics, E_NUMBER_TOO_LARGE, number, "a number is from 1 to %d", COUNT_MAX);
    else
        t->lines.items[t->lines.count++] = (toy_line){name, number, (uint32_t)count};
}

/* A line of tokens: `use "FILE"`, or a name and a number. */
static void take_line(toy *t, const tn_token *line, size_t count)
{
    const char *text = t->diagnostics->sources->files[t->file].text;
    tn_span last = line[count - 1].span;
    if (count == 2 && line[0].kind == TN_TOKEN_WORD && line[1].kind == TN_TOKEN_STRING && last.end - last.begin > 2 &&
        text[last.end - 1] == '"')
        t->uses[t->use_count++] =
            (tn_use){.path = tn_string_lex(t->arena, text + last.begin + 1, last.end - last.begin - 2), .span = last};
    else if (count == 2 && line[0].kind == TN_TOKEN_NAME && line[1].kind == TN_TOKEN_NUMBER)
        add_counter(t, line[0].span, last);
    else
        tn_help(t->diagnostics, tn_report(t->diagnostics, E_UNEXPECTED, line[0].span, "a line is a name and a number"),
                "write `apples 3`");
}

/* Reads the source; false where out of memory. */
static bool read_source(toy *t)
{
    const tn_source *source = &t->diagnostics->sources->files[t->file];
    tn_token *line = TN_NEW_ARRAY(t->arena, tn_token, source->size + 1);
    t->uses = TN_NEW_ARRAY(t->arena, tn_use, source->size + 1);
    t->lines.items = TN_NEW_ARRAY(t->arena, toy_line, source->size + 1);
    if (!line || !t->uses || !t->lines.items)
        return false;
    if (!tn_text_check(t->diagnostics, t->file))
        return true;
    size_t count = 0, length;
    for (size_t at = tn_text_mark(source->text, source->size); at < source->size; at += length) {
        tn_token_kind kind = token_at(source->text + at, source->size - at, &length);
        tn_span span = {t->file, (uint32_t)at, (uint32_t)(at + length)};
        if (kind == TN_TOKEN_STRAY && strchr(" \t\r", source->text[at]))
            continue;
        tn_token_add(t->tokens, kind, span);
        if (kind == TN_TOKEN_LINE && count > 0) {
            take_line(t, line, count);
            count = 0;
        } else if (kind != TN_TOKEN_LINE && kind != TN_TOKEN_COMMENT) {
            line[count++] = (tn_token){span, kind};
        }
    }
    if (count > 0)
        take_line(t, line, count);
    return !tn_arena_failed(t->arena);
}

static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses, size_t *use_count)
{
    toy t = {.arena = arena, .diagnostics = diagnostics, .file = unit->file};
    bool done = read_source(&t);
    toy_lines *lines = TN_NEW(arena, toy_lines);
    if (!lines)
        return false;
    *lines = t.lines;
    unit->tree = lines;
    *uses = t.uses;
    *use_count = t.use_count;
    return done;
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    toy t = {.arena = arena, .diagnostics = diagnostics, .file = reading->file, .tokens = &reading->tokens};
    return read_source(&t);
}

static void emit_counter(tn_builder *builder, const tn_sources *sources, const toy_line *line)
{
    tn_counter_record counter = {.name = tn_builder_string_n(builder,
                                                             sources->files[line->name.file].text + line->name.begin,
                                                             line->name.end - line->name.begin),
                                 .code_begin = tn_builder_offset(builder)};
    tn_builder_add_SOURCE_MAP(builder, &(tn_source_map_record){.offset = counter.code_begin,
                                                               .file = line->number.file,
                                                               .begin = line->number.begin,
                                                               .end = line->number.end});
    tn_builder_emit(builder, TN_OP_COUNT_UP, line->count, 0);
    tn_builder_emit(builder, TN_OP_STOP, 0, 0);
    counter.code_end = tn_builder_offset(builder);
    tn_builder_add_COUNTER(builder, &counter);
}

static tn_status compile(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_imports imports;
    if (tn_import_all(c, options, c->notation->extension, parse_unit, &imports) != TN_OK || c->diagnostics.failed)
        return tn_fail_memory(error);
    if (c->diagnostics.error_count > 0)
        return TN_INVALID;
    tn_builder *builder = tn_compilation_begin(c, &imports, error);
    if (!builder)
        return TN_MEMORY;
    for (size_t i = 0; i < imports.count; i++) {
        const toy_lines *lines = imports.units[i]->tree;
        for (size_t l = 0; l < lines->count; l++)
            emit_counter(builder, &c->sources, &lines->items[l]);
    }
    return tn_compilation_finish(c, builder, TN_OK, error);
}

static bool made(const tn_module *module)
{
    return module->COUNTER_count > 0;
}

static void list(tn_listing *listing)
{
    for (size_t first = 0, last; first < listing->count; first = last + 1) {
        last = tn_listing_line_end(listing, first, listing->count);
        if (last > first)
            tn_listing_add(listing, TN_LISTING_CONSTANT, first, first + 1, last);
    }
}

static size_t one_blank(const tn_format *format, size_t i)
{
    (void)format, (void)i;
    return 1;
}

static void lay_out(tn_format *format)
{
    format->gap_before = one_blank;
    for (size_t first = 0, last; first < format->count; first = last) {
        for (last = first + 1; last < format->count && !format->tokens[last].line_ends;)
            last++;
        tn_format_gap(format, first, 0, false);
        tn_format_flat(format, first, last);
    }
    tn_format_gap(format, format->count, 0, false);
}

extern const tn_front tn_front_toy;
const tn_front tn_front_toy = {
    .read = read, .compile = compile, .made = made, .list = list, .lay_out = lay_out, .spell = tn_format_small_letters};
