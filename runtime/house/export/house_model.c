/* Makes a mesh of a house whose parts have names: by storey, room and part. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/json.h"
#include "runtime/house/export/export.h"
#include "runtime/house/model/designations.h"
#include "runtime/house/model/model.h"
#include "runtime/house/schedule/cost.h"

/* Where a block belongs. storey: behind all storeys are roofs. room: of what belongs to one room, its place among the
 * numbered ones, counted from 1; 0: of a storey. of, item: tell doors, windows, flights and furniture of a room apart.
 */
typedef struct placed_block {
    uint32_t storey, room, kind, of, item, material, block;
} placed_block;

typedef struct builder {
    const tn_house *house;
    const char *name, *line; /* line: NULL where no facts are said */
    tn_designations rooms;
    uint32_t *numbered; /* [cells] the place of a cell's room, counted from 1; 0: it is open to the storey below */
    tn_blocks blocks;
    placed_block *placed;
    size_t at;                             /* the next that is taken */
    uint32_t made[TN_HOUSE_GROUPS_MAX][2]; /* materials of groups, as they are and as glass, counted from 1 */
    tn_mesh_model *model;
} builder;

/* ---- where blocks belong */

static tn_status number_cells(builder *b, tn_error *error)
{
    const tn_house *house = b->house;
    tn_status status = tn_designations_find(house, tn_house_length_style(house) == TN_STYLE_FEET, &b->rooms, error);
    b->numbered = calloc(house->cell_count + 1, sizeof *b->numbered);
    if (status == TN_OK && !b->numbered)
        status = tn_fail_memory(error);
    for (uint32_t r = 0; status == TN_OK && r < b->rooms.room_count; r++)
        for (uint32_t i = b->rooms.numbered[r].room; i < house->cell_count; i++)
            if (b->rooms.rooms[i] == b->rooms.numbered[r].room && house->cells[i].storey == b->rooms.numbered[r].storey)
                b->numbered[i] = r + 1;
    return status;
}

/* The room at one side of a face only, or at both. */
static uint32_t room_at(const builder *b, const tn_face *face)
{
    uint32_t first = b->numbered[face->first];
    if (face->relation == TN_FACE_UNDER || face->second == TN_NO_CELL)
        return first;
    uint32_t second = b->numbered[face->second];
    return first == second ? first : 0;
}

/* A glazed opening of an outside wall belongs to the room that it is a window of, as that wall does. */
static void place_in_face(const builder *b, uint32_t index, placed_block *placed)
{
    const tn_face *face = &b->house->faces[index];
    uint32_t sheltered = tn_face_sheltered(b->house, face);
    placed->storey = face->storey;
    placed->room = sheltered == TN_NO_CELL ? room_at(b, face) : b->numbered[sheltered];
}

static void place_in_cell(const builder *b, uint32_t cell, placed_block *placed)
{
    placed->storey = b->house->cells[cell].storey;
    placed->room = b->numbered[cell];
}

static placed_block place(const builder *b, uint32_t index)
{
    const tn_house_block *block = &b->blocks.items[index];
    placed_block placed = {.kind = block->kind, .block = index};
    switch (block->kind) {
    case TN_SOLID_ROOF:
    case TN_SOLID_ROOFDECK:
        placed.storey = b->house->form->record->storey_count;
        placed.kind = TN_SOLID_ROOF;
        break;
    case TN_SOLID_DECK:
    case TN_SOLID_POST:
        placed.storey = block->of;
        break;
    case TN_SOLID_BEAM:
        placed.storey = block->of;
        placed.item = block->item;
        break;
    case TN_SOLID_GUARD:
        placed.storey = tn_guard_storey(b->house, block->of);
        break;
    case TN_SOLID_GABLE:
        place_in_cell(b, block->of, &placed);
        break;
    case TN_SOLID_ITEM:
        place_in_cell(b, block->of, &placed);
        placed.of = block->of;
        placed.item = block->item;
        break;
    case TN_SOLID_PANE:
    case TN_SOLID_LEAF:
    case TN_SOLID_FLIGHT:
        place_in_face(b, block->of, &placed);
        placed.of = block->of;
        break;
    default:
        place_in_face(b, block->of, &placed);
        break;
    }
    return placed;
}

/* ---- materials */

/* What fills an opening is a pane, or the leaf of a door, which may be glazed. */
static bool opens_to_glass(const tn_opening_record *opening)
{
    return !(opening->flags & TN_PASSAGE) || opening->flags & TN_GLAZED;
}

static bool is_glass(const tn_house *house, const tn_house_block *block)
{
    return (block->kind == TN_SOLID_PANE || block->kind == TN_SOLID_LEAF) &&
           opens_to_glass(tn_form_opening(house->form, house->faces[block->of].kind));
}

/* Is all that a form has of it glass? */
static bool is_for_glass(const tn_house_form *form, const tn_material_record *material)
{
    uint32_t first = tn_form_openings_part(form);
    for (uint32_t i = 0; i < material->part_count; i++) {
        int64_t part = form->module->HOUSE_ITEM_records[material->part_first + i].number;
        if (part < first || part >= first + form->record->opening_count ||
            !opens_to_glass(&form->module->OPENING_records[form->record->opening_first + part - first]))
            return false;
    }
    return true;
}

static bool is_material(const tn_house_form *form, const char *name)
{
    for (uint32_t i = 0; i < form->record->material_count; i++)
        if (strcmp(tn_text(form->module, form->module->MATERIAL_records[form->record->material_first + i].name),
                   name) == 0)
            return true;
    return false;
}

/* What a material is called: as the form does; else as the kind of part, or "glass". "-glass" and "-plain" keep names
 * apart. NULL: there was no memory. */
static char *material_name(const tn_house_form *form, uint32_t group, bool glass)
{
    const char *name, *more;
    if (group < TN_SOLID_COUNT) {
        name = glass ? "glass" : tn_solid_kind_text((tn_solid_kind)group);
        more = is_material(form, name) ? "-plain" : "";
    } else {
        const tn_material_record *material =
            &form->module->MATERIAL_records[form->record->material_first + group - TN_SOLID_COUNT];
        name = tn_text(form->module, material->name);
        more = glass && !is_for_glass(form, material) ? "-glass" : "";
    }
    char *made;
    return asprintf(&made, "%s%s", name, more) < 0 ? NULL : made;
}

#define GLASS_OPACITY 0.35

static tn_status find_material(builder *b, uint32_t group, bool glass, uint32_t *material, tn_error *error)
{
    unsigned char colours[TN_HOUSE_GROUPS_MAX][3];
    uint32_t kind = glass && group < TN_SOLID_COUNT ? TN_SOLID_PANE : group, *made = &b->made[kind][glass];
    tn_status status = TN_OK;
    if (*made == 0) {
        char *name = material_name(b->house->form, kind, glass);
        if (!name)
            return tn_fail_memory(error);
        tn_house_mesh_colours(b->house->form, colours);
        status = tn_mesh_model_material(b->model, name, colours[kind], glass ? GLASS_OPACITY : 1, material, error);
        free(name);
        *made = *material + 1;
    }
    *material = *made - 1;
    return status;
}

/* ---- in their order */

static int by_place(const void *a, const void *b)
{
    const placed_block *p = a, *q = b;
    const uint32_t keys[][2] = {{p->storey, q->storey}, {p->room, q->room},         {p->kind, q->kind},  {p->of, q->of},
                                {p->item, q->item},     {p->material, q->material}, {p->block, q->block}};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (keys[i][0] != keys[i][1])
            return keys[i][0] < keys[i][1] ? -1 : 1;
    return 0;
}

static tn_status place_blocks(builder *b, tn_error *error)
{
    tn_status status = TN_OK;
    b->placed = malloc((b->blocks.count + 1) * sizeof *b->placed);
    if (!b->placed)
        return tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < b->blocks.count; i++) {
        b->placed[i] = place(b, i);
        status = find_material(b, b->blocks.items[i].group, is_glass(b->house, &b->blocks.items[i]),
                               &b->placed[i].material, error);
    }
    if (status == TN_OK)
        qsort(b->placed, b->blocks.count, sizeof *b->placed, by_place);
    return status;
}

/* ---- nodes */

static const char *part_name(const tn_house *house, const tn_house_block *block)
{
    const tn_house_form *form = house->form;
    switch (block->kind) {
    case TN_SOLID_OUTSIDE:
        return "wall";
    case TN_SOLID_PANE:
    case TN_SOLID_LEAF:
    case TN_SOLID_FLIGHT:
        return tn_form_kind_text(form, house->faces[block->of].kind);
    case TN_SOLID_ITEM:
        return tn_text(form->module, form->module->TILE_BOX_records[block->item].name);
    case TN_SOLID_BEAM:
        return tn_text(form->module, tn_form_beam(form, block->item)->name);
    default:
        return tn_solid_kind_text(block->kind);
    }
}

static bool is_same_part(const placed_block *a, const placed_block *b)
{
    return a->kind == b->kind && a->of == b->of && a->item == b->item;
}

/* The blocks of a storey that belong to a room of it, or to none: a node for each part, or (`whole`) all in the one
 * that is there. */
static tn_status take_parts(builder *b, uint32_t storey, uint32_t room, uint32_t parent, bool whole, tn_error *error)
{
    const placed_block *last = NULL;
    tn_mesh_piece piece = {.node = parent};
    tn_status status = TN_OK;
    for (; status == TN_OK && b->at < b->blocks.count; b->at++) {
        const placed_block *next = &b->placed[b->at];
        tn_house_block *block = &b->blocks.items[next->block];
        if (next->storey != storey || next->room != room)
            break;
        bool same = last && (whole || is_same_part(last, next));
        if (!whole && !same)
            status = tn_mesh_model_node(b->model, parent, part_name(b->house, block), &piece.node, error);
        if (status == TN_OK && (!same || piece.material != next->material)) {
            piece.material = next->material;
            status = tn_mesh_model_piece(b->model, piece, error);
        }
        block->group = (uint32_t)b->model->piece_count - 1;
        last = next;
    }
    return status;
}

enum { AREA_DIGITS = 12 };

static tn_status say_room(const builder *b, uint32_t room, tn_mesh_node *node, tn_error *error)
{
    const tn_house *house = b->house;
    const tn_numbered_room *numbered = &b->rooms.numbered[room - 1];
    const tn_cell *cell = &house->cells[numbered->largest];
    tn_buffer text = {0};
    tn_json json = tn_json_text(&text, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_string(&json, "function", tn_text(house->form->module, tn_form_rule(house->form, cell->function)->name));
    tn_json_string(&json, "number", numbered->number);
    tn_json_rounded(&json, "gross_m2", numbered->gross / 1e18, AREA_DIGITS);
    tn_json_rounded(&json, "net_m2", numbered->net / 1e18, AREA_DIGITS);
    tn_json_rounded(&json, "glazed_m2", (double)tn_room_glazing(house, b->rooms.rooms, numbered->room) / 1e18,
                    AREA_DIGITS);
    tn_json_object_end(&json);
    node->facts = text.data;
    return text.failed ? tn_fail_memory(error) : TN_OK;
}

/* "0.01-kitchen" */
static tn_status take_room(builder *b, uint32_t room, uint32_t storey_node, tn_error *error)
{
    const tn_numbered_room *numbered = &b->rooms.numbered[room - 1];
    const tn_house_form *form = b->house->form;
    uint32_t node;
    char *name;
    if (asprintf(&name, "%s-%s", numbered->number,
                 tn_text(form->module, tn_form_rule(form, b->house->cells[numbered->largest].function)->name)) < 0)
        return tn_fail_memory(error);
    tn_status status = tn_mesh_model_node(b->model, storey_node, name, &node, error);
    free(name);
    if (status == TN_OK && b->line)
        status = say_room(b, room, &b->model->nodes[node], error);
    return status == TN_OK ? take_parts(b, numbered->storey, room, node, false, error) : status;
}

static bool has_storey(const builder *b, uint32_t storey)
{
    return (b->at < b->blocks.count && b->placed[b->at].storey == storey) || tn_house_has_storey(b->house, storey);
}

static tn_status take_storey(builder *b, uint32_t storey, tn_error *error)
{
    const tn_house_form *form = b->house->form;
    uint32_t node;
    if (!has_storey(b, storey))
        return TN_OK;
    const tn_storey_record *record = &form->module->STOREY_records[form->record->storey_first + storey];
    tn_status status = tn_mesh_model_node(b->model, 0, tn_text(form->module, record->name), &node, error);
    if (status == TN_OK)
        status = take_parts(b, storey, 0, node, false, error);
    for (uint32_t r = 0; status == TN_OK && r < b->rooms.room_count; r++)
        if (b->rooms.numbered[r].storey == storey)
            status = take_room(b, r + 1, node, error);
    return status;
}

static tn_status take_all(builder *b, tn_error *error)
{
    uint32_t node, roof = b->house->form->record->storey_count;
    tn_status status = tn_mesh_model_node(b->model, 0, b->name, &node, error);
    for (uint32_t storey = 0; status == TN_OK && storey < roof; storey++)
        status = take_storey(b, storey, error);
    if (status != TN_OK || b->at == b->blocks.count)
        return status;
    status = tn_mesh_model_node(b->model, 0, tn_solid_kind_text(TN_SOLID_ROOF), &node, error);
    return status == TN_OK ? take_parts(b, roof, 0, node, true, error) : status;
}

/* ---- what is said of the house */

static void say_costs(const tn_house *house, const tn_costs *costs, tn_json *json)
{
    tn_json_number(json, "cost", mpz_get_d(costs->hundredths) / 100);
    tn_json_list(json, "costs");
    for (size_t i = 0; i < costs->count; i++) {
        const tn_cost_line *line = &costs->lines[i];
        if (!tn_cost_line_stands(line) || line->material == TN_NO_RECORD)
            continue;
        tn_json_object(json, NULL);
        tn_json_string(json, "part", tn_form_part_text(house->form, line->part));
        tn_json_string(json, "material",
                       tn_text(house->form->module, house->form->module->MATERIAL_records[line->material].name));
        tn_json_number(json, "cost", mpz_get_d(line->hundredths) / 100);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static tn_status say_house(const builder *b, const tn_solids *solids, tn_error *error)
{
    const tn_house *house = b->house;
    tn_costs costs = {0};
    tn_buffer text = {0};
    double gross = 0, net = 0;
    bool priced = tn_form_has_prices(house->form);
    tn_status status = priced ? tn_house_costs(house, solids, &costs, error) : TN_OK;
    for (uint32_t r = 0; r < b->rooms.room_count; r++) {
        gross += b->rooms.numbered[r].gross / 1e18;
        net += b->rooms.numbered[r].net / 1e18;
    }
    tn_json json = tn_json_text(&text, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_string(&json, "house", b->line);
    tn_json_string(&json, "form", tn_text(house->form->module, house->form->record->name));
    tn_json_rounded(&json, "gross_m2", gross, AREA_DIGITS);
    tn_json_rounded(&json, "net_m2", net, AREA_DIGITS);
    if (status == TN_OK && priced)
        say_costs(house, &costs, &json);
    tn_json_object_end(&json);
    b->model->facts = text.data;
    tn_costs_clear(&costs);
    return status == TN_OK && text.failed ? tn_fail_memory(error) : status;
}

/* ---- all */

static tn_status mesh_blocks(const builder *b, tn_mesh *mesh, tn_error *error)
{
    tn_status status = tn_blocks_mesh(&b->blocks, (uint32_t)b->model->piece_count, mesh, error);
    for (size_t i = 0; status == TN_OK && i < 3 * mesh->vertex_count; i++)
        mesh->positions[i] /= 1e9; /* metres */
    return status == TN_OK ? tn_mesh_sort_faces(mesh, error) : status;
}

tn_status tn_house_model(const tn_house *house, const tn_solids *solids, const char *name, const char *line,
                         tn_mesh *mesh, tn_mesh_model *model, tn_error *error)
{
    builder b = {.house = house, .name = name, .line = line, .model = model};
    *mesh = (tn_mesh){0};
    *model = (tn_mesh_model){0};
    tn_status status = tn_house_blocks(house, solids, &b.blocks, error);
    if (status == TN_OK)
        status = number_cells(&b, error);
    if (status == TN_OK)
        status = place_blocks(&b, error);
    if (status == TN_OK)
        status = take_all(&b, error);
    if (status == TN_OK && line)
        status = say_house(&b, solids, error);
    if (status == TN_OK)
        status = mesh_blocks(&b, mesh, error);
    tn_blocks_clear(&b.blocks);
    tn_designations_clear(&b.rooms);
    free(b.numbered);
    free(b.placed);
    return status;
}
