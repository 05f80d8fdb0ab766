/* Lists what a .kit file has: its definitions, and in models and parts what they say. */
#include "compiler/kit/kit.h"

static bool is_any(const tn_listing *listing, size_t i, const char *const *words)
{
    for (; *words; words++)
        if (tn_listing_is(listing, i, *words))
            return true;
    return false;
}

static size_t end_of(const tn_listing *listing, size_t i, const char *const *ends)
{
    while (i < listing->count && !is_any(listing, i, ends))
        i++;
    return i;
}

void tn_kit_list(tn_listing *listing)
{
    static const char *const line_ends[] = {";", NULL}, *const block_ends[] = {"}", NULL};
    for (size_t i = 0, end; i < listing->count; i = end + 1) {
        const char *word = listing->text + listing->tokens[i].span.begin;
        size_t size = listing->tokens[i].span.end - listing->tokens[i].span.begin;
        bool block = tn_vocabulary_head_block(&tn_kit_words, word, size);
        bool line = tn_vocabulary_find(&tn_kit_words, word, size, TN_KIT_AT(STATEMENT), TN_AS_HEAD) != NULL;
        end = end_of(listing, i, block ? block_ends : line_ends);
        if (i + 1 >= listing->count || (!block && !line))
            continue;
        tn_listing_kind kind = block                               ? TN_LISTING_BLOCK
                               : tn_listing_is(listing, i, "rule") ? TN_LISTING_RULE
                                                                   : TN_LISTING_CONSTANT;
        size_t last = end < listing->count ? end + 1 : end;
        tn_listing_add(listing, kind, i + 1, i + 2, block ? i + 2 : end)->whole = tn_listing_span(listing, i, last);
    }
}
