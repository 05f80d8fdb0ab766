/* A polygon mesh as it goes to and from files: plain arrays.
 *
 * A tn_mesh owns its arrays; free them with tn_mesh_clear. Positions are model units, z up. Faces are counter-clockwise
 * seen from outside.
 */
#ifndef TARTAN_GEOMETRY_MESH_H
#define TARTAN_GEOMETRY_MESH_H

#include "runtime/base/error.h"

struct tn_watch; /* base/watch.h, which is no C++ */

typedef struct tn_mesh {
    double *positions; /* [vertex_count][3] */
    size_t vertex_count;
    uint32_t *face_first; /* [face_count + 1] into corners */
    uint32_t *corners;    /* vertices */
    uint32_t *face_group; /* [face_count], below group_count; NULL: no groups */
    size_t face_count;
    char (*group_names)[24]; /* [group_count] */
    uint32_t group_count;
    uint32_t *lines;      /* [line_count][2] vertices, where edges are wanted too; otherwise NULL */
    uint32_t *line_group; /* [line_count] */
    size_t line_count;
    struct tn_watch *watch; /* borrowed, or NULL: long work on it gives up (TN_STOPPED) once this says so */
} tn_mesh;

void tn_mesh_clear(tn_mesh *mesh);

/* Does its watch say that work on it is to end? TN_OK or TN_STOPPED. */
tn_status tn_mesh_check(const tn_mesh *mesh, tn_error *error);

/* Room for so many; TN_MEMORY. Groups and lines are not made. */
tn_status tn_mesh_new(size_t vertices, size_t faces, size_t corners, tn_mesh *mesh, tn_error *error);

/* A mesh of its own, the same to the last number. Clear it in any case. */
tn_status tn_mesh_copy(const tn_mesh *mesh, tn_mesh *copy, tn_error *error);

/* Newell's normal of a loop of vertices: twice its area long. */
void tn_mesh_face_normal(const tn_mesh *mesh, const uint32_t *corners, uint32_t count, double n[3]);

/* Every face in triangles, ears cut off, so that hollow faces are covered rightly. */
tn_status tn_mesh_triangulate(tn_mesh *mesh, tn_error *error);

/* Unit normals of the vertices, [vertex_count][3], weighted by area; zero where there is none. The caller frees them.
 */
tn_status tn_mesh_normals(const tn_mesh *mesh, double **normals, tn_error *error);

/* One vertex for all that lie at exactly the same place; faces that thereby lose an edge become smaller or go. */
tn_status tn_mesh_weld(tn_mesh *mesh, tn_error *error);

/* Moves each vertex whose place another has too into its own solid, against its normal, by this share of the diagonal.
 * *moved: how many. */
tn_status tn_mesh_pull_apart(tn_mesh *mesh, double share, size_t *moved, tn_error *error);

/* The colour of a group: the same for a number wherever it is drawn. */
void tn_group_colour(uint32_t group, unsigned char rgb[3]);

#endif
