/* A run of evolution as its parts see it: evolve.c moves it on, evolve_stats.c looks at it. Of no use elsewhere. */
#ifndef TARTAN_GENE_EVOLVE_STATE_H
#define TARTAN_GENE_EVOLVE_STATE_H

#include "runtime/gene/evolve.h"
#include "runtime/gene/score_cache.h"
#include "runtime/vm/crew.h"

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
};

#endif
