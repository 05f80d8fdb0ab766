/* Scores by sentence, so that no sentence is evaluated twice in a run. Sentences are known by 128 bits of hash. */
#ifndef TARTAN_GENOME_BREEDING_SCORE_CACHE_H
#define TARTAN_GENOME_BREEDING_SCORE_CACHE_H

#include "runtime/genome/breeding/evolve.h"

typedef struct tn_cached_score {
    uint64_t hash[2];
    tn_score score;
    bool used;
} tn_cached_score;

typedef struct tn_score_cache {
    tn_cached_score *entries; /* a hash table, at most half full */
    size_t size, count;
} tn_score_cache;

void tn_score_cache_clear(tn_score_cache *cache);

/* Makes a place for the sentence; *is_new where it was not there. */
tn_status tn_score_cache_enter(tn_score_cache *cache, const uint64_t hash[2], bool *is_new, tn_error *error);

/* The sentence must have been entered. */
void tn_score_cache_put(tn_score_cache *cache, const uint64_t hash[2], const tn_score *score);
void tn_score_cache_get(const tn_score_cache *cache, const uint64_t hash[2], tn_score *score);

#endif
