/* Which parts of an explanation are shown. */
#include <stdlib.h>

#include "driver/plan/explain.h"

#define SHORT_DEPTH 4

/* In the short form: of an `or` that matched, what did; below what was not found, only what shows how far it got. */
static bool is_shown(const tn_explanation *why, const tn_why *node, bool full, unsigned depth)
{
    if (tn_part_unwritten(&why->trees[node->tree], node->part))
        return false;
    if (full || node->parent == TN_NO_WHY)
        return true;
    const tn_why *parent = &why->nodes[node->parent];
    tn_part_kind above = tn_why_part(why, parent)->kind;
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
        bool shown = is_shown(why, node, full, depth);
        if (shown) {
            rows->nodes[rows->count] = at;
            rows->depths[rows->count++] = depth;
        }
        if (shown && node->first != TN_NO_WHY) {
            at = node->first;
            depth++;
            continue;
        }
        while (at != 0 && why->nodes[at].next == TN_NO_WHY) {
            at = why->nodes[at].parent;
            depth--;
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
