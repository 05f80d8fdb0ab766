/* Begins a run in a folder, or opens the one that is there and sees that it is of the same study, grammar and inputs;
 * makes stored runs again. */
#include "driver/breed/evolve_begin.h"

#include <errno.h>
#include <fcntl.h>
#include <float.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

#include "compiler/evolution/evolution.h"
#include "driver/breed/evolve.h"
#include "driver/breed/inputs.h"
#include "runtime/base/file.h"
#include "runtime/math/elementary.h"

/* ---- first generations with few different sentences, or with none that names a column; data without names */

#define FEW 4u              /* different sentences are few where they are fewer than one in so many */
#define SENTENCES_LEAST 10u /* of fewer, nothing is said */
#define TRIAL_MOST 2000u    /* individuals of a generation that is made to see what another depth gives */
#define DEPTH_MOST 10000u   /* of settings.def */
#define SHOWN 90            /* bytes of the columns' names */

static tn_finding *add(tn_first_look *look, tn_code code)
{
    tn_finding *finding = &look->items[look->count++];
    *finding = (tn_finding){.code = code};
    return finding;
}

/* ---- few different sentences */

static tn_status score_nothing(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                               char message[200], tn_error *error)
{
    (void)context, (void)thread, (void)sentence, (void)size, (void)message, (void)error;
    score->objectives[0] = 0;
    return TN_OK;
}

/* How many different sentences a first generation has that is made so; nobody scores it. */
static tn_status try(const tn_run *run, const tn_evolution_settings *settings, uint32_t *distinct, tn_error *error)
{
    static const tn_evaluator evaluator = {.objectives = 1, .evaluate = score_nothing};
    tn_evolution *trial = NULL;
    tn_status status = tn_evolution_new(run->job->grammar, settings, &evaluator, &trial, error);
    if (status == TN_OK)
        status = tn_evolution_step(trial, error);
    *distinct = status == TN_OK ? tn_evolution_stats(trial).distinct : 0;
    tn_evolution_free(trial);
    return status;
}

/* Another way to make the first generation. */
typedef struct proposal {
    tn_initialisation initialisation;
    uint32_t deeper; /* levels that the largest depth is raised by */
} proposal;

static void propose(const tn_evolution_settings *from, const proposal *p, tn_evolution_settings *to)
{
    *to = *from;
    to->initialisation = p->initialisation;
    to->depth_high += to->depth_high + p->deeper <= DEPTH_MOST ? p->deeper : 0;
    to->select = (tn_select_options){.selection = TN_SELECT_TOURNAMENT, .tournament = 2};
    to->islands = 1;
    to->every = 0;
    to->population = from->population < TRIAL_MOST ? from->population : TRIAL_MOST;
    to->elites = 1;
    to->remembers = false;
    to->ranks = NULL;
}

static void describe(const tn_evolution_settings *now, const tn_evolution_settings *other, uint32_t distinct,
                     tn_finding *finding)
{
    char depth[48];
    snprintf(depth, sizeof depth, "`depth %u..%u`", other->depth_low, other->depth_high);
    const char *way = other->initialisation == TN_INITIALISE_PI_GROW ? "`initialise pi-grow`" : "`initialise ramped`";
    bool other_way = now->initialisation != other->initialisation, deeper = now->depth_high != other->depth_high;
    snprintf(finding->help, sizeof finding->help, "%s%s%s makes %u different ones of %u", other_way ? way : "",
             other_way && deeper ? " with " : "", deeper ? depth : "", distinct, other->population);
}

/* The first way that makes twice as many, and half of them different; or else the best of those that make half as many
 * again. */
static tn_status find_better(const tn_run *run, tn_finding *finding, tn_error *error)
{
    const tn_evolution_settings *now = &run->job->settings;
    bool random = now->initialisation == TN_INITIALISE_RANDOM;
    tn_initialisation method = random ? TN_INITIALISE_RAMPED : now->initialisation;
    const proposal proposals[] = {
        {method, random ? 0 : 2}, {method, 4}, {TN_INITIALISE_PI_GROW, 0}, {method, 8}, {TN_INITIALISE_PI_GROW, 4}};
    tn_evolution_settings settings;
    uint32_t distinct, today, best;
    propose(now, &(proposal){now->initialisation, 0}, &settings);
    tn_status status = try(run, &settings, &today, error);
    best = today + today / 2;
    for (size_t i = 0; i < sizeof proposals / sizeof *proposals && status == TN_OK; i++) {
        propose(now, &proposals[i], &settings);
        status = try(run, &settings, &distinct, error);
        if (status != TN_OK || distinct <= best)
            continue;
        best = distinct;
        describe(now, &settings, distinct, finding);
        if (distinct >= 2 * today && distinct >= settings.population / 2)
            break;
    }
    return status;
}

static tn_status look_for_few(const tn_run *run, tn_first_look *look, tn_error *error)
{
    tn_generation_stats s = tn_evolution_stats(run->evolution);
    uint32_t sentences = s.scored + s.failed + s.limited;
    if (!run->job->grammar || sentences < SENTENCES_LEAST || s.distinct * FEW >= sentences)
        return TN_OK;
    tn_finding *finding = add(look, W_FEW_SENTENCES);
    snprintf(finding->message, sizeof finding->message,
             "of %u sentences of the first generation, only %u are different", sentences, s.distinct);
    return find_better(run, finding, error);
}

/* ---- no column */

static void name_columns(const tn_problem *problem, char *text, size_t size)
{
    size_t count, length = 0;
    const char *const *names = tn_problem_columns(problem, &count);
    text[0] = '\0';
    for (size_t i = 0; i < count && length < SHOWN; i++)
        length += (size_t)snprintf(text + length, size - length, "%s`%.40s`", i ? ", " : "", names[i]);
}

static tn_status look_for_columns(const tn_run *run, tn_first_look *look, tn_error *error)
{
    size_t count;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    bool read = false;
    if (!run->job->problem || !run->job->study.of[TN_SET_FIT].written)
        return TN_OK;
    for (size_t i = 0; i < count; i++) {
        bool names;
        if (members[i]->score.state != TN_SCORED)
            continue;
        tn_status status =
            tn_problem_names_column(run->job->problem, members[i]->sentence, members[i]->sentence_size, &names, error);
        if (status != TN_OK || names)
            return status;
        read = true;
    }
    if (!read)
        return TN_OK; /* why not is told */
    char names[200];
    name_columns(run->job->problem, names, sizeof names);
    tn_finding *finding = add(look, W_NO_COLUMN);
    snprintf(finding->message, sizeof finding->message,
             "no sentence of the first generation that can be scored names a column of the data");
    snprintf(finding->help, sizeof finding->help,
             "its columns are %s; the grammar can also say x[:, 0], x[:, 1] and so on", names);
    return TN_OK;
}

/* A line of numbers is no line of names, whatever was meant. */
static void look_for_names(const tn_run *run, tn_first_look *look)
{
    if (!run->job->problem || !run->job->study.of[TN_SET_FIT].written || !tn_problem_unnamed(run->job->problem))
        return;
    char names[200];
    name_columns(run->job->problem, names, sizeof names);
    tn_finding *finding = add(look, W_NO_HEADER);
    snprintf(finding->message, sizeof finding->message,
             "the data have no line of names: their first line is numbers, and is fitted, too");
    snprintf(finding->help, sizeof finding->help,
             "the columns are called %s and, what is wanted, `y`; write a first line with their names, or one that "
             "begins with # if these are numbers",
             names);
}

tn_status tn_run_first_look(const tn_run *run, tn_first_look *look, tn_error *error)
{
    *look = (tn_first_look){0};
    look_for_names(run, look);
    tn_status status = look_for_few(run, look, error);
    if (status == TN_OK)
        status = look_for_columns(run, look, error);
    for (size_t i = 0; i < look->count; i++) {
        const tn_finding said = look->items[i];
        snprintf(look->items[i].text, sizeof look->items[i].text, "%s%s%s", said.message, said.help[0] ? "; " : "",
                 said.help);
    }
    return status;
}

/* ---- beginning, and opening a folder */

static tn_status put_meta(tn_run *run, const tn_run_texts *texts, tn_error *error)
{
    char seed[24], objectives[24], arithmetic[24];
    const tn_evolution_job *job = run->job;
    snprintf(seed, sizeof seed, "%" PRIu64, job->settings.seed);
    snprintf(objectives, sizeof objectives, "%zu", job->evaluator.objectives);
    snprintf(arithmetic, sizeof arithmetic, "%d", TN_NUMERIC_VERSION);
    const char *const keys[] = {"format", "arithmetic",   "identity", "seed",   "objectives", "study_path",
                                "study",  "grammar_path", "grammar",  "inputs", "seeds"};
    const char *const values[] = {"1",
                                  arithmetic,
                                  job->identity,
                                  seed,
                                  objectives,
                                  run->study,
                                  texts->study_text,
                                  texts->grammar_path,
                                  texts->grammar_text,
                                  job->inputs ? job->inputs : "",
                                  job->seeds_text};
    size_t count = sizeof keys / sizeof *keys;
    _Static_assert(sizeof keys == sizeof values, "a value for each key");
    return tn_run_store_put_meta(run->store, keys, values, job->seeds_text ? count : count - 1, error);
}

static void start_anew(tn_error *error)
{
    tn_error_help(error,
                  "only `generations`, `stop` and `program-timeout` may change in between; -o DIR starts another run");
}

/* Scores, and what is grown again of a genome, hang on the last digits of elementary functions. Runs from before these
 * had versions were made with the first. */
static tn_status run_same_arithmetic(const tn_run *run, tn_error *error)
{
    char *stored;
    tn_status status = tn_run_store_get_meta(run->store, "arithmetic", &stored, error);
    int was = stored ? atoi(stored) : 1;
    free(stored);
    if (status != TN_OK || was == TN_NUMERIC_VERSION)
        return status;
    tn_fail(error, TN_INVALID, E_RUN_DIFFERS,
            "the run in %.200s was made with arithmetic %d, and this Tartan has arithmetic %d: sines and exponentials "
            "differ in their last digits",
            run->dir, was, TN_NUMERIC_VERSION);
    tn_error_help(error, "continue with the version of Tartan that began it, or start another run with -o DIR");
    return TN_INVALID;
}

/* The identity has a setting a line: the first that differs is named. */
static tn_status same_study(tn_run *run, tn_error *error)
{
    char *stored;
    tn_status status = tn_run_store_get_meta(run->store, "identity", &stored, error);
    const char *was = stored ? stored : "", *is = run->job->identity;
    if (status == TN_OK && strcmp(was, is) != 0) {
        while (strcspn(was, "\n") == strcspn(is, "\n") && *was && strncmp(was, is, strcspn(is, "\n") + 1) == 0) {
            size_t line = strcspn(is, "\n") + 1;
            was += line;
            is += line;
        }
        status = tn_fail(error, TN_INVALID, E_RUN_DIFFERS,
                         "the run in %.100s was started with another study: it has `%.*s`, and this one `%.*s`",
                         run->dir, (int)strcspn(was, "\n"), was, (int)strcspn(is, "\n"), is);
        start_anew(error);
    }
    free(stored);
    return status;
}

static tn_status same_grammar(tn_run *run, const char *now, tn_error *error)
{
    char *stored;
    tn_status status = tn_run_store_get_meta(run->store, "grammar", &stored, error);
    if (status == TN_OK && (!stored || strcmp(stored, now) != 0)) {
        status =
            tn_fail(error, TN_INVALID, E_RUN_DIFFERS, "the run in %.200s was started with another grammar", run->dir);
        start_anew(error);
    }
    free(stored);
    return status;
}

/* Together: what was stored to be done before the next generation. */
static tn_status do_waiting(tn_run *run, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < run->waiting_count && status == TN_OK; i++)
        status = tn_run_by_hand(run, run->waiting[i].kind, run->waiting[i].text, error);
    return status;
}

/* ---- inputs: what scores depend on besides study and grammar (inputs.h) */

/* Those that the stored scores are of: what the last event "inputs" says, or else what the run began with. NULL: the
 * run is from before they were stored. The caller frees them. */
static tn_status stored_inputs(tn_run *run, char **inputs, tn_error *error)
{
    for (size_t i = run->change_count; i-- > 0;)
        if (strcmp(run->changes[i].kind, "inputs") == 0) {
            *inputs = strdup(run->changes[i].text);
            return *inputs ? TN_OK : tn_fail_memory(error);
        }
    return tn_run_store_get_meta(run->store, "inputs", inputs, error);
}

/* Which of the inputs has another content than the stored scores are of: its name, or "". */
static tn_status changed_input(tn_run *run, char *name, size_t size, tn_error *error)
{
    char *before = NULL;
    tn_status status = stored_inputs(run, &before, error);
    if (status == TN_OK && before)
        tn_inputs_difference(before, run->job->inputs ? run->job->inputs : "", name, size);
    free(before);
    return status;
}

/* Together: scores of different inputs are never mixed. All members are scored again, where that is wished, or the run
 * is not gone on with. */
static tn_status same_inputs(tn_run *run, bool may_rescore, tn_error *error)
{
    const tn_ranks *ranks = run->job->settings.ranks;
    char name[200] = "";
    tn_status status = run->store ? changed_input(run, name, sizeof name, error) : TN_OK;
    bool rescores = may_rescore && run->generations > 0;
    if (status == TN_OK && name[0] && !rescores) {
        status = tn_fail(error, TN_INVALID, E_RUN_DIFFERS,
                         "the scores in %.100s are of another file: `%.160s` has changed since", run->dir, name);
        tn_error_help(error, "-o DIR starts another run; --resume --rescore scores all members again and goes on");
    }
    status = tn_ranks_agree(ranks, status, error);
    if (status != TN_OK || !tn_ranks_any(ranks, name[0] != '\0'))
        return status;
    return tn_run_take_inputs(run, error);
}

static tn_status begin_new(tn_run *run, const char *path, const tn_run_options *options, const tn_run_texts *texts,
                           tn_error *error)
{
    tn_status status = tn_run_store_create(path, options->durable, &run->store, error);
    return status == TN_OK ? put_meta(run, texts, error) : status;
}

/* What was killed while it began begins again: then *goes_on is false. */
static tn_status open_or_begin(tn_run *run, const char *path, const tn_run_options *options, const tn_run_texts *texts,
                               bool *goes_on, tn_error *error)
{
    bool begun;
    *goes_on = false;
    if (!options->resume || access(path, F_OK) != 0)
        return begin_new(run, path, options, texts, error);
    tn_status status = tn_run_store_begun(path, &begun, error);
    if (status != TN_OK)
        return status;
    if (!begun && unlink(path) != 0)
        return tn_fail(error, TN_IO, E_CANNOT_WRITE, "cannot begin %.200s again: %s", path, strerror(errno));
    if (!begun)
        return begin_new(run, path, options, texts, error);
    *goes_on = true;
    status = tn_run_store_open(path, options->durable, false, &run->store, error);
    if (status == TN_OK)
        status = run_same_arithmetic(run, error);
    if (status == TN_OK)
        status = same_study(run, error);
    return status == TN_OK ? same_grammar(run, texts->grammar_text, error) : status;
}

/* Until the run is cleared, nobody else writes its folder, which is there. TN_IO (E1256) where somebody does. What no
 * file system can lock is not locked. */
static tn_status run_lock(tn_run *run, tn_error *error)
{
    run->lock = open(run->dir, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (run->lock < 0)
        return TN_OK; /* what is wrong with it is said where its database is opened */
    run->locked = flock(run->lock, LOCK_EX | LOCK_NB) == 0;
    bool taken = !run->locked && errno == EWOULDBLOCK;
    if (!run->locked)
        close(run->lock);
    if (!taken)
        return TN_OK;
    tn_fail(error, TN_IO, E_RUN_IN_USE, "another command is writing the run in %.200s", run->dir);
    tn_error_help(error, "wait until it has ended, or write to another folder: -o DIR");
    return TN_IO;
}

/* Rank 0's part: the folder and its database. */
static tn_status begin_store(tn_run *run, const char *dir, const tn_run_options *options, const tn_run_texts *texts,
                             bool *goes_on, tn_error *error)
{
    char *path = tn_run_database(dir);
    tn_status status = path ? tn_folder_make(dir, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = run_lock(run, error);
    if (status == TN_OK)
        status = open_or_begin(run, path, options, texts, goes_on, error);
    free(path);
    return status;
}

/* Together: do all ranks breed the same? */
static tn_status same_everywhere(const tn_run *run, const tn_run_texts *texts, tn_error *error)
{
    const tn_evolution_job *job = run->job;
    tn_status status = tn_ranks_same(job->settings.ranks, "the study", job->identity, error);
    if (status == TN_OK)
        status = tn_ranks_same(job->settings.ranks, "the grammar", texts->grammar_text, error);
    return status == TN_OK
               ? tn_ranks_same(job->settings.ranks, "what scores depend on", job->inputs ? job->inputs : "", error)
               : status;
}

tn_status tn_run_begin(tn_evolution_job *job, const char *dir, const tn_run_options *options, const tn_run_texts *texts,
                       tn_run *run, tn_error *error)
{
    const tn_ranks *ranks = job->settings.ranks;
    bool goes_on = false;
    const char *slash = strrchr(texts->study_path, '/');
    *run = (tn_run){.job = job, .dir = dir ? strdup(dir) : NULL};
    run->study = strdup(slash ? slash + 1 : texts->study_path);
    bool named = run->study && (run->dir || !dir);
    tn_status status = tn_ranks_agree(ranks, named ? TN_OK : tn_fail_memory(error), error);
    if (status == TN_OK)
        status = same_everywhere(run, texts, error);
    if (status == TN_OK)
        status = tn_evolution_new(job->grammar, &job->settings, &job->evaluator, &run->evolution, error);
    if (status == TN_OK && dir && tn_ranks_lead(ranks))
        status = begin_store(run, dir, options, texts, &goes_on, error);
    status = tn_ranks_agree(ranks, status, error);
    if (status != TN_OK || !tn_ranks_any(ranks, goes_on))
        return status;
    status = tn_run_repeat(run, UINT64_MAX, error);
    if (status == TN_OK)
        status = same_inputs(run, options->rescore, error);
    return status == TN_OK ? do_waiting(run, error) : status;
}

/* ---- making stored runs again: to show one individual, or to leave something for when the run goes on */

static tn_status compile_stored(tn_run *run, tn_opened *opened, tn_error *error)
{
    char *path = NULL, *text = NULL;
    tn_status status = tn_run_store_get_meta(run->store, "grammar_path", &path, error);
    if (status == TN_OK)
        status = tn_run_store_get_meta(run->store, "grammar", &text, error);
    if (status == TN_OK && path && !path[0]) { /* of forms: the study stands alone */
        free(path);
        free(text);
        path = strdup("run.study");
        text = NULL;
        status = path ? tn_run_store_get_meta(run->store, "study", &text, error) : tn_fail_memory(error);
    }
    if (status == TN_OK && (!path || !text))
        status = tn_fail(error, TN_INVALID, E_RUN_DATABASE, "the run's database holds no grammar");
    if (status == TN_OK && tn_open_bytes(path, (const uint8_t *)text, strlen(text), false, opened) != TN_OK)
        status =
            tn_fail(error, TN_INVALID, E_RUN_DIFFERS, "the run's grammar does not compile with this version of tartan");
    free(path);
    free(text);
    return status;
}

/* The settings of the stored study; its texts live in the arena of `opened`. */
static tn_status read_stored(tn_run *run, tn_opened *opened, tn_evolution_study *study, tn_error *error)
{
    char *text = NULL;
    uint32_t file;
    tn_compilation *c = &opened->compilation;
    tn_status status = tn_run_store_get_meta(run->store, "study", &text, error);
    if (status == TN_OK && !text)
        status = tn_fail(error, TN_INVALID, E_RUN_DATABASE, "the run's database holds no study");
    if (status == TN_OK)
        status = tn_sources_add(&c->sources, "run.study", text, strlen(text), &file, error);
    if (status == TN_OK && !tn_evolution_settings_read(&c->sources, file, &c->diagnostics, c->arena, study))
        status = tn_fail(error, TN_INVALID, E_RUN_DIFFERS, "the run's study cannot be read by this version of tartan");
    free(text);
    return status;
}

static tn_status stored_number(tn_run *run, const char *key, uint64_t *number, tn_error *error)
{
    char *text = NULL;
    tn_status status = tn_run_store_get_meta(run->store, key, &text, error);
    if (status == TN_OK && !(text && *text))
        status = tn_fail(error, TN_INVALID, E_RUN_DATABASE, "the run's database does not say its %s", key);
    if (status == TN_OK)
        *number = strtoull(text, NULL, 10);
    free(text);
    return status;
}

/* Opens the run of a folder and makes its generations again, until `until` was born. */
static tn_status open_stored(const char *dir, bool read_only, uint64_t until, tn_opened *opened, tn_evolution_job *job,
                             tn_run *run, tn_error *error)
{
    tn_evolution_study study;
    tn_evolution_job_options options = {.only_replay = true, .says_seed = true};
    char *seeds = NULL, *path = tn_run_database(dir);
    *run = (tn_run){.job = job, .dir = strdup(dir)};
    tn_status status = path && run->dir ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && !read_only)
        status = run_lock(run, error);
    if (status == TN_OK)
        status = tn_run_store_open(path, false, read_only, &run->store, error);
    free(path);
    if (status == TN_OK)
        status = run_same_arithmetic(run, error);
    if (status == TN_OK)
        status = compile_stored(run, opened, error);
    if (status == TN_OK)
        status = read_stored(run, opened, &study, error);
    if (status == TN_OK)
        status = stored_number(run, "seed", &options.seed, error);
    if (status == TN_OK)
        status = stored_number(run, "objectives", &options.objectives, error);
    if (status == TN_OK)
        status = tn_run_store_get_meta(run->store, "seeds", &seeds, error);
    options.stored_seeds = seeds;
    if (status == TN_OK)
        status = tn_evolution_job_make(&study, dir, opened->module, &options, job, error);
    free(seeds);
    if (status == TN_OK)
        status = tn_evolution_new(job->grammar, &job->settings, &job->evaluator, &run->evolution, error);
    if (status == TN_OK)
        status = tn_run_repeat(run, until, error);
    return status;
}

/* Born or inserted before the newest generation. */
static const tn_individual *find_newest(const tn_evolution *evolution, uint64_t id)
{
    size_t born, inserted;
    const tn_individual *const *newest = tn_evolution_born(evolution, &born);
    for (size_t i = 0; i < born; i++)
        if (newest[i]->id == id)
            return newest[i];
    newest = tn_evolution_inserted(evolution, &inserted);
    for (size_t i = 0; i < inserted; i++)
        if (newest[i]->id == id)
            return newest[i];
    return NULL;
}

tn_status tn_run_replay(const char *dir, uint64_t id, tn_opened *opened, tn_evolution_job *job, tn_run *run,
                        const tn_individual **individual, tn_error *error)
{
    *individual = NULL;
    tn_status status = open_stored(dir, true, id, opened, job, run, error);
    if (status == TN_OK && run->generations)
        *individual = find_newest(run->evolution, id);
    if (status == TN_OK && !*individual) {
        status = tn_fail(error, TN_INVALID, E_NO_INDIVIDUAL, "the run has no individual %" PRIu64, id);
        tn_error_help(error, "its folder has the best (best/scores.csv), its run.sqlite all");
    }
    return status;
}

/* ---- events left for the run */

/* What is inserted is not scored yet: it counts as better than all members, so that it stays. */
static bool recall_unknown(void *context, uint64_t id, tn_score *score)
{
    (void)context, (void)id;
    *score = (tn_score){.state = TN_SCORED};
    for (size_t i = 0; i < TN_SCORE_NUMBERS_MAX; i++)
        score->objectives[i] = -DBL_MAX;
    return true;
}

/* Does what waits already, so that what comes after it can be done too. */
static tn_status do_for_the_moment(tn_run *run, tn_error *error)
{
    tn_status status = TN_OK;
    tn_evolution_recall(run->evolution, recall_unknown, NULL);
    for (size_t i = 0; i < run->waiting_count && status == TN_OK; i++) {
        char *said;
        status = tn_by_hand_do(run->evolution, run->waiting[i].kind, run->waiting[i].text, &said, error);
        free(said);
    }
    return status;
}

tn_by_hand_language tn_evolution_job_language(const tn_evolution_job *job)
{
    return (tn_by_hand_language){job->grammar, &job->settings, strcmp(job->extension, "hemls") == 0};
}

static tn_status text_of_event(const tn_evolution_job *job, const char *written, uint64_t member, char **text,
                               char **sentence, tn_error *error)
{
    tn_genome genome = {0};
    const tn_by_hand_language language = tn_evolution_job_language(job);
    if (!written)
        return asprintf(text, "%" PRIu64, member) < 0 ? tn_fail_memory(error) : TN_OK;
    tn_status status = tn_by_hand_genome(&language, written, strlen(written), &genome, sentence, error);
    if (status == TN_OK && !(*text = tn_by_hand_text(member, &genome)))
        status = tn_fail_memory(error);
    tn_genome_clear(&genome);
    return status;
}

tn_status tn_run_leave(const char *dir, const char *kind, const char *written, uint64_t member, tn_opened *opened,
                       tn_evolution_job *job, tn_run *run, tn_run_event *left, char **sentence, tn_error *error)
{
    char *text = NULL;
    *left = (tn_run_event){0};
    *sentence = NULL;
    tn_status status = open_stored(dir, false, UINT64_MAX, opened, job, run, error);
    if (status == TN_OK && run->generations == 0)
        status = tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "the run in %.200s has no generation yet", dir);
    if (status == TN_OK)
        status = text_of_event(job, written, member, &text, sentence, error);
    if (status == TN_OK)
        status = do_for_the_moment(run, error);
    if (status == TN_OK)
        status = tn_by_hand_do(run->evolution, kind, text, &left->text, error);
    if (status == TN_OK)
        status = tn_run_store_put_event(run->store, run->generations, kind, left->text, error);
    left->generation = run->generations;
    left->kind = strdup(kind);
    if (status == TN_OK && !left->kind)
        status = tn_fail_memory(error);
    free(text);
    return status;
}
