/* Lists what a .study file has: statements by their word, a boundary and a fitness term by two; of an evolution block
 * its settings. */
#include "compiler/study/study.h"

static size_t block_end(const tn_listing *listing, size_t i)
{
    while (i < listing->count && !tn_listing_is(listing, i, "}"))
        i++;
    return i < listing->count ? i + 1 : i;
}

static void add_block(tn_listing *listing, size_t first, size_t last)
{
    size_t close = tn_listing_is(listing, last - 1, "}") ? last - 1 : last;
    tn_listing_entry *block = tn_listing_add(listing, TN_LISTING_BLOCK, first, first + 1, first + 1);
    block->whole = tn_listing_span(listing, first, last);
    for (size_t i = first + 2, end; i < close; i = end + 1) {
        end = tn_listing_line_end(listing, i, close);
        if (end > i)
            tn_listing_add(listing, TN_LISTING_SETTING, i, i + 1, end)->inside = true;
    }
}

static bool starts_block(const tn_listing *listing, size_t i)
{
    return tn_listing_is(listing, i, "evolution") && tn_listing_is(listing, i + 1, "{");
}

static bool starts_statement(const tn_listing *listing, size_t i)
{
    tn_token token = listing->tokens[i];
    return starts_block(listing, i) ||
           (token.kind == TN_TOKEN_WORD &&
            tn_study_heads(listing->text + token.span.begin, token.span.end - token.span.begin));
}

void tn_study_list(tn_listing *listing)
{
    for (size_t i = 0, end; i < listing->count; i = end) {
        end = starts_block(listing, i) ? block_end(listing, i) : i + 1;
        if (starts_block(listing, i)) {
            add_block(listing, i, end);
            continue;
        }
        if (!starts_statement(listing, i))
            continue;
        while (end < listing->count && !starts_statement(listing, end) && listing->tokens[end].kind != TN_TOKEN_LINE)
            end++;
        bool by_two = tn_listing_is(listing, i, "boundary") || tn_listing_is(listing, i, "fitness");
        tn_listing_add(listing, TN_LISTING_SETTING, i, i + 1 + (by_two && end > i + 1), end);
    }
}
