/* Draws from the normal distribution. */
#ifndef TARTAN_GENOME_BREEDING_NORMAL_H
#define TARTAN_GENOME_BREEDING_NORMAL_H

#include <math.h>

#include "runtime/genome/breeding/chance.h"
#include "runtime/numeric/numeric.h"

/* Of mean 0 and deviation 1, by two draws (Box and Muller, 1958). */
static inline double tn_chance_normal(tn_chance *chance)
{
    double radius = sqrt(-2 * tn_log(1 - tn_chance_unit(chance)));
    return radius * tn_cos(6.283185307179586 * tn_chance_unit(chance));
}

#endif
