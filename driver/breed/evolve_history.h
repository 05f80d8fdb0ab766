/* What a run's database says of the generations that are stored, so that they can be made again without evaluating.
 * With several ranks, rank 0 reads it and tells the others. */
#ifndef TARTAN_DRIVER_BREED_EVOLVE_HISTORY_H
#define TARTAN_DRIVER_BREED_EVOLVE_HISTORY_H

#include "runtime/genome/store/run_store.h"
#include "runtime/ranks/ranks.h"

typedef struct tn_rescored_list {
    tn_rescored *items; /* in order of their ids; owned */
    size_t count;
} tn_rescored_list;

/* Owns all of it. Zero it to begin with; clear it in any case. */
typedef struct tn_run_history {
    uint32_t generations;
    tn_run_scores scores;
    tn_run_event *events;
    size_t event_count;
    tn_rescored_list *rescored; /* [events]: the members' scores after a change; empty for choices */
} tn_run_history;

/* Reads it; with several ranks together. `store` is NULL on all but rank 0. */
tn_status tn_run_history_read(tn_run_store *store, size_t numbers, const tn_ranks *ranks, tn_run_history *history,
                              tn_error *error);
void tn_run_history_clear(tn_run_history *history);

/* For tn_evolution_recall: the scores of a tn_rescored_list. */
bool tn_rescored_recall(void *list, uint64_t id, tn_score *score);

/* Orders scores by their ids. */
void tn_rescored_sort(tn_rescored *items, size_t count);

#endif
