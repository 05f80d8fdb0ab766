/* Writes runs, packed bits and differences. */
#include <string.h>

#include "driver/parquet/encoding.h"

#define PART 32u /* differences of a part of a block: the fewest that the format allows */
#define PARTS (TN_DELTA_BLOCK / PART)

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

uint8_t *tn_bytes_begin(tn_buffer *out, size_t count)
{
    size_t size = 8 * packed_head(out, count);
    return tn_buffer_reserve(out, size) ? (uint8_t *)out->data + out->size : NULL;
}

void tn_bytes_end(tn_buffer *out, size_t begin, size_t count)
{
    char *values = out->data + out->size;
    size_t size = (count + 7) / 8 * 8;
    if (count > 0 && memcmp(values, values + 1, count - 1) == 0) {
        out->size = begin;
        tn_run_write(out, 8, (uint8_t)values[0], count);
        return;
    }
    memset(values + count, 0, size - count);
    out->size += size;
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

static uint64_t least_difference(const tn_delta_writer *writer)
{
    int64_t least = INT64_MAX;
    for (size_t i = 0; i < writer->in_block; i++)
        least = (int64_t)writer->differences[i] < least ? (int64_t)writer->differences[i] : least;
    return (uint64_t)least;
}

/* The block in hand; what its last part lacks is 0. */
static void write_block(tn_delta_writer *writer)
{
    uint64_t *differences = writer->differences, least = least_difference(writer);
    size_t count = writer->in_block;
    uint8_t widths[PARTS] = {0};
    for (size_t i = 0; i < count; i++) {
        differences[i] -= least;
        unsigned bits = bits_of(differences[i]);
        widths[i / PART] = (uint8_t)(bits > widths[i / PART] ? bits : widths[i / PART]);
    }
    memset(differences + count, 0, (TN_DELTA_BLOCK - count) * sizeof *differences);
    tn_varint_write(&writer->blocks, tn_fold((int64_t)least));
    tn_buffer_append(&writer->blocks, (const char *)widths, sizeof widths);
    for (size_t part = 0; part * PART < count; part++)
        pack_part(&writer->blocks, differences + part * PART, widths[part]);
    writer->in_block = 0;
}

bool tn_delta_add(tn_delta_writer *writer, int64_t value)
{
    if (writer->count++ == 0)
        writer->first = value;
    else
        writer->differences[writer->in_block++] = (uint64_t)value - (uint64_t)writer->last;
    writer->last = value;
    if (writer->in_block == TN_DELTA_BLOCK)
        write_block(writer);
    return !writer->blocks.failed;
}

void tn_delta_end(tn_delta_writer *writer, tn_buffer *out)
{
    if (writer->in_block > 0)
        write_block(writer);
    tn_varint_write(out, TN_DELTA_BLOCK);
    tn_varint_write(out, PARTS);
    tn_varint_write(out, writer->count);
    tn_varint_write(out, tn_fold(writer->count > 0 ? writer->first : 0));
    tn_buffer_append(out, writer->blocks.data, writer->blocks.size);
    out->failed = out->failed || writer->blocks.failed;
    writer->blocks.size = writer->count = 0;
}
