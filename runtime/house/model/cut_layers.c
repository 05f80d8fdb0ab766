/* Cuts the layers of walls, decks and roofs by the plane of a drawing. */
#include "runtime/house/model/aspect.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/base/array.h"

/* The plane, and what goes into the drawing. across: the two other axes, which are u and v. */
typedef struct tn_layer_cutting {
    const tn_house *house;
    const tn_solids *solids;
    int axis, across[2];
    double at;
    tn_house_projection *projection;
} tn_layer_cutting;

static void find_least_and_main(const tn_layering *layers, double *least, uint32_t *main)
{
    int64_t thin = INT64_MAX, thick = 0;
    for (uint32_t i = layers->first; i < layers->first + layers->count; i++) {
        int64_t of = tn_form_layer(layers->form, i)->thick;
        *main = of > thick ? i : *main;
        thick = of > thick ? of : thick;
        thin = of < thin ? of : thin;
    }
    *least = (double)thin;
}

/* A layer that is drawn, but for its polygon. */
static tn_cut_layer begin(const tn_layering *layers, uint32_t layer, tn_solid_kind kind)
{
    tn_cut_layer cut = {.layer = layer, .group = tn_solid_groups[kind]};
    uint32_t main = layers->first;
    find_least_and_main(layers, &cut.least, &main);
    cut.main = layer == main;
    return cut;
}

static tn_status add(const tn_layer_cutting *c, const tn_cut_layer *cut, tn_error *error)
{
    tn_house_projection *p = c->projection;
    if (!tn_array_reserve_from(&p->layers, &p->layer_room, 64, p->layer_count, 1, sizeof *p->layers))
        return tn_fail_memory(error);
    p->layers[p->layer_count++] = *cut;
    return TN_OK;
}

/* ---- of boxes */

static tn_status cut_box(const tn_layer_cutting *c, const tn_solid *solid, const tn_layering *layers, uint32_t layer,
                         tn_error *error)
{
    tn_box box = tn_layer_box(layers, layer, &solid->at);
    const int64_t ends[3][2] = {{box.x0, box.x1}, {box.y0, box.y1}, {box.z0, box.z1}};
    double low[2], high[2];
    if ((double)ends[c->axis][0] >= c->at || (double)ends[c->axis][1] <= c->at)
        return TN_OK;
    tn_cut_layer cut = begin(layers, layer, solid->kind);
    cut.meets = layer > layers->first && layers->axis != c->axis;
    for (int k = 0; k < 2; k++) {
        low[k] = (double)ends[c->across[k]][0];
        high[k] = (double)ends[c->across[k]][1];
        bool ended = c->across[k] == layers->axis; /* the line is at one end of it */
        cut.line[0][k] = ended && layers->from_high ? high[k] : low[k];
        cut.line[1][k] = ended && !layers->from_high ? low[k] : high[k];
    }
    for (int i = 0; i < 4; i++) {
        cut.at[i][0] = i == 1 || i == 2 ? high[0] : low[0];
        cut.at[i][1] = i >= 2 ? high[1] : low[1];
    }
    return add(c, &cut, error);
}

static tn_status cut_boxes(const tn_layer_cutting *c, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < c->solids->box_count; i++) {
        const tn_solid *s = &c->solids->boxes[i];
        tn_layering layers = tn_solid_layering(c->house, s->kind, s->of, s->item);
        for (uint32_t k = layers.first; status == TN_OK && k < layers.first + layers.count; k++)
            status = cut_box(c, s, &layers, k, error);
    }
    return status;
}

/* ---- of prisms */

#define SAME_NM 0.5

/* Where a layer of a wall below a roof meets the one before it, if an edge of what is cut is there. */
static void find_joint(const tn_layer_cutting *c, const tn_prism *prism, const tn_layering *layers, tn_cut_layer *cut)
{
    tn_rectangle r = tn_gable_layer_at(c->house, prism->item, layers, cut->layer);
    double joint = (double)(layers->axis == 0 ? layers->from_high ? r.x1 : r.x0 : layers->from_high ? r.y1 : r.y0);
    int k = c->across[0] == layers->axis ? 0 : 1;
    for (int i = 0; c->across[k] == layers->axis && !cut->meets && i < 4; i++) {
        const double *from = cut->at[i], *to = cut->at[(i + 1) % 4];
        bool edge = fabs(from[k] - joint) < SAME_NM && fabs(to[k] - joint) < SAME_NM;
        cut->meets = edge && fabs(from[1 - k] - to[1 - k]) > SAME_NM;
        for (int n = 0; n < 2; n++) {
            cut->line[0][n] = from[n];
            cut->line[1][n] = to[n];
        }
    }
}

static tn_status add_face(const tn_layer_cutting *c, const tn_prism *prism, const tn_layering *layers, uint32_t layer,
                          const tn_cut_face *face, tn_error *error)
{
    tn_cut_layer cut = begin(layers, layer, prism->kind);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++)
            cut.at[i][k] = face->at[i][k];
    if (layer > layers->first && prism->kind == TN_SOLID_GABLE)
        find_joint(c, prism, layers, &cut);
    cut.meets = cut.meets || (layer > layers->first && prism->kind == TN_SOLID_ROOF && c->axis != 2);
    for (int k = 0; prism->kind == TN_SOLID_ROOF && k < 2; k++) { /* its upper end, as tn_blocks_cut has it */
        cut.line[0][k] = face->at[3][k];
        cut.line[1][k] = face->at[2][k];
    }
    return add(c, &cut, error);
}

static tn_status cut_prism(const tn_layer_cutting *c, const tn_prism *prism, const tn_layering *layers, uint32_t layer,
                           tn_error *error)
{
    tn_solids pieces = {0};
    tn_blocks blocks = {0};
    tn_status status = tn_layer_prisms(c->house, c->solids, prism, layers, layer, &pieces, error);
    if (status == TN_OK)
        status = tn_blocks_of_prisms(&pieces, &blocks, error);
    if (status == TN_OK)
        status = tn_blocks_cut(&blocks, c->axis, c->at, false, error);
    for (size_t i = 0; status == TN_OK && i < blocks.cut_count; i++)
        status = add_face(c, prism, layers, layer, &blocks.cuts[i], error);
    tn_blocks_clear(&blocks);
    tn_solids_clear(&pieces);
    return status;
}

static tn_status cut_prisms(const tn_layer_cutting *c, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < c->solids->prism_count; i++) {
        const tn_prism *prism = &c->solids->prisms[i];
        tn_layering layers = tn_solid_layering(c->house, prism->kind, prism->of, prism->item);
        for (uint32_t k = layers.first; status == TN_OK && k < layers.first + layers.count; k++)
            status = cut_prism(c, prism, &layers, k, error);
    }
    return status;
}

/* Makes one line of the joints of layers of a number that lie in one. */
static tn_status join_layers(tn_house_projection *p, tn_error *error)
{
    p->joints = malloc((p->layer_count + 1) * sizeof *p->joints);
    if (!p->joints)
        return tn_fail_memory(error);
    for (size_t i = 0; i < p->layer_count; i++) {
        const tn_cut_layer *layer = &p->layers[i];
        tn_drawn_line joint = {.weight = TN_STROKE_THIN, .group = layer->layer, .cut = true};
        for (int end = 0; end < 2; end++)
            for (int k = 0; k < 2; k++)
                joint.at[end][k] = layer->line[end][k];
        if (layer->meets)
            p->joints[p->joint_count++] = joint;
    }
    return tn_lines_merge(p->joints, &p->joint_count, true, error);
}

tn_status tn_cut_layers(const tn_house *house, const tn_solids *solids, int axis, double at,
                        tn_house_projection *projection, tn_error *error)
{
    const tn_layer_cutting c = {.house = house,
                                .solids = solids,
                                .axis = axis,
                                .across = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2},
                                .at = at,
                                .projection = projection};
    if (house->form->record->layer_count == 0)
        return TN_OK;
    tn_status status = cut_boxes(&c, error);
    if (status == TN_OK)
        status = cut_prisms(&c, error);
    return status == TN_OK ? join_layers(projection, error) : status;
}
