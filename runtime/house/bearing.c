/* Which walls stand on nothing that bears them: an outside or party wall above a partition, an open face or no wall. */
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

/* What a wall of the storey below bears of the one above, from a place on: *reaches is moved to where it bears all up
 * to there; *next back to the next place that it bears. */
static void look_below(const tn_house *house, const tn_face *below, const tn_wall_run *above, int64_t thick, int64_t at,
                       int64_t *reaches, int64_t *next)
{
    tn_wall_run run = run_of(below);
    bool bears = tn_face_thickness(house, below) >= thick, posts = tn_face_is_open_side(house, below);
    if (run.in_y == above->in_y && run.plane == above->plane) {
        if (bears && run.from <= at && run.to > *reaches)
            *reaches = run.to;
        if ((bears || posts) && run.from > at && run.from < *next)
            *next = run.from;
        if (posts && run.to > at && run.to < *next)
            *next = run.to;
    } else if (run.in_y != above->in_y && run.from <= above->plane && run.to >= above->plane) {
        bool meets = bears || (posts && (run.from == above->plane || run.to == above->plane));
        if (meets && run.plane > at && run.plane < *next)
            *next = run.plane;
    }
}

bool tn_face_hangs(const tn_house *house, const tn_face *face, int64_t *from, int64_t *to)
{
    int64_t thick = tn_face_thickness(house, face);
    tn_wall_run above = run_of(face);
    *from = *to = above.from;
    if (face->storey == 0 || thick <= house->form->record->partition)
        return false;
    for (int64_t at = above.from; at < above.to;) {
        int64_t reaches = at, next = above.to;
        for (size_t i = 0; i < house->face_count; i++)
            if (house->faces[i].relation != TN_FACE_UNDER && house->faces[i].storey + 1 == face->storey)
                look_below(house, &house->faces[i], &above, thick, at, &reaches, &next);
        if (reaches == at && next - at > *to - *from) {
            *from = at;
            *to = next;
        }
        at = reaches > at ? reaches : next;
    }
    return *to > *from;
}
