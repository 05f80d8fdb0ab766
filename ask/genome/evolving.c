/* Puts a run together for questions that breed. */
#include "ask/genome/evolving.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/formats.h"
#include "runtime/ranks/ranks.h"

static tn_diagnostics *said(const tn_evolving *e)
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
    tn_diagnostic *diagnostic = tn_report_error(said(e), error, job->blamed_path, NULL, 0);
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
        said(e), TN_WARNING, W_OPEN_BOUNDARY,
        "the boundary mesh %.200s is open, or has edges of more than two faces: nothing is inside it", mesh);
    tn_help(said(e), d, "close it, or leave `inside` out: it stops what crosses it from either side");
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
        tn_diagnostic *d = tn_report_bare(said(e), TN_WARNING, finding->code, "%s", finding->message);
        if (finding->help[0])
            tn_help(said(e), d, "%s", finding->help);
    }
}

/* ---- as answers have them */

void tn_generation_put(const tn_generation_stats *s, tn_run_generation *to)
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
