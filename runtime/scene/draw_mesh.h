/* Pictures of large meshes of triangles: shaded, what is hidden left out, no edges drawn. In pixels by a depth buffer
 * (render.h), as vectors by a view (view.h). */
#ifndef TARTAN_SCENE_DRAW_MESH_H
#define TARTAN_SCENE_DRAW_MESH_H

#include "runtime/base/picture.h"
#include "runtime/geometry/mesh.h"
#include "runtime/scene/view.h"

/* The most triangles of a vector picture. */
#define TN_DRAWN_TRIANGLES_MAX 300000u

typedef struct tn_mesh_picture {
    tn_camera camera;
    const char *title;      /* or NULL */
    const double *normals;  /* of the vertices, for a PNG; NULL: the mean of the triangles' */
    const char *caption;    /* a line at the foot: how it was made; or NULL */
    uint32_t dpi;           /* of a PNG; 0: 150 */
    int threads;            /* 0: all processors */
    bool open;              /* the mesh may have rims, and is seen from behind, too */
    struct tn_watch *watch; /* or NULL */
} tn_mesh_picture;

/* Draws a mesh of triangles, a closed one unless `open`. E0820 if a vector picture would be too large; otherwise as
 * tn_canvas_open. */
tn_status tn_mesh_draw(const tn_mesh *mesh, const tn_mesh_picture *picture, tn_picture *to, tn_error *error);

/* Pictures of several meshes of triangles side by side, in pixels (draw_mesh.h draws one). */

typedef struct tn_meshes_picture {
    const char *title;         /* or NULL */
    const char *const *labels; /* below each, or NULL */
    double *const *normals;    /* of the vertices of each, or NULL: the mean of the triangles' */
    bool open;                 /* they may have rims, and are seen from behind, too */
} tn_meshes_picture;

/* Draws meshes of triangles, closed ones unless `open`, about as many rows as columns. All have one scale, but those
 * that would fill less than half of their cell are enlarged, to twice their size at most. The picture is a PNG,
 * whatever its path says: TN_INVALID (E0904) for another. */
tn_status tn_meshes_draw(const tn_mesh *const *meshes, size_t count, const tn_meshes_picture *picture, tn_picture *to,
                         tn_error *error);

#endif
