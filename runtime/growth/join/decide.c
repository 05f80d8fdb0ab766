/* Decides which branches of each face join. */
#include "runtime/growth/join/decide.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/watch.h"

/* ==== the faces of a pass: decided, numbered, written. Faces that a join in another face might concern wait until all
 * others are decided, and are then taken in the order of their ranks */

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

#define MANY 512u /* faces, for patterns to be worth their finding */

/* ---- deciders */

/* As many deciders as threads, ready for a pass. False: out of memory. */
static bool deciders_prepare(tn_growth_workspace *space, int count)
{
    if (count > space->decider_count) {
        if (!tn_array_resize(&space->deciders, (size_t)count, sizeof *space->deciders))
            return false;
        for (int i = space->decider_count; i < count; i++)
            space->deciders[i] = (tn_decider){0};
        space->decider_count = count;
    }
    for (int i = 0; i < space->decider_count; i++) {
        tn_decider *one = &space->deciders[i];
        tn_cuts_empty(&one->cuts);
        one->pending_count = one->later_count = 0;
        memset(one->failures, 0, sizeof one->failures);
    }
    return true;
}

void tn_deciders_forget(tn_growth_workspace *space)
{
    for (int i = 0; i < space->decider_count; i++)
        tn_patterns_forget(&space->deciders[i].patterns);
}

void tn_deciders_clear(tn_growth_workspace *space)
{
    for (int i = 0; i < space->decider_count; i++) {
        tn_decider *one = &space->deciders[i];
        tn_loop_clear(&one->loop);
        tn_patterns_clear(&one->patterns);
        tn_cuts_clear(&one->cuts);
        free(one->pending);
        free(one->later);
    }
    free(space->deciders);
    space->deciders = NULL;
    space->decider_count = 0;
}

/* ---- one face */

typedef struct decision {
    tn_pass *pass;
    tn_decider *decider;
    tn_face_chunk *chunk;
} decision;

static void tally(const decision *d, uint32_t face, uint64_t darts, uint32_t faces, uint32_t joins)
{
    d->chunk->darts += darts;
    d->chunk->faces += faces;
    d->chunk->joins += joins;
    if (d->pass->made)
        d->pass->made[d->pass->old->face_rank[face]] = joins;
}

static void take_cut(const decision *d, uint32_t face, const tn_cuts *cuts, uint32_t index, uint32_t mark)
{
    const tn_cut *cut = &cuts->items[index];
    d->pass->cut_of[face] = index | mark;
    tally(d, face, cut->dart_count, cut->loop_count, cut->join_count);
}

static tn_pending *add_pending(tn_decider *decider, size_t count)
{
    if (!tn_array_reserve(&decider->pending, &decider->pending_room, decider->pending_count, count,
                          sizeof *decider->pending))
        return NULL;
    decider->pending_count += count;
    return decider->pending + decider->pending_count - count;
}

/* The branches of a face's loop that did not join. */
static bool keep_pending(tn_decider *decider, const tn_cuts *cuts, const tn_cut *cut, uint32_t face)
{
    const tn_cut_waiting *waiting = cuts->waiting + cut->waiting_first;
    tn_pending *list = add_pending(decider, cut->waiting_count);
    for (uint32_t i = 0; list && i < cut->waiting_count; i++) {
        const tn_loop_branch *branch = &decider->loop.branches[waiting[i].branch];
        list[i] = (tn_pending){.dart = waiting[i].dart,
                               .face = face,
                               .loop = waiting[i].loop,
                               .id = branch->id,
                               .label = branch->label,
                               .age = branch->age,
                               .reversed = branch->reversed};
        tn_vector_put(list[i].direction, branch->direction);
    }
    return list;
}

/* The same of a face of a pattern. */
static bool keep_pattern_pending(const decision *d, const tn_cuts *cuts, const tn_cut *cut, uint32_t face)
{
    const tn_pass *pass = d->pass;
    const tn_cut_waiting *waiting = cuts->waiting + cut->waiting_first;
    tn_pending *list = add_pending(d->decider, cut->waiting_count);
    for (uint32_t i = 0; list && i < cut->waiting_count; i++) {
        uint32_t dart = pass->old->face_first[face] + tn_reference_dart(waiting[i].branch);
        uint32_t index = waiting[i].branch & 0xffff;
        uint32_t edge = pass->old->side[dart] / 2;
        const tn_record *record = &pass->records[edge];
        const tn_template_branch *branch = &pass->growth->system->templates[record->template].branches[index];
        tn_vector heading, up;
        double length;
        tn_pass_frame(pass, edge, edge, &heading, &up, &length);
        list[i] = (tn_pending){.dart = waiting[i].dart,
                               .face = face,
                               .loop = waiting[i].loop,
                               .id = record->branch + index,
                               .label = branch->label,
                               .age = tn_changed_age(branch->age, record->age),
                               .reversed = branch->reversed};
        tn_vector_put(list[i].direction, tn_branch_direction(heading, up, branch));
    }
    return list;
}

/* Works out one face by itself. Without `taken` it may be put off. */
static bool decide_alone(const decision *d, uint32_t face, tn_pair_set *taken)
{
    tn_pass *pass = d->pass;
    tn_decider *decider = d->decider;
    tn_loop *loop = &decider->loop;
    bool interior = face != TN_OUTER_FACE, keeps = interior && !pass->joins_last;
    if (!tn_loop_expand(loop, pass, face, interior))
        return false;
    switch (tn_loop_join_branches(loop, pass, face, taken)) {
    case TN_JOIN_MEMORY:
        return false;
    case TN_JOIN_LATER:
        if (!tn_array_reserve(&decider->later, &decider->later_room, decider->later_count, 1, sizeof *decider->later))
            return false;
        decider->later[decider->later_count++] = face;
        return true;
    default:
        break;
    }
    if (pass->growth->options.explain && pass->joins_last && !tn_loop_explain(loop, pass, decider->failures))
        return false;
    for (uint32_t i = 0; i < loop->join_count; i++) {
        const tn_loop_branch *low = &loop->branches[loop->joins[i].low], *high = &loop->branches[low->partner];
        pass->joints[low->id] = tn_state(low->label, low->age > high->age ? low->age : high->age, false);
    }
    if (!tn_cuts_add(&decider->cuts, loop, keeps))
        return false;
    uint32_t index = (uint32_t)decider->cuts.count - 1;
    take_cut(d, face, &decider->cuts, index, 0);
    const tn_cut *cut = &decider->cuts.items[index];
    return cut->waiting_count == 0 || keep_pending(decider, &decider->cuts, cut, face);
}

/* The darts of a face that no branch is in; 0 if there is one. */
static uint64_t plain_darts(const tn_pass *pass, uint32_t face)
{
    uint64_t darts = 0;
    for (uint32_t d = pass->old->face_first[face]; d < pass->old->face_first[face + 1]; d++) {
        uint32_t side = pass->old->side[d];
        const tn_record *record = &pass->records[side / 2];
        if (tn_is_kept(record)) {
            darts++;
            continue;
        }
        const tn_shape *shape = &pass->growth->shapes[record->template];
        if (face != TN_OUTER_FACE && (side & 1 ? shape->right_branches : shape->left_branches))
            return 0;
        darts += shape->template->segment_count;
    }
    return darts;
}

static bool has_pending(const tn_pass *pass, uint32_t face)
{
    const tn_pending_list *list = &pass->growth->pending;
    return list->count && list->face_first[face] != list->face_first[face + 1];
}

static bool decide_face(const decision *d, uint32_t face)
{
    tn_pass *pass = d->pass;
    if (pass->runs || pass->growth->options.explain || (face != TN_OUTER_FACE && has_pending(pass, face)))
        return decide_alone(d, face, NULL);
    bool many = pass->old->face_count >= MANY && !pass->growth->system->even;
    if (many && face != TN_OUTER_FACE && tn_face_size(pass->old, face) <= TN_PATTERN_DARTS) {
        const tn_cuts *cuts = &d->decider->patterns.cuts;
        uint32_t index;
        if (!tn_patterns_decide(&d->decider->patterns, pass, face, &d->decider->loop, &index))
            return false;
        if (index == TN_NONE)
            return decide_alone(d, face, NULL);
        take_cut(d, face, cuts, index, TN_CUT_OF_PATTERN);
        const tn_cut *cut = &cuts->items[index];
        return pass->joins_last || cut->waiting_count == 0 || keep_pattern_pending(d, cuts, cut, face);
    }
    uint64_t darts = plain_darts(pass, face);
    if (darts == 0)
        return decide_alone(d, face, NULL);
    pass->cut_of[face] = TN_CUT_PLAIN;
    tally(d, face, darts, 1, 0);
    return true;
}

/* ---- all faces */

static tn_status decide_chunk(void *context, unsigned decider, size_t number, tn_error *error)
{
    tn_pass *pass = context;
    tn_growth_workspace *space = &pass->growth->space;
    uint32_t faces = pass->old->face_count, begin = (uint32_t)number * TN_CHUNK_FACES;
    uint32_t end = faces - begin < TN_CHUNK_FACES ? faces : begin + TN_CHUNK_FACES;
    pass->chunks[number] = (tn_face_chunk){.decider = (int)decider};
    decision d = {pass, &space->deciders[decider], &pass->chunks[number]};
    for (uint32_t f = begin; f < end; f++) {
        if (f % TN_TOGETHER == 0)
            tn_ask_ahead(pass, f, pass->aims, sizeof *pass->aims, pass->branch_first);
        if (!decide_face(&d, f))
            return tn_fail_memory(error);
    }
    return TN_OK;
}

static void sift_by_rank(const uint32_t *rank, uint32_t *heap, size_t at, size_t count)
{
    uint32_t moving = heap[at];
    for (size_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && rank[heap[child]] < rank[heap[child + 1]])
            child++;
        if (rank[moving] >= rank[heap[child]])
            break;
        heap[at] = heap[child];
    }
    heap[at] = moving;
}

static void sort_by_rank(const uint32_t *rank, uint32_t *faces, size_t count)
{
    for (size_t i = count / 2; i-- > 0;)
        sift_by_rank(rank, faces, i, count);
    for (size_t end = count; end-- > 1;) {
        uint32_t last = faces[end];
        faces[end] = faces[0];
        faces[0] = last;
        sift_by_rank(rank, faces, 0, end);
    }
}

/* The faces that waited, in the order of their ranks. */
static bool decide_later(tn_pass *pass)
{
    tn_growth_workspace *space = &pass->growth->space;
    size_t count = 0;
    for (int i = 0; i < space->decider_count; i++)
        count += space->deciders[i].later_count;
    pass->growth->waited |= count > 0;
    pass->growth->needs_ranks = count && !pass->growth->ranked;
    if (count == 0 || pass->growth->needs_ranks)
        return true;
    tn_pair_set taken = {0};
    uint32_t *faces = malloc(count * sizeof *faces);
    bool fine = faces != NULL;
    for (int i = 0; fine && i < space->decider_count; i++)
        for (size_t j = 0; j < space->deciders[i].later_count; j++)
            faces[--count] = space->deciders[i].later[j];
    for (int i = 0; i < space->decider_count; i++)
        count += space->deciders[i].later_count;
    if (fine)
        sort_by_rank(pass->old->face_rank, faces, count);
    for (size_t i = 0; i < count && fine; i++) {
        tn_face_chunk *chunk = &pass->chunks[faces[i] / TN_CHUNK_FACES];
        decision d = {pass, &space->deciders[chunk->decider], chunk};
        fine = decide_alone(&d, faces[i], &taken);
    }
    tn_pair_set_clear(&taken);
    free(faces);
    return fine;
}

static void count_failures(tn_growth *growth)
{
    for (int d = 0; d < growth->space.decider_count; d++)
        for (int i = 0; i < TN_JOIN_FAILURE_COUNT; i++)
            growth->counts.failures[i] += growth->space.deciders[d].failures[i];
}

tn_status tn_pass_decide(tn_pass *pass, tn_error *error)
{
    tn_growth_workspace *space = &pass->growth->space;
    pass->chunk_count = (pass->old->face_count + TN_CHUNK_FACES - 1) / TN_CHUNK_FACES;
    if (!tn_pages_reserve(&space->chunks, pass->chunk_count * sizeof *pass->chunks) ||
        !deciders_prepare(space, (int)tn_crew_threads(tn_pass_crew(pass))))
        return tn_fail_memory(error);
    pass->chunks = space->chunks.data;
    tn_status status = tn_crew_run(tn_pass_crew(pass), pass->chunk_count, 1, decide_chunk, pass, error);
    if (status == TN_OK && !decide_later(pass))
        status = tn_fail_memory(error);
    count_failures(pass->growth);
    return status;
}
