/* What bears walls: which outside and party walls stand above a partition, an open face or no wall, and the beams that
 * bear these. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/house.h"

/* A wall along its plane. */
typedef struct tn_wall_run {
    bool in_y;
    int64_t plane, from, to;
} tn_wall_run;

static tn_wall_run run_of(const tn_face *face)
{
    bool in_y = face->at.x0 == face->at.x1;
    return (tn_wall_run){in_y, in_y ? face->at.x0 : face->at.y0, in_y ? face->at.y0 : face->at.x0,
                         in_y ? face->at.y1 : face->at.x1};
}

void tn_bearing_clear(tn_bearing *bearing)
{
    free(bearing->items);
    *bearing = (tn_bearing){0};
}

/* ---- stretches */

static bool is_heavy(const tn_house *house, const tn_face *face)
{
    return face->storey > 0 && face->relation != TN_FACE_UNDER &&
           tn_face_thickness(house, face) > house->form->record->partition;
}

static bool bears(const tn_house *house, const tn_face *below)
{
    return tn_face_thickness(house, below) >= house->form->record->wall;
}

/* What a wall of the storey below bears of the line above, from a place on: *reaches is moved to where it bears all up to
 * there; *next back to the next place that it bears. */
static void look_below(const tn_house *house, const tn_face *below, const tn_wall_run *above, int64_t at,
                       int64_t *reaches, int64_t *next)
{
    tn_wall_run run = run_of(below);
    bool strong = bears(house, below), posts = tn_face_is_open_side(house, below);
    if (run.in_y == above->in_y && run.plane == above->plane) {
        if (strong && run.from <= at && run.to > *reaches)
            *reaches = run.to;
        if ((strong || posts) && run.from > at && run.from < *next)
            *next = run.from;
        if (posts && run.to > at && run.to < *next)
            *next = run.to;
    } else if (run.in_y != above->in_y && run.from <= above->plane && run.to >= above->plane) {
        bool meets = strong || (posts && (run.from == above->plane || run.to == above->plane));
        if (meets && run.plane > at && run.plane < *next)
            *next = run.plane;
    }
}

/* Does something below bear a place of the line? */
static bool is_held(const tn_house *house, uint32_t storey, const tn_wall_run *line, int64_t at)
{
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *below = &house->faces[i];
        if (below->relation == TN_FACE_UNDER || below->storey + 1 != storey)
            continue;
        tn_wall_run run = run_of(below);
        bool strong = bears(house, below), posts = tn_face_is_open_side(house, below);
        bool along = run.in_y == line->in_y && run.plane == line->plane;
        int64_t place = along ? at : line->plane;
        if ((!along && (run.in_y == line->in_y || run.plane != at)) || place < run.from || place > run.to)
            continue;
        if (strong || (posts && (place == run.from || place == run.to)))
            return true;
    }
    return false;
}

static tn_status add(tn_bearing *bearing, const tn_unborne *stretch, tn_error *error)
{
    if (!tn_array_reserve_from(&bearing->items, &bearing->room, 8, bearing->count, 1, sizeof *bearing->items))
        return tn_fail_memory(error);
    bearing->items[bearing->count++] = *stretch;
    return TN_OK;
}

/* The stretches of a line of walls that nothing bears. */
static tn_status add_line(const tn_house *house, uint32_t storey, const tn_wall_run *line, tn_bearing *bearing,
                          tn_error *error)
{
    tn_status status = TN_OK;
    for (int64_t at = line->from; status == TN_OK && at < line->to;) {
        int64_t reaches = at, next = line->to;
        for (size_t i = 0; i < house->face_count; i++)
            if (house->faces[i].relation != TN_FACE_UNDER && house->faces[i].storey + 1 == storey)
                look_below(house, &house->faces[i], line, at, &reaches, &next);
        tn_unborne stretch = {storey, line->in_y, false, line->plane, at, next, TN_NO_RECORD, {0}};
        stretch.held = is_held(house, storey, line, at) && is_held(house, storey, line, next);
        if (reaches == at)
            status = add(bearing, &stretch, error);
        at = reaches > at ? reaches : next;
    }
    return status;
}

/* The wall that goes on where another one ends, or begins where it begins (`before`); NULL: none does. */
static const tn_face *next_to(const tn_house *house, const tn_face *face, bool before)
{
    tn_wall_run run = run_of(face);
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *other = &house->faces[i];
        if (other->storey != face->storey || !is_heavy(house, other))
            continue;
        tn_wall_run next = run_of(other);
        if (next.in_y == run.in_y && next.plane == run.plane && (before ? next.to == run.from : next.from == run.to))
            return other;
    }
    return NULL;
}

static tn_status find_stretches(const tn_house *house, tn_bearing *bearing, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (!is_heavy(house, face) || next_to(house, face, true))
            continue;
        tn_wall_run line = run_of(face);
        for (const tn_face *next = face; next; next = next_to(house, next, false))
            line.to = run_of(next).to;
        status = add_line(house, face->storey, &line, bearing, error);
    }
    return status;
}

/* ---- beams */

/* Where beams are put. */
typedef struct tn_beaming {
    const tn_house *house;
    const tn_flights *flights;
    const tn_bearing *bearing; /* with the beams so far */
    tn_posts posts; /* of the storey below the walls */
} tn_beaming;

/* From post to post, under the deck. */
static tn_box box_of(const tn_beaming *b, const tn_unborne *stretch, const tn_beam_record *beam)
{
    const tn_house_form *form = b->house->form;
    int64_t ends[2] = {stretch->from, stretch->to}, half = beam->wide / 2, plane = stretch->plane,
            high = form->level[stretch->storey] - form->record->deck;
    for (int k = 0; k < 2; k++) {
        const tn_post *post = tn_posts_find(&b->posts, stretch->in_y ? plane : ends[k], stretch->in_y ? ends[k] : plane);
        int64_t thick = post ? (stretch->in_y ? post->thick_y : post->thick_x) : 0;
        ends[k] += k == 0 ? thick / 2 : -(thick / 2);
    }
    return stretch->in_y ? (tn_box){plane - half, plane + half, ends[0], ends[1], high - beam->high, high}
                         : (tn_box){ends[0], ends[1], plane - half, plane + half, high - beam->high, high};
}

static bool boxes_meet(const tn_box *a, const tn_box *b)
{
    return a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1 && a->z0 < b->z1 && b->z0 < a->z1;
}

/* Does what is in a face of the storey below leave a beam room: is an opening lower, can one walk through below it? */
static bool face_leaves_room(const tn_house *house, const tn_face *below, const tn_unborne *stretch, const tn_box *box)
{
    const tn_house_form *form = house->form;
    const tn_opening_record *opening = tn_form_opening(form, below->kind);
    tn_wall_run run = run_of(below);
    int64_t low = stretch->in_y ? box->y0 : box->x0, high = stretch->in_y ? box->y1 : box->x1,
            room = box->z0 - form->level[below->storey];
    if (below->relation == TN_FACE_UNDER || below->storey + 1 != stretch->storey || run.in_y != stretch->in_y ||
        run.plane != stretch->plane || run.to <= low || run.from >= high)
        return true;
    if (below->kind == TN_FACE_OPEN)
        return room >= form->record->headroom;
    return !opening || opening->sill + opening->high <= room;
}

/* A flight beside a wall is not walked into a beam. */
static bool flights_leave_room(const tn_beaming *b, const tn_unborne *stretch, const tn_box *box)
{
    int64_t head = b->house->form->record->headroom;
    for (size_t f = 0; f < b->flights->count; f++) {
        const tn_flight *flight = &b->flights->items[f];
        uint32_t storey = b->house->faces[flight->face].storey;
        for (size_t t = 0; storey + 1 == stretch->storey && t < flight->tread_count + flight->wedge_count; t++) {
            tn_box step = t < flight->tread_count ? flight->treads[t]
                                                  : tn_wedge_box(&flight->wedges[t - flight->tread_count]);
            step.z0 += b->house->form->level[storey];
            step.z1 += b->house->form->level[storey] + head;
            if (boxes_meet(&step, box))
                return false;
        }
    }
    return true;
}

static tn_status items_leave_room(const tn_house *house, const tn_unborne *stretch, const tn_box *box, bool *leave,
                                  tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t c = 0; status == TN_OK && *leave && c < house->cell_count; c++) {
        const tn_cell *cell = &house->cells[c];
        tn_variants v;
        if (cell->storey + 1 != stretch->storey || cell->at.x0 > box->x1 || cell->at.x1 < box->x0 ||
            cell->at.y0 > box->y1 || cell->at.y1 < box->y0)
            continue;
        status = tn_tile_variants(house, c, &v, error);
        const tn_tile_variant *variant = status == TN_OK && v.count > 0 ? &v.variants[cell->variant] : NULL;
        for (size_t i = 0; variant && i < variant->item_count; i++) {
            tn_box at = v.items[variant->item_first + i].at;
            at.z0 += house->form->level[cell->storey];
            at.z1 += house->form->level[cell->storey];
            *leave = *leave && !boxes_meet(&at, box);
        }
        tn_variants_clear(&v);
    }
    return status;
}

static tn_status fits(const tn_beaming *b, const tn_unborne *stretch, const tn_box *box, bool *fit, tn_error *error)
{
    const tn_house *house = b->house;
    *fit = stretch->in_y ? box->y0 < box->y1 : box->x0 < box->x1;
    *fit = *fit && box->z0 - house->form->level[stretch->storey - 1] >= house->form->record->guard;
    for (size_t i = 0; *fit && i < house->face_count; i++)
        *fit = face_leaves_room(house, &house->faces[i], stretch, box);
    *fit = *fit && flights_leave_room(b, stretch, box);
    for (size_t i = 0; *fit && i < b->bearing->count; i++) /* lines of walls may cross */
        *fit = b->bearing->items[i].beam == TN_NO_RECORD || !boxes_meet(&b->bearing->items[i].at, box);
    return *fit ? items_leave_room(house, stretch, box, fit, error) : TN_OK;
}

/* The first that spans the stretch and has room. */
static tn_status find_beam(const tn_beaming *b, tn_unborne *stretch, tn_error *error)
{
    const tn_house_form *form = b->house->form;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && stretch->beam == TN_NO_RECORD && i < form->record->beam_count; i++) {
        const tn_beam_record *beam = tn_form_beam(form, i);
        tn_box box = box_of(b, stretch, beam);
        bool fit = false;
        if (beam->span < stretch->to - stretch->from)
            continue;
        status = fits(b, stretch, &box, &fit, error);
        if (status == TN_OK && fit) {
            stretch->beam = i;
            stretch->at = box;
        }
    }
    return status;
}

tn_status tn_house_bearing(const tn_house *house, const tn_flights *flights, tn_bearing *bearing, tn_error *error)
{
    tn_beaming b = {.house = house, .flights = flights, .bearing = bearing};
    *bearing = (tn_bearing){0};
    tn_status status = find_stretches(house, bearing, error);
    for (uint32_t k = 1; status == TN_OK && house->form->record->beam_count > 0 && k < house->form->record->storey_count;
         k++) {
        status = tn_house_posts(house, k - 1, NULL, &b.posts, error);
        for (size_t i = 0; status == TN_OK && i < bearing->count; i++)
            if (bearing->items[i].storey == k && bearing->items[i].held)
                status = find_beam(&b, &bearing->items[i], error);
        free(b.posts.items);
    }
    return status;
}

/* ---- walls that hang */

bool tn_face_hangs(const tn_bearing *bearing, const tn_face *face, int64_t *from, int64_t *to, const tn_unborne **of)
{
    tn_wall_run run = run_of(face);
    *from = *to = run.from;
    for (size_t i = 0; face->relation != TN_FACE_UNDER && i < bearing->count; i++) {
        const tn_unborne *stretch = &bearing->items[i];
        int64_t low = stretch->from > run.from ? stretch->from : run.from,
                high = stretch->to < run.to ? stretch->to : run.to;
        if (stretch->beam != TN_NO_RECORD || stretch->storey != face->storey || stretch->in_y != run.in_y ||
            stretch->plane != run.plane || high - low <= *to - *from)
            continue;
        *from = low;
        *to = high;
        if (of)
            *of = stretch;
    }
    return *to > *from;
}
