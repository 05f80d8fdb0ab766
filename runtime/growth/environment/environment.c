/* Moves vertices by forces, and stops them at boundaries. */
#include "runtime/growth/environment/environment.h"

#include "runtime/numeric/numeric.h"

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
