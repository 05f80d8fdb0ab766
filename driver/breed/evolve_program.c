/* Finds the program of a study, and has it score what the study breeds. */
#include "driver/breed/evolve_program.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "driver/breed/inputs.h"
#include "runtime/base/file.h"
#include "runtime/base/file_error.h"

/* The program's whole path. The caller frees it. */
static tn_status find_program(const tn_evolution_job *job, const char *path, char **whole, tn_error *error)
{
    char *beside = tn_file_beside(path, job->study.of[TN_SET_PROGRAM].text);
    *whole = beside ? realpath(beside, NULL) : NULL;
    int reason = errno;
    tn_status status = *whole ? TN_OK : beside ? tn_cannot_read(beside, reason, error) : tn_fail_memory(error);
    free(beside);
    return status;
}

static tn_status refuse(const char *program, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_PROGRAM_REFUSED, "this study runs the program %.350s for its scores", program);
    tn_error_help(error, "read the program first; if you trust it, say --run-programs");
    return TN_INVALID;
}

/* Does the problem want anything of its own? */
static bool wants(const tn_evolution_job *job)
{
    return job->grower    ? tn_grower_wants(job->grower)
           : job->designs ? tn_design_scorer_wants(job->designs)
           : job->placer  ? tn_placer_wants(job->placer)
           : job->fields  ? tn_field_scorer_wants(job->fields)
                          : false;
}

static void listen(tn_evolution_job *job)
{
    tn_form_listener listener = tn_program_scorer_listener(job->program);
    if (job->grower)
        tn_grower_tell(job->grower, listener);
    if (job->designs)
        tn_design_scorer_tell(job->designs, listener);
    if (job->fields)
        tn_field_scorer_tell(job->fields, listener);
    if (job->placer)
        tn_placer_tell(job->placer, tn_program_scorer_hear_model, job->program);
}

static tn_status ask(tn_evolution_job *job, const char *program, tn_error *error)
{
    const tn_evolution_study *s = &job->study;
    const tn_program_scoring scoring = {
        .program = {.path = program,
                    .threads = job->settings.threads,
                    .seconds = (unsigned)s->of[TN_SET_PROGRAM_TIMEOUT].first,
                    .values = (size_t)s->of[TN_SET_PROGRAM_VALUES].first,
                    .watch = job->settings.watch},
        .weight = s->of[TN_SET_PROGRAM].second,
        .separately = job->settings.select.selection == TN_SELECT_NSGA2,
        .population = job->settings.population,
    };
    tn_status status = tn_inputs_add_file(&job->inputs, "fitness program", program, error);
    if (status == TN_OK)
        status = tn_program_scorer_new(&scoring, &job->program, error);
    if (status == TN_OK)
        status = tn_program_scorer_follow(job->program, &job->evaluator, wants(job), error);
    if (status != TN_OK)
        return status;
    listen(job);
    job->evaluator = tn_program_scorer_evaluator(job->program);
    return TN_OK;
}

tn_status tn_evolution_job_ask(tn_evolution_job *job, const char *path, const tn_evolution_job_options *options,
                               tn_error *error)
{
    char *program = NULL;
    job->blamed = TN_SET_PROGRAM;
    for (job->blamed_each = 0; job->study.each[job->blamed_each].setting != TN_SET_PROGRAM;)
        job->blamed_each++;
    tn_status status = find_program(job, path, &program, error);
    if (status == TN_OK)
        status = options->run_programs ? ask(job, program, error) : refuse(program, error);
    free(program);
    return status;
}
