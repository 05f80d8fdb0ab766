/* Makes, opens and writes a run's database. */
#include <math.h>
#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/genome/store/run_store.h"

struct tn_run_store {
    sqlite3 *db;
    sqlite3_stmt *put_birth, *put_generation, *put_event, *put_rescore;
};

static inline tn_status wrong(tn_run_store *store, tn_error *error)
{
    int code = sqlite3_errcode(store->db);
    if (code == SQLITE_NOMEM)
        return tn_fail_memory(error);
    if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT)
        return tn_fail(error, TN_INVALID, E_RUN_DATABASE, "the run's database is damaged: %s",
                       sqlite3_errmsg(store->db));
    return tn_fail(error, TN_IO, E_CANNOT_WRITE, "the run's database: %s", sqlite3_errmsg(store->db));
}

static inline tn_status run(tn_run_store *store, const char *sql, tn_error *error)
{
    return sqlite3_exec(store->db, sql, NULL, NULL, NULL) == SQLITE_OK ? TN_OK : wrong(store, error);
}

static inline tn_status prepare(tn_run_store *store, const char *sql, sqlite3_stmt **statement, tn_error *error)
{
    return sqlite3_prepare_v2(store->db, sql, -1, statement, NULL) == SQLITE_OK ? TN_OK : wrong(store, error);
}

/* Runs a statement that gives no rows, and makes it ready for the next time. */
static inline tn_status finish_step(tn_run_store *store, sqlite3_stmt *statement, tn_error *error)
{
    bool done = sqlite3_step(statement) == SQLITE_DONE;
    tn_status status = done ? TN_OK : wrong(store, error);
    sqlite3_reset(statement);
    return status;
}

/* One number that a query gives. */
static inline tn_status query_number(tn_run_store *store, const char *sql, int64_t *value, tn_error *error)
{
    sqlite3_stmt *statement = NULL;
    tn_status status = prepare(store, sql, &statement, error);
    if (status == TN_OK) {
        if (sqlite3_step(statement) == SQLITE_ROW)
            *value = sqlite3_column_int64(statement, 0);
        else
            status = wrong(store, error);
    }
    sqlite3_finalize(statement);
    return status;
}

static inline char *copy_column(sqlite3_stmt *statement, int column)
{
    const char *text = (const char *)sqlite3_column_text(statement, column);
    return strdup(text ? text : "");
}

/* ---- reads a run's database */

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

#define APPLICATION_ID 0x54524E31 /* "TRN1" in the header, so that `file` and we know the database */

static const char schema[] = "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
                             "CREATE TABLE generation(number INTEGER PRIMARY KEY, best REAL, mean REAL, scored "
                             "INTEGER, no_sentence INTEGER, failed INTEGER,"
                             " limited INTEGER, distinct_sentences INTEGER, evaluations INTEGER, births INTEGER, "
                             "mean_codons REAL, mean_depth REAL,"
                             " members BLOB, lower_quartile REAL, median REAL, upper_quartile REAL);"
                             "CREATE TABLE birth(id INTEGER PRIMARY KEY, kind INTEGER, parent INTEGER, other INTEGER, "
                             "state INTEGER, fitness REAL,"
                             " more BLOB, message TEXT);"
                             "CREATE TABLE event(generation INTEGER, number INTEGER, kind TEXT, text TEXT, PRIMARY "
                             "KEY(generation, number)) WITHOUT ROWID;"
                             "CREATE TABLE rescore(generation INTEGER, id INTEGER, state INTEGER, fitness REAL, more "
                             "BLOB, PRIMARY KEY(generation, id))"
                             " WITHOUT ROWID;";

void tn_run_store_free(tn_run_store *store)
{
    if (!store)
        return;
    sqlite3_finalize(store->put_birth);
    sqlite3_finalize(store->put_generation);
    sqlite3_finalize(store->put_event);
    sqlite3_finalize(store->put_rescore);
    sqlite3_close(store->db);
    free(store);
}

static tn_status cannot_open(const char *path, int flags, const tn_run_store *store, tn_error *error)
{
    if (!(flags & SQLITE_OPEN_CREATE) && access(path, F_OK) != 0) {
        tn_fail(error, TN_IO, E_CANNOT_READ, "there is no run: no file %.200s", path);
        tn_error_help(error, "name the folder that `tartan evolve` made, as hello.run");
        return TN_IO;
    }
    return tn_fail(error, TN_IO, flags & SQLITE_OPEN_CREATE ? E_CANNOT_WRITE : E_CANNOT_READ, "cannot open %.200s: %s",
                   path, sqlite3_errmsg(store->db));
}

static tn_status open_at(const char *path, int flags, bool durable, tn_run_store **store, tn_error *error)
{
    tn_run_store *s = calloc(1, sizeof *s);
    *store = s;
    if (!s)
        return tn_fail_memory(error);
    if (sqlite3_open_v2(path, &s->db, flags, NULL) != SQLITE_OK)
        return cannot_open(path, flags, s, error);
    sqlite3_busy_timeout(s->db, 5000);
    return run(s, durable ? "PRAGMA synchronous=FULL" : "PRAGMA synchronous=OFF", error);
}

static tn_status prepare_writing(tn_run_store *store, tn_error *error)
{
    tn_status status = prepare(store, "INSERT INTO birth VALUES(?,?,?,?,?,?,?,?)", &store->put_birth, error);
    if (status == TN_OK)
        status = prepare(store, "INSERT INTO generation VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)",
                         &store->put_generation, error);
    if (status == TN_OK)
        status = prepare(store, "INSERT OR REPLACE INTO event VALUES(?,?,?,?)", &store->put_event, error);
    if (status == TN_OK)
        status = prepare(store, "INSERT INTO rescore VALUES(?,?,?,?,?)", &store->put_rescore, error);
    return status;
}

static tn_status done(tn_run_store **store, tn_status status)
{
    if (status != TN_OK) {
        tn_run_store_free(*store);
        *store = NULL;
    }
    return status;
}

tn_status tn_run_store_create(const char *path, bool durable, tn_run_store **store, tn_error *error)
{
    *store = NULL;
    if (access(path, F_OK) == 0) {
        tn_fail(error, TN_INVALID, E_RUN_EXISTS, "there is a run in %.200s already", path);
        tn_error_help(error, "--resume goes on with it; -o DIR puts this run elsewhere");
        return TN_INVALID;
    }
    tn_status status = open_at(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, durable, store, error);
    char pragma[64];
    snprintf(pragma, sizeof pragma, "PRAGMA application_id=%d", APPLICATION_ID);
    if (status == TN_OK)
        status = run(*store, "BEGIN IMMEDIATE", error);
    if (status == TN_OK)
        status = run(*store, pragma, error);
    if (status == TN_OK)
        status = run(*store, schema, error);
    if (status == TN_OK)
        status = run(*store, "COMMIT", error);
    if (status == TN_OK)
        status = prepare_writing(*store, error);
    return done(store, status);
}

/* Runs of before there were quartiles get the columns, empty, before they are gone on with. */
static tn_status add_columns(tn_run_store *store, tn_error *error)
{
    int64_t there = 0;
    tn_status status =
        query_number(store, "SELECT count(*) FROM pragma_table_info('generation') WHERE name='median'", &there, error);
    if (status != TN_OK || there)
        return status;
    return run(store,
               "BEGIN IMMEDIATE;"
               "ALTER TABLE generation ADD COLUMN lower_quartile REAL;"
               "ALTER TABLE generation ADD COLUMN median REAL;"
               "ALTER TABLE generation ADD COLUMN upper_quartile REAL;"
               "COMMIT",
               error);
}

tn_status tn_run_store_open(const char *path, bool durable, bool read_only, tn_run_store **store, tn_error *error)
{
    int64_t id = 0;
    tn_status status = open_at(path, read_only ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE, durable, store, error);
    if (status == TN_OK)
        status = query_number(*store, "PRAGMA application_id", &id, error);
    if (status == TN_OK && id != APPLICATION_ID)
        status = tn_fail(error, TN_INVALID, E_RUN_DATABASE, "%.200s is not the database of a run", path);
    if (status == TN_OK && !read_only)
        status = add_columns(*store, error);
    if (status == TN_OK && !read_only)
        status = prepare_writing(*store, error);
    return done(store, status);
}

tn_status tn_run_store_begun(const char *path, bool *begun, tn_error *error)
{
    int64_t tables = 0, id = 0, rows = 0;
    tn_run_store *store = NULL;
    tn_status status = open_at(path, SQLITE_OPEN_READWRITE, false, &store, error);
    if (status == TN_OK)
        status = query_number(store, "SELECT count(*) FROM sqlite_master", &tables, error);
    if (status == TN_OK && tables > 0)
        status = query_number(store, "PRAGMA application_id", &id, error);
    if (status == TN_OK && tables > 0 && id != APPLICATION_ID)
        status = tn_fail(error, TN_INVALID, E_RUN_DATABASE, "%.200s is not the database of a run", path);
    if (status == TN_OK && tables > 0)
        status = query_number(store, "SELECT count(*) FROM meta", &rows, error);
    if (status == TN_INVALID)
        tn_error_help(error, "--resume leaves it as it is; -o DIR starts another run");
    *begun = rows > 0;
    tn_run_store_free(store);
    return status;
}

/* ---- meta */

tn_status tn_run_store_put_meta(tn_run_store *store, const char *const *keys, const char *const *values, size_t count,
                                tn_error *error)
{
    sqlite3_stmt *statement = NULL;
    tn_status status = run(store, "BEGIN IMMEDIATE", error);
    if (status == TN_OK)
        status = prepare(store, "INSERT INTO meta VALUES(?,?)", &statement, error);
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        sqlite3_bind_text(statement, 1, keys[i], -1, SQLITE_STATIC);
        sqlite3_bind_text(statement, 2, values[i], -1, SQLITE_STATIC);
        status = finish_step(store, statement, error);
    }
    sqlite3_finalize(statement);
    return status == TN_OK ? run(store, "COMMIT", error) : status;
}

tn_status tn_run_store_get_meta(tn_run_store *store, const char *key, char **value, tn_error *error)
{
    sqlite3_stmt *statement = NULL;
    *value = NULL;
    tn_status status = prepare(store, "SELECT value FROM meta WHERE key=?", &statement, error);
    if (status != TN_OK)
        return status;
    sqlite3_bind_text(statement, 1, key, -1, SQLITE_STATIC);
    if (sqlite3_step(statement) == SQLITE_ROW && !(*value = copy_column(statement, 0)))
        status = tn_fail_memory(error);
    sqlite3_finalize(statement);
    return status;
}

tn_status tn_run_store_generations(tn_run_store *store, uint32_t *count, tn_error *error)
{
    int64_t number = 0;
    tn_status status = query_number(store, "SELECT count(*) FROM generation", &number, error);
    *count = (uint32_t)number;
    return status;
}

/* ---- writing a generation */

static void bind_id(sqlite3_stmt *statement, int column, uint64_t id)
{
    if (id == TN_NO_PARENT)
        sqlite3_bind_null(statement, column);
    else
        sqlite3_bind_int64(statement, column, (int64_t)id);
}

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* State, the first objective and the further ones, from column `first` on. What is lacking of the requirements comes
 * after the last one, where it is not 0. */
static void bind_score(sqlite3_stmt *s, int first, const tn_score *score, size_t numbers)
{
    uint8_t more[8 * TN_SCORE_NUMBERS_MAX];
    bool lacks = numbers > 1 && score->state == TN_SCORED && score->violation != 0;
    for (size_t i = 1; i < numbers; i++)
        tn_put_u64(more + 8 * (i - 1), bits_of(score->objectives[i]));
    if (lacks)
        tn_put_u64(more + 8 * (numbers - 1), bits_of(score->violation));
    sqlite3_bind_int(s, first, (int)score->state);
    if (score->state == TN_SCORED)
        sqlite3_bind_double(s, first + 1, score->objectives[0]);
    else
        sqlite3_bind_null(s, first + 1);
    if (numbers > 1)
        sqlite3_bind_blob(s, first + 2, more, (int)(8 * (numbers - 1 + lacks)), SQLITE_TRANSIENT);
    else
        sqlite3_bind_null(s, first + 2);
}

static tn_status put_birth(tn_run_store *store, const tn_individual *born, size_t numbers, tn_error *error)
{
    sqlite3_stmt *s = store->put_birth;
    sqlite3_bind_int64(s, 1, (int64_t)born->id);
    sqlite3_bind_int(s, 2, born->kind);
    bind_id(s, 3, born->parents[0]);
    bind_id(s, 4, born->parents[1]);
    bind_score(s, 5, &born->score, numbers);
    bool said = born->score.state == TN_SCORE_FAILED || born->score.state == TN_SCORE_LIMIT;
    if (born->score.state == TN_SCORE_NO_SENTENCE)
        sqlite3_bind_text(s, 8, tn_mapping_reason_text(born->reason), -1, SQLITE_STATIC);
    else if (said && born->message[0])
        sqlite3_bind_text(s, 8, born->message, -1, SQLITE_STATIC);
    else
        sqlite3_bind_null(s, 8);
    return finish_step(store, s, error);
}

static tn_status put_generation(tn_run_store *store, const tn_evolution *evolution, tn_error *error)
{
    size_t count;
    const tn_individual *const *members = tn_evolution_members(evolution, &count);
    tn_generation_stats t = tn_evolution_stats(evolution);
    sqlite3_stmt *s = store->put_generation;
    uint8_t *ids = malloc(8 * count + 1);
    if (!ids)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        tn_put_u64(ids + 8 * i, members[i]->id);
    sqlite3_bind_int64(s, 1, t.generation);
    sqlite3_bind_double(s, 2, t.best[0]);
    sqlite3_bind_double(s, 3, t.mean);
    sqlite3_bind_int64(s, 4, t.scored);
    sqlite3_bind_int64(s, 5, t.no_sentence);
    sqlite3_bind_int64(s, 6, t.failed);
    sqlite3_bind_int64(s, 7, t.limited);
    sqlite3_bind_int64(s, 8, t.distinct);
    sqlite3_bind_int64(s, 9, (int64_t)t.evaluations);
    sqlite3_bind_int64(s, 10, (int64_t)t.births);
    sqlite3_bind_double(s, 11, t.mean_codons);
    sqlite3_bind_double(s, 12, t.mean_depth);
    sqlite3_bind_blob(s, 13, ids, (int)(8 * count), free);
    for (int i = 0; i < 3; i++)
        sqlite3_bind_double(s, 14 + i, t.quartiles[i]);
    return finish_step(store, s, error);
}

static tn_status put_events(tn_run_store *store, uint32_t generation, const tn_run_event *events, size_t count,
                            tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        sqlite3_bind_int64(store->put_event, 1, generation);
        sqlite3_bind_int64(store->put_event, 2, (int64_t)i);
        sqlite3_bind_text(store->put_event, 3, events[i].kind, -1, SQLITE_STATIC);
        sqlite3_bind_text(store->put_event, 4, events[i].text, -1, SQLITE_STATIC);
        status = finish_step(store, store->put_event, error);
    }
    return status;
}

tn_status tn_run_store_put_event(tn_run_store *store, uint32_t generation, const char *kind, const char *text,
                                 tn_error *error)
{
    sqlite3_stmt *statement = NULL;
    tn_status status = prepare(
        store, "INSERT INTO event SELECT ?1, coalesce(max(number) + 1, 0), ?2, ?3 FROM event WHERE generation=?1",
        &statement, error);
    if (status == TN_OK) {
        sqlite3_bind_int64(statement, 1, generation);
        sqlite3_bind_text(statement, 2, kind, -1, SQLITE_STATIC);
        sqlite3_bind_text(statement, 3, text, -1, SQLITE_STATIC);
        status = finish_step(store, statement, error);
    }
    sqlite3_finalize(statement);
    return status;
}

static tn_status put_rescored(tn_run_store *store, uint32_t generation, const tn_rescored *rescored, size_t count,
                              size_t numbers, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        sqlite3_bind_int64(store->put_rescore, 1, generation);
        sqlite3_bind_int64(store->put_rescore, 2, (int64_t)rescored[i].id);
        bind_score(store->put_rescore, 3, &rescored[i].score, numbers);
        status = finish_step(store, store->put_rescore, error);
    }
    return status;
}

tn_status tn_run_store_put(tn_run_store *store, const tn_evolution *evolution, size_t numbers,
                           const tn_run_event *events, size_t event_count, const tn_rescored *rescored,
                           size_t rescored_count, tn_error *error)
{
    size_t count, inserted_count;
    const tn_individual *const *born = tn_evolution_born(evolution, &count);
    uint32_t generation = tn_evolution_generation(evolution);
    tn_status status = run(store, "BEGIN IMMEDIATE", error);
    if (status == TN_OK)
        status = put_events(store, generation, events, event_count, error);
    if (status == TN_OK)
        status = put_rescored(store, generation, rescored, rescored_count, numbers, error);
    const tn_individual *const *inserted = tn_evolution_inserted(evolution, &inserted_count);
    for (size_t i = 0; i < inserted_count && status == TN_OK; i++)
        status = put_birth(store, inserted[i], numbers, error);
    for (size_t i = 0; i < count && status == TN_OK; i++)
        status = put_birth(store, born[i], numbers, error);
    if (status == TN_OK)
        status = put_generation(store, evolution, error);
    if (status == TN_OK)
        return run(store, "COMMIT", error);
    sqlite3_exec(store->db, "ROLLBACK", NULL, NULL, NULL);
    return status;
}
