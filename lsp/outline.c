/* The outline of a document: of a .plan file from the index, of others from the tokens, so that it is there too while a
 * file is being typed. */
#include <string.h>
#include <strings.h>

#include "compiler/study/study.h"
#include "lsp/features.h"

/* SymbolKind of the protocol. */
enum {
    KIND_MODULE = 2,
    KIND_PROPERTY = 7,
    KIND_FIELD = 8,
    KIND_FUNCTION = 12,
    KIND_CONSTANT = 14,
    KIND_KEY = 20,
    KIND_MEMBER = 22,
    KIND_STRUCT = 23,
};

/* ---- .plan */

static int outline_kind(tn_symbol_kind kind)
{
    static const int kinds[] = {
        [TN_SYMBOL_SCHEMA] = KIND_STRUCT, [TN_SYMBOL_FIELD] = KIND_FIELD,    [TN_SYMBOL_VALUE] = KIND_MEMBER,
        [TN_SYMBOL_RULE] = KIND_FUNCTION, [TN_SYMBOL_LIBRARY] = KIND_MODULE, [TN_SYMBOL_CLAUSE] = KIND_KEY};
    return kinds[kind];
}

static json_t *outline_item(tn_file_analysis *analysis, const tn_symbol *symbol)
{
    json_t *item = json_pack("{s:s,s:i,s:o,s:o}", "name", symbol->name, "kind", outline_kind(symbol->kind), "range",
                             tn_analysis_range(analysis, symbol->span), "selectionRange",
                             tn_analysis_range(analysis, symbol->name_span));
    if (symbol->doc)
        json_object_set_new(item, "detail", json_string(symbol->doc));
    json_t *children = json_array();
    for (const tn_symbol *s = symbol->next; s && symbol->kind != TN_SYMBOL_RULE; s = s->next) {
        if (s->parent == symbol)
            json_array_append_new(children, outline_item(analysis, s));
        else if (s->kind != TN_SYMBOL_VALUE && symbol->kind != TN_SYMBOL_LIBRARY && s->parent != symbol)
            break;
    }
    if (json_array_size(children) > 0)
        json_object_set(item, "children", children);
    json_decref(children);
    return item;
}

static json_t *outline_plan(tn_file_analysis *analysis)
{
    json_t *list = json_array();
    for (const tn_symbol *s = analysis->index.first; s; s = s->next)
        if (s->span.file == 0 && !s->parent)
            json_array_append_new(list, outline_item(analysis, s));
    return list;
}

/* ---- from tokens */

typedef struct reader {
    tn_file_analysis *analysis;
    const char *text;
    const tn_token *tokens; /* without comments */
    size_t count;
} reader;

static bool is(const reader *r, size_t i, const char *text)
{
    if (i >= r->count)
        return false;
    tn_span span = r->tokens[i].span;
    return strlen(text) == span.end - span.begin && strncasecmp(r->text + span.begin, text, strlen(text)) == 0;
}

static tn_span span_of(const reader *r, size_t first, size_t last)
{
    return tn_span_join(r->tokens[first].span, r->tokens[last - 1].span);
}

/* Tokens [first, named) are the name, the rest up to `last` the detail. */
static json_t *entry(const reader *r, int kind, size_t first, size_t named, size_t last)
{
    tn_span name = span_of(r, first, named), whole = span_of(r, first, last);
    json_t *item = json_pack("{s:s%,s:i,s:o,s:o}", "name", r->text + name.begin, (size_t)(name.end - name.begin),
                             "kind", kind, "range", tn_analysis_range(r->analysis, whole), "selectionRange",
                             tn_analysis_range(r->analysis, name));
    if (named < last && item) {
        tn_span rest = span_of(r, named, last);
        size_t size = strcspn(r->text + rest.begin, "\r\n"); /* its first line */
        if (size > rest.end - rest.begin)
            size = rest.end - rest.begin;
        json_object_set_new(item, "detail", json_stringn(r->text + rest.begin, size));
    }
    return item;
}

/* The next line end from i on, or `last`. */
static size_t line_end(const reader *r, size_t i, size_t last)
{
    while (i < last && r->tokens[i].kind != TN_TOKEN_LINE)
        i++;
    return i;
}

static bool is_arrow(const reader *r, size_t i)
{
    return is(r, i, "->") || is(r, i, "\xe2\x86\x92");
}

/* A rule by what it replaces; the seed; settings. */
static json_t *outline_hemls(const reader *r)
{
    json_t *list = json_array();
    for (size_t first = 0, last; first < r->count; first = last + 1) {
        last = line_end(r, first, r->count);
        size_t arrow = first;
        while (arrow < last && !is_arrow(r, arrow))
            arrow++;
        if (first == last)
            continue;
        if (arrow > first && arrow < last)
            json_array_append_new(list, entry(r, KIND_FUNCTION, first, arrow, last));
        else if (r->tokens[first].kind == TN_TOKEN_WORD)
            json_array_append_new(list, entry(r, KIND_PROPERTY, first, first + 1, last));
        else
            json_array_append_new(list, entry(r, KIND_CONSTANT, first, last, last));
    }
    return list;
}

static size_t block_end(const reader *r, size_t i)
{
    while (i < r->count && !is(r, i, "}"))
        i++;
    return i < r->count ? i + 1 : i;
}

static json_t *outline_block(const reader *r, size_t first, size_t last)
{
    json_t *block = entry(r, KIND_MODULE, first, first + 1, first + 1), *settings = json_array();
    size_t close = is(r, last - 1, "}") ? last - 1 : last;
    json_object_set_new(block, "range", tn_analysis_range(r->analysis, span_of(r, first, last)));
    for (size_t i = first + 2, end; i < close; i = end + 1) {
        end = line_end(r, i, close);
        if (end > i)
            json_array_append_new(settings, entry(r, KIND_PROPERTY, i, i + 1, end));
    }
    json_object_set_new(block, "children", settings);
    return block;
}

static bool starts_block(const reader *r, size_t i)
{
    return is(r, i, "evolution") && is(r, i + 1, "{");
}

static bool starts_statement(const reader *r, size_t i)
{
    tn_token token = r->tokens[i];
    return starts_block(r, i) || (token.kind == TN_TOKEN_WORD &&
                                  tn_study_heads(r->text + token.span.begin, token.span.end - token.span.begin));
}

/* Statements by their word; a boundary and a fitness term by two. */
static json_t *outline_study(const reader *r)
{
    json_t *list = json_array();
    for (size_t i = 0, end; i < r->count; i = end) {
        end = starts_block(r, i) ? block_end(r, i) : i + 1;
        if (starts_block(r, i)) {
            json_array_append_new(list, outline_block(r, i, end));
            continue;
        }
        if (!starts_statement(r, i))
            continue;
        while (end < r->count && !starts_statement(r, end) && r->tokens[end].kind != TN_TOKEN_LINE)
            end++;
        size_t named = i + 1 + ((is(r, i, "boundary") || is(r, i, "fitness")) && end > i + 1);
        json_array_append_new(list, entry(r, KIND_PROPERTY, i, named, end));
    }
    return list;
}

/* Rules and directives. */
static json_t *outline_bnf(const reader *r)
{
    json_t *list = json_array();
    for (size_t i = 0, end; i < r->count; i = end) {
        bool rule = r->tokens[i].kind == TN_TOKEN_NAME;
        for (end = i + 1; rule && end < r->count && r->tokens[end].kind != TN_TOKEN_NAME;)
            end++;
        if (rule || r->tokens[i].kind == TN_TOKEN_WORD)
            json_array_append_new(list, entry(r, rule ? KIND_FUNCTION : KIND_PROPERTY, i, i + 1, i + 1));
        if (rule) { /* blank texts and line ends before the next rule are not this one's */
            json_t *item = json_array_get(list, json_array_size(list) - 1);
            size_t last = end;
            while (last > i + 1 && r->tokens[last - 1].kind == TN_TOKEN_LINE)
                last--;
            json_object_set_new(item, "range", tn_analysis_range(r->analysis, span_of(r, i, last)));
        }
    }
    return list;
}

/* ---- all */

/* The tokens but for the comments, in the arena; where lines mean something, with their ends. */
static bool make_reader(tn_file_analysis *analysis, reader *r)
{
    const tn_tokens *all = &analysis->tokens;
    tn_token *tokens = all->arena ? TN_NEW_ARRAY(all->arena, tn_token, all->count + 1) : NULL;
    *r = (reader){.analysis = analysis, .tokens = tokens};
    if (!tokens)
        return false;
    r->text = analysis->compilation.sources.files[0].text;
    for (size_t i = 0; i < all->count; i++)
        if (all->items[i].kind != TN_TOKEN_COMMENT)
            tokens[r->count++] = all->items[i];
    return true;
}

json_t *tn_lsp_outline(tn_document *document, tn_file_analysis *analysis)
{
    reader r;
    (void)document;
    if (analysis->notation == TN_NOTATION_PLAN)
        return outline_plan(analysis);
    if (!make_reader(analysis, &r))
        return json_array();
    return analysis->notation == TN_NOTATION_HEMLS   ? outline_hemls(&r)
           : analysis->notation == TN_NOTATION_STUDY ? outline_study(&r)
                                                     : outline_bnf(&r);
}
