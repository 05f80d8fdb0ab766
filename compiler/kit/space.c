/* Spaces of kits as conditions on a place: shapes become comparisons of x, y and z. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/kit/kit.h"

enum { SHAPES_MAX = 20000, REPEATED_MAX = 1000 };

static tn_expression *number(tn_kit *kit, tn_span span, double value)
{
    return tn_expression_number(kit->arena, span, value);
}

static tn_expression *of(tn_kit *kit, tn_opcode op, tn_span span, tn_expression *a, tn_expression *b)
{
    return a ? tn_expression_of(kit->arena, op, span, a, b, NULL) : NULL;
}

static tn_expression *coordinate(tn_kit *kit, tn_span span, int axis)
{
    static const char *const names[] = {"x", "y", "z"};
    tn_expression *e = tn_expression_name(kit->arena, span, names[axis]);
    if (e)
        e->term = TN_PLACED_X + (uint32_t)axis;
    return e;
}

static tn_expression *between(tn_kit *kit, tn_span span, int axis, double low, double high)
{
    return tn_expression_of(kit->arena, TN_OP_IS_BETWEEN, span, coordinate(kit, span, axis), number(kit, span, low),
                            number(kit, span, high));
}

static tn_expression *square(tn_kit *kit, tn_span span, int axis, double centre)
{
    tn_expression *a = of(kit, TN_OP_SUBTRACT, span, coordinate(kit, span, axis), number(kit, span, centre));
    tn_expression *b = of(kit, TN_OP_SUBTRACT, span, coordinate(kit, span, axis), number(kit, span, centre));
    return of(kit, TN_OP_MULTIPLY, span, a, b);
}

/* Within a radius of the middle of a shape, along two axes or three. */
static tn_expression *within(tn_kit *kit, tn_span span, const double centre[3], double radius, bool round)
{
    tn_expression *sum = of(kit, TN_OP_ADD, span, square(kit, span, 0, centre[0]), square(kit, span, 2, centre[2]));
    if (round)
        sum = of(kit, TN_OP_ADD, span, sum, square(kit, span, 1, centre[1]));
    return of(kit, TN_OP_IS_AT_MOST, span, sum, number(kit, span, radius * radius));
}

static const struct {
    const char *name;
    tn_kit_extents extents;
} shapes[] = {{"box", {{"width", "height", "depth"}, 3, "box(16 studs, 8 bricks, 1 stud): width, height and depth"}},
              {"sphere", {{"radius"}, 1, "sphere(8 studs): the radius"}},
              {"cylinder", {{"radius", "height"}, 2, "cylinder(6 studs, 8 bricks): radius and height"}}};
enum { BOX, SPHERE, CYLINDER, SHAPE_COUNT };

static int find_shape(tn_kit *kit, const tn_kit_node *node)
{
    static const char *const filed[] = {"mesh", "heightmap"};
    const char *names[SHAPE_COUNT];
    for (int i = 0; i < SHAPE_COUNT; i++) {
        names[i] = shapes[i].name;
        if (strcmp(shapes[i].name, node->name.text) == 0)
            return i;
    }
    for (size_t i = 0; i < sizeof filed / sizeof *filed; i++) {
        if (strcmp(filed[i], node->name.text) != 0)
            continue;
        tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_SPACE, node->span, "`%s` takes a file first", filed[i]);
        tn_help(kit->diagnostics, d, "as mesh(\"statue.stl\", 20 bricks)");
        return SHAPE_COUNT;
    }
    tn_diagnostic *d =
        tn_report(kit->diagnostics, E_KIT_UNKNOWN, node->name.span, "there is no shape `%.100s`", node->name.text);
    const char *near = tn_nearest(node->name.text, names, SHAPE_COUNT);
    if (near)
        tn_suggest(kit->diagnostics, d, "%s", near);
    else
        tn_help(kit->diagnostics, d, "shapes are box, sphere and cylinder; and mesh, heightmap and model, of files");
    return SHAPE_COUNT;
}

/* A length may be called by its name, which is the one of its place. */
static bool called_right(tn_kit *kit, const tn_kit_node *node, const tn_kit_node *length, const char *name)
{
    if (!length->name.text || strcmp(length->name.text, name) == 0)
        return true;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_SPACE, length->name.span, "of `%.100s`, the %s stands here",
                                 node->name.text, name);
    tn_suggest(kit->diagnostics, d, "%s", name);
    return false;
}

bool tn_kit_sizes(tn_kit *kit, const tn_kit_node *node, const tn_kit_extents *wanted, double size[3])
{
    uint32_t count = 0;
    for (const tn_kit_node *length = node->inner.first; length; length = length->next, count++) {
        int64_t value;
        if (count >= wanted->count)
            continue;
        if (!called_right(kit, node, length, wanted->names[count]) || !tn_kit_measure(kit, &length->size[0], &value))
            return false;
        size[count] = (double)value / 1e6;
        if (value > 0)
            continue;
        tn_diagnostic *d =
            tn_report(kit->diagnostics, E_KIT_SPACE, length->span, "a shape without extent holds nothing");
        tn_help(kit->diagnostics, d, "sizes are above 0");
        return false;
    }
    if (count == wanted->count)
        return true;
    tn_diagnostic *d =
        tn_report(kit->diagnostics, E_KIT_SPACE, node->span, "`%s` takes %s%u length%s, not %u", node->name.text,
                  node->kind == TN_KIT_FILED ? "a file and " : "", wanted->count, wanted->count == 1 ? "" : "s", count);
    tn_help(kit->diagnostics, d, "as %s", wanted->example);
    return false;
}

static tn_kit_region region_of_shape(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *at)
{
    double size[3] = {0};
    tn_kit_region region = {.inside = NULL};
    int shape = find_shape(kit, node);
    if (shape == SHAPE_COUNT || !tn_kit_sizes(kit, node, &shapes[shape].extents, size))
        return region;
    bool across = at->turns % 2;
    double wide = shape == BOX ? size[across ? 2 : 0] / 2 : size[0],
           deep = shape == BOX ? size[across ? 0 : 2] / 2 : size[0];
    double high = shape == CYLINDER ? size[1] : shape == BOX ? size[1] : size[0];
    double reach[3] = {wide, high, deep};
    for (int k = 0; k < 3; k++) {
        region.low[k] = at->at[k] - (k == 1 && shape != SPHERE ? 0 : reach[k]);
        region.high[k] = at->at[k] + reach[k];
    }
    tn_span span = node->span;
    tn_expression *upright = between(kit, span, 1, region.low[1], region.high[1]);
    if (shape == BOX)
        region.inside = of(kit, TN_OP_IS_BOTH, span,
                           of(kit, TN_OP_IS_BOTH, span, between(kit, span, 0, region.low[0], region.high[0]), upright),
                           between(kit, span, 2, region.low[2], region.high[2]));
    else if (shape == CYLINDER)
        region.inside = of(kit, TN_OP_IS_BOTH, span, within(kit, span, at->at, size[0], false), upright);
    else
        region.inside = within(kit, span, at->at, size[0], true);
    return region;
}

static tn_kit_region region_of(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *at);

static tn_kit_region region_named(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *at)
{
    tn_kit_region none = {.inside = NULL};
    tn_kit_space *space = tn_names_get(&kit->spaces, node->name.text);
    if (!space) {
        tn_kit_unknown(kit, &kit->spaces, "space", node->name.span, node->name.text,
                       "write `space room = box(8 studs, 4 bricks, 8 studs);`, or the shape itself here");
        return none;
    }
    if (space->open) {
        tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_SPACE, node->name.span,
                                     "the space `%.100s` is made from itself", node->name.text);
        tn_help(kit->diagnostics, d, "leave it out here, or give one of the two another name");
        return none;
    }
    if (!space->node->inner.first)
        return none;
    space->open = true;
    tn_kit_region region = region_of(kit, space->node->inner.first, at);
    space->open = false;
    return region;
}

static tn_kit_region join_regions(tn_kit *kit, tn_span span, const tn_kit_region *a, const tn_kit_region *b, bool both)
{
    tn_kit_region region = a->endless && both ? *b : *a;
    region.endless = both ? a->endless && b->endless : a->endless || b->endless;
    for (int k = 0; k < 3 && !a->endless && !b->endless; k++) {
        region.low[k] = (a->low[k] < b->low[k]) == both ? b->low[k] : a->low[k];
        region.high[k] = (a->high[k] < b->high[k]) == both ? a->high[k] : b->high[k];
    }
    region.inside =
        a->inside && b->inside ? of(kit, both ? TN_OP_IS_BOTH : TN_OP_IS_EITHER, span, a->inside, b->inside) : NULL;
    return region;
}

static tn_kit_region region_of_two(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *at)
{
    tn_kit_region a = region_of(kit, node->inner.first, at), b = region_of(kit, node->inner.last, at);
    return join_regions(kit, node->span, &a, &b, node->kind == TN_KIT_BOTH);
}

/* The placement moved so many times by what stands behind `at` or `by`; turned as the placement is. */
static bool move_placement(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *at, double times,
                           tn_space_placement *to)
{
    double by[3];
    for (int k = 0; k < 3; k++) {
        int64_t value;
        if (!tn_kit_measure(kit, &node->at.at[k], &value))
            return false;
        by[k] = times * (double)value / 1e6;
    }
    *to = *at;
    for (uint32_t t = 0; t < at->turns % 4; t++) {
        double x = by[0];
        by[0] = -by[2];
        by[2] = x;
    }
    for (int k = 0; k < 3; k++)
        to->at[k] += by[k];
    return true;
}

static tn_kit_region region_moved(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *at)
{
    tn_space_placement to;
    return move_placement(kit, node, at, 1, &to) ? region_of(kit, node->inner.first, &to)
                                                 : (tn_kit_region){.inside = NULL};
}

static tn_kit_region region_turned(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *at)
{
    int64_t turns;
    tn_space_placement to = *at;
    if (!tn_kit_whole(kit, &node->count[0], 0, 3, "a turn", &turns))
        return (tn_kit_region){.inside = NULL};
    to.turns += (uint32_t)turns;
    return region_of(kit, node->inner.first, &to);
}

/* What is inside of any of so many copies from the first on: halves are joined, so that the condition is not deep. */
static tn_kit_region region_copies(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *at, int64_t first,
                                   int64_t count)
{
    tn_space_placement to;
    if (count > 1) {
        tn_kit_region a = region_copies(kit, node, at, first, count / 2);
        if (!a.inside)
            return a;
        tn_kit_region b = region_copies(kit, node, at, first + count / 2, count - count / 2);
        return join_regions(kit, node->span, &a, &b, false);
    }
    return move_placement(kit, node, at, (double)first, &to) ? region_of(kit, node->inner.first, &to)
                                                             : (tn_kit_region){.inside = NULL};
}

static tn_kit_region region_repeated(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *at)
{
    int64_t count;
    return tn_kit_whole(kit, &node->count[0], 1, REPEATED_MAX, "a number of copies", &count)
               ? region_copies(kit, node, at, 0, count)
               : (tn_kit_region){.inside = NULL};
}

/* Recursion is as deep as spaces nest, which was checked for each, and as names lead to one another, which is checked
 * by the number of shapes. */
static tn_kit_region region_of(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *at)
{
    tn_kit_region region = {.inside = NULL};
    if (node->depth > TN_NESTING_MAX || ++kit->shapes > SHAPES_MAX) {
        tn_diagnostic *d = tn_report(kit->diagnostics, E_TOO_DEEP, node->span, "this space has too many parts");
        tn_help(kit->diagnostics, d, "make it of fewer shapes");
        return region;
    }
    switch (node->kind) {
    case TN_KIT_SHAPE:
        return region_of_shape(kit, node, at);
    case TN_KIT_FILED:
        return tn_kit_region_of_file(kit, node, at);
    case TN_KIT_NAMED:
        return region_named(kit, node, at);
    case TN_KIT_MOVED:
        return region_moved(kit, node, at);
    case TN_KIT_TURNED:
        return region_turned(kit, node, at);
    case TN_KIT_REPEATED:
        return region_repeated(kit, node, at);
    case TN_KIT_NOT:
        region = region_of(kit, node->inner.first, at);
        region.inside = of(kit, TN_OP_IS_NOT, node->span, region.inside, NULL);
        region.endless = true;
        return region;
    default:
        return region_of_two(kit, node, at);
    }
}

tn_kit_region tn_kit_check_space(tn_kit *kit, const tn_kit_node *node)
{
    static const tn_space_placement origin = {.turns = 0};
    size_t errors = kit->diagnostics->error_count;
    kit->shapes = 0;
    tn_kit_region region = region_of(kit, node, &origin);
    if (kit->diagnostics->error_count > errors || !region.inside)
        return (tn_kit_region){.inside = NULL};
    if (region.inside->depth > TN_NESTING_MAX) {
        tn_diagnostic *d = tn_report(kit->diagnostics, E_TOO_DEEP, node->span, "this space is nested too deep");
        tn_help(kit->diagnostics, d, "make it of fewer shapes");
        region.inside = NULL;
    }
    return region;
}
