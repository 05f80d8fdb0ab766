/* Shard sets: a stretch of a library's ranks, divided into files that any number of workers write, on any machines.
 *
 * A set is a folder. `manifest.json` says what the shards are and never changes; `rules.tnb` is the module that every
 * worker runs; `shards/000/000000.plans` and so on are the shards, in the order of their ranks. Nothing else is shared,
 * and what a shard holds depends on the manifest and the module alone. Beside a shard lies its record (record.h), and
 * while a worker writes it, its claim (run.h).
 *
 * A shard of houses is three files, a table each (driver/house/tables.h); what is said of a shard's file is then about
 * that of houses, and its record also tells of the others.
 *
 * The shards of other sets are not plans of a library, but what `tartan match` or `tartan prune` says of the plans of
 * large files (inputs.h).
 *
 * A tn_shard_set owns everything reached through it, and is constant once it was read or created: threads may share it.
 */
#ifndef TARTAN_DRIVER_SHARDS_SET_H
#define TARTAN_DRIVER_SHARDS_SET_H

#include "driver/house/tables.h"
#include "driver/plan/answering.h"
#include "driver/plan/library.h"
#include "runtime/plan/text/stream.h"

#define TN_SHARDS_MAX 100000u
#define TN_SHARDS_SAMPLE_MAX UINT64_C(10000000000)
#define TN_SHARDS_A_FOLDER 1000u /* with records and claims, 3,000 files: few enough for any file system */

#define TN_SHARD_RECORD ".record"
#define TN_SHARD_CLAIM ".claim"

/* Files of a set. */
#define TN_MANIFEST_NAME "manifest.json"
#define TN_MODULE_NAME "rules.tnb"

/* What the shards hold. */
typedef enum tn_shard_task {
    TN_TASK_ENUMERATE, /* the plans of a stretch of ranks */
    TN_TASK_MATCH,     /* which rules match the plans of a piece of a file */
    TN_TASK_PRUNE,     /* which of them a library keeps */
    TN_TASK_SAMPLE,    /* the plans of a sample that are in a stretch of ranks */
    TN_TASK_HOUSES,    /* the houses of a stretch of ranks, as tables */
    TN_TASK_COUNT
} tn_shard_task;

/* A file whose plans are answered about, as it was when the set was made. */
typedef struct tn_shard_input {
    char *path; /* from the root of the file system */
    uint64_t size;
    int64_t seconds, nanoseconds; /* when it was changed */
    tn_plan_format format;
} tn_shard_input;

typedef struct tn_shard_piece {
    uint32_t input;
    bool whole; /* the file cannot be divided, and `part` is empty */
    tn_plan_part part;
} tn_shard_piece;

/* What a set of answers is about. */
typedef struct tn_shard_inputs {
    tn_shard_input *items;
    uint32_t count;
    tn_shard_piece *pieces; /* [shards], in the order of the files and within them */
    tn_answer_format answer;
    char **rules; /* match: those asked for; none: all of the file's own */
    uint32_t rule_count;
    bool skips; /* plans that cannot be read */
} tn_shard_inputs;

/* A sample: the plans that `tartan sample` draws. */
typedef struct tn_shard_sample {
    uint64_t plans, seed;
    uint64_t attempts; /* of drawing: see tn_draws */
    uint64_t *of;      /* [shards]: plans of each */
} tn_shard_sample;

typedef struct tn_shard_set {
    tn_shard_task task;
    char *folder;
    char hash[33];                                           /* of its manifest: sets with the same one are copies */
    char *version;                                           /* of the Tartan that made it */
    char *library;                                           /* its name in the module; NULL where rules are matched */
    char *rules_path;                                        /* as it was named when the set was made */
    char *command;                                           /* the one command whose output these are */
    char module_hash[33], library_hash[33], schema_hash[17]; /* library_hash: only of enumerated plans */
    tn_plan_format format;                                   /* of enumerated plans */
    bool compressed;                                         /* by zstd */
    uint32_t row_group;                                      /* Parquet: plans of a row group, or 0 */
    bool plan_lines;                                         /* Parquet: also a column of plan lines */
    tn_library_options options; /* those that decide which plans there are, and the limits */
    uint32_t count;
    mpz_t *bounds; /* [count + 1]: shard i has the ranks from bounds[i] on, before bounds[i + 1]; NULL: answers */
    tn_shard_inputs inputs; /* of answers */
    tn_shard_sample sample; /* of TN_TASK_SAMPLE */
} tn_shard_set;

/* Divides the ranks [from, to) among `shards` shards, as equal as can be, but none empty where another is not; or
 * (shards 0) among shards of `plans` plans. Fills count and bounds. TN_LIMIT (E1705) where they are too many. */
tn_status tn_shard_set_divide(tn_shard_set *set, const mpz_t from, const mpz_t to, uint64_t shards, uint64_t plans,
                              tn_error *error);
void tn_shard_set_clear(tn_shard_set *set);

/* Is the module that which the set was made with? TN_INVALID (E1704). Asked before it is opened. */
tn_status tn_shard_set_module_same(const tn_shard_set *set, tn_error *error);

/* Does what was opened (the library; NULL for answers) hold what the manifest says, and would this program write the
 * same bytes? TN_INVALID (E1703, E1704). */
tn_status tn_shard_set_agrees(const tn_shard_set *set, const tn_schema *schema, const tn_library *library,
                              tn_error *error);

/* Are the shards answers about the plans of files? */
static inline bool tn_shard_set_answers(const tn_shard_set *set)
{
    return set->task == TN_TASK_MATCH || set->task == TN_TASK_PRUNE;
}

/* Are they tables of houses? */
static inline bool tn_shard_set_houses(const tn_shard_set *set)
{
    return set->task == TN_TASK_HOUSES;
}

/* How many files a shard is. */
static inline uint32_t tn_shard_files(const tn_shard_set *set)
{
    return tn_shard_set_houses(set) ? TN_HOUSE_TABLES : 1;
}

/* "FOLDER/NAME", and the path of a shard with an ending behind it ("": none). The caller frees them; NULL where out of
 * memory. */
char *tn_shard_set_path(const tn_shard_set *set, const char *name);
char *tn_shard_path(const tn_shard_set *set, uint32_t shard, const char *ending);

/* A shard's name in the folder: "shards/000/000000.plans". */
typedef struct tn_shard_name {
    char text[40];
} tn_shard_name;
tn_shard_name tn_shard_name_of(const tn_shard_set *set, uint32_t shard);

/* The name and the path of one of its files (tn_house_table). */
tn_shard_name tn_shard_file_name(const tn_shard_set *set, uint32_t shard, uint32_t file);
char *tn_shard_file_path(const tn_shard_set *set, uint32_t shard, uint32_t file);

/* What the paths of a shard of houses begin with: "FOLDER/shards/000/000000.csv", of which tables have their names
 * before the ending. */
char *tn_shard_stem(const tn_shard_set *set, uint32_t shard);

/* How to open its shards. */
tn_reader_options tn_shard_reading(const tn_shard_set *set, const tn_library *library);

/* How to write one. `ranks`: how many the library has, borrowed. */
tn_writer_options tn_shard_writing(const tn_shard_set *set, const tn_plan_metadata *metadata, mpz_srcptr ranks);

/* How many plans (or houses) a shard holds, and all do. `plans` is initialised. */
void tn_shard_plans(const tn_shard_set *set, uint32_t shard, mpz_t plans);
void tn_shard_set_plans(const tn_shard_set *set, mpz_t plans);

/* Makes a divided set one of a sample: so many plans of all `all` that its bounds are of, drawn by the seed. memory:
 * see tn_draws_count. TN_MEMORY, TN_STOPPED. */
tn_status tn_shard_set_sample(tn_shard_set *set, const mpz_t all, uint64_t plans, uint64_t seed, size_t memory,
                              tn_watch *watch, tn_error *error);

/* The ranks of a sample that are in a shard, ascending; free them by tn_integers_free. all: plans of the library. */
tn_status tn_shard_sampled(const tn_shard_set *set, const mpz_t all, uint32_t shard, mpz_t **ranks, size_t *count,
                           tn_watch *watch, tn_error *error);

#endif
