/* Which parts of an explanation are shown. */
#include <stdlib.h>

#include "driver/plan/explain.h"

#define SHORT_DEPTH 4

/* A step of what is written as one, as the `not` in `a implies b`: it has no row, what is below it has. */
static bool is_step(const tn_explanation *why, const tn_why *node)
{
    const tn_parts *tree = &why->trees[node->tree];
    return tn_part_is_step(tree, node->part) && !tn_part_unwritten(tree, node->part);
}

/* Compiled to `not a or b`. */
static bool is_implies(const tn_explanation *why, const tn_why *node)
{
    if (tn_why_part(why, node)->kind != TN_PART_OR || node->first == TN_NO_WHY)
        return false;
    const tn_why *first = &why->nodes[node->first];
    return is_step(why, first) && tn_why_part(why, first)->kind == TN_PART_NOT;
}

/* In the short form: of an `or` that matched, what did; below what was not found, only what shows how far it got. */
static bool is_shown(const tn_explanation *why, const tn_why *node, bool full, unsigned depth)
{
    if (tn_part_unwritten(&why->trees[node->tree], node->part))
        return false;
    if (full || node->parent == TN_NO_WHY)
        return true;
    const tn_why *parent = &why->nodes[node->parent];
    tn_part_kind above = tn_why_part(why, parent)->kind;
    if (is_implies(why, parent) && !parent->matched)
        return true; /* both halves: the first matches, the second does not */
    if (is_step(why, parent) && above == TN_PART_NOT)
        return true; /* the first half of `implies`: where it does not match, that is why the whole does */
    if (depth > SHORT_DEPTH || (parent->matched && !node->matched && above == TN_PART_OR))
        return false;
    return node->matched || parent->parent == TN_NO_WHY || above == TN_PART_AND || above == TN_PART_NEIGHBOUR;
}

bool tn_explain_rows_make(const tn_explanation *why, bool full, tn_explain_rows *rows)
{
    size_t room = (size_t)why->node_count + 1;
    *rows = (tn_explain_rows){malloc(room * sizeof *rows->nodes), malloc(room * sizeof *rows->depths), 0};
    if (!rows->nodes || !rows->depths)
        return false;
    uint32_t at = 0;
    unsigned depth = 0;
    for (;;) {
        const tn_why *node = &why->nodes[at];
        bool step = is_step(why, node), shown = !step && is_shown(why, node, full, depth);
        if (shown) {
            rows->nodes[rows->count] = at;
            rows->depths[rows->count++] = depth;
        }
        if ((shown || step) && node->first != TN_NO_WHY) {
            at = node->first;
            depth += shown;
            continue;
        }
        while (at != 0 && why->nodes[at].next == TN_NO_WHY) {
            at = why->nodes[at].parent;
            depth -= !is_step(why, &why->nodes[at]);
        }
        if (at == 0)
            return true;
        at = why->nodes[at].next;
    }
}

void tn_explain_rows_clear(tn_explain_rows *rows)
{
    free(rows->nodes);
    free(rows->depths);
    *rows = (tn_explain_rows){0};
}
