/* Pictures of triangles in pixels, by a depth buffer: what is nearer hides what is farther, however much there is. */
#ifndef TARTAN_GEOMETRY_RENDER_H
#define TARTAN_GEOMETRY_RENDER_H

#include "runtime/geometry/mesh.h"
#include "runtime/geometry/vector.h"

/* Where a picture of a form is seen from, infinitely far away, and how it is lit. */

typedef struct tn_camera {
    double azimuth;   /* degrees about z, from the x axis; the camera looks from there */
    double elevation; /* degrees above the ground: 90 looks straight down */
    double width;     /* of a view, in points */
} tn_camera;

/* Azimuth -60, elevation 30, 480 points wide. */
tn_camera tn_camera_default(void);

/* The camera's axes: units at right angles. */
typedef struct tn_eye {
    tn_vector right, up, towards;
} tn_eye;

tn_eye tn_camera_eye(const tn_camera *camera);

/* Where a place lies before the eye: to the right, up, and towards it. */
tn_vector tn_eye_sees(const tn_eye *eye, tn_vector place);

/* How light a surface is, 0 dark to 1: by a lamp over the eye's left shoulder. Both of its sides are lit. */
double tn_eye_light(const tn_eye *eye, tn_vector normal);

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

#endif
