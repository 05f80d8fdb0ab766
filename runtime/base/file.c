/* Whole files in, whole files out, and what is said of those that could not be read or written. */
#include "runtime/base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "runtime/base/array.h"

/* ==== words the errors of files */

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

/* ==== reads files, and writes them beside their target before they are renamed */

/* ---- reading */

static tn_status too_large(const char *path, size_t limit, tn_error *error)
{
    return tn_fail(error, TN_LIMIT, E_FILE_TOO_LARGE, "%s is larger than the limit of %zu bytes", path, limit);
}

/* Reads to the end of the file, doubling the memory as it goes: sizes that the system reports are not to be trusted for
 * pipes and devices. */
static tn_status read_all(int file, const char *path, size_t limit, uint8_t **bytes, size_t *size, tn_error *error)
{
    size_t capacity = 0, used = 0;
    uint8_t *memory = NULL;
    tn_file_state before = tn_file_state_of(file);
    while (tn_array_reserve_from(&memory, &capacity, 65536, used, 2, 1)) {
        ssize_t got = read(file, memory + used, capacity - used - 1);
        if (got < 0 && errno == EINTR)
            continue;
        if (got == 0) {
            memory[used] = 0;
            *bytes = memory;
            *size = used;
            break;
        }
        if (got < 0) {
            int reason = errno;
            free(memory);
            return tn_cannot_read(path, reason, error);
        }
        used += (size_t)got;
        if (used > limit) {
            free(memory);
            return too_large(path, limit, error);
        }
    }
    tn_status status = *bytes ? tn_file_state_same(&before, file, path, error) : tn_fail_memory(error);
    if (status == TN_OK)
        return TN_OK;
    free(memory);
    *bytes = NULL;
    *size = 0;
    return status;
}

int tn_file_open(const char *path)
{
    int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    struct stat known;
    if (file < 0)
        return -1;
    struct pollfd pipe = {.fd = file, .events = POLLIN};
    if (fstat(file, &known) == 0 && S_ISFIFO(known.st_mode))
        while (poll(&pipe, 1, -1) < 0 && errno == EINTR)
            ;
    fcntl(file, F_SETFL, fcntl(file, F_GETFL) & ~O_NONBLOCK);
    return file;
}

FILE *tn_file_stream(const char *path)
{
    int file = tn_file_open(path);
    return file < 0 ? NULL : fdopen(file, "r");
}

tn_status tn_file_read(const char *path, size_t limit, uint8_t **bytes, size_t *size, tn_error *error)
{
    *bytes = NULL;
    *size = 0;
    if (strcmp(path, "-") == 0)
        return read_all(STDIN_FILENO, "standard input", limit, bytes, size, error);
    int file = tn_file_open(path);
    if (file < 0)
        return tn_cannot_read(path, errno, error);
    tn_status status = read_all(file, path, limit, bytes, size, error);
    close(file);
    return status;
}

/* ---- writing */

tn_status tn_folder_make(const char *path, tn_error *error)
{
    struct stat known;
    if (mkdir(path, 0777) == 0)
        return TN_OK;
    int reason = errno;
    if (reason == EEXIST && stat(path, &known) == 0 && S_ISDIR(known.st_mode))
        return TN_OK;
    return tn_cannot_make(path, reason, error);
}

static const char *shown(const tn_output *output)
{
    return strcmp(output->path, "-") == 0 ? "standard output" : output->path;
}

/* Opens the folder that `target` is in; -1 where that cannot be. */
static int open_folder(const char *target, int flags)
{
    char *folder = strdup(target);
    if (!folder)
        return -1;
    char *slash = strrchr(folder, '/');
    if (slash)
        slash[slash == folder] = '\0';
    int file = open(slash ? folder : ".", flags | O_CLOEXEC, 0666);
    free(folder);
    return file;
}

/* What the system calls the open file, so that it can be given a name: "/proc/self/fd/4". */
typedef struct file_link {
    char path[40];
} file_link;

static const char *link_of(int file, file_link *link)
{
    snprintf(link->path, sizeof link->path, "/proc/self/fd/%d", file);
    return link->path;
}

/* Gives a name in the target's folder to an open file that has none, or (file < 0) makes one of that name:
 * ".tartan-4711-0.tmp". Returns what was done, or -1. */
static int take_name(tn_output *output, int file)
{
    const char *slash = strrchr(output->target, '/');
    int folder = slash ? (int)(slash + 1 - output->target) : 0;
    file_link link;
    for (unsigned attempt = 0; attempt < 1000; attempt++) {
        if (asprintf(&output->temporary, "%.*s.tartan-%ld-%u.tmp", folder, output->target, (long)getpid(), attempt) <
            0) {
            output->temporary = NULL;
            errno = ENOMEM;
            return -1;
        }
        int done = file >= 0 ? linkat(AT_FDCWD, link_of(file, &link), AT_FDCWD, output->temporary, AT_SYMLINK_FOLLOW)
                             : open(output->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (done >= 0)
            return done;
        int reason = errno;
        free(output->temporary);
        output->temporary = NULL;
        errno = reason;
        if (reason != EEXIST)
            return -1;
    }
    return -1;
}

/* A file of the target's folder without a name: however the program ends, nothing is left of it. -1 where the system
 * has no such files. */
static int open_nameless(const tn_output *output)
{
    int file = open_folder(output->target, O_TMPFILE | O_WRONLY);
    file_link link;
    if (file < 0 || access(link_of(file, &link), F_OK) == 0)
        return file;
    close(file); /* it could not be named afterwards */
    return -1;
}

static int open_beside(tn_output *output, mode_t mode)
{
    int file = open_nameless(output);
    if (file < 0)
        file = take_name(output, -1);
    if (file >= 0 && mode != 0)
        (void)!fchmod(file, mode); /* the target's own, where it was there; failing that, the usual */
    return file;
}

static void forget(tn_output *output)
{
    free(output->temporary);
    free(output->target);
    *output = (tn_output){.path = output->path};
}

/* A file whose bytes are seen. */
typedef struct seen_file {
    int file;
    tn_seen_bytes written;
} seen_file;

static ssize_t write_seen(void *cookie, const char *bytes, size_t size)
{
    const seen_file *seen = cookie;
    size_t done = 0;
    while (done < size) {
        ssize_t got = write(seen->file, bytes + done, size - done);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return 0;
        seen->written.see(seen->written.context, bytes + done, (size_t)got);
        done += (size_t)got;
    }
    return (ssize_t)done;
}

static int close_seen(void *cookie)
{
    seen_file *seen = cookie;
    int result = close(seen->file);
    free(seen);
    return result;
}

/* The stream of an open file; NULL and errno where that cannot be, and then the file is left open. */
static FILE *stream_of(int file, const tn_seen_bytes *written)
{
    if (!written)
        return fdopen(file, "wb");
    const cookie_io_functions_t functions = {.write = write_seen, .close = close_seen};
    seen_file *seen = malloc(sizeof *seen);
    FILE *stream = seen ? fopencookie(seen, "wb", functions) : NULL;
    if (stream) {
        *seen = (seen_file){file, *written};
        return stream;
    }
    free(seen);
    errno = ENOMEM;
    return NULL;
}

tn_status tn_output_open(const char *path, tn_output *output, tn_error *error)
{
    return tn_output_open_seen(path, NULL, output, error);
}

tn_status tn_output_open_seen(const char *path, const tn_seen_bytes *written, tn_output *output, tn_error *error)
{
    *output = (tn_output){.path = path, .file = STDOUT_FILENO};
    if (strcmp(path, "-") == 0) {
        output->stream = stdout;
        return TN_OK;
    }
    /* A link is followed, so that the file it names is replaced and not the link. */
    struct stat known;
    bool exists = lstat(path, &known) == 0, link = exists && S_ISLNK(known.st_mode);
    output->target = link ? realpath(path, NULL) : NULL;
    if (!output->target)
        output->target = strdup(path);
    if (!output->target)
        return tn_fail_memory(error);
    exists = link ? stat(output->target, &known) == 0 : exists;
    int file;
    output->replaces = !exists || S_ISREG(known.st_mode);
    if (!output->replaces) /* a device or a pipe */
        file = open(output->target, O_WRONLY | O_CLOEXEC);
    else if (exists && access(output->target, W_OK) != 0)
        file = -1; /* renaming would get round the protection of a file that may not be written */
    else
        file = open_beside(output, exists ? known.st_mode & 0777 : 0);
    output->file = file;
    output->stream = file < 0 ? NULL : stream_of(file, written);
    if (output->stream)
        return TN_OK;
    int reason = errno;
    if (file >= 0)
        close(file);
    tn_output_discard(output);
    return tn_cannot_write(path, reason, error);
}

/* The rename itself is on the disk only when the folder is. */
static void sync_folder(const char *target)
{
    int file = open_folder(target, O_RDONLY | O_DIRECTORY);
    if (file >= 0) {
        fsync(file);
        close(file);
    }
}

/* Why writing failed some time ago, when only the stream's mark of it is left: what writing one more byte would fail
 * on. */
static int probe(int file)
{
    struct pollfd pipe_end = {.fd = file, .events = POLLOUT};
    if (poll(&pipe_end, 1, 0) == 1 && (pipe_end.revents & POLLERR))
        return EPIPE;
    return write(file, "\n", 1) < 0 ? errno : EIO;
}

/* Flushes what is buffered to the disk; 0, or why that failed. */
static int flush(tn_output *output)
{
    if (ferror(output->stream))
        return probe(output->file);
    errno = 0;
    if (fflush(output->stream) != 0)
        return errno ? errno : EIO;
    if (output->replaces && fsync(output->file) != 0)
        return errno;
    return 0;
}

/* Puts an open file that has no name in the target's place, where nothing is there: at no moment is it known by another
 * name that a killed program would leave behind. Otherwise it gets one, to be renamed from. 0, or why that failed. */
static int name_file(tn_output *output)
{
    file_link link;
    if (!output->replaces || output->temporary)
        return 0;
    if (linkat(AT_FDCWD, link_of(output->file, &link), AT_FDCWD, output->target, AT_SYMLINK_FOLLOW) == 0)
        return 0;
    return errno == EEXIST && take_name(output, output->file) >= 0 ? 0 : errno;
}

tn_status tn_output_commit(tn_output *output, tn_error *error)
{
    int reason = flush(output);
    if (reason == 0)
        reason = name_file(output);
    if (output->stream != stdout) {
        if (fclose(output->stream) != 0 && reason == 0)
            reason = errno;
        output->stream = NULL;
        if (reason == 0 && output->temporary && rename(output->temporary, output->target) != 0)
            reason = errno;
    }
    if (reason != 0) {
        tn_status status = tn_cannot_write(shown(output), reason, error);
        tn_output_discard(output);
        return status;
    }
    if (output->replaces && !output->derived)
        sync_folder(output->target);
    forget(output);
    return TN_OK;
}

void tn_output_discard(tn_output *output)
{
    if (output->stream && output->stream != stdout)
        fclose(output->stream);
    if (output->temporary)
        unlink(output->temporary);
    forget(output);
}

char *tn_file_beside(const char *file, const char *path)
{
    const char *slash = path[0] == '/' ? NULL : strrchr(file, '/');
    size_t folder = slash ? (size_t)(slash - file) + 1 : 0, size = folder + strlen(path) + 1;
    char *joined = malloc(size);
    if (joined)
        snprintf(joined, size, "%.*s%s", (int)folder, file, path);
    return joined;
}
