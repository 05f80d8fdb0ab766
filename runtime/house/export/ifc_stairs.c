/* Writes the stairs of a building model: their flights, landings and guards. */
#include <stdio.h>
#include <stdlib.h>

#include "runtime/house/export/ifc.h"

/* A flight of stairs as it stands in a face, and what is written of it. record: NULL of a stair without a shape. */
typedef struct tn_ifc_stair {
    uint32_t face;
    const tn_opening_record *record;
    const tn_flight *flight; /* NULL: the same */
    const char *name;
    char key[TN_IFC_FACE_KEY + 10];
    unsigned where;
    double riser; /* nanometres */
    size_t risers;
    tn_stepfile_list parts;
} tn_ifc_stair;

/* A landing is larger than a step. */
static bool is_landing(const tn_ifc_stair *stair, size_t tread)
{
    const tn_box *at = &stair->flight->treads[tread];
    return stair->record->turn != TN_TURN_STRAIGHT &&
           (tn_int128)(at->x1 - at->x0) * (at->y1 - at->y0) != (tn_int128)stair->record->wide * stair->record->going;
}

/* Is a box of the flight, or a piece of one that a post cuts, of the treads from `first` on and before `end`? */
static bool is_among(const tn_ifc *ifc, const tn_ifc_stair *stair, const tn_box *b, size_t first, size_t end)
{
    int64_t floor = ifc->house->form->level[ifc->storey];
    for (size_t i = first; i < end; i++) {
        const tn_box *at = &stair->flight->treads[i];
        if (b->x0 >= at->x0 && b->x1 <= at->x1 && b->y0 >= at->y0 && b->y1 <= at->y1 && b->z1 == floor + at->z1)
            return true;
    }
    return false;
}

/* Steps as solids. */
typedef struct tn_ifc_steps {
    tn_stepfile_list bodies;
    double volume, plan;
} tn_ifc_steps;

/* Those that are boxes; faceted: as solids of faces, since others of the flight are. */
static void put_boxes(tn_ifc *ifc, const tn_ifc_stair *stair, size_t first, size_t end, bool faceted,
                      tn_ifc_steps *steps)
{
    double floor = (double)ifc->house->form->level[ifc->storey];
    for (size_t i = 0; i < ifc->solids->box_count; i++) {
        const tn_solid *s = &ifc->solids->boxes[i];
        if (s->kind != TN_SOLID_FLIGHT || s->of != stair->face || !is_among(ifc, stair, &s->at, first, end))
            continue;
        const double low[3] = {(double)s->at.x0, (double)s->at.y0, (double)s->at.z0 - floor},
                     high[3] = {(double)s->at.x1, (double)s->at.y1, (double)s->at.z1 - floor};
        const tn_block_corner corners[4] = {{low[0], low[1], low[2], high[2]},
                                            {high[0], low[1], low[2], high[2]},
                                            {high[0], high[1], low[2], high[2]},
                                            {low[0], high[1], low[2], high[2]}};
        tn_stepfile_list_add(&steps->bodies, faceted ? tn_stepfile_prism(&ifc->step, corners, 4)
                                                     : tn_stepfile_solid(&ifc->step, low, high));
        steps->volume += tn_ifc_box_volume(&s->at);
        steps->plan += (high[0] - low[0]) * (high[1] - low[1]) / 1e18;
    }
}

/* Those that are wedges. */
static void put_wedges(tn_ifc *ifc, const tn_ifc_stair *stair, tn_ifc_steps *steps)
{
    for (size_t i = 0; i < ifc->solids->prism_count; i++) {
        const tn_prism *prism = &ifc->solids->prisms[i];
        tn_block_corner corners[TN_FACET_CORNERS];
        if (prism->kind != TN_SOLID_FLIGHT || prism->of != stair->face)
            continue;
        size_t count = tn_ifc_corners(ifc, prism, corners);
        tn_stepfile_list_add(&steps->bodies, tn_stepfile_prism(&ifc->step, corners, count));
        steps->volume += tn_ifc_prism_volume(corners, count);
    }
}

/* The shape of the treads from `first` on and before `end`; 0: nothing is left of them. */
static unsigned shape_of(tn_ifc *ifc, const tn_ifc_stair *stair, size_t first, size_t end, tn_ifc_steps *steps)
{
    bool faceted = stair->flight->wedge_count > 0;
    *steps = (tn_ifc_steps){.volume = 0};
    tn_ifc_look_as(ifc, &(tn_solid){.kind = TN_SOLID_FLIGHT, .of = stair->face});
    put_boxes(ifc, stair, first, end, faceted, steps);
    if (faceted)
        put_wedges(ifc, stair, steps);
    return tn_ifc_shape(ifc, faceted ? "Tessellation" : "SweptSolid", &steps->bodies);
}

static void keep(tn_ifc *ifc, tn_ifc_stair *stair, unsigned part)
{
    tn_ifc_make_of(ifc, &(tn_solid){.kind = TN_SOLID_FLIGHT, .of = stair->face}, part);
    tn_stepfile_list_add(&stair->parts, part);
}

/* How many risers and treads there are, and how large they are, as properties of a set. */
static void describe_steps(tn_ifc *ifc, const tn_ifc_stair *stair, unsigned part, const char *set, size_t risers,
                           size_t treads)
{
    tn_ifc_property sizes[4] = {
        {.name = "NumberOfRiser"}, {.name = "NumberOfTreads"}, {.name = "RiserHeight"}, {.name = "TreadLength"}};
    snprintf(sizes[0].value, sizeof sizes[0].value, "IFCCOUNTMEASURE(%zu)", risers);
    snprintf(sizes[1].value, sizeof sizes[1].value, "IFCCOUNTMEASURE(%zu)", treads);
    snprintf(sizes[2].value, sizeof sizes[2].value, "IFCPOSITIVELENGTHMEASURE(%s)",
             tn_stepfile_length(&ifc->step, stair->riser).text);
    snprintf(sizes[3].value, sizeof sizes[3].value, "IFCPOSITIVELENGTHMEASURE(%s)",
             tn_stepfile_length(&ifc->step, (double)stair->record->going).text);
    tn_ifc_properties(ifc, part, set, stair->name, sizes, 4);
}

/* Treads that follow one another without a landing; above the last is a riser more. */
static void put_run(tn_ifc *ifc, tn_ifc_stair *stair, size_t number, size_t first, size_t end)
{
    tn_ifc_steps steps;
    unsigned shape = shape_of(ifc, stair, first, end, &steps);
    char key[sizeof stair->key + 40], tail[40];
    size_t treads = end - first + stair->flight->wedge_count;
    if (!shape)
        return;
    snprintf(tail, sizeof tail, ",$,$,$,$,.%s.", /* sizes are among the properties */
             stair->record->turn == TN_TURN_SPIRAL ? "SPIRAL"
             : stair->flight->wedge_count > 0      ? "WINDER"
                                                   : "STRAIGHT");
    snprintf(key, sizeof key, "flight %zu of %s", number, stair->key);
    const tn_ifc_part part = {.entity = "IFCSTAIRFLIGHT",
                              .tail = tail,
                              .name = stair->name,
                              .type_name = stair->name,
                              .shape = shape,
                              .where = tn_stepfile_placement(&ifc->step, stair->where, 0, 0, 0)};
    unsigned run = tn_ifc_put(ifc, &part, key);
    const tn_ifc_quantity quantities[] = {{"GrossVolume", 'V', steps.volume}, {"NetVolume", 'V', steps.volume}};
    describe_steps(ifc, stair, run, "Pset_StairFlightCommon", treads + 1, treads);
    tn_ifc_quantities(ifc, run, "Qto_StairFlightBaseQuantities", key, quantities, 2);
    keep(ifc, stair, run);
}

static void put_landing(tn_ifc *ifc, tn_ifc_stair *stair, size_t tread)
{
    tn_ifc_steps steps;
    unsigned shape = shape_of(ifc, stair, tread, tread + 1, &steps);
    const tn_box *at = &stair->flight->treads[tread];
    char key[sizeof stair->key + 40], type[100];
    if (!shape)
        return;
    snprintf(key, sizeof key, "landing of %s", stair->key);
    tn_ifc_sized_name(ifc, "landing", at->z1 - at->z0, type, sizeof type);
    const tn_ifc_part part = {.entity = "IFCSLAB",
                              .tail = ",.LANDING.",
                              .name = "landing",
                              .type_name = type,
                              .shape = shape,
                              .where = tn_stepfile_placement(&ifc->step, stair->where, 0, 0, 0)};
    unsigned landing = tn_ifc_put(ifc, &part, key);
    const tn_ifc_property inside = tn_ifc_truth("IsExternal", false);
    const tn_ifc_quantity quantities[] = {{"Width", 'L', (double)(at->z1 - at->z0)},
                                          {"GrossArea", 'A', steps.plan},
                                          {"NetArea", 'A', steps.plan},
                                          {"GrossVolume", 'V', steps.volume},
                                          {"NetVolume", 'V', steps.volume}};
    tn_ifc_properties(ifc, landing, "Pset_SlabCommon", type, &inside, 1);
    tn_ifc_quantities(ifc, landing, "Qto_SlabBaseQuantities", key, quantities, 5);
    keep(ifc, stair, landing);
}

static void put_flights(tn_ifc *ifc, tn_ifc_stair *stair)
{
    const tn_flight *flight = stair->flight;
    size_t run = 0, first = 0;
    for (size_t i = 0; i < flight->tread_count; i++) {
        if (!is_landing(stair, i))
            continue;
        put_run(ifc, stair, run++, first, i);
        put_landing(ifc, stair, i);
        first = i + 1;
    }
    put_run(ifc, stair, run, first, flight->tread_count);
    for (size_t i = 0; i < ifc->solids->box_count; i++) {
        const tn_solid *s = &ifc->solids->boxes[i];
        if (s->kind == TN_SOLID_GUARD && s->of == stair->face)
            tn_stepfile_list_add(&stair->parts, tn_ifc_put_guard(ifc, s, stair->where));
    }
}

static const char *stair_type(const tn_opening_record *flight)
{
    switch (flight ? (tn_turn)flight->turn : TN_TURN_NONE) {
    case TN_TURN_STRAIGHT:
        return ",.STRAIGHT_RUN_STAIR.";
    case TN_TURN_QUARTER:
        return flight->winders ? ",.QUARTER_WINDING_STAIR." : ",.QUARTER_TURN_STAIR.";
    case TN_TURN_HALF:
        return flight->winders ? ",.HALF_WINDING_STAIR." : ",.HALF_TURN_STAIR.";
    case TN_TURN_SPIRAL:
        return ",.SPIRAL_STAIR.";
    default:
        return ",.NOTDEFINED.";
    }
}

/* Of a stair without a shape only what it takes of the floor is known. */
static unsigned outline_of(tn_ifc *ifc, const tn_face *face)
{
    const tn_rectangle *at = &face->at;
    double x0 = (double)at->x0, x1 = (double)at->x1, y0 = (double)at->y0, y1 = (double)at->y1;
    const double around[5][2] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}};
    unsigned curve = tn_stepfile_curve(&ifc->step, around, 5),
             representation = tn_stepfile_add(&ifc->step, "IFCSHAPEREPRESENTATION(#%u,'FootPrint','Curve2D',(#%u))",
                                              ifc->step.plan_context, curve);
    return tn_stepfile_shape(&ifc->step, representation, 0);
}

/* The stair itself, when its parts are written. */
static unsigned put_whole(tn_ifc *ifc, tn_ifc_stair *stair)
{
    const char *type = stair_type(stair->record), *parts = tn_stepfile_list_text(&stair->parts);
    const tn_ifc_part part = {.entity = "IFCSTAIR",
                              .tail = type,
                              .name = stair->name,
                              .type_name = stair->name,
                              .where = stair->where,
                              .shape = parts ? 0 : outline_of(ifc, &ifc->house->faces[stair->face])};
    unsigned made = tn_ifc_put(ifc, &part, stair->key);
    if (parts)
        tn_stepfile_add(&ifc->step, "IFCRELAGGREGATES('%s',$,$,$,#%u,%s)",
                        tn_stepfile_guid(&ifc->step, "parts of %s", stair->key).text, made, parts);
    if (ifc->house->faces[stair->face].kind >= TN_FACE_KIND_COUNT)
        tn_ifc_classify(ifc, tn_solid_whole_part(ifc->house, TN_SOLID_FLIGHT, stair->face, 0), made);
    if (stair->risers > 0)
        describe_steps(ifc, stair, made, "Pset_StairCommon", stair->risers, stair->risers - 1);
    else
        tn_ifc_properties(ifc, made, "Pset_StairCommon", stair->name, NULL, 0);
    return made;
}

static const tn_flight *flight_in(const tn_ifc *ifc, uint32_t face)
{
    for (size_t i = 0; i < ifc->flights.count; i++)
        if (ifc->flights.items[i].face == face)
            return &ifc->flights.items[i];
    return NULL;
}

static void put_stair(tn_ifc *ifc, uint32_t face, tn_stepfile_list *list)
{
    const tn_house_form *form = ifc->house->form;
    char of[TN_IFC_FACE_KEY];
    tn_ifc_stair stair = {.face = face,
                          .record = tn_form_flight(form, ifc->house->faces[face].kind),
                          .flight = flight_in(ifc, face),
                          .where = tn_stepfile_placement(&ifc->step, ifc->placement, 0, 0, 0)};
    stair.name = stair.record ? tn_text(form->module, stair.record->name) : "stair";
    tn_ifc_face_key(ifc, face, of);
    snprintf(stair.key, sizeof stair.key, "stair %s", of);
    if (stair.flight && stair.flight->tread_count + stair.flight->wedge_count > 0) {
        int64_t height = form->level[ifc->storey + 1] - form->level[ifc->storey];
        stair.risers = stair.flight->tread_count + stair.flight->wedge_count + 1;
        stair.riser = (double)height / (double)stair.risers;
        put_flights(ifc, &stair);
    }
    tn_stepfile_list_add(list, put_whole(ifc, &stair));
    ifc->failed |= stair.parts.text.failed;
    tn_stepfile_list_clear(&stair.parts);
}

void tn_ifc_put_stairs(tn_ifc *ifc, tn_stepfile_list *list)
{
    for (uint32_t i = 0; i < ifc->house->face_count; i++) {
        const tn_face *face = &ifc->house->faces[i];
        bool stair = face->kind == TN_FACE_STAIR || tn_form_flight(ifc->house->form, face->kind);
        if (face->relation == TN_FACE_UNDER && stair && ifc->house->cells[face->first].storey == ifc->storey)
            put_stair(ifc, i, list);
    }
}
