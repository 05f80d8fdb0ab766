/* Lists the buildings of a kit's parts. */
#include "cli/place/enumerate_kit.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "runtime/base/formats.h"
#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "runtime/base/json.h"
#include "runtime/place/count/list.h"
#include "runtime/place/write.h"

typedef enum building_format { AS_LINES, AS_JSON, AS_SUBFILES } building_format;

typedef struct enumeration {
    const tn_module *module;
    building_format format;
    uint64_t rank, from, to, most, written; /* rank: of the next; from, to: those that are written */
    bool enough;
    FILE *out;
    tn_progress progress;
} enumeration;

/* ---- one building */

static void write_line(const enumeration *e, const tn_placed_model *model)
{
    for (size_t i = 0; i < model->count; i++) {
        fprintf(e->out, "%s%s ", i ? "; " : "", model->parts[i].name);
        tn_place_write_at(e->module, &model->parts[i].frame, " ", e->out);
        fprintf(e->out, " %" PRIu32, model->parts[i].frame.heading);
    }
    putc('\n', e->out);
}

static void write_json(const enumeration *e, const tn_placed_model *model)
{
    tn_json json = tn_json_file(e->out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_count(&json, "building", e->rank);
    tn_json_list(&json, "parts");
    for (size_t i = 0; i < model->count; i++) {
        double at[3];
        tn_json_object(&json, NULL);
        tn_json_string(&json, "part", model->parts[i].name);
        tn_place_at(e->module, &model->parts[i].frame, at);
        tn_json_numbers(&json, "at", at, 3);
        tn_json_count(&json, "turn", model->parts[i].frame.heading);
        tn_json_object_end(&json);
    }
    tn_json_list_end(&json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

static void write_subfile(const enumeration *e, const tn_placed_model *model)
{
    fprintf(e->out, "0 FILE building-%" PRIu64 ".ldr\n0 building %" PRIu64 "\n", e->rank, e->rank);
    tn_place_write_ldraw(e->module, model, NULL, e->out);
}

/* ---- all of them */

static tn_status write_building(void *context, const tn_placed_model *model, tn_error *error)
{
    enumeration *e = context;
    e->enough = e->rank >= e->to || e->written >= e->most || ferror(e->out);
    if (e->enough)
        return tn_fail(error, TN_STOPPED, TN_CODE_NONE, "all that were asked for are written");
    if (e->rank >= e->from) {
        (e->format == AS_JSON ? write_json : e->format == AS_LINES ? write_line : write_subfile)(e, model);
        e->written++;
    }
    e->rank++;
    tn_progress_update(&e->progress, (double)e->rank);
    return TN_OK;
}

/* Ranks past 2^64 are past the last: so many buildings nobody lists. */
static uint64_t rank_of(const char *digits, uint64_t otherwise)
{
    if (!digits)
        return otherwise;
    errno = 0;
    unsigned long long rank = strtoull(digits, NULL, 10);
    return errno == ERANGE ? UINT64_MAX : rank;
}

static bool begin(tn_job *job, bool json, const tn_building_range *range, const char *path, enumeration *e)
{
    tn_file_format format = path ? tn_file_format_of(path) : TN_FILE_OTHER;
    bool subfiles = format == TN_FILE_MPD || format == TN_FILE_LDR;
    *e = (enumeration){.module = job->opened.module,
                       .format = subfiles ? AS_SUBFILES
                                 : json   ? AS_JSON
                                          : AS_LINES,
                       .from = rank_of(range->from, 0),
                       .to = rank_of(range->to, UINT64_MAX),
                       .most = range->limit.given ? range->limit.value : UINT64_MAX};
    if (subfiles && json) {
        tn_job_usage(job, "%.200s has a sub-file for each building: leave out --format", path);
        return false;
    }
    if (e->from <= e->to)
        return true;
    tn_diagnostic *d = tn_job_usage(job, "no rank is from %.60s on and before %.60s", range->from, range->to);
    tn_help(tn_job_diagnostics(job), d, "write the smaller rank after --from");
    return false;
}

static tn_status list(enumeration *e, const tn_building_list *asked, bool shows, tn_error *error)
{
    tn_progress_begin(&e->progress, "buildings", 0, e->to < UINT64_MAX ? (double)e->to : 0);
    e->progress.shows = e->progress.shows && shows;
    tn_status status = tn_list_buildings(asked, tn_interrupt_waiting(), error);
    tn_progress_end(&e->progress);
    return e->enough ? TN_OK : status;
}

/* What was written stays, and how to go on is said. */
static void end(tn_job *job, const enumeration *e)
{
    if (tn_interrupted()) {
        tn_interrupt_answered();
        tn_job_interrupted(job,
                           "interrupted; %" PRIu64 " buildings are written, and --from %" PRIu64 " goes on after them",
                           e->written, e->rank > e->from ? e->rank : e->from);
    } else if (e->written == 0 && !e->enough) {
        tn_job_note(job, "there are %" PRIu64 " buildings, none of them from rank %" PRIu64 " on", e->rank, e->from);
    }
}

void tn_job_enumerate_kit(tn_job *job, const tn_kit_options *options, bool json, const tn_building_range *range,
                          const char *path)
{
    tn_place_rules rules = {.module = job->opened.module};
    tn_output output;
    tn_error error = {0};
    enumeration e;
    const tn_kit_asked what = tn_kit_options_ask(options);
    bool *wanted;
    if (!begin(job, json, range, path, &e) || !tn_job_answered(job, tn_kit_asked_parts(&job->session, &what, &wanted)))
        return;
    bool spaced = !options->inside || tn_job_answered(job, tn_kit_asked_space(&job->session, options->inside, &rules));
    if (spaced && tn_job_output(job, path, &output)) {
        const tn_building_list asked = {.rules = &rules,
                                        .wanted = wanted,
                                        .parts = (uint32_t)options->parts.value,
                                        .kind = options->inside  ? TN_BUILDINGS_INSIDE
                                                : options->fixed ? TN_BUILDINGS_FIXED
                                                                 : TN_BUILDINGS_TURNED,
                                        .visit = write_building,
                                        .context = &e};
        bool to_stdout = !path || strcmp(path, "-") == 0;
        e.out = output.stream;
        tn_job_show(job);
        tn_status status = list(&e, &asked, !(to_stdout && isatty(STDOUT_FILENO)), &error);
        bool kept = status == TN_OK || tn_interrupted();
        if (!kept)
            tn_job_fail(job, &error);
        tn_job_close(job, &output, kept);
        if (kept)
            end(job, &e);
    }
    if (options->inside && spaced)
        tn_place_rules_clear(&rules);
    free(wanted);
}
