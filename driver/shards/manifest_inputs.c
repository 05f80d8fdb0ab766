/* What a manifest says of a set of answers: how plans are answered about, and the files that they are in. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "driver/shards/manifest_read.h"

static const char *const answers[TN_ANSWER_FORMAT_COUNT] = {
    [TN_ANSWER_NAMES] = "names",
    [TN_ANSWER_JSON] = "json",
    [TN_ANSWER_BITS] = "bits",
    [TN_ANSWER_ANY] = "any",
    [TN_ANSWER_LINES] = "lines"};

/* ---- writing */

static void write_input(const tn_shard_input *input, tn_json *json)
{
    tn_json_object(json, NULL);
    tn_json_string(json, "path", input->path);
    tn_json_count(json, "size", input->size);
    tn_json_list(json, "changed");
    tn_json_whole(json, NULL, input->seconds);
    tn_json_whole(json, NULL, input->nanoseconds);
    tn_json_list_end(json);
    tn_json_string(json, "format", tn_manifest_formats()[input->format]);
    tn_json_object_end(json);
}

void tn_manifest_write_inputs(const tn_shard_set *set, tn_json *json)
{
    const tn_shard_inputs *inputs = &set->inputs;
    const tn_json_layout layout = json->layout;
    tn_json_string(json, "answer", answers[inputs->answer]);
    if (inputs->skips)
        tn_json_string(json, "on_error", "skip");
    if (inputs->rule_count > 0) {
        tn_json_list(json, "rules");
        for (uint32_t i = 0; i < inputs->rule_count; i++)
            tn_json_string(json, NULL, inputs->rules[i]);
        tn_json_list_end(json);
    }
    json->layout.lines = 2;
    tn_json_list(json, "inputs");
    for (uint32_t i = 0; i < inputs->count; i++)
        write_input(&inputs->items[i], json);
    tn_json_list_end(json);
    json->layout = layout;
}

void tn_manifest_write_piece(const tn_shard_piece *piece, tn_json *json)
{
    tn_json_count(json, "input", piece->input);
    if (piece->whole)
        return;
    tn_json_count(json, "from", piece->part.begin);
    tn_json_count(json, "to", piece->part.end);
}

/* ---- reading */

static bool read_whole(const json_t *value, int64_t least, int64_t *number)
{
    *number = json_integer_value(value);
    return json_is_integer(value) && *number >= least;
}

static tn_status read_rules(const tn_manifest_reading *r)
{
    const json_t *rules = json_object_get(r->manifest, "rules");
    tn_shard_inputs *inputs = &r->set->inputs;
    size_t count = json_array_size(rules);
    if (!rules)
        return TN_OK;
    if (count == 0 || count > UINT32_MAX || r->set->task != TN_TASK_MATCH)
        return tn_manifest_refuse(r, "`rules` is no list of rules to match");
    inputs->rules = calloc(count, sizeof *inputs->rules);
    if (!inputs->rules)
        return tn_fail_memory(r->error);
    inputs->rule_count = (uint32_t)count;
    for (size_t i = 0; i < count; i++) {
        const char *name = json_string_value(json_array_get(rules, i));
        if (!name)
            return tn_manifest_refuse(r, "`rules` is no list of rules to match");
        inputs->rules[i] = strdup(name);
        if (!inputs->rules[i])
            return tn_fail_memory(r->error);
    }
    return TN_OK;
}

static tn_status read_input(const tn_manifest_reading *r, uint32_t i, const json_t *said)
{
    tn_shard_input *input = &r->set->inputs.items[i];
    const char *path = json_string_value(json_object_get(said, "path"));
    const char *format = json_string_value(json_object_get(said, "format"));
    const json_t *changed = json_object_get(said, "changed");
    int64_t size;
    if (!path || path[0] != '/')
        return tn_manifest_refuse(r, "input %u has no `path` from the root", i);
    if (!read_whole(json_object_get(said, "size"), 0, &size) || json_array_size(changed) != 2 ||
        !read_whole(json_array_get(changed, 0), INT64_MIN, &input->seconds) ||
        !read_whole(json_array_get(changed, 1), 0, &input->nanoseconds))
        return tn_manifest_refuse(r, "input %u has no `size`, or no time when it was `changed`", i);
    input->size = (uint64_t)size;
    for (int f = 0; format && f < TN_FORMAT_COUNT; f++)
        if (tn_manifest_formats()[f] && strcmp(tn_manifest_formats()[f], format) == 0)
            input->format = (tn_plan_format)f;
    if (input->format == TN_FORMAT_AUTO)
        return tn_manifest_refuse(r, "input %u has no `format`", i);
    input->path = strdup(path);
    return input->path ? TN_OK : tn_fail_memory(r->error);
}

static tn_status read_files(const tn_manifest_reading *r)
{
    const json_t *said = json_object_get(r->manifest, "inputs");
    tn_shard_inputs *inputs = &r->set->inputs;
    size_t count = json_array_size(said);
    if (count == 0)
        return tn_manifest_refuse(r, "it has no list `inputs`");
    if (count > TN_SHARDS_MAX)
        return tn_manifest_refuse(r, "it has %zu inputs, and %u is the most", count, TN_SHARDS_MAX);
    inputs->items = calloc(count, sizeof *inputs->items);
    if (!inputs->items)
        return tn_fail_memory(r->error);
    inputs->count = (uint32_t)count;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < inputs->count; i++)
        status = read_input(r, i, json_array_get(said, i));
    return status;
}

tn_status tn_manifest_read_inputs(const tn_manifest_reading *r)
{
    int answer;
    const json_t *on_error = json_object_get(r->manifest, "on_error");
    tn_shard_inputs *inputs = &r->set->inputs;
    tn_status status = tn_manifest_word(r, "answer", answers, TN_ANSWER_FORMAT_COUNT, &answer);
    if (status != TN_OK)
        return status;
    bool plans = r->set->task == TN_TASK_PRUNE;
    if (answer != TN_ANSWER_JSON && (answer == TN_ANSWER_LINES) != plans)
        return tn_manifest_refuse(r, "`answer` is none of those of the task");
    inputs->answer = (tn_answer_format)answer;
    inputs->skips = on_error && json_is_string(on_error) && strcmp(json_string_value(on_error), "skip") == 0;
    if (on_error && !inputs->skips)
        return tn_manifest_refuse(r, "`on_error` is not skip");
    status = read_rules(r);
    return status == TN_OK ? read_files(r) : status;
}

/* Does the piece follow the one before it in the same file, or begin the next file? */
static bool follows(const tn_shard_inputs *inputs, uint32_t i, const tn_shard_piece *piece)
{
    if (i == 0)
        return piece->input == 0;
    const tn_shard_piece *before = &inputs->pieces[i - 1];
    if (piece->input != before->input)
        return piece->input == before->input + 1;
    return !piece->whole && !before->whole && piece->part.begin == before->part.end;
}

tn_status tn_manifest_read_piece(const tn_manifest_reading *r, uint32_t i, const json_t *shard)
{
    tn_shard_inputs *inputs = &r->set->inputs;
    tn_shard_piece *piece = &inputs->pieces[i];
    int64_t input, from = 0, to = 0;
    piece->whole = !json_object_get(shard, "from") && !json_object_get(shard, "to");
    if (!read_whole(json_object_get(shard, "input"), 0, &input) || input >= inputs->count)
        return tn_manifest_refuse(r, "shard %u has no `input`", i);
    if (!piece->whole &&
        (!read_whole(json_object_get(shard, "from"), 0, &from) ||
         !read_whole(json_object_get(shard, "to"), from, &to) || (uint64_t)to > inputs->items[input].size))
        return tn_manifest_refuse(r, "shard %u has no part `from` and `to` of its input", i);
    piece->input = (uint32_t)input;
    piece->part = (tn_plan_part){(uint64_t)from, (uint64_t)to};
    bool last = i + 1 == r->set->count;
    if (!follows(inputs, i, piece) || (last && piece->input + 1 != inputs->count))
        return tn_manifest_refuse(r, "shard %u does not follow the one before it, or leaves something out", i);
    return TN_OK;
}
