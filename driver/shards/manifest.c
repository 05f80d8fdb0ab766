/* Writes and reads the manifest of a shard set, and the folder of a set by it. */
#include "driver/shards/manifest.h"

#include <inttypes.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "driver/open/missing.h"
#include "driver/shards/hash.h"
#include "driver/shards/set.h"
#include "runtime/base/file.h"

typedef struct reading {
    tn_shard_set *set;
    json_t *manifest;
    tn_error *error;
} reading;

/* How formats are called, as by --format. */
static const char *const formats[TN_FORMAT_COUNT] = {
    [TN_FORMAT_LINES] = "lines", [TN_FORMAT_JSON] = "json",     [TN_FORMAT_CSV] = "csv",
    [TN_FORMAT_BIN] = "bin",     [TN_FORMAT_SQLITE] = "sqlite", [TN_FORMAT_PARQUET] = "parquet"};

static tn_status refuse(const reading *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
static tn_status word(const reading *r, const char *key, const char *const *words, int count, int *number);

/* ---- sets of answers */

static const char *const answers[TN_ANSWER_FORMAT_COUNT] = {[TN_ANSWER_NAMES] = "names",
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
    tn_json_string(json, "format", formats[input->format]);
    tn_json_object_end(json);
}

static void manifest_write_inputs(const tn_shard_set *set, tn_json *json)
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

static void manifest_write_piece(const tn_shard_piece *piece, tn_json *json)
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

static tn_status read_rules(const reading *r)
{
    const json_t *rules = json_object_get(r->manifest, "rules");
    tn_shard_inputs *inputs = &r->set->inputs;
    size_t count = json_array_size(rules);
    if (!rules)
        return TN_OK;
    if (count == 0 || count > UINT32_MAX || r->set->task != TN_TASK_MATCH)
        return refuse(r, "`rules` is no list of rules to match");
    inputs->rules = calloc(count, sizeof *inputs->rules);
    if (!inputs->rules)
        return tn_fail_memory(r->error);
    inputs->rule_count = (uint32_t)count;
    for (size_t i = 0; i < count; i++) {
        const char *name = json_string_value(json_array_get(rules, i));
        if (!name)
            return refuse(r, "`rules` is no list of rules to match");
        inputs->rules[i] = strdup(name);
        if (!inputs->rules[i])
            return tn_fail_memory(r->error);
    }
    return TN_OK;
}

static tn_status read_input(const reading *r, uint32_t i, const json_t *said)
{
    tn_shard_input *input = &r->set->inputs.items[i];
    const char *path = json_string_value(json_object_get(said, "path"));
    const char *format = json_string_value(json_object_get(said, "format"));
    const json_t *changed = json_object_get(said, "changed");
    int64_t size;
    if (!path || path[0] != '/')
        return refuse(r, "input %u has no `path` from the root", i);
    if (!read_whole(json_object_get(said, "size"), 0, &size) || json_array_size(changed) != 2 ||
        !read_whole(json_array_get(changed, 0), INT64_MIN, &input->seconds) ||
        !read_whole(json_array_get(changed, 1), 0, &input->nanoseconds))
        return refuse(r, "input %u has no `size`, or no time when it was `changed`", i);
    input->size = (uint64_t)size;
    for (int f = 0; format && f < TN_FORMAT_COUNT; f++)
        if (formats[f] && strcmp(formats[f], format) == 0)
            input->format = (tn_plan_format)f;
    if (input->format == TN_FORMAT_AUTO)
        return refuse(r, "input %u has no `format`", i);
    input->path = strdup(path);
    return input->path ? TN_OK : tn_fail_memory(r->error);
}

static tn_status read_files(const reading *r)
{
    const json_t *said = json_object_get(r->manifest, "inputs");
    tn_shard_inputs *inputs = &r->set->inputs;
    size_t count = json_array_size(said);
    if (count == 0)
        return refuse(r, "it has no list `inputs`");
    if (count > TN_SHARDS_MAX)
        return refuse(r, "it has %zu inputs, and %u is the most", count, TN_SHARDS_MAX);
    inputs->items = calloc(count, sizeof *inputs->items);
    if (!inputs->items)
        return tn_fail_memory(r->error);
    inputs->count = (uint32_t)count;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < inputs->count; i++)
        status = read_input(r, i, json_array_get(said, i));
    return status;
}

/* What a set of answers is about: all but its shards; and shard i, which is said in `shard`. (manifest_inputs.c) */
static tn_status read_inputs(const reading *r)
{
    int answer;
    const json_t *on_error = json_object_get(r->manifest, "on_error");
    tn_shard_inputs *inputs = &r->set->inputs;
    tn_status status = word(r, "answer", answers, TN_ANSWER_FORMAT_COUNT, &answer);
    if (status != TN_OK)
        return status;
    bool plans = r->set->task == TN_TASK_PRUNE;
    if (answer != TN_ANSWER_JSON && (answer == TN_ANSWER_LINES) != plans)
        return refuse(r, "`answer` is none of those of the task");
    inputs->answer = (tn_answer_format)answer;
    inputs->skips = on_error && json_is_string(on_error) && strcmp(json_string_value(on_error), "skip") == 0;
    if (on_error && !inputs->skips)
        return refuse(r, "`on_error` is not skip");
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

static tn_status read_piece(const reading *r, uint32_t i, const json_t *shard)
{
    tn_shard_inputs *inputs = &r->set->inputs;
    tn_shard_piece *piece = &inputs->pieces[i];
    int64_t input, from = 0, to = 0;
    piece->whole = !json_object_get(shard, "from") && !json_object_get(shard, "to");
    if (!read_whole(json_object_get(shard, "input"), 0, &input) || input >= inputs->count)
        return refuse(r, "shard %u has no `input`", i);
    if (!piece->whole &&
        (!read_whole(json_object_get(shard, "from"), 0, &from) ||
         !read_whole(json_object_get(shard, "to"), from, &to) || (uint64_t)to > inputs->items[input].size))
        return refuse(r, "shard %u has no part `from` and `to` of its input", i);
    piece->input = (uint32_t)input;
    piece->part = (tn_plan_part){(uint64_t)from, (uint64_t)to};
    bool last = i + 1 == r->set->count;
    if (!follows(inputs, i, piece) || (last && piece->input + 1 != inputs->count))
        return refuse(r, "shard %u does not follow the one before it, or leaves something out", i);
    return TN_OK;
}

static const char *const tasks[TN_TASK_COUNT] = {[TN_TASK_ENUMERATE] = "enumerate",
                                                 [TN_TASK_SAMPLE] = "sample",
                                                 [TN_TASK_HOUSES] = "houses",
                                                 [TN_TASK_MATCH] = "match",
                                                 [TN_TASK_PRUNE] = "prune"};

#define HASH_BEGIN "  \"hash\": \""
#define HASH_END "\"\n}\n"

/* ---- writing */

/* Left out where it is 0. */
static void write_number(tn_json *json, const char *key, uint64_t value)
{
    if (value != 0)
        tn_json_count(json, key, value);
}

static void write_shard(const tn_shard_set *set, uint32_t i, tn_json *json)
{
    tn_json_object(json, NULL);
    tn_json_string(json, "name", tn_shard_name_of(set, i).text);
    if (tn_shard_set_answers(set)) {
        manifest_write_piece(&set->inputs.pieces[i], json);
    } else {
        tn_json_digits(json, "from", set->bounds[i]);
        tn_json_digits(json, "to", set->bounds[i + 1]);
    }
    if (set->task == TN_TASK_SAMPLE)
        tn_json_count(json, "plans", set->sample.of[i]);
    tn_json_object_end(json);
}

bool tn_manifest_seal(tn_buffer *text, char hash[33])
{
    tn_hash_bytes(text->data, text->size, hash);
    return tn_buffer_printf(text, HASH_BEGIN "%s" HASH_END, hash);
}

static void write_sample(const tn_shard_set *set, tn_json *json)
{
    char seed[24]; /* of 64 bits, so a text: readers of JSON round them */
    snprintf(seed, sizeof seed, "%" PRIu64, set->sample.seed);
    tn_json_object(json, "sample");
    tn_json_count(json, "plans", set->sample.plans);
    tn_json_string(json, "seed", seed);
    tn_json_count(json, "attempts", set->sample.attempts);
    tn_json_object_end(json);
}

/* What the plans of a library are written as. */
static void write_plans(const tn_shard_set *set, tn_json *json)
{
    tn_json_string(json, "library_hash", set->library_hash);
    tn_json_string(json, "format", formats[set->format]);
    if (set->compressed)
        tn_json_string(json, "compress", "zstd");
    if (set->plan_lines)
        tn_json_string(json, "columns", "plan");
    if (set->task == TN_TASK_SAMPLE)
        write_sample(set, json);
    write_number(json, "row_group", set->row_group);
}

static void write_trays(const tn_shard_set *set, tn_json *json)
{
    tn_json_list(json, "trays");
    tn_json_count(json, NULL, set->options.trays_min);
    tn_json_count(json, NULL, set->options.trays_max);
    tn_json_list_end(json);
}

/* A member a line, and of the lists of shards and inputs an item a line; the hash ends the object. */
bool tn_manifest_write(const tn_shard_set *set, tn_buffer *text, char hash[33])
{
    tn_json json = tn_json_text(text, TN_JSON_LINES);
    json.layout.lines = 1;
    tn_json_object(&json, NULL);
    tn_json_whole(&json, "tartan_shards", TN_MANIFEST_VERSION);
    tn_json_string(&json, "version", set->version);
    tn_json_string(&json, "module", TN_MODULE_NAME);
    tn_json_string(&json, "module_hash", set->module_hash);
    if (set->task != TN_TASK_ENUMERATE)
        tn_json_string(&json, "task", tasks[set->task]);
    if (set->library)
        tn_json_string(&json, "library", set->library);
    tn_json_string(&json, "schema_hash", set->schema_hash);
    tn_json_string(&json, "rules_path", set->rules_path);
    tn_json_string(&json, "command", set->command);
    if (tn_shard_set_answers(set))
        manifest_write_inputs(set, &json);
    else
        write_plans(set, &json);
    if (set->options.override_trays)
        write_trays(set, &json);
    write_number(&json, "max_states", set->options.max_states);
    write_number(&json, "max_length", set->options.max_length);
    json.layout.lines = 2;
    tn_json_list(&json, "shards");
    for (uint32_t i = 0; i < set->count; i++)
        write_shard(set, i, &json);
    tn_json_list_end(&json);
    return !text->failed && tn_buffer_printf(text, ",\n") && tn_manifest_seal(text, hash);
}

/* ---- reading */

/* E1702 with what is wrong. Returns TN_INVALID. */
static tn_status refuse(const reading *r, const char *format, ...)
{
    char text[300];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    tn_fail(r->error, TN_INVALID, E_SHARD_MANIFEST, "%.140s/" TN_MANIFEST_NAME ": %s", r->set->folder, text);
    tn_error_help(r->error, "get another copy of it, or make a new set by `tartan shards new`");
    return TN_INVALID;
}

static tn_status read_text(const reading *r, const char *key, char **text)
{
    const char *value = json_string_value(json_object_get(r->manifest, key));
    if (!value)
        return refuse(r, "it has no text `%s`", key);
    *text = strdup(value);
    return *text ? TN_OK : tn_fail_memory(r->error);
}

static tn_status read_hash(const reading *r, const char *key, char *hash, size_t digits)
{
    const char *value = json_string_value(json_object_get(r->manifest, key));
    if (!value || strlen(value) != digits || strspn(value, "0123456789abcdef") != digits)
        return refuse(r, "`%s` is no hash of %zu digits", key, digits);
    memcpy(hash, value, digits + 1);
    return TN_OK;
}

static tn_status read_version(const reading *r)
{
    const json_t *version = json_object_get(r->manifest, "tartan_shards");
    if (!json_is_integer(version))
        return refuse(r, "it is not the manifest of a shard set");
    if (json_integer_value(version) == TN_MANIFEST_VERSION)
        return TN_OK;
    tn_fail(r->error, TN_INVALID, E_SHARD_VERSION,
            "%.200s/" TN_MANIFEST_NAME " is of version %" JSON_INTEGER_FORMAT ", and only version %d is known",
            r->set->folder, json_integer_value(version), TN_MANIFEST_VERSION);
    tn_error_help(r->error, "use the Tartan that made the set");
    return TN_INVALID;
}

/* The last `needle` of the text; NULL where there is none. */
static const char *find_last(const char *text, size_t size, const char *needle)
{
    size_t length = strlen(needle);
    for (size_t at = size >= length ? size - length + 1 : 0; at-- > 0;)
        if (memcmp(text + at, needle, length) == 0)
            return text + at;
    return NULL;
}

static tn_status check_seal(const reading *r, const char *text, size_t size)
{
    char wanted[80];
    const char *seal = find_last(text, size, HASH_BEGIN);
    if (seal) {
        tn_hash_bytes(text, (size_t)(seal - text), r->set->hash);
        int length = snprintf(wanted, sizeof wanted, HASH_BEGIN "%s" HASH_END, r->set->hash);
        if ((size_t)length == size - (size_t)(seal - text) && memcmp(seal, wanted, (size_t)length) == 0)
            return TN_OK;
    }
    return refuse(r, "it was changed after it was made: its hash does not fit what it holds");
}

/* The number of one of these words, which are what `key` can be; NULL words are none. */
static tn_status word(const reading *r, const char *key, const char *const *words, int count, int *number)
{
    const char *word = json_string_value(json_object_get(r->manifest, key));
    for (*number = 0; word && *number < count; ++*number)
        if (words[*number] && strcmp(words[*number], word) == 0)
            return TN_OK;
    return refuse(r, "`%s` is none that is known", key);
}

static tn_status read_format(const reading *r)
{
    int format;
    tn_status status = word(r, "format", formats, TN_FORMAT_COUNT, &format);
    if (status != TN_OK)
        return status;
    r->set->format = (tn_plan_format)format;
    if (tn_shard_set_houses(r->set) && format != TN_FORMAT_CSV && format != TN_FORMAT_PARQUET)
        return refuse(r, "`format` is none of csv and parquet, which tables of houses are");
    return format != TN_FORMAT_SQLITE ? TN_OK : refuse(r, "`format` is none of lines, json, csv, bin and parquet");
}

static tn_status read_compression(const reading *r)
{
    const json_t *how = json_object_get(r->manifest, "compress");
    r->set->compressed = how && json_is_string(how) && strcmp(json_string_value(how), "zstd") == 0;
    if (how && tn_shard_set_houses(r->set))
        return refuse(r, "tables of houses are not compressed");
    return !how || r->set->compressed ? TN_OK : refuse(r, "`compress` is not zstd");
}

/* What is asked for of Parquet. */
static tn_status read_columns(const reading *r)
{
    const json_t *columns = json_object_get(r->manifest, "columns");
    r->set->plan_lines = columns && json_is_string(columns) && strcmp(json_string_value(columns), "plan") == 0;
    return !columns || r->set->plan_lines ? TN_OK : refuse(r, "`columns` is not plan");
}

/* A whole number of 32 bits; absent: `otherwise`. */
static tn_status read_number(const reading *r, const json_t *value, const char *key, uint32_t *number)
{
    json_int_t read = json_integer_value(value);
    if (value && (!json_is_integer(value) || read < 0 || read > UINT32_MAX - 1))
        return refuse(r, "`%s` is not a number that it can be", key);
    *number = (uint32_t)read;
    return TN_OK;
}

static tn_status read_options(const reading *r)
{
    tn_library_options *options = &r->set->options;
    const json_t *trays = json_object_get(r->manifest, "trays");
    tn_status status = read_number(r, json_object_get(r->manifest, "max_states"), "max_states", &options->max_states);
    if (status == TN_OK)
        status = read_number(r, json_object_get(r->manifest, "max_length"), "max_length", &options->max_length);
    if (status == TN_OK)
        status = read_number(r, json_object_get(r->manifest, "row_group"), "row_group", &r->set->row_group);
    if (status != TN_OK || !trays)
        return status;
    if (json_array_size(trays) != 2)
        return refuse(r, "`trays` is not two numbers");
    options->override_trays = true;
    status = read_number(r, json_array_get(trays, 0), "trays", &options->trays_min);
    return status == TN_OK ? read_number(r, json_array_get(trays, 1), "trays", &options->trays_max) : status;
}

static bool read_rank(const json_t *shard, const char *key, mpz_t rank)
{
    const char *digits = json_string_value(json_object_get(shard, key));
    return digits && *digits && strspn(digits, "0123456789") == strlen(digits) && mpz_set_str(rank, digits, 10) == 0;
}

static tn_status read_count(const reading *r, const json_t *object, const char *key, uint64_t *count)
{
    const json_t *value = json_object_get(object, key);
    if (!json_is_integer(value) || json_integer_value(value) < 0)
        return refuse(r, "`%s` is no number of plans or draws", key);
    *count = (uint64_t)json_integer_value(value);
    return TN_OK;
}

/* How many plans of the sample are in the shard. */
static tn_status read_share(const reading *r, uint32_t i, const json_t *shard)
{
    mpz_t ranks;
    tn_status status = read_count(r, shard, "plans", &r->set->sample.of[i]);
    mpz_init(ranks);
    mpz_sub(ranks, r->set->bounds[i + 1], r->set->bounds[i]);
    if (status == TN_OK && mpz_cmp_ui(ranks, r->set->sample.of[i]) < 0)
        status = refuse(r, "shard %u has more plans than ranks", i);
    mpz_clear(ranks);
    return status;
}

/* `attempts` are at most what drawing so many numbers takes, so that no manifest keeps a worker busy for ever. */
static tn_status read_sample(const reading *r)
{
    tn_shard_sample *sample = &r->set->sample;
    const json_t *json = json_object_get(r->manifest, "sample");
    const char *seed = json_string_value(json_object_get(json, "seed"));
    char *end = NULL;
    tn_status status = read_count(r, json, "plans", &sample->plans);
    if (status == TN_OK)
        status = read_count(r, json, "attempts", &sample->attempts);
    if (status != TN_OK)
        return status;
    sample->seed = seed ? strtoull(seed, &end, 10) : 0;
    if (!seed || *seed < '0' || *seed > '9' || *end)
        return refuse(r, "`seed` is no number");
    return sample->plans <= TN_SHARDS_SAMPLE_MAX && sample->attempts <= 8 * sample->plans + 100000
               ? TN_OK
               : refuse(r, "its sample is too large");
}

/* The shares of the shards are those of the whole. */
static tn_status add_shares(const reading *r)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < r->set->count; i++)
        sum += r->set->sample.of[i];
    return sum == r->set->sample.plans ? TN_OK : refuse(r, "its shards do not have all plans of the sample");
}

static tn_status read_ranks(const reading *r, uint32_t i, const json_t *shard, mpz_t from)
{
    tn_shard_set *set = r->set;
    if (!read_rank(shard, "from", from) || !read_rank(shard, "to", set->bounds[i + 1]))
        return refuse(r, "shard %u has no ranks `from` and `to`", i);
    if (i == 0)
        mpz_set(set->bounds[0], from);
    int order = mpz_cmp(from, set->bounds[i]);
    if (order != 0)
        return refuse(r, order < 0 ? "shards %u and %u overlap" : "there are ranks between shards %u and %u", i - 1, i);
    if (mpz_cmp(set->bounds[i + 1], from) < 0)
        return refuse(r, "shard %u ends before it begins", i);
    return set->task == TN_TASK_SAMPLE ? read_share(r, i, shard) : TN_OK;
}

static tn_status read_shard(const reading *r, uint32_t i, const json_t *shard, mpz_t from)
{
    const char *name = json_string_value(json_object_get(shard, "name"));
    tn_shard_name wanted = tn_shard_name_of(r->set, i);
    if (!name || strcmp(name, wanted.text) != 0)
        return refuse(r, "shard %u is not called `%s`", i, wanted.text);
    return tn_shard_set_answers(r->set) ? read_piece(r, i, shard) : read_ranks(r, i, shard, from);
}

/* Room for what is said of each shard. */
static tn_status make_room(tn_shard_set *set, size_t count, tn_error *error)
{
    if (tn_shard_set_answers(set))
        set->inputs.pieces = calloc(count, sizeof *set->inputs.pieces);
    else
        set->bounds = calloc(count + 1, sizeof *set->bounds);
    if (set->task == TN_TASK_SAMPLE)
        set->sample.of = calloc(count + 1, sizeof *set->sample.of);
    if ((!set->bounds && !set->inputs.pieces) || (set->task == TN_TASK_SAMPLE && !set->sample.of))
        return tn_fail_memory(error);
    set->count = (uint32_t)count;
    for (size_t i = 0; set->bounds && i <= count; i++)
        mpz_init(set->bounds[i]);
    return TN_OK;
}

static tn_status read_shards(const reading *r)
{
    tn_shard_set *set = r->set;
    const json_t *shards = json_object_get(r->manifest, "shards");
    size_t count = json_array_size(shards);
    if (count == 0)
        return refuse(r, "it has no list `shards`");
    if (count > TN_SHARDS_MAX)
        return tn_fail(r->error, TN_LIMIT, E_SHARD_TOO_MANY, "%.200s has %zu shards, and %u is the most", set->folder,
                       count, TN_SHARDS_MAX);
    tn_status status = make_room(set, count, r->error);
    mpz_t from;
    mpz_init(from);
    for (uint32_t i = 0; status == TN_OK && i < set->count; i++)
        status = read_shard(r, i, json_array_get(shards, i), from);
    mpz_clear(from);
    return status == TN_OK && set->task == TN_TASK_SAMPLE ? add_shares(r) : status;
}

static tn_status read_texts(const reading *r)
{
    tn_shard_set *set = r->set;
    const struct {
        const char *key;
        char **text;
    } texts[] = {{"version", &set->version},
                 {"rules_path", &set->rules_path},
                 {"command", &set->command},
                 {"library", &set->library}};
    size_t count = sizeof texts / sizeof *texts - (set->task == TN_TASK_MATCH);
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = read_text(r, texts[i].key, texts[i].text);
    if (status == TN_OK)
        status = read_hash(r, "module_hash", set->module_hash, 32);
    return status == TN_OK ? read_hash(r, "schema_hash", set->schema_hash, 16) : status;
}

/* What the plans of a library are written as. */
static tn_status read_plans(const reading *r)
{
    tn_status status = read_hash(r, "library_hash", r->set->library_hash, 32);
    if (status == TN_OK)
        status = read_format(r);
    if (status == TN_OK)
        status = read_compression(r);
    if (status == TN_OK)
        status = read_columns(r);
    return status == TN_OK && r->set->task == TN_TASK_SAMPLE ? read_sample(r) : status;
}

static tn_status read_members(const reading *r)
{
    int task = TN_TASK_ENUMERATE; /* where it is not said */
    tn_status status = TN_OK;
    if (json_object_get(r->manifest, "task"))
        status = word(r, "task", tasks, TN_TASK_COUNT, &task);
    if (status != TN_OK)
        return status;
    r->set->task = (tn_shard_task)task;
    status = read_texts(r);
    if (status == TN_OK)
        status = tn_shard_set_answers(r->set) ? read_inputs(r) : read_plans(r);
    if (status == TN_OK)
        status = read_options(r);
    return status == TN_OK ? read_shards(r) : status;
}

tn_status tn_manifest_read(const char *text, size_t size, tn_shard_set *set, tn_error *error)
{
    json_error_t wrong;
    reading r = {set, json_loadb(text, size, JSON_REJECT_DUPLICATES, &wrong), error};
    if (!r.manifest)
        return refuse(&r, "line %d: %s", wrong.line, wrong.text);
    tn_status status = read_version(&r);
    if (status == TN_OK)
        status = check_seal(&r, text, size);
    if (status == TN_OK)
        status = read_members(&r);
    json_decref(r.manifest);
    return status;
}

/* ---- the folder of a set */

#define MANIFEST_BYTES ((size_t)256 << 20) /* the most: 100,000 shards with ranks of a thousand digits */

static tn_status write_file(const tn_shard_set *set, const char *name, const void *bytes, size_t size, tn_error *error)
{
    tn_output output;
    char *path = tn_shard_set_path(set, name);
    tn_status status = path ? tn_output_open(path, &output, error) : tn_fail_memory(error);
    if (status == TN_OK) {
        fwrite(bytes, 1, size, output.stream);
        status = tn_output_commit(&output, error);
    }
    free(path);
    return status;
}

static tn_status make_folder(const tn_shard_set *set, const char *name, tn_error *error)
{
    char *path = tn_shard_set_path(set, name);
    tn_status status = path ? tn_folder_make(path, error) : tn_fail_memory(error);
    free(path);
    return status;
}

static tn_status make_folders(const tn_shard_set *set, tn_error *error)
{
    char name[20];
    tn_status status = tn_folder_make(set->folder, error);
    if (status == TN_OK)
        status = make_folder(set, "shards", error);
    for (uint32_t i = 0; status == TN_OK && i < set->count; i += TN_SHARDS_A_FOLDER) {
        snprintf(name, sizeof name, "shards/%03u", i / TN_SHARDS_A_FOLDER);
        status = make_folder(set, name, error);
    }
    return status;
}

/* A set that is there is never written over: its shards would be taken for those of the new one. */
static tn_status refuse_another(const tn_shard_set *set, tn_error *error)
{
    char *path = tn_shard_set_path(set, TN_MANIFEST_NAME), *shards = tn_shard_set_path(set, "shards");
    bool there = path && shards && (tn_path_exists(path) || tn_path_exists(shards));
    free(path);
    free(shards);
    if (!there)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_SHARD_SET_THERE, "%.300s has a shard set already", set->folder);
    tn_error_help(error, "name another folder after -o, or delete this one");
    return TN_INVALID;
}

tn_status tn_shard_set_create(tn_shard_set *set, const uint8_t *module, size_t module_size, tn_error *error)
{
    tn_buffer text = {0};
    tn_hash_bytes(module, module_size, set->module_hash);
    free(set->version);
    set->version = strdup(TARTAN_VERSION);
    tn_status status = refuse_another(set, error);
    if (status == TN_OK && (!set->version || !tn_manifest_write(set, &text, set->hash)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = make_folders(set, error);
    if (status == TN_OK)
        status = write_file(set, TN_MODULE_NAME, module, module_size, error);
    if (status == TN_OK)
        status = write_file(set, TN_MANIFEST_NAME, text.data, text.size, error);
    free(text.data);
    return status;
}

tn_status tn_shard_set_read(const char *folder, tn_shard_set *set, tn_error *error)
{
    uint8_t *bytes = NULL;
    size_t size = 0;
    *set = (tn_shard_set){.folder = strdup(folder)};
    char *path = set->folder ? tn_shard_set_path(set, TN_MANIFEST_NAME) : NULL;
    tn_status status = path ? tn_file_read(path, MANIFEST_BYTES, &bytes, &size, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_manifest_read((const char *)bytes, size, set, error);
    else if (status == TN_IO && path && !tn_path_exists(path))
        tn_error_help(error, "a shard set is a folder that `tartan shards new` made");
    free(bytes);
    free(path);
    return status;
}
