/* Pictures of several meshes of triangles side by side, in pixels (draw_mesh.h draws one). */
#ifndef TARTAN_SCENE_DRAW_MESHES_H
#define TARTAN_SCENE_DRAW_MESHES_H

#include "runtime/base/picture.h"
#include "runtime/geometry/mesh.h"

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
