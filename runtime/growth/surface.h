/* A grown map as a mesh: vertices in order of creation; faces by their lowest (edge, side), starting there. */
#ifndef TARTAN_GROWTH_SURFACE_H
#define TARTAN_GROWTH_SURFACE_H

#include "runtime/geometry/mesh.h"
#include "runtime/growth/growth.h"

typedef struct tn_surface_options {
    bool groups; /* a face belongs to the label and age of its lowest edge, a line to its own */
    bool lines;  /* edges too */
    bool layers; /* lines are grouped by their label alone; faces are not */
} tn_surface_options;

/* Makes the mesh, which the caller clears. */
tn_status tn_surface_mesh(const tn_growth *growth, const tn_surface_options *options, tn_mesh *mesh, tn_error *error);

#endif
