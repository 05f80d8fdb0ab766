/* How Parquet writes numbers that are many and small: in runs and packed bits (RLE), and as differences (DELTA). */
#ifndef TARTAN_DRIVER_PARQUET_ENCODING_H
#define TARTAN_DRIVER_PARQUET_ENCODING_H

#include "driver/parquet/thrift.h"

enum { TN_DELTA_BLOCK = 128 }; /* differences of a block that we write: the fewest that the format allows */

/* ---- writing: where memory runs out, out->failed is set */

/* A run of `count` times the value, in `width` bits. */
void tn_run_write(tn_buffer *out, unsigned width, uint32_t value, size_t count);

/* Numbers of one byte each, as one run where they are equal. tn_bytes_begin gives the place to write them to, at the
 * end of `out` (NULL: out of memory); `begin` is the size that `out` had before. */
uint8_t *tn_bytes_begin(tn_buffer *out, size_t count);
void tn_bytes_end(tn_buffer *out, size_t begin, size_t count);

/* Numbers of 16 bits each, in the same way. */
void tn_shorts_write(tn_buffer *out, const uint16_t *values, size_t count);

/* Bits, of which the first is the lowest of the first byte. What follows `count` of them in the last byte is 0. */
void tn_bits_write(tn_buffer *out, const uint8_t *bits, size_t count);

/* Differences, in blocks of 128, of numbers that come one by one. Zero it to begin with, free blocks.data with free().
 */
typedef struct tn_delta_writer {
    tn_buffer blocks;
    int64_t first, last; /* numbers */
    uint64_t differences[TN_DELTA_BLOCK];
    size_t count, in_block; /* numbers; differences of the block in hand */
} tn_delta_writer;

/* False where out of memory. */
bool tn_delta_add(tn_delta_writer *writer, int64_t value);

/* Appends the numbers to `out`, and begins again with none. */
void tn_delta_end(tn_delta_writer *writer, tn_buffer *out);

/* ---- reading. Both give false where the bytes end too soon or cannot be. They borrow the bytes. */

/* Runs and packed bits. */
typedef struct tn_runs {
    tn_thrift_in in;
    unsigned width; /* bits of a number: 0 to 32 */
    uint64_t left;  /* of the run in hand */
    bool packed;    /* is that one of packed bits? */
    uint32_t value; /* otherwise: the run's */
    uint64_t bit;   /* where in `bytes` the next packed number begins */
    const uint8_t *bytes;
} tn_runs;

void tn_runs_begin(tn_runs *runs, unsigned width, const uint8_t *bytes, size_t size);
bool tn_runs_refill(tn_runs *runs); /* the next run, where none is left of this one */
uint32_t tn_runs_packed(tn_runs *runs);

static inline bool tn_runs_next(tn_runs *runs, uint32_t *value)
{
    if (runs->left == 0 && !tn_runs_refill(runs))
        return false;
    runs->left--;
    if (!runs->packed)
        *value = runs->value;
    else if (runs->width == 8) /* these two widths are by far the most frequent */
        *value = runs->bytes[runs->bit / 8], runs->bit += 8;
    else if (runs->width == 1)
        *value = runs->bytes[runs->bit / 8] >> runs->bit % 8 & 1, runs->bit++;
    else
        *value = tn_runs_packed(runs);
    return true;
}

/* Differences. */
typedef struct tn_deltas {
    tn_thrift_in in;
    uint64_t total; /* numbers that are left */
    uint64_t block, parts;
    uint64_t last; /* the number given last; sums go round at 64 bits */
    bool first;
    uint64_t least;        /* of the differences of the block */
    const uint8_t *widths; /* of its parts */
    uint64_t part, left;   /* the part in hand, and what is left of it */
    const uint8_t *bytes;  /* its bits */
    uint64_t bit;
} tn_deltas;

bool tn_deltas_begin(tn_deltas *deltas, const uint8_t *bytes, size_t size);
bool tn_deltas_next(tn_deltas *deltas, int64_t *value);

#endif
