/* The stages of meshing a field. Internal to runtime/field. */
#ifndef TARTAN_FIELD_CONTOURING_H
#define TARTAN_FIELD_CONTOURING_H

#include "runtime/base/crew.h"
#include "runtime/field/contour.h"

#define TN_BLOCK 8u /* samples along a block's side */

/* A mesh in the making. */
typedef struct tn_contouring {
    const tn_field *field;
    const tn_field_grid *grid;
    const tn_contour_options *options;
    tn_contour *out;
    tn_crew *crew;
    unsigned threads;
    double *places[3]; /* of the samples, [count] */
    bool flat;         /* layers by themselves (slices.c): no edges along z, and the box is open there */
    uint64_t *signs;   /* a bit a sample, inside is 1: rows of `words` words, by z, then y */
    size_t words;
    uint32_t (*first)[3];  /* of each row: the first vertex on its x, y and z edges */
    uint32_t *layer_jumps; /* vertices that are jumps, of each layer */
    uint32_t *layer_moved; /* that were moved */
    uint64_t *jumping;     /* a bit a vertex */
    uint64_t vertex_count;
} tn_contouring;

static inline const uint64_t *tn_signs_at(const tn_contouring *c, uint32_t y, uint32_t z)
{
    return c->signs + ((size_t)z * c->grid->count[1] + y) * c->words;
}

/* The edges of a row that cross the surface, word by word: along x, or to another row. */
static inline uint64_t tn_crossing_x(const tn_contouring *c, const uint64_t *row, size_t word)
{
    uint64_t next = word + 1 < c->words ? row[word + 1] << 63 : 0;
    uint32_t edges = c->grid->count[0] - 1; /* one less than samples */
    uint64_t crossing = row[word] ^ (row[word] >> 1 | next);
    size_t left = edges > 64 * word ? edges - 64 * word : 0;
    return left >= 64 ? crossing : crossing & (((uint64_t)1 << left) - 1);
}

/* The edges of a row along an axis that cross the surface; `next`: the row at their other ends, NULL along x. */
static inline uint64_t tn_crossing(const tn_contouring *c, const uint64_t *row, const uint64_t *next, size_t word)
{
    return next ? row[word] ^ next[word] : tn_crossing_x(c, row, word);
}

/* Room for signs and numbers, and the samples' places; z: those along z, or NULL for the grid's. TN_MEMORY. Free it
 * with tn_contouring_free in any case. */
tn_status tn_contouring_begin(tn_contouring *c, const double *z, tn_error *error);
void tn_contouring_free(tn_contouring *c);

/* The rows of samples' signs. */
tn_status tn_contour_signs(tn_contouring *c, tn_error *error);

/* Looks for parts of the form between the samples, into c->out. TN_INVALID (E1417) if all of it lies there. */
tn_status tn_contour_missed(tn_contouring *c, tn_error *error);

/* Numbers the vertices and finds their places. */
tn_status tn_contour_roots(tn_contouring *c, tn_error *error);

/* Counts jumps and moved vertices in c->out. */
void tn_contouring_count(const tn_contouring *c);

/* The triangles: those of the table of cells, or with sharp edges. */
tn_status tn_contour_cells(tn_contouring *c, tn_error *error);
tn_status tn_contour_sharp_cells(tn_contouring *c, tn_error *error);

#endif
