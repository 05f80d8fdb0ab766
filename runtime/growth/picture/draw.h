/* Pictures of grown surfaces: shaded, hidden faces removed (hidden.h), edges coloured by label. */
#ifndef TARTAN_GROWTH_PICTURE_DRAW_H
#define TARTAN_GROWTH_PICTURE_DRAW_H

#include "runtime/base/picture.h"
#include "runtime/geometry/camera.h"
#include "runtime/growth/growth.h"

#define TN_DRAWN_FACES_MAX 2000000u

/* One view: what is drawn may be thrown away afterwards. */
typedef struct tn_view tn_view;

/* Takes a picture of the growth as it stands. E0820 where it has more than TN_DRAWN_FACES_MAX faces. */
tn_status tn_view_take(const tn_growth *growth, const tn_camera *camera, tn_view **view, tn_error *error);
void tn_view_free(tn_view *view);

/* How many faces pass through one another too often to be cut (hidden.h): they are drawn by their depth, which is only
 * nearly right. */
uint32_t tn_view_by_depth(const tn_view *view);

typedef struct tn_view_options {
    const char *title;         /* or NULL */
    const char *caption;       /* a line at the foot: how it was made; or NULL */
    uint32_t columns;          /* of a sheet; 0: about as many as rows */
    const char *const *labels; /* below each view; NULL: its step, if there are several */
    uint32_t dpi;
    const tn_growth_system *system; /* names of labels, for the legend */
} tn_view_options;

/* Draws views side by side, all to one scale. */
tn_status tn_views_draw(tn_view *const *views, size_t count, const tn_view_options *options, tn_picture *to,
                        tn_error *error);

#endif
