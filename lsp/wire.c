/* Reads and writes messages of the Base Protocol: a header that says how long, then JSON. */
#include "lsp/wire.h"

#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "runtime/base/array.h"

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

static tn_wire_result malformed(tn_wire *wire, const char *problem, bool lost)
{
    wire->problem = problem;
    wire->lost = lost;
    return TN_WIRE_MALFORMED;
}

tn_wire_result tn_wire_read(tn_wire *wire, json_t **message)
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

tn_wire_event tn_wire_wait(const tn_wire *wire, int wake, int milliseconds)
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

void tn_wire_send(tn_wire *wire, json_t *message)
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

void tn_wire_clear(tn_wire *wire)
{
    free(wire->buffer);
    wire->buffer = NULL;
}
