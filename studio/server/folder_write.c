/* Writes rule files into the served folder. */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include "runtime/base/file.h"
#include "studio/server/folder_parts.h"

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
    int reason = tn_read_regular(file, TN_TEXT_MAX, &bytes, &size);
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
    return tn_open_below(folder, path, O_RDONLY | O_DIRECTORY);
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
