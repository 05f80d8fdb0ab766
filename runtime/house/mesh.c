/* Makes polygons of a house's solids: a box has six sides, a roof two ends, a bottom, two sides and its slopes. */
#include "runtime/house/mesh.h"

#include <stdio.h>
#include <stdlib.h>

static const double metre = 1e9; /* nanometres */

/* Where the next vertex and face go. */
typedef struct tn_mesh_writer {
    tn_mesh *mesh;
    size_t vertex, face;
    uint32_t corner, group;
} tn_mesh_writer;

static uint32_t add_vertex(tn_mesh_writer *w, double x, double y, double z)
{
    double *p = w->mesh->positions + 3 * w->vertex;
    p[0] = x / metre;
    p[1] = y / metre;
    p[2] = z / metre;
    return (uint32_t)w->vertex++;
}

static void begin_face(tn_mesh_writer *w)
{
    w->mesh->face_group[w->face] = w->group;
    w->mesh->face_first[w->face++] = w->corner;
}

static void add_corner(tn_mesh_writer *w, uint32_t vertex)
{
    w->mesh->corners[w->corner++] = vertex;
}

static void add_quad(tn_mesh_writer *w, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    begin_face(w);
    add_corner(w, a);
    add_corner(w, b);
    add_corner(w, c);
    add_corner(w, d);
}

static void add_box(tn_mesh_writer *w, const tn_box *b)
{
    uint32_t v = (uint32_t)w->vertex;
    for (int i = 0; i < 8; i++)
        add_vertex(w, (double)(i & 1 ? b->x1 : b->x0), (double)(i & 2 ? b->y1 : b->y0),
                   (double)(i & 4 ? b->z1 : b->z0));
    add_quad(w, v, v + 2, v + 3, v + 1);
    add_quad(w, v + 4, v + 5, v + 7, v + 6);
    add_quad(w, v, v + 1, v + 5, v + 4);
    add_quad(w, v + 2, v + 6, v + 7, v + 3);
    add_quad(w, v, v + 4, v + 6, v + 2);
    add_quad(w, v + 1, v + 3, v + 7, v + 5);
}

/* The outline of a roof's end, seen from x = infinity counter-clockwise: the two feet, then the line from the front to
 * the back. */
static void add_outline(tn_mesh_writer *w, const tn_prism *prism, const tn_roof_point *points, double x)
{
    size_t n = prism->point_count;
    add_vertex(w, x, tn_fraction_value(points[0].y), (double)prism->base);
    add_vertex(w, x, tn_fraction_value(points[n - 1].y), (double)prism->base);
    for (size_t i = n; i-- > 0;)
        add_vertex(w, x, tn_fraction_value(points[i].y), tn_fraction_value(points[i].z));
}

static void add_prism(tn_mesh_writer *w, const tn_prism *prism, const tn_roof_point *points)
{
    uint32_t low = (uint32_t)w->vertex, count = (uint32_t)prism->point_count + 2, high = low + count;
    add_outline(w, prism, points, (double)prism->x0);
    add_outline(w, prism, points, (double)prism->x1);
    begin_face(w);
    for (uint32_t i = count; i-- > 0;)
        add_corner(w, low + i);
    begin_face(w);
    for (uint32_t i = 0; i < count; i++)
        add_corner(w, high + i);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t next = i + 1 < count ? i + 1 : 0;
        add_quad(w, low + i, low + next, high + next, high + i);
    }
}

static tn_status make_groups(tn_mesh *mesh, tn_error *error)
{
    mesh->face_group = malloc((mesh->face_count + 1) * sizeof *mesh->face_group);
    mesh->group_names = calloc(TN_SOLID_COUNT, sizeof *mesh->group_names);
    if (!mesh->face_group || !mesh->group_names) {
        tn_mesh_clear(mesh);
        return tn_fail_memory(error);
    }
    mesh->group_count = TN_SOLID_COUNT;
    for (int i = 0; i < TN_SOLID_COUNT; i++)
        snprintf(mesh->group_names[i], sizeof mesh->group_names[i], "%s", tn_solid_kind_text((tn_solid_kind)i));
    return TN_OK;
}

tn_status tn_house_mesh(const tn_solids *solids, tn_mesh *mesh, tn_error *error)
{
    size_t vertices = 8 * solids->box_count, faces = 6 * solids->box_count, corners = 24 * solids->box_count;
    for (size_t i = 0; i < solids->prism_count; i++) {
        size_t outline = solids->prisms[i].point_count + 2;
        vertices += 2 * outline;
        faces += outline + 2;
        corners += 6 * outline;
    }
    tn_status status = tn_mesh_new(vertices, faces, corners, mesh, error);
    if (status == TN_OK)
        status = make_groups(mesh, error);
    if (status != TN_OK)
        return status;
    tn_mesh_writer w = {.mesh = mesh};
    for (size_t i = 0; i < solids->box_count; i++) {
        w.group = solids->boxes[i].kind;
        add_box(&w, &solids->boxes[i].at);
    }
    w.group = TN_SOLID_ROOF;
    for (size_t i = 0; i < solids->prism_count; i++)
        add_prism(&w, &solids->prisms[i], solids->points + solids->prisms[i].point_first);
    mesh->face_first[w.face] = w.corner;
    return TN_OK;
}
