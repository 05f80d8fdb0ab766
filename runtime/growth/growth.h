/* Growing a surface: a rewrite system, an environment and options, one derivation step after another.
 *
 * A growth borrows its system and environment and belongs to one thread at a time (it uses several inside). The same
 * inputs give the same bytes at any number of threads. After a failed step the map is not usable: grow again to the
 * last complete step (tn_growth_regrow), which costs less memory than a copy kept at hand.
 *
 * Source: "Genr8" paper, section 4.3; docs/growth.md.
 */
#ifndef TARTAN_GROWTH_GROWTH_H
#define TARTAN_GROWTH_GROWTH_H

#include "runtime/growth/environment/environment.h"
#include "runtime/growth/model/map.h"
#include "runtime/growth/model/options.h"

/* Of what the same rules grow to: larger where any surface became another. Runs keep it with their scores. 2: edges
 * that stand upright in a level surface bend away from the seed's axis. */
#define TN_GROWTH_VERSION 2u

/* The seed, ready to grow. Options are checked (TN_INVALID). */
tn_status tn_growth_new(const tn_growth_system *system, const tn_environment *environment,
                        const tn_growth_options *options, tn_growth **growth, tn_error *error);
void tn_growth_free(tn_growth *growth);

/* The seed of another growth in the memory of this one, whose map is gone: growing many surfaces one after another so
 * takes fresh memory only where one is larger than all before. After a failure it can be renewed again, or freed. */
tn_status tn_growth_renew(tn_growth *growth, const tn_growth_system *system, const tn_environment *environment,
                          const tn_growth_options *options, tn_error *error);

/* One derivation step. TN_LIMIT: more edges than the options allow, or memory than the watch does, an age beyond
 * 32,767, or a coordinate that is no longer finite; the map is then unusable. */
tn_status tn_growth_step(tn_growth *growth, tn_error *error);

/* Who waits for the steps to come; NULL: nobody. */
void tn_growth_watch(tn_growth *growth, tn_watch *watch);

/* Back to the seed, and `steps` steps. */
tn_status tn_growth_regrow(tn_growth *growth, uint32_t steps, tn_error *error);

const tn_map *tn_growth_map(const tn_growth *growth);
uint32_t tn_growth_steps(const tn_growth *growth);
const tn_growth_system *tn_growth_rules(const tn_growth *growth);
const tn_environment *tn_growth_surroundings(const tn_growth *growth);
const tn_growth_options *tn_growth_settings(const tn_growth *growth);
tn_growth_counts tn_growth_last_counts(const tn_growth *growth); /* of the last step */

/* Did the last step leave everything as it was, with nothing random in the system? Then no later step changes anything.
 */
bool tn_growth_at_rest(const tn_growth *growth);

#endif
