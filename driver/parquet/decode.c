/* Reads runs, packed bits and differences, from bytes of any origin. */
#include "driver/parquet/encoding.h"

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
