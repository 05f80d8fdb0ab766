/* How likely the plans of a library with weights are drawn: each in proportion to the product of its weights.
 *
 * A plan's mass is that product, as a whole number: weights are brought to one denominator. The masses of all plans lie
 * side by side on a line, and a number drawn on it means the plan whose mass it hits; so everything is exact. The
 * masses are added up over the library's automaton joined with what weights remember that look at the trays around.
 *
 * Immutable once made; borrows the library.
 */
#ifndef TARTAN_PLAN_MEASURE_LIKELIHOOD_H
#define TARTAN_PLAN_MEASURE_LIKELIHOOD_H

#include "runtime/plan/library/library.h"

typedef struct tn_likelihood tn_likelihood;

/* Of a library with a record; one without weights has each plan as likely as each. A tray that stands for n plans of
 * another library makes a plan n times as likely: so each row of plans is as likely as each, but for weights. E0802
 * where weights remember too much, E0831 where more than three of them look at the trays around, E0841 past the limit
 * on memory. */
tn_status tn_likelihood_new(const tn_library *library, tn_likelihood **likelihood, tn_error *error);
void tn_likelihood_free(tn_likelihood *likelihood);

/* The sum of the weights of the plans of one length, or (TN_ALL_LENGTHS) of all. `total` is initialised. */
void tn_likelihood_total(const tn_likelihood *likelihood, uint32_t length, mpq_t total);

/* As tn_library_sample; but each plan is drawn in proportion to its weight, those drawn before left out. Where the
 * library has no more than are wanted these are all. TN_STOPPED. */
tn_status tn_likelihood_sample(const tn_likelihood *likelihood, uint64_t seed, uint32_t length, size_t count,
                               mpz_t *ranks, size_t *found, tn_error *error);

/* The line of all masses: how long it is, and how many places on it a weight of one has. Both are initialised. */
void tn_likely_line(const tn_likelihood *likelihood, mpz_t length, mpz_t scale);

/* The plan at a place on the line of all masses, and the stretch that it has there: `begin` and `size` are initialised,
 * `trays` has room for the longest plan. TN_MEMORY. */
tn_status tn_likely_plan(const tn_likelihood *likelihood, const mpz_t place, tn_tray *trays, uint32_t *length,
                         mpz_t begin, mpz_t size, tn_error *error);

#endif
