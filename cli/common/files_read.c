/* Runs a command again whenever a file that it has read changes. */
#include "cli/common/files_read.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "runtime/base/array.h"
#include "runtime/base/watch.h"

typedef struct tn_file_seen {
    char *path;
    bool there;
    ino_t number;
    off_t size;
    struct timespec changed;
} tn_file_seen;

static tn_file_seen look(const char *path)
{
    struct stat known;
    if (stat(path, &known) != 0)
        return (tn_file_seen){0};
    return (tn_file_seen){.there = true, .number = known.st_ino, .size = known.st_size, .changed = known.st_mtim};
}

static int compare_times(struct timespec a, struct timespec b)
{
    if (a.tv_sec != b.tv_sec)
        return a.tv_sec < b.tv_sec ? -1 : 1;
    return a.tv_nsec < b.tv_nsec ? -1 : a.tv_nsec > b.tv_nsec;
}

static bool same(const tn_file_seen *a, const tn_file_seen *b)
{
    return a->there == b->there && a->number == b->number && a->size == b->size &&
           compare_times(a->changed, b->changed) == 0;
}

void tn_files_read_clear(tn_files_read *read)
{
    for (size_t i = 0; i < read->count; i++)
        free(read->files[i].path);
    free(read->files);
    *read = (tn_files_read){0};
}

void tn_files_read_add(tn_files_read *read, const char *path)
{
    for (size_t i = 0; i < read->count; i++)
        if (strcmp(read->files[i].path, path) == 0)
            return;
    tn_file_seen seen = look(path);
    if (!seen.there)
        return;
    if (!tn_array_reserve(&read->files, &read->capacity, read->count, 1, sizeof *read->files))
        return;
    seen.path = strdup(path);
    if (seen.path)
        read->files[read->count++] = seen;
}

/* One that is away for a moment, while another is put in its place, has not changed yet. */
static const char *changed(const tn_files_read *read)
{
    for (size_t i = 0; i < read->count; i++) {
        tn_file_seen now = look(read->files[i].path);
        if (now.there && !same(&now, &read->files[i]))
            return read->files[i].path;
    }
    return NULL;
}

/* Changed since the run began? What it has read may be of two files then. */
static const char *changed_since(const tn_files_read *read, struct timespec begin)
{
    for (size_t i = 0; i < read->count; i++)
        if (compare_times(read->files[i].changed, begin) >= 0)
            return read->files[i].path;
    return NULL;
}

static void say(const tn_settings *settings, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say(const tn_settings *settings, const char *format, ...)
{
    char text[400];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    tn_job job;
    tn_job_begin(&job, settings);
    tn_job_note(&job, "%s", text);
    tn_job_end(&job);
}

/* The file that changed; NULL: interrupted. */
static const char *wait_for_change(const tn_files_read *read)
{
    const struct timespec pause = {0, 200 * 1000 * 1000};
    const char *path = NULL;
    while (!path && !tn_interrupted()) {
        nanosleep(&pause, NULL);
        path = changed(read);
    }
    return tn_interrupted() ? NULL : path;
}

/* Of standard input there is nothing to watch. */
static int refuse_standard_input(const tn_settings *settings)
{
    tn_job job;
    tn_job_begin(&job, settings);
    tn_job_usage(&job, "--watch is about files, and standard input is none");
    return tn_job_end(&job);
}

int tn_watch_files(const tn_settings *settings, int (*once)(const tn_settings *settings, tn_files_read *read))
{
    tn_files_read read = {0};
    for (size_t i = 0; i < settings->operands.count; i++)
        if (strcmp(settings->operands.items[i], "-") == 0)
            return refuse_standard_input(settings);
    for (;;) {
        struct timespec begin;
        clock_gettime(CLOCK_REALTIME, &begin);
        double start = tn_seconds();
        int exit_code = once(settings, &read);
        double seconds = tn_seconds() - start;
        fflush(stdout);
        for (size_t i = 0; i < settings->operands.count; i++)
            tn_files_read_add(&read, settings->operands.items[i]);
        const char *path = changed_since(&read, begin);
        if (!path && !tn_interrupted() && read.count > 0) {
            say(settings, "%.2f s; waiting for a change of %zu file%s; Ctrl-C ends", seconds, read.count,
                read.count == 1 ? "" : "s");
            path = wait_for_change(&read);
        }
        if (!path) {
            tn_interrupt_answered();
            tn_files_read_clear(&read);
            return exit_code;
        }
        say(settings, "%.300s has changed", path);
        tn_files_read_clear(&read);
    }
}
