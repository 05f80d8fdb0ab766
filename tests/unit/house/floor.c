/* Free floors of small random cells, by brute force: the square itself is moved by steps of half a unit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/house/floor/floor.h"

enum { CELLS = 4000, LARGEST = 9, REACH = 6, SPAN = 2 * (LARGEST + 2 * REACH) + 1, MOST = 8 };

/* A cell from (0, 0) on, and what is in it. */
typedef struct drawn {
    tn_floor floor;
    tn_rectangle obstacles[MOST], keeps[MOST], leaves[MOST], landings[MOST], in_air[MOST];
    tn_passage passages[MOST];
} drawn;

/* Where the square's middle can be, in half units from (-REACH, -REACH): the part that it is in, from 1 on. */
typedef struct moved {
    uint32_t part[SPAN][SPAN], parts;
} moved;

static int64_t draw(uint64_t *state, int64_t below)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (int64_t)((*state >> 33) % (uint64_t)below);
}

/* ---- cells */

static tn_rectangle draw_box(uint64_t *s, const tn_rectangle *in, int64_t most)
{
    int64_t x = draw(s, in->x1), y = draw(s, in->y1), wide = 1 + draw(s, most), deep = 1 + draw(s, most);
    return (tn_rectangle){x, x + wide < in->x1 ? x + wide : in->x1, y, y + deep < in->y1 ? y + deep : in->y1};
}

static size_t draw_boxes(uint64_t *s, const tn_rectangle *in, int64_t most, tn_rectangle *boxes)
{
    size_t count = (size_t)draw(s, most);
    for (size_t i = 0; i < count; i++)
        boxes[i] = draw_box(s, in, 4);
    return count;
}

/* One way or longer; a door has a leaf, half of the time. */
static void draw_passage(uint64_t *s, drawn *d, tn_house_side side)
{
    const tn_rectangle *c = &d->floor.clear;
    bool in_x = side == TN_HOUSE_BACK || side == TN_HOUSE_FRONT;
    int64_t way = d->floor.way, length = in_x ? c->x1 : c->y1;
    if (length < way)
        return;
    int64_t from = draw(s, length - way + 1),
            to = draw(s, 3) ? from + way : from + way + draw(s, length - way - from + 1);
    tn_passage_kind kind = (tn_passage_kind)draw(s, 3);
    d->passages[d->floor.passage_count++] = (tn_passage){side, kind, from, to};
    if (kind != TN_PASSAGE_DOOR || draw(s, 2))
        return;
    d->leaves[d->floor.leaf_count++] = side == TN_HOUSE_BACK    ? (tn_rectangle){from, to, 0, way}
                                       : side == TN_HOUSE_FRONT ? (tn_rectangle){from, to, c->y1 - way, c->y1}
                                       : side == TN_HOUSE_LEFT  ? (tn_rectangle){0, way, from, to}
                                                                : (tn_rectangle){c->x1 - way, c->x1, from, to};
}

static void draw_cell(uint64_t *s, drawn *d)
{
    *d = (drawn){.floor = {.way = draw(s, 3) ? 2 : 4, .clear = {0, 1 + draw(s, LARGEST), 0, 1 + draw(s, LARGEST)}}};
    tn_floor *f = &d->floor;
    f->obstacles = d->obstacles;
    f->keeps = d->keeps;
    f->leaves = d->leaves;
    f->landings = d->landings;
    f->in_air = d->in_air;
    f->passages = d->passages;
    f->obstacle_count = draw_boxes(s, &f->clear, 5, d->obstacles);
    f->keep_count = draw_boxes(s, &f->clear, 3, d->keeps);
    f->landing_count = draw(s, 3) ? 0 : draw_boxes(s, &f->clear, 3, d->landings);
    f->in_air_count = draw(s, 4) ? 0 : draw_boxes(s, &f->clear, 2, d->in_air);
    for (tn_house_side side = TN_HOUSE_BACK; side <= TN_HOUSE_RIGHT; side++)
        if (draw(s, 2))
            draw_passage(s, d, side);
}

/* ---- the square is moved */

static tn_rectangle doubled(const tn_rectangle *r)
{
    return (tn_rectangle){2 * r->x0, 2 * r->x1, 2 * r->y0, 2 * r->y1};
}

/* Is the square, all lengths doubled, partly in the passage: no more than half through, and within its stretch? */
static bool is_in_passage(const tn_floor *f, const tn_passage *p, const tn_rectangle *square)
{
    tn_rectangle c = doubled(&f->clear), bounds = {INT64_MIN, INT64_MAX, INT64_MIN, INT64_MAX};
    bool in_x = p->side == TN_HOUSE_BACK || p->side == TN_HOUSE_FRONT;
    if (in_x) {
        bounds.x0 = 2 * p->from;
        bounds.x1 = 2 * p->to;
        bounds.y0 = p->side == TN_HOUSE_BACK ? c.y0 - f->way : c.y1 - 2 * f->way;
        bounds.y1 = bounds.y0 + 3 * f->way;
    } else {
        bounds.y0 = 2 * p->from;
        bounds.y1 = 2 * p->to;
        bounds.x0 = p->side == TN_HOUSE_LEFT ? c.x0 - f->way : c.x1 - 2 * f->way;
        bounds.x1 = bounds.x0 + 3 * f->way;
    }
    return tn_rectangle_within(square, &bounds);
}

static bool stands(const tn_floor *f, const tn_rectangle *square)
{
    tn_rectangle clear = doubled(&f->clear);
    bool there = tn_rectangle_within(square, &clear);
    for (size_t i = 0; i < f->passage_count; i++)
        there |= is_in_passage(f, &f->passages[i], square);
    for (size_t i = 0; i < f->obstacle_count; i++) {
        tn_rectangle other = doubled(&f->obstacles[i]);
        there &= !tn_rectangles_meet(square, &other);
    }
    return there;
}

static tn_rectangle square_at(const tn_floor *f, int x, int y)
{
    int64_t at_x = x - 2 * REACH, at_y = y - 2 * REACH;
    return (tn_rectangle){at_x - f->way, at_x + f->way, at_y - f->way, at_y + f->way};
}

static void spread(const tn_floor *f, int x, int y, moved *m)
{
    if (x < 0 || y < 0 || x >= SPAN || y >= SPAN || m->part[x][y])
        return;
    tn_rectangle square = square_at(f, x, y);
    if (!stands(f, &square))
        return;
    m->part[x][y] = m->parts;
    spread(f, x - 1, y, m);
    spread(f, x + 1, y, m);
    spread(f, x, y - 1, m);
    spread(f, x, y + 1, m);
}

static void move(const tn_floor *f, moved *m)
{
    memset(m, 0, sizeof *m);
    for (int x = 0; x < SPAN; x++)
        for (int y = 0; y < SPAN; y++) {
            tn_rectangle square = square_at(f, x, y);
            if (m->part[x][y] || !stands(f, &square))
                continue;
            m->parts++;
            spread(f, x, y, m);
        }
}

/* ---- compared */

/* Bits of the parts that are met where the square's middle is in a closed rectangle, in half units. */
static uint64_t parts_in(const moved *m, tn_rectangle r)
{
    uint64_t met = 0;
    for (int x = 0; x < SPAN; x++)
        for (int y = 0; y < SPAN; y++)
            if (m->part[x][y] && x - 2 * REACH >= r.x0 && x - 2 * REACH <= r.x1 && y - 2 * REACH >= r.y0 &&
                y - 2 * REACH <= r.y1)
                met |= UINT64_C(1) << m->part[x][y];
    return met;
}

/* The middle of a square half through the side, all doubled. */
static tn_rectangle on_side(const tn_floor *f, const tn_passage *p)
{
    tn_rectangle c = doubled(&f->clear);
    int64_t from = 2 * p->from + f->way, to = 2 * p->to - f->way;
    return p->side == TN_HOUSE_BACK    ? (tn_rectangle){from, to, c.y0, c.y0}
           : p->side == TN_HOUSE_FRONT ? (tn_rectangle){from, to, c.y1, c.y1}
           : p->side == TN_HOUSE_LEFT  ? (tn_rectangle){c.x0, c.x0, from, to}
                                       : (tn_rectangle){c.x1, c.x1, from, to};
}

static tn_rectangle on_landing(const tn_rectangle *r)
{
    int64_t x = (r->x0 + r->x1) / 2, y = (r->y0 + r->y1) / 2;
    return (tn_rectangle){2 * x, 2 * x, 2 * y, 2 * y};
}

static bool meets_any(const tn_rectangle *r, const tn_rectangle *others, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (tn_rectangles_meet(r, &others[i]))
            return true;
    return false;
}

static uint64_t parts_at(const drawn *d, const moved *m, size_t i)
{
    const tn_floor *f = &d->floor;
    if (i < f->passage_count)
        return parts_in(m, on_side(f, &f->passages[i]));
    const tn_rectangle *landing = &f->landings[i - f->passage_count];
    return meets_any(landing, f->obstacles, f->obstacle_count) ? 0 : parts_in(m, on_landing(landing));
}

/* Parts are numbered otherwise here: what is compared is which of two have one in common. */
static void compare_joined(const drawn *d, const moved *m, const tn_floor_answer *a)
{
    size_t count = d->floor.passage_count + d->floor.landing_count;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < count; k++) {
            bool common = false;
            for (size_t w = 0; w < a->words; w++)
                common |= (a->joined[i * a->words + w] & a->joined[k * a->words + w]) != 0;
            assert_int_equal(common, (parts_at(d, m, i) & parts_at(d, m, k)) != 0);
        }
}

static bool leaf_has_room(const tn_floor *f, size_t leaf)
{
    bool room = true;
    for (size_t i = 0; i < f->leaf_count; i++)
        room &= i == leaf || !tn_rectangles_meet(&f->leaves[i], &f->leaves[leaf]);
    return room && tn_rectangle_within(&f->leaves[leaf], &f->clear) &&
           !meets_any(&f->leaves[leaf], f->obstacles, f->obstacle_count) &&
           !meets_any(&f->leaves[leaf], f->in_air, f->in_air_count) &&
           !meets_any(&f->leaves[leaf], f->landings, f->landing_count);
}

/* Does the cell fit, as the definition says it? */
static bool fits(const drawn *d, const moved *m)
{
    const tn_floor *f = &d->floor;
    size_t ways_in = f->passage_count + f->landing_count, unmet = 0;
    uint64_t common = UINT64_MAX;
    bool fit = true;
    for (size_t i = 0; i < f->passage_count; i++)
        unmet += f->passages[i].kind != TN_PASSAGE_MET;
    bool alcove = ways_in == 1 && f->passage_count == 1 && f->keep_count == 0 && f->passages[0].kind != TN_PASSAGE_DOOR;
    bool taken = unmet == 0 && f->landing_count == 0 && f->keep_count == 0;
    for (size_t i = 0; !alcove && !taken && i < ways_in; i++)
        common &= parts_at(d, m, i);
    fit = common != 0;
    for (size_t k = 0; ways_in > 0 && k < f->keep_count; k++) {
        tn_rectangle near = tn_rectangle_grown(&f->keeps[k], f->way / 2);
        fit &= (parts_in(m, doubled(&near)) & common) != 0;
    }
    for (size_t l = 0; l < f->leaf_count; l++)
        fit &= leaf_has_room(f, l);
    return fit;
}

/* ---- how far one comes */

/* The parts that all before the fault have in common; *any: there is something before it. An alcove has no such fault.
 */
static uint64_t parts_before(const drawn *d, const moved *m, const tn_floor_answer *a, bool *any)
{
    const tn_floor *f = &d->floor;
    size_t ways_in = f->passage_count + f->landing_count, end = a->fault == TN_FLOOR_KEEP ? ways_in : a->of;
    bool alcove = ways_in == 1 && f->passage_count == 1 && f->keep_count == 0;
    uint64_t common = UINT64_MAX;
    *any = false;
    for (size_t i = 0; i < end; i++) {
        if (alcove && f->passages[i].kind != TN_PASSAGE_DOOR)
            continue;
        common &= parts_at(d, m, i);
        *any = true;
    }
    return common;
}

static int64_t beyond(int64_t at, int64_t from, int64_t to)
{
    return at < from ? from - at : at > to ? at - to : 0;
}

/* Is a half unit's place within one of the rectangles? */
static size_t covering(const tn_rectangle *rectangles, size_t count, int64_t x, int64_t y)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++)
        found += 2 * rectangles[i].x0 <= x && x < 2 * rectangles[i].x1 && 2 * rectangles[i].y0 <= y &&
                 y < 2 * rectangles[i].y1;
    return found;
}

/* The ground is what squares cover whose middles are in those parts; no rectangle of it covers what another does. */
static void compare_ground(const drawn *d, const moved *m, uint64_t parts, const tn_floor_stop *stop)
{
    static bool covered[SPAN][SPAN];
    int way = (int)d->floor.way;
    memset(covered, 0, sizeof covered);
    for (int x = 0; x < SPAN; x++)
        for (int y = 0; y < SPAN; y++)
            for (int i = x - way; m->part[x][y] && parts >> m->part[x][y] & 1 && i < x + way; i++)
                for (int k = y - way; k < y + way; k++)
                    covered[i][k] = true;
    for (int x = 0; x < SPAN; x++)
        for (int y = 0; y < SPAN; y++)
            assert_int_equal(covering(stop->ground, stop->ground_count, x - 2 * REACH, y - 2 * REACH), covered[x][y]);
}

/* The nearest place that is reached, by trying all of them. */
static void compare_stop(const drawn *d, const moved *m, const tn_floor_answer *a)
{
    const tn_floor *f = &d->floor;
    tn_floor_stop stop;
    tn_error error;
    bool any;
    uint64_t parts = parts_before(d, m, a, &any);
    int64_t best = INT64_MAX;
    tn_rectangle near = a->fault == TN_FLOOR_KEEP ? tn_rectangle_grown(&f->keeps[a->of], f->way / 2) : f->clear,
                 wanted = a->fault == TN_FLOOR_KEEP  ? doubled(&near)
                          : a->of < f->passage_count ? on_side(f, &f->passages[a->of])
                                                     : on_landing(&f->landings[a->of - f->passage_count]);
    assert_int_equal(tn_floor_stop_find(f, a, &stop, &error), TN_OK);
    for (int x = 0; any && x < SPAN; x++)
        for (int y = 0; y < SPAN; y++) {
            int64_t dx = beyond(x - 2 * REACH, wanted.x0, wanted.x1), dy = beyond(y - 2 * REACH, wanted.y0, wanted.y1);
            if (m->part[x][y] && parts >> m->part[x][y] & 1 && dx * dx + dy * dy < best)
                best = dx * dx + dy * dy;
        }
    assert_int_equal(stop.stands, best < INT64_MAX);
    assert_int_equal(stop.square.x1 - stop.square.x0, f->way);
    if (stop.stands) {
        int64_t x = stop.square.x0 + stop.square.x1, y = stop.square.y0 + stop.square.y1,
                dx = beyond(x, wanted.x0, wanted.x1), dy = beyond(y, wanted.y0, wanted.y1), by = 2 * stop.short_by;
        assert_int_equal(dx * dx + dy * dy, best);
        assert_true(parts >> m->part[x + 2 * REACH][y + 2 * REACH] & 1);
        assert_true(by * by >= best && (by == 0 || (by - 2) * (by - 2) < best));
        compare_ground(d, m, parts, &stop);
    }
    tn_floor_stop_clear(&stop);
}

static void test_brute_force(void **state)
{
    uint64_t s = 1;
    size_t fit = 0, stopped = 0;
    static drawn d;
    static moved m;
    (void)state;
    for (int i = 0; i < CELLS; i++) {
        tn_floor_answer answer;
        tn_error error;
        bool one;
        draw_cell(&s, &d);
        move(&d.floor, &m);
        assert_int_equal(tn_floor_ask(&d.floor, &answer, &error), TN_OK);
        assert_int_equal(answer.parts, m.parts);
        compare_joined(&d, &m, &answer);
        assert_int_equal(answer.fits, fits(&d, &m));
        assert_int_equal(answer.fits, answer.fault == TN_FLOOR_FITS);
        assert_int_equal(tn_floor_fits(&d.floor, &one, &error), TN_OK);
        assert_int_equal(one, answer.fits);
        fit += answer.fits;
        if (!answer.fits && answer.fault != TN_FLOOR_LEAF) {
            compare_stop(&d, &m, &answer);
            stopped++;
        }
        tn_floor_answer_clear(&answer);
    }
    assert_in_range(fit, CELLS / 8, CELLS - CELLS / 8);
    assert_true(stopped > CELLS / 8);
}

/* A gap of exactly the way is passed; one that is narrower by a unit is not, and the fault is named. */
static void test_gap(void **state)
{
    (void)state;
    for (int64_t narrower = 0; narrower < 2; narrower++) {
        const tn_rectangle post = {0, 1000 + narrower, 900, 1100};
        const tn_passage ways_in[] = {{TN_HOUSE_BACK, TN_PASSAGE_DOOR, 500, 1300},
                                      {TN_HOUSE_FRONT, TN_PASSAGE_DOOR, 500, 1300}};
        const tn_floor floor = {.way = 800,
                                .clear = {0, 1800, 0, 2000},
                                .obstacles = &post,
                                .obstacle_count = 1,
                                .passages = ways_in,
                                .passage_count = 2};
        tn_floor_answer answer;
        tn_error error;
        assert_int_equal(tn_floor_ask(&floor, &answer, &error), TN_OK);
        assert_int_equal(answer.fits, !narrower);
        assert_int_equal(answer.parts, 1 + narrower);
        assert_int_equal(answer.fault, narrower ? TN_FLOOR_APART : TN_FLOOR_FITS);
        assert_int_equal(answer.of, narrower ? 1 : 0);
        tn_floor_answer_clear(&answer);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_brute_force), cmocka_unit_test(test_gap)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
