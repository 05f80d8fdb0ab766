/* The C interface to runs of evolution that are kept in a database. */
#include <stdlib.h>
#include <string.h>

#include "api/genome/evolution.h"
#include "runtime/genome/store/run_store.h"

struct tartan_run {
    tn_run_store *store;
    tn_generation_stats *stats;
    size_t stat_count;
    tn_run_event *events;
    size_t event_count;
    size_t objectives;
};

static tn_status read_objectives(tartan_run *run, tn_error *error)
{
    char *text = NULL;
    tn_status status = tn_run_store_get_meta(run->store, "objectives", &text, error);
    unsigned long long count = text ? strtoull(text, NULL, 10) : 1;
    free(text);
    run->objectives = count < 1 ? 1 : count > TN_OBJECTIVES_MAX ? TN_OBJECTIVES_MAX : (size_t)count;
    return status;
}

static tn_status read(const char *path, tartan_run *run, tn_error *error)
{
    tn_status status = tn_run_store_open(path, false, true, &run->store, error);
    if (status == TN_OK)
        status = read_objectives(run, error);
    if (status == TN_OK)
        status = tn_run_store_stats(run->store, &run->stats, &run->stat_count, error);
    if (status == TN_OK)
        status = tn_run_store_events(run->store, &run->events, &run->event_count, error);
    return status;
}

tartan_status tartan_run_open(const char *path, tartan_run **run, tartan_error *error)
{
    tn_error found;
    if (!path || !run)
        return tn_api_missing(error, path ? "room for the run" : "path");
    tartan_run *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    if (read(path, made, &found) != TN_OK) {
        tartan_run_free(made);
        return tn_api_fail(&found, error);
    }
    *run = made;
    return TARTAN_OK;
}

void tartan_run_free(tartan_run *run)
{
    if (!run)
        return;
    tn_run_events_free(run->events, run->event_count);
    free(run->stats);
    tn_run_store_free(run->store);
    free(run);
}

tartan_status tartan_run_text(tartan_run *run, const char *name, char **text, tartan_error *error)
{
    tn_error found;
    char *value = NULL;
    if (!run || !name || !text)
        return tn_api_missing(error, !run ? "run" : !name ? "name" : "room for the text");
    if (tn_run_store_get_meta(run->store, name, &value, &found) != TN_OK)
        return tn_api_fail(&found, error);
    *text = value;
    return TARTAN_OK;
}

size_t tartan_run_generations(const tartan_run *run)
{
    return run->stat_count;
}

size_t tartan_run_objectives(const tartan_run *run)
{
    return run->objectives;
}

tartan_status tartan_run_generation(const tartan_run *run, size_t i, tartan_generation *generation, tartan_error *error)
{
    if (!run)
        return tn_api_missing(error, "run");
    if (i >= run->stat_count)
        return tn_api_refuse(error, TARTAN_INVALID, "the run has %zu generations", run->stat_count);
    tartan_generation own = tn_api_generation(&run->stats[i]);
    return TN_API_GIVE(tartan_generation, generation, &own, error);
}

size_t tartan_run_event_count(const tartan_run *run)
{
    return run->event_count;
}

tartan_status tartan_run_event_at(const tartan_run *run, size_t i, tartan_run_event *event, tartan_error *error)
{
    if (!run)
        return tn_api_missing(error, "run");
    if (i >= run->event_count)
        return tn_api_refuse(error, TARTAN_INVALID, "the run has %zu events", run->event_count);
    const tn_run_event *from = &run->events[i];
    tartan_run_event own = {.size = sizeof own, .generation = from->generation, .kind = from->kind, .text = from->text};
    return TN_API_GIVE(tartan_run_event, event, &own, error);
}
