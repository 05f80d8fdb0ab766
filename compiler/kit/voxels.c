/* Spaces that files give: a mesh, a height map or a model becomes a bit for each cell when the kit is compiled, so that
 * a module needs no other file. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/kit/kit.h"
#include "runtime/geometry/winding.h"
#include "runtime/place/picture/heights_png.h"

static const double mm = 2.5; /* LDU */

tn_request tn_kit_request(const tn_kit *kit, const tn_kit_node *node)
{
    return (tn_request){node->doc.text, "", kit->diagnostics->sources->files[node->span.file].path};
}

void tn_kit_file_failed(tn_kit *kit, const tn_kit_node *node, tn_status status, const tn_error *error)
{
    if (status == TN_MEMORY) {
        kit->out_of_memory = true;
        return;
    }
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_FILE, node->doc.span, "`%.200s` cannot be used: %.300s",
                                 node->doc.text, error->message);
    tn_help(kit->diagnostics, d, "%s",
            error->help[0] ? error->help : "a mesh is OBJ, PLY, STL or OFF, a height map PNG or PGM, a model LDraw");
}

/* ---- cells */

static void too_many(tn_kit *kit, const tn_kit_node *node, const char *what)
{
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_TOO_MANY, node->span, "%s", what);
    tn_help(kit->diagnostics, d, "spaces from files have at most %d cells together, and stand at %u places",
            64 * TN_MASK_WORDS_MAX, TN_KIT_MASKS_MAX);
}

/* Room for the cells of a box in LDU, y upwards. */
static bool make_room(tn_kit *kit, tn_kit_voxels *voxels, const double low[3], const double high[3])
{
    double cells = 1;
    for (int k = 0; k < 3; k++) {
        double unit = (double)kit->unit[k] / 1e6;
        double from = floor((k == 1 ? -high[k] : low[k]) / unit), to = ceil((k == 1 ? -low[k] : high[k]) / unit);
        if (!(from > -TN_PLACE_FAR && to < TN_PLACE_FAR)) {
            too_many(kit, voxels->node, "this space reaches too far");
            return false;
        }
        voxels->low[k] = (int32_t)from;
        voxels->size[k] = (uint32_t)(to - from);
        cells *= to - from;
    }
    if (kit->voxels_count == TN_KIT_MASKS_MAX || cells > 64.0 * (TN_MASK_WORDS_MAX - (double)kit->voxel_words)) {
        too_many(kit, voxels->node,
                 kit->voxels_count == TN_KIT_MASKS_MAX ? "spaces from files stand at too many places"
                                                       : "spaces from files have too many cells");
        return false;
    }
    voxels->words = ((size_t)cells + 63) / 64;
    voxels->bits = TN_NEW_ARRAY(kit->arena, uint64_t, voxels->words + 1);
    kit->voxel_words += voxels->words;
    return voxels->bits != NULL;
}

/* The middle of a cell, in LDU from the placement, turned back. */
static void place_in(const tn_kit *kit, const tn_kit_voxels *voxels, const uint32_t cell[3], double place[3])
{
    for (int k = 0; k < 3; k++) {
        double unit = (double)kit->unit[k] / 1e6, middle = (voxels->low[k] + (double)cell[k] + 0.5) * unit;
        place[k] = (k == 1 ? -middle : middle) - voxels->placement.at[k];
    }
    for (uint32_t t = 0; t < voxels->placement.turns % 4; t++) {
        double x = place[0];
        place[0] = place[2];
        place[2] = -x;
    }
}

/* Is this place inside? */
typedef bool holds(const void *context, const double place[3]);

static void fill_where(const tn_kit *kit, tn_kit_voxels *voxels, holds *inside, const void *context)
{
    size_t bit = 0;
    uint32_t cell[3];
    for (cell[1] = 0; cell[1] < voxels->size[1]; cell[1]++) {
        for (cell[2] = 0; cell[2] < voxels->size[2]; cell[2]++) {
            for (cell[0] = 0; cell[0] < voxels->size[0]; cell[0]++, bit++) {
                double place[3];
                place_in(kit, voxels, cell, place);
                if (inside(context, place))
                    voxels->bits[bit / 64] |= UINT64_C(1) << bit % 64;
            }
        }
    }
}

/* A box about the placement's origin, turned and moved to where it is. */
static void box_at(const tn_space_placement *placement, const double from[3], const double to[3], double low[3],
                   double high[3])
{
    double a[2] = {from[0], from[2]}, b[2] = {to[0], to[2]};
    for (uint32_t t = 0; t < placement->turns % 4; t++) {
        double x[2] = {a[0], b[0]};
        a[0] = -b[1];
        b[0] = -a[1];
        a[1] = x[0];
        b[1] = x[1];
    }
    for (int k = 0; k < 3; k++) {
        low[k] = placement->at[k] + (k == 1 ? from[1] : a[k / 2]);
        high[k] = placement->at[k] + (k == 1 ? to[1] : b[k / 2]);
    }
}

/* ---- meshes */

/* Which of a file's axes is up: z, or y where that was written. */
static bool read_upright(tn_kit *kit, const tn_kit_node *node, bool *y_up)
{
    const char *source = kit->diagnostics->sources->files[node->span.file].text;
    *y_up = false;
    if (!node->other.text)
        return true;
    bool up = strncasecmp(source + node->other.span.end - 2, "up", 2) == 0;
    *y_up = strcasecmp(node->other.text, "y") == 0;
    if (up && (*y_up || strcasecmp(node->other.text, "z") == 0))
        return true;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_SPACE, node->other.span, "this does not say what is up");
    tn_help(kit->diagnostics, d, "in most files z is up; otherwise write `mesh(\"x.obj\" y up, 20 bricks)`");
    return false;
}

static bool mesh_bounds(const tn_mesh *mesh, double low[3], double high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
    }
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++) {
        double at = mesh->positions[i];
        if (!isfinite(at))
            return false;
        low[i % 3] = fmin(low[i % 3], at);
        high[i % 3] = fmax(high[i % 3], at);
    }
    return mesh->vertex_count > 0 && mesh->face_count > 0;
}

/* Puts the mesh on the floor of its placement: x, z and the height, in LDU. */
static void lay_mesh(tn_mesh *mesh, const tn_space_placement *placement, double scale, const double low[3],
                     const double high[3])
{
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        double *p = mesh->positions + 3 * v;
        double x = (p[0] - (low[0] + high[0]) / 2) * scale, z = (p[1] - (low[1] + high[1]) / 2) * scale;
        for (uint32_t t = 0; t < placement->turns % 4; t++) {
            double before = x;
            x = -z;
            z = before;
        }
        p[0] = x + placement->at[0];
        p[1] = z + placement->at[2];
        p[2] = (p[2] - low[2]) * scale + placement->at[1];
    }
}

static void turn_up(tn_mesh *mesh)
{
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        double *p = mesh->positions + 3 * v, y = p[1];
        p[1] = -p[2];
        p[2] = y;
    }
}

/* An open mesh has no inside. */
static bool is_closed(tn_kit *kit, const tn_kit_node *node, const tn_mesh *mesh)
{
    size_t count;
    double ends[2][3];
    tn_error error;
    if (tn_mesh_opening(mesh, &count, ends, &error) != TN_OK) {
        kit->out_of_memory = true;
        return false;
    }
    if (count == 0)
        return true;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_MESH_OPEN, node->doc.span,
                                 "`%.200s` is open along %zu edge%s, the first from (%.10g, %.10g, %.10g) to (%.10g, "
                                 "%.10g, %.10g): it has no inside",
                                 node->doc.text, count, count == 1 ? "" : "s", ends[0][0], ends[0][1], ends[0][2],
                                 ends[1][0], ends[1][1], ends[1][2]);
    tn_help(kit->diagnostics, d, "close it in the program that made it: each edge has a face on both sides");
    return false;
}

static bool fill_mesh(tn_kit *kit, tn_kit_voxels *voxels, tn_mesh *mesh, double height)
{
    double low[3], high[3], from[3], to[3];
    tn_error error;
    if (!mesh_bounds(mesh, low, high)) {
        tn_fail(&error, TN_INVALID, TN_CODE_NONE, "it has no faces, or places that are no numbers");
        tn_kit_file_failed(kit, voxels->node, TN_INVALID, &error);
        return false;
    }
    double scale = height > 0 && high[2] > low[2] ? height / (high[2] - low[2]) : mm;
    lay_mesh(mesh, &voxels->placement, scale, low, high);
    mesh_bounds(mesh, low, high);
    for (int k = 0; k < 3; k++) { /* x, z, height to x, height, z */
        from[k] = low[k == 0 ? 0 : 3 - k];
        to[k] = high[k == 0 ? 0 : 3 - k];
    }
    if (!make_room(kit, voxels, from, to))
        return false;
    const tn_mesh_grid grid = {
        {voxels->low[0], voxels->low[2], voxels->low[1]},
        {(double)kit->unit[0] / 1e6, (double)kit->unit[2] / 1e6, -(double)kit->unit[1] / 1e6},
        {voxels->size[0], voxels->size[2], voxels->size[1]},
    };
    tn_status status = tn_mesh_fill_grid(mesh, &grid, voxels->bits, &error);
    if (status != TN_OK)
        tn_kit_file_failed(kit, voxels->node, status, &error);
    return status == TN_OK;
}

static const tn_kit_extents mesh_extents = {{"height"}, 1, "mesh(\"statue.stl\", 20 bricks): how high it is"};

static bool make_mesh(tn_kit *kit, tn_kit_voxels *voxels)
{
    const tn_kit_node *node = voxels->node;
    double size[3] = {0};
    bool y_up;
    tn_mesh mesh = {0};
    tn_error error = {0};
    if ((node->inner.first && !tn_kit_sizes(kit, node, &mesh_extents, size)) || !read_upright(kit, node, &y_up))
        return false;
    const tn_request request = tn_kit_request(kit, node);
    tn_status status = kit->attachments->mesh(kit->attachments->context, &request, &mesh, &error);
    if (status == TN_OK && y_up)
        turn_up(&mesh);
    bool made = status == TN_OK && is_closed(kit, node, &mesh);
    if (made)
        status = tn_mesh_triangulate(&mesh, &error);
    if (status != TN_OK)
        tn_kit_file_failed(kit, node, status, &error);
    made = made && status == TN_OK && fill_mesh(kit, voxels, &mesh, size[0]);
    tn_mesh_clear(&mesh);
    return made;
}

/* ---- height maps */

typedef struct hill {
    const tn_heights *heights;
    const double *size; /* width, height, depth */
} hill;

/* The picture's lower side is the front. */
static bool hill_holds(const void *context, const double place[3])
{
    const hill *h = context;
    double across = place[0] / h->size[0] + 0.5, down = 0.5 - place[2] / h->size[2];
    return place[1] > 0 && across >= 0 && across <= 1 && down >= 0 && down <= 1 &&
           place[1] <= h->size[1] * tn_heights_at(h->heights, across, down);
}

static const tn_kit_extents hill_extents = {
    {"width", "height", "depth"},
    3,
    "heightmap(\"hill.pgm\", 32 studs, 10 bricks, 32 studs): width, height of what is white, and depth"};

static bool make_hill(tn_kit *kit, tn_kit_voxels *voxels)
{
    const tn_kit_node *node = voxels->node;
    double size[3], low[3], high[3];
    uint8_t *bytes = NULL;
    size_t count = 0;
    tn_heights heights = {0};
    tn_error error = {0};
    if (!tn_kit_sizes(kit, node, &hill_extents, size))
        return false;
    const double from[3] = {-size[0] / 2, 0, -size[2] / 2}, to[3] = {size[0] / 2, size[1], size[2] / 2};
    const tn_request request = tn_kit_request(kit, node);
    tn_status status = kit->attachments->bytes(kit->attachments->context, &request, &bytes, &count, &error);
    if (status == TN_OK)
        status = (tn_is_png(bytes, count) ? tn_heights_read_png : tn_heights_read)(bytes, count, &heights, &error);
    free(bytes);
    box_at(&voxels->placement, from, to, low, high);
    bool made = status == TN_OK && make_room(kit, voxels, low, high);
    if (made)
        fill_where(kit, voxels, hill_holds, &(hill){&heights, size});
    else if (status != TN_OK)
        tn_kit_file_failed(kit, node, status, &error);
    tn_heights_clear(&heights);
    return made;
}

/* ---- models */

static void fill_box(tn_kit_voxels *voxels, const tn_cell_box *box)
{
    int32_t cell[3];
    for (cell[1] = box->low[1]; cell[1] < box->high[1]; cell[1]++) {
        for (cell[2] = box->low[2]; cell[2] < box->high[2]; cell[2]++) {
            for (cell[0] = box->low[0]; cell[0] < box->high[0]; cell[0]++) {
                size_t bit =
                    ((size_t)(cell[1] - voxels->low[1]) * voxels->size[2] + (size_t)(cell[2] - voxels->low[2])) *
                        voxels->size[0] +
                    (size_t)(cell[0] - voxels->low[0]);
                voxels->bits[bit / 64] |= UINT64_C(1) << bit % 64;
            }
        }
    }
}

/* The cells of the model where it stands. */
static bool make_standing(tn_kit *kit, tn_kit_voxels *voxels, const tn_kit_parts *parts)
{
    tn_cell_box all = {{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}}, box;
    double low[3], high[3];
    for (const tn_kit_stands *one = parts->first; one; one = one->next) {
        for (uint32_t i = 0; i < one->part->box_count; i++) {
            box = tn_kit_box_of(one, i);
            tn_cell_box_widen(&all, &box);
        }
    }
    for (int k = 0; k < 3; k++) {
        double unit = (double)kit->unit[k] / 1e6;
        low[k] = (k == 1 ? -(double)all.high[k] : all.low[k]) * unit;
        high[k] = (k == 1 ? -(double)all.low[k] : all.high[k]) * unit;
    }
    if (all.low[0] > all.high[0] || !make_room(kit, voxels, low, high))
        return false;
    for (int k = 0; k < 3; k++) { /* exactly, whatever dividing has left */
        voxels->low[k] = all.low[k];
        voxels->size[k] = (uint32_t)(all.high[k] - all.low[k]);
    }
    for (const tn_kit_stands *one = parts->first; one; one = one->next) {
        for (uint32_t i = 0; i < one->part->box_count; i++) {
            box = tn_kit_box_of(one, i);
            fill_box(voxels, &box);
        }
    }
    return true;
}

typedef struct standing {
    const tn_kit *kit;
    const tn_kit_voxels *voxels;
} standing;

static bool standing_holds(const void *context, const double place[3])
{
    const standing *s = context;
    uint64_t cell[3];
    for (int k = 0; k < 3; k++) {
        double unit = (double)s->kit->unit[k] / 1e6,
               at = floor((k == 1 ? -place[k] : place[k]) / unit) - s->voxels->low[k];
        if (!(at >= 0 && at < s->voxels->size[k]))
            return false;
        cell[k] = (uint64_t)at;
    }
    uint64_t bit = (cell[1] * s->voxels->size[2] + cell[2]) * s->voxels->size[0] + cell[0];
    return s->voxels->bits[bit / 64] >> bit % 64 & 1;
}

static bool make_model(tn_kit *kit, tn_kit_voxels *voxels)
{
    const tn_kit_parts *parts = tn_kit_parts_of_file(kit, voxels->node);
    tn_kit_voxels still = {.node = voxels->node};
    double from[3], to[3], low[3], high[3];
    if (!parts || !parts->first || !make_standing(kit, &still, parts))
        return false;
    for (int k = 0; k < 3; k++) {
        double unit = (double)kit->unit[k] / 1e6, end = still.low[k] + (double)still.size[k];
        from[k] = (k == 1 ? -end : still.low[k]) * unit;
        to[k] = (k == 1 ? -(double)still.low[k] : end) * unit;
    }
    kit->voxel_words -= still.words;
    box_at(&voxels->placement, from, to, low, high);
    if (!make_room(kit, voxels, low, high))
        return false;
    fill_where(kit, voxels, standing_holds, &(standing){kit, &still});
    return true;
}

/* ---- all */

static bool make(tn_kit *kit, tn_kit_voxels *voxels)
{
    static const char *const kinds[] = {"mesh", "heightmap", "model"};
    static bool (*const makers[])(tn_kit *, tn_kit_voxels *) = {make_mesh, make_hill, make_model};
    const tn_kit_text *name = &voxels->node->name;
    tn_error error;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (strcasecmp(kinds[i], name->text) != 0)
            continue;
        if (kit->attachments->bytes && kit->attachments->mesh)
            return makers[i](kit, voxels);
        tn_fail(&error, TN_INVALID, TN_CODE_NONE, "no files can be read here");
        tn_kit_file_failed(kit, voxels->node, TN_INVALID, &error);
        return false;
    }
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_SPACE, name->span, "`%.100s` takes no file", name->text);
    const char *near = tn_nearest(name->text, kinds, sizeof kinds / sizeof *kinds);
    if (near)
        tn_suggest(kit->diagnostics, d, "%s", near);
    else
        tn_help(kit->diagnostics, d, "spaces from files are mesh, heightmap and model");
    return false;
}

static const tn_kit_voxels *voxels_of(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *placement)
{
    tn_kit_voxels *voxels = kit->voxels_list.first;
    while (voxels && (voxels->node != node || memcmp(voxels->placement.at, placement->at, sizeof placement->at) != 0 ||
                      voxels->placement.turns % 4 != placement->turns % 4))
        voxels = voxels->next;
    if (voxels)
        return voxels;
    voxels = TN_NEW(kit->arena, tn_kit_voxels);
    if (!voxels)
        return NULL;
    voxels->node = node;
    voxels->placement = *placement;
    voxels->wrong = !make(kit, voxels);
    voxels->index = voxels->wrong ? 0 : kit->voxels_count++;
    TN_CHAIN(&kit->voxels_list, voxels);
    return voxels;
}

tn_kit_region tn_kit_region_of_file(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *placement)
{
    const tn_kit_voxels *voxels = voxels_of(kit, node, placement);
    tn_kit_region region = {.inside = NULL};
    if (!voxels || voxels->wrong)
        return region;
    tn_expression *e = tn_expression_name(kit->arena, node->span, tn_placed_terms[TN_PLACED_MASK + voxels->index]);
    if (!e)
        return region;
    e->term = TN_PLACED_MASK + voxels->index;
    region.inside = tn_expression_of(kit->arena, TN_OP_IS_ABOVE, node->span, e,
                                     tn_expression_number(kit->arena, node->span, 0), NULL);
    for (int k = 0; k < 3; k++) {
        double unit = (double)kit->unit[k] / 1e6, end = voxels->low[k] + (double)voxels->size[k];
        region.low[k] = (k == 1 ? -end : voxels->low[k]) * unit;
        region.high[k] = (k == 1 ? -(double)voxels->low[k] : end) * unit;
    }
    return region;
}
