/* Words the errors of files. */
#include "runtime/base/file_error.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A row a reason that users meet; for others the system's own words have to do. */
typedef struct file_reason {
    int number;
    const char *what; /* after "cannot read NAME: " */
    const char *help;
} file_reason;

static const file_reason read_reasons[] = {
    {ENOENT, "there is no such file", "check its name and folder"},
    {ENOTDIR, "a part of its path is a file, not a folder", "check its name and folder"},
    {EISDIR, "it is a folder", "name a file in it"},
    {EACCES, "you have no right to read it", "ask its owner for that, or name another file"},
};

static const file_reason write_reasons[] = {
    {ENOENT, "its folder is not there", "make the folder first, or name another"},
    {ENOTDIR, "a part of its path is a file, not a folder", "name another folder"},
    {EISDIR, "it is a folder", "name a file in it"},
    {EEXIST, "there is a file of that name", "choose another name"},
    {EACCES, "you have no right to write there", "name another folder"},
    {EPERM, "you have no right to write there", "name another folder"},
    {EROFS, "that disk can only be read", "name a folder on another"},
    {ENOSPC, "the disk is full", "make room on it, or name a folder on another"},
    {EFBIG, "the file would be larger than is allowed", "raise the limit of the shell, `ulimit -f`, or write less"},
    {EDQUOT, "your share of the disk is used up", "make room on it, or name a folder on another"},
    {ENAMETOOLONG, "the name is too long", "choose a shorter one"},
    {EBADF, "it is closed", "leave it open, or name a file with -o"},
};

static tn_status refuse(const char *cannot, const char *path, uint32_t code, int number, const file_reason *known,
                        size_t known_count, tn_error *error)
{
    for (size_t i = 0; i < known_count; i++) {
        if (known[i].number != number)
            continue;
        tn_fail(error, TN_IO, code, "cannot %s %.300s: %s", cannot, path, known[i].what);
        tn_error_help(error, "%s", known[i].help);
        return TN_IO;
    }
    return tn_fail(error, TN_IO, code, "cannot %s %.300s: %s", cannot, path, strerror(number));
}

tn_status tn_cannot_read(const char *path, int reason, tn_error *error)
{
    tn_status status =
        refuse("read", path, E_CANNOT_READ, reason, read_reasons, sizeof read_reasons / sizeof *read_reasons, error);
    if (reason == ENOENT && strchr(path, '|'))
        tn_error_help(error, "the file comes first: this looks like a plan");
    return status;
}

/* Is the folder there that a file or folder of this name would be in? */
static bool has_folder(const char *path)
{
    size_t length = strlen(path);
    while (length > 0 && path[length - 1] == '/')
        length--;
    while (length > 0 && path[length - 1] != '/')
        length--;
    struct stat found;
    char *folder = length ? strndup(path, length) : strdup(".");
    bool there = folder && stat(folder, &found) == 0 && S_ISDIR(found.st_mode);
    free(folder);
    return there;
}

/* A folder that is there can refuse new files as if it were not, as /proc does. */
static tn_status refused_by_folder(const char *cannot, const char *path, tn_error *error)
{
    tn_fail(error, TN_IO, E_CANNOT_WRITE, "cannot %s %.300s: its folder is there, but nothing can be made in it (%s)",
            cannot, path, strerror(ENOENT));
    tn_error_help(error, "name another folder");
    return TN_IO;
}

static tn_status unwritten(const char *cannot, const char *path, int reason, tn_error *error)
{
    if (reason == ENOENT && has_folder(path))
        return refused_by_folder(cannot, path, error);
    return refuse(cannot, path, E_CANNOT_WRITE, reason ? reason : EIO, write_reasons,
                  sizeof write_reasons / sizeof *write_reasons, error);
}

tn_status tn_cannot_write(const char *path, int reason, tn_error *error)
{
    if (reason == ENOMEM)
        return tn_fail_memory(error);
    if (reason == EPIPE)
        return tn_fail(error, TN_IO, E_CLOSED_PIPE, "the reader of %.300s went away", path);
    return unwritten("write", path, reason, error);
}

tn_status tn_cannot_make(const char *path, int reason, tn_error *error)
{
    return unwritten("make the folder", path, reason, error);
}
