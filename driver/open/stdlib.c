/* Finds files of the standard library: in the folders where it is installed, or in the program itself. */
#include "driver/open/stdlib.h"

#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compiler/common/import.h"
#include "compiler/compile.h"
#include "runtime/base/array.h"
#include "runtime/base/nearest.h"

/* ---- its folders */

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

/* ---- a file by its name */

#define NAMES_MAX 512u /* considered for a suggestion */

bool tn_path_is_bare(const char *path)
{
    return path[0] != '\0' && !strpbrk(path, "/.");
}

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

typedef struct name_list {
    char *items[NAMES_MAX];
    size_t count;
} name_list;

/* "genr8.bnf": without the extension of a notation. */
static size_t name_length(const char *path)
{
    bool is_rules = tn_notation_of(path, "", 0) != NULL;
    return strlen(path) - (is_rules ? strlen(tn_path_extension(path)) : 0);
}

static void list_folder(const char *path, name_list *list)
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

static void suggest(const char *name, const name_list *list, tn_error *error)
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
    name_list list = {.count = 0};
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

/* ---- the texts in the program */

const tn_stdlib_text *tn_stdlib_text_named(const char *name)
{
    for (size_t i = 0; i < tn_stdlib_text_count; i++)
        if (strcmp(tn_stdlib_texts[i].name, name) == 0)
            return &tn_stdlib_texts[i];
    return NULL;
}

/* ---- as a resolver */

/* The name of a file that was likely meant, with the extension that is asked for; NULL if there is none. */
static const char *find_near(const char *name, const char *extension)
{
    const char **names = calloc(tn_stdlib_text_count + 1, sizeof *names);
    size_t count = 0;
    for (size_t i = 0; names && i < tn_stdlib_text_count; i++)
        if (strcmp(strrchr(tn_stdlib_texts[i].name, '.'), extension) == 0)
            names[count++] = tn_stdlib_texts[i].name;
    const char *near = names ? tn_nearest(name, names, count) : NULL;
    free(names);
    return near;
}

static tn_status resolve(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    const tn_stdlib_resolver *own = context;
    char name[TN_MEANT_SIZE];
    if (!tn_path_is_bare(request->path))
        return own->rest.resolve(own->rest.context, request, found, meant, error);
    snprintf(name, sizeof name, "%s%s", request->path, request->extension);
    const tn_stdlib_text *text = tn_stdlib_text_named(name);
    if (text) {
        *found = (tn_input){text->text, text->size, text->recorded, NULL, text->recorded};
        return TN_OK;
    }
    tn_status status = own->rest.resolve(own->rest.context, request, found, meant, error);
    const char *near = status == TN_INVALID ? find_near(name, request->extension) : NULL;
    if (near && !meant[0]) {
        int size = (int)(strlen(near) - strlen(request->extension));
        tn_error_help(error, "did you mean `%.*s`?", size, near);
        snprintf(meant, TN_MEANT_SIZE, "%.*s", size, near);
    }
    return status;
}

tn_resolver tn_stdlib_resolver_of(tn_stdlib_resolver *own)
{
    return (tn_resolver){resolve, own};
}
