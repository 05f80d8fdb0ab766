/* Moves a run on: changes it, makes its stored generations again, and breeds new ones. */
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
#include "driver/breed/evolve_begin.h"
#include "driver/hand/hand.h"
#include "runtime/base/array.h"
#include "runtime/base/file.h"
#include "runtime/genome/mapping/sentences.h"
#include "runtime/genome/store/run_store.h"
#include "runtime/math/elementary.h"
#include "runtime/plan/text/text.h"
#include "runtime/ranks/ranks.h"

typedef struct rescored_list {
    tn_rescored *items; /* in order of their ids; owned */
    size_t count;
} rescored_list;

/* Owns all of it. Zero it to begin with; clear it in any case. */
typedef struct run_history {
    uint32_t generations;
    tn_run_scores scores;
    tn_run_event *events;
    size_t event_count;
    rescored_list *rescored; /* [events]: the members' scores after a change; empty for choices */
} run_history;

/* ---- what a run's database says of the generations that are stored, so that they can be made again without evaluating
 *
 * With several ranks, rank 0 reads it and tells the others. */

static void run_history_clear(run_history *history)
{
    for (size_t i = 0; history->rescored && i < history->event_count; i++)
        free(history->rescored[i].items);
    free(history->rescored);
    tn_run_scores_clear(&history->scores);
    tn_run_events_free(history->events, history->event_count);
    *history = (run_history){0};
}

static int compare_rescored(const void *left, const void *right)
{
    const tn_rescored *a = left, *b = right;
    return a->id < b->id ? -1 : a->id > b->id;
}

/* Orders scores by their ids. */
static void rescored_sort(tn_rescored *items, size_t count)
{
    qsort(items, count, sizeof *items, compare_rescored);
}

/* For tn_evolution_recall: the scores of a rescored_list. */
static bool rescored_recall(void *context, uint64_t id, tn_score *score)
{
    const rescored_list *list = context;
    tn_rescored key = {.id = id};
    const tn_rescored *found = bsearch(&key, list->items, list->count, sizeof key, compare_rescored);
    if (found)
        *score = found->score;
    return found != NULL;
}

/* ---- from the database */

static bool is_choice(const tn_run_event *event)
{
    return strcmp(event->kind, "choose") == 0;
}

static tn_status read_store(tn_run_store *store, size_t numbers, run_history *h, tn_error *error)
{
    tn_status status = tn_run_store_generations(store, &h->generations, error);
    if (status == TN_OK)
        status = tn_run_store_scores(store, numbers, &h->scores, error);
    if (status == TN_OK)
        status = tn_run_store_events(store, &h->events, &h->event_count, error);
    if (status == TN_OK && !(h->rescored = calloc(h->event_count + 1, sizeof *h->rescored)))
        status = tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < h->event_count; i++)
        if (!is_choice(&h->events[i]))
            status = tn_run_store_rescored(store, h->events[i].generation, numbers, &h->rescored[i].items,
                                           &h->rescored[i].count, error);
    return status;
}

/* ---- told to other ranks: the same structures one behind the other, as this machine has them */

static bool put(tn_buffer *out, const void *bytes, size_t size)
{
    return size == 0 || tn_buffer_append(out, bytes, size);
}

static bool put_size(tn_buffer *out, uint64_t size)
{
    return put(out, &size, sizeof size);
}

static bool put_text(tn_buffer *out, const char *text)
{
    return put_size(out, strlen(text)) && put(out, text, strlen(text));
}

static bool put_history(const run_history *h, tn_buffer *out)
{
    bool done = put_size(out, h->generations) && put_size(out, h->scores.count) &&
                put(out, h->scores.scores, h->scores.count * sizeof *h->scores.scores) &&
                put(out, h->scores.known, h->scores.count * sizeof *h->scores.known) && put_size(out, h->event_count);
    for (size_t i = 0; done && i < h->event_count; i++)
        done = put_size(out, h->events[i].generation) && put_text(out, h->events[i].kind) &&
               put_text(out, h->events[i].text) && put_size(out, h->rescored[i].count) &&
               put(out, h->rescored[i].items, h->rescored[i].count * sizeof(tn_rescored));
    return done;
}

typedef struct told {
    const uint8_t *at;
    bool failed; /* out of memory */
} told;

static uint64_t take_size(told *t)
{
    uint64_t size;
    memcpy(&size, t->at, sizeof size);
    t->at += sizeof size;
    return size;
}

/* `count` items, with a zero behind them. */
static void *take_items(told *t, size_t count, size_t size)
{
    uint8_t *items = malloc(count * size + 1);
    t->failed |= !items;
    if (items) {
        memcpy(items, t->at, count * size);
        items[count * size] = '\0';
    }
    t->at += count * size;
    return items;
}

static void take_event(told *t, tn_run_event *event, rescored_list *list)
{
    event->generation = (uint32_t)take_size(t);
    event->kind = take_items(t, (size_t)take_size(t), 1);
    event->text = take_items(t, (size_t)take_size(t), 1);
    list->count = (size_t)take_size(t);
    list->items = take_items(t, list->count, sizeof *list->items);
}

static tn_status take_history(const uint8_t *bytes, run_history *h, tn_error *error)
{
    told t = {.at = bytes};
    h->generations = (uint32_t)take_size(&t);
    h->scores.count = (size_t)take_size(&t);
    h->scores.scores = take_items(&t, h->scores.count, sizeof *h->scores.scores);
    h->scores.known = take_items(&t, h->scores.count, sizeof *h->scores.known);
    size_t events = (size_t)take_size(&t);
    h->events = calloc(events + 1, sizeof *h->events);
    h->rescored = calloc(events + 1, sizeof *h->rescored);
    if (!h->events || !h->rescored)
        return tn_fail_memory(error);
    for (h->event_count = 0; h->event_count < events; h->event_count++)
        take_event(&t, &h->events[h->event_count], &h->rescored[h->event_count]);
    return t.failed ? tn_fail_memory(error) : TN_OK;
}

static tn_status tell(const tn_ranks *ranks, tn_status status, run_history *h, tn_error *error)
{
    tn_buffer out = {0};
    bool lead = tn_ranks_lead(ranks);
    if (status == TN_OK && lead && !put_history(h, &out))
        status = tn_fail_memory(error);
    status = tn_ranks_agree(ranks, status, error);
    uint8_t *bytes = (uint8_t *)out.data;
    size_t size = out.size;
    if (status == TN_OK)
        status = tn_ranks_tell(ranks, &bytes, &size, error);
    if (status == TN_OK) {
        status = lead ? TN_OK : take_history(bytes, h, error);
        status = tn_ranks_agree(ranks, status, error);
    }
    free(bytes);
    return status;
}

/* Reads it; with several ranks together. `store` is NULL on all but rank 0. */
static tn_status run_history_read(tn_run_store *store, size_t numbers, const tn_ranks *ranks, run_history *history,
                                  tn_error *error)
{
    *history = (run_history){0};
    tn_status status = tn_ranks_lead(ranks) ? read_store(store, numbers, history, error) : TN_OK;
    return tn_ranks_several(ranks) ? tell(ranks, status, history, error) : status;
}

/* ---- moving a run on */

char *tn_run_database(const char *dir)
{
    char *path = NULL;
    return asprintf(&path, "%s/run.sqlite", dir) < 0 ? NULL : path;
}

void tn_run_clear(tn_run *run)
{
    tn_evolution_free(run->evolution);
    tn_run_store_free(run->store);
    if (run->locked)
        close(run->lock);
    tn_run_events_free(run->changes, run->change_count);
    tn_run_events_free(run->waiting, run->waiting_count);
    free(run->rescored);
    free(run->kept);
    free(run->study);
    free(run->dir);
    *run = (tn_run){0};
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
    rescored_sort(kept, count);
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

tn_status tn_run_take_inputs(tn_run *run, tn_error *error)
{
    const char *inputs = run->job->inputs ? run->job->inputs : "";
    tn_status status = remember_change(run, run->generations, "inputs", inputs, error);
    status = tn_ranks_agree(run->job->settings.ranks, status, error);
    return status == TN_OK ? rescore(run, error) : status;
}

static int compare_ids(const void *left, const void *right)
{
    const uint64_t *a = left, *b = right;
    return *a < *b ? -1 : *a > *b;
}

/* The members' ids, in ascending order. The caller frees them; NULL: out of memory. */
static uint64_t *member_ids(const tn_run *run, size_t *count)
{
    const tn_individual *const *members = tn_evolution_members(run->evolution, count);
    uint64_t *ids = calloc(*count + 1, sizeof *ids);
    for (size_t i = 0; ids && i < *count; i++)
        ids[i] = members[i]->id;
    if (ids)
        qsort(ids, *count, sizeof *ids, compare_ids);
    return ids;
}

/* Those that are members no more, as text "12 40". The caller frees it; NULL: out of memory. */
static char *ids_left(const tn_run *run, const uint64_t *before, size_t before_count)
{
    char *text = NULL;
    size_t size, count;
    uint64_t *now = member_ids(run, &count);
    FILE *out = now ? open_memstream(&text, &size) : NULL;
    const char *between = "";
    for (size_t i = 0; out && i < before_count; i++) {
        if (bsearch(&before[i], now, count, sizeof *now, compare_ids))
            continue;
        fprintf(out, "%s%" PRIu64, between, before[i]);
        between = " ";
    }
    free(now);
    if (out && fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

/* What the event "left" says. The caller frees the ids; NULL: out of memory. */
static uint64_t *read_ids(const char *text, size_t *count)
{
    uint64_t *ids = calloc(strlen(text) / 2 + 1, sizeof *ids);
    *count = 0;
    for (char *end = NULL; ids && *text; text = *end ? end + 1 : end)
        ids[(*count)++] = strtoull(text, &end, 10);
    return ids;
}

static tn_status resize(tn_run *run, const char *change, const char *left, tn_error *error)
{
    uint32_t population;
    size_t count = 0;
    uint64_t *ids = left ? read_ids(left, &count) : NULL;
    tn_status status = left && !ids ? tn_fail_memory(error) : tn_change_population(change, &population, error);
    if (status == TN_OK)
        status = tn_evolution_resize(run->evolution, population, ids, count, error);
    free(ids);
    return status;
}

/* Children are made otherwise from here on, or more or fewer of them; scores stay. `left`: of a stored change, who left
 * the population by it, or NULL. */
static tn_status vary(tn_run *run, const char *change, const char *left, tn_error *error)
{
    if (tn_change_resizes(change))
        return resize(run, change, left, error);
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

/* Whose scores were changed before in this generation is not known later: then who leaves is stored with the change. */
static tn_status vary_and_note(tn_run *run, const char *change, tn_error *error)
{
    size_t before_count;
    bool notes = tn_change_resizes(change) && run->rescored_count > 0;
    uint64_t *before = notes ? member_ids(run, &before_count) : NULL;
    char *left = NULL;
    tn_status status = notes && !before ? tn_fail_memory(error) : vary(run, change, NULL, error);
    if (status == TN_OK && notes && !(left = ids_left(run, before, before_count)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = remember_change(run, run->generations, "set", change, error);
    if (status == TN_OK && left && *left)
        status = remember_change(run, run->generations, "left", left, error);
    status = tn_ranks_agree(run->job->settings.ranks, status, error);
    if (status == TN_OK)
        run->new_changes += 1 + (left && *left);
    free(before);
    free(left);
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
    if (varies)
        return vary_and_note(run, change, error);
    tn_status status = evaluator->adjust(evaluator->context, change, error);
    if (status == TN_OK)
        status = remember_change(run, run->generations, "set", change, error);
    status = tn_ranks_agree(run->job->settings.ranks, status, error);
    return status == TN_OK ? rescore(run, error) : status;
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
    rescored_list *list;
    const tn_run_scores *births;
} known_scores;

static bool recall_known(void *context, uint64_t id, tn_score *score)
{
    known_scores *known = context;
    tn_run_scores births = *known->births;
    return rescored_recall(known->list, id, score) || tn_run_scores_recall(&births, id, score);
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
static tn_status repeat_change(tn_run *run, const tn_run_event *event, const char *left, known_scores *known,
                               tn_error *error)
{
    const tn_evaluator *evaluator = &run->job->evaluator;
    bool set = strcmp(event->kind, "set") == 0, varies = set && tn_change_varies(event->text);
    bool adjusts = evaluator->adjust && set;
    tn_status status = varies    ? vary(run, event->text, left, error)
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

/* A warning, or who left by the change before it. */
static bool tells_only(const char *kind)
{
    return strcmp(kind, "warning") == 0 || strcmp(kind, "left") == 0;
}

/* Together: the next generation. Was there anything to be scored? */
static tn_status step(tn_run *run, tn_status status, tn_error *error)
{
    uint64_t before = run->generations ? tn_evolution_stats(run->evolution).evaluations : 0;
    status = tn_evolution_step_after(run->evolution, status, error);
    run->idle = status == TN_OK && tn_evolution_stats(run->evolution).evaluations == before;
    return status;
}

/* Together: one stored generation, made again and compared with what is stored. */
static tn_status repeat_step(tn_run *run, const run_history *history, size_t *at, tn_error *error)
{
    tn_status status = TN_OK;
    for (; status == TN_OK && *at < history->event_count && history->events[*at].generation == run->generations;
         ++*at) {
        const tn_run_event *event = &history->events[*at];
        known_scores known = {&history->rescored[*at], &history->scores};
        bool leaves = *at + 1 < history->event_count && strcmp(event[1].kind, "left") == 0;
        status = strcmp(event->kind, "choose") == 0 ? repeat_choice(run, event, error)
                 : tells_only(event->kind)          ? TN_OK
                 : tn_by_hand(event->kind)          ? repeat_by_hand(run, event, &history->scores, error)
                                           : repeat_change(run, event, leaves ? event[1].text : NULL, &known, error);
    }
    tn_run_scores scores = history->scores;
    tn_evolution_recall(run->evolution, tn_run_scores_recall, &scores);
    tn_evolution_recall_parents(run->evolution, tn_run_scores_recall_parents);
    if (status == TN_OK)
        status = step(run, TN_OK, error);
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
    run_history history;
    tn_status status = run_history_read(run->store, tn_evaluator_numbers(&run->job->evaluator),
                                        run->job->settings.ranks, &history, error);
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
    run_history_clear(&history);
    return status;
}

/* ---- going on */

/* What is stored with the next generation: changes that are not stored yet, and the choice, whose texts are borrowed;
 * and room for what is found in it. */
static tn_run_event *events_to_store(const tn_run *run, char *kind, char *choice, size_t *count)
{
    *count = run->new_changes;
    tn_run_event *events = calloc(*count + 1 + TN_FINDINGS_MAX, sizeof *events);
    for (size_t i = 0; events && i < *count; i++)
        events[i] = run->changes[run->change_count - *count + i];
    if (events && choice)
        events[(*count)++] = (tn_run_event){0, kind, choice};
    return events;
}

/* What is to be said of the first generation is stored with it. */
static tn_status look_first(tn_run *run, char *kind, tn_run_event *events, size_t *count, tn_error *error)
{
    tn_status status = tn_run_first_look(run, &run->look, error);
    for (size_t i = 0; i < run->look.count && status == TN_OK; i++)
        events[(*count)++] = (tn_run_event){0, kind, run->look.items[i].text};
    return status;
}

/* Stores what was bred, with the changes and the choice (`text`) that led to it. With several ranks it fails later,
 * where they meet: they breed on meanwhile. */
static tn_status store_step(tn_run *run, char *text, tn_error *error)
{
    char kind[] = "choose", warning[] = "warning";
    size_t count;
    tn_run_event *events = events_to_store(run, kind, text, &count);
    tn_status status = events ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && run->generations == 0)
        status = look_first(run, warning, events, &count, error);
    if (status == TN_OK)
        status = tn_run_store_put(run->store, run->evolution, tn_evaluator_numbers(&run->job->evaluator), events, count,
                                  run->rescored, run->new_changes ? run->rescored_count : 0, error);
    free(events);
    if (status == TN_OK || !tn_ranks_several(run->job->settings.ranks))
        return status;
    run->store_failure = *error;
    run->store_failure.status = status;
    return TN_OK;
}

/* Of a run without a folder, what its database would have. */
static tn_status keep_step(tn_run *run, tn_error *error)
{
    if (!tn_array_resize(&run->kept, run->kept_count + 1, sizeof *run->kept))
        return tn_fail_memory(error);
    run->kept[run->kept_count++] = tn_evolution_stats(run->evolution);
    return run->generations == 0 ? tn_run_first_look(run, &run->look, error) : TN_OK;
}

/* Could this rank store the generation before? */
static tn_status stored(const tn_run *run, tn_error *error)
{
    if (run->store_failure.status != TN_OK)
        *error = run->store_failure;
    return run->store_failure.status;
}

tn_status tn_run_settle(tn_run *run, tn_error *error)
{
    return tn_ranks_agree(run->job->settings.ranks, stored(run, error), error);
}

/* How this rank has fared since all last met. One that is to end, ends all of them with it. */
static tn_status fared(const tn_run *run, tn_error *error)
{
    tn_status status = stored(run, error);
    if (status == TN_OK && tn_ranks_several(run->job->settings.ranks))
        status = tn_watch_check(run->job->settings.watch, error);
    return status;
}

/* Together: the choice of parents. */
static tn_status choose(tn_run *run, const tn_chosen *chosen, size_t count, char **text, tn_error *error)
{
    *text = tn_choices_text(chosen, count);
    tn_status status = *text ? tn_evolution_choose(run->evolution, chosen, count, error) : tn_fail_memory(error);
    return tn_ranks_agree(run->job->settings.ranks, status, error);
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
    char *text = NULL;
    tn_status status = chosen ? choose(run, chosen, chosen_count, &text, error) : TN_OK;
    if (status == TN_OK)
        status = step(run, fared(run, error), error);
    if (status == TN_OK)
        status = check_program(run, error);
    if (status == TN_OK && run->store)
        status = store_step(run, text, error);
    else if (status == TN_OK && !run->dir)
        status = keep_step(run, error);
    if (status == TN_OK) {
        run->generations++;
        run->new_changes = 0;
        run->rescored_count = 0;
    }
    free(text);
    return status;
}

#define SENTENCES_MOST                                                                                                 \
    20000u /* of a grammar that is taken for small; counting as many derivations takes some 0.1 s                      \
            */

bool tn_run_exhausted(tn_run *run)
{
    tn_error error;
    if (!run->job->grammar || !run->idle)
        return false;
    if (!run->sentences && tn_count_sentences(run->job->grammar, &run->job->settings.mapping, SENTENCES_MOST,
                                              &run->sentences, &error) != TN_OK)
        run->sentences = 0; /* without memory for that, as many as one likes */
    if (!run->sentences)
        run->sentences = SIZE_MAX; /* why there are none is said otherwise */
    return tn_evolution_known(run->evolution) == run->sentences;
}

bool tn_run_reached(const tn_run *run)
{
    const tn_setting_value *stop = &run->job->study.of[TN_SET_STOP];
    return stop->written && run->generations && tn_evolution_stats(run->evolution).best[0] <= stop->first;
}
