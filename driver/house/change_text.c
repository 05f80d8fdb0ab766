/* Names cells, faces, changes and areas of houses. */
#include "driver/house/change_text.h"

#include <stdio.h>

#include "runtime/base/length.h"
#include "runtime/house/solids.h"

static const char *text_of(const tn_house *house, uint32_t string)
{
    return tn_text(house->form->module, string);
}

void tn_cell_text(const tn_house *house, uint32_t index, char *text, size_t size)
{
    const tn_cell *cell = &house->cells[index];
    const tn_house_form *form = house->form;
    snprintf(text, size, "%u.%s.%s", cell->tray + 1, text_of(house, form->schema->fields[cell->zone].name),
             text_of(house, form->module->STOREY_records[form->record->storey_first + cell->storey].name));
}

void tn_face_text(const tn_house *house, uint32_t index, char *text, size_t size)
{
    static const char *const sides[] = {[TN_HOUSE_ANY_SIDE] = "above",
                                        [TN_HOUSE_BACK] = "back",
                                        [TN_HOUSE_FRONT] = "front",
                                        [TN_HOUSE_LEFT] = "left",
                                        [TN_HOUSE_RIGHT] = "right"};
    const tn_face *face = &house->faces[index];
    char cell[96], other[96];
    tn_cell_text(house, face->first, cell, sizeof cell);
    if (face->second == TN_NO_CELL) {
        snprintf(text, size, "%s, %s", cell, sides[face->side]);
        return;
    }
    tn_cell_text(house, face->second, other, sizeof other);
    snprintf(text, size, "%s to %s", cell, other);
}

static void write_length(const tn_house *house, int64_t length, char text[64])
{
    tn_length_style style = tn_house_length_style(house);
    bool whole = style != TN_STYLE_FEET || length % (TN_INCH_NM / 64) == 0; /* other lengths are in metres */
    tn_length_write_style(length, whole ? style : TN_STYLE_METRES, text, 64);
}

/* Why none of the form's beams bears a stretch; empty if the form has none. */
static void write_why(const tn_house *house, const tn_unborne *stretch, char *text, size_t size)
{
    const tn_house_form *form = house->form;
    const tn_beam_record *spans = NULL;
    char length[64];
    for (uint32_t i = form->record->beam_count; i-- > 0;)
        if (tn_form_beam(form, i)->span >= stretch->to - stretch->from)
            spans = tn_form_beam(form, i);
    write_length(house, stretch->to - stretch->from, length);
    if (form->record->beam_count == 0)
        snprintf(text, size, "%s", "");
    else if (!stretch->held)
        snprintf(text, size, ": nothing bears both ends of a beam there, %s apart", length);
    else if (!spans)
        snprintf(text, size, ": no beam spans the %s from what bears it to what bears it", length);
    else
        snprintf(text, size, ": below beam `%.60s` there is no room for what stands there",
                 tn_text(form->module, spans->name));
}

void tn_hanging_text(const tn_house *house, const tn_bearing *bearing, uint32_t face, char *text, size_t size)
{
    int64_t from = 0, to = 0;
    char at[256], length[64], why[200] = "";
    const tn_unborne *stretch = NULL;
    tn_face_text(house, face, at, sizeof at);
    if (tn_face_hangs(bearing, &house->faces[face], &from, &to, &stretch) && stretch)
        write_why(house, stretch, why, sizeof why);
    write_length(house, to - from, length);
    snprintf(text, size, "%s, along %s%s", at, length, why);
}

static void name_tile(const tn_house *house, uint32_t cell, size_t variant, char text[TN_VARIANT_TEXT])
{
    tn_variants tiles;
    tn_error error;
    text[0] = '\0';
    if (tn_tile_variants(house, cell, &tiles, &error) == TN_OK && variant < tiles.count)
        tn_variant_text(house->form, &tiles.variants[variant], text);
    tn_variants_clear(&tiles);
}

void tn_change_text(const tn_house *house, const tn_house_change *c, tn_change_words *w)
{
    const tn_house_form *form = house->form;
    const tn_choice_record *choice;
    switch (c->kind) {
    case TN_CHANGE_SECTION:
        choice = tn_form_choice(form, c->of);
        snprintf(w->where, sizeof w->where, "option %s", text_of(house, choice->name));
        snprintf(w->from, sizeof w->from, "%s",
                 text_of(house, form->module->SHAPE_records[choice->shape_first + c->from].spelling));
        snprintf(w->to, sizeof w->to, "%s",
                 text_of(house, form->module->SHAPE_records[choice->shape_first + c->to].spelling));
        return;
    case TN_CHANGE_FUNCTION:
        tn_cell_text(house, c->of, w->where, sizeof w->where);
        snprintf(w->from, sizeof w->from, "%s", text_of(house, tn_form_rule(form, (uint32_t)c->from)->name));
        snprintf(w->to, sizeof w->to, "%s", text_of(house, tn_form_rule(form, (uint32_t)c->to)->name));
        return;
    case TN_CHANGE_FACE:
        tn_face_text(house, c->of, w->where, sizeof w->where);
        snprintf(w->from, sizeof w->from, "%s", tn_form_kind_text(form, (uint32_t)c->from));
        snprintf(w->to, sizeof w->to, "%s", tn_form_kind_text(form, (uint32_t)c->to));
        return;
    default:
        tn_cell_text(house, c->of, w->where, sizeof w->where);
        name_tile(house, c->of, c->from, w->from);
        name_tile(house, c->of, c->to, w->to);
    }
}

tn_int128 tn_house_floor_area(const tn_house *house)
{
    tn_int128 area = 0;
    for (size_t i = 0; i < house->cell_count; i++)
        area += house->cells[i].open ? 0 : tn_cell_area(&house->cells[i]);
    return area;
}

const char *tn_house_area_unit(const tn_house_form *form, double *nm2)
{
    static const double foot = 304800000.0, metre = 1e9;
    const tn_schema *schema = form->schema;
    const char *width = tn_text(schema->module, schema->values[schema->value_start[form->width]].name);
    bool feet = tn_length_style_of(width) == TN_STYLE_FEET;
    *nm2 = feet ? foot * foot : metre * metre;
    return feet ? "sf" : "m2";
}
