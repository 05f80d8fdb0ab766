#include "studio/server/folder.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <linux/openat2.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <xxhash.h>

#include "compiler/compile.h"
#include "runtime/base/array.h"
#include "runtime/base/file.h"
#include "runtime/base/utf8.h"
#include "studio/server/folder_parts.h"

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

int tn_open_below(const tn_studio_folder *folder, const char *name, int flags)
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

int tn_read_regular(int file, size_t limit, uint8_t **bytes, size_t *size)
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
    int file = tn_open_below(folder, name, O_RDONLY);
    int reason = file < 0 ? errno : tn_read_regular(file, limit, bytes, size);
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
    int file = tn_open_below(folder, name, O_PATH);
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
