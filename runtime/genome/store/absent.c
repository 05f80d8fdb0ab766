/* Databases of runs in a build without the part `store`: none can be made or opened, so that there is never one to ask.
 */
#include "runtime/base/error.h"
#include "runtime/genome/store/run_store.h"

static tn_status absent(tn_error *error)
{
    return tn_part_absent(TN_WITH_STORE, "keeping a run in a database", error);
}

tn_status tn_run_store_create(const char *path, bool durable, tn_run_store **store, tn_error *error)
{
    (void)path, (void)durable;
    *store = NULL;
    return absent(error);
}

tn_status tn_run_store_open(const char *path, bool durable, bool read_only, tn_run_store **store, tn_error *error)
{
    (void)path, (void)durable, (void)read_only;
    *store = NULL;
    return absent(error);
}

void tn_run_store_free(tn_run_store *store)
{
    (void)store; /* always NULL */
}

tn_status tn_run_store_begun(const char *path, bool *begun, tn_error *error)
{
    (void)path;
    *begun = false;
    return absent(error);
}

tn_status tn_run_store_put_meta(tn_run_store *store, const char *const *keys, const char *const *values, size_t count,
                                tn_error *error)
{
    (void)store, (void)keys, (void)values, (void)count;
    return absent(error);
}

tn_status tn_run_store_get_meta(tn_run_store *store, const char *key, char **value, tn_error *error)
{
    (void)store, (void)key;
    *value = NULL;
    return absent(error);
}

tn_status tn_run_store_message(tn_run_store *store, uint64_t id, char message[200], tn_error *error)
{
    (void)store, (void)id;
    message[0] = '\0';
    return absent(error);
}

tn_status tn_run_store_generations(tn_run_store *store, uint32_t *count, tn_error *error)
{
    (void)store;
    *count = 0;
    return absent(error);
}

tn_status tn_run_store_put_event(tn_run_store *store, uint32_t generation, const char *kind, const char *text,
                                 tn_error *error)
{
    (void)store, (void)generation, (void)kind, (void)text;
    return absent(error);
}

tn_status tn_run_store_put(tn_run_store *store, const tn_evolution *evolution, size_t numbers,
                           const tn_run_event *events, size_t event_count, const tn_rescored *rescored,
                           size_t rescored_count, tn_error *error)
{
    (void)store, (void)evolution, (void)numbers, (void)events, (void)event_count, (void)rescored;
    (void)rescored_count;
    return absent(error);
}

tn_status tn_run_store_rescored(tn_run_store *store, uint32_t generation, size_t numbers, tn_rescored **rescored,
                                size_t *count, tn_error *error)
{
    (void)store, (void)generation, (void)numbers;
    *rescored = NULL;
    *count = 0;
    return absent(error);
}

tn_status tn_run_store_events(tn_run_store *store, tn_run_event **events, size_t *count, tn_error *error)
{
    (void)store;
    *events = NULL;
    *count = 0;
    return absent(error);
}

void tn_run_events_free(tn_run_event *events, size_t count)
{
    (void)events, (void)count; /* always none */
}

tn_status tn_run_store_scores(tn_run_store *store, size_t numbers, tn_run_scores *scores, tn_error *error)
{
    (void)store, (void)numbers;
    *scores = (tn_run_scores){0};
    return absent(error);
}

void tn_run_scores_clear(tn_run_scores *scores)
{
    *scores = (tn_run_scores){0};
}

bool tn_run_scores_recall(void *scores, uint64_t id, tn_score *score)
{
    (void)scores, (void)id, (void)score;
    return false;
}

bool tn_run_scores_recall_parents(void *scores, uint64_t id, uint64_t parents[2])
{
    (void)scores, (void)id, (void)parents;
    return false;
}

tn_status tn_run_store_check(tn_run_store *store, const tn_evolution *evolution, tn_error *error)
{
    (void)store, (void)evolution;
    return absent(error);
}

tn_status tn_run_store_stats(tn_run_store *store, tn_generation_stats **stats, size_t *count, tn_error *error)
{
    (void)store;
    *stats = NULL;
    *count = 0;
    return absent(error);
}
