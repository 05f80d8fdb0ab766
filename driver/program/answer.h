/* What a program that scores answers: a line of JSON with a number, a list of numbers, or an object.
 *
 *   1.5
 *   [1.5, 20]
 *   {"id": 12, "score": [1.5, 20]}
 *   {"id": 12, "error": "it falls over"}
 */
#ifndef TARTAN_DRIVER_PROGRAM_ANSWER_H
#define TARTAN_DRIVER_PROGRAM_ANSWER_H

#include "runtime/genome/breeding/select.h"

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

/* Copies bytes as they can be shown, in at most `room` bytes and its end. */
void tn_clean_copy(char *to, size_t room, const char *text, size_t size);

#endif
