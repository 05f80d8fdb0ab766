/* Which rules use themselves at their left end, as trays are read, and all ways to there. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/plan/ways/rests_data.h"

enum { CORNERS_MAX = 1 << 16, DEEP_MAX = 1000 };

uint32_t tn_rests_part(const tn_rests *r, uint32_t neighbour, uint32_t side, uint32_t k)
{
    const tn_derived *node = &r->derivation->nodes[neighbour];
    uint32_t part = node->first, at = side == TN_SIDE_WRITTEN ? k : node->count - 1 - k;
    for (uint32_t i = 0; i < at; i++)
        part = r->derivation->nodes[part].next;
    return part;
}

bool tn_rests_may_end(const tn_rests *r, uint32_t neighbour, uint32_t side, uint32_t k)
{
    for (; k < r->derivation->nodes[neighbour].count; k++)
        if (!r->derivation->nodes[tn_rests_part(r, neighbour, side, k)].optional)
            return false;
    return true;
}

/* ---- which rules: those that lead back to themselves */

/* Marks the rules of the circle, from `first` on, that stand at the left end of a node. */
static void mark_left(const tn_rests *r, uint32_t index, uint32_t side, uint32_t first, uint8_t *left)
{
    const tn_derived *node = &r->derivation->nodes[index];
    if (node->kind == TN_DERIVED_CALL && node->again)
        left[node->rule - first] = 1;
    if (node->kind == TN_DERIVED_OR)
        for (uint32_t part = node->first; part != TN_NOT_DERIVED; part = r->derivation->nodes[part].next)
            mark_left(r, part, side, first, left);
    if (node->kind == TN_DERIVED_REPEAT)
        mark_left(r, node->first, side, first, left);
    for (uint32_t k = 0; node->kind == TN_DERIVED_NEIGHBOUR && k < node->count; k++) {
        uint32_t part = tn_rests_part(r, index, side, k);
        mark_left(r, part, side, first, left);
        if (!r->derivation->nodes[part].optional)
            break;
    }
}

/* Follows the left ends on (Warshall, A theorem on Boolean matrices, 1962). */
static void close(uint8_t *left, uint32_t size)
{
    for (uint32_t k = 0; k < size; k++)
        for (uint32_t i = 0; i < size; i++)
            for (uint32_t j = 0; left[i * size + k] && j < size; j++)
                left[i * size + j] |= left[k * size + j];
}

/* Rules that lead to each other are one group, whose number is its first rule's, from 1. */
static tn_status find_groups(tn_rests *r, uint32_t first, uint32_t end, uint32_t side, tn_error *error)
{
    uint32_t size = end - first;
    uint8_t *left = calloc((size_t)size * size + 1, 1);
    if (!left)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < size; i++)
        mark_left(r, r->derivation->rules[first + i].first, side, first, left + (size_t)i * size);
    close(left, size);
    for (uint32_t i = 0; i < size; i++) {
        uint32_t k = 0;
        while (k < size && !(left[i * size + k] && left[k * size + i]))
            k++;
        r->rules[(first + i) * TN_SIDES + side].group = k < size ? first + k + 1 : 0;
    }
    free(left);
    return TN_OK;
}

/* ---- all ways to the left end of a rule */

typedef struct path {
    tn_rests *r;
    uint32_t rule, side;
    uint32_t behind[DEEP_MAX]; /* symbols, the outermost first */
    uint32_t count;
    bool start;
} path;

static tn_status too_many(const path *p, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES, "a rule that uses itself has more than %d ways to its beginning",
            (int)CORNERS_MAX);
    tn_error_help(error, "write some of its alternatives as rules of their own");
    if (error)
        error->code_offset =
            p->r->derivation->module->FUNCTION_records[p->r->derivation->rules[p->rule].function].code_begin;
    return TN_LIMIT;
}

static tn_status add_corner(path *p, uint32_t rule, uint32_t node, tn_error *error)
{
    tn_rests *r = p->r;
    side_of_rule *of = &r->rules[p->rule * TN_SIDES + p->side];
    if (of->count >= CORNERS_MAX)
        return too_many(p, error);
    if (!tn_array_reserve(&of->corners, &of->room, of->count, 1, sizeof *of->corners) ||
        !tn_array_reserve(&r->behind, &r->behind_room, r->behind_count, p->count, sizeof *r->behind))
        return tn_fail_memory(error);
    of->corners[of->count++] = (corner){rule, node, (uint32_t)r->behind_count, p->count, p->start};
    for (uint32_t i = p->count; i-- > 0;)
        r->behind[r->behind_count++] = p->behind[i];
    return TN_OK;
}

static tn_status find_corners(path *p, uint32_t index, tn_error *error);

/* Goes on into a part, with the symbol behind it; NULL: nothing is. */
static tn_status go_on(path *p, uint32_t part, const symbol *behind, bool tied, tn_error *error)
{
    uint32_t before = p->count;
    tn_status status = TN_OK;
    if (p->count + 2 > DEEP_MAX)
        return too_many(p, error);
    if (tied)
        status = tn_rests_symbol(p->r, (symbol){.kind = SYMBOL_TIED}, &p->behind[p->count++], error);
    if (status == TN_OK && behind)
        status = tn_rests_symbol(p->r, *behind, &p->behind[p->count++], error);
    if (status == TN_OK)
        status = find_corners(p, part, error);
    p->count = before;
    return status;
}

static tn_status neighbour_corners(path *p, uint32_t index, tn_error *error)
{
    const tn_derived *node = &p->r->derivation->nodes[index];
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < node->count; k++) {
        uint32_t part = tn_rests_part(p->r, index, p->side, k);
        const symbol more = {SYMBOL_MORE, index, p->side, k + 1, 0};
        if (k + 1 < node->count)
            status = go_on(p, part, &more, false, error);
        if (status == TN_OK && tn_rests_may_end(p->r, index, p->side, k + 1))
            status = go_on(p, part, NULL, tn_tied_end(node, p->side), error);
        if (!p->r->derivation->nodes[part].optional)
            break;
    }
    return status;
}

static tn_status repeat_corners(path *p, uint32_t index, tn_error *error)
{
    const tn_derived *node = &p->r->derivation->nodes[index];
    const symbol more = {SYMBOL_TIMES, index, p->side, 1, 0};
    tn_status status = node->most != 1 ? go_on(p, node->first, &more, false, error) : TN_OK;
    return status == TN_OK && node->least <= 1 ? go_on(p, node->first, NULL, false, error) : status;
}

static tn_status find_corners(path *p, uint32_t index, tn_error *error)
{
    const tn_derivation *d = p->r->derivation;
    const tn_derived *node = &d->nodes[index];
    uint32_t group = p->r->rules[p->rule * TN_SIDES + p->side].group;
    bool start = p->start;
    tn_status status = TN_OK;
    switch (node->kind) {
    case TN_DERIVED_OR:
        for (uint32_t part = node->first; status == TN_OK && part != TN_NOT_DERIVED; part = d->nodes[part].next)
            status = find_corners(p, part, error);
        return status;
    case TN_DERIVED_NEIGHBOUR:
        p->start |= tn_tied_start(node, p->side);
        status = neighbour_corners(p, index, error);
        p->start = start;
        return status;
    case TN_DERIVED_REPEAT:
        return repeat_corners(p, index, error);
    case TN_DERIVED_CALL:
        if (node->again && p->r->rules[node->rule * TN_SIDES + p->side].group == group)
            return add_corner(p, node->rule, TN_NOT_DERIVED, error);
        return add_corner(p, TN_NOT_DERIVED, index, error);
    default:
        return add_corner(p, TN_NOT_DERIVED, index, error);
    }
}

static tn_status rule_corners(tn_rests *r, uint32_t rule, uint32_t side, tn_error *error)
{
    path *p = calloc(1, sizeof *p);
    if (!p)
        return tn_fail_memory(error);
    p->r = r;
    p->rule = rule;
    p->side = side;
    tn_status status = find_corners(p, r->derivation->rules[rule].first, error);
    free(p);
    return status;
}

tn_status tn_rests_corners(tn_rests *r, tn_error *error)
{
    const tn_derivation *d = r->derivation;
    r->rules = calloc((size_t)d->rule_count * TN_SIDES + 1, sizeof *r->rules);
    tn_status status = r->rules ? TN_OK : tn_fail_memory(error);
    for (uint32_t rule = 0; status == TN_OK && rule < d->rule_count; rule++)
        for (uint32_t side = 0; status == TN_OK && side < TN_SIDES; side++)
            if (d->rules[rule].circle_first == rule)
                status = find_groups(r, rule, d->rules[rule].circle_end, side, error);
    for (uint32_t rule = 0; status == TN_OK && rule < d->rule_count; rule++)
        for (uint32_t side = 0; status == TN_OK && side < TN_SIDES; side++)
            if (r->rules[rule * TN_SIDES + side].group > 0)
                status = rule_corners(r, rule, side, error);
    return status;
}
