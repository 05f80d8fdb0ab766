/* Charts in a build without the part `draw`: there are none. */
#include "runtime/base/part.h"
#include "runtime/chart/chart.h"

tn_status tn_histogram_draw(const tn_histogram *histogram, tn_picture *to, tn_error *error)
{
    (void)histogram, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing a histogram", error);
}

tn_status tn_front_draw(const tn_front_drawing *drawing, tn_picture *to, tn_error *error)
{
    (void)drawing, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing a front", error);
}
