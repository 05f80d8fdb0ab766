/* The planes of each kind of roof, and rectangles cut by where one plane takes over from another. */
#include "runtime/house/slopes.h"

#include "runtime/house/solids.h"

/* ---- fractions */

static tn_int128 common_divisor(tn_int128 a, tn_int128 b)
{
    while (b > UINT32_MAX || b < -(tn_int128)UINT32_MAX) {
        tn_int128 rest = a % b;
        a = b;
        b = rest;
    }
    if (b == 0)
        return a < 0 ? -a : a;
    int64_t small = (int64_t)b, rest = (int64_t)(a % b); /* most of the way in one word */
    while (rest) {
        int64_t next = small % rest;
        small = rest;
        rest = next;
    }
    return small < 0 ? -small : small;
}

tn_fraction tn_fraction_new(tn_int128 top, tn_int128 bottom)
{
    tn_int128 common = bottom == 1 ? 1 : common_divisor(top, bottom);
    common = bottom < 0 ? -common : common;
    return (tn_fraction){top / common, bottom / common};
}

double tn_fraction_value(tn_fraction fraction)
{
    tn_int128 whole = fraction.top / fraction.bottom, rest = fraction.top % fraction.bottom;
    return (double)whole + (double)rest / (double)fraction.bottom;
}

bool tn_fraction_less(tn_fraction a, tn_fraction b)
{
    return a.top * b.bottom < b.top * a.bottom;
}

/* ---- planes of roofs */

enum { VAULT_STEPS = TN_SLOPES_MAX };

/* A plane that rises across the ridge, which is in x where the roof goes across the row. */
static tn_slope across_ridge(bool in_x, tn_int128 rise, tn_int128 at)
{
    return in_x ? (tn_slope){rise, 0, at} : (tn_slope){0, rise, at};
}

/* Two planes that rise from `from` and from `to` towards the middle. */
static void add_gable(tn_slopes *slopes, bool in_x, int64_t from, int64_t to, uint32_t rise)
{
    slopes->items[slopes->count++] = across_ridge(in_x, rise, -(tn_int128)rise * from);
    slopes->items[slopes->count++] = across_ridge(in_x, -(tn_int128)rise, (tn_int128)rise * to);
}

/* Chords of the parabola that is `height` high in the middle, between sixteenths of its width: the chord i of width w
 * is height / (4 w) * ((15 - 2 i) (y - from) + w i (i + 1) / 16). */
static tn_slopes vault(bool in_x, int64_t from, int64_t to, int64_t height)
{
    tn_int128 wide = (tn_int128)to - from;
    tn_slopes slopes = {.count = VAULT_STEPS, .first = VAULT_STEPS, .bottom = 64 * wide};
    for (int i = 0; i < VAULT_STEPS; i++) {
        tn_int128 rise = (tn_int128)16 * height * (VAULT_STEPS - 1 - 2 * i);
        slopes.items[i] = across_ridge(in_x, rise, height * wide * i * (i + 1) - rise * from);
    }
    return slopes;
}

tn_slopes tn_roof_slopes(const tn_house *house, const tn_cell *cell)
{
    const tn_shape_record *shape = tn_house_shape(house, cell->zone, TN_CHOICE_ROOF);
    tn_rectangle r = tn_cell_grown(house, cell);
    bool in_x = shape && shape->flags & TN_ROOF_ACROSS;
    int64_t from = in_x ? r.x0 : r.y0, to = in_x ? r.x1 : r.y1;
    tn_slopes slopes = {.bottom = shape && shape->run ? shape->run : 1};
    switch (shape ? (tn_roof_kind)shape->roof : TN_ROOF_FLAT) {
    case TN_ROOF_SHED_BACK:
        slopes.items[slopes.count++] = (tn_slope){0, shape->rise, -(tn_int128)shape->rise * from};
        break;
    case TN_ROOF_SHED_FRONT:
        slopes.items[slopes.count++] = (tn_slope){0, -(tn_int128)shape->rise, (tn_int128)shape->rise * to};
        break;
    case TN_ROOF_GABLE:
    case TN_ROOF_HIP:
        add_gable(&slopes, in_x, from, to, shape->rise);
        break;
    case TN_ROOF_CROSS_GABLE: /* from plane to plane, so that valleys come down to the eaves */
        add_gable(&slopes, false, from, to, shape->rise);
        add_gable(&slopes, true, cell->at.x0, cell->at.x1, shape->rise);
        slopes.first = 2;
        return slopes;
    case TN_ROOF_VAULT:
        return vault(in_x, from, to, shape->height);
    default:
        slopes.items[slopes.count++] = (tn_slope){0, 0, 0};
    }
    slopes.first = slopes.count;
    return slopes;
}

/* The cell of the next or the last tray that goes on with the roof of a cell; TN_NO_CELL: there is none. */
static uint32_t goes_on_with(const tn_house *house, uint32_t index, bool right)
{
    const tn_cell *cell = &house->cells[index];
    uint32_t tray = right ? cell->tray + 1 : cell->tray - 1;
    if (right ? tray == house->length : cell->tray == 0)
        return TN_NO_CELL;
    for (uint32_t i = house->tray_first[tray]; i < house->tray_first[tray + 1]; i++) {
        const tn_cell *other = &house->cells[i];
        if (other->zone == cell->zone && other->storey == cell->storey && other->at.y0 == cell->at.y0 &&
            other->at.y1 == cell->at.y1 && tn_cell_is_top(house, i))
            return i;
    }
    return TN_NO_CELL;
}

/* Does a higher wall stand against all of the end of a cell's roof? */
static bool ends_at_wall(const tn_house *house, uint32_t index, bool right)
{
    const tn_cell *cell = &house->cells[index];
    uint32_t tray = right ? cell->tray + 1 : cell->tray - 1;
    int64_t at = cell->at.y0;
    bool further = right ? tray < house->length : cell->tray > 0;
    while (further && at < cell->at.y1) {
        int64_t reached = at;
        for (uint32_t i = house->tray_first[tray]; i < house->tray_first[tray + 1]; i++) {
            const tn_cell *other = &house->cells[i];
            if (other->storey == cell->storey + 1 && other->at.y0 <= reached && other->at.y1 > reached)
                reached = other->at.y1;
        }
        further = reached > at;
        at = reached;
    }
    return at >= cell->at.y1;
}

/* The end of a hip slopes down from where the roof goes on no more, half a wall beyond the last cell; not towards a
 * higher wall, where water would stand. */
static void add_end(const tn_house *house, uint32_t index, bool right, uint32_t rise, tn_slopes *slopes)
{
    for (uint32_t next = index; next != TN_NO_CELL; next = goes_on_with(house, index, right))
        index = next;
    if (ends_at_wall(house, index, right))
        return;
    tn_rectangle last = tn_cell_grown(house, &house->cells[index]);
    slopes->items[slopes->count++] =
        right ? across_ridge(true, -(tn_int128)rise, (tn_int128)rise * last.x1)
              : across_ridge(true, rise, -(tn_int128)rise * last.x0);
}

tn_slopes tn_roof_slopes_of(const tn_house *house, uint32_t cell)
{
    const tn_shape_record *shape = tn_house_shape(house, house->cells[cell].zone, TN_CHOICE_ROOF);
    tn_slopes slopes = tn_roof_slopes(house, &house->cells[cell]);
    if (!shape || shape->roof != TN_ROOF_HIP)
        return slopes;
    add_end(house, cell, false, shape->rise, &slopes);
    add_end(house, cell, true, shape->rise, &slopes);
    slopes.first = slopes.count;
    return slopes;
}

/* ---- heights */

/* A plane's equation at a point, times the bottoms of the point and of the slopes. */
static tn_int128 value_at(const tn_slope *slope, tn_fraction x, tn_fraction y)
{
    return slope->x * x.top * y.bottom + slope->y * y.top * x.bottom + slope->at * x.bottom * y.bottom;
}

tn_fraction tn_slope_at(const tn_slopes *slopes, size_t plane, tn_fraction x, tn_fraction y, int64_t base)
{
    tn_fraction height =
        tn_fraction_new(value_at(&slopes->items[plane], x, y), slopes->bottom * x.bottom * y.bottom);
    return tn_fraction_raised(height, base);
}

/* The least of some planes at a point, times the point's bottoms. */
static tn_int128 least_of(const tn_slopes *slopes, size_t from, size_t to, tn_fraction x, tn_fraction y)
{
    tn_int128 least = value_at(&slopes->items[from], x, y);
    for (size_t i = from + 1; i < to; i++) {
        tn_int128 value = value_at(&slopes->items[i], x, y);
        least = value < least ? value : least;
    }
    return least;
}

tn_fraction tn_slopes_at(const tn_slopes *slopes, tn_fraction x, tn_fraction y, int64_t base)
{
    tn_int128 value = least_of(slopes, 0, slopes->first, x, y);
    if (slopes->first < slopes->count) {
        tn_int128 other = least_of(slopes, slopes->first, slopes->count, x, y);
        value = other > value ? other : value;
    }
    return tn_fraction_raised(tn_fraction_new(value, slopes->bottom * x.bottom * y.bottom), base);
}

/* ---- cutting */

static int sign_of(tn_int128 value)
{
    return (value > 0) - (value < 0);
}

/* Where the edge from a corner to the next meets what the two values, on either side of 0, are 0 of. */
static void crossing(const tn_facet *facet, size_t corner, const tn_int128 values[TN_FACET_CORNERS], tn_fraction at[2])
{
    size_t next = (corner + 1) % facet->count;
    const tn_fraction *p = facet->at[corner], *q = facet->at[next];
    tn_int128 from = values[corner] * q[0].bottom * q[1].bottom, to = values[next] * p[0].bottom * p[1].bottom;
    tn_fraction part = tn_fraction_new(from, from - to);
    for (int k = 0; k < 2; k++) {
        tn_fraction way = tn_fraction_new(q[k].top * p[k].bottom - p[k].top * q[k].bottom, p[k].bottom * q[k].bottom);
        tn_fraction step = tn_fraction_new(way.top * part.top, way.bottom * part.bottom);
        at[k] = tn_fraction_new(p[k].top * step.bottom + step.top * p[k].bottom, p[k].bottom * step.bottom);
    }
}

/* Keeps of a facet where a plane is not above 0; nothing where that has no area. If it is 0 all over, the facet stays
 * if `level`. */
static void keep_below(tn_facet *facet, const tn_slope *less, bool level)
{
    tn_int128 values[TN_FACET_CORNERS];
    bool below = false, above = false;
    for (size_t i = 0; i < facet->count; i++) {
        values[i] = value_at(less, facet->at[i][0], facet->at[i][1]);
        below |= values[i] < 0;
        above |= values[i] > 0;
    }
    if (!below)
        facet->count = !above && level ? facet->count : 0;
    if (!below || !above)
        return;
    tn_facet kept = {.plane = facet->plane};
    for (size_t i = 0; i < facet->count && kept.count < TN_FACET_CORNERS; i++) {
        int here = sign_of(values[i]), next = sign_of(values[(i + 1) % facet->count]);
        if (here <= 0) {
            kept.at[kept.count][0] = facet->at[i][0];
            kept.at[kept.count++][1] = facet->at[i][1];
        }
        if (here * next < 0 && kept.count < TN_FACET_CORNERS)
            crossing(facet, i, values, kept.at[kept.count++]);
    }
    *facet = kept;
}

void tn_facet_keep(tn_facet *facet, tn_rectangle in)
{
    const tn_slope beyond[4] = {{-1, 0, in.x0}, {1, 0, -(tn_int128)in.x1}, {0, -1, in.y0}, {0, 1, -(tn_int128)in.y1}};
    for (int i = 0; i < 4 && facet->count > 0; i++)
        keep_below(facet, &beyond[i], false);
}

static tn_slope difference(const tn_slope *a, const tn_slope *b)
{
    return (tn_slope){a->x - b->x, a->y - b->y, a->at - b->at};
}

/* Keeps where plane i is the least of those from one to another; of equal ones the first. */
static void keep_least(const tn_slopes *slopes, size_t from, size_t to, size_t i, tn_facet *facet)
{
    bool ordered = to - from > 4;
    for (size_t k = from; k < to && facet->count > 0; k++) {
        tn_slope over = difference(&slopes->items[i], &slopes->items[k]);
        if (k != i && (!ordered || k + 1 == i || k == i + 1))
            keep_below(facet, &over, i < k);
    }
}

static tn_facet whole(tn_rectangle r)
{
    tn_fraction x0 = tn_fraction_whole(r.x0), x1 = tn_fraction_whole(r.x1), y0 = tn_fraction_whole(r.y0),
                y1 = tn_fraction_whole(r.y1);
    return (tn_facet){.count = 4, .at = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
}

/* The part of a facet where plane j of the second height is the least of that: where the first height, which plane i
 * decides, is not lower, and where it is. */
static size_t cut_second(const tn_slopes *slopes, size_t i, size_t j, tn_facet part, tn_facet facets[2])
{
    size_t count = 0;
    keep_least(slopes, slopes->first, slopes->count, j, &part);
    for (int second = 0; second < 2 && part.count > 0; second++) {
        size_t own = second ? j : i, other = second ? i : j;
        tn_slope under = difference(&slopes->items[other], &slopes->items[own]);
        facets[count] = part;
        facets[count].plane = own;
        keep_below(&facets[count], &under, second == 0);
        count += facets[count].count > 0;
    }
    return count;
}

size_t tn_slopes_cut(const tn_slopes *slopes, tn_rectangle over, tn_facet facets[TN_FACETS_MAX])
{
    size_t count = 0;
    for (size_t i = 0; i < slopes->first; i++) {
        tn_facet part = whole(over);
        part.plane = i;
        keep_least(slopes, 0, slopes->first, i, &part);
        if (part.count == 0)
            continue;
        if (slopes->first == slopes->count)
            facets[count++] = part;
        for (size_t j = slopes->first; j < slopes->count; j++)
            count += cut_second(slopes, i, j, part, facets + count);
    }
    return count;
}

tn_fraction tn_slopes_highest(const tn_slopes *slopes, tn_rectangle over, int64_t base)
{
    tn_facet facets[TN_FACETS_MAX];
    bool in_x = over.x0 < over.x1, in_y = over.y0 < over.y1;
    over.x1 += !in_x; /* a line is looked at as a strip, and only its own side of that */
    over.y1 += !in_y;
    size_t count = tn_slopes_cut(slopes, over, facets);
    tn_fraction best = tn_slopes_at(slopes, tn_fraction_whole(over.x0), tn_fraction_whole(over.y0), base);
    for (size_t f = 0; f < count; f++)
        for (size_t i = 0; i < facets[f].count; i++) {
            tn_fraction x = in_x ? facets[f].at[i][0] : tn_fraction_whole(over.x0),
                        y = in_y ? facets[f].at[i][1] : tn_fraction_whole(over.y0);
            tn_fraction height = tn_slopes_at(slopes, x, y, base);
            best = tn_fraction_less(best, height) ? height : best;
        }
    return best;
}
