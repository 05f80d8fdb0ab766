/* A run of random draws that depends on (seed, what for, generation, number) alone, so that work can be shared among
 * threads in any way and be repeated at any time. */
#ifndef TARTAN_GENOME_BREEDING_CHANCE_H
#define TARTAN_GENOME_BREEDING_CHANCE_H

#include <math.h>
#include <stdbool.h>

#include "runtime/base/random.h"
#include "runtime/math/elementary.h"

typedef enum tn_purpose {
    TN_PURPOSE_INITIALISE = 1, /* number: the individual */
    TN_PURPOSE_BIRTH,          /* number: the pair of parents */
    TN_PURPOSE_SELECT,         /* number: the pair of parents */
    TN_PURPOSE_AGAIN,          /* number: the individual of the first generation or the pair, and the attempt */
} tn_purpose;

#define TN_ATTEMPTS_MAX 8u

typedef struct tn_chance {
    uint64_t seed, stream, index;
} tn_chance;

static inline tn_chance tn_chance_for(uint64_t seed, tn_purpose purpose, uint64_t generation, uint64_t number)
{
    return (tn_chance){seed, (uint64_t)purpose << 60 | (generation & 0x3FFFFFFF) << 30 | (number & 0x3FFFFFFF), 0};
}

/* Attempt 0 draws as above, later ones as many streams farther; at most TN_ATTEMPTS_MAX. */
static inline tn_chance tn_chance_again(uint64_t seed, tn_purpose purpose, uint64_t generation, uint64_t number,
                                        unsigned attempt)
{
    return attempt == 0 ? tn_chance_for(seed, purpose, generation, number)
                        : tn_chance_for(seed, TN_PURPOSE_AGAIN, generation, number * TN_ATTEMPTS_MAX + attempt - 1);
}

static inline uint64_t tn_chance_next(tn_chance *chance)
{
    return tn_random64(chance->seed, chance->stream, chance->index++);
}

/* Evenly from 0 to bound - 1; 0 if bound is 0. (The bias is under bound / 2^64.) */
static inline uint64_t tn_chance_below(tn_chance *chance, uint64_t bound)
{
    return (uint64_t)((__extension__(unsigned __int128) tn_chance_next(chance) * bound) >> 64);
}

/* Evenly from [0, 1). */
static inline double tn_chance_unit(tn_chance *chance)
{
    return (double)(tn_chance_next(chance) >> 11) * 0x1p-53;
}

static inline bool tn_chance_is(tn_chance *chance, double probability)
{
    return tn_chance_unit(chance) < probability;
}

/* Draws from the normal distribution. */

/* Of mean 0 and deviation 1, by two draws (Box and Muller, 1958). */
static inline double tn_chance_normal(tn_chance *chance)
{
    double radius = sqrt(-2 * tn_log(1 - tn_chance_unit(chance)));
    return radius * tn_cos(6.283185307179586 * tn_chance_unit(chance));
}

#endif
