/* Finds the design that is asked for, and names boxes. */
#include <string.h>

#include "driver/solid/solid.h"

tn_box_words tn_box_named(const tn_module *module, uint32_t solid, uint32_t box, uint32_t image)
{
    const tn_solid_record *record = &module->SOLID_records[solid];
    const char *name = tn_text(module, module->BOX_records[record->box_first + box].name);
    tn_box_words words;
    size_t used = name[0] ? (size_t)snprintf(words.text, sizeof words.text, "%.*s", (int)TN_NAME_MAX, name)
                          : (size_t)snprintf(words.text, sizeof words.text, "box %u", box + 1);
    if (image)
        words.text[used++] = '\'';
    for (unsigned axis = 0; axis < 3; axis++)
        if (image >> axis & 1)
            words.text[used++] = "xyz"[axis];
    words.text[used] = '\0';
    return words;
}

static tn_span place_of(const tn_solid_record *record)
{
    return (tn_span){record->file, record->begin, record->begin + (uint32_t)strlen("solid")};
}

tn_status tn_solid_fail(tn_opened *opened, uint32_t solid, const tn_error *error)
{
    tn_diagnostic *diagnostic = tn_report_error(&opened->compilation.diagnostics, error, NULL, NULL, 0);
    diagnostic->has_span = error->status != TN_IO; /* of a file that cannot be written the design is not to blame */
    diagnostic->span = place_of(&opened->module->SOLID_records[solid]);
    return error->status;
}

static void list_names(const tn_module *module, char *text, size_t size)
{
    size_t used = 0;
    for (size_t i = 0; i < module->SOLID_count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s`%.60s`", i ? ", " : "",
                                 tn_text(module, module->SOLID_records[i].name));
}

static tn_status unknown(tn_opened *opened, const char *what, const char *name)
{
    char names[300] = "";
    tn_diagnostics *list = &opened->compilation.diagnostics;
    list_names(opened->module, names, sizeof names);
    tn_diagnostic *d =
        name ? tn_report_bare(list, TN_ERROR, E_UNKNOWN_SOLID, "%s has no design `%.100s`", opened->path, name)
             : tn_report_bare(list, TN_ERROR, E_UNKNOWN_SOLID, "%s %s", opened->path, what);
    tn_help(list, d, "name one with --solid: %s", names);
    return TN_INVALID;
}

tn_status tn_solid_choose(tn_opened *opened, const char *name, uint32_t *solid)
{
    const tn_module *module = opened->module;
    uint32_t own = 0;
    for (uint32_t i = 0; i < module->SOLID_count; i++) {
        const tn_solid_record *record = &module->SOLID_records[i];
        bool imported = record->flags & TN_SOLID_IMPORTED;
        if (name ? strcmp(tn_text(module, record->name), name) != 0 : imported)
            continue;
        own++;
        *solid = i;
    }
    if (own == 1)
        return TN_OK;
    return unknown(opened, own ? "has several designs" : "has no design of its own", name);
}

tn_squash_words tn_squash_told(const tn_module *module, uint32_t solid, const tn_squash *s)
{
    tn_box_words box = tn_box_named(module, solid, s->box, 0), by = tn_box_named(module, solid, s->by, s->image);
    tn_squash_words told;
    if (s->whole)
        snprintf(told.text, sizeof told.text, "%s  by %s  nothing is left", box.text, by.text);
    else
        snprintf(told.text, sizeof told.text, "%s  by %s  %s %c  %.10g -> %.10g", box.text, by.text,
                 s->high ? "high" : "low", "xyz"[s->axis], s -> before, s -> after);
    return told;
}
