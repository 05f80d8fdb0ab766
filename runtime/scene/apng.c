/* Writes animated PNG (W3C PNG, third edition): the chunks of the frames, numbered, with what says how long each is
 * shown. */
#include "runtime/scene/apng.h"

#include <stdint.h>
#include <string.h>
#include <zlib.h>

enum { SIGNATURE = 8, HEAD = 8, TAIL = 4, SIZES = 8, THOUSANDTHS = 1000 };

typedef struct writer {
    FILE *out;
    uint32_t sequence; /* of chunks about frames */
    bool fine;
} writer;

static void put_number(unsigned char *to, uint32_t number)
{
    for (int i = 0; i < 4; i++)
        to[i] = (unsigned char)(number >> (24 - 8 * i));
}

static uint32_t number_at(const unsigned char *from)
{
    return (uint32_t)from[0] << 24 | (uint32_t)from[1] << 16 | (uint32_t)from[2] << 8 | from[3];
}

static void write_bytes(writer *w, const void *bytes, size_t size)
{
    if (size > 0) /* nothing is written from nowhere */
        w->fine = w->fine && fwrite(bytes, 1, size, w->out) == size;
}

/* A chunk whose data are in two parts. */
static void write_chunk(writer *w, const char *name, const unsigned char *first, uint32_t first_size,
                        const unsigned char *rest, uint32_t rest_size)
{
    unsigned char head[HEAD], tail[TAIL];
    put_number(head, first_size + rest_size);
    memcpy(head + 4, name, 4);
    uLong sum = crc32(0, head + 4, 4);
    if (first_size)
        sum = crc32(sum, first, first_size);
    if (rest_size)
        sum = crc32(sum, rest, rest_size);
    put_number(tail, (uint32_t)sum);
    write_bytes(w, head, HEAD);
    write_bytes(w, first, first_size);
    write_bytes(w, rest, rest_size);
    write_bytes(w, tail, TAIL);
}

/* How large the frame is and how long it is shown. `head` is the data of its chunk IHDR. */
static void write_control(writer *w, const unsigned char *head, unsigned delay)
{
    unsigned char control[26] = {0};
    put_number(control, w->sequence++);
    memcpy(control + 4, head, SIZES);
    control[20] = (unsigned char)(delay >> 8);
    control[21] = (unsigned char)delay;
    control[22] = THOUSANDTHS >> 8;
    control[23] = THOUSANDTHS & 255;
    write_chunk(w, "fcTL", control, sizeof control, NULL, 0);
}

/* The first frame's data are those of the picture itself, for viewers that know no others. */
static void write_frame(writer *w, const tn_picture *frame, size_t count, bool first, unsigned delay)
{
    const unsigned char *bytes = (const unsigned char *)frame->element;
    for (size_t at = SIGNATURE; at + HEAD + TAIL <= frame->size;) {
        const unsigned char *chunk = bytes + at, *data = chunk + HEAD;
        uint32_t size = number_at(chunk);
        if (memcmp(chunk + 4, "IHDR", 4) == 0) {
            unsigned char number[8] = {0};
            put_number(number, (uint32_t)count);
            if (first)
                write_bytes(w, bytes, SIGNATURE + HEAD + size + TAIL);
            if (first)
                write_chunk(w, "acTL", number, sizeof number, NULL, 0);
            write_control(w, data, delay);
        } else if (memcmp(chunk + 4, "IDAT", 4) == 0 && first) {
            write_bytes(w, chunk, HEAD + (size_t)size + TAIL);
        } else if (memcmp(chunk + 4, "IDAT", 4) == 0) {
            unsigned char sequence[4];
            put_number(sequence, w->sequence++);
            write_chunk(w, "fdAT", sequence, sizeof sequence, data, size);
        }
        at += HEAD + (size_t)size + TAIL;
    }
}

tn_status tn_apng_write(const tn_picture *frames, size_t count, unsigned delay, FILE *out, tn_error *error)
{
    writer w = {.out = out, .fine = true};
    for (size_t i = 0; i < count && w.fine; i++)
        write_frame(&w, &frames[i], count, i == 0, delay);
    write_chunk(&w, "IEND", NULL, 0, NULL, 0);
    return w.fine ? TN_OK : tn_fail(error, TN_IO, E_CANNOT_WRITE, "the moving picture cannot be written");
}
