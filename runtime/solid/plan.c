/* Measures what of a design is seen along an axis: shadows, what lies level on top, what hangs over. */
#include <math.h>
#include <stdlib.h>

#include "runtime/geometry/union/cover.h"
#include "runtime/solid/measure_parts.h"

/* Points of a cell, or of one of its faces, as they are seen along the axis. */
static bool cover_of_corners(const tn_cut_box *cell, const tn_cut_box_face *face, int axis, tn_cover *cover)
{
    double points[TN_COVER_CORNERS][2];
    size_t count = face ? face->count : cell->corner_count;
    for (size_t i = 0; i < count; i++) {
        const double *at = cell->at[face ? face->corner[i] : i];
        points[i][0] = at[(axis + 1) % 3];
        points[i][1] = at[(axis + 2) % 3];
    }
    return tn_cover_of((const double(*)[2])points, count, cover);
}

tn_status tn_built_shadow(const tn_built *built, int axis, double *area, tn_error *error)
{
    tn_cover *covers = malloc((built->cell_count + 1) * sizeof *covers);
    size_t count = 0;
    bool fine = covers != NULL;
    for (size_t i = 0; i < built->cell_count && fine; i++)
        if (built->cells[i].face_count > 0)
            fine = cover_of_corners(&built->cells[i], NULL, axis, &covers[count++]);
    *area = fine ? tn_cover_area(covers, count) : -1;
    free(covers);
    return *area < 0 ? tn_fail_memory(error) : TN_OK;
}

/* The clipped face of a cell, where it faces up and is not level. */
static const tn_cut_box_face *slope_of(const tn_cut_box *cell, double level)
{
    for (uint32_t f = 0; f < cell->face_count; f++) {
        const tn_cut_box_face *face = &cell->faces[f];
        double low = INFINITY, high = -INFINITY, area = 0;
        if (face->side != TN_CUT_BOX_CAP)
            continue;
        for (uint32_t c = 0; c < face->count; c++) {
            const double *p = cell->at[face->corner[c]], *q = cell->at[face->corner[(c + 1) % face->count]];
            low = fmin(low, p[1]);
            high = fmax(high, p[1]);
            area += p[2] * q[0] - p[0] * q[2];
        }
        return area > 0 && high - low > level ? face : NULL;
    }
    return NULL;
}

/* What is seen from above, and what lies above what. */
typedef struct plan {
    const tn_built *built;
    tn_box_bounds *bounds; /* of cells, seen from above */
    tn_box_tree tree;
    tn_box_hits hits;
    tn_cover_pieces work;
} plan;

/* What of a cell's slope no other cell covers. */
static bool add_slope(plan *p, const tn_cut_box *cell, const tn_cut_box_face *face, double *area)
{
    tn_cover slope, above;
    if (!cover_of_corners(cell, face, 1, &slope))
        return false;
    const tn_box_bounds bounds = tn_cover_bounds(&slope);
    bool fine = tn_box_tree_list(&p->tree, &bounds, &p->hits);
    tn_cover_begin(&p->work, &slope);
    for (size_t k = 0; k < p->hits.count && fine && p->work.count; k++) {
        const tn_cut_box *other = &p->built->cells[p->hits.items[k]];
        if (other->face_count == 0 || other->low[1] < cell->high[1])
            continue;
        fine = cover_of_corners(other, NULL, 1, &above);
        tn_cover_less(&p->work, &above);
    }
    *area += tn_cover_left(&p->work);
    return fine && !p->work.failed;
}

tn_status tn_built_sloping(const tn_built *built, double level, double *area, tn_error *error)
{
    size_t n = built->cell_count;
    plan p = {.built = built, .bounds = calloc(n + 1, sizeof *p.bounds)};
    bool fine = p.bounds;
    *area = 0;
    for (size_t i = 0; i < n && fine; i++) {
        const tn_cut_box *c = &built->cells[i]; /* z, x, as covers along y have it */
        p.bounds[i] = (tn_box_bounds){{c->low[2], c->low[0], 0}, {c->high[2], c->high[0], 0}};
    }
    fine = fine && tn_box_tree_make(p.bounds, (uint32_t)n, &p.tree, error) == TN_OK;
    for (size_t i = 0; i < n && fine; i++) {
        const tn_cut_box_face *face = slope_of(&built->cells[i], level);
        fine = !face || add_slope(&p, &built->cells[i], face, area);
    }
    tn_box_tree_clear(&p.tree);
    free(p.bounds);
    free(p.hits.items);
    free(p.work.pieces);
    return fine ? TN_OK : tn_fail_memory(error);
}

double tn_mesh_overhang(const tn_mesh *mesh, double ground, double level)
{
    static const double steep = 0.70710678118654752 + 1e-9; /* cos 45 degrees; what is exactly so does not count */
    double area = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        double n[3], highest = -INFINITY;
        tn_mesh_face_normal(mesh, mesh->corners + 3 * f, 3, n);
        double twice = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (size_t c = 3 * f; c < 3 * f + 3; c++)
            highest = fmax(highest, mesh->positions[3 * (size_t)mesh->corners[c] + 1]);
        if (n[1] < -steep * twice && highest > ground + level)
            area += twice / 2;
    }
    return area;
}
