/* Finds the depths that derivations can have, the shallowest first. */
#include "runtime/grammar/depths.h"

#include <stdlib.h>

static bool has(const tn_depths *h, uint32_t rule, uint32_t height)
{
    return h->bits[rule * h->row + height / 64] >> (height % 64) & 1;
}

/* Do all non-terminals of the words [at, end) end within `height` levels? */
static bool all_end(const tn_grammar *g, const tn_analysis *a, uint32_t at, uint32_t end, uint32_t height)
{
    for (; at < end; at++)
        if (TN_WORD_OP(g->words[at]) == TN_WORD_RULE && a->rule_depth[TN_WORD_ARGUMENT(g->words[at])] > height)
            return false;
    return true;
}

/* Has one of the production's non-terminals the depth `height`? Those of a group count where all that it holds can end
 * within that: then it can be written once. */
static bool leads(const tn_depths *h, const tn_grammar *g, const tn_analysis *a, uint32_t production, uint32_t height)
{
    uint32_t closed = 0; /* words before this one lie in a group that is left out */
    for (uint32_t at = g->productions[production].words; TN_WORD_OP(g->words[at]) != TN_WORD_DONE; at++) {
        uint32_t argument = TN_WORD_ARGUMENT(g->words[at]);
        switch (TN_WORD_OP(g->words[at])) {
        case TN_WORD_REPEAT:
        case TN_WORD_MAYBE:
            if (at >= closed && !all_end(g, a, at + 1, at + 1 + argument, height))
                closed = at + 1 + argument;
            break;
        case TN_WORD_RULE:
            if (at >= closed && has(h, argument, height))
                return true;
            break;
        default:
            break;
        }
    }
    return false;
}

static void find_of_height(tn_depths *h, const tn_grammar *g, const tn_analysis *a, uint32_t height)
{
    uint32_t leaf = g->dialect == TN_DIALECT_GE ? 2 : 1;
    for (uint32_t p = 0; p < g->production_count; p++) {
        uint32_t least = a->production_depth[p], rule = g->productions[p].rule;
        if (least == TN_DEPTH_ENDLESS || least > height || has(h, rule, height))
            continue;
        if ((height == leaf && least == leaf) || (height > leaf && leads(h, g, a, p, height - 1)))
            h->bits[rule * h->row + height / 64] |= UINT64_C(1) << (height % 64);
    }
}

tn_status tn_depths_find(const tn_grammar *grammar, const tn_analysis *analysis, uint32_t top, tn_depths *depths,
                         tn_error *error)
{
    *depths = (tn_depths){.top = top, .row = (size_t)top / 64 + 1};
    depths->bits = calloc(grammar->rule_count * depths->row, sizeof *depths->bits);
    if (!depths->bits)
        return tn_fail_memory(error);
    for (uint32_t height = 1; height <= top; height++)
        find_of_height(depths, grammar, analysis, height);
    return TN_OK;
}

void tn_depths_clear(tn_depths *depths)
{
    free(depths->bits);
    *depths = (tn_depths){0};
}

bool tn_depths_within(const tn_depths *h, uint32_t rule, uint32_t low, uint32_t high)
{
    for (uint32_t height = low; height <= high && height <= h->top; height++)
        if (has(h, rule, height))
            return true;
    return false;
}
