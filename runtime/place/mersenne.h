/* The random numbers of the published connection-grammar program: MT19937 (Matsumoto and Nishimura 1998), seeded by
 * init_genrand, 53 bits a draw. Only .pcfg grammars use it, so that a seed gives that program's models; everything else
 * in Tartan draws from runtime/base/random.h. */
#ifndef TARTAN_PLACE_MERSENNE_H
#define TARTAN_PLACE_MERSENNE_H

#include <stdint.h>

typedef struct tn_mersenne {
    uint32_t state[624];
    uint32_t next;
} tn_mersenne;

void tn_mersenne_seed(tn_mersenne *generator, uint32_t seed);

/* At least 0 and below 1. */
double tn_mersenne_draw(tn_mersenne *generator);

#endif
