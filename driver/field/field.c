/* Opens a surface of a file, and warns of what its contour has. */
#include "driver/field/field.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/compile.h"

static tn_status no_surface(const tn_opened *opened, const char *name, tn_error *error)
{
    const tn_module *module = opened->module;
    if (module->SURFACE_count == 0) {
        tn_fail(error, TN_INVALID, E_NO_SURFACE, "%.200s has no surface and no design of boxes", opened->path);
        const tn_notation *notation = tn_notation_of_module(module);
        const char *help = "a .field file defines a surface: `surface ball = x*x + y*y + z*z - 1`";
        bool field = notation && strcmp(notation->name, "field") == 0;
        tn_error_help(error, "%s", field ? help : tn_opened_help(opened, help).text);
        return TN_INVALID;
    }
    const char **names = calloc(module->SURFACE_count, sizeof *names);
    if (!names)
        return tn_fail_memory(error);
    for (size_t i = 0; i < module->SURFACE_count; i++)
        names[i] = tn_text(module, module->SURFACE_records[i].name);
    const char *near = tn_nearest(name, names, module->SURFACE_count);
    tn_fail(error, TN_INVALID, E_NO_SURFACE, "%.200s has no surface `%.100s`", opened->path, name);
    if (near) {
        tn_error_help(error, "did you mean `%s`?", near);
    } else {
        char list[300];
        tn_word_list(names, module->SURFACE_count, list, sizeof list);
        tn_error_help(error, "it has %s", list);
    }
    free(names);
    return TN_INVALID;
}

tn_status tn_open_field_of(const tn_opened *opened, const char *name, tn_open_field *open, tn_error *error)
{
    const tn_module *module = opened->module;
    size_t surface = name ? 0 : module->SURFACE_count - 1;
    while (name && surface < module->SURFACE_count &&
           strcmp(tn_text(module, module->SURFACE_records[surface].name), name) != 0)
        surface++;
    if (surface >= module->SURFACE_count)
        return no_surface(opened, name, error);
    tn_status status = tn_field_meshes_read(module, tn_opened_meshes(opened), opened->path, &open->meshes, error);
    if (status == TN_OK)
        status = tn_field_read(module, (uint32_t)surface, open->meshes.items, &open->field, error);
    return status;
}

void tn_open_field_close(tn_open_field *open)
{
    tn_field_clear(&open->field);
    tn_field_meshes_clear(&open->meshes);
}

/* ---- what there is to say */

void tn_field_warn(tn_opened *opened, tn_code code, const char *help, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    tn_diagnostic *d = tn_report_bare_list(&opened->compilation.diagnostics, TN_WARNING, code, format, arguments);
    va_end(arguments);
    tn_help(&opened->compilation.diagnostics, d, "%s", help);
}

static void warn_of_cut(tn_opened *opened, const tn_contour *contour)
{
    static const char *const sides[] = {"low x", "high x", "low y", "high y", "low z", "high z"};
    const char *cut[6];
    char list[100];
    size_t count = 0;
    for (unsigned side = 0; side < 6; side++)
        if (contour->cut >> side & 1)
            cut[count++] = sides[side];
    if (count == 0)
        return;
    tn_word_list(cut, count, list, sizeof list);
    tn_field_warn(opened, W_FIELD_CUT, "take a larger box, if that is not meant", "the box cuts the form at %s", list);
}

void tn_field_warn_of_contour(tn_opened *opened, const tn_contour *c, const char *jumps)
{
    if (!c->inside)
        tn_field_warn(opened, W_FIELD_EMPTY, "inside is where the field is below 0", "nothing of the box is inside%s",
                      c->empty ? "" : ", at this grid");
    if (c->missed)
        tn_field_warn(opened, W_FIELD_COARSE, "take a finer --grid to have them whole",
                      "parts of the form lie between the samples, in %" PRIu64 " cells; (%.6g, %.6g, %.6g) is inside",
                      c->missed, c->missed_at[0], c->missed_at[1], c->missed_at[2]);
    if (!c->outside)
        tn_field_warn(opened, W_FIELD_FULL, "inside is where the field is below 0; turn its sign round for the rest",
                      "all of the box is inside");
    else
        warn_of_cut(opened, c);
    if (c->no_values)
        tn_field_warn(opened, W_FIELD_NO_VALUE, "what has no value is outside",
                      "%" PRIu64 " samples have no value; the first is (%.6g, %.6g, %.6g)", c->no_values,
                      c->no_value[0], c->no_value[1], c->no_value[2]);
    if (c->jumps)
        tn_field_warn(opened, W_FIELD_JUMPS, jumps,
                      "at %" PRIu64 " vertices the field jumps; the first is (%.6g, %.6g, %.6g)", c->jumps, c->jump[0],
                      c->jump[1], c->jump[2]);
}
