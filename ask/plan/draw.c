/* draw: plans, rules, houses or a form in space as a picture. */
#include "ask/plan/draw.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/form/form.h"
#include "ask/plan/best.h"
#include "ask/session/questions.h"
#include "driver/house/change_text.h"
#include "driver/house/judge.h"
#include "driver/measure/front.h"
#include "driver/open/digits.h"
#include "driver/open/open.h"
#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/picture/draw.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/schedule/describe.h"
#include "runtime/plan/picture/draw.h"
#include "runtime/plan/picture/draw_rule.h"

/* ---- plans gathered for a picture */

tn_status tn_sheet_add(tn_plan_sheet *s, const tn_tray *trays, size_t length, char *number, const char *heading,
                       char *caption, tn_error *error)
{
    tn_tray *copy = malloc(sizeof *copy * (length + 1));
    if (!copy || !number || !tn_array_reserve(&s->plans, &s->room, s->count, 1, sizeof *s->plans)) {
        free(copy);
        free(number);
        free(caption);
        return tn_fail_memory(error);
    }
    if (length)
        memcpy(copy, trays, sizeof *copy * length);
    s->plans[s->count++] = (tn_drawn_plan){copy, length, number, heading, caption};
    return TN_OK;
}

void tn_sheet_clear(tn_plan_sheet *s)
{
    for (size_t i = 0; i < s->count; i++) {
        free((tn_tray *)(uintptr_t)s->plans[i].trays);
        free((char *)(uintptr_t)s->plans[i].number);
        free((char *)(uintptr_t)s->plans[i].caption);
    }
    free(s->plans);
    *s = (tn_plan_sheet){0};
}

/* "ward.plan, rules 0123456789abcdef, tartan 1.0": the last note of a sheet. Only the file's name, so that the same
 * sheet can be made anywhere. */
static void sheet_note_rules(const tn_opened *opened, char *note, size_t size)
{
    const tn_module *module = opened->module;
    const char *path = opened->path, *slash = strrchr(path, '/');
    const tn_producer_record *producer = module->PRODUCER_count ? &module->PRODUCER_records[0] : NULL;
    char params[160];
    tn_opened_params_text(opened, params, sizeof params);
    int used = snprintf(note, size, "%.160s%s%s", slash ? slash + 1 : path, params[0] ? " with " : "", params);
    if (producer && used >= 0 && (size_t)used < size)
        snprintf(note + used, size - (size_t)used, ", rules %016" PRIx64 ", %.60s", (uint64_t)producer->sources_hash,
                 tn_text(module, producer->version));
}

/* ---- sheets of plans, those of a request or of a library, and pictures of rules */

enum { NOTE_COUNT = 3, NOTE_SIZE = 256 };

/* A sheet being made. */
typedef struct sheet {
    tn_session *session;
    const tn_draw_request *request;
    tn_drawn_picture *made;
    const tn_schema *schema;
    const tn_library_record *library; /* or NULL */
    const tn_ready_library *ready;    /* of plans that it was asked for */
    tn_wishes wishes;                 /* of the best ones */
    tn_plan_sheet drawn;
    tn_status taken; /* what taking a plan came to, with its error */
    tn_error error;
    bool ranked; /* numbers are ranks, not lines */
    char notes[NOTE_COUNT][NOTE_SIZE];
    size_t note_count;
} sheet;

static tn_status draw_sheet(sheet *s)
{
    const tn_draw_request *request = s->request;
    const tn_module *module = s->session->opened->module;
    const char *notes[NOTE_COUNT];
    tn_picture to = tn_picture_asked(tn_draw_format(request));
    tn_error error;
    to.profile = (tn_profile)request->profile;
    sheet_note_rules(s->session->opened, s->notes[s->note_count++], NOTE_SIZE);
    for (size_t i = 0; i < s->note_count; i++)
        notes[i] = s->notes[i];
    tn_string name = s->library ? s->library->name : s->schema->record->name,
              doc = s->library ? s->library->doc : s->schema->record->doc;
    const tn_draw_options options = {.title = request->title ? request->title : tn_text(module, name),
                                     .doc = doc ? tn_text(module, doc) : NULL,
                                     .number_name = s->ranked ? "rank" : "line",
                                     .notes = notes,
                                     .note_count = s->note_count,
                                     .paper = request->paper,
                                     .scale = (uint32_t)request->scale,
                                     .columns = (uint32_t)request->columns,
                                     .dpi = (uint32_t)request->dpi,
                                     .max_plans =
                                         request->has_max_plans ? (size_t)request->max_plans : TN_DRAW_PLANS_DEFAULT};
    tn_status status = tn_plans_draw(s->schema, s->drawn.plans, s->drawn.count, &options, &to, &error);
    return tn_draw_give(s->session, request, &to, status, &error, s->made);
}

/* ---- plans that the request has */

static tn_status add_given(sheet *s, size_t i)
{
    const tn_given_plan *given = &s->request->plans.items[i];
    char place[24];
    tn_plan plan = {0};
    tn_error error;
    tn_status status =
        tn_session_plan_line(s->session, s->schema, given->plan, tn_asked_length(&s->request->subject), &plan);
    snprintf(place, sizeof place, "%zu", i + 1);
    if (status == TN_OK && tn_sheet_add(&s->drawn, plan.trays, plan.length,
                                        strdup(given->number ? given->number : place), NULL, NULL, &error) != TN_OK)
        status = tn_session_fail(s->session, &error);
    free(plan.trays);
    return status;
}

static tn_status draw_given(sheet *s)
{
    const tn_draw_request *request = s->request;
    size_t count = request->plans.count;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = add_given(s, i);
    snprintf(s->notes[s->note_count++], NOTE_SIZE, "%zu plan%s%s%s", count, count == 1 ? "" : "s",
             request->from ? " from " : "", request->from ? request->from : "");
    s->ranked = request->ranked;
    return status == TN_OK ? draw_sheet(s) : status;
}

static tn_status choose_given(sheet *s)
{
    const tn_module *module = s->session->opened->module;
    tn_schema *schema;
    uint32_t index, library = UINT32_MAX;
    tn_error error;
    tn_status status = tn_schema_choose(s->session->opened, s->request->subject.library, &index, &library);
    if (status != TN_OK)
        return status;
    if (tn_schema_new(module, index, 0, &schema, &error) != TN_OK)
        return tn_session_fail(s->session, &error);
    s->schema = schema;
    s->library = library != UINT32_MAX ? &module->LIBRARY_records[library] : NULL;
    status = draw_given(s);
    tn_schema_free(schema);
    return status;
}

/* ---- plans that the library is asked for */

static bool begins(void *context, tn_found_of *of)
{
    sheet *s = context;
    s->ready = of->plans;
    s->schema = of->plans->schema;
    s->library = of->plans->record;
    s->ranked = !of->unranked;
    if (of->wishes)
        s->wishes = *of->wishes;
    return true;
}

/* "3.  cost 87,880, area 304 sf"; NULL: out of memory. */
static char *caption_of(const sheet *s, const tn_found_one *found)
{
    tn_buffer caption = {0};
    bool ok = tn_buffer_printf(&caption, "%zu.  ", s->drawn.count + 1);
    for (uint32_t k = 0; ok && k < s->wishes.count; k++)
        ok = tn_buffer_printf(&caption, "%s%s ", k ? ", " : "", s->wishes.names[k]) &&
             tn_amount_write(tn_amount_unit_shown(s->wishes.units[k]), found->values[k], &caption);
    if (ok)
        return caption.data;
    free(caption.data);
    return NULL;
}

/* Its rank; of a plan without one, how many are drawn with it. NULL: out of memory. */
static char *number_of(const sheet *s, const tn_found_one *found)
{
    tn_buffer number = {0};
    if (found->rank)
        return mpz_get_str(NULL, 10, found->rank);
    return tn_buffer_printf(&number, "%zu", s->drawn.count + 1) ? number.data : NULL;
}

static bool takes(void *context, const tn_found_one *found)
{
    sheet *s = context;
    char *caption = s->wishes.count ? caption_of(s, found) : NULL;
    if (s->wishes.count && !caption)
        s->taken = tn_fail_memory(&s->error);
    else
        s->taken = tn_sheet_add(&s->drawn, found->trays, found->length, number_of(s, found), NULL, caption, &s->error);
    return s->taken == TN_OK;
}

/* " of 5,000 plans", as many as the library keeps; or " plans found by search" (malloc). NULL: out of memory. */
static char *kept_words(const sheet *s)
{
    tn_buffer words = {0};
    mpz_t kept;
    if (!s->ready->library)
        return strdup(" plans found by search");
    mpz_init(kept);
    tn_library_kept(s->ready->library, TN_ALL_LENGTHS, kept);
    char *digits = tn_digits(kept, true);
    bool ok = digits && tn_buffer_printf(&words, " of %s plans", digits);
    free(digits);
    mpz_clear(kept);
    return ok ? words.data : NULL;
}

static void note_library(sheet *s)
{
    char hash[33];
    if (!s->ready->library)
        return;
    tn_library_hash(s->ready->library, hash);
    snprintf(s->notes[s->note_count++], NOTE_SIZE, "library %s", hash);
}

static tn_status find_sample(sheet *s, tn_reply *found)
{
    const tn_draw_request *r = s->request;
    const tn_sample_request request = {.subject = r->subject,
                                       .has_count = r->has_sample,
                                       .count = r->sample,
                                       .seed = r->seed,
                                       .has_length = r->has_length,
                                       .length = r->length,
                                       .has_per_length = r->has_per_length,
                                       .per_length = r->per_length,
                                       .diverse = r->diverse,
                                       .uniform = true};
    return tn_ask_sample(s->session, &request, found);
}

static tn_status find_best(sheet *s, tn_reply *found)
{
    const tn_draw_request *r = s->request;
    const tn_best_request request = {.subject = r->subject,
                                     .by = {r->by.items, r->by.count},
                                     .has_count = true,
                                     .count = r->best,
                                     .diverse = r->diverse,
                                     .mirror = r->mirror};
    return tn_ask_best(s->session, &request, found);
}

/* "24 of 5,000 plans, drawn with seed 0"; "the 10 of 5,000 plans with the least cost, then the most area" */
static tn_status note_found(sheet *s)
{
    const tn_wishes *wishes = &s->wishes;
    char *kept = kept_words(s);
    tn_buffer text = {0};
    bool best = s->request->has_best, ok = kept != NULL;
    if (ok)
        ok = best ? tn_buffer_printf(&text, "%s%zu%s with the ",
                                     s->request->diverse ? "plans that differ, among the best: " : "the ",
                                     s->drawn.count, kept)
                  : tn_buffer_printf(&text, "%zu%s, drawn with seed %" PRIu64, s->drawn.count, kept, s->request->seed);
    for (uint32_t k = 0; ok && best && k < wishes->count; k++)
        ok = tn_buffer_printf(&text, "%s%s %s", k ? ", then the " : "", wishes->most[k] ? "most" : "least",
                              wishes->names[k]);
    if (ok)
        snprintf(s->notes[s->note_count++], NOTE_SIZE, "%s", text.data);
    free(text.data);
    free(kept);
    return ok ? TN_OK : tn_fail_memory(&s->error);
}

static tn_status draw_library(sheet *s)
{
    const tn_taker taker = {.begins = begins, .takes = takes, .context = s}, *before = s->session->taker;
    tn_reply found;
    s->session->taker = &taker;
    tn_status status = s->request->has_best ? find_best(s, &found) : find_sample(s, &found);
    s->session->taker = before;
    tn_reply_clear(&found);
    if (status != TN_OK || !s->ready)
        return status;
    status = s->taken == TN_OK ? note_found(s) : s->taken;
    if (status != TN_OK)
        return tn_session_fail(s->session, &s->error);
    note_library(s);
    return draw_sheet(s);
}

/* ---- the best trade-offs */

static tn_status draw_front(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
{
    const tn_pareto_request asked = {.subject = request->subject, .by = {request->by.items, request->by.count}};
    tn_picture to = tn_picture_asked(tn_draw_format(request));
    tn_reply found;
    tn_error error;
    tn_status status = tn_ask_pareto(session, &asked, &found);
    if (status == TN_OK && !((tn_found_front *)found.value)->shown.value) {
        status = tn_session_refuse(session, "leave out -o, or give fewer trays with --trays",
                                   "the front of a library that is searched is not drawn, since it stands over the "
                                   "counts of all plans");
    } else if (status == TN_OK) {
        const tn_plan_front *f = ((tn_found_front *)found.value)->shown.value;
        const tn_shown_front shown = {f->ready,       f->wishes.count, f->wishes.measures,
                                      f->wishes.most, f->weighed,      &f->front};
        to.dpi = (uint32_t)request->dpi;
        status = tn_draw_give(session, request, &to, tn_front_picture(&shown, &to, &error), &error, made);
    }
    tn_reply_clear(&found);
    return status;
}

/* ---- asked */

/* Plans that the request has, or that the library is asked for: its best ones, or a sample. */
static tn_status draw_plans(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
{
    sheet s = {.session = session, .request = request, .made = made};
    bool from_library = request->has_sample || request->has_per_length || request->has_best;
    if (request->front)
        return draw_front(session, request, made);
    if (!from_library && !request->from && request->plans.count == 0)
        return tn_session_refuse(session, NULL, "say what is drawn: plans, rules, a sample or the best");
    tn_status status = from_library ? draw_library(&s) : choose_given(&s);
    tn_sheet_clear(&s.drawn);
    return status;
}

/* ---- rules */

/* Finds the rules, and the schema that they are about. */
static tn_status find_rules(tn_session *session, const tn_texts *names, tn_drawn_rule *rules, uint32_t *trays)
{
    const tn_module *module = session->opened->module;
    for (size_t i = 0; i < names->count; i++) {
        uint32_t rule;
        tn_status status = tn_rule_choose(session->opened, names->items[i], &rule);
        if (status != TN_OK)
            return status;
        rules[i] = tn_drawn_rule_of(module, rule);
        if (i > 0 && module->RULE_records[rule].schema != *trays)
            return tn_session_refuse(session, NULL, "the rules of one picture are about the same trays");
        *trays = module->RULE_records[rule].schema;
    }
    return TN_OK;
}

static tn_status draw_rules(tn_session *session, const tn_draw_request *request, const tn_drawn_rule *rules,
                            uint32_t trays, tn_drawn_picture *made)
{
    tn_picture to = tn_picture_asked(tn_draw_format(request));
    tn_schema *schema = NULL;
    tn_error error;
    to.dpi = (uint32_t)request->dpi;
    tn_status status = tn_schema_new(session->opened->module, trays, 0, &schema, &error);
    if (status == TN_OK)
        status = tn_rules_draw(schema, rules, request->rules.count, &to, &error);
    tn_schema_free(schema);
    return tn_draw_give(session, request, &to, status, &error, made);
}

/* Rules in one picture, which are about the same trays. */
static tn_status tn_draw_rules(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
{
    tn_drawn_rule *rules = malloc(sizeof *rules * (request->rules.count + 1));
    uint32_t trays = 0;
    tn_error error;
    if (!rules) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    tn_status status = find_rules(session, &request->rules, rules, &trays);
    if (status == TN_OK)
        status = draw_rules(session, request, rules, trays, made);
    free(rules);
    return status;
}

/* ---- a sample of a library of houses, or its best */

enum { NAME_SIZE = 96, SAID_SIZE = 128 };

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
    if (!tn_form_has_prices(p->house.form))
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

/* The area in the unit of the schema, and the cost if the form has prices. */
static tn_status describe(pictured *p, tn_error *error)
{
    double nm2;
    bool feet = strcmp(tn_house_area_unit(p->house.form, &nm2), "sf") == 0;
    int used = snprintf(p->said, SAID_SIZE, "%.*f %s", feet ? 0 : 1, (double)tn_house_floor_area(&p->house) / nm2,
                        feet ? "sf" : "m\xc2\xb2");
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
    tn_status status = TN_OK;
    if (rank)
        status = name(p, rank, NULL, error);
    else /* houses that are tried have no rank */
        snprintf(p->name, NAME_SIZE, "%zu", c->count);
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
        tn_ordered_value(&s->by, k, value);
        char *text = tn_wish_caption(&s->found, k, value);
        ok = text != NULL;
        if (ok)
            used +=
                (size_t)snprintf(p->said + used, SAID_SIZE - used, "%s%s %s", k ? ", " : "", s->found.names[k], text);
        free(text);
    }
    mpq_clear(value);
    char *digits = c->front ? tn_digits(s->by.count, true) : NULL;
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

static tn_status draw_page(page *p, const tn_numbered *n)
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
                           : tn_numbered_sample(n, NULL, p->wanted, p->request->seed, p->request->diverse,
                                                collect_drawn, c, &error);
    if (status != TN_OK)
        status = tn_session_fail(p->session, &error);
    else if (c->count > 0)
        status = draw_page(p, n);
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
    p->wanted = tn_ordered_points(&search->by);
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
                                  .diverse = r->diverse && !r->front,
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

/* Houses in space: a sample, the best, or the first of each of the best trade-offs. */
static tn_status draw_houses(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
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

/* ---- what goes together */

static bool is_sampled(const tn_draw_request *request)
{
    return request->has_sample || request->has_per_length;
}

static bool of_houses(const tn_session *session, const tn_draw_request *r)
{
    return r->plan ||
           (r->subject.library && tn_house_library_find(session->opened->module, r->subject.library) != TN_NO_RECORD);
}

static tn_status check_best(tn_session *session, const tn_draw_request *r)
{
    size_t most = r->has_max_plans ? (size_t)r->max_plans : TN_DRAW_PLANS_DEFAULT;
    if (r->has_best && (is_sampled(r) || r->rules.count || r->from))
        return tn_session_refuse(
            session, NULL,
            "--best draws the best plans of a library: give it without --sample, --rule and a file of plans");
    if (r->has_best && r->best > most && !of_houses(session, r))
        return tn_session_refuse(session, "ask for fewer, or raise the limit with --max-plans",
                                 "a picture shows at most %zu plans", most);
    if (r->front && (r->has_best || is_sampled(r) || r->rules.count || r->from))
        return tn_session_refuse(session, NULL, "the front is drawn alone, without a sample, the best and rules");
    if (r->plan && !r->has_best && !r->front)
        return tn_session_refuse(session, NULL, "`plan` says which houses are best: give `best` or `front` too");
    if (!r->has_best && !r->front && (r->by.count || r->mirror))
        return tn_session_refuse(session, NULL,
                                 "--least, --most and --mirror say which plans are best: give --best N too");
    return TN_OK;
}

static tn_status check_plans(tn_session *session, const tn_draw_request *r)
{
    if (r->rules.count && (is_sampled(r) || r->from))
        return tn_session_refuse(session, NULL, "draw either rules or plans, not both");
    if (is_sampled(r) && r->from)
        return tn_session_refuse(session, NULL, "draw either a file of plans or a --sample, not both");
    if (!is_sampled(r) && (r->has_seed || r->has_length || (r->diverse && !r->has_best)))
        return tn_session_refuse(session, NULL,
                                 "--seed, --length and --diverse say what is sampled: give --sample N too");
    if (!is_sampled(r) && !r->has_best && !r->front && r->subject.has_trays)
        return tn_session_refuse(
            session, NULL, "--trays says which plans are taken from the library: give --sample N or --best N too");
    return check_best(session, r);
}

/* What says something about one or two of the subjects only. */
static tn_status check_uses(tn_session *session, const tn_draw_request *r)
{
    bool houses = of_houses(session, r);
    const tn_asked_use uses[] = {
        {r->rules.count > 0, TN_OF_PLANS, "rule"},
        {r->subject.library != NULL, TN_OF_PLANS, "library"},
        {r->has_sample, TN_OF_PLANS, "sample"},
        {r->has_best, TN_OF_PLANS, "best"},
        {r->has_per_length, TN_OF_PLANS, "per-length"},
        {r->paper != NULL, TN_OF_PLANS, "paper"},
        {r->has_scale, TN_OF_PLANS, "scale"},
        {r->has_max_plans, TN_OF_PLANS, "max-plans"},
        {r->has_columns, TN_OF_PLANS | TN_OF_SOLIDS, "columns"},
        {r->solid.solid != NULL, TN_OF_SOLIDS, "solid"},
        {r->show == TN_DRAW_SHEET, TN_OF_SOLIDS, "sheet"},
        {r->show == TN_DRAW_BEFORE, TN_OF_SOLIDS, "before"},
        {r->show == TN_DRAW_EXPLODED, TN_OF_SOLIDS, "exploded"},
        {r->show == TN_DRAW_HISTORY, TN_OF_SOLIDS, "show"},
        {r->solid.has_max_boxes, TN_OF_SOLIDS, "max-boxes"},
        {r->has_azimuth && !houses, TN_OF_SOLIDS | TN_OF_FIELDS, "azimuth"},
        {r->has_elevation && !houses, TN_OF_SOLIDS | TN_OF_FIELDS, "elevation"},
        {r->has_width, TN_OF_SOLIDS | TN_OF_FIELDS, "width"},
        {r->surface != NULL, TN_OF_FIELDS, "surface"},
        {r->has_grid, TN_OF_FIELDS, "grid"},
        {r->sharp, TN_OF_FIELDS, "sharp"},
        {r->open, TN_OF_FIELDS, "open"},
    };
    return tn_session_check_uses(session, uses, sizeof uses / sizeof *uses);
}

tn_status tn_draw_check(tn_session *session, const tn_draw_request *request)
{
    tn_status status = check_plans(session, request);
    return status == TN_OK ? check_uses(session, request) : status;
}

/* ---- asked */

/* A file for drawing programs shows nothing by what covers it. */
static tn_status check_dxf(tn_session *session, const tn_draw_request *r)
{
    bool dxf = tn_draw_format(r) == TN_FILE_DXF, forms = tn_subject_of(session->opened->module) != TN_SUBJECT_PLANS,
         houses = !forms && of_houses(session, r);
    if (dxf && (forms || houses || r->rules.count || r->front))
        return tn_session_refuse(session,
                                 forms    ? "end its name in .svg, .png or .pdf; `tartan mesh` writes a form as .dxf"
                                 : houses ? "end its name in .svg, .png or .pdf; `tartan house` writes a house as .dxf"
                                          : "end its name in .svg, .png or .pdf",
                                 "a DXF is made of plans, and this draws something else");
    if (!dxf && r->profile)
        return tn_session_refuse(session, "end its name in .dxf, or leave it out",
                                 "--profile names the layers of a DXF, and the picture is none");
    return TN_OK;
}

static tn_status draw(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
{
    tn_status status = check_dxf(session, request);
    if (status != TN_OK)
        return status;
    switch (tn_subject_of(session->opened->module)) {
    case TN_SUBJECT_SOLID:
    case TN_SUBJECT_FIELD:
        return tn_draw_form(session, request, made);
    default:
        return of_houses(session, request) ? draw_houses(session, request, made)
               : request->rules.count      ? tn_draw_rules(session, request, made)
                                           : draw_plans(session, request, made);
    }
}

tn_status tn_ask_draw(tn_session *session, const tn_draw_request *request, tn_reply *answer)
{
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = tn_draw_check(session, request);
    if (status != TN_OK)
        return status;
    if (tn_reply_new(&tn_message_drawn_picture, answer, &error) != TN_OK)
        return tn_session_fail(session, &error);
    return draw(session, request, answer->value);
}
