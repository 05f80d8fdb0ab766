/* Writes and reads the records of shards, and reads shards through. */
#include "driver/shards/record.h"

#include <errno.h>
#include <inttypes.h>
#include <jansson.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "driver/open/missing.h"
#include "driver/shards/hash.h"
#include "runtime/base/file.h"
#include "runtime/base/integers.h"
#include "runtime/plan/text/pack.h"

#define RECORD_BYTES (1u << 20) /* the most: complaints about a hundred plans */
#define RECORD_VERSION 2        /* the first one did not say which it is, nor of which shard */

/* Needs no memory, whose lack would look like a shard that is not there. */
static bool is_there(const tn_shard_set *set, uint32_t shard, const char *ending)
{
    struct stat known;
    char path[PATH_MAX];
    int size = snprintf(path, sizeof path, "%s/%s%s", set->folder, tn_shard_name_of(set, shard).text, ending);
    return size < PATH_MAX && stat(path, &known) == 0 && S_ISREG(known.st_mode);
}

bool tn_shard_exists(const tn_shard_set *set, uint32_t shard)
{
    return is_there(set, shard, "");
}

bool tn_shard_recorded(const tn_shard_set *set, uint32_t shard)
{
    return is_there(set, shard, TN_SHARD_RECORD) && tn_shard_exists(set, shard);
}

tn_status tn_shard_wrong(const tn_shard_set *set, uint32_t shard, tn_error *error, const char *format, ...)
{
    char text[240];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    const tn_shard_name name = tn_shard_name_of(set, shard);
    tn_fail(error, TN_INVALID, E_SHARD_WRONG, "%.150s/%s %s", set->folder, name.text, text);
    tn_error_help(error, "delete it and its " TN_SHARD_RECORD ", and write it again: tartan shards run %.120s",
                  set->folder);
    return TN_INVALID;
}

/* ---- records */

static void write_complaint(const tn_error *complaint, tn_json *json)
{
    tn_json_object(json, NULL);
    tn_json_whole(json, "code", complaint->code);
    tn_json_count(json, "line", complaint->line);
    tn_json_count(json, "column", complaint->column);
    tn_json_string(json, "message", complaint->message);
    tn_json_object_end(json);
}

static void write_read(const tn_shard_read *read, tn_json *json)
{
    tn_json_count(json, "lines", read->lines);
    tn_json_count(json, "unread", read->unread);
    if (read->unread == 0)
        return;
    tn_json_list(json, "complaints");
    for (size_t i = 0; i < read->unread && i < TN_COMPLAINTS_KEPT; i++)
        write_complaint(&read->complaints[i], json);
    tn_json_list_end(json);
}

static void write_file(const tn_shard_file *file, tn_json *json)
{
    tn_json_count(json, "bytes", file->bytes);
    tn_json_string(json, "hash", file->hash);
}

/* The files behind the first. */
static void write_others(const tn_shard_record *record, tn_json *json)
{
    tn_json_list(json, "others");
    for (size_t i = 1; i < TN_HOUSE_TABLES; i++) {
        tn_json_object(json, NULL);
        write_file(&record->files[i], json);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static bool write_record(const tn_shard_set *set, uint32_t shard, const tn_shard_record *record,
                         const tn_shard_read *read, tn_buffer *text)
{
    tn_json json = tn_json_text(text, TN_JSON_SPACED);
    tn_json_object(&json, NULL);
    tn_json_whole(&json, "tartan_record", RECORD_VERSION);
    tn_json_string(&json, "set", set->hash);
    tn_json_count(&json, "shard", shard);
    write_file(&record->files[0], &json);
    if (tn_shard_set_houses(set))
        write_others(record, &json);
    if (read)
        write_read(read, &json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
    return !text->failed;
}

tn_status tn_shard_record_write(const tn_shard_set *set, uint32_t shard, const tn_shard_record *record,
                                const tn_shard_read *read, tn_error *error)
{
    tn_output output;
    tn_buffer text = {0};
    char *beside = tn_shard_path(set, shard, TN_SHARD_RECORD);
    tn_status status = beside && write_record(set, shard, record, read, &text) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_output_open(beside, &output, error);
    if (status == TN_OK) {
        output.derived = true;
        fwrite(text.data, 1, text.size, output.stream);
        status = tn_output_commit(&output, error);
    }
    free(text.data);
    free(beside);
    return status;
}

static bool parse_number(const json_t *object, const char *key, uint64_t *number)
{
    const json_t *value = json_object_get(object, key);
    *number = (uint64_t)json_integer_value(value);
    return json_is_integer(value) && json_integer_value(value) >= 0;
}

static bool parse_file(const json_t *json, tn_shard_file *file)
{
    const char *hash = json_string_value(json_object_get(json, "hash"));
    bool whole = parse_number(json, "bytes", &file->bytes) && hash && strlen(hash) == 32;
    if (whole)
        memcpy(file->hash, hash, 33);
    return whole;
}

static bool parse_others(const json_t *json, tn_shard_record *record)
{
    const json_t *others = json_object_get(json, "others");
    bool whole = json_array_size(others) == TN_HOUSE_TABLES - 1;
    for (size_t i = 1; whole && i < TN_HOUSE_TABLES; i++)
        whole = parse_file(json_array_get(others, i - 1), &record->files[i]);
    return whole;
}

static bool parse_record(const tn_shard_set *set, const json_t *json, tn_shard_record *record)
{
    *record = (tn_shard_record){0};
    bool whole = parse_file(json, &record->files[0]);
    if (whole && tn_shard_set_houses(set))
        whole = parse_others(json, record);
    if (whole && tn_shard_set_answers(set))
        whole = parse_number(json, "lines", &record->lines) && parse_number(json, "unread", &record->unread);
    return whole;
}

static bool parse_complaint(const json_t *json, tn_error *complaint)
{
    const char *message = json_string_value(json_object_get(json, "message"));
    uint64_t code, column;
    bool whole = message && parse_number(json, "code", &code) && parse_number(json, "line", &complaint->line) &&
                 parse_number(json, "column", &column) && code <= UINT16_MAX && column <= UINT32_MAX;
    if (!whole)
        return false;
    uint64_t line = complaint->line;
    tn_fail(complaint, TN_INVALID, (tn_code)code, "%s", message);
    tn_error_place(complaint, line, (size_t)column, (size_t)column + 1);
    return true;
}

static bool parse_read(const tn_shard_set *set, const json_t *json, tn_shard_read *read)
{
    tn_shard_record record;
    const json_t *complaints = json_object_get(json, "complaints");
    bool whole = parse_record(set, json, &record);
    read->lines = record.lines;
    read->unread = record.unread;
    size_t wanted = record.unread < TN_COMPLAINTS_KEPT ? (size_t)record.unread : TN_COMPLAINTS_KEPT;
    whole = whole && json_array_size(complaints) == wanted;
    for (size_t i = 0; whole && i < wanted; i++)
        whole = parse_complaint(json_array_get(complaints, i), &read->complaints[i]);
    return whole;
}

static tn_status damaged_record(const tn_shard_set *set, uint32_t shard, tn_error *error)
{
    return tn_shard_wrong(set, shard, error, "has a damaged " TN_SHARD_RECORD);
}

/* Is the record of a version that is known, and of this shard of this set? */
static tn_status check_owner(const tn_shard_set *set, uint32_t shard, const json_t *json, tn_error *error)
{
    const char *owner = json_string_value(json_object_get(json, "set"));
    uint64_t version = 1, number;
    if (json_object_get(json, "tartan_record") && !parse_number(json, "tartan_record", &version))
        return damaged_record(set, shard, error);
    if (version != RECORD_VERSION)
        return tn_shard_wrong(set, shard, error,
                              "has a " TN_SHARD_RECORD " of version %" PRIu64 ", and only version %d is known", version,
                              RECORD_VERSION);
    if (!owner || !parse_number(json, "shard", &number))
        return damaged_record(set, shard, error);
    if (strcmp(owner, set->hash) != 0)
        return tn_shard_wrong(set, shard, error, "has the " TN_SHARD_RECORD " of a shard of another set");
    return number == shard ? TN_OK
                           : tn_shard_wrong(set, shard, error,
                                            "has the " TN_SHARD_RECORD " of shard %" PRIu64 " of this set", number);
}

/* The JSON of the record, which is of this shard. */
static tn_status load_record(const tn_shard_set *set, uint32_t shard, json_t **json, tn_error *error)
{
    uint8_t *bytes = NULL;
    size_t size = 0;
    char *path = tn_shard_path(set, shard, TN_SHARD_RECORD);
    tn_status status = path ? tn_file_read(path, RECORD_BYTES, &bytes, &size, error) : tn_fail_memory(error);
    *json = status == TN_OK ? json_loadb((const char *)bytes, size, 0, NULL) : NULL;
    free(bytes);
    free(path);
    if (status != TN_OK)
        return status;
    return *json ? check_owner(set, shard, *json, error) : damaged_record(set, shard, error);
}

tn_status tn_shard_record_read(const tn_shard_set *set, uint32_t shard, tn_shard_record *record, tn_error *error)
{
    json_t *json;
    tn_status status = load_record(set, shard, &json, error);
    if (status == TN_OK && !parse_record(set, json, record))
        status = damaged_record(set, shard, error);
    json_decref(json);
    return status;
}

tn_status tn_shard_read_of(const tn_shard_set *set, uint32_t shard, tn_shard_read *read, tn_error *error)
{
    json_t *json;
    tn_status status = load_record(set, shard, &json, error);
    if (status == TN_OK && !parse_read(set, json, read))
        status = damaged_record(set, shard, error);
    json_decref(json);
    return status;
}

/* ", in rooms" of a shard of several files. */
static const char *in_table(const tn_shard_set *set, uint32_t file, char text[40])
{
    snprintf(text, 40, "%s%s", tn_shard_set_houses(set) ? ", in " : "",
             tn_shard_set_houses(set) ? tn_house_table_name((tn_house_table)file) : "");
    return text;
}

static tn_status compare_size(const tn_shard_set *set, uint32_t shard, uint32_t file, uint64_t found, uint64_t wanted,
                              tn_error *error)
{
    char where[40];
    return found == wanted
               ? TN_OK
               : tn_shard_wrong(set, shard, error, "has %" PRIu64 " bytes, and had %" PRIu64 " when it was written%s",
                                found, wanted, in_table(set, file, where));
}

static tn_status file_done(const tn_shard_set *set, uint32_t shard, uint32_t file, const tn_shard_record *record,
                           tn_error *error)
{
    struct stat known;
    char *path = tn_shard_file_path(set, shard, file);
    tn_status status = path ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && stat(path, &known) != 0)
        status = file == 0 ? tn_cannot_read(path, errno, error)
                           : tn_shard_wrong(set, shard, error, "lacks its table of %s",
                                            tn_house_table_name((tn_house_table)file));
    else if (status == TN_OK)
        status = compare_size(set, shard, file, (uint64_t)known.st_size, record->files[file].bytes, error);
    free(path);
    return status;
}

tn_status tn_shard_done(const tn_shard_set *set, uint32_t shard, tn_error *error)
{
    tn_shard_record record;
    tn_status status = tn_shard_record_read(set, shard, &record, error);
    for (uint32_t i = 0; status == TN_OK && i < tn_shard_files(set); i++)
        status = file_done(set, shard, i, &record, error);
    return status;
}

static tn_status file_same(const tn_shard_set *set, uint32_t shard, uint32_t file, const tn_shard_record *record,
                           tn_error *error)
{
    const tn_shard_file *wanted = &record->files[file];
    tn_shard_file found;
    char where[40];
    char *path = tn_shard_file_path(set, shard, file);
    tn_status status = path ? tn_hash_file(path, found.hash, &found.bytes, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = compare_size(set, shard, file, found.bytes, wanted->bytes, error);
    if (status == TN_OK && strcmp(found.hash, wanted->hash) != 0)
        status = tn_shard_wrong(set, shard, error, "was changed after it was written: its hash is another%s",
                                in_table(set, file, where));
    free(path);
    return status;
}

tn_status tn_shard_same_as_record(const tn_shard_set *set, uint32_t shard, tn_error *error)
{
    tn_shard_record record;
    tn_status status = tn_shard_record_read(set, shard, &record, error);
    for (uint32_t i = 0; status == TN_OK && i < tn_shard_files(set); i++) {
        if (i > 0)
            status = file_done(set, shard, i, &record, error); /* says what is missing */
        if (status == TN_OK)
            status = file_same(set, shard, i, &record, error);
    }
    return status;
}

/* ---- hashes of the files of a shard of houses */

tn_status tn_shard_record_files(const tn_shard_set *set, uint32_t shard, tn_shard_record *record, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < tn_shard_files(set); i++) {
        char *path = tn_shard_file_path(set, shard, i);
        tn_shard_file *file = &record->files[i];
        status = path ? tn_hash_file(path, file->hash, &file->bytes, error) : tn_fail_memory(error);
        free(path);
    }
    return status;
}

/* ---- reading a shard through */

typedef struct through {
    const tn_shard_set *set;
    const tn_library *library;
    uint32_t shard;
    tn_watch *watch;
    uint64_t count;
    mpz_t *sampled; /* [sampled_count]: ranks of a sample that are in the shard; NULL: it has all */
    size_t sampled_count;
    tn_plan last;
} through;

static tn_status compare_rank(const through *t, const tn_plan *plan, const mpz_t wanted, const char *which,
                              tn_error *error)
{
    mpz_t rank;
    mpz_init(rank);
    bool found = tn_library_rank(t->library, plan->trays, plan->length, rank) && mpz_cmp(rank, wanted) == 0;
    mpz_clear(rank);
    return found ? TN_OK
                 : tn_shard_wrong(t->set, t->shard, error,
                                  "does not hold the plans of its ranks: its %s plan is another", which);
}

/* Each plan of a sample is looked at: no two follow one another. */
static tn_status compare_sampled(const through *t, const tn_plan *plan, tn_error *error)
{
    return t->count < t->sampled_count ? compare_rank(t, plan, t->sampled[t->count], "next", error) : TN_OK;
}

static bool keep_plan(const tn_plan *plan, tn_plan *kept)
{
    if (!tn_plan_reserve(kept, plan->length))
        return false;
    if (plan->length)
        memcpy(kept->trays, plan->trays, plan->length * sizeof *plan->trays);
    kept->length = plan->length;
    return true;
}

static tn_status read_plans(through *t, tn_plan_reader *reader, tn_error *error)
{
    for (;;) {
        const tn_plan *plan;
        tn_status status = tn_plan_reader_next(reader, &plan, error);
        if (status == TN_INVALID || status == TN_LIMIT)
            return tn_shard_wrong(t->set, t->shard, error, "has a plan that cannot be read, number %" PRIu64,
                                  t->count + 1);
        if (status != TN_OK || !plan)
            return status;
        if (t->sampled)
            status = compare_sampled(t, plan, error);
        else if (t->count == 0)
            status = compare_rank(t, plan, t->set->bounds[t->shard], "first", error);
        if (status == TN_OK && !keep_plan(plan, &t->last))
            status = tn_fail_memory(error);
        if (status == TN_OK && tn_watch_stopped_at(t->watch, (size_t)t->count))
            status = tn_fail_stopped(t->watch, error);
        if (status != TN_OK)
            return status;
        t->count++;
    }
}

/* The number of plans, and the last of them. */
static tn_status compare_end(const through *t, tn_error *error)
{
    mpz_t wanted;
    mpz_init(wanted);
    tn_shard_plans(t->set, t->shard, wanted);
    tn_status status = TN_OK;
    if (mpz_cmp_ui(wanted, t->count) != 0) {
        char *digits = mpz_get_str(NULL, 10, wanted);
        status = tn_shard_wrong(t->set, t->shard, error, "has %" PRIu64 " plans instead of %.60s", t->count,
                                digits ? digits : "?");
        free(digits);
    } else if (t->count > 0 && !t->sampled) {
        mpz_sub_ui(wanted, t->set->bounds[t->shard + 1], 1);
        status = compare_rank(t, &t->last, wanted, "last", error);
    }
    mpz_clear(wanted);
    return status;
}

static tn_status find_sampled(through *t, tn_error *error)
{
    if (t->set->task != TN_TASK_SAMPLE)
        return TN_OK;
    mpz_t all;
    mpz_init(all);
    tn_library_kept(t->library, TN_ALL_LENGTHS, all);
    tn_status status = tn_shard_sampled(t->set, all, t->shard, &t->sampled, &t->sampled_count, t->watch, error);
    mpz_clear(all);
    return status;
}

tn_status tn_shard_read_through(const tn_shard_set *set, const tn_ready_library *ready, uint32_t shard, tn_watch *watch,
                                tn_error *error)
{
    through t = {.set = set, .library = ready->library, .shard = shard, .watch = watch};
    const tn_reader_options options = tn_shard_reading(set, ready->library);
    tn_plan_reader *reader = NULL;
    char *path = tn_shard_path(set, shard, "");
    tn_status status = path ? find_sampled(&t, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_plan_reader_open(ready->schema, path, &options, &reader, error);
    if (status == TN_INVALID)
        status = tn_shard_wrong(set, shard, error, "does not begin as such a file does");
    if (status == TN_OK)
        status = read_plans(&t, reader, error);
    if (status == TN_OK)
        status = compare_end(&t, error);
    tn_plan_reader_free(reader);
    tn_integers_free(t.sampled, t.sampled_count);
    free(t.last.trays);
    free(path);
    return status;
}
