/* Keeps the tokens that a lexer leaves for formatting and for editors, and lists what a text has from them. */
#include "compiler/common/token.h"

#include <string.h>
#include <strings.h>

/* ---- keeps the tokens that a lexer leaves for formatting and for editors */

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

/* ---- lists what a text has: the tokens that a listing is made of, and the entries that a notation adds */

bool tn_listing_start(tn_listing *listing, const char *text, const tn_tokens *tokens)
{
    tn_token *kept = tokens->arena ? TN_NEW_ARRAY(tokens->arena, tn_token, tokens->count + 1) : NULL;
    *listing = (tn_listing){.arena = tokens->arena, .text = text, .tokens = kept};
    if (!kept)
        return false;
    for (size_t i = 0; i < tokens->count; i++)
        if (tokens->items[i].kind != TN_TOKEN_COMMENT)
            kept[listing->count++] = tokens->items[i];
    return true;
}

bool tn_listing_is(const tn_listing *listing, size_t i, const char *text)
{
    if (i >= listing->count)
        return false;
    tn_span span = listing->tokens[i].span;
    size_t size = strlen(text);
    return size == span.end - span.begin && strncasecmp(listing->text + span.begin, text, size) == 0;
}

size_t tn_listing_line_end(const tn_listing *listing, size_t i, size_t last)
{
    while (i < last && listing->tokens[i].kind != TN_TOKEN_LINE)
        i++;
    return i;
}

tn_span tn_listing_span(const tn_listing *listing, size_t first, size_t last)
{
    return tn_span_join(listing->tokens[first].span, listing->tokens[last - 1].span);
}

/* Room for one more; NULL if out of memory. */
static tn_listing_entry *room(tn_listing *listing)
{
    if (listing->entry_count == listing->capacity) {
        size_t capacity = listing->capacity ? 2 * listing->capacity : 32;
        tn_listing_entry *grown = TN_NEW_ARRAY(listing->arena, tn_listing_entry, capacity);
        if (!grown)
            return NULL;
        if (listing->entry_count)
            memcpy(grown, listing->entries, listing->entry_count * sizeof *grown);
        listing->entries = grown;
        listing->capacity = capacity;
    }
    return &listing->entries[listing->entry_count++];
}

tn_listing_entry *tn_listing_add(tn_listing *listing, tn_listing_kind kind, size_t first, size_t named, size_t last)
{
    tn_listing_entry *entry = room(listing);
    if (!entry)
        entry = &listing->forgotten;
    *entry = (tn_listing_entry){
        .kind = kind, .name = tn_listing_span(listing, first, named), .whole = tn_listing_span(listing, first, last)};
    if (named < last) {
        tn_span rest = tn_listing_span(listing, named, last);
        size_t size = strcspn(listing->text + rest.begin, "\r\n"); /* its first line */
        if (size < rest.end - rest.begin)
            rest.end = rest.begin + (uint32_t)size;
        entry->detail = rest;
    }
    return entry;
}
