/* Puts the values of a distribution into bins. */
#include "runtime/plan/measure/bins.h"

#include "runtime/number/rational.h"

void tn_bins_init(tn_bins *bins, const tn_distribution *d, tn_amount_unit unit)
{
    *bins = (tn_bins){.d = d, .unit = unit};
    mpq_init(bins->step);
}

void tn_bins_clear(tn_bins *bins)
{
    mpq_clear(bins->step);
}

void tn_bins_value(const tn_bins *bins, size_t i, mpq_t value)
{
    tn_distribution_value(bins->d, i, value);
    tn_amount_convert(bins->unit, value);
}

/* The bin that value i lies in: floor(value / step). */
static void bin_of(const tn_bins *p, size_t i, mpz_t bin)
{
    mpq_t value;
    mpq_init(value);
    tn_bins_value(p, i, value);
    mpq_div(value, value, p->step);
    mpz_fdiv_q(bin, mpq_numref(value), mpq_denref(value));
    mpq_clear(value);
}

static void count_bins(const tn_bins *p, mpz_t bins)
{
    mpz_t first;
    mpz_init(first);
    bin_of(p, 0, first);
    bin_of(p, p->d->count - 1, bins);
    mpz_sub(bins, bins, first);
    mpz_add_ui(bins, bins, 1);
    mpz_clear(first);
}

bool tn_bins_at_most(const tn_bins *p, uint64_t most)
{
    mpz_t count;
    mpz_init(count);
    count_bins(p, count);
    bool good = mpz_cmp_ui(count, most) <= 0;
    mpz_clear(count);
    return good;
}

void tn_bins_few(tn_bins *p, uint64_t most)
{
    static const unsigned factors[] = {1, 2, 5};
    mpq_t ten;
    mpq_init(ten);
    for (int power = -12, done = 0; power < 300 && !done; power++) {
        for (size_t f = 0; f < 3 && !done; f++) {
            mpq_set_ui(ten, 10, 1);
            tn_rational_power(p->step, ten, power);
            mpq_set_ui(ten, factors[f], 1);
            mpq_mul(p->step, p->step, ten);
            done = tn_bins_at_most(p, most);
        }
    }
    mpq_clear(ten);
    p->binned = true;
}

void tn_bin_row_init(const tn_bins *p, tn_bin_row *r)
{
    mpq_inits(r->from, r->to, NULL);
    mpz_inits(r->plans, r->bin, NULL);
    r->next = 0;
    if (p->binned)
        bin_of(p, 0, r->bin);
}

bool tn_bin_row_next(const tn_bins *p, tn_bin_row *r)
{
    if (r->next == p->d->count)
        return false;
    mpz_set_ui(r->plans, 0);
    if (!p->binned) {
        tn_bins_value(p, r->next, r->from);
        mpq_set(r->to, r->from);
        mpz_set(r->plans, p->d->plans[r->next++]);
        return true;
    }
    mpz_t bin;
    mpz_init(bin);
    mpq_set_z(r->from, r->bin);
    mpq_mul(r->from, r->from, p->step);
    mpq_add(r->to, r->from, p->step);
    for (; r->next < p->d->count; r->next++) {
        bin_of(p, r->next, bin);
        if (mpz_cmp(bin, r->bin) != 0)
            break;
        mpz_add(r->plans, r->plans, p->d->plans[r->next]);
    }
    mpz_add_ui(r->bin, r->bin, 1);
    mpz_clear(bin);
    return true;
}

void tn_bin_row_clear(tn_bin_row *r)
{
    mpq_clears(r->from, r->to, NULL);
    mpz_clears(r->plans, r->bin, NULL);
}

double tn_bins_share(const mpz_t part, const mpz_t all)
{
    if (mpz_sgn(all) == 0)
        return 0;
    mpq_t share;
    mpq_init(share);
    mpq_set_num(share, part);
    mpq_set_den(share, all);
    mpq_canonicalize(share);
    double number = mpq_get_d(share);
    mpq_clear(share);
    return number;
}
