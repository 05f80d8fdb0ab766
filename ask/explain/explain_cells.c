/* Says why a plan has no house in a form: the cells that can be nothing, and what keeps each tile out of them. */
#include <stdlib.h>
#include <string.h>

#include "ask/explain/explain.h"
#include "ask/house/numbered.h"
#include "driver/house/change_text.h"
#include "runtime/house/bare.h"
#include "runtime/house/solids.h"

typedef struct cells_explaining {
    const tn_house_form *form;
    tn_bare_cells bare;
} cells_explaining;

static tn_status add_tile(cells_explaining *e, uint32_t cell, uint32_t function, uint32_t tile, tn_bare_cell *to,
                          tn_error *error)
{
    tn_tile_failure failure;
    char why[4 * TN_NAME_MAX];
    tn_status status = tn_bare_why(&e->bare, cell, function, tile, &failure, error);
    if (status != TN_OK)
        return status;
    tn_tile_failure_text(e->form, tile, &failure, tn_house_length_style(&e->bare.house), why, sizeof why);
    tn_failing_tile *failing = TN_ADD(failing_tile, to->tiles, error);
    if (!failing)
        return TN_MEMORY;
    failing->tile = tn_text(e->form->module, e->form->module->TILE_records[tile].name);
    failing->has_function = true;
    failing->function = tn_text(e->form->module, tn_form_rule(e->form, function)->name);
    failing->why = strdup(why);
    return failing->why ? TN_OK : tn_fail_memory(error);
}

static tn_status add_tiles(cells_explaining *e, uint32_t cell, uint32_t function, tn_bare_cell *to, tn_error *error)
{
    const tn_form_record *form = e->form->record;
    tn_status status = TN_OK;
    for (uint32_t t = form->tile_first; status == TN_OK && t < form->tile_first + form->tile_count; t++) {
        e->bare.house.cells[cell].function = function;
        bool meant = tn_tile_is_for(&e->bare.house, cell, t);
        e->bare.house.cells[cell].function = TN_NO_FUNCTION;
        if (meant)
            status = add_tile(e, cell, function, t, to, error);
    }
    return status;
}

static tn_status set_cell(cells_explaining *e, uint32_t cell, tn_bare_cell *to, tn_error *error)
{
    const tn_house *house = &e->bare.house;
    char name[96];
    tn_cell_text(house, cell, name, sizeof name);
    to->cell = strdup(name);
    tn_status status = to->cell ? TN_OK : tn_fail_memory(error);
    for (uint32_t f = 0; status == TN_OK && f < tn_form_functions(e->form); f++) {
        if (!tn_cell_may(house, &house->cells[cell], f))
            continue;
        to->usable = true;
        status = add_tiles(e, cell, f, to, error);
    }
    return status;
}

static tn_status explain(cells_explaining *e, const tn_numbered *n, const tn_plan *plan, tn_explained_cells *to,
                         tn_error *error)
{
    tn_status status = tn_bare_find(e->form, plan->trays, plan->length, &e->bare, error);
    to->library = tn_text(e->form->module, n->record->name);
    to->form = tn_text(e->form->module, e->form->record->name);
    to->sectionless = status == TN_OK && !e->bare.house.form;
    if (status == TN_OK)
        status = TN_NEW_LIST(bare_cell, to->bare, e->bare.count, error);
    for (size_t i = 0; status == TN_OK && i < e->bare.count; i++)
        status = set_cell(e, e->bare.cells[i], &to->bare.items[i], error);
    return status;
}

/* A plan, #P or #P: */
static tn_status read_plan(tn_numbered *n, const tn_explain_request *request, tn_plan *plan)
{
    size_t size = strlen(request->plan);
    bool colon = request->plan[0] == '#' && request->plan[size - 1] == ':';
    char *text = strndup(request->plan, size - colon);
    tn_error error;
    tn_status status = TN_OK;
    if (text) {
        status = tn_numbered_plan(n, text, tn_asked_length(&request->subject), plan);
    } else {
        tn_fail_memory(&error);
        status = tn_session_fail(n->session, &error);
    }
    free(text);
    return status;
}

static tn_status explain_on(tn_numbered *n, const tn_explain_request *request, tn_reply *answer)
{
    cells_explaining e = {.form = &n->form};
    tn_plan plan = {0};
    tn_error error = {0};
    tn_status status = read_plan(n, request, &plan);
    if (status == TN_OK) {
        status = tn_reply_new(&tn_message_explained_cells, answer, &error);
        if (status == TN_OK)
            status = explain(&e, n, &plan, answer->value, &error);
        if (status != TN_OK)
            tn_session_fail(n->session, &error);
    }
    free(plan.trays);
    tn_bare_clear(&e.bare);
    return status;
}

tn_status tn_explain_cells(tn_session *session, const tn_explain_request *request, tn_reply *answer)
{
    const tn_house_settings settings = tn_asked_houses(&request->subject);
    tn_numbered n;
    tn_status status = tn_numbered_open(&n, session, &settings);
    if (status == TN_OK)
        status = explain_on(&n, request, answer);
    tn_numbered_close(&n);
    return status;
}
