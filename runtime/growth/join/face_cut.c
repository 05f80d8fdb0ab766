/* Cuts a face into loops along its joined branches. */
#include "runtime/growth/join/face_cut.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

void tn_cuts_clear(tn_cuts *cuts)
{
    free(cuts->items);
    free(cuts->origins);
    free(cuts->sides);
    free(cuts->loops);
    free(cuts->joins);
    free(cuts->waiting);
    *cuts = (tn_cuts){0};
}

void tn_cuts_empty(tn_cuts *cuts)
{
    cuts->count = cuts->dart_count = cuts->loop_count = cuts->join_count = cuts->waiting_count = 0;
}

/* One more than is needed, so that there is an array to point into where nothing is. */
static bool make_room(tn_cuts *cuts, const tn_loop *loop, bool waiting)
{
    size_t joins = loop->join_count + 1, origin_room = cuts->dart_room;
    return tn_array_reserve(&cuts->items, &cuts->room, cuts->count, 1, sizeof *cuts->items) &&
           tn_array_reserve(&cuts->origins, &origin_room, cuts->dart_count, loop->item_count, sizeof *cuts->origins) &&
           tn_array_reserve(&cuts->sides, &cuts->dart_room, cuts->dart_count, loop->item_count, sizeof *cuts->sides) &&
           tn_array_reserve(&cuts->loops, &cuts->loop_room, cuts->loop_count, joins, sizeof *cuts->loops) &&
           tn_array_reserve(&cuts->joins, &cuts->join_room, cuts->join_count, joins, sizeof *cuts->joins) &&
           (!waiting || tn_array_reserve(&cuts->waiting, &cuts->waiting_room, cuts->waiting_count,
                                         loop->branch_count + 1, sizeof *cuts->waiting));
}

/* Branches met after a loop's last dart lie in the corner before its first: they come first. */
static void turn_waiting(tn_cut_waiting *list, uint32_t count, uint32_t first_dart, uint32_t end_dart)
{
    uint32_t tail = 0;
    while (tail < count && list[count - 1 - tail].dart == end_dart)
        tail++;
    for (uint32_t i = 0; i < tail; i++) {
        tn_cut_waiting last = list[count - 1];
        memmove(list + 1, list, (count - 1) * sizeof *list);
        last.dart = first_dart;
        list[0] = last;
    }
}

/* Writes the loop that item `start` lies on. A branch that joined is the dart towards its partner, after which the loop
 * goes on behind the partner. */
static void write_loop(tn_cuts *cuts, tn_cut *cut, tn_loop *loop, uint32_t start, bool waiting)
{
    uint32_t *origins = cuts->origins + cut->dart_first, *sides = cuts->sides + cut->dart_first;
    tn_cut_waiting *list = waiting ? cuts->waiting + cut->waiting_first : NULL;
    uint32_t first = cut->dart_count, before = cut->waiting_count, i = start;
    do {
        tn_loop_item *item = &loop->items[i];
        tn_loop_branch *branch = item->is_branch ? &loop->branches[item->value] : NULL;
        uint32_t next = i;
        if (!branch || branch->partner >= 0) {
            item->seen = true;
            origins[cut->dart_count] = item->vertex;
            sides[cut->dart_count] = branch ? TN_NONE : item->value;
            if (branch) {
                branch->dart = cut->dart_count;
                next = loop->branches[branch->partner].item;
            }
            cut->dart_count++;
        } else if (waiting) {
            list[cut->waiting_count++] = (tn_cut_waiting){item->value, cut->loop_count, cut->dart_count};
        }
        i = next + 1 == loop->item_count ? 0 : next + 1;
    } while (i != start);
    if (cut->waiting_count > before)
        turn_waiting(list + before, cut->waiting_count - before, first, cut->dart_count);
    cuts->loops[cut->loop_first + cut->loop_count++] = (tn_cut_loop){cut->dart_count, loop->items[start].region};
}

bool tn_cuts_add(tn_cuts *cuts, tn_loop *loop, bool waiting)
{
    if (!make_room(cuts, loop, waiting))
        return false;
    tn_cut *cut = &cuts->items[cuts->count++];
    *cut = (tn_cut){cuts->dart_count, cuts->loop_count, cuts->join_count, cuts->waiting_count, 0, 0, 0, 0};
    for (uint32_t i = 0; i < loop->item_count; i++) {
        const tn_loop_item *item = &loop->items[i];
        if (!item->seen && (!item->is_branch || loop->branches[item->value].partner >= 0))
            write_loop(cuts, cut, loop, i, waiting);
    }
    for (uint32_t i = 0; i < loop->join_count; i++) {
        const tn_loop_branch *one = &loop->branches[loop->joins[i].start], *other = &loop->branches[loop->joins[i].end];
        cuts->joins[cut->join_first + cut->join_count++] =
            (tn_cut_join){one->id, other->id, one->dart, other->dart, one->reversed != other->reversed, false, 0};
    }
    cuts->dart_count += cut->dart_count;
    cuts->loop_count += cut->loop_count;
    cuts->join_count += cut->join_count;
    cuts->waiting_count += cut->waiting_count;
    return true;
}

/* ---- references */

typedef struct table {
    const tn_pass *pass;
    uint32_t first, size; /* darts of the face */
} table;

/* The pieces that a dart's edge became; 0 where it is kept. */
static uint32_t pieces_of(const table *face, uint32_t dart)
{
    const tn_record *record = &face->pass->records[face->pass->old->side[face->first + dart] / 2];
    return tn_is_kept(record) ? 0 : face->pass->growth->system->templates[record->template].segment_count;
}

static uint32_t refer_to_vertex(const table *face, uint32_t vertex)
{
    uint32_t bases[TN_BASES];
    for (uint32_t i = 0; i < face->size; i++) {
        tn_dart_bases(face->pass, face->first + i, bases);
        if (bases[TN_BASE_ORIGIN] == vertex)
            return tn_refer(i, TN_BASE_ORIGIN, 0);
        uint32_t pieces = pieces_of(face, i), more = vertex - bases[TN_BASE_VERTEX];
        if (pieces > 0 && more < pieces - 1)
            return tn_refer(i, TN_BASE_VERTEX, more);
    }
    return 0;
}

static uint32_t refer_to_side(const table *face, uint32_t side)
{
    uint32_t bases[TN_BASES];
    for (uint32_t i = 0; i < face->size; i++) {
        tn_dart_bases(face->pass, face->first + i, bases);
        uint32_t pieces = pieces_of(face, i), more = side - bases[TN_BASE_SIDE];
        if (pieces ? more < 2 * pieces : more == 0)
            return tn_refer(i, TN_BASE_SIDE, more);
    }
    return 0;
}

/* Returns what the template says of the branch, too. */
static const tn_template_branch *refer_to_branch(const table *face, uint32_t *id)
{
    for (uint32_t i = 0; i < face->size; i++) {
        const tn_record *record = &face->pass->records[face->pass->old->side[face->first + i] / 2];
        if (tn_is_kept(record))
            continue;
        const tn_template *template = face->pass->growth->shapes[record->template].template;
        uint32_t more = *id - record->branch;
        if (more >= template->branch_count)
            continue;
        *id = tn_refer(i, TN_BASE_BRANCH, more);
        return &template->branches[more];
    }
    return NULL;
}

static void refer_to_joint(const table *face, tn_cut_join *join)
{
    const tn_template_branch *one = refer_to_branch(face, &join->one), *other = refer_to_branch(face, &join->other);
    join->aged = one->age != TN_AGE_ZERO || other->age != TN_AGE_ZERO;
    join->state = tn_state(one->label, 0, false);
}

void tn_cuts_refer(tn_cuts *cuts, const tn_pass *pass, uint32_t face, const tn_loop *loop)
{
    const tn_cut *cut = &cuts->items[cuts->count - 1];
    table of = {pass, pass->old->face_first[face], tn_face_size(pass->old, face)};
    for (size_t d = cut->dart_first; d < cut->dart_first + cut->dart_count; d++) {
        cuts->origins[d] = refer_to_vertex(&of, cuts->origins[d]);
        cuts->sides[d] = cuts->sides[d] == TN_NONE ? 0 : refer_to_side(&of, cuts->sides[d]);
    }
    for (size_t j = cut->join_first; j < cut->join_first + cut->join_count; j++)
        refer_to_joint(&of, &cuts->joins[j]);
    for (size_t w = cut->waiting_first; w < cut->waiting_first + cut->waiting_count; w++) {
        cuts->waiting[w].branch = loop->branches[cuts->waiting[w].branch].id;
        refer_to_branch(&of, &cuts->waiting[w].branch);
    }
}
