/* house, vary: a house of a form, checked and written as files; and what else it could be. */
#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered.h"
#include "ask/house/typed.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "compiler/plan/syntax/program.h"
#include "driver/house/change_text.h"
#include "driver/house/files.h"
#include "driver/house/values.h"
#include "runtime/base/integers.h"
#include "runtime/base/nearest.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/schedule/describe.h"

/* ---- vary: each other value of one choice with which it stays in its library */

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

static tn_status read_varied(tn_numbered *n, const tn_vary_request *request, tn_house *house)
{
    const char *text = request->house;
    tn_error error = {0};
    if (!tn_is_house_number(text))
        return tn_numbered_typed(n, text, tn_asked_length(&request->subject), house);
    tn_status status = tn_numbered_house(n, text, house, &error);
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
        status = read_varied(&n, request, &house);
    if (status == TN_OK)
        status = vary_house(&n, &house, request->at, answer);
    tn_house_clear(&house);
    tn_numbered_close(&n);
    return status;
}

/* ---- house */

typedef struct building {
    tn_session *session;
    const tn_house_request *request;
    tn_built_house *built;
    tn_house_filed filed;
    size_t objs; /* how many were begun */
} building;

/* ---- which files */

/* The kind that a word of the request means: json, parts.csv and so on. */
static tn_status kind_of(const char *word, tn_house_file *kind, tn_error *error)
{
    const char *words[TN_HOUSE_FILES];
    char list[200];
    size_t count = 0;
    for (int i = TN_HOUSE_AS_LINE + 1; i < TN_HOUSE_FILES; i++) {
        words[count] = tn_house_file_ending((tn_house_file)i) + 1;
        if (strcmp(words[count++], word) == 0) {
            *kind = (tn_house_file)i;
            return TN_OK;
        }
    }
    tn_fail(error, TN_INVALID, E_USAGE, "a house cannot be written as `%.60s`", word);
    tn_word_list(words, count, list, sizeof list);
    tn_error_help(error, "it is written as %s", list);
    return TN_INVALID;
}

/* Something that is asked for, and of which of the files it is. */
typedef struct asked_of {
    const char *name;
    bool given, drawings, models;
} asked_of;

/* What no file has and is asked for; false if there is none. */
static bool asked_in_vain(const tn_house_request *request, bool draws, bool models, asked_of *found)
{
    const asked_of all[] = {{"view", request->views.count > 0, true, false},
                            {"cut", request->cut != NULL, true, false},
                            {"furnish", request->bare, true, false},
                            {"scale", request->has_scale, true, false},
                            {"azimuth", request->has_azimuth, true, false},
                            {"elevation", request->has_elevation, true, false},
                            {"dpi", request->has_dpi, true, false},
                            {"profile", request->profile > 0, true, false},
                            {"revision", request->revision != NULL, true, false},
                            {"project", request->project != NULL, true, true},
                            {"date", request->date != NULL, true, true},
                            {"north", request->has_north, true, true},
                            {"author", request->author != NULL, false, true},
                            {"latitude", request->has_latitude, false, true},
                            {"longitude", request->has_longitude, false, true}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        *found = all[i];
        if (found->given && !(found->drawings && draws) && !(found->models && models))
            return true;
    }
    return false;
}

static tn_status refuse_in_vain(tn_session *session, const asked_of *asked)
{
    if (!asked->models)
        return tn_session_refuse(session, "add `-o NAME.svg`, or .pdf, .png or .dxf",
                                 "--%s is about drawings, and no file is one", asked->name);
    if (!asked->drawings)
        return tn_session_refuse(session, "add `-o NAME.ifc`", "--%s is about building models, and no file is one",
                                 asked->name);
    return tn_session_refuse(session, "add `-o NAME.svg`, or .pdf, .png, .dxf or .ifc",
                             "--%s is about drawings and building models, and no file is one", asked->name);
}

/* Dates and places that a building model can say. */
static tn_status check_model(tn_session *session, const tn_house_request *request)
{
    char stamp[TN_TIME_STAMP_TEXT];
    if (request->date && !tn_house_time_stamp(request->date, stamp))
        return tn_session_refuse(session, "write it as 2026-05-12 or 2026-05-12T14:30:00",
                                 "`%.60s` is no date as IFC files have them", request->date);
    if (request->has_latitude && !(request->latitude >= -90 && request->latitude <= 90))
        return tn_session_refuse(session, NULL, "a latitude is from -90 to 90 degrees, not %g", request->latitude);
    if (request->has_longitude && !(request->longitude >= -180 && request->longitude <= 180))
        return tn_session_refuse(session, NULL, "a longitude is from -180 to 180 degrees, not %g", request->longitude);
    return TN_OK;
}

static tn_status check_files(tn_session *session, const tn_house_request *request)
{
    bool draws = false, models = false;
    tn_house_file kind;
    tn_error error;
    asked_of found;
    for (size_t i = 0; i < request->files.count; i++) {
        if (kind_of(request->files.items[i], &kind, &error) != TN_OK)
            return tn_session_fail(session, &error);
        draws |= tn_house_file_draws(kind);
        models |= kind == TN_HOUSE_AS_IFC;
    }
    if (asked_in_vain(request, draws, models, &found))
        return refuse_in_vain(session, &found);
    return models ? check_model(session, request) : TN_OK;
}

/* ---- written */

static tn_status write_file(building *b, const char *word, tn_error *error)
{
    char name[40];
    tn_making making;
    tn_house_file kind;
    tn_made_file *file = TN_ADD(made_file, b->built->files, error);
    if (!file)
        return TN_MEMORY;
    tn_status status = kind_of(word, &kind, error);
    snprintf(name, sizeof name, "house.%s", word);
    if (status == TN_OK && kind == TN_HOUSE_AS_OBJ) {
        const tn_texts *names = &b->request->mtl;
        b->filed.mtl = b->objs < names->count ? names->items[b->objs] : NULL;
        b->objs++;
    }
    if (status == TN_OK)
        status = tn_making_begin(&making, b->session, tn_house_file_format(kind),
                                 b->request->files.count > 1 ? name : NULL, file, error);
    if (status == TN_OK)
        status = tn_making_end(&making, tn_house_file_write(&b->filed, kind, making.stream, error), error);
    return status;
}

static tn_house_filed filed_of(const building *b)
{
    const tn_house_request *request = b->request;
    return (tn_house_filed){.title = request->title                       ? request->title
                                     : tn_is_house_number(request->house) ? request->house
                                                                          : NULL,
                            .views = {.items = request->views.items,
                                      .count = request->views.count,
                                      .cut = request->cut,
                                      .bare = request->bare,
                                      .azimuth = request->has_azimuth ? &request->azimuth : NULL,
                                      .elevation = request->has_elevation ? &request->elevation : NULL},
                            .says = {.project = request->project,
                                     .date = request->date,
                                     .revision = request->revision,
                                     .north = request->has_north ? &request->north : NULL},
                            .author = request->author,
                            .latitude = request->has_latitude ? &request->latitude : NULL,
                            .longitude = request->has_longitude ? &request->longitude : NULL,
                            .scale = (uint32_t)request->scale,
                            .dpi = (uint32_t)request->dpi,
                            .profile = (tn_profile)request->profile,
                            .watch = b->session->opened->module->watch};
}

static tn_status set_line(const tn_house *house, tn_built_house *built, tn_error *error)
{
    tn_buffer line = {0};
    tn_status status = tn_house_write(house, &line, error);
    built->house = line.data;
    return status == TN_OK && line.failed ? tn_fail_memory(error) : status;
}

static tn_status add_value(const tn_house_value *value, tn_built_house *built, tn_error *error)
{
    tn_buffer shown = {0};
    tn_valued_measure *to = TN_ADD(valued_measure, built->measures, error);
    if (!to)
        return TN_MEMORY;
    to->measure = value->measure;
    to->unit = tn_amount_unit_name(value->unit);
    to->has_value = value->has;
    if (!value->has)
        return TN_OK;
    mpq_set(to->value, value->value);
    tn_amount_convert(value->unit, to->value);
    bool good = tn_amount_write(value->unit, value->value, &shown);
    to->shown = shown.data;
    return good ? TN_OK : tn_fail_memory(error);
}

static tn_status set_values(const tn_house *house, tn_built_house *built, tn_error *error)
{
    tn_house_valuer *valuer;
    size_t count = 0;
    tn_status status = tn_house_valuer_new(house->form, house->length, NULL, 0, &valuer, error);
    if (status == TN_OK)
        status = tn_house_values_find(valuer, house, NULL, error);
    const tn_house_value *values = status == TN_OK ? tn_house_values(valuer, &count) : NULL;
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = add_value(&values[i], built, error);
    tn_house_valuer_free(valuer);
    return status;
}

enum { HANGING_SHOWN = 8 }; /* walls of a storey that are named */

/* Warns of walls of a storey that stand over nothing thicker than a partition, at the line of the storey. */
static void warn_of_hanging(const building *b, const tn_house *house, const tn_bearing *bearing, uint32_t storey)
{
    tn_compilation *compilation = &b->session->opened->compilation;
    const tn_house_form *form = house->form;
    const tn_storey_record *record = &form->module->STOREY_records[form->record->storey_first + storey];
    tn_span span = {record->file, record->begin, record->end};
    uint32_t walls[HANGING_SHOWN];
    size_t count = 0;
    int64_t from, to;
    for (uint32_t i = 0; i < house->face_count; i++)
        if (house->faces[i].storey == storey && tn_face_hangs(bearing, &house->faces[i], &from, &to, NULL)) {
            if (count < HANGING_SHOWN)
                walls[count] = i;
            count++;
        }
    if (count == 0 || tn_program_allows(compilation->program, W_HANGING_WALL, span))
        return;
    tn_diagnostics *list = &compilation->diagnostics;
    tn_diagnostic *d = tn_report(list, W_HANGING_WALL, span,
                                 count == 1 ? "a wall of storey `%s` stands over nothing thicker than a partition"
                                            : "walls of storey `%s` stand over nothing thicker than a partition",
                                 tn_text(form->module, record->name));
    for (size_t i = 0; i < count && i < HANGING_SHOWN; i++) {
        char text[600];
        tn_hanging_text(house, bearing, walls[i], text, sizeof text);
        tn_note(list, d, NULL, "%s", text);
    }
    if (count > HANGING_SHOWN)
        tn_note(list, d, NULL, "and %zu more", count - HANGING_SHOWN);
    tn_help(list, d,
            "what bears such a wall is a wall of that thickness below, outside or `party`, a post, or a `beam` "
            "whose `span` is as long");
}

static tn_status warn_of_walls(const building *b, const tn_house *house, tn_error *error)
{
    tn_flights flights;
    tn_bearing bearing = {0};
    tn_status status = tn_flights_stand(house, &flights, error);
    if (status == TN_OK)
        status = tn_house_bearing(house, &flights, &bearing, error);
    for (uint32_t k = 1; status == TN_OK && k < house->form->record->storey_count; k++)
        warn_of_hanging(b, house, &bearing, k);
    tn_bearing_clear(&bearing);
    tn_flights_clear(&flights);
    return status;
}

static tn_status write_all(void *context, const tn_house *house, tn_error *error)
{
    building *b = context;
    tn_solids solids = {0};
    tn_status status = set_line(house, b->built, error);
    if (status == TN_OK && b->request->measures)
        status = set_values(house, b->built, error);
    if (status == TN_OK && b->request->files.count)
        status = tn_house_solids(house, &solids, error);
    b->filed = filed_of(b);
    b->filed.house = house;
    b->filed.line = b->built->house;
    b->filed.solids = &solids;
    for (size_t i = 0; status == TN_OK && i < b->request->files.count; i++)
        status = write_file(b, b->request->files.items[i], error);
    tn_solids_clear(&solids);
    return status == TN_OK ? warn_of_walls(b, house, error) : status;
}

/* ---- which house */

/* The form that is meant: the named one, or the only one of the file itself, or the only one there is. */
static tn_status choose_form(tn_session *session, const char *wanted, uint32_t *index)
{
    const tn_module *module = session->opened->module;
    uint32_t own = 0;
    for (uint32_t i = 0; i < module->FORM_count; i++) {
        bool imported = module->FORM_records[i].flags & TN_IMPORTED;
        if (wanted ? strcmp(tn_text(module, module->FORM_records[i].name), wanted) != 0
                   : imported && module->FORM_count > 1)
            continue;
        own++;
        *index = i;
    }
    if (own == 1)
        return TN_OK;
    if (wanted)
        return tn_session_refuse(session, "a form is declared by `form NAME of SCHEMA { ... }`",
                                 "there is no form `%s` in the file", wanted);
    return module->FORM_count ? tn_session_refuse(session, "say which: --form NAME", "the file has several forms")
                              : tn_session_refuse(session, "a form is declared by `form NAME of SCHEMA { ... }`",
                                                  "the file has no form");
}

/* The library that is named, or the only one, if it is about the form: a line that leaves values out stands for one of
 * its houses. */
static const tn_house_library_record *library_of(const building *b, uint32_t form)
{
    const tn_module *module = b->session->opened->module;
    uint32_t found = tn_house_library_find(module, b->request->library);
    bool about = found != TN_NO_RECORD && module->HOUSE_LIBRARY_records[found].form == form;
    return about ? &module->HOUSE_LIBRARY_records[found] : NULL;
}

static tn_status read_house(building *b, const tn_house_form *form, uint32_t number, size_t max_length)
{
    const tn_typed_among among = {
        .form = form,
        .form_number = number,
        .library = library_of(b, number),
        .options = {.max_states = (uint32_t)b->request->max_states, .max_length = (uint32_t)max_length},
        .max_length = max_length};
    tn_house house = {0};
    tn_error error = {0};
    bool completed;
    tn_status status = tn_typed_house(b->session, &among, b->request->house, &house, &completed);
    if (status == TN_OK && write_all(b, &house, &error) != TN_OK)
        status = tn_session_fail(b->session, &error);
    tn_house_clear(&house);
    return status;
}

static tn_status read_line(building *b, size_t max_length)
{
    const tn_module *module = b->session->opened->module;
    uint32_t index = 0;
    tn_schema *schema;
    tn_house_form form;
    tn_error error;
    tn_status status = choose_form(b->session, b->request->form, &index);
    if (status != TN_OK)
        return status;
    if (tn_form_schema(module, index, &schema, &error) != TN_OK)
        return tn_session_fail(b->session, &error);
    tn_form_ready(module, index, schema, &form);
    status = read_house(b, &form, index, max_length);
    tn_schema_free(schema);
    return status;
}

tn_status tn_ask_house(tn_session *session, const tn_house_request *request, tn_reply *answer)
{
    size_t max_length = request->has_max_length ? (size_t)request->max_length : TN_HOUSE_TRAYS_DEFAULT;
    const tn_house_settings houses = {
        .library = request->library,
        .max_length = max_length,
        .plans = {.max_states = (uint32_t)request->max_states, .max_length = (uint32_t)max_length}};
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = check_files(session, request);
    if (status != TN_OK)
        return status;
    if (tn_reply_new(&tn_message_built_house, answer, &error) != TN_OK)
        return tn_session_fail(session, &error);
    building b = {.session = session, .request = request, .built = answer->value};
    return tn_is_house_number(request->house) ? tn_session_house(session, &houses, request->house, write_all, &b)
                                              : read_line(&b, max_length);
}
