/* Finds a file of the standard library by its name. */
#include "driver/open/stdlib_find.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compiler/common/import.h"
#include "compiler/compile.h"
#include "driver/open/stdlib_dirs.h"
#include "runtime/base/nearest.h"

#define NAMES_MAX 512u /* considered for a suggestion */

bool tn_stdlib_may_mean(const char *name)
{
    return name[0] && !strpbrk(name, "./") && strcmp(name, "-") != 0 && access(name, F_OK) != 0;
}

void tn_stdlib_file_clear(tn_stdlib_file *file)
{
    free(file->path);
    free(file->recorded);
    *file = (tn_stdlib_file){0};
}

static tn_status try_file(const char *dir, const char *name, const char *extension, tn_stdlib_file *found,
                          tn_error *error)
{
    if (asprintf(&found->path, "%s/%s%s", dir, name, extension) < 0) {
        found->path = NULL;
        return tn_fail_memory(error);
    }
    if (access(found->path, F_OK) != 0) {
        free(found->path);
        found->path = NULL;
        return TN_OK;
    }
    if (asprintf(&found->recorded, "<stdlib>/%s%s", name, extension) < 0) {
        found->recorded = NULL;
        return tn_fail_memory(error);
    }
    return TN_OK;
}

tn_status tn_stdlib_find(const char *name, tn_stdlib_file *found, tn_error *error)
{
    tn_stdlib_dirs dirs;
    *found = (tn_stdlib_file){0};
    tn_status status = tn_stdlib_dirs_find(&dirs, error);
    for (size_t d = 0; d < dirs.count && status == TN_OK; d++)
        for (size_t n = 0; n < tn_notation_count && status == TN_OK && !found->path; n++)
            status = try_file(dirs.dirs[d], name, tn_notations[n].extension, found, error);
    tn_stdlib_dirs_clear(&dirs);
    return status;
}

/* ---- did you mean */

typedef struct names {
    char *items[NAMES_MAX];
    size_t count;
} names;

/* "genr8.bnf": without the extension of a notation. */
static size_t name_length(const char *path)
{
    bool is_rules = tn_notation_of(path, "", 0) != NULL;
    return strlen(path) - (is_rules ? strlen(tn_path_extension(path)) : 0);
}

static void list_folder(const char *path, names *list)
{
    DIR *folder = opendir(path);
    for (const struct dirent *entry; folder && list->count < NAMES_MAX && (entry = readdir(folder));) {
        size_t length = name_length(entry->d_name);
        if (length > 0 && entry->d_name[length] && (list->items[list->count] = strndup(entry->d_name, length)))
            list->count++;
    }
    if (folder)
        closedir(folder);
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void suggest(const char *name, const names *list, tn_error *error)
{
    const char *near = tn_nearest(name, (const char *const *)list->items, list->count);
    if (near && strcmp(near, name) == 0)
        tn_error_help(error, "the standard library's file is named `%s`", near);
    else if (near)
        tn_error_help(error, "did you mean `%s`, of the standard library?", near);
}

void tn_stdlib_suggest(const char *path, tn_error *error)
{
    tn_stdlib_dirs dirs;
    names list = {.count = 0};
    char *name = strchr(path, '/') ? NULL : strndup(path, name_length(path));
    if (!name)
        return;
    if (tn_stdlib_dirs_find(&dirs, NULL) == TN_OK)
        for (size_t d = 0; d < dirs.count; d++)
            list_folder(dirs.dirs[d], &list);
    qsort(list.items, list.count, sizeof *list.items, compare_names); /* folders are listed in any order */
    suggest(name, &list, error);
    for (size_t i = 0; i < list.count; i++)
        free(list.items[i]);
    free(name);
    tn_stdlib_dirs_clear(&dirs);
}
