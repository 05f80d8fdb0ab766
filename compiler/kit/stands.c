/* Models that a kit names: their parts are those of the kit, and stand where the file has them. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/kit/kit.h"
#include "runtime/place/cells.h"
#include "runtime/place/read.h"

static void cannot_stand(tn_kit *kit, const tn_kit_node *node, const char *part, const char *what, const char *help)
{
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_STANDS, node->doc.span, "part %.100s of `%.200s` %s", part,
                                 node->doc.text, what);
    tn_help(kit->diagnostics, d, "%s", help);
}

/* The first part that cannot be placed is said; so a file of another kit is not complained of a thousand times. */
static bool is_right(tn_kit *kit, const tn_kit_node *node, const tn_ldraw *ldraw)
{
    if (ldraw->tilted)
        cannot_stand(kit, node, ldraw->first_tilted, "is turned in a way in which this kit turns no part",
                     "leave it out of the file");
    else if (ldraw->beside)
        cannot_stand(kit, node, ldraw->first_beside, "lies beside the cells of the kit",
                     "move it onto them, or use a kit with smaller cells");
    else if (ldraw->model.count > TN_KIT_STANDS_MAX)
        cannot_stand(kit, node, ldraw->model.parts[TN_KIT_STANDS_MAX].name, "is one too many",
                     "at most 100,000 parts of a file can stand");
    else
        return true;
    return false;
}

static const tn_kit_part *part_of(tn_kit *kit, const tn_kit_node *node, const char *name)
{
    const tn_kit_part *part = tn_names_get(&kit->parts, name);
    for (const tn_kit_part *other = kit->part_list.first; other && !part; other = other->next)
        if (strcasecmp(other->node->name.text, name) == 0)
            part = other; /* names of LDraw files are the same in capitals or not */
    if (part)
        return part;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_STANDS, node->doc.span,
                                 "`%.200s` has the part %.100s, which is none of this kit's", node->doc.text, name);
    tn_kit_suggest(kit, d, &kit->parts, name, "add it to the kit by `part`, or leave it out of the file");
    return NULL;
}

tn_cell_box tn_kit_box_of(const tn_kit_stands *one, uint32_t index)
{
    const tn_frame frame = {.at = {one->at[0], one->at[1], one->at[2]}, .heading = one->heading};
    const tn_kit_box *box = &one->part->boxes[index];
    tn_step step = {.kind = TN_STEP_BLOCK};
    memcpy(step.a, box->low, sizeof step.a);
    memcpy(step.b, box->high, sizeof step.b);
    return tn_frame_box(&frame, &step);
}

/* Parts of a file may not be in each other's way. */
static bool has_room(tn_kit *kit, const tn_kit_node *node, const tn_kit_stands *one, tn_cells *cells)
{
    tn_error error;
    for (uint32_t i = 0; i < one->part->box_count; i++) {
        tn_cell_box box = tn_kit_box_of(one, i);
        if (tn_cells_any(cells, &box)) {
            cannot_stand(kit, node, one->part->node->name.text, "overlaps another",
                         "`tartan inspect` shows where; move one of them, or leave it out");
            return false;
        }
        if (tn_cells_fill(cells, &box, &error) != TN_OK) {
            kit->out_of_memory = true;
            return false;
        }
    }
    return true;
}

static void take_parts(tn_kit *kit, const tn_kit_node *node, const tn_ldraw *ldraw, tn_kit_parts *parts)
{
    tn_kit_parts taken = {.node = NULL};
    tn_cells *cells = tn_cells_new(NULL);
    bool right = cells != NULL;
    kit->out_of_memory |= !cells;
    for (size_t i = 0; i < ldraw->model.count && right; i++) {
        const tn_placed_part *from = &ldraw->model.parts[i];
        const tn_kit_part *part = part_of(kit, node, from->name);
        tn_kit_stands *one = part ? TN_NEW(kit->arena, tn_kit_stands) : NULL;
        right = one != NULL;
        if (!one)
            break;
        one->part = part;
        memcpy(one->at, from->frame.at, sizeof one->at);
        one->heading = from->frame.heading;
        one->colour = from->frame.colour;
        right = has_room(kit, node, one, cells);
        TN_CHAIN(&taken, one);
    }
    tn_cells_free(cells);
    if (!right)
        return;
    parts->first = taken.first;
    parts->last = taken.last;
}

/* Where files beside a model are looked for. */
typedef struct model_place {
    const tn_attachments *attachments;
    const char *path; /* of the model */
} model_place;

/* What cannot be had is no file: then the name is that of a part. */
static tn_status find_beside(void *context, const char *name, uint8_t **bytes, size_t *size, tn_error *error)
{
    const model_place *place = context;
    const tn_request request = {name, "", place->path};
    tn_status status = place->attachments->bytes(place->attachments->context, &request, bytes, size, error);
    return status == TN_MEMORY ? status : TN_OK;
}

/* The path of the model that a kit names. */
static const char *model_path(tn_kit *kit, const tn_request *request)
{
    const char *slash = request->path[0] == '/' ? NULL : strrchr(request->user, '/');
    size_t folder = slash ? (size_t)(slash + 1 - request->user) : 0, size = strlen(request->path) + 1;
    char *path = TN_NEW_ARRAY(kit->arena, char, folder + size);
    if (!path)
        return request->path; /* the arena remembers */
    memcpy(path, request->user, folder);
    memcpy(path + folder, request->path, size);
    return path;
}

static void read_parts(tn_kit *kit, const tn_kit_node *node, tn_kit_parts *parts)
{
    uint8_t *bytes = NULL;
    size_t size = 0;
    tn_ldraw ldraw = {0};
    tn_error error = {0};
    const tn_request request = tn_kit_request(kit, node);
    model_place place = {kit->attachments, model_path(kit, &request)};
    double unit[3];
    for (int k = 0; k < 3; k++)
        unit[k] = (double)kit->unit[k] / 1e6;
    tn_status status = kit->attachments->bytes(kit->attachments->context, &request, &bytes, &size, &error);
    if (status == TN_OK)
        status = tn_ldraw_read((const char *)bytes, size, unit, kit->turns, &(tn_ldraw_files){find_beside, &place},
                               &ldraw, &error);
    free(bytes);
    if (status == TN_OK && ldraw.model.count + ldraw.tilted + ldraw.beside == 0)
        status = tn_fail(&error, TN_INVALID, TN_CODE_NONE, "it has no parts");
    if (status != TN_OK)
        tn_kit_file_failed(kit, node, status, &error);
    else if (is_right(kit, node, &ldraw))
        take_parts(kit, node, &ldraw, parts);
    tn_ldraw_clear(&ldraw);
}

const tn_kit_parts *tn_kit_parts_of_file(tn_kit *kit, const tn_kit_node *node)
{
    tn_kit_parts *parts = kit->file_list.first;
    tn_error error;
    while (parts && parts->node != node)
        parts = parts->next;
    if (parts)
        return parts;
    parts = TN_NEW(kit->arena, tn_kit_parts);
    if (!parts)
        return NULL;
    parts->node = node;
    TN_CHAIN(&kit->file_list, parts);
    if (kit->attachments->bytes) {
        read_parts(kit, node, parts);
    } else {
        tn_fail(&error, TN_INVALID, TN_CODE_NONE, "no files can be read here");
        tn_kit_file_failed(kit, node, TN_INVALID, &error);
    }
    return parts;
}
