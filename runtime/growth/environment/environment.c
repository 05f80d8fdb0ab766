/* Moves vertices by forces, and stops them at boundaries. */
#include "runtime/growth/environment/environment.h"

#include "runtime/math/elementary.h"

/* Within this of a boundary a vertex counts as on it. */
#define TOUCH 1e-9
/* A vertex that a membrane stops stays this far off it, on the side that it came from. */
#define MEMBRANE 1e-8
/* Of a membrane along an edge: more are not counted. */
#define CROSSINGS_MAX 64

typedef struct contact {
    double t;         /* along the displacement, in [0, 1) */
    tn_vector normal; /* towards the allowed side */
    uint32_t boundary;
    uint32_t triangle; /* of a mesh */
} contact;

static double raise_to(double r, double exponent)
{
    if (exponent == 2) /* the inverse square is the default, and by far the commonest */
        return r * r;
    return tn_pow(r, exponent);
}

tn_vector tn_environment_force(const tn_environment *environment, tn_vector x)
{
    tn_vector sum = {0, 0, 0};
    for (uint32_t i = 0; i < environment->force_count; i++) {
        const tn_force *force = &environment->forces[i];
        tn_vector at = tn_vector_at(force->at);
        if (force->kind == TN_GRAVITY) {
            sum = tn_add(sum, at);
            continue;
        }
        tn_vector d = tn_sub(at, x);
        double r = tn_norm(d);
        if (r < 1e-12) /* at the attractor itself there is no direction to go */
            continue;
        double sign = force->kind == TN_ATTRACTOR ? 1 : -1;
        sum = tn_along(sum, d, sign * force->strength / raise_to(r, force->exponent) / r);
    }
    return sum;
}

/* ---- planes */

static double plane_distance(const tn_boundary *plane, tn_vector x)
{
    return tn_dot(tn_sub(x, tn_vector_at(plane->a)), tn_vector_at(plane->b));
}

static bool plane_hit(const tn_boundary *plane, tn_vector x, tn_vector d, contact *hit)
{
    double height = plane_distance(plane, x), along = tn_dot(d, tn_vector_at(plane->b));
    if (along >= 0 || height < -TOUCH)
        return false;
    double t = fmax(0, height) / -along;
    if (!(t < 1))
        return false;
    hit->t = t;
    hit->normal = tn_vector_at(plane->b);
    return true;
}

/* ---- spheres */

static double sphere_distance(const tn_boundary *sphere, tn_vector x)
{
    double d = tn_norm(tn_sub(x, tn_vector_at(sphere->a))) - sphere->radius;
    return sphere->inside ? -d : d;
}

static bool sphere_hit(const tn_boundary *sphere, tn_vector x, tn_vector d, contact *hit)
{
    if (sphere_distance(sphere, x) < -TOUCH)
        return false;
    tn_vector centre = tn_vector_at(sphere->a), m = tn_sub(x, centre);
    double a = tn_dot(d, d), b = tn_dot(m, d), c = tn_dot(m, m) - sphere->radius * sphere->radius;
    if (a < 1e-300)
        return false;
    double discriminant = b * b - a * c, t;
    if (sphere->inside) {
        if (discriminant < 0)
            return false;
        t = (-b + sqrt(discriminant)) / a;
    } else {
        if (b >= 0 || discriminant <= 0)
            return false;
        t = (-b - sqrt(discriminant)) / a;
    }
    if (!(t < 1))
        return false;
    hit->t = fmax(0, t);
    tn_vector n = tn_normalised(tn_sub(tn_along(x, d, hit->t), centre));
    hit->normal = sphere->inside ? tn_scale(n, -1) : n;
    return true;
}

static tn_vector sphere_project(const tn_boundary *sphere, tn_vector x)
{
    if (sphere_distance(sphere, x) >= 0)
        return x;
    tn_vector centre = tn_vector_at(sphere->a), m = tn_sub(x, centre);
    tn_vector n = tn_norm(m) > 1e-12 ? tn_normalised(m) : (tn_vector){0, 0, 1};
    return tn_along(centre, n, sphere->radius);
}

/* ---- boxes */

static double box_distance(const tn_boundary *box, tn_vector x)
{
    double p[3], out = 0, most = -INFINITY;
    tn_vector_put(p, x);
    for (int k = 0; k < 3; k++) {
        double q = fmax(box->a[k] - p[k], p[k] - box->b[k]);
        most = fmax(most, q);
        out += fmax(q, 0) * fmax(q, 0);
    }
    double d = sqrt(out) + fmin(most, 0);
    return box->inside ? -d : d;
}

static bool box_hit_from_inside(const tn_boundary *box, const double p[3], const double v[3], contact *hit)
{
    bool found = false;
    for (int k = 0; k < 3; k++) {
        for (int high = 0; high < 2; high++) {
            double s = high ? -1 : 1, along = v[k] * s;
            if (along >= 0)
                continue;
            double t = fmax(0, (p[k] - (high ? box->b[k] : box->a[k])) * s) / -along;
            if (!(t < 1) || (found && t >= hit->t))
                continue;
            double n[3] = {0, 0, 0};
            n[k] = s;
            hit->t = t;
            hit->normal = tn_vector_at(n);
            found = true;
        }
    }
    return found;
}

static bool box_hit_from_outside(const tn_boundary *box, const double p[3], const double v[3], contact *hit)
{
    double enter = -INFINITY, leave = INFINITY, n[3] = {0, 0, 0};
    bool entered = false;
    for (int k = 0; k < 3; k++) {
        if (fabs(v[k]) < 1e-300) {
            if (p[k] <= box->a[k] || p[k] >= box->b[k])
                return false;
            continue;
        }
        double t0 = (box->a[k] - p[k]) / v[k], t1 = (box->b[k] - p[k]) / v[k], s = -1;
        if (t0 > t1) {
            double swap = t0;
            t0 = t1;
            t1 = swap;
            s = 1;
        }
        if (t0 > enter) {
            enter = t0;
            n[0] = n[1] = n[2] = 0;
            n[k] = s;
            entered = true;
        }
        leave = fmin(leave, t1);
    }
    if (!entered || enter >= leave - 1e-12 || enter >= 1 || leave <= TOUCH || enter < -1e-6)
        return false;
    hit->t = fmax(0, enter);
    hit->normal = tn_vector_at(n);
    return true;
}

static bool box_hit(const tn_boundary *box, tn_vector x, tn_vector d, contact *hit)
{
    if (box_distance(box, x) < -TOUCH)
        return false;
    double p[3], v[3];
    tn_vector_put(p, x);
    tn_vector_put(v, d);
    return box->inside ? box_hit_from_inside(box, p, v, hit) : box_hit_from_outside(box, p, v, hit);
}

static tn_vector box_project(const tn_boundary *box, tn_vector x)
{
    if (box_distance(box, x) >= 0)
        return x;
    double p[3], nearest = INFINITY, to = 0;
    int axis = 0;
    tn_vector_put(p, x);
    if (box->inside) {
        for (int k = 0; k < 3; k++)
            p[k] = fmin(fmax(p[k], box->a[k]), box->b[k]);
        return tn_vector_at(p);
    }
    for (int k = 0; k < 3; k++) {
        for (int high = 0; high < 2; high++) {
            double bound = high ? box->b[k] : box->a[k];
            if (fabs(p[k] - bound) < nearest) {
                nearest = fabs(p[k] - bound);
                axis = k;
                to = bound;
            }
        }
    }
    p[axis] = to;
    return tn_vector_at(p);
}

/* ---- meshes */

static bool is_membrane(const tn_boundary *boundary)
{
    return boundary->kind == TN_BOUNDARY_MESH && !tn_boundary_mesh_is_solid(boundary->mesh);
}

/* A membrane has no inside: nothing trespasses, only crossing is refused. */
static double mesh_distance(const tn_boundary *boundary, tn_vector x, tn_vector *nearest)
{
    double d = tn_boundary_mesh_distance(boundary->mesh, x, nearest);
    return boundary->inside && tn_boundary_mesh_is_solid(boundary->mesh) ? -d : d;
}

static bool mesh_hit(const tn_boundary *boundary, tn_vector x, tn_vector d, uint32_t except, contact *hit)
{
    int sign;
    if (tn_boundary_mesh_clear(boundary->mesh, x, tn_norm(d), &sign))
        return false;
    tn_mesh_hit found;
    if (!tn_boundary_mesh_hit(boundary->mesh, boundary->inside, x, d, except, &found))
        return false;
    hit->t = found.t;
    hit->normal = found.normal;
    hit->triangle = found.triangle;
    return true;
}

static tn_vector mesh_project(const tn_boundary *boundary, tn_vector x)
{
    int sign = 0;
    if (is_membrane(boundary))
        return x;
    if (tn_boundary_mesh_clear(boundary->mesh, x, 0, &sign) && (sign < 0) == boundary->inside)
        return x;
    tn_vector nearest;
    return mesh_distance(boundary, x, &nearest) >= 0 ? x : nearest;
}

/* ---- all kinds */

static double distance(const tn_boundary *boundary, tn_vector x)
{
    switch (boundary->kind) {
    case TN_BOUNDARY_PLANE:
        return plane_distance(boundary, x);
    case TN_BOUNDARY_BOX:
        return box_distance(boundary, x);
    case TN_BOUNDARY_SPHERE:
        return sphere_distance(boundary, x);
    default:
        return mesh_distance(boundary, x, NULL);
    }
}

static bool meets(const tn_boundary *boundary, tn_vector x, tn_vector d, uint32_t except, contact *hit)
{
    hit->triangle = TN_NO_TRIANGLE;
    switch (boundary->kind) {
    case TN_BOUNDARY_PLANE:
        return plane_hit(boundary, x, d, hit);
    case TN_BOUNDARY_BOX:
        return box_hit(boundary, x, d, hit);
    case TN_BOUNDARY_SPHERE:
        return sphere_hit(boundary, x, d, hit);
    default:
        return mesh_hit(boundary, x, d, except, hit);
    }
}

static tn_vector project(const tn_boundary *boundary, tn_vector x)
{
    switch (boundary->kind) {
    case TN_BOUNDARY_PLANE: {
        double height = plane_distance(boundary, x);
        return height < 0 ? tn_along(x, tn_vector_at(boundary->b), -height) : x;
    }
    case TN_BOUNDARY_BOX:
        return box_project(boundary, x);
    case TN_BOUNDARY_SPHERE:
        return sphere_project(boundary, x);
    default:
        return mesh_project(boundary, x);
    }
}

/* The first boundary that the displacement meets. `slid` is the contact it comes from, or NULL: that boundary is not
 * asked again, except that a mesh is, without the triangle that was hit. */
static bool first_contact(const tn_environment *environment, tn_vector x, tn_vector d, const contact *slid,
                          contact *first)
{
    bool found = false;
    for (uint32_t i = 0; i < environment->boundary_count; i++) {
        const tn_boundary *boundary = &environment->boundaries[i];
        uint32_t except = TN_NO_TRIANGLE;
        if (boundary->mode == TN_SOFT)
            continue;
        if (slid && slid->boundary == i) {
            if (boundary->kind != TN_BOUNDARY_MESH)
                continue;
            except = slid->triangle;
        }
        contact hit;
        if (!meets(boundary, x, d, except, &hit) || (found && hit.t >= first->t))
            continue;
        *first = hit;
        first->boundary = i;
        found = true;
    }
    return found;
}

tn_vector tn_environment_project(const tn_environment *environment, tn_vector x)
{
    for (uint32_t i = 0; i < environment->boundary_count; i++)
        if (environment->boundaries[i].mode != TN_SOFT)
            x = project(&environment->boundaries[i], x);
    return x;
}

/* Does the way from x to p end on the other side of a membrane? One that is wrinkled it may cross there and back. */
static bool ends_across(const tn_boundary *membrane, tn_vector x, tn_vector p, contact *last)
{
    bool across = false;
    uint32_t except = TN_NO_TRIANGLE;
    for (int crossings = 0; crossings < CROSSINGS_MAX; crossings++) {
        contact hit;
        tn_vector d = tn_sub(p, x);
        if (!mesh_hit(membrane, x, d, except, &hit))
            return across;
        across = !across;
        except = hit.triangle;
        x = tn_along(tn_along(x, d, hit.t), hit.normal, -MEMBRANE);
        *last = hit;
    }
    return across;
}

/* On which side of a membrane a new vertex belongs the edge tells that it divides: where the ways to it from both ends
 * lead across, it is put back to the nearest place on their side. */
static tn_vector pull_through(const tn_boundary *membrane, tn_vector p, tn_vector from, tn_vector to)
{
    contact hit;
    tn_vector nearest;
    if (!ends_across(membrane, from, p, &hit) || !ends_across(membrane, to, p, &hit))
        return p;
    tn_boundary_mesh_distance(membrane->mesh, p, &nearest);
    tn_vector out = tn_normalised(tn_sub(nearest, p));
    return tn_along(nearest, tn_dot(out, out) > 0 ? out : hit.normal, MEMBRANE);
}

tn_vector tn_environment_place(const tn_environment *environment, tn_vector p, tn_vector from, tn_vector to)
{
    p = tn_environment_project(environment, p);
    for (uint32_t i = 0; i < environment->boundary_count; i++) {
        const tn_boundary *boundary = &environment->boundaries[i];
        if (boundary->mode != TN_SOFT && is_membrane(boundary))
            p = pull_through(boundary, p, from, to);
    }
    return p;
}

tn_vector tn_environment_move(const tn_environment *environment, tn_vector x, tn_vector d)
{
    contact hit, second;
    if (!first_contact(environment, x, d, NULL, &hit))
        return tn_environment_project(environment, tn_add(x, d));
    const tn_boundary *boundary = &environment->boundaries[hit.boundary];
    tn_vector met = tn_along(x, d, hit.t);
    if (is_membrane(boundary))
        met = tn_along(met, hit.normal, MEMBRANE); /* else nothing would tell later which side it is on */
    if (boundary->mode == TN_STOP)
        return project(boundary, met);
    tn_vector rest = tn_scale(d, 1 - hit.t);
    rest = tn_along(rest, hit.normal, -tn_dot(rest, hit.normal));
    tn_vector y = project(boundary, tn_add(met, rest));
    tn_vector slide = tn_sub(y, met);
    if (first_contact(environment, met, slide, &hit, &second)) {
        y = tn_along(met, slide, second.t);
        if (is_membrane(&environment->boundaries[second.boundary]))
            y = tn_along(y, second.normal, MEMBRANE);
    }
    return tn_environment_project(environment, y);
}

bool tn_environment_trespasses(const tn_environment *environment, tn_vector x)
{
    for (uint32_t i = 0; i < environment->boundary_count; i++)
        if (environment->boundaries[i].mode == TN_SOFT && distance(&environment->boundaries[i], x) < -TOUCH)
            return true;
    return false;
}

bool tn_environment_has_hard(const tn_environment *environment)
{
    for (uint32_t i = 0; i < environment->boundary_count; i++)
        if (environment->boundaries[i].mode != TN_SOFT)
            return true;
    return false;
}

bool tn_environment_has_soft(const tn_environment *environment)
{
    for (uint32_t i = 0; i < environment->boundary_count; i++)
        if (environment->boundaries[i].mode == TN_SOFT)
            return true;
    return false;
}

/* ==== lists what a surface grows in for pictures of it */

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
    tn_guide guide = {f->kind == TN_ATTRACTOR ? TN_GUIDE_ATTRACTOR : TN_GUIDE_REPELLER, TN_GUIDE_FORCE,
                      .name = f->kind == TN_ATTRACTOR ? "attractor" : "repeller", .value = f->strength};
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
