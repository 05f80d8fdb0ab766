/* Asks a program for scores: as many processes of it as there are threads, each kept alive and asked line by line.
 *
 * Each thread asks its own process. A process is started when it is first needed, and again after it has ended. A
 * question that is unanswered when a process ends is asked once more, alone, of a new one; then it has failed. So a
 * failure is always that of the question asked.
 */
#ifndef TARTAN_DRIVER_PROGRAM_EXTERNAL_H
#define TARTAN_DRIVER_PROGRAM_EXTERNAL_H

#include "runtime/base/watch.h"
#include "runtime/genome/breeding/select.h"

/* What a program that scores answers: a line of JSON with a number, a list of numbers, or an object.
 *
 *   1.5
 *   [1.5, 20]
 *   {"id": 12, "score": [1.5, 20]}
 *   {"id": 12, "error": "it falls over"}
 */

#define TN_REFUSAL_SIZE 200u

typedef struct tn_answer {
    bool understood; /* it has what is wanted, or says why not */
    bool says_id;    /* and which */
    uint64_t id;
    double values[TN_OBJECTIVES_MAX];
    char refusal[TN_REFUSAL_SIZE]; /* a clause about the program, such as "answered `x`, ...": why there are no values;
                                      else empty */
} tn_answer;

/* Reads a line of `size` bytes, from which `count` numbers are wanted. What comes from the line is cleaned. */
void tn_answer_read(const char *line, size_t size, size_t count, tn_answer *answer);

typedef struct tn_external tn_external;

#define TN_EXTERNAL_PATIENCE 10u

typedef struct tn_external_options {
    const char *path; /* the program's whole path */
    unsigned threads; /* that ask at once */
    unsigned seconds; /* that an answer may take */
    size_t values;    /* numbers in an answer, 1 to TN_OBJECTIVES_MAX */
    tn_watch *watch;  /* borrowed, or NULL: asking gives up (TN_STOPPED) once this says so */
} tn_external_options;

/* Nothing is started yet but a process that clears up, whatever becomes of this one (keeper.h). TN_IO (E1254) where the
 * file cannot be run. */
tn_status tn_external_new(const tn_external_options *options, tn_external **program, tn_error *error);

/* Ends its processes, and removes its folder. */
void tn_external_free(tn_external *program);

/* A folder for files that the program is told of; it is there as long as the program. */
const char *tn_external_folder(const tn_external *program);

/* TN_INVALID (E1255): the program scores nothing; `refusal` is what its answer about this individual was, or, with
 * UINT64_MAX, about the last of so many that patience ended. */
tn_status tn_external_useless(const tn_external *program, uint64_t id, const char *refusal, tn_error *error);

typedef struct tn_question {
    uint64_t id;      /* of an individual; no two in one call are the same */
    const char *line; /* ends with '\n' */
    size_t size;
    tn_answer answer; /* set by tn_external_ask */
    unsigned tries;   /* zero to begin with, as are the others */
    bool sent, done;
} tn_question;

/* Answers questions, up to 64. One that fails has the reason in its answer. TN_IO (E1254) where the program cannot be
 * started. TN_INVALID (E1255) where it answers what it was not asked, since then no score of it can be trusted, and
 * where it has answered none of TN_EXTERNAL_PATIENCE questions, the first that it was asked. */
tn_status tn_external_ask(tn_external *program, unsigned thread, tn_question *questions, size_t count, tn_error *error);

#endif
