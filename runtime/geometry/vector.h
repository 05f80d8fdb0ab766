/* Vectors of three doubles, for the geometry of growing surfaces. Model units, right-handed, z up. */
#ifndef TARTAN_GEOMETRY_VECTOR_H
#define TARTAN_GEOMETRY_VECTOR_H

#include <math.h>

/* As fmax and fmin of numbers, without the calls that these are where the processor's own instruction treats what is
 * no number otherwise. */
static inline double tn_larger(double a, double b)
{
    return b > a ? b : a;
}

static inline double tn_smaller(double a, double b)
{
    return b < a ? b : a;
}

typedef struct tn_vector {
    double x, y, z;
} tn_vector;

static inline tn_vector tn_vector_at(const double *p)
{
    return (tn_vector){p[0], p[1], p[2]};
}

static inline void tn_vector_put(double *p, tn_vector a)
{
    p[0] = a.x;
    p[1] = a.y;
    p[2] = a.z;
}

static inline tn_vector tn_add(tn_vector a, tn_vector b)
{
    return (tn_vector){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline tn_vector tn_sub(tn_vector a, tn_vector b)
{
    return (tn_vector){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline tn_vector tn_scale(tn_vector a, double s)
{
    return (tn_vector){a.x * s, a.y * s, a.z * s};
}

static inline double tn_dot(tn_vector a, tn_vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline tn_vector tn_cross(tn_vector a, tn_vector b)
{
    return (tn_vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double tn_norm(tn_vector a)
{
    return sqrt(tn_dot(a, a));
}

/* The unit vector along a, or zero where a has no length. */
static inline tn_vector tn_normalised(tn_vector a)
{
    double n = tn_norm(a);
    return n > 1e-300 ? tn_scale(a, 1 / n) : (tn_vector){0, 0, 0};
}

/* a + b*s */
static inline tn_vector tn_along(tn_vector a, tn_vector b, double s)
{
    return (tn_vector){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}

#endif
