/* Suggests a file for a path that does not exist. */
#include "driver/open/suggest_file.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "runtime/base/nearest.h"

enum { NAMES_MAX = 1 << 15 }; /* a library of LDraw parts has some 20,000 files */

static int compare_texts(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* "houses.plan" as "houses", with the zero byte "plan" behind it: ".plan" makes no two names alike. */
static char *cut_name(const char *name)
{
    size_t size = strlen(name);
    char *cut = malloc(size + 2);
    if (!cut)
        return NULL;
    memcpy(cut, name, size + 1);
    cut[size + 1] = '\0';
    char *dot = strrchr(cut, '.');
    if (dot)
        *dot = '\0';
    return cut;
}

static const char *extension_of(const char *cut)
{
    return cut + strlen(cut) + 1;
}

/* The folder's files with the extension, or all where that is empty, as cut names. Sorted, so that the suggestion does
 * not depend on how the folder is stored. */
static size_t list_folder(const char *folder, const char *extension, char **names)
{
    DIR *directory = opendir(folder);
    size_t count = 0;
    for (struct dirent *entry; directory && count < NAMES_MAX && (entry = readdir(directory));) {
        char *cut = entry->d_name[0] == '.' ? NULL : cut_name(entry->d_name);
        if (cut && (!*extension || strcmp(extension_of(cut), extension) == 0))
            names[count++] = cut;
        else
            free(cut);
    }
    if (directory)
        closedir(directory);
    qsort(names, count, sizeof *names, compare_texts);
    return count;
}

bool tn_suggest_file(const char *path, tn_error *error)
{
    if (strcmp(path, "-") == 0 || access(path, F_OK) == 0 || errno != ENOENT)
        return false;
    const char *slash = strrchr(path, '/'), *near = NULL;
    int folder_size = slash ? (int)(slash - path) + 1 : 0;
    char folder[PATH_MAX], **names = malloc(NAMES_MAX * sizeof *names);
    char *wanted = cut_name(path + folder_size);
    if (names && wanted && (size_t)folder_size < sizeof folder) {
        snprintf(folder, sizeof folder, "%.*s", folder_size, path);
        size_t count = list_folder(folder_size ? folder : ".", extension_of(wanted), names);
        near = tn_nearest(wanted, (const char *const *)names, count);
        if (near)
            tn_error_help(error, "did you mean `%s%s%s%s`?", folder, near, *extension_of(near) ? "." : "",
                          extension_of(near));
        for (size_t i = 0; i < count; i++)
            free(names[i]);
    }
    free(names);
    free(wanted);
    return near != NULL;
}
