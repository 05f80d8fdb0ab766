/* What rooms can tell of the inside of a tray, in a form that is the same where they cannot tell it apart.
 *
 * Of a cell only that is kept which a question about its room can still depend on. A room that cannot go on behind the
 * planes beside the tray, and of which nothing is seen there, is known here: only the questions that it answers are
 * kept. Those that answer none are as good as one. */
#include <stdlib.h>
#include <string.h>

#include "runtime/house/frontier/parts.h"

/* The rooms of the tray by their first cells. */
typedef struct tn_inside_rooms {
    const tn_inside *in;
    uint32_t *of; /* [cells] */
    tn_whole_room whole[TN_STRIP_CELLS_MAX];
    tn_room_open open[TN_STRIP_CELLS_MAX];
    bool goes_on[TN_STRIP_CELLS_MAX];
    uint32_t truth[TN_STRIP_CELLS_MAX];
    uint32_t nothing; /* the first cell of a room that answers no question */
} tn_inside_rooms;

/* The kinds in the inner faces of a cell, as far as rooms ask for them. */
static uint64_t inner_marks(const tn_inside *in, uint32_t cell)
{
    uint64_t marks = 0;
    for (size_t i = 0; i < in->house.face_count; i++) {
        const tn_face *face = &in->house.faces[i];
        if (tn_face_is_inner(face) && (face->first == cell || face->second == cell))
            marks |= tn_strip_marks(in->strip, face->kind);
    }
    return marks;
}

/* What is glazed in its outside faces at the back and the front. */
static tn_int128 inner_glass(const tn_inside *in, uint32_t cell)
{
    tn_int128 glass = 0;
    for (size_t i = 0; i < in->house.face_count; i++)
        if (tn_face_is_inner(&in->house.faces[i]) && in->house.faces[i].first == cell)
            glass += tn_face_glazing(&in->house, &in->house.faces[i]);
    return glass;
}

static tn_status find_open(tn_inside_rooms *r, tn_error *error)
{
    const tn_inside *in = r->in;
    uint32_t count = (uint32_t)in->house.cell_count;
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < count; i++)
        if (!in->house.cells[i].open)
            r->whole[r->of[i]].fails |= tn_strip_answers_fail(in->strip, in->cells[i]->answers);
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        if (r->of[i] == i)
            status = tn_strip_room_open(in->strip, r->whole[i].fails, &r->open[i], error);
    return status;
}

/* Can the plane at a side of the cell tell more of its room? Where it is asked where rooms are, it always may. */
static bool is_seen(const tn_inside_rooms *r, tn_strip_role_at role, uint32_t cell)
{
    const tn_strip_reach *reach = tn_inside_reach(r->in, role, cell);
    const tn_room_open *open = &r->open[r->of[cell]];
    return r->in->strip->questions.placed_count > 0 || reach->open || reach->marks & open->kinds ||
           (open->glass && reach->glazed);
}

static void gather(tn_inside_rooms *r)
{
    const tn_inside *in = r->in;
    for (uint32_t i = 0; i < in->house.cell_count; i++) {
        uint32_t room = r->of[i];
        const tn_room_open *open = &r->open[room];
        tn_whole_room *whole = &r->whole[room];
        if (!open->any && in->strip->questions.placed_count == 0)
            continue;
        whole->kinds |= open->kinds ? inner_marks(in, i) & open->kinds : 0;
        whole->glass += open->glass ? inner_glass(in, i) : 0;
        whole->area += open->area && !in->house.cells[i].open ? tn_cell_area(&in->house.cells[i]) : 0;
        whole->cells += !in->house.cells[i].open;
        r->goes_on[room] = r->goes_on[room] || is_seen(r, TN_STRIP_ENTRY, i) || is_seen(r, TN_STRIP_EXIT, i);
    }
    r->nothing = TN_STRIP_NONE;
    for (uint32_t i = 0; i < in->house.cell_count; i++) {
        uint32_t room = r->of[i];
        if (room == i && r->open[i].any && !r->goes_on[i])
            r->truth[i] = tn_strip_room_truth(in->strip, &r->whole[i]);
        if (!r->goes_on[room] && r->truth[room] == 0 && r->nothing == TN_STRIP_NONE)
            r->nothing = i;
    }
}

/* What is known of the room as a whole stands at its first cell. */
static tn_status push_cell(const tn_inside_rooms *r, uint32_t cell, tn_key *key, tn_error *error)
{
    const tn_inside *in = r->in;
    tn_strip *strip = in->strip;
    const tn_cell *at = &in->house.cells[cell];
    uint32_t base = 0, room = r->of[cell];
    tn_whole_room own = {0};
    if (!at->open && strip->tiled[at->function]) {
        tn_status status = tn_strip_fit_base(strip, &in->house, cell, &base, error);
        if (status != TN_OK)
            return status;
    }
    if (r->goes_on[room] && room == cell)
        own = r->whole[cell];
    uint32_t is = !r->goes_on[room] ? ROOM_IS_KNOWN
                  : at->open        ? ROOM_IS_VOID
                                    : ROOM_GOES_ON,
             to = r->goes_on[room] || r->truth[room] ? room : r->nothing;
    uint32_t area = tn_strip_number_area(strip, own.area), glass = tn_strip_number_area(strip, own.glass);
    bool ok = area != UINT32_MAX && glass != UINT32_MAX && tn_key_push(key, base) && tn_key_push(key, area) &&
              tn_key_push(key, glass) && tn_push_long(key, own.kinds) && tn_push_long(key, own.fails) &&
              tn_key_push(key, to) && tn_key_push(key, is) && tn_key_push(key, r->truth[room]);
    return ok ? TN_OK : tn_fail_memory(error);
}

tn_status tn_strip_push_inside(const tn_inside *in, tn_key *key, tn_error *error)
{
    tn_inside_rooms r = {.in = in};
    tn_status status = tn_house_rooms(&in->house, &r.of, error);
    if (status == TN_OK)
        status = find_open(&r, error);
    if (status == TN_OK)
        gather(&r);
    for (uint32_t i = 0; status == TN_OK && i < in->house.cell_count; i++)
        status = push_cell(&r, i, key, error);
    free(r.of);
    if (status == TN_OK && !tn_strip_push_walks(in, key))
        status = tn_fail_memory(error);
    return status;
}
