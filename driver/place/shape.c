/* Turns placed models into faces. */
#include "driver/place/shape.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/place/bodies.h"
#include "runtime/base/array.h"
#include "runtime/geometry/union/union.h"
#include "runtime/place/grow.h"

typedef struct colour_groups {
    int32_t *items; /* LDraw colours */
    size_t count, capacity;
} colour_groups;

/* ---- LDraw's common colours, as its colour table gives them (LDConfig.ldr), to the nearest of 256 steps */

static const struct {
    int32_t number;
    uint32_t rgb;
} colours[] = {
    {0, 0x1b2a34},   {1, 0x1e5aa8},   {2, 0x00852b},   {3, 0x069d9f},   {4, 0xb40000},   {5, 0xd3359d},
    {6, 0x543324},   {7, 0x8a928d},   {8, 0x545955},   {9, 0x97cbd9},   {10, 0x58ab41},  {14, 0xfac80a},
    {15, 0xf4f4f4},  {19, 0xb0a06f},  {22, 0x671f81},  {25, 0xd67923},  {26, 0x901f76},  {27, 0xa5ca18},
    {28, 0x897d62},  {70, 0x5f3109},  {71, 0xa3a2a4},  {72, 0x646464},  {73, 0x7396c8},  {78, 0xffc995},
    {84, 0xaa7d55},  {85, 0x441a91},  {272, 0x19325a}, {288, 0x00451a}, {308, 0x352100}, {320, 0x720012},
    {326, 0xe2f99a}, {378, 0x708e7c}, {379, 0x70819a}, {484, 0x91501c},
};

/* In sRGB, 0 to 1; a colour that is not known is a light grey. */
static void ldraw_colour(int32_t number, double rgb[3])
{
    uint32_t found = 0xb8b8b8;
    for (size_t i = 0; i < sizeof colours / sizeof *colours; i++)
        if (colours[i].number == number)
            found = colours[i].rgb;
    for (int k = 0; k < 3; k++)
        rgb[k] = (found >> (16 - 8 * k) & 255) / 255.0;
}

/* ---- the colours of a model, each once; they are few, so they are looked for one after the other */

static bool group_of(colour_groups *list, int32_t colour, uint32_t *group)
{
    for (*group = 0; *group < list->count; ++*group)
        if (list->items[*group] == colour)
            return true;
    if (!tn_array_reserve(&list->items, &list->capacity, list->count, 1, sizeof *list->items))
        return false;
    list->items[list->count++] = colour;
    return true;
}

/* Adds the model's colours. *groups: [part] the number of its colour, which the caller frees in any case, as the
 * items. TN_MEMORY. */
static tn_status colour_groups_add(colour_groups *list, const tn_placed_model *model, uint32_t **groups,
                                   tn_error *error)
{
    *groups = malloc((model->count + 1) * sizeof **groups);
    for (size_t i = 0; *groups && i < model->count; i++)
        if (!group_of(list, model->parts[i].frame.colour, &(*groups)[i]))
            return tn_fail_memory(error);
    return *groups ? TN_OK : tn_fail_memory(error);
}

/* ---- closed meshes */

/* The bodies as cells of a union, with their parts' groups. */
static tn_status list_cells(const tn_module *module, const tn_placed_model *model, const tn_bodies *bodies,
                            const uint32_t *groups, tn_cut_box **cells, uint32_t **cell_groups, tn_error *error)
{
    *cells = malloc((bodies->count + 1) * sizeof **cells);
    *cell_groups = malloc((bodies->count + 1) * sizeof **cell_groups);
    if (!*cells || !*cell_groups)
        return tn_fail_memory(error);
    for (size_t i = 0; i < bodies->count; i++) {
        tn_body_shape(module, model, &bodies->items[i], &(*cells)[i]);
        (*cell_groups)[i] = groups[bodies->items[i].part];
    }
    return bodies->count > 0 ? TN_OK : tn_no_bodies(error);
}

/* The union's groups are cells: they become colours. */
static tn_status take_mesh(tn_union *u, const uint32_t *cell_groups, const colour_groups *list, tn_mesh *mesh,
                           unsigned char (**palette)[3], tn_error *error)
{
    *mesh = u->mesh;
    u->mesh = (tn_mesh){0};
    free(mesh->group_names);
    mesh->group_names = calloc(list->count + 1, sizeof *mesh->group_names);
    *palette = calloc(list->count + 1, sizeof **palette);
    if (!mesh->group_names || !*palette)
        return tn_fail_memory(error);
    for (size_t f = 0; f < mesh->face_count; f++)
        mesh->face_group[f] = cell_groups[mesh->face_group[f]];
    mesh->group_count = (uint32_t)list->count;
    for (size_t i = 0; i < list->count; i++) {
        double rgb[3];
        ldraw_colour(list->items[i], rgb);
        snprintf(mesh->group_names[i], sizeof *mesh->group_names, "colour-%d", list->items[i]);
        for (int k = 0; k < 3; k++)
            (*palette)[i][k] = (unsigned char)(255 * rgb[k] + 0.5);
    }
    return TN_OK;
}

tn_status tn_placed_mesh(const tn_module *module, const tn_placed_model *model, tn_mesh *mesh,
                         unsigned char (**palette)[3], tn_error *error)
{
    tn_bodies bodies = {0};
    tn_placed_joints joints;
    colour_groups list = {0};
    uint32_t *groups, *cell_groups = NULL;
    tn_cut_box *cells = NULL;
    tn_union u = {0};
    *mesh = (tn_mesh){0};
    *palette = NULL;
    tn_status status = colour_groups_add(&list, model, &groups, error);
    tn_status found = tn_placed_joints_find(module, model, NULL, &joints, error);
    status = status == TN_OK ? found : status;
    if (status == TN_OK)
        status = tn_bodies_list(module, model, &joints, &bodies, error);
    if (status == TN_OK)
        status = list_cells(module, model, &bodies, groups, &cells, &cell_groups, error);
    if (status == TN_OK)
        status = tn_union_make(cells, bodies.count, &u, error);
    if (status == TN_OK)
        status = take_mesh(&u, cell_groups, &list, mesh, palette, error);
    tn_union_clear(&u);
    tn_placed_joints_clear(&joints);
    tn_bodies_clear(&bodies);
    free(cells);
    free(cell_groups);
    free(groups);
    free(list.items);
    return status;
}

/* ---- placed models as faces */

enum { STUD_SIDES = 8, BOX_FACES = 6 };
static const double ldu = 0.4, stud_radius = 6, stud_height = 4; /* millimetres; LDU */

/* A regular octagon's corners, the first half a side from x. */
static const double octagon[STUD_SIDES][2] = {
    {0.92387953251128674, 0.38268343236508977},   {0.38268343236508977, 0.92387953251128674},
    {-0.38268343236508977, 0.92387953251128674},  {-0.92387953251128674, 0.38268343236508977},
    {-0.92387953251128674, -0.38268343236508977}, {-0.38268343236508977, -0.92387953251128674},
    {0.38268343236508977, -0.92387953251128674},  {0.92387953251128674, -0.38268343236508977}};

typedef struct drawing {
    const tn_module *module;
    const tn_placed_model *model;
    double unit[3]; /* LDU */
    size_t shown;   /* the first so many parts are drawn */
    double width;   /* of its picture; 0: that of one alone */
    bool below;     /* seen from below */
    tn_display_list display;
    bool *studs;     /* [connector type]: owned */
    double grown;    /* so many times as large as those of bricks studs are, less 1 */
    uint32_t corner; /* next */
} drawing;

/* ---- faces */

/* A place in LDU, y downwards, as a place of the picture. */
static void put_corner(drawing *d, double x, double y, double z)
{
    double *p = d->display.points[d->corner];
    d->display.edges[d->corner++] = TN_EDGE_DARK;
    p[0] = x * ldu;
    p[1] = z * ldu;
    p[2] = -y * ldu;
}

static void end_face(drawing *d, uint32_t group)
{
    d->display.groups[d->display.face_count++] = group;
    d->display.first[d->display.face_count] = d->corner;
}

/* The bodies of one part. Edges over which its surface goes on flat are not drawn. */
static void add_part(drawing *d, const tn_bodies *bodies, size_t first, size_t count, uint32_t group)
{
    enum { SHAPES_MAX = 32 }; /* edges of what has more are drawn */
    tn_cut_box shapes[SHAPES_MAX];
    for (size_t b = 0; b < count; b++)
        if (b < SHAPES_MAX)
            tn_body_shape(d->module, d->model, &bodies->items[first + b], &shapes[b]);
    for (size_t b = 0; b < count; b++) {
        tn_cut_box one, *shape = b < SHAPES_MAX ? &shapes[b] : &one;
        if (shape == &one)
            tn_body_shape(d->module, d->model, &bodies->items[first + b], &one);
        for (uint32_t f = 0; f < shape->face_count; f++) {
            const tn_cut_box_face *face = &shape->faces[f];
            for (uint32_t c = 0; c < face->count; c++) {
                bool flat = count > 1 && count <= SHAPES_MAX && tn_body_goes_on(shapes, count, b, face, c);
                memcpy(d->display.points[d->corner], shape->at[face->corner[c]], sizeof *d->display.points);
                d->display.edges[d->corner++] = flat ? TN_EDGE_NONE : TN_EDGE_DARK;
            }
            end_face(d, group);
        }
    }
}

/* A place in LDU, y downwards: so far across, along and up where a part is turned so. */
static void put_turned(drawing *d, const double at[3], uint32_t turn, double across, double along, double up)
{
    static const int8_t steps[TN_AXIS_COUNT][3] = {{0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 0, 1}};
    const int8_t *x = steps[tn_axis_turn(TN_AXIS_RIGHT, turn)], *z = steps[tn_axis_turn(TN_AXIS_BACK, turn)],
                 *y = steps[tn_axis_turn(TN_AXIS_UP, turn)];
    double p[3];
    for (int k = 0; k < 3; k++)
        p[k] = at[k] + across * x[k] + along * z[k] + up * y[k];
    put_corner(d, p[0], p[1], p[2]);
}

/* A stud that points up where a part is turned so. */
static void add_stud(drawing *d, const double at[3], uint32_t turn, uint32_t group)
{
    const double radius = stud_radius * (1 + d->grown), height = stud_height * (1 + d->grown);
    for (int i = 0; i < STUD_SIDES; i++) {
        const double *a = octagon[i], *b = octagon[(i + 1) % STUD_SIDES];
        put_turned(d, at, turn, radius * a[0], radius * a[1], 0);
        put_turned(d, at, turn, radius * b[0], radius * b[1], 0);
        put_turned(d, at, turn, radius * b[0], radius * b[1], height);
        put_turned(d, at, turn, radius * a[0], radius * a[1], height);
        end_face(d, group);
    }
    for (int i = 0; i < STUD_SIDES; i++)
        put_turned(d, at, turn, radius * octagon[i][0], radius * octagon[i][1], height);
    end_face(d, group);
}

/* ---- studs that nothing stands on */

/* A connector is drawn as a stud where its kind points up in some part of the kit, and down in none. */
static tn_status find_studs(drawing *d, tn_error *error)
{
    const tn_module *module = d->module;
    d->studs = calloc((size_t)module->CONNECTOR_TYPE_count + 1, sizeof *d->studs);
    if (!d->studs)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < module->PART_CONNECTOR_count; i++)
        d->studs[module->PART_CONNECTOR_records[i].type] |= module->PART_CONNECTOR_records[i].axis == TN_AXIS_UP;
    for (uint32_t i = 0; i < module->PART_CONNECTOR_count; i++)
        if (module->PART_CONNECTOR_records[i].axis == TN_AXIS_DOWN)
            d->studs[module->PART_CONNECTOR_records[i].type] = false;
    return TN_OK;
}

static size_t count_studs(const drawing *d, const tn_kit_part_record *kind)
{
    size_t count = 0;
    for (uint32_t c = 0; kind && c < kind->connector_count; c++)
        count += d->studs[d->module->PART_CONNECTOR_records[kind->connector_first + c].type];
    return count;
}

/* Is a cell in front of the stud filled? */
static bool is_covered(tn_cells *cells, const int32_t at[3], uint32_t turn)
{
    static const tn_cell_box above = {{-1, -1, -1}, {1, 0, 1}};
    tn_cell_box box = tn_cell_box_turn(&above, turn);
    for (int k = 0; k < 3; k++) {
        box.low[k] += at[k];
        box.high[k] += at[k];
    }
    return tn_cells_any(cells, &box);
}

static void add_studs(drawing *d, tn_cells *cells, const tn_kit_part_record *kind, const tn_frame *frame,
                      uint32_t group)
{
    for (uint32_t c = 0; c < kind->connector_count; c++) {
        const tn_part_connector_record *from = &d->module->PART_CONNECTOR_records[kind->connector_first + c];
        const int32_t own[3] = {(int32_t)from->x, (int32_t)from->y, (int32_t)from->z};
        int32_t at[3];
        double place[3];
        if (!d->studs[from->type])
            continue;
        uint32_t turn = tn_turn_to(tn_axis_turn((tn_axis)from->axis, frame->heading));
        tn_turn_place(frame->heading, own, at);
        for (int k = 0; k < 3; k++) {
            at[k] += frame->at[k];
            place[k] = d->unit[k] * at[k];
        }
        if (!is_covered(cells, at, turn))
            add_stud(d, place, turn, group);
    }
}

/* ---- pictures */

/* The next part's bodies: where they end. */
static size_t bodies_end(const tn_bodies *bodies, size_t first)
{
    size_t end = first;
    while (end < bodies->count && bodies->items[end].part == bodies->items[first].part)
        end++;
    return end;
}

static tn_status list_faces(drawing *d, const tn_placed_joints *joints, const tn_bodies *bodies, const uint32_t *groups,
                            tn_error *error)
{
    tn_cells *cells = tn_cells_new(NULL);
    tn_status status = cells ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < d->shown && status == TN_OK; i++) {
        const tn_kit_part_record *kind = joints->kinds[i];
        for (uint32_t b = 0; kind && b < kind->box_count && status == TN_OK; b++) {
            tn_cell_box box =
                tn_part_box_at(&d->module->PART_BOX_records[kind->box_first + b], &d->model->parts[i].frame);
            status = tn_cells_fill(cells, &box, error);
        }
    }
    for (size_t b = 0, end; b < bodies->count && bodies->items[b].part < d->shown && status == TN_OK; b = end) {
        end = bodies_end(bodies, b);
        add_part(d, bodies, b, end - b, groups[bodies->items[b].part]);
    }
    for (size_t i = 0; i < d->shown && status == TN_OK; i++)
        if (joints->kinds[i])
            add_studs(d, cells, joints->kinds[i], &d->model->parts[i].frame, groups[i]);
    tn_cells_free(cells);
    return status;
}

static tn_status take_view(drawing *d, const tn_placed_joints *joints, const uint32_t *groups, tn_view **view,
                           tn_error *error)
{
    size_t boxes = 0, studs = 0;
    for (size_t i = 0; i < d->shown; i++) {
        boxes += joints->kinds[i] ? joints->kinds[i]->box_count : 0;
        studs += count_studs(d, joints->kinds[i]);
    }
    if (boxes == 0)
        return tn_no_bodies(error);
    tn_status status = tn_display_list_new(BOX_FACES * boxes + (STUD_SIDES + 1) * studs,
                                           4 * BOX_FACES * boxes + 5 * STUD_SIDES * studs, true, &d->display, error);
    if (status != TN_OK)
        return status;
    d->display.closed = true;
    d->display.face_count = 0;
    d->display.first[0] = 0;
    tn_bodies bodies = {0};
    status = tn_bodies_list(d->module, d->model, joints, &bodies, error);
    if (status == TN_OK)
        status = list_faces(d, joints, &bodies, groups, error);
    tn_bodies_clear(&bodies);
    const tn_camera camera = {.azimuth = -60, .elevation = 30, .width = d->width > 0 ? d->width : 480};
    return status == TN_OK ? tn_view_take(&d->display, &camera, view, error) : status;
}

/* With marks, groups are plain and marked; otherwise colours. */
static tn_status make_palette(const colour_groups *list, bool marks, double (**palette)[3], tn_error *error)
{
    *palette = calloc(list->count + 2, sizeof **palette);
    if (!*palette)
        return tn_fail_memory(error);
    for (size_t i = 0; i < list->count && !marks; i++)
        ldraw_colour(list->items[i], (*palette)[i]);
    for (int k = 0; k < 3 && marks; k++) {
        (*palette)[0][k] = 0.9;
        (*palette)[1][k] = k == 0 ? 0.85 : 0.1;
    }
    return TN_OK;
}

tn_status tn_placed_draw(const tn_module *module, const tn_placed_model *model, const tn_placed_measures *measures,
                         const bool *marked, const char *title, tn_picture *to, tn_error *error)
{
    drawing d = {.module = module, .model = model, .shown = model->count};
    colour_groups list = {0};
    uint32_t *groups;
    double(*palette)[3] = NULL;
    tn_view *view = NULL;
    tn_place_unit(module, d.unit);
    tn_status status = colour_groups_add(&list, model, &groups, error);
    if (status == TN_OK)
        status = find_studs(&d, error);
    for (size_t i = 0; i < model->count && marked && status == TN_OK; i++)
        groups[i] = marked[i];
    if (status == TN_OK)
        status = make_palette(&list, marked != NULL, &palette, error);
    if (status == TN_OK)
        status = take_view(&d, &measures->joints, groups, &view, error);
    if (status == TN_OK) {
        const tn_view_options options = {.title = title, .palette = (const double(*)[3])palette};
        status = tn_views_draw(&view, 1, &options, to, error);
    }
    tn_view_free(view);
    tn_display_list_clear(&d.display);
    free(d.studs);
    free(palette);
    free(groups);
    free(list.items);
    return status;
}

/* The view of one of several models. */
static tn_status take_shape(const tn_placed_shape *shape, double width, colour_groups *list, tn_view **view,
                            tn_error *error)
{
    drawing d = {.module = shape->module, .model = shape->model, .shown = shape->model->count, .width = width};
    tn_placed_joints joints;
    uint32_t *groups;
    tn_place_unit(shape->module, d.unit);
    tn_status status = colour_groups_add(list, shape->model, &groups, error);
    tn_status found = tn_placed_joints_find(shape->module, shape->model, NULL, &joints, error);
    status = status == TN_OK ? found : status;
    if (status == TN_OK)
        status = find_studs(&d, error);
    if (status == TN_OK)
        status = take_view(&d, &joints, groups, view, error);
    tn_display_list_clear(&d.display);
    tn_placed_joints_clear(&joints);
    free(d.studs);
    free(groups);
    return status;
}

tn_status tn_placed_draw_many(const tn_placed_shape *shapes, const char *const *labels, size_t count, const char *title,
                              tn_picture *to, tn_error *error)
{
    enum { SMALL = 200 };
    tn_view **views = calloc(count + 1, sizeof *views);
    colour_groups list = {0};
    double(*palette)[3] = NULL;
    tn_status status = views ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < count && status == TN_OK; i++)
        status = take_shape(&shapes[i], count > 1 ? SMALL : 0, &list, &views[i], error);
    if (status == TN_OK)
        status = make_palette(&list, false, &palette, error);
    if (status == TN_OK) {
        const tn_view_options options = {.title = title, .labels = labels, .palette = (const double(*)[3])palette};
        status = tn_views_draw(views, count, &options, to, error);
    }
    for (size_t i = 0; views && i < count; i++)
        tn_view_free(views[i]);
    free(views);
    free(palette);
    free(list.items);
    return status;
}

/* A view after each step. */
static tn_status take_steps(drawing *d, const tn_placed_joints *joints, const tn_placed_steps *steps,
                            const uint32_t *groups, tn_view **views, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < steps->count && status == TN_OK; i++) {
        d->shown = steps->ends[i];
        d->corner = 0;
        status = take_view(d, joints, groups, &views[i], error);
        tn_display_list_clear(&d->display);
    }
    return status;
}

tn_status tn_placed_draw_steps(const tn_module *module, const tn_placed_model *model,
                               const tn_placed_measures *measures, const tn_placed_steps *steps, tn_picture *to,
                               tn_error *error)
{
    enum { STEPS_MAX = 200, LABEL = 24 };
    drawing d = {.module = module, .model = model};
    colour_groups list = {0};
    uint32_t *groups;
    double(*palette)[3] = NULL;
    tn_view *views[STEPS_MAX] = {NULL};
    char texts[STEPS_MAX][LABEL];
    const char *labels[STEPS_MAX];
    if (steps->count > STEPS_MAX) {
        tn_fail(error, TN_LIMIT, E_PLACE_SHEET, "a sheet would have %zu pictures, and %d are the most", steps->count,
                STEPS_MAX);
        tn_error_help(error, "make fewer steps: --steps layer, or --steps %zu", model->count / STEPS_MAX + 1);
        return TN_LIMIT;
    }
    for (size_t i = 0; i < steps->count; i++) {
        snprintf(texts[i], sizeof texts[i], "%zu", i + 1);
        labels[i] = texts[i];
    }
    tn_place_unit(module, d.unit);
    tn_status status = colour_groups_add(&list, model, &groups, error);
    if (status == TN_OK)
        status = find_studs(&d, error);
    if (status == TN_OK)
        status = make_palette(&list, false, &palette, error);
    if (status == TN_OK)
        status = take_steps(&d, &measures->joints, steps, groups, views, error);
    if (status == TN_OK) {
        const tn_view_options options = {.palette = (const double(*)[3])palette, .labels = labels};
        status = tn_views_draw(views, steps->count, &options, to, error);
    }
    for (size_t i = 0; i < steps->count; i++)
        tn_view_free(views[i]);
    tn_display_list_clear(&d.display);
    free(d.studs);
    free(palette);
    free(groups);
    free(list.items);
    return status;
}

/* ---- a part alone */

/* Studs of a part that is much larger or smaller than bricks grow or shrink with it. */
static double growth_of(const drawing *d, const tn_kit_part_record *part)
{
    enum { LEAST = 20, MOST = 400 }; /* LDU */
    double extent = 0;
    for (uint32_t b = 0; b < part->box_count; b++) {
        const tn_part_box_record *box = &d->module->PART_BOX_records[part->box_first + b];
        const double sides[3] = {d->unit[0] * (double)(box->high_x - box->low_x),
                                 d->unit[1] * (double)(box->high_y - box->low_y),
                                 d->unit[2] * (double)(box->high_z - box->low_z)};
        for (int k = 0; k < 3; k++)
            extent = sides[k] > extent ? sides[k] : extent;
    }
    if (extent > MOST)
        return extent / MOST - 1;
    return extent > 0 && extent < LEAST ? extent / LEAST - 1 : 0;
}

/* Group 0 is the part, and group 1 + t what shows its connectors of type t. */
static tn_status take_part(drawing *d, const tn_kit_part_record *part, tn_view **view, tn_error *error)
{
    tn_placed_part alone = {.name = tn_text(d->module, part->name)};
    const tn_placed_model model = {.parts = &alone, .count = 1};
    const tn_placed_joints joints = {.kinds = &part, .count = 1};
    tn_bodies bodies;
    const size_t boxes = part->box_count, studs = part->connector_count;
    tn_status status = tn_display_list_new(BOX_FACES * boxes + (STUD_SIDES + 1) * studs,
                                           4 * BOX_FACES * boxes + 5 * STUD_SIDES * studs, true, &d->display, error);
    if (status != TN_OK)
        return status;
    d->display.closed = true;
    d->display.face_count = 0;
    d->display.first[0] = 0;
    d->corner = 0;
    d->model = &model;
    status = tn_bodies_list(d->module, &model, &joints, &bodies, error);
    if (status == TN_OK)
        add_part(d, &bodies, 0, bodies.count, 0);
    tn_bodies_clear(&bodies);
    if (status != TN_OK)
        return status;
    for (uint32_t c = 0; c < part->connector_count; c++) {
        const tn_part_connector_record *from = &d->module->PART_CONNECTOR_records[part->connector_first + c];
        const double at[3] = {d->unit[0] * (double)from->x, d->unit[1] * (double)from->y, d->unit[2] * (double)from->z};
        add_stud(d, at, tn_turn_to((tn_axis)from->axis), 1 + from->type);
    }
    const tn_camera camera = {.azimuth = -60, .elevation = d->below ? -30 : 30, .width = d->width};
    return tn_view_take(&d->display, &camera, view, error);
}

static tn_status make_type_palette(const tn_module *module, double (**palette)[3], tn_error *error)
{
    *palette = calloc((size_t)module->CONNECTOR_TYPE_count + 1, sizeof **palette);
    if (!*palette)
        return tn_fail_memory(error);
    for (int k = 0; k < 3; k++)
        (*palette)[0][k] = 0.9;
    for (uint32_t t = 0; t < module->CONNECTOR_TYPE_count; t++) {
        unsigned char rgb[3];
        tn_group_colour(t, rgb);
        for (int k = 0; k < 3; k++)
            (*palette)[1 + t][k] = rgb[k] / 255.0;
    }
    return TN_OK;
}

tn_status tn_kit_part_draw(const tn_module *module, uint32_t part, tn_picture *to, tn_error *error)
{
    enum { BOTH = 320 };
    static const char *const labels[] = {"from above", "from below"};
    const tn_kit_part_record *record = &module->KIT_PART_records[part];
    double(*palette)[3] = NULL;
    tn_view *views[2] = {NULL, NULL};
    drawing d = {.module = module, .width = BOTH};
    tn_place_unit(module, d.unit);
    d.grown = growth_of(&d, record);
    tn_status status = record->box_count ? make_type_palette(module, &palette, error) : tn_no_bodies(error);
    for (int v = 0; v < 2 && status == TN_OK; v++) {
        d.below = v == 1;
        status = take_part(&d, record, &views[v], error);
        tn_display_list_clear(&d.display);
    }
    if (status == TN_OK) {
        const tn_view_options options = {.labels = labels, .palette = (const double(*)[3])palette};
        status = tn_views_draw(views, 2, &options, to, error);
    }
    for (int v = 0; v < 2; v++)
        tn_view_free(views[v]);
    free(palette);
    return status;
}
