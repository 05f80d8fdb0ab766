/* Shows on a terminal how far long work is. */
#include "cli/common/progress.h"
#include "runtime/base/watch.h"

#include <stdio.h>
#include <unistd.h>

#define SECONDS_BEFORE 0.5 /* short work shows nothing */
#define SECONDS_BETWEEN 0.2

void tn_progress_begin(tn_progress *progress, const char *what, double done, double total)
{
    double time = tn_seconds();
    *progress = (tn_progress){.what = what,
                              .before = done,
                              .total = total,
                              .start = time,
                              .last = time + SECONDS_BEFORE - SECONDS_BETWEEN,
                              .shows = isatty(STDERR_FILENO)};
}

/* Seconds as people say them. */
static void write_time(double seconds, char *text, size_t size)
{
    if (seconds < 100)
        snprintf(text, size, "%.0f s", seconds);
    else if (seconds < 6000)
        snprintf(text, size, "%.0f min", seconds / 60);
    else
        snprintf(text, size, "%.3g h", seconds / 3600);
}

void tn_progress_update(tn_progress *progress, double done)
{
    if (!progress->shows)
        return;
    double time = tn_seconds();
    if (time - progress->last < SECONDS_BETWEEN)
        return;
    progress->last = time;
    progress->shown = true;
    double rate = (done - progress->before) / (time - progress->start);
    fprintf(stderr, "\r\033[K%.0f %s, %.0f/s", done, progress->what, rate);
    if (progress->total > 0 && rate > 0) {
        char left[32];
        write_time((progress->total - done) / rate, left, sizeof left);
        fprintf(stderr, ", %.1f %%, %s left", 100 * done / progress->total, left);
    }
    fflush(stderr);
}

void tn_progress_end(tn_progress *progress)
{
    if (progress->shown)
        fputs("\r\033[K", stderr);
    progress->shown = false;
}

static bool draw(void *context, double done, double total)
{
    tn_progress *progress = context;
    double time = tn_seconds();
    if (time - progress->last < SECONDS_BETWEEN)
        return true;
    progress->last = time;
    progress->shown = true;
    if (total > 0)
        fprintf(stderr, "\r\033[K%s: %.0f of %.0f", progress->what, done, total);
    else
        fprintf(stderr, "\r\033[K%s: %.0f s", progress->what, time - progress->start);
    fflush(stderr);
    return true;
}

void tn_progress_watch(tn_progress *progress, const char *what, tn_watch *watch)
{
    tn_progress_begin(progress, what, 0, 0);
    if (!progress->shows)
        return;
    watch->done = watch->total = 0;
    watch->context = progress;
    watch->caller = pthread_self();
    watch->go_on = draw;
}

void tn_progress_unwatch(tn_progress *progress, tn_watch *watch)
{
    if (progress->shows)
        watch->go_on = NULL;
    tn_progress_end(progress);
}
