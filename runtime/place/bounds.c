/* The shells of bounds, filled cell by cell as the published program fills them. */
#include "runtime/place/bounds.h"

#include <math.h>

/* The shell's coordinates run from -size - 1 to size on each axis; a cell is of it where one of them is at an end. A
 * negative size leaves no room, and nothing is filled where the range is empty. */
tn_status tn_bound_box(tn_cells *cells, const tn_frame *frame, const tn_step *step, tn_error *error)
{
    tn_cell_box whole;
    for (int k = 0; k < 3; k++) {
        whole.low[k] = frame->at[k] - step->a[k] - 1;
        whole.high[k] = frame->at[k] + step->a[k] + 1;
    }
    for (int k = 0; k < 3; k++) {
        for (int side = 0; side < 2; side++) {
            tn_cell_box slab = whole;
            if (side == 0)
                slab.high[k] = slab.low[k] + 1;
            else
                slab.low[k] = slab.high[k] - 1;
            bool empty = whole.low[k] >= whole.high[k];
            tn_status status = empty ? TN_OK : tn_cells_fill(cells, &slab, error);
            if (status != TN_OK)
                return status;
        }
    }
    return TN_OK;
}

/* The largest whole number whose square is at most `square`; -1 where that is negative. */
static int64_t root_below(int64_t square)
{
    if (square < 0)
        return -1;
    int64_t root = (int64_t)sqrt((double)square);
    while (root * root > square)
        root--;
    while ((root + 1) * (root + 1) <= square)
        root++;
    return root;
}

/* Fills the cells x of a row with low <= x < high. */
static tn_status fill_row(tn_cells *cells, int64_t low, int64_t high, int32_t y, int32_t z, tn_error *error)
{
    tn_cell_box row = {{(int32_t)low, y, z}, {(int32_t)high, y + 1, z + 1}};
    return low < high ? tn_cells_fill(cells, &row, error) : TN_OK;
}

/* Cells x, y, z in [-r, r - 1] with (r - 1)^2 < x^2 + y^2 + z^2 <= r^2: of a row along x, what lies within the outer
 * ball less what lies within the inner one. */
tn_status tn_bound_ball(tn_cells *cells, int32_t radius, tn_error *error)
{
    int64_t r = radius, outer_square = r * r, inner_square = (r - 1) * (r - 1);
    for (int64_t y = -r; y < r; y++) {
        int64_t z_reach = root_below(outer_square - y * y);
        for (int64_t z = -z_reach; z <= z_reach && z < r; z++) {
            int64_t outer = root_below(outer_square - y * y - z * z), inner = root_below(inner_square - y * y - z * z);
            int64_t high = outer + 1 < r ? outer + 1 : r, low = -outer > -r ? -outer : -r;
            tn_status status;
            if (inner < 0) {
                status = fill_row(cells, low, high, (int32_t)y, (int32_t)z, error);
            } else {
                status = fill_row(cells, low, -inner, (int32_t)y, (int32_t)z, error);
                if (status == TN_OK)
                    status = fill_row(cells, inner + 1, high, (int32_t)y, (int32_t)z, error);
            }
            if (status != TN_OK)
                return status;
        }
    }
    return TN_OK;
}
