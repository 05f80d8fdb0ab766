/* Makes the triangles of the grid's cells: by the table of cells, or with sharp edges. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/field/contour_table.h"
#include "runtime/field/contouring.h"
#include "runtime/field/field.h"
#include "runtime/math/any_width.h"

/* Rows of cells: the edges that they have, by rows of samples. Row k of samples lies at y + (k & 1), z + (k >> 1). */
typedef struct cell_row {
    const uint64_t *signs[4];
    uint32_t first[4][3];    /* the next vertex of each row of edges, at the word at hand */
    uint64_t crossing[4][3]; /* of the word at hand */
    uint64_t corner[8];      /* a bit a cell of the word: is this corner inside? */
} cell_row;

static inline void cell_row_open(const tn_contouring *c, uint32_t y, uint32_t z, cell_row *row)
{
    for (uint32_t k = 0; k < 4; k++) {
        uint32_t at_y = y + (k & 1), at_z = z + (k >> 1);
        row->signs[k] = tn_signs_at(c, at_y, at_z);
        memcpy(row->first[k], c->first[(size_t)at_z * c->grid->count[1] + at_y], sizeof row->first[k]);
    }
}

/* Looks at a word: the corners of its cells, and the edges along each axis that cross; those along y go from rows 0 and
 * 2, along z from 0 and 1. False if all corners are alike, so that nothing crosses. */
static inline bool cell_row_look(const tn_contouring *c, cell_row *row, size_t word)
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

static inline void cell_row_pass(cell_row *row)
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
static inline uint64_t cells_mixed(const tn_contouring *c, const cell_row *row, size_t word)
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

static inline unsigned cell_mask(const cell_row *row, uint32_t bit)
{
    unsigned mask = 0;
    for (unsigned k = 0; k < 8; k++)
        mask |= (unsigned)(row->corner[k] >> bit & 1) << k;
    return mask;
}

/* The vertex on an edge of the cell at this bit. */
static inline uint32_t cell_vertex(const cell_row *row, uint32_t bit, unsigned edge)
{
    unsigned low = tn_contour_edges[edge][0], axis = (low ^ tn_contour_edges[edge][1]) >> 1, k = low >> 1;
    uint32_t at = bit + (low & 1);
    uint64_t before = at > 63 ? ~(uint64_t)0 : ((uint64_t)1 << at) - 1;
    return row->first[k][axis] + (uint32_t)__builtin_popcountll(row->crossing[k][axis] & before);
}

/* Is one of the vertices a jump? */
static inline bool touches_jump(const tn_contouring *c, const uint32_t corner[3])
{
    for (int i = 0; i < 3; i++)
        if (c->jumping[corner[i] / 64] >> (corner[i] % 64) & 1)
            return true;
    return false;
}

/* ==== makes the triangles of the grid's cells, by the table of cells */

typedef struct cells {
    tn_contouring *c;
    uint64_t *layer_first; /* triangles before each layer of cells */
    uint32_t *corners;     /* NULL: they are counted */
} cells;

/* Writes (or counts) a cell's triangles; returns how many. */
__attribute__((always_inline)) static inline uint32_t do_cell(const cells *all, const cell_row *row, uint32_t bit,
                                                              unsigned mask, uint32_t *out)
{
    const uint8_t *triangles = tn_contour_table[mask];
    uint32_t count = 0;
    if (!out && (!all->c->options->jumps_open || all->c->options->survey))
        return triangles[0];
    for (uint32_t t = 0; t < triangles[0]; t++) {
        uint32_t corner[3];
        for (uint32_t i = 0; i < 3; i++)
            corner[i] = cell_vertex(row, bit, triangles[1 + 3 * t + i]);
        if (all->c->options->jumps_open && touches_jump(all->c, corner))
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
        cell_row row;
        cell_row_open(c, y, (uint32_t)item, &row);
        for (size_t word = 0; word < c->words; word++) {
            if (!cell_row_look(c, &row, word))
                continue;
            for (uint64_t mixed = cells_mixed(c, &row, word); mixed; mixed &= mixed - 1) {
                uint32_t bit = (uint32_t)__builtin_ctzll(mixed);
                uint32_t *out = all->corners ? all->corners + 3 * (all->layer_first[item] + count) : NULL;
                count += do_cell(all, &row, bit, cell_mask(&row, bit), out);
            }
            cell_row_pass(&row);
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

/* Room for so many triangles in c->out->mesh, and where each begins. TN_LIMIT (E1415) or TN_MEMORY. */
static tn_status contour_make_room(tn_contouring *c, uint64_t count, tn_error *error)
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
        status = contour_make_room(c, all.layer_first[layers], error);
    all.corners = c->out->mesh.corners;
    if (status == TN_OK && !c->options->survey)
        status = tn_crew_run(c->crew, layers, 1, do_layer, &all, error);
    free(all.layer_first);
    return status;
}

/* ==== makes the triangles of the grid's cells with sharp edges: a loop of vertices whose normals differ becomes a fan
 * round the point nearest to its tangent planes, and sides between two such fans are flipped, so that they run along
 * the edge (docs/field-language.md) */

/* ---- finds the point nearest to some planes, by the eigenvectors of their normal equations */

#define SHARP_COSINE 0x1.bb67ae8584caap-1 /* of 30 degrees */
#define DROPPED 0.01                      /* of the largest eigenvalue: a singular value of 0.1, squared */
#define DESCENTS 64                       /* planes differ by 30 degrees at least, so that each halves what is left */
#define FLAT 1e-9                         /* of a plane that does not depend on a coordinate */
#define SWEEPS 8                          /* Jacobi's method ends after 5 or so for matrices of 3 rows */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Do two of the unit normals differ by more than 30 degrees? False if one of them is zero: there none is known. */
static bool feature_is_sharp(const double (*normals)[3], uint32_t count)
{
    bool sharp = false;
    for (uint32_t i = 0; i < count; i++) {
        if (dot(normals[i], normals[i]) == 0)
            return false;
        for (uint32_t k = 0; k < i; k++)
            sharp |= dot(normals[i], normals[k]) < SHARP_COSINE;
    }
    return sharp;
}

/* Turns rows and columns p and q of a symmetric matrix so that m[p][q] becomes 0; v keeps the product of all turns. */
static void turn(double m[3][3], double v[3][3], int p, int q)
{
    if (m[p][q] == 0)
        return;
    double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
    double c = 1 / sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 3; k++) {
        double a = m[k][p], b = m[k][q];
        m[k][p] = c * a - s * b;
        m[k][q] = s * a + c * b;
    }
    for (int k = 0; k < 3; k++) {
        double a = m[p][k], b = m[q][k], e = v[k][p], f = v[k][q];
        m[p][k] = c * a - s * b;
        m[q][k] = s * a + c * b;
        v[k][p] = c * e - s * f;
        v[k][q] = s * e + c * f;
    }
}

/* Sum of the squared distances from the planes, d from the places' mean: d m d - 2 right d, but for a number. */
typedef struct planes {
    double mean[3], m[3][3], right[3];
} planes;

static planes sum_planes(const double (*places)[3], const double (*normals)[3], uint32_t count)
{
    planes s = {0};
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            s.mean[k] += places[i][k] / count;
    for (uint32_t i = 0; i < count; i++) {
        double off = 0;
        for (int k = 0; k < 3; k++)
            off += normals[i][k] * (places[i][k] - s.mean[k]);
        for (int k = 0; k < 3; k++) {
            s.right[k] += normals[i][k] * off;
            for (int l = 0; l < 3; l++)
                s.m[k][l] += normals[i][k] * normals[i][l];
        }
    }
    return s;
}

/* The least of the sum, without what the planes say little about. */
static void solve(const planes *s, double d[3])
{
    double m[3][3], v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    memcpy(m, s->m, sizeof m);
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++)
                turn(m, v, p, q);
    double least = DROPPED * fmax(m[0][0], fmax(m[1][1], m[2][2]));
    d[0] = d[1] = d[2] = 0;
    for (int e = 0; e < 3; e++) {
        if (!(m[e][e] > least))
            continue;
        double along = (v[0][e] * s->right[0] + v[1][e] * s->right[1] + v[2][e] * s->right[2]) / m[e][e];
        for (int k = 0; k < 3; k++)
            d[k] += along * v[k][e];
    }
}

/* Moves d into the box, to where the sum is least there: one coordinate after the other. */
static void keep_within(const planes *s, const double low[3], const double high[3], double d[3])
{
    for (int k = 0; k < 3; k++)
        d[k] = fmin(fmax(d[k], low[k] - s->mean[k]), high[k] - s->mean[k]);
    for (int step = 0; step < DESCENTS; step++)
        for (int k = 0; k < 3; k++) {
            int p = (k + 1) % 3, q = (k + 2) % 3;
            double best = (s->right[k] - s->m[k][p] * d[p] - s->m[k][q] * d[q]) / s->m[k][k];
            if (s->m[k][k] > FLAT)
                d[k] = fmin(fmax(best, low[k] - s->mean[k]), high[k] - s->mean[k]);
        }
}

/* The point of the box nearest to the planes through these places; along directions that the planes say little about
 * (singular values below 0.1 of the largest) it stays at the places' mean. count: 1 or more. */
static void feature_point(const double (*places)[3], const double (*normals)[3], uint32_t count, const double low[3],
                          const double high[3], double point[3])
{
    planes s = sum_planes(places, normals, count);
    double d[3];
    bool inside = true;
    solve(&s, d);
    for (int k = 0; k < 3; k++)
        inside = inside && d[k] >= low[k] - s.mean[k] && d[k] <= high[k] - s.mean[k];
    if (!inside)
        keep_within(&s, low, high, d);
    for (int k = 0; k < 3; k++)
        point[k] = fmin(fmax(s.mean[k] + d[k], low[k]), high[k]);
}

#define NEAREST                                                                                                        \
    (1.0 / 4096) /* of a cell: the point keeps this distance from its faces, as vertices do from samples               \
                  */
#define EDGES 12u
#define NORMALS_CHUNK 1024u

/* The loops in which a surface runs through a cell: after each edge comes the next of its loop. */
typedef struct loops {
    uint8_t next[EDGES];
    uint16_t first; /* a bit for each edge that a loop begins with */
} loops;

/* What a layer of cells has. Corners of points count from the first point of the layer. */
typedef struct layer {
    uint32_t *corners;
    double *points;
    size_t face_count, corner_capacity, point_count, point_capacity;
} layer;

typedef struct sharpening {
    tn_contouring *c;
    loops table[256];
    double (*normals)[3]; /* of the vertices; zero where none is known */
    double *registers;    /* for gradients, of each thread */
    layer *layers;
} sharpening;

/* ---- normals */

/* Where the box closes the form, the surface is the box's face. */
static bool normal_of_box(const tn_field_grid *grid, const double *vertex, double normal[3])
{
    for (int axis = 0; axis < 3; axis++) {
        double near = 1.01 * NEAREST * (grid->high[axis] - grid->low[axis]) / (grid->count[axis] - 1);
        bool low = vertex[axis] - grid->low[axis] <= near, high = grid->high[axis] - vertex[axis] <= near;
        if (!low && !high)
            continue;
        for (int k = 0; k < 3; k++)
            normal[k] = k != axis ? 0 : low ? -1 : 1;
        return true;
    }
    return false;
}

static tn_status find_normals(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)error;
    sharpening *s = context;
    const tn_contouring *c = s->c;
    double *registers = s->registers + (size_t)thread * 4 * c->field->samples.register_count;
    for (size_t v = item * NORMALS_CHUNK; v < (item + 1) * NORMALS_CHUNK && v < c->vertex_count; v++) {
        const double *vertex = c->out->mesh.positions + 3 * v;
        double gradient[3], size = tn_field_slope(c->field, vertex, c->out->spacing, registers, gradient);
        bool jumps = c->jumping[v / 64] >> (v % 64) & 1;
        for (int k = 0; k < 3; k++)
            s->normals[v][k] = size > 0 && !jumps ? gradient[k] / size : 0;
        if (!(size > 0) && !c->options->open)
            normal_of_box(c->grid, vertex, s->normals[v]);
    }
    return TN_OK;
}

/* ---- loops */

/* The sides of a cell's triangles that no other of them shares make the loops. */
static void find_loops(unsigned mask, loops *to)
{
    const uint8_t *row = tn_contour_table[mask];
    bool side[EDGES][EDGES] = {{false}};
    uint16_t met = 0;
    for (uint32_t t = 0; t < row[0]; t++)
        for (uint32_t k = 0; k < 3; k++)
            side[row[1 + 3 * t + k]][row[1 + 3 * t + (k + 1) % 3]] = true;
    for (uint8_t a = 0; a < EDGES; a++)
        for (uint8_t b = 0; b < EDGES; b++)
            if (side[a][b] && !side[b][a])
                to->next[a] = b;
    for (uint32_t t = 0; t < row[0]; t++) {
        uint8_t first = row[1 + 3 * t], edge = first;
        to->first |= (uint16_t)(met >> first & 1 ? 0 : 1u << first);
        for (; !(met >> edge & 1); edge = to->next[edge])
            met |= (uint16_t)(1u << edge);
    }
}

/* ---- cells */

/* A cell at hand, and of its edges those whose triangles are already made. */
typedef struct cell {
    const cell_row *row;
    uint32_t bit, at[3];
    unsigned mask;
    uint16_t done;
} cell;

static bool add_triangle(layer *to, uint32_t a, uint32_t b, uint32_t c)
{
    if (!tn_array_reserve(&to->corners, &to->corner_capacity, 3 * to->face_count, 3, sizeof *to->corners))
        return false;
    uint32_t *corner = to->corners + 3 * to->face_count++;
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
    return true;
}

/* The part of its cell that a point is kept in. */
static void room_of(const tn_contouring *c, const cell *in, double low[3], double high[3])
{
    for (int axis = 0; axis < 3; axis++) {
        double first = c->places[axis][in->at[axis]], last = c->places[axis][in->at[axis] + 1];
        low[axis] = first + NEAREST * (last - first);
        high[axis] = last - NEAREST * (last - first);
    }
}

/* The fan of a loop, if it is sharp. False if out of memory. */
static bool try_fan(const sharpening *s, layer *to, cell *in, uint8_t first)
{
    const tn_contouring *c = s->c;
    const loops *l = &s->table[in->mask];
    double places[EDGES][3], normals[EDGES][3], low[3], high[3], point[3];
    uint32_t vertex[EDGES + 1], count = 0;
    uint16_t edges = 0;
    for (uint8_t edge = first; !(edges >> edge & 1); edge = l->next[edge]) {
        uint32_t v = vertex[count] = cell_vertex(in->row, in->bit, edge);
        memcpy(places[count], c->out->mesh.positions + 3 * (size_t)v, sizeof places[count]);
        memcpy(normals[count], s->normals[v], sizeof normals[count]);
        edges |= (uint16_t)(1u << edge);
        count++;
    }
    if (!feature_is_sharp((const double(*)[3])normals, count))
        return true;
    room_of(c, in, low, high);
    feature_point((const double(*)[3])places, (const double(*)[3])normals, count, low, high, point);
    if (!tn_array_reserve(&to->points, &to->point_capacity, 3 * to->point_count, 3, sizeof *to->points))
        return false;
    memcpy(to->points + 3 * to->point_count, point, sizeof point);
    vertex[count] = vertex[0];
    uint32_t centre = (uint32_t)(c->vertex_count + to->point_count++);
    bool well = true;
    for (uint32_t i = 0; i < count && well; i++)
        well = add_triangle(to, vertex[i], vertex[i + 1], centre);
    in->done |= edges;
    return well;
}

static bool sharpen_cell(const sharpening *s, layer *to, cell *in)
{
    const uint8_t *row = tn_contour_table[in->mask];
    bool well = true;
    for (uint8_t edge = 0; edge < EDGES && well; edge++)
        if (s->table[in->mask].first >> edge & 1)
            well = try_fan(s, to, in, edge);
    for (uint32_t t = 0; t < row[0] && well; t++) {
        uint32_t corner[3];
        for (uint32_t k = 0; k < 3; k++)
            corner[k] = cell_vertex(in->row, in->bit, row[1 + 3 * t + k]);
        bool left_out = s->c->options->jumps_open && touches_jump(s->c, corner);
        if (!(in->done >> row[1 + 3 * t] & 1) && !left_out)
            well = add_triangle(to, corner[0], corner[1], corner[2]);
    }
    return well;
}

static tn_status sharpen_layer(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)thread;
    sharpening *s = context;
    const tn_contouring *c = s->c;
    for (uint32_t y = 0; y + 1 < c->grid->count[1]; y++) {
        cell_row row;
        cell_row_open(c, y, (uint32_t)item, &row);
        for (size_t word = 0; word < c->words; word++) {
            if (!cell_row_look(c, &row, word))
                continue;
            for (uint64_t mixed = cells_mixed(c, &row, word); mixed; mixed &= mixed - 1) {
                uint32_t bit = (uint32_t)__builtin_ctzll(mixed);
                cell in = {&row, bit, {(uint32_t)(64 * word) + bit, y, (uint32_t)item}, 0, 0};
                in.mask = cell_mask(&row, bit);
                if (!sharpen_cell(s, &s->layers[item], &in))
                    return tn_fail_memory(error);
            }
            cell_row_pass(&row);
        }
    }
    return TN_OK;
}

/* ---- flipping */

/* Two fans that share a side. */
typedef struct shared_side {
    uint64_t ends;    /* the side's, or the two fans' middles */
    uint32_t face[2]; /* [1]: while there is one only, unused */
} shared_side;

static uint64_t ends_of(uint32_t a, uint32_t b)
{
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

static int by_ends(const void *left, const void *right)
{
    const shared_side *a = left, *b = right;
    return a->ends != b->ends ? (a->ends < b->ends ? -1 : 1) : (a->face[0] > b->face[0]) - (a->face[0] < b->face[0]);
}

/* Triangles (a, b, p) and (b, a, q) become (p, a, q) and (q, b, p). */
static void flip(uint32_t *first, uint32_t *second)
{
    uint32_t a = first[0], b = first[1], p = first[2], q = second[2];
    memcpy(first, (uint32_t[3]){p, a, q}, 3 * sizeof *first);
    memcpy(second, (uint32_t[3]){q, b, p}, 3 * sizeof *second);
}

/* Two fans that share two sides keep the second: the new side is there already. */
static tn_status flip_sides(tn_contouring *c, tn_error *error)
{
    tn_mesh *mesh = &c->out->mesh;
    size_t count = 0, pairs = 0;
    for (size_t f = 0; f < mesh->face_count; f++)
        count += mesh->corners[3 * f + 2] >= c->vertex_count;
    shared_side *sides = malloc((count + 1) * sizeof *sides);
    if (!sides)
        return tn_fail_memory(error);
    count = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->corners + 3 * f;
        if (corner[2] >= c->vertex_count)
            sides[count++] = (shared_side){ends_of(corner[0], corner[1]), {(uint32_t)f, 0}};
    }
    qsort(sides, count, sizeof *sides, by_ends);
    for (size_t i = 0; i + 1 < count; i++) {
        if (sides[i].ends != sides[i + 1].ends)
            continue;
        uint32_t f = sides[i].face[0], g = sides[i + 1].face[0];
        uint64_t middles = ends_of(mesh->corners[3 * (size_t)f + 2], mesh->corners[3 * (size_t)g + 2]);
        sides[pairs++] = (shared_side){middles, {f, g}};
        i++;
    }
    qsort(sides, pairs, sizeof *sides, by_ends);
    for (size_t i = 0; i < pairs; i++)
        if (i == 0 || sides[i].ends != sides[i - 1].ends)
            flip(mesh->corners + 3 * (size_t)sides[i].face[0], mesh->corners + 3 * (size_t)sides[i].face[1]);
    free(sides);
    return TN_OK;
}

/* ---- all */

/* Puts the layers' triangles and points together. */
static tn_status join_layers(sharpening *s, tn_error *error)
{
    tn_contouring *c = s->c;
    tn_mesh *mesh = &c->out->mesh;
    uint64_t faces = 0, points = 0, first = 0, at = 0;
    for (uint32_t z = 0; z + 1 < c->grid->count[2]; z++) {
        faces += s->layers[z].face_count;
        points += s->layers[z].point_count;
    }
    tn_status status = contour_make_room(c, faces, error);
    if (status != TN_OK)
        return status;
    if (c->vertex_count + points > UINT32_MAX - 1)
        return tn_fail(error, TN_LIMIT, E_FIELD_TRIANGLES, "the mesh has more than %u vertices, the limit",
                       UINT32_MAX - 1);
    if (!tn_array_resize(&mesh->positions, tn_as_size(3 * (c->vertex_count + points) + 3), sizeof *mesh->positions))
        return tn_fail_memory(error);
    for (uint32_t z = 0; z + 1 < c->grid->count[2]; z++) {
        const layer *l = &s->layers[z];
        for (size_t i = 0; i < 3 * l->face_count; i++)
            mesh->corners[at++] = l->corners[i] + (l->corners[i] >= c->vertex_count ? (uint32_t)first : 0);
        if (l->point_count)
            memcpy(mesh->positions + 3 * (c->vertex_count + first), l->points,
                   3 * l->point_count * sizeof *mesh->positions);
        first += l->point_count;
    }
    mesh->vertex_count = (size_t)(c->vertex_count + points);
    c->out->sharp = points;
    return TN_OK;
}

tn_status tn_contour_sharp_cells(tn_contouring *c, tn_error *error)
{
    uint32_t layers = c->grid->count[2] - 1;
    sharpening *s = calloc(1, sizeof *s);
    if (!s)
        return tn_fail_memory(error);
    s->c = c;
    s->layers = calloc(layers, sizeof *s->layers);
    s->normals = tn_array_new(c->vertex_count + 1, sizeof *s->normals);
    s->registers = malloc((size_t)c->threads * 4 * c->field->samples.register_count * sizeof *s->registers);
    for (unsigned mask = 0; mask < 256; mask++)
        find_loops(mask, &s->table[mask]);
    tn_status status = s->layers && s->normals && s->registers ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_crew_run(c->crew, (size_t)((c->vertex_count + NORMALS_CHUNK - 1) / NORMALS_CHUNK), 1, find_normals,
                             s, error);
    if (status == TN_OK)
        status = tn_crew_run(c->crew, layers, 1, sharpen_layer, s, error);
    if (status == TN_OK)
        status = join_layers(s, error);
    if (status == TN_OK)
        status = flip_sides(c, error);
    for (uint32_t z = 0; s->layers && z < layers; z++) {
        free(s->layers[z].corners);
        free(s->layers[z].points);
    }
    free(s->layers);
    free(s->normals);
    free(s->registers);
    free(s);
    return status;
}
