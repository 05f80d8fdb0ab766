/* Finds the folders of the standard library. */
#include "driver/open/stdlib_dirs.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "runtime/base/array.h"

static bool add(tn_stdlib_dirs *found, const char *dir, size_t length, const char *below)
{
    if (!tn_array_resize(&found->dirs, found->count + 1, sizeof *found->dirs))
        return false;
    size_t size = length + strlen(below) + 1;
    char *text = malloc(size);
    if (!text)
        return false;
    snprintf(text, size, "%.*s%s", (int)length, dir, below);
    found->dirs[found->count++] = text;
    return true;
}

static bool add_environment(tn_stdlib_dirs *found)
{
    const char *at = getenv("TARTAN_PATH");
    while (at && *at) {
        size_t length = strcspn(at, ":");
        if (length && length < PATH_MAX && !add(found, at, length, ""))
            return false;
        at += length + (at[length] == ':');
    }
    return true;
}

static bool add_beside_executable(tn_stdlib_dirs *found)
{
    char path[PATH_MAX];
    ssize_t length = readlink("/proc/self/exe", path, sizeof path);
    if (length <= 0 || length == (ssize_t)sizeof path)
        return true;
    while (length > 0 && path[length - 1] != '/')
        length--;
    return add(found, path, (size_t)length, "stdlib") && add(found, path, (size_t)length, "../share/tartan/stdlib");
}

tn_status tn_stdlib_dirs_find(tn_stdlib_dirs *found, tn_error *error)
{
    *found = (tn_stdlib_dirs){0};
    static const char installed[] = TARTAN_DATADIR "/stdlib";
    if (!add_environment(found) || !add_beside_executable(found) || !add(found, installed, sizeof installed - 1, ""))
        return tn_fail_memory(error);
    return TN_OK;
}

void tn_stdlib_dirs_clear(tn_stdlib_dirs *found)
{
    for (size_t i = 0; i < found->count; i++)
        free(found->dirs[i]);
    free(found->dirs);
    *found = (tn_stdlib_dirs){0};
}
