/* Meshes: vertices and faces as plain arrays, and as files. */
#ifndef TARTAN_MESH_H
#define TARTAN_MESH_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A mesh owns its arrays and does not change, but by the functions that say so. */
typedef struct tartan_mesh tartan_mesh;

/* A mesh of the caller's own: positions are x, y, z of each vertex; the corners of face i, counter-clockwise seen from
 * outside, are corners[face_first[i]] up to, without it, corners[face_first[i + 1]] (face_count + 1 numbers, from 0
 * on). All is copied. TARTAN_INVALID: a face of fewer than three corners, a corner that is no vertex, a position that
 * is not finite. */
TARTAN_API tartan_status tartan_mesh_new(const double *positions, size_t vertex_count, const uint32_t *face_first,
                                         const uint32_t *corners, size_t face_count, tartan_mesh **mesh,
                                         tartan_error *error);
TARTAN_API void tartan_mesh_free(tartan_mesh *mesh);

/* Its arrays, borrowed. tartan_mesh_faces returns where each face's corners begin, as in tartan_mesh_new. Lines are
 * pairs of vertices: the edges of the rules, where they were asked for. Groups: a number below
 * tartan_mesh_group_count for each face or line, or NULL where there are none. */
TARTAN_API const double *tartan_mesh_positions(const tartan_mesh *mesh, size_t *vertex_count);
TARTAN_API const uint32_t *tartan_mesh_faces(const tartan_mesh *mesh, const uint32_t **corners, size_t *face_count);
TARTAN_API const uint32_t *tartan_mesh_lines(const tartan_mesh *mesh, size_t *line_count);
TARTAN_API const uint32_t *tartan_mesh_face_groups(const tartan_mesh *mesh);
TARTAN_API const uint32_t *tartan_mesh_line_groups(const tartan_mesh *mesh);
TARTAN_API uint32_t tartan_mesh_group_count(const tartan_mesh *mesh);
TARTAN_API const char *tartan_mesh_group_name(const tartan_mesh *mesh,
                                              uint32_t group); /* "Edge0_2"; NULL past the end */

/* Fills `normals`, x, y, z of each vertex, with unit normals weighted by area; zeros where there is none. */
TARTAN_API tartan_status tartan_mesh_normals(const tartan_mesh *mesh, double *normals, tartan_error *error);

/* ---- files */

/* Reads an OBJ, PLY, STL, OFF or OM file. */
TARTAN_API tartan_status tartan_mesh_read(const char *path, tartan_mesh **mesh, tartan_error *error);

/* Reads a mesh file, for functions whose module names one: tartan_mesh_read is of this type. */
typedef tartan_status tartan_mesh_reader(const char *path, tartan_mesh **mesh, tartan_error *error);

/* These change the mesh, which no other thread may use meanwhile; lines and groups go, but with tartan_mesh_smooth.
 * After a failure the mesh is as it was, or empty where memory ran out. Smoothing moves vertices towards their
 * neighbours, but for the outline; each round of subdividing makes four faces of one (Catmull-Clark, or Loop where all
 * faces are triangles); decimating leaves about so many triangles. */
TARTAN_API tartan_status tartan_mesh_triangulate(tartan_mesh *mesh, tartan_error *error);
TARTAN_API tartan_status tartan_mesh_smooth(tartan_mesh *mesh, uint32_t rounds, tartan_error *error);
TARTAN_API tartan_status tartan_mesh_subdivide(tartan_mesh *mesh, uint32_t rounds, tartan_error *error);
TARTAN_API tartan_status tartan_mesh_decimate(tartan_mesh *mesh, size_t faces, tartan_error *error);

typedef enum tartan_mesh_format {
    TARTAN_OBJ, /* text */
    TARTAN_PLY, /* binary, doubles */
    TARTAN_GLB, /* glTF 2.0: y up, floats, triangles; in metres where a field says what its unit is */
    TARTAN_DXF, /* lines only, release 12 */
    TARTAN_STL, /* binary, floats, triangles */
    TARTAN_OFF, /* text */
    TARTAN_OM,  /* OpenMesh's own */
} tartan_mesh_format;

typedef struct tartan_mesh_style {
    size_t size;
    const char *note; /* a comment line on how it was made, where the format has comments; or NULL */
    bool normals;     /* OBJ, PLY, GLB */
    bool y_up;        /* turns z up to y up (GLB always is) */
} tartan_mesh_style;
TARTAN_SIZED(tartan_mesh_style)

/* The mesh as a file of that format, in memory; `style` and `watch` may be NULL. The watch is told the bytes so far;
 * STL, OFF and OM, which OpenMesh writes, only end before they begin. */
TARTAN_API tartan_status tartan_mesh_write(const tartan_mesh *mesh, tartan_mesh_format format,
                                           const tartan_mesh_style *style, const tartan_watch *watch, void **bytes,
                                           size_t *size, tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
