/* Puts faces of one plane and colour side by side in the order of painting, so that they can be filled as one shape:
 * the edges between them then leave no seam, and the lines round them are drawn after all of them.
 *
 * A face may be painted earlier than it was to be if it lies beside all that was to be painted in between. */
#include <math.h>
#include <stdlib.h>

#include "runtime/scene/view_parts.h"

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
typedef struct seam {
    float from[2], to[2];
    uint32_t corner;
} seam;

static int by_ends(const void *a, const void *b)
{
    const seam *x = a, *y = b;
    const float p[4] = {x->from[0], x->from[1], x->to[0], x->to[1]},
                q[4] = {y->from[0], y->from[1], y->to[0], y->to[1]};
    for (int k = 0; k < 4; k++)
        if (p[k] != q[k])
            return p[k] < q[k] ? -1 : 1;
    return 0;
}

static seam seam_at(const tn_view *view, const tn_seen_face *face, uint32_t i)
{
    const float *p = view->points[face->first + i], *q = view->points[face->first + (i + 1) % face->size];
    bool forward = p[0] != q[0] ? p[0] < q[0] : p[1] < q[1];
    const float *from = forward ? p : q, *to = forward ? q : p;
    return (seam){{from[0], from[1]}, {to[0], to[1]}, face->first + i};
}

/* Marks edges that two faces of a run share. */
static void join_edges(tn_view *view, const tn_seen_face *faces, size_t count, seam *seams)
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
    seam *seams = malloc((corners + 1) * sizeof *seams);
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
