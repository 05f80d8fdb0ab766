/* The faces of a pass: decided, numbered, written. Faces that a join in another face might concern wait until all
 * others are decided, and are then taken in the order of their ranks. */
#include <stdlib.h>
#include <string.h>

#include "runtime/growth/join/decide.h"

/* ---- numbers */

/* Counts of each chunk become the first of each; returns the totals. */
static tn_face_chunk place_chunks(tn_pass *pass)
{
    tn_face_chunk next = {0};
    for (uint32_t c = 0; c < pass->chunk_count; c++) {
        tn_face_chunk *one = &pass->chunks[c], here = *one;
        one->darts = next.darts;
        one->faces = next.faces;
        one->joins = next.joins;
        next.darts += here.darts;
        next.faces += here.faces;
        next.joins += here.joins;
    }
    return next;
}

/* New faces rank after all old ones: by their parents' ranks, then in the order of the joins that made them. */
static void rank_faces(const tn_pass *pass)
{
    if (!pass->made)
        return;
    uint32_t next = pass->old->face_count;
    for (uint32_t r = 0; r < pass->old->face_count; r++) {
        uint32_t joins = pass->made[r];
        pass->made[r] = next;
        next += joins;
    }
}

/* ---- branches that wait for the next pass */

/* All deciders' branches by their old face, in the order of each face's loops. False: out of memory. */
static bool gather_pending(const tn_pass *pass, tn_pending *items)
{
    const tn_growth_workspace *space = &pass->growth->space;
    uint32_t faces = pass->old->face_count;
    uint32_t *next = calloc((size_t)faces + 1, sizeof *next);
    if (!next)
        return false;
    for (int i = 0; i < space->decider_count; i++)
        for (size_t j = 0; j < space->deciders[i].pending_count; j++)
            next[space->deciders[i].pending[j].face + 1]++;
    for (uint32_t f = 0; f < faces; f++)
        next[f + 1] += next[f];
    for (int i = 0; i < space->decider_count; i++)
        for (size_t j = 0; j < space->deciders[i].pending_count; j++)
            items[next[space->deciders[i].pending[j].face]++] = space->deciders[i].pending[j];
    free(next);
    return true;
}

static uint32_t loops_of(const tn_pass *pass, const tn_face_chunk *chunk, uint32_t face)
{
    uint32_t index = pass->cut_of[face];
    if (index == TN_CUT_PLAIN)
        return 1;
    const tn_cuts *cuts = tn_cuts_of(pass, chunk, &index);
    return cuts->items[index].loop_count;
}

/* From darts of their old face's cut to darts of the new map. */
static void place_pending(const tn_pass *pass, tn_pending_list *list)
{
    uint32_t i = 0, filled = 0;
    for (uint32_t f = 0, made = 0; f < pass->old->face_count; f++) {
        for (; i < list->count && list->items[i].face == f; i++) {
            uint32_t face = made + list->items[i].loop;
            while (filled <= face)
                list->face_first[filled++] = i;
            list->items[i].dart += pass->new->face_first[made];
        }
        made += loops_of(pass, &pass->chunks[f / TN_CHUNK_FACES], f);
    }
    while (filled <= pass->new->face_count)
        list->face_first[filled++] = i;
}

static tn_status hand_over_pending(const tn_pass *pass, tn_error *error)
{
    tn_pending_list *list = &pass->growth->pending;
    const tn_growth_workspace *space = &pass->growth->space;
    free(list->items);
    free(list->face_first);
    *list = (tn_pending_list){0};
    size_t count = 0;
    for (int i = 0; i < space->decider_count; i++)
        count += space->deciders[i].pending_count;
    if (count == 0)
        return TN_OK;
    list->items = malloc(count * sizeof *list->items);
    list->face_first = malloc(((size_t)pass->new->face_count + 1) * sizeof *list->face_first);
    if (!list->items || !list->face_first || !gather_pending(pass, list->items))
        return tn_fail_memory(error);
    list->count = count;
    place_pending(pass, list);
    return TN_OK;
}

/* ---- the whole */

static tn_status prepare(tn_pass *pass, tn_error *error)
{
    tn_growth_workspace *space = &pass->growth->space;
    size_t branches = (size_t)pass->branch_first + pass->branch_count, faces = pass->old->face_count;
    bool ranked = pass->growth->ranked;
    if (!tn_pages_reserve(&space->joints, (uint64_t)branches * sizeof *pass->joints) ||
        !tn_pages_reserve(&space->cut_of, (uint64_t)faces * sizeof *pass->cut_of) ||
        (ranked && !tn_pages_reserve(&space->made, (uint64_t)faces * sizeof *pass->made)))
        return tn_fail_memory(error);
    pass->joints = space->joints.data;
    pass->cut_of = space->cut_of.data;
    pass->made = ranked ? space->made.data : NULL;
    memset(pass->joints, 0xff, branches * sizeof *pass->joints);
    return TN_OK;
}

static tn_status make_map(tn_pass *pass, const tn_face_chunk *total, tn_error *error)
{
    tn_map *new = pass->new;
    tn_growth_workspace *space = &pass->growth->space;
    tn_status status = tn_growth_check_edges(pass->growth, pass->edges + total->joins, error);
    if (status != TN_OK)
        return status;
    uint64_t ranks = pass->growth->ranked ? total->faces : 0;
    tn_pages *dart_space = &space->darts[!space->current], *face_space = &space->faces[!space->current];
    if (!tn_pages_reserve(dart_space, 2 * total->darts * sizeof *new->origin) ||
        !tn_pages_reserve(face_space, (total->faces + 1 + ranks) * sizeof *new->face_first))
        return tn_fail_memory(error);
    new->vertex_count = pass->vertices;
    new->edge_count = pass->edges + (uint32_t)total->joins;
    new->face_count = (uint32_t)total->faces;
    new->origin = dart_space->data;
    new->side = new->origin + total->darts;
    new->face_first = face_space->data;
    new->face_rank = ranks ? new->face_first + total->faces + 1 : NULL;
    new->face_first[total->faces] = (uint32_t)total->darts;
    return TN_OK;
}

tn_status tn_pass_faces(tn_pass *pass, tn_error *error)
{
    tn_status status = prepare(pass, error);
    if (status == TN_OK)
        status = tn_pass_decide(pass, error);
    if (status != TN_OK || pass->growth->needs_ranks)
        return status;
    tn_face_chunk total = place_chunks(pass);
    status = make_map(pass, &total, error);
    if (status != TN_OK)
        return status;
    pass->growth->counts.joins += total.joins;
    rank_faces(pass);
    status = tn_pass_number_joints(pass, error);
    if (status != TN_OK)
        return status;
    status = tn_pass_stamp(pass, error);
    return status == TN_OK ? hand_over_pending(pass, error) : status;
}
