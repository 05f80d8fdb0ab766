/* Looks a shard set over. */
#include "driver/shards/check.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/shards/record.h"
#include "runtime/base/file.h"

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

/* Is it a shard of this folder, its record or its claim? What begins with a point is being written. */
static bool is_known(const tn_shard_set *set, uint32_t folder, const char *name)
{
    char *end;
    if (name[0] == '.')
        return true;
    unsigned long long shard = strtoull(name, &end, 10);
    if (end != name + 6 || shard >= set->count || shard / TN_SHARDS_A_FOLDER != folder)
        return false;
    const tn_shard_name whole = tn_shard_name_of(set, (uint32_t)shard);
    const char *wanted = strrchr(whole.text, '/') + 1;
    size_t size = strlen(wanted);
    if (strncmp(name, wanted, size) != 0)
        return false;
    const char *ending = name + size;
    return !*ending || strcmp(ending, TN_SHARD_RECORD) == 0 ||
           strncmp(ending, TN_SHARD_CLAIM, strlen(TN_SHARD_CLAIM)) == 0;
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
