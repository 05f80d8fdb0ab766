/* A face's loop as a pass leaves it: each dart's pieces, and the branches at its corners. */
#include <stdlib.h>

#include "runtime/map/join.h"

#define AHEAD 6u /* faces, and darts of each */

void tn_loop_clear(tn_loop *loop)
{
    free(loop->items);
    free(loop->branches);
    free(loop->candidates);
    free(loop->joins);
    *loop = (tn_loop){0};
}

static bool make_room(tn_loop *loop, size_t items, size_t branches)
{
    if (loop->item_count + items > loop->item_room) {
        size_t room = 2 * (loop->item_count + items) + 64;
        tn_loop_item *grown = realloc(loop->items, room * sizeof *grown);
        if (!grown)
            return false;
        loop->items = grown;
        loop->item_room = room;
    }
    if (loop->branch_count + branches > loop->branch_room) {
        size_t room = 2 * (loop->branch_count + branches) + 64;
        tn_loop_branch *grown = realloc(loop->branches, room * sizeof *grown);
        if (!grown)
            return false;
        loop->branches = grown;
        loop->branch_room = room;
    }
    return true;
}

static void add_dart(tn_loop *loop, uint32_t vertex, uint32_t side)
{
    loop->items[loop->item_count++] = (tn_loop_item){vertex, side, 0, false, false};
}

static int32_t branch_age(uint8_t change, int32_t age)
{
    return change == TN_AGE_KEEP ? age : change == TN_AGE_MORE ? age + 1 : change == TN_AGE_LESS ? age - 1 : 0;
}

static void add_branch(tn_loop *loop, const tn_pass *pass, uint32_t slot, uint32_t index, uint32_t vertex,
                       uint32_t beyond)
{
    const tn_record *record = &pass->records[slot];
    const tn_template *template = &pass->growth->system->templates[record->template];
    const tn_template_branch *b = &template->branches[index];
    bool old = b->at == 0 || b->at == template->segment_count;
    tn_vector h = tn_vector_at(record->heading), u = tn_vector_at(record->up), l = tn_cross(u, h);
    tn_loop_branch *branch = &loop->branches[loop->branch_count];
    branch->direction = tn_along(tn_along(tn_scale(h, b->direction[0]), l, b->direction[1]), u, b->direction[2]);
    branch->at = tn_vector_at(pass->new->positions + 3 * (size_t)vertex);
    branch->id = record->branch + index;
    branch->label = b->label;
    branch->item = loop->item_count;
    branch->age = branch_age(b->age, record->age);
    branch->partner = -1;
    branch->record = slot;
    branch->point = b->at;
    branch->beyond = old ? TN_NONE : beyond;
    branch->reversed = b->reversed;
    loop->items[loop->item_count++] = (tn_loop_item){vertex, loop->branch_count++, 0, true, false};
}

static void add_pending(tn_loop *loop, const tn_pass *pass, const tn_pending *pending, uint32_t vertex)
{
    tn_loop_branch *branch = &loop->branches[loop->branch_count];
    *branch = (tn_loop_branch){.direction = tn_vector_at(pending->direction),
                               .at = tn_vector_at(pass->new->positions + 3 * (size_t)vertex),
                               .id = pending->id,
                               .label = pending->label,
                               .item = loop->item_count,
                               .age = pending->age,
                               .partner = -1,
                               .record = TN_NONE,
                               .beyond = TN_NONE,
                               .reversed = pending->reversed};
    loop->items[loop->item_count++] = (tn_loop_item){vertex, loop->branch_count++, 0, true, false};
}

/* The pieces of a replaced edge along one side; `start` and `end` are the loop's vertices before and after them. */
static void add_pieces(tn_loop *loop, const tn_pass *pass, uint32_t slot, bool against, uint32_t start, uint32_t end,
                       bool branches)
{
    const tn_record *record = &pass->records[slot];
    const tn_shape *shape = &pass->growth->shapes[record->template];
    const tn_walk *walk = against ? shape->right : shape->left;
    uint32_t count = against ? shape->right_count : shape->left_count, points = shape->template->segment_count;
    uint32_t beyond = against ? record->left : record->right;
    for (uint32_t i = 0; i < count; i++) {
        if (walk[i].branch && !branches)
            continue;
        uint32_t at = walk[i].at, vertex = record->vertex + at - 1;
        if (at == 0)
            vertex = against ? end : start;
        else if (at == points)
            vertex = against ? start : end;
        if (walk[i].branch)
            add_branch(loop, pass, slot, walk[i].index, vertex, beyond);
        else
            add_dart(loop, vertex, 2 * (record->child + walk[i].index) + (walk[i].reversed != against));
    }
}

/* A face's records lie where its edges' numbers say, all over memory: asked for a few faces ahead, they are there in
 * time. */
void tn_loop_prefetch(const tn_pass *pass, uint32_t face)
{
    const tn_map *old = pass->old;
    if (face + 3 * AHEAD >= old->face_count)
        return;
    const uint32_t *side = old->side, *first = old->face_first;
    uint32_t far = face + 3 * AHEAD, middle = face + 2 * AHEAD, near = face + AHEAD;
    for (uint32_t d = first[far], end = first[far + 1]; d < end && d < first[far] + AHEAD; d++)
        __builtin_prefetch(&pass->slot[side[d] / 2]);
    for (uint32_t d = first[middle], end = first[middle + 1]; d < end && d < first[middle] + AHEAD; d++) {
        uint32_t slot = pass->slot[side[d] / 2];
        if (slot & TN_KEPT)
            continue;
        const char *record = (const char *)&pass->records[slot];
        __builtin_prefetch(record);
        __builtin_prefetch(record + sizeof(tn_record) - 1);
    }
    for (uint32_t d = first[near], end = first[near + 1]; d < end && d < first[near] + AHEAD; d++) {
        uint32_t slot = pass->slot[side[d] / 2];
        if (!(slot & TN_KEPT))
            __builtin_prefetch(pass->new->positions + 3 * (size_t)pass->records[slot].vertex);
    }
}

bool tn_loop_expand(tn_loop *loop, const tn_pass *pass, uint32_t face, bool branches)
{
    const tn_map *old = pass->old;
    uint32_t first = old->face_first[face], size = tn_face_size(old, face);
    const uint32_t *sides = old->side + first, *origins = old->origin + first;
    const tn_pending_list *list = &pass->growth->pending;
    const tn_pending *pending = NULL, *pending_end = NULL;
    if (branches && list->count) {
        pending = list->items + list->face_first[face];
        pending_end = list->items + list->face_first[face + 1];
    }
    loop->item_count = loop->branch_count = loop->join_count = loop->candidate_count = 0;
    for (uint32_t i = 0; i < size; i++) {
        uint32_t slot = pass->slot[sides[i] / 2], room = 1, next = i + 1;
        bool against = sides[i] & 1;
        const tn_shape *shape = slot & TN_KEPT ? NULL : &pass->growth->shapes[pass->records[slot].template];
        if (shape) {
            if (pass->runs && sides[i] / 2 != (against ? pass->runs[slot].last : pass->runs[slot].first))
                continue; /* within a chain: its head on this side stands for all of it */
            while (pass->runs && pass->slot[sides[next % size] / 2] == slot)
                next++;
            room = against ? shape->right_count : shape->left_count;
        }
        size_t waiting = (size_t)(pending_end - pending);
        if (!make_room(loop, room + waiting, room + waiting))
            return false;
        while (pending < pending_end && pending->dart == first + i)
            add_pending(loop, pass, pending++, origins[i]);
        if (shape)
            add_pieces(loop, pass, slot, against, origins[i], origins[next % size], branches);
        else
            add_dart(loop, origins[i], 2 * (slot & ~TN_KEPT) | against);
    }
    return true;
}
