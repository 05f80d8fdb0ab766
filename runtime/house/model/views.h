/* Which drawings of a house are wanted, as texts. */
#ifndef TARTAN_HOUSE_VIEWS_H
#define TARTAN_HOUSE_VIEWS_H

#include "runtime/house/model/aspect.h"

/* Texts are plan:STOREY, plan:roof (unless a storey has that name), section:x=LENGTH, section:y=LENGTH, elevation:SIDE, axonometric, or sheet: all that make a
 * sheet, as if there are none. */
typedef struct tn_views {
    const char *const *items;
    size_t count;
    const char *cut;                   /* in the axonometric view what is above this storey is lifted off; or NULL */
    bool bare;                         /* without what stands in the rooms */
    const double *azimuth, *elevation; /* of the axonometric view, in degrees; NULL: tn_house_sheet_camera */
} tn_views;

/* `aspects` has room for TN_HOUSE_VIEWS_MAX. TN_INVALID (E_USAGE) if a text is wrong. */
#define TN_HOUSE_VIEWS_MAX 128u
tn_status tn_house_views(const tn_house *house, const tn_views *views, tn_aspect *aspects, size_t *count,
                         tn_error *error);

#endif
