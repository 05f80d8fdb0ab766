#include "studio/server/folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <linux/openat2.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>
#include <xxhash.h>

#include "compiler/compile.h"
#include "lsp/workspace.h"
#include "runtime/base/array.h"
#include "runtime/base/file.h"
#include "runtime/base/utf8.h"

struct tn_studio_folder {
    int root; /* the folder's descriptor */
    bool read_only;
    bool walks; /* the kernel has no openat2 */
    char *path;
    pthread_mutex_t writing; /* one writer at a time compares and renames */
};

/* Opening never waits for a FIFO's other end, and never makes a terminal this process's own. */
#define SAFELY (O_CLOEXEC | O_NONBLOCK | O_NOCTTY)

enum { AGAIN_MAX = 16 }; /* openat2 asks to be called again if something was renamed meanwhile */

/* ---- below the folder */

/* What is only looked at is not opened, and takes no other flags. */
static int with_care(int flags)
{
    return flags | (flags & O_PATH ? O_CLOEXEC : SAFELY);
}

static long open_beneath(int root, const char *name, int flags)
{
    const struct open_how how = {.flags = (uint64_t)with_care(flags),
                                 .resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS};
    long file = -1;
    errno = EAGAIN;
    for (int i = 0; i < AGAIN_MAX && file < 0 && errno == EAGAIN; i++)
        file = syscall(SYS_openat2, root, name, &how, sizeof how);
    return file;
}

/* The path without `.` and `..`, which is the same path as long as none of its parts is a link. False: it leads out, or
 * is too long. */
static bool flatten(const char *name, char flat[PATH_MAX])
{
    size_t size = 0;
    flat[0] = '\0';
    if (name[0] == '/')
        return false;
    while (*name) {
        size_t length = strcspn(name, "/");
        bool up = length == 2 && memcmp(name, "..", 2) == 0, stays = length == 0 || (length == 1 && name[0] == '.');
        if (up && size == 0)
            return false;
        if (up) {
            const char *slash = strrchr(flat, '/');
            size = slash ? (size_t)(slash - flat) : 0;
        } else if (!stays) {
            if (size + length + 2 > PATH_MAX)
                return false;
            if (size > 0)
                flat[size++] = '/';
            memcpy(flat + size, name, length);
            size += length;
        }
        flat[size] = '\0';
        name += length + (name[length] == '/');
    }
    return true;
}

/* Step by step, following no link: whatever others rename meanwhile, each step is into a folder of the one before. */
static int open_walking(int root, const char *name, int flags)
{
    char flat[PATH_MAX];
    if (!flatten(name, flat)) {
        errno = EXDEV;
        return -1;
    }
    size_t size = strlen(name);
    flags |= size > 0 && name[size - 1] == '/' ? O_DIRECTORY : 0;
    int at = root;
    char *part = flat;
    for (char *slash; (slash = strchr(part, '/')) != NULL; part = slash + 1) {
        *slash = '\0';
        int next = openat(at, part, O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        int reason = errno;
        if (at != root)
            close(at);
        errno = reason;
        if (next < 0)
            return -1;
        at = next;
    }
    int file = openat(at, *part ? part : ".", with_care(flags) | O_NOFOLLOW), reason = errno;
    if (at != root)
        close(at);
    errno = reason;
    return file;
}

/* Opens what `name` says below the folder; -1 and errno. EXDEV: it lies outside. */
static int open_below(const tn_studio_folder *folder, const char *name, int flags)
{
    return folder->walks ? open_walking(folder->root, name, flags) : (int)open_beneath(folder->root, name, flags);
}

/* ---- the folder */

tn_status tn_studio_folder_open(const char *path, bool read_only, tn_studio_folder **folder, tn_error *error)
{
    tn_studio_folder *made = calloc(1, sizeof *made);
    *folder = NULL;
    if (!made)
        return tn_fail_memory(error);
    made->root = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    int reason = errno;
    made->path = made->root >= 0 ? realpath(path, NULL) : NULL;
    if (made->root < 0 || !made->path) {
        reason = made->root < 0 ? reason : errno;
        if (made->root >= 0)
            close(made->root);
        free(made);
        return tn_cannot_read(path, reason, error);
    }
    if (!tn_is_utf8(made->path, strlen(made->path))) { /* a page could not be told */
        close(made->root);
        free(made->path);
        free(made);
        return tn_fail(error, TN_IO, E_CANNOT_READ, "cannot serve the folder: its name is no UTF-8 text");
    }
    made->read_only = read_only;
    pthread_mutex_init(&made->writing, NULL);
    /* Filters of system calls refuse what they do not know, with errors of their own. */
    long probe = open_beneath(made->root, ".", O_PATH);
    made->walks = probe < 0;
    if (probe >= 0)
        close((int)probe);
    *folder = made;
    return TN_OK;
}

void tn_studio_folder_close(tn_studio_folder *folder)
{
    if (!folder)
        return;
    close(folder->root);
    free(folder->path);
    pthread_mutex_destroy(&folder->writing);
    free(folder);
}

void tn_studio_folder_walk(tn_studio_folder *folder)
{
    folder->walks = true;
}

const char *tn_studio_folder_path(const tn_studio_folder *folder)
{
    return folder->path;
}

bool tn_studio_folder_read_only(const tn_studio_folder *folder)
{
    return folder->read_only;
}

/* ---- reading */

/* 0, or why not. */
static int read_whole(int file, size_t limit, uint8_t **bytes, size_t *size)
{
    uint8_t *made = NULL;
    size_t capacity = 0, used = 0;
    int reason = 0;
    for (bool more = true; more;) {
        ssize_t got = -1;
        if (tn_array_reserve_from(&made, &capacity, 1 << 16, used, 2, 1))
            got = read(file, made + used, capacity - used - 1);
        else
            errno = ENOMEM;
        reason = got >= 0 || errno == EINTR ? 0 : errno;
        used += got > 0 ? (size_t)got : 0;
        if (used > limit)
            reason = EFBIG;
        more = reason == 0 && got != 0;
    }
    if (reason != 0) {
        free(made);
        return reason;
    }
    made[used] = 0;
    *bytes = made;
    *size = used;
    return 0;
}

/* Reads an open file. 0, or why not: ENODEV or EISDIR if it is none that holds text, EFBIG if it is larger than the
 * limit. */
static int read_regular(int file, size_t limit, uint8_t **bytes, size_t *size)
{
    struct stat found;
    if (fstat(file, &found) != 0)
        return errno;
    if (!S_ISREG(found.st_mode))
        return S_ISDIR(found.st_mode) ? EISDIR : ENODEV;
    if (found.st_size > 0 && (uint64_t)found.st_size > limit)
        return EFBIG;
    return read_whole(file, limit, bytes, size);
}

static tn_status cannot(const char *name, size_t limit, int reason, tn_error *error)
{
    if (reason == ENOMEM)
        return tn_fail_memory(error);
    if (reason == EFBIG)
        return tn_fail(error, TN_LIMIT, E_FILE_TOO_LARGE, "%.300s is larger than the limit of %zu bytes", name, limit);
    const char *why = reason == EXDEV                       ? "it lies outside of the folder that is served"
                      : reason == ELOOP                     ? "it is a link, or lies behind one"
                      : reason == ENODEV || reason == ENXIO ? "it is no file that holds text"
                                                            : NULL;
    return why ? tn_fail(error, TN_IO, E_CANNOT_READ, "cannot read %.300s: %s", name, why)
               : tn_cannot_read(name, reason, error);
}

tn_status tn_studio_folder_read(const tn_studio_folder *folder, const char *name, size_t limit, uint8_t **bytes,
                                size_t *size, tn_error *error)
{
    int file = open_below(folder, name, O_RDONLY);
    int reason = file < 0 ? errno : read_regular(file, limit, bytes, size);
    if (file >= 0)
        close(file);
    return reason ? cannot(name, limit, reason, error) : TN_OK;
}

tn_file_hash tn_hash_of_bytes(const void *bytes, size_t size)
{
    static const char digits[] = "0123456789abcdef";
    tn_file_hash hash;
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes, size));
    for (size_t i = 0; i < sizeof canonical.digest; i++) {
        hash.text[2 * i] = digits[canonical.digest[i] >> 4];
        hash.text[2 * i + 1] = digits[canonical.digest[i] & 15];
    }
    hash.text[2 * sizeof canonical.digest] = '\0';
    return hash;
}

tn_file_hash tn_studio_folder_hash(const tn_studio_folder *folder, const char *name)
{
    uint8_t *bytes;
    size_t size;
    tn_error error;
    if (tn_studio_folder_read(folder, name, TN_TEXT_MAX, &bytes, &size, &error) != TN_OK)
        return (tn_file_hash){""};
    tn_file_hash hash = tn_hash_of_bytes(bytes, size);
    free(bytes);
    return hash;
}

tn_file_stamp tn_studio_folder_stamp(const tn_studio_folder *folder, const char *name)
{
    struct stat found;
    int file = open_below(folder, name, O_PATH);
    bool known = file >= 0 && fstat(file, &found) == 0 && S_ISREG(found.st_mode);
    if (file >= 0)
        close(file);
    return known ? (tn_file_stamp){(uint64_t)found.st_ino + 1, (uint64_t)found.st_size,
                                   (uint64_t)found.st_mtim.tv_sec * 1000000000u + (uint64_t)found.st_mtim.tv_nsec}
                 : (tn_file_stamp){0};
}

/* ---- names */

static bool is_plain(const char *name)
{
    for (;;) {
        size_t length = strcspn(name, "/");
        if (length == 0 || (length == 1 && name[0] == '.') || (length == 2 && memcmp(name, "..", 2) == 0))
            return false;
        if (name[length] == '\0')
            return true;
        name += length + 1;
    }
}

tn_status tn_studio_name_check(const char *name, tn_error *error)
{
    if (strlen(name) >= PATH_MAX || !tn_is_utf8(name, strlen(name)))
        return tn_fail(error, TN_INVALID, E_USAGE, "the name of a file is too long, or is no text");
    if (!is_plain(name))
        return tn_fail(error, TN_INVALID, E_USAGE, "%.300s is not the name of a file below the folder that is served",
                       name);
    if (!tn_notation_of(name, "", 0))
        return tn_fail(error, TN_INVALID, E_USAGE, "%.300s is not the name of a rule file: no notation's files end so",
                       name);
    return TN_OK;
}

/* ---- its rule files */

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
    int file = open_below(w->folder, name, O_PATH);
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

/* ---- writing */

/* A file that is written: all names are of one folder, which stays the same whatever others rename. */
typedef struct draft {
    int folder;
    const char *name;   /* of the target, in it */
    char temporary[40]; /* empty while there is none */
    bool replaces;
} draft;

/* What is there now. A link is not looked behind: renaming would put the file in the link's place. */
static int hash_of_target(const draft *d, tn_file_hash *hash)
{
    uint8_t *bytes;
    size_t size;
    *hash = (tn_file_hash){""};
    int file = openat(d->folder, d->name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (file < 0)
        return errno == ENOENT ? 0 : errno;
    int reason = read_regular(file, TN_TEXT_MAX, &bytes, &size);
    close(file);
    if (reason != 0)
        return reason;
    *hash = tn_hash_of_bytes(bytes, size);
    free(bytes);
    return 0;
}

/* A new file beside the target, with the target's rights; -1 and errno. */
static int open_beside(draft *d)
{
    struct stat found;
    uint64_t number;
    d->replaces = fstatat(d->folder, d->name, &found, AT_SYMLINK_NOFOLLOW) == 0;
    if (d->replaces && faccessat(d->folder, d->name, W_OK, AT_EACCESS) != 0)
        return -1;
    if (getrandom(&number, sizeof number, 0) != (ssize_t)sizeof number)
        return -1;
    snprintf(d->temporary, sizeof d->temporary, ".tartan-%016llx", (unsigned long long)number);
    int file = openat(d->folder, d->temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file < 0) {
        d->temporary[0] = '\0';
        return -1;
    }
    if (d->replaces)
        (void)!fchmod(file, found.st_mode & 0777); /* on file systems without rights there is nothing to keep */
    return file;
}

static int write_whole(int file, const char *text, size_t size)
{
    while (size > 0) {
        ssize_t wrote = write(file, text, size);
        if (wrote < 0 && errno != EINTR)
            return errno;
        text += wrote > 0 ? wrote : 0;
        size -= wrote > 0 ? (size_t)wrote : 0;
    }
    return fsync(file) == 0 ? 0 : errno;
}

static int put_in_place(draft *d)
{
    if (d->replaces)
        return renameat(d->folder, d->temporary, d->folder, d->name) == 0 ? 0 : errno;
    if (renameat2(d->folder, d->temporary, d->folder, d->name, RENAME_NOREPLACE) == 0)
        return 0;
    if (errno != EINVAL && errno != ENOSYS)
        return errno;
    /* a file system that cannot say whether there was one */
    return renameat(d->folder, d->temporary, d->folder, d->name) == 0 ? 0 : errno;
}

/* 0, or why it is not written. *conflict: what is there is not what was seen. */
static int replace(draft *d, const char *text, size_t size, const tn_file_hash *seen, tn_file_hash *now, bool *conflict)
{
    int reason = hash_of_target(d, now);
    *conflict = reason == 0 && strcmp(now->text, seen->text) != 0;
    if (reason != 0 || *conflict)
        return reason;
    int file = open_beside(d);
    if (file < 0)
        return errno;
    reason = write_whole(file, text, size);
    if (close(file) != 0 && reason == 0)
        reason = errno;
    if (reason == 0) /* once more: writing may have taken long */
        reason = hash_of_target(d, now);
    *conflict = reason == 0 && strcmp(now->text, seen->text) != 0;
    if (reason == 0 && !*conflict)
        reason = put_in_place(d);
    if (reason == EEXIST) { /* made by another program just now */
        reason = hash_of_target(d, now);
        *conflict = true;
    } else if (reason == 0 && !*conflict) {
        d->temporary[0] = '\0';
        (void)!fsync(d->folder);
        *now = tn_hash_of_bytes(text, size);
    }
    return reason;
}

static tn_status unwritten(const char *name, int reason, tn_error *error)
{
    const char *why = reason == EXDEV    ? "its folder lies outside of the folder that is served"
                      : reason == ELOOP  ? "it is a link, which writing would replace"
                      : reason == ENODEV ? "it is no file that holds text"
                      : reason == ENOENT ? "its folder is not there any more"
                                         : NULL;
    return why ? tn_fail(error, TN_IO, E_CANNOT_WRITE, "cannot write %.300s: %s", name, why)
               : tn_cannot_write(name, reason, error);
}

/* The folder that the file is in, opened; -1 and errno. */
static int open_its_folder(const tn_studio_folder *folder, const char *name, size_t length)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%.*s", length ? (int)length : 1, length ? name : ".");
    return open_below(folder, path, O_RDONLY | O_DIRECTORY);
}

tn_status tn_studio_folder_write(tn_studio_folder *folder, const char *name, const char *text, size_t size,
                                 const tn_file_hash *seen, tn_file_hash *now, bool *conflict, tn_error *error)
{
    *conflict = false;
    if (tn_studio_name_check(name, error) != TN_OK)
        return error->status;
    if (folder->read_only)
        return tn_fail(error, TN_IO, E_CANNOT_WRITE, "cannot write %.300s: the folder is served to be read only", name);
    if (size > TN_TEXT_MAX)
        return tn_fail(error, TN_LIMIT, E_FILE_TOO_LARGE, "%.300s would be larger than the limit of %d bytes", name,
                       TN_TEXT_MAX);
    const char *slash = strrchr(name, '/');
    draft d = {.name = slash ? slash + 1 : name};
    d.folder = open_its_folder(folder, name, slash ? (size_t)(slash - name) : 0);
    if (d.folder < 0)
        return unwritten(name, errno, error);
    pthread_mutex_lock(&folder->writing);
    int reason = replace(&d, text, size, seen, now, conflict);
    pthread_mutex_unlock(&folder->writing);
    if (d.temporary[0])
        unlinkat(d.folder, d.temporary, 0);
    close(d.folder);
    return reason != 0 ? unwritten(name, reason, error) : TN_OK;
}
