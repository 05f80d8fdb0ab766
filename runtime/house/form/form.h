/* A form made ready: what a plan's trays become when they stand up (docs/houses.md).
 *
 * A form is immutable and may be shared between threads. It borrows the module and the schema, which must outlive it.
 */
#ifndef TARTAN_HOUSE_FORM_FORM_H
#define TARTAN_HOUSE_FORM_FORM_H

#include "runtime/plan/schema/schema.h"

#define TN_DECISION_STACK_MAX 1024u

typedef struct tn_house_form {
    const tn_module *module;
    const tn_form_record *record;
    const tn_schema *schema;
    uint32_t width;                /* the schema's first field of lengths */
    uint32_t spine;                /* a field of the schema */
    uint32_t zones[TN_FIELDS_MAX]; /* the schema's zones, from back to front */
    uint32_t zone_count;
    uint32_t kinds_end[TN_CELL_RULE_KIND_COUNT]; /* rules of a kind end there; those of the next one begin */
    uint32_t layers_end[TN_LAYERED_COUNT];       /* its layers of a kind end there; those of the next one begin */
    int64_t level[TN_STOREYS_MAX + 1];           /* the floor of each storey, and what is above the last */
    uint64_t
        bare[(TN_CELL_RULES_MAX + 63) / 64]; /* if it asks for ways: a bit for each function whose cells are bare */
    bool has_outdoor;                        /* some function is outdoor */
} tn_house_form;

/* The schema of the FORM record `index`, whose trays houses go through one by one: E0803 if they are too many to be
 * listed, and as of tn_schema_new. Free with tn_schema_free. */
tn_status tn_form_schema(const tn_module *module, uint32_t index, tn_schema **schema, tn_error *error);

/* Makes the FORM record `index` ready; `schema` is its schema. */
void tn_form_ready(const tn_module *module, uint32_t index, const tn_schema *schema, tn_house_form *form);

/* Have cells of the function nothing in them: neither tiles, nor flights or stairs of any line of faces? Those in the
 * open are not called so. */
static inline bool tn_form_is_bare(const tn_house_form *form, uint32_t function)
{
    return form->bare[function / 64] >> function % 64 & 1;
}

/* How many functions it has; function i is rule i. */
static inline uint32_t tn_form_functions(const tn_house_form *form)
{
    return form->kinds_end[TN_CELL_FUNCTION];
}

static inline const tn_cell_rule_record *tn_form_rule(const tn_house_form *form, uint32_t rule)
{
    return &form->module->CELL_RULE_records[form->record->rule_first + rule];
}

static inline const tn_choice_record *tn_form_choice(const tn_house_form *form, uint32_t choice)
{
    return &form->module->CHOICE_records[form->record->choice_first + choice];
}

/* Is the term of walks between cells? */
static inline bool tn_house_term_walks(uint32_t kind)
{
    return kind == TN_HOUSE_LONGEST_WALK || kind == TN_HOUSE_SHORTEST_WALK;
}

/* Does it depend on walks, and so on all that stands on the floors of a house? */
static inline bool tn_house_term_of_floors(uint32_t kind)
{
    return tn_house_term_walks(kind) || kind == TN_HOUSE_EXITS;
}

static inline bool tn_form_is_outdoor(const tn_house_form *form, uint32_t function)
{
    return tn_form_rule(form, function)->flags & TN_OUTDOOR;
}

/* Does a line of faces name the function of its first cells, and may they have it? */
bool tn_form_line_names(const tn_house_form *form, const tn_face_line_record *line, uint32_t function);

/* Does a line of faces say of both cells what they are: is neither `cell(any)`? */
bool tn_form_names_both(const tn_house_form *form, const tn_face_line_record *line);

/* The next section, by the shape of each choice, the last choice first; all zeros begin. False after the last. */
static inline bool tn_form_next_section(const tn_house_form *form, uint32_t *shapes)
{
    for (uint32_t i = form->record->choice_count; i-- > 0;) {
        if (++shapes[i] < tn_form_choice(form, i)->shape_count)
            return true;
        shapes[i] = 0;
    }
    return false;
}

/* The record of a kind of face that the form declares, an opening or a flight; NULL where it is none. */
static inline const tn_opening_record *tn_form_declared(const tn_house_form *form, uint32_t kind)
{
    return kind < TN_FACE_KIND_COUNT
               ? NULL
               : &form->module->OPENING_records[form->record->opening_first + kind - TN_FACE_KIND_COUNT];
}

/* The opening that a kind of face is; NULL where it is none. */
static inline const tn_opening_record *tn_form_opening(const tn_house_form *form, uint32_t kind)
{
    const tn_opening_record *declared = tn_form_declared(form, kind);
    return declared && declared->turn == TN_TURN_NONE ? declared : NULL;
}

/* The flight of stairs that a kind of face is; NULL where it is none. */
static inline const tn_opening_record *tn_form_flight(const tn_house_form *form, uint32_t kind)
{
    const tn_opening_record *declared = tn_form_declared(form, kind);
    return declared && declared->turn != TN_TURN_NONE ? declared : NULL;
}

static inline const tn_beam_record *tn_form_beam(const tn_house_form *form, uint32_t beam)
{
    return &form->module->BEAM_records[form->record->beam_first + beam];
}

/* The number of the first part that is an opening or flight: those of the form's layers come before. */
static inline uint32_t tn_form_openings_part(const tn_house_form *form)
{
    return TN_OF_COUNT + form->record->layer_count;
}

static inline const tn_layer_record *tn_form_layer(const tn_house_form *form, uint32_t layer)
{
    return &form->module->LAYER_records[form->record->layer_first + layer];
}

/* The first layer of what consists of layers; those up to layers_end are its layers. */
static inline uint32_t tn_form_layers(const tn_house_form *form, tn_layered of)
{
    return of == 0 ? 0 : form->layers_end[of - 1];
}

/* How thick what may consist of layers is. */
static inline int64_t tn_layered_thick(const tn_form_record *form, tn_layered of)
{
    return of == TN_LAYERED_PARTITION ? form->partition
           : of == TN_LAYERED_DECK    ? form->deck
           : of == TN_LAYERED_ROOF    ? form->roof
                                      : form->wall;
}

/* The height of a storey's rooms: from its floor to the deck above. */
static inline int64_t tn_form_clear(const tn_house_form *form, uint32_t storey)
{
    return form->level[storey + 1] - form->level[storey] - form->record->deck;
}

/* How a house line writes a kind of face. */
const char *tn_form_kind_text(const tn_house_form *form, uint32_t kind);

#endif
