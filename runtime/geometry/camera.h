/* Where a picture of a form is seen from, infinitely far away, and how it is lit. */
#ifndef TARTAN_GEOMETRY_CAMERA_H
#define TARTAN_GEOMETRY_CAMERA_H

#include "runtime/geometry/vector.h"

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

/* The same for smooth forms, which turn away from the lamp: some of the light comes from the eye, and only the side
 * that the normal points to is lit. */
double tn_eye_light_around(const tn_eye *eye, tn_vector normal);

#endif
