#include "compiler/plan/edit/rule_text.h"

#include <string.h>

/* Tokens and comments apart, both in their order. */
static tn_status sort_tokens(const tn_tokens *all, tn_rule_text *to, tn_error *error)
{
    tn_token *tokens = TN_NEW_ARRAY(to->arena, tn_token, all->count + 1),
             *comments = TN_NEW_ARRAY(to->arena, tn_token, all->count + 1);
    if (!tokens || !comments)
        return tn_fail_memory(error);
    for (size_t i = 0; i < all->count; i++) {
        if (all->items[i].kind == TN_TOKEN_COMMENT)
            comments[to->comment_count++] = all->items[i];
        else
            tokens[to->token_count++] = all->items[i];
    }
    to->tokens = tokens;
    to->comments = comments;
    return TN_OK;
}

static const char *first_error(const tn_diagnostics *said, tn_arena *arena)
{
    for (size_t i = 0; i < said->count; i++)
        if (said->items[i].severity == TN_ERROR && said->items[i].message)
            return tn_arena_copy(arena, said->items[i].message, strlen(said->items[i].message));
    return NULL;
}

static tn_status parse(tn_diagnostics *said, uint32_t file, tn_rule_text *to, tn_error *error)
{
    tn_tokens tokens = {.arena = to->arena};
    to->text = to->sources.files[file].text;
    to->size = to->sources.files[file].size;
    to->tree = tn_parse_plan(to->arena, said, file, &tokens);
    to->parses = to->tree && said->error_count == 0;
    to->mistake = first_error(said, to->arena);
    if (!to->tree || said->failed || tn_arena_failed(to->arena))
        return tn_fail_memory(error);
    return sort_tokens(&tokens, to, error);
}

tn_status tn_rule_text_read(const char *text, size_t size, tn_rule_text *to, tn_error *error)
{
    tn_diagnostics said;
    uint32_t file;
    *to = (tn_rule_text){.arena = tn_arena_new()};
    if (!to->arena)
        return tn_fail_memory(error);
    tn_status status = tn_sources_add(&to->sources, "rule.plan", text, size, &file, error);
    tn_diagnostics_init(&said, &to->sources);
    if (status == TN_OK)
        status = parse(&said, file, to, error);
    tn_diagnostics_clear(&said);
    return status;
}

void tn_rule_text_clear(tn_rule_text *text)
{
    tn_sources_clear(&text->sources);
    tn_arena_free(text->arena);
    *text = (tn_rule_text){0};
}

/* The item as a rule that has a body, or NULL. */
static const tn_ast_rule *as_rule(const tn_ast_top *item)
{
    const tn_ast_rule *rule = item->kind == TN_ITEM_RULE ? (const tn_ast_rule *)item : NULL;
    return rule && rule->body ? rule : NULL;
}

const tn_ast_rule *tn_rule_text_find(const tn_rule_text *text, const char *name)
{
    for (TN_EACH(const tn_ast_top, item, text->tree->items)) {
        const tn_ast_rule *rule = as_rule(item);
        if (rule && strcmp(rule->name->text, name) == 0)
            return rule;
    }
    return NULL;
}

const tn_ast_rule *tn_rule_text_at(const tn_rule_text *text, size_t offset)
{
    for (TN_EACH(const tn_ast_top, item, text->tree->items)) {
        const tn_ast_rule *rule = as_rule(item);
        if (rule && item->node.span.begin <= offset && offset <= item->node.span.end)
            return rule;
    }
    return NULL;
}

size_t tn_rule_text_token(const tn_rule_text *text, size_t offset)
{
    size_t low = 0, high = text->token_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (text->tokens[middle].span.begin < offset)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}
