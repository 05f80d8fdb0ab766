/* A run of evolution as its parts see it. Of no use elsewhere.
 *
 * evolve.c        moves it on, generation by generation
 * evolve_birth.c  makes genomes and their sentences
 * evolve_score.c  gives them their scores
 * evolve_stats.c  looks at it
 */
#ifndef TARTAN_GENOME_BREEDING_EVOLVE_STATE_H
#define TARTAN_GENOME_BREEDING_EVOLVE_STATE_H

#include "runtime/base/crew.h"
#include "runtime/genome/breeding/evolve.h"
#include "runtime/genome/breeding/score_cache.h"

struct tn_evolution {
    const tn_grammar *grammar;
    tn_analysis analysis;
    tn_evolution_settings settings;
    tn_evaluator evaluator;
    unsigned threads;
    tn_crew *crew;
    tn_breeder **breeders; /* by thread */
    tn_individual *all;    /* twice the population */
    tn_individual **members, **born, **pool;
    size_t member_count, born_count;
    tn_merit *merits; /* of pool, or of members */
    uint32_t *scratch;
    uint32_t *todo; /* places in born that wait for their score */
    tn_score_cache cache;
    uint32_t generation; /* of the members */
    uint32_t *chosen;    /* by a person, or NULL */
    size_t chosen_count;
    tn_recall *recall;
    void *recall_context;
    uint64_t evaluations, births;
    uint64_t *hashes; /* of the members' sentences, while distinct ones are counted */
};

/* Takes places for the next `count` to be born. */
void tn_evolution_take_places(tn_evolution *evolution, size_t count);

/* Makes all to be born, with their sentences, in pairs, by all threads. */
tn_status tn_evolution_make(tn_evolution *evolution, bool first, tn_error *error);

/* Makes the children of one pair, with their sentences. */
tn_status tn_evolution_make_pair(tn_evolution *evolution, size_t pair, tn_error *error);

/* Gives scores to individuals that have a sentence. */
tn_status tn_evolution_score(tn_evolution *evolution, tn_individual **individuals, size_t count, tn_error *error);

#endif
