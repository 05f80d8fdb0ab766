/* Lists and draws the parts of a model. */
#include "ask/place/parts.h"

#include <stdlib.h>
#include <string.h>

#include "driver/mesh/mesh_file.h"
#include "runtime/place/write.h"

/* ---- by kind */

static tn_status set_kind(const tn_module *module, const tn_part_count *count, tn_placed_kind *kind, tn_error *error)
{
    bool of_kit = module->KIT_count > 0;
    const tn_kit_part_record *part = of_kit ? tn_kit_part_named(module, count->name) : NULL;
    kind->part = strdup(count->name);
    kind->colour = count->colour;
    kind->number = count->count;
    kind->has_name = kind->has_mass = kind->has_price = of_kit;
    kind->name = part ? tn_text(module, part->title) : "";
    kind->mass = part ? part->mass * (double)count->count : 0;
    kind->price = part ? part->price * (double)count->count : 0;
    return kind->part ? TN_OK : tn_fail_memory(error);
}

tn_status tn_parts_by_kind(const tn_module *module, const tn_placed_model *model, tn_list *kinds, tn_error *error)
{
    tn_part_count *counts;
    size_t count;
    tn_status status = tn_place_count_parts(model, &counts, &count, error);
    if (status != TN_OK)
        return status;
    status = tn_message_list(&tn_message_placed_kind, count, kinds, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = set_kind(module, &counts[i], (tn_placed_kind *)kinds->items + i, error);
    free(counts);
    return status;
}

/* ---- pictures */

tn_status tn_parts_draw(const tn_parts_picture *p, tn_file_format format, FILE *out, tn_error *error)
{
    tn_picture picture = tn_picture_asked(format);
    tn_status status = p->steps ? tn_placed_draw_steps(p->module, p->model, p->measures, p->steps, &picture, error)
                                : tn_placed_draw(p->module, p->model, p->measures, p->marked, NULL, &picture, error);
    if (status == TN_OK)
        fwrite(picture.element, 1, picture.size, out); /* failing shows when the file is closed */
    free(picture.element);
    return status;
}

/* ---- meshes */

tn_status tn_parts_write_mesh(tn_opened *opened, const tn_placed_model *model, tn_file_format format, FILE *out,
                              tn_error *error)
{
    unsigned char(*palette)[3] = NULL;
    tn_mesh mesh = {0};
    tn_status status = tn_placed_mesh(opened->module, model, &mesh, &palette, error);
    const tn_mesh_style style = {.unit = TN_MESH_UNIT_MM, .colours = (const unsigned char(*)[3])palette};
    if (status == TN_OK)
        status = tn_mesh_change(opened, &(tn_mesh_changes){0}, format, &mesh, error);
    if (status == TN_OK)
        status = tn_mesh_file_write(&mesh, format, &style, out, error);
    tn_mesh_clear(&mesh);
    free(palette);
    return status;
}
