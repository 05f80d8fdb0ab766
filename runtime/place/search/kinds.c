/* Compares each part of a kit with itself turned and mirrored. */
#include "runtime/place/search/kinds.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/place/joints.h"

/* A box, or a connector with its type, its axis and how far it is turned about that, from the lowest cell of the part.
 */
typedef struct feature {
    int32_t what, type, axis, turn, low[3], high[3];
} feature;

static int compare(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(feature));
}

static void mirror_box(tn_cell_box *box, int axis)
{
    int k = axis == 0 ? 0 : 2;
    int32_t low = box->low[k];
    box->low[k] = -box->high[k];
    box->high[k] = -low;
}

static tn_axis mirror_axis(tn_axis at, int axis)
{
    static const tn_axis pairs[2][2] = {{TN_AXIS_LEFT, TN_AXIS_RIGHT}, {TN_AXIS_FRONT, TN_AXIS_BACK}};
    return at == pairs[axis][0] ? pairs[axis][1] : at == pairs[axis][1] ? pairs[axis][0] : at;
}

/* The part turned, and before that mirrored at x = 0 (0) or z = 0 (1) or not (-1). */
static size_t list_features(const tn_module *module, const tn_kind_of_part *kind, uint32_t heading, int mirror,
                            feature *to)
{
    const tn_kit_part_record *record = kind->record;
    const tn_frame turned = {.heading = heading};
    int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX};
    size_t count = 0;
    for (uint32_t i = 0; i < record->box_count; i++) {
        tn_cell_box box = tn_part_box_at(&module->PART_BOX_records[record->box_first + i], &(tn_frame){.heading = 0});
        if (mirror >= 0)
            mirror_box(&box, mirror);
        tn_part_box_record again = {box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2]};
        box = tn_part_box_at(&again, &turned);
        to[count] = (feature){.what = 0};
        memcpy(to[count].low, box.low, sizeof box.low);
        memcpy(to[count++].high, box.high, sizeof box.high);
        for (int k = 0; k < 3; k++)
            low[k] = box.low[k] < low[k] ? box.low[k] : low[k];
    }
    for (uint32_t i = 0; i < record->connector_count; i++) {
        const tn_part_connector_record *c = &module->PART_CONNECTOR_records[record->connector_first + i];
        tn_axis axis = mirror >= 0 ? mirror_axis((tn_axis)c->axis, mirror) : (tn_axis)c->axis;
        feature *f = &to[count++];
        *f = (feature){.what = 1, .type = (int32_t)c->type, .axis = (int32_t)tn_axis_turn(axis, heading)};
        /* what is beside the axis tells how far it is turned about it: alike are all, opposite ones, or none */
        tn_axis beside = tn_axis_beside((tn_axis)c->axis);
        beside = tn_axis_turn(mirror >= 0 ? mirror_axis(beside, mirror) : beside, heading);
        uint32_t alike = tn_connector_turns(module, c->type);
        f->turn = alike == 4 ? 0 : alike == 2 ? (int32_t)(beside / 2) : (int32_t)beside;
        const int32_t at[3] = {(int32_t)(mirror == 0 ? -c->x : c->x), (int32_t)c->y,
                               (int32_t)(mirror == 1 ? -c->z : c->z)};
        tn_turn_place(heading, at, f->low);
        memcpy(f->high, f->low, sizeof f->low);
    }
    for (size_t i = 0; i < count && record->box_count > 0; i++)
        for (int k = 0; k < 3; k++) {
            to[i].low[k] -= low[k];
            to[i].high[k] -= low[k];
        }
    qsort(to, count, sizeof *to, compare);
    return count;
}

static void set_boxes(const tn_module *module, tn_kind_of_part *kind)
{
    for (uint32_t h = 0; h < 4; h++) {
        tn_cell_box all = {{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
        for (uint32_t i = 0; i < kind->record->box_count; i++) {
            const tn_part_box_record *box = &module->PART_BOX_records[kind->record->box_first + i];
            kind->boxes[h][i] = tn_part_box_at(box, &(tn_frame){.heading = h});
            tn_cell_box_widen(&all, &kind->boxes[h][i]);
        }
        kind->all[h] = kind->record->box_count ? all : (tn_cell_box){{0}, {0}};
    }
}

static tn_status set_shapes(const tn_module *module, tn_kind_of_part *kind, tn_error *error)
{
    size_t most = (size_t)kind->record->box_count + kind->record->connector_count;
    feature *plain = calloc(most + 1, sizeof *plain), *other = calloc(most + 1, sizeof *other);
    tn_status status = plain && other ? TN_OK : tn_fail_memory(error);
    uint32_t turns = tn_place_turns(module);
    for (uint32_t h = 0; status == TN_OK && h < turns; h++) {
        size_t count = list_features(module, kind, h, -1, plain);
        for (kind->shape[h] = 0; kind->shape[h] < h; kind->shape[h]++) {
            list_features(module, kind, kind->shape[h], -1, other);
            if (memcmp(plain, other, count * sizeof *plain) == 0)
                break;
        }
    }
    for (int axis = 0; status == TN_OK && axis < 2; axis++) {
        size_t count = list_features(module, kind, 0, axis, plain);
        for (kind->mirrored[axis] = 0; kind->mirrored[axis] < turns; kind->mirrored[axis]++) {
            list_features(module, kind, kind->mirrored[axis], -1, other);
            if (memcmp(plain, other, count * sizeof *plain) == 0)
                break;
        }
        if (kind->mirrored[axis] == turns)
            kind->mirrored[axis] = TN_TURNS;
    }
    free(plain);
    free(other);
    return status;
}

tn_status tn_kinds_make(tn_site_choices *choices, tn_error *error)
{
    const tn_module *module = choices->rules->module;
    size_t boxes = 0;
    choices->kind_count = module->KIT_PART_count;
    for (uint32_t i = 0; i < choices->kind_count; i++)
        boxes += 4 * (size_t)module->KIT_PART_records[i].box_count;
    choices->kinds = calloc((size_t)choices->kind_count + 1, sizeof *choices->kinds);
    choices->boxes = calloc(boxes + 1, sizeof *choices->boxes);
    if (!choices->kinds || !choices->boxes)
        return tn_fail_memory(error);
    tn_cell_box *next = choices->boxes;
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < choices->kind_count && status == TN_OK; i++) {
        tn_kind_of_part *kind = &choices->kinds[i];
        kind->record = &module->KIT_PART_records[i];
        kind->most = UINT64_MAX;
        for (int h = 0; h < 4; h++, next += kind->record->box_count)
            kind->boxes[h] = next;
        set_boxes(module, kind);
        status = set_shapes(module, kind, error);
    }
    return status;
}

/* Mirrored, turned and mirrored again is a turn too; the mirrored part is one that is turned. */
static uint32_t mirror_turn(uint32_t turn, int axis)
{
    uint32_t found = 0;
    tn_axis up = mirror_axis(tn_axis_turn(TN_AXIS_UP, turn), axis);
    tn_axis right = mirror_axis(tn_axis_turn(mirror_axis(TN_AXIS_RIGHT, axis), turn), axis);
    while (tn_axis_turn(TN_AXIS_UP, found) != up || tn_axis_turn(TN_AXIS_RIGHT, found) != right)
        found++;
    return found;
}

tn_frame tn_kind_mirror(const tn_kind_of_part *kind, const tn_frame *frame, int axis)
{
    tn_frame image = *frame;
    tn_cell_box all = tn_kind_all(kind, frame->heading);
    image.heading = tn_turn_after(mirror_turn(frame->heading, axis), kind->mirrored[axis]);
    tn_cell_box turned = tn_kind_all(kind, image.heading);
    for (int k = 0; k < 3; k++) {
        all.low[k] += frame->at[k];
        all.high[k] += frame->at[k];
    }
    mirror_box(&all, axis);
    for (int k = 0; k < 3; k++)
        image.at[k] = all.low[k] - turned.low[k];
    return image;
}
