/* Finds the new lines of the clauses that tests name by line, when a .plan file is formatted. */
#include "compiler/plan/format_clauses.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHAIN_MAX = 64 }; /* libraries made from one another; beyond, names by lines are left as they are */

typedef struct renamer {
    const tn_source *source;
    const tn_ast_file *tree;
    const tn_format *format;
    const tn_ast_library *chain[CHAIN_MAX]; /* the library, what it is made from, and so on */
    size_t chain_count;
} renamer;

static const tn_ast_library *find_library(const tn_ast_file *tree, const char *name)
{
    for (TN_EACH(const tn_ast_top, item, tree->items))
        if (item->kind == TN_ITEM_LIBRARY && strcmp(((const tn_ast_library *)item)->name->text, name) == 0)
            return (const tn_ast_library *)item;
    return NULL;
}

static bool find_chain(renamer *r, const char *name)
{
    r->chain_count = 0;
    while (name) {
        const tn_ast_library *library = find_library(r->tree, name);
        if (!library || r->chain_count == CHAIN_MAX)
            return false;
        r->chain[r->chain_count++] = library;
        name = library->from ? library->from->text : NULL;
    }
    return true;
}

/* "prune", "require" or "generate" for a clause that has no name of its own; NULL for others. */
static const char *clause_word(const tn_ast_clause *clause)
{
    const char *word = clause->form == TN_FORM_PRUNE      ? "prune"
                       : clause->form == TN_FORM_REQUIRE  ? "require"
                       : clause->form == TN_FORM_GENERATE ? "generate"
                                                          : NULL;
    return !word || clause->name || clause->expr->kind == TN_EXPR_NAME ? NULL : word;
}

static size_t old_line(const renamer *r, size_t offset)
{
    size_t line = 1;
    for (size_t i = 0; i < offset; i++)
        line += r->source->text[i] == '\n';
    return line;
}

/* Token of the source's byte; tokens are in order. */
static size_t token_at(const tn_format *format, size_t offset)
{
    size_t low = 0, high = format->count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (format->tokens[middle].offset < offset)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The clause that the name word@line.ordinal means. */
static const tn_ast_clause *find_clause(const renamer *r, const char *word, size_t line, size_t ordinal)
{
    for (size_t i = r->chain_count; i-- > 0;)
        for (TN_EACH(const tn_ast_clause, clause, r->chain[i]->clauses)) {
            const char *own = clause_word(clause);
            if (own && strcmp(own, word) == 0 && old_line(r, clause->node.span.begin) == line && --ordinal == 0)
                return clause;
        }
    return NULL;
}

static size_t new_line(const renamer *r, const tn_ast_clause *clause)
{
    return r->format->tokens[token_at(r->format, clause->node.span.begin)].line;
}

static size_t new_ordinal(const renamer *r, const tn_ast_clause *target)
{
    size_t ordinal = 0;
    for (size_t i = r->chain_count; i-- > 0;)
        for (TN_EACH(const tn_ast_clause, clause, r->chain[i]->clauses)) {
            const char *own = clause_word(clause);
            ordinal += own && strcmp(own, clause_word(target)) == 0 && new_line(r, clause) == new_line(r, target);
            if (clause == target)
                return ordinal;
        }
    return ordinal;
}

static bool rename_token(const renamer *r, tn_arena *arena, const tn_ast_word *name, tn_format_token *tokens)
{
    const char *at = strchr(name->text, '@');
    char word[16], made[64], *end;
    if (!at || (size_t)(at - name->text) >= sizeof word)
        return false;
    snprintf(word, sizeof word, "%.*s", (int)(at - name->text), name->text);
    size_t line = strtoul(at + 1, &end, 10), ordinal = *end == '.' ? strtoul(end + 1, NULL, 10) : 1;
    const tn_ast_clause *clause = find_clause(r, word, line, ordinal);
    if (!clause)
        return false;
    ordinal = new_ordinal(r, clause);
    int size = snprintf(made, sizeof made, "%s@%zu", word, new_line(r, clause));
    if (ordinal > 1)
        size += snprintf(made + size, sizeof made - (size_t)size, ".%zu", ordinal);
    tn_format_token *token = &tokens[token_at(r->format, name->node.span.begin)];
    if (token->size == (size_t)size && memcmp(token->text, made, token->size) == 0)
        return false;
    char *copy = tn_arena_copy(arena, made, (size_t)size);
    if (!copy)
        return false;
    token->text = copy;
    token->size = token->width = (size_t)size;
    return true;
}

bool tn_format_clause_names(tn_arena *arena, const tn_source *source, const tn_ast_file *tree, const tn_format *format,
                            tn_format_token *tokens)
{
    renamer r = {.source = source, .tree = tree, .format = format};
    bool renamed = false;
    for (TN_EACH(const tn_ast_top, item, tree->items)) {
        const tn_ast_test *test = (const tn_ast_test *)item;
        if (item->kind != TN_ITEM_TEST || !find_chain(&r, ((const tn_ast_word *)test->subjects.first)->text))
            continue;
        for (TN_EACH(const tn_ast_case, test_case, test->cases))
            for (TN_EACH(const tn_ast_word, name, test_case->by))
                renamed |= rename_token(&r, arena, name, tokens);
    }
    return renamed;
}
