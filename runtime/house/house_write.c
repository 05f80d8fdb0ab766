/* Writes the choices of a house: as a house line, and as members of a JSON object. */
#include <string.h>

#include "runtime/house/house.h"

/* Where words go: one of the two. */
typedef struct words {
    tn_buffer *line;
    tn_json *json;
} words;

/* A word of a part: after a blank, where it is not the first, or an item of the list that is open. */
static void put(const words *to, bool *any, const char *text)
{
    if (to->json) {
        tn_json_string(to->json, NULL, text);
    } else {
        tn_buffer_append(to->line, " ", *any);
        tn_buffer_append(to->line, text, strlen(text));
    }
    *any = true;
}

const char *tn_house_option(const tn_house *house, uint32_t choice)
{
    const tn_module *module = house->form->module;
    return tn_text(
        module,
        module->SHAPE_records[tn_form_choice(house->form, choice)->shape_first + house->shapes[choice]].spelling);
}

/* The functions of a tray's cells; are there any? */
static bool put_tray(const tn_house *house, size_t tray, const words *to)
{
    bool any = false;
    for (uint32_t i = house->tray_first[tray]; i < house->tray_first[tray + 1]; i++) {
        const tn_cell *cell = &house->cells[i];
        put(to, &any,
            cell->open ? "void" : tn_text(house->form->module, tn_form_rule(house->form, cell->function)->name));
    }
    return any;
}

/* What is in the faces that leave a choice; are there any? */
static bool put_faces(const tn_house *house, const words *to)
{
    uint32_t kinds[TN_FACE_KINDS_MAX];
    bool any = false;
    for (size_t i = 0; i < house->face_count; i++)
        if (tn_face_options(house, &house->faces[i], kinds) > 1)
            put(to, &any, tn_form_kind_text(house->form, house->faces[i].kind));
    return any;
}

static tn_status put_tiles(const tn_house *house, const words *to, bool *any, tn_error *error)
{
    tn_status status = TN_OK;
    *any = false;
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++) {
        tn_variants v;
        char text[TN_VARIANT_TEXT];
        status = tn_tile_variants(house, i, &v, error);
        if (status == TN_OK && v.count > 0) {
            tn_variant_text(house->form, &v.variants[house->cells[i].variant], text);
            put(to, any, text);
        }
        tn_variants_clear(&v);
    }
    return status;
}

/* ---- the line */

static void end_part(tn_buffer *out, bool any)
{
    tn_buffer_printf(out, "%s ; ", any ? "" : "-");
}

tn_status tn_house_write(const tn_house *house, tn_buffer *out, tn_error *error)
{
    const tn_house_form *form = house->form;
    const words to = {.line = out};
    bool any = false;
    tn_plan_write_line(form->schema, house->trays, house->length, out);
    end_part(out, house->length > 0);
    for (uint32_t i = 0; i < form->record->choice_count; i++)
        put(&to, &any, tn_house_option(house, i));
    end_part(out, any);
    for (size_t t = 0; t < house->length; t++) {
        tn_buffer_printf(out, "%s", t ? " | " : "");
        if (!put_tray(house, t, &to))
            tn_buffer_append(out, "-", 1);
    }
    end_part(out, house->length > 0);
    end_part(out, put_faces(house, &to));
    tn_status status = put_tiles(house, &to, &any, error);
    if (!any)
        tn_buffer_append(out, "-", 1);
    return status == TN_OK && out->failed ? tn_fail_memory(error) : status;
}

/* ---- JSON */

tn_status tn_house_write_members(const tn_house *house, tn_json *json, tn_error *error)
{
    const tn_house_form *form = house->form;
    const words to = {.json = json};
    bool any = false;
    tn_json_object(json, "section");
    for (uint32_t i = 0; i < form->record->choice_count; i++)
        tn_json_string(json, tn_text(form->module, tn_form_choice(form, i)->name), tn_house_option(house, i));
    tn_json_object_end(json);
    tn_json_list(json, "functions");
    for (size_t t = 0; t < house->length; t++) {
        tn_json_list(json, NULL);
        put_tray(house, t, &to);
        tn_json_list_end(json);
    }
    tn_json_list_end(json);
    tn_json_list(json, "faces");
    put_faces(house, &to);
    tn_json_list_end(json);
    tn_json_list(json, "tiles");
    tn_status status = put_tiles(house, &to, &any, error);
    tn_json_list_end(json);
    return status;
}
