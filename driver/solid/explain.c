/* How the boxes of a design were squashed: pair by pair, in order, before and after. */
#include "driver/solid/solid.h"

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

static void write_object(const tn_module *module, uint32_t solid, const tn_squash *s, FILE *out)
{
    tn_box_words box = tn_box_named(module, solid, s->box, 0), by = tn_box_named(module, solid, s->by, s->image);
    fprintf(
        out,
        "{\"box\":\"%s\",\"by\":\"%s\",\"axis\":\"%c\",\"side\":\"%s\",\"before\":%.17g,\"after\":%.17g,\"left\":%s}",
        box.text, by.text, "xyz"[s->axis], s -> high ? "high" : "low", s->before, s->after,
        s->whole ? "false" : "true");
}

static void write_history(const tn_module *module, uint32_t solid, const tn_built *built, bool json, FILE *out)
{
    const tn_history *history = &built->history;
    if (json)
        fputc('[', out);
    else if (history->count == 0)
        fputs("no two boxes overlap: nothing was squashed\n", out);
    for (size_t i = 0; i < history->count; i++) {
        if (json && i)
            fputc(',', out);
        if (json)
            write_object(module, solid, &history->items[i], out);
        else
            fprintf(out, "%s\n", tn_squash_told(module, solid, &history->items[i]).text);
    }
    if (json)
        fputs("]\n", out);
}

tn_status tn_solid_explain(tn_opened *opened, uint32_t solid, uint32_t most, bool json, FILE *out)
{
    tn_built built;
    tn_error error;
    tn_status status = tn_built_make(opened->module, solid, most, &built, &error);
    if (status == TN_OK || status == TN_INVALID)
        write_history(opened->module, solid, &built, json, out);
    tn_built_clear(&built);
    return status == TN_OK ? TN_OK : tn_solid_fail(opened, solid, &error);
}
