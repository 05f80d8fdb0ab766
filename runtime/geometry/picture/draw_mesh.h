/* Pictures of meshes: shaded, what is hidden left out. In pixels by a depth buffer (render.h), as vectors by painting
 * from the farthest face to the nearest (hidden.h). */
#ifndef TARTAN_GEOMETRY_PICTURE_DRAW_MESH_H
#define TARTAN_GEOMETRY_PICTURE_DRAW_MESH_H

#include "runtime/base/picture.h"
#include "runtime/base/watch.h"
#include "runtime/geometry/camera.h"
#include "runtime/geometry/mesh.h"

/* The most triangles of a vector picture. */
#define TN_DRAWN_TRIANGLES_MAX 300000u

typedef struct tn_mesh_picture {
    tn_camera camera;
    const char *title;   /* or NULL */
    const char *caption; /* a line at the foot: how it was made; or NULL */
    uint32_t dpi;        /* of a PNG; 0: 150 */
    int threads;         /* 0: all processors */
    tn_watch *watch;     /* or NULL */
} tn_mesh_picture;

/* Draws a mesh of triangles. E0820 where a vector picture would be too large; otherwise as tn_canvas_open. */
tn_status tn_mesh_draw(const tn_mesh *mesh, const tn_mesh_picture *picture, tn_picture *to, tn_error *error);

#endif
