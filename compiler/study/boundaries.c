/* Finds boundaries that leave a surface no place: of two that it has to keep to, no point is allowed by both. */
#include <math.h>

#include "compiler/study/study.h"

#define LOOKED_AT 1000u /* boundaries: of more, those behind are not compared */

/* What a boundary allows: a side of a plane, or what is inside or outside of a sphere or box. */
typedef struct region {
    uint32_t kind; /* tn_boundary_kind */
    bool inside;
    double a[3], b[3], radius; /* plane: a point, its normal; box: its corners; sphere: its centre */
} region;

/* False of a mesh, which is not known yet, and of a soft boundary, which may be passed. */
static bool region_of(const tn_study_item *item, region *r)
{
    *r = (region){.kind = item->which,
                  .a = {item->a.x, item->a.y, item->a.z},
                  .b = {item->b.x, item->b.y, item->b.z},
                  .radius = item->b.x};
    for (const tn_study_part *part = item->parts; part; part = part->next) {
        if (part->kind == TN_PART_MODE && part->value == TN_SOFT)
            return false;
        r->inside |= part->kind == TN_PART_SIDE && part->value > 0;
    }
    return item->which != TN_BOUNDARY_MESH;
}

static double dot(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

static double distance(const double x[3], const double y[3])
{
    const double d[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
    return sqrt(dot(d, d));
}

/* The box's point that is nearest to x, or farthest from it. */
static void box_point(const region *box, const double x[3], bool farthest, double point[3])
{
    for (int k = 0; k < 3; k++) {
        bool high = x[k] - box->a[k] < box->b[k] - x[k];
        point[k] = farthest ? (high ? box->b[k] : box->a[k]) : fmin(fmax(x[k], box->a[k]), box->b[k]);
    }
}

/* How high the region's highest point lies above the plane, in lengths of its normal. */
static double height(const region *plane, const region *of)
{
    double size = sqrt(dot(plane->b, plane->b)), point[3];
    for (int k = 0; k < 3; k++)
        point[k] = (of->kind == TN_BOUNDARY_SPHERE ? of->a[k] : plane->b[k] > 0 ? of->b[k] : of->a[k]) - plane->a[k];
    return dot(point, plane->b) / size + (of->kind == TN_BOUNDARY_SPHERE ? of->radius : 0);
}

/* Two planes that face each other with their backs, with room between them. */
static bool backs_apart(const region *a, const region *b)
{
    double sizes = sqrt(dot(a->b, a->b) * dot(b->b, b->b));
    const double between[3] = {b->a[0] - a->a[0], b->a[1] - a->a[1], b->a[2] - a->a[2]};
    return dot(a->b, b->b) <= -sizes * (1 - 1e-12) && dot(between, a->b) < 0;
}

static bool insides_apart(const region *a, const region *b)
{
    double point[3];
    if (a->kind == TN_BOUNDARY_BOX && b->kind == TN_BOUNDARY_BOX) {
        for (int k = 0; k < 3; k++)
            if (a->b[k] < b->a[k] || b->b[k] < a->a[k])
                return true;
        return false;
    }
    if (a->kind == TN_BOUNDARY_SPHERE && b->kind == TN_BOUNDARY_SPHERE)
        return distance(a->a, b->a) > a->radius + b->radius;
    const region *box = a->kind == TN_BOUNDARY_BOX ? a : b, *sphere = box == a ? b : a;
    box_point(box, sphere->a, false, point);
    return distance(point, sphere->a) > sphere->radius;
}

/* Does the obstacle hold all of what is inside the other? */
static bool swallows(const region *obstacle, const region *within)
{
    double point[3];
    if (obstacle->kind == TN_BOUNDARY_SPHERE) {
        if (within->kind == TN_BOUNDARY_SPHERE)
            return distance(obstacle->a, within->a) + within->radius < obstacle->radius;
        box_point(within, obstacle->a, true, point);
        return distance(point, obstacle->a) < obstacle->radius;
    }
    for (int k = 0; k < 3; k++) {
        bool ball = within->kind == TN_BOUNDARY_SPHERE;
        double low = ball ? within->a[k] - within->radius : within->a[k],
               high = ball ? within->a[k] + within->radius : within->b[k];
        if (!(low > obstacle->a[k] && high < obstacle->b[k]))
            return false;
    }
    return true;
}

/* Is no point allowed by both? */
static bool are_apart(const region *a, const region *b)
{
    bool flat_a = a->kind == TN_BOUNDARY_PLANE, flat_b = b->kind == TN_BOUNDARY_PLANE;
    if (flat_a && flat_b)
        return backs_apart(a, b);
    if (flat_a || flat_b) {
        const region *plane = flat_a ? a : b, *other = flat_a ? b : a;
        return other->inside && height(plane, other) < 0;
    }
    if (a->inside && b->inside)
        return insides_apart(a, b);
    return a->inside != b->inside && swallows(a->inside ? b : a, a->inside ? a : b);
}

void tn_check_boundaries(tn_diagnostics *diagnostics, const tn_study_item *const *boundaries, uint32_t count)
{
    region later, earlier;
    if (count > LOOKED_AT)
        count = LOOKED_AT;
    for (uint32_t i = 1; i < count; i++)
        for (uint32_t k = 0; k < i && region_of(boundaries[i], &later); k++) {
            if (!region_of(boundaries[k], &earlier) || !are_apart(&later, &earlier))
                continue;
            tn_diagnostic *d = tn_report(diagnostics, E_BAD_BOUNDARY, boundaries[i]->span,
                                         "no point is allowed by this boundary and by another one, too");
            tn_note(diagnostics, d, &boundaries[k]->span, "the other is here");
            tn_help(diagnostics, d,
                    "a surface keeps to all boundaries at once; where it may be inside of either, name one closed mesh "
                    "of both, which `tartan mesh` makes of a field");
            break;
        }
}
