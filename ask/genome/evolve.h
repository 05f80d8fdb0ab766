/* A run of the study that is open: put together, begun or gone on with, for questions that breed. */
#ifndef TARTAN_ASK_GENOME_EVOLVE_H
#define TARTAN_ASK_GENOME_EVOLVE_H

#include "ask/session/made.h"
#include "driver/breed/evolve.h"

typedef struct tn_evolving {
    tn_session *session;
    const tn_run_asked *asked; /* borrowed */
    tn_watch *watch;           /* borrowed, or NULL: breeding gives up (TN_STOPPED) once this says so */
    bool remembers;            /* whoever was born can be chosen as a parent later */
    tn_evolution_job job;
    tn_run run;
    uint32_t generations; /* to be bred, after the first */
} tn_evolving;

/* Makes the run of the study that is open, as far as it was made before. What is wrong is said. With several ranks,
 * together. Zero it before, but for its first four members; clear it in any case, before the file is closed. */
tn_status tn_evolving_begin(tn_evolving *evolving);
void tn_evolving_clear(tn_evolving *evolving);

/* Does what is asked of a run go together? What does not is said; for before the study is opened. */
tn_status tn_run_asked_check(tn_session *session, const tn_run_asked *asked);

/* Warns of what the first generation shows, once it was made here. */
void tn_evolving_warn(const tn_evolving *evolving);

/* ---- as answers have them */

tn_status tn_individual_put(const tn_individual *individual, tn_individual_told *to, tn_error *error);

/* Files of a run without a folder go into the answer: `files` is what tn_run_results and the like take, or NULL if they
 * go into the folder. */
typedef struct tn_run_making {
    tn_session *session;
    tn_list *list; /* of the answer's files */
    tn_making making;
    tn_run_files taker;
    const tn_run_files *files;
} tn_run_making;

void tn_run_making_begin(tn_run_making *making, const tn_evolving *evolving, tn_list *list);

#endif
