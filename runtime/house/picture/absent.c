/* Pictures of houses in a build without the part `draw`: there are none. */
#include "runtime/base/part.h"
#include "runtime/house/picture/draw.h"

tn_status tn_house_draw(const tn_house *house, const tn_solids *solids, const tn_house_drawing *drawing, tn_picture *to,
                        tn_error *error)
{
    (void)house, (void)solids, (void)drawing, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing a house", error);
}

tn_status tn_house_gallery_draw(const tn_house_gallery *gallery, tn_picture *to, tn_error *error)
{
    (void)gallery, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing houses", error);
}
