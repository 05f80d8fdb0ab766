/* Makes one mesh of the blocks of a house: the boundary of their union, worked out plane by plane. */
#include <stdlib.h>

#include "runtime/geometry/union/union.h"
#include "runtime/house/model/model.h"

/* The corners of each side in order, as in cut_box.c: bit 0 of a corner is high x, bit 1 y, bit 2 z. */
static const uint8_t sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

/* Which end of the block's slope a corner is at. */
static int end_of(const tn_house_block *block, int corner)
{
    return corner >> block->axis & 1;
}

/* A side without the corners that fall on the one before: where the top comes down to the bottom. */
static void add_side(tn_cut_box *cell, const tn_house_block *block, int side)
{
    tn_cut_box_face face = {.side = (uint8_t)side};
    if ((side == 5 && block->top[0] != block->top[1]) || (side == 4 && block->bottom[0] != block->bottom[1]))
        face.side = TN_CUT_BOX_CAP;
    for (int i = 0; i < 4; i++) {
        uint8_t corner = sides[side][i];
        int end = end_of(block, corner);
        if (corner & 4 && block->top[end] <= block->bottom[end])
            corner &= 3;
        bool new = face.count == 0 || (face.corner[face.count - 1] != corner && face.corner[0] != corner);
        if (new)
            face.corner[face.count++] = corner;
    }
    if (face.count >= 3)
        cell->faces[cell->face_count++] = face;
}

static void make_cell(const tn_house_block *block, tn_cut_box *cell)
{
    *cell = (tn_cut_box){.corner_count = 8};
    for (int k = 0; k < 3; k++) {
        cell->low[k] = block->low[k];
        cell->high[k] = block->high[k];
    }
    for (int i = 0; i < 8; i++) {
        cell->at[i][0] = i & 1 ? block->high[0] : block->low[0];
        cell->at[i][1] = i & 2 ? block->high[1] : block->low[1];
        cell->at[i][2] = (i & 4 ? block->top : block->bottom)[end_of(block, i)];
    }
    for (int side = 0; side < 6; side++)
        add_side(cell, block, side);
}

/* A block without a height, width or depth is none. */
static bool is_solid(const tn_house_block *b)
{
    return b->low[0] < b->high[0] && b->low[1] < b->high[1] && b->low[2] < b->high[2];
}

/* Is an upright face of a roof a part of the wall below: a gable end, or a side that is higher than the roof is thick?
 */
static bool is_end(const tn_house_block *block, const tn_mesh *mesh, size_t face)
{
    const uint32_t *corners = mesh->corners + mesh->face_first[face];
    double n[3], at = mesh->positions[3 * corners[0] + (size_t)block->axis];
    if (block->edge == 0)
        return false;
    tn_mesh_face_normal(mesh, corners, mesh->face_first[face + 1] - mesh->face_first[face], n);
    if (n[2] != 0 || n[block->axis] == 0)
        return n[2] == 0;
    int end = at > block->low[block->axis];
    return block->top[end] - block->bottom[end] > block->edge;
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
        for (size_t f = 0; f < united.mesh.face_count; f++) {
            const tn_house_block *block = of[united.mesh.face_group[f]];
            united.mesh.face_group[f] = is_end(block, &united.mesh, f) ? block->end_group : block->group;
        }
        united.mesh.group_count = groups;
        *mesh = united.mesh;
        united.mesh = (tn_mesh){0};
    }
    tn_union_clear(&united);
    free(cells);
    free(of);
    return status;
}
