/* Lays out a text in its notation's one way, and checks that it still means what it did. */
#include "compiler/format.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/common/lexical.h"

enum { PASSES_MAX = 8 };

/* ---- what was laid out against what it was made from */

/* The next token that is neither a comment nor a line end; *line: there was one of these. */
static size_t next_token(const tn_tokens *tokens, size_t i, bool *line)
{
    *line = false;
    for (; i < tokens->count && (tokens->items[i].kind == TN_TOKEN_COMMENT || tokens->items[i].kind == TN_TOKEN_LINE);
         i++)
        *line |= tokens->items[i].kind == TN_TOKEN_LINE;
    return i;
}

static const char *text_of(const tn_sources *sources, tn_token token)
{
    return sources->files[token.span.file].text + token.span.begin;
}

/* Are two house lines the same, one blank or line end being as good as several? */
static bool same_house(const char *a, size_t a_size, const char *b, size_t b_size)
{
    size_t i = 0, k = 0;
    while (i < a_size && k < b_size) {
        size_t blanks = strspn(a + i, " \t\r\n\f\v"), others = strspn(b + k, " \t\r\n\f\v");
        if ((blanks > 0) != (others > 0) || (!blanks && a[i] != b[k]))
            return false;
        i += blanks ? blanks : 1;
        k += blanks ? others : 1;
    }
    return i == a_size && k == b_size;
}

static bool same_token(const tn_sources *sources, tn_token one, tn_token other)
{
    size_t size = one.span.end - one.span.begin;
    if (one.kind != other.kind)
        return false;
    if (one.kind == TN_TOKEN_CLAUSE_NAME) /* the line that it names is elsewhere now */
        return true;
    const char *a = text_of(sources, one), *b = text_of(sources, other);
    if (one.kind == TN_TOKEN_HOUSE)
        return same_house(a, size, b, other.span.end - other.span.begin);
    return size == other.span.end - other.span.begin &&
           (one.kind == TN_TOKEN_WORD ? strncasecmp(a, b, size) : memcmp(a, b, size)) == 0;
}

/* Beside a brace, a line end means nothing. */
static bool is_brace(const tn_sources *sources, tn_token token)
{
    return token.kind == TN_TOKEN_SIGN && strchr("{}", *text_of(sources, token));
}

/* Do the two have the same tokens, comments aside, on the same lines where these mean something? */
static bool same_tokens(const tn_sources *sources, const tn_reading *before, const tn_reading *after)
{
    const tn_tokens *one = &before->tokens, *other = &after->tokens;
    bool line, other_line, free = true;
    size_t i = next_token(one, 0, &line), k = next_token(other, 0, &other_line);
    while (i < one->count && k < other->count && same_token(sources, one->items[i], other->items[k])) {
        bool brace = is_brace(sources, one->items[i]);
        if (line != other_line && !free && !brace)
            return false;
        free = brace;
        i = next_token(one, i + 1, &line);
        k = next_token(other, k + 1, &other_line);
    }
    return i == one->count && k == other->count;
}

/* ---- one text */

/* What a lexer did not leave a token for would be lost: there may be nothing but white space between tokens, and the
 * `;` that ends a line of a .hemls file which goes on in the next. */
static bool is_whole(const tn_source *source, const tn_tokens *tokens)
{
    size_t end = tn_text_mark(source->text, source->size);
    for (size_t i = 0; i <= tokens->count; i++) {
        size_t next = i < tokens->count ? tokens->items[i].span.begin : source->size;
        for (; end < next; end++)
            if (!strchr(" \t\r\n\f\v;", source->text[end]))
                return false;
        end = i < tokens->count ? tokens->items[i].span.end : end;
    }
    return true;
}

/* A byte order mark after white space would come first, and then be one. */
static bool reports_late_mark(tn_diagnostics *diagnostics, uint32_t file)
{
    const char *text = diagnostics->sources->files[file].text;
    size_t mark = tn_text_mark(text, diagnostics->sources->files[file].size);
    size_t begin = mark + strspn(text + mark, " \t\r\n\f\v");
    if (!tn_text_mark(text + begin, diagnostics->sources->files[file].size - begin))
        return false;
    tn_span span = {file, (uint32_t)begin, (uint32_t)begin + 3};
    tn_diagnostic *d = tn_report(diagnostics, E_STRAY_CHARACTER, span,
                                 "a byte order mark stands elsewhere than at the start of the file");
    tn_help(diagnostics, d, "leave it out");
    return true;
}

static tn_status read_text(tn_arena *arena, tn_diagnostics *diagnostics, const tn_notation *notation, const char *path,
                           const char *text, size_t size, tn_reading *read, tn_error *error)
{
    size_t errors = diagnostics->error_count;
    tn_status status = tn_sources_add(diagnostics->sources, path, text, size, &read->file, error);
    if (status != TN_OK)
        return status;
    if (!tn_text_check(diagnostics, read->file) || reports_late_mark(diagnostics, read->file))
        return TN_INVALID;
    bool done = tn_read(arena, diagnostics, notation, read->file, read);
    if (!done || diagnostics->failed || tn_arena_failed(arena))
        return tn_fail_memory(error);
    if (notation->front->trim)
        notation->front->trim(&diagnostics->sources->files[read->file], &read->tokens);
    return diagnostics->error_count > errors ? TN_INVALID : TN_OK;
}

static tn_status report_depth(tn_diagnostics *diagnostics, const tn_reading *text, size_t offset)
{
    tn_span span = {text->file, (uint32_t)offset, (uint32_t)offset + 1};
    tn_diagnostic *d =
        tn_report(diagnostics, E_TOO_DEEP, span, "brackets are nested more than %u deep, which is the limit",
                  (unsigned)TN_FORMAT_BRACKETS_MAX);
    tn_help(diagnostics, d, "leave out those that are not needed");
    return TN_INVALID;
}

/* Lays the file out, and again until the lines that clauses are named by have come to rest. */
static tn_status lay_out(tn_arena *arena, tn_diagnostics *diagnostics, const tn_notation *notation,
                         const tn_reading *from, char **text, size_t *size, tn_error *error)
{
    const tn_source *source = &diagnostics->sources->files[from->file];
    const tn_front *front = notation->front;
    tn_format format = {.tree = from->tree};
    size_t place = 0;
    tn_format_take(&format, arena, source, &from->tokens, front->spell);
    if (tn_arena_failed(arena))
        return tn_fail_memory(error);
    if (front->nests && !tn_format_match_brackets(&format, &place))
        return report_depth(diagnostics, from, format.tokens[place].offset);
    tn_format_token *tokens = format.tokens;
    size_t bytes = (format.count + 1) * sizeof *tokens;
    bool renamed = true;
    for (int pass = 0; renamed && pass < PASSES_MAX; pass++) {
        format.tokens = tn_arena_alloc(arena, bytes);
        if (!format.tokens)
            return tn_fail_memory(error);
        memcpy(format.tokens, tokens, bytes);
        tn_layout_start(&format.layout, arena);
        front->lay_out(&format);
        renamed = front->rename && front->rename(arena, source, from, &format, tokens);
    }
    *text = tn_layout_finish(&format.layout, size);
    return *text ? TN_OK : tn_fail_memory(error);
}

/* Reads what was laid out; *same: it is what it was made from. What there is to say about it has been said. */
static tn_status compare(tn_arena *arena, tn_sources *sources, const tn_notation *notation, const char *path,
                         const char *text, size_t size, const tn_reading *before, bool *same, tn_error *error)
{
    tn_diagnostics scratch;
    tn_reading after;
    tn_diagnostics_init(&scratch, sources);
    tn_status status = read_text(arena, &scratch, notation, path, text, size, &after, error);
    *same = status == TN_OK &&
            (notation->front->same ? notation->front->same(before, &after) : same_tokens(sources, before, &after));
    tn_diagnostics_clear(&scratch);
    if (tn_arena_failed(arena))
        return tn_fail_memory(error);
    return status == TN_INVALID ? TN_OK : status;
}

/* Reads the text with the newer words for older ones instead, if it has some; *said: what there is to say of that, or
 * NULL. */
static tn_status renew(tn_arena *arena, tn_diagnostics *diagnostics, const tn_notation *notation, const char *path,
                       tn_reading *read, const char **said, tn_error *error)
{
    const tn_source *source = &diagnostics->sources->files[read->file];
    *said = NULL;
    const char *text = notation->front->renew ? notation->front->renew(arena, source, &read->tokens, said) : NULL;
    if (tn_arena_failed(arena))
        return tn_fail_memory(error);
    return text ? read_text(arena, diagnostics, notation, path, text, strlen(text), read, error) : TN_OK;
}

static tn_status format_in(tn_arena *arena, tn_diagnostics *diagnostics, const tn_notation *notation, const char *path,
                           const char *text, size_t size, char **formatted, size_t *formatted_size, tn_error *error)
{
    tn_reading before;
    const char *renewed = NULL;
    char *laid_out;
    bool same;
    tn_status status = read_text(arena, diagnostics, notation, path, text, size, &before, error);
    if (status == TN_OK && !is_whole(&diagnostics->sources->files[before.file], &before.tokens))
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "laid out, %s would lose something: it stays as it is", path);
    if (status == TN_OK)
        status = renew(arena, diagnostics, notation, path, &before, &renewed, error);
    if (status == TN_OK)
        status = lay_out(arena, diagnostics, notation, &before, &laid_out, formatted_size, error);
    if (status == TN_OK)
        status = compare(arena, diagnostics->sources, notation, path, laid_out, *formatted_size, &before, &same, error);
    if (status != TN_OK)
        return status;
    if (!same)
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "laid out, %s would not mean the same: it stays as it is",
                       path);
    *formatted = malloc(*formatted_size + 1);
    if (!*formatted)
        return tn_fail_memory(error);
    memcpy(*formatted, laid_out, *formatted_size + 1);
    if (renewed)
        tn_report_bare(diagnostics, TN_NOTE, TN_CODE_NONE, "%s: %s; the next release reads the newer words alone", path,
                       renewed);
    return TN_OK;
}

tn_status tn_format_text(tn_diagnostics *diagnostics, const tn_notation *notation, const char *path, const char *text,
                         size_t size, char **formatted, size_t *formatted_size)
{
    tn_error error = {0};
    tn_arena *arena = tn_arena_new();
    *formatted = NULL;
    tn_status status =
        arena ? format_in(arena, diagnostics, notation, path, text, size, formatted, formatted_size, &error)
              : tn_fail_memory(&error);
    tn_arena_free(arena);
    if (status != TN_OK && status != TN_INVALID)
        tn_report_error(diagnostics, &error, path, NULL, 0);
    tn_diagnostics_sort(diagnostics);
    return status;
}
