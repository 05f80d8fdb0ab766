/* Joins lines of a path. */
#include "runtime/draw/device/chains.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define GRID 1e3 /* places that are the same to a thousandth of a point are one */
#define NONE SIZE_MAX

/* An end of a line: of line k the first is 2 k, the other 2 k + 1. */
typedef struct line_end {
    double x, y;
    size_t number;
} line_end;

typedef struct joining {
    line_end *ends;    /* [2 * lines] by number */
    size_t *partner;   /* [2 * lines] the end that goes on there, or NONE */
    bool *used;        /* [lines] */
    tn_drawn_step *to; /* what is made */
    size_t count, lines;
} joining;

static size_t end_of_subpath(const tn_drawn_path *path, size_t from)
{
    size_t i = from + 1;
    while (i < path->count && path->steps[i].kind != TN_DRAWN_MOVE)
        i++;
    return i;
}

/* Takes the single lines, and copies all else. */
static void sort_out(joining *j, const tn_drawn_path *path)
{
    for (size_t i = 0, end; i < path->count; i = end) {
        end = end_of_subpath(path, i);
        if (end == i + 2 && path->steps[i + 1].kind == TN_DRAWN_LINE) {
            for (size_t k = 0; k < 2; k++)
                j->ends[2 * j->lines + k] = (line_end){path->steps[i + k].x, path->steps[i + k].y, 2 * j->lines + k};
            j->lines++;
            continue;
        }
        memcpy(j->to + j->count, path->steps + i, (end - i) * sizeof *j->to);
        j->count += end - i;
    }
}

static int by_place(const void *a, const void *b)
{
    const line_end *p = a, *q = b;
    double px = round(p->x * GRID), qx = round(q->x * GRID), py = round(p->y * GRID), qy = round(q->y * GRID);
    if (px != qx)
        return px < qx ? -1 : 1;
    if (py != qy)
        return py < qy ? -1 : 1;
    return p->number < q->number ? -1 : p->number > q->number;
}

static bool same_place(const line_end *p, const line_end *q)
{
    return round(p->x * GRID) == round(q->x * GRID) && round(p->y * GRID) == round(q->y * GRID);
}

/* Ends that are two in their place go on as one another. sorted: room for all ends. */
static void find_partners(joining *j, line_end *sorted)
{
    size_t ends = 2 * j->lines;
    memcpy(sorted, j->ends, ends * sizeof *sorted);
    qsort(sorted, ends, sizeof *sorted, by_place);
    for (size_t i = 0, end; i < ends; i = end) {
        for (end = i + 1; end < ends && same_place(&sorted[i], &sorted[end]);)
            end++;
        bool two = end == i + 2 && sorted[i].number / 2 != sorted[i + 1].number / 2;
        for (size_t k = i; k < end; k++)
            j->partner[sorted[k].number] = two ? sorted[2 * i + 1 - k].number : NONE;
    }
}

static void add(joining *j, tn_drawn_step_kind kind, const line_end *at)
{
    j->to[j->count++] = (tn_drawn_step){.kind = kind, .x = at->x, .y = at->y};
}

/* The lines from an end on, until there is none, or the first again. */
static void follow(joining *j, size_t from)
{
    size_t end = from;
    add(j, TN_DRAWN_MOVE, &j->ends[from]);
    do {
        j->used[end / 2] = true;
        size_t far = end ^ 1;
        end = j->partner[far];
        if (end == from)
            add(j, TN_DRAWN_CLOSE, &j->ends[from]);
        else
            add(j, TN_DRAWN_LINE, &j->ends[far]);
    } while (end != NONE && end != from);
}

tn_status tn_chains_join(const tn_drawn_path *path, tn_drawn_step **steps, size_t *count)
{
    size_t room = path->count + 1; /* a line is two steps, and has two ends */
    joining j = {.ends = malloc(room * sizeof *j.ends),
                 .partner = malloc(room * sizeof *j.partner),
                 .used = calloc(room, sizeof *j.used),
                 .to = malloc(room * sizeof *j.to)};
    line_end *sorted = malloc(room * sizeof *sorted);
    bool fine = j.ends && j.partner && j.used && j.to && sorted;
    if (fine) {
        sort_out(&j, path);
        find_partners(&j, sorted);
        for (size_t end = 0; end < 2 * j.lines; end++)
            if (!j.used[end / 2] && j.partner[end] == NONE)
                follow(&j, end);
        for (size_t line = 0; line < j.lines; line++) /* rings are left */
            if (!j.used[line])
                follow(&j, 2 * line);
    }
    free(j.ends);
    free(j.partner);
    free(j.used);
    free(sorted);
    *steps = j.to;
    *count = j.count;
    return fine ? TN_OK : TN_MEMORY;
}
