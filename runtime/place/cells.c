/* Filled cells in chunks of bits. */
#include "runtime/place/cells.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/random.h"

enum { SHIFT_X = 6, SHIFT_YZ = 4, ROWS = TN_CHUNK_ROWS, FIRST_SLOTS = 64 };

typedef struct cell_chunk {
    int32_t at[3];            /* in chunks */
    uint64_t row[ROWS][ROWS]; /* [y][z]: bits along x */
} cell_chunk;

struct tn_cells {
    cell_chunk **slots; /* open addressing; at most half full */
    size_t slot_count, chunk_count;
    cell_chunk *last;
    uint64_t filled;
    tn_watch *watch;
    const tn_cell_space *space; /* or NULL */
    tn_status status;           /* of looking at the space */
    tn_error error;
};

tn_cells *tn_cells_new(tn_watch *watch)
{
    tn_cells *cells = calloc(1, sizeof *cells);
    cell_chunk **slots = calloc(FIRST_SLOTS, sizeof *slots);
    if (!cells || !slots) {
        free(cells);
        free(slots);
        return NULL;
    }
    cells->slots = slots;
    cells->slot_count = FIRST_SLOTS;
    cells->watch = watch;
    cells->status = TN_OK;
    return cells;
}

void tn_cells_bound(tn_cells *cells, const tn_cell_space *space)
{
    cells->space = space;
}

tn_status tn_cells_status(const tn_cells *cells, tn_error *error)
{
    if (cells->status != TN_OK && error)
        *error = cells->error;
    return cells->status;
}

void tn_cells_free(tn_cells *cells)
{
    if (!cells)
        return;
    for (size_t i = 0; i < cells->slot_count; i++)
        free(cells->slots[i]);
    free(cells->slots);
    free(cells);
}

uint64_t tn_cells_count(const tn_cells *cells)
{
    return cells->filled;
}

/* ---- chunks */

static size_t slot_of(const tn_cells *cells, const int32_t at[3])
{
    uint64_t hash = tn_mix64((uint64_t)(uint32_t)at[0] << 32 | (uint32_t)at[1]);
    hash = tn_mix64(hash ^ (uint32_t)at[2]);
    size_t slot = (size_t)hash & (cells->slot_count - 1);
    while (cells->slots[slot] && memcmp(cells->slots[slot]->at, at, sizeof cells->slots[slot]->at) != 0)
        slot = (slot + 1) & (cells->slot_count - 1);
    return slot;
}

static cell_chunk *find_chunk(tn_cells *cells, const int32_t at[3])
{
    if (cells->last && memcmp(cells->last->at, at, sizeof cells->last->at) == 0)
        return cells->last;
    cell_chunk *found = cells->slots[slot_of(cells, at)];
    if (found)
        cells->last = found;
    return found;
}

static bool grow_slots(tn_cells *cells)
{
    size_t count = cells->slot_count;
    cell_chunk **old = cells->slots, **slots = calloc(2 * count, sizeof *slots);
    if (!slots)
        return false;
    cells->slots = slots;
    cells->slot_count = 2 * count;
    for (size_t i = 0; i < count; i++)
        if (old[i])
            slots[slot_of(cells, old[i]->at)] = old[i];
    free(old);
    return true;
}

static tn_status make_chunk(tn_cells *cells, const int32_t at[3], cell_chunk **made, tn_error *error)
{
    *made = find_chunk(cells, at);
    if (*made)
        return TN_OK;
    tn_status status = tn_watch_check(cells->watch, error);
    if (status != TN_OK)
        return status;
    if (2 * (cells->chunk_count + 1) > cells->slot_count && !grow_slots(cells))
        return tn_fail_memory(error);
    cell_chunk *chunk = calloc(1, sizeof *chunk);
    if (!chunk)
        return tn_fail_memory(error);
    memcpy(chunk->at, at, sizeof chunk->at);
    if (cells->space && (status = cells->space->outside(cells->space->context, at, chunk->row, error)) != TN_OK) {
        free(chunk);
        return status;
    }
    cells->slots[slot_of(cells, at)] = chunk;
    cells->chunk_count++;
    *made = cells->last = chunk;
    return TN_OK;
}

/* ---- boxes */

/* The part of a box that lies in one chunk: rows [y0, y1) x [z0, z1), and the bits of a row. */
typedef struct chunk_part {
    int32_t at[3];
    int y0, y1, z0, z1;
    uint64_t bits;
} chunk_part;

/* The cells of [low, high) that lie in the chunk at `chunk` of this size, counted from its start. */
static void cut_axis(int32_t low, int32_t high, int32_t chunk, int shift, int *from, int *to)
{
    int64_t size = (int64_t)1 << shift, start = chunk * size;
    *from = low > start ? (int)(low - start) : 0;
    *to = high < start + size ? (int)(high - start) : (int)size;
}

static uint64_t row_bits(int from, int to)
{
    uint64_t below = to == 64 ? UINT64_MAX : (UINT64_C(1) << to) - 1;
    return below & UINT64_MAX << from;
}

static bool first_part(const tn_cell_box *box, chunk_part *part)
{
    for (int k = 0; k < 3; k++)
        if (box->low[k] >= box->high[k])
            return false;
    part->at[0] = box->low[0] >> SHIFT_X;
    part->at[1] = box->low[1] >> SHIFT_YZ;
    part->at[2] = box->low[2] >> SHIFT_YZ;
    return true;
}

static void cut_part(const tn_cell_box *box, chunk_part *part)
{
    int from, to;
    cut_axis(box->low[0], box->high[0], part->at[0], SHIFT_X, &from, &to);
    part->bits = row_bits(from, to);
    cut_axis(box->low[1], box->high[1], part->at[1], SHIFT_YZ, &part->y0, &part->y1);
    cut_axis(box->low[2], box->high[2], part->at[2], SHIFT_YZ, &part->z0, &part->z1);
}

/* The next chunk that the box lies in: z first, then y, then x. */
static bool next_part(const tn_cell_box *box, chunk_part *part)
{
    if (++part->at[2] <= (box->high[2] - 1) >> SHIFT_YZ)
        return true;
    part->at[2] = box->low[2] >> SHIFT_YZ;
    if (++part->at[1] <= (box->high[1] - 1) >> SHIFT_YZ)
        return true;
    part->at[1] = box->low[1] >> SHIFT_YZ;
    return ++part->at[0] <= (box->high[0] - 1) >> SHIFT_X;
}

static bool part_any(const cell_chunk *chunk, const chunk_part *part)
{
    for (int y = part->y0; y < part->y1; y++)
        for (int z = part->z0; z < part->z1; z++)
            if (chunk->row[y][z] & part->bits)
                return true;
    return false;
}

/* How many chunks the box lies in, as far as it matters: there may be more than a number can say. */
static double count_parts(const tn_cell_box *box)
{
    double count = 1;
    for (int k = 0; k < 3; k++) {
        int shift = k == 0 ? SHIFT_X : SHIFT_YZ;
        count *= (double)((box->high[k] - 1) >> shift) - (double)(box->low[k] >> shift) + 1;
    }
    return count;
}

/* The same asked of every chunk there is: for boxes that lie in more chunks than there are. */
static bool any_of_all(const tn_cells *cells, const tn_cell_box *box)
{
    for (size_t i = 0; i < cells->slot_count; i++) {
        const cell_chunk *chunk = cells->slots[i];
        if (!chunk)
            continue;
        chunk_part part;
        memcpy(part.at, chunk->at, sizeof part.at);
        bool inside = true;
        for (int k = 0; k < 3; k++) {
            int shift = k == 0 ? SHIFT_X : SHIFT_YZ;
            inside &= part.at[k] >= box->low[k] >> shift && part.at[k] <= (box->high[k] - 1) >> shift;
        }
        if (!inside)
            continue;
        cut_part(box, &part);
        if (part_any(chunk, &part))
            return true;
    }
    return false;
}

/* In a space the chunks that a box lies in are made where they are not there: they hold what is outside. */
static bool any_in_space(tn_cells *cells, const tn_cell_box *box, chunk_part *part)
{
    const tn_cell_box *all = &cells->space->box;
    for (int k = 0; k < 3; k++)
        if (box->low[k] < all->low[k] || box->high[k] > all->high[k])
            return true;
    do {
        cell_chunk *chunk;
        if (cells->status == TN_OK)
            cells->status = make_chunk(cells, part->at, &chunk, &cells->error);
        if (cells->status != TN_OK)
            return true;
        cut_part(box, part);
        if (part_any(chunk, part))
            return true;
    } while (next_part(box, part));
    return false;
}

static bool in_one_chunk(const tn_cell_box *box, const chunk_part *part)
{
    return (box->high[0] - 1) >> SHIFT_X == part->at[0] && (box->high[1] - 1) >> SHIFT_YZ == part->at[1] &&
           (box->high[2] - 1) >> SHIFT_YZ == part->at[2];
}

/* Most boxes are those of a lookahead, and lie in one chunk. */
bool tn_cells_any(tn_cells *cells, const tn_cell_box *box)
{
    chunk_part part;
    if (!first_part(box, &part))
        return false;
    if (cells->space)
        return any_in_space(cells, box, &part);
    if (in_one_chunk(box, &part)) {
        const cell_chunk *chunk = find_chunk(cells, part.at);
        if (!chunk)
            return false;
        cut_part(box, &part);
        return part_any(chunk, &part);
    }
    if (count_parts(box) > (double)cells->slot_count)
        return any_of_all(cells, box);
    do {
        const cell_chunk *chunk = find_chunk(cells, part.at);
        if (!chunk)
            continue;
        cut_part(box, &part);
        if (part_any(chunk, &part))
            return true;
    } while (next_part(box, &part));
    return false;
}

/* The box is halved along one axis after the other, and the half with the lower cells is kept where it holds any. */
bool tn_cells_first(tn_cells *cells, const tn_cell_box *box, int32_t cell[3])
{
    tn_cell_box part = *box;
    if (!tn_cells_any(cells, &part))
        return false;
    for (int k = 0; k < 3; k++) {
        while (part.high[k] - part.low[k] > 1) {
            int32_t high = part.high[k];
            part.high[k] = part.low[k] + (high - part.low[k]) / 2;
            if (!tn_cells_any(cells, &part)) {
                part.low[k] = part.high[k];
                part.high[k] = high;
            }
        }
        cell[k] = part.low[k];
    }
    return true;
}

tn_status tn_cells_fill(tn_cells *cells, const tn_cell_box *box, tn_error *error)
{
    chunk_part part;
    if (!first_part(box, &part))
        return TN_OK;
    do {
        cell_chunk *chunk;
        tn_status status = make_chunk(cells, part.at, &chunk, error);
        if (status != TN_OK)
            return status;
        cut_part(box, &part);
        for (int y = part.y0; y < part.y1; y++) {
            for (int z = part.z0; z < part.z1; z++) {
                cells->filled += (uint64_t)__builtin_popcountll(part.bits & ~chunk->row[y][z]);
                chunk->row[y][z] |= part.bits;
            }
        }
    } while (next_part(box, &part));
    return TN_OK;
}

void tn_cells_empty(tn_cells *cells, const tn_cell_box *box)
{
    chunk_part part;
    if (!first_part(box, &part))
        return;
    do {
        cell_chunk *chunk = find_chunk(cells, part.at);
        if (!chunk)
            continue;
        cut_part(box, &part);
        for (int y = part.y0; y < part.y1; y++) {
            for (int z = part.z0; z < part.z1; z++) {
                cells->filled -= (uint64_t)__builtin_popcountll(part.bits & chunk->row[y][z]);
                chunk->row[y][z] &= ~part.bits;
            }
        }
    } while (next_part(box, &part));
}
