/* Opens the study of a run, for `evolve` and `breed`. */
#include "cli/genome/evolution_session.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "driver/ponyge/ponyge.h"
#include "runtime/base/file.h"

#define PARAMETERS_BYTES_MAX ((size_t)1 << 20)

/* study.study -> study.run, in the folder that the command is given in. */
static char *default_dir(const char *study)
{
    const char *slash = strrchr(study, '/'), *name = slash ? slash + 1 : study, *dot = strrchr(name, '.');
    size_t length = dot && dot > name ? (size_t)(dot - name) : strlen(name);
    char *dir = malloc(length + 5);
    if (dir)
        sprintf(dir, "%.*s.run", (int)length, name);
    return dir;
}

/* Parameters of PonyGE2 become a study, which is compiled as if it lay beside them. */
static bool open_parameters(tn_study_job *s, const char *path)
{
    tn_job *job = &s->job;
    char *study = NULL, *ignored = NULL;
    uint8_t *bytes;
    size_t size;
    tn_error error = {0};
    tn_status status = tn_file_read(path, PARAMETERS_BYTES_MAX, &bytes, &size, &error);
    if (status == TN_OK) {
        status = tn_ponyge_study(path, (const char *)bytes, size, &study, &ignored, &error);
        free(bytes);
    }
    if (status != TN_OK) {
        tn_job_status(job, status);
        tn_report_error(tn_job_diagnostics(job), &error, path, NULL, 0);
        return false;
    }
    if (asprintf(&s->parameters_study, "%s.study", path) < 0)
        s->parameters_study = NULL;
    status = s->parameters_study ? tn_open_bytes(s->parameters_study, (const uint8_t *)study, strlen(study),
                                                 job->settings->werror, &job->opened)
                                 : TN_MEMORY;
    tn_job_status(job, status);
    if (job->opened.module)
        job->opened.module->watch = tn_interrupt_waiting();
    if (ignored[0])
        tn_report_bare(tn_job_diagnostics(job), TN_NOTE, TN_CODE_NONE, "these parameters of PonyGE2 do not apply: %s",
                       ignored);
    free(study);
    free(ignored);
    return job->opened.module != NULL;
}

/* Is all asked that has to be, before the study is opened? */
static bool can_be_asked(tn_job *job, const tn_session_settings *settings, const tn_run_asked *asked)
{
    bool stream = settings->output && strcmp(settings->output, "-") == 0;
    bool changes = settings->changes.count && !settings->resume;
    if (stream && !changes) {
        tn_job_usage(job, "a run is a folder, which cannot be written to standard output: name one, as -o hello.run");
        return false;
    }
    return tn_job_answered(job, tn_run_asked_check(&job->session, asked));
}

static tn_run_asked asked_of(const tn_session_settings *s, const char *dir)
{
    return (tn_run_asked){.run = dir,
                          .resume = s->resume,
                          .rescore = s->rescore,
                          .durable = s->durable,
                          .has_generations = s->generations.given,
                          .generations = s->generations.value,
                          .set = {s->changes.items, s->changes.count},
                          .has_seed = s->seed.given,
                          .seed = s->seed.value,
                          .has_threads = s->threads.given,
                          .threads = s->threads.value,
                          .open = s->open,
                          .run_programs = s->run_programs};
}

bool tn_study_job_open(tn_study_job *s, const tn_session_settings *settings)
{
    tn_job *job = &s->job;
    const char *path = settings->common.operands.items[0];
    tn_error error;
    *s = (tn_study_job){0};
    tn_job_begin(job, &settings->common);
    job->session.ranks = settings->common.ranks;
    s->own_dir = settings->output ? NULL : default_dir(path);
    s->asked = asked_of(settings, settings->output ? settings->output : s->own_dir);
    if (!s->asked.run) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
    }
    bool open = s->asked.run && can_be_asked(job, settings, &s->asked) &&
                (settings->ponyge ? open_parameters(s, path) : tn_job_open(job, path));
    return tn_job_agree(job, open);
}

int tn_study_job_end(tn_study_job *s)
{
    int code = tn_job_end(&s->job);
    free(s->own_dir);
    free(s->parameters_study);
    return code;
}
