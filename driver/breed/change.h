/* What a change of a run that has begun says, beside targets and weights: how genomes vary from here on, and what
 * surfaces grow in. */
#ifndef TARTAN_DRIVER_BREED_CHANGE_H
#define TARTAN_DRIVER_BREED_CHANGE_H

#include "runtime/genome/breeding/evolve.h"
#include "runtime/growth/study.h"

/* Is it about how genomes vary ("mutation codons 0.02"), or what surfaces grow in ("gravity 0 0 -0.2")? */
bool tn_change_varies(const char *change);
bool tn_change_resizes(const char *change); /* of these: how large the population is ("population 30")? */
bool tn_change_surrounds(const char *change);

/* "mutation HOW P" or "crossover HOW P", in the words of an evolution block. TN_INVALID (E_EVOLUTION_VALUE) where it is
 * none that can be. */
tn_status tn_change_variation(const char *change, tn_vary_options *vary, tn_error *error);

/* "population N". TN_INVALID as above; whether the run can have that many, it says itself. */
tn_status tn_change_population(const char *change, uint32_t *population, tn_error *error);

/* A statement of a growth study about a force or boundary: gravity stands instead of the gravity there was; a force
 * instead of one of its kind at the same place, and with strength 0 there is none; a boundary is added. `path` is the
 * study's, whose words it is read with, and `base` its module. TN_INVALID (E_EVOLUTION_VALUE) where it is none;
 * TN_MEMORY leaves the study as it was. */
tn_status tn_change_surroundings(const char *change, const char *path, const tn_module *base, tn_study *study,
                                 tn_error *error);

/* How long the part of a change is that says what it is about: a later change with the same part stands instead of it.
 */
size_t tn_change_subject(const char *change);

#endif
