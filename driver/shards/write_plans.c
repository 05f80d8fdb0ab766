/* Writes a shard of enumerated plans. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "driver/plan/made.h"
#include "driver/shards/inputs.h"
#include "driver/shards/write.h"
#include "runtime/base/file.h"
#include "runtime/base/integers.h"

/* ---- writes a shard of answers */

typedef struct answers {
    const tn_shard_set *set;
    const tn_answering *answering;
    const tn_shard_writing_now *now;
    tn_shard_read *read;
    FILE *out;
    tn_status status; /* why it ended early */
    tn_error *error;
} answers;

static bool describe(const void *context, const tn_sifted *plan, tn_buffer texts[TN_RELAY_TEXTS])
{
    const answers *a = context;
    return a->answering->plan(a->answering->context, plan, texts);
}

static bool write_texts(void *context, uint64_t plans, const tn_buffer texts[TN_RELAY_TEXTS])
{
    (void)plans;
    answers *a = context;
    bool written = texts[0].size == 0 || fwrite(texts[0].data, 1, texts[0].size, a->out) == texts[0].size;
    tn_claim_touch(a->now->claim, a->now->stale);
    if (written)
        a->status = tn_watch_check(a->now->watch, a->error);
    return written && a->status == TN_OK;
}

/* The failure, with the file and the line in it. */
static void refuse_plan(answers *a, const tn_error *complaint)
{
    const tn_shard_input *input = &a->set->inputs.items[a->set->inputs.pieces[a->now->shard].input];
    uint64_t before;
    a->status = tn_shard_lines_before(a->set, a->answering->schema, a->now->shard, &before, a->error);
    if (a->status != TN_OK)
        return;
    a->status = tn_fail(a->error, complaint->status, complaint->code, "%.200s:%" PRIu64 ":%u: %.240s", input->path,
                        before + complaint->line, complaint->column, complaint->message);
    if (complaint->help[0])
        tn_error_help(a->error, "%s", complaint->help);
}

static bool complain(void *context, const tn_error *complaint, const char *text, size_t size)
{
    (void)text, (void)size;
    answers *a = context;
    if (!a->set->inputs.skips)
        refuse_plan(a, complaint);
    else if (a->read->unread++ < TN_COMPLAINTS_KEPT)
        a->read->complaints[a->read->unread - 1] = *complaint;
    return a->set->inputs.skips;
}

static tn_status sift_piece(answers *a, tn_plan_reader *reader, tn_error *error)
{
    const tn_sift_calls calls = {.context = a,
                                 .numbered = a->answering->numbered,
                                 .any = a->answering->any,
                                 .plan = describe,
                                 .write = write_texts,
                                 .bad = complain,
                                 .lines = &a->read->lines};
    tn_status status = tn_sift(reader, a->answering->rules, 1, &calls, error);
    return status == TN_OK ? a->status : status;
}

tn_status tn_shard_answer(const tn_shard_set *set, const tn_answering *answering, const tn_shard_writing_now *now,
                          tn_shard_read *read, tn_error *error)
{
    tn_plan_reader *reader = NULL;
    tn_output output = {0};
    char *path = tn_shard_path(set, now->shard, "");
    tn_status status =
        path ? tn_shard_input_open(set, answering->schema, now->shard, &reader, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_output_open_seen(path, now->written, &output, error);
    if (status == TN_OK) {
        answers a = {set, answering, now, read, output.stream, TN_OK, error};
        status = sift_piece(&a, reader, error);
        if (status == TN_OK)
            status = tn_output_commit(&output, error);
        else
            tn_output_discard(&output);
    }
    tn_plan_reader_free(reader);
    free(path);
    return status;
}

#define LOOK_EVERY 4096u /* plans between looks at the clock and for interruptions */

static char *words_of(const tn_shard_set *set, uint32_t shard)
{
    if (set->task == TN_TASK_SAMPLE)
        return strdup(set->command);
    char *from = mpz_get_str(NULL, 10, set->bounds[shard]), *to = mpz_get_str(NULL, 10, set->bounds[shard + 1]);
    const tn_enumerated asked = {.from = from,
                                 .to = to,
                                 .trays_given = set->options.override_trays,
                                 .trays_min = set->options.trays_min,
                                 .trays_max = set->options.trays_max};
    char *words = from && to ? tn_enumerated_words(&asked) : NULL;
    free(from);
    free(to);
    return words;
}

static tn_status write_sampled(const tn_shard_set *set, const tn_ready_library *ready, mpz_srcptr ranks,
                               const tn_shard_writing_now *now, tn_plan_writer *writer, tn_error *error)
{
    mpz_t *sampled;
    size_t count;
    tn_tray *trays = malloc(((size_t)tn_library_max(ready->library) + 1) * sizeof *trays);
    tn_status status = tn_shard_sampled(set, ranks, now->shard, &sampled, &count, now->watch, error);
    if (status == TN_OK && !trays)
        status = tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        uint32_t length;
        status = tn_library_unrank(ready->library, sampled[i], trays, &length)
                     ? tn_plan_writer_write(writer, sampled[i], trays, length, error)
                     : tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a sampled rank is not in the library");
        if (status == TN_OK && (i + 1) % LOOK_EVERY == 0) {
            tn_claim_touch(now->claim, now->stale);
            status = tn_watch_check(now->watch, error);
        }
    }
    tn_integers_free(sampled, count);
    free(trays);
    return status;
}

static tn_status write_plans(const tn_shard_set *set, const tn_ready_library *ready, const tn_shard_writing_now *now,
                             tn_plan_writer *writer, tn_error *error)
{
    uint32_t shard = now->shard;
    tn_cursor *cursor;
    const tn_tray *trays;
    uint32_t length;
    size_t seen = 0;
    tn_status status = tn_cursor_new(ready->library, set->bounds[shard], set->bounds[shard + 1], &cursor, error);
    if (status != TN_OK)
        return status;
    mpz_t rank;
    mpz_init_set(rank, set->bounds[shard]);
    while (status == TN_OK && tn_cursor_next(cursor, &trays, &length)) {
        status = tn_plan_writer_write(writer, rank, trays, length, error);
        mpz_add_ui(rank, rank, 1);
        if (status == TN_OK && ++seen % LOOK_EVERY == 0) {
            tn_claim_touch(now->claim, now->stale);
            status = tn_watch_check(now->watch, error);
        }
    }
    mpz_clear(rank);
    tn_cursor_free(cursor);
    return status;
}

tn_status tn_shard_enumerate(const tn_shard_set *set, const tn_ready_library *ready, const tn_plan_metadata *metadata,
                             mpz_srcptr ranks, const tn_shard_writing_now *now, tn_error *error)
{
    char *path = tn_shard_path(set, now->shard, ""), *words = words_of(set, now->shard);
    tn_plan_writer *writer = NULL;
    tn_writer_options options = tn_shard_writing(set, metadata, ranks);
    options.metadata.command = words;
    options.written = now->written;
    tn_status status =
        path && words ? tn_plan_writer_open(ready->schema, path, &options, &writer, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = set->task == TN_TASK_SAMPLE ? write_sampled(set, ready, ranks, now, writer, error)
                                             : write_plans(set, ready, now, writer, error);
    if (status == TN_OK)
        status = tn_plan_writer_close(writer, error);
    tn_plan_writer_free(writer);
    free(path);
    free(words);
    return status;
}
