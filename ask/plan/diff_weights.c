/* diff: the weights that an edit changes. */
#include <stdlib.h>
#include <string.h>

#include "ask/plan/diff.h"
#include "ask/plan/weights.h"
#include "runtime/plan/match/code_hash.h"

/* A library's weights, with hashes of what they weigh. */
typedef struct side {
    const tn_module *module;
    const tn_weight_record *weights;
    uint32_t count;
    uint64_t (*hashes)[2];
    bool *met; /* has it been compared? */
} side;

static tn_status open_side(side *s, const tn_ready_library *ready, tn_error *error)
{
    *s = (side){.module = ready->schema->module, .count = ready->record->weight_count};
    s->weights = s->module->WEIGHT_records + ready->record->weight_first;
    s->hashes = calloc((size_t)s->count + 1, sizeof *s->hashes);
    s->met = calloc((size_t)s->count + 1, sizeof *s->met);
    tn_status status = s->hashes && s->met ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < s->count; i++) {
        const tn_sum_record *sum = &s->module->SUM_records[s->weights[i].sum];
        status = tn_code_hash(s->module, s->module->TERM_records[sum->term_first].part, s->hashes[i], error);
    }
    return status;
}

static void close_side(side *s)
{
    free(s->hashes);
    free(s->met);
}

static const char *factor_of(const side *s, uint32_t i)
{
    return tn_text(s->module, s->weights[i].factor);
}

/* before, after: which weight, or UINT32_MAX. */
static tn_status tell(const side *sides, uint32_t before, uint32_t after, tn_clause_change change, tn_compared *to,
                      tn_error *error)
{
    tn_compared_weight *weight = TN_ADD(compared_weight, to->weights, error);
    if (!weight)
        return TN_MEMORY;
    const side *named = &sides[after != UINT32_MAX];
    weight->name = tn_text(named->module, named->weights[after != UINT32_MAX ? after : before].name);
    weight->change = tn_change_word(change);
    weight->has_before = before != UINT32_MAX;
    weight->has_after = after != UINT32_MAX;
    if (weight->has_before) {
        mpq_set_str(weight->before, factor_of(&sides[0], before), 10);
        weight->shown_before = tn_weight_text(weight->before);
    }
    if (weight->has_after) {
        mpq_set_str(weight->after, factor_of(&sides[1], after), 10);
        weight->shown_after = tn_weight_text(weight->after);
    }
    to->has_weights = true;
    bool shown = (weight->shown_before || !weight->has_before) && (weight->shown_after || !weight->has_after);
    return shown ? TN_OK : tn_fail_memory(error);
}

/* Pairs weights of the same trays: first those of the same number too, which did not change. */
static tn_status pair(side *sides, bool same_number, tn_compared *to, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t b = 0; status == TN_OK && b < sides[0].count; b++)
        for (uint32_t a = 0; status == TN_OK && !sides[0].met[b] && a < sides[1].count; a++) {
            bool same = strcmp(factor_of(&sides[0], b), factor_of(&sides[1], a)) == 0;
            if (sides[1].met[a] || memcmp(sides[0].hashes[b], sides[1].hashes[a], sizeof *sides->hashes) != 0 ||
                same != same_number)
                continue;
            sides[0].met[b] = sides[1].met[a] = true;
            if (!same)
                status = tell(sides, b, a, TN_CLAUSE_CHANGED, to, error);
        }
    return status;
}

tn_status tn_diff_weights(const tn_ready_library *before, const tn_ready_library *after, tn_compared *compared,
                          tn_error *error)
{
    side sides[2] = {0};
    tn_status status = open_side(&sides[0], before, error);
    if (status == TN_OK)
        status = open_side(&sides[1], after, error);
    if (status == TN_OK)
        status = pair(sides, true, compared, error);
    if (status == TN_OK)
        status = pair(sides, false, compared, error);
    for (uint32_t b = 0; status == TN_OK && b < sides[0].count; b++)
        if (!sides[0].met[b])
            status = tell(sides, b, UINT32_MAX, TN_CLAUSE_REMOVED, compared, error);
    for (uint32_t a = 0; status == TN_OK && a < sides[1].count; a++)
        if (!sides[1].met[a])
            status = tell(sides, UINT32_MAX, a, TN_CLAUSE_ADDED, compared, error);
    close_side(&sides[0]);
    close_side(&sides[1]);
    return status;
}
