/* Finds the parts of a cell's free floor, and which passages, landings and keeps touch which. */
#include "runtime/house/floor/floor.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

#define NO_PART UINT32_MAX

/* The edges in one direction, ascending, each once. Place 2 i of the cut plane is edge i, place 2 i + 1 what lies
 * between it and the next. */
typedef struct tn_floor_edges {
    int64_t *at;
    size_t count, room;
} tn_floor_edges;

/* [places of x][places of y]. */
typedef struct tn_cut_plane {
    const tn_floor *floor;
    tn_floor_edges x, y;
    size_t wide, deep;
    bool *free;
    uint32_t *part; /* NO_PART where nothing is free */
    uint32_t parts;
} tn_cut_plane;

/* Places of the plane, both ends included. */
typedef struct tn_floor_places {
    size_t x0, x1, y0, y1;
} tn_floor_places;

/* ---- what cuts the plane */

tn_rectangle tn_floor_points(const tn_floor *floor, const tn_passage *passage)
{
    const tn_rectangle *c = &floor->clear;
    int64_t from = passage->from + floor->way / 2, to = passage->to - floor->way / 2;
    switch (passage->side) {
    case TN_HOUSE_BACK:
        return (tn_rectangle){from, to, c->y0, c->y0};
    case TN_HOUSE_FRONT:
        return (tn_rectangle){from, to, c->y1, c->y1};
    case TN_HOUSE_LEFT:
        return (tn_rectangle){c->x0, c->x0, from, to};
    default:
        return (tn_rectangle){c->x1, c->x1, from, to};
    }
}

tn_rectangle tn_floor_gate(const tn_floor *floor, const tn_passage *passage)
{
    tn_rectangle gate = tn_floor_points(floor, passage);
    gate.x0 -= passage->side == TN_HOUSE_RIGHT ? floor->way / 2 : 0;
    gate.x1 += passage->side == TN_HOUSE_LEFT ? floor->way / 2 : 0;
    gate.y0 -= passage->side == TN_HOUSE_FRONT ? floor->way / 2 : 0;
    gate.y1 += passage->side == TN_HOUSE_BACK ? floor->way / 2 : 0;
    return gate;
}

static tn_rectangle middle_of(const tn_rectangle *r)
{
    tn_point m = tn_rectangle_middle(r);
    return (tn_rectangle){m.x, m.x, m.y, m.y};
}

bool tn_floor_has_room(const tn_floor *floor)
{
    const tn_rectangle *c = &floor->clear;
    return c->x1 - c->x0 >= floor->way && c->y1 - c->y0 >= floor->way;
}

static void cut(tn_cut_plane *p, tn_rectangle r)
{
    p->x.at[p->x.count++] = r.x0;
    p->x.at[p->x.count++] = r.x1;
    p->y.at[p->y.count++] = r.y0;
    p->y.at[p->y.count++] = r.y1;
}

static int compare_edges(const void *a, const void *b)
{
    const int64_t *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

static void order(tn_floor_edges *edges)
{
    size_t kept = 0;
    qsort(edges->at, edges->count, sizeof *edges->at, compare_edges);
    for (size_t i = 0; i < edges->count; i++)
        if (kept == 0 || edges->at[kept - 1] != edges->at[i])
            edges->at[kept++] = edges->at[i];
    edges->count = kept;
}

static bool find_edges(tn_cut_plane *p)
{
    const tn_floor *f = p->floor;
    size_t most = 1 + 2 * f->passage_count + f->obstacle_count + f->keep_count + f->landing_count;
    p->x.at = malloc(2 * most * sizeof *p->x.at);
    p->y.at = malloc(2 * most * sizeof *p->y.at);
    if (!p->x.at || !p->y.at)
        return false;
    if (tn_floor_has_room(f))
        cut(p, tn_rectangle_grown(&f->clear, -f->way / 2));
    for (size_t i = 0; i < f->passage_count; i++) {
        cut(p, tn_floor_gate(f, &f->passages[i]));
        cut(p, tn_floor_points(f, &f->passages[i]));
    }
    for (size_t i = 0; i < f->obstacle_count; i++)
        cut(p, tn_rectangle_grown(&f->obstacles[i], f->way / 2));
    for (size_t i = 0; i < f->keep_count; i++)
        cut(p, tn_rectangle_grown(&f->keeps[i], f->way / 2));
    for (size_t i = 0; i < f->landing_count; i++)
        cut(p, middle_of(&f->landings[i]));
    order(&p->x);
    order(&p->y);
    p->wide = p->x.count > 0 ? 2 * p->x.count - 1 : 0;
    p->deep = p->y.count > 0 ? 2 * p->y.count - 1 : 0;
    return true;
}

/* The place of an edge that is there. */
static size_t place_of(const tn_floor_edges *edges, int64_t at)
{
    size_t low = 0, high = edges->count - 1;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (edges->at[middle] < at)
            low = middle + 1;
        else
            high = middle;
    }
    return 2 * low;
}

static tn_floor_places places_of(const tn_cut_plane *p, tn_rectangle r)
{
    return (tn_floor_places){place_of(&p->x, r.x0), place_of(&p->x, r.x1), place_of(&p->y, r.y0),
                             place_of(&p->y, r.y1)};
}

/* ---- what is free */

static void set_free(tn_cut_plane *p, tn_rectangle closed)
{
    tn_floor_places at = places_of(p, closed);
    for (size_t x = at.x0; x <= at.x1; x++)
        for (size_t y = at.y0; y <= at.y1; y++)
            p->free[x * p->deep + y] = true;
}

/* The inner part alone: one may touch an obstacle. */
static void set_taken(tn_cut_plane *p, tn_rectangle open)
{
    tn_floor_places at = places_of(p, open);
    for (size_t x = at.x0 + 1; x < at.x1; x++)
        for (size_t y = at.y0 + 1; y < at.y1; y++)
            p->free[x * p->deep + y] = false;
}

static bool find_free(tn_cut_plane *p)
{
    const tn_floor *f = p->floor;
    if (p->deep > 0 && p->wide > UINT32_MAX / 8 / p->deep)
        return false; /* more than a machine of 32 bits has memory for */
    p->free = calloc(p->wide * p->deep + 1, sizeof *p->free);
    if (!p->free)
        return false;
    if (tn_floor_has_room(f))
        set_free(p, tn_rectangle_grown(&f->clear, -f->way / 2));
    for (size_t i = 0; i < f->passage_count; i++)
        set_free(p, tn_floor_gate(f, &f->passages[i]));
    for (size_t i = 0; i < f->obstacle_count; i++)
        set_taken(p, tn_rectangle_grown(&f->obstacles[i], f->way / 2));
    return true;
}

/* ---- its parts */

/* Takes a free place that has no part yet into the last one; false: it is none. */
static bool take(tn_cut_plane *p, size_t place, uint32_t *todo, size_t *count)
{
    if (!p->free[place] || p->part[place] != NO_PART)
        return false;
    p->part[place] = p->parts;
    todo[(*count)++] = (uint32_t)place;
    return true;
}

static void spread(tn_cut_plane *p, uint32_t *todo, size_t count)
{
    while (count > 0) {
        size_t place = todo[--count], x = place / p->deep, y = place % p->deep;
        if (x > 0)
            take(p, place - p->deep, todo, &count);
        if (x + 1 < p->wide)
            take(p, place + p->deep, todo, &count);
        if (y > 0)
            take(p, place - 1, todo, &count);
        if (y + 1 < p->deep)
            take(p, place + 1, todo, &count);
    }
}

static bool find_parts(tn_cut_plane *p)
{
    size_t places = p->wide * p->deep;
    uint32_t *todo = malloc((places + 1) * sizeof *todo);
    p->part = malloc((places + 1) * sizeof *p->part);
    if (!todo || !p->part) {
        free(todo);
        return false;
    }
    memset(p->part, 0xff, places * sizeof *p->part);
    for (size_t i = 0; i < places; i++) {
        size_t count = 0;
        if (!take(p, i, todo, &count))
            continue;
        spread(p, todo, count);
        p->parts++;
    }
    free(todo);
    return true;
}

/* parts := those that the closed rectangle touches, whose edges are there. */
static void find_touched(const tn_cut_plane *p, tn_rectangle r, uint64_t *parts)
{
    tn_floor_places at = places_of(p, r);
    for (size_t x = at.x0; x <= at.x1; x++)
        for (size_t y = at.y0; y <= at.y1; y++) {
            uint32_t part = p->part[x * p->deep + y];
            if (part != NO_PART)
                parts[part / 64] |= UINT64_C(1) << part % 64;
        }
}

static void clear_plane(tn_cut_plane *p)
{
    free(p->x.at);
    free(p->y.at);
    free(p->free);
    free(p->part);
}

/* ---- what is asked of it */

static bool is_empty(const uint64_t *set, size_t words)
{
    for (size_t w = 0; w < words; w++)
        if (set[w] != 0)
            return false;
    return true;
}

static void keep_common(uint64_t *set, const uint64_t *other, size_t words)
{
    for (size_t w = 0; w < words; w++)
        set[w] &= other[w];
}

static bool have_common(const uint64_t *a, const uint64_t *b, size_t words)
{
    for (size_t w = 0; w < words; w++)
        if (a[w] & b[w])
            return true;
    return false;
}

static bool meets_any(const tn_rectangle *r, const tn_rectangle *others, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (tn_rectangles_meet(r, &others[i]))
            return true;
    return false;
}

/* On a landing that is not wholly free nobody stands. */
static void find_joined(const tn_cut_plane *p, tn_floor_answer *a)
{
    const tn_floor *f = p->floor;
    for (size_t i = 0; i < f->passage_count; i++)
        find_touched(p, tn_floor_points(f, &f->passages[i]), a->joined + i * a->words);
    for (size_t i = 0; i < f->landing_count; i++)
        if (tn_rectangle_within(&f->landings[i], &f->clear) &&
            !meets_any(&f->landings[i], f->obstacles, f->obstacle_count))
            find_touched(p, middle_of(&f->landings[i]), a->joined + (f->passage_count + i) * a->words);
}

/* Is a passage or, behind these, a landing one of those that have to be joined? Of an alcove, whose only way in is an
 * open side, nothing is asked; nor of a cell whose only ways in are sides that a flight of stairs takes. */
static bool is_asked(const tn_floor *f, size_t i)
{
    bool others = false, alone = f->passage_count + f->landing_count == 1 && f->keep_count == 0;
    if (i >= f->passage_count)
        return true;
    for (size_t k = 0; k < f->passage_count; k++)
        others |= f->passages[k].kind != TN_PASSAGE_MET;
    return (f->passages[i].kind == TN_PASSAGE_DOOR || !alone) && (others || f->landing_count > 0 || f->keep_count > 0);
}

static void find_fault(tn_floor_answer *a, tn_floor_fault fault, size_t of)
{
    if (a->fault != TN_FLOOR_FITS)
        return;
    a->fault = fault;
    a->of = of;
}

/* common := the parts that all touch which are asked. Returns whether any is asked. */
static bool find_common(const tn_floor *f, tn_floor_answer *a, uint64_t *common)
{
    bool any = false;
    memset(common, 0xff, a->words * sizeof *common);
    for (size_t i = 0; i < f->passage_count + f->landing_count; i++) {
        const uint64_t *own = a->joined + i * a->words;
        if (!is_asked(f, i))
            continue;
        any = true;
        keep_common(common, own, a->words);
        if (is_empty(common, a->words))
            find_fault(a, is_empty(own, a->words) ? TN_FLOOR_SHUT : TN_FLOOR_APART, i);
    }
    return any;
}

bool tn_floor_leaf_has_room(const tn_floor *f, size_t leaf)
{
    const tn_rectangle *r = &f->leaves[leaf];
    for (size_t i = 0; i < f->leaf_count; i++)
        if (i != leaf && tn_rectangles_meet(r, &f->leaves[i]))
            return false;
    return tn_rectangle_within(r, &f->clear) && !meets_any(r, f->obstacles, f->obstacle_count) &&
           !meets_any(r, f->in_air, f->in_air_count) && !meets_any(r, f->landings, f->landing_count);
}

/* common, touched: sets. */
static void judge(const tn_cut_plane *p, tn_floor_answer *a, uint64_t *common, uint64_t *touched)
{
    const tn_floor *f = p->floor;
    find_joined(p, a);
    bool any = find_common(f, a, common), ways_in = f->passage_count + f->landing_count > 0;
    for (size_t k = 0; k < f->keep_count; k++) {
        memset(touched, 0, a->words * sizeof *touched);
        find_touched(p, tn_rectangle_grown(&f->keeps[k], f->way / 2), touched);
        a->keeps[k] = any && have_common(common, touched, a->words);
        if (ways_in && !a->keeps[k])
            find_fault(a, TN_FLOOR_KEEP, k);
    }
    a->ways = a->fault == TN_FLOOR_FITS;
    for (size_t l = 0; l < f->leaf_count; l++) {
        a->leaves[l] = tn_floor_leaf_has_room(f, l);
        if (!a->leaves[l])
            find_fault(a, TN_FLOOR_LEAF, l);
    }
    a->fits = a->fault == TN_FLOOR_FITS;
}

tn_status tn_floor_ask(const tn_floor *floor, tn_floor_answer *a, tn_error *error)
{
    tn_cut_plane plane = {.floor = floor};
    *a = (tn_floor_answer){0};
    bool ok = find_edges(&plane) && find_free(&plane) && find_parts(&plane);
    a->parts = plane.parts;
    a->words = (size_t)plane.parts / 64 + 1;
    uint64_t *sets = ok ? calloc(2 * a->words, sizeof *sets) : NULL;
    a->joined = calloc((floor->passage_count + floor->landing_count) * a->words + 1, sizeof *a->joined);
    a->keeps = calloc(floor->keep_count + 1, sizeof *a->keeps);
    a->leaves = calloc(floor->leaf_count + 1, sizeof *a->leaves);
    ok = sets && a->joined && a->keeps && a->leaves;
    if (ok)
        judge(&plane, a, sets, sets + a->words);
    free(sets);
    clear_plane(&plane);
    return ok ? TN_OK : tn_fail_memory(error);
}

void tn_floor_answer_clear(tn_floor_answer *answer)
{
    free(answer->joined);
    free(answer->keeps);
    free(answer->leaves);
    *answer = (tn_floor_answer){0};
}

/* Whether leaves have room is found sooner than the rest. */
tn_status tn_floor_fits(const tn_floor *floor, bool *fits, tn_error *error)
{
    tn_floor_answer answer;
    *fits = true;
    for (size_t l = 0; *fits && l < floor->leaf_count; l++)
        *fits = tn_floor_leaf_has_room(floor, l);
    if (!*fits)
        return TN_OK;
    tn_status status = tn_floor_ask(floor, &answer, error);
    *fits = status == TN_OK && answer.fits;
    tn_floor_answer_clear(&answer);
    return status;
}

tn_status tn_floor_keeps_joined(const tn_floor *floor, size_t *keep, tn_error *error)
{
    tn_cut_plane plane = {.floor = floor};
    bool ok = find_edges(&plane) && find_free(&plane) && find_parts(&plane);
    size_t words = (size_t)plane.parts / 64 + 1;
    uint64_t *sets = ok ? calloc(2 * words, sizeof *sets) : NULL;
    *keep = SIZE_MAX;
    if (sets)
        memset(sets, 0xff, words * sizeof *sets);
    for (size_t k = 0; sets && *keep == SIZE_MAX && k < floor->keep_count; k++) {
        memset(sets + words, 0, words * sizeof *sets);
        find_touched(&plane, tn_rectangle_grown(&floor->keeps[k], floor->way / 2), sets + words);
        keep_common(sets, sets + words, words);
        *keep = is_empty(sets, words) ? k : SIZE_MAX;
    }
    ok = sets != NULL;
    free(sets);
    clear_plane(&plane);
    return ok ? TN_OK : tn_fail_memory(error);
}

/* ---- where one stops */

/* The parts that are touched by all that is asked before the fault; where that is a keep, by all that is asked. */
static bool find_joined_before(const tn_floor *f, const tn_floor_answer *a, uint64_t *common)
{
    size_t ways = f->passage_count + f->landing_count, end = a->fault == TN_FLOOR_KEEP ? ways : a->of;
    bool any = false;
    memset(common, 0xff, a->words * sizeof *common);
    for (size_t i = 0; i < end; i++) {
        if (!is_asked(f, i))
            continue;
        any = true;
        keep_common(common, a->joined + i * a->words, a->words);
    }
    return any;
}

/* The closed rectangle of a place of the plane. */
static tn_rectangle place_at(const tn_cut_plane *p, size_t place)
{
    size_t x = place / p->deep, y = place % p->deep;
    return (tn_rectangle){p->x.at[x / 2], p->x.at[(x + 1) / 2], p->y.at[y / 2], p->y.at[(y + 1) / 2]};
}

static int64_t nearest_in(int64_t from, int64_t to, int64_t low, int64_t high)
{
    return high < from ? from : low > to ? to : low > from ? low : from;
}

/* The point of a rectangle that is nearest to another, and its distance squared. */
static tn_int128 distance_of(const tn_rectangle *r, const tn_rectangle *to, int64_t *x, int64_t *y)
{
    *x = nearest_in(r->x0, r->x1, to->x0, to->x1);
    *y = nearest_in(r->y0, r->y1, to->y0, to->y1);
    tn_int128 dx = *x < to->x0   ? to->x0 - *x
                   : *x > to->x1 ? *x - to->x1
                                 : 0,
              dy = *y < to->y0   ? to->y0 - *y
                   : *y > to->y1 ? *y - to->y1
                                 : 0;
    return dx * dx + dy * dy;
}

static tn_rectangle square_at(const tn_floor *f, int64_t x, int64_t y)
{
    return (tn_rectangle){x - f->way / 2, x + f->way / 2, y - f->way / 2, y + f->way / 2};
}

/* Where its middle has to come: what is missed, and the places of the middle that would do. */
static void find_missed(const tn_floor *f, const tn_floor_answer *a, tn_rectangle *missed, tn_rectangle *wanted)
{
    if (a->fault == TN_FLOOR_KEEP) {
        *missed = f->keeps[a->of];
        *wanted = tn_rectangle_grown(missed, f->way / 2);
    } else if (a->of < f->passage_count) {
        const tn_passage *passage = &f->passages[a->of];
        *wanted = tn_floor_points(f, passage);
        *missed = *wanted;
        *(passage->side <= TN_HOUSE_FRONT ? &missed->x0 : &missed->y0) -= f->way / 2;
        *(passage->side <= TN_HOUSE_FRONT ? &missed->x1 : &missed->y1) += f->way / 2;
    } else {
        *missed = f->landings[a->of - f->passage_count];
        *wanted = middle_of(missed);
    }
}

/* The places of those parts, and the one that is nearest to what is wanted. */
static tn_status follow_parts(const tn_cut_plane *p, const uint64_t *parts, const tn_rectangle *wanted,
                              tn_floor_stop *stop, tn_error *error)
{
    tn_int128 best = 0;
    stop->ground = malloc((p->wide * p->deep + 1) * sizeof *stop->ground);
    if (!stop->ground)
        return tn_fail_memory(error);
    for (size_t i = 0; i < p->wide * p->deep; i++) {
        uint32_t part = p->part[i];
        int64_t x, y;
        if (part == NO_PART || !(parts[part / 64] >> part % 64 & 1))
            continue;
        tn_rectangle place = place_at(p, i);
        tn_int128 distance = distance_of(&place, wanted, &x, &y);
        if (!stop->stands || distance < best) {
            stop->square = square_at(p->floor, x, y);
            best = distance;
            stop->short_by = tn_root_up(best);
        }
        stop->stands = true;
        stop->ground[stop->ground_count++] = tn_rectangle_grown(&place, p->floor->way / 2);
    }
    return TN_OK;
}

/* Rectangles that cover the same, and are apart: columns between their edges, and in each as few as there can be. */
static tn_status set_apart(tn_floor_stop *stop, tn_error *error)
{
    size_t count = stop->ground_count, made = 0, room = 0;
    tn_rectangle *apart = NULL;
    tn_floor_edges x = {.at = malloc((2 * count + 1) * sizeof *x.at)},
                   y = {.at = malloc((2 * count + 1) * sizeof *y.at)};
    bool ok = x.at && y.at;
    for (size_t i = 0; ok && i < count; i++) {
        x.at[x.count++] = stop->ground[i].x0;
        x.at[x.count++] = stop->ground[i].x1;
        y.at[y.count++] = stop->ground[i].y0;
        y.at[y.count++] = stop->ground[i].y1;
    }
    if (ok) {
        order(&x);
        order(&y);
    }
    for (size_t i = 0; ok && i + 1 < x.count; i++)
        for (size_t k = 0; ok && k + 1 < y.count; k++) {
            const tn_rectangle cell = {x.at[i], x.at[i + 1], y.at[k], y.at[k + 1]};
            tn_rectangle *last = made > 0 ? &apart[made - 1] : NULL;
            if (!meets_any(&cell, stop->ground, count))
                continue;
            if (last && last->x0 == cell.x0 && last->y1 == cell.y0) {
                last->y1 = cell.y1;
                continue;
            }
            ok = tn_array_reserve(&apart, &room, made, 1, sizeof *apart);
            if (ok)
                apart[made++] = cell;
        }
    free(x.at);
    free(y.at);
    free(stop->ground);
    stop->ground = apart;
    stop->ground_count = ok ? made : 0;
    return ok ? TN_OK : tn_fail_memory(error);
}

static tn_status find_stop(const tn_cut_plane *p, const tn_floor_answer *a, tn_floor_stop *stop, tn_error *error)
{
    tn_rectangle wanted;
    uint64_t *parts = calloc(a->words, sizeof *parts);
    tn_status status = parts ? TN_OK : tn_fail_memory(error);
    find_missed(p->floor, a, &stop->missed, &wanted);
    tn_rectangle middle = middle_of(&wanted);
    stop->square = square_at(p->floor, middle.x0, middle.y0);
    if (status == TN_OK && find_joined_before(p->floor, a, parts))
        status = follow_parts(p, parts, &wanted, stop, error);
    if (status == TN_OK)
        status = set_apart(stop, error);
    free(parts);
    return status;
}

tn_status tn_floor_stop_find(const tn_floor *floor, const tn_floor_answer *a, tn_floor_stop *stop, tn_error *error)
{
    tn_cut_plane plane = {.floor = floor};
    tn_status status = TN_OK;
    *stop = (tn_floor_stop){0};
    if (a->fault == TN_FLOOR_LEAF) {
        stop->missed = floor->leaves[a->of];
        return TN_OK;
    }
    if (!find_edges(&plane) || !find_free(&plane) || !find_parts(&plane))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = find_stop(&plane, a, stop, error);
    clear_plane(&plane);
    return status;
}

void tn_floor_stop_clear(tn_floor_stop *stop)
{
    free(stop->ground);
    *stop = (tn_floor_stop){0};
}
