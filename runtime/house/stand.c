/* Stands a plan up: the cells of its trays, zones and storeys, and the faces between them and to the outside. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/house.h"

const tn_shape_record *tn_house_shape(const tn_house *house, uint32_t zone, tn_choice_kind kind)
{
    const tn_house_form *form = house->form;
    for (uint32_t i = 0; i < form->record->choice_count; i++) {
        const tn_choice_record *choice = tn_form_choice(form, i);
        if (choice->kind == kind && choice->zone == form->schema->record->field_first + zone)
            return &form->module->SHAPE_records[choice->shape_first + house->shapes[i]];
    }
    return NULL;
}

static uint32_t storeys_of(const tn_house *house, uint32_t zone)
{
    const tn_shape_record *shape = tn_house_shape(house, zone, TN_CHOICE_STOREYS);
    return shape ? shape->storeys : house->form->record->storey_count;
}

/* ---- cells */

static bool meets(const tn_house *house, const tn_cell *cell, tn_cell_rule_kind kind)
{
    const tn_house_form *form = house->form;
    for (uint32_t i = form->kinds_end[kind - 1]; i < form->kinds_end[kind]; i++)
        if (tn_house_decide(house, tn_form_rule(form, i)->decides, cell))
            return true;
    return false;
}

static tn_status add_cell(tn_house *house, const tn_cell *cell, tn_error *error)
{
    if (!tn_array_reserve_from(&house->cells, &house->cell_room, 32, house->cell_count, 1, sizeof *house->cells))
        return tn_fail_memory(error);
    house->cells[house->cell_count++] = *cell;
    return TN_OK;
}

/* The cells of one zone of a tray, upwards; a cell that is not there ends them. */
static tn_status stack(tn_house *house, tn_cell cell, tn_error *error)
{
    uint32_t storeys = storeys_of(house, cell.zone);
    for (cell.storey = 0; cell.storey < storeys; cell.storey++) {
        cell.open = false;
        if (meets(house, &cell, TN_CELL_NO))
            break;
        cell.open = cell.storey > 0 && meets(house, &cell, TN_CELL_VOID);
        tn_status status = add_cell(house, &cell, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static int64_t depth_of(const tn_house *house, size_t tray, uint32_t zone)
{
    return tn_tray_value_record(house->form->schema, house->trays[tray], zone)->length;
}

/* Zones before the spine lie behind y = 0, the last of them nearest to it. */
static tn_status add_tray(tn_house *house, uint32_t tray, int64_t x0, int64_t x1, tn_error *error)
{
    const tn_house_form *form = house->form;
    int64_t y = 0;
    for (uint32_t z = 0; z < form->zone_count && form->zones[z] < form->spine; z++)
        y -= depth_of(house, tray, form->zones[z]);
    house->tray_first[tray] = (uint32_t)house->cell_count;
    for (uint32_t z = 0; z < form->zone_count; z++) {
        int64_t depth = depth_of(house, tray, form->zones[z]);
        tn_cell cell = {.tray = tray, .zone = form->zones[z], .at = {x0, x1, y, y + depth}, .function = TN_NO_FUNCTION};
        tn_status status = depth > 0 ? stack(house, cell, error) : TN_OK;
        if (status != TN_OK)
            return status;
        y += depth;
    }
    return TN_OK;
}

static int64_t width_of(const tn_house *house, size_t tray)
{
    return tn_tray_value_record(house->form->schema, house->trays[tray], house->form->width)->length;
}

int64_t tn_house_plane_x(const tn_house *house, size_t tray)
{
    int64_t x = 0;
    for (size_t i = 0; i < tray; i++)
        x += width_of(house, i);
    return x;
}

bool tn_house_ends(const tn_house *house, uint32_t tray, uint32_t zone, tn_cell *end)
{
    int64_t width = width_of(house, tray), depth = depth_of(house, tray, zone);
    *end = (tn_cell){.tray = tray, .zone = zone, .at = {0, width, 0, depth}, .function = TN_NO_FUNCTION};
    for (uint32_t i = house->tray_first[tray]; i < house->tray_first[tray + 1]; i++)
        end->storey += house->cells[i].zone == zone;
    return depth > 0 && end->storey < storeys_of(house, zone);
}

static tn_status add_cells(tn_house *house, tn_error *error)
{
    int64_t x = 0;
    for (size_t i = 0; i < house->length; i++) {
        int64_t width = width_of(house, i);
        tn_status status = add_tray(house, (uint32_t)i, x, x + width, error);
        if (status != TN_OK)
            return status;
        x += width;
    }
    house->tray_first[house->length] = (uint32_t)house->cell_count;
    return TN_OK;
}

/* ---- faces */

static tn_status add_face(tn_house *house, tn_face face, tn_error *error)
{
    if (!tn_array_reserve_from(&house->faces, &house->face_room, 64, house->face_count, 1, sizeof *house->faces))
        return tn_fail_memory(error);
    face.storey = house->cells[face.first].storey;
    face.relation = face.second == TN_NO_CELL        ? TN_FACE_OUTSIDE
                    : face.side == TN_HOUSE_ANY_SIDE ? TN_FACE_UNDER
                                                     : TN_FACE_BESIDE;
    face.kind = face.relation == TN_FACE_UNDER ? TN_FACE_FLOOR : TN_FACE_WALL;
    house->faces[house->face_count++] = face;
    return TN_OK;
}

/* The left or the right side of a cell, stretch by stretch. A face of two cells is the left one's. */
static tn_status add_along(tn_house *house, uint32_t index, tn_house_side side, tn_error *error)
{
    tn_cell cell = house->cells[index];
    bool left = side == TN_HOUSE_LEFT, at_end = left ? cell.tray == 0 : cell.tray + 1 == house->length;
    int64_t x = left ? cell.at.x0 : cell.at.x1, y = cell.at.y0;
    size_t beside = left ? cell.tray - (size_t)!at_end : cell.tray + (size_t)!at_end;
    size_t first = at_end ? 0 : house->tray_first[beside], last = at_end ? 0 : house->tray_first[beside + 1];
    tn_status status = TN_OK;
    for (size_t i = first; status == TN_OK && i < last; i++) {
        const tn_cell *other = &house->cells[i];
        if (other->storey != cell.storey || other->at.y0 >= cell.at.y1 || other->at.y1 <= cell.at.y0)
            continue;
        int64_t from = other->at.y0 > cell.at.y0 ? other->at.y0 : cell.at.y0;
        int64_t to = other->at.y1 < cell.at.y1 ? other->at.y1 : cell.at.y1;
        if (from > y)
            status = add_face(
                house, (tn_face){.first = index, .second = TN_NO_CELL, .side = side, .at = {x, x, y, from}}, error);
        if (status == TN_OK && !left)
            status = add_face(
                house, (tn_face){.first = index, .second = (uint32_t)i, .side = side, .at = {x, x, from, to}}, error);
        y = to;
    }
    if (status == TN_OK && y < cell.at.y1)
        status = add_face(
            house, (tn_face){.first = index, .second = TN_NO_CELL, .side = side, .at = {x, x, y, cell.at.y1}}, error);
    return status;
}

/* The back or the front of a cell. A face of two cells is the lower one's, which is behind. */
static tn_status add_across(tn_house *house, uint32_t index, tn_house_side side, tn_error *error)
{
    tn_cell cell = house->cells[index];
    bool back = side == TN_HOUSE_BACK;
    int64_t y = back ? cell.at.y0 : cell.at.y1;
    uint32_t other = TN_NO_CELL;
    for (uint32_t i = house->tray_first[cell.tray]; i < house->tray_first[cell.tray + 1]; i++)
        if (i != index && house->cells[i].storey == cell.storey &&
            (back ? house->cells[i].at.y1 : house->cells[i].at.y0) == y)
            other = i;
    if (other != TN_NO_CELL && other < index)
        return TN_OK;
    return add_face(
        house, (tn_face){.first = index, .second = other, .side = side, .at = {cell.at.x0, cell.at.x1, y, y}}, error);
}

static tn_status add_above(tn_house *house, uint32_t index, tn_error *error)
{
    const tn_cell *cell = &house->cells[index], *above = cell + 1; /* cells are in order */
    if (index + 1 == house->cell_count || above->tray != cell->tray || above->zone != cell->zone)
        return TN_OK;
    return add_face(house, (tn_face){.first = index, .second = index + 1, .at = cell->at}, error);
}

static tn_status add_faces(tn_house *house, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++) {
        status = add_along(house, i, TN_HOUSE_LEFT, error);
        if (status == TN_OK)
            status = add_across(house, i, TN_HOUSE_BACK, error);
        if (status == TN_OK)
            status = add_across(house, i, TN_HOUSE_FRONT, error);
        if (status == TN_OK)
            status = add_along(house, i, TN_HOUSE_RIGHT, error);
        if (status == TN_OK)
            status = add_above(house, i, error);
    }
    return status;
}

/* ---- sizes */

#define TN_HOUSE_EXTENT_MAX (INT64_C(1) << 43) /* nanometres, 8.8 km */

static tn_status check_extent(const tn_house *house, tn_error *error)
{
    for (size_t i = 0; i < house->cell_count; i++) {
        const tn_rectangle *at = &house->cells[i].at;
        if (at->x1 <= TN_HOUSE_EXTENT_MAX && at->y0 >= -TN_HOUSE_EXTENT_MAX && at->y1 <= TN_HOUSE_EXTENT_MAX)
            continue;
        tn_fail(error, TN_INVALID, E_BAD_HOUSE, "the house is longer or deeper than 8,796 m");
        tn_error_help(error, "write fewer trays");
        return TN_INVALID;
    }
    return TN_OK;
}

/* ---- walls that would overlap */

/* Do two cells beside each other have walls that are too near? */
static bool too_near(const tn_cell *a, const tn_cell *b, int64_t wall)
{
    const int64_t y[2] = {a->at.y0, a->at.y1}, other[2] = {b->at.y0, b->at.y1};
    for (int i = 0; i < 4; i++) {
        int64_t gap = y[i / 2] - other[i % 2];
        if (gap != 0 && gap < wall && gap > -wall)
            return true;
    }
    return false;
}

static tn_status check_walls(const tn_house *house, tn_error *error)
{
    for (size_t i = 0; i < house->cell_count; i++) {
        const tn_cell *cell = &house->cells[i];
        size_t end = cell->tray + 2 <= house->length ? house->tray_first[cell->tray + 2] : house->cell_count;
        for (size_t k = house->tray_first[cell->tray + 1]; k < end; k++) {
            if (house->cells[k].storey != cell->storey || !too_near(cell, &house->cells[k], house->form->record->wall))
                continue;
            tn_fail(error, TN_INVALID, E_TOO_NEAR,
                    "walls of trays %u and %u are nearer to each other than they are thick", cell->tray + 1,
                    cell->tray + 2);
            tn_error_help(error,
                          "make the form's `wall` thinner, or the depths of the two trays equal or more different");
            return TN_INVALID;
        }
    }
    return TN_OK;
}

/* ---- houses */

tn_status tn_house_stand(const tn_house_form *form, const tn_tray *trays, size_t length, const uint32_t *shapes,
                         tn_house *house, tn_error *error)
{
    *house = (tn_house){0};
    return tn_house_stand_again(form, trays, length, shapes, house, error);
}

void tn_house_take_section(const tn_house_form *form, const uint32_t *shapes, tn_house *house)
{
    house->form = form;
    house->known = NULL;
    house->views = NULL;
    house->ways_unknown = false;
    house->length = house->cell_count = house->face_count = 0;
    memset(house->shapes, 0, sizeof house->shapes);
    if (form->record->choice_count)
        memcpy(house->shapes, shapes, form->record->choice_count * sizeof *shapes);
}

tn_status tn_house_stand_again(const tn_house_form *form, const tn_tray *trays, size_t length, const uint32_t *shapes,
                               tn_house *house, tn_error *error)
{
    if (!tn_array_resize(&house->trays, length + 1, sizeof *trays) ||
        !tn_array_resize(&house->tray_first, length + 1, sizeof *house->tray_first))
        return tn_fail_memory(error);
    tn_house_take_section(form, shapes, house);
    house->length = length;
    house->tiles_left_out = false;
    if (length)
        memcpy(house->trays, trays, length * sizeof *trays);
    tn_status status = add_cells(house, error);
    if (status == TN_OK)
        status = check_extent(house, error);
    if (status == TN_OK)
        status = check_walls(house, error);
    return status == TN_OK ? add_faces(house, error) : status;
}

/* A copy of an array; NULL: out of memory. */
static void *copy_of(const void *items, size_t count, size_t size)
{
    void *copy = malloc((count + 1) * size);
    if (copy && count > 0)
        memcpy(copy, items, count * size);
    return copy;
}

tn_status tn_house_copy(const tn_house *house, tn_house *copy, tn_error *error)
{
    *copy = *house;
    copy->known = NULL;
    copy->views = NULL;
    copy->cell_room = house->cell_count;
    copy->face_room = house->face_count;
    copy->trays = copy_of(house->trays, house->length, sizeof *house->trays);
    copy->tray_first = copy_of(house->tray_first, house->length + 1, sizeof *house->tray_first);
    copy->cells = copy_of(house->cells, house->cell_count, sizeof *house->cells);
    copy->faces = copy_of(house->faces, house->face_count, sizeof *house->faces);
    if (copy->trays && copy->tray_first && copy->cells && copy->faces)
        return TN_OK;
    tn_house_clear(copy);
    return tn_fail_memory(error);
}

void tn_house_clear(tn_house *house)
{
    free(house->trays);
    free(house->tray_first);
    free(house->cells);
    free(house->faces);
    *house = (tn_house){0};
}
