/* tartan evolve: breeds sentences of a grammar towards what a study wants. */
#include "cli/genome/evolve.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "driver/ponyge/ponyge.h"
#include "runtime/base/file.h"
#include "runtime/base/utf8.h"
#include "runtime/base/watch.h"

/* ---- opens the study of a run, for `evolve` and `breed` */

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

/* ---- while it runs */

typedef struct watched_run {
    tn_study_job *study;
    tn_progress progress;
    char text[200];
    double start;
    uint64_t before; /* evaluations of generations that were made before */
    bool begun, lead;
} watched_run;

/* What there is to see. */
static void describe(watched_run *w, const tn_run_generation *g)
{
    uint64_t invalid = g->no_sentence + g->failed + g->limited, members = invalid + g->scored;
    double seconds = tn_seconds() - w->start;
    snprintf(w->text, sizeof w->text,
             "generations; best %.5g, median %.5g, %.0f %% without score, %" PRIu64 " distinct, %.0f evaluations/s",
             g->best, g->median, members ? 100.0 * (double)invalid / (double)members : 0, g->distinct,
             seconds > 0 ? (double)(g->evaluations - w->before) / seconds : 0);
}

static void begin(watched_run *w, size_t generations, const tn_run_generation *last)
{
    tn_job *job = &w->study->job;
    tn_evolution_study study;
    double wanted = (double)w->study->asked.generations;
    if (!w->study->asked.has_generations && tn_evolution_study_of(job->opened.module, &study))
        wanted = study.of[TN_SET_GENERATIONS].first;
    w->begun = true;
    w->start = tn_seconds();
    w->before = last ? last->evaluations : 0;
    snprintf(w->text, sizeof w->text, "generations");
    tn_progress_begin(&w->progress, w->text, (double)generations, wanted + 1);
    w->progress.shows &= w->lead;
}

/* Called once before breeding, and with each generation. */
static void show_so_far(void *context, const tn_reply *answer)
{
    watched_run *w = context;
    const tn_evolved *told = TN_REPLY(evolved, answer);
    size_t generations = told->generations.count;
    const tn_run_generation *last = generations ? &told->generations.items[generations - 1] : NULL;
    if (!w->begun || tn_job_diagnostics(&w->study->job)->count)
        tn_job_show(&w->study->job);
    if (w->lead)
        tn_interrupt_last_words("interrupted after %zu generations; --resume goes on from there", generations);
    if (!w->begun) {
        begin(w, generations, last);
        return;
    }
    if (w->progress.shows)
        describe(w, last);
    tn_progress_update(&w->progress, (double)generations);
}

/* ---- how it went */

/* How its genomes were made. */
static void tell_first_made(const tn_first_genomes *first, FILE *out)
{
    if (first->given)
        fprintf(out, "%" PRIu64 " given, ", first->given);
    if (first->has_full)
        fprintf(out, "%" PRIu64 " full and ", first->full);
    if (first->has_grown)
        fprintf(out, "%" PRIu64 " grown, ", first->grown);
    if (first->has_random)
        fprintf(out, "%" PRIu64 " random, ", first->random);
}

/* What the first generation was like, from which all others come. */
static void tell_first(const tn_evolved *told, FILE *out)
{
    if (!told->generations.count)
        return;
    const tn_run_generation *g = &told->generations.items[0];
    fputs("first generation: ", out);
    if (told->has_first_genomes)
        tell_first_made(&told->first_genomes, out);
    fprintf(out, "%" PRIu64 " distinct, %" PRIu64 " without sentence, mean depth %.3g", g->distinct, g->no_sentence,
            g->mean_depth);
    fprintf(out, told->has_first_genomes ? ", %.4g codons on the mean\n" : "\n", g->mean_codons);
}

static void tell_reasons(const tn_evolved *told, bool programs, FILE *out)
{
    for (size_t i = 0; i < told->reasons.count; i++) {
        const tn_no_score_reason *reason = &told->reasons.items[i];
        fprintf(out, "  %" PRIu64 " %s: %s", reason->members,
                strcmp(reason->state, "limited") == 0 ? "past a limit" : "failed",
                reason->text[0] ? reason->text : "no reason was given");
        if (programs)
            fprintf(out, reason->members > 1 ? " (individual %" PRIu64 " and others)" : " (individual %" PRIu64 ")",
                    reason->individual);
        fputc('\n', out);
    }
}

static void tell_best(const tn_evolved *told, FILE *out)
{
    fprintf(out, "best: individual %" PRIu64 "\n", told->best.individual);
    tn_write_shown(out, told->best.sentence, strlen(told->best.sentence));
    fputc('\n', out);
    if (told->has_slope)
        fprintf(out, "scaled: %.10g + %.10g times this\n", told->intercept, told->slope);
    if (told->has_test)
        fprintf(out, "with the test data: %.6g\n", told->test);
}

static void summarise(const tn_evolved *told, bool programs, bool written, FILE *out)
{
    const tn_run_generation *g = &told->newest;
    fprintf(out, "%" PRIu64 " generation%s, %" PRIu64 " evaluations, %" PRIu64 " births\n", g->generation,
            g->generation == 1 ? "" : "s", g->evaluations, g->births);
    if (g->scored)
        fprintf(out, "last generation: best %.6g, median %.6g, mean %.6g, %" PRIu64 " distinct", g->best, g->median,
                g->mean, g->distinct);
    else
        fprintf(out, "last generation: no individual has a score (%s)", told->why_none ? told->why_none : "");
    fprintf(out, ", %" PRIu64 " without sentence, %" PRIu64 " failed, %" PRIu64 " past a limit\n", g->no_sentence,
            g->failed, g->limited);
    tell_reasons(told, programs, out);
    if (told->has_best)
        tell_best(told, out);
    tell_first(told, out);
    fprintf(out, written ? "results are in %s\n" : "the run so far is in %s/run.sqlite\n", told->run);
}

/* ---- the command */

static void tell(tn_study_job *s, const tn_reply *answer, bool written)
{
    const tn_evolved *told = TN_REPLY(evolved, answer);
    bool json = ((const tn_session_settings *)s->job.settings)->json;
    tn_evolution_study study;
    tn_output output;
    bool programs = tn_evolution_study_of(s->job.opened.module, &study) && study.of[TN_SET_PROGRAM].written;
    if (!tn_job_output(&s->job, NULL, &output))
        return;
    if (json)
        tn_job_write_json(answer, output.stream);
    else if (told->has_newest)
        summarise(told, programs, written, output.stream);
    tn_job_commit(&s->job, &output);
}

static void evolve(tn_study_job *s)
{
    const tn_ranks *ranks = s->job.settings->ranks;
    const tn_evolve_request request = {.asked = s->asked};
    watched_run w = {.study = s, .lead = tn_ranks_lead(ranks)};
    tn_reply answer;
    if (ranks)
        tn_interrupt_gently(true, true);
    s->job.session.so_far = show_so_far;
    s->job.session.so_far_context = &w;
    tn_status status = tn_ask_evolve(&s->job.session, &request, &answer);
    if (w.begun)
        tn_progress_end(&w.progress);
    const tn_evolved *told = TN_REPLY(evolved, &answer);
    s->job.said = told && !w.lead; /* what is missing: the first says it */
    if (told && w.lead && status == TN_STOPPED)
        tn_job_interrupted(&s->job, "interrupted after %zu generations; --resume goes on from there",
                           told->generations.count);
    else if (w.lead || status != TN_STOPPED)
        tn_job_answered(&s->job, status);
    if (told && w.lead)
        tell(s, &answer, status == TN_OK);
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_study_job study;
    if (tn_study_job_open(&study, (const tn_session_settings *)settings))
        evolve(&study);
    return tn_study_job_end(&study);
}

#define SETTINGS tn_session_settings
static const tn_option options[] = {OPTIONS_RUN("how many generations to breed, instead of the study's number"),
                                    FLAG("json", 0, json, "write how it went as JSON"), OPTION_LDRAW};

const tn_command tn_command_evolve = {
    .name = "evolve",
    .summary = "breed sentences, fields or designs towards a goal",
    .usage = "STUDY.study [-o DIR] [--resume] [--generations N]",
    .description =
        "Makes a population of genomes, maps them through the study's grammar, scores the sentences, and breeds "
        "the next generation from the best, as often as the study says. Fields and "
        "designs of boxes are bred as what they are, without a grammar. The same study and seed give the same run "
        "on every machine and with any number of threads.\n\n"
        "The folder DIR gets run.sqlite (the whole run), best/ (the best sentences as files, with pictures of "
        "their surfaces, rules or derivations), stats.csv and fitness.svg. Each generation is stored when it is "
        "done. --resume continues a run that was interrupted or killed, and the result has the same bytes as a "
        "run without interruption. With --resume and a larger --generations a finished run is extended.",
    .example = "$ tartan evolve hello.study\n$ tartan evolve hello.study --resume --generations 200",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "make the population smaller",
    .operands = "one STUDY.study",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
