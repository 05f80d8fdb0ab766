/* A face's loop as a pass leaves it: each dart's pieces, and the branches at its corners. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/growth/join/join.h"

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
    return tn_array_reserve(&loop->items, &loop->item_room, loop->item_count, items, sizeof *loop->items) &&
           tn_array_reserve(&loop->branches, &loop->branch_room, loop->branch_count, branches, sizeof *loop->branches);
}

static void add_dart(tn_loop *loop, uint32_t vertex, uint32_t side)
{
    loop->items[loop->item_count++] = (tn_loop_item){vertex, side, 0, false, false};
}

/* A branch of a replaced edge; its direction is filled in by the caller. */
static void add_branch(tn_loop *loop, const tn_pass *pass, uint32_t edge, uint32_t index, uint32_t vertex,
                       uint32_t corner)
{
    const tn_record *record = &pass->records[edge];
    uint32_t id = record->branch + index, beyond = pass->aims[id - pass->branch_first].beyond;
    const tn_template *template = pass->growth->shapes[record->template].template;
    const tn_template_branch *b = &template->branches[index];
    bool old = b->at == 0 || b->at == template->segment_count;
    loop->branches[loop->branch_count] = (tn_loop_branch){.at = tn_vector_at(pass->new->positions + 3 * (size_t)vertex),
                                                          .id = id,
                                                          .label = b->label,
                                                          .item = loop->item_count,
                                                          .age = tn_changed_age(b->age, record->age),
                                                          .partner = -1,
                                                          .edge = pass->runs ? pass->runs[edge].first : edge,
                                                          .point = b->at,
                                                          .beyond = old ? TN_NONE : beyond,
                                                          .corner = corner,
                                                          .reversed = b->reversed};
    loop->items[loop->item_count++] = (tn_loop_item){vertex, loop->branch_count++, 0, true, false};
}

/* Directions of the branches from `first` on, which are those of an edge (or of its chain). */
static void turn_branches(tn_loop *loop, const tn_pass *pass, uint32_t edge, uint32_t first)
{
    if (first == loop->branch_count)
        return;
    const tn_record *record = &pass->records[edge];
    tn_edge_run run = pass->runs ? pass->runs[edge] : (tn_edge_run){edge, edge};
    tn_vector heading, up;
    double length;
    tn_pass_frame(pass, run.first, run.last, &heading, &up, &length);
    for (uint32_t i = first; i < loop->branch_count; i++) {
        tn_loop_branch *branch = &loop->branches[i];
        branch->direction = tn_branch_direction(
            heading, up, &pass->growth->system->templates[record->template].branches[branch->id - record->branch]);
    }
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
                               .edge = TN_NONE,
                               .beyond = TN_NONE,
                               .corner = pending->dart,
                               .reversed = pending->reversed};
    loop->items[loop->item_count++] = (tn_loop_item){vertex, loop->branch_count++, 0, true, false};
}

/* The pieces of a replaced edge along one side, from the old dart `here` on; `next` is the one after them. */
static void add_pieces(tn_loop *loop, const tn_pass *pass, uint32_t edge, bool against, uint32_t here, uint32_t next,
                       bool branches)
{
    uint32_t start = pass->old->origin[here], end = pass->old->origin[next];
    const tn_record *record = &pass->records[edge];
    const tn_shape *shape = &pass->growth->shapes[record->template];
    const tn_walk *walk = against ? shape->right : shape->left;
    uint32_t count = against ? shape->right_count : shape->left_count, points = shape->template->segment_count;
    for (uint32_t i = 0; i < count; i++) {
        if (walk[i].branch && !branches)
            continue;
        uint32_t at = walk[i].at, vertex = record->vertex + at - 1;
        bool leaves_end = at == (against ? 0 : points);
        if (leaves_end)
            vertex = end;
        else if (at == 0 || at == points)
            vertex = start;
        if (walk[i].branch)
            add_branch(loop, pass, edge, walk[i].index, vertex, leaves_end ? next : here);
        else
            add_dart(loop, vertex, record->side + 2 * walk[i].index + (walk[i].reversed != against));
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
        uint32_t edge = sides[i] / 2, room = 1, next = i + 1;
        bool against = sides[i] & 1;
        const tn_record *record = &pass->records[edge];
        const tn_shape *shape = tn_is_kept(record) ? NULL : &pass->growth->shapes[record->template];
        if (shape) {
            if (pass->runs && edge != (against ? pass->runs[edge].last : pass->runs[edge].first))
                continue; /* within a chain: its head on this side stands for all of it */
            while (pass->runs && pass->runs[sides[next % size] / 2].first == pass->runs[edge].first)
                next++;
            room = against ? shape->right_count : shape->left_count;
        }
        size_t waiting = (size_t)(pending_end - pending);
        if (!make_room(loop, room + waiting, room + waiting))
            return false;
        while (pending < pending_end && pending->dart == first + i)
            add_pending(loop, pass, pending++, origins[i]);
        uint32_t before = loop->branch_count;
        if (shape)
            add_pieces(loop, pass, edge, against, first + i, first + next % size, branches);
        else
            add_dart(loop, origins[i], record->side | against);
        turn_branches(loop, pass, edge, before);
    }
    return true;
}
