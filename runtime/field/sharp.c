/* Makes the triangles of the grid's cells with sharp edges: a loop of vertices whose normals differ becomes a fan round
 * the point nearest to its tangent planes, and sides between two such fans are flipped, so that they run along the edge
 * (docs/field-language.md). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/field/cell_row.h"
#include "runtime/field/feature.h"
#include "runtime/field/normals.h"

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
    const tn_cell_row *row;
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

/* The fan of a loop, if it is sharp. False where out of memory. */
static bool try_fan(const sharpening *s, layer *to, cell *in, uint8_t first)
{
    const tn_contouring *c = s->c;
    const loops *l = &s->table[in->mask];
    double places[EDGES][3], normals[EDGES][3], low[3], high[3], point[3];
    uint32_t vertex[EDGES + 1], count = 0;
    uint16_t edges = 0;
    for (uint8_t edge = first; !(edges >> edge & 1); edge = l->next[edge]) {
        uint32_t v = vertex[count] = tn_cell_vertex(in->row, in->bit, edge);
        memcpy(places[count], c->out->mesh.positions + 3 * (size_t)v, sizeof places[count]);
        memcpy(normals[count], s->normals[v], sizeof normals[count]);
        edges |= (uint16_t)(1u << edge);
        count++;
    }
    if (!tn_feature_is_sharp((const double(*)[3])normals, count))
        return true;
    room_of(c, in, low, high);
    tn_feature_point((const double(*)[3])places, (const double(*)[3])normals, count, low, high, point);
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

static bool do_cell(const sharpening *s, layer *to, cell *in)
{
    const uint8_t *row = tn_contour_table[in->mask];
    bool well = true;
    for (uint8_t edge = 0; edge < EDGES && well; edge++)
        if (s->table[in->mask].first >> edge & 1)
            well = try_fan(s, to, in, edge);
    for (uint32_t t = 0; t < row[0] && well; t++) {
        uint32_t corner[3];
        for (uint32_t k = 0; k < 3; k++)
            corner[k] = tn_cell_vertex(in->row, in->bit, row[1 + 3 * t + k]);
        bool left_out = s->c->options->jumps_open && tn_touches_jump(s->c, corner);
        if (!(in->done >> row[1 + 3 * t] & 1) && !left_out)
            well = add_triangle(to, corner[0], corner[1], corner[2]);
    }
    return well;
}

static tn_status do_layer(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)thread;
    sharpening *s = context;
    const tn_contouring *c = s->c;
    for (uint32_t y = 0; y + 1 < c->grid->count[1]; y++) {
        tn_cell_row row;
        tn_cell_row_open(c, y, (uint32_t)item, &row);
        for (size_t word = 0; word < c->words; word++) {
            if (!tn_cell_row_look(c, &row, word))
                continue;
            for (uint64_t mixed = tn_cells_mixed(c, &row, word); mixed; mixed &= mixed - 1) {
                uint32_t bit = (uint32_t)__builtin_ctzll(mixed);
                cell in = {&row, bit, {(uint32_t)(64 * word) + bit, y, (uint32_t)item}, 0, 0};
                in.mask = tn_cell_mask(&row, bit);
                if (!do_cell(s, &s->layers[item], &in))
                    return tn_fail_memory(error);
            }
            tn_cell_row_pass(&row);
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
    tn_status status = tn_contour_make_room(c, faces, error);
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
        status = tn_crew_run(c->crew, layers, 1, do_layer, s, error);
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
