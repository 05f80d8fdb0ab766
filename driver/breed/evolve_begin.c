/* Begins a run in a folder, or opens the one that is there and sees that it is of the same study, grammar and inputs.
 */
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

#include "driver/breed/evolve.h"
#include "driver/breed/evolve_replay.h"
#include "driver/breed/inputs.h"
#include "runtime/base/file.h"
#include "runtime/math/elementary.h"

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
tn_status tn_run_same_arithmetic(const tn_run *run, tn_error *error)
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
        status = tn_run_same_arithmetic(run, error);
    if (status == TN_OK)
        status = same_study(run, error);
    return status == TN_OK ? same_grammar(run, texts->grammar_text, error) : status;
}

tn_status tn_run_lock(tn_run *run, tn_error *error)
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
        status = tn_run_lock(run, error);
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
