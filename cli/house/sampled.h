/* Houses drawn at random. Internal to cli/house. */
#ifndef TARTAN_CLI_HOUSE_SAMPLED_H
#define TARTAN_CLI_HOUSE_SAMPLED_H

#include "cli/house/houses.h"

/* What is done with a house that is drawn, of that rank: among all, or among those on the plan; variant: always among
 * those on its plan. It may take the house, and leaves an empty one then. */
typedef tn_status tn_sampled_house(void *context, tn_house *house, const mpz_t rank, const mpz_t variant,
                                   tn_error *error);

/* Calls `use` with `wanted` different houses of the library, or of those on one plan (NULL: all plans), each drawn with
 * the same probability, in the order of their ranks; with all where there are fewer. */
tn_status tn_numbered_sample(tn_numbered *n, const tn_plan *plan, size_t wanted, uint64_t seed, tn_sampled_house *use,
                             void *context, tn_error *error);

#endif
