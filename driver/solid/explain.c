/* How the boxes of a design were squashed: pair by pair, in order, before and after. */
#include "driver/solid/solid.h"
#include "runtime/base/json.h"

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

static void write_object(const tn_module *module, uint32_t solid, const tn_squash *s, tn_json *json)
{
    tn_box_words box = tn_box_named(module, solid, s->box, 0), by = tn_box_named(module, solid, s->by, s->image);
    tn_json_object(json, NULL);
    tn_json_string(json, "box", box.text);
    tn_json_string(json, "by", by.text);
    tn_json_bytes(json, "axis", &"xyz"[s->axis], 1);
    tn_json_string(json, "side", s->high ? "high" : "low");
    tn_json_number(json, "before", s->before);
    tn_json_number(json, "after", s->after);
    tn_json_bool(json, "left", !s->whole);
    tn_json_object_end(json);
}

static void write_json(const tn_module *module, uint32_t solid, const tn_history *history, FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_TIGHT);
    tn_json_list(&json, NULL);
    for (size_t i = 0; i < history->count; i++)
        write_object(module, solid, &history->items[i], &json);
    tn_json_list_end(&json);
    tn_json_end_line(&json);
}

static void write_lines(const tn_module *module, uint32_t solid, const tn_history *history, FILE *out)
{
    if (history->count == 0)
        fputs("no two boxes overlap: nothing was squashed\n", out);
    for (size_t i = 0; i < history->count; i++)
        fprintf(out, "%s\n", tn_squash_told(module, solid, &history->items[i]).text);
}

tn_status tn_solid_explain(tn_opened *opened, uint32_t solid, uint32_t most, bool json, FILE *out)
{
    tn_built built;
    tn_error error;
    tn_status status = tn_built_make(opened->module, solid, most, &built, &error);
    if (status == TN_OK || status == TN_INVALID)
        (json ? write_json : write_lines)(opened->module, solid, &built.history, out);
    tn_built_clear(&built);
    return status == TN_OK ? TN_OK : tn_solid_fail(opened, solid, &error);
}
