/* Divides files of plans, and opens pieces of them. */
#include "driver/shards/inputs.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "driver/open/missing.h"
#include "driver/parquet/parquet.h"
#include "driver/shards/record.h"
#include "driver/zstd/zstd.h"
#include "runtime/base/array.h"
#include "runtime/base/file.h"
#include "runtime/base/utf8.h"
#include "runtime/plan/store/sqlite.h"

/* ---- finding */

static tn_status refuse_input(const char *path, const char *what, const char *help, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_SHARD_INPUT, "%.300s %s", path, what);
    tn_error_help(error, "%s", help);
    return TN_INVALID;
}

static tn_status find_input(const char *path, tn_shard_input *input, tn_error *error)
{
    struct stat known;
    if (strcmp(path, "-") == 0)
        return refuse_input("standard input", "is no regular file",
                            "write it to a file first: workers read it in pieces", error);
    if (stat(path, &known) != 0) {
        tn_cannot_read(path, errno, error);
        tn_suggest_file(path, error);
        return TN_IO;
    }
    if (!S_ISREG(known.st_mode))
        return refuse_input(path, "is no regular file", "write it to a file first: workers read it in pieces", error);
    input->path = realpath(path, NULL);
    if (!input->path)
        return tn_cannot_read(path, errno, error);
    if (!tn_is_utf8(input->path, strlen(input->path)))
        return refuse_input(path, "has a name that is not UTF-8 text, and a manifest holds only that",
                            "rename the file", error);
    input->size = (uint64_t)known.st_size;
    input->seconds = known.st_mtim.tv_sec;
    input->nanoseconds = known.st_mtim.tv_nsec;
    return TN_OK;
}

static tn_status too_many(uint64_t shards, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_SHARD_TOO_MANY, "%" PRIu64 " shards are more than a set may have, which is %u", shards,
            TN_SHARDS_MAX);
    tn_error_help(error, "ask for fewer with --shards, or make several sets");
    return TN_LIMIT;
}

tn_status tn_shard_inputs_find(tn_shard_set *set, const char *const *paths, size_t count, tn_error *error)
{
    tn_shard_inputs *inputs = &set->inputs;
    if (count > TN_SHARDS_MAX)
        return too_many(count, error);
    inputs->items = calloc(count, sizeof *inputs->items);
    if (!inputs->items)
        return tn_fail_memory(error);
    inputs->count = (uint32_t)count;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = find_input(paths[i], &inputs->items[i], error);
    return status;
}

/* ---- dividing */

typedef struct dividing {
    tn_shard_set *set;
    uint64_t shards, bytes; /* asked for; of all files */
    size_t room;
} dividing;

static tn_status add_piece(dividing *d, const tn_shard_piece *piece, tn_error *error)
{
    tn_shard_set *set = d->set;
    if (set->count == TN_SHARDS_MAX)
        return too_many((uint64_t)set->count + 1, error);
    if (!tn_array_reserve(&set->inputs.pieces, &d->room, set->count, 1, sizeof *set->inputs.pieces))
        return tn_fail_memory(error);
    set->inputs.pieces[set->count++] = *piece;
    return TN_OK;
}

/* As many pieces as the file has of all bytes, rounded. */
static uint64_t pieces_of(const dividing *d, const tn_shard_input *input)
{
    uint64_t pieces = d->bytes ? (uint64_t)((double)input->size / (double)d->bytes * (double)d->shards + 0.5) : 1;
    return pieces ? pieces : 1;
}

/* Cuts the file; pieces that a long line leaves empty are none. */
static tn_status cut_file(dividing *d, uint32_t input, tn_plan_reader *reader, tn_plan_part rest, tn_error *error)
{
    uint64_t pieces = pieces_of(d, &d->set->inputs.items[input]), begin = rest.begin;
    uint64_t each = (rest.end - rest.begin) / pieces, more = (rest.end - rest.begin) % pieces;
    tn_status status = TN_OK;
    for (uint64_t i = 1; status == TN_OK && i <= pieces; i++) {
        uint64_t cut = rest.end, near = begin + each * i + (i < more ? i : more);
        if (i < pieces)
            status = tn_plan_reader_cut(reader, &rest, near, &cut, error);
        const tn_shard_piece piece = {.input = input, .part = {rest.begin, cut}};
        bool last = i == pieces && (rest.begin == begin || cut > rest.begin);
        if (status == TN_OK && (last || (i < pieces && cut > rest.begin)))
            status = add_piece(d, &piece, error);
        rest.begin = cut;
    }
    return status;
}

static tn_reader_options reading(const tn_shard_set *set, tn_plan_format format)
{
    return (tn_reader_options){.format = format,
                               .max_length = set->options.max_length,
                               .sqlite = tn_plan_sqlite(),
                               .parquet = tn_plan_parquet_calls(),
                               .compression = tn_plan_zstd()};
}

static tn_status divide_file(dividing *d, uint32_t input, const tn_schema *schema, tn_plan_format format,
                             tn_error *error)
{
    tn_shard_input *file = &d->set->inputs.items[input];
    const tn_reader_options options = reading(d->set, format);
    const tn_shard_piece whole = {.input = input, .whole = true};
    tn_plan_reader *reader;
    tn_plan_part part;
    tn_status status = tn_plan_reader_open(schema, file->path, &options, &reader, error);
    if (status != TN_OK)
        return status;
    file->format = tn_plan_reader_format(reader);
    status =
        tn_plan_reader_whole(reader, &part) ? cut_file(d, input, reader, part, error) : add_piece(d, &whole, error);
    if (status == TN_OK)
        status = tn_plan_reader_unchanged(reader, error);
    tn_plan_reader_free(reader);
    return status;
}

tn_status tn_shard_inputs_divide(tn_shard_set *set, const tn_schema *schema, tn_plan_format format, uint64_t shards,
                                 tn_error *error)
{
    dividing d = {.set = set, .shards = shards};
    if (shards > TN_SHARDS_MAX)
        return too_many(shards, error);
    for (uint32_t i = 0; i < set->inputs.count; i++)
        d.bytes += set->inputs.items[i].size;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < set->inputs.count; i++)
        status = divide_file(&d, i, schema, format, error);
    return status;
}

/* ---- opening */

static bool is_unchanged(const tn_shard_input *input)
{
    struct stat known;
    return stat(input->path, &known) == 0 && (uint64_t)known.st_size == input->size &&
           known.st_mtim.tv_sec == input->seconds && known.st_mtim.tv_nsec == input->nanoseconds;
}

static const char put_back[] = "put the file back, with its time, or make a new set by `tartan shards new`";

static tn_status refuse_changed(const tn_shard_set *set, const tn_shard_input *input, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_SHARD_INPUT_CHANGED, "%.300s is not as it was when %.100s was made", input->path,
            set->folder);
    tn_error_help(error, "%s", put_back);
    return TN_INVALID;
}

/* The file as it is, all of it. */
static tn_status open_file(const tn_shard_set *set, const tn_schema *schema, const tn_shard_input *input,
                           tn_plan_reader **reader, tn_error *error)
{
    const tn_reader_options options = reading(set, input->format);
    tn_status status = tn_plan_reader_open(schema, input->path, &options, reader, error);
    if (status != TN_IO && !is_unchanged(input))
        status = refuse_changed(set, input, error);
    else if (status == TN_IO && !tn_path_exists(input->path))
        tn_error_help(error, "%s", put_back);
    return status;
}

tn_status tn_shard_input_open(const tn_shard_set *set, const tn_schema *schema, uint32_t shard, tn_plan_reader **reader,
                              tn_error *error)
{
    const tn_shard_piece *piece = &set->inputs.pieces[shard];
    const tn_shard_input *input = &set->inputs.items[piece->input];
    tn_plan_part whole;
    *reader = NULL;
    tn_status status = open_file(set, schema, input, reader, error);
    if (status == TN_OK && !piece->whole) {
        bool divides = tn_plan_reader_whole(*reader, &whole);
        bool within = divides && piece->part.begin >= whole.begin && piece->part.end <= whole.end;
        status = within ? tn_plan_reader_restrict(*reader, &piece->part, error) : refuse_changed(set, input, error);
    }
    if (status != TN_OK) {
        tn_plan_reader_free(*reader);
        *reader = NULL;
    }
    return status;
}

/* ---- lines */

static tn_status count_lines(const tn_shard_set *set, const tn_schema *schema, uint32_t shard, uint64_t *lines,
                             tn_error *error)
{
    tn_shard_record record;
    tn_plan_reader *reader;
    if (tn_shard_recorded(set, shard) && tn_shard_record_read(set, shard, &record, NULL) == TN_OK) {
        *lines = record.lines;
        return TN_OK;
    }
    tn_status status = tn_shard_input_open(set, schema, shard, &reader, error);
    if (status == TN_OK)
        status = tn_plan_reader_count(reader, &set->inputs.pieces[shard].part, lines, error);
    tn_plan_reader_free(reader);
    return status;
}

tn_status tn_shard_lines_before(const tn_shard_set *set, const tn_schema *schema, uint32_t shard, uint64_t *lines,
                                tn_error *error)
{
    const tn_shard_piece *pieces = set->inputs.pieces;
    tn_status status = TN_OK;
    uint64_t own;
    *lines = 0;
    for (uint32_t i = shard; status == TN_OK && i > 0 && pieces[i - 1].input == pieces[shard].input; i--) {
        status = count_lines(set, schema, i - 1, &own, error);
        *lines += status == TN_OK ? own : 0;
    }
    return status;
}
