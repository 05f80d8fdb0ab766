/* Draws the marks of stairs on plans: the way up a flight to where the plan cuts it, with a line that breaks it off
 * there and what is above it dashed, and the way down a flight that comes up, as far as it is seen through its hole. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "runtime/house/model/marks.h"
#include "runtime/house/model/model.h"

#define TREAD_NM 254000000.0 /* 10"; more where a stair is so long that it would have more than TREADS_MOST */
#define TREADS_MOST 1000
#define STEP_NM 1e7 /* how closely it is looked where a way is seen */

/* Treads across a stair, and a line up its middle. It goes the same way on both storeys: their cells are equal, though
 * the walls around them may not be. */
void tn_marks_stair(const tn_house *house, uint32_t cell, tn_marks *marks)
{
    tn_rectangle whole = house->cells[cell].at, r = tn_cell_clear(house, cell);
    bool along_x = whole.x1 - whole.x0 > whole.y1 - whole.y0;
    double x0 = (double)r.x0, x1 = (double)r.x1, y0 = (double)r.y0, y1 = (double)r.y1;
    double low = along_x ? x0 : y0, high = along_x ? x1 : y1, tip = TREAD_NM * 0.6,
           tread = fmax(TREAD_NM, (high - low) / TREADS_MOST);
    for (double at = low + tread; at < high; at += tread)
        tn_marks_line(marks, TN_MARK_STAIR, along_x ? at : x0, along_x ? y0 : at, along_x ? at : x1, along_x ? y1 : at);
    double mx = (x0 + x1) / 2, my = (y0 + y1) / 2;
    tn_marks_line(marks, TN_MARK_STAIR, along_x ? x0 : mx, along_x ? my : y0, along_x ? x1 : mx, along_x ? my : y1);
    for (int side = -1; side <= 1; side += 2)
        tn_marks_line(marks, TN_MARK_STAIR, along_x ? x1 - tip : mx + side * tip / 2,
                      along_x ? my + side * tip / 2 : y1 - tip, along_x ? x1 : mx, along_x ? my : y1);
}

/* ---- ways up and down */

/* A way on a plan. */
typedef struct drawn_way {
    double at[TN_FLIGHT_PATH_MAX][2];
    size_t count;
} drawn_way;

static drawn_way way_of(const tn_flight *flight, bool down)
{
    drawn_way way = {.count = flight->path_count};
    for (size_t i = 0; i < way.count; i++)
        for (int k = 0; k < 2; k++)
            way.at[i][k] = (double)flight->path[down ? way.count - 1 - i : i][k];
    return way;
}

static bool is_within(const tn_rectangle *r, double x, double y)
{
    return x >= (double)r->x0 && x <= (double)r->x1 && y >= (double)r->y0 && y <= (double)r->y1;
}

/* Is a step above the plane of the cut there? high: above the floor. */
static bool is_above(const tn_flight *flight, int64_t high, double x, double y)
{
    for (size_t i = 0; i < flight->tread_count; i++) {
        const tn_box *t = &flight->treads[i];
        if (t->z0 >= high && is_within(&(tn_rectangle){t->x0, t->x1, t->y0, t->y1}, x, y))
            return true;
    }
    for (size_t i = 0; i < flight->wedge_count; i++) {
        tn_box t = tn_wedge_box(&flight->wedges[i]);
        if (t.z0 >= high && is_within(&(tn_rectangle){t.x0, t.x1, t.y0, t.y1}, x, y))
            return true;
    }
    return false;
}

/* What a plan shows of a flight that comes up: what its holes leave open, but for what the next flight covers. */
typedef struct seen_through {
    const tn_flight *below, *above; /* above: or NULL */
    int64_t cut;                    /* above the floor */
} seen_through;

static bool is_seen(const seen_through *through, double x, double y)
{
    bool open = false, covered = false;
    for (size_t i = 0; i < through->below->hole_count; i++)
        open |= is_within(&through->below->holes[i], x, y);
    for (size_t i = 0; through->above && i < through->above->tread_count; i++) {
        const tn_box *t = &through->above->treads[i];
        covered |= t->z0 < through->cut && is_within(&(tn_rectangle){t->x0, t->x1, t->y0, t->y1}, x, y);
    }
    return open && !covered;
}

/* Ends a way where it is seen no more, from where it begins. */
static void keep_seen(drawn_way *way, const seen_through *through)
{
    for (size_t i = 1; i < way->count; i++) {
        double du = way->at[i][0] - way->at[i - 1][0], dv = way->at[i][1] - way->at[i - 1][1], length = hypot(du, dv);
        int steps = (int)(length / STEP_NM) + 1, last = 0;
        for (int k = 1; k <= steps && last == k - 1; k++) {
            double share = (k - 0.5) / steps; /* on neither of two steps at once */
            last += is_seen(through, way->at[i - 1][0] + du * share, way->at[i - 1][1] + dv * share);
        }
        if (last == steps)
            continue;
        way->at[i][0] = way->at[i - 1][0] + du * last / steps;
        way->at[i][1] = way->at[i - 1][1] + dv * last / steps;
        way->count = last > 0 ? i + 1 : i;
    }
}

/* From a point at its beginning, with an arrow at its end. */
static void put_way(const drawn_way *way, tn_marks *marks)
{
    double tip = TREAD_NM * 0.6;
    for (size_t i = 1; i < way->count; i++) {
        const double *from = way->at[i - 1], *to = way->at[i];
        double along = hypot(to[0] - from[0], to[1] - from[1]);
        tn_marks_line(marks, TN_MARK_STAIR, from[0], from[1], to[0], to[1]);
        if (i + 1 < way->count || !(along > 0))
            continue;
        double du = (to[0] - from[0]) / along * tip, dv = (to[1] - from[1]) / along * tip;
        tn_marks_line(marks, TN_MARK_STAIR, to[0] - du - dv / 2, to[1] - dv + du / 2, to[0], to[1]);
        tn_marks_line(marks, TN_MARK_STAIR, to[0] - du + dv / 2, to[1] - dv - du / 2, to[0], to[1]);
    }
    if (way->count > 1)
        tn_marks_circle(marks, TN_MARK_STAIR, way->at[0][0], way->at[0][1], tip / 3);
}

/* The longest of some texts that has room along the first leg of a way. */
static void put_text(const drawn_way *way, const char *const texts[], size_t count, const tn_mark_style *style,
                     tn_marks *marks)
{
    double du = way->at[1][0] - way->at[0][0], dv = way->at[1][1] - way->at[0][1], leg = hypot(du, dv), along = 0;
    size_t taken = 0;
    for (; taken < count; taken++) {
        along = (tn_mark_width(texts[taken]) / 2 + 0.3) * style->lettering + TREAD_NM / 4;
        if (2 * along <= leg)
            break;
    }
    if (taken == count)
        taken--;
    tn_marks_text(marks, TN_MARK_STAIR, way->at[0][0] + du / leg * along, way->at[0][1] + dv / leg * along,
                  style->lettering, fabs(dv) > fabs(du), texts[taken]);
}

/* ---- a flight that goes up */

/* The edge that two steps have in common. */
static bool edge_between(const tn_box *a, const tn_box *b, double edge[4])
{
    double x0 = (double)(a->x0 > b->x0 ? a->x0 : b->x0), x1 = (double)(a->x1 < b->x1 ? a->x1 : b->x1),
           y0 = (double)(a->y0 > b->y0 ? a->y0 : b->y0), y1 = (double)(a->y1 < b->y1 ? a->y1 : b->y1);
    edge[0] = x0;
    edge[1] = y0;
    edge[2] = x1;
    edge[3] = y1;
    return (x0 == x1) != (y0 == y1) && x0 <= x1 && y0 <= y1;
}

/* Steps above the plane of the cut, by the edges between them. */
static void put_above(const tn_flight *flight, int64_t cut, tn_marks *marks)
{
    double edge[4];
    for (size_t i = 1; i < flight->tread_count; i++)
        if (flight->treads[i].z0 >= cut && edge_between(&flight->treads[i - 1], &flight->treads[i], edge))
            tn_marks_line(marks, TN_MARK_VOID, edge[0], edge[1], edge[2], edge[3]);
}

#define BREAK_SLANT 0.35 /* of how wide the flight is */
#define BREAK_TOOTH 0.12

/* A slanted line with a tooth in it across the way, where the first step is that the plan does not show. */
static void put_break(const tn_flight *flight, const drawn_way *way, int64_t cut, double wide, tn_marks *marks)
{
    for (size_t i = 1; i < way->count; i++) {
        double du = way->at[i][0] - way->at[i - 1][0], dv = way->at[i][1] - way->at[i - 1][1], length = hypot(du, dv);
        int steps = (int)(length / STEP_NM) + 1;
        for (int k = 0; k < steps; k++) {
            double share = (k + 0.5) / steps, u = way->at[i - 1][0] + du * share, v = way->at[i - 1][1] + dv * share;
            if (!is_above(flight, cut, u, v))
                continue;
            double along[2] = {du / length * wide, dv / length * wide}, across[2] = {-along[1], along[0]};
            const double points[6][2] = {{-0.5, -BREAK_SLANT / 2}, {-0.08, -0.03}, {-0.04, BREAK_TOOTH},
                                         {0.04, -BREAK_TOOTH},     {0.08, 0.03},   {0.5, BREAK_SLANT / 2}};
            for (int n = 1; n < 6; n++) {
                const double *p = points[n - 1], *q = points[n];
                tn_marks_line(marks, TN_MARK_STAIR, u + across[0] * p[0] + along[0] * p[1],
                              v + across[1] * p[0] + along[1] * p[1], u + across[0] * q[0] + along[0] * q[1],
                              v + across[1] * q[0] + along[1] * q[1]);
            }
            return;
        }
    }
}

/* Ends a way where the plan cuts the flight. */
static void keep_below(const tn_flight *flight, int64_t cut, drawn_way *way)
{
    for (size_t i = 1; i < way->count; i++) {
        double du = way->at[i][0] - way->at[i - 1][0], dv = way->at[i][1] - way->at[i - 1][1];
        int steps = (int)(hypot(du, dv) / STEP_NM) + 1;
        for (int k = 0; k < steps; k++) {
            double share = (k + 0.5) / steps;
            if (!is_above(flight, cut, way->at[i - 1][0] + du * share, way->at[i - 1][1] + dv * share))
                continue;
            way->at[i][0] = way->at[i - 1][0] + du * k / steps;
            way->at[i][1] = way->at[i - 1][1] + dv * k / steps;
            way->count = k > 0 ? i + 1 : i;
            break;
        }
    }
}

static int64_t count_risers(const tn_house *house, const tn_face *face)
{
    return tn_flight_size_in(house->form, face->storey, tn_form_flight(house->form, face->kind)).steps;
}

/* How many risers there are, and how high and deep steps are; or less, where there is no room. shared: another comes up
 * in its place, so that the way ends where this one is cut. */
static void put_up(const tn_house *house, const tn_face *face, const tn_flight *flight, bool shared,
                   const tn_mark_style *style, tn_marks *marks)
{
    char all[48], risers[24];
    const tn_opening_record *record = tn_form_flight(house->form, face->kind);
    int64_t count = count_risers(house, face),
            cut = tn_plan_level(house->form, face->storey) - house->form->level[face->storey],
            height = house->form->level[face->storey + 1] - house->form->level[face->storey];
    drawn_way way = way_of(flight, false);
    snprintf(risers, sizeof risers, "UP %" PRId64 "R", count);
    snprintf(all, sizeof all, "UP %" PRId64 " \xc3\x97 %.0f/%.0f", count, (double)height / fmax((double)count, 1) / 1e6,
             (double)record->going / 1e6);
    put_break(flight, &way, cut, (double)record->wide, marks);
    if (shared)
        keep_below(flight, cut, &way);
    else
        put_above(flight, cut, marks);
    put_way(&way, marks);
    const char *const texts[] = {all, risers, "UP"};
    size_t first = style->us || count == 0;
    if (way.count > 1)
        put_text(&way, texts + first, 3 - first, style, marks);
}

/* ---- a flight that comes up */

static void put_down(const tn_house *house, const tn_face *face, const seen_through *through,
                     const tn_mark_style *style, tn_marks *marks)
{
    char risers[24];
    drawn_way way = way_of(through->below, true);
    keep_seen(&way, through);
    if (way.count < 2)
        return;
    snprintf(risers, sizeof risers, "DN %" PRId64 "R", count_risers(house, face));
    const char *const texts[] = {risers, "DN"};
    put_way(&way, marks);
    put_text(&way, texts, 2, style, marks);
}

static bool is_flight(const tn_house *house, const tn_face *face, uint32_t storey)
{
    return face->relation == TN_FACE_UNDER && face->storey == storey && tn_form_flight(house->form, face->kind);
}

/* Does a flight that goes up stand over one that comes up? */
static bool stands_over(const tn_flight *above, const tn_flight *below)
{
    for (size_t i = 0; i < above->tread_count; i++)
        for (size_t k = 0; k < below->hole_count; k++) {
            const tn_box *t = &above->treads[i];
            const tn_rectangle *h = &below->holes[k];
            if (t->x0 < h->x1 && h->x0 < t->x1 && t->y0 < h->y1 && h->y0 < t->y1)
                return true;
        }
    return false;
}

/* The flight of the storey that stands over one from below; NULL: none does. */
static const tn_flight *find_above(const tn_house *house, const tn_flights *flights, uint32_t storey,
                                   const tn_flight *below)
{
    for (size_t i = 0; i < flights->count; i++)
        if (is_flight(house, &house->faces[flights->items[i].face], storey) && stands_over(&flights->items[i], below))
            return &flights->items[i];
    return NULL;
}

tn_status tn_marks_flights(const tn_house *house, uint32_t storey, const tn_mark_style *style, tn_marks *marks,
                           tn_error *error)
{
    tn_flights flights;
    tn_status status = tn_flights_stand(house, &flights, error);
    int64_t cut = tn_plan_level(house->form, storey) - house->form->level[storey];
    for (size_t i = 0; status == TN_OK && i < flights.count; i++) {
        const tn_flight *flight = &flights.items[i];
        const tn_face *face = &house->faces[flight->face];
        bool shared = false;
        for (size_t k = 0; k < flights.count; k++)
            shared |= storey > 0 && is_flight(house, &house->faces[flights.items[k].face], storey - 1) &&
                      stands_over(flight, &flights.items[k]);
        if (flight->path_count > 1 && is_flight(house, face, storey))
            put_up(house, face, flight, shared, style, marks);
        else if (flight->path_count > 1 && storey > 0 && is_flight(house, face, storey - 1))
            put_down(house, face, &(seen_through){flight, find_above(house, &flights, storey, flight), cut}, style,
                     marks);
    }
    tn_flights_clear(&flights);
    return status;
}
