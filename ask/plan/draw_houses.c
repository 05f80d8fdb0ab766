/* Draws a sample of a library of houses, or its best: small pictures with name, area and cost. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/plan/best.h"
#include "ask/plan/draw.h"
#include "driver/house/change_text.h"
#include "driver/open/digits.h"
#include "runtime/base/integers.h"
#include "runtime/house/picture/draw.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/schedule/describe.h"

enum { NAME_SIZE = 96, SAID_SIZE = 128, NOTE_SIZE = 256 };

/* The most houses of a page. */
#define TN_HOUSES_DRAWN_MAX 200u

/* A house of the sheet, and the words below it. */
typedef struct pictured {
    tn_house house;
    tn_solids solids;
    char name[NAME_SIZE], said[SAID_SIZE];
} pictured;

typedef struct collection {
    pictured *items;
    size_t count;
    tn_houses_search *search; /* of the best, or NULL */
    bool front;               /* of the best trade-offs */
} collection;

static tn_status say_cost(pictured *p, size_t used, tn_error *error)
{
    tn_costs costs = {0};
    if (!tn_form_has_costs(p->house.form))
        return TN_OK;
    tn_status status = tn_house_costs(&p->house, &p->solids, &costs, error);
    if (status == TN_OK) {
        tn_buffer cost = {0};
        if (tn_cost_write(&cost, costs.hundredths))
            snprintf(p->said + used, SAID_SIZE - used, ", cost %s", cost.data);
        else
            status = tn_fail_memory(error);
        free(cost.data);
    }
    tn_costs_clear(&costs);
    return status;
}

/* The area in the unit of the schema, and the cost where the form has prices. */
static tn_status describe(pictured *p, tn_error *error)
{
    double nm2;
    const char *unit = tn_house_area_unit(p->house.form, &nm2);
    bool feet = strcmp(unit, "sf") == 0;
    int used =
        snprintf(p->said, SAID_SIZE, "%.*f %s", feet ? 0 : 1, (double)tn_house_floor_area(&p->house) / nm2, unit);
    return say_cost(p, (size_t)used, error);
}

/* Takes the house. */
static tn_status take(pictured *p, tn_house *house, tn_error *error)
{
    p->house = *house;
    *house = (tn_house){0};
    return tn_house_solids(&p->house, &p->solids, error);
}

/* Names it by its rank, or by that of its plan and its variant on that. */
static tn_status name(pictured *p, const mpz_t rank, mpz_srcptr variant, tn_error *error)
{
    tn_buffer text = {0};
    bool ok = tn_buffer_append(&text, "#", 1) && tn_buffer_integer(&text, rank) &&
              (!variant || (tn_buffer_append(&text, ":", 1) && tn_buffer_integer(&text, variant)));
    if (ok)
        snprintf(p->name, NAME_SIZE, "%s", text.data);
    free(text.data);
    return ok ? TN_OK : tn_fail_memory(error);
}

/* ---- a sample */

static tn_status collect_drawn(void *context, tn_house *house, const mpz_t rank, const mpz_t variant, tn_error *error)
{
    (void)variant;
    collection *c = context;
    pictured *p = &c->items[c->count++];
    tn_status status = name(p, rank, NULL, error);
    if (status == TN_OK)
        status = take(p, house, error);
    return status == TN_OK ? describe(p, error) : status;
}

/* ---- the best */

/* "daylight 14', cost 2500"; of a trade-off also how many houses have it. */
static tn_status say_values(const collection *c, pictured *p, tn_error *error)
{
    const tn_houses_search *s = c->search;
    size_t used = 0;
    mpq_t value;
    mpq_init(value);
    bool ok = true;
    for (uint32_t k = 0; ok && k < s->found.count && used < SAID_SIZE; k++) {
        tn_houses_search_value(s, k, value);
        char *text = tn_wish_text(&s->found, k, value);
        ok = text != NULL;
        if (ok)
            used +=
                (size_t)snprintf(p->said + used, SAID_SIZE - used, "%s%s %s", k ? ", " : "", s->found.names[k], text);
        free(text);
    }
    mpq_clear(value);
    char *digits = c->front ? tn_digits(s->count, true) : NULL;
    if (digits && used < SAID_SIZE)
        snprintf(p->said + used, SAID_SIZE - used, "; %s house%s", digits, strcmp(digits, "1") == 0 ? "" : "s");
    ok = ok && (digits || !c->front);
    free(digits);
    return ok ? TN_OK : tn_fail_memory(error);
}

/* The house is the search's: a copy is taken, as its line says it. */
static tn_status collect_best(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    collection *c = context;
    tn_buffer line = {0};
    tn_house copy = {0};
    tn_status status = tn_house_write(house, &line, error);
    if (status == TN_OK)
        status = tn_house_read(house->form, line.data, line.size, house->length, &copy, error);
    if (status == TN_OK)
        status = say_values(c, &c->items[c->count], error);
    if (status == TN_OK)
        status = take(&c->items[c->count++], &copy, error);
    tn_house_clear(&copy);
    free(line.data);
    *stop = ++c->search->given == c->search->wanted || c->front;
    return status;
}

/* Searches for all, then names them: each by itself, since both go through houses on plans. */
static tn_status collect_all_best(collection *c, tn_error *error)
{
    mpz_t plan, variant;
    mpz_inits(plan, variant, NULL);
    tn_status status = tn_houses_search_each(c->search, collect_best, c, error);
    for (size_t i = 0; status == TN_OK && i < c->count; i++) {
        pictured *p = &c->items[i];
        status = tn_numbered_name(&c->search->n, &p->house, plan, variant, error);
        if (status == TN_OK)
            status = name(p, plan, variant, error);
    }
    mpz_clears(plan, variant, NULL);
    return status;
}

/* ---- the page */

/* The houses of a page, and what they are. */
typedef struct page {
    tn_session *session;
    const tn_draw_request *request;
    tn_drawn_picture *made;
    collection c;
    size_t wanted;
    char what[NOTE_SIZE]; /* behind how many they are */
} page;

static tn_camera camera_of(const tn_draw_request *request)
{
    tn_camera camera = tn_house_sheet_camera();
    if (request->has_azimuth)
        camera.azimuth = request->azimuth;
    if (request->has_elevation)
        camera.elevation = request->elevation;
    return camera;
}

static tn_status draw(page *p, const tn_numbered *n)
{
    const collection *c = &p->c;
    const tn_form_record *form = n->form.record;
    tn_pictured_house *houses = calloc(c->count + 1, sizeof *houses);
    tn_picture to = tn_picture_asked(tn_draw_format(p->request));
    char note[NOTE_SIZE];
    const char *notes[] = {note};
    tn_error error;
    if (!houses) {
        tn_fail_memory(&error);
        return tn_session_fail(p->session, &error);
    }
    snprintf(note, sizeof note, "%zu house%s of %.100s%s; all to one scale", c->count, c->count == 1 ? "" : "s",
             tn_text(n->form.module, n->record->name), p->what);
    for (size_t i = 0; i < c->count; i++)
        houses[i] = (tn_pictured_house){&c->items[i].house, &c->items[i].solids, c->items[i].name, c->items[i].said};
    const tn_house_gallery gallery = {
        .houses = houses,
        .count = c->count,
        .columns = (size_t)p->request->columns,
        .camera = camera_of(p->request),
        .title = p->request->title ? p->request->title : tn_text(n->form.module, form->doc ? form->doc : form->name),
        .notes = notes,
        .note_count = 1};
    to.dpi = (uint32_t)p->request->dpi;
    to.watch = p->session->opened->module->watch;
    tn_status status = tn_house_gallery_draw(&gallery, &to, &error);
    free(houses);
    return tn_draw_give(p->session, p->request, &to, status, &error, p->made);
}

static void clear(collection *c)
{
    for (size_t i = 0; c->items && i < c->count; i++) {
        tn_solids_clear(&c->items[i].solids);
        tn_house_clear(&c->items[i].house);
    }
    free(c->items);
}

/* Collects the houses, n's, and draws them, if there are any. */
static tn_status draw_collected(page *p, tn_numbered *n)
{
    collection *c = &p->c;
    tn_error error = {0};
    c->items = calloc(p->wanted + 1, sizeof *c->items);
    tn_status status = c->items ? TN_OK : tn_fail_memory(&error);
    if (status == TN_OK)
        status = c->search ? collect_all_best(c, &error)
                           : tn_numbered_sample(n, NULL, p->wanted, p->request->seed, collect_drawn, c, &error);
    if (status != TN_OK)
        status = tn_session_fail(p->session, &error);
    else if (c->count > 0)
        status = draw(p, n);
    if (status == TN_OK)
        tn_numbered_say_few(n, p->request->plan != NULL, c->count, p->wanted > 0 ? p->wanted : 1);
    clear(c);
    return status;
}

static tn_status draw_sample(page *p)
{
    tn_numbered n;
    tn_plan none;
    snprintf(p->what, sizeof p->what, ", drawn with seed %" PRIu64, p->request->seed);
    tn_status status = tn_numbered_open_on(&n, p->session, &p->request->subject, NULL, &none);
    if (status == TN_OK)
        status = draw_collected(p, &n);
    tn_numbered_close(&n);
    return status;
}

/* " with the least cost, then the most daylight"; ": the first of each of the best trade-offs, with the least cost and
 * the most daylight" */
static void say_aim(const tn_houses_search *search, bool front, char *text, size_t size)
{
    const tn_wishes *wishes = &search->found;
    snprintf(text, size, front ? ": the first of each of the best trade-offs, with " : " with ");
    for (uint32_t k = 0; k < wishes->count; k++) {
        size_t used = strlen(text);
        const char *between = k == 0 ? "the" : front ? " and the" : ", then the";
        snprintf(text + used, size - used, "%s %s %s", between, wishes->most[k] ? "most" : "least", wishes->names[k]);
    }
}

/* A front has as many points as it has. */
static tn_status find_wanted(page *p, const tn_houses_search *search)
{
    if (!p->c.front)
        return TN_OK;
    p->wanted = tn_houses_points(search->houses);
    return p->wanted <= TN_HOUSES_DRAWN_MAX
               ? TN_OK
               : tn_session_refuse(p->session, "leave out -o, or name a text file: it has a house of each",
                                   "a picture shows 1 to %u houses, and there are %zu best trade-offs",
                                   TN_HOUSES_DRAWN_MAX, p->wanted);
}

static tn_status draw_best(page *p)
{
    const tn_draw_request *r = p->request;
    const tn_house_asked asked = {.subject = &r->subject,
                                  .plan = r->plan,
                                  .wanted = r->front ? UINT64_MAX : p->wanted,
                                  .aim = r->front ? TN_HOUSES_FRONT : TN_HOUSES_LEAST,
                                  .by = r->by.items,
                                  .by_count = r->by.count,
                                  .by_least = r->front ? 2 : 1};
    tn_houses_search search;
    p->c = (collection){.search = &search, .front = r->front};
    tn_status status = tn_houses_search_begin(&search, p->session, &asked);
    if (status == TN_OK)
        status = find_wanted(p, &search);
    if (status == TN_OK) {
        say_aim(&search, r->front, p->what, sizeof p->what);
        status = draw_collected(p, &search.n);
    }
    tn_houses_search_end(&search);
    return status;
}

/* ---- asked */

/* What says which plans are drawn, and how they are put on paper, says nothing of houses: it is refused, with what does
 * it for houses. */
static tn_status check(tn_session *session, const tn_draw_request *r)
{
    static const char of_trays[] = "write it as a requirement, such as --where \"quantity(any, n = 3)\"";
    static const char one_scale[] = "leave it out: all houses of a picture are to one scale. `tartan house FILE HOUSE "
                                    "-o NAME.pdf` draws one on paper";
    const struct {
        bool given;
        const char *what, *help;
    } refused[] = {
        {r->mirror, "--mirror", "leave it out: it is about plans, not about houses"},
        {r->rules.count > 0, "--rule", "rules about houses have no picture; `tartan report` lists them"},
        {r->from || r->plans.count, "a file of plans",
         "--sample N draws N houses of the library, and `tartan house FILE HOUSE -o NAME.svg` one"},
        {r->has_length, "--length", of_trays},
        {r->has_per_length, "--per-length", of_trays},
        {r->diverse, "--diverse", "leave it out: each house of the library is drawn as likely as each"},
        {r->paper != NULL, "--paper", one_scale},
        {r->has_scale, "--scale", one_scale},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        if (refused[i].given)
            return tn_session_refuse(session, refused[i].help,
                                     "for a library of houses, `tartan draw` does not take %s", refused[i].what);
    if (!r->has_sample && !r->has_best && !r->front)
        return tn_session_refuse(session,
                                 "write --sample N, or --best N --least MEASURE; `tartan house` draws one house",
                                 "of a library of houses, a sample or the best are drawn");
    return TN_OK;
}

tn_status tn_draw_houses(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
{
    page p = {.session = session,
              .request = request,
              .made = made,
              .wanted = (size_t)(request->has_best ? request->best : request->sample)};
    tn_status status = check(session, request);
    if (status == TN_OK && !request->front && (p.wanted == 0 || p.wanted > TN_HOUSES_DRAWN_MAX))
        status = tn_session_refuse(session, p.wanted ? "ask for fewer" : "ask for one, or more",
                                   "a picture shows 1 to %u houses", TN_HOUSES_DRAWN_MAX);
    if (status != TN_OK)
        return status;
    return request->has_best || request->front ? draw_best(&p) : draw_sample(&p);
}
