/* vary: what else a house could be: each other value of one choice with which it stays in its library. */
#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered.h"
#include "ask/session/questions.h"
#include "driver/house/change_text.h"
#include "runtime/base/integers.h"
#include "runtime/base/nearest.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/schedule/describe.h"

/* The house at hand, and where its changes go. */
typedef struct varying {
    tn_numbered *n;
    const tn_house *house;
    tn_varied *varied;
    mpz_t plan, variant, cost, more; /* of the house, and what a change adds to it, in hundredths */
    const char *unit;                /* of areas */
    double unit_nm2;
} varying;

/* ---- changes */

/* What the house costs, in hundredths; 0 where its form has no materials. */
static tn_status cost_of(const tn_house *house, mpz_t hundredths, tn_error *error)
{
    tn_costs costs;
    mpz_set_ui(hundredths, 0);
    if (!tn_form_has_costs(house->form))
        return TN_OK;
    tn_status status = tn_house_bill(house, tn_house_solids, &costs, error);
    if (status == TN_OK)
        mpz_set(hundredths, costs.hundredths);
    tn_costs_clear(&costs);
    return status;
}

/* What is written, or NULL where out of memory; the caller frees it. */
static char *take_text(tn_buffer *text)
{
    if (!text->failed)
        return text->data;
    free(text->data);
    return NULL;
}

/* "+12.50" */
static char *money(const varying *v)
{
    tn_buffer text = {0};
    mpz_t more;
    mpz_init(more);
    mpz_abs(more, v->more);
    tn_buffer_append(&text, mpz_sgn(v->more) < 0 ? "-" : "+", 1);
    tn_cost_write(&text, more);
    mpz_clear(more);
    return take_text(&text);
}

/* The house by the rank of its plan and its variant on that. */
static char *name_house(const varying *v)
{
    tn_buffer text = {0};
    tn_buffer_append(&text, "#", 1);
    tn_buffer_integer(&text, v->plan);
    tn_buffer_append(&text, ":", 1);
    tn_buffer_integer(&text, v->variant);
    return take_text(&text);
}

static tn_status set_words(const varying *v, const tn_house_change *change, tn_varied_house *to, tn_error *error)
{
    static const char *const kinds[] = {"section", "function", "face", "tile"};
    tn_change_words words;
    tn_change_text(v->house, change, &words);
    to->kind = kinds[change->kind];
    to->where = strdup(words.where);
    to->from = strdup(words.from);
    to->to = strdup(words.to);
    return to->where && to->from && to->to ? TN_OK : tn_fail_memory(error);
}

static tn_status add_change(void *context, const tn_house_change *change, const tn_house *changed, tn_error *error)
{
    varying *v = context;
    tn_varied_house *to = TN_ADD(varied_house, v->varied->houses, error);
    if (!to)
        return TN_MEMORY;
    mpz_set_ui(v->variant, 0);
    tn_status status = tn_numbered_number(v->n, changed, v->variant, error);
    if (status == TN_OK)
        status = cost_of(changed, v->more, error);
    if (status == TN_OK)
        status = set_words(v, change, to, error);
    if (status != TN_OK)
        return status;
    double more = (double)(tn_house_floor_area(changed) - tn_house_floor_area(v->house)) / v->unit_nm2;
    to->has_area_sf = strcmp(v->unit, "sf") == 0;
    to->has_area_m2 = !to->has_area_sf;
    to->area_sf = to->area_m2 = more;
    mpz_sub(v->more, v->more, v->cost);
    to->has_cost = tn_form_has_costs(v->house->form);
    to->cost = to->has_cost ? money(v) : NULL;
    to->house = name_house(v);
    return to->house && (to->cost || !to->has_cost) ? TN_OK : tn_fail_memory(error);
}

/* ---- the cell that is asked about */

enum { CELL_TEXT = 96 };

static void help_cell(const tn_house *house, const char *at, tn_error *error)
{
    char(*texts)[CELL_TEXT] = calloc(house->cell_count + 1, sizeof *texts);
    const char **names = calloc(house->cell_count + 1, sizeof *names);
    for (uint32_t i = 0; texts && names && i < house->cell_count; i++) {
        tn_cell_text(house, i, texts[i], sizeof texts[i]);
        names[i] = texts[i];
    }
    const char *near = texts && names ? tn_nearest(at, names, house->cell_count) : NULL;
    if (near)
        tn_error_help(error, "did you mean `%s`?", near);
    else
        tn_error_help(error, "a cell is TRAY.ZONE.STOREY, such as %s; trays count from 1",
                      texts && house->cell_count ? texts[0] : "1.body.ground");
    free(names);
    free(texts);
}

/* TRAY.ZONE.STOREY, trays from 1. TN_INVALID where the house has no such cell. */
static tn_status find_cell(const varying *v, const char *at, uint32_t *cell, tn_error *error)
{
    char text[CELL_TEXT];
    *cell = TN_NO_CELL;
    for (uint32_t i = 0; at && i < v->house->cell_count; i++) {
        tn_cell_text(v->house, i, text, sizeof text);
        if (strcmp(text, at) == 0)
            *cell = i;
    }
    if (!at || *cell != TN_NO_CELL)
        return TN_OK;
    tn_status status = tn_fail(error, TN_INVALID, E_USAGE, "--at: the house has no cell `%.60s`", at);
    help_cell(v->house, at, error);
    return status;
}

/* ---- asked */

static tn_status vary(varying *v, const char *at, tn_error *error)
{
    tn_house_rules *rules = NULL;
    uint32_t cell;
    tn_status status = find_cell(v, at, &cell, error);
    if (status == TN_OK && !tn_library_rank(v->n->plans, v->house->trays, (uint32_t)v->house->length, v->plan)) {
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "the library does not hold the plan of this house");
        tn_error_help(error, "`tartan explain` says which clauses drop it");
    }
    if (status == TN_OK) /* is it a house of the library? */
        status = tn_numbered_number(v->n, v->house, v->variant, error);
    if (status == TN_OK)
        status = cost_of(v->house, v->cost, error);
    if (status == TN_OK)
        status = tn_house_rules_new(&v->n->form, 0, &rules, error);
    if (status == TN_OK)
        status = tn_house_changes(v->house, rules, v->n->record, cell, add_change, v, error);
    tn_house_rules_free(rules);
    return status;
}

static tn_status read_house(tn_numbered *n, const tn_vary_request *request, tn_house *house)
{
    const char *text = request->house;
    tn_error error = {0};
    tn_status status = tn_is_house_number(text) ? tn_numbered_house(n, text, house, &error)
                                                : tn_house_read(&n->form, text, strlen(text),
                                                                tn_asked_length(&request->subject), house, &error);
    return status == TN_OK ? TN_OK : tn_session_bad_text(n->session, &error, "HOUSE", text);
}

static tn_status vary_house(tn_numbered *n, const tn_house *house, const char *at, tn_reply *answer)
{
    tn_error error;
    tn_status status = tn_reply_new(&tn_message_varied, answer, &error);
    if (status != TN_OK)
        return tn_session_fail(n->session, &error);
    varying v = {.n = n, .house = house, .varied = answer->value};
    v.varied->library = tn_text(n->form.module, n->record->name);
    v.unit = tn_house_area_unit(&n->form, &v.unit_nm2);
    mpz_inits(v.plan, v.variant, v.cost, v.more, NULL);
    status = vary(&v, at, &error);
    mpz_clears(v.plan, v.variant, v.cost, v.more, NULL);
    if (status != TN_OK)
        return tn_session_fail(n->session, &error);
    if (v.varied->houses.count == 0)
        tn_session_note(n->session,
                        "nothing can be changed by itself: each other value takes the house out of the library");
    return TN_OK;
}

tn_status tn_ask_vary(tn_session *session, const tn_vary_request *request, tn_reply *answer)
{
    tn_numbered n;
    tn_plan none;
    tn_house house = {0};
    *answer = (tn_reply){0};
    tn_status status = tn_numbered_open_on(&n, session, &request->subject, NULL, &none);
    if (status == TN_OK)
        status = read_house(&n, request, &house);
    if (status == TN_OK)
        status = vary_house(&n, &house, request->at, answer);
    tn_house_clear(&house);
    tn_numbered_close(&n);
    return status;
}
