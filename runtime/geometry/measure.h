/* What a closed mesh of triangles measures. */
#ifndef TARTAN_GEOMETRY_MEASURE_H
#define TARTAN_GEOMETRY_MEASURE_H

#include "runtime/geometry/mesh.h"

typedef struct tn_mesh_measures {
    uint32_t parts;       /* that no edge joins */
    uint32_t small_parts; /* whose extent is below `small` along every axis */
    double small_part[3]; /* a vertex of the first of them */
    int64_t euler;        /* vertices less edges plus faces */
    double volume, area;
    double centroid[3];   /* of the volume; zero where there is none */
    double inertia[3][3]; /* of the volume about the centroid, at a density of 1 */
    double low[3], high[3];
} tn_mesh_measures;

/* Sums go in the order of the triangles. TN_OK or TN_MEMORY. */
tn_status tn_mesh_measure(const tn_mesh *mesh, double small, tn_mesh_measures *measures, tn_error *error);

/* How thick the form is: from the middle of each triangle straight inward to where the form ends. */
typedef struct tn_thickness {
    double least;
    double hundredth; /* a hundredth of the surface, by area, is thinner */
} tn_thickness;

/* Of a closed mesh of triangles, counter-clockwise from outside. Both are 0 if it has no triangles. TN_OK or
 * TN_MEMORY. */
tn_status tn_mesh_thickness(const tn_mesh *mesh, tn_thickness *thickness, tn_error *error);

#endif
