/* Serves an exchange on a pair of streams. */
#include "lsp/serve.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <poll.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "lsp/exchange.h"
#include "lsp/review.h"
#include "runtime/base/array.h"

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

typedef enum wire_result { TN_WIRE_MESSAGE, TN_WIRE_MALFORMED, TN_WIRE_END } wire_result;

typedef enum wire_event { TN_WIRE_INPUT, TN_WIRE_WOKEN, TN_WIRE_TIME } wire_event;

/* ---- messages on the wire: a header that says how long, then JSON (Base Protocol) */

enum {
    CHUNK = 65536,
    HEADER_MAX = 8192,
    LENGTH_MAX = 1 << 30, /* a message that is said to be longer is taken for a damaged header */
};

/* More bytes from the input; false at its end. */
static bool fill(tn_wire *wire)
{
    if (wire->begin > 0) {
        memmove(wire->buffer, wire->buffer + wire->begin, wire->end - wire->begin);
        wire->end -= wire->begin;
        wire->begin = 0;
    }
    if (!tn_array_reserve(&wire->buffer, &wire->capacity, wire->end, CHUNK, 1)) {
        wire->failed = true;
        return false;
    }
    ssize_t got;
    do
        got = read(wire->input, wire->buffer + wire->end, wire->capacity - wire->end);
    while (got < 0 && errno == EINTR);
    if (got <= 0)
        return false;
    wire->end += (size_t)got;
    return true;
}

static const char length_name[] = "content-length:";
enum { LENGTH_NAME = sizeof length_name - 1 };

/* The decimal number behind a header's name; false where it is none, or one that no message has. */
static bool read_length(const char *text, const char *end, size_t *length)
{
    while (text < end && (*text == ' ' || *text == '\t'))
        text++;
    const char *first = text;
    for (*length = 0; text < end && *text >= '0' && *text <= '9' && *length <= LENGTH_MAX; text++)
        *length = *length * 10 + (size_t)(*text - '0');
    while (text < end && (*text == ' ' || *text == '\t' || *text == '\r'))
        text++;
    return text > first && text == end && *first >= '0' && *first <= '9' && *length <= LENGTH_MAX;
}

/* The value of Content-Length in a header of lines; false where it has none that can be used. */
static bool content_length(const char *header, size_t size, size_t *length)
{
    for (const char *line = header; line < header + size;) {
        const char *end = memchr(line, '\n', (size_t)(header + size - line));
        end = end ? end : header + size;
        if (end - line > LENGTH_NAME && strncasecmp(line, length_name, LENGTH_NAME) == 0)
            return read_length(line + LENGTH_NAME, end, length);
        line = end + 1;
    }
    return false;
}

/* The bytes of the header with the empty line after it; 0 where that has not come yet. */
static size_t header_size(const char *text, size_t size)
{
    for (size_t i = 0; i + 1 < size; i++) {
        if (text[i] == '\n' && text[i + 1] == '\n')
            return i + 2;
        if (i + 3 < size && memcmp(text + i, "\r\n\r\n", 4) == 0)
            return i + 4;
    }
    return 0;
}

/* Leaves out so many bytes of the input. */
static bool skip(tn_wire *wire, size_t size)
{
    while (size > wire->end - wire->begin) {
        size -= wire->end - wire->begin;
        wire->begin = wire->end = 0;
        if (!fill(wire))
            return false;
    }
    wire->begin += size;
    return true;
}

/* After a header that says nothing of where its message ends: leaves out what comes before the next header. */
static bool find_header(tn_wire *wire)
{
    for (;;) {
        const char *text = wire->buffer + wire->begin;
        size_t size = wire->end - wire->begin, at = 0;
        while (at + LENGTH_NAME <= size && strncasecmp(text + at, length_name, LENGTH_NAME) != 0)
            at++;
        wire->begin += at;
        if (at + LENGTH_NAME <= size)
            return true;
        if (!fill(wire))
            return false;
    }
}

static wire_result malformed(tn_wire *wire, const char *problem, bool lost)
{
    wire->problem = problem;
    wire->lost = lost;
    return TN_WIRE_MALFORMED;
}

/* Waits for the next message, which the caller releases. TN_WIRE_MALFORMED: it was left out, and wire->problem says
 * why; where a header could not be read, everything up to the next header is left out. */
static wire_result wire_read(tn_wire *wire, json_t **message)
{
    size_t header, length = 0;
    *message = NULL;
    if (!wire->buffer && !fill(wire))
        return TN_WIRE_END;
    if (wire->lost && !find_header(wire))
        return TN_WIRE_END;
    wire->lost = false;
    while ((header = header_size(wire->buffer + wire->begin, wire->end - wire->begin)) == 0) {
        if (wire->end - wire->begin > HEADER_MAX) {
            wire->begin += LENGTH_NAME; /* so that this very header is not found again */
            return malformed(wire, "the header of a message is longer than 8192 bytes", true);
        }
        if (!fill(wire))
            return TN_WIRE_END;
    }
    bool known = content_length(wire->buffer + wire->begin, header, &length);
    wire->begin += known ? header : LENGTH_NAME < header ? LENGTH_NAME : header;
    if (!known)
        return malformed(wire, "the header of a message has no Content-Length from 0 to 1073741824", true);
    if (length > TN_WIRE_BYTES_MAX)
        return skip(wire, length) ? malformed(wire, "a message is longer than 67108864 bytes and was left out", false)
                                  : TN_WIRE_END;
    while (wire->end - wire->begin < length)
        if (!fill(wire))
            return TN_WIRE_END;
    *message = json_loadb(wire->buffer + wire->begin, length, JSON_ALLOW_NUL, NULL);
    wire->begin += length;
    return *message ? TN_WIRE_MESSAGE : malformed(wire, "a message is not JSON", false);
}

/* Waits for input (also its end), for the file `wake` to be readable, or for so many milliseconds (-1: for ever),
 * whichever is first. */
static wire_event wire_wait(const tn_wire *wire, int wake, int milliseconds)
{
    struct pollfd files[2] = {{.fd = wire->input, .events = POLLIN}, {.fd = wake, .events = POLLIN}};
    int ready;
    if (wire->end > wire->begin)
        return TN_WIRE_INPUT;
#ifdef __EMSCRIPTEN__
    if (milliseconds == 0)
        return TN_WIRE_TIME; /* Node does not say whether there is input: what can be done is done before it is waited
                                for */
#endif
    do
        ready = poll(files, 2, milliseconds);
    while (ready < 0 && errno == EINTR);
    if (ready < 0 || files[0].revents)
        return TN_WIRE_INPUT;
    return ready > 0 ? TN_WIRE_WOKEN : TN_WIRE_TIME;
}

/* Sends a message and releases it; NULL (out of memory) is a failure. */
static void wire_send(tn_wire *wire, json_t *message)
{
    char *text = message ? json_dumps(message, JSON_COMPACT | JSON_ENSURE_ASCII) : NULL;
    json_decref(message);
    if (!text) {
        wire->failed = true;
        return;
    }
    fprintf(wire->output, "Content-Length: %zu\r\n\r\n%s", strlen(text), text);
    free(text);
    if (fflush(wire->output) != 0)
        wire->failed = true;
}

static void wire_clear(tn_wire *wire)
{
    free(wire->buffer);
    wire->buffer = NULL;
}

/* ---- serving */

#define REVIEW_SECONDS 60.0 /* after which rules are looked at no longer */

typedef struct server {
    tn_wire wire;
    tn_exchange *exchange;
    tn_background *background; /* at work on a review, or NULL */
    int wake[2];               /* the pipe by which it says that it is done: a byte each time */
    bool ended;                /* there is no more input */
} server;

/* ---- the background */

/* On the thread of the review. */
static void wake(void *context)
{
    const server *s = context;
    (void)!write(s->wake[1], "", 1);
}

static void end_background(server *s)
{
    tn_review *review = tn_background_join(s->background);
    s->background = NULL;
    tn_exchange_reviewed(s->exchange, review);
}

static void take_background(server *s)
{
    char said;
    (void)!read(s->wake[0], &said, 1);
    if (s->background && tn_background_ended(s->background))
        end_background(s);
}

static void begin_background(server *s)
{
    tn_review *review = tn_exchange_review(s->exchange);
    if (!review)
        return;
    s->background = tn_background_start(review, REVIEW_SECONDS, wake, s);
    if (!s->background) {
        tn_review_cancel(review);
        tn_exchange_reviewed(s->exchange, review);
    }
}

/* ---- the loop */

static void take_message(server *s)
{
    json_t *message;
    wire_result result = wire_read(&s->wire, &message);
    if (result == TN_WIRE_END) {
        s->ended = true;
    } else if (result == TN_WIRE_MALFORMED) {
        tn_exchange_malformed(s->exchange, s->wire.problem);
    } else {
        tn_exchange_take(s->exchange, message);
        json_decref(message);
    }
}

static void send_all(server *s)
{
    for (json_t *message; (message = tn_exchange_next(s->exchange));)
        wire_send(&s->wire, message);
}

/* What comes next; what is to be done while nothing comes is done before it is waited for. */
static wire_event wait(server *s)
{
    wire_event event = wire_wait(&s->wire, s->wake[0], 0);
    if (event != TN_WIRE_TIME)
        return event;
    tn_exchange_work(s->exchange);
    begin_background(s);
    send_all(s);
    return wire_wait(&s->wire, s->wake[0], tn_exchange_patience(s->exchange));
}

static void loop(server *s)
{
    while (!s->ended && !tn_exchange_ended(s->exchange) && !tn_exchange_failed(s->exchange) && !s->wire.failed) {
        wire_event event = wait(s);
        if (event == TN_WIRE_INPUT)
            take_message(s);
        else if (event == TN_WIRE_WOKEN)
            take_background(s);
        send_all(s);
    }
    tn_exchange_cancel(s->exchange);
    if (s->background)
        end_background(s);
}

static tn_status how_it_ended(const server *s, tn_error *error)
{
    if (tn_exchange_failed(s->exchange))
        return tn_fail_memory(error);
    if (s->wire.failed)
        return ferror(s->wire.output)
                   ? tn_fail(error, TN_IO, E_CANNOT_WRITE, "the client does not read what it is sent")
                   : tn_fail_memory(error);
    if (!tn_exchange_shut_down(s->exchange))
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the client went away without `shutdown`");
    return TN_OK;
}

tn_status tn_lsp_serve(int input, FILE *output, tn_error *error)
{
    server s = {.wire = {.input = input, .output = output}};
    if (pipe2(s.wake, O_CLOEXEC | O_NONBLOCK) != 0)
        return tn_fail_memory(error);
    tn_status status = tn_exchange_new(NULL, &s.exchange, error);
    if (status == TN_OK) {
        loop(&s);
        status = how_it_ended(&s, error);
    }
    tn_exchange_free(s.exchange);
    wire_clear(&s.wire);
    close(s.wake[0]);
    close(s.wake[1]);
    return status;
}
