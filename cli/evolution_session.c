#include "cli/evolution_session.h"

#include <stdlib.h>
#include <string.h>

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

static const tn_source *source_of(const tn_job *command, uint32_t file)
{
    return &command->opened.compilation.sources.files[file];
}

/* A study's data files are inputs of their own: what is wrong in them has its place there. */
static bool begin(tn_evolution_session *e, const tn_evolution_study *study, const char *dir, tn_error *error)
{
    const tn_settings *settings = e->command->settings;
    const char *path = settings->operands.items[0];
    tn_evolution_job_options options = {
        .threads = (unsigned)settings->threads.value, .says_seed = settings->seed.given, .seed = settings->seed.value};
    tn_run_options run_options = {.resume = settings->resume, .durable = settings->durable};
    const tn_source *grammar = source_of(e->command, study->grammar_file), *text = source_of(e->command, 0);
    tn_run_texts texts = {path, text->text, grammar->path, grammar->text};
    e->generations = settings->generations.given ? (uint32_t)settings->generations.value : (uint32_t)study->generations;
    bool begun = tn_evolution_job_make(study, path, e->command->opened.module, &options, &e->job, error) == TN_OK &&
                 tn_run_begin(&e->job, dir, &run_options, &texts, &e->run, error) == TN_OK;
    for (size_t i = 0; begun && i < settings->changes.count; i++)
        begun = tn_run_set(&e->run, settings->changes.items[i], error) == TN_OK;
    return begun;
}

bool tn_evolution_session_open(tn_job *command, tn_evolution_session *e)
{
    const char *path = command->settings->operands.items[0];
    tn_error error = {0};
    *e = (tn_evolution_session){.command = command};
    if (!tn_job_open(command, path))
        return false;
    const tn_evolution_study *study = command->opened.compilation.evolution;
    if (!study) {
        tn_fail(&error, TN_INVALID, E_EVOLUTION_SYNTAX, "%.200s says nothing of evolution", path);
        tn_error_help(&error, "a study to be evolved is a .study file with a block `evolution { ... }`");
        tn_job_fail(command, &error);
        return false;
    }
    char *own = command->settings->output ? NULL : default_dir(path);
    const char *dir = command->settings->output ? command->settings->output : own;
    bool begun = dir ? begin(e, study, dir, &error) : tn_fail_memory(&error) == TN_OK;
    free(own);
    if (!begun)
        tn_job_fail(command, &error);
    return begun;
}

void tn_evolution_session_close(tn_evolution_session *e)
{
    tn_run_clear(&e->run);
    tn_evolution_job_clear(&e->job);
}
