/* evolve, runs, individual, change_run: breeds what a study wants, generation by generation; looks at runs that were
 * made, and changes them; and puts runs together for all questions that breed. */
#include "ask/genome/evolve.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "driver/breed/evolve.h"
#include "driver/sheet/sheet_page.h"
#include "runtime/base/formats.h"
#include "runtime/ranks/ranks.h"

#define TN_REASONS_MAX 32u /* reasons that are told apart; what else there is counts as the last */

typedef struct tn_reason {
    char text[200];
    tn_score_state state;
    uint32_t count;
    uint64_t first; /* the lowest id of them */
} tn_reason;

/* The most frequent first. */
typedef struct tn_reasons {
    tn_reason items[TN_REASONS_MAX];
    size_t count;
} tn_reasons;

/* ---- why sentences could not be scored */

/* Why individuals of a generation have no score, each reason once. */

static void count_reason(tn_reasons *r, tn_score_state state, const char *text, uint64_t id)
{
    size_t at = 0;
    while (at < r->count && (r->items[at].state != state || strcmp(r->items[at].text, text) != 0))
        at++;
    if (at == TN_REASONS_MAX)
        at--;
    if (at == r->count) {
        r->items[r->count++] = (tn_reason){.state = state, .first = id};
        snprintf(r->items[at].text, sizeof r->items[at].text, "%s", text);
    }
    r->items[at].count++;
    if (id < r->items[at].first)
        r->items[at].first = id;
}

static int compare_reasons(const void *left, const void *right)
{
    const tn_reason *a = left, *b = right;
    if (a->count != b->count)
        return a->count > b->count ? -1 : 1;
    return strcmp(a->text, b->text);
}

/* The message of a member with this sentence that was evaluated in this generation, or NULL. */
static const char *known_message(const tn_individual *const *members, size_t count, const tn_individual *wanted)
{
    for (size_t i = 0; i < count; i++)
        if (members[i]->message[0] && members[i]->hash[0] == wanted->hash[0] && members[i]->hash[1] == wanted->hash[1])
            return members[i]->message;
    return NULL;
}

static tn_status reason_of(const tn_run *run, const tn_individual *member, char message[200], tn_error *error)
{
    const tn_evaluator *evaluator = &run->job->evaluator;
    tn_score score = {0};
    tn_status status = run->store ? tn_run_store_message(run->store, member->id, message, error) : TN_OK;
    if (status != TN_OK || (run->store && message[0]))
        return status;
    message[0] = '\0';
    return evaluator->evaluate(evaluator->context, 0, member->sentence, member->sentence_size, &score, message, error);
}

/* Of the members that failed or passed a limit. Messages are not stored with scores that are known already: such a
 * sentence is evaluated once more, if the database does not say why either. TN_OK, or what went wrong. */
static tn_status run_reasons(const tn_run *run, tn_reasons *reasons, tn_error *error)
{
    size_t count;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    tn_status status = TN_OK;
    *reasons = (tn_reasons){0};
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        tn_score_state state = members[i]->score.state;
        char message[200];
        if (state != TN_SCORE_FAILED && state != TN_SCORE_LIMIT)
            continue;
        const char *known = known_message(members, count, members[i]);
        if (!known)
            status = reason_of(run, members[i], message, error);
        count_reason(reasons, state, known ? known : message, members[i]->id);
    }
    qsort(reasons->items, reasons->count, sizeof *reasons->items, compare_reasons);
    return status;
}

/* ---- a run put together */

static tn_diagnostics *diagnostics_of(const tn_evolving *e)
{
    return &e->session->opened->compilation.diagnostics;
}

/* What a setting names is to blame: in the file itself, where that has the place, or else where the study names it. */
static tn_status blame(tn_evolving *e, const tn_evolution_study *study, const tn_error *error)
{
    const tn_evolution_job *job = &e->job;
    bool repeats = job->blamed < TN_SETTING_COUNT && tn_setting_rows[job->blamed].kind == TN_SETTING_EACH;
    const tn_setting_value *value = job->blamed == TN_SETTING_COUNT ? NULL
                                    : repeats                       ? &study->each[job->blamed_each].value
                                                                    : &study->of[job->blamed];
    if (!value || !value->written || error->status == TN_MEMORY)
        return tn_session_fail(e->session, error);
    tn_diagnostic *diagnostic = tn_report_error(diagnostics_of(e), error, job->blamed_path, NULL, 0);
    if (error->line)
        return error->status;
    diagnostic->has_span = true;
    diagnostic->span = (tn_span){value->file, value->begin, value->end};
    return error->status;
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
    tn_buffer whole = {0};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (study->of[numbers[i].setting].written)
            tn_buffer_printf(&whole, "%s %.0f\n", numbers[i].directive, study->of[numbers[i].setting].first);
    tn_buffer_append(&whole, text, strlen(text));
    if (!whole.failed)
        return whole.data;
    free(whole.data);
    return NULL;
}

static tn_status open_study(tn_evolving *e, tn_evolution_study *study)
{
    tn_opened *opened = e->session->opened;
    tn_error error;
    if (tn_evolution_study_of(opened->module, study))
        return TN_OK;
    tn_fail(&error, TN_INVALID, E_EVOLUTION_SYNTAX, "%.200s has no block `evolution { ... }`", opened->path);
    tn_error_help(
        &error, "%s",
        tn_opened_help(opened, "a study to be evolved is a .study file with a block `evolution { ... }`").text);
    return tn_session_fail(e->session, &error);
}

/* May it be bred so? */
static tn_status check_job(tn_evolving *e, const tn_evolution_study *study)
{
    const char *path = e->session->opened->path;
    tn_error error;
    if (e->remembers && study->of[TN_SET_ISLANDS].first > 1) {
        tn_fail(&error, TN_INVALID, E_EVOLUTION_VALUE,
                "a person chooses parents from one population, not from islands");
        tn_error_help(&error, "leave `islands` and `migrate` out, or have it bred: tartan evolve %.200s", path);
        e->job.blamed = TN_SET_ISLANDS;
        return blame(e, study, &error);
    }
    if (e->remembers || !e->job.settings.kind || e->job.scored) /* with `breed`, a person chooses */
        return TN_OK;
    tn_fail(&error, TN_INVALID, E_EVOLUTION_VALUE, "the study does not say what to evolve towards");
    tn_error_help(&error, "add a goal, as `fitness volume target 200`; or choose parents yourself: tartan breed %s",
                  path);
    return tn_session_fail(e->session, &error);
}

static tn_status make_job(tn_evolving *e, const tn_evolution_study *study)
{
    const tn_run_asked *asked = e->asked;
    tn_opened *opened = e->session->opened;
    const tn_ranks *ranks = e->session->ranks;
    tn_error error;
    const tn_evolution_job_options options = {.threads = ranks && !asked->has_threads ? 1 : (unsigned)asked->threads,
                                              .watch = e->watch,
                                              .ranks = ranks,
                                              .says_seed = asked->has_seed,
                                              .seed = asked->seed,
                                              .run_programs = asked->run_programs,
                                              .remembers = e->remembers,
                                              .draws_open = asked->open};
    if (asked->open && tn_evolution_study_use(study) != TN_USE_TREES)
        return tn_session_refuse(e->session, "leave it out",
                                 "--open is about fields, and this study breeds something else");
    e->generations = (uint32_t)(asked->has_generations ? asked->generations : study->of[TN_SET_GENERATIONS].first);
    if (tn_evolution_job_make(study, opened->path, opened->module, &options, &e->job, &error) != TN_OK)
        return blame(e, study, &error);
    return check_job(e, study);
}

static void warn_of_open_mesh(const tn_evolving *e)
{
    const char *mesh = e->job.grower ? tn_grower_open_mesh(e->job.grower) : NULL;
    if (!mesh || !tn_ranks_lead(e->session->ranks))
        return;
    tn_diagnostic *d = tn_report_bare(
        diagnostics_of(e), TN_WARNING, W_OPEN_BOUNDARY,
        "the boundary mesh %.200s is open, or has edges of more than two faces: nothing is inside it", mesh);
    tn_help(diagnostics_of(e), d, "close it, or leave `inside` out: it stops what crosses it from either side");
}

static tn_status begin_run(tn_evolving *e, const tn_evolution_study *study, tn_error *error)
{
    const tn_module *module = e->session->opened->module;
    const tn_run_asked *asked = e->asked;
    const tn_run_options options = {.resume = asked->resume, .durable = asked->durable, .rescore = asked->rescore};
    bool codons = tn_evolution_study_use(study) == TN_USE_CODONS; /* forms have no grammar */
    const tn_source_record *grammar = codons ? &module->SOURCE_records[module->GRAMMAR_records[0].file] : NULL,
                           *text = &module->SOURCE_records[codons ? study->of[TN_SET_GRAMMAR].file : 0];
    char *whole = grammar_text(study, grammar ? tn_text(module, grammar->text) : "");
    const tn_run_texts texts = {tn_text(module, text->path), tn_text(module, text->text),
                                grammar ? tn_text(module, grammar->path) : "", whole};
    tn_status status =
        whole ? tn_run_begin(&e->job, asked->run, &options, &texts, &e->run, error) : tn_fail_memory(error);
    free(whole);
    return status;
}

tn_status tn_run_asked_check(tn_session *session, const tn_run_asked *asked)
{
    if (asked->set.count && !asked->resume)
        return tn_session_refuse(session, NULL,
                                 "--set changes a run that has begun: say --resume too, or change the study itself");
    if (asked->rescore && !asked->resume)
        return tn_session_refuse(session, NULL, "--rescore is about a run that has begun: say --resume too");
    if (asked->resume && !asked->run)
        return tn_session_refuse(session, NULL, "--resume goes on with the run of a folder: say which");
    return TN_OK;
}

tn_status tn_evolving_begin(tn_evolving *e)
{
    tn_evolution_study study;
    tn_error error = {0};
    tn_status status = tn_run_asked_check(e->session, e->asked);
    if (status == TN_OK)
        status = open_study(e, &study);
    if (status == TN_OK)
        status = make_job(e, &study);
    if (status == TN_OK)
        warn_of_open_mesh(e);
    if (tn_ranks_any(e->session->ranks, status != TN_OK))
        return status == TN_OK ? TN_INVALID : status; /* another rank says why */
    status = begin_run(e, &study, &error);
    for (size_t i = 0; status == TN_OK && i < e->asked->set.count; i++)
        status = tn_run_set(&e->run, e->asked->set.items[i], &error);
    return status == TN_OK ? TN_OK : tn_session_fail(e->session, &error);
}

void tn_evolving_clear(tn_evolving *e)
{
    tn_run_clear(&e->run);
    tn_evolution_job_clear(&e->job);
}

void tn_evolving_warn(const tn_evolving *e)
{
    for (size_t i = 0; i < e->run.look.count; i++) {
        const tn_finding *finding = &e->run.look.items[i];
        tn_diagnostic *d = tn_report_bare(diagnostics_of(e), TN_WARNING, finding->code, "%s", finding->message);
        if (finding->help[0])
            tn_help(diagnostics_of(e), d, "%s", finding->help);
    }
}

/* ---- as answers have them */

static void generation_put(const tn_generation_stats *s, tn_run_generation *to)
{
    *to = (tn_run_generation){.generation = s->generation,
                              .has_best = isfinite(s->best[0]),
                              .best = s->best[0],
                              .mean = s->mean,
                              .lower_quartile = s->quartiles[0],
                              .median = s->quartiles[1],
                              .upper_quartile = s->quartiles[2],
                              .scored = s->scored,
                              .no_sentence = s->no_sentence,
                              .failed = s->failed,
                              .limited = s->limited,
                              .distinct = s->distinct,
                              .evaluations = s->evaluations,
                              .births = s->births,
                              .mean_codons = s->mean_codons,
                              .mean_depth = s->mean_depth};
}

tn_status tn_individual_put(const tn_individual *individual, tn_individual_told *to, tn_error *error)
{
    to->individual = individual->id;
    to->has_parents = individual->parents[0] != TN_NO_PARENT;
    to->has_score = individual->score.state == TN_SCORED;
    to->score = individual->score.objectives[0];
    if (to->has_parents) {
        to->parents.items = calloc(2, sizeof *to->parents.items);
        if (!to->parents.items)
            return tn_fail_memory(error);
        memcpy(to->parents.items, individual->parents, sizeof individual->parents);
        to->parents.count = 2;
    }
    to->sentence = strdup(individual->sentence);
    to->genome = tn_genome_text(&individual->genome);
    return to->sentence && to->genome ? TN_OK : tn_fail_memory(error);
}

/* ---- files into the answer */

static tn_status open_made(void *context, const char *name, FILE **stream, tn_error *error)
{
    tn_run_making *m = context;
    tn_made_file *to = tn_message_add(&tn_message_made_file, m->list, error);
    if (!to)
        return TN_MEMORY;
    tn_file_format format = tn_file_format_of(name);
    bool other = format == TN_FILE_OTHER; /* a sentence of a grammar */
    tn_status status = tn_making_begin(&m->making, m->session, other ? TN_FILE_RULES : format, name, to, error);
    *stream = status == TN_OK ? m->making.stream : NULL;
    if (status == TN_OK && !to->format[0]) /* rules and sentences have no word of their own */
        to->format = strrchr(to->name, '.') ? strrchr(to->name, '.') + 1 : "";
    return status;
}

static tn_status close_made(void *context, tn_status status, tn_error *error)
{
    tn_run_making *m = context;
    return tn_making_end(&m->making, status, error);
}

void tn_run_making_begin(tn_run_making *making, const tn_evolving *e, tn_list *list)
{
    *making = (tn_run_making){.session = e->session, .list = list};
    making->taker = (tn_run_files){open_made, close_made, making};
    making->files = e->asked->run ? NULL : &making->taker;
}

/* ---- evolve */

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
    if (run_reasons(run, &reasons, &error) != TN_OK || reasons.count == 0)
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
            generation_put(&stats[i], row);
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
    generation_put(&stats, row);
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
    if (run_reasons(&r->e.run, &reasons, error) != TN_OK)
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
    generation_put(&newest, &r->told->newest);
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

/* ---- what a run's database says of it */

static tn_status put_generations(tn_run_store *store, tn_run_told *told, tn_error *error)
{
    tn_generation_stats *stats = NULL;
    size_t count = 0;
    tn_status status = tn_run_store_stats(store, &stats, &count, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(run_generation, told->generations, count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        generation_put(&stats[i], &told->generations.items[i]);
    told->has_best_first_at = status == TN_OK && count > 0;
    size_t first = 0;
    while (told->has_best_first_at && first + 1 < count && stats[first].best[0] > stats[count - 1].best[0])
        first++;
    if (told->has_best_first_at)
        told->best_first_at = stats[first].generation;
    free(stats);
    return status;
}

/* Takes the texts of the events. */
static tn_status put_events(tn_run_store *store, tn_run_told *told, tn_error *error)
{
    tn_run_event *events = NULL;
    size_t count = 0;
    tn_status status = tn_run_store_events(store, &events, &count, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(told_event, told->events, count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        told->events.items[i] = (tn_told_event){events[i].generation, events[i].kind, events[i].text};
        events[i].kind = events[i].text = NULL;
    }
    tn_run_events_free(events, count);
    return status;
}

static tn_status tell_run(const char *dir, tn_run_told *told, tn_error *error)
{
    tn_run_store *store = NULL;
    char *path = tn_run_database(dir);
    told->run = dir;
    tn_status status = path ? tn_run_store_open(path, false, true, &store, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_run_store_get_meta(store, "identity", &told->settings, error);
    told->has_settings = told->settings != NULL;
    if (status == TN_OK)
        status = put_generations(store, told, error);
    if (status == TN_OK)
        status = put_events(store, told, error);
    tn_run_store_free(store);
    free(path);
    return status;
}

tn_status tn_ask_runs(tn_session *session, const tn_runs_request *request, tn_reply *answer)
{
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = tn_reply_new(&tn_message_runs_told, answer, &error);
    tn_runs_told *told = answer->value;
    if (status == TN_OK)
        status = TN_NEW_LIST(run_told, told->runs, request->runs.count, &error);
    for (size_t i = 0; status == TN_OK && i < request->runs.count; i++)
        status = tell_run(request->runs.items[i], &told->runs.items[i], &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* ---- an individual */

tn_status tn_ask_individual(tn_session *session, const tn_individual_request *request, tn_reply *answer)
{
    tn_evolution_job evolved = {0};
    tn_run run = {0};
    tn_opened opened = {0};
    const tn_individual *individual;
    tn_error error = {0};
    *answer = (tn_reply){0};
    tn_status status = tn_run_replay(request->run, request->individual, &opened, &evolved, &run, &individual, &error);
    if (status == TN_OK)
        status = tn_reply_new(&tn_message_individual_told, answer, &error);
    if (status == TN_OK)
        status = tn_individual_put(individual, answer->value, &error);
    if (status != TN_OK)
        tn_session_fail(session, &error);
    tn_run_clear(&run);
    tn_evolution_job_clear(&evolved);
    tn_close(&opened);
    return status;
}

/* ---- what is left for a run that goes on later */

static tn_status leave(tn_session *session, const tn_change_run_request *request, tn_run_event *left)
{
    tn_evolution_job evolved = {0};
    tn_run run = {0};
    tn_opened opened = {0};
    tn_error error = {0};
    char *sentence = NULL;
    const char *kind = request->has_remove ? "remove" : request->has_in_place_of ? "edit" : "insert";
    uint64_t member = request->has_remove        ? request->remove
                      : request->has_in_place_of ? request->in_place_of
                                                 : TN_NO_PARENT;
    tn_status status = tn_run_leave(request->run, kind, request->has_remove ? NULL : request->sentence, member, &opened,
                                    &evolved, &run, left, &sentence, &error);
    if (status != TN_OK && sentence && error.line)
        tn_report_error(&session->opened->compilation.diagnostics, &error, request->file ? request->file : "sentence",
                        sentence, strlen(sentence));
    else if (status != TN_OK)
        tn_session_fail(session, &error);
    free(sentence);
    tn_run_clear(&run);
    tn_evolution_job_clear(&evolved);
    tn_close(&opened);
    return status;
}

tn_status tn_ask_change_run(tn_session *session, const tn_change_run_request *request, tn_reply *answer)
{
    tn_run_event left = {0};
    tn_error error;
    *answer = (tn_reply){0};
    if ((request->sentence != NULL) == request->has_remove || (request->has_in_place_of && request->has_remove))
        return tn_session_refuse(session, NULL,
                                 "say what is changed: a sentence that is inserted, or a member that is taken out");
    if (tn_reply_new(&tn_message_told_event, answer, &error) != TN_OK)
        return tn_session_fail(session, &error);
    tn_status status = leave(session, request, &left);
    *(tn_told_event *)answer->value = (tn_told_event){left.generation, left.kind, left.text};
    return status;
}
