/* Makes one mesh of the blocks of a house: the boundary of their union, worked out plane by plane. */
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/union/union.h"
#include "runtime/house/model/model.h"

/* The side of its box in whose plane an edge's face is: a polygon goes round counter-clockwise. */
static uint8_t side_of(const tn_block_corner *from, const tn_block_corner *to)
{
    if (from->x != to->x && from->y != to->y)
        return TN_CUT_BOX_CAP;
    if (from->y == to->y)
        return from->x < to->x ? 2 : 3;
    return from->y < to->y ? 1 : 0;
}

/* Adds a face without the corners that fall on the one before: where the top comes down to the bottom. */
static void add_face(tn_cut_box *cell, uint8_t side, const uint8_t *ring, size_t count)
{
    tn_cut_box_face face = {.side = side};
    for (size_t i = 0; i < count; i++) {
        const double *at = cell->at[ring[i]];
        const double *last = face.count ? cell->at[face.corner[face.count - 1]] : NULL,
                     *first = face.count ? cell->at[face.corner[0]] : NULL;
        if (!last || (memcmp(at, last, 3 * sizeof *at) != 0 && memcmp(at, first, 3 * sizeof *at) != 0))
            face.corner[face.count++] = ring[i];
    }
    if (face.count >= 3)
        cell->faces[cell->face_count++] = face;
}

static bool is_level(const tn_house_block *block, bool top)
{
    const tn_block_corner *c = block->corners;
    for (size_t i = 1; i < block->count; i++)
        if (top ? c[i].high != c[0].high : c[i].low != c[0].low)
            return false;
    return true;
}

/* Corners of the bottom come first, then those of the top. */
static void make_cell(const tn_house_block *block, tn_cut_box *cell)
{
    uint8_t count = (uint8_t)block->count, ring[TN_BLOCK_CORNERS];
    *cell = (tn_cut_box){.corner_count = 2 * block->count};
    for (int k = 0; k < 3; k++) {
        cell->low[k] = block->low[k];
        cell->high[k] = block->high[k];
    }
    for (uint8_t i = 0; i < count; i++) {
        const tn_block_corner *c = &block->corners[i];
        const double bottom[3] = {c->x, c->y, c->low}, top[3] = {c->x, c->y, c->high};
        memcpy(cell->at[i], bottom, sizeof bottom);
        memcpy(cell->at[count + i], top, sizeof top);
    }
    for (uint8_t i = 0; i < count; i++) {
        uint8_t next = (uint8_t)((i + 1) % count);
        const uint8_t face[4] = {i, next, (uint8_t)(count + next), (uint8_t)(count + i)};
        add_face(cell, side_of(&block->corners[i], &block->corners[next]), face, 4);
    }
    for (uint8_t i = 0; i < count; i++)
        ring[i] = (uint8_t)(count - 1 - i);
    add_face(cell, is_level(block, false) ? 4 : TN_CUT_BOX_CAP, ring, count);
    for (uint8_t i = 0; i < count; i++)
        ring[i] = (uint8_t)(count + i);
    add_face(cell, is_level(block, true) ? 5 : TN_CUT_BOX_CAP, ring, count);
}

/* A block without a height, width or depth is none. */
static bool is_solid(const tn_house_block *b)
{
    return b->low[0] < b->high[0] && b->low[1] < b->high[1] && b->low[2] < b->high[2];
}

tn_status tn_blocks_mesh(const tn_blocks *blocks, uint32_t groups, tn_mesh *mesh, tn_error *error)
{
    tn_cut_box *cells = malloc((blocks->count + 1) * sizeof *cells);
    const tn_house_block **of = malloc((blocks->count + 1) * sizeof *of);
    tn_union united = {0};
    size_t count = 0;
    tn_status status = cells && of ? TN_OK : tn_fail_memory(error);
    *mesh = (tn_mesh){0};
    for (size_t i = 0; status == TN_OK && i < blocks->count; i++) {
        if (!is_solid(&blocks->items[i]))
            continue;
        of[count] = &blocks->items[i];
        make_cell(&blocks->items[i], &cells[count++]);
    }
    if (status == TN_OK)
        status = tn_union_make(cells, count, &united, error);
    if (status == TN_OK) {
        for (size_t f = 0; f < united.mesh.face_count; f++)
            united.mesh.face_group[f] = of[united.mesh.face_group[f]]->group;
        united.mesh.group_count = groups;
        *mesh = united.mesh;
        united.mesh = (tn_mesh){0};
    }
    tn_union_clear(&united);
    free(cells);
    free(of);
    return status;
}
