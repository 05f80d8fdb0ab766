/* Fitness expressions over what is measured of a surface: the code of a MEASURE function, run. */
#ifndef TARTAN_NUMBER_MEASURE_H
#define TARTAN_NUMBER_MEASURE_H

#include <stdint.h>

/* The value of the function whose verified code begins at `offset`; terms: what was measured, by tn_measured. Not
 * finite where the expression has none: a division by 0, the root of a negative number. */
double tn_measure_run(const uint8_t *code, uint32_t offset, const double *terms);

#endif
