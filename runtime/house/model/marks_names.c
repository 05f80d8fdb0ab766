/* Letters the rooms of a plan: name, number and net area of each, where no furniture is below and no door swings. */
#include "runtime/house/model/marks_names.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/length.h"
#include "runtime/base/utf8.h"

#define LEADING 1.3 /* from line to line, in the size of the lettering */

enum {
    PLACES = 12, /* on either side of the middle, along and across */
    LINES_MOST = 3
};

/* What is written in a room, and how wide and high that is in nanometres. */
typedef struct tn_name_lines {
    const char *lines[LINES_MOST];
    size_t count;
    double wide, high;
} tn_name_lines;

/* Where it stands, and which share of it covers something else. */
typedef struct tn_name_place {
    double x, y, covered;
    bool upright;
} tn_name_place;

/* What is in a room: within the rectangle of a cell, in the drawing. */
typedef struct tn_naming {
    const tn_house *house;
    const tn_taken *taken;
    double lettering;
    tn_rectangle *near;            /* owned; has room for all that is taken */
    size_t near_count, item_count; /* first what stands there, then doors and tags */
    tn_rectangle cell;
} tn_naming;

static double overlap(double low, double high, double from, double to)
{
    double a = low > from ? low : from, b = high < to ? high : to;
    return b > a ? b - a : 0;
}

#define DOOR_WEIGHT 3 /* a name over furniture can be read more easily than one over a tag */

static double covered_of(const tn_naming *n, double x, double y, double half_wide, double half_high)
{
    double covered = 0;
    for (size_t i = 0; i < n->near_count; i++) {
        const tn_rectangle *r = &n->near[i];
        covered += (i < n->item_count ? 1 : DOOR_WEIGHT) *
                   overlap(x - half_wide, x + half_wide, (double)r->x0, (double)r->x1) *
                   overlap(y - half_high, y + half_high, (double)r->y0, (double)r->y1);
    }
    return covered;
}

static void gather(tn_naming *n, const tn_rectangles *from)
{
    for (size_t i = 0; i < from->count; i++) {
        const tn_rectangle *r = &from->items[i];
        if (r->x0 < n->cell.x1 && r->x1 > n->cell.x0 && r->y0 < n->cell.y1 && r->y1 > n->cell.y0)
            n->near[n->near_count++] = *r;
    }
}

static void enter(tn_naming *n, uint32_t cell)
{
    n->cell = tn_turned(tn_cell_clear(n->house, cell));
    n->near_count = 0;
    gather(n, &n->taken->items);
    n->item_count = n->near_count;
    gather(n, &n->taken->swings);
}

/* The place in the cell where least is below it, and of those the nearest to the middle; false if there is no room. */
static bool find_place(const tn_naming *n, const tn_name_lines *lines, bool upright, tn_name_place *best)
{
    const tn_rectangle *r = &n->cell;
    double x = (double)(r->x0 + r->x1) / 2, y = (double)(r->y0 + r->y1) / 2, near = INFINITY;
    double half_wide = (upright ? lines->high : lines->wide) / 2, half_high = (upright ? lines->wide : lines->high) / 2;
    double out = ((double)(r->x1 - r->x0) / 2 - half_wide) / PLACES,
           up = ((double)(r->y1 - r->y0) / 2 - half_high) / PLACES;
    best->covered = INFINITY;
    if (out < 0 || up < 0)
        return false;
    for (int i = -PLACES; i <= PLACES; i++)
        for (int k = -PLACES; k <= PLACES; k++) {
            double u = x + i * out, v = y + k * up, away = (u - x) * (u - x) + (v - y) * (v - y);
            double covered = covered_of(n, u, v, half_wide, half_high) / (4 * half_wide * half_high);
            if (covered > best->covered || (covered == best->covered && away >= near))
                continue;
            *best = (tn_name_place){u, v, covered, upright};
            near = away;
        }
    return true;
}

static void put_lines(const tn_naming *n, const tn_name_lines *lines, const tn_name_place *place, tn_marks *marks)
{
    for (size_t i = 0; i < lines->count; i++) {
        double up = LEADING * n->lettering * ((double)(lines->count - 1) / 2 - (double)i);
        tn_marks_text(marks, TN_MARK_NAME, place->upright ? place->x - up : place->x,
                      place->upright ? place->y : place->y + up, n->lettering, place->upright, lines->lines[i]);
    }
}

static void add_line(tn_name_lines *lines, const tn_naming *n, const char *line)
{
    double wide = (tn_mark_width(line) + 0.3) * n->lettering;
    lines->lines[lines->count++] = line;
    lines->wide = wide > lines->wide ? wide : lines->wide;
    lines->high = LEADING * n->lettering * (double)lines->count;
}

/* Level or upright, in the largest cell first. Better places are those that cover less. */
static bool find_in_room(tn_naming *n, const tn_designations *names, const tn_numbered_room *room,
                         const tn_name_lines *lines, tn_name_place *best)
{
    best->covered = INFINITY;
    for (uint32_t i = 0, cell = room->largest; i <= n->house->cell_count && best->covered > 0; cell = i++) {
        const tn_cell *c = &n->house->cells[cell];
        if (names->rooms[cell] != room->room || c->storey != room->storey || c->open)
            continue;
        enter(n, cell);
        for (int upright = 0; upright < 2; upright++) {
            tn_name_place place;
            if (find_place(n, lines, upright, &place) && place.covered < best->covered)
                *best = place;
        }
    }
    return best->covered < INFINITY;
}

#define COVERED_MOST 0.02 /* of what is written, so that it can be read */

/* All of it; without the area; the number alone, which the schedule explains. Of these the first that covers nothing,
 * or else the one that covers least. If there is no room for any, the number stands in the middle. */
static void put_name(tn_naming *n, const tn_designations *names, const tn_numbered_room *room, const char *area,
                     tn_marks *marks)
{
    const char *const said[] = {room->name, room->number, area};
    static const struct {
        size_t first, count;
    } choices[] = {{0, 3}, {0, 2}, {1, 1}};
    tn_name_lines best_lines = {0};
    tn_name_place best = {.covered = INFINITY};
    for (size_t c = 0; c < 3 && best.covered > COVERED_MOST; c++) {
        tn_name_lines lines = {0};
        tn_name_place place;
        for (size_t i = 0; i < choices[c].count; i++)
            add_line(&lines, n, said[choices[c].first + i]);
        bool found = find_in_room(n, names, room, &lines, &place);
        if (!found && c + 1 == sizeof choices / sizeof *choices && best.covered == INFINITY) {
            enter(n, room->largest);
            place =
                (tn_name_place){(double)(n->cell.x0 + n->cell.x1) / 2, (double)(n->cell.y0 + n->cell.y1) / 2, 0, false};
            found = true;
        }
        if (found && place.covered < best.covered) {
            best = place;
            best_lines = lines;
        }
    }
    put_lines(n, &best_lines, &best, marks);
}

tn_status tn_marks_names(const tn_house *house, uint32_t storey, const tn_mark_style *style,
                         const tn_designations *names, const tn_taken *taken, tn_marks *marks, tn_error *error)
{
    tn_naming naming = {.house = house,
                        .taken = taken,
                        .lettering = style->lettering,
                        .near = malloc((taken->items.count + taken->swings.count + 1) * sizeof *naming.near)};
    if (!naming.near)
        return tn_fail_memory(error);
    for (size_t i = 0; i < names->room_count; i++) {
        char area[32];
        const tn_numbered_room *room = &names->numbered[i];
        if (room->storey != storey)
            continue;
        tn_mark_area(style->us, room->net, area);
        put_name(&naming, names, room, area, marks);
    }
    free(naming.near);
    return marks->failed ? tn_fail_memory(error) : TN_OK;
}
