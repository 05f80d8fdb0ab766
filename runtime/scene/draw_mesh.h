/* Pictures of large meshes of triangles: shaded, what is hidden left out, no edges drawn. In pixels by a depth buffer
 * (render.h), as vectors by a view (view.h). */
#ifndef TARTAN_SCENE_DRAW_MESH_H
#define TARTAN_SCENE_DRAW_MESH_H

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

/* Draws a mesh of triangles, a closed one unless `open`. E0820 where a vector picture would be too large; otherwise as
 * tn_canvas_open. */
tn_status tn_mesh_draw(const tn_mesh *mesh, const tn_mesh_picture *picture, tn_picture *to, tn_error *error);

#endif
