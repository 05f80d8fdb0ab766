/* Messages on the wire: a header that says how long, then JSON (Base Protocol). Owns its buffer. */
#ifndef TARTAN_LSP_WIRE_H
#define TARTAN_LSP_WIRE_H

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

#define TN_WIRE_BYTES_MAX (64u << 20) /* of one message; longer ones are skipped */

typedef struct tn_wire {
    int input;
    FILE *output;
    char *buffer;
    size_t begin, end, capacity; /* unread bytes are [begin, end) */
    bool failed;                 /* out of memory, or the output cannot be written */
    const char *problem;         /* why the last message was malformed, in words */
    bool lost;                   /* the last header did not say where its message ends */
} tn_wire;

typedef enum tn_wire_result { TN_WIRE_MESSAGE, TN_WIRE_MALFORMED, TN_WIRE_END } tn_wire_result;

/* Waits for the next message, which the caller releases. TN_WIRE_MALFORMED: it was left out, and wire->problem says
 * why; where a header could not be read, everything up to the next header is left out. */
tn_wire_result tn_wire_read(tn_wire *wire, json_t **message);

typedef enum tn_wire_event { TN_WIRE_INPUT, TN_WIRE_WOKEN, TN_WIRE_TIME } tn_wire_event;

/* Waits for input (also its end), for the file `wake` to be readable, or for so many milliseconds (-1: for ever),
 * whichever is first. */
tn_wire_event tn_wire_wait(const tn_wire *wire, int wake, int milliseconds);

/* Sends a message and releases it; NULL (out of memory) is a failure. */
void tn_wire_send(tn_wire *wire, json_t *message);

void tn_wire_clear(tn_wire *wire);

#endif
