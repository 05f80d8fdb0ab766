/* Lists the rule files below the served folder. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "compiler/compile.h"
#include "lsp/folders.h"
#include "runtime/base/array.h"
#include "runtime/base/file.h"
#include "runtime/base/utf8.h"
#include "studio/server/folder_parts.h"

typedef struct walk {
    const tn_studio_folder *folder;
    tn_studio_files *list;
} walk;

static bool add(tn_studio_files *list, const char *name, uint64_t size, const tn_notation *notation)
{
    if (!tn_array_reserve(&list->files, &list->capacity, list->count, 1, sizeof *list->files))
        return false;
    char *copy = strdup(name);
    if (copy)
        list->files[list->count++] = (tn_studio_file){copy, size, tn_notation_language(notation)};
    return copy != NULL;
}

/* Of what is there; behind a link that leads out of the folder there is nothing. */
static mode_t kind_of(const walk *w, int at, const char *entry, const char *name, uint64_t *size)
{
    struct stat found;
    if (fstatat(at, entry, &found, AT_SYMLINK_NOFOLLOW) != 0)
        return 0;
    *size = (uint64_t)found.st_size;
    if (!S_ISLNK(found.st_mode))
        return found.st_mode & S_IFMT;
    int file = tn_open_below(w->folder, name, O_PATH);
    bool regular = file >= 0 && fstat(file, &found) == 0 && S_ISREG(found.st_mode);
    if (file >= 0)
        close(file);
    *size = (uint64_t)found.st_size;
    return regular ? S_IFREG : 0;
}

static bool list_folder(const walk *w, int at, const char *prefix, unsigned depth);

/* False: out of memory. A folder that cannot be read has none. */
static bool list_inside(const walk *w, int at, const char *entry, const char *name, unsigned depth)
{
    char *prefix = NULL;
    int below = openat(at, entry, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (below < 0)
        return true;
    if (asprintf(&prefix, "%s/", name) < 0) {
        close(below);
        return false;
    }
    bool good = list_folder(w, below, prefix, depth);
    free(prefix);
    return good;
}

/* `at`: the folder that the entry is in. False: out of memory. */
static bool look_at(const walk *w, int at, const char *prefix, const char *entry, unsigned depth)
{
    const tn_notation *notation = tn_notation_of(entry, "", 0);
    char *name = NULL;
    uint64_t size = 0;
    if (entry[0] == '.' || strcmp(entry, "node_modules") == 0 || !tn_is_utf8(entry, strlen(entry)))
        return true;
    if (asprintf(&name, "%s%s", prefix, entry) < 0)
        return false;
    mode_t kind = kind_of(w, at, entry, name, &size);
    bool good = true;
    if (kind == S_IFREG && notation)
        good = add(w->list, name, size, notation);
    else if (kind == S_IFDIR && depth > 0)
        good = list_inside(w, at, entry, name, depth - 1);
    free(name);
    return good;
}

/* Takes over `at`. */
static bool list_folder(const walk *w, int at, const char *prefix, unsigned depth)
{
    DIR *directory = fdopendir(at);
    bool good = true;
    if (!directory)
        close(at);
    for (const struct dirent *entry; good && directory && !w->list->cut && (entry = readdir(directory));) {
        w->list->cut = w->list->entries++ >= TN_FOLDER_ENTRIES_MAX;
        if (!w->list->cut)
            good = look_at(w, dirfd(directory), prefix, entry->d_name, depth);
    }
    if (directory)
        closedir(directory);
    return good;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const tn_studio_file *)a)->name, ((const tn_studio_file *)b)->name);
}

tn_status tn_studio_folder_list(const tn_studio_folder *folder, tn_studio_files *list, tn_error *error)
{
    struct stat found;
    *list = (tn_studio_files){0};
    if (fstat(folder->root, &found) != 0 || found.st_nlink == 0)
        return tn_fail(error, TN_IO, E_CANNOT_READ, "the folder %.300s is gone", folder->path);
    int root = openat(folder->root, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (root < 0)
        return tn_cannot_read(folder->path, errno, error);
    const walk w = {folder, list};
    if (!list_folder(&w, root, "", TN_FOLDER_DEPTH_MAX))
        return tn_fail_memory(error);
    if (list->count > 0)
        qsort(list->files, list->count, sizeof *list->files, by_name);
    return TN_OK;
}

void tn_studio_files_clear(tn_studio_files *list)
{
    for (size_t i = 0; i < list->count; i++)
        free(list->files[i].name);
    free(list->files);
    *list = (tn_studio_files){0};
}

/* ---- for those who compile: a path begins with "/", which is the folder */

static tn_status read_served(void *context, const char *path, uint8_t **bytes, size_t *size, tn_error *error)
{
    return tn_studio_folder_read(context, path + (path[0] == '/'), TN_NAMED_FILE_MAX, bytes, size, error);
}

/* The names as paths. */
static bool hand_over(const tn_studio_files *list, char **paths)
{
    for (size_t i = 0; i < list->count; i++)
        if (asprintf(&paths[i], "/%s", list->files[i].name) < 0) {
            while (i > 0)
                free(paths[--i]);
            return false;
        }
    return true;
}

static tn_status list_served(void *context, char ***paths, size_t *count, bool *cut_off, tn_error *error)
{
    tn_studio_files list;
    tn_status status = tn_studio_folder_list(context, &list, error);
    *count = 0;
    *paths = status == TN_OK ? malloc(sizeof **paths * (list.count + 1)) : NULL;
    if (status == TN_OK && (!*paths || !hand_over(&list, *paths))) {
        free(*paths);
        *paths = NULL;
        status = tn_fail_memory(error);
    } else if (status == TN_OK) {
        *count = list.count;
        *cut_off = list.cut;
    }
    tn_studio_files_clear(&list);
    return status;
}

tn_served tn_studio_folder_served(tn_studio_folder *folder)
{
    return (tn_served){.read = read_served, .list = list_served, .context = folder};
}
