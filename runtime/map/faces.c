/* The faces of a pass, in chunks: each chunk is worked out in a buffer that stays in the cache, gets its place in the
 * new map when its turn comes, and is copied there. Places therefore do not depend on which thread did what. Faces that
 * a join in another face might concern wait until all others are done, and are then taken in the order of their ranks.
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/map/join.h"
#include "runtime/map/share.h"

#define BATCH_CHUNKS 12u /* for each thread */

typedef struct out_loop {
    uint32_t first;  /* dart of the buffer; the next loop's first ends it */
    uint32_t face;   /* the old face it comes from: index into the buffer's faces */
    uint32_t region; /* 0: it keeps the face's rank */
    uint32_t pending_first, pending_count;
} out_loop;

typedef struct out_joint {
    uint32_t branch;     /* lower number */
    uint32_t start, end; /* darts of the buffer */
    tn_edge_state state;
} out_joint;

/* What some faces became; used again for others. */
typedef struct buffer {
    uint32_t *origin, *side;
    out_loop *loops;
    out_joint *joints;
    tn_pending *pending;
    size_t dart_count, loop_count, joint_count, pending_count;
    size_t dart_room, loop_room, joint_room, pending_room;
    uint32_t faces[TN_CHUNK_FACES]; /* numbers in the old map */
    uint32_t joins[TN_CHUNK_FACES]; /* of each */
    uint32_t face_count;
    uint32_t later[TN_CHUNK_FACES]; /* faces that wait */
    uint32_t later_count;
    tn_loop loop;
} buffer;

/* Where the next buffer goes; touched only in its turn. */
typedef struct places {
    uint32_t darts, faces, joins;
    tn_pair_set taken;
    tn_pending_list pending; /* of the new map */
    uint32_t *later;         /* faces that wait, of all chunks */
    size_t later_count, later_room;
    bool failed; /* out of memory */
} places;

static void clear_buffer(buffer *out)
{
    free(out->origin);
    free(out->side);
    free(out->loops);
    free(out->joints);
    free(out->pending);
    tn_loop_clear(&out->loop);
}

static void empty_buffer(buffer *out)
{
    out->dart_count = out->loop_count = out->joint_count = out->pending_count = 0;
    out->face_count = out->later_count = 0;
}

static bool grow_array(void **array, size_t *room, size_t need, size_t size)
{
    if (need <= *room)
        return true;
    size_t larger = 2 * need + 256;
    void *grown = realloc(*array, larger * size);
    if (!grown)
        return false;
    *array = grown;
    *room = larger;
    return true;
}

static bool make_room(buffer *out, const tn_loop *loop, bool pending)
{
    size_t darts = out->dart_count + loop->item_count, side_room = out->dart_room;
    return grow_array((void **)&out->origin, &side_room, darts, sizeof *out->origin) &&
           grow_array((void **)&out->side, &out->dart_room, darts, sizeof *out->side) &&
           grow_array((void **)&out->loops, &out->loop_room, out->loop_count + loop->join_count + 1,
                      sizeof *out->loops) &&
           grow_array((void **)&out->joints, &out->joint_room, out->joint_count + loop->join_count,
                      sizeof *out->joints) &&
           (!pending || grow_array((void **)&out->pending, &out->pending_room, out->pending_count + loop->branch_count,
                                   sizeof *out->pending));
}

static void keep_pending(buffer *out, const tn_loop_branch *branch)
{
    tn_pending *one = &out->pending[out->pending_count++];
    tn_vector_put(one->direction, branch->direction);
    one->dart = (uint32_t)out->dart_count; /* the next dart written */
    one->id = branch->id;
    one->label = branch->label;
    one->age = branch->age;
    one->reversed = branch->reversed;
}

/* Branches met after a loop's last dart lie in the corner before its first: they come first. */
static void turn_pending(buffer *out, const out_loop *loop)
{
    uint32_t loop_end = (uint32_t)out->dart_count;
    tn_pending *list = out->pending + loop->pending_first;
    uint32_t count = loop->pending_count, tail = 0;
    while (tail < count && list[count - 1 - tail].dart == loop_end)
        tail++;
    for (uint32_t i = 0; i < tail; i++) {
        tn_pending last = list[count - 1];
        memmove(list + 1, list, (count - 1) * sizeof *list);
        last.dart = loop->first;
        list[0] = last;
    }
}

/* Writes the loop that item `start` lies on. A branch that joined is the dart towards its partner, after which the loop
 * goes on behind the partner. */
static void write_loop(buffer *out, uint32_t *joint_dart, uint32_t face, uint32_t start, bool keeps_pending)
{
    tn_loop *loop = &out->loop;
    out_loop *made = &out->loops[out->loop_count++];
    *made = (out_loop){(uint32_t)out->dart_count, face, loop->items[start].region, (uint32_t)out->pending_count, 0};
    uint32_t i = start;
    do {
        tn_loop_item *item = &loop->items[i];
        const tn_loop_branch *branch = item->is_branch ? &loop->branches[item->value] : NULL;
        uint32_t next = i;
        if (!branch || branch->partner >= 0) {
            item->seen = true;
            out->origin[out->dart_count] = item->vertex;
            out->side[out->dart_count] = item->value;
            if (branch) {
                joint_dart[item->value] = (uint32_t)out->dart_count;
                next = loop->branches[branch->partner].item;
            }
            out->dart_count++;
        } else if (keeps_pending) {
            keep_pending(out, branch);
        }
        i = next + 1 == loop->item_count ? 0 : next + 1;
    } while (i != start);
    made->pending_count = (uint32_t)out->pending_count - made->pending_first;
    if (made->pending_count)
        turn_pending(out, made);
}

static void write_joints(buffer *out, const uint32_t *joint_dart)
{
    tn_loop *loop = &out->loop;
    for (uint32_t i = 0; i < loop->join_count; i++) {
        const tn_loop_join *join = &loop->joins[i];
        const tn_loop_branch *a = &loop->branches[join->start], *b = &loop->branches[join->end];
        out->joints[out->joint_count++] =
            (out_joint){loop->branches[join->low].id, joint_dart[join->start], joint_dart[join->end],
                        tn_state(a->label, a->age > b->age ? a->age : b->age, false)};
    }
}

static bool write_face(buffer *out, uint32_t face, bool keeps_pending)
{
    tn_loop *loop = &out->loop;
    uint32_t some[64], *joint_dart = some;
    if (!make_room(out, loop, keeps_pending))
        return false;
    if (loop->branch_count > 64 && !(joint_dart = malloc(loop->branch_count * sizeof *joint_dart)))
        return false;
    out->joins[face] = loop->join_count;
    for (uint32_t i = 0; i < loop->item_count; i++) {
        const tn_loop_item *item = &loop->items[i];
        if (!item->seen && (!item->is_branch || loop->branches[item->value].partner >= 0))
            write_loop(out, joint_dart, face, i, keeps_pending);
    }
    write_joints(out, joint_dart);
    if (joint_dart != some)
        free(joint_dart);
    return true;
}

static void note_failures(const tn_pass *pass, const tn_loop *loop)
{
    uint64_t failures[TN_JOIN_FAILURE_COUNT] = {0};
    tn_loop_explain(loop, pass, failures);
    for (int i = 0; i < TN_JOIN_FAILURE_COUNT; i++) {
#pragma omp atomic
        pass->growth->counts.failures[i] += failures[i];
    }
}

/* One face into the buffer. Without `taken` it may be put off. */
static bool take_face(const tn_pass *pass, buffer *out, uint32_t number, tn_pair_set *taken)
{
    bool interior = number != TN_OUTER_FACE;
    if (!tn_loop_expand(&out->loop, pass, number, interior))
        return false;
    switch (tn_loop_join_branches(&out->loop, pass, number, taken)) {
    case TN_JOIN_MEMORY:
        return false;
    case TN_JOIN_LATER:
        out->later[out->later_count++] = number;
        return true;
    default:
        break;
    }
    uint32_t face = out->face_count++;
    out->faces[face] = number;
    if (pass->growth->options.explain && pass->joins_last)
        note_failures(pass, &out->loop);
    return write_face(out, face, interior && !pass->joins_last);
}

/* Gives a full buffer its place. */
static bool place_buffer(const buffer *out, places *place, places *mine)
{
    mine->darts = place->darts;
    mine->faces = place->faces;
    mine->joins = place->joins;
    mine->pending.count = place->pending.count;
    place->darts += (uint32_t)out->dart_count;
    place->faces += (uint32_t)out->loop_count;
    place->joins += (uint32_t)out->joint_count;
    tn_pending_list *list = &place->pending;
    if (!grow_array((void **)&list->items, &list->capacity, list->count + out->pending_count, sizeof *list->items) ||
        !grow_array((void **)&place->later, &place->later_room, place->later_count + out->later_count,
                    sizeof *place->later))
        return false;
    for (size_t i = 0; i < out->pending_count; i++) {
        tn_pending *one = &list->items[list->count++];
        *one = out->pending[i];
        one->dart += mine->darts;
    }
    for (uint32_t i = 0; i < out->later_count; i++)
        place->later[place->later_count++] = out->later[i];
    return true;
}

/* Copies a placed buffer into the new map. Joined edges have no numbers yet: their first dart tells the second, where
 * their state waits. New faces have no ranks yet: the n-th join's parent waits where its edge's state will be. */
static void copy_buffer(const tn_pass *pass, const buffer *out, const places *mine)
{
    tn_map *new = pass->new;
    uint32_t first_join[TN_CHUNK_FACES], joins = mine->joins, old_faces = pass->old->face_count;
    for (uint32_t f = 0; f < out->face_count; f++) {
        uint32_t rank = pass->old->face_rank[out->faces[f]];
        first_join[f] = joins;
        pass->made_first[rank] = joins;
        pass->made_count[rank] = out->joins[f];
        for (uint32_t i = 0; i < out->joins[f]; i++)
            new->states[pass->edges + joins++] = rank;
    }
    if (out->dart_count) {
        memcpy(new->origin + mine->darts, out->origin, out->dart_count * sizeof *out->origin);
        memcpy(new->side + mine->darts, out->side, out->dart_count * sizeof *out->side);
    }
    for (size_t i = 0; i < out->loop_count; i++) {
        const out_loop *loop = &out->loops[i];
        uint32_t face = mine->faces + (uint32_t)i;
        new->face_first[face] = mine->darts + loop->first;
        new->face_rank[face] = loop->region ? old_faces + first_join[loop->face] + loop->region - 1
                                            : pass->old->face_rank[out->faces[loop->face]];
        if (pass->pending_first)
            pass->pending_first[face] = (uint32_t)mine->pending.count + loop->pending_first;
    }
    for (size_t i = 0; i < out->joint_count; i++) {
        const out_joint *joint = &out->joints[i];
        pass->joints[joint->branch] = mine->darts + joint->start;
        new->side[mine->darts + joint->start] = mine->darts + joint->end;
        new->side[mine->darts + joint->end] = joint->state;
    }
}

/* A chunk of faces on its way: worked out by any thread, placed in its turn, copied by any thread. */
typedef struct tn_chunk {
    buffer out;
    places mine;
    bool failed;
} tn_chunk;

/* Chunks [first, ...) of the pass, that are on their way together. */
typedef struct batch {
    const tn_pass *pass;
    tn_chunk *chunks;
    uint32_t first;
} batch;

static void work_out(void *context, uint32_t i)
{
    const batch *b = context;
    const tn_pass *pass = b->pass;
    tn_chunk *work = &b->chunks[i];
    uint32_t faces = pass->old->face_count, begin = (b->first + i) * TN_CHUNK_FACES;
    uint32_t end = faces - begin < TN_CHUNK_FACES ? faces : begin + TN_CHUNK_FACES;
    empty_buffer(&work->out);
    work->failed = false;
    for (uint32_t f = begin; f < end && !work->failed; f++) {
        tn_loop_prefetch(pass, f);
        work->failed = !take_face(pass, &work->out, f, NULL);
    }
}

static void copy_chunk(void *context, uint32_t i)
{
    const batch *b = context;
    copy_buffer(b->pass, &b->chunks[i].out, &b->chunks[i].mine);
}

static void run_batch(batch *b, places *place, uint32_t count)
{
    int threads = b->pass->threads;
    tn_share(threads, count, TN_SHARE_UNEVEN, work_out, b);
    for (uint32_t i = 0; i < count && !place->failed; i++)
        place->failed = b->chunks[i].failed || !place_buffer(&b->chunks[i].out, place, &b->chunks[i].mine);
    if (!place->failed)
        tn_share(threads, count, TN_SHARE_EVENLY, copy_chunk, b);
}

void tn_chunks_free(tn_chunk *chunks, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        clear_buffer(&chunks[i].out);
    free(chunks);
}

static bool reserve_chunks(tn_workspace *space, uint32_t count)
{
    if (count <= space->chunk_count)
        return true;
    tn_chunk *grown = realloc(space->chunks, count * sizeof *grown);
    if (!grown)
        return false;
    memset(grown + space->chunk_count, 0, (count - space->chunk_count) * sizeof *grown);
    space->chunks = grown;
    space->chunk_count = count;
    return true;
}

/* In batches, so that threads meet seldom and few buffers are needed; one thread keeps its one buffer in the cache. */
static void run_chunks(const tn_pass *pass, places *place)
{
    tn_workspace *space = &pass->growth->space;
    uint32_t chunks = (pass->old->face_count + TN_CHUNK_FACES - 1) / TN_CHUNK_FACES;
    uint32_t room = pass->threads > 1 ? BATCH_CHUNKS * (uint32_t)pass->threads : 1;
    room = room < chunks ? room : chunks;
    place->failed = !reserve_chunks(space, room);
    batch b = {pass, space->chunks, 0};
    for (; b.first < chunks && !place->failed; b.first += room)
        run_batch(&b, place, chunks - b.first < room ? chunks - b.first : room);
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
static void run_later(const tn_pass *pass, places *place)
{
    sort_by_rank(pass->old->face_rank, place->later, place->later_count);
    buffer *out = &pass->growth->space.chunks[0].out;
    size_t next = 0, count = place->later_count;
    while (next < count && !place->failed) {
        places mine;
        empty_buffer(out);
        bool fine = true;
        while (next < count && out->face_count < TN_CHUNK_FACES && fine)
            fine = take_face(pass, out, place->later[next++], &place->taken);
        fine = fine && place_buffer(out, place, &mine);
        if (fine)
            copy_buffer(pass, out, &mine);
        place->failed = !fine;
    }
}

/* New faces rank after all old ones: by their parents' ranks, then in the order of the joins that made them. */
static void rank_faces(const tn_pass *pass)
{
    tn_map *new = pass->new;
    uint32_t old_faces = pass->old->face_count, next = old_faces;
    for (uint32_t r = 0; r < old_faces; r++) {
        uint32_t count = pass->made_count[r];
        pass->made_count[r] = next;
        next += count;
    }
    if (next == old_faces)
        return;
    for (uint32_t f = 0; f < new->face_count; f++) {
        if (new->face_rank[f] < old_faces)
            continue;
        uint32_t join = new->face_rank[f] - old_faces, parent = new->states[pass->edges + join];
        new->face_rank[f] = pass->made_count[parent] + join - pass->made_first[parent];
    }
}

/* ---- the whole pass */

static tn_status make_map(tn_pass *pass, tn_error *error)
{
    tn_map *new = pass->new;
    tn_workspace *space = &pass->growth->space;
    uint64_t joins = ((uint64_t)pass->branch_count + pass->growth->pending.count) / 2;
    uint64_t darts = 2 * (pass->edges + joins), faces = pass->old->face_count + joins + 1;
    size_t numbers = (size_t)pass->branch_first + pass->branch_count;
    if (darts > UINT32_MAX)
        return tn_fail(error, TN_LIMIT, 840, "step %u could make more than %u edges", pass->growth->steps + 1,
                       TN_EDGES_MAX);
    tn_pages *dart_space = &space->darts[!space->current], *face_space = &space->faces[!space->current];
    if (!tn_pages_reserve(dart_space, 2 * darts * sizeof *new->origin) ||
        !tn_pages_reserve(face_space, 2 * faces * sizeof *new->face_first) ||
        !tn_pages_reserve(&space->joints, numbers * sizeof *pass->joints) ||
        !tn_pages_reserve(&space->made, 2 * (size_t)pass->old->face_count * sizeof *pass->made_count))
        return tn_fail_memory(error);
    if (!pass->joins_last && !(pass->pending_first = malloc(faces * sizeof *pass->pending_first)))
        return tn_fail_memory(error);
    new->origin = dart_space->data;
    new->side = new->origin + darts;
    new->face_first = face_space->data;
    new->face_rank = new->face_first + faces;
    pass->joints = space->joints.data;
    pass->made_first = space->made.data;
    pass->made_count = pass->made_first + pass->old->face_count;
    memset(pass->joints, 0xff, numbers * sizeof *pass->joints);
    return TN_OK;
}

/* The branches that wait, now in the order of the new faces. */
static void hand_over_pending(tn_pass *pass, places *place)
{
    tn_pending_list *list = &pass->growth->pending;
    free(list->items);
    free(list->face_first);
    *list = (tn_pending_list){0};
    if (place->pending.count && pass->pending_first) {
        *list = place->pending;
        list->face_first = pass->pending_first;
        list->face_first[place->faces] = (uint32_t)list->count;
        place->pending.items = NULL;
        pass->pending_first = NULL;
    }
}

tn_status tn_pass_faces(tn_pass *pass, tn_error *error)
{
    places place = {0};
    tn_status status = make_map(pass, error);
    if (status != TN_OK)
        return status;
    run_chunks(pass, &place);
    if (place.later_count && !place.failed)
        run_later(pass, &place);
    tn_map *new = pass->new;
    new->face_count = place.faces;
    new->face_first[place.faces] = place.darts;
    new->edge_count = pass->edges + place.joins;
    new->vertex_count = pass->vertices;
    pass->growth->counts.joins += place.joins;
    status = place.failed ? tn_fail_memory(error) : TN_OK;
    if (status == TN_OK) {
        rank_faces(pass);
        status = tn_pass_number_joints(pass, error);
        hand_over_pending(pass, &place);
    }
    free(place.pending.items);
    free(place.taken.slots);
    free(place.later);
    free(pass->pending_first);
    return status;
}
