/* Lists what a .field file has: constants, functions and surfaces by their names, settings by their words. */
#include "compiler/field/field.h"

static bool starts_statement(const tn_listing *listing, size_t i)
{
    tn_token token = listing->tokens[i];
    return token.kind == TN_TOKEN_WORD &&
           tn_field_heads(listing->text + token.span.begin, token.span.end - token.span.begin);
}

void tn_field_list(tn_listing *listing)
{
    for (size_t i = 0, end; i < listing->count; i = end) {
        end = i + 1;
        if (!starts_statement(listing, i))
            continue;
        while (end < listing->count && !starts_statement(listing, end))
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
