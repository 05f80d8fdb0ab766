/* Makes shard sets, and names what is in them. */
#include "driver/shards/set.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "driver/open/missing.h"
#include "driver/parquet/parquet.h"
#include "driver/shards/hash.h"
#include "driver/zstd/zstd.h"
#include "runtime/base/file.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/library/sample.h"
#include "runtime/plan/text/pack.h"

/* ---- samples */

static tn_draws draws_of(const tn_shard_set *set, mpz_srcptr all)
{
    return (tn_draws){.seed = set->sample.seed,
                      .stream = TN_ALL_LENGTHS,
                      .bound = all,
                      .wanted = set->sample.plans,
                      .attempts = set->sample.attempts};
}

tn_status tn_shard_set_sample(tn_shard_set *set, const mpz_t all, uint64_t plans, uint64_t seed, size_t memory,
                              tn_watch *watch, tn_error *error)
{
    set->task = TN_TASK_SAMPLE;
    set->sample.seed = seed;
    set->sample.plans = mpz_cmp_ui(all, plans) < 0 ? mpz_get_ui(all) : plans;
    set->sample.of = calloc((size_t)set->count + 1, sizeof *set->sample.of);
    tn_draws draws = draws_of(set, all);
    tn_status status = set->sample.of ? tn_draws_count(&draws, (const mpz_t *)set->bounds, set->count, set->sample.of,
                                                       memory, watch, error)
                                      : tn_fail_memory(error);
    set->sample.attempts = draws.attempts;
    return status;
}

tn_status tn_shard_sampled(const tn_shard_set *set, const mpz_t all, uint32_t shard, mpz_t **ranks, size_t *count,
                           tn_watch *watch, tn_error *error)
{
    const tn_draws draws = draws_of(set, all);
    return tn_draws_between(&draws, set->bounds[shard], set->bounds[shard + 1], ranks, count, watch, error);
}

static void clear_inputs(tn_shard_inputs *inputs)
{
    for (uint32_t i = 0; inputs->items && i < inputs->count; i++)
        free(inputs->items[i].path);
    for (uint32_t i = 0; inputs->rules && i < inputs->rule_count; i++)
        free(inputs->rules[i]);
    free(inputs->items);
    free(inputs->pieces);
    free(inputs->rules);
}

void tn_shard_set_clear(tn_shard_set *set)
{
    clear_inputs(&set->inputs);
    for (size_t i = 0; set->bounds && i <= set->count; i++)
        mpz_clear(set->bounds[i]);
    free(set->bounds);
    free(set->sample.of);
    free(set->folder);
    free(set->version);
    free(set->library);
    free(set->rules_path);
    free(set->command);
    *set = (tn_shard_set){0};
}

/* ---- names */

static const char *ending_of(const tn_shard_set *set)
{
    static const char *const answers[TN_ANSWER_FORMAT_COUNT] = {[TN_ANSWER_NAMES] = ".names",
                                                                [TN_ANSWER_JSON] = ".jsonl",
                                                                [TN_ANSWER_BITS] = ".bits",
                                                                [TN_ANSWER_ANY] = ".any",
                                                                [TN_ANSWER_LINES] = ".plans"};
    static const char *const endings[TN_FORMAT_COUNT] = {[TN_FORMAT_LINES] = ".plans",
                                                         [TN_FORMAT_JSON] = ".jsonl",
                                                         [TN_FORMAT_CSV] = ".csv",
                                                         [TN_FORMAT_BIN] = ".bin",
                                                         [TN_FORMAT_PARQUET] = ".parquet"};
    return tn_shard_set_answers(set) ? answers[set->inputs.answer] : endings[set->format];
}

tn_shard_name tn_shard_file_name(const tn_shard_set *set, uint32_t shard, uint32_t file)
{
    tn_shard_name name;
    bool tables = tn_shard_set_houses(set);
    snprintf(name.text, sizeof name.text, "shards/%03u/%06u%s%s%s%s", shard / TN_SHARDS_A_FOLDER, shard,
             tables ? "." : "", tables ? tn_house_table_name((tn_house_table)file) : "", ending_of(set),
             set->compressed ? ".zst" : "");
    return name;
}

tn_shard_name tn_shard_name_of(const tn_shard_set *set, uint32_t shard)
{
    return tn_shard_file_name(set, shard, 0);
}

char *tn_shard_set_path(const tn_shard_set *set, const char *name)
{
    return tn_path_join(set->folder, name, "");
}

char *tn_shard_path(const tn_shard_set *set, uint32_t shard, const char *ending)
{
    return tn_path_join(set->folder, tn_shard_name_of(set, shard).text, ending);
}

char *tn_shard_file_path(const tn_shard_set *set, uint32_t shard, uint32_t file)
{
    return tn_path_join(set->folder, tn_shard_file_name(set, shard, file).text, "");
}

char *tn_shard_stem(const tn_shard_set *set, uint32_t shard)
{
    char name[40];
    snprintf(name, sizeof name, "shards/%03u/%06u%s", shard / TN_SHARDS_A_FOLDER, shard, ending_of(set));
    return tn_path_join(set->folder, name, "");
}

tn_reader_options tn_shard_reading(const tn_shard_set *set, const tn_library *library)
{
    return (tn_reader_options){.format = set->format,
                               .max_length = tn_library_max(library),
                               .parquet = tn_plan_parquet_calls(),
                               .compression = set->compressed ? tn_plan_zstd() : NULL};
}

tn_writer_options tn_shard_writing(const tn_shard_set *set, const tn_plan_metadata *metadata, mpz_srcptr ranks)
{
    return (tn_writer_options){.format = set->format,
                               .metadata = *metadata,
                               .row_group = set->row_group,
                               .plan_lines = set->plan_lines,
                               .ranks = ranks,
                               .parquet = tn_plan_parquet_calls(),
                               .compression = set->compressed ? tn_plan_zstd() : NULL};
}

void tn_shard_plans(const tn_shard_set *set, uint32_t shard, mpz_t plans)
{
    if (set->task == TN_TASK_SAMPLE)
        mpz_set_ui(plans, set->sample.of[shard]);
    else
        mpz_sub(plans, set->bounds[shard + 1], set->bounds[shard]);
}

void tn_shard_set_plans(const tn_shard_set *set, mpz_t plans)
{
    if (set->task == TN_TASK_SAMPLE)
        mpz_set_ui(plans, set->sample.plans);
    else
        mpz_sub(plans, set->bounds[set->count], set->bounds[0]);
}

/* ---- dividing */

static tn_status too_many(const mpz_t plans, tn_error *error)
{
    mpz_t least;
    mpz_init(least);
    mpz_cdiv_q_ui(least, plans, TN_SHARDS_MAX);
    char *digits = mpz_get_str(NULL, 10, least);
    tn_fail(error, TN_LIMIT, E_SHARD_TOO_MANY, "more shards than a set may have, which is %u", TN_SHARDS_MAX);
    tn_error_help(error, "make shards of at least %.200s plan%s: --plans %.60s", digits ? digits : "?",
                  mpz_cmp_ui(least, 1) == 0 ? "" : "s", digits ? digits : "?");
    free(digits);
    mpz_clear(least);
    return TN_LIMIT;
}

/* How many shards there are to be; false: too many. */
static bool count_shards(const mpz_t all, uint64_t shards, uint64_t plans, uint32_t *count)
{
    mpz_t number;
    mpz_init_set_ui(number, shards);
    if (shards == 0)
        mpz_cdiv_q_ui(number, all, plans);
    else if (mpz_cmp(number, all) > 0)
        mpz_set(number, all);
    if (mpz_sgn(number) == 0)
        mpz_set_ui(number, 1); /* an empty one */
    bool fits = mpz_cmp_ui(number, TN_SHARDS_MAX) <= 0 && shards <= TN_SHARDS_MAX;
    *count = (uint32_t)mpz_get_ui(number);
    mpz_clear(number);
    return fits;
}

/* bound := where shard i begins. */
static void find_bound(const mpz_t from, const mpz_t all, uint32_t count, uint64_t plans, uint32_t i, mpz_t bound)
{
    if (plans > 0) {
        mpz_set_ui(bound, plans);
        mpz_mul_ui(bound, bound, i);
        if (mpz_cmp(bound, all) > 0)
            mpz_set(bound, all);
    } else {
        mpz_mul_ui(bound, all, i);
        mpz_fdiv_q_ui(bound, bound, count);
    }
    mpz_add(bound, bound, from);
}

tn_status tn_shard_set_divide(tn_shard_set *set, const mpz_t from, const mpz_t to, uint64_t shards, uint64_t plans,
                              tn_error *error)
{
    mpz_t all;
    mpz_init(all);
    mpz_sub(all, to, from);
    tn_status status = TN_OK;
    if (!count_shards(all, shards, plans, &set->count))
        status = too_many(all, error);
    else if (!(set->bounds = calloc((size_t)set->count + 1, sizeof *set->bounds)))
        status = tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i <= set->count; i++) {
        mpz_init(set->bounds[i]);
        find_bound(from, all, set->count, shards > 0 ? 0 : plans, i, set->bounds[i]);
    }
    mpz_clear(all);
    return status;
}

/* ---- is it of this library? */

static const char another_copy[] = "get another copy of the set, or make a new one by `tartan shards new`";

static tn_status refuse_module(const tn_shard_set *set, const char *what, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_SHARD_MODULE, "%.200s/%s", set->folder, what);
    tn_error_help(error, "%s", another_copy);
    return TN_INVALID;
}

tn_status tn_shard_set_module_same(const tn_shard_set *set, tn_error *error)
{
    char hash[33];
    uint64_t size;
    char *path = tn_shard_set_path(set, TN_MODULE_NAME);
    tn_status status = path ? tn_hash_file(path, hash, &size, error) : tn_fail_memory(error);
    if (status == TN_IO && path && !tn_path_exists(path))
        tn_error_help(error, "%s", another_copy);
    free(path);
    if (status != TN_OK || strcmp(hash, set->module_hash) == 0)
        return status;
    return refuse_module(set, TN_MODULE_NAME " is not the module that the set was made with", error);
}

/* Do the shards lie within the library? A manifest whose hash is right can still be wrong. */
static bool within(const tn_shard_set *set, const tn_library *library)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    bool fits = mpz_cmp(set->bounds[set->count], kept) <= 0;
    mpz_clear(kept);
    return fits;
}

tn_status tn_shard_set_agrees(const tn_shard_set *set, const tn_schema *schema, const tn_library *library,
                              tn_error *error)
{
    char library_hash[33] = "", schema_hash[17];
    if (library)
        tn_library_hash(library, library_hash);
    snprintf(schema_hash, sizeof schema_hash, "%016" PRIx64, tn_pack_schema_hash(schema));
    if (strcmp(set->version, TARTAN_VERSION) != 0) {
        tn_fail(error, TN_INVALID, E_SHARD_VERSION, "Tartan %.60s made %.200s, and this is Tartan " TARTAN_VERSION,
                set->version, set->folder);
        tn_error_help(error, "use that version on every machine: shards of two versions may differ");
        return TN_INVALID;
    }
    if (strcmp(library_hash, set->library_hash) != 0 || strcmp(schema_hash, set->schema_hash) != 0)
        return refuse_module(set, TN_MANIFEST_NAME " is about another library than the module has", error);
    if (library && !tn_shard_set_houses(set) &&
        !within(set, library)) /* ranks of houses are seen when they are written */
        return refuse_module(set, TN_MANIFEST_NAME " has ranks that the library does not", error);
    return TN_OK;
}
