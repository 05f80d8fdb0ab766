/* Writes the decks of a storey of a building model: each as one slab, whose outline is that of all its rectangles.
 *
 * The rectangles are put on a grid whose lines are at their sides. Its cells in the deck are numbered by the connected
 * parts that they are of; outlines go along their sides, with the deck at the left, so that holes are clockwise. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/export/ifc.h"

/* part: 0 of cells that are not in the deck. seen: a bit for each side that an outline went along. Owns its arrays. */
typedef struct tn_deck_grid {
    int64_t *x, *y; /* lines */
    size_t columns, rows;
    uint32_t *part, parts; /* [column * rows + row] */
    unsigned char *seen;   /* the same */
} tn_deck_grid;

/* A closed line around a part, or around a hole of it: its corners, and its area, which is below 0 around a hole. */
typedef struct tn_deck_ring {
    uint32_t part;
    size_t first, count;
    double area, length;
} tn_deck_ring;

/* Owns its arrays. */
typedef struct tn_deck_outline {
    double (*corners)[2];
    size_t corner_count, corner_room;
    tn_deck_ring *rings;
    size_t ring_count, ring_room;
} tn_deck_outline;

/* ---- the grid */

static int compare(const void *a, const void *b)
{
    const int64_t *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

/* Sorts numbers and leaves out those that are there before. Returns how many are left. */
static size_t settle(int64_t *numbers, size_t count)
{
    size_t kept = 0;
    qsort(numbers, count, sizeof *numbers, compare);
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || numbers[kept - 1] != numbers[i])
            numbers[kept++] = numbers[i];
    return kept;
}

static size_t line_at(const int64_t *lines, size_t count, int64_t at)
{
    const int64_t *found = bsearch(&at, lines, count, sizeof *lines, compare);
    return (size_t)(found - lines);
}

static void grid_clear(tn_deck_grid *grid)
{
    free(grid->x);
    free(grid->y);
    free(grid->part);
    free(grid->seen);
}

/* False without memory. All cells of the deck are of part 1 so far. */
static bool make_grid(const tn_rectangles *deck, tn_deck_grid *grid)
{
    grid->x = malloc(2 * deck->count * sizeof *grid->x);
    grid->y = malloc(2 * deck->count * sizeof *grid->y);
    if (!grid->x || !grid->y)
        return false;
    for (size_t i = 0; i < deck->count; i++) {
        grid->x[2 * i] = deck->items[i].x0;
        grid->x[2 * i + 1] = deck->items[i].x1;
        grid->y[2 * i] = deck->items[i].y0;
        grid->y[2 * i + 1] = deck->items[i].y1;
    }
    size_t across = settle(grid->x, 2 * deck->count), up = settle(grid->y, 2 * deck->count);
    grid->columns = across - 1;
    grid->rows = up - 1;
    grid->part = calloc(grid->columns * grid->rows, sizeof *grid->part);
    grid->seen = calloc(grid->columns * grid->rows, sizeof *grid->seen);
    if (!grid->part || !grid->seen)
        return false;
    for (size_t i = 0; i < deck->count; i++) {
        const tn_rectangle *r = &deck->items[i];
        for (size_t c = line_at(grid->x, across, r->x0); grid->x[c] < r->x1; c++)
            for (size_t k = line_at(grid->y, up, r->y0); grid->y[k] < r->y1; k++)
                grid->part[c * grid->rows + k] = 1;
    }
    return true;
}

/* The part of the cell at a column and a row, which may be beyond the grid: 0. */
static uint32_t part_at(const tn_deck_grid *grid, size_t column, size_t row)
{
    return column < grid->columns && row < grid->rows ? grid->part[column * grid->rows + row] : 0;
}

/* Ways along the lower, right, upper and left side of a cell, and out of it there. Below 0 wraps to beyond the grid. */
static const int ahead[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}}, out_of[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};

static size_t moved(size_t place, int by)
{
    return by < 0 ? place - 1 : place + (size_t)by;
}

/* Numbers the connected parts from 1 on. False without memory. */
static bool number_parts(tn_deck_grid *grid)
{
    size_t cells = grid->columns * grid->rows, left = 0;
    size_t *stack = malloc((cells + 1) * sizeof *stack);
    const uint32_t fresh = UINT32_MAX;
    if (!stack)
        return false;
    for (size_t i = 0; i < cells; i++)
        grid->part[i] = grid->part[i] ? fresh : 0;
    for (size_t i = 0; i < cells; i++) {
        if (grid->part[i] != fresh)
            continue;
        grid->part[i] = ++grid->parts;
        for (stack[left++] = i; left > 0;) {
            size_t at = stack[--left];
            for (int side = 0; side < 4; side++) {
                size_t column = moved(at / grid->rows, out_of[side][0]), row = moved(at % grid->rows, out_of[side][1]);
                if (part_at(grid, column, row) != fresh)
                    continue;
                grid->part[column * grid->rows + row] = grid->parts;
                stack[left++] = column * grid->rows + row;
            }
        }
    }
    free(stack);
    return true;
}

/* ---- outlines */

static bool add_corner(tn_deck_outline *outline, double x, double y)
{
    if (!tn_array_reserve(&outline->corners, &outline->corner_room, outline->corner_count, 1, sizeof *outline->corners))
        return false;
    outline->corners[outline->corner_count][0] = x;
    outline->corners[outline->corner_count++][1] = y;
    return true;
}

/* The next side of the outline: where two cells meet at a corner alone it stays with the part, so that parts do not
 * touch themselves; if both are of one part, with what is outside, so that holes do not. */
static void go_on(const tn_deck_grid *grid, size_t *column, size_t *row, int *side)
{
    size_t next[2] = {moved(*column, ahead[*side][0]), moved(*row, ahead[*side][1])},
           beyond[2] = {moved(next[0], out_of[*side][0]), moved(next[1], out_of[*side][1])};
    uint32_t part = part_at(grid, next[0], next[1]), other = part_at(grid, beyond[0], beyond[1]);
    if (other != 0 && (part != 0 || other == part_at(grid, *column, *row))) {
        *column = beyond[0];
        *row = beyond[1];
        *side = (*side + 3) % 4;
    } else if (part != 0) {
        *column = next[0];
        *row = next[1];
    } else {
        *side = (*side + 1) % 4;
    }
}

/* The ring that goes along a side of a cell. */
static bool follow(tn_deck_grid *grid, size_t column, size_t row, int side, tn_deck_outline *outline)
{
    tn_deck_ring ring = {.part = part_at(grid, column, row), .first = outline->corner_count};
    if (!tn_array_reserve(&outline->rings, &outline->ring_room, outline->ring_count, 1, sizeof *outline->rings))
        return false;
    while (!(grid->seen[column * grid->rows + row] >> side & 1)) {
        int before = side;
        grid->seen[column * grid->rows + row] |= (unsigned char)(1 << side);
        go_on(grid, &column, &row, &side);
        if (side != before && !add_corner(outline, (double)grid->x[column + (side == 1 || side == 2)],
                                          (double)grid->y[row + (side >= 2)]))
            return false;
    }
    ring.count = outline->corner_count - ring.first;
    for (size_t i = 0; i < ring.count; i++) {
        const double *a = outline->corners[ring.first + i], *b = outline->corners[ring.first + (i + 1) % ring.count];
        ring.area += (a[0] * b[1] - b[0] * a[1]) / 2e18;
        ring.length += fabs(b[0] - a[0]) + fabs(b[1] - a[1]);
    }
    outline->rings[outline->ring_count++] = ring;
    return true;
}

static bool find_outline(tn_deck_grid *grid, tn_deck_outline *outline)
{
    for (size_t c = 0; c < grid->columns; c++)
        for (size_t r = 0; r < grid->rows; r++)
            for (int side = 0; side < 4; side++) {
                bool border =
                    part_at(grid, c, r) && !part_at(grid, moved(c, out_of[side][0]), moved(r, out_of[side][1]));
                if (border && !(grid->seen[c * grid->rows + r] >> side & 1) && !follow(grid, c, r, side, outline))
                    return false;
            }
    return true;
}

/* ---- slabs */

/* The solids of the deck below the storey at hand, or (top) of what lies above its highest cells. */
static tn_status take_rectangles(tn_ifc *ifc, bool top, const tn_solid **first, tn_rectangles *deck)
{
    tn_status status = TN_OK;
    tn_error error;
    for (size_t i = 0; status == TN_OK && i < ifc->solids->box_count; i++) {
        const tn_solid *s = &ifc->solids->boxes[i];
        if (top ? s->kind != TN_SOLID_ROOFDECK || ifc->house->cells[s->of].storey != ifc->storey
                : s->kind != TN_SOLID_DECK || s->of != ifc->storey)
            continue;
        *first = *first ? *first : s;
        status = tn_rectangles_add(deck, (tn_rectangle){s->at.x0, s->at.x1, s->at.y0, s->at.y1}, &error);
    }
    return status;
}

/* All go counter-clockwise in the file, as readers are used to. */
static unsigned put_ring(tn_ifc *ifc, const tn_deck_outline *outline, const tn_deck_ring *ring)
{
    return tn_stepfile_ring(&ifc->step, (const double(*)[2])outline->corners + ring->first, ring->count,
                            ring->area < 0);
}

/* The solid of a part, around which a ring goes, without its holes. */
static unsigned put_body(tn_ifc *ifc, const tn_deck_outline *outline, const tn_deck_ring *around, double high)
{
    tn_stepfile *step = &ifc->step;
    tn_stepfile_list holes = {0};
    for (size_t i = 0; i < outline->ring_count; i++)
        if (outline->rings[i].part == around->part && outline->rings[i].area < 0)
            tn_stepfile_list_add(&holes, put_ring(ifc, outline, &outline->rings[i]));
    unsigned line = put_ring(ifc, outline, around);
    const char *inner = tn_stepfile_list_text(&holes);
    unsigned profile = inner ? tn_stepfile_add(step, "IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,#%u,%s)", line, inner)
                             : tn_stepfile_add(step, "IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#%u)", line);
    ifc->failed |= holes.text.failed;
    tn_stepfile_list_clear(&holes);
    return tn_stepfile_extruded(step, profile, 0, high);
}

/* What is known of a slab as a whole. */
typedef struct tn_deck_slab {
    unsigned shape;
    double area, outline;
} tn_deck_slab;

static size_t holes_in(const tn_deck_outline *outline, uint32_t part)
{
    size_t count = 0;
    for (size_t i = 0; i < outline->ring_count; i++)
        count += outline->rings[i].part == part && outline->rings[i].area < 0;
    return count;
}

/* The rectangles of a part, as a solid each. */
static void put_rectangles(tn_ifc *ifc, const tn_rectangles *deck, const tn_deck_grid *grid, uint32_t part, double high,
                           tn_stepfile_list *bodies)
{
    for (size_t i = 0; i < deck->count; i++) {
        const tn_rectangle *r = &deck->items[i];
        size_t column = line_at(grid->x, grid->columns + 1, r->x0), row = line_at(grid->y, grid->rows + 1, r->y0);
        const double low[3] = {(double)r->x0, (double)r->y0, 0}, top[3] = {(double)r->x1, (double)r->y1, high};
        if (part_at(grid, column, row) == part)
            tn_stepfile_list_add(bodies, tn_stepfile_solid(&ifc->step, low, top));
    }
}

/* A part with several holes is written as its rectangles: readers cut triangles from one hole to the next, and leave
 * cracks between holes that are in a row. */
static tn_deck_slab put_bodies(tn_ifc *ifc, const tn_rectangles *deck, const tn_deck_grid *grid,
                               const tn_deck_outline *outline, double high)
{
    tn_deck_slab slab = {0};
    tn_stepfile_list bodies = {0};
    for (size_t i = 0; i < outline->ring_count; i++) {
        const tn_deck_ring *ring = &outline->rings[i];
        slab.area += ring->area;
        if (ring->area < 0)
            continue;
        slab.outline += ring->length;
        if (holes_in(outline, ring->part) > 1)
            put_rectangles(ifc, deck, grid, ring->part, high, &bodies);
        else
            tn_stepfile_list_add(&bodies, put_body(ifc, outline, ring, high));
    }
    slab.shape = tn_ifc_shape(ifc, "SweptSolid", &bodies);
    return slab;
}

static unsigned put_slab(tn_ifc *ifc, bool top, const tn_solid *first, const tn_deck_slab *slab)
{
    const tn_house_form *form = ifc->house->form;
    const char *name = tn_solid_kind_text(first->kind),
               *storey =
                   tn_text(form->module, form->module->STOREY_records[form->record->storey_first + ifc->storey].name);
    char key[TN_NAME_MAX + 20], type[100];
    const double thick = (double)form->record->deck;
    snprintf(key, sizeof key, "%s %s", name, storey);
    tn_ifc_sized_name(ifc, name, form->record->deck, type, sizeof type);
    const tn_ifc_part part = {.entity = "IFCSLAB",
                              .tail = top || ifc->storey > 0 ? ",.FLOOR." : ",.BASESLAB.",
                              .name = name,
                              .type_name = type,
                              .shape = slab->shape,
                              .where = tn_stepfile_placement(&ifc->step, ifc->placement, 0, 0,
                                                             (double)(first->at.z0 - form->level[ifc->storey]))};
    unsigned made = tn_ifc_put(ifc, &part, key);
    const tn_ifc_property properties[] = {tn_ifc_truth("IsExternal", !top && ifc->storey == 0),
                                          tn_ifc_truth("LoadBearing", true)};
    const tn_ifc_quantity quantities[] = {{"Width", 'L', thick},
                                          {"Perimeter", 'L', slab->outline},
                                          {"GrossArea", 'A', slab->area},
                                          {"NetArea", 'A', slab->area},
                                          {"GrossVolume", 'V', slab->area * thick / 1e9},
                                          {"NetVolume", 'V', slab->area * thick / 1e9}};
    tn_ifc_properties(ifc, made, "Pset_SlabCommon", type, properties, 2);
    tn_ifc_quantities(ifc, made, "Qto_SlabBaseQuantities", key, quantities, 6);
    tn_ifc_make_of(ifc, first, made);
    return made;
}

unsigned tn_ifc_put_deck(tn_ifc *ifc, bool top, tn_stepfile_list *list)
{
    tn_rectangles deck = {0};
    tn_deck_grid grid = {0};
    tn_deck_outline outline = {0};
    const tn_solid *first = NULL;
    unsigned made = 0;
    bool good = take_rectangles(ifc, top, &first, &deck) == TN_OK;
    if (good && first) {
        good = make_grid(&deck, &grid) && number_parts(&grid) && find_outline(&grid, &outline);
        if (good) {
            tn_ifc_look_as(ifc, first);
            tn_deck_slab slab = put_bodies(ifc, &deck, &grid, &outline, (double)(first->at.z1 - first->at.z0));
            made = put_slab(ifc, top, first, &slab);
            tn_stepfile_list_add(list, made);
        }
    }
    ifc->failed |= !good;
    free(deck.items);
    grid_clear(&grid);
    free(outline.corners);
    free(outline.rings);
    return made;
}
