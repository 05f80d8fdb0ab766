/* Says why a plan has no house in a form: the cells that can be nothing, and what keeps each tile out of them. */
#include <stdlib.h>
#include <string.h>

#include "driver/house/change_text.h"
#include "cli/house/houses.h"
#include "cli/house/judged.h"
#include "runtime/base/utf8.h"
#include "runtime/house/bare.h"
#include "runtime/house/solids.h"

typedef struct tn_plan_explaining {
    tn_numbered n;
    tn_bare_cells bare;
    tn_buffer text;
    tn_json *json; /* into the text; NULL: as lines */
} tn_plan_explaining;

static const char *form_name(const tn_plan_explaining *e)
{
    return tn_text(e->n.form.module, e->n.form.record->name);
}

/* ---- tiles and functions of a cell */

static tn_status write_tile(tn_plan_explaining *e, uint32_t cell, uint32_t function, uint32_t tile, tn_error *error)
{
    const char *name = tn_text(e->n.form.module, e->n.form.module->TILE_records[tile].name);
    tn_tile_failure failure;
    char why[4 * TN_NAME_MAX];
    tn_status status = tn_bare_why(&e->bare, cell, function, tile, &failure, error);
    if (status != TN_OK)
        return status;
    tn_tile_failure_text(&e->n.form, tile, &failure, tn_house_length_style(&e->bare.house), why, sizeof why);
    if (!e->json) {
        tn_buffer_printf(&e->text, "    %s, as %s: %s\n", name,
                         tn_text(e->n.form.module, tn_form_rule(&e->n.form, function)->name), why);
        return TN_OK;
    }
    tn_json_object(e->json, NULL);
    tn_json_string(e->json, "tile", name);
    tn_json_string(e->json, "function", tn_text(e->n.form.module, tn_form_rule(&e->n.form, function)->name));
    tn_json_string(e->json, "why", why);
    tn_json_object_end(e->json);
    return TN_OK;
}

static tn_status write_tiles(tn_plan_explaining *e, uint32_t cell, uint32_t function, tn_error *error)
{
    const tn_form_record *form = e->n.form.record;
    tn_status status = TN_OK;
    for (uint32_t t = form->tile_first; status == TN_OK && t < form->tile_first + form->tile_count; t++) {
        e->bare.house.cells[cell].function = function;
        bool meant = tn_tile_is_for(&e->bare.house, cell, t);
        e->bare.house.cells[cell].function = TN_NO_FUNCTION;
        if (meant)
            status = write_tile(e, cell, function, t, error);
    }
    return status;
}

static tn_status write_cell(tn_plan_explaining *e, uint32_t cell, tn_error *error)
{
    const tn_house *house = &e->bare.house;
    bool may = false;
    char name[96];
    tn_status status = TN_OK;
    tn_cell_text(house, cell, name, sizeof name);
    for (uint32_t f = 0; f < tn_form_functions(&e->n.form); f++)
        may |= tn_cell_may(house, &house->cells[cell], f);
    if (e->json) {
        tn_json_object(e->json, NULL);
        tn_json_string(e->json, "cell", name);
        tn_json_list(e->json, "tiles");
    } else {
        tn_buffer_printf(&e->text, "- %s: %s\n", name,
                         may ? "no tile stands there, whatever is in its walls" : "no function may be there");
    }
    for (uint32_t f = 0; status == TN_OK && f < tn_form_functions(&e->n.form); f++)
        if (tn_cell_may(house, &house->cells[cell], f))
            status = write_tiles(e, cell, f, error);
    if (e->json) {
        tn_json_list_end(e->json);
        tn_json_object_end(e->json);
    }
    return status;
}

/* ---- the whole */

static void write_head(tn_plan_explaining *e)
{
    const char *library = tn_text(e->n.form.module, e->n.record->name);
    if (e->json) {
        tn_json_object(e->json, NULL);
        tn_json_string(e->json, "library", library);
        tn_json_string(e->json, "form", form_name(e));
        tn_json_list(e->json, "bare");
    } else if (!e->bare.house.form) {
        tn_buffer_printf(&e->text, "form `%s` has no house: its `forbid` lines forbid every section\n", form_name(e));
    } else if (e->bare.count > 0) {
        tn_buffer_printf(&e->text, "form `%s` has no house on this plan\n", form_name(e));
    } else {
        tn_buffer_printf(&e->text,
                         "each cell of this plan can have a function, and a tile where that wants one\n"
                         "`tartan count` with --library %s --plan PLAN --clauses says how many houses it has, and what "
                         "each clause keeps out\n",
                         library);
    }
}

static tn_status explain(tn_plan_explaining *e, const tn_plan *plan, tn_error *error)
{
    tn_status status = tn_bare_find(&e->n.form, plan->trays, plan->length, &e->bare, error);
    if (status == TN_OK)
        write_head(e);
    for (size_t i = 0; status == TN_OK && i < e->bare.count; i++)
        status = write_cell(e, e->bare.cells[i], error);
    if (e->json) {
        tn_json_list_end(e->json);
        tn_json_object_end(e->json);
        tn_json_end_line(e->json);
    }
    return status == TN_OK && e->text.failed ? tn_fail_memory(error) : status;
}

void tn_job_explain_plan(tn_job *job, const tn_house_settings *settings, const char *text, bool json)
{
    tn_plan_explaining e = {.n = {0}};
    tn_json writer = tn_json_text(&e.text, TN_JSON_TIGHT);
    e.json = json ? &writer : NULL;
    tn_error error = {0};
    tn_plan plan = {0};
    tn_output out;
    if (tn_job_numbered(job, &e.n, settings)) {
        tn_status status = tn_numbered_plan(&e.n, text, settings->max_length, &plan, &error);
        if (status != TN_OK)
            tn_job_bad_text(job, &error, "PLAN", text);
        else if (explain(&e, &plan, &error) != TN_OK)
            tn_job_fail(job, &error);
        else if (tn_job_output(job, NULL, &out)) {
            if (json)
                fwrite(e.text.data, 1, e.text.size, out.stream);
            else
                tn_write_shown(out.stream, e.text.data, e.text.size);
            tn_job_commit(job, &out);
        }
    }
    free(plan.trays);
    free(e.text.data);
    tn_bare_clear(&e.bare);
    tn_numbered_close(&e.n);
}

bool tn_job_house_line(tn_job *job, const tn_house_settings *settings, const char *number, tn_buffer *line)
{
    tn_numbered n;
    tn_house house = {0};
    tn_error error = {0};
    bool good = tn_job_numbered(job, &n, settings);
    if (good) {
        tn_status status = tn_numbered_house(&n, number, &house, &error);
        if (status == TN_OK)
            status = tn_house_write(&house, line, &error);
        good = status == TN_OK;
        if (!good)
            tn_job_fail(job, &error);
    }
    tn_house_clear(&house);
    tn_numbered_close(&n);
    return good;
}
