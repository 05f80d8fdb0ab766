/* Draws a sample of a library of houses, or its best: small pictures with name, area and cost. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/plan/best.h"
#include "cli/house/houses.h"
#include "driver/house/change_text.h"
#include "driver/open/digits.h"
#include "runtime/house/picture/draw.h"
#include "runtime/house/schedule/cost.h"

enum { NAME_SIZE = 96, SAID_SIZE = 128, NOTE_SIZE = 256 };

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
        mpz_t whole;
        mpz_init(whole);
        mpz_fdiv_q_ui(whole, costs.hundredths, 100);
        gmp_snprintf(p->said + used, SAID_SIZE - used, ", cost %Zd.%02lu", whole, mpz_fdiv_ui(costs.hundredths, 100));
        mpz_clear(whole);
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

/* ---- a sample */

static tn_status collect_drawn(void *context, tn_house *house, const mpz_t rank, const mpz_t variant, tn_error *error)
{
    (void)variant;
    collection *c = context;
    pictured *p = &c->items[c->count++];
    gmp_snprintf(p->name, NAME_SIZE, "#%Zd", rank);
    tn_status status = take(p, house, error);
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
        gmp_snprintf(p->name, NAME_SIZE, "#%Zd:%Zd", plan, variant);
    }
    mpz_clears(plan, variant, NULL);
    return status;
}

/* ---- the page */

static tn_status draw(const tn_numbered *n, const collection *c, const tn_house_sheet *sheet, const char *note,
                      tn_error *error)
{
    tn_pictured_house *houses = calloc(c->count + 1, sizeof *houses);
    const tn_form_record *form = n->form.record;
    if (!houses)
        return tn_fail_memory(error);
    for (size_t i = 0; i < c->count; i++)
        houses[i] = (tn_pictured_house){&c->items[i].house, &c->items[i].solids, c->items[i].name, c->items[i].said};
    tn_house_gallery gallery = {.houses = houses,
                                .count = c->count,
                                .columns = sheet->columns,
                                .camera = sheet->camera,
                                .title = sheet->title ? sheet->title
                                                      : tn_text(n->form.module, form->doc ? form->doc : form->name),
                                .notes = &note,
                                .note_count = 1};
    tn_job_show(tn_numbered_job(n));
    tn_status status = tn_house_gallery_draw(&gallery, &(tn_picture){.path = sheet->output, .dpi = sheet->dpi}, error);
    free(houses);
    return status;
}

/* Collects the houses, n's, and draws them. note: what they are, behind how many there are. */
static void draw_collected(tn_numbered *n, collection *c, const tn_house_sheet *sheet, const char *what)
{
    tn_error error = {0};
    char note[NOTE_SIZE];
    c->items = calloc(sheet->wanted + 1, sizeof *c->items);
    tn_status status = c->items ? TN_OK : tn_fail_memory(&error);
    if (status == TN_OK)
        status = c->search ? collect_all_best(c, &error)
                           : tn_numbered_sample(n, NULL, sheet->wanted, sheet->seed, collect_drawn, c, &error);
    snprintf(note, sizeof note, "%zu house%s of %.100s%s; all to one scale", c->count, c->count == 1 ? "" : "s",
             tn_text(tn_numbered_job(n)->opened.module, n->record->name), what);
    if (status == TN_OK && c->count > 0)
        status = draw(n, c, sheet, note, &error);
    if (status == TN_OK)
        tn_numbered_say_few(n, sheet->best && sheet->best->plan, c->count, sheet->wanted > 0 ? sheet->wanted : 1);
    else
        tn_job_fail(tn_numbered_job(n), &error);
    for (size_t i = 0; c->items && i < c->count; i++) {
        tn_solids_clear(&c->items[i].solids);
        tn_house_clear(&c->items[i].house);
    }
    free(c->items);
}

static void draw_sample(tn_job *job, const tn_house_settings *settings, const tn_house_sheet *sheet)
{
    tn_numbered n = {0};
    collection c = {0};
    char what[NOTE_SIZE];
    snprintf(what, sizeof what, ", drawn with seed %" PRIu64, sheet->seed);
    if (tn_job_numbered(job, &n, settings))
        draw_collected(&n, &c, sheet, what);
    tn_numbered_close(&n);
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
static bool fits(tn_job *job, const tn_houses_search *search, tn_house_sheet *sheet)
{
    size_t points = tn_houses_points(search->houses);
    if (!sheet->front)
        return true;
    sheet->wanted = points;
    if (points <= TN_HOUSES_DRAWN_MAX)
        return true;
    tn_help(tn_job_diagnostics(job),
            tn_job_usage(job, "a picture shows 1 to %u houses, and there are %zu best trade-offs", TN_HOUSES_DRAWN_MAX,
                         points),
            "leave out -o, or name a text file: it has a house of each");
    return false;
}

static void draw_best(tn_job *job, tn_house_sheet sheet)
{
    const tn_best_request *best = sheet.best;
    const tn_pareto_request *front = sheet.front;
    const tn_house_asked asked = {.subject = front ? &front->subject : &best->subject,
                                  .plan = front ? front->plan : best->plan,
                                  .wanted = front ? UINT64_MAX : sheet.wanted,
                                  .aim = front ? TN_HOUSES_FRONT : TN_HOUSES_LEAST,
                                  .by = front ? front->by.items : best->by.items,
                                  .by_count = front ? front->by.count : best->by.count,
                                  .by_least = front ? 2 : 1};
    tn_houses_search search;
    collection c = {.search = &search, .front = front != NULL};
    char what[NOTE_SIZE];
    if (tn_job_answered(job, tn_houses_search_begin(&search, &job->session, &asked)) && fits(job, &search, &sheet)) {
        say_aim(&search, front != NULL, what, sizeof what);
        draw_collected(&search.n, &c, &sheet, what);
    }
    tn_houses_search_end(&search);
}

void tn_job_draw_houses(tn_job *job, const tn_house_settings *settings, const tn_house_sheet *sheet)
{
    if (sheet->front)
        draw_best(job, *sheet);
    else if (sheet->wanted == 0 || sheet->wanted > TN_HOUSES_DRAWN_MAX)
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "a picture shows 1 to %u houses", TN_HOUSES_DRAWN_MAX),
                sheet->wanted ? "ask for fewer" : "ask for one, or more");
    else if (sheet->best)
        draw_best(job, *sheet);
    else
        draw_sample(job, settings, sheet);
}
