/* Takes the drawings of a house: cuts it, looks at it from where the drawing is seen, and adds its marks. */
#include "runtime/house/model/aspect.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/base/length.h"
#include "runtime/base/utf8.h"

#define PLAN_CUT_NM INT64_C(1219200000) /* 4' */
#define INTO_NM 1000.0                  /* less than one sees */

const uint32_t tn_solid_groups[TN_SOLID_COUNT] = {
    [TN_SOLID_OUTSIDE] = TN_GROUP_WALL, [TN_SOLID_PARTY] = TN_GROUP_WALL,    [TN_SOLID_PARTITION] = TN_GROUP_WALL,
    [TN_SOLID_POST] = TN_GROUP_WALL,    [TN_SOLID_DECK] = TN_GROUP_FLOOR,    [TN_SOLID_ROOFDECK] = TN_GROUP_FLOOR,
    [TN_SOLID_ITEM] = TN_GROUP_ITEM,    [TN_SOLID_ROOF] = TN_GROUP_ROOF,     [TN_SOLID_PANE] = TN_GROUP_PANE,
    [TN_SOLID_LEAF] = TN_GROUP_LEAF,    [TN_SOLID_FLIGHT] = TN_GROUP_FLIGHT, [TN_SOLID_GUARD] = TN_GROUP_GUARD,
    [TN_SOLID_GABLE] = TN_GROUP_WALL,   [TN_SOLID_BEAM] = TN_GROUP_FLOOR,
};

void tn_house_projection_clear(tn_house_projection *projection)
{
    tn_mesh_clear(&projection->mesh);
    free(projection->lines);
    free(projection->cuts);
    free(projection->layers);
    free(projection->joints);
    tn_marks_clear(&projection->marks);
    *projection = (tn_house_projection){0};
}

/* Looking level at a side, or straight down with the front below. */
static tn_camera camera_of(const tn_aspect *aspect)
{
    static const double sides[] = {[TN_HOUSE_ANY_SIDE] = 0,
                                   [TN_HOUSE_BACK] = -90,
                                   [TN_HOUSE_FRONT] = 90,
                                   [TN_HOUSE_LEFT] = 180,
                                   [TN_HOUSE_RIGHT] = 0};
    double width = tn_camera_default().width;
    switch (aspect->kind) {
    case TN_ASPECT_PLAN:
    case TN_ASPECT_ROOF:
        return (tn_camera){90, 90, width};
    case TN_ASPECT_SECTION_X:
        return (tn_camera){0, 0, width};
    case TN_ASPECT_SECTION_Y:
        return (tn_camera){90, 0, width};
    case TN_ASPECT_ELEVATION:
        return (tn_camera){sides[aspect->side], 0, width};
    default:
        return aspect->camera;
    }
}

/* In the house's unit; a place that is no length of feet and inches is in metres. */
static void write_place(int64_t at, tn_length_style style, char *text, size_t size)
{
    static const int64_t least = 25400000 / 64; /* of an inch */
    bool whole = style != TN_STYLE_FEET || at % least == 0;
    tn_length_write_style(at, whole ? style : TN_STYLE_METRES, text, size);
}

static void write_title(const tn_house *house, const tn_aspect *aspect, char *text, size_t size)
{
    static const char *const sides[] = {[TN_HOUSE_ANY_SIDE] = "",
                                        [TN_HOUSE_BACK] = "back",
                                        [TN_HOUSE_FRONT] = "front",
                                        [TN_HOUSE_LEFT] = "left",
                                        [TN_HOUSE_RIGHT] = "right"};
    const tn_house_form *form = house->form;
    char at[64], name[51];
    write_place(aspect->at < 0 ? -aspect->at : aspect->at, tn_house_length_style(house), at, sizeof at);
    switch (aspect->kind) {
    case TN_ASPECT_PLAN:
        tn_utf8_copy(
            tn_text(form->module, form->module->STOREY_records[form->record->storey_first + aspect->storey].name),
            sizeof name, name);
        snprintf(text, size, "plan, %s", name);
        return;
    case TN_ASPECT_ROOF:
        snprintf(text, size, "plan, roof");
        return;
    case TN_ASPECT_SECTION_X:
    case TN_ASPECT_SECTION_Y:
        snprintf(text, size, "section %c = %s%s", aspect->kind == TN_ASPECT_SECTION_X ? 'x' : 'y',
                 aspect->at < 0 ? "-" : "", at);
        return;
    case TN_ASPECT_ELEVATION:
        snprintf(text, size, "%s elevation", sides[aspect->side]);
        return;
    default:
        snprintf(text, size, aspect->storeys ? "axonometric, roof off" : "axonometric");
    }
}

/* Doors are drawn open on plans, and panes and furniture by symbols; this is left out where it is not wanted. */
static void drop_parts(tn_blocks *blocks, const tn_aspect *aspect)
{
    size_t kept = 0;
    for (size_t i = 0; i < blocks->count; i++) {
        tn_solid_kind kind = blocks->items[i].kind;
        bool plan = aspect->kind == TN_ASPECT_PLAN || aspect->kind == TN_ASPECT_ROOF;
        if (((kind == TN_SOLID_LEAF || kind == TN_SOLID_PANE) && plan) ||
            (kind == TN_SOLID_ITEM && (plan || aspect->bare)))
            continue;
        blocks->items[kept++] = blocks->items[i];
    }
    blocks->count = kept;
}

/* What stands above the storeys that are shown: their walls end at the deck. */
static void drop_above(const tn_house *house, tn_blocks *blocks, uint32_t storeys)
{
    double level = (double)(house->form->level[storeys] - house->form->record->deck);
    size_t kept = 0;
    for (size_t i = 0; i < blocks->count; i++) {
        const tn_house_block *block = &blocks->items[i];
        bool roof = block->kind == TN_SOLID_ROOF || block->kind == TN_SOLID_GABLE;
        bool shown = roof ? house->cells[block->of].storey + 1 < storeys : block->low[2] < level;
        if (shown)
            blocks->items[kept++] = *block;
    }
    blocks->count = kept;
}

int64_t tn_plan_level(const tn_house_form *form, uint32_t storey)
{
    int64_t clear = tn_form_clear(form, storey);
    return form->level[storey] + (clear > PLAN_CUT_NM ? PLAN_CUT_NM : clear / 2);
}

/* Furniture and stairs that are cut are drawn like the rest of them, not hatched. */
static void drop_item_cuts(tn_blocks *blocks, bool plan)
{
    size_t kept = 0;
    for (size_t i = 0; i < blocks->cut_count; i++)
        if (blocks->cuts[i].kind != TN_SOLID_ITEM && (!plan || blocks->cuts[i].kind != TN_SOLID_FLIGHT))
            blocks->cuts[kept++] = blocks->cuts[i];
    blocks->cut_count = kept;
}

/* Do two blocks of one part of the house meet in the plane across the axis? */
static bool meet(const tn_house_block *below, const tn_house_block *above, int axis, double at)
{
    bool meet = below->kind == above->kind && below->high[axis] == at && above->low[axis] == at;
    for (int k = 0; k < 3; k++)
        meet = meet && (k == axis || (below->low[k] < above->high[k] && above->low[k] < below->high[k]));
    return meet;
}

/* Where a section is cut: at the place, or where blocks meet there that are one deck or wall, a little way into what is
 * drawn, so that they are cut and not seen from beside. */
static double off_joints(const tn_blocks *blocks, int axis, double at, double into)
{
    for (size_t i = 0; i < blocks->count; i++)
        for (size_t k = 0; blocks->items[i].high[axis] == at && k < blocks->count; k++)
            if (meet(&blocks->items[i], &blocks->items[k], axis, at))
                return at + into;
    return at;
}

/* Cuts the blocks; *axis, *at: by which plane, if there is one. */
static tn_status cut(const tn_house *house, const tn_aspect *aspect, tn_blocks *blocks, int *axis, double *at,
                     tn_error *error)
{
    drop_parts(blocks, aspect);
    switch (aspect->kind) {
    case TN_ASPECT_PLAN:
        *axis = 2;
        *at = (double)tn_plan_level(house->form, aspect->storey);
        return tn_blocks_cut(blocks, 2, *at, false, error);
    case TN_ASPECT_SECTION_X:
        *axis = 0;
        *at = off_joints(blocks, 0, (double)aspect->at, -INTO_NM);
        return tn_blocks_cut(blocks, 0, *at, false, error);
    case TN_ASPECT_SECTION_Y:
        *axis = 1;
        *at = off_joints(blocks, 1, (double)aspect->at, -INTO_NM);
        return tn_blocks_cut(blocks, 1, *at, false, error);
    default:
        if (aspect->storeys && aspect->storeys <= house->form->record->storey_count)
            drop_above(house, blocks, aspect->storeys);
        return TN_OK;
    }
}

const tn_cut_layer *tn_joint_layer(const tn_house_projection *projection, const tn_drawn_line *joint)
{
    const tn_cut_layer *layer = projection->layers;
    while (layer->layer != joint->group)
        layer++;
    return layer;
}

static void measure(tn_house_projection *projection)
{
    tn_eye eye = tn_camera_eye(&projection->camera);
    for (int k = 0; k < 2; k++) {
        projection->low[k] = INFINITY;
        projection->high[k] = -INFINITY;
    }
    for (size_t v = 0; v < projection->mesh.vertex_count; v++) {
        tn_vector seen = tn_eye_sees(&eye, tn_vector_at(projection->mesh.positions + 3 * v));
        projection->low[0] = fmin(projection->low[0], seen.x);
        projection->high[0] = fmax(projection->high[0], seen.x);
        projection->low[1] = fmin(projection->low[1], seen.y);
        projection->high[1] = fmax(projection->high[1], seen.y);
    }
}

static tn_status missed(const tn_house *house, const tn_aspect *aspect, const tn_house_projection *projection,
                        tn_error *error)
{
    tn_status status;
    if (house->cell_count == 0) {
        status = tn_fail(error, TN_INVALID, E_BAD_HOUSE, "the house has no cell, so there is nothing to draw");
        tn_error_help(error, "models and lists of it are written, though they are empty");
        return status;
    }
    if (aspect->kind == TN_ASPECT_PLAN) {
        status = tn_fail(error, TN_INVALID, E_USAGE, "the drawing `%s` would be empty: the house has no room there",
                         projection->title);
        tn_error_help(error, "options say how many storeys zones have");
        return status;
    }
    status = tn_fail(error, TN_INVALID, E_USAGE, "the %s cuts nothing of the house", projection->title);
    tn_error_help(error, "%s",
                  aspect->kind == TN_ASPECT_SECTION_X
                      ? "x is 0 at the left of the first tray, and grows to the right"
                      : "y is 0 at the back of the spine, and grows to the front; zones behind the spine are negative");
    return status;
}

static bool misses(const tn_house *house, const tn_aspect *aspect, const tn_blocks *blocks)
{
    if (aspect->kind == TN_ASPECT_PLAN)
        return !tn_house_has_storey(house, aspect->storey);
    if (aspect->kind == TN_ASPECT_ROOF)
        return house->cell_count == 0;
    return (aspect->kind == TN_ASPECT_SECTION_X || aspect->kind == TN_ASPECT_SECTION_Y) && blocks->cut_count == 0;
}

tn_status tn_house_projection_mark(const tn_house *house, const tn_mark_style *style, tn_house_projection *projection,
                                   tn_error *error)
{
    tn_mark_style own = *style;
    own.bare = projection->aspect.bare;
    tn_marks_clear(&projection->marks);
    switch (projection->aspect.kind) {
    case TN_ASPECT_AXONOMETRIC:
        return TN_OK;
    case TN_ASPECT_ROOF:
        return tn_marks_roof(house, projection->low, projection->high, style, &projection->marks, error);
    case TN_ASPECT_PLAN:
        return tn_marks_plan(house, projection->aspect.storey, &own, &projection->marks, error);
    default:
        return tn_marks_levels(house, projection->low, projection->high, projection->aspect.kind != TN_ASPECT_ELEVATION,
                               style, &projection->marks, error);
    }
}

static void stretch(double low[2], double high[2], double u, double v, double half_u, double half_v)
{
    low[0] = fmin(low[0], u - half_u);
    high[0] = fmax(high[0], u + half_u);
    low[1] = fmin(low[1], v - half_v);
    high[1] = fmax(high[1], v + half_v);
}

void tn_house_projection_extent(const tn_house_projection *projection, double low[2], double high[2])
{
    for (int k = 0; k < 2; k++) {
        low[k] = projection->low[k];
        high[k] = projection->high[k];
    }
    for (size_t i = 0; i < projection->marks.count; i++) {
        const tn_mark *m = &projection->marks.items[i];
        bool span = m->kind == TN_MARK_SPAN;
        double radius = m->kind == TN_MARK_NORTH ? m->u1 - m->u0 : 0;     /* its arrow may point anywhere */
        bool sized = m->kind != TN_MARK_PANE && m->kind != TN_MARK_NORTH; /* whose `high` is something else */
        double wide = sized ? tn_mark_width(m->text) * m->high / 2 : 0,
               tall = !sized ? 0
                      : span ? (m->below ? 1.6 : 1.25) * m->high
                             : m->high / 2,
               u = span ? (m->u0 + m->u1) / 2 : m->u0, v = span ? (m->v0 + m->v1) / 2 : m->v0;
        stretch(low, high, u, v, m->upright ? tall : wide, m->upright ? wide : tall);
        stretch(low, high, m->u0, m->v0, radius, radius);
        stretch(low, high, m->u1, m->v1, 0, 0);
    }
}

/* What was cut, as the camera sees it: from the front and from above it sees x to the left, from above y downwards. */
static void turn_cuts(tn_house_projection *p)
{
    bool turn[2] = {p->aspect.kind == TN_ASPECT_PLAN || p->aspect.kind == TN_ASPECT_SECTION_Y,
                    p->aspect.kind == TN_ASPECT_PLAN};
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; turn[k] && i < p->cut_count; i++)
            for (int corner = 0; corner < 4; corner++)
                p->cuts[i].at[corner][k] = -p->cuts[i].at[corner][k];
        for (size_t i = 0; turn[k] && i < p->layer_count; i++) {
            tn_cut_layer *layer = &p->layers[i];
            for (int corner = 0; corner < 4; corner++)
                layer->at[corner][k] = -layer->at[corner][k];
        }
        for (size_t i = 0; turn[k] && i < p->joint_count; i++)
            for (int end = 0; end < 2; end++)
                p->joints[i].at[end][k] = -p->joints[i].at[end][k];
    }
}

static uint32_t group_of(const tn_house *house, const tn_grouping *grouping, const tn_house_block *block)
{
    uint32_t own = grouping ? grouping->group(house, block) : 0;
    return tn_solid_groups[block->kind] + TN_GROUP_COUNT * own;
}

static void group_blocks(const tn_house *house, const tn_grouping *grouping, tn_blocks *blocks)
{
    for (size_t i = 0; i < blocks->count; i++)
        blocks->items[i].group = group_of(house, grouping, &blocks->items[i]);
}

/* Walls, floors and roofs weigh; what stands in them or is climbed is thin, and so is all that is seen in space. */
static tn_line_weight weight_of(const void *context, uint32_t group, bool is_cut)
{
    const tn_aspect *aspect = context;
    uint32_t kind = group % TN_GROUP_COUNT;
    bool heavy = kind == TN_GROUP_WALL || kind == TN_GROUP_FLOOR || kind == TN_GROUP_ROOF ||
                 (kind == TN_GROUP_FLIGHT && is_cut && aspect->kind != TN_ASPECT_PLAN);
    return !heavy || aspect->kind == TN_ASPECT_AXONOMETRIC ? TN_STROKE_THIN : is_cut ? TN_STROKE_CUT : TN_STROKE_SEEN;
}

tn_status tn_house_projection_take(const tn_house *house, const tn_solids *solids, const tn_aspect *aspect,
                                   const tn_grouping *grouping, tn_house_projection *projection, tn_error *error)
{
    tn_blocks blocks;
    int axis = -1;
    double at = 0;
    *projection = (tn_house_projection){.aspect = *aspect, .camera = camera_of(aspect)};
    write_title(house, aspect, projection->title, sizeof projection->title);
    tn_status status = tn_blocks_of(house, solids, &blocks, error);
    if (status == TN_OK && aspect->kind != TN_ASPECT_PLAN)
        status = tn_house_part_floors(house, &blocks, error);
    if (status == TN_OK)
        status = cut(house, aspect, &blocks, &axis, &at, error);
    if (status == TN_OK && misses(house, aspect, &blocks))
        status = missed(house, aspect, projection, error);
    if (status == TN_OK) {
        group_blocks(house, grouping, &blocks);
        status =
            tn_blocks_mesh(&blocks, TN_GROUP_COUNT * (1 + (grouping ? grouping->more : 0)), &projection->mesh, error);
    }
    if (status == TN_OK && axis != 2)
        tn_house_face_floors(house, grouping, axis, at, &projection->mesh);
    if (status == TN_OK)
        status =
            tn_house_lines(&projection->mesh, &projection->camera, axis >= 0, &(tn_line_weights){aspect, weight_of},
                           &projection->lines, &projection->line_count, error);
    if (status == TN_OK && axis >= 0)
        status = tn_cut_layers(house, solids, axis, at, projection, error);
    drop_item_cuts(&blocks, aspect->kind == TN_ASPECT_PLAN);
    if (status == TN_OK) {
        projection->cuts = blocks.cuts;
        projection->cut_count = blocks.cut_count;
        blocks.cuts = NULL;
        turn_cuts(projection);
        measure(projection);
    }
    tn_blocks_clear(&blocks);
    return status;
}
