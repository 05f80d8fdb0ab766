/* Measures designs of boxes. */
#include "runtime/solid/measure.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/geometry/mesh.h"
#include "runtime/geometry/union/box_tree.h"
#include "runtime/geometry/union/contacts.h"
#include "runtime/geometry/union/cover.h"
#include "runtime/geometry/union/union.h"
#include "runtime/module/code.h"

/* ==== measures what of a design is seen along an axis: shadows, what lies level on top, what hangs over */

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

/* The area of the silhouette along an axis. */
static tn_status built_shadow(const tn_built *built, int axis, double *area, tn_error *error)
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

/* The part of the plan's area whose highest surface is not level: it rises by more than `level`. */
static tn_status built_sloping(const tn_built *built, double level, double *area, tn_error *error)
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

/* The area of a mesh's faces that look down by more than 45 degrees and do not lie on the ground. */
static double mesh_overhang(const tn_mesh *mesh, double ground, double level)
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

/* ==== builds a design and measures it: volumes and moments of cells, what they touch, what they stand on */

void tn_built_clear(tn_built *built)
{
    tn_design_clear(&built->written);
    tn_design_clear(&built->built);
    tn_history_clear(&built->history);
    free(built->cells);
    *built = (tn_built){0};
}

static tn_status make_cells(tn_built *built, tn_error *error)
{
    const tn_design *design = &built->built;
    uint32_t n = design->box_count, images = tn_design_images(design);
    bool any = false;
    built->cell_count = (size_t)n * images;
    built->cells = malloc((built->cell_count + 1) * sizeof *built->cells);
    if (!built->cells)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < built->cell_count; i++) {
        tn_design_cell(design, i % n, tn_design_image(design, i / n), &built->cells[i]);
        any |= built->cells[i].face_count > 0;
    }
    if (any)
        return TN_OK;
    tn_status status = tn_fail(error, TN_INVALID, E_SOLID_EMPTY, "nothing of this design is left");
    tn_error_help(error, "its boxes are clipped away or squashed to nothing: `tartan explain` says by what");
    return status;
}

static tn_status check_count(const tn_module *module, uint32_t solid, uint32_t most, tn_error *error)
{
    const tn_solid_record *record = &module->SOLID_records[solid];
    const tn_design counted = {.flags = record->flags};
    uint64_t boxes = (uint64_t)record->box_count * tn_design_images(&counted);
    most = most ? most : TN_SOLID_BOXES_DEFAULT;
    if (boxes <= most)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_SOLID_TOO_MANY, "`%.100s` has %llu boxes, images counted; the limit is %u",
            tn_text(module, record->name), (unsigned long long)boxes, most);
    tn_error_help(error, "--max-boxes %llu raises it", (unsigned long long)boxes);
    return TN_LIMIT;
}

tn_status tn_built_make(const tn_module *module, uint32_t solid, uint32_t most, tn_built *built, tn_error *error)
{
    *built = (tn_built){0};
    tn_status status = check_count(module, solid, most, error);
    if (status == TN_OK)
        status = tn_design_read(module, solid, &built->written, error);
    if (status == TN_OK)
        status = tn_design_copy(&built->written, &built->built, error);
    if (status == TN_OK)
        status = tn_design_correct(&built->built, &built->history, error);
    return status == TN_OK ? make_cells(built, error) : status;
}

tn_status tn_built_make_of(const tn_design *written, tn_built *built, tn_error *error)
{
    *built = (tn_built){0};
    tn_status status = tn_design_copy(written, &built->written, error);
    if (status == TN_OK)
        status = tn_design_copy(written, &built->built, error);
    if (status == TN_OK)
        status = tn_design_correct(&built->built, NULL, error);
    return status == TN_OK ? make_cells(built, error) : status;
}

/* ---- of boxes */

static double volume_of_boxes(const tn_design *design)
{
    double volume = 0;
    for (uint32_t i = 0; i < design->box_count; i++) {
        const tn_solid_box *b = &design->boxes[i];
        if (!b->void_)
            volume += (b->high[0] - b->low[0]) * (b->high[1] - b->low[1]) * (b->high[2] - b->low[2]);
    }
    return volume * tn_design_images(design);
}

static void measure_boxes(const tn_built *built, double *values)
{
    const tn_design *design = &built->built;
    uint32_t voids = 0, ghosts = 0;
    for (uint32_t i = 0; i < design->box_count; i++) {
        voids += design->boxes[i].void_;
        ghosts += !design->boxes[i].void_ && built->cells[i].face_count == 0;
    }
    values[TN_SOLID_BOXES_MEASURED] = (double)built->cell_count;
    values[TN_SOLID_VOIDS_MEASURED] = voids * (double)tn_design_images(design);
    values[TN_SOLID_GHOSTS_MEASURED] = ghosts * (double)tn_design_images(design);
    values[TN_SOLID_SQUASHED_MEASURED] = volume_of_boxes(&built->written) - volume_of_boxes(design);
}

/* ---- of cells */

typedef struct bounds {
    double low[3], high[3], diagonal;
} bounds;

static bounds find_bounds(const tn_built *built)
{
    bounds b = {.diagonal = 0};
    tn_cut_boxes_bounds(built->cells, built->cell_count, b.low, b.high);
    for (int k = 0; k < 3; k++)
        b.diagonal += (b.high[k] - b.low[k]) * (b.high[k] - b.low[k]);
    b.diagonal = sqrt(b.diagonal);
    return b;
}

static void measure_mass(const tn_built *built, double *values)
{
    tn_moments m = {0};
    double around[3];
    for (size_t i = 0; i < built->cell_count; i++)
        tn_cut_box_moments(&built->cells[i], &m);
    values[TN_SOLID_VOLUME_MEASURED] = values[TN_SOLID_MASS_MEASURED] = m.volume;
    for (int k = 0; k < 3; k++) {
        double centre = m.volume > 0 ? m.first[k] / m.volume : 0;
        values[TN_SOLID_CENTRE_X_MEASURED + k] = centre;
        around[k] = m.second[k] - centre * m.first[k]; /* of the squares of distances along this axis */
    }
    for (int k = 0; k < 3; k++)
        values[TN_SOLID_INERTIA_X_MEASURED + k] = around[(k + 1) % 3] + around[(k + 2) % 3];
}

static tn_status measure_footprint(const tn_built *built, const bounds *b, double *values, tn_error *error)
{
    size_t count = 0;
    double(*points)[2] = malloc((built->cell_count * TN_CUT_BOX_CORNERS + 1) * sizeof *points);
    if (!points)
        return tn_fail_memory(error);
    for (size_t i = 0; i < built->cell_count; i++)
        for (uint32_t v = 0; built->cells[i].face_count && v < built->cells[i].corner_count; v++) {
            const double *at = built->cells[i].at[v];
            if (at[1] > b->low[1] + 1e-9 * b->diagonal)
                continue;
            points[count][0] = at[0];
            points[count++][1] = at[2];
        }
    const double centre[2] = {values[TN_SOLID_CENTRE_X_MEASURED], values[TN_SOLID_CENTRE_Z_MEASURED]};
    if (!tn_hull(points, &count)) {
        free(points);
        return tn_fail_memory(error);
    }
    values[TN_SOLID_FOOTPRINT_MEASURED] = tn_hull_area((const double(*)[2])points, count);
    values[TN_SOLID_STABLE_MEASURED] = tn_hull_depth((const double(*)[2])points, count, centre);
    free(points);
    return TN_OK;
}

/* ---- clipped faces against other boxes */

static bool cap_middle(const tn_cut_box *cell, double middle[3])
{
    for (uint32_t f = 0; f < cell->face_count; f++) {
        const tn_cut_box_face *face = &cell->faces[f];
        if (face->side != TN_CUT_BOX_CAP)
            continue;
        for (int k = 0; k < 3; k++) {
            middle[k] = 0;
            for (uint32_t c = 0; c < face->count; c++)
                middle[k] += cell->at[face->corner[c]][k] / face->count;
        }
        return true;
    }
    return false;
}

static bool near_box(const tn_cut_box *cell, const double p[3], double reach)
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double out = fmax(0, fmax(cell->low[k] - p[k], p[k] - cell->high[k]));
        square += out * out;
    }
    return cell->face_count > 0 && square <= reach * reach;
}

/* The first other cell whose box is within reach of a point, or UINT32_MAX. */
static uint32_t cell_near(const tn_built *built, const tn_box_tree *tree, uint32_t but, const double p[3], double reach)
{
    tn_box_bounds around;
    tn_box_search search;
    uint32_t found, first = UINT32_MAX;
    for (int k = 0; k < 3; k++) {
        around.low[k] = p[k] - reach;
        around.high[k] = p[k] + reach;
    }
    tn_box_tree_search(tree, &around, &search);
    while (tn_box_search_next(&search, &found))
        if (found != but && found < first && near_box(&built->cells[found], p, reach))
            first = found;
    return first;
}

tn_status tn_built_inward(const tn_built *built, uint32_t **others, tn_error *error)
{
    double reach = 1e-6 * find_bounds(built).diagonal, middle[3];
    tn_box_tree tree = {0};
    tn_box_bounds *boxes = malloc((built->cell_count + 1) * sizeof *boxes);
    *others = malloc((built->cell_count + 1) * sizeof **others);
    for (size_t i = 0; boxes && i < built->cell_count; i++) {
        const tn_cut_box *c = &built->cells[i];
        boxes[i] = (tn_box_bounds){{c->low[0], c->low[1], c->low[2]}, {c->high[0], c->high[1], c->high[2]}};
    }
    tn_status status =
        *others && boxes ? tn_box_tree_make(boxes, (uint32_t)built->cell_count, &tree, error) : tn_fail_memory(error);
    for (uint32_t i = 0; i < built->cell_count && status == TN_OK; i++)
        (*others)[i] = cap_middle(&built->cells[i], middle) ? cell_near(built, &tree, i, middle, reach) : UINT32_MAX;
    tn_box_tree_clear(&tree);
    free(boxes);
    if (status != TN_OK) {
        free(*others);
        *others = NULL;
    }
    return status;
}

static tn_status measure_inward(const tn_built *built, double *values, tn_error *error)
{
    uint32_t *others;
    double count = 0;
    tn_status status = tn_built_inward(built, &others, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < built->cell_count; i++)
        count += others[i] != UINT32_MAX;
    values[TN_SOLID_INWARD_MEASURED] = count;
    free(others);
    return TN_OK;
}

/* ---- of the union */

static double area_of(const tn_mesh *mesh)
{
    double area = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        double n[3];
        tn_mesh_face_normal(mesh, mesh->corners + 3 * f, 3, n);
        area += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
    }
    return area;
}

static uint32_t find(uint32_t *parent, uint32_t x)
{
    while (parent[x] != x) {
        parent[x] = parent[parent[x]];
        x = parent[x];
    }
    return x;
}

static int widest_first(const void *a, const void *b)
{
    const tn_contact *x = a, *y = b;
    if (x->area != y->area)
        return x->area > y->area ? -1 : 1;
    if (x->a != y->a)
        return x->a < y->a ? -1 : 1;
    return x->b < y->b ? -1 : x->b > y->b;
}

/* Parts, and the least contact of the strongest forest. Contacts come to be in another order. */
static tn_status count_parts(const tn_built *built, tn_contacts *contacts, double *values, tn_error *error)
{
    uint32_t *parent = malloc((built->cell_count + 1) * sizeof *parent), parts = 0;
    double weakest = 0;
    if (!parent)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < built->cell_count; i++) {
        parent[i] = i;
        parts += built->cells[i].face_count > 0;
    }
    if (contacts->count)
        qsort(contacts->items, contacts->count, sizeof *contacts->items, widest_first);
    for (size_t i = 0; i < contacts->count; i++) {
        const tn_contact *contact = &contacts->items[i];
        uint32_t a = find(parent, contact->a), b = find(parent, contact->b);
        if (a == b)
            continue;
        parent[a] = b;
        parts--;
        weakest = contact->area;
    }
    values[TN_SOLID_PARTS_MEASURED] = parts;
    values[TN_SOLID_WEAKEST_MEASURED] = weakest;
    free(parent);
    return TN_OK;
}

static tn_status measure_parts(const tn_built *built, double *values, tn_error *error)
{
    tn_contacts contacts;
    tn_status status = tn_contacts_find(built->cells, built->cell_count, TN_CONTACT_LEAST, &contacts, error);
    if (status == TN_OK)
        status = count_parts(built, &contacts, values, error);
    tn_contacts_clear(&contacts);
    return status;
}

static tn_status measure_surface(const tn_built *built, const bounds *b, double *values, tn_error *error)
{
    tn_union u;
    tn_status status = tn_union_make(built->cells, built->cell_count, &u, error);
    if (status == TN_OK) {
        values[TN_SOLID_AREA_MEASURED] = area_of(&u.mesh);
        values[TN_SOLID_OVERHANG_MEASURED] = mesh_overhang(&u.mesh, b->low[1], 1e-9 * b->diagonal);
    }
    tn_union_clear(&u);
    return status;
}

#define ASKED(NAME) (mask >> TN_SOLID_##NAME##_MEASURED & 1)

static tn_status measure_plan(const tn_built *built, const bounds *b, uint64_t mask, double *values, tn_error *error)
{
    double *shadows = values + TN_SOLID_SHADOW_X_MEASURED, sloping;
    tn_status status = TN_OK;
    for (int axis = 0; axis < 3 && status == TN_OK; axis++)
        if (mask >> (TN_SOLID_SHADOW_X_MEASURED + axis) & 1 || (axis == 1 && ASKED(SUPPORT)))
            status = built_shadow(built, axis, &shadows[axis], error);
    if (status != TN_OK || !ASKED(SUPPORT))
        return status;
    status = built_sloping(built, 1e-9 * b->diagonal, &sloping, error);
    if (status == TN_OK)
        values[TN_SOLID_SUPPORT_MEASURED] = shadows[1] > 0 ? fmax(0, 1 - sloping / shadows[1]) : 0;
    return status;
}

tn_status tn_built_measure(const tn_built *built, uint64_t mask, double values[TN_SOLID_MEASURED_COUNT],
                           tn_error *error)
{
    bounds b = find_bounds(built);
    tn_status status = TN_OK;
    for (int k = 0; k < 3; k++)
        values[TN_SOLID_WIDTH_MEASURED + k] = b.high[k] - b.low[k];
    measure_boxes(built, values);
    measure_mass(built, values);
    if (ASKED(STABLE) || ASKED(FOOTPRINT))
        status = measure_footprint(built, &b, values, error);
    if (status == TN_OK && ASKED(INWARD))
        status = measure_inward(built, values, error);
    if (status == TN_OK)
        status = measure_plan(built, &b, mask, values, error);
    if (status == TN_OK && (ASKED(PARTS) || ASKED(WEAKEST)))
        status = measure_parts(built, values, error);
    if (status == TN_OK && (ASKED(AREA) || ASKED(OVERHANG)))
        status = measure_surface(built, &b, values, error);
    return status;
}
