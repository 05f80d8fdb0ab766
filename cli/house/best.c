/* best, pareto and complete of houses: values, the houses that have them, and what open plans leave. */
#include "cli/house/best_parts.h"

#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "driver/open/digits.h"
#include "driver/plan/library.h"
#include "runtime/house/rank/rank.h"

const char *tn_best_houses_measure(const tn_best_houses *s, uint32_t k)
{
    return tn_text(s->n.form.module, s->weights[k]->of.name);
}

static tn_status find_measures(tn_best_houses *s, tn_error *error)
{
    const tn_module *module = s->n.form.module;
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < s->wishes->count; k++) {
        uint32_t measure;
        status =
            tn_house_measure_choose(&tn_numbered_job(&s->n)->opened, s->wishes->names[k], s->n.record->form, &measure);
        tn_job_status(tn_numbered_job(&s->n), status);
        if (status != TN_OK)
            return status;
        tn_house_measured of = tn_house_measured_of(module, measure);
        status = tn_house_weights_new(&s->n.form, of, &s->weights[k], error);
        if (status != TN_OK)
            tn_job_fail(tn_numbered_job(&s->n), error);
        s->units[k] = tn_amount_unit_of(s->n.schema, module->SUM_records[of.sum].power);
        s->measures.of[k] = s->weights[k];
        s->measures.most[k] = s->wishes->most[k];
    }
    s->measures.count = s->wishes->count;
    return status;
}

static tn_status find_values(tn_best_houses *s, tn_houses_aim aim, tn_error *error)
{
    const tn_house_wishes *wishes = s->wishes;
    tn_houses_what what = {.measures = wishes->count ? &s->measures : NULL, .aim = aim, .wanted = wishes->wanted};
    tn_progress progress;
    if (wishes->plan) {
        what.only = s->plan.trays;
        what.length = (uint32_t)s->plan.length;
    }
    tn_progress_watch(&progress, "looking for the best", tn_interrupt_waiting());
    tn_status status = tn_houses_of(&s->n.form, s->n.record, s->n.plans, &what, s->n.max_states, &s->houses, error);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    return status;
}

bool tn_best_houses_begin(tn_best_houses *s, tn_job *job, const tn_house_settings *settings,
                          const tn_house_wishes *wishes, tn_houses_aim aim)
{
    tn_error error = {0};
    *s = (tn_best_houses){.wishes = wishes};
    mpz_init(s->count);
    if (!tn_job_numbered(job, &s->n, settings))
        return false;
    tn_status status =
        wishes->plan ? tn_numbered_plan(&s->n, wishes->plan, settings->max_length, &s->plan, &error) : TN_OK;
    if (status != TN_OK) {
        tn_job_bad_text(job, &error, "PLAN", wishes->plan);
        return false;
    }
    if (find_measures(s, &error) != TN_OK)
        return false;
    status = find_values(s, aim, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

void tn_best_houses_end(tn_best_houses *s)
{
    tn_houses_free(s->houses);
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        tn_house_weights_free(s->weights[k]);
    free(s->plan.trays);
    tn_numbered_close(&s->n);
    mpz_clear(s->count);
}

/* ---- values */

bool tn_best_houses_value(const tn_best_houses *s, uint32_t k, bool exact, tn_buffer *text)
{
    mpq_t value;
    mpq_init(value);
    mpq_set_si(value, s->values[k], 1);
    mpq_mul(value, value, s->weights[k]->shown);
    bool ok = (exact ? tn_amount_write_exact : tn_amount_write)(s->units[k], value, text);
    mpq_clear(value);
    return ok;
}

/* "value":"3/2" or "values":["3/2","4"]; false where out of memory. */
static bool write_json_values(const tn_best_houses *s, bool list, tn_json *json)
{
    tn_buffer value = {0};
    bool ok = true;
    if (list)
        tn_json_list(json, "values");
    for (uint32_t k = 0; ok && k < s->wishes->count; k++) {
        value.size = 0;
        ok = tn_best_houses_value(s, k, true, &value);
        tn_json_bytes(json, list ? NULL : "value", value.data, value.size);
    }
    if (list)
        tn_json_list_end(json);
    free(value.data);
    return ok;
}

static tn_status put(const tn_best_houses *s, tn_buffer *text, bool ok, tn_error *error)
{
    if (ok)
        fwrite(text->data, 1, text->size, s->out); /* a failure is said when the output is closed */
    free(text->data);
    return ok ? TN_OK : tn_fail_memory(error);
}

/* ---- best */

static bool best_json(const tn_best_houses *s, const char *line, tn_buffer *text)
{
    tn_json json = tn_json_text(text, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    bool ok = write_json_values(s, s->wishes->count > 1, &json);
    tn_json_string(&json, "house", line);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
    return ok && !text->failed;
}

static bool best_text(const tn_best_houses *s, const char *line, tn_buffer *text)
{
    bool ok = tn_buffer_printf(text, "# ");
    for (uint32_t k = 0; ok && k < s->wishes->count; k++)
        ok = tn_buffer_printf(text, k ? "  " : "") && tn_best_houses_value(s, k, false, text);
    return ok && tn_buffer_printf(text, "\n%s\n", line);
}

static tn_status write_best(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    tn_best_houses *s = context;
    tn_buffer text = {0}, line = {0};
    tn_status status = tn_house_write(house, &line, error);
    bool ok = status == TN_OK && (s->wishes->json ? best_json(s, line.data, &text) : best_text(s, line.data, &text));
    free(line.data);
    *stop = ++s->given == s->wishes->wanted;
    tn_status written = put(s, &text, ok, error);
    return status == TN_OK ? written : status;
}

/* Whoever gets the houses that were found gets them judged. */
typedef struct judged {
    tn_numbered *n;
    tn_house_each *each;
    void *context;
} judged;

static tn_status judge_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    judged *j = context;
    tn_status status = tn_numbered_judge(j->n, house, error);
    return status == TN_OK ? j->each(j->context, house, stop, error) : status;
}

static tn_status each_of_point(tn_best_houses *s, size_t point, tn_house_each *each, void *context, tn_error *error)
{
    judged j = {.n = &s->n, .each = each, .context = context};
    return tn_houses_point_each(s->houses, point, s->n.variants, judge_house, &j, error);
}

tn_status tn_best_houses_each(tn_best_houses *s, tn_house_each *each, void *context, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && s->given < s->wishes->wanted && i < tn_houses_points(s->houses); i++) {
        tn_houses_point(s->houses, i, s->values, s->count);
        status = each_of_point(s, i, each, context, error);
    }
    return status;
}

static tn_status write_houses(tn_best_houses *s, tn_error *error)
{
    return tn_best_houses_each(s, write_best, s, error);
}

/* Was it written? */
static bool write_found(tn_best_houses *s, tn_status write(tn_best_houses *s, tn_error *error))
{
    tn_error error = {0};
    tn_output out;
    if (!tn_job_output(tn_numbered_job(&s->n), s->wishes->output, &out))
        return false;
    s->out = out.stream;
    tn_status status = write(s, &error);
    if (status != TN_OK)
        tn_job_fail(tn_numbered_job(&s->n), &error);
    tn_job_close(tn_numbered_job(&s->n), &out, status == TN_OK);
    return status == TN_OK;
}

void tn_job_best_houses(tn_job *job, const tn_house_settings *settings, const tn_house_wishes *wishes)
{
    tn_best_houses s;
    if (tn_best_houses_begin(&s, job, settings, wishes, TN_HOUSES_LEAST) && write_found(&s, write_houses))
        tn_numbered_say_few(&s.n, wishes->plan != NULL, s.given, wishes->wanted);
    tn_best_houses_end(&s);
}

/* ---- the front */

static tn_status take_line(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    *stop = true;
    return tn_house_write(house, context, error);
}

static bool point_json(const tn_best_houses *s, const char *line, tn_json *json)
{
    tn_json_object(json, NULL);
    bool ok = write_json_values(s, true, json);
    tn_json_digits(json, "houses", s->count);
    tn_json_string(json, "house", line);
    tn_json_object_end(json);
    return ok;
}

static bool point_text(const tn_best_houses *s, const char *line, FILE *out)
{
    tn_buffer value = {0};
    char *count = tn_digits(s->count, true);
    bool ok = count != NULL;
    for (uint32_t k = 0; ok && k < s->wishes->count; k++) {
        value.size = 0;
        ok = tn_best_houses_value(s, k, false, &value);
        fprintf(out, "%18s", ok ? value.data : "");
    }
    if (ok)
        fprintf(out, "  %20s  %s\n", count, line);
    free(count);
    free(value.data);
    return ok;
}

/* As JSON, or as a line of a table where `json` is NULL. */
static tn_status write_point(tn_best_houses *s, size_t point, tn_json *json, tn_error *error)
{
    tn_buffer line = {0};
    tn_houses_point(s->houses, point, s->values, s->count);
    tn_status status = each_of_point(s, point, take_line, &line, error);
    if (status == TN_OK && !(json ? point_json(s, line.data, json) : point_text(s, line.data, s->out)))
        status = tn_fail_memory(error);
    free(line.data);
    return status;
}

static tn_status front_json(tn_best_houses *s, tn_error *error)
{
    tn_status status = TN_OK;
    tn_json json = tn_json_file(s->out, TN_JSON_LINES);
    json.layout.lines = 1;
    tn_json_object(&json, NULL);
    tn_json_list(&json, "measures");
    for (uint32_t k = 0; k < s->wishes->count; k++)
        tn_json_string(&json, NULL, tn_best_houses_measure(s, k));
    tn_json_list_end(&json);
    json.layout.lines = 2;
    tn_json_list(&json, "points");
    for (size_t i = 0; status == TN_OK && i < tn_houses_points(s->houses); i++)
        status = write_point(s, i, &json, error);
    tn_json_list_end(&json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
    return status;
}

static tn_status front_text(tn_best_houses *s, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t k = 0; k < s->wishes->count; k++)
        fprintf(s->out, "%18s", tn_best_houses_measure(s, k));
    fprintf(s->out, "  %20s  %s\n", "houses", "the first of them");
    for (size_t i = 0; status == TN_OK && i < tn_houses_points(s->houses); i++)
        status = write_point(s, i, NULL, error);
    return status;
}

static tn_status write_front(tn_best_houses *s, tn_error *error)
{
    return s->wishes->json ? front_json(s, error) : front_text(s, error);
}

void tn_job_front_of_houses(tn_job *job, const tn_house_settings *settings, const tn_house_wishes *wishes)
{
    tn_best_houses s;
    if (tn_best_houses_begin(&s, job, settings, wishes, TN_HOUSES_FRONT))
        write_found(&s, write_front);
    tn_best_houses_end(&s);
}

/* ---- open plans */

void tn_job_complete_houses(tn_job *job, const tn_house_settings *settings, const tn_house_wishes *wishes,
                            const tn_open_plan *open, void show(tn_job *job, const tn_house_completed *completed))
{
    tn_best_houses s;
    tn_completions found = {0};
    tn_error error = {0};
    bool begun = tn_best_houses_begin(&s, job, settings, wishes, TN_HOUSES_COMPLETE);
    tn_status status = begun ? tn_houses_complete(s.houses, open, &found, &error) : TN_OK;
    if (status != TN_OK)
        tn_job_fail(job, &error);
    tn_house_completed completed = {.schema = s.n.schema, .library = s.n.record, .open = open, .found = &found};
    if (wishes->count && s.weights[0]) {
        completed.measure = tn_best_houses_measure(&s, 0);
        completed.most = wishes->most[0];
        completed.step = s.weights[0]->shown;
        completed.unit = s.units[0];
    }
    if (begun && status == TN_OK)
        show(job, &completed);
    if (begun)
        tn_completions_clear(&found);
    tn_best_houses_end(&s);
}
