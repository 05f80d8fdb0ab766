/* Writes runs, packed bits and differences. */
#include <string.h>

#include "driver/parquet/encoding.h"

#define BLOCK 128u /* differences in a block, and PART in each of its parts: the fewest that the format allows */
#define PART 32u
#define PARTS (BLOCK / PART)

void tn_run_write(tn_buffer *out, unsigned width, uint32_t value, size_t count)
{
    char bytes[4];
    for (unsigned i = 0; i < sizeof bytes; i++)
        bytes[i] = (char)(value >> 8 * i & 0xff);
    tn_varint_write(out, (uint64_t)count << 1);
    tn_buffer_append(out, bytes, (width + 7) / 8);
}

/* The head of packed numbers, which come in groups of eight. */
static size_t packed_head(tn_buffer *out, size_t count)
{
    size_t groups = (count + 7) / 8;
    tn_varint_write(out, (uint64_t)groups << 1 | 1);
    return groups;
}

/* Bytes that were written already, and zeros up to `size`. */
static void append_padded(tn_buffer *out, const void *bytes, size_t used, size_t size)
{
    static const char zeros[16];
    tn_buffer_append(out, bytes, used);
    tn_buffer_append(out, zeros, size - used);
}

void tn_bytes_write(tn_buffer *out, const uint8_t *values, size_t count)
{
    if (count > 0 && memcmp(values, values + 1, count - 1) == 0)
        tn_run_write(out, 8, values[0], count);
    else
        append_padded(out, values, count, 8 * packed_head(out, count));
}

void tn_shorts_write(tn_buffer *out, const uint16_t *values, size_t count)
{
    if (count > 0 && memcmp(values, values + 1, (count - 1) * sizeof *values) == 0) {
        tn_run_write(out, 16, values[0], count);
        return;
    }
    size_t size = 16 * packed_head(out, count);
    if (!tn_buffer_reserve(out, size))
        return;
    memset(out->data + out->size, 0, size);
    for (size_t i = 0; i < count; i++, out->size += 2) {
        out->data[out->size] = (char)(values[i] & 0xff);
        out->data[out->size + 1] = (char)(values[i] >> 8);
    }
    out->size += size - 2 * count;
}

void tn_bits_write(tn_buffer *out, const uint8_t *bits, size_t count)
{
    size_t groups = packed_head(out, count);
    tn_buffer_append(out, (const char *)bits, groups);
}

/* ---- differences */

static unsigned bits_of(uint64_t value)
{
    return value ? 64 - (unsigned)__builtin_clzll(value) : 0;
}

/* Packs PART numbers of so many bits. */
static void pack_part(tn_buffer *out, const uint64_t *values, unsigned width)
{
    uint8_t bytes[PART * 8] = {0};
    uint64_t bit = 0;
    for (unsigned i = 0; i < PART; i++)
        for (unsigned b = 0; b < width; b++, bit++)
            bytes[bit / 8] |= (uint8_t)((values[i] >> b & 1) << bit % 8);
    tn_buffer_append(out, (const char *)bytes, PART * width / 8);
}

/* The differences in front of values[1..count], which are at most BLOCK. */
static void write_block(tn_buffer *out, const int64_t *values, size_t count)
{
    uint64_t differences[BLOCK] = {0};
    int64_t least = INT64_MAX;
    for (size_t i = 0; i < count; i++) {
        differences[i] = (uint64_t)values[i + 1] - (uint64_t)values[i];
        least = (int64_t)differences[i] < least ? (int64_t)differences[i] : least;
    }
    uint8_t widths[PARTS] = {0};
    for (size_t i = 0; i < count; i++) {
        differences[i] -= (uint64_t)least;
        unsigned bits = bits_of(differences[i]);
        widths[i / PART] = (uint8_t)(bits > widths[i / PART] ? bits : widths[i / PART]);
    }
    tn_varint_write(out, tn_fold(least));
    tn_buffer_append(out, (const char *)widths, sizeof widths);
    for (size_t part = 0; part * PART < count; part++)
        pack_part(out, differences + part * PART, widths[part]);
}

void tn_delta_write(tn_buffer *out, const int64_t *values, size_t count)
{
    tn_varint_write(out, BLOCK);
    tn_varint_write(out, PARTS);
    tn_varint_write(out, count);
    tn_varint_write(out, tn_fold(count > 0 ? values[0] : 0));
    for (size_t at = 1; at < count; at += BLOCK)
        write_block(out, values + at - 1, count - at < BLOCK ? count - at : BLOCK);
}
