/* How sharply lines meet the ends of seams.
 *
 * Where a face was cut, a hairline of its own colour closes the seam. It must not paint over lines that end where it
 * ends: those of its own face, and those of faces that were painted before. The sharper the angle between them, the
 * sooner the hairline has to end. */
#include <math.h>
#include <stdlib.h>

#include "runtime/scene/view_parts.h"

#define GRID 1e6 /* points nearer than this share of the form are one */

typedef struct seam_end {
    int32_t at[2];
    float along[2]; /* from there on, of unit length */
    size_t number;  /* in `sharpest` */
} seam_end;

typedef struct seam_ends {
    seam_end *items; /* by `at` */
    size_t count;
    double low[2], unit;
} seam_ends;

static int compare_ends(const void *a, const void *b)
{
    const seam_end *p = a, *q = b;
    return p->at[0] != q->at[0] ? (p->at[0] > q->at[0]) - (p->at[0] < q->at[0])
                                : (p->at[1] > q->at[1]) - (p->at[1] < q->at[1]);
}

/* The end of a side at one of its corners. */
static seam_end end_at(const seam_ends *ends, const float *corner, const float *other, size_t number)
{
    double along[2] = {(double)other[0] - (double)corner[0], (double)other[1] - (double)corner[1]};
    double length = fmax(hypot(along[0], along[1]), 1e-30);
    seam_end end = {.number = number};
    for (int k = 0; k < 2; k++) {
        end.at[k] = (int32_t)lrint(((double)corner[k] - ends->low[k]) / ends->unit);
        end.along[k] = (float)(along[k] / length);
    }
    return end;
}

/* A line ends at a corner: all seams that end there know it. */
static void meet(const seam_ends *ends, const seam_end *line, float *sharpest)
{
    size_t low = 0, high = ends->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (compare_ends(&ends->items[middle], line) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < ends->count && compare_ends(&ends->items[low], line) == 0; low++) {
        const seam_end *seam = &ends->items[low];
        float cosine = seam->along[0] * line->along[0] + seam->along[1] * line->along[1];
        sharpest[seam->number] = fmaxf(sharpest[seam->number], fminf(cosine, 1));
    }
}

typedef enum side_kind { SIDE_SEAM, SIDE_LINE } side_kind;

/* Adds the ends of seams, or lets the ends of lines meet them. */
static void go_through(const tn_view *view, seam_ends *ends, side_kind kind)
{
    for (size_t f = 0; f < view->face_count; f++) {
        const tn_seen_face *face = &view->faces[f];
        for (uint32_t i = 0; i < face->size; i++) {
            size_t c = face->first + i, next = face->first + (i + 1) % face->size;
            bool seam = view->edges[c] == TN_EDGE_NONE;
            if (view->edges[c] == TN_EDGE_JOINED || seam != (kind == SIDE_SEAM))
                continue;
            const seam_end both[2] = {end_at(ends, view->points[c], view->points[next], 2 * c),
                                      end_at(ends, view->points[next], view->points[c], 2 * c + 1)};
            for (int k = 0; k < 2; k++)
                if (seam)
                    ends->items[ends->count++] = both[k];
                else
                    meet(ends, &both[k], view->sharpest);
        }
    }
}

static size_t count_seams(const tn_view *view, size_t *corners)
{
    size_t seams = 0;
    *corners = 0;
    for (size_t f = 0; f < view->face_count; f++) {
        const tn_seen_face *face = &view->faces[f];
        *corners = face->first + face->size > *corners ? face->first + face->size : *corners;
        for (uint32_t i = 0; i < face->size; i++)
            seams += view->edges[face->first + i] == TN_EDGE_NONE;
    }
    return seams;
}

tn_status tn_view_find_seams(tn_view *view, tn_error *error)
{
    size_t corners, seams = count_seams(view, &corners);
    if (seams == 0)
        return TN_OK;
    seam_ends ends = {.items = malloc(2 * seams * sizeof *ends.items), .low = {view->low[0], view->low[1]}};
    ends.unit = fmax(fmax(view->high[0] - view->low[0], view->high[1] - view->low[1]), 1e-300) / GRID;
    view->sharpest = malloc(2 * corners * sizeof *view->sharpest);
    if (!ends.items || !view->sharpest) {
        free(ends.items);
        return tn_fail_memory(error);
    }
    for (size_t i = 0; i < 2 * corners; i++)
        view->sharpest[i] = TN_MEETS_NOTHING;
    go_through(view, &ends, SIDE_SEAM);
    qsort(ends.items, ends.count, sizeof *ends.items, compare_ends);
    go_through(view, &ends, SIDE_LINE);
    free(ends.items);
    return TN_OK;
}
