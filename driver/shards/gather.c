/* Looks a shard set over, and writes the plans of all its shards into one file. */
#include "driver/shards/gather.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/plan/answering.h"
#include "driver/plan/provenance.h"
#include "driver/shards/record.h"
#include "runtime/base/file.h"
#include "runtime/plan/store/sqlite.h"

/* ---- looks a shard set over */

/* Of answers a record says what was read for them, too. */
static tn_status check_answers(const tn_shard_set *set, uint32_t shard, tn_error *error)
{
    tn_shard_read *read = calloc(1, sizeof *read);
    tn_status status = read ? tn_shard_read_of(set, shard, read, error) : tn_fail_memory(error);
    free(read);
    return status;
}

tn_status tn_shard_check(const tn_shard_set *set, const tn_ready_library *ready, uint32_t shard, tn_watch *watch,
                         tn_error *error)
{
    bool recorded = tn_shard_recorded(set, shard), answers = tn_shard_set_answers(set);
    tn_status status = recorded ? tn_shard_same_as_record(set, shard, error) : TN_OK;
    if (tn_shard_set_houses(set))
        return status;
    if (status == TN_OK && !answers)
        return tn_shard_read_through(set, ready, shard, watch, error);
    return status == TN_OK && recorded ? check_answers(set, shard, error) : status;
}

tn_status tn_shards_complete(const tn_shard_set *set, tn_error *error)
{
    uint32_t missing = 0, first = 0;
    for (uint32_t i = set->count; i-- > 0;) {
        if (!tn_shard_recorded(set, i)) {
            missing++;
            first = i;
        }
    }
    if (missing == 0)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_SHARD_MISSING,
            "%u of the %u shards of %.200s %s not there, or without a record; the first is %s", missing, set->count,
            set->folder, missing == 1 ? "is" : "are", tn_shard_name_of(set, first).text);
    tn_error_help(error, "write what is missing: tartan shards run %.200s", set->folder);
    return TN_INVALID;
}

/* ---- strangers */

/* The first file of a shard has the record and the claim beside it. */
static bool is_file_of(const char *wanted, uint32_t file, const char *name)
{
    size_t size = strlen(wanted);
    if (strncmp(name, wanted, size) != 0)
        return false;
    const char *ending = name + size;
    return !*ending || (file == 0 && (strcmp(ending, TN_SHARD_RECORD) == 0 ||
                                      strncmp(ending, TN_SHARD_CLAIM, strlen(TN_SHARD_CLAIM)) == 0));
}

/* Is it a shard of this folder, its record or its claim? What begins with a point is being written. */
static bool is_known(const tn_shard_set *set, uint32_t folder, const char *name)
{
    char *end;
    if (name[0] == '.')
        return true;
    unsigned long long shard = strtoull(name, &end, 10);
    if (end != name + 6 || shard >= set->count || shard / TN_SHARDS_A_FOLDER != folder)
        return false;
    for (uint32_t i = 0; i < tn_shard_files(set); i++) {
        const tn_shard_name whole = tn_shard_file_name(set, (uint32_t)shard, i);
        if (is_file_of(strrchr(whole.text, '/') + 1, i, name))
            return true;
    }
    return false;
}

static tn_status refuse_stranger(const tn_shard_set *set, const char *folder, const char *name, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_SHARD_STRANGER, "%.200s/%.80s is no shard of this set", folder, name);
    tn_error_help(error, "move it out of %.200s: what reads all files there takes it for a shard", set->folder);
    return TN_INVALID;
}

static tn_status look_at_folder(const tn_shard_set *set, uint32_t folder, const char *path, tn_error *error)
{
    DIR *open = opendir(path);
    tn_status status = TN_OK;
    if (!open)
        return tn_cannot_read(path, errno, error);
    for (struct dirent *entry; status == TN_OK && (entry = readdir(open));)
        if (!is_known(set, folder, entry->d_name))
            status = refuse_stranger(set, path, entry->d_name, error);
    closedir(open);
    return status;
}

tn_status tn_shards_no_strangers(const tn_shard_set *set, tn_error *error)
{
    tn_status status = TN_OK;
    char name[20];
    for (uint32_t folder = 0; status == TN_OK && folder * TN_SHARDS_A_FOLDER < set->count; folder++) {
        snprintf(name, sizeof name, "shards/%03u", folder);
        char *path = tn_shard_set_path(set, name);
        status = path ? look_at_folder(set, folder, path, error) : tn_fail_memory(error);
        free(path);
    }
    return status;
}

/* ---- writes the answers of all shards into one file */

/* The number of lines of the file before those of a shard: what its own are counted from. */
static tn_status lines_before(const tn_gathering *g, uint32_t shard, uint64_t *lines, tn_error *error)
{
    const tn_shard_piece *pieces = g->set->inputs.pieces;
    tn_shard_record record;
    if (shard == 0 || pieces[shard - 1].input != pieces[shard].input) {
        *lines = 0;
        return TN_OK;
    }
    tn_status status = tn_shard_record_read(g->set, shard - 1, &record, error);
    *lines += status == TN_OK ? record.lines : 0;
    return status;
}

/* Copies answers in JSON, whose lines are counted on from those of the shards before. */
static tn_status copy_numbered(const tn_gathering *g, uint32_t shard, uint64_t before, FILE *in, FILE *out,
                               tn_error *error)
{
    static const char begin[] = TN_MATCHED_LINE;
    char *line = NULL, *rest;
    size_t room = 0, seen = 0;
    tn_status status = TN_OK;
    for (ssize_t size; status == TN_OK && (size = getline(&line, &room, in)) > 0;) {
        unsigned long long number = 0;
        bool known = strncmp(line, begin, sizeof begin - 1) == 0;
        if (known)
            number = strtoull(line + sizeof begin - 1, &rest, 10);
        if (!known || *rest != ',')
            status = tn_shard_wrong(g->set, shard, error, "does not hold answers of `tartan match`");
        else if (fprintf(out, "%s%llu", begin, number + before) > 0)
            fwrite(rest, 1, (size_t)size - (size_t)(rest - line), out);
        if (status == TN_OK && tn_watch_stopped_at(g->watch, ++seen))
            status = tn_fail_stopped(g->watch, error);
    }
    free(line);
    return status;
}

static tn_status copy_answers(const tn_gathering *g, uint32_t shard, uint64_t before, FILE *out, tn_error *error)
{
    bool numbered = g->set->task == TN_TASK_MATCH && g->set->inputs.answer == TN_ANSWER_JSON && before > 0;
    char bytes[1 << 16];
    char *path = tn_shard_path(g->set, shard, "");
    FILE *in = path ? tn_file_stream(path) : NULL;
    tn_status status = in ? TN_OK : path ? tn_cannot_read(path, errno, error) : tn_fail_memory(error);
    if (in && numbered)
        status = copy_numbered(g, shard, before, in, out, error);
    for (size_t got; in && !numbered && (got = fread(bytes, 1, sizeof bytes, in)) > 0;)
        fwrite(bytes, 1, got, out);
    if (status == TN_OK && ferror(in))
        status = tn_cannot_read(path, errno, error);
    if (in)
        fclose(in);
    free(path);
    return status;
}

/* The same of a set of answers that is complete. */
static tn_status shards_gather_answers(const tn_gathering *g, tn_error *error)
{
    tn_output output;
    uint64_t before = 0;
    tn_status status = tn_output_open(g->output, &output, error);
    if (status != TN_OK)
        return status;
    for (uint32_t i = 0; status == TN_OK && i < g->set->count; i++) {
        status = tn_watch_check(g->watch, error);
        if (status == TN_OK)
            status = tn_shard_same_as_record(g->set, i, error);
        if (status == TN_OK)
            status = lines_before(g, i, &before, error);
        if (status == TN_OK)
            status = copy_answers(g, i, before, output.stream, error);
        tn_watch_tell(g->watch, i + 1, g->set->count);
    }
    if (status == TN_OK)
        return tn_output_commit(&output, error);
    tn_output_discard(&output);
    return status;
}

/* The rank of a plan that is in the library. */
static tn_status rank_of(const tn_gathering *g, uint32_t shard, const tn_plan *plan, mpz_t rank, tn_error *error)
{
    return tn_library_rank(g->ready->library, plan->trays, plan->length, rank)
               ? TN_OK
               : tn_shard_wrong(g->set, shard, error, "has a plan that the library does not have");
}

/* Reads a shard's plans and writes them, with their ranks. */
static tn_status rewrite_shard(const tn_gathering *g, const char *path, uint32_t shard, tn_plan_writer *writer,
                               tn_error *error)
{
    const tn_reader_options options = tn_shard_reading(g->set, g->ready->library);
    tn_plan_reader *reader;
    const tn_plan *plan;
    size_t seen = 0;
    bool sampled = g->set->task == TN_TASK_SAMPLE;
    mpz_t rank, plans;
    tn_status status = tn_plan_reader_open(g->ready->schema, path, &options, &reader, error);
    if (status != TN_OK)
        return status;
    mpz_init_set(rank, g->set->bounds[shard]);
    mpz_init(plans);
    while (status == TN_OK && (status = tn_plan_reader_next(reader, &plan, error)) == TN_OK && plan) {
        if (sampled)
            status = rank_of(g, shard, plan, rank, error);
        if (status == TN_OK)
            status = tn_plan_writer_write(writer, rank, plan->trays, plan->length, error);
        mpz_add_ui(rank, rank, 1);
        if (status == TN_OK && tn_watch_stopped_at(g->watch, ++seen))
            status = tn_fail_stopped(g->watch, error);
    }
    tn_shard_plans(g->set, shard, plans);
    bool whole = mpz_cmp_ui(plans, seen) == 0;
    mpz_clears(rank, plans, NULL);
    tn_plan_reader_free(reader);
    return status == TN_OK && !whole ? tn_shard_wrong(g->set, shard, error, "does not have the plans of its ranks")
                                     : status;
}

/* Files of most formats can be put behind one another. */
static bool is_copied(const tn_gathering *g)
{
    return g->format == g->set->format && !g->set->compressed && g->format != TN_FORMAT_PARQUET;
}

static tn_status gather_shard(const tn_gathering *g, uint32_t shard, tn_plan_writer *writer, tn_error *error)
{
    char *path = tn_shard_path(g->set, shard, "");
    tn_status status = path ? tn_watch_check(g->watch, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_shard_same_as_record(g->set, shard, error);
    if (status == TN_OK)
        status =
            is_copied(g) ? tn_plan_writer_append(writer, path, error) : rewrite_shard(g, path, shard, writer, error);
    tn_watch_tell(g->watch, shard + 1, g->set->count);
    free(path);
    return status;
}

static tn_status gather_plans(const tn_gathering *g, tn_error *error)
{
    tn_provenance provenance;
    tn_plan_writer *writer = NULL;
    tn_provenance_describe(g->opened, g->ready, g->set->rules_path, g->set->command, &provenance);
    mpz_t ranks;
    mpz_init(ranks);
    tn_library_kept(g->ready->library, TN_ALL_LENGTHS, ranks);
    tn_writer_options options = tn_shard_writing(g->set, &provenance.metadata, ranks);
    options.format = g->format;
    options.compression = NULL;
    options.sqlite = tn_plan_sqlite();
    tn_status status = tn_plan_writer_open(g->ready->schema, g->output, &options, &writer, error);
    for (uint32_t i = 0; status == TN_OK && i < g->set->count; i++)
        status = gather_shard(g, i, writer, error);
    if (status == TN_OK)
        status = tn_plan_writer_close(writer, error);
    tn_plan_writer_free(writer);
    mpz_clear(ranks);
    return status;
}

tn_status tn_shards_gather(const tn_gathering *g, tn_error *error)
{
    tn_status status = tn_shards_complete(g->set, error);
    for (uint32_t i = 0; status == TN_OK && i < g->set->count; i++) /* before anything is written */
        status = tn_shard_done(g->set, i, error);
    if (status != TN_OK)
        return status;
    return tn_shard_set_answers(g->set) ? shards_gather_answers(g, error) : gather_plans(g, error);
}
