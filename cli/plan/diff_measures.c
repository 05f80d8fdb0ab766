/* Compares the measures of two libraries. */
#include "cli/plan/diff_measures.h"

#include <stdlib.h>
#include <string.h>

#include "driver/open/findings.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/moments.h"

enum { BEFORE, AFTER, SIDES };
enum { LEAST, MEAN, MOST, NUMBERS };

static const char *const number_names[NUMBERS] = {"least", "mean", "most"};

typedef struct change {
    const char *name;
    tn_amount_unit unit[SIDES];
    tn_measure_moments moments[SIDES];
} change;

struct tn_measure_changes {
    change *items;
    size_t count;
};

/* The measure of that name over the library's trays, or TN_NO_RECORD. */
static uint32_t measure_named(const tn_ready_library *ready, const char *name)
{
    const tn_module *module = ready->schema->module;
    for (uint32_t i = 0; i < module->MEASURE_count; i++)
        if (module->MEASURE_records[i].schema == ready->record->schema &&
            strcmp(tn_text(module, module->MEASURE_records[i].name), name) == 0)
            return i;
    return TN_NO_RECORD;
}

static tn_status find_side(const tn_ready_library *ready, uint32_t measure, change *c, int side, tn_error *error)
{
    const tn_module *module = ready->schema->module;
    tn_weighed *weighed = NULL;
    c->unit[side] = tn_amount_unit_of(ready->schema, module->SUM_records[module->MEASURE_records[measure].sum].power);
    tn_status status = tn_weighed_new(ready->library, &measure, 1, &weighed, error);
    if (status == TN_OK)
        status = tn_measure_moments_find(&c->moments[side], weighed, error);
    tn_weighed_free(weighed);
    return status;
}

static void change_clear(change *c)
{
    for (int side = 0; side < SIDES; side++)
        tn_measure_moments_clear(&c->moments[side]);
}

static tn_status find_change(tn_job *job, const tn_compared *compared, uint32_t before, uint32_t after,
                             tn_measure_changes *changes, tn_error *error)
{
    const tn_module *module = compared->before->schema->module;
    change *c = &changes->items[changes->count];
    *c = (change){.name = tn_text(module, module->MEASURE_records[before].name)};
    for (int side = 0; side < SIDES; side++)
        tn_measure_moments_init(&c->moments[side]);
    tn_status status = find_side(compared->before, before, c, BEFORE, error);
    if (status == TN_OK)
        status = find_side(compared->after, after, c, AFTER, error);
    if (status == TN_OK) {
        changes->count++;
        return TN_OK;
    }
    change_clear(c);
    if (status != TN_LIMIT)
        return status;
    tn_job_note(job, "the measure `%s` is not compared: %s", c->name, error->message);
    return TN_OK;
}

tn_status tn_measure_changes_find(tn_job *job, const tn_compared *compared, tn_measure_changes **out, tn_error *error)
{
    const tn_module *module = compared->before->schema->module;
    tn_measure_changes *changes = calloc(1, sizeof *changes);
    *out = changes;
    if (changes)
        changes->items = calloc((size_t)module->MEASURE_count + 1, sizeof *changes->items);
    tn_status status = changes && changes->items ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < module->MEASURE_count; i++) {
        uint32_t after = measure_named(compared->after, tn_text(module, module->MEASURE_records[i].name));
        if (module->MEASURE_records[i].schema == compared->before->record->schema && after != TN_NO_RECORD)
            status = find_change(job, compared, i, after, changes, error);
    }
    return status;
}

void tn_measure_changes_free(tn_measure_changes *changes)
{
    if (!changes)
        return;
    for (size_t i = 0; i < changes->count; i++)
        change_clear(&changes->items[i]);
    free(changes->items);
    free(changes);
}

static mpq_srcptr number_of(const change *c, int side, int number)
{
    const tn_measure_moments *m = &c->moments[side];
    return number == LEAST ? m->least : number == MEAN ? m->mean : m->most;
}

/* ---- text */

static bool write_number(const change *c, int side, int number, tn_buffer *text)
{
    if (mpz_sgn(c->moments[side].plans) == 0)
        return tn_buffer_printf(text, "-");
    if (number != MEAN)
        return tn_amount_write(c->unit[side], number_of(c, side, number), text);
    mpq_t mean;
    mpq_init(mean);
    mpq_set(mean, number_of(c, side, number));
    tn_amount_convert(c->unit[side], mean);
    bool ok = tn_amount_write_about(c->unit[side], mean, text);
    mpq_clear(mean);
    return ok;
}

/* "115.2 m2 -> 118.8 m2", or one of them where both are the same. */
static bool write_cell(const change *c, int number, tn_buffer *text)
{
    tn_buffer after = {0};
    bool ok = write_number(c, BEFORE, number, text) && write_number(c, AFTER, number, &after);
    if (ok && strcmp(text->data, after.data) != 0)
        ok = tn_buffer_printf(text, " -> %s", after.data);
    free(after.data);
    return ok;
}

static size_t cell_width(const tn_measure_changes *changes, int number)
{
    size_t width = strlen(number_names[number]);
    for (size_t i = 0; i < changes->count; i++) {
        tn_buffer text = {0};
        if (write_cell(&changes->items[i], number, &text) && text.size > width)
            width = text.size;
        free(text.data);
    }
    return width;
}

bool tn_measure_changes_write(const tn_measure_changes *changes, FILE *out)
{
    size_t names = strlen("measure"), widths[NUMBERS];
    bool ok = true;
    if (!changes || changes->count == 0)
        return true;
    for (size_t i = 0; i < changes->count; i++)
        names = strlen(changes->items[i].name) > names ? strlen(changes->items[i].name) : names;
    fprintf(out, "\n%-*s", (int)names, "measure");
    for (int n = 0; n < NUMBERS; n++) {
        widths[n] = cell_width(changes, n);
        fprintf(out, "  %*s", (int)widths[n], number_names[n]);
    }
    fputc('\n', out);
    for (size_t i = 0; ok && i < changes->count; i++) {
        fprintf(out, "%-*s", (int)names, changes->items[i].name);
        for (int n = 0; ok && n < NUMBERS; n++) {
            tn_buffer text = {0};
            ok = write_cell(&changes->items[i], n, &text);
            fprintf(out, "  %*s", (int)widths[n], text.data ? text.data : "");
            free(text.data);
        }
        fputc('\n', out);
    }
    return ok;
}

/* ---- JSON */

static void side_json(const change *c, const char *key, int side, tn_json *json)
{
    tn_json_object(json, key);
    for (int n = 0; n < NUMBERS; n++) {
        tn_buffer text = {0};
        bool any = mpz_sgn(c->moments[side].plans) > 0;
        if (any && !tn_amount_write_exact(c->unit[side], number_of(c, side, n), &text))
            json->text->failed = true;
        tn_json_string(json, number_names[n], any ? text.data : NULL);
        free(text.data);
    }
    tn_json_object_end(json);
}

void tn_measure_changes_json(const tn_measure_changes *changes, tn_json *json)
{
    tn_json_list(json, "measures");
    for (size_t i = 0; changes && i < changes->count; i++) {
        const change *c = &changes->items[i];
        tn_json_object(json, NULL);
        tn_json_string(json, "name", c->name);
        tn_json_string(json, "unit", tn_amount_unit_name(c->unit[BEFORE]));
        side_json(c, "before", BEFORE, json);
        side_json(c, "after", AFTER, json);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}
