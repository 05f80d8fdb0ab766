/* Pictures of triangles in pixels, by a depth buffer: what is nearer hides what is farther, however much there is. */
#ifndef TARTAN_GEOMETRY_RENDER_H
#define TARTAN_GEOMETRY_RENDER_H

#include "runtime/geometry/camera.h"
#include "runtime/geometry/mesh.h"

typedef struct tn_render_frame {
    uint32_t width, height; /* pixels */
    double left, top;       /* of the picture, in the eye's units: the top is the larger number */
    double pixel;           /* its side */
    bool open;              /* the mesh has rims: its triangles are seen from behind, too */
} tn_render_frame;

/* Paints a mesh of triangles, of which those that look away are hidden by the others if it is closed: image[y][x] is
 * 0xAARRGGBB, alpha already multiplied in, the first row at the top; what nothing covers is left transparent. Normals
 * of vertices are rounded over edges flatter than 40 degrees. The caller frees *image. TN_MEMORY. */
tn_status tn_mesh_render(const tn_mesh *mesh, const double *normals, const tn_eye *eye, const tn_render_frame *frame,
                         uint32_t **image, tn_error *error);

/* The colour of a surface by its light: 0 to 1 each. */
void tn_light_colour(double light, double rgb[3]);

#endif
