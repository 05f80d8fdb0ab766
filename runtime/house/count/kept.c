/* Keeps the steps that counting went: ranks go the same ones backwards. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/count/data.h"

enum { KEPT_MAX = 6000000 }; /* by all kinds of sections together: 144 MB */

tn_status tn_houses_keep_step(const tn_houses *h, tn_houses_kind *kind, uint32_t layer, uint32_t to,
                              const tn_houses_edge *edge, tn_error *error)
{
    tn_kept_steps *kept = &kind->layers[layer].kept;
    uint64_t times;
    if (!kept->all)
        return TN_OK;
    if (kind->kept_steps >= KEPT_MAX / h->kind_count || __builtin_mul_overflow(edge->ways, edge->times, &times)) {
        tn_houses_forget_steps(kind, layer);
        return TN_OK;
    }
    if (!tn_array_reserve(&kept->items, &kept->room, kept->count, 1, sizeof *kept->items))
        return tn_fail_memory(error);
    kept->items[kept->count++] = (tn_kept_step){edge->from, to, edge->slice, times};
    kind->kept_steps++;
    return TN_OK;
}

void tn_houses_forget_steps(tn_houses_kind *kind, uint32_t layer)
{
    tn_kept_steps *kept = &kind->layers[layer].kept;
    kind->kept_steps -= kept->count;
    free(kept->items);
    *kept = (tn_kept_steps){0};
}
