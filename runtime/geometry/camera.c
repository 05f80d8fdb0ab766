/* Places cameras, and lights surfaces. */
#include "runtime/geometry/camera.h"

#include <math.h>

#include "runtime/numeric/numeric.h"

tn_camera tn_camera_default(void)
{
    return (tn_camera){-60, 30, 480};
}

tn_eye tn_camera_eye(const tn_camera *camera)
{
    double ca = tn_cos_degrees(camera->azimuth), sa = tn_sin_degrees(camera->azimuth);
    double ce = tn_cos_degrees(camera->elevation), se = tn_sin_degrees(camera->elevation);
    return (tn_eye){{-sa, ca, 0}, {-se * ca, -se * sa, ce}, {ce * ca, ce * sa, se}};
}

tn_vector tn_eye_sees(const tn_eye *eye, tn_vector place)
{
    return (tn_vector){tn_dot(place, eye->right), tn_dot(place, eye->up), tn_dot(place, eye->towards)};
}

static double light_of_lamp(const tn_eye *eye, tn_vector normal)
{
    tn_vector lamp = tn_normalised(tn_add(tn_add(eye->towards, tn_scale(eye->up, 0.9)), tn_scale(eye->right, -0.6)));
    return 0.35 + 0.65 * fmax(0, tn_dot(normal, lamp));
}

double tn_eye_light(const tn_eye *eye, tn_vector normal)
{
    return light_of_lamp(eye, tn_dot(normal, eye->towards) < 0 ? tn_scale(normal, -1) : normal);
}

double tn_eye_light_around(const tn_eye *eye, tn_vector normal)
{
    return 0.7 * light_of_lamp(eye, normal) + 0.3 * fabs(tn_dot(normal, eye->towards));
}
