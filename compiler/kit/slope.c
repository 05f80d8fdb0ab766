/* Boxes of parts of which a corner is cut off: the cells that are left, in steps. */
#include <strings.h>

#include "compiler/kit/kit.h"

/* Makes the box shorter by so many cells on the side where the axis points. */
static void shorten(tn_kit_box *box, tn_axis axis, int32_t by)
{
    int k = tn_axis_coordinate(axis);
    if (tn_axis_falls(axis))
        box->low[k] += by;
    else
        box->high[k] -= by;
}

static int32_t length_along(const tn_kit_box *box, tn_axis axis)
{
    int k = tn_axis_coordinate(axis);
    return box->high[k] - box->low[k];
}

/* How many cells are lost of the row at a distance from the face across `row`: those of which half or more is beyond
 * the cut, which goes from corner to corner. */
static int32_t lost(int64_t along, int64_t rows, int64_t row)
{
    int64_t count = (2 * rows - 2 * row - 1) * along; /* how far the cut is, in half cells, times the rows */
    return (int32_t)((count + rows) / (2 * rows));
}

/* The cells of a slope as boxes, row by row along the shorter side that is cut; equal rows are one box. */
static void add_steps(tn_kit_part *part, const tn_kit_box *whole, tn_axis row_axis, tn_axis lost_axis)
{
    int32_t rows = length_along(whole, row_axis), along = length_along(whole, lost_axis), before = -1;
    for (int32_t row = rows - 1; row >= 0; row--) {
        int32_t gone = lost(along, rows, row);
        if (gone == before) {
            shorten(&part->boxes[part->box_count - 1], row_axis, -1);
            continue;
        }
        if (gone == along)
            return;
        tn_kit_box *box = &part->boxes[part->box_count++];
        *box = *whole;
        shorten(box, row_axis, row);
        shorten(box, tn_axis_opposite(row_axis), rows - 1 - row);
        shorten(box, lost_axis, gone);
        before = gone;
    }
}

static bool check(tn_kit *kit, const tn_kit_node *node, const tn_kit_slope *slope, int32_t rows, int32_t along)
{
    tn_diagnostic *d;
    if (tn_axis_coordinate(slope->sides[0]) == tn_axis_coordinate(slope->sides[1])) {
        d = tn_report(kit->diagnostics, E_KIT_SLOPE, node->other.span, "`%s` and `%s` have no corner between them",
                      node->name.text, node->other.text);
        tn_help(kit->diagnostics, d, "a slope lies between sides that meet: `slope up front`");
        return false;
    }
    if (rows > TN_KIT_SLOPE_STEPS_MAX) {
        d = tn_report(kit->diagnostics, E_KIT_SLOPE, node->span, "this slope has %d steps of cells, and %d are the most",
                      rows, TN_KIT_SLOPE_STEPS_MAX);
        tn_help(kit->diagnostics, d, "use a kit with larger cells, or a smaller slope");
        return false;
    }
    if (along == 1 && rows == 1) {
        d = tn_report(kit->diagnostics, E_KIT_SLOPE, node->span, "this slope fills no cell");
        tn_help(kit->diagnostics, d, "of a single cell only half is left: use a kit with smaller cells, or `fill`");
        return false;
    }
    return true;
}

static bool is_slope(tn_kit *kit, const tn_kit_text *word)
{
    if (strcasecmp(word->text, "slope") == 0)
        return true;
    tn_diagnostic *d =
        tn_report(kit->diagnostics, E_KIT_SLOPE, word->span, "`%.100s` is nothing that a part has", word->text);
    tn_help(kit->diagnostics, d, "boxes are `fill 20 x 24 x 20;` and slopes `slope up front 20 x 24 x 20;`");
    return false;
}

void tn_kit_add_slope(tn_kit *kit, tn_kit_part *part, const tn_kit_node *node, const tn_kit_box *whole)
{
    if (!is_slope(kit, &node->doc))
        return;
    tn_kit_slope slope = {.whole = *whole, .first = part->box_count};
    bool right = tn_kit_axis(kit, &node->name, &slope.sides[0]) && tn_kit_axis(kit, &node->other, &slope.sides[1]);
    if (!right)
        return;
    int32_t sizes[2] = {length_along(whole, slope.sides[0]), length_along(whole, slope.sides[1])};
    int rows = sizes[0] < sizes[1] ? 0 : 1;
    if (!check(kit, node, &slope, sizes[rows], sizes[!rows]))
        return;
    add_steps(part, whole, slope.sides[rows], slope.sides[!rows]);
    slope.count = part->box_count - slope.first;
    part->slopes[part->slope_count++] = slope;
}
