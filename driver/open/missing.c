/* Says of a file that is not there which one was likely meant. */
#include "driver/open/missing.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "runtime/base/nearest.h"

/* ---- by a path */

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
static size_t list_cut_names(const char *folder, const char *extension, char **names)
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
        size_t count = list_cut_names(folder_size ? folder : ".", extension_of(wanted), names);
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

/* ---- paths */

bool tn_path_exists(const char *path)
{
    return access(path, F_OK) == 0;
}

static char *join(const char *folder, size_t folder_size, const char *name, const char *extension)
{
    size_t size = folder_size + strlen(name) + strlen(extension) + 2;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%.*s%s%s%s", (int)folder_size, folder,
                 folder_size > 0 && folder[folder_size - 1] != '/' ? "/" : "", name, extension);
    return path;
}

char *tn_path_join(const char *folder, const char *name, const char *extension)
{
    return join(folder, strlen(folder), name, extension);
}

char *tn_path_beside(const char *user, const char *path, const char *extension)
{
    const char *slash = path[0] == '/' ? NULL : strrchr(user, '/');
    return join(user, slash ? (size_t)(slash - user) + 1 : 0, path, extension);
}

/* ---- what was meant */

enum { ROOM = 512 };

typedef struct names {
    char *items[ROOM];
    size_t count;
} names;

/* Adds the file names in a folder that end in the extension, sorted; without the extension where `bare`. */
static void list_folder(const char *folder, const char *extension, bool bare, names *list)
{
    DIR *directory = opendir(folder);
    size_t first = list->count, extension_size = strlen(extension);
    for (struct dirent *entry; directory && list->count < ROOM && (entry = readdir(directory));) {
        size_t size = strlen(entry->d_name);
        if (size <= extension_size || strcmp(entry->d_name + size - extension_size, extension) != 0)
            continue;
        char *name = strndup(entry->d_name, bare ? size - extension_size : size);
        if (name)
            list->items[list->count++] = name;
    }
    if (directory)
        closedir(directory);
    qsort(list->items + first, list->count - first, sizeof *list->items, compare_texts);
}

/* The names that could have been meant. */
static void list_names(const tn_stdlib_dirs *dirs, const tn_request *request, bool bare, names *list)
{
    for (size_t i = 0; bare && i < dirs->count; i++)
        list_folder(dirs->dirs[i], request->extension, true, list);
    char *path = bare ? NULL : tn_path_beside(request->user, request->path, "");
    if (!path)
        return;
    char *slash = strrchr(path, '/');
    if (slash)
        slash[1] = '\0';
    list_folder(slash ? path : ".", request->extension, false, list);
    free(path);
}

static void suggest(const tn_request *request, const char *near, char *meant, tn_error *error)
{
    const char *last = strrchr(request->path, '/');
    int folder = last ? (int)(last - request->path) + 1 : 0;
    tn_error_help(error, "did you mean `%.*s%s`?", folder, request->path, near);
    if ((size_t)snprintf(meant, TN_MEANT_SIZE, "%.*s%s", folder, request->path, near) >= TN_MEANT_SIZE)
        meant[0] = '\0';
}

/* Is there a folder of the standard library at all? A program that was copied away from its own has none. */
static bool any_folder(const tn_stdlib_dirs *dirs)
{
    for (size_t i = 0; i < dirs->count; i++)
        if (tn_path_exists(dirs->dirs[i]))
            return true;
    return false;
}

tn_status tn_missing(const tn_stdlib_dirs *dirs, const tn_request *request, char *meant, tn_error *error)
{
    bool bare = tn_path_is_bare(request->path);
    const char *path = request->path, *extension = request->extension, *last = strrchr(path, '/');
    names list = {.count = 0};
    tn_status status = tn_fail(error, TN_INVALID, E_IMPORT_NOT_FOUND,
                               bare ? "the standard library has no `%.400s`" : "there is no file `%.400s`", path);
    list_names(dirs, request, bare, &list);
    const char *near = tn_nearest(last ? last + 1 : path, (const char *const *)list.items, list.count);
    char *neighbour = bare ? tn_path_beside(request->user, path, extension) : NULL;
    if (neighbour && tn_path_exists(neighbour))
        tn_error_help(error, "for the file beside this one write `use \"%.200s%s\"`", path, extension);
    else if (near)
        suggest(request, near, meant, error);
    else if (bare && dirs->count && !any_folder(dirs))
        tn_error_help(error, "there is no folder %.300s: set TARTAN_PATH to the folder of the standard library",
                      dirs->dirs[dirs->count - 1]);
    else if (bare)
        tn_error_help(error, "for a file of yours write its extension too: `use \"%.200s%s\"`", path, extension);
    else
        tn_error_help(error, "the path starts at the folder of the file that names it");
    free(neighbour);
    for (size_t i = 0; i < list.count; i++)
        free(list.items[i]);
    return status;
}
