/* Runs of `tartan evolve` that are kept in a folder: what they were started from, and how they went. */
#ifndef TARTAN_RUN_H
#define TARTAN_RUN_H

#include "evolution.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A run, as its database had it when it was opened. It does not change once made, but for tartan_run_text, and belongs
 * to one thread at a time. */
typedef struct tartan_run tartan_run;

/* Opens the database of a run, DIR/run.sqlite, to read it. TARTAN_IO: it cannot be read; TARTAN_INVALID: it is no run.
 */
TARTAN_API tartan_status tartan_run_open(const char *path, tartan_run **run, tartan_error *error);
TARTAN_API void tartan_run_free(tartan_run *run);

/* A text that the run was started from: "study" and "grammar", with their names "study_path" and "grammar_path";
 * "seed", "objectives"; "seeds", its first genomes. *text is NULL where it has none of this name. Free it with
 * tartan_text_free. */
TARTAN_API tartan_status tartan_run_text(tartan_run *run, const char *name, char **text, tartan_error *error);

/* Its generations, from 0 on. Past the end, TARTAN_INVALID. */
TARTAN_API size_t tartan_run_generations(const tartan_run *run);
TARTAN_API size_t tartan_run_objectives(const tartan_run *run);
TARTAN_API tartan_status tartan_run_generation(const tartan_run *run, size_t i, tartan_generation *generation,
                                               tartan_error *error);

/* What a person decided while it ran. */
typedef struct tartan_run_event {
    size_t size;
    uint32_t generation; /* before which it was decided */
    const char *kind;    /* "choose": parents, by their places from 1; "set": another target or weight */
    const char *text;
} tartan_run_event;
TARTAN_SIZED(tartan_run_event)

/* What a person chose or changed on its way: how many events, and the i-th. */
TARTAN_API size_t tartan_run_event_count(const tartan_run *run);
TARTAN_API tartan_status tartan_run_event_at(const tartan_run *run, size_t i, tartan_run_event *event,
                                             tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
