/* Mesh files written by us: OBJ and PLY in doubles (OpenMesh would write floats), GLB, 3MF, polyhedra for OpenSCAD, and
 * lines or faces as DXF. */
#ifndef TARTAN_GEOMETRY_WRITE_H
#define TARTAN_GEOMETRY_WRITE_H

#include <stdio.h>

#include "runtime/geometry/mesh_model.h"

/* What one unit of length is; the order of a field's units. */
typedef enum tn_mesh_unit {
    TN_MESH_UNIT_NONE,
    TN_MESH_UNIT_MM,
    TN_MESH_UNIT_CM,
    TN_MESH_UNIT_M,
    TN_MESH_UNIT_IN,
    TN_MESH_UNIT_FT,
    TN_MESH_UNIT_COUNT
} tn_mesh_unit;

typedef struct tn_mesh_style {
    const char *const *notes; /* how it was made: a comment line each, where the format has comments */
    size_t note_count;
    bool normals;
    const double *vertex_normals;      /* [vertex_count][3]; NULL: the faces' means (tn_mesh_normals) */
    bool y_up;                         /* turn z up to y up (GLB always is, 3MF never) */
    tn_mesh_unit unit;                 /* 3MF says it, GLB is made metres; others have numbers alone */
    const unsigned char (*colours)[3]; /* [group_count] of PLY, GLB and 3MF, in sRGB; NULL: tn_group_colour */
    const tn_mesh_model *model;        /* of OBJ and GLB: what its groups are; or NULL */
    const char *mtl;                   /* of OBJ with a model: the file that its materials are in */
} tn_mesh_style;

/* The colour of a group in the style. */
void tn_mesh_style_colour(const tn_mesh_style *style, uint32_t group, unsigned char rgb[3]);

/* The normals that the style asks for, or NULL. The caller frees them. TN_MEMORY. */
tn_status tn_mesh_style_normals(const tn_mesh *mesh, const tn_mesh_style *style, double **normals, tn_error *error);

/* Text; coordinates with the fewest digits that read back. Groups are `g` and lines `l`; of a model each part is `o`,
 * with the names on the way to it as `g`, and materials are `usemtl`. */
tn_status tn_mesh_write_obj(const tn_mesh *mesh, const tn_mesh_style *style, FILE *out, tn_error *error);

/* Binary, little-endian, doubles; faces have a colour where there are groups, lines are the element `edge`. */
tn_status tn_mesh_write_ply(const tn_mesh *mesh, const tn_mesh_style *style, FILE *out, tn_error *error);

/* glTF 2.0 in one file: metres (one where there is no unit) and y up by its specification, floats; faces are triangles;
 * a primitive and a material for each group. Of a model, a node for each of its own, with arrays of its own. */
tn_status tn_mesh_write_glb(const tn_mesh *mesh, const tn_mesh_style *style, FILE *out, tn_error *error);

/* 3MF: millimetres where there is no unit; one object, or, where the style has no colours, one for each group of faces.
 * Faces are triangles. TN_LIMIT (E0804) from 4 GB on. */
tn_status tn_mesh_write_3mf(const tn_mesh *mesh, const tn_mesh_style *style, FILE *out, tn_error *error);

/* DXF, release 12, a layer for each group. A mesh with lines: these as polylines; where exactly two lines of a layer
 * meet they are one polyline, so that an outline is one closed line. Level ones are plane, others are in space. A mesh
 * without lines: its faces, which are triangles, and of their edges those are seen at which it bends. */
tn_status tn_mesh_write_dxf(const tn_mesh *mesh, const tn_mesh_style *style, FILE *out, tn_error *error);

/* OpenSCAD: a union of polyhedra, one for each group. The faces of a group follow one another, and its vertices are its
 * own and follow one another too. */
tn_status tn_mesh_write_scad(const tn_mesh *mesh, const tn_mesh_style *style, FILE *out, tn_error *error);

#endif
