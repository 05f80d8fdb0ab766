/* Counter-based randomness: a value depends on (seed, stream, index) alone, so a result never depends
 * on how many threads computed it or in what order. */
#ifndef TARTAN_BASE_RANDOM_H
#define TARTAN_BASE_RANDOM_H

#include <stdint.h>

/* The mixing function of splitmix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014). */
static inline uint64_t tn_mix64(uint64_t x)
{
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/* 64 random bits. */
static inline uint64_t tn_random64(uint64_t seed, uint64_t stream, uint64_t index)
{
    return tn_mix64(tn_mix64(tn_mix64(seed) ^ stream) ^ index);
}

#endif
