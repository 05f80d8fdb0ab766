/* Lists what a surface grows in for pictures of it. */
#include "runtime/growth/environment/surroundings.h"

#include "runtime/numeric/numeric.h"

enum {
    ROUND = 48,   /* points of a circle */
    RINGS = 12,   /* of a sphere's faces, from pole to pole */
    SECTORS = 24, /* of each ring */
    TRIANGLE = 3,
    TRIANGLES_MAX = 20000 /* of a mesh; a larger one is shown as its box */
};

static const double round_angle = 6.283185307179586; /* a whole turn */
static const double far_reach = 1.5;   /* times the surface's diameter, from its middle: farther forces are arrows */
static const double arrow_share = 0.2; /* of the diameter: how long arrows are */

typedef struct listing {
    tn_guides *guides;
    tn_vector low, high, middle;
    double size; /* of the surface: its diagonal */
    uint32_t wholes;
    bool failed; /* out of memory */
} listing;

static void add(listing *l, tn_guide guide, const tn_vector *points, size_t count)
{
    l->failed = l->failed || !tn_guides_add(l->guides, guide, points, count);
}

static void add_line(listing *l, const tn_boundary *b, const tn_vector *points, size_t count)
{
    add(l, (tn_guide){TN_GUIDE_LINE, TN_GUIDE_BOUNDARY, .dashed = b->mode == TN_SOFT}, points, count);
}

static void add_area(listing *l, tn_guide_subject subject, const tn_vector *points, size_t count)
{
    add(l, (tn_guide){TN_GUIDE_AREA, subject, .whole = l->wholes}, points, count);
}

/* ---- forces */

static void add_force(listing *l, const tn_force *f)
{
    tn_vector at = tn_vector_at(f->at), away = tn_sub(at, l->middle);
    tn_guide guide = {f->kind == TN_ATTRACTOR ? TN_GUIDE_ATTRACTOR : TN_GUIDE_REPELLER,
                      TN_GUIDE_FORCE,
                      .name = f->kind == TN_ATTRACTOR ? "attractor" : "repeller",
                      .value = f->strength};
    if (tn_norm(away) <= far_reach * l->size) {
        add(l, guide, &at, 1);
        return;
    }
    tn_vector to = tn_normalised(away);
    const tn_vector line[2] = {tn_along(l->middle, to, 0.6 * l->size),
                               tn_along(l->middle, to, (0.6 + arrow_share) * l->size)};
    guide.kind = TN_GUIDE_ARROW;
    guide.name = f->kind == TN_ATTRACTOR ? "to attractor" : "to repeller";
    add(l, guide, line, 2);
}

/* Above a corner of the surface. */
static void add_gravity(listing *l, const tn_force *f)
{
    tn_vector pull = tn_vector_at(f->at), to = tn_normalised(pull);
    tn_vector from = {l->high.x, l->high.y, l->high.z + arrow_share * l->size};
    const tn_vector line[2] = {from, tn_along(from, to, arrow_share * l->size)};
    add(l, (tn_guide){TN_GUIDE_ARROW, TN_GUIDE_FORCE, .name = "gravity", .value = tn_norm(pull)}, line, 2);
}

/* ---- boundaries */

static void add_box(listing *l, const tn_boundary *b)
{
    static const int sides[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    static const int edges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                     {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
    tn_vector corners[8];
    for (int i = 0; i < 8; i++)
        corners[i] = (tn_vector){i & 1 ? b->b[0] : b->a[0], i & 2 ? b->b[1] : b->a[1], i & 4 ? b->b[2] : b->a[2]};
    for (int s = 0; s < 6; s++) {
        tn_vector side[4];
        for (int i = 0; i < 4; i++)
            side[i] = corners[sides[s][i]];
        add_area(l, TN_GUIDE_BOUNDARY, side, 4);
    }
    for (int e = 0; e < 12; e++) {
        const tn_vector edge[2] = {corners[edges[e][0]], corners[edges[e][1]]};
        add_line(l, b, edge, 2);
    }
}

static tn_vector on_sphere(const tn_boundary *b, double turn, double height)
{
    double around = tn_cos(height);
    return tn_along(tn_vector_at(b->a), (tn_vector){around * tn_cos(turn), around * tn_sin(turn), tn_sin(height)},
                    b->radius);
}

static void add_sphere(listing *l, const tn_boundary *b)
{
    for (int r = 0; r < RINGS; r++)
        for (int s = 0; s < SECTORS; s++) {
            double low = round_angle * (r / (double)RINGS - 0.5) / 2, high = low + round_angle / RINGS / 2;
            double from = round_angle * s / SECTORS, to = from + round_angle / SECTORS;
            const tn_vector face[4] = {on_sphere(b, from, low), on_sphere(b, to, low), on_sphere(b, to, high),
                                       on_sphere(b, from, high)};
            add_area(l, TN_GUIDE_BOUNDARY, face, 4);
        }
    tn_vector circles[3][ROUND + 1];
    for (int i = 0; i <= ROUND; i++) {
        double angle = round_angle * i / ROUND;
        circles[0][i] = on_sphere(b, angle, 0);
        circles[1][i] = on_sphere(b, 0, angle);
        circles[2][i] = on_sphere(b, round_angle / 4, angle);
    }
    for (int k = 0; k < 3; k++)
        add_line(l, b, circles[k], ROUND + 1);
}

/* A square of the plane about the place next to the surface's middle. */
static void add_plane(listing *l, const tn_boundary *b)
{
    tn_vector normal = tn_vector_at(b->b), from = tn_sub(l->middle, tn_vector_at(b->a));
    tn_vector foot = tn_along(l->middle, normal, -tn_dot(from, normal));
    tn_vector aside = fabs(normal.z) < 0.9 ? (tn_vector){0, 0, 1} : (tn_vector){1, 0, 0};
    tn_vector u = tn_normalised(tn_cross(aside, normal)), v = tn_cross(normal, u);
    double half = 0.6 * l->size;
    tn_vector corners[5];
    for (int i = 0; i < 5; i++) {
        double along = i % 4 == 1 || i % 4 == 2 ? half : -half, across = i % 4 >= 2 ? half : -half;
        corners[i] = tn_along(tn_along(foot, u, along), v, across);
    }
    add_area(l, TN_GUIDE_BOUNDARY, corners, 4);
    add_line(l, b, corners, 5);
}

static void add_box_of(listing *l, const tn_boundary *b, const tn_vector *points, size_t count)
{
    tn_boundary box = {.mode = b->mode};
    tn_vector_put(box.a, points[0]);
    tn_vector_put(box.b, points[0]);
    for (size_t i = 0; i < count; i++) {
        const double at[3] = {points[i].x, points[i].y, points[i].z};
        for (int k = 0; k < 3; k++) {
            box.a[k] = tn_smaller(box.a[k], at[k]);
            box.b[k] = tn_larger(box.b[k], at[k]);
        }
    }
    add_box(l, &box);
}

static void add_mesh(listing *l, const tn_boundary *b)
{
    size_t count;
    const tn_vector *corners = tn_boundary_mesh_corners(b->mesh, &count);
    if (count > TRIANGLES_MAX)
        add_box_of(l, b, corners, TRIANGLE * count);
    for (size_t i = 0; i < count && count <= TRIANGLES_MAX; i++)
        add_area(l, TN_GUIDE_BOUNDARY, corners + TRIANGLE * i, TRIANGLE);
}

static void add_boundary(listing *l, const tn_boundary *b)
{
    static void (*const adders[TN_BOUNDARY_KIND_COUNT])(listing *, const tn_boundary *) = {
        [TN_BOUNDARY_PLANE] = add_plane,
        [TN_BOUNDARY_BOX] = add_box,
        [TN_BOUNDARY_SPHERE] = add_sphere,
        [TN_BOUNDARY_MESH] = add_mesh,
    };
    adders[b->kind](l, b);
    l->wholes++;
}

static void add_ground(listing *l)
{
    double margin = 0.08 * l->size, z = l->low.z;
    const tn_vector corners[4] = {{l->low.x - margin, l->low.y - margin, z},
                                  {l->high.x + margin, l->low.y - margin, z},
                                  {l->high.x + margin, l->high.y + margin, z},
                                  {l->low.x - margin, l->high.y + margin, z}};
    add_area(l, TN_GUIDE_GROUND, corners, 4);
    l->wholes++;
}

tn_status tn_surroundings_guides(const tn_environment *environment, const double low[3], const double high[3],
                                 tn_guides *guides, tn_error *error)
{
    listing l = {.guides = guides, .low = tn_vector_at(low), .high = tn_vector_at(high)};
    l.middle = tn_scale(tn_add(l.low, l.high), 0.5);
    l.size = tn_norm(tn_sub(l.high, l.low));
    add_ground(&l);
    for (uint32_t i = 0; i < environment->boundary_count; i++)
        add_boundary(&l, &environment->boundaries[i]);
    for (uint32_t i = 0; i < environment->force_count; i++)
        (environment->forces[i].kind == TN_GRAVITY ? add_gravity : add_force)(&l, &environment->forces[i]);
    return l.failed ? tn_fail_memory(error) : TN_OK;
}
