/* Makes the triangles of the grid's cells, by the table of cells. */
#include <stdlib.h>
#include <string.h>

#include "runtime/field/contour_parts.h"
#include "runtime/field/contour_table.h"

/* Rows of cells: the edges that they have, by rows of samples. Row k of samples lies at y + (k & 1), z + (k >> 1). */
typedef struct cell_row {
    const uint64_t *signs[4];
    uint32_t first[4][3];    /* the next vertex of each row of edges, at the word at hand */
    uint64_t crossing[4][3]; /* of the word at hand */
} cell_row;

typedef struct cells {
    tn_contouring *c;
    uint64_t *layer_first; /* triangles before each layer of cells */
    uint32_t *corners;     /* NULL: they are counted */
} cells;

static void open_row(const tn_contouring *c, uint32_t y, uint32_t z, cell_row *row)
{
    for (uint32_t k = 0; k < 4; k++) {
        uint32_t at_y = y + (k & 1), at_z = z + (k >> 1);
        row->signs[k] = tn_signs_at(c, at_y, at_z);
        memcpy(row->first[k], c->first[(size_t)at_z * c->grid->count[1] + at_y], sizeof row->first[k]);
    }
}

/* The cells of a word that have both kinds of corners. */
static uint64_t mixed_cells(const tn_contouring *c, const cell_row *row, size_t word)
{
    uint64_t any = 0, all = ~(uint64_t)0;
    for (int k = 0; k < 4; k++) {
        uint64_t next = word + 1 < c->words ? row->signs[k][word + 1] << 63 : 0;
        uint64_t here = row->signs[k][word], beside = here >> 1 | next;
        any |= here | beside;
        all &= here & beside;
    }
    uint32_t edges = c->grid->count[0] - 1;
    size_t left = edges > 64 * word ? edges - 64 * word : 0;
    uint64_t exist = left >= 64 ? ~(uint64_t)0 : ((uint64_t)1 << left) - 1;
    return any & ~all & exist;
}

/* The edges along each axis that cross in this word; those along y go from rows 0 and 2, along z from 0 and 1. */
static void find_crossing(const tn_contouring *c, cell_row *row, size_t word)
{
    for (int k = 0; k < 4; k++)
        row->crossing[k][0] = tn_crossing_x(c, row->signs[k], word);
    for (int k = 0; k < 4; k += 2)
        row->crossing[k][1] = row->signs[k][word] ^ row->signs[k + 1][word];
    for (int k = 0; k < 2; k++)
        row->crossing[k][2] = row->signs[k][word] ^ row->signs[k + 2][word];
}

static void pass_word(cell_row *row)
{
    for (int k = 0; k < 4; k++) {
        row->first[k][0] += (uint32_t)__builtin_popcountll(row->crossing[k][0]);
        if (k % 2 == 0)
            row->first[k][1] += (uint32_t)__builtin_popcountll(row->crossing[k][1]);
        if (k < 2)
            row->first[k][2] += (uint32_t)__builtin_popcountll(row->crossing[k][2]);
    }
}

static unsigned mask_of(const tn_contouring *c, const cell_row *row, size_t word, uint32_t bit)
{
    unsigned mask = 0;
    for (unsigned k = 0; k < 4; k++) {
        uint64_t here = row->signs[k][word] >> bit & 1;
        uint64_t beside = bit < 63              ? row->signs[k][word] >> (bit + 1) & 1
                          : word + 1 < c->words ? row->signs[k][word + 1] & 1
                                                : 0;
        mask |= (unsigned)here << (2 * k) | (unsigned)beside << (2 * k + 1);
    }
    return mask;
}

/* The vertex on an edge of the cell at this bit. */
static uint32_t vertex_of(const cell_row *row, uint32_t bit, unsigned edge)
{
    unsigned low = tn_contour_edges[edge][0], axis = (low ^ tn_contour_edges[edge][1]) >> 1, k = low >> 1;
    uint32_t at = bit + (low & 1);
    uint64_t before = at > 63 ? ~(uint64_t)0 : ((uint64_t)1 << at) - 1;
    return row->first[k][axis] + (uint32_t)__builtin_popcountll(row->crossing[k][axis] & before);
}

static bool touches_jump(const tn_contouring *c, const uint32_t corner[3])
{
    for (int i = 0; i < 3; i++)
        if (c->jumping[corner[i] / 64] >> (corner[i] % 64) & 1)
            return true;
    return false;
}

/* Writes (or counts) a cell's triangles; returns how many. */
static uint32_t do_cell(const cells *all, const cell_row *row, uint32_t bit, unsigned mask, uint32_t *out)
{
    const uint8_t *triangles = tn_contour_table[mask];
    uint32_t count = 0;
    if (!out && !all->c->options->jumps_open)
        return triangles[0];
    for (uint32_t t = 0; t < triangles[0]; t++) {
        uint32_t corner[3];
        for (uint32_t i = 0; i < 3; i++)
            corner[i] = vertex_of(row, bit, triangles[1 + 3 * t + i]);
        if (all->c->options->jumps_open && touches_jump(all->c, corner))
            continue;
        if (out)
            memcpy(out + 3 * (size_t)count, corner, sizeof corner);
        count++;
    }
    return count;
}

static tn_status do_layer(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)thread;
    (void)error;
    cells *all = context;
    const tn_contouring *c = all->c;
    uint64_t count = 0;
    for (uint32_t y = 0; y + 1 < c->grid->count[1]; y++) {
        cell_row row;
        open_row(c, y, (uint32_t)item, &row);
        for (size_t word = 0; word < c->words; word++) {
            find_crossing(c, &row, word);
            for (uint64_t mixed = mixed_cells(c, &row, word); mixed; mixed &= mixed - 1) {
                uint32_t bit = (uint32_t)__builtin_ctzll(mixed);
                uint32_t *out = all->corners ? all->corners + 3 * (all->layer_first[item] + count) : NULL;
                count += do_cell(all, &row, bit, mask_of(c, &row, word, bit), out);
            }
            pass_word(&row);
        }
    }
    if (!all->corners)
        all->layer_first[item + 1] = count;
    return TN_OK;
}

tn_status tn_contour_cells(tn_contouring *c, tn_error *error)
{
    uint32_t layers = c->grid->count[2] - 1;
    uint64_t most = c->options->triangles ? c->options->triangles : TN_TRIANGLES_MAX;
    tn_mesh *mesh = &c->out->mesh;
    cells all = {.c = c, .layer_first = calloc((size_t)layers + 1, sizeof *all.layer_first)};
    if (!all.layer_first)
        return tn_fail_memory(error);
    tn_status status = tn_crew_run(c->crew, layers, 1, do_layer, &all, error);
    for (uint32_t z = 0; z < layers; z++)
        all.layer_first[z + 1] += all.layer_first[z];
    uint64_t count = all.layer_first[layers];
    if (status == TN_OK && count > most) {
        status = tn_fail(error, TN_LIMIT, E_FIELD_TRIANGLES, "the mesh has %llu triangles; the limit is %llu",
                         (unsigned long long)count, (unsigned long long)most);
        tn_error_help(error, "take a coarser --grid, or raise --max-triangles");
    }
    if (status == TN_OK) {
        mesh->face_count = (size_t)count;
        mesh->corners = all.corners = malloc((3 * (size_t)count + 1) * sizeof *mesh->corners);
        mesh->face_first = malloc(((size_t)count + 1) * sizeof *mesh->face_first);
        status = mesh->corners && mesh->face_first ? TN_OK : tn_fail_memory(error);
    }
    if (status == TN_OK)
        status = tn_crew_run(c->crew, layers, 1, do_layer, &all, error);
    for (uint32_t i = 0; status == TN_OK && i <= count; i++)
        mesh->face_first[i] = 3 * i;
    free(all.layer_first);
    return status;
}
