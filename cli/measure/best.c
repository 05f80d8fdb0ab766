/* tartan best: the best plans of a library by measures, in order. */
#include <stdlib.h>

#include "cli/common/interrupt.h"
#include "cli/common/option_rows.h"
#include "cli/common/progress.h"
#include "cli/measure/wishes.h"
#include "cli/plan/plan_output.h"
#include "cli/plan/sheet.h"
#include "driver/open/digits.h"
#include "runtime/plan/measure/best.h"

enum { BEST_DEFAULT = 10, BEST_MAX = 1000000 };

typedef struct best_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_written_settings written;
    tn_option_list wanted; /* wishes */
    bool mirror;
} best_settings;

static const best_settings *settings_of(const tn_job *job)
{
    return (const best_settings *)job->settings;
}

/* Where the plans go: onto a sheet that is drawn, into lines with their values, JSON with them, or what `sample`
 * writes. */
typedef struct sink {
    tn_job *job;
    const tn_ready_library *ready;
    const tn_wishes *wishes;
    const tn_weighed *weighed;
    tn_plan_writer *writer; /* NULL: `output` */
    tn_output output;
    bool json, draws;
    tn_plan_sheet sheet;
    tn_buffer text;
    tn_buffer values; /* as text: many plans in a row have the same */
    int64_t written[TN_WEIGHED_MAX];
} sink;

static const char *measure_name(const sink *s, uint32_t k)
{
    const tn_module *module = s->ready->schema->module;
    return tn_text(module, module->MEASURE_records[s->wishes->measures[k]].name);
}

/* "3.  cost 87,880, area 304 ft2" */
static tn_status add_drawn(sink *s, const tn_tray *trays, uint32_t length, const int64_t *values, const mpz_t rank,
                           tn_error *error)
{
    tn_buffer caption = {0};
    bool ok = tn_buffer_printf(&caption, "%zu.  ", s->sheet.count + 1);
    for (uint32_t k = 0; ok && k < s->wishes->count; k++)
        ok = tn_buffer_printf(&caption, "%s%s ", k ? ", " : "", measure_name(s, k)) &&
             tn_wishes_text(s->wishes, s->weighed, k, values[k], &caption);
    if (ok)
        return tn_sheet_add(&s->sheet, trays, length, mpz_get_str(NULL, 10, rank), NULL, caption.data, error);
    free(caption.data);
    return tn_fail_memory(error);
}

static bool write_values(sink *s, const int64_t *values)
{
    bool list = s->wishes->count > 1;
    s->values.size = 0;
    bool ok = tn_buffer_printf(&s->values, s->json ? (list ? "{\"values\":[" : "{\"value\":") : "# ");
    for (uint32_t k = 0; ok && k < s->wishes->count; k++) {
        ok = k == 0 || tn_buffer_printf(&s->values, s->json ? "," : "  ");
        s->written[k] = values[k];
        if (!s->json) {
            ok = ok && tn_wishes_text(s->wishes, s->weighed, k, values[k], &s->values);
            continue;
        }
        ok = ok && tn_buffer_printf(&s->values, "\"") &&
             tn_wishes_exact(s->wishes, s->weighed, k, values[k], &s->values) && tn_buffer_printf(&s->values, "\"");
    }
    return ok && (!s->json || !list || tn_buffer_printf(&s->values, "]"));
}

static bool put_values(sink *s, const int64_t *values)
{
    bool same = s->values.size > 0;
    for (uint32_t k = 0; same && k < s->wishes->count; k++)
        same = values[k] == s->written[k];
    return (same || write_values(s, values)) && tn_buffer_append(&s->text, s->values.data, s->values.size);
}

static tn_status put_plan(sink *s, const tn_tray *trays, uint32_t length, const int64_t *values, const mpz_t rank,
                          tn_error *error)
{
    if (s->draws)
        return add_drawn(s, trays, length, values, rank, error);
    if (s->writer)
        return tn_plan_writer_write(s->writer, rank, trays, length, error);
    s->text.size = 0;
    char *digits = mpz_get_str(NULL, 10, rank);
    bool ok = digits && put_values(s, values);
    if (s->json)
        ok = ok && tn_buffer_printf(&s->text, ",\"rank\":\"%s\",\"trays\":", digits) &&
             tn_plan_write_trays(s->ready->schema, trays, length, &s->text) && tn_buffer_printf(&s->text, "}\n");
    else
        ok = ok && tn_buffer_printf(&s->text, "  rank %s\n", digits) &&
             tn_plan_write_line(s->ready->schema, trays, length, &s->text) && tn_buffer_printf(&s->text, "\n");
    free(digits);
    if (!ok)
        return tn_fail_memory(error);
    fwrite(s->text.data, 1, s->text.size, s->output.stream);
    return TN_OK;
}

/* A plan whose mirror image is kept and of lower rank is left out where pairs count once. */
static bool is_wanted(const sink *s, const tn_tray *trays, uint32_t length)
{
    return !settings_of(s->job)->mirror || tn_library_mirror_first(s->ready->library, trays, length);
}

static void give(sink *s, tn_best *best, uint64_t wanted)
{
    tn_error error;
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(s->ready->library) + 1));
    tn_status status = trays ? TN_OK : tn_fail_memory(&error);
    mpz_t rank;
    mpz_init(rank);
    bool found = true;
    tn_progress progress;
    tn_progress_watch(&progress, "looking for the best", tn_interrupt_waiting());
    for (uint64_t given = 0; status == TN_OK && found && given < wanted;) {
        int64_t values[TN_WEIGHED_MAX];
        uint32_t length;
        status = tn_best_next(best, trays, &length, values, &found, &error);
        if (given == 0) /* the first takes longest; from then on lines are written */
            tn_progress_unwatch(&progress, tn_interrupt_waiting());
        if (status != TN_OK || !found || !is_wanted(s, trays, length))
            continue;
        tn_library_rank(s->ready->library, trays, length, rank);
        status = put_plan(s, trays, length, values, rank, &error);
        given++;
    }
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    if (status != TN_OK)
        tn_job_fail(s->job, &error);
    mpz_clear(rank);
    free(trays);
}

enum { NOTES = 3, NOTE_SIZE = 256 };

/* "the 10 of 5,000 plans with the least cost, then most area" */
static bool write_aim(const sink *s, char *note)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(s->ready->library, TN_ALL_LENGTHS, kept);
    char *digits = tn_digits(kept, true);
    tn_buffer text = {0};
    bool ok = digits && tn_buffer_printf(&text, "the %zu of %s plans with the ", s->sheet.count, digits);
    for (uint32_t k = 0; ok && k < s->wishes->count; k++)
        ok = tn_buffer_printf(&text, "%s%s %s", k ? ", then the " : "", s->wishes->most[k] ? "most" : "least",
                              measure_name(s, k));
    if (ok)
        snprintf(note, NOTE_SIZE, "%s", text.data);
    free(text.data);
    free(digits);
    mpz_clear(kept);
    return ok;
}

static void draw_sheet(const sink *s)
{
    const tn_module *module = s->ready->schema->module;
    char aim[NOTE_SIZE] = "", hash[33], library[NOTE_SIZE], rules[NOTE_SIZE];
    const char *notes[NOTES] = {aim, library, rules};
    tn_error error;
    tn_library_hash(s->ready->library, hash);
    snprintf(library, sizeof library, "library %s", hash);
    tn_sheet_note_rules(s->job, rules, sizeof rules);
    const tn_draw_options options = {.title = tn_text(module, s->ready->record->name),
                                     .doc = tn_text(module, s->ready->record->doc),
                                     .number_name = "rank",
                                     .notes = notes,
                                     .note_count = NOTES};
    tn_status status = write_aim(s, aim) ? TN_OK : tn_fail_memory(&error);
    if (status == TN_OK)
        status = tn_plans_draw(s->ready->schema, s->sheet.plans, s->sheet.count, &options,
                               &(tn_picture){.path = settings_of(s->job)->written.output}, &error);
    if (status != TN_OK)
        tn_job_fail(s->job, &error);
}

/* A picture by its name; text goes out here, so that values can stand with the plans; the other formats as `sample`
 * writes them. */
static bool open_sink(sink *s, uint64_t wanted)
{
    const tn_written_settings *settings = &settings_of(s->job)->written;
    tn_plan_format format = (tn_plan_format)settings->format;
    s->draws = format == TN_FORMAT_AUTO && tn_job_draws(settings->output);
    if (s->draws && wanted > TN_DRAW_PLANS_DEFAULT) {
        tn_help(tn_job_diagnostics(s->job),
                tn_job_usage(s->job, "a picture shows at most %u plans", TN_DRAW_PLANS_DEFAULT),
                "ask for fewer, or write them to a file that is not a picture");
        return false;
    }
    s->json = format == TN_FORMAT_JSON;
    bool text = s->json || format == TN_FORMAT_LINES || (format == TN_FORMAT_AUTO && !settings->output);
    return s->draws || (text ? tn_job_output(s->job, settings->output, &s->output)
                             : tn_job_plan_writer(s->job, s->ready, settings, "best", &s->writer));
}

static void close_sink(sink *s)
{
    if (s->draws && s->job->exit_code == TN_EXIT_DONE)
        draw_sheet(s);
    else if (s->writer)
        tn_job_plan_close(s->job, s->writer);
    else if (!s->draws)
        tn_job_commit(s->job, &s->output);
}

static void find_best(tn_job *job, const tn_ready_library *ready, uint64_t wanted)
{
    tn_wishes wishes;
    tn_weighed *weighed = NULL;
    tn_best *best = NULL;
    tn_error error;
    if (!tn_wishes_read(job, ready, &settings_of(job)->wanted, 1, &wishes))
        return;
    tn_status status = tn_weighed_new(ready->library, wishes.measures, wishes.count, &weighed, &error);
    if (status == TN_OK)
        status = tn_best_new(weighed, wishes.most, &best, &error);
    sink s = {.job = job, .ready = ready, .wishes = &wishes, .weighed = weighed};
    tn_job_show(job);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
    } else if (open_sink(&s, wanted)) {
        give(&s, best, wanted);
        close_sink(&s);
    }
    tn_sheet_clear(&s.sheet);
    free(s.text.data);
    free(s.values.data);
    tn_best_free(best);
    tn_weighed_free(weighed);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const best_settings *settings = (const best_settings *)common;
    tn_job job;
    tn_ready_library ready = {0};
    uint64_t wanted = BEST_DEFAULT;
    tn_job_begin(&job, common);
    if (common->operands.count > 1 && (!tn_number_read(common->operands.items[1], &wanted) || wanted > BEST_MAX)) {
        tn_diagnostic *d = tn_job_usage(&job, "the number of plans is a number from 0 to %d, not `%.60s`", BEST_MAX,
                                        common->operands.items[1]);
        tn_help(tn_job_diagnostics(&job), d, "the file comes first: tartan best FILE N --least MEASURE");
    } else if (tn_job_library(&job, common->operands.items[0], &settings->plans, &ready)) {
        find_best(&job, &ready, wanted);
    }
    tn_library_close(&ready);
    return tn_job_end(&job);
}

#define SETTINGS best_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    WISH("least", wanted, "the plans with the least MEASURE first"),
    WISH("most", wanted, "the plans with the most MEASURE first"),
    WISH("then-least", wanted, "of equal ones those with the least of this measure; may be repeated"),
    WISH("then-most", wanted, "of equal ones those with the most of this measure; may be repeated"),
    FLAG("mirror", 0, mirror, "leave out a plan whose mirror image is kept and of lower rank"),
    OPTION_PLAN_FORMAT,
    TEXT("output", 'o', "FILE", written.output,
         "write to FILE instead of standard output; .sqlite and .db make a database, .svg, .png and .pdf a picture"),
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_best = {
    .name = "best",
    .summary = "write the best plans of a library by a measure",
    .usage = "FILE [N] --least MEASURE\nFILE [N] --most MEASURE [--then-least MEASURE]\nFILE [N] --least MEASURE -o "
             "SHEET.svg",
    .description =
        "Writes the N (10) plans of the library with the least or most of a measure, in order: by the measure, then by "
        "the measures named after it, then by rank. They are found from the library's automaton; no other plan is "
        "looked "
        "at. In lines, a comment before each plan has its values and its rank; in JSON, \"value\" or \"values\" has "
        "them exactly, in feet or metres. With -o and the name of a picture (.svg, .png or .pdf) the plans are drawn, "
        "each "
        "with its place and its values.",
    .example = "$ tartan best lahave-houses 12 --least cost --then-most daylight",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE and perhaps a number N",
    .operands_min = 1,
    .operands_max = 2,
    .run = run,
};
