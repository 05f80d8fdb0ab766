/* What walls, posts, decks and roofs consist of: layers, from the outside or from the first cell of a face inwards, from the
 * top of a deck or a roof down. A layer is the solid's box, cut across; layers of prisms are made in roof.c. */
#include "runtime/house/solids.h"

tn_solid_kind tn_face_wall(const tn_house *house, const tn_face *face)
{
    return tn_face_is_outer(house, face) ? TN_SOLID_OUTSIDE
           : face->kind == TN_FACE_PARTY ? TN_SOLID_PARTY
                                         : TN_SOLID_PARTITION;
}

static tn_layering layers_of(const tn_house_form *form, tn_layered of)
{
    uint32_t first = tn_form_layers(form, of);
    return (tn_layering){.form = form, .first = first, .count = form->layers_end[of] - first};
}

/* Is the outside, or the first cell, at the low side of the face? */
static bool begins_low(const tn_house *house, const tn_face *face)
{
    uint32_t inner = tn_face_is_outer(house, face) ? tn_face_sheltered(house, face) : TN_NO_CELL;
    tn_house_side side = inner != TN_NO_CELL ? tn_face_side(face, inner) : face->side; /* of that, or the first cell */
    bool low = side == TN_HOUSE_BACK || side == TN_HOUSE_LEFT;
    return low == (inner != TN_NO_CELL);
}

/* Of a wall in a face that consists of such layers. */
static tn_layering along_face(const tn_house *house, const tn_face *face, tn_layered of)
{
    tn_layering layers = layers_of(house->form, of);
    layers.axis = face->at.x0 == face->at.x1 ? 0 : 1;
    layers.from_high = !begins_low(house, face);
    return layers;
}

tn_layering tn_face_layering(const tn_house *house, const tn_face *face)
{
    static const tn_layered kinds[] = {[TN_SOLID_OUTSIDE] = TN_LAYERED_OUTSIDE,
                                       [TN_SOLID_PARTY] = TN_LAYERED_PARTY,
                                       [TN_SOLID_PARTITION] = TN_LAYERED_PARTITION};
    return along_face(house, face, kinds[tn_face_wall(house, face)]);
}

tn_layering tn_gable_layering(const tn_house *house, const tn_face *face)
{
    bool party = tn_face_wall(house, face) == TN_SOLID_PARTY;
    return along_face(house, face, party ? TN_LAYERED_PARTY : TN_LAYERED_OUTSIDE);
}

tn_layering tn_solid_layering(const tn_house *house, tn_solid_kind kind, uint32_t of, uint32_t item)
{
    tn_layering layers = {.form = house->form};
    if (house->form->record->layer_count == 0)
        return layers;
    switch (kind) {
    case TN_SOLID_OUTSIDE:
    case TN_SOLID_PARTY:
    case TN_SOLID_PARTITION:
        return tn_face_layering(house, &house->faces[of]);
    case TN_SOLID_POST:
        return item == TN_NO_FACE ? layers : tn_face_layering(house, &house->faces[item]);
    case TN_SOLID_GABLE:
        return item == TN_NO_FACE ? layers : tn_gable_layering(house, &house->faces[item]);
    case TN_SOLID_DECK:
    case TN_SOLID_ROOFDECK:
    case TN_SOLID_ROOF:
        layers = layers_of(house->form, kind == TN_SOLID_ROOF ? TN_LAYERED_ROOF : TN_LAYERED_DECK);
        layers.axis = 2;
        layers.from_high = true;
        return layers;
    default:
        return layers;
    }
}

tn_box tn_layer_box(const tn_layering *layers, uint32_t layer, const tn_box *box)
{
    tn_box cut = *box;
    int64_t *low = layers->axis == 0   ? &cut.x0
                   : layers->axis == 1 ? &cut.y0
                                       : &cut.z0,
            *high = layers->axis == 0   ? &cut.x1
                    : layers->axis == 1 ? &cut.y1
                                        : &cut.z1,
            before = 0, thick = tn_form_layer(layers->form, layer)->thick;
    for (uint32_t i = layers->first; i < layer; i++)
        before += tn_form_layer(layers->form, i)->thick;
    if (layers->from_high) {
        *high -= before;
        *low = *high - thick;
    } else {
        *low += before;
        *high = *low + thick;
    }
    return cut;
}

tn_rectangle tn_gable_layer_at(const tn_house *house, uint32_t face, const tn_layering *layers, uint32_t layer)
{
    tn_rectangle r = tn_rectangle_grown(&house->faces[face].at, house->form->record->wall / 2);
    tn_box box = tn_layer_box(layers, layer, &(tn_box){r.x0, r.x1, r.y0, r.y1, 0, 0});
    return (tn_rectangle){box.x0, box.x1, box.y0, box.y1};
}

uint32_t tn_post_wall(const tn_house *house, uint32_t storey, const tn_post *post)
{
    uint32_t walls[2] = {TN_NO_FACE, TN_NO_FACE}; /* along x, along y */
    for (uint32_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        bool ends =
            (face->at.x0 == post->x && face->at.y0 == post->y) || (face->at.x1 == post->x && face->at.y1 == post->y);
        if (!ends || face->storey != storey)
            continue;
        int along = face->at.x0 == face->at.x1;
        int64_t thick = tn_face_thickness(house, face);
        if (walls[along] == TN_NO_FACE && thick > 0 && thick == (along ? post->thick_x : post->thick_y))
            walls[along] = i;
    }
    if (post->thick_x == post->thick_y)
        return walls[0] != TN_NO_FACE ? walls[0] : walls[1];
    return walls[post->thick_x > post->thick_y];
}
