/* Remembers the scores of sentences. */
#include "runtime/genome/breeding/score_cache.h"

#include <stdlib.h>

void tn_score_cache_clear(tn_score_cache *cache)
{
    free(cache->entries);
    *cache = (tn_score_cache){0};
}

static tn_cached_score *place_of(const tn_score_cache *cache, const uint64_t hash[2])
{
    size_t place = (size_t)hash[0] & (cache->size - 1);
    while (cache->entries[place].used &&
           (cache->entries[place].hash[0] != hash[0] || cache->entries[place].hash[1] != hash[1]))
        place = (place + 1) & (cache->size - 1);
    return &cache->entries[place];
}

static bool grow(tn_score_cache *cache)
{
    if (cache->count * 2 < cache->size)
        return true;
    tn_score_cache larger = {.size = cache->size ? cache->size * 2 : 1024, .count = cache->count};
    larger.entries = calloc(larger.size, sizeof *larger.entries);
    if (!larger.entries)
        return false;
    for (size_t i = 0; i < cache->size; i++)
        if (cache->entries[i].used)
            *place_of(&larger, cache->entries[i].hash) = cache->entries[i];
    free(cache->entries);
    *cache = larger;
    return true;
}

tn_status tn_score_cache_enter(tn_score_cache *cache, const uint64_t hash[2], bool *is_new, tn_error *error)
{
    if (!grow(cache))
        return tn_fail_memory(error);
    tn_cached_score *entry = place_of(cache, hash);
    *is_new = !entry->used;
    if (entry->used)
        return TN_OK;
    *entry = (tn_cached_score){.hash = {hash[0], hash[1]}, .used = true};
    cache->count++;
    return TN_OK;
}

void tn_score_cache_put(tn_score_cache *cache, const uint64_t hash[2], const tn_score *score)
{
    place_of(cache, hash)->score = *score;
}

void tn_score_cache_get(const tn_score_cache *cache, const uint64_t hash[2], tn_score *score)
{
    *score = place_of(cache, hash)->score;
}
