/* Reads what is stored of a run, and tells it to the other ranks. */
#include "driver/breed/evolve_history.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/plan/text/text.h"

void tn_run_history_clear(tn_run_history *history)
{
    for (size_t i = 0; history->rescored && i < history->event_count; i++)
        free(history->rescored[i].items);
    free(history->rescored);
    tn_run_scores_clear(&history->scores);
    tn_run_events_free(history->events, history->event_count);
    *history = (tn_run_history){0};
}

static int compare_rescored(const void *left, const void *right)
{
    const tn_rescored *a = left, *b = right;
    return a->id < b->id ? -1 : a->id > b->id;
}

void tn_rescored_sort(tn_rescored *items, size_t count)
{
    qsort(items, count, sizeof *items, compare_rescored);
}

bool tn_rescored_recall(void *context, uint64_t id, tn_score *score)
{
    const tn_rescored_list *list = context;
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

static tn_status read_store(tn_run_store *store, size_t numbers, tn_run_history *h, tn_error *error)
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

static bool put_history(const tn_run_history *h, tn_buffer *out)
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

static void take_event(told *t, tn_run_event *event, tn_rescored_list *list)
{
    event->generation = (uint32_t)take_size(t);
    event->kind = take_items(t, (size_t)take_size(t), 1);
    event->text = take_items(t, (size_t)take_size(t), 1);
    list->count = (size_t)take_size(t);
    list->items = take_items(t, list->count, sizeof *list->items);
}

static tn_status take_history(const uint8_t *bytes, tn_run_history *h, tn_error *error)
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

static tn_status tell(const tn_ranks *ranks, tn_status status, tn_run_history *h, tn_error *error)
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

tn_status tn_run_history_read(tn_run_store *store, size_t numbers, const tn_ranks *ranks, tn_run_history *history,
                              tn_error *error)
{
    *history = (tn_run_history){0};
    tn_status status = tn_ranks_lead(ranks) ? read_store(store, numbers, history, error) : TN_OK;
    return tn_ranks_several(ranks) ? tell(ranks, status, history, error) : status;
}
