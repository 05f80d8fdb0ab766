/* Databases of runs by the part `store`, which is loaded when the first one is made or opened. Without one there is
 * nothing to ask, so that only those two, and whoever asks whether a file is one, can fail for want of it. */
#include "runtime/base/part.h"
#include "runtime/genome/store/run_store.h"

#define FIND(function, error)                                                                                          \
    ((__typeof__(function) *)tn_part_find(TN_WITH_STORE, #function, "keeping a run in a database", error))

tn_status tn_run_store_create(const char *path, bool durable, tn_run_store **store, tn_error *error)
{
    *store = NULL;
    __typeof__(tn_run_store_create) *function = FIND(tn_run_store_create, error);
    return function ? function(path, durable, store, error) : TN_INVALID;
}

tn_status tn_run_store_open(const char *path, bool durable, bool read_only, tn_run_store **store, tn_error *error)
{
    *store = NULL;
    __typeof__(tn_run_store_open) *function = FIND(tn_run_store_open, error);
    return function ? function(path, durable, read_only, store, error) : TN_INVALID;
}

void tn_run_store_free(tn_run_store *store)
{
    __typeof__(tn_run_store_free) *function = FIND(tn_run_store_free, NULL);
    if (function)
        function(store);
}

tn_status tn_run_store_begun(const char *path, bool *begun, tn_error *error)
{
    *begun = false;
    __typeof__(tn_run_store_begun) *function = FIND(tn_run_store_begun, error);
    return function ? function(path, begun, error) : TN_INVALID;
}

tn_status tn_run_store_put_meta(tn_run_store *store, const char *const *keys, const char *const *values, size_t count,
                                tn_error *error)
{
    __typeof__(tn_run_store_put_meta) *function = FIND(tn_run_store_put_meta, error);
    return function ? function(store, keys, values, count, error) : TN_INVALID;
}

tn_status tn_run_store_get_meta(tn_run_store *store, const char *key, char **value, tn_error *error)
{
    __typeof__(tn_run_store_get_meta) *function = FIND(tn_run_store_get_meta, error);
    return function ? function(store, key, value, error) : TN_INVALID;
}

tn_status tn_run_store_message(tn_run_store *store, uint64_t id, char message[200], tn_error *error)
{
    __typeof__(tn_run_store_message) *function = FIND(tn_run_store_message, error);
    return function ? function(store, id, message, error) : TN_INVALID;
}

tn_status tn_run_store_generations(tn_run_store *store, uint32_t *count, tn_error *error)
{
    __typeof__(tn_run_store_generations) *function = FIND(tn_run_store_generations, error);
    return function ? function(store, count, error) : TN_INVALID;
}

tn_status tn_run_store_put_event(tn_run_store *store, uint32_t generation, const char *kind, const char *text,
                                 tn_error *error)
{
    __typeof__(tn_run_store_put_event) *function = FIND(tn_run_store_put_event, error);
    return function ? function(store, generation, kind, text, error) : TN_INVALID;
}

tn_status tn_run_store_put(tn_run_store *store, const tn_evolution *evolution, size_t numbers,
                           const tn_run_event *events, size_t event_count, const tn_rescored *rescored,
                           size_t rescored_count, tn_error *error)
{
    __typeof__(tn_run_store_put) *function = FIND(tn_run_store_put, error);
    return function ? function(store, evolution, numbers, events, event_count, rescored, rescored_count, error)
                    : TN_INVALID;
}

tn_status tn_run_store_rescored(tn_run_store *store, uint32_t generation, size_t numbers, tn_rescored **rescored,
                                size_t *count, tn_error *error)
{
    __typeof__(tn_run_store_rescored) *function = FIND(tn_run_store_rescored, error);
    return function ? function(store, generation, numbers, rescored, count, error) : TN_INVALID;
}

tn_status tn_run_store_events(tn_run_store *store, tn_run_event **events, size_t *count, tn_error *error)
{
    __typeof__(tn_run_store_events) *function = FIND(tn_run_store_events, error);
    return function ? function(store, events, count, error) : TN_INVALID;
}

void tn_run_events_free(tn_run_event *events, size_t count)
{
    __typeof__(tn_run_events_free) *function = FIND(tn_run_events_free, NULL);
    if (function)
        function(events, count);
}

tn_status tn_run_store_scores(tn_run_store *store, size_t numbers, tn_run_scores *scores, tn_error *error)
{
    __typeof__(tn_run_store_scores) *function = FIND(tn_run_store_scores, error);
    return function ? function(store, numbers, scores, error) : TN_INVALID;
}

void tn_run_scores_clear(tn_run_scores *scores)
{
    __typeof__(tn_run_scores_clear) *function = FIND(tn_run_scores_clear, NULL);
    if (function)
        function(scores);
}

bool tn_run_scores_recall(void *scores, uint64_t id, tn_score *score)
{
    __typeof__(tn_run_scores_recall) *function = FIND(tn_run_scores_recall, NULL);
    return function && function(scores, id, score);
}

bool tn_run_scores_recall_parents(void *scores, uint64_t id, uint64_t parents[2])
{
    __typeof__(tn_run_scores_recall_parents) *function = FIND(tn_run_scores_recall_parents, NULL);
    return function && function(scores, id, parents);
}

tn_status tn_run_store_check(tn_run_store *store, const tn_evolution *evolution, tn_error *error)
{
    __typeof__(tn_run_store_check) *function = FIND(tn_run_store_check, error);
    return function ? function(store, evolution, error) : TN_INVALID;
}

tn_status tn_run_store_stats(tn_run_store *store, tn_generation_stats **stats, size_t *count, tn_error *error)
{
    __typeof__(tn_run_store_stats) *function = FIND(tn_run_store_stats, error);
    return function ? function(store, stats, count, error) : TN_INVALID;
}
