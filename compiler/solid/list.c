/* Lists what a .solid file has: designs, and in each its boxes and its other statements. */
#include "compiler/solid/solid.h"

static size_t statement_end(const tn_listing *listing, size_t i)
{
    while (i < listing->count && !tn_listing_is(listing, i, ";") && !tn_listing_is(listing, i, "}") &&
           !tn_listing_is(listing, i, "{"))
        i++;
    return i;
}

/* A design's statements, from behind its brace; returns where they end. */
static size_t list_statements(tn_listing *listing, size_t i)
{
    while (i < listing->count && !tn_listing_is(listing, i, "}")) {
        size_t end = statement_end(listing, i);
        tn_token token = listing->tokens[i];
        if (end > i && tn_solid_heads(listing->text + token.span.begin, token.span.end - token.span.begin)) {
            bool named = (tn_listing_is(listing, i, "box") || tn_listing_is(listing, i, "fitness")) && end > i + 1;
            tn_listing_add(listing, TN_LISTING_SETTING, i, i + 1 + named, end)->inside = true;
        }
        i = end + (end < listing->count && !tn_listing_is(listing, end, "}"));
    }
    return i < listing->count ? i + 1 : i;
}

void tn_solid_list(tn_listing *listing)
{
    for (size_t i = 0, end; i < listing->count; i = end) {
        end = i + 1;
        if (!tn_listing_is(listing, i, "solid") || i + 1 >= listing->count)
            continue;
        size_t open = statement_end(listing, i);
        if (open >= listing->count || !tn_listing_is(listing, open, "{"))
            continue;
        size_t at = listing->entry_count;
        tn_listing_add(listing, TN_LISTING_BLOCK, i, i + 2, i + 2);
        end = list_statements(listing, open + 1);
        if (at < listing->entry_count)
            listing->entries[at].whole = tn_listing_span(listing, i, end);
    }
}
