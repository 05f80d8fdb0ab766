#include "runtime/plan/ways/projected.h"

#include <stdlib.h>

#include "runtime/base/integers.h"
#include "runtime/plan/match/lower.h"

/* ---- letters */

/* How many newer trays of each column lie above a tray, as pairs; counts: [columns], all 0 before and after. */
static bool count_above(const tn_projected *p, tn_tray tray, uint32_t *counts, tn_key *pairs)
{
    const tn_projection *projection = p->projection;
    bool ok = true;
    pairs->size = 0;
    for (tn_tray t = projection->begin[tray]; t < projection->end[tray]; t++)
        counts[p->plans->column[p->newer->of_tray[t]]]++;
    for (uint32_t c = 0; c < p->plans->columns; c++) {
        if (counts[c] > 0)
            ok = ok && tn_key_push(pairs, c) && tn_key_push(pairs, counts[c]);
        counts[c] = 0;
    }
    return ok;
}

/* Numbers what lies above each tray, of[tray]. */
static tn_status number_trays(tn_projected *p, uint32_t *of, tn_error *error)
{
    uint32_t *counts = calloc((size_t)p->plans->columns + 1, sizeof *counts);
    tn_key pairs = {0};
    bool ok = counts != NULL;
    for (tn_tray t = 0; ok && t < p->projection->schema->tray_count; t++) {
        ok = count_above(p, t, counts, &pairs);
        of[t] = ok ? tn_intern(&p->above, pairs.data, pairs.size) : UINT32_MAX;
        ok = of[t] != UINT32_MAX;
    }
    free(pairs.data);
    free(counts);
    return ok ? TN_OK : tn_fail_memory(error);
}

static tn_status make_letters(tn_projected *p, const tn_classes *classes, tn_error *error)
{
    const tn_schema *schema = p->projection->schema;
    uint32_t *of = calloc((size_t)schema->tray_count + 1, sizeof *of);
    const tn_classes numbers = {.schema = schema, .of_tray = of};
    tn_status status = of ? number_trays(p, of, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_classes_new(schema, NULL, 0, &p->letters, error);
    if (status == TN_OK)
        status = tn_classes_refine(p->letters, &numbers, error);
    if (status == TN_OK && classes)
        status = tn_classes_refine(p->letters, classes, error);
    if (status == TN_OK && !(p->above_of = calloc((size_t)p->letters->count + 1, sizeof *p->above_of)))
        status = tn_fail_memory(error);
    for (uint32_t l = 0; status == TN_OK && l < p->letters->count; l++)
        p->above_of[l] = of[p->letters->representative[l]];
    free(of);
    return status;
}

tn_status tn_projected_new(const tn_schema *schema, const tn_instruction *image, const tn_classes *classes,
                           uint32_t max_states, uint32_t longest, tn_projected **out, tn_error *error)
{
    tn_projected *p = calloc(1, sizeof *p);
    if (!p)
        return tn_fail_memory(error);
    tn_status status = tn_projection_new(schema, image, &p->projection, error);
    if (status == TN_OK)
        status = tn_classes_above(p->projection, &p->newer, error);
    if (status == TN_OK)
        status = tn_lower_above(p->projection, p->newer, max_states, longest, &p->plans, error);
    if (status == TN_OK)
        status = make_letters(p, classes, error);
    if (status != TN_OK) {
        tn_projected_free(p);
        return status;
    }
    *out = p;
    return TN_OK;
}

void tn_projected_free(tn_projected *p)
{
    if (!p)
        return;
    tn_interner_clear(&p->above);
    free(p->above_of);
    tn_classes_free(p->letters);
    tn_sparse_free(p->plans);
    tn_classes_free(p->newer);
    tn_projection_free(p->projection);
    free(p);
}

/* ---- one plan */

/* next[state]: in how many ways it is reached by one tray more. */
static void step(const tn_projected *p, tn_tray tray, mpz_t *ways, mpz_t *next, uint32_t *counts)
{
    const tn_sparse *plans = p->plans;
    size_t size;
    const uint32_t *pairs = tn_interned(&p->above, p->above_of[p->letters->of_tray[tray]], &size);
    for (size_t i = 0; i < size; i += 2)
        counts[pairs[i]] = pairs[i + 1];
    for (uint32_t s = 0; s < plans->states; s++)
        for (size_t e = plans->first[s]; e < plans->first[s + 1] && mpz_sgn(ways[s]) > 0; e++)
            mpz_addmul_ui(next[plans->target[e]], ways[s], counts[plans->label[e]]);
    for (size_t i = 0; i < size; i += 2)
        counts[pairs[i]] = 0;
    for (uint32_t s = 0; s < plans->states; s++)
        mpz_set_ui(ways[s], 0);
}

tn_status tn_projected_ways(const tn_projected *p, const tn_tray *trays, size_t length, mpz_t ways, tn_error *error)
{
    uint32_t states = p->plans->states;
    mpz_t *now = tn_integers_new((size_t)states + 1), *next = tn_integers_new((size_t)states + 1);
    uint32_t *counts = calloc((size_t)p->plans->columns + 1, sizeof *counts);
    tn_status status = now && next && counts ? TN_OK : tn_fail_memory(error);
    mpz_set_ui(ways, 0);
    if (status == TN_OK)
        mpz_set_ui(now[0], 1);
    for (size_t i = 0; status == TN_OK && i < length; i++) {
        step(p, trays[i], now, next, counts);
        mpz_t *swap = now;
        now = next;
        next = swap;
    }
    for (uint32_t s = 0; status == TN_OK && s < states; s++)
        if (p->plans->accept[s])
            mpz_add(ways, ways, now[s]);
    free(counts);
    tn_integers_free(now, (size_t)states + 1);
    tn_integers_free(next, (size_t)states + 1);
    return status;
}
