/* Gradient noise: a smooth number at every place, 0 at the points of the whole-number lattice (docs/field-language.md).
 */
#ifndef TARTAN_NUMBER_NOISE_H
#define TARTAN_NUMBER_NOISE_H

/* Between -1.1 and 1.1; no value from a coordinate of 2^31 on. */
double tn_noise(double x, double y, double z);

/* Its derivative along the direction. */
double tn_noise_slope(double x, double y, double z, double dx, double dy, double dz);

#endif
