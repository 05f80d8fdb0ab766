/* Makes the triangles of the grid's cells, by the table of cells. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/field/cell_row.h"
#include "runtime/numeric/any_width.h"

typedef struct cells {
    tn_contouring *c;
    uint64_t *layer_first; /* triangles before each layer of cells */
    uint32_t *corners;     /* NULL: they are counted */
} cells;

/* Writes (or counts) a cell's triangles; returns how many. */
__attribute__((always_inline)) static inline uint32_t do_cell(const cells *all, const tn_cell_row *row, uint32_t bit,
                                                              unsigned mask, uint32_t *out)
{
    const uint8_t *triangles = tn_contour_table[mask];
    uint32_t count = 0;
    if (!out && (!all->c->options->jumps_open || all->c->options->survey))
        return triangles[0];
    for (uint32_t t = 0; t < triangles[0]; t++) {
        uint32_t corner[3];
        for (uint32_t i = 0; i < 3; i++)
            corner[i] = tn_cell_vertex(row, bit, triangles[1 + 3 * t + i]);
        if (all->c->options->jumps_open && tn_touches_jump(all->c, corner))
            continue;
        if (out)
            memcpy(out + 3 * (size_t)count, corner, sizeof corner);
        count++;
    }
    return count;
}

/* Counting bits is one instruction on processors that have wider vectors. */
TN_ANY_WIDTH static tn_status do_layer(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)thread;
    (void)error;
    cells *all = context;
    const tn_contouring *c = all->c;
    uint64_t count = 0;
    for (uint32_t y = 0; y + 1 < c->grid->count[1]; y++) {
        tn_cell_row row;
        tn_cell_row_open(c, y, (uint32_t)item, &row);
        for (size_t word = 0; word < c->words; word++) {
            if (!tn_cell_row_look(c, &row, word))
                continue;
            for (uint64_t mixed = tn_cells_mixed(c, &row, word); mixed; mixed &= mixed - 1) {
                uint32_t bit = (uint32_t)__builtin_ctzll(mixed);
                uint32_t *out = all->corners ? all->corners + 3 * (all->layer_first[item] + count) : NULL;
                count += do_cell(all, &row, bit, tn_cell_mask(&row, bit), out);
            }
            tn_cell_row_pass(&row);
        }
    }
    if (!all->corners)
        all->layer_first[item + 1] = count;
    return TN_OK;
}

static tn_status check_count(const tn_contouring *c, uint64_t count, tn_error *error)
{
    uint64_t most = c->options->triangles ? c->options->triangles : TN_TRIANGLES_MAX;
    if (count > most) {
        tn_fail(error, TN_LIMIT, E_FIELD_TRIANGLES, "the mesh has %llu triangles; the limit is %llu",
                (unsigned long long)count, (unsigned long long)most);
        tn_error_help(error, "take a coarser --grid, or raise --max-triangles");
        return TN_LIMIT;
    }
    return TN_OK;
}

tn_status tn_contour_make_room(tn_contouring *c, uint64_t count, tn_error *error)
{
    tn_mesh *mesh = &c->out->mesh;
    tn_status status = check_count(c, count, error);
    if (status != TN_OK)
        return status;
    mesh->face_count = (size_t)count;
    mesh->corners = tn_array_new(3 * count + 1, sizeof *mesh->corners);
    mesh->face_first = tn_array_new(count + 1, sizeof *mesh->face_first);
    if (!mesh->corners || !mesh->face_first)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i <= count; i++)
        mesh->face_first[i] = 3 * i;
    return TN_OK;
}

tn_status tn_contour_cells(tn_contouring *c, tn_error *error)
{
    uint32_t layers = c->grid->count[2] - 1;
    cells all = {.c = c, .layer_first = calloc((size_t)layers + 1, sizeof *all.layer_first)};
    if (!all.layer_first)
        return tn_fail_memory(error);
    tn_status status = tn_crew_run(c->crew, layers, 1, do_layer, &all, error);
    for (uint32_t z = 0; z < layers; z++)
        all.layer_first[z + 1] += all.layer_first[z];
    if (status == TN_OK && c->options->survey)
        status = check_count(c, all.layer_first[layers], error);
    else if (status == TN_OK)
        status = tn_contour_make_room(c, all.layer_first[layers], error);
    all.corners = c->out->mesh.corners;
    if (status == TN_OK && !c->options->survey)
        status = tn_crew_run(c->crew, layers, 1, do_layer, &all, error);
    free(all.layer_first);
    return status;
}
