/* Walks along rows of the grid's cells: which of them the surface runs through, and the vertices on their edges.
 * Internal to runtime/field. */
#ifndef TARTAN_FIELD_CELL_ROW_H
#define TARTAN_FIELD_CELL_ROW_H

#include <string.h>

#include "runtime/field/contour_parts.h"
#include "runtime/field/contour_table.h"

/* Rows of cells: the edges that they have, by rows of samples. Row k of samples lies at y + (k & 1), z + (k >> 1). */
typedef struct tn_cell_row {
    const uint64_t *signs[4];
    uint32_t first[4][3];    /* the next vertex of each row of edges, at the word at hand */
    uint64_t crossing[4][3]; /* of the word at hand */
    uint64_t corner[8];      /* a bit a cell of the word: is this corner inside? */
} tn_cell_row;

static inline void tn_cell_row_open(const tn_contouring *c, uint32_t y, uint32_t z, tn_cell_row *row)
{
    for (uint32_t k = 0; k < 4; k++) {
        uint32_t at_y = y + (k & 1), at_z = z + (k >> 1);
        row->signs[k] = tn_signs_at(c, at_y, at_z);
        memcpy(row->first[k], c->first[(size_t)at_z * c->grid->count[1] + at_y], sizeof row->first[k]);
    }
}

/* Looks at a word: the corners of its cells, and the edges along each axis that cross; those along y go from rows 0 and
 * 2, along z from 0 and 1. False where all corners are alike, so that nothing crosses. */
static inline bool tn_cell_row_look(const tn_contouring *c, tn_cell_row *row, size_t word)
{
    uint64_t any = 0, all = ~(uint64_t)0;
    for (int k = 0; k < 4; k++) {
        uint64_t next = word + 1 < c->words ? row->signs[k][word + 1] << 63 : 0;
        row->corner[2 * k] = row->signs[k][word];
        row->corner[2 * k + 1] = row->signs[k][word] >> 1 | next;
        any |= row->corner[2 * k] | row->corner[2 * k + 1];
        all &= row->corner[2 * k] & row->corner[2 * k + 1];
    }
    if (any == all)
        return false;
    for (int k = 0; k < 4; k++)
        row->crossing[k][0] = tn_crossing_x(c, row->signs[k], word);
    for (int k = 0; k < 4; k += 2)
        row->crossing[k][1] = row->signs[k][word] ^ row->signs[k + 1][word];
    for (int k = 0; k < 2; k++)
        row->crossing[k][2] = row->signs[k][word] ^ row->signs[k + 2][word];
    return true;
}

static inline void tn_cell_row_pass(tn_cell_row *row)
{
    for (int k = 0; k < 4; k++) {
        row->first[k][0] += (uint32_t)__builtin_popcountll(row->crossing[k][0]);
        if (k % 2 == 0)
            row->first[k][1] += (uint32_t)__builtin_popcountll(row->crossing[k][1]);
        if (k < 2)
            row->first[k][2] += (uint32_t)__builtin_popcountll(row->crossing[k][2]);
    }
}

/* The cells of the word at hand that have both kinds of corners. */
static inline uint64_t tn_cells_mixed(const tn_contouring *c, const tn_cell_row *row, size_t word)
{
    uint64_t any = 0, all = ~(uint64_t)0;
    for (int k = 0; k < 8; k++) {
        any |= row->corner[k];
        all &= row->corner[k];
    }
    uint32_t edges = c->grid->count[0] - 1;
    size_t left = edges > 64 * word ? edges - 64 * word : 0;
    uint64_t exist = left >= 64 ? ~(uint64_t)0 : ((uint64_t)1 << left) - 1;
    return any & ~all & exist;
}

static inline unsigned tn_cell_mask(const tn_cell_row *row, uint32_t bit)
{
    unsigned mask = 0;
    for (unsigned k = 0; k < 8; k++)
        mask |= (unsigned)(row->corner[k] >> bit & 1) << k;
    return mask;
}

/* The vertex on an edge of the cell at this bit. */
static inline uint32_t tn_cell_vertex(const tn_cell_row *row, uint32_t bit, unsigned edge)
{
    unsigned low = tn_contour_edges[edge][0], axis = (low ^ tn_contour_edges[edge][1]) >> 1, k = low >> 1;
    uint32_t at = bit + (low & 1);
    uint64_t before = at > 63 ? ~(uint64_t)0 : ((uint64_t)1 << at) - 1;
    return row->first[k][axis] + (uint32_t)__builtin_popcountll(row->crossing[k][axis] & before);
}

/* Is one of the vertices a jump? */
static inline bool tn_touches_jump(const tn_contouring *c, const uint32_t corner[3])
{
    for (int i = 0; i < 3; i++)
        if (c->jumping[corner[i] / 64] >> (corner[i] % 64) & 1)
            return true;
    return false;
}

#endif
