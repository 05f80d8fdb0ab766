/* Lists the buildings of a kit's parts. */
#include "cli/place/enumerate_kit.h"

#include <inttypes.h>
#include <string.h>
#include <unistd.h>

#include "ask/place/buildings.h"
#include "ask/session/questions.h"
#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "runtime/base/formats.h"
#include "runtime/base/json.h"
#include "runtime/place/write.h"

typedef enum building_format { AS_LINES, AS_JSON, AS_SUBFILES } building_format;

typedef struct enumeration {
    tn_job *job;
    const tn_module *module;
    const char *path;
    building_format format;
    uint64_t next, written; /* next: the rank after those that were listed, or the first that is asked for */
    bool begun;
    tn_output output;
    tn_progress progress;
} enumeration;

/* ---- one building */

static void write_line(const enumeration *e, uint64_t rank, const tn_placed_model *model)
{
    FILE *out = e->output.stream;
    (void)rank;
    for (size_t i = 0; i < model->count; i++) {
        fprintf(out, "%s%s ", i ? "; " : "", model->parts[i].name);
        tn_place_write_at(e->module, &model->parts[i].frame, " ", out);
        fprintf(out, " %" PRIu32, model->parts[i].frame.heading);
    }
    putc('\n', out);
}

static void write_json(const enumeration *e, uint64_t rank, const tn_placed_model *model)
{
    tn_json json = tn_json_file(e->output.stream, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_count(&json, "building", rank);
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

static void write_subfile(const enumeration *e, uint64_t rank, const tn_placed_model *model)
{
    FILE *out = e->output.stream;
    fprintf(out, "0 FILE building-%" PRIu64 ".ldr\n0 building %" PRIu64 "\n", rank, rank);
    tn_place_write_ldraw(e->module, model, NULL, out);
}

/* ---- all of them */

/* Lines would mix with progress on the terminal that both go to. */
static bool begins(void *context, uint64_t from, uint64_t to)
{
    enumeration *e = context;
    bool to_stdout = !e->path || strcmp(e->path, "-") == 0;
    e->begun = tn_job_output(e->job, e->path, &e->output);
    if (!e->begun)
        return false;
    e->next = from;
    tn_job_show(e->job);
    tn_progress_begin(&e->progress, "buildings", 0, to < UINT64_MAX ? (double)to : 0);
    e->progress.shows = e->progress.shows && !(to_stdout && isatty(STDOUT_FILENO));
    return true;
}

static bool takes(void *context, uint64_t rank, const tn_placed_model *building)
{
    enumeration *e = context;
    if (building) {
        (e->format == AS_JSON ? write_json : e->format == AS_LINES ? write_line : write_subfile)(e, rank, building);
        e->written++;
        e->next = rank + 1;
    }
    tn_progress_update(&e->progress, (double)(rank + 1));
    return !ferror(e->output.stream);
}

/* What was written stays, and how to go on is said. */
static void end(enumeration *e, tn_status status)
{
    bool interrupted = tn_interrupted();
    if (!e->begun || !interrupted)
        tn_job_answered(e->job, status);
    if (!e->begun)
        return;
    tn_progress_end(&e->progress);
    tn_job_close(e->job, &e->output, status == TN_OK || interrupted);
    if (!interrupted)
        return;
    tn_interrupt_answered();
    tn_job_interrupted(e->job,
                       "interrupted; %" PRIu64 " buildings are written, and --from %" PRIu64 " goes on after them",
                       e->written, e->next);
}

void tn_job_enumerate_kit(tn_job *job, const tn_enumerate_request *request, bool json, const char *path)
{
    tn_file_format format = path ? tn_file_format_of(path) : TN_FILE_OTHER;
    bool subfiles = format == TN_FILE_MPD || format == TN_FILE_LDR;
    enumeration e = {.job = job,
                     .module = job->opened.module,
                     .path = path,
                     .format = subfiles ? AS_SUBFILES
                               : json   ? AS_JSON
                                        : AS_LINES};
    const tn_building_taker taker = {begins, takes, &e};
    tn_reply answer;
    if (subfiles && json) {
        tn_job_usage(job, "%.200s has a sub-file for each building: leave out --format", path);
        return;
    }
    job->session.buildings = &taker;
    end(&e, tn_ask_enumerate(&job->session, request, &answer));
    job->session.buildings = NULL;
    tn_reply_clear(&answer);
}
