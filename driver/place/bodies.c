/* Lists bodies, and decides which slopes have their room to themselves. */
#include "driver/place/bodies.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/geometry/vector.h"
#include "runtime/place/cells.h"

static const double ldu = 0.4; /* millimetres */

static tn_cell_box slope_box(const tn_part_slope_record *slope, const tn_frame *frame)
{
    const tn_part_box_record whole = {slope->low_x,  slope->low_y,  slope->low_z,
                                      slope->high_x, slope->high_y, slope->high_z};
    return tn_part_box_at(&whole, frame);
}

/* ---- which slopes have room */

static tn_status fill_boxes(tn_cells *cells, const tn_part_box_record *boxes, uint32_t count, const tn_frame *frame,
                            tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < count && status == TN_OK; i++) {
        tn_cell_box box = tn_part_box_at(&boxes[i], frame);
        status = tn_cells_fill(cells, &box, error);
    }
    return status;
}

/* Takes all of the slope's box, if nothing but its own steps is there. */
static tn_status take_room(tn_cells *cells, const tn_module *module, const tn_part_slope_record *slope,
                           const tn_frame *frame, bool *taken, tn_error *error)
{
    const tn_part_box_record *steps = &module->PART_BOX_records[slope->step_first];
    tn_cell_box whole = slope_box(slope, frame);
    for (uint32_t i = 0; i < slope->step_count; i++) {
        tn_cell_box box = tn_part_box_at(&steps[i], frame);
        tn_cells_empty(cells, &box);
    }
    *taken = !tn_cells_any(cells, &whole);
    return *taken ? tn_cells_fill(cells, &whole, error) : fill_boxes(cells, steps, slope->step_count, frame, error);
}

/* ---- listing */

/* The boxes of a part from one on, up to another. */
static void add_boxes(tn_bodies *bodies, uint32_t part, uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++)
        bodies->items[bodies->count++] = (tn_body){part, i, false};
}

/* A slope comes where its first step would. */
static tn_status add_part(tn_bodies *bodies, const tn_module *module, tn_cells *cells, uint32_t part,
                          const tn_kit_part_record *kind, const tn_frame *frame, tn_error *error)
{
    uint32_t next = kind->box_first;
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < kind->slope_count && status == TN_OK; i++) {
        const tn_part_slope_record *slope = &module->PART_SLOPE_records[kind->slope_first + i];
        bool taken;
        status = take_room(cells, module, slope, frame, &taken, error);
        if (!taken)
            continue;
        add_boxes(bodies, part, next, slope->step_first);
        bodies->items[bodies->count++] = (tn_body){part, kind->slope_first + i, true};
        next = slope->step_first + slope->step_count;
    }
    add_boxes(bodies, part, next, kind->box_first + kind->box_count);
    return status;
}

tn_status tn_bodies_list(const tn_module *module, const tn_placed_model *model, const tn_placed_joints *joints,
                         tn_bodies *bodies, tn_error *error)
{
    size_t most = 0;
    *bodies = (tn_bodies){0};
    for (size_t i = 0; i < model->count; i++)
        most += joints->kinds[i] ? joints->kinds[i]->box_count : 0;
    bodies->items = malloc((most + 1) * sizeof *bodies->items);
    tn_cells *cells = tn_cells_new(NULL);
    tn_status status = bodies->items && cells ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < model->count && module->PART_SLOPE_count > 0 && status == TN_OK; i++) {
        const tn_kit_part_record *kind = joints->kinds[i];
        if (kind)
            status = fill_boxes(cells, &module->PART_BOX_records[kind->box_first], kind->box_count,
                                &model->parts[i].frame, error);
    }
    for (size_t i = 0; i < model->count && status == TN_OK; i++)
        if (joints->kinds[i])
            status = add_part(bodies, module, cells, (uint32_t)i, joints->kinds[i], &model->parts[i].frame, error);
    if (status == TN_OK)
        status = tn_cells_status(cells, error);
    tn_cells_free(cells);
    return status;
}

void tn_bodies_clear(tn_bodies *bodies)
{
    free(bodies->items);
    *bodies = (tn_bodies){0};
}

tn_status tn_no_bodies(tn_error *error)
{
    tn_fail(error, TN_INVALID, E_PLACE_NO_SHAPE, "none of the model's parts has a shape that is known");
    tn_error_help(error, "shapes are those of a kit: `tartan inspect MODEL.ldr --kit bricks -o wall.svg`");
    return TN_INVALID;
}

/* ---- shapes */

/* Where the corner between two sides of a box lies that is cut off from edge to edge: out of the middle, of length 1.
 */
static void cut_towards(const tn_part_slope_record *slope, const tn_frame *frame, const double low[3],
                        const double high[3], double n[3])
{
    static const int across[3] = {0, 2, 1}; /* x, y, z of cells in the picture, where z is up */
    const tn_axis sides[2] = {tn_axis_turn((tn_axis)slope->side, frame->heading),
                              tn_axis_turn((tn_axis)slope->other, frame->heading)};
    double length = 0;
    n[0] = n[1] = n[2] = 0;
    for (int i = 0; i < 2; i++) {
        int k = across[tn_axis_coordinate(sides[i])];
        bool falls = k == 2 ? !tn_axis_falls(sides[i]) : tn_axis_falls(sides[i]);
        n[k] = (falls ? -1 : 1) / (high[k] - low[k]);
        length += n[k] * n[k];
    }
    for (int k = 0; k < 3; k++)
        n[k] /= sqrt(length);
}

void tn_body_shape(const tn_module *module, const tn_placed_model *model, const tn_body *body, tn_cut_box *shape)
{
    const tn_frame *frame = &model->parts[body->part].frame;
    const tn_part_slope_record *slope = body->slope ? &module->PART_SLOPE_records[body->record] : NULL;
    tn_cell_box box = slope ? slope_box(slope, frame) : tn_part_box_at(&module->PART_BOX_records[body->record], frame);
    double unit[3], n[3];
    tn_place_unit(module, unit);
    const double low[3] = {ldu * unit[0] * box.low[0], ldu * unit[2] * box.low[2], -ldu * unit[1] * box.high[1]};
    const double high[3] = {ldu * unit[0] * box.high[0], ldu * unit[2] * box.high[2], -ldu * unit[1] * box.low[1]};
    if (slope)
        cut_towards(slope, frame, low, high, n);
    tn_cut_box_clip(low, high, slope ? n : NULL, 0, shape);
}

/* ---- edges inside of a part */

static tn_vector corner(const tn_cut_box *shape, const tn_cut_box_face *face, size_t i)
{
    return tn_vector_at(shape->at[face->corner[i % face->count]]);
}

static tn_vector normal_of(const tn_cut_box *shape, const tn_cut_box_face *face)
{
    tn_vector a = corner(shape, face, 0), b = corner(shape, face, 1), c = corner(shape, face, 2);
    return tn_normalised(tn_cross(tn_sub(b, a), tn_sub(c, a)));
}

static bool holds(const tn_cut_box *shape, tn_vector at)
{
    for (uint32_t f = 0; f < shape->face_count; f++)
        if (tn_dot(normal_of(shape, &shape->faces[f]), tn_sub(at, corner(shape, &shape->faces[f], 0))) >
            0)
            return false;
    return shape->face_count > 0;
}

static bool any_holds(const tn_cut_box *shapes, size_t count, size_t but, tn_vector at)
{
    for (size_t i = 0; i < count; i++)
        if (i != but && holds(&shapes[i], at))
            return true;
    return false;
}

/* Looks just beyond the edge, near its ends and in its middle: below the face there is a body, and above it none. */
bool tn_body_goes_on(const tn_cut_box *shapes, size_t count, size_t body, const tn_cut_box_face *face, size_t edge)
{
    static const double along[3] = {0.05, 0.5, 0.95};
    const tn_cut_box *shape = &shapes[body];
    tn_vector from = corner(shape, face, edge), way = tn_sub(corner(shape, face, edge + 1), from);
    tn_vector up = normal_of(shape, face), out = tn_normalised(tn_cross(way, up));
    double near = INFINITY;
    for (int k = 0; k < 3; k++)
        near = tn_smaller(near, 1e-3 * (shape->high[k] - shape->low[k]));
    for (int i = 0; i < 3; i++) {
        tn_vector at = tn_along(tn_along(from, way, along[i]), out, near);
        if (!any_holds(shapes, count, body, tn_along(at, up, -near)) ||
            any_holds(shapes, count, body, tn_along(at, up, near)))
            return false;
    }
    return true;
}
