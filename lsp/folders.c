/* Lists the rule files in the folders that an editor has open. */
#include "lsp/folders.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "compiler/compile.h"
#include "runtime/base/array.h"

static void add(tn_rule_files *files, const char *path)
{
    if (!tn_array_reserve(&files->paths, &files->capacity, files->count, 1, sizeof *files->paths)) {
        files->failed = true;
        return;
    }
    char *real = realpath(path, NULL);
    if (real)
        files->paths[files->count++] = real;
}

static bool passed_over(const char *name)
{
    return name[0] == '.' || strcmp(name, "node_modules") == 0;
}

/* Not every file system says in its entries what they are. */
static bool is_folder(const struct dirent *entry, const char *path)
{
    struct stat status;
    if (entry->d_type != DT_UNKNOWN)
        return entry->d_type == DT_DIR;
    return lstat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

static void look_at(tn_rule_files *files, const char *folder, const struct dirent *entry, unsigned depth)
{
    bool rules = tn_notation_of(entry->d_name, "", 0) == TN_NOTATION(plan);
    bool maybe_folder = depth > 0 && (entry->d_type == DT_DIR || entry->d_type == DT_UNKNOWN);
    char *path = NULL;
    if (!rules && !maybe_folder)
        return;
    if (asprintf(&path, "%s/%s", folder, entry->d_name) < 0) {
        files->failed = true;
        return;
    }
    if (!is_folder(entry, path)) {
        if (rules)
            add(files, path);
    } else if (depth > 0) {
        tn_rule_files_find(files, path, depth - 1);
    }
    free(path);
}

void tn_rule_files_find(tn_rule_files *files, const char *folder, unsigned depth)
{
    DIR *directory = opendir(folder);
    for (const struct dirent *entry; directory && !files->cut_off && (entry = readdir(directory));) {
        files->cut_off = files->entries++ >= TN_FOLDER_ENTRIES_MAX;
        if (!files->cut_off && !passed_over(entry->d_name))
            look_at(files, folder, entry, depth);
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
