/* tartan vary: what else a house could be: each other value of one choice with which it stays in its library. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/option_rows.h"
#include "cli/house/houses.h"
#include "driver/house/change_text.h"
#include "runtime/base/nearest.h"
#include "runtime/house/schedule/cost.h"

typedef struct vary_settings {
    tn_settings common;
    const char *library, *at, *output;
    tn_option_number max_length, max_states;
    bool json;
} vary_settings;

/* The house at hand, and where its changes go. */
typedef struct varying {
    tn_numbered *n;
    const tn_house *house;
    FILE *out;
    bool json;
    mpz_t plan, variant, cost, more; /* of the house, and what a change adds to it, in hundredths */
    size_t count;
    const char *unit; /* of areas */
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

/* "+12.50"; the caller frees it. */
static char *money(const varying *v)
{
    char *text = NULL;
    mpz_t whole;
    mpz_init(whole);
    unsigned long rest = mpz_tdiv_q_ui(whole, v->more, 100);
    mpz_abs(whole, whole);
    gmp_asprintf(&text, "%c%Zd.%02lu", mpz_sgn(v->more) < 0 ? '-' : '+', whole, rest);
    mpz_clear(whole);
    return text;
}

static void write_json(const varying *v, const tn_house_change *change, const tn_change_words *w, double more,
                       const char *number, const char *cost)
{
    static const char *const kinds[] = {"section", "function", "face", "tile"};
    char area[32];
    tn_json json = tn_json_file(v->out, TN_JSON_TIGHT);
    snprintf(area, sizeof area, "area_%s", v->unit);
    tn_json_object(&json, NULL);
    tn_json_string(&json, "house", number);
    tn_json_string(&json, "kind", kinds[change->kind]);
    tn_json_string(&json, "where", w->where);
    tn_json_string(&json, "from", w->from);
    tn_json_string(&json, "to", w->to);
    tn_json_number(&json, area, more);
    if (tn_form_has_costs(v->house->form))
        tn_json_string(&json, "cost", cost);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

static void write_line(const varying *v, const tn_change_words *w, double more, const char *number, const char *cost)
{
    fprintf(v->out, "%s  %s: %s for %s", number, w->where, w->to, w->from);
    if (more != 0)
        fprintf(v->out, ", %+.2f %s", more, v->unit);
    if (mpz_sgn(v->more) != 0)
        fprintf(v->out, ", cost %s", cost);
    fputc('\n', v->out);
}

static tn_status write_change(void *context, const tn_house_change *change, const tn_house *changed, tn_error *error)
{
    varying *v = context;
    tn_change_words w;
    mpz_set_ui(v->variant, 0);
    tn_status status = tn_numbered_number(v->n, changed, v->variant, error);
    if (status == TN_OK)
        status = cost_of(changed, v->more, error);
    if (status != TN_OK)
        return status;
    mpz_sub(v->more, v->more, v->cost);
    tn_change_text(v->house, change, &w);
    double more = (double)(tn_house_floor_area(changed) - tn_house_floor_area(v->house)) / v->unit_nm2;
    v->count++;
    char *number = NULL, *cost = money(v);
    if (gmp_asprintf(&number, "#%Zd:%Zd", v->plan, v->variant) < 0 || !cost)
        status = tn_fail_memory(error);
    else if (v->json)
        write_json(v, change, &w, more, number, cost);
    else
        write_line(v, &w, more, number, cost);
    free(number);
    free(cost);
    return status;
}

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

static tn_status vary(varying *v, const char *at, tn_error *error)
{
    tn_house_rules *rules = NULL;
    uint32_t cell;
    tn_status status = find_cell(v, at, &cell, error);
    if (status == TN_OK && !tn_library_rank(v->n->plans, v->house->trays, v->house->length, v->plan)) {
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
        status = tn_house_changes(v->house, rules, v->n->record, cell, write_change, v, error);
    tn_house_rules_free(rules);
    return status;
}

static tn_status read_house(tn_numbered *n, const char *text, size_t max_trays, tn_house *house, tn_error *error)
{
    return tn_is_house_number(text) ? tn_numbered_house(n, text, house, error)
                                    : tn_house_read(&n->form, text, strlen(text), max_trays, house, error);
}

static void vary_house(tn_job *job, tn_numbered *n, const vary_settings *settings, size_t max_trays)
{
    const char *text = job->settings->operands.items[1];
    tn_house house = {0};
    tn_error error = {0};
    tn_output out;
    tn_status status = read_house(n, text, max_trays, &house, &error);
    if (status != TN_OK) {
        tn_job_bad_text(job, &error, "HOUSE", text);
    } else if (tn_job_output(job, settings->output, &out)) {
        varying v = {.n = n, .house = &house, .out = out.stream, .json = settings->json};
        v.unit = tn_house_area_unit(&n->form, &v.unit_nm2);
        mpz_inits(v.plan, v.variant, v.cost, v.more, NULL);
        status = vary(&v, settings->at, &error);
        if (status != TN_OK)
            tn_job_fail(job, &error);
        else if (v.count == 0)
            tn_job_note(job, "nothing can be changed by itself: each other value takes the house out of the library");
        tn_job_close(job, &out, status == TN_OK);
        mpz_clears(v.plan, v.variant, v.cost, v.more, NULL);
    }
    tn_house_clear(&house);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const vary_settings *settings = (const vary_settings *)common;
    size_t max_trays = settings->max_length.given ? (size_t)settings->max_length.value : TN_HOUSE_TRAYS_DEFAULT;
    const tn_house_settings houses = {
        .library = settings->library,
        .max_length = max_trays,
        .plans = {.max_states = (uint32_t)settings->max_states.value, .max_length = (uint32_t)max_trays}};
    tn_job job;
    tn_numbered n;
    tn_job_begin(&job, common);
    if (tn_job_open(&job, common->operands.items[0])) {
        if (tn_job_numbered(&job, &n, &houses))
            vary_house(&job, &n, settings, max_trays);
        tn_numbered_close(&n);
    }
    return tn_job_end(&job);
}

#define SETTINGS vary_settings
static const tn_option options[] = {
    TEXT("at", 0, "CELL", at, "only what is about one cell: TRAY.ZONE.STOREY, trays from 1, such as 2.body.ground"),
    TEXT("library", 0, "NAME", library, "the library of houses; may be left out where the file has only one"),
    FLAG("json", 0, json, "write each change as a JSON object"),
    OUTPUT(output, TN_WRITES_TEXT | TN_WRITES(JSON), "write to FILE"),
    NUMBER("max-length", 0, "N", max_length, 1, 1u << 24, "the longest plan that is accepted, in trays (default 4096)"),
    NUMBER("max-states", 0, "N", max_states, 1, UINT32_MAX, "the most states of an automaton of the library of plans"),
};

const tn_command tn_command_vary = {
    .name = "vary",
    .summary = "list what else a house could be",
    .usage = "FILE HOUSE [--at TRAY.ZONE.STOREY] [--library NAME] [--json]\nFILE '#P:V' [--at TRAY.ZONE.STOREY]",
    .description =
        "Lists each other value of one choice with which the house stays in its library: of the section, of the "
        "function of a cell, of what is in a face, of a tile. Each line has the number of the house that this makes, "
        "what changes, "
        "and the differences in floor area and cost, if there are any. All other choices stay as they are where they "
        "can; where a "
        "change takes away a "
        "tile or what is in a face, the first that fits takes its place.",
    .example = "$ tartan vary cottage '#10:77' --at 1.body.ground",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE and a HOUSE",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
