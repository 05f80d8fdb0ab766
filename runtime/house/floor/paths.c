/* Finds the shortest ways over a floor: which points see each other, then the shortest sums from each end. */
#include "runtime/house/floor/paths.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

static int64_t size_of(int64_t number)
{
    return number < 0 ? -number : number;
}

/* ---- where one can stand: in one of the closed rectangles, and in none of the open boxes */

typedef struct tn_stand {
    tn_rectangle *places, *boxes;
    size_t place_count, box_count;
} tn_stand;

static bool stand_find(const tn_floor *f, tn_stand *s)
{
    *s = (tn_stand){.places = tn_array_new(f->passage_count + 1, sizeof *s->places),
                    .boxes = tn_array_new(f->obstacle_count + 1, sizeof *s->boxes)};
    if (!s->places || !s->boxes)
        return false;
    if (tn_floor_has_room(f))
        s->places[s->place_count++] = tn_rectangle_grown(&f->clear, -f->way / 2);
    for (size_t i = 0; i < f->passage_count; i++)
        s->places[s->place_count++] = tn_floor_gate(f, &f->passages[i]);
    for (size_t i = 0; i < f->obstacle_count; i++)
        s->boxes[s->box_count++] = tn_rectangle_grown(&f->obstacles[i], f->way / 2);
    return true;
}

static bool is_in(const tn_rectangle *closed, tn_point p)
{
    return closed->x0 <= p.x && p.x <= closed->x1 && closed->y0 <= p.y && p.y <= closed->y1;
}

static bool stands(const tn_stand *s, tn_point p)
{
    bool free = false;
    for (size_t i = 0; !free && i < s->place_count; i++)
        free = is_in(&s->places[i], p);
    for (size_t i = 0; free && i < s->box_count; i++) {
        const tn_rectangle *b = &s->boxes[i];
        free = !(b->x0 < p.x && p.x < b->x1 && b->y0 < p.y && p.y < b->y1);
    }
    return free;
}

/* ---- lines */

/* A part of the way along a line: top / bottom, bottom above 0. */
typedef struct tn_line_share {
    int64_t top, bottom;
} tn_line_share;

static bool is_less(tn_line_share a, tn_line_share b)
{
    return (tn_int128)a.top * b.bottom < (tn_int128)b.top * a.bottom;
}

/* The parts between which a line is between two lines along the other axis. */
typedef struct tn_line_stretch {
    tn_line_share from, to;
} tn_line_stretch;

/* Along one axis: the line begins at `at` and goes so far. `from` is after `to` if it is never between. */
static void narrow(tn_line_stretch *s, int64_t at, int64_t far, int64_t low, int64_t high, bool *never, bool open)
{
    if (far == 0) {
        *never |= open ? at <= low || at >= high : at < low || at > high;
        return;
    }
    int64_t bottom = size_of(far);
    tn_line_share from = {far > 0 ? low - at : at - high, bottom}, to = {far > 0 ? high - at : at - low, bottom};
    s->from = is_less(s->from, from) ? from : s->from;
    s->to = is_less(to, s->to) ? to : s->to;
}

static tn_line_stretch stretch_in(const tn_rectangle *r, tn_point p, tn_point q, bool open, bool *never)
{
    static const tn_line_share before = {-1, 1}, behind = {2, 1};
    tn_line_stretch s = {open ? before : (tn_line_share){0, 1}, open ? behind : (tn_line_share){1, 1}};
    *never = false;
    narrow(&s, p.x, q.x - p.x, r->x0, r->x1, never, open);
    narrow(&s, p.y, q.y - p.y, r->y0, r->y1, never, open);
    return s;
}

/* Does a line come into the open box? */
static bool comes_into(const tn_rectangle *box, tn_point p, tn_point q)
{
    static const tn_line_share begin = {0, 1}, end = {1, 1};
    bool never;
    tn_line_stretch s = stretch_in(box, p, q, true, &never);
    return !never && is_less(s.from, s.to) && is_less(s.from, end) && is_less(begin, s.to);
}

/* Is the whole line in the closed rectangles together? From what is covered so far the one goes on that goes furthest. */
static bool is_covered(const tn_stand *s, tn_point p, tn_point q)
{
    static const tn_line_share end = {1, 1};
    tn_line_share covered = {0, 1};
    bool on = true;
    for (size_t i = 0; i < s->place_count; i++)
        if (is_in(&s->places[i], p) && is_in(&s->places[i], q))
            return true;
    while (on && is_less(covered, end)) {
        on = false;
        for (size_t i = 0; i < s->place_count; i++) {
            bool never;
            tn_line_stretch in = stretch_in(&s->places[i], p, q, false, &never);
            if (never || is_less(in.to, in.from) || is_less(covered, in.from) || !is_less(covered, in.to))
                continue;
            covered = in.to;
            on = true;
        }
    }
    return on;
}

static bool see_each_other(const tn_stand *s, tn_point p, tn_point q)
{
    for (size_t i = 0; i < s->box_count; i++)
        if (comes_into(&s->boxes[i], p, q))
            return false;
    return is_covered(s, p, q);
}

/* ---- points */

static void add_corners(const tn_stand *s, const tn_rectangle *r, tn_floor_paths *paths)
{
    const tn_point corners[] = {{r->x0, r->y0}, {r->x0, r->y1}, {r->x1, r->y0}, {r->x1, r->y1}};
    for (size_t i = 0; i < sizeof corners / sizeof *corners; i++)
        if (stands(s, corners[i]))
            paths->points[paths->count++] = corners[i];
}

static tn_status find_points(const tn_stand *s, const tn_point *ends, size_t count, tn_floor_paths *paths,
                             tn_error *error)
{
    paths->points = tn_array_new(count + 4 * (s->place_count + s->box_count) + 1, sizeof *paths->points);
    if (!paths->points)
        return tn_fail_memory(error);
    if (count > 0)
        memcpy(paths->points, ends, count * sizeof *ends);
    paths->end_count = paths->count = count;
    for (size_t i = 0; i < s->place_count; i++)
        add_corners(s, &s->places[i], paths);
    for (size_t i = 0; i < s->box_count; i++)
        add_corners(s, &s->boxes[i], paths);
    return TN_OK;
}

/* ---- sums */

enum { UNKNOWN = -1 };

typedef struct tn_way_seeking {
    const tn_stand *stand;
    tn_floor_paths *paths;
    int64_t *lines; /* [points][points] UNKNOWN, TN_NO_PATH, or how long */
    bool *settled;  /* [points] */
} tn_way_seeking;

static int64_t line_between(const tn_way_seeking *w, size_t a, size_t b)
{
    int64_t *line = &w->lines[a < b ? a * w->paths->count + b : b * w->paths->count + a];
    tn_point p = w->paths->points[a], q = w->paths->points[b];
    if (*line == UNKNOWN)
        *line = see_each_other(w->stand, p, q) ? tn_distance_up(p, q) : TN_NO_PATH;
    return *line;
}

/* The nearest point that is not settled; the number of points: none is left. */
static size_t nearest(const tn_way_seeking *w, const int64_t *lengths)
{
    size_t best = w->paths->count;
    for (size_t i = 0; i < w->paths->count; i++)
        if (!w->settled[i] && lengths[i] != TN_NO_PATH && (best == w->paths->count || lengths[i] < lengths[best]))
            best = i;
    return best;
}

static void go_from(const tn_way_seeking *w, size_t end)
{
    size_t count = w->paths->count;
    int64_t *lengths = w->paths->lengths + end * count;
    uint32_t *before = w->paths->before + end * count;
    for (size_t i = 0; i < count; i++) {
        lengths[i] = TN_NO_PATH;
        before[i] = (uint32_t)end;
        w->settled[i] = false;
    }
    lengths[end] = stands(w->stand, w->paths->points[end]) ? 0 : TN_NO_PATH;
    for (size_t at = nearest(w, lengths); at < count; at = nearest(w, lengths)) {
        w->settled[at] = true;
        for (size_t i = 0; i < count; i++) {
            int64_t line = w->settled[i] ? TN_NO_PATH : line_between(w, at, i);
            if (line == TN_NO_PATH || lengths[i] <= lengths[at] + line)
                continue;
            lengths[i] = lengths[at] + line;
            before[i] = (uint32_t)at;
        }
    }
}

static tn_status find_lengths(const tn_stand *s, tn_floor_paths *paths, tn_error *error)
{
    tn_way_seeking w = {.stand = s, .paths = paths};
    size_t pairs = tn_size_of(paths->end_count, paths->count), lines = tn_size_of(paths->count, paths->count);
    paths->lengths = tn_array_new(pairs + 1, sizeof *paths->lengths);
    paths->before = tn_array_new(pairs + 1, sizeof *paths->before);
    w.lines = tn_array_new(lines + 1, sizeof *w.lines);
    w.settled = tn_array_new(paths->count + 1, sizeof *w.settled);
    bool ok = paths->lengths && paths->before && w.lines && w.settled;
    for (size_t i = 0; ok && i < lines; i++)
        w.lines[i] = UNKNOWN;
    for (size_t i = 0; ok && i < paths->end_count; i++)
        go_from(&w, i);
    free(w.lines);
    free(w.settled);
    return ok ? TN_OK : tn_fail_memory(error);
}

tn_status tn_floor_paths_find(const tn_floor *floor, const tn_point *ends, size_t count, tn_floor_paths *paths,
                              tn_error *error)
{
    tn_stand s;
    *paths = (tn_floor_paths){0};
    tn_status status = stand_find(floor, &s) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = find_points(&s, ends, count, paths, error);
    if (status == TN_OK)
        status = find_lengths(&s, paths, error);
    free(s.places);
    free(s.boxes);
    return status;
}

void tn_floor_paths_clear(tn_floor_paths *paths)
{
    free(paths->points);
    free(paths->lengths);
    free(paths->before);
    *paths = (tn_floor_paths){0};
}

size_t tn_floor_path_points(const tn_floor_paths *paths, size_t from, size_t to, tn_point *points)
{
    const uint32_t *before = paths->before + from * paths->count;
    size_t count = 1, at = to;
    while (at != from) {
        at = before[at];
        count++;
    }
    at = to;
    for (size_t i = count; i-- > 0; at = before[at])
        points[i] = paths->points[at];
    return count;
}
