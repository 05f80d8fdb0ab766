/* Keeps the tokens that a lexer leaves for formatting and for editors. */
#include "compiler/common/token.h"

#include <string.h>

void tn_token_add(tn_tokens *tokens, tn_token_kind kind, tn_span span)
{
    if (!tokens || span.begin == span.end)
        return;
    if (tokens->count == tokens->capacity) {
        size_t capacity = tokens->capacity ? 2 * tokens->capacity : 256;
        tn_token *items = TN_NEW_ARRAY(tokens->arena, tn_token, capacity);
        if (!items)
            return;
        if (tokens->count)
            memcpy(items, tokens->items, tokens->count * sizeof *items);
        tokens->items = items;
        tokens->capacity = capacity;
    }
    tokens->items[tokens->count++] = (tn_token){span, kind};
}
