/* Writes the answers of all shards into one file. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "driver/plan/matched.h"
#include "driver/shards/gather.h"
#include "driver/shards/record.h"
#include "runtime/base/file.h"
#include "runtime/base/file_error.h"

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

tn_status tn_shards_gather_answers(const tn_gathering *g, tn_error *error)
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
