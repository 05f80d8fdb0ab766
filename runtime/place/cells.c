/* Filled cells in chunks of bits, and the shells of bounds. */
#include "runtime/place/cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/random.h"

/* ==== filled cells in chunks of bits */

enum { FIRST_SLOTS = 64 };

tn_cells *tn_cells_new(tn_watch *watch)
{
    tn_cells *cells = calloc(1, sizeof *cells);
    tn_cell_chunk **slots = calloc(FIRST_SLOTS, sizeof *slots);
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
    while (cells->slots[slot] && !tn_cell_chunk_is_at(cells->slots[slot], at))
        slot = (slot + 1) & (cells->slot_count - 1);
    return slot;
}

static inline tn_cell_chunk *find_chunk(tn_cells *cells, const int32_t at[3])
{
    tn_cell_chunk **near = tn_cells_near(cells, at);
    if (*near && tn_cell_chunk_is_at(*near, at))
        return *near;
    tn_cell_chunk *found = cells->slots[slot_of(cells, at)];
    if (found)
        *near = found;
    return found;
}

static bool grow_slots(tn_cells *cells)
{
    size_t count = cells->slot_count;
    tn_cell_chunk **old = cells->slots, **slots = calloc(2 * count, sizeof *slots);
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

static tn_status make_chunk(tn_cells *cells, const int32_t at[3], tn_cell_chunk **made, tn_error *error)
{
    *made = find_chunk(cells, at);
    if (*made)
        return TN_OK;
    tn_status status = tn_watch_check(cells->watch, error);
    if (status != TN_OK)
        return status;
    if (2 * (cells->chunk_count + 1) > cells->slot_count && !grow_slots(cells))
        return tn_fail_memory(error);
    tn_cell_chunk *chunk = calloc(1, sizeof *chunk);
    if (!chunk)
        return tn_fail_memory(error);
    memcpy(chunk->at, at, sizeof chunk->at);
    if (cells->space && (status = cells->space->outside(cells->space->context, at, chunk->row, error)) != TN_OK) {
        free(chunk);
        return status;
    }
    cells->slots[slot_of(cells, at)] = chunk;
    cells->chunk_count++;
    *made = *tn_cells_near(cells, at) = chunk;
    return TN_OK;
}

/* ---- boxes */

/* The part of a box that lies in one chunk: its first and last cells. */
typedef struct chunk_part {
    int32_t at[3];
    int32_t low[3], last[3];
} chunk_part;

/* The first chunk of a box; false if it has no cells. */
static inline bool first_part(const tn_cell_box *box, chunk_part *part)
{
    for (int k = 0; k < 3; k++)
        part->at[k] = tn_cell_chunk_of(box->low[k], k);
    return box->low[0] < box->high[0] && box->low[1] < box->high[1] && box->low[2] < box->high[2];
}

static inline void cut_part(const tn_cell_box *box, chunk_part *part)
{
    for (int k = 0; k < 3; k++) {
        int32_t start = tn_cell_chunk_start(part->at[k], k), end = start + (1 << tn_cell_chunk_shift(k)) - 1;
        part->low[k] = box->low[k] > start ? box->low[k] : start;
        part->last[k] = box->high[k] - 1 < end ? box->high[k] - 1 : end;
    }
}

/* The next chunk that the box lies in: z first, then y, then x. */
static inline bool next_part(const tn_cell_box *box, chunk_part *part)
{
    for (int k = 2; k >= 0; k--) {
        if (++part->at[k] <= tn_cell_chunk_of(box->high[k] - 1, k))
            return true;
        part->at[k] = tn_cell_chunk_of(box->low[k], k);
    }
    return false;
}

static bool part_any(tn_cell_chunk *chunk, const tn_cell_box *box, chunk_part *part)
{
    cut_part(box, part);
    const tn_cell_rows rows = tn_cell_rows_of(chunk, part->low, part->last);
    return tn_cell_rows_any(&rows);
}

/* How many chunks the box lies in, as far as it matters: there may be more than a number can say. */
static double count_parts(const tn_cell_box *box)
{
    double count = 1;
    for (int k = 0; k < 3; k++)
        count *= (double)tn_cell_chunk_of(box->high[k] - 1, k) - (double)tn_cell_chunk_of(box->low[k], k) + 1;
    return count;
}

/* Might it lie in more than eight chunks? */
static bool is_large(const tn_cell_box *box)
{
    for (int k = 0; k < 3; k++)
        if ((int64_t)box->high[k] - box->low[k] > TN_CHUNK_ROWS)
            return true;
    return false;
}

/* The same asked of every chunk there is: for boxes that lie in more chunks than there are. */
static bool any_of_all(const tn_cells *cells, const tn_cell_box *box)
{
    for (size_t i = 0; i < cells->slot_count; i++) {
        tn_cell_chunk *chunk = cells->slots[i];
        if (!chunk)
            continue;
        chunk_part part;
        bool inside = true;
        for (int k = 0; k < 3; k++) {
            part.at[k] = chunk->at[k];
            inside &=
                part.at[k] >= tn_cell_chunk_of(box->low[k], k) && part.at[k] <= tn_cell_chunk_of(box->high[k] - 1, k);
        }
        if (inside && part_any(chunk, box, &part))
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
        tn_cell_chunk *chunk;
        if (cells->status == TN_OK)
            cells->status = make_chunk(cells, part->at, &chunk, &cells->error);
        if (cells->status != TN_OK)
            return true;
        if (part_any(chunk, box, part))
            return true;
    } while (next_part(box, part));
    return false;
}

bool tn_cells_any_far(tn_cells *cells, const tn_cell_box *box)
{
    chunk_part part;
    if (!first_part(box, &part))
        return false;
    if (cells->space)
        return any_in_space(cells, box, &part);
    if (is_large(box) && count_parts(box) > (double)cells->slot_count)
        return any_of_all(cells, box);
    do {
        tn_cell_chunk *chunk = find_chunk(cells, part.at);
        if (chunk && part_any(chunk, box, &part))
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

/* Fills rows; how many of their cells were free. */
static uint64_t fill_rows(const tn_cell_rows *rows)
{
    uint64_t fresh = 0, all = (uint64_t)__builtin_popcountll(rows->bits), *row = rows->first;
    for (int y = 0; y < rows->high; y++, row += TN_CHUNK_ROWS) {
        for (int z = 0; z < rows->deep; z++) {
            fresh += row[z] & rows->bits ? (uint64_t)__builtin_popcountll(rows->bits & ~row[z]) : all;
            row[z] |= rows->bits;
        }
    }
    return fresh;
}

tn_status tn_cells_fill(tn_cells *cells, const tn_cell_box *box, tn_error *error)
{
    chunk_part part;
    if (!first_part(box, &part))
        return TN_OK;
    do {
        tn_cell_chunk *chunk;
        tn_status status = make_chunk(cells, part.at, &chunk, error);
        if (status != TN_OK)
            return status;
        cut_part(box, &part);
        const tn_cell_rows rows = tn_cell_rows_of(chunk, part.low, part.last);
        cells->filled += fill_rows(&rows);
    } while (next_part(box, &part));
    return TN_OK;
}

static uint64_t empty_rows(const tn_cell_rows *rows)
{
    uint64_t gone = 0, *row = rows->first;
    for (int y = 0; y < rows->high; y++, row += TN_CHUNK_ROWS) {
        for (int z = 0; z < rows->deep; z++) {
            gone += (uint64_t)__builtin_popcountll(rows->bits & row[z]);
            row[z] &= ~rows->bits;
        }
    }
    return gone;
}

void tn_cells_empty(tn_cells *cells, const tn_cell_box *box)
{
    chunk_part part;
    if (!first_part(box, &part))
        return;
    do {
        tn_cell_chunk *chunk = find_chunk(cells, part.at);
        if (!chunk)
            continue;
        cut_part(box, &part);
        const tn_cell_rows rows = tn_cell_rows_of(chunk, part.low, part.last);
        cells->filled -= empty_rows(&rows);
    } while (next_part(box, &part));
}

/* ==== the shells of bounds, filled cell by cell as the published program fills them */

/* The shell's coordinates run from -size - 1 to size on each axis; a cell is of it where one of them is at an end. A
 * negative size leaves no room, and nothing is filled where the range is empty. */
tn_status tn_bound_box(tn_cells *cells, const tn_frame *frame, const tn_step *step, tn_error *error)
{
    tn_cell_box whole;
    for (int k = 0; k < 3; k++) {
        whole.low[k] = frame->at[k] - step->a[k] - 1;
        whole.high[k] = frame->at[k] + step->a[k] + 1;
    }
    for (int k = 0; k < 3; k++) {
        for (int side = 0; side < 2; side++) {
            tn_cell_box slab = whole;
            if (side == 0)
                slab.high[k] = slab.low[k] + 1;
            else
                slab.low[k] = slab.high[k] - 1;
            bool empty = whole.low[k] >= whole.high[k];
            tn_status status = empty ? TN_OK : tn_cells_fill(cells, &slab, error);
            if (status != TN_OK)
                return status;
        }
    }
    return TN_OK;
}

/* The largest whole number whose square is at most `square`; -1 where that is negative. */
static int64_t root_below(int64_t square)
{
    if (square < 0)
        return -1;
    int64_t root = (int64_t)sqrt((double)square);
    while (root * root > square)
        root--;
    while ((root + 1) * (root + 1) <= square)
        root++;
    return root;
}

/* Fills the cells x of a row with low <= x < high. */
static tn_status fill_row(tn_cells *cells, int64_t low, int64_t high, int32_t y, int32_t z, tn_error *error)
{
    tn_cell_box row = {{(int32_t)low, y, z}, {(int32_t)high, y + 1, z + 1}};
    return low < high ? tn_cells_fill(cells, &row, error) : TN_OK;
}

/* Cells x, y, z in [-r, r - 1] with (r - 1)^2 < x^2 + y^2 + z^2 <= r^2: of a row along x, what lies within the outer
 * ball less what lies within the inner one. */
tn_status tn_bound_ball(tn_cells *cells, int32_t radius, tn_error *error)
{
    int64_t r = radius, outer_square = r * r, inner_square = (r - 1) * (r - 1);
    for (int64_t y = -r; y < r; y++) {
        int64_t z_reach = root_below(outer_square - y * y);
        for (int64_t z = -z_reach; z <= z_reach && z < r; z++) {
            int64_t outer = root_below(outer_square - y * y - z * z), inner = root_below(inner_square - y * y - z * z);
            int64_t high = outer + 1 < r ? outer + 1 : r, low = -outer > -r ? -outer : -r;
            tn_status status;
            if (inner < 0) {
                status = fill_row(cells, low, high, (int32_t)y, (int32_t)z, error);
            } else {
                status = fill_row(cells, low, -inner, (int32_t)y, (int32_t)z, error);
                if (status == TN_OK)
                    status = fill_row(cells, inner + 1, high, (int32_t)y, (int32_t)z, error);
            }
            if (status != TN_OK)
                return status;
        }
    }
    return TN_OK;
}
