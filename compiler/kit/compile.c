/* The front end of .kit files: makes the syntax tree, as the parser asks; lays files out, lists what they have, and
 * compiles them and what they use. */
#include "compiler/common/import.h"
#include "compiler/common/layout.h"
#include "compiler/common/notation.h"
#include "compiler/kit/kit.h"

/* ---- makes the syntax tree of .kit files: what the parser calls */

tn_kit_node *tn_kit_node_new(tn_parsing *parse, tn_kit_kind kind, tn_span span, tn_kit_text name)
{
    tn_kit_node *node = TN_NEW(parse->arena, tn_kit_node);
    if (node) {
        node->kind = kind;
        node->span = span;
        node->name = name;
        node->depth = 1;
    }
    return node;
}

tn_kit_nodes tn_kit_nodes_add(tn_kit_nodes list, tn_kit_node *node)
{
    TN_CHAIN(&list, node);
    return list;
}

tn_kit_node *tn_kit_space_of(tn_parsing *parse, tn_kit_kind kind, tn_span span, tn_kit_node *a, tn_kit_node *b)
{
    tn_kit_node *node = tn_kit_node_new(parse, kind, span, (tn_kit_text){0});
    if (!node || !a)
        return NULL;
    node->inner = tn_kit_nodes_add(tn_kit_nodes_add((tn_kit_nodes){0}, a), b);
    node->depth = 1 + (b && b->depth > a->depth ? b->depth : a->depth);
    return node;
}

void tn_kit_add(tn_parsing *parse, tn_kit_node *node)
{
    tn_kit_file *file = parse->result;
    TN_CHAIN(file, node);
}

void tn_kit_add_use(tn_parsing *parse, tn_kit_text path)
{
    tn_kit_file *file = parse->result;
    tn_kit_use *use = TN_NEW(parse->arena, tn_kit_use);
    if (use)
        use->path = path;
    TN_CHAIN(&file->uses, use);
}

/* ---- laying out .kit files: a statement a line; one that is too long goes on where its next part begins */

/* box( and count(. */
static bool is_call(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "(") && (format->tokens[i - 1].kind == TN_TOKEN_NAME ||
                                            tn_format_is_word(format, i - 1, &tn_kit_words, TN_ANYWHERE, TN_AS_CALL));
}

/* Does the brace at i, or the one that ends there, hold statements and not parts? */
static bool is_block(const tn_format *format, size_t i)
{
    size_t open = tn_format_is(format, i, "}") ? format->tokens[i].match : i;
    while (open > 0 && !tn_format_is(format, open - 1, ";") && !tn_format_is(format, open - 1, "}"))
        open--;
    return tn_vocabulary_head_block(&tn_kit_words, format->tokens[open].text, format->tokens[open].size);
}

/* Behind the brace that opens a list of parts, or before the one that closes it. */
static bool is_brace(const tn_format *format, size_t i)
{
    return (tn_format_is(format, i, "}") && !is_block(format, i)) ||
           (tn_format_is(format, i - 1, "{") && !is_block(format, i - 1));
}

static size_t gap_before(const tn_format *format, size_t i)
{
    bool tight = tn_format_is(format, i, ")") || tn_format_is(format, i, ",") || tn_format_is(format, i, ";") ||
                 tn_format_is(format, i - 1, "(") || tn_format_is_minus_sign(format, i - 1) ||
                 tn_format_is(format, i, "..") || tn_format_is(format, i - 1, "..") || is_call(format, i) ||
                 is_brace(format, i) || (tn_format_is(format, i, "]") || tn_format_is(format, i - 1, "["));
    return tight ? 0 : 1;
}

/* The bracket that begins in the statement of token i and holds it, or i where there is none. */
static size_t bracket_around(const tn_format *format, size_t i)
{
    int depth = 0;
    for (size_t k = i; k > 0 && !tn_format_is(format, k - 1, ";"); k--) {
        bool opens = tn_format_is(format, k - 1, "(") || tn_format_is(format, k - 1, "{");
        if (tn_format_is(format, k - 1, "{") && is_block(format, k - 1))
            return i;
        depth += opens;
        depth -= tn_format_is(format, k - 1, ")") || tn_format_is(format, k - 1, "}");
        if (depth > 0)
            return k - 1;
    }
    return i;
}

/* Where a statement that is too long goes on in the next line. */
static bool at_part(const tn_format *format, size_t i)
{
    bool behind_comma = i > 0 && tn_format_is(format, i - 1, ",");
    size_t around = bracket_around(format, i);
    if (around != i)
        return behind_comma && tn_format_is(format, around, "{"); /* a list of parts */
    return behind_comma || tn_format_is(format, i, "|") || tn_format_is(format, i, "by") ||
           tn_format_is_word(format, i, &tn_kit_words, TN_KIT_AT(SPACE), TN_AS_INFIX);
}

static bool ends_statement(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, ";") ||
           ((tn_format_is(format, i, "{") || tn_format_is(format, i, "}")) && is_block(format, i));
}

static void format_kit(tn_format *format)
{
    tn_format_statements(format, &(tn_statement_format){gap_before, at_part, ends_statement});
}

/* ---- lists what a .kit file has: its definitions, and in models and parts what they say */

static bool is_any(const tn_listing *listing, size_t i, const char *const *words)
{
    for (; *words; words++)
        if (tn_listing_is(listing, i, *words))
            return true;
    return false;
}

static size_t end_of(const tn_listing *listing, size_t i, const char *const *ends)
{
    while (i < listing->count && !is_any(listing, i, ends))
        i++;
    return i;
}

static void kit_list(tn_listing *listing)
{
    static const char *const line_ends[] = {";", NULL}, *const block_ends[] = {"}", NULL};
    for (size_t i = 0, end; i < listing->count; i = end + 1) {
        const char *word = listing->text + listing->tokens[i].span.begin;
        size_t size = listing->tokens[i].span.end - listing->tokens[i].span.begin;
        bool block = tn_vocabulary_head_block(&tn_kit_words, word, size);
        bool line = tn_vocabulary_find(&tn_kit_words, word, size, TN_KIT_AT(STATEMENT), TN_AS_HEAD) != NULL;
        end = end_of(listing, i, block ? block_ends : line_ends);
        if (i + 1 >= listing->count || (!block && !line))
            continue;
        tn_listing_kind kind = block                               ? TN_LISTING_BLOCK
                               : tn_listing_is(listing, i, "rule") ? TN_LISTING_RULE
                                                                   : TN_LISTING_CONSTANT;
        size_t last = end < listing->count ? end + 1 : end;
        tn_listing_add(listing, kind, i + 1, i + 2, block ? i + 2 : end)->whole = tn_listing_span(listing, i, last);
    }
}

/* ---- compiles .kit files and what they use; and the front end that the table of notations names */

static const char kit_files[] = ".kit";

/* What importing needs to know of a file. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses, size_t *use_count)
{
    tn_kit_file *file = tn_parse_kit(arena, diagnostics, unit->file, NULL);
    size_t count = 0;
    *use_count = 0;
    if (!file)
        return false;
    unit->tree = file;
    for (const tn_kit_use *use = file->uses.first; use; use = use->next)
        count++;
    *uses = TN_NEW_ARRAY(arena, tn_use, count + 1);
    if (!*uses)
        return false;
    for (tn_kit_use *use = file->uses.first; use; use = use->next) {
        if (!use->path.text || use->path.text[0] == '\0') {
            tn_diagnostic *d = tn_report(diagnostics, E_IMPORT_NOT_FOUND, use->path.span, "the file has no name");
            tn_help(diagnostics, d, "write its path, or the name of one of the standard library's");
            continue;
        }
        (*uses)[(*use_count)++] = (tn_use){use->path.text, use->path.span, NULL, NULL};
    }
    return true;
}

static tn_status emit(tn_compilation *c, const tn_imports *imports, tn_kit *kit, tn_error *error)
{
    size_t length;
    const char *name = tn_path_stem(c->sources.files[0].path, &length);
    const tn_kit_file *file = imports->units[imports->count - 1]->tree;
    tn_builder *builder = tn_compilation_begin(c, imports, error);
    return builder ? tn_compilation_finish(c, builder, tn_emit_kit(builder, kit, file, name, length, error), error)
                   : TN_MEMORY;
}

/* Conditions alone, about parts that are named. */
static tn_status compile_conditions(tn_compilation *c, const tn_questions *questions, tn_error *error)
{
    tn_kit kit = {
        .arena = c->arena, .diagnostics = &c->diagnostics, .parts.arena = c->arena, .turns = TN_UPRIGHT_TURNS};
    tn_kit_file *file = tn_parse_kit_conditions(c->arena, &c->diagnostics, 0);
    tn_unit unit = {.file = 0, .recorded = c->sources.files[0].path, .tree = file}, *units[] = {&unit};
    const tn_imports imports = {units, 1};
    for (size_t i = 0; i < questions->part_count; i++)
        if (!tn_names_get(&kit.parts, questions->parts[i]))
            tn_names_put(&kit.parts, questions->parts[i], (void *)(uintptr_t)questions->parts[i]);
    if (file && file->first)
        tn_kit_check_conditions(&kit, file->first);
    if (!file || tn_arena_failed(c->arena) || c->diagnostics.failed)
        return tn_fail_memory(error);
    if (file->damaged || !file->first || c->diagnostics.error_count > 0)
        return TN_INVALID;
    tn_builder *builder = tn_compilation_begin(c, &imports, error);
    return builder ? tn_compilation_finish(c, builder, tn_emit_kit_conditions(builder, &kit, file->first, error), error)
                   : TN_MEMORY;
}

static tn_status compile(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_imports imports;
    tn_diagnostics *diagnostics = &c->diagnostics;
    tn_kit kit = {
        .arena = c->arena, .diagnostics = diagnostics, .attachments = &options->attachments, .turns = TN_UPRIGHT_TURNS};
    if (options->questions && options->questions->parts)
        return compile_conditions(c, options->questions, error);
    tn_status status = tn_import_all(c, options, kit_files, parse_unit, &imports);
    bool right = status == TN_OK && tn_check_kit(&kit, &imports);
    if (status != TN_OK || tn_arena_failed(c->arena) || diagnostics->failed || kit.out_of_memory)
        return tn_fail_memory(error);
    if (!right || diagnostics->error_count > 0 || (options->warnings_are_errors && diagnostics->warning_count > 0))
        return TN_INVALID;
    return emit(c, &imports, &kit, error);
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    reading->tree = tn_parse_kit(arena, diagnostics, reading->file, &reading->tokens);
    return reading->tree != NULL;
}

static bool made(const tn_module *module)
{
    return module->KIT_count > 0;
}

static const tn_vocabulary_word words[] = {
#define WORD(TEXT, TOKEN, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, USE, 0},
#include "compiler/kit/words.def"
};

static const tn_vocabulary_place places[] = {
#define PLACE(ID, BLOCK, HEADS, WHERE) {BLOCK, HEADS},
#include "compiler/kit/words.def"
};

const tn_vocabulary tn_kit_words = {words, sizeof words / sizeof *words, places, sizeof places / sizeof *places, false};

extern const tn_front tn_front_kit;
const tn_front tn_front_kit = {
    .read = read,
    .compile = compile,
    .made = made,
    .list = kit_list,
    .words = &tn_kit_words,
    .lay_out = format_kit,
    .spell = tn_format_small_letters,
    .nests = true,
};
