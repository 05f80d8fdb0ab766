#include "lsp/folders.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "compiler/notation.h"

static void add(tn_rule_files *files, const char *path)
{
    if (files->count == files->capacity) {
        size_t capacity = files->capacity ? 2 * files->capacity : 16;
        char **grown = realloc(files->paths, capacity * sizeof *grown);
        if (!grown) {
            files->failed = true;
            return;
        }
        files->paths = grown;
        files->capacity = capacity;
    }
    char *real = realpath(path, NULL);
    if (real)
        files->paths[files->count++] = real;
}

static bool passed_over(const char *name)
{
    return name[0] == '.' || strcmp(name, "node_modules") == 0;
}

static void look_at(tn_rule_files *files, const char *folder, const char *name, unsigned depth)
{
    struct stat status;
    char *path = NULL;
    if (asprintf(&path, "%s/%s", folder, name) < 0) {
        files->failed = true;
        return;
    }
    if (lstat(path, &status) != 0) {
        free(path);
        return;
    }
    if (S_ISDIR(status.st_mode) && depth > 0)
        tn_rule_files_find(files, path, depth - 1);
    else if (!S_ISDIR(status.st_mode) && tn_notation_of(name) == TN_NOTATION_PLAN)
        add(files, path);
    free(path);
}

void tn_rule_files_find(tn_rule_files *files, const char *folder, unsigned depth)
{
    DIR *directory = opendir(folder);
    for (const struct dirent *entry; directory && !files->cut_off && (entry = readdir(directory));) {
        files->cut_off = files->entries++ >= TN_FOLDER_ENTRIES_MAX;
        if (!files->cut_off && !passed_over(entry->d_name))
            look_at(files, folder, entry->d_name, depth);
    }
    if (directory)
        closedir(directory);
}

void tn_rule_files_clear(tn_rule_files *files)
{
    for (size_t i = 0; i < files->count; i++)
        free(files->paths[i]);
    free(files->paths);
    *files = (tn_rule_files){0};
}
