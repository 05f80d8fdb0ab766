/* Writes animated PNG (W3C PNG, third edition): the chunks of the frames, numbered, with what says how long each is
 * shown. */
#include "runtime/scene/apng.h"

#include <stdint.h>
#include <string.h>

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

/* The sum of a chunk (CRC-32 of ISO/IEC 15948, annex D) goes on over more bytes, by half a byte at a time. It begins
 * with all bits set, and is written with all of them turned. */
static uint32_t sum_on(uint32_t sum, const unsigned char *bytes, size_t size)
{
    static const uint32_t remainders[16] = {
        0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4, 0x4db26158, 0x5005713c,
        0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c, 0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c,
    };
    for (size_t i = 0; i < size; i++) {
        sum ^= bytes[i];
        sum = sum >> 4 ^ remainders[sum & 15];
        sum = sum >> 4 ^ remainders[sum & 15];
    }
    return sum;
}

/* A chunk whose data are in two parts. */
static void write_chunk(writer *w, const char *name, const unsigned char *first, uint32_t first_size,
                        const unsigned char *rest, uint32_t rest_size)
{
    unsigned char head[HEAD], tail[TAIL];
    put_number(head, first_size + rest_size);
    memcpy(head + 4, name, 4);
    uint32_t sum = sum_on(UINT32_MAX, head + 4, 4);
    sum = sum_on(sum, first, first_size);
    sum = sum_on(sum, rest, rest_size);
    put_number(tail, ~sum);
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
