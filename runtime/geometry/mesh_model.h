/* A mesh as a tree of named parts, for files that keep names.
 *
 * Node 0 is the whole; each other node stands behind its parent. A group of the mesh is the faces of one node that have
 * one material: a piece. Pieces stand in the order of their nodes, and the faces of the mesh in that of their pieces.
 * A tn_mesh_model owns its arrays and texts; zero it to begin with, and free them with tn_mesh_model_clear. */
#ifndef TARTAN_GEOMETRY_MESH_MODEL_H
#define TARTAN_GEOMETRY_MESH_MODEL_H

#include <stdio.h>

#include "runtime/geometry/mesh.h"

/* opacity: 1 of what is solid, less of glass. */
typedef struct tn_mesh_material {
    char *name;
    unsigned char rgb[3]; /* sRGB */
    double opacity;
} tn_mesh_material;

/* facts: an object of JSON that says more, or NULL. Siblings have different names. */
typedef struct tn_mesh_node {
    char *name, *facts;
    uint32_t parent; /* of node 0: itself */
} tn_mesh_node;

typedef struct tn_mesh_piece {
    uint32_t node, material;
} tn_mesh_piece;

typedef struct tn_mesh_model {
    tn_mesh_node *nodes;
    size_t node_count, node_room;
    tn_mesh_material *materials;
    size_t material_count, material_room;
    tn_mesh_piece *pieces; /* [group_count of the mesh] */
    size_t piece_count, piece_room;
    char *facts; /* of all of it: an object of JSON, or NULL */
} tn_mesh_model;

void tn_mesh_model_clear(tn_mesh_model *model);

/* A node below one that is there (of the first one, `parent` is 0); where a sibling has its name, "-2" and so on is
 * added. TN_MEMORY. */
tn_status tn_mesh_model_node(tn_mesh_model *model, uint32_t parent, const char *name, uint32_t *node, tn_error *error);

tn_status tn_mesh_model_material(tn_mesh_model *model, const char *name, const unsigned char rgb[3], double opacity,
                                 uint32_t *material, tn_error *error);

/* A piece behind all others. */
tn_status tn_mesh_model_piece(tn_mesh_model *model, tn_mesh_piece piece, tn_error *error);

/* Puts the faces of a mesh, which are triangles, in the order of their groups. TN_MEMORY. */
tn_status tn_mesh_sort_faces(tn_mesh *mesh, tn_error *error);

/* The materials as an OBJ file cites them. */
tn_status tn_mesh_write_mtl(const tn_mesh_model *model, FILE *out, tn_error *error);

#endif
