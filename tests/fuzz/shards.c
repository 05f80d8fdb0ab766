/* The small files of shard sets from any bytes: manifests, with the hash that they have and with the right one, records
 * and claims. A manifest that is read is written as one that reads the same. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "driver/shards/manifest.h"
#include "driver/shards/record.h"
#include "driver/shards/run.h"
#include "tests/fuzz/fuzz.h"

#define OWN_SET "00000000000000000000000000000000" /* whose the records of the corpus are */

static tn_status read_manifest(const char *text, size_t size, tn_shard_set *set)
{
    tn_error error;
    *set = (tn_shard_set){.folder = strdup("set")};
    return set->folder ? tn_manifest_read(text, size, set, &error) : TN_MEMORY;
}

/* Do two sets say the same, in the same words? And does each shard have ranks, or a piece of an input? */
static void same_again(const tn_shard_set *set)
{
    tn_buffer text = {0}, second = {0};
    char hash[33];
    tn_shard_set again;
    if (!tn_manifest_write(set, &text, hash) || read_manifest(text.data, text.size, &again) != TN_OK)
        abort();
    if (!tn_manifest_write(&again, &second, hash) || text.size != second.size ||
        memcmp(text.data, second.data, text.size) != 0)
        abort();
    for (uint32_t i = 0; i < set->count; i++)
        if (tn_shard_set_answers(set) ? set->inputs.pieces[i].input >= set->inputs.count
                                      : mpz_cmp(set->bounds[i], set->bounds[i + 1]) > 0)
            abort();
    tn_shard_set_clear(&again);
    free(text.data);
    free(second.data);
}

static void manifest(const char *text, size_t size)
{
    tn_shard_set set;
    if (read_manifest(text, size, &set) == TN_OK)
        same_again(&set);
    tn_shard_set_clear(&set);
}

/* What the bytes say, with the hash that they would have. */
static void sealed(const char *text, size_t size)
{
    tn_buffer whole = {0};
    char hash[33];
    if (tn_buffer_append(&whole, text, size) && tn_manifest_seal(&whole, hash))
        manifest(whole.data, whole.size);
    free(whole.data);
}

static void write_file(const char *path, const char *text, size_t size)
{
    FILE *out = path ? fopen(path, "wb") : NULL;
    if (!out || fwrite(text, 1, size, out) != size || fclose(out) != 0)
        abort();
}

/* The bytes as each of the small files beside a shard, in a folder of this process's own. */
static void small_files(const char *text, size_t size)
{
    char folder[40], shards[60], inner[80];
    snprintf(folder, sizeof folder, "/tmp/tartan-fuzz-%ld", (long)getpid());
    snprintf(shards, sizeof shards, "%s/shards", folder);
    snprintf(inner, sizeof inner, "%s/000", shards);
    mkdir(folder, 0700);
    mkdir(shards, 0700);
    mkdir(inner, 0700);
    tn_shard_set set = {.folder = folder, .hash = OWN_SET, .count = 1, .format = TN_FORMAT_BIN};
    tn_shard_record record;
    tn_shard_read read;
    tn_claimant claimant;
    tn_error error;
    char *beside = tn_shard_path(&set, 0, TN_SHARD_RECORD), *claim = tn_shard_path(&set, 0, TN_SHARD_CLAIM);
    write_file(beside, text, size);
    write_file(claim, text, size);
    if (tn_shard_record_read(&set, 0, &record, &error) == TN_OK && strlen(record.files[0].hash) != 32)
        abort();
    set.task = TN_TASK_MATCH; /* whose records say more */
    set.inputs.answer = TN_ANSWER_NAMES;
    char *other = tn_shard_path(&set, 0, TN_SHARD_RECORD);
    write_file(other, text, size);
    if (tn_shard_read_of(&set, 0, &read, &error) == TN_OK && read.unread > 0 && read.complaints[0].status != TN_INVALID)
        abort();
    unlink(other);
    free(other);
    if (!tn_claim_read(claim, &claimant))
        abort();
    unlink(beside);
    unlink(claim);
    free(beside);
    free(claim);
    rmdir(inner);
    rmdir(shards);
    rmdir(folder);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    manifest((const char *)data, size);
    sealed((const char *)data, size);
    small_files((const char *)data, size);
    return 0;
}
