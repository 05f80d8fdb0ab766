/* Reads and writes runs, packed bits and differences. What is read may come from anywhere. */
#include "driver/parquet/encoding.h"

#include <string.h>

/* ---- reading */

#define BLOCK_MOST (UINT64_C(1) << 20) /* differences in a block; writers in use have 128 to 1,024 */

void tn_runs_begin(tn_runs *runs, unsigned width, const uint8_t *bytes, size_t size)
{
    *runs = (tn_runs){.in = {bytes, bytes + size, false}, .width = width};
}

static bool refill_packed(tn_runs *runs, uint64_t groups)
{
    uint64_t left = (uint64_t)(runs->in.end - runs->in.at);
    if (groups > left || groups * runs->width > left)
        return false;
    runs->packed = true;
    runs->bytes = runs->in.at;
    runs->bit = 0;
    runs->left = 8 * groups;
    runs->in.at += groups * runs->width;
    return groups > 0;
}

static bool refill_run(tn_runs *runs, uint64_t count)
{
    size_t size = (runs->width + 7) / 8;
    if (count == 0 || (size_t)(runs->in.end - runs->in.at) < size)
        return false;
    runs->packed = false;
    runs->value = 0;
    for (size_t i = 0; i < size; i++)
        runs->value |= (uint32_t)*runs->in.at++ << 8 * i;
    runs->left = count;
    return runs->width == 32 || runs->value >> runs->width == 0;
}

bool tn_runs_refill(tn_runs *runs)
{
    uint64_t head = tn_varint_read(&runs->in);
    if (runs->in.bad)
        return false;
    return head & 1 ? refill_packed(runs, head >> 1) : refill_run(runs, head >> 1);
}

/* `width` bits, at most 64, that begin at that bit. */
static uint64_t bits_at(const uint8_t *bytes, uint64_t bit, unsigned width)
{
    uint64_t value = 0;
    for (unsigned taken = 0; taken < width;) {
        unsigned within = (unsigned)((bit + taken) % 8), some = 8 - within;
        some = some < width - taken ? some : width - taken;
        uint64_t part = (uint64_t)(bytes[(bit + taken) / 8] >> within) & ((1u << some) - 1);
        value |= part << taken;
        taken += some;
    }
    return value;
}

uint32_t tn_runs_packed(tn_runs *runs)
{
    uint64_t bit = runs->bit;
    runs->bit += runs->width;
    return (uint32_t)bits_at(runs->bytes, bit, runs->width);
}

/* ---- differences */

bool tn_deltas_begin(tn_deltas *deltas, const uint8_t *bytes, size_t size)
{
    *deltas = (tn_deltas){.in = {bytes, bytes + size, false}, .first = true};
    deltas->block = tn_varint_read(&deltas->in);
    deltas->parts = tn_varint_read(&deltas->in);
    deltas->total = tn_varint_read(&deltas->in);
    deltas->last = (uint64_t)tn_unfold(tn_varint_read(&deltas->in));
    deltas->part = deltas->parts;
    return !deltas->in.bad && deltas->block > 0 && deltas->block <= BLOCK_MOST && deltas->parts > 0 &&
           deltas->block % deltas->parts == 0 && deltas->block / deltas->parts % 8 == 0;
}

static bool next_block(tn_deltas *deltas)
{
    tn_thrift_in *in = &deltas->in;
    deltas->least = (uint64_t)tn_unfold(tn_varint_read(in));
    if (in->bad || deltas->parts > (uint64_t)(in->end - in->at))
        return false;
    deltas->widths = in->at;
    in->at += deltas->parts;
    deltas->part = 0;
    return true;
}

static bool next_part(tn_deltas *deltas)
{
    tn_thrift_in *in = &deltas->in;
    if (deltas->part >= deltas->parts && !next_block(deltas))
        return false;
    unsigned width = deltas->widths[deltas->part++];
    deltas->left = deltas->block / deltas->parts;
    uint64_t size = deltas->left / 8 * width;
    if (width > 64 || size > (uint64_t)(in->end - in->at))
        return false;
    deltas->bytes = in->at;
    deltas->bit = 0;
    in->at += size;
    return true;
}

bool tn_deltas_next(tn_deltas *deltas, int64_t *value)
{
    if (deltas->total == 0)
        return false;
    deltas->total--;
    if (!deltas->first) {
        if (deltas->left == 0 && !next_part(deltas))
            return false;
        unsigned width = deltas->widths[deltas->part - 1];
        deltas->last += deltas->least + bits_at(deltas->bytes, deltas->bit, width);
        deltas->bit += width;
        deltas->left--;
    }
    deltas->first = false;
    *value = (int64_t)deltas->last;
    return true;
}

/* ---- writing */

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
