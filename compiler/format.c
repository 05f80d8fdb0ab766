#include "compiler/format.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/format_clauses.h"
#include "compiler/format_tokens.h"
#include "compiler/limits.h"

enum {
    BRACKETS_MAX = 4 * TN_NESTING_MAX, /* parentheses that mean nothing do not count as nesting, but are laid out */
    PASSES_MAX = 8,
};

/* ---- from the lexer's tokens to the formatter's */

/* Line ends between two places: none, one, or more. */
static size_t lines_between(const tn_source *source, size_t begin, size_t end)
{
    size_t lines = 0;
    for (size_t i = begin; i < end; i++)
        lines += source->text[i] == '\n' || (source->text[i] == '\r' && source->text[i + 1] != '\n');
    return lines;
}

static size_t without_blanks(const char *text, size_t size)
{
    while (size > 0 && (text[size - 1] == ' ' || text[size - 1] == '\t'))
        size--;
    return size;
}

static const char *small_letters(tn_arena *arena, const char *text, size_t size)
{
    char *copy = tn_arena_copy(arena, text, size);
    for (size_t i = 0; copy && i < size; i++)
        if (copy[i] >= 'A' && copy[i] <= 'Z')
            copy[i] = (char)(copy[i] - 'A' + 'a');
    return copy;
}

static bool is_measure(tn_token_kind kind)
{
    return kind == TN_TOKEN_NUMBER || kind == TN_TOKEN_LENGTH;
}

/* `4'` and `6"` on two lines are two lengths, on one line they are one. */
static bool would_merge(const tn_format_token *before, tn_token_kind kind, size_t lines)
{
    return lines > 0 && is_measure(before->kind) && kind == TN_TOKEN_LENGTH;
}

static void take_tokens(tn_format *format, tn_arena *arena, const tn_source *source, const tn_tokens *tokens)
{
    format->tokens = TN_NEW_ARRAY(arena, tn_format_token, tokens->count + 1);
    tn_format_comment *comments = TN_NEW_ARRAY(arena, tn_format_comment, tokens->count + 1);
    if (!format->tokens || !comments)
        return;
    size_t end = 0;
    for (size_t i = 0; i < tokens->count; i++) {
        tn_span span = tokens->items[i].span;
        tn_format_token *token = &format->tokens[format->count];
        const char *text = source->text + span.begin;
        size_t size = span.end - span.begin, lines = lines_between(source, end, span.begin);
        end = span.end;
        if (tokens->items[i].kind == TN_TOKEN_COMMENT) {
            tn_format_comment comment = {text, without_blanks(text, size), lines > 1};
            if (format->count > 0 && lines == 0 && !token->comment_count && !token[-1].remark.text) {
                token[-1].remark = comment;
            } else {
                comments[0] = comment;
                token->comments = token->comment_count++ ? token->comments : comments;
                comments++;
            }
            continue;
        }
        token->kind = tokens->items[i].kind;
        token->text = token->kind == TN_TOKEN_WORD ? small_letters(arena, text, size) : text;
        token->size = size;
        token->offset = span.begin;
        token->width = tn_text_width(text, size);
        token->blank = lines > 1;
        if (size == 1 && *text == ',' && format->count > 0 &&
            !token->comment_count) { /* `a # why , b`: after the comma */
            token->remark = token[-1].remark;
            token[-1].remark.text = NULL;
        }
        token->breaks = format->count > 0 && would_merge(&token[-1], token->kind, lines);
        format->count++;
    }
    format->tokens[format->count].text = "";
    format->tokens[format->count].kind = TN_TOKEN_SIGN;
}

/* Finds the pairs of brackets. False where they are nested too deep, *place is where. */
static bool match_brackets(tn_format *format, size_t *place)
{
    size_t stack[BRACKETS_MAX], depth = 0;
    for (size_t i = 0; i < format->count; i++) {
        if (tn_format_is(format, i, "(") || tn_format_is(format, i, "[")) {
            *place = i;
            if (depth == BRACKETS_MAX)
                return false;
            stack[depth++] = i;
        } else if ((tn_format_is(format, i, ")") || tn_format_is(format, i, "]")) && depth > 0) {
            format->tokens[i].match = stack[--depth];
            format->tokens[stack[depth]].match = i;
        }
    }
    return true;
}

/* ---- one text */

typedef struct format_text {
    uint32_t file;
    const tn_ast_file *tree;
    tn_tokens tokens;
} format_text;

static tn_status parse(tn_arena *arena, tn_diagnostics *diagnostics, const char *path, const char *text, size_t size,
                       format_text *parsed, tn_error *error)
{
    size_t errors = diagnostics->error_count;
    tn_status status = tn_sources_add(diagnostics->sources, path, text, size, &parsed->file, error);
    if (status != TN_OK)
        return status;
    parsed->tokens = (tn_tokens){.arena = arena};
    parsed->tree = tn_parse_plan(arena, diagnostics, parsed->file, &parsed->tokens);
    if (!parsed->tree || diagnostics->failed)
        return tn_fail_memory(error);
    return diagnostics->error_count > errors ? TN_INVALID : TN_OK;
}

static size_t next_token(const tn_tokens *tokens, size_t i)
{
    while (i < tokens->count && tokens->items[i].kind == TN_TOKEN_COMMENT)
        i++;
    return i;
}

static bool same_token(const tn_sources *sources, tn_token one, tn_token other)
{
    const char *text = sources->files[one.span.file].text + one.span.begin;
    const char *other_text = sources->files[other.span.file].text + other.span.begin;
    size_t size = one.span.end - one.span.begin;
    if (one.kind != other.kind)
        return false;
    if (one.kind == TN_TOKEN_CLAUSE_NAME) /* the line that it names is elsewhere now */
        return true;
    return size == other.span.end - other.span.begin &&
           (one.kind == TN_TOKEN_WORD ? strncasecmp(text, other_text, size) : memcmp(text, other_text, size)) == 0;
}

/* Do the two have the same tokens, comments aside? */
static bool same_tokens(const tn_sources *sources, const tn_tokens *one, const tn_tokens *other)
{
    size_t i = next_token(one, 0), k = next_token(other, 0);
    while (i < one->count && k < other->count && same_token(sources, one->items[i], other->items[k])) {
        i = next_token(one, i + 1);
        k = next_token(other, k + 1);
    }
    return i == one->count && k == other->count;
}

static tn_status report_depth(tn_diagnostics *diagnostics, const format_text *parsed, size_t offset)
{
    tn_span span = {parsed->file, (uint32_t)offset, (uint32_t)offset + 1};
    tn_diagnostic *d = tn_report(diagnostics, E_TOO_DEEP, span,
                                 "brackets are nested more than %u deep, which is the limit", (unsigned)BRACKETS_MAX);
    tn_help(diagnostics, d, "leave out those that are not needed");
    return TN_INVALID;
}

/* Lays the file out, and again until the lines that clauses are named by have come to rest. */
static tn_status lay_out(tn_arena *arena, tn_diagnostics *diagnostics, const format_text *parsed, char **text,
                         size_t *size, tn_error *error)
{
    const tn_source *source = &diagnostics->sources->files[parsed->file];
    tn_format format = {0};
    size_t place = 0;
    take_tokens(&format, arena, source, &parsed->tokens);
    if (tn_arena_failed(arena))
        return tn_fail_memory(error);
    if (!match_brackets(&format, &place))
        return report_depth(diagnostics, parsed, format.tokens[place].offset);
    tn_format_token *tokens = format.tokens;
    size_t bytes = (format.count + 1) * sizeof *tokens;
    bool renamed = true;
    for (int pass = 0; renamed && pass < PASSES_MAX; pass++) {
        format.tokens = tn_arena_alloc(arena, bytes);
        if (!format.tokens)
            return tn_fail_memory(error);
        memcpy(format.tokens, tokens, bytes);
        tn_layout_start(&format.layout, arena);
        tn_format_plan(&format);
        renamed = tn_format_clause_names(arena, source, parsed->tree, &format, tokens);
    }
    *text = tn_layout_finish(&format.layout, size);
    return *text ? TN_OK : tn_fail_memory(error);
}

static tn_status format_in(tn_arena *arena, tn_diagnostics *diagnostics, const char *path, const char *text,
                           size_t size, char **formatted, size_t *formatted_size, tn_error *error)
{
    format_text before, after;
    char *laid_out;
    tn_status status = parse(arena, diagnostics, path, text, size, &before, error);
    if (status == TN_OK)
        status = lay_out(arena, diagnostics, &before, &laid_out, formatted_size, error);
    if (status == TN_OK)
        status = parse(arena, diagnostics, path, laid_out, *formatted_size, &after, error);
    if (status != TN_OK)
        return status;
    if (!same_tokens(diagnostics->sources, &before.tokens, &after.tokens))
        return tn_fail(error, TN_INTERNAL, 0, "laid out, %s would not mean the same: it stays as it is", path);
    *formatted = malloc(*formatted_size + 1);
    if (!*formatted)
        return tn_fail_memory(error);
    memcpy(*formatted, laid_out, *formatted_size + 1);
    return TN_OK;
}

tn_status tn_format_text(tn_diagnostics *diagnostics, const char *path, const char *text, size_t size, char **formatted,
                         size_t *formatted_size)
{
    tn_error error = {0};
    tn_arena *arena = tn_arena_new();
    *formatted = NULL;
    tn_status status = arena ? format_in(arena, diagnostics, path, text, size, formatted, formatted_size, &error)
                             : tn_fail_memory(&error);
    tn_arena_free(arena);
    if (status != TN_OK && status != TN_INVALID)
        tn_report_error(diagnostics, &error, path, NULL, 0);
    tn_diagnostics_sort(diagnostics);
    return status;
}
