/* Pictures of grown surfaces: as views of faces (runtime/scene), edges coloured by label. */
#ifndef TARTAN_GROWTH_PICTURE_DRAW_H
#define TARTAN_GROWTH_PICTURE_DRAW_H

#include "runtime/growth/growth.h"
#include "runtime/scene/view.h"

/* Takes a picture of the growth as it stands; `surrounded`, with what it grows in. E0820 if it has more than
 * TN_DRAWN_FACES_MAX faces. */
tn_status tn_growth_view(const tn_growth *growth, const tn_camera *camera, bool surrounded, tn_view **view,
                         tn_error *error);

/* Adds the growth as it stands to what is looked at, which is all zeros at first: steps over one another. Clear the
 * display list in any case. E0820 as above, of all together. */
tn_status tn_growth_display_add(const tn_growth *growth, tn_display_list *display, tn_error *error);

/* Adds what the growth grows in, around all faces that were added: attractors and repellers, gravity, boundaries, and
 * the ground. */
tn_status tn_growth_display_surround(const tn_growth *growth, tn_display_list *display, tn_error *error);

/* The names of a system's labels, for as long as it lives. */
tn_legend tn_growth_legend(const tn_growth_system *system);

#endif
