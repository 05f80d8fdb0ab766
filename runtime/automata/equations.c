#include "runtime/automata/equations.h"

#include <stdlib.h>

tn_status tn_linear_make(const tn_marked *marked, uint32_t count, uint32_t unknown, tn_linear *out, tn_error *error)
{
    *out = (tn_linear){.count = count, .by = calloc((size_t)count + 1, sizeof(tn_dfa *))};
    if (!out->by)
        return tn_fail_memory(error);
    if (unknown < count)
        out->by[unknown] = tn_dfa_share(marked->empty); /* it stands there with nothing beside it */
    return TN_OK;
}

void tn_linear_clear(tn_linear *linear)
{
    for (uint32_t i = 0; linear->by && i < linear->count; i++)
        tn_dfa_free(linear->by[i]);
    tn_dfa_free(linear->rest);
    free(linear->by);
    *linear = (tn_linear){0};
}

bool tn_linear_has_unknowns(const tn_linear *linear)
{
    for (uint32_t i = 0; i < linear->count; i++)
        if (linear->by[i])
            return true;
    return false;
}

/* Puts what was made in the place of what was there. */
static tn_status replace(tn_status status, tn_dfa **place, tn_dfa *made)
{
    if (status == TN_OK) {
        tn_dfa_free(*place);
        *place = made;
    }
    return status;
}

static tn_status add(const tn_marked *marked, tn_dfa **to, tn_dfa *other, tn_error *error)
{
    tn_dfa *both = NULL;
    if (!other)
        return TN_OK;
    if (!*to) {
        *to = tn_dfa_share(other);
        return TN_OK;
    }
    tn_status status = tn_dfa_product(*to, other, TN_DFA_OR, "rule", marked->bounds, &both, error);
    return replace(status, to, both);
}

tn_status tn_linear_or(const tn_marked *marked, tn_linear *to, const tn_linear *other, tn_error *error)
{
    tn_status status = add(marked, &to->rest, other->rest, error);
    for (uint32_t i = 0; status == TN_OK && i < to->count; i++)
        status = add(marked, &to->by[i], other->by[i], error);
    return status;
}

static tn_status chain(const tn_marked *marked, tn_dfa **to, const tn_dfa *relation, bool before, tn_error *error)
{
    tn_dfa *made = NULL;
    if (!*to)
        return TN_OK;
    tn_status status = tn_marked_chain(marked, before ? relation : *to, before ? *to : relation, &made, error);
    return replace(status, to, made);
}

tn_status tn_linear_chain(const tn_marked *marked, tn_linear *to, const tn_dfa *relation, bool before, tn_error *error)
{
    tn_status status = chain(marked, &to->rest, relation, before, error);
    for (uint32_t i = 0; status == TN_OK && i < to->count; i++)
        status = chain(marked, &to->by[i], relation, before, error);
    return status;
}

/* ---- elimination */

/* to := to or A B (right-linear), or B A. */
static tn_status add_chain(const tn_marked *marked, tn_dfa **to, const tn_dfa *a, const tn_dfa *b, bool left,
                           tn_error *error)
{
    tn_dfa *made = NULL;
    if (!b)
        return TN_OK;
    tn_status status = tn_marked_chain(marked, left ? b : a, left ? a : b, &made, error);
    if (status == TN_OK)
        status = add(marked, to, made, error);
    tn_dfa_free(made);
    return status;
}

/* side := side or A other, for what stands beside each unknown and for the rest. */
static tn_status put_in(const tn_marked *marked, tn_linear *side, const tn_dfa *a, const tn_linear *other, bool left,
                        tn_error *error)
{
    tn_status status = add_chain(marked, &side->rest, a, other->rest, left, error);
    for (uint32_t i = 0; status == TN_OK && i < side->count; i++)
        status = add_chain(marked, &side->by[i], a, other->by[i], left, error);
    return status;
}

/* Takes what stands beside an unknown out of a side. */
static tn_dfa *take(tn_linear *side, uint32_t unknown)
{
    tn_dfa *taken = side->by[unknown];
    side->by[unknown] = NULL;
    return taken;
}

/* X = A X or C becomes X = A+ C or C. */
static tn_status solve_one(const tn_marked *marked, tn_linear *side, uint32_t unknown, bool left, tn_error *error)
{
    tn_dfa *own = take(side, unknown), *repeated = NULL;
    if (!own)
        return TN_OK;
    tn_linear before = {0};
    tn_status status = tn_marked_repeat(marked, own, 1, 0, &repeated, error);
    if (status == TN_OK)
        status = tn_linear_make(marked, side->count, TN_NO_STATE, &before, error);
    if (status == TN_OK)
        status = tn_linear_or(marked, &before, side, error);
    if (status == TN_OK)
        status = put_in(marked, side, repeated, &before, left, error);
    tn_linear_clear(&before);
    tn_dfa_free(repeated);
    tn_dfa_free(own);
    return status;
}

static tn_status keep_nonempty(const tn_marked *marked, tn_dfa **rest, tn_error *error)
{
    tn_dfa *some = NULL;
    if (!*rest)
        return TN_OK;
    tn_status status = tn_dfa_product(*rest, marked->nonempty, TN_DFA_AND, "rule", marked->bounds, &some, error);
    return replace(status, rest, some);
}

/* Solves equation i, and puts its side in the place of the unknown in all others. */
static tn_status eliminate(const tn_marked *marked, tn_linear *sides, uint32_t count, uint32_t i, bool left,
                           tn_error *error)
{
    tn_status status = solve_one(marked, &sides[i], i, left, error);
    for (uint32_t k = 0; status == TN_OK && k < count; k++) {
        tn_dfa *beside = k == i ? NULL : take(&sides[k], i);
        if (beside)
            status = put_in(marked, &sides[k], beside, &sides[i], left, error);
        tn_dfa_free(beside);
    }
    return status;
}

tn_status tn_linear_solve(const tn_marked *marked, tn_linear *sides, uint32_t count, bool left, tn_dfa **out,
                          tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        status = keep_nonempty(marked, &sides[i].rest, error);
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        status = eliminate(marked, sides, count, i, left, error);
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        out[i] = sides[i].rest;
        sides[i].rest = NULL;
        if (!out[i])
            status = tn_dfa_constant(marked->letters, false, &out[i], error);
    }
    return status;
}
