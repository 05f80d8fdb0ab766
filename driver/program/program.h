/* Asks a program for scores: as many processes of it as there are threads, each kept alive and asked line by line.
 *
 * Each thread asks its own process. A process is started when it is first needed, and again after it has ended. A
 * question that is unanswered when a process ends is asked once more, alone, of a new one; then it has failed. So a
 * failure is always that of the question asked.
 */
#ifndef TARTAN_DRIVER_PROGRAM_PROGRAM_H
#define TARTAN_DRIVER_PROGRAM_PROGRAM_H

#include "driver/program/answer.h"
#include "runtime/base/watch.h"

typedef struct tn_program tn_program;

#define TN_PROGRAM_PATIENCE 10u

typedef struct tn_program_options {
    const char *path;    /* the program's whole path */
    unsigned threads;    /* that ask at once */
    unsigned seconds;    /* that an answer may take */
    size_t values;       /* numbers in an answer, 1 to TN_OBJECTIVES_MAX */
    tn_watch *watch;     /* borrowed, or NULL: asking gives up (TN_STOPPED) once this says so */
} tn_program_options;

/* Nothing is started yet but a process that clears up, whatever becomes of this one (keeper.h). TN_IO (E1254) where the
 * file cannot be run. */
tn_status tn_program_new(const tn_program_options *options, tn_program **program, tn_error *error);

/* Ends its processes, and removes its folder. */
void tn_program_free(tn_program *program);

/* A folder for files that the program is told of; it is there as long as the program. */
const char *tn_program_folder(const tn_program *program);
const char *tn_program_path(const tn_program *program);

/* TN_INVALID (E1255): the program scores nothing; `refusal` is what its answer about this individual was. */
tn_status tn_program_useless(const tn_program *program, uint64_t id, const char *refusal, tn_error *error);

typedef struct tn_question {
    uint64_t id;      /* of an individual; no two in one call are the same */
    const char *line; /* ends with '\n' */
    size_t size;
    tn_answer answer; /* set by tn_program_ask */
    unsigned tries;   /* zero to begin with, as are the others */
    bool sent, done;
} tn_question;

/* Answers questions, up to 64. One that fails has the reason in its answer. TN_IO (E1254) where the program cannot be
 * started. TN_INVALID (E1255) where it answers what it was not asked, since then no score of it can be trusted, and
 * where it has answered none of TN_PROGRAM_PATIENCE questions, the first that it was asked. */
tn_status tn_program_ask(tn_program *program, unsigned thread, tn_question *questions, size_t count, tn_error *error);

#endif
