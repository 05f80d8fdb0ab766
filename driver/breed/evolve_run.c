/* Begins or resumes a run in a folder, steps it and changes it. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "compiler/evolution/evolution.h"
#include "driver/breed/change.h"
#include "driver/breed/evolve.h"
#include "driver/breed/evolve_history.h"
#include "driver/breed/evolve_replay.h"
#include "driver/breed/inputs.h"
#include "driver/hand/choice.h"
#include "runtime/base/array.h"
#include "runtime/base/file.h"
#include "runtime/numeric/numeric.h"

char *tn_run_database(const char *dir)
{
    char *path = NULL;
    return asprintf(&path, "%s/run.sqlite", dir) < 0 ? NULL : path;
}

void tn_run_clear(tn_run *run)
{
    tn_evolution_free(run->evolution);
    tn_run_store_free(run->store);
    tn_run_events_free(run->changes, run->change_count);
    tn_run_events_free(run->waiting, run->waiting_count);
    free(run->rescored);
    free(run->dir);
    *run = (tn_run){0};
}

/* ---- beginning */

static tn_status put_meta(tn_run *run, const tn_run_texts *texts, tn_error *error)
{
    char seed[24], objectives[24], arithmetic[24];
    const tn_evolution_job *job = run->job;
    const char *slash = strrchr(texts->study_path, '/');
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
                                  slash ? slash + 1 : texts->study_path,
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
    tn_error_help(error, "only `generations`, `stop` and `program-timeout` may change in between; -o DIR starts another run");
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

/* ---- changes of targets and weights */

/* Is this what the last change of the same subject said? */
static bool holds_already(const tn_run *run, const char *change)
{
    size_t length = tn_change_subject(change);
    for (size_t i = run->change_count; i-- > 0;)
        if (strcmp(run->changes[i].kind, "set") == 0 && tn_change_subject(run->changes[i].text) == length &&
            strncmp(run->changes[i].text, change, length) == 0)
            return strcmp(run->changes[i].text, change) == 0;
    return false;
}

static tn_status remember_change(tn_run *run, uint32_t generation, const char *kind, const char *change,
                                 tn_error *error)
{
    if (!tn_array_resize(&run->changes, run->change_count + 1, sizeof *run->changes))
        return tn_fail_memory(error);
    tn_run_event *event = &run->changes[run->change_count++];
    *event = (tn_run_event){generation, strdup(kind), strdup(change)};
    return event->kind && event->text ? TN_OK : tn_fail_memory(error);
}

static tn_status keep_rescored(tn_run *run, tn_error *error)
{
    size_t count;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    tn_rescored *kept = calloc(count + 1, sizeof *kept);
    if (!kept)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        kept[i] = (tn_rescored){members[i]->id, members[i]->score};
    tn_rescored_sort(kept, count);
    free(run->rescored);
    run->rescored = kept;
    run->rescored_count = count;
    return TN_OK;
}

/* Together. */
static tn_status rescore(tn_run *run, tn_error *error)
{
    run->new_changes++;
    tn_status status = tn_evolution_rescore(run->evolution, error);
    if (status == TN_OK)
        status = keep_rescored(run, error);
    return tn_ranks_agree(run->job->settings.ranks, status, error);
}

static tn_status resize(tn_run *run, const char *change, tn_error *error)
{
    uint32_t population;
    tn_status status = tn_change_population(change, &population, error);
    return status == TN_OK ? tn_evolution_resize(run->evolution, population, error) : status;
}

/* Children are made otherwise from here on, or more or fewer of them; scores stay. */
static tn_status vary(tn_run *run, const char *change, tn_error *error)
{
    if (tn_change_resizes(change))
        return resize(run, change, error);
    const tn_vary_options *now = tn_evolution_varies(run->evolution);
    if (!now) {
        tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "`%.100s` is about genomes of codons, and this run has others",
                change);
        tn_error_help(error, "start another run with other numbers in its study");
        return TN_INVALID;
    }
    tn_vary_options next = *now;
    tn_status status = tn_change_variation(change, &next, error);
    if (status == TN_OK)
        tn_evolution_vary(run->evolution, &next);
    return status;
}

tn_status tn_run_set(tn_run *run, const char *change, tn_error *error)
{
    const tn_evaluator *evaluator = &run->job->evaluator;
    bool varies = tn_change_varies(change);
    if (run->generations == 0 || (!evaluator->adjust && !varies)) {
        tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE,
                run->generations ? "there is nothing to be changed in this run" : "the run has not begun yet");
        tn_error_help(error, run->generations ? "targets and weights are for growing, building and learning"
                                              : "change the study itself");
        return TN_INVALID;
    }
    if (holds_already(run, change))
        return TN_OK;
    tn_status status = varies ? vary(run, change, error) : evaluator->adjust(evaluator->context, change, error);
    if (status == TN_OK)
        status = remember_change(run, run->generations, "set", change, error);
    status = tn_ranks_agree(run->job->settings.ranks, status, error);
    if (status == TN_OK && varies)
        run->new_changes++;
    return status == TN_OK && !varies ? rescore(run, error) : status;
}

/* ---- by hand */

/* Together: what is remembered is stored with the next generation, or was (`stored`). */
static tn_status do_by_hand(tn_run *run, const char *kind, const char *text, uint32_t generation, bool stored,
                            tn_error *error)
{
    char *said;
    tn_status status = tn_by_hand_do(run->evolution, kind, text, &said, error);
    if (status == TN_OK)
        status = remember_change(run, generation, kind, said, error);
    free(said);
    status = tn_ranks_agree(run->job->settings.ranks, status, error);
    if (status == TN_OK && !stored)
        run->new_changes++;
    return status;
}

tn_status tn_run_by_hand(tn_run *run, const char *kind, const char *text, tn_error *error)
{
    if (run->generations > 0)
        return do_by_hand(run, kind, text, run->generations, false, error);
    tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "the run has not begun yet");
    tn_error_help(error, "first individuals of a study are its `seeds`");
    return TN_INVALID;
}

/* ---- repeating */

/* Scores after a change; of those who were taken out after it, those that they were born with. */
typedef struct known_scores {
    tn_rescored_list *list;
    const tn_run_scores *births;
} known_scores;

static bool recall_known(void *context, uint64_t id, tn_score *score)
{
    known_scores *known = context;
    tn_run_scores births = *known->births;
    return tn_rescored_recall(known->list, id, score) || tn_run_scores_recall(&births, id, score);
}

static tn_status repeat_by_hand(tn_run *run, const tn_run_event *event, const tn_run_scores *births, tn_error *error)
{
    tn_run_scores scores = *births;
    tn_evolution_recall(run->evolution, tn_run_scores_recall, &scores);
    tn_status status = do_by_hand(run, event->kind, event->text, event->generation, true, error);
    tn_evolution_recall(run->evolution, NULL, NULL);
    return status;
}

/* One stored change, made again; the members' scores only after the last of a generation, when they were stored. */
static tn_status repeat_change(tn_run *run, const tn_run_event *event, known_scores *known, tn_error *error)
{
    const tn_evaluator *evaluator = &run->job->evaluator;
    bool set = strcmp(event->kind, "set") == 0, varies = set && tn_change_varies(event->text);
    bool adjusts = evaluator->adjust && set;
    tn_status status = varies    ? vary(run, event->text, error)
                       : adjusts ? evaluator->adjust(evaluator->context, event->text, error)
                                 : TN_OK;
    if (status == TN_OK)
        status = remember_change(run, event->generation, event->kind, event->text, error);
    status = tn_ranks_agree(run->job->settings.ranks, status, error);
    if (status != TN_OK || varies)
        return status;
    tn_evolution_recall(run->evolution, recall_known, known);
    return tn_evolution_rescore(run->evolution, error);
}

static tn_status repeat_choice(tn_run *run, const tn_run_event *event, tn_error *error)
{
    tn_choices choices = {0};
    char wrong[40];
    tn_status status = tn_choices_read(event->text, &choices, wrong, error);
    if (status == TN_OK)
        status = tn_evolution_choose(run->evolution, choices.items, choices.count, error);
    tn_choices_clear(&choices);
    return tn_ranks_agree(run->job->settings.ranks, status, error);
}

/* Together: one stored generation, made again and compared with what is stored. */
static tn_status repeat_step(tn_run *run, const tn_run_history *history, size_t *at, tn_error *error)
{
    tn_status status = TN_OK;
    for (; status == TN_OK && *at < history->event_count && history->events[*at].generation == run->generations;
         ++*at) {
        const tn_run_event *event = &history->events[*at];
        known_scores known = {&history->rescored[*at], &history->scores};
        status = strcmp(event->kind, "choose") == 0 ? repeat_choice(run, event, error)
                 : tn_by_hand(event->kind)          ? repeat_by_hand(run, event, &history->scores, error)
                                                    : repeat_change(run, event, &known, error);
    }
    tn_run_scores scores = history->scores;
    tn_evolution_recall(run->evolution, tn_run_scores_recall, &scores);
    tn_evolution_recall_parents(run->evolution, tn_run_scores_recall_parents);
    if (status == TN_OK)
        status = tn_evolution_step(run->evolution, error);
    if (status == TN_OK && run->store)
        status = tn_run_store_check(run->store, run->evolution, error);
    tn_evolution_recall(run->evolution, NULL, NULL);
    tn_evolution_recall_parents(run->evolution, NULL);
    return tn_ranks_agree(run->job->settings.ranks, status, error);
}

static tn_status keep_waiting(tn_run *run, const tn_run_event *event, tn_error *error)
{
    if (!tn_array_resize(&run->waiting, run->waiting_count + 1, sizeof *run->waiting))
        return tn_fail_memory(error);
    tn_run_event *kept = &run->waiting[run->waiting_count++];
    *kept = (tn_run_event){event->generation, strdup(event->kind), strdup(event->text)};
    return kept->kind && kept->text ? TN_OK : tn_fail_memory(error);
}

/* Together: makes the stored generations again, without evaluating; up to the one that `until` is born in, or all. */
tn_status tn_run_repeat(tn_run *run, uint64_t until, tn_error *error)
{
    tn_run_history history;
    tn_status status =
        tn_run_history_read(run->store, run->job->evaluator.objectives, run->job->settings.ranks, &history, error);
    for (size_t i = 0; status == TN_OK && i < history.event_count; i++)
        if (strcmp(history.events[i].kind, "choose") == 0 && tn_choices_have_ids(history.events[i].text))
            tn_evolution_remember(run->evolution);
    size_t done = 0;
    for (size_t at = 0; status == TN_OK && run->generations < history.generations; run->generations++) {
        if (until < tn_evolution_next_id(run->evolution))
            break;
        status = repeat_step(run, &history, &at, error);
        done = at;
    }
    for (size_t i = done; status == TN_OK && i < history.event_count; i++)
        if (history.events[i].generation == history.generations)
            status = keep_waiting(run, &history.events[i], error);
    tn_run_history_clear(&history);
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
    status = remember_change(run, run->generations, "inputs", run->job->inputs ? run->job->inputs : "", error);
    status = tn_ranks_agree(ranks, status, error);
    return status == TN_OK ? rescore(run, error) : status;
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

/* Rank 0's part: the folder and its database. */
static tn_status begin_store(tn_run *run, const char *dir, const tn_run_options *options, const tn_run_texts *texts,
                             bool *goes_on, tn_error *error)
{
    char *path = tn_run_database(dir);
    tn_status status = path ? tn_folder_make(dir, error) : tn_fail_memory(error);
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
    *run = (tn_run){.job = job, .dir = strdup(dir)};
    tn_status status = tn_ranks_agree(ranks, run->dir ? TN_OK : tn_fail_memory(error), error);
    if (status == TN_OK)
        status = same_everywhere(run, texts, error);
    if (status == TN_OK)
        status = tn_evolution_new(job->grammar, &job->settings, &job->evaluator, &run->evolution, error);
    if (status == TN_OK && tn_ranks_lead(ranks))
        status = begin_store(run, dir, options, texts, &goes_on, error);
    status = tn_ranks_agree(ranks, status, error);
    if (status != TN_OK || !tn_ranks_any(ranks, goes_on))
        return status;
    status = tn_run_repeat(run, UINT64_MAX, error);
    if (status == TN_OK)
        status = same_inputs(run, options->rescore, error);
    return status == TN_OK ? do_waiting(run, error) : status;
}

/* ---- going on */

/* What is stored with the next generation: changes that are not stored yet, and the choice, whose texts are borrowed.
 */
static tn_run_event *events_to_store(const tn_run *run, char *kind, char *choice, size_t *count)
{
    *count = run->new_changes;
    tn_run_event *events = calloc(*count + 1, sizeof *events);
    for (size_t i = 0; events && i < *count; i++)
        events[i] = run->changes[run->change_count - *count + i];
    if (events && choice)
        events[(*count)++] = (tn_run_event){0, kind, choice};
    return events;
}

/* Together: a program that gives nobody of the first generation a score is not gone on with. */
static tn_status check_program(const tn_run *run, tn_error *error)
{
    size_t count;
    const tn_individual *const *born = tn_evolution_born(run->evolution, &count);
    if (!run->job->program || run->generations || tn_evolution_stats(run->evolution).scored)
        return TN_OK;
    for (size_t i = 0; i < count; i++)
        if (strncmp(born[i]->message, TN_PROGRAM_SAYS, strlen(TN_PROGRAM_SAYS)) == 0)
            return tn_external_useless(tn_program_scorer_program(run->job->program), born[i]->id,
                                      born[i]->message + strlen(TN_PROGRAM_SAYS), error);
    return TN_OK;
}

tn_status tn_run_step(tn_run *run, const tn_chosen *chosen, size_t chosen_count, tn_error *error)
{
    const tn_ranks *ranks = run->job->settings.ranks;
    char kind[] = "choose", *text = chosen ? tn_choices_text(chosen, chosen_count) : NULL;
    size_t count;
    tn_run_event *events = events_to_store(run, kind, text, &count);
    tn_status status = events && (text || !chosen) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && chosen)
        status = tn_evolution_choose(run->evolution, chosen, chosen_count, error);
    status = tn_ranks_agree(ranks, status, error);
    if (status == TN_OK)
        status = tn_evolution_step(run->evolution, error);
    if (status == TN_OK)
        status = check_program(run, error);
    if (status == TN_OK && run->store)
        status = tn_run_store_put(run->store, run->evolution, run->job->evaluator.objectives, events, count,
                                  run->rescored, run->new_changes ? run->rescored_count : 0, error);
    status = tn_ranks_agree(ranks, status, error);
    if (status == TN_OK) {
        run->generations++;
        run->new_changes = 0;
        run->rescored_count = 0;
    }
    free(events);
    free(text);
    return status;
}

bool tn_run_reached(const tn_run *run)
{
    const tn_setting_value *stop = &run->job->study.of[TN_SET_STOP];
    return stop->written && run->generations && tn_evolution_stats(run->evolution).best[0] <= stop->first;
}
