/* Pictures of grown surfaces in a build without the part `draw`: there are none. */
#include "runtime/base/part.h"
#include "runtime/growth/picture/draw.h"

tn_status tn_view_take(const tn_growth *growth, const tn_camera *camera, tn_view **view, tn_error *error)
{
    (void)growth, (void)camera;
    *view = NULL;
    return tn_part_absent(TN_WITH_DRAW, "drawing a surface", error);
}

void tn_view_free(tn_view *view)
{
    (void)view; /* always NULL */
}

uint32_t tn_view_by_depth(const tn_view *view)
{
    (void)view;
    return 0;
}

tn_status tn_views_draw(tn_view *const *views, size_t count, const tn_view_options *options, tn_picture *to,
                        tn_error *error)
{
    (void)views, (void)count, (void)options, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing a surface", error);
}
