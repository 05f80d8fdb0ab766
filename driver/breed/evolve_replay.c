/* Makes stored runs again: to show one individual, or to leave something for when the run goes on. */
#include <float.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/evolution/evolution.h"
#include "driver/breed/evolve_replay.h"
#include "runtime/base/file.h"

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
        status = tn_run_lock(run, error);
    if (status == TN_OK)
        status = tn_run_store_open(path, false, read_only, &run->store, error);
    free(path);
    if (status == TN_OK)
        status = tn_run_same_arithmetic(run, error);
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
