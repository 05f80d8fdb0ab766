/* Progress of long work, on a terminal's standard error only: how much is done, how fast, how long to go. */
#ifndef TARTAN_CLI_COMMON_PROGRESS_H
#define TARTAN_CLI_COMMON_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

#include "runtime/base/watch.h"

typedef struct tn_progress {
    const char *what;   /* "plans" */
    double before;      /* done before this run began: no part of its rate */
    double total;       /* with what was done before; 0 where it is not known */
    double start, last; /* seconds */
    bool shows, shown;
} tn_progress;

void tn_progress_begin(tn_progress *progress, const char *what, double done, double total);

/* Says how much is done, with what was before; draws a few times a second at most. */
void tn_progress_update(tn_progress *progress, double done);

/* For work that asks a watch whether it may go on, and tells it how far it is: draws "what: 3 of 12", or, where it
 * tells nothing, for how long it has been at work. The watch is this thread's until tn_progress_unwatch, which wipes
 * the line. */
void tn_progress_watch(tn_progress *progress, const char *what, tn_watch *watch);
void tn_progress_unwatch(tn_progress *progress, tn_watch *watch);

/* Wipes the line. */
void tn_progress_end(tn_progress *progress);

#endif
