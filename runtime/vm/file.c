#include "runtime/vm/file.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- reading */

static tn_status cannot_read(const char *path, int reason, tn_error *error)
{
    return tn_fail(error, TN_IO, 901, "cannot read %s: %s", path, strerror(reason));
}

static tn_status too_large(const char *path, size_t limit, tn_error *error)
{
    return tn_fail(error, TN_LIMIT, 804, "%s is larger than the limit of %zu bytes", path, limit);
}

/* Reads to the end of the file, doubling the memory as it goes: sizes that the system reports are not to be trusted for
 * pipes and devices. */
static tn_status read_all(int file, const char *path, size_t limit, uint8_t **bytes, size_t *size, tn_error *error)
{
    size_t capacity = 65536;
    uint8_t *memory = malloc(capacity);
    size_t used = 0;
    while (memory) {
        ssize_t got = read(file, memory + used, capacity - used - 1);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0) {
            if (got == 0)
                break;
            int reason = errno;
            free(memory);
            return cannot_read(path, reason, error);
        }
        used += (size_t)got;
        if (used > limit) {
            free(memory);
            return too_large(path, limit, error);
        }
        if (capacity - used > 1)
            continue;
        uint8_t *larger = capacity <= SIZE_MAX / 2 ? realloc(memory, capacity * 2) : NULL;
        if (!larger)
            free(memory);
        memory = larger;
        capacity *= 2;
    }
    if (!memory)
        return tn_fail_memory(error);
    memory[used] = 0;
    *bytes = memory;
    *size = used;
    return TN_OK;
}

tn_status tn_file_read(const char *path, size_t limit, uint8_t **bytes, size_t *size, tn_error *error)
{
    *bytes = NULL;
    *size = 0;
    if (strcmp(path, "-") == 0)
        return read_all(STDIN_FILENO, "standard input", limit, bytes, size, error);
    int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return cannot_read(path, errno, error);
    tn_status status = read_all(file, path, limit, bytes, size, error);
    close(file);
    return status;
}

/* ---- writing */

static tn_status cannot_write(const char *path, int reason, tn_error *error)
{
    if (reason == ENOMEM)
        return tn_fail_memory(error);
    if (reason == EPIPE)
        return tn_fail(error, TN_IO, 903, "the reader of %s went away", path);
    return tn_fail(error, TN_IO, 902, "cannot write %s: %s", path, strerror(reason ? reason : EIO));
}

static const char *shown(const tn_output *output)
{
    return strcmp(output->path, "-") == 0 ? "standard output" : output->path;
}

/* Makes a file that was not there before, in the target's folder: ".tartan-4711-0.tmp". */
static int open_temporary(tn_output *output, mode_t mode)
{
    const char *slash = strrchr(output->target, '/');
    int folder = slash ? (int)(slash + 1 - output->target) : 0;
    for (unsigned attempt = 0; attempt < 1000; attempt++) {
        if (asprintf(&output->temporary, "%.*s.tartan-%ld-%u.tmp", folder, output->target, (long)getpid(), attempt) <
            0) {
            output->temporary = NULL;
            errno = ENOMEM;
            return -1;
        }
        int file = open(output->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file >= 0) {
            if (mode != 0)
                (void)!fchmod(file, mode); /* the target's own, where it was there; failing that, the usual */
            return file;
        }
        int reason = errno;
        free(output->temporary);
        output->temporary = NULL;
        errno = reason;
        if (reason != EEXIST)
            return -1;
    }
    return -1;
}

static void forget(tn_output *output)
{
    free(output->temporary);
    free(output->target);
    *output = (tn_output){.path = output->path};
}

tn_status tn_output_open(const char *path, tn_output *output, tn_error *error)
{
    *output = (tn_output){.path = path};
    if (strcmp(path, "-") == 0) {
        output->stream = stdout;
        return TN_OK;
    }
    /* A link is followed, so that the file it names is replaced and not the link. */
    output->target = realpath(path, NULL);
    if (!output->target)
        output->target = strdup(path);
    if (!output->target)
        return tn_fail_memory(error);
    struct stat known;
    bool exists = stat(output->target, &known) == 0;
    int file;
    if (exists && !S_ISREG(known.st_mode)) /* a device or a pipe is written to, not replaced */
        file = open(output->target, O_WRONLY | O_CLOEXEC);
    else if (exists && access(output->target, W_OK) != 0)
        file = -1; /* renaming would get round the protection of a file that may not be written */
    else
        file = open_temporary(output, exists ? known.st_mode & 0777 : 0);
    output->stream = file < 0 ? NULL : fdopen(file, "wb");
    if (output->stream)
        return TN_OK;
    int reason = errno;
    if (file >= 0)
        close(file);
    tn_output_discard(output);
    return cannot_write(path, reason, error);
}

/* The rename itself is on the disk only when the folder is. */
static void sync_folder(const char *target)
{
    char *folder = strdup(target);
    if (!folder)
        return;
    char *slash = strrchr(folder, '/');
    if (slash)
        slash[slash == folder] = '\0';
    int file = open(slash ? folder : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file >= 0) {
        fsync(file);
        close(file);
    }
    free(folder);
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

/* Flushes what is buffered; 0, or why that failed. */
static int flush(const tn_output *output)
{
    if (ferror(output->stream))
        return probe(fileno(output->stream));
    errno = 0;
    if (fflush(output->stream) != 0)
        return errno ? errno : EIO;
    if (output->temporary && fsync(fileno(output->stream)) != 0)
        return errno;
    return 0;
}

tn_status tn_output_commit(tn_output *output, tn_error *error)
{
    int reason = flush(output);
    if (output->stream != stdout) {
        if (fclose(output->stream) != 0 && reason == 0)
            reason = errno;
        output->stream = NULL;
        if (reason == 0 && output->temporary && rename(output->temporary, output->target) != 0)
            reason = errno;
    }
    if (reason != 0) {
        tn_status status = cannot_write(shown(output), reason, error);
        tn_output_discard(output);
        return status;
    }
    if (output->temporary)
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
