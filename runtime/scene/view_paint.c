/* Paints a view: faces from the farthest on, each with its seams and lines. */
#include <math.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/draw/canvas.h"
#include "runtime/geometry/mesh.h"
#include "runtime/scene/seen.h"

/* ==== puts faces of one plane and colour side by side in the order of painting, so that they can be filled as one
 * shape: the edges between them then leave no seam, and the lines round them are drawn after all of them. A face may be
 * painted earlier than it was to be if it lies beside all that was to be painted in between */

enum {
    RUNS_BACK = 64, /* how many runs back a face looks for its own */
    FACES_MOST = 64 /* of a run that are compared one by one */
};

#define NONE UINT32_MAX

typedef struct run {
    uint32_t first, last, count; /* faces, linked by `next` */
    float low[2], high[2];
} run;

typedef struct joining {
    const tn_view *view;
    run *runs;
    uint32_t run_count;
    uint32_t *next; /* [face] the next of its run, or NONE */
    float touch;    /* what overlaps by no more only touches */
} joining;

static void bound(const tn_view *view, const tn_seen_face *face, float low[2], float high[2])
{
    for (int k = 0; k < 2; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
        for (uint32_t c = face->first; c < face->first + face->size; c++) {
            low[k] = fminf(low[k], view->points[c][k]);
            high[k] = fmaxf(high[k], view->points[c][k]);
        }
    }
}

static bool boxes_meet(const joining *j, const run *r, const float low[2], const float high[2])
{
    return r->low[0] + j->touch < high[0] && low[0] + j->touch < r->high[0] && r->low[1] + j->touch < high[1] &&
           low[1] + j->touch < r->high[1];
}

/* How far to the left of the line from a to b the face reaches, and how little; times the line's length. */
static void reach(const joining *j, const tn_seen_face *face, const float *a, const float *b, float out[2])
{
    out[0] = INFINITY;
    out[1] = -INFINITY;
    for (uint32_t c = face->first; c < face->first + face->size; c++) {
        const float *p = j->view->points[c];
        float left = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        out[0] = fminf(out[0], left);
        out[1] = fmaxf(out[1], left);
    }
}

/* Does one side of p have all of p on one hand, and all of q on the other? */
static bool is_split_by(const joining *j, const tn_seen_face *p, const tn_seen_face *q)
{
    for (uint32_t i = 0; i < p->size; i++) {
        const float *a = j->view->points[p->first + i], *b = j->view->points[p->first + (i + 1) % p->size];
        float touch = j->touch * hypotf(b[0] - a[0], b[1] - a[1]), own[2], its[2];
        if (touch <= 0)
            continue;
        reach(j, p, a, b, own);
        reach(j, q, a, b, its);
        if (own[0] >= its[1] - touch || its[0] >= own[1] - touch)
            return true;
    }
    return false;
}

static bool lies_over(const joining *j, const run *r, const tn_seen_face *face)
{
    if (r->count > FACES_MOST)
        return true;
    for (uint32_t f = r->first; f != NONE; f = j->next[f])
        if (!is_split_by(j, &j->view->faces[f], face) && !is_split_by(j, face, &j->view->faces[f]))
            return true;
    return false;
}

static bool same_fill(const tn_seen_face *p, const tn_seen_face *q)
{
    return p->plane == q->plane && p->group == q->group && p->plane != 0;
}

/* The run that a face can be painted with, or NONE. */
static uint32_t run_for(const joining *j, const tn_seen_face *face, const float low[2], const float high[2])
{
    for (uint32_t r = j->run_count, looked = 0; r-- > 0 && looked < RUNS_BACK; looked++) {
        if (same_fill(&j->view->faces[j->runs[r].first], face))
            return r;
        if (boxes_meet(j, &j->runs[r], low, high) && lies_over(j, &j->runs[r], face))
            return NONE;
    }
    return NONE;
}

static void join(joining *j, uint32_t f)
{
    float low[2], high[2];
    const tn_seen_face *face = &j->view->faces[f];
    bound(j->view, face, low, high);
    uint32_t found = run_for(j, face, low, high);
    j->next[f] = NONE;
    if (found == NONE) {
        j->runs[j->run_count++] = (run){f, f, 1, {low[0], low[1]}, {high[0], high[1]}};
        return;
    }
    run *r = &j->runs[found];
    j->next[r->last] = f;
    r->last = f;
    r->count++;
    for (int k = 0; k < 2; k++) {
        r->low[k] = fminf(r->low[k], low[k]);
        r->high[k] = fmaxf(r->high[k], high[k]);
    }
}

/* ---- edges between faces of a run */

/* An edge without a line, its ends in order. */
typedef struct seam_side {
    float from[2], to[2];
    uint32_t corner;
} seam_side;

static int by_ends(const void *a, const void *b)
{
    const seam_side *x = a, *y = b;
    const float p[4] = {x->from[0], x->from[1], x->to[0], x->to[1]},
                q[4] = {y->from[0], y->from[1], y->to[0], y->to[1]};
    for (int k = 0; k < 4; k++)
        if (p[k] != q[k])
            return p[k] < q[k] ? -1 : 1;
    return 0;
}

static seam_side seam_at(const tn_view *view, const tn_seen_face *face, uint32_t i)
{
    const float *p = view->points[face->first + i], *q = view->points[face->first + (i + 1) % face->size];
    bool forward = p[0] != q[0] ? p[0] < q[0] : p[1] < q[1];
    const float *from = forward ? p : q, *to = forward ? q : p;
    return (seam_side){{from[0], from[1]}, {to[0], to[1]}, face->first + i};
}

/* Marks edges that two faces of a run share. */
static void join_edges(tn_view *view, const tn_seen_face *faces, size_t count, seam_side *seams)
{
    size_t found = 0;
    for (size_t f = 0; f < count; f++)
        for (uint32_t i = 0; i < faces[f].size; i++)
            if (view->edges[faces[f].first + i] == TN_EDGE_NONE)
                seams[found++] = seam_at(view, &faces[f], i);
    if (found)
        qsort(seams, found, sizeof *seams, by_ends);
    for (size_t i = 0; i + 1 < found; i++)
        if (by_ends(&seams[i], &seams[i + 1]) == 0) {
            view->edges[seams[i].corner] = view->edges[seams[i + 1].corner] = TN_EDGE_JOINED;
            i++;
        }
}

static bool join_all_edges(tn_view *view)
{
    size_t corners = 0;
    for (size_t f = 0; f < view->face_count; f++)
        corners += view->faces[f].size;
    seam_side *seams = malloc((corners + 1) * sizeof *seams);
    for (size_t f = 0, end; seams && f < view->face_count; f = end) {
        for (end = f + 1; end < view->face_count && view->faces[end].joined;)
            end++;
        if (end > f + 1)
            join_edges(view, view->faces + f, end - f, seams);
    }
    bool made = seams != NULL;
    free(seams);
    return made;
}

tn_status tn_view_join(tn_view *view, tn_error *error)
{
    size_t count = view->face_count, at = 0;
    tn_seen_face *sorted = malloc((count + 1) * sizeof *sorted);
    joining j = {.view = view,
                 .runs = malloc((count + 1) * sizeof *j.runs),
                 .next = malloc((count + 1) * sizeof *j.next),
                 .touch = (float)(1e-6 * fmax(view->high[0] - view->low[0], view->high[1] - view->low[1]))};
    bool fine = sorted && j.runs && j.next;
    for (uint32_t f = 0; fine && f < count; f++)
        join(&j, f);
    for (uint32_t r = 0; fine && r < j.run_count; r++)
        for (uint32_t f = j.runs[r].first; f != NONE; f = j.next[f]) {
            sorted[at] = view->faces[f];
            sorted[at++].joined = f != j.runs[r].first;
        }
    free(j.runs);
    free(j.next);
    if (!fine) {
        free(sorted);
        return tn_fail_memory(error);
    }
    free(view->faces);
    view->faces = sorted;
    return join_all_edges(view) ? TN_OK : tn_fail_memory(error);
}

/* ==== where lines end at corners of faces that are painted after them. Faces are painted one over another, each with
 * its lines, which reach half their width into the faces beside them. Such a face has that line at one of its sides,
 * too, and draws it again; but not one that touches it with a corner alone, as pieces of faces do. There its filling,
 * and the hairlines that close seams, would cut into the line. So seams end where they come near to a line; and where
 * the angle is sharp, lines are mended as far as the filling and the seam reach into them */

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

/* ==== paints a view: faces from the farthest on, each with its seams and lines */

#define HAIRLINE 0.5 /* points: of seams */
#define PAPER 0.88   /* the grey that lines fade towards */

static void set_edge_colour(tn_paint *paint, uint16_t edge, double fade)
{
    unsigned char rgb[3] = {33, 33, 38};
    if (edge != TN_EDGE_DARK)
        tn_group_colour(edge, rgb);
    tn_paint_colour(paint, rgb[0] / 255.0 + fade * (PAPER - rgb[0] / 255.0),
                    rgb[1] / 255.0 + fade * (PAPER - rgb[1] / 255.0), rgb[2] / 255.0 + fade * (PAPER - rgb[2] / 255.0));
}

void tn_view_face_colour(tn_paint *paint, const tn_seen_face *face)
{
    unsigned char rgb[3];
    double light = (double)face->light;
    if (face->group == TN_NO_GROUP) {
        tn_paint_colour(paint, 0.98 * light, 0.97 * light, 0.93 * light);
        return;
    }
    tn_group_colour(face->group, rgb);
    tn_paint_colour(paint, light * (0.4 + 0.6 * rgb[0] / 255.0), light * (0.4 + 0.6 * rgb[1] / 255.0),
                    light * (0.4 + 0.6 * rgb[2] / 255.0));
}

/* Paths are in points of the page, y downwards: an SVG with coordinates of the model and a matrix that makes them small
 * loses its thin lines in browsers. */
typedef struct tn_brush {
    tn_paint *paint;
    const tn_view *view;
    double scale;
} tn_brush;

static void move_to(const tn_brush *brush, double x, double y)
{
    tn_paint_move_to(brush->paint, x * brush->scale, -y * brush->scale);
}

static void line_to(const tn_brush *brush, double x, double y)
{
    tn_paint_line_to(brush->paint, x * brush->scale, -y * brush->scale);
}

static void set_width(const tn_brush *brush, double width)
{
    tn_paint_line_width(brush->paint, width * brush->scale);
}

static void outline(const tn_brush *brush, const tn_seen_face *face)
{
    tn_paint_new_sub_path(brush->paint);
    for (uint32_t c = face->first; c < face->first + face->size; c++)
        line_to(brush, (double)brush->view->points[c][0], (double)brush->view->points[c][1]);
    tn_paint_close_path(brush->paint);
}

/* Strokes the sides of one kind, from one corner on; returns the next corner. */
static uint32_t stroke_run(const tn_brush *brush, const tn_seen_face *face, uint32_t i)
{
    const uint16_t *edges = brush->view->edges + face->first;
    const float(*points)[2] = (const float(*)[2])(brush->view->points + face->first);
    uint16_t edge = edges[i];
    move_to(brush, (double)points[i][0], (double)points[i][1]);
    for (; i < face->size && edges[i] == edge; i++) {
        const float *next = points[(i + 1) % face->size];
        line_to(brush, (double)next[0], (double)next[1]);
    }
    tn_paint_stroke(brush->paint);
    return i;
}

static void set_fill(tn_paint *paint, const tn_seen_face *face, const tn_view_place *place)
{
    const double(*palette)[3] = place->palette;
    double light = place->ambient + (1 - place->ambient) * (double)face->light;
    if (palette)
        tn_paint_colour(paint, light * palette[face->group][0], light * palette[face->group][1],
                        light * palette[face->group][2]);
    else
        tn_view_face_colour(paint, face);
}

/* How far seams keep away from lines at their ends, in units of the model: `line` is half as wide as these are,
 * `stroke` half as wide as a seam is. */
typedef struct clearance {
    double line, stroke;
} clearance;

/* The share of a seam that is left out at its end, so that no part of it touches a line that ends there, half of it at
 * most. Where the angle is sharp only as much as the line hides: it is mended behind that. */
static double left_out(const tn_view *view, size_t end, double length, const clearance *clear)
{
    double cosine = (double)view->sharpest[end];
    if (view->sharpest[end] == TN_MEETS_NOTHING)
        return 0;
    double sine = sqrt(fmax(1 - cosine * cosine, 0));
    double reach = cosine > (double)TN_SHARP ? clear->line / fmax(sine, 1e-9)
                   : cosine > 0              ? (clear->line + clear->stroke * cosine) / sine
                                             : clear->line;
    return fmin(reach / fmax(length, 1e-30), 0.5);
}

/* Seams that follow one another are one stroke, unless lines end where they meet. */
static void draw_seams(const tn_brush *brush, const tn_seen_face *face, const clearance *clear)
{
    const tn_view *view = brush->view;
    const float(*points)[2] = (const float(*)[2])(view->points + face->first);
    bool goes_on = false;
    for (uint32_t i = 0; i < face->size; i++) {
        const float *a = points[i], *b = points[(i + 1) % face->size];
        double along[2] = {(double)b[0] - (double)a[0], (double)b[1] - (double)a[1]};
        size_t end = 2 * ((size_t)face->first + i);
        if (view->edges[face->first + i] != TN_EDGE_NONE) {
            goes_on = false;
            continue;
        }
        double length = hypot(along[0], along[1]), from = left_out(view, end, length, clear),
               to = left_out(view, end + 1, length, clear);
        if (!goes_on || from > 0)
            move_to(brush, (double)a[0] + from * along[0], (double)a[1] + from * along[1]);
        line_to(brush, (double)b[0] - to * along[0], (double)b[1] - to * along[1]);
        goes_on = to == 0;
    }
    tn_paint_stroke(brush->paint);
}

static void draw_edges(const tn_brush *brush, const tn_seen_face *face, double fade)
{
    for (uint32_t i = 0; i < face->size;) {
        uint16_t edge = brush->view->edges[face->first + i];
        if (edge == TN_EDGE_NONE || edge == TN_EDGE_JOINED) {
            i++;
            continue;
        }
        set_edge_colour(brush->paint, edge, fade);
        i = stroke_run(brush, face, i);
    }
}

/* The first mend that is not of a corner before this one. */
static size_t first_mend(const tn_view *view, uint32_t corner)
{
    size_t low = 0, high = view->mend_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (view->mends[middle].corner < corner)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Adds to the path that half of a line into which the face and its seams reach, as far as they do. */
static void trace_mend(const tn_brush *brush, const tn_mend *mend, const clearance *clear)
{
    const float *corner = brush->view->points[mend->corner];
    double along[2] = {(double)mend->along[0], (double)mend->along[1]}, tangent = (double)mend->tangent,
           reach = fmin((clear->line + clear->stroke) / fmax(fabs(tangent), 1e-9), (double)mend->length),
           aside = copysign(clear->line / 2, tangent), x = (double)corner[0] - aside * along[1],
           y = (double)corner[1] + aside * along[0];
    move_to(brush, x, y);
    line_to(brush, x + reach * along[0], y + reach * along[1]);
}

/* Draws such halves again, those of one colour at a time. */
static void draw_mends(const tn_brush *brush, const tn_seen_face *face, const clearance *clear, double fade)
{
    const tn_mend *mends = brush->view->mends;
    size_t i = first_mend(brush->view, face->first), end = first_mend(brush->view, face->first + face->size);
    for (; i < end; i++) {
        trace_mend(brush, &mends[i], clear);
        if (i + 1 < end && mends[i + 1].edge == mends[i].edge)
            continue;
        set_edge_colour(brush->paint, mends[i].edge, fade);
        tn_paint_stroke(brush->paint);
    }
}

/* Fills faces of one plane as one shape, then draws their edges, runs of one colour at a time. Where they were cut, a
 * hairline of their own colour closes the seam that smoothed edges would leave. It does not reach into lines, which the
 * face on their other side may have drawn before. */
static void paint_faces(const tn_brush *brush, const tn_seen_face *faces, size_t count, const tn_view_place *place,
                        double seam)
{
    tn_paint *paint = brush->paint;
    const clearance clear = {place->line / place->scale / 2, seam / 2};
    tn_paint_new_path(paint); /* text leaves a point behind */
    for (size_t f = 0; f < count; f++)
        outline(brush, &faces[f]);
    set_fill(paint, faces, place);
    tn_paint_even_odd(paint, count == 1);
    tn_paint_fill(paint);
    tn_paint_line_cap(paint, TN_CAP_BUTT);
    set_width(brush, seam);
    for (size_t f = 0; f < count; f++)
        draw_seams(brush, &faces[f], &clear);
    if (place->line <= 0)
        return;
    set_width(brush, clear.line);
    for (size_t f = 0; f < count; f++)
        draw_mends(brush, &faces[f], &clear, place->fade);
    tn_paint_line_cap(paint, TN_CAP_ROUND);
    set_width(brush, 2 * clear.line);
    for (size_t f = 0; f < count; f++)
        draw_edges(brush, &faces[f], place->fade);
}

/* As wide as a seam can be seen, in units of the model: a pixel at least where there are pixels. */
static double seam_width(tn_paint *paint, const tn_view_place *place)
{
    return fmax(HAIRLINE, tn_paint_pixel(paint)) / place->scale;
}

void tn_view_paint(const tn_canvas *canvas, const tn_view *view, const tn_view_place *place)
{
    tn_paint *paint = tn_canvas_paint(canvas);
    const tn_brush brush = {paint, view, place->scale};
    tn_paint_save(paint);
    tn_paint_translate(paint, place->x, place->y);
    tn_paint_line_join(paint, TN_JOIN_ROUND);
    tn_paint_line_cap(paint, TN_CAP_ROUND);
    double seam = seam_width(paint, place);
    for (size_t f = 0, end, painted = 0; f < view->face_count; f = end) {
        if (painted++ % 256 == 0 && tn_canvas_stopped(canvas))
            break;
        for (end = f + 1; end < view->face_count && view->faces[end].joined;)
            end++;
        paint_faces(&brush, view->faces + f, end - f, place, seam);
    }
    tn_paint_restore(paint);
}
