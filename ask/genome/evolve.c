/* evolve: breeds what a study wants, generation by generation. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/genome/evolving.h"
#include "ask/session/questions.h"
#include "driver/breed/reasons.h"
#include "driver/sheet/sheet_page.h"

typedef struct evolving_run {
    tn_evolving e;
    tn_reply *answer;
    tn_evolved *told;
    bool lead; /* the rank that writes results and speaks */
} evolving_run;

static tn_diagnostics *said(const evolving_run *r)
{
    return &r->e.session->opened->compilation.diagnostics;
}

/* ---- warnings */

/* A grammar whose sentences mostly cannot be scored is rarely meant: said once, before breeding begins. */
static void warn_of_failures(const evolving_run *r)
{
    const tn_run *run = &r->e.run;
    tn_error error;
    tn_generation_stats s = tn_evolution_stats(run->evolution);
    tn_reasons reasons;
    if (s.failed + s.limited <= s.scored)
        return;
    if (tn_run_reasons(run, &reasons, &error) != TN_OK || reasons.count == 0)
        return;
    tn_diagnostic *diagnostic = tn_report_bare(
        said(r), TN_WARNING, W_SENTENCES_FAIL, "of %u sentences of the first generation, %u have no score: %s",
        s.scored + s.failed + s.limited, s.failed + s.limited, reasons.items[0].text);
    tn_help(said(r), diagnostic,
            "that is why %u of them have none; the grammar may be for another program or other data",
            reasons.items[0].count);
}

/* The best by its score may lack what is required: then the score says little. */
static void warn_of_unmet(const evolving_run *r)
{
    const tn_bred_forms *forms = &r->e.job.forms;
    size_t count;
    const tn_individual *const *members = tn_evolution_members(r->e.run.evolution, &count);
    char *text = NULL;
    tn_error error;
    if (!forms->unmet || !count || members[0]->score.state != TN_SCORED ||
        forms->unmet(forms->context, members[0]->sentence, &text, &error) != TN_OK || !text[0]) {
        free(text);
        return;
    }
    tn_diagnostic *d = tn_report_bare(said(r), TN_WARNING, W_BEST_LACKS,
                                      "the best %s does not meet what is required of it", forms->what);
    for (char *line = text, *end; (end = strchr(line, '\n')); line = end + 1)
        tn_note(said(r), d, NULL, "%.*s", (int)(end - line), line);
    if (r->e.job.settings.select.selection != TN_SELECT_NSGA2)
        tn_help(said(r), d, "with `selection nsga2`, what meets more of it is always better");
    free(text);
}

/* ---- bred */

/* Those that were made before. */
static tn_status put_stored(const evolving_run *r, tn_error *error)
{
    tn_generation_stats *stats = NULL;
    size_t count = 0;
    tn_status status = tn_run_stats(&r->e.run, &stats, &count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        tn_run_generation *row = TN_ADD(run_generation, r->told->generations, error);
        if (row)
            tn_generation_put(&stats[i], row);
        else
            status = TN_MEMORY;
    }
    free(stats);
    return status;
}

/* Whoever waits for it is told of each generation. */
static void tell_so_far(const evolving_run *r)
{
    const tn_session *session = r->e.session;
    if (session->so_far)
        session->so_far(session->so_far_context, r->answer);
    tn_watch_tell(session->opened->module->watch, r->e.run.generations, (double)r->e.generations + 1);
}

/* Is there another generation to breed? Several ranks give the same answer: an interrupt ends the step of all of them.
 */
static bool goes_on(evolving_run *r)
{
    tn_run *run = &r->e.run;
    bool exhausted = tn_run_exhausted(run), left = run->generations <= r->e.generations;
    bool wanted = left && !exhausted && !tn_run_reached(run);
    r->told->has_exhausted = left && exhausted;
    r->told->exhausted = run->sentences;
    return wanted && (tn_ranks_several(r->e.session->ranks) || !tn_watch_stopped(r->e.watch));
}

static tn_status step(evolving_run *r, tn_error *error)
{
    tn_run *run = &r->e.run;
    tn_status status = tn_run_step(run, NULL, 0, error);
    if (status != TN_OK)
        return status;
    if (r->lead && run->generations == 1) {
        warn_of_failures(r);
        tn_evolving_warn(&r->e);
    }
    tn_run_generation *row = TN_ADD(run_generation, r->told->generations, error);
    status = tn_ranks_agree(r->e.session->ranks, row ? TN_OK : TN_MEMORY, error);
    if (status != TN_OK)
        return status;
    const tn_generation_stats stats = tn_evolution_stats(run->evolution);
    tn_generation_put(&stats, row);
    tell_so_far(r);
    return TN_OK;
}

static tn_status breed_all(evolving_run *r, tn_error *error)
{
    tn_status status = tn_ranks_agree(r->e.session->ranks, put_stored(r, error), error);
    if (status == TN_OK)
        tell_so_far(r);
    while (status == TN_OK && goes_on(r))
        status = step(r, error);
    return status == TN_OK ? tn_run_settle(&r->e.run, error) : status;
}

/* ---- told */

static void put_first_genomes(const evolving_run *r)
{
    const tn_evolution_settings *s = &r->e.job.settings;
    size_t given = s->seed_count < s->population ? s->seed_count : s->population, left = s->population - given;
    size_t full = (s->population + 1) / 2 - (given + 1) / 2; /* of both kinds: even numbers full and odd ones grown */
    bool ramped = s->initialisation == TN_INITIALISE_RAMPED, random = s->initialisation == TN_INITIALISE_RANDOM;
    r->told->has_first_genomes = r->e.job.grammar != NULL;
    r->told->first_genomes = (tn_first_genomes){.given = given,
                                                .has_full = ramped,
                                                .full = full,
                                                .has_grown = !random,
                                                .grown = ramped ? left - full : left,
                                                .has_random = random,
                                                .random = left};
}

static tn_status put_reasons(const evolving_run *r, tn_error *error)
{
    tn_reasons reasons;
    if (tn_run_reasons(&r->e.run, &reasons, error) != TN_OK)
        return TN_OK; /* then they are not known */
    tn_status status = TN_NEW_LIST(no_score_reason, r->told->reasons, reasons.count, error);
    for (size_t i = 0; status == TN_OK && i < reasons.count; i++) {
        const tn_reason *reason = &reasons.items[i];
        r->told->reasons.items[i] =
            (tn_no_score_reason){.text = strdup(reason->text),
                                 .state = reason->state == TN_SCORE_LIMIT ? "limited" : "failed",
                                 .members = reason->count,
                                 .individual = reason->first};
        if (!r->told->reasons.items[i].text)
            status = tn_fail_memory(error);
    }
    return status;
}

/* What the best is worth with data that nobody has looked at yet. */
static void put_test(const evolving_run *r, const tn_individual *best)
{
    const tn_evolution_job *job = &r->e.job;
    tn_fit_report report;
    tn_error error;
    if (!job->problem || !job->study.of[TN_SET_FIT].written ||
        tn_problem_examine(job->problem, best->sentence, best->sentence_size, &report, &error) != TN_OK)
        return;
    r->told->has_intercept = r->told->has_slope = job->study.of[TN_SET_SCALING].choice != 0;
    r->told->intercept = report.line[0];
    r->told->slope = report.line[1];
    r->told->has_test = tn_problem_holds(job->problem);
    r->told->test = report.test;
}

static tn_status put_best(const evolving_run *r, tn_error *error)
{
    size_t count;
    const tn_individual *const *members = tn_evolution_members(r->e.run.evolution, &count);
    const tn_individual *best = count ? members[0] : NULL;
    if (!best)
        return TN_OK;
    r->told->has_best = best->score.state == TN_SCORED;
    if (r->told->has_best) {
        put_test(r, best);
        return tn_individual_put(best, &r->told->best, error);
    }
    bool valid = best->reason == TN_MAPPING_VALID;
    r->told->has_why_none = true;
    r->told->why_none = strdup(valid ? best->message : tn_mapping_reason_text(best->reason));
    return r->told->why_none ? TN_OK : tn_fail_memory(error);
}

/* Also of a run that was stopped, or failed, as far as it went. */
static tn_status put_run(const evolving_run *r, tn_error *error)
{
    if (r->e.run.generations == 0)
        return TN_OK;
    const tn_generation_stats newest = tn_evolution_stats(r->e.run.evolution);
    r->told->has_newest = true;
    tn_generation_put(&newest, &r->told->newest);
    put_first_genomes(r);
    tn_status status = put_reasons(r, error);
    return status == TN_OK ? put_best(r, error) : status;
}

static tn_status make_files(evolving_run *r, bool page, tn_error *error)
{
    tn_run_making making;
    bool made;
    tn_run_making_begin(&making, &r->e, (tn_list *)&r->told->files);
    tn_status status = tn_run_results(&r->e.run, making.files, error);
    return status == TN_OK && page ? tn_sheet_page(&r->e.run, making.files, &made, error) : status;
}

static void note_rest(const evolving_run *r)
{
    const tn_run *run = &r->e.run;
    if (run->new_changes)
        tn_session_note(r->e.session,
                        "what --set changed is kept with the next generation: --generations %u breeds one",
                        run->generations);
    if (r->told->has_exhausted)
        tn_session_note(r->e.session,
                        "the grammar has %zu sentences, and all have been scored: more generations find nothing new",
                        run->sentences);
}

/* TN_STOPPED with what there is by then. */
static tn_status evolve(evolving_run *r, bool page)
{
    const tn_ranks *ranks = r->e.session->ranks;
    tn_error error, telling;
    tn_status status = breed_all(r, &error);
    bool stopped = tn_ranks_any(ranks, tn_watch_stopped(r->e.watch) || status == TN_STOPPED);
    if (status == TN_STOPPED)
        status = TN_OK; /* within a generation, which is not kept */
    bool results = status == TN_OK && !stopped && r->lead && r->e.run.generations;
    if (results)
        status = make_files(r, page, &error);
    if (results && status == TN_OK)
        warn_of_unmet(r);
    tn_status told = r->lead ? put_run(r, &telling) : TN_OK;
    if (status == TN_OK && told != TN_OK)
        error = telling;
    status = status == TN_OK ? told : status;
    if (status != TN_OK)
        return tn_session_fail(r->e.session, &error);
    if (r->lead)
        note_rest(r);
    return stopped ? TN_STOPPED : TN_OK;
}

tn_status tn_ask_evolve(tn_session *session, const tn_evolve_request *request, tn_reply *answer)
{
    evolving_run r = {.e = {.session = session, .asked = &request->asked, .watch = session->opened->module->watch},
                      .answer = answer,
                      .lead = tn_ranks_lead(session->ranks)};
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = tn_evolving_begin(&r.e);
    if (status == TN_OK) {
        status = tn_ranks_agree(session->ranks, tn_reply_new(&tn_message_evolved, answer, &error), &error);
        status = status == TN_OK ? TN_OK : tn_session_fail(session, &error);
    }
    if (status == TN_OK) {
        r.told = answer->value;
        r.told->has_run = request->asked.run != NULL;
        r.told->run = request->asked.run;
        status = evolve(&r, request->page);
    }
    tn_evolving_clear(&r.e);
    return status;
}
