/* Where lines end at corners of faces that are painted after them.
 *
 * Faces are painted one over another, each with its lines, which reach half their width into the faces beside them.
 * Such a face has that line at one of its sides, too, and draws it again; but not one that touches it with a corner
 * alone, as pieces of faces do. There its filling, and the hairlines that close seams, would cut into the line. So
 * seams end where they come near to a line; and where the angle is sharp, lines are mended as far as the filling and
 * the seam reach into them. */
#include <math.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/scene/view_parts.h"

#define GRID 1e6     /* points nearer than this share of the form are one */
#define BESIDE 1e-4F /* of a line's direction: beside it */

/* An end of a seam, or a corner. */
typedef struct meeting_place {
    int32_t at[3];
    float sides[2][2]; /* from there on, of unit length; of a seam the first alone */
    uint32_t corner;
    uint32_t end;            /* of a seam: in `sharpest`; of a line: its edge */
    uint32_t shape;          /* the faces that are filled together: their lines are drawn after all of them */
    bool is_corner, bare[2]; /* bare: is that side no line? */
} meeting_place;

typedef struct meeting_places {
    tn_view *view;
    const float *depths;
    meeting_place *items; /* by `at` */
    size_t count, mend_room;
    double unit;
    uint32_t shape; /* at hand */
} meeting_places;

static int compare_places(const void *a, const void *b)
{
    const meeting_place *p = a, *q = b;
    for (int k = 0; k < 3; k++)
        if (p->at[k] != q->at[k])
            return p->at[k] < q->at[k] ? -1 : 1;
    return 0;
}

static double put_direction(const meeting_places *m, size_t from, size_t to, float direction[2])
{
    const float *a = m->view->points[from], *b = m->view->points[to];
    double along[2] = {(double)b[0] - (double)a[0], (double)b[1] - (double)a[1]}, length = hypot(along[0], along[1]);
    for (int k = 0; k < 2; k++)
        direction[k] = (float)(along[k] / fmax(length, 1e-300));
    return length;
}

static meeting_place place_at(const meeting_places *m, size_t corner, size_t other)
{
    meeting_place place = {.corner = (uint32_t)corner, .shape = m->shape};
    for (int k = 0; k < 2; k++)
        place.at[k] = (int32_t)lrint(((double)m->view->points[corner][k] - m->view->low[k]) / m->unit);
    place.at[2] = (int32_t)lrint((double)m->depths[corner] / m->unit);
    put_direction(m, corner, other, place.sides[0]);
    return place;
}

static float dot(const float *a, const float *b)
{
    return a[0] * b[0] + a[1] * b[1];
}

static float cross(const float *a, const float *b)
{
    return a[0] * b[1] - a[1] * b[0];
}

/* Does this direction run inside the corner? */
static bool is_inside(const meeting_place *corner, const float *line)
{
    const float *a = corner->sides[0], *b = corner->sides[1];
    float turn = cross(a, b), from_a = cross(a, line), to_b = cross(line, b);
    return turn > 0 ? from_a > 0 && to_b > 0 : from_a < 0 && to_b < 0;
}

/* Would the filling of the corner reach far into a line in this direction, which runs beside it? *tangent: of the angle
 * from the line to the filling, which is at its left where that is positive. */
static bool reaches(const meeting_place *corner, const float *line, float *tangent)
{
    const float *a = corner->sides[0], *b = corner->sides[1];
    bool is_b = dot(b, line) > dot(a, line);
    const float *nearest = is_b ? b : a;
    float cosine = dot(nearest, line);
    *tangent = cross(line, nearest) / fmaxf(cosine, 1e-9f);
    return corner->bare[is_b] && !is_inside(corner, line) && cosine > TN_SHARP;
}

/* The places that are those of a line's end: from the first on. */
typedef struct company {
    size_t first, end;
} company;

/* Is the side of the line covered by a face that is painted after it? side: 1 at its left, -1 at its right. */
static bool is_covered(const meeting_places *m, const company *here, const meeting_place *line, float side)
{
    const float *d = line->sides[0], aside[2] = {d[0] - side * BESIDE * d[1], d[1] + side * BESIDE * d[0]};
    for (size_t i = here->first; i < here->end; i++)
        if (m->items[i].is_corner && m->items[i].shape > line->shape && is_inside(&m->items[i], aside))
            return true;
    return false;
}

/* A line that is covered at both sides is hidden, though it may run beside each of the pieces that hide it. */
static bool is_hidden(const meeting_places *m, const company *here, const meeting_place *line)
{
    return is_covered(m, here, line, 1) && is_covered(m, here, line, -1);
}

static tn_status mend(meeting_places *m, const meeting_place *corner, const meeting_place *line, double length,
                      tn_error *error)
{
    tn_view *view = m->view;
    float tangent;
    if (corner->shape == line->shape || !reaches(corner, line->sides[0], &tangent))
        return TN_OK;
    if (!tn_array_reserve(&view->mends, &m->mend_room, view->mend_count, 1, sizeof *view->mends))
        return tn_fail_memory(error);
    view->mends[view->mend_count++] = (tn_mend){.corner = corner->corner,
                                                .along = {line->sides[0][0], line->sides[0][1]},
                                                .length = (float)length,
                                                .tangent = tangent,
                                                .edge = (uint16_t)line->end};
    return TN_OK;
}

static company find_company(const meeting_places *m, const meeting_place *line)
{
    size_t low = 0, high = m->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (compare_places(&m->items[middle], line) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    while (high < m->count && compare_places(&m->items[high], line) == 0)
        high++;
    return (company){low, high};
}

static tn_status meet(meeting_places *m, const meeting_place *line, double length, tn_error *error)
{
    const company here = find_company(m, line);
    bool hidden = is_hidden(m, &here, line);
    tn_status status = TN_OK;
    for (size_t i = here.first; status == TN_OK && i < here.end; i++) {
        const meeting_place *place = &m->items[i];
        float *sharpest = &m->view->sharpest[place->end];
        if (place->is_corner)
            status = hidden ? TN_OK : mend(m, place, line, length, error);
        else
            *sharpest = fmaxf(*sharpest, fminf(dot(place->sides[0], line->sides[0]), 1));
    }
    return status;
}

static bool is_line(const tn_view *view, size_t corner)
{
    return view->edges[corner] != TN_EDGE_NONE && view->edges[corner] != TN_EDGE_JOINED;
}

static void add_seam(meeting_places *m, size_t corner, size_t next)
{
    meeting_place from = place_at(m, corner, next), to = place_at(m, next, corner);
    from.end = 2 * (uint32_t)corner;
    to.end = from.end + 1;
    m->items[m->count++] = from;
    m->items[m->count++] = to;
}

static void add_corner(meeting_places *m, size_t before, size_t corner, size_t next)
{
    meeting_place place = place_at(m, corner, next);
    place.is_corner = true;
    place.bare[0] = !is_line(m->view, corner);
    place.bare[1] = !is_line(m->view, before);
    put_direction(m, corner, before, place.sides[1]);
    m->items[m->count++] = place;
}

static tn_status add_line(meeting_places *m, size_t corner, size_t next, tn_error *error)
{
    meeting_place from = place_at(m, corner, next), to = place_at(m, next, corner);
    float along[2];
    double length = put_direction(m, corner, next, along);
    from.end = to.end = m->view->edges[corner];
    tn_status status = meet(m, &from, length, error);
    return status == TN_OK ? meet(m, &to, length, error) : status;
}

typedef enum side_kind { SIDE_OTHER, SIDE_LINE } side_kind;

static tn_status go_through(meeting_places *m, side_kind kind, tn_error *error)
{
    const tn_view *view = m->view;
    tn_status status = TN_OK;
    m->shape = 0;
    for (size_t f = 0; f < view->face_count; f++) {
        const tn_seen_face *face = &view->faces[f];
        m->shape += f > 0 && !face->joined;
        for (uint32_t i = 0; status == TN_OK && i < face->size; i++) {
            size_t corner = face->first + i, next = face->first + (i + 1) % face->size,
                   before = face->first + (i + face->size - 1) % face->size;
            bool line = is_line(view, corner);
            if (kind == SIDE_OTHER)
                add_corner(m, before, corner, next);
            if (kind == SIDE_OTHER && view->edges[corner] == TN_EDGE_NONE)
                add_seam(m, corner, next);
            if (kind == SIDE_LINE && line)
                status = add_line(m, corner, next, error);
        }
    }
    return status;
}

static int compare_mends(const void *a, const void *b)
{
    const tn_mend *p = a, *q = b;
    return p->corner != q->corner       ? (p->corner > q->corner) - (p->corner < q->corner)
           : p->along[0] != q->along[0] ? (p->along[0] > q->along[0]) - (p->along[0] < q->along[0])
           : p->along[1] != q->along[1] ? (p->along[1] > q->along[1]) - (p->along[1] < q->along[1])
           : p->edge != q->edge         ? (p->edge > q->edge) - (p->edge < q->edge)
                                        : (p->length > q->length) - (p->length < q->length);
}

/* Both faces at a line say that it ends: one mend is enough. */
static void sort_mends(tn_view *view)
{
    size_t kept = 0;
    if (view->mend_count > 0)
        qsort(view->mends, view->mend_count, sizeof *view->mends, compare_mends);
    for (size_t i = 0; i < view->mend_count; i++)
        if (kept == 0 || compare_mends(&view->mends[kept - 1], &view->mends[i]) != 0)
            view->mends[kept++] = view->mends[i];
    view->mend_count = kept;
}

static size_t count_sides(const tn_view *view, size_t *corners)
{
    size_t others = 0;
    *corners = 0;
    for (size_t f = 0; f < view->face_count; f++) {
        const tn_seen_face *face = &view->faces[f];
        *corners = face->first + face->size > *corners ? face->first + face->size : *corners;
        for (uint32_t i = 0; i < face->size; i++)
            others += !is_line(view, face->first + i);
    }
    return others;
}

tn_status tn_view_find_meets(tn_view *view, const float *depths, tn_error *error)
{
    size_t corners, others = count_sides(view, &corners);
    if (others == 0)
        return TN_OK;
    meeting_places m = {
        .view = view, .depths = depths, .items = tn_array_new(corners + 2 * (uint64_t)others, sizeof *m.items)};
    m.unit = fmax(fmax(view->high[0] - view->low[0], view->high[1] - view->low[1]), 1e-300) / GRID;
    view->sharpest = tn_array_new(2 * (uint64_t)corners, sizeof *view->sharpest);
    tn_status status = m.items && view->sharpest ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; view->sharpest && i < 2 * corners; i++)
        view->sharpest[i] = TN_MEETS_NOTHING;
    if (status == TN_OK) {
        go_through(&m, SIDE_OTHER, error); /* does not fail */
        qsort(m.items, m.count, sizeof *m.items, compare_places);
        status = go_through(&m, SIDE_LINE, error);
    }
    if (status == TN_OK)
        sort_mends(view);
    free(m.items);
    return status;
}
