/* Draws a sample of a library of houses: small pictures with rank, area and cost. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/house/numbered_parts.h"
#include "cli/house/sampled.h"
#include "runtime/base/length_style.h"
#include "runtime/house/picture/draw.h"
#include "runtime/house/schedule/cost.h"

enum { NAME_SIZE = 96, SAID_SIZE = 96, NOTE_SIZE = 256 };
#define SQUARE_FOOT_NM2 (304800000.0 * 304800000.0)

/* A house of the sheet, and the words below it. */
typedef struct pictured {
    tn_house house;
    tn_solids solids;
    char name[NAME_SIZE], said[SAID_SIZE];
} pictured;

typedef struct collection {
    pictured *items;
    size_t room, count;
} collection;

static double floor_area(const tn_house *house)
{
    double area = 0;
    for (size_t i = 0; i < house->cell_count; i++)
        if (!house->cells[i].open)
            area += (double)tn_cell_area(&house->cells[i]);
    return area;
}

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

/* "#12": rank, area in the unit of the schema, cost where the form has prices. */
static tn_status describe(pictured *p, const mpz_t rank, tn_error *error)
{
    const tn_schema *schema = p->house.form->schema;
    const char *width = tn_text(schema->module, schema->values[schema->value_start[p->house.form->width]].name);
    double area = floor_area(&p->house);
    bool feet = tn_length_style_of(width) == TN_STYLE_FEET;
    gmp_snprintf(p->name, NAME_SIZE, "#%Zd", rank);
    int used = feet ? snprintf(p->said, SAID_SIZE, "%.0f sf", area / SQUARE_FOOT_NM2)
                    : snprintf(p->said, SAID_SIZE, "%.1f m2", area / 1e18);
    return say_cost(p, (size_t)used, error);
}

static tn_status collect(void *context, tn_house *house, const mpz_t rank, const mpz_t variant, tn_error *error)
{
    (void)variant;
    collection *c = context;
    pictured *p = &c->items[c->count++];
    p->house = *house;
    *house = (tn_house){0};
    tn_status status = tn_house_solids(&p->house, &p->solids, error);
    return status == TN_OK ? describe(p, rank, error) : status;
}

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
    tn_job_show(n->job);
    tn_status status = tn_house_gallery_draw(&gallery, &(tn_picture){.path = sheet->output, .dpi = sheet->dpi}, error);
    free(houses);
    return status;
}

void tn_job_draw_houses(tn_job *job, const tn_house_settings *settings, const tn_house_sheet *sheet)
{
    tn_numbered n = {0};
    tn_error error = {0};
    if (tn_numbered_open(&n, job, settings)) {
        collection c = {.items = calloc(sheet->wanted + 1, sizeof *c.items), .room = sheet->wanted};
        tn_status status = c.items ? TN_OK : tn_fail_memory(&error);
        if (status == TN_OK)
            status = tn_numbered_sample(&n, NULL, sheet->wanted, sheet->seed, collect, &c, &error);
        char note[NOTE_SIZE];
        snprintf(note, sizeof note, "%zu house%s of %.100s, drawn with seed %" PRIu64 "; all to one scale", c.count,
                 c.count == 1 ? "" : "s", tn_text(job->opened.module, n.record->name), sheet->seed);
        if (status == TN_OK && c.count == 0)
            tn_job_note(job, "the library has no houses: nothing is drawn");
        else if (status == TN_OK)
            status = draw(&n, &c, sheet, note, &error);
        if (status != TN_OK)
            tn_job_fail(job, &error);
        for (size_t i = 0; i < c.count; i++) {
            tn_solids_clear(&c.items[i].solids);
            tn_house_clear(&c.items[i].house);
        }
        free(c.items);
    }
    tn_numbered_close(&n);
}
