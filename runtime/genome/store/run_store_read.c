/* Reads a run's database: events, scores and statistics. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/genome/store/run_store_sql.h"

void tn_run_events_free(tn_run_event *events, size_t count)
{
    for (size_t i = 0; events && i < count; i++) {
        free(events[i].kind);
        free(events[i].text);
    }
    free(events);
}

tn_status tn_run_store_events(tn_run_store *store, tn_run_event **events, size_t *count, tn_error *error)
{
    sqlite3_stmt *statement = NULL;
    size_t capacity = 0;
    *events = NULL;
    *count = 0;
    tn_status status =
        prepare(store, "SELECT generation, kind, text FROM event ORDER BY generation, number", &statement, error);
    while (status == TN_OK && sqlite3_step(statement) == SQLITE_ROW) {
        if (!tn_array_reserve_from(events, &capacity, 16, *count, 1, sizeof **events)) {
            status = tn_fail_memory(error);
            break;
        }
        tn_run_event *event = &(*events)[(*count)++];
        *event = (tn_run_event){(uint32_t)sqlite3_column_int64(statement, 0), copy_column(statement, 1),
                                copy_column(statement, 2)};
        if (!event->kind || !event->text)
            status = tn_fail_memory(error);
    }
    sqlite3_finalize(statement);
    return status;
}

void tn_run_scores_clear(tn_run_scores *scores)
{
    free(scores->scores);
    free(scores->parents);
    free(scores->known);
    *scores = (tn_run_scores){0};
}

bool tn_run_scores_recall(void *context, uint64_t id, tn_score *score)
{
    const tn_run_scores *scores = context;
    if (id >= scores->count || !scores->known[id])
        return false;
    *score = scores->scores[id];
    return true;
}

bool tn_run_scores_recall_parents(void *context, uint64_t id, uint64_t parents[2])
{
    const tn_run_scores *scores = context;
    if (!scores->parents || id >= scores->count || !scores->known[id])
        return false;
    memcpy(parents, scores->parents[id], sizeof scores->parents[id]);
    return true;
}

static uint64_t read_parent(sqlite3_stmt *statement, int column)
{
    return sqlite3_column_type(statement, column) == SQLITE_NULL ? TN_NO_PARENT
                                                                 : (uint64_t)sqlite3_column_int64(statement, column);
}

static void read_score(sqlite3_stmt *statement, size_t numbers, tn_score *score)
{
    int state = sqlite3_column_int(statement, 1);
    score->state = state >= 0 && state < TN_SCORE_STATE_COUNT ? (tn_score_state)state : TN_SCORE_FAILED;
    score->objectives[0] = sqlite3_column_double(statement, 2);
    const uint8_t *more = sqlite3_column_blob(statement, 3);
    size_t size = (size_t)sqlite3_column_bytes(statement, 3);
    for (size_t i = 1; i <= numbers; i++) {
        uint64_t bits = more && size >= 8 * i ? tn_get_u64(more + 8 * (i - 1)) : 0;
        memcpy(i < numbers ? &score->objectives[i] : &score->violation, &bits, sizeof bits);
    }
}

tn_status tn_run_store_scores(tn_run_store *store, size_t numbers, tn_run_scores *scores, tn_error *error)
{
    sqlite3_stmt *statement = NULL;
    int64_t most = -1;
    *scores = (tn_run_scores){0};
    tn_status status = query_number(store, "SELECT coalesce(max(id), -1) FROM birth", &most, error);
    if (status != TN_OK)
        return status;
    if (most >= (int64_t)1 << 32)
        return tn_fail(error, TN_LIMIT, E_RUN_DATABASE, "the run has more than 2^32 births, the limit of resuming");
    scores->count = (size_t)(most + 1);
    scores->scores = calloc(scores->count + 1, sizeof *scores->scores);
    scores->parents = calloc(scores->count + 1, sizeof *scores->parents);
    scores->known = calloc(scores->count + 1, 1);
    if (!scores->scores || !scores->parents || !scores->known)
        return tn_fail_memory(error);
    status = prepare(store, "SELECT id, state, fitness, more, parent, other FROM birth", &statement, error);
    while (status == TN_OK && sqlite3_step(statement) == SQLITE_ROW) {
        int64_t id = sqlite3_column_int64(statement, 0);
        if (id < 0)
            continue;
        read_score(statement, numbers, &scores->scores[id]);
        for (int i = 0; i < 2; i++)
            scores->parents[id][i] = read_parent(statement, 4 + i);
        scores->known[id] = 1;
    }
    sqlite3_finalize(statement);
    return status;
}

tn_status tn_run_store_rescored(tn_run_store *store, uint32_t generation, size_t numbers, tn_rescored **rescored,
                                size_t *count, tn_error *error)
{
    sqlite3_stmt *statement = NULL;
    size_t capacity = 0;
    *rescored = NULL;
    *count = 0;
    tn_status status = prepare(store, "SELECT id, state, fitness, more FROM rescore WHERE generation=? ORDER BY id",
                               &statement, error);
    if (status == TN_OK)
        sqlite3_bind_int64(statement, 1, generation);
    while (status == TN_OK && sqlite3_step(statement) == SQLITE_ROW) {
        if (!tn_array_reserve(rescored, &capacity, *count, 1, sizeof **rescored)) {
            status = tn_fail_memory(error);
            break;
        }
        tn_rescored *one = &(*rescored)[(*count)++];
        *one = (tn_rescored){.id = (uint64_t)sqlite3_column_int64(statement, 0)};
        read_score(statement, numbers, &one->score);
    }
    sqlite3_finalize(statement);
    return status;
}

tn_status tn_run_store_check(tn_run_store *store, const tn_evolution *evolution, tn_error *error)
{
    sqlite3_stmt *statement = NULL;
    size_t count;
    const tn_individual *const *members = tn_evolution_members(evolution, &count);
    uint32_t generation = tn_evolution_generation(evolution);
    tn_status status = prepare(store, "SELECT members FROM generation WHERE number=?", &statement, error);
    if (status != TN_OK)
        return status;
    sqlite3_bind_int64(statement, 1, generation);
    bool same = sqlite3_step(statement) == SQLITE_ROW && (size_t)sqlite3_column_bytes(statement, 0) == 8 * count;
    const uint8_t *ids = same ? sqlite3_column_blob(statement, 0) : NULL;
    for (size_t i = 0; i < count && same; i++)
        same = tn_get_u64(ids + 8 * i) == members[i]->id;
    sqlite3_finalize(statement);
    if (same)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_RUN_DIFFERS,
            "generation %u does not give the results that are stored: the run was made with another grammar, study or "
            "version",
            generation);
    tn_error_help(error, "resume it with the files and the version of tartan that it was started with");
    return TN_INVALID;
}

tn_status tn_run_store_message(tn_run_store *store, uint64_t id, char message[200], tn_error *error)
{
    sqlite3_stmt *statement = NULL;
    message[0] = '\0';
    tn_status status = prepare(store, "SELECT message FROM birth WHERE id = ?", &statement, error);
    if (status != TN_OK)
        return status;
    sqlite3_bind_int64(statement, 1, (sqlite3_int64)id);
    if (sqlite3_step(statement) == SQLITE_ROW && sqlite3_column_type(statement, 0) == SQLITE_TEXT)
        snprintf(message, 200, "%s", (const char *)sqlite3_column_text(statement, 0));
    sqlite3_finalize(statement);
    return TN_OK;
}

tn_status tn_run_store_stats(tn_run_store *store, tn_generation_stats **stats, size_t *count, tn_error *error)
{
    sqlite3_stmt *statement = NULL;
    uint32_t generations;
    *stats = NULL;
    *count = 0;
    tn_status status = tn_run_store_generations(store, &generations, error);
    if (status == TN_OK && !(*stats = calloc((size_t)generations + 1, sizeof **stats)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = prepare(store, "SELECT * FROM generation ORDER BY number", &statement, error);
    while (status == TN_OK && *count < generations && sqlite3_step(statement) == SQLITE_ROW) {
        tn_generation_stats *s = &(*stats)[(*count)++];
        s->generation = (uint32_t)sqlite3_column_int64(statement, 0);
        s->best[0] = sqlite3_column_double(statement, 1);
        s->mean = sqlite3_column_double(statement, 2);
        s->scored = (uint32_t)sqlite3_column_int64(statement, 3);
        s->no_sentence = (uint32_t)sqlite3_column_int64(statement, 4);
        s->failed = (uint32_t)sqlite3_column_int64(statement, 5);
        s->limited = (uint32_t)sqlite3_column_int64(statement, 6);
        s->distinct = (uint32_t)sqlite3_column_int64(statement, 7);
        s->evaluations = (uint64_t)sqlite3_column_int64(statement, 8);
        s->births = (uint64_t)sqlite3_column_int64(statement, 9);
        s->mean_codons = sqlite3_column_double(statement, 10);
        s->mean_depth = sqlite3_column_double(statement, 11);
        for (int i = 0; i < 3; i++)
            s->quartiles[i] = sqlite3_column_type(statement, 13 + i) == SQLITE_FLOAT
                                  ? sqlite3_column_double(statement, 13 + i)
                                  : NAN; /* a run of before they were stored */
    }
    sqlite3_finalize(statement);
    return status;
}
