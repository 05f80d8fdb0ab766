/* The front end of .field files: makes the syntax tree, as the parser asks; lays files out, lists what they have, and
 * compiles them. */
#include <ctype.h>
#include <string.h>

#include "compiler/common/import.h"
#include "compiler/common/notation.h"
#include "compiler/field/field.h"

static bool field_heads(const char *text, size_t size);

/* ---- makes the syntax tree of .field files: what the parser calls */

tn_field_parameters tn_field_parameter_add(tn_parsing *parse, tn_field_parameters list, tn_field_text name)
{
    tn_field_parameter *parameter = TN_NEW(parse->arena, tn_field_parameter);
    if (parameter)
        parameter->name = name;
    TN_CHAIN(&list, parameter);
    list.count++;
    return list;
}

void tn_field_define(tn_parsing *parse, tn_field_statement kind, tn_span span, tn_field_text name, const char *doc,
                     tn_field_parameters parameters, tn_expression *body)
{
    tn_field_file *file = parse->result;
    tn_field_definition *definition = TN_NEW(parse->arena, tn_field_definition);
    if (!definition || !body || !name.text)
        return;
    *definition = (tn_field_definition){
        .kind = kind, .name = name, .doc = doc, .parameters = parameters, .body = body, .span = span};
    TN_CHAIN(file, definition);
}

void tn_field_add_use(tn_parsing *parse, tn_field_text path)
{
    tn_field_file *file = parse->result;
    tn_field_use *use = TN_NEW(parse->arena, tn_field_use);
    if (!use || !path.text)
        return;
    use->path = path;
    TN_CHAIN(&file->uses, use);
    file->use_count++;
}

void tn_field_set(tn_parsing *parse, tn_field_setting setting)
{
    static const char *const words[] = {"box", "grid", "unit"};
    tn_field_file *file = parse->result;
    const tn_field_setting *first = file->settings[setting.kind];
    if (first) {
        tn_diagnostic *d =
            tn_report(parse->diagnostics, E_FIELD_REPEATED, setting.span, "`%s` is there twice", words[setting.kind]);
        tn_note(parse->diagnostics, d, &first->span, "the first is here");
        tn_help(parse->diagnostics, d, "a file has one, for all its surfaces: leave one of them out");
        return;
    }
    tn_field_setting *copy = TN_NEW(parse->arena, tn_field_setting);
    if (copy)
        *copy = setting;
    file->settings[setting.kind] = copy;
}

/* A file's name without folder and extension, where that can be a name; else "surface". */
static const char *stem(tn_parsing *parse)
{
    const char *path = parse->diagnostics->sources->files[parse->file].path, *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    size_t size = 0;
    while (isalnum((unsigned char)name[size]) || name[size] == '_')
        size++;
    if (size == 0 || isdigit((unsigned char)name[0]) || (name[size] != '.' && name[size] != '\0'))
        return "surface";
    return tn_arena_copy(parse->arena, name, size);
}

void tn_field_add_bare(tn_parsing *parse, tn_expression *body)
{
    if (body)
        tn_field_define(parse, TN_FIELD_SURFACE, body->span, (tn_field_text){stem(parse), body->span}, NULL,
                        (tn_field_parameters){0}, body);
}

/* ---- laying out .field files: a statement a line; a long expression goes on in the next lines, indented */

enum { CONTINUED = 4 /* indent of what goes on in the next line */ };

static bool heads_statement(const tn_format *format, size_t i)
{
    const tn_format_token *token = &format->tokens[i];
    return token->kind == TN_TOKEN_WORD && field_heads(token->text, token->size);
}

/* A minus that stands before what it turns round, not between two. */
static bool is_sign(const tn_format *format, size_t i)
{
    static const char *const before[] = {"(", ",", "=", "+", "-", "*", "/", "%", NULL};
    return tn_format_is(format, i, "-") && (i == 0 || tn_format_is_any(format, i - 1, before));
}

/* Products are written close, so that sums stand out. */
static size_t gap_before(const tn_format *format, size_t i)
{
    static const char *const close[] = {")", ",", "..", "*", "/", NULL}, *const open[] = {"(", "..", "*", "/", NULL};
    bool call = tn_format_is(format, i, "(") && format->tokens[i - 1].kind == TN_TOKEN_NAME;
    bool tight = tn_format_is_any(format, i, close) || tn_format_is_any(format, i - 1, open) || is_sign(format, i - 1);
    return call || tight ? 0 : 1;
}

static bool is_sum(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "+") || (tn_format_is(format, i, "-") && !is_sign(format, i));
}

/* Where the next part of an expression begins: at sums and differences outside of parentheses, or (`inner`) at any and
 * before an argument that is no number. */
static size_t part_end(const tn_format *format, size_t i, size_t last, bool inner)
{
    int depth = 0;
    for (depth += tn_format_is(format, i, "(") - tn_format_is(format, i, ")"), i++; i < last; i++) {
        if (is_sum(format, i) && (inner || depth == 0))
            return i;
        if (inner && tn_format_is(format, i - 1, ",") && format->tokens[i].kind != TN_TOKEN_NUMBER)
            return i;
        depth += tn_format_is(format, i, "(") - tn_format_is(format, i, ")");
    }
    return last;
}

/* Puts tokens [first, last) in as few lines as they take. */
static void put_parts(tn_format *format, size_t first, size_t last, bool inner)
{
    for (size_t begin = first, end; begin < last; begin = end) {
        end = part_end(format, begin, last, inner);
        size_t gap = format->layout.fresh ? 0 : gap_before(format, begin), width = tn_format_width(format, begin, end);
        if (!format->layout.fresh && format->layout.column + gap + width > TN_FORMAT_WIDTH) {
            tn_layout_line(&format->layout, CONTINUED);
            gap = 0;
        }
        if (!inner && CONTINUED + width > TN_FORMAT_WIDTH) {
            put_parts(format, begin, end, true);
            continue;
        }
        tn_layout_spaces(&format->layout, gap);
        tn_format_flat(format, begin, end);
    }
}

/* On one line where it fits; else what is behind `=` goes on in lines of its own. */
static void put_statement(tn_format *format, size_t first, size_t last)
{
    tn_layout_line(&format->layout, 0);
    if (tn_format_width(format, first, last) <= TN_FORMAT_WIDTH) {
        tn_format_flat(format, first, last);
        return;
    }
    size_t body = first;
    while (body < last && !tn_format_is(format, body, "="))
        body++;
    body = body < last ? body + 1 : first;
    if (body > first) {
        tn_format_flat(format, first, body);
        tn_layout_line(&format->layout, CONTINUED);
    }
    format->layout.indent = body > first ? CONTINUED : 0;
    put_parts(format, body, last, false);
}

static void format_field(tn_format *format)
{
    format->gap_before = gap_before;
    for (size_t first = 0, last; first < format->count; first = last) {
        for (last = first + 1; last < format->count && !heads_statement(format, last);)
            last++;
        tn_format_gap(format, first, 0, false);
        put_statement(format, first, last);
    }
    tn_format_gap(format, format->count, 0, false);
}

/* ---- lists what a .field file has: constants, functions and surfaces by their names, settings by their words */

static bool lists_statement(const tn_listing *listing, size_t i)
{
    tn_token token = listing->tokens[i];
    return token.kind == TN_TOKEN_WORD &&
           field_heads(listing->text + token.span.begin, token.span.end - token.span.begin);
}

static void field_list(tn_listing *listing)
{
    for (size_t i = 0, end; i < listing->count; i = end) {
        end = i + 1;
        if (!lists_statement(listing, i))
            continue;
        while (end < listing->count && !lists_statement(listing, end))
            end++;
        bool let = tn_listing_is(listing, i, "let");
        bool named = let || tn_listing_is(listing, i, "fn") || tn_listing_is(listing, i, "surface");
        if (named && end > i + 1)
            tn_listing_add(listing, let ? TN_LISTING_CONSTANT : TN_LISTING_RULE, i + 1, i + 2, end)->whole =
                tn_listing_span(listing, i, end);
        else
            tn_listing_add(listing, TN_LISTING_SETTING, i, i + 1, end);
    }
}

/* ---- compiles .field files; and the front end that the table of notations names */

static const char field_files[] = ".field";

/* What importing needs to know of a file. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses, size_t *use_count)
{
    *use_count = 0;
    tn_field_file *file = tn_parse_field(arena, diagnostics, unit->file, NULL);
    if (!file)
        return false;
    unit->tree = file;
    *uses = TN_NEW_ARRAY(arena, tn_use, file->use_count + 1);
    if (!*uses)
        return false;
    for (const tn_field_use *use = file->uses.first; use; use = use->next) {
        if (use->path.text[0] == '\0') {
            tn_diagnostic *d = tn_report(diagnostics, E_IMPORT_NOT_FOUND, use->path.span, "the file has no name");
            tn_help(diagnostics, d, "write its path, or the name of one of the standard library's");
            continue;
        }
        (*uses)[(*use_count)++] = (tn_use){use->path.text, use->path.span, NULL, NULL};
    }
    return true;
}

static tn_status emit(tn_compilation *c, const tn_compile_options *options, const tn_imports *imports,
                      const tn_checked_fields *checked, tn_error *error)
{
    tn_builder *builder = tn_compilation_begin(c, imports, error);
    if (!builder)
        return TN_MEMORY;
    tn_status status = tn_emit_field(builder, c->arena, &c->diagnostics, checked, error);
    if (status == TN_OK && options->warnings_are_errors && c->diagnostics.warning_count > 0)
        status = TN_INVALID;
    return tn_compilation_finish(c, builder, status, error);
}

static tn_status compile(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_imports imports;
    tn_checked_fields *checked = TN_NEW(c->arena, tn_checked_fields);
    tn_diagnostics *diagnostics = &c->diagnostics;
    tn_status status = tn_import_all(c, options, field_files, parse_unit, &imports);
    if (status != TN_OK)
        return status;
    bool damaged = false;
    for (size_t u = 0; u < imports.count; u++) {
        const tn_field_file *file = imports.units[u]->tree;
        damaged = damaged || !file || file->damaged;
    }
    if (!damaged && (!checked || !tn_check_field(c->arena, diagnostics, &imports, &options->resolver, checked)))
        return tn_fail_memory(error);
    if (tn_arena_failed(c->arena) || diagnostics->failed)
        return tn_fail_memory(error);
    if (damaged || diagnostics->error_count > 0 || (options->warnings_are_errors && diagnostics->warning_count > 0))
        return TN_INVALID;
    c->fields = checked;
    return emit(c, options, &imports, checked, error);
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    reading->tree = tn_parse_field(arena, diagnostics, reading->file, &reading->tokens);
    return reading->tree != NULL;
}

/* A library of functions leaves nothing but its name. */
static bool made(const tn_module *module)
{
    const char *path = module->SOURCE_count ? tn_text(module, module->SOURCE_records[0].path) : "";
    return module->SURFACE_count > 0 || strcmp(tn_path_extension(path), field_files) == 0;
}

static const tn_vocabulary_word words[] = {
#define WORD(TEXT, TOKEN, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, USE, 0},
#include "compiler/field/words.def"
};

static const tn_vocabulary_place places[] = {
#define PLACE(ID, BLOCK, HEADS, WHERE) {BLOCK, HEADS},
#include "compiler/field/words.def"
};

const tn_vocabulary tn_field_words = {words, sizeof words / sizeof *words, places, sizeof places / sizeof *places,
                                      .heads_begin = true};

/* Does a statement start with this word? */
static bool field_heads(const char *text, size_t size)
{
    return tn_vocabulary_find(&tn_field_words, text, size, TN_FIELD_AT(STATEMENT), TN_AS_KEYWORDS) != NULL;
}

extern const tn_front tn_front_field;
const tn_front tn_front_field = {
    .read = read,
    .compile = compile,
    .made = made,
    .list = field_list,
    .words = &tn_field_words,
    .lay_out = format_field,
    .spell = tn_format_small_letters,
    .nests = true,
};
