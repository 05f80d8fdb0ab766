/* tartan evolve: breeds sentences of a grammar towards what a study wants. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/genome/evolution_session.h"
#include "driver/breed/reasons.h"
#include "runtime/base/utf8.h"

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

/* What there is to see while it runs. */
static void describe(const tn_evolution_session *e, uint64_t evaluated_before, double start, char *text, size_t size)
{
    tn_generation_stats s = tn_evolution_stats(e->run.evolution);
    uint32_t invalid = s.no_sentence + s.failed + s.limited, members = invalid + s.scored;
    double seconds = now() - start;
    snprintf(text, size, "generations; best %.5g, median %.5g, %.0f %% without score, %u distinct, %.0f evaluations/s",
             s.best[0], s.quartiles[1], members ? 100.0 * invalid / members : 0, s.distinct,
             seconds > 0 ? (double)(s.evaluations - evaluated_before) / seconds : 0);
}

/* A grammar whose sentences mostly cannot be scored is rarely meant: said once, before breeding begins. */
static void warn_of_failures(tn_evolution_session *e)
{
    tn_error error;
    tn_generation_stats s = tn_evolution_stats(e->run.evolution);
    tn_reasons reasons;
    if (e->run.generations != 1 || s.failed + s.limited <= s.scored)
        return;
    if (tn_run_reasons(&e->run, &reasons, &error) != TN_OK || reasons.count == 0)
        return;
    tn_diagnostics *list = tn_job_diagnostics(e->command);
    tn_diagnostic *diagnostic = tn_report_bare(
        list, TN_WARNING, W_SENTENCES_FAIL, "of %u sentences of the first generation, %u have no score: %s",
        s.scored + s.failed + s.limited, s.failed + s.limited, reasons.items[0].text);
    tn_help(list, diagnostic, "that is why %u of them have none; the grammar may be for another program or other data",
            reasons.items[0].count);
    tn_job_show(e->command);
}

/* Is there another generation to breed? Several ranks give the same answer: an interrupt ends the step of all of them.
 */
static bool goes_on(tn_evolution_session *e)
{
    bool exhausted = tn_run_exhausted(&e->run), left = e->run.generations <= e->generations;
    bool wanted = left && !exhausted && !tn_run_reached(&e->run);
    e->exhausted = left && exhausted;
    return wanted && (tn_ranks_several(e->job.settings.ranks) || !tn_interrupted());
}

/* The best by its score may lack what is required: then the score says little. */
static void warn_of_unmet(tn_evolution_session *e)
{
    const tn_bred_forms *forms = &e->job.forms;
    size_t count;
    const tn_individual *const *members = tn_evolution_members(e->run.evolution, &count);
    char *text = NULL;
    tn_error error;
    if (!forms->unmet || !count || members[0]->score.state != TN_SCORED ||
        forms->unmet(forms->context, members[0]->sentence, &text, &error) != TN_OK || !text[0]) {
        free(text);
        return;
    }
    tn_diagnostics *list = tn_job_diagnostics(e->command);
    tn_diagnostic *d =
        tn_report_bare(list, TN_WARNING, W_BEST_LACKS, "the best %s does not meet what is required of it", forms->what);
    for (char *line = text, *end; (end = strchr(line, '\n')); line = end + 1)
        tn_note(list, d, NULL, "%.*s", (int)(end - line), line);
    if (e->job.settings.select.selection != TN_SELECT_NSGA2)
        tn_help(list, d, "with `selection nsga2`, what meets more of it is always better");
    free(text);
    tn_job_show(e->command);
}

static tn_status breed_all(tn_evolution_session *e, tn_error *error)
{
    tn_progress progress;
    char text[200] = "generations";
    double start = now();
    bool lead = tn_ranks_lead(e->job.settings.ranks);
    uint64_t before = e->run.generations ? tn_evolution_stats(e->run.evolution).evaluations : 0;
    tn_progress_begin(&progress, text, e->run.generations, (double)e->generations + 1);
    progress.shows &= lead;
    tn_status status = TN_OK;
    while (status == TN_OK && goes_on(e)) {
        if (lead)
            tn_interrupt_last_words("interrupted after %u generations; --resume goes on from there",
                                    e->run.generations);
        status = tn_run_step(&e->run, NULL, 0, error);
        if (status == TN_OK && lead)
            warn_of_failures(e);
        if (status == TN_OK && lead && e->run.generations == 1)
            tn_evolution_session_warn(e);
        if (status == TN_OK && progress.shows)
            describe(e, before, start, text, sizeof text);
        tn_progress_update(&progress, e->run.generations);
    }
    tn_progress_end(&progress);
    if (status == TN_OK)
        status = tn_run_settle(&e->run, error);
    return status;
}

static void evolve(tn_evolution_session *e)
{
    tn_error error;
    const tn_ranks *ranks = e->job.settings.ranks;
    if (ranks)
        tn_interrupt_gently(true, true);
    tn_status status = breed_all(e, &error);
    bool interrupted = tn_ranks_any(ranks, tn_interrupted() || status == TN_STOPPED);
    if (status == TN_STOPPED)
        status = TN_OK; /* within a generation, which is not kept */
    if (status == TN_OK && e->run.generations && !interrupted && tn_ranks_lead(ranks))
        status = tn_run_results(&e->run, &error);
    e->written = status == TN_OK && !interrupted;
    if (e->written && e->run.generations && tn_ranks_lead(ranks))
        warn_of_unmet(e);
    e->command->said = !tn_ranks_lead(ranks); /* what is missing: the first says it */
    if (status != TN_OK) {
        tn_job_fail(e->command, &error);
    } else if (!tn_ranks_lead(ranks)) {
        return;
    } else if (e->run.new_changes) {
        tn_job_note(e->command, "what --set changed is kept with the next generation: --generations %u breeds one",
                    e->run.generations);
    } else if (interrupted) {
        tn_job_interrupted(e->command, "interrupted after %u generations; --resume goes on from there",
                           e->run.generations);
    }
}

static const char *why_no_score(const tn_individual *individual)
{
    return individual->reason != TN_MAPPING_VALID ? tn_mapping_reason_text(individual->reason) : individual->message;
}

/* How its genomes were made: even numbers full and odd ones grown, where they are of both kinds. */
static void tell_first_made(const tn_evolution_session *e, FILE *out)
{
    const tn_evolution_settings *s = &e->job.settings;
    size_t given = s->seed_count < s->population ? s->seed_count : s->population, left = s->population - given;
    size_t full = (s->population + 1) / 2 - (given + 1) / 2;
    if (given)
        fprintf(out, "%zu given, ", given);
    if (s->initialisation == TN_INITIALISE_RAMPED)
        fprintf(out, "%zu full and %zu grown, ", full, left - full);
    else
        fprintf(out, "%zu %s, ", left, s->initialisation == TN_INITIALISE_RANDOM ? "random" : "grown");
}

/* What the first generation was like, from which all others come. */
static void tell_first(const tn_evolution_session *e, FILE *out)
{
    tn_generation_stats *stats = NULL;
    size_t count = 0;
    tn_error error;
    if (tn_run_store_stats(e->run.store, &stats, &count, &error) == TN_OK && count) {
        const tn_generation_stats *s = &stats[0];
        fputs("first generation: ", out);
        if (e->job.grammar)
            tell_first_made(e, out);
        fprintf(out, "%u distinct, %u without sentence, mean depth %.3g", s->distinct, s->no_sentence, s->mean_depth);
        fprintf(out, e->job.grammar ? ", %.4g codons on the mean\n" : "\n", s->mean_codons);
    }
    free(stats);
}

static void tell_reasons(const tn_evolution_session *e, FILE *out)
{
    tn_reasons reasons;
    tn_error error;
    if (tn_run_reasons(&e->run, &reasons, &error) != TN_OK)
        return;
    for (size_t i = 0; i < reasons.count; i++) {
        const tn_reason *reason = &reasons.items[i];
        fprintf(out, "  %u %s: %s", reason->count, reason->state == TN_SCORE_LIMIT ? "past a limit" : "failed",
                reason->text[0] ? reason->text : "no reason was given");
        if (e->job.program)
            fprintf(out, reason->count > 1 ? " (individual %" PRIu64 " and others)" : " (individual %" PRIu64 ")",
                    reason->first);
        fputc('\n', out);
    }
}

/* What the best is worth where nobody has looked yet. */
static void tell_test(const tn_evolution_session *e, const tn_individual *best, FILE *out)
{
    tn_fit_report report;
    tn_error error;
    if (!e->job.problem || !e->job.study.of[TN_SET_FIT].written ||
        tn_problem_examine(e->job.problem, best->sentence, best->sentence_size, &report, &error) != TN_OK)
        return;
    if (e->job.study.of[TN_SET_SCALING].choice)
        fprintf(out, "scaled: %.10g + %.10g times this\n", report.line[0], report.line[1]);
    if (tn_problem_holds(e->job.problem))
        fprintf(out, "with the test data: %.6g\n", report.test);
}

static void summarise(const tn_evolution_session *e, FILE *out)
{
    size_t count;
    tn_generation_stats s = tn_evolution_stats(e->run.evolution);
    const tn_individual *const *members = tn_evolution_members(e->run.evolution, &count);
    if (e->run.generations == 0)
        return;
    fprintf(out, "%u generation%s, %" PRIu64 " evaluations, %" PRIu64 " births\n", s.generation,
            s.generation == 1 ? "" : "s", s.evaluations, s.births);
    if (s.scored)
        fprintf(out, "last generation: best %.6g, median %.6g, mean %.6g, %u distinct", s.best[0], s.quartiles[1],
                s.mean, s.distinct);
    else
        fprintf(out, "last generation: no individual has a score (%s)", count ? why_no_score(members[0]) : "");
    fprintf(out, ", %u without sentence, %u failed, %u past a limit\n", s.no_sentence, s.failed, s.limited);
    tell_reasons(e, out);
    if (count && members[0]->score.state == TN_SCORED) {
        fprintf(out, "best: individual %" PRIu64 "\n", members[0]->id);
        tn_write_shown(out, members[0]->sentence, strlen(members[0]->sentence));
        fputc('\n', out);
        tell_test(e, members[0], out);
    }
    tell_first(e, out);
    fprintf(out, e->written ? "results are in %s\n" : "the run so far is in %s/run.sqlite\n", e->run.dir);
}

/* It ended before its last generation. */
static void tell_exhausted(tn_evolution_session *e)
{
    if (e->exhausted)
        tn_job_note(e->command,
                    "the grammar has %zu sentences, and all have been scored: more generations find nothing new",
                    e->run.sentences);
}

static void evolve_and_tell(tn_evolution_session *e)
{
    tn_output output;
    evolve(e);
    if (tn_ranks_lead(e->job.settings.ranks))
        tell_exhausted(e);
    if (tn_ranks_lead(e->job.settings.ranks) && tn_job_output(e->command, NULL, &output)) {
        summarise(e, output.stream);
        tn_job_commit(e->command, &output);
    }
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    return tn_evolution_session_run((const tn_session_settings *)settings, false, evolve_and_tell);
}

#define SETTINGS tn_session_settings
static const tn_option options[] = {OPTIONS_RUN("how many generations to breed, instead of the study's number"),
                                    OPTION_LDRAW};

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
