/* Compares two libraries of houses in the same form, of which one has all clauses of the other: no house is gone
 * through. What a clause more keeps out is a library, too: with the clauses of both, and this one turned round. */
#include "ask/house/compared.h"

#include <stdlib.h>

#include "runtime/base/integers.h"

static void add_all(mpz_t sum, const tn_compared_houses *c, mpz_t *counts)
{
    for (uint32_t i = 0; i <= c->high - c->low; i++)
        mpz_add(sum, sum, counts[i]);
}

/* How many houses a library has, by length where lengths is not NULL. */
static tn_status count_all(const tn_compared_houses *c, tn_numbered *n, mpz_t *lengths, mpz_t sum, tn_error *error)
{
    mpz_t *own = lengths ? lengths : tn_integers_new((size_t)c->high - c->low + 1);
    tn_status status = own ? tn_numbered_lengths(n, c->low, c->high, own, error) : tn_fail_memory(error);
    mpz_set_ui(sum, 0);
    if (status == TN_OK)
        add_all(sum, c, own);
    if (!lengths)
        tn_integers_free(own, (size_t)c->high - c->low + 1);
    return status;
}

/* ---- clauses */

/* The clauses that both libraries have, and then one more of the strict side, turned round. */
static uint32_t gather_clauses(const tn_compared_side *side, uint32_t turned, tn_house_clause_record *clauses)
{
    const tn_house_clause_record *all = side->n.form.module->HOUSE_CLAUSE_records + side->n.record->clause_first;
    uint32_t count = 0;
    for (uint32_t i = 0; i < side->n.record->clause_count; i++)
        if (side->partner[i] != TN_NO_RECORD)
            clauses[count++] = all[i];
    clauses[count] = all[turned];
    clauses[count].kind = all[turned].kind == TN_CLAUSE_PRUNE ? TN_CLAUSE_REQUIRE : TN_CLAUSE_PRUNE;
    return count + 1;
}

static tn_status count_clause(const tn_compared_houses *c, int strict, tn_house_edit *edit,
                              const tn_compared_options *options, tn_error *error)
{
    const tn_compared_side *side = &c->sides[strict];
    tn_house_clause_record *clauses = malloc(((size_t)side->n.record->clause_count + 1) * sizeof *clauses);
    tn_other_clauses other;
    tn_numbered kept_out = {0};
    int which = strict == 1 ? 0 : 1;
    if (!clauses)
        return tn_fail_memory(error);
    tn_other_clauses_set(&side->n.form, side->n.record, clauses, gather_clauses(side, edit->clause[strict], clauses),
                         &other);
    tn_numbered_other(&side->n, &other.module, &other.library, tn_library_diff_part(c->plans, TN_DIFF_KEPT), &kept_out);
    tn_status status = count_all(c, &kept_out, NULL, edit->houses[which], error);
    if (status == TN_OK)
        status = tn_edit_sample(edit, which, &kept_out, options, error);
    tn_numbered_other_close(&kept_out);
    free(clauses);
    return status;
}

/* ---- plans */

tn_status tn_compared_own_plans(const tn_compared_houses *c, int which, tn_house_edit *edit,
                                const tn_compared_options *options, tn_error *error)
{
    const tn_numbered *n = &c->sides[which].n;
    tn_numbered own = {0};
    tn_numbered_other(n, n->form.module, n->record,
                      tn_library_diff_part(c->plans, which ? TN_DIFF_ADDED : TN_DIFF_REMOVED), &own);
    tn_status status = count_all(c, &own, NULL, edit->houses[which], error);
    if (status == TN_OK)
        status = tn_edit_sample(edit, which, &own, options, error);
    tn_numbered_other_close(&own);
    return status;
}

/* What the strict side has on the plans of both is what both have. */
static tn_status count_kept(tn_compared_houses *c, int strict, tn_error *error)
{
    const tn_numbered *n = &c->sides[strict].n;
    tn_numbered both = {0};
    mpz_t sum;
    mpz_init(sum);
    tn_numbered_other(n, n->form.module, n->record, tn_library_diff_part(c->plans, TN_DIFF_KEPT), &both);
    tn_status status = count_all(c, &both, c->kept, sum, error);
    tn_numbered_other_close(&both);
    mpz_clear(sum);
    return status;
}

tn_status tn_compare_together(tn_compared_houses *c, int strict, const tn_compared_options *options, tn_error *error)
{
    tn_house_edit *plans = tn_compared_edit(c, "plans");
    tn_status status = count_kept(c, strict, error);
    for (int which = 0; status == TN_OK && plans && which < 2; which++)
        status = tn_compared_own_plans(c, which, plans, options, error);
    for (size_t i = 0; status == TN_OK && i < c->edit_count; i++)
        if (c->edits[i].clause[strict] != TN_NO_RECORD)
            status = count_clause(c, strict, &c->edits[i], options, error);
    return status;
}
