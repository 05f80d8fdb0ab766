/* Draws sheets of plans, from a file or a library, and pictures of rules. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/plan/found.h"
#include "ask/session/questions.h"
#include "cli/draw/draw.h"
#include "cli/measure/best_sheet.h"
#include "cli/plan/sheet.h"
#include "driver/open/digits.h"
#include "runtime/base/picture.h"
#include "runtime/plan/picture/draw_rule.h"

static const tn_draw_settings *settings_of(const tn_job *job)
{
    return (const tn_draw_settings *)job->settings;
}

enum { NOTE_COUNT = 3, NOTE_SIZE = 256 };

/* A sheet being made. */
typedef struct sheet {
    tn_job *job;
    const tn_schema *schema;
    const tn_library_record *library; /* or NULL */
    const tn_ready_library *ready;    /* of plans that it was asked for */
    tn_plan_sheet drawn;
    bool ranked; /* numbers are ranks, not lines */
    char notes[NOTE_COUNT][NOTE_SIZE];
    size_t note_count;
} sheet;

size_t tn_draw_max_plans(const tn_draw_settings *settings)
{
    return settings->max_plans.given ? (size_t)settings->max_plans.value : TN_DRAW_PLANS_DEFAULT;
}

/* The number below a plan that was read: its rank where the file gives one, otherwise its line. */
static char *number_of(sheet *s, const tn_plan_reader *reader)
{
    char *text = NULL;
    mpz_t rank;
    mpz_init(rank);
    if (s->drawn.count == 0)
        s->ranked = tn_plan_reader_rank(reader, rank);
    if (s->ranked && tn_plan_reader_rank(reader, rank)) {
        text = mpz_get_str(NULL, 10, rank);
    } else {
        char line[24];
        snprintf(line, sizeof line, "%" PRIu64, tn_plan_reader_line(reader));
        text = strdup(line);
    }
    mpz_clear(rank);
    return text;
}

/* Reads the plans, one more than the limit at most, which drawing then refuses. False where the sheet is not to be
 * drawn. */
static bool read_plans(sheet *s, const char *path)
{
    tn_plan_reader *reader;
    const tn_plan *plan;
    tn_error error;
    const tn_draw_settings *settings = settings_of(s->job);
    const tn_plans_source source = {path, &settings->input, &settings->plans};
    bool going = tn_job_reader(s->job, s->schema, &source, &reader);
    if (!going)
        return false;
    while (going && s->drawn.count <= tn_draw_max_plans(settings)) {
        tn_status status = tn_plan_reader_next(reader, &plan, &error);
        if (status == TN_OK && !plan)
            break;
        if (status == TN_OK)
            status = tn_sheet_add(&s->drawn, plan->trays, plan->length, number_of(s, reader), NULL, NULL, &error);
        else if (error.line > 0) {
            size_t size = 0;
            const char *text = tn_plan_reader_text(reader, &size);
            going = tn_job_bad_plan(s->job, &source, &error, text, size);
            continue;
        }
        if (status != TN_OK) {
            tn_job_fail(s->job, &error);
            going = false;
        }
    }
    tn_plan_reader_free(reader);
    snprintf(s->notes[s->note_count++], NOTE_SIZE, "%zu plan%s from %s", s->drawn.count, s->drawn.count == 1 ? "" : "s",
             strcmp(path, "-") == 0 ? "standard input" : path);
    return going;
}

/* ---- plans that the library is asked for */

static bool take_library(void *context, tn_found_of *of)
{
    sheet *s = context;
    s->ready = of->plans;
    s->schema = of->plans->schema;
    s->library = of->plans->record;
    return true;
}

static bool take_plan(void *context, const tn_found_one *found)
{
    sheet *s = context;
    tn_error error;
    tn_status status =
        tn_sheet_add(&s->drawn, found->trays, found->length, mpz_get_str(NULL, 10, found->rank), NULL, NULL, &error);
    if (status != TN_OK)
        tn_job_fail(s->job, &error);
    return status == TN_OK;
}

static void note_library(sheet *s)
{
    char hash[33];
    tn_library_hash(s->ready->library, hash);
    snprintf(s->notes[s->note_count++], NOTE_SIZE, "library %s", hash);
}

static void note_sample(sheet *s)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(s->ready->library, TN_ALL_LENGTHS, kept);
    char *digits = tn_digits(kept, true);
    snprintf(s->notes[s->note_count++], NOTE_SIZE, "%zu of %s plans, drawn with seed %" PRIu64, s->drawn.count,
             digits ? digits : "?", settings_of(s->job)->seed.value);
    free(digits);
    mpz_clear(kept);
}

static bool sample_plans(sheet *s)
{
    const tn_draw_settings *settings = settings_of(s->job);
    const tn_taker taker = {take_library, take_plan, s};
    const tn_sample_request request = {.subject = tn_job_asked(&settings->plans),
                                       .has_count = settings->sample.given,
                                       .count = settings->sample.value,
                                       .seed = settings->seed.value,
                                       .has_length = settings->length.given,
                                       .length = settings->length.value,
                                       .has_per_length = settings->per_length.given,
                                       .per_length = settings->per_length.value,
                                       .diverse = settings->diverse};
    tn_reply answer;
    s->job->session.taker = &taker;
    bool drawn = tn_job_answered(s->job, tn_ask_sample(&s->job->session, &request, &answer)) && s->ready &&
                 s->job->exit_code == TN_EXIT_DONE;
    s->job->session.taker = NULL;
    tn_reply_clear(&answer);
    if (drawn)
        note_sample(s);
    return drawn;
}

static bool best_plans(sheet *s)
{
    const tn_draw_settings *settings = settings_of(s->job);
    tn_best_sheet best = {0};
    tn_wished wished;
    if (!tn_job_wishes(s->job, &settings->wanted, 1, &wished))
        return false;
    const tn_best_request request = {.subject = tn_job_asked(&settings->plans),
                                     .by = {wished.items, wished.count},
                                     .has_count = true,
                                     .count = settings->best.value,
                                     .mirror = settings->mirror};
    bool found =
        tn_job_best_sheet(s->job, &request, &best) && tn_best_sheet_aim(&best, s->notes[s->note_count++], NOTE_SIZE);
    s->drawn = best.drawn;
    if (found)
        take_library(s, &(tn_found_of){.plans = best.ready});
    return found;
}

static void draw_sheet(sheet *s)
{
    const tn_draw_settings *settings = settings_of(s->job);
    const tn_module *module = s->job->opened.module;
    const char *notes[NOTE_COUNT];
    tn_error error;
    tn_sheet_note_rules(s->job, s->notes[s->note_count++], NOTE_SIZE);
    for (size_t i = 0; i < s->note_count; i++)
        notes[i] = s->notes[i];
    tn_string name = s->library ? s->library->name : s->schema->record->name,
              doc = s->library ? s->library->doc : s->schema->record->doc;
    tn_draw_options options = {.title = settings->title ? settings->title : tn_text(module, name),
                               .doc = doc ? tn_text(module, doc) : NULL,
                               .number_name = s->ranked ? "rank" : "line",
                               .notes = notes,
                               .note_count = s->note_count,
                               .paper = settings->paper,
                               .scale = (uint32_t)settings->scale.value,
                               .columns = (uint32_t)settings->columns.value,
                               .dpi = (uint32_t)settings->dpi.value,
                               .max_plans = tn_draw_max_plans(settings)};
    tn_job_show(s->job);
    if (tn_plans_draw(s->schema, s->drawn.plans, s->drawn.count, &options, &(tn_picture){.path = settings->output},
                      &error) != TN_OK)
        tn_job_fail(s->job, &error);
}

/* Plans that the library is asked for: its best ones, or a sample. */
void tn_job_draw_library(tn_job *job)
{
    sheet s = {.job = job, .ranked = true};
    if (!tn_job_open_plans(job, job->settings->operands.items[0], &settings_of(job)->plans))
        return;
    if (settings_of(job)->best.given ? best_plans(&s) : sample_plans(&s)) {
        note_library(&s);
        draw_sheet(&s);
    }
    tn_sheet_clear(&s.drawn);
}

void tn_job_draw_file(tn_job *job, const char *path)
{
    tn_schema *schema = NULL;
    uint32_t index, library = UINT32_MAX;
    tn_error error;
    if (!job->opened.module && !tn_job_open(job, job->settings->operands.items[0]))
        return;
    tn_status status = tn_schema_choose(&job->opened, settings_of(job)->plans.library, &index, &library);
    tn_job_status(job, status);
    if (status != TN_OK)
        return;
    if (tn_schema_new(job->opened.module, index, 0, &schema, &error) == TN_OK) {
        sheet s = {.job = job, .schema = schema};
        if (library != UINT32_MAX)
            s.library = &job->opened.module->LIBRARY_records[library];
        if (read_plans(&s, path)) {
            if (s.drawn.count == 0 && job->exit_code == TN_EXIT_DONE)
                tn_job_note(job, "no plans came from %.200s: the sheet is empty",
                            strcmp(path, "-") == 0 ? "standard input" : path);
            draw_sheet(&s);
        }
        tn_sheet_clear(&s.drawn);
    } else {
        tn_job_fail(job, &error);
    }
    tn_schema_free(schema);
}

/* Rules rather than plans: one picture of those asked for, which are about the same trays. */
void tn_job_draw_rules(tn_job *job)
{
    const tn_option_list *asked = &settings_of(job)->rules;
    tn_schema *schema = NULL;
    tn_error error;
    if (!tn_job_open(job, job->settings->operands.items[0]))
        return;
    const tn_module *module = job->opened.module;
    tn_drawn_rule *rules = malloc(sizeof *rules * (asked->count + 1));
    tn_status status = rules ? TN_OK : tn_fail_memory(&error);
    uint32_t trays = 0;
    for (size_t i = 0; status == TN_OK && i < asked->count; i++) {
        uint32_t rule;
        status = tn_rule_choose(&job->opened, asked->items[i], &rule);
        tn_job_status(job, status);
        if (status != TN_OK)
            break;
        rules[i] = tn_drawn_rule_of(module, rule);
        if (i > 0 && module->RULE_records[rule].schema != trays) {
            tn_job_usage(job, "the rules of one picture are about the same trays");
            status = TN_INVALID;
        }
        trays = module->RULE_records[rule].schema;
    }
    if (status == TN_OK) {
        status = tn_schema_new(module, trays, 0, &schema, &error);
        tn_picture to = {.path = settings_of(job)->output, .dpi = (uint32_t)settings_of(job)->dpi.value};
        if (status == TN_OK)
            status = tn_rules_draw(schema, rules, asked->count, &to, &error);
        if (status != TN_OK)
            tn_job_fail(job, &error);
    }
    if (!rules)
        tn_job_fail(job, &error);
    tn_schema_free(schema);
    free(rules);
}
