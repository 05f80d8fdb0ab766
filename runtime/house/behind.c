/* Says which openings a lower roof keeps out of a face, and by how much. */
#include <stdio.h>

#include "runtime/house/decide_parts.h"
#include "runtime/house/solids.h"

static bool is_behind(const tn_house *house, const tn_face *face, uint32_t kind, tn_behind_roof *behind)
{
    const tn_opening_record *opening = tn_form_opening(house->form, kind);
    if (opening ? !tn_opening_has_room(house, face, opening) : kind != TN_FACE_OPEN)
        return false;
    behind->kind = kind;
    return tn_face_behind(house, face, opening, &behind->sill, &behind->top);
}

bool tn_face_behind_roof(const tn_house *house, const tn_face *face, uint32_t kind, tn_behind_roof *behind)
{
    const tn_house_form *form = house->form;
    uint32_t kinds[TN_FACE_KINDS_MAX], last;
    tn_face_decided(house, face, kinds, &last);
    if (face->relation != TN_FACE_OUTSIDE)
        return false;
    for (uint32_t i = 0; i < form->record->face_count && (last == TN_NO_RECORD || i <= last); i++) {
        const tn_face_line_record *line = &form->module->FACE_LINE_records[form->record->face_first + i];
        for (uint32_t k = 0; tn_face_line_is_about(house, line, face) && k < line->kind_count; k++) {
            uint32_t other = form->module->HOUSE_ITEM_records[line->kind_first + k].number;
            if ((kind == TN_NO_RECORD || kind == other) && is_behind(house, face, other, behind))
                return true;
        }
    }
    return false;
}

tn_length_style tn_house_length_style(const tn_house *house)
{
    const tn_schema *schema = house->form->schema;
    return tn_length_style_of(tn_text(schema->module, schema->values[schema->value_start[house->form->width]].name));
}

void tn_behind_roof_text(const tn_house *house, const tn_behind_roof *behind, char *text, size_t size)
{
    tn_length_style style = tn_house_length_style(house);
    tn_int128 step = style == TN_STYLE_FEET ? TN_INCH_NM / 64 : 1000000, part = step * behind->top.bottom;
    char sill[64], top[64];
    tn_length_write_style(behind->sill, style, sill, sizeof sill);
    tn_length_write_style((int64_t)((behind->top.top + part - 1) / part * step), style, top, sizeof top);
    snprintf(text, size, "its %s is %s above the lowest floor, and the roof there reaches %s",
             behind->kind == TN_FACE_OPEN ? "floor" : "sill", sill, top);
}
