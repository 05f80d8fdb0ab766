/* Pictures of grown surfaces in a build without the part `draw`: there are none. */
#include "runtime/base/part.h"
#include "runtime/growth/picture/draw.h"

tn_status tn_growth_view(const tn_growth *growth, const tn_camera *camera, bool surrounded, tn_view **view,
                         tn_error *error)
{
    (void)growth, (void)camera, (void)surrounded;
    *view = NULL;
    return tn_part_absent(TN_WITH_DRAW, "drawing a surface", error);
}

tn_legend tn_growth_legend(const tn_growth_system *system)
{
    (void)system;
    return (tn_legend){0};
}

tn_status tn_growth_sight_add(const tn_growth *growth, tn_sight *sight, tn_error *error)
{
    (void)growth, (void)sight;
    return tn_part_absent(TN_WITH_DRAW, "drawing a surface", error);
}

tn_status tn_growth_sight_surround(const tn_growth *growth, tn_sight *sight, tn_error *error)
{
    (void)growth, (void)sight;
    return tn_part_absent(TN_WITH_DRAW, "drawing a surface", error);
}
