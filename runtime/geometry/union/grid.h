/* What the files of the union share: points and lines, counted in steps. Internal to union*.c. */
#ifndef TARTAN_GEOMETRY_UNION_GRID_H
#define TARTAN_GEOMETRY_UNION_GRID_H

#include "runtime/base/array.h"
#include "runtime/base/hash_table.h"
#include "runtime/geometry/union/union.h"
#include "runtime/geometry/union/wide.h"

#define TN_NOTHING UINT32_MAX

/* A line along an axis (kind 0, 1, 2: the two other coordinates, by number of axis, are p and q), or one that lies in a
 * plane across axis kind - 3 at coordinate p: a * u + b * v = c there, with u and v the next two axes; a and b have no
 * common divisor and a > 0, or a = 0 and b > 0. TN_GRID_FREE: in no such plane, from vertex p to vertex q, p < q; caps
 * alone have edges along such lines, and those that meet there have whole edges in common. */
#define TN_GRID_FREE 6u
typedef struct tn_grid_line {
    uint32_t kind;
    int64_t p, q, a, b;
    tn_int128 c;
} tn_grid_line;

typedef struct tn_grid_vertex {
    int64_t at[3];
} tn_grid_vertex;

/* A vertex lies on a line. */
typedef struct tn_grid_stop {
    uint32_t line, vertex;
} tn_grid_stop;

/* A vertex as two lines of a plane make it; a corner of a cell is where it is, and has none. */
typedef struct tn_grid_point {
    uint32_t vertex;
    uint32_t one, other; /* lines; TN_NOTHING: of a corner */
} tn_grid_point;

/* A corner of a polygon, and the line that its edge to the next goes along. side: the sign that the line's equation has
 * inside. */
typedef struct tn_ring_corner {
    tn_grid_point point;
    uint32_t line;
    int side;
} tn_ring_corner;

typedef struct tn_ring {
    uint32_t first, count; /* corners */
    uint32_t cell;
    uint32_t face; /* 2 * axis, + 1 where its outside is the high side; TN_CUT_BOX_CAP */
} tn_ring;

/* An edge that gets a vertex in its middle. */
typedef struct tn_grid_split {
    uint32_t low, high, middle; /* vertices; low < high */
} tn_grid_split;

typedef struct tn_grid {
    double step;
    bool merging; /* a crossing of lines becomes the vertex that is a few steps away, if there is one */
    tn_grid_vertex *vertices;
    size_t vertex_count, vertex_capacity;
    tn_hash_table vertex_index;
    tn_grid_line *lines;
    size_t line_count, line_capacity;
    tn_hash_table line_index;
    tn_grid_stop *stops;
    size_t stop_count, stop_capacity;
    size_t *line_stops; /* [line_count + 1] into stops, once they are sorted */
    /* polygons of the boundary */
    tn_ring_corner *corners;
    size_t corner_count, corner_capacity;
    tn_ring *rings;
    size_t ring_count, ring_capacity;
    tn_grid_split *splits; /* by their vertices */
    size_t split_count, split_capacity;
    bool failed; /* out of memory */
} tn_grid;

void tn_grid_clear(tn_grid *grid);

/* E_SOLID_TOO_FINE. */
tn_status tn_union_too_fine(tn_error *error);

/* Makes room for one more of what `items` points to the pointer of. */
bool tn_grid_room(tn_grid *grid, void *items, size_t size, size_t count, size_t *capacity);

uint32_t tn_grid_vertex_of(tn_grid *grid, const int64_t at[3]);
uint32_t tn_grid_line_through(tn_grid *grid, uint32_t from, uint32_t to);
void tn_grid_stop_at(tn_grid *grid, uint32_t line, uint32_t vertex);

/* The sign of the line's equation at a point, both in the plane across the axis. */
int tn_grid_side(const tn_grid *grid, int axis, uint32_t line, const tn_grid_point *point);

/* The same of what is inside a polygon whose edge goes from one vertex to another, on its left in the plane's u and v.
 */
int tn_grid_inside(const tn_grid *grid, int axis, uint32_t line, uint32_t from, uint32_t to);

/* Where two lines of the plane across the axis at w cross; they do. */
tn_grid_point tn_grid_crossing(tn_grid *grid, int axis, int64_t w, uint32_t one, uint32_t other);

/* Appends a polygon of the boundary. */
void tn_grid_add_ring(tn_grid *grid, const tn_ring_corner *corners, uint32_t count, uint32_t cell, uint32_t face);

/* The polygons of cells' faces in all planes less those that lie against them; caps as they are, but for those that are
 * each other's other side. */
void tn_grid_planes(tn_grid *grid, const tn_cut_box *cells, size_t count);

/* The boundary's triangles, from its polygons. */
tn_status tn_grid_triangles(tn_grid *grid, tn_mesh *mesh, tn_error *error);

#endif
