/* Opens a study and the run that it is to make, for `evolve` and `breed`. */
#include "cli/genome/evolution_session.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "driver/ponyge/ponyge.h"
#include "runtime/base/file.h"

#include "runtime/ranks/ranks.h"

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

/* What a setting names is to blame: in the file itself, where that has the place, or else where the study names it. */
static void report(tn_evolution_session *e, const tn_evolution_study *study, const tn_error *error)
{
    const tn_evolution_job *job = &e->job;
    bool repeats = job->blamed < TN_SETTING_COUNT && tn_setting_rows[job->blamed].kind == TN_SETTING_EACH;
    const tn_setting_value *value = job->blamed == TN_SETTING_COUNT ? NULL
                                    : repeats                       ? &study->each[job->blamed_each].value
                                                                    : &study->of[job->blamed];
    tn_diagnostics *list = tn_job_diagnostics(e->command);
    if (!value || !value->written || error->status == TN_MEMORY) {
        tn_job_fail(e->command, error);
        return;
    }
    tn_job_status(e->command, error->status);
    tn_diagnostic *diagnostic = tn_report_error(list, error, job->blamed_path, NULL, 0);
    if (error->line)
        return;
    diagnostic->has_span = true;
    diagnostic->span = (tn_span){value->file, value->begin, value->end};
}

/* The grammar's text, with the numbers of the data that the study's compiler found above it: a run is made again from
 * that alone. The caller frees it. */
static char *grammar_text(const tn_evolution_study *study, const char *text)
{
    static const struct {
        tn_setting setting;
        const char *directive;
    } numbers[] = {{TN_SET_DATASET_VARS, "%dataset-vars"},
                   {TN_SET_DATASET_INPUTS, "%dataset-inputs"},
                   {TN_SET_DATASET_OUTPUTS, "%dataset-outputs"}};
    char *whole = NULL;
    size_t size;
    FILE *out = open_memstream(&whole, &size);
    if (!out)
        return NULL;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (study->of[numbers[i].setting].written)
            fprintf(out, "%s %.0f\n", numbers[i].directive, study->of[numbers[i].setting].first);
    fputs(text, out);
    bool written = !ferror(out);
    if (fclose(out) == 0 && written)
        return whole;
    free(whole);
    return NULL;
}

static bool begin_run(tn_evolution_session *e, const tn_evolution_study *study, const char *dir,
                      const tn_run_options *options, tn_error *error)
{
    const tn_module *module = e->command->opened.module;
    bool codons = tn_evolution_study_use(study) == TN_USE_CODONS; /* forms have no grammar */
    const tn_source_record *grammar = codons ? &module->SOURCE_records[module->GRAMMAR_records[0].file] : NULL,
                           *text = &module->SOURCE_records[codons ? study->of[TN_SET_GRAMMAR].file : 0];
    char *whole = grammar_text(study, grammar ? tn_text(module, grammar->text) : "");
    tn_run_texts texts = {tn_text(module, text->path), tn_text(module, text->text),
                          grammar ? tn_text(module, grammar->path) : "", whole};
    tn_status status = whole ? tn_run_begin(&e->job, dir, options, &texts, &e->run, error) : tn_fail_memory(error);
    free(whole);
    return status == TN_OK;
}

/* Makes the job of the study. */
static bool make_job(tn_evolution_session *e, const tn_evolution_study *study, tn_error *error)
{
    const tn_session_settings *settings = e->settings;
    const char *path = settings->common.operands.items[0];
    const tn_ranks *ranks = settings->common.ranks;
    uint64_t threads = ranks && !settings->threads.given ? 1 : settings->threads.value;
    tn_evolution_job_options options = {.threads = (unsigned)threads,
                                        .watch = tn_interrupt_waiting(),
                                        .ranks = ranks,
                                        .says_seed = settings->seed.given,
                                        .seed = settings->seed.value,
                                        .run_programs = settings->run_programs,
                                        .remembers = e->remembers,
                                        .draws_open = settings->open};
    if (settings->open && tn_evolution_study_use(study) != TN_USE_TREES) {
        tn_diagnostic *d = tn_job_usage(e->command, "--open is about fields, and this study breeds something else");
        tn_help(tn_job_diagnostics(e->command), d, "leave it out");
        return false;
    }
    e->generations =
        (uint32_t)(settings->generations.given ? settings->generations.value : study->of[TN_SET_GENERATIONS].first);
    if (tn_evolution_job_make(study, path, e->command->opened.module, &options, &e->job, error) != TN_OK) {
        report(e, study, error);
        return false;
    }
    if (e->remembers && study->of[TN_SET_ISLANDS].first > 1) {
        tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "a person chooses parents from one population, not from islands");
        tn_error_help(error, "leave `islands` and `migrate` out, or have it bred: tartan evolve %.200s", path);
        e->job.blamed = TN_SET_ISLANDS;
        report(e, study, error);
        return false;
    }
    if (e->remembers || !e->job.settings.kind || e->job.scored) /* with `breed`, a person chooses */
        return true;
    tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "the study does not say what to evolve towards");
    tn_error_help(error, "add a goal, as `fitness volume target 200`; or choose parents yourself: tartan breed %s",
                  path);
    tn_job_fail(e->command, error);
    return false;
}

static void warn_of_open_mesh(tn_evolution_session *e)
{
    const char *mesh = e->job.grower ? tn_grower_open_mesh(e->job.grower) : NULL;
    if (!mesh || !tn_ranks_lead(e->settings->common.ranks))
        return;
    tn_diagnostics *list = tn_job_diagnostics(e->command);
    tn_diagnostic *d = tn_report_bare(
        list, TN_WARNING, W_OPEN_BOUNDARY,
        "the boundary mesh %.200s is open, or has edges of more than two faces: nothing is inside it", mesh);
    tn_help(list, d, "close it, or leave `inside` out: it stops what crosses it from either side");
}

/* With several ranks, together. */
static bool begin(tn_evolution_session *e, const tn_evolution_study *study, const char *dir, tn_error *error)
{
    const tn_session_settings *settings = e->settings;
    tn_run_options run_options = {
        .resume = settings->resume, .durable = settings->durable, .rescore = settings->rescore};
    bool begun = begin_run(e, study, dir, &run_options, error);
    for (size_t i = 0; begun && i < settings->changes.count; i++)
        begun = tn_run_set(&e->run, settings->changes.items[i], error) == TN_OK;
    if (!begun)
        tn_job_fail(e->command, error);
    return begun;
}

static bool wants_what_can_be(tn_job *command, const tn_session_settings *settings)
{
    if (settings->changes.count && !settings->resume) {
        tn_job_usage(command, "--set changes a run that has begun: say --resume too, or change the study itself");
        return false;
    }
    if (settings->output && strcmp(settings->output, "-") == 0) {
        tn_job_usage(command,
                     "a run is a folder, which cannot be written to standard output: name one, as -o hello.run");
        return false;
    }
    if (settings->rescore && !settings->resume) {
        tn_job_usage(command, "--rescore is about a run that has begun: say --resume too");
        return false;
    }
    return true;
}

/* Parameters of PonyGE2 become a study, which is compiled as if it lay beside them. */
static bool open_parameters(tn_evolution_session *e, const char *path)
{
    tn_job *command = e->command;
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
        tn_job_status(command, status);
        tn_report_error(tn_job_diagnostics(command), &error, path, NULL, 0);
        return false;
    }
    if (asprintf(&e->parameters_study, "%s.study", path) < 0)
        e->parameters_study = NULL;
    status = e->parameters_study ? tn_open_bytes(e->parameters_study, (const uint8_t *)study, strlen(study),
                                                 command->settings->werror, &command->opened)
                                 : TN_MEMORY;
    tn_job_status(command, status);
    if (command->opened.module)
        command->opened.module->watch = tn_interrupt_waiting();
    if (ignored[0])
        tn_report_bare(tn_job_diagnostics(command), TN_NOTE, TN_CODE_NONE,
                       "these parameters of PonyGE2 do not apply: %s", ignored);
    free(study);
    free(ignored);
    return command->opened.module != NULL;
}

static bool open_study(tn_evolution_session *e, const char *path, tn_evolution_study *study, tn_error *error)
{
    tn_job *command = e->command;
    if (e->settings->ponyge ? !open_parameters(e, path) : !tn_job_open(command, path))
        return false;
    if (tn_evolution_study_of(command->opened.module, study))
        return true;
    tn_fail(error, TN_INVALID, E_EVOLUTION_SYNTAX, "%.200s has no block `evolution { ... }`", path);
    tn_error_help(
        error, "%s",
        tn_opened_help(&command->opened, "a study to be evolved is a .study file with a block `evolution { ... }`")
            .text);
    tn_job_fail(command, error);
    return false;
}

static bool open_session(tn_job *command, const tn_session_settings *settings, bool remembers, tn_evolution_session *e)
{
    const char *path = settings->common.operands.items[0];
    tn_error error = {0};
    tn_evolution_study study;
    *e = (tn_evolution_session){.command = command, .settings = settings, .remembers = remembers};
    char *own = settings->output ? NULL : default_dir(path);
    const char *dir = settings->output ? settings->output : own;
    if (!dir) {
        tn_fail_memory(&error);
        tn_job_fail(command, &error);
    }
    bool ready = dir && wants_what_can_be(command, settings) && open_study(e, path, &study, &error) &&
                 make_job(e, &study, &error);
    if (ready)
        warn_of_open_mesh(e);
    bool begun = tn_job_agree(command, ready) && begin(e, &study, dir, &error);
    free(own);
    return begun;
}

void tn_evolution_session_warn(tn_evolution_session *e)
{
    tn_diagnostics *list = tn_job_diagnostics(e->command);
    for (size_t i = 0; i < e->run.look.count; i++) {
        const tn_finding *finding = &e->run.look.items[i];
        tn_diagnostic *d = tn_report_bare(list, TN_WARNING, finding->code, "%s", finding->message);
        if (finding->help[0])
            tn_help(list, d, "%s", finding->help);
    }
    if (e->run.look.count)
        tn_job_show(e->command);
}

int tn_evolution_session_run(const tn_session_settings *settings, bool remembers,
                             void (*work)(tn_evolution_session *evolution))
{
    tn_job command;
    tn_evolution_session evolution = {0};
    tn_job_begin(&command, &settings->common);
    if (open_session(&command, settings, remembers, &evolution)) {
        tn_job_show(&command);
        work(&evolution);
    }
    tn_run_clear(&evolution.run); /* before the job ends, which owns the study's texts */
    tn_evolution_job_clear(&evolution.job);
    int code = tn_job_end(&command);
    free(evolution.parameters_study);
    return code;
}
