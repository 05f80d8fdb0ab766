/* What a surface grows in: forces that pull and push its vertices, and boundaries that they may not (or should not)
 * pass.
 *
 * An environment borrows its boundary meshes; it is read-only while surfaces grow in it and may be shared between
 * threads. Lengths are model units. Source: "Genr8" paper, section 4.7; docs/growth.md.
 */
#ifndef TARTAN_GROWTH_ENVIRONMENT_ENVIRONMENT_H
#define TARTAN_GROWTH_ENVIRONMENT_ENVIRONMENT_H

#include "runtime/base/error.h"
#include "runtime/geometry/boundary_mesh.h"
#include "runtime/geometry/guide/guide.h"
#include "runtime/geometry/vector.h"
#include "runtime/growth/model/system.h"

typedef struct tn_force {
    uint32_t kind;   /* tn_force_kind */
    double at[3];    /* its place; gravity: the displacement of each step */
    double strength; /* the displacement of a vertex one unit away */
    double exponent; /* strength / distance^exponent */
} tn_force;

typedef struct tn_boundary {
    uint32_t kind, mode; /* tn_boundary_kind, tn_boundary_mode */
    bool inside; /* the surface is to stay inside it; otherwise outside. A plane's allowed side is the one its normal
                    points to */
    double a[3]; /* plane: a point; box: the low corner; sphere: the centre */
    double b[3]; /* plane: the unit normal; box: the high corner */
    double radius;
    const tn_boundary_mesh *mesh;
} tn_boundary;

typedef struct tn_environment {
    const tn_force *forces;
    uint32_t force_count;
    const tn_boundary *boundaries;
    uint32_t boundary_count;
} tn_environment;

/* The displacement that all forces give a vertex at x, in the order in which they are listed. */
tn_vector tn_environment_force(const tn_environment *environment, tn_vector x);

/* Where a vertex at x that is displaced by d ends. */
tn_vector tn_environment_move(const tn_environment *environment, tn_vector x, tn_vector d);

/* The point, or where it lies inside an obstacle, the nearest allowed one (each boundary in turn; soft ones do
 * nothing). */
tn_vector tn_environment_project(const tn_environment *environment, tn_vector x);

/* The same for a new vertex on an edge between two others: it does not lie across a membrane from both of them either.
 */
tn_vector tn_environment_place(const tn_environment *environment, tn_vector p, tn_vector from, tn_vector to);

/* Is x on the wrong side of a soft boundary, by more than 1e-9? */
bool tn_environment_trespasses(const tn_environment *environment, tn_vector x);

/* Does any boundary change how vertices move? Any soft one? */
bool tn_environment_has_hard(const tn_environment *environment);
bool tn_environment_has_soft(const tn_environment *environment);

/* What a surface grows in, as guides for a picture of it: forces at their places, gravity as an arrow, boundaries as
 * outlines, and the ground, which is the level of the lowest vertex. */

/* Adds them around a surface whose vertices lie between `low` and `high`. A force that is farther from it than it is
 * large is shown as an arrow that points there; of a plane, the part near the surface is shown. TN_MEMORY. */
tn_status tn_surroundings_guides(const tn_environment *environment, const double low[3], const double high[3],
                                 tn_guides *guides, tn_error *error);

#endif
