/* Writes a shard of answers. */
#include <inttypes.h>
#include <stdlib.h>

#include "driver/shards/inputs.h"
#include "driver/shards/write.h"
#include "runtime/base/file.h"

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
