/* What the parts of a box mean: its faces, each rounded once, and the plane that clips it. */
#include <math.h>
#include <string.h>

#include "compiler/solid/solid.h"
#include "runtime/geometry/union/cut_box.h"

static tn_diagnostic *report(tn_solid_check *check, tn_code code, tn_span span, const char *message)
{
    check->solid->wrong = true;
    return tn_report(check->diagnostics, code, span, "%s", message);
}

/* ---- faces */

static double *low(tn_box_record *box, int axis)
{
    return axis == 0 ? &box->low_x : axis == 1 ? &box->low_y : &box->low_z;
}

static double *high(tn_box_record *box, int axis)
{
    return axis == 0 ? &box->high_x : axis == 1 ? &box->high_y : &box->high_z;
}

/* The faces of a box, low and high ones. */
typedef struct faces {
    tn_solid_place low[3], high[3];
} faces;

static void check_order(tn_solid_check *check, const faces *of, const tn_solid_part *part, int axis)
{
    static const char names[] = "xyz";
    double from = of->low[axis].written, to = of->high[axis].written;
    if (from > to) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_SOLID_RANGE, part->span,
                                     "in %c, this box goes from %.15g down to %.15g", names[axis], from, to);
        tn_note(check->diagnostics, d, &part->a.at[axis].span, "from here");
        tn_help(check->diagnostics, d, "swap the two: from %.15g to %.15g", to, from);
        check->solid->wrong = true;
    } else if (from == to) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_SOLID_SIZE, part->span, "in %c, this box has no extent", names[axis]);
        tn_help(check->diagnostics, d, "`from` and `to` are opposite corners: they differ in x, y and z");
        check->solid->wrong = true;
    }
}

static void faces_of_corners(tn_solid_check *check, faces *of, const tn_solid_part *part)
{
    bool flat = check->solid->flags & TN_SOLID_FLAT;
    for (int axis = 0; axis < (flat ? 2 : 3); axis++) {
        tn_solid_corner(check, &part->a.at[axis], &of->low[axis]);
        tn_solid_corner(check, &part->b.at[axis], &of->high[axis]);
        if (!check->solid->wrong)
            check_order(check, of, part, axis);
    }
}

static void check_size(tn_solid_check *check, const tn_solid_number *size, int axis)
{
    static const char names[] = "xyz";
    double value = tn_solid_value(check, size);
    if (value > 0 || check->solid->wrong)
        return;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_SOLID_SIZE, size->span,
                  value < 0 ? "in %c, this size is below 0" : "in %c, this box has no extent", names[axis]);
    tn_help(check->diagnostics, d, "sizes are above 0");
    check->solid->wrong = true;
}

static void faces_of_centre(tn_solid_check *check, faces *of, const tn_solid_part *at, const tn_solid_part *size)
{
    bool flat = check->solid->flags & TN_SOLID_FLAT;
    for (int axis = 0; axis < (flat ? 2 : 3); axis++) {
        check_size(check, &size->a.at[axis], axis);
        if (!tn_solid_face(check, &at->a.at[axis], &size->a.at[axis], -1, &of->low[axis]) ||
            !tn_solid_face(check, &at->a.at[axis], &size->a.at[axis], 1, &of->high[axis]))
            return;
    }
}

static void make_flat(tn_solid_check *check, faces *of)
{
    if (!(check->solid->flags & TN_SOLID_FLAT) || !(check->solid->depth > 0)) /* what is wrong is reported */
        return;
    const tn_solid_number *depth = &check->solid->settings[TN_SOLID_SETS_FLAT]->number[0];
    tn_solid_face(check, NULL, depth, -1, &of->low[2]);
    tn_solid_face(check, NULL, depth, 1, &of->high[2]);
}

static void warn_of_move(tn_solid_check *check, const tn_solid_item *item, const tn_solid_place *face)
{
    const tn_face_unit *unit = &check->solid->unit;
    if (face->at == face->written)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, W_MOVED_BY_UNIT, item->span,
                                 "a face of this box moves by %.6g, from %.15g to %.15g",
                                 fabs(face->at - face->written), face->written, face->at);
    tn_help(check->diagnostics, d, "the unit of this design is %.15g: write %.15g, or leave `unit` out",
            (double)unit->top / (double)unit->bottom, face->at);
}

/* The faces are those of the grid, if the design has one. */
static void take_faces(tn_solid_check *check, const tn_solid_item *item, const faces *of, tn_box_record *box)
{
    for (int axis = 0; axis < 3; axis++) {
        *low(box, axis) = of->low[axis].at;
        *high(box, axis) = of->high[axis].at;
        if (check->solid->wrong)
            continue;
        warn_of_move(check, item, &of->low[axis]);
        warn_of_move(check, item, &of->high[axis]);
    }
}

/* ---- the plane */

static void plane_through(tn_solid_check *check, tn_box_record *box, const tn_solid_part *part)
{
    double n[3], p[3], length = 0, d = 0;
    for (int axis = 0; axis < 3; axis++) {
        n[axis] = tn_solid_value(check, &part->a.at[axis]);
        p[axis] = tn_solid_value(check, &part->b.at[axis]);
        length += n[axis] * n[axis];
    }
    if (check->solid->wrong)
        return;
    length = sqrt(length);
    if (!(length > 0)) {
        tn_diagnostic *e = report(check, E_SOLID_NORMAL, part->a.span, "this normal has no direction");
        tn_help(check->diagnostics, e, "a normal points out of what is kept: `normal (1, 0, 0)` cuts off the far x");
        return;
    }
    if ((check->solid->flags & TN_SOLID_FLAT) && n[2] != 0) {
        tn_diagnostic *e = report(check, E_SOLID_FLAT, part->a.span, "this normal leans out of the flat design");
        tn_help(check->diagnostics, e, "its third number is 0 where the design is `flat`");
        return;
    }
    for (int axis = 0; axis < 3; axis++)
        d += n[axis] / length * (p[axis] - (*low(box, axis) + *high(box, axis)) / 2);
    box->normal_x = n[0] / length;
    box->normal_y = n[1] / length;
    box->normal_z = n[2] / length;
    box->planedist = d;
}

static void plane_of_angles(tn_box_record *box, double planedist, double a, double b)
{
    double normal[3];
    tn_normal_of_angles(a, b, normal);
    box->normal_x = normal[0];
    box->normal_y = normal[1];
    box->normal_z = normal[2];
    box->planedist = planedist;
}

static void check_plane(tn_solid_check *check, tn_box_record *box, const tn_solid_part *part)
{
    box->flags |= TN_BOX_CLIPPED;
    if (part->kind == TN_SOLID_CLIP_NORMAL) {
        plane_through(check, box, part);
        return;
    }
    const tn_solid_number *raw = part->a.at;
    double angle = tn_solid_value(check, &raw[1]);
    if ((check->solid->flags & TN_SOLID_FLAT) && angle != 90 && angle != -90) {
        tn_diagnostic *e = report(check, E_SOLID_FLAT, raw[1].span, "this normal leans out of the flat design");
        tn_help(check->diagnostics, e, "the first angle is 90 where the design is `flat`");
        return;
    }
    plane_of_angles(box, tn_solid_value(check, &raw[0]), angle, tn_solid_value(check, &raw[2]));
}

/* ---- a box */

typedef struct parts {
    const tn_solid_part *of[TN_SOLID_PART_COUNT];
} parts;

static void twice(tn_solid_check *check, const tn_solid_part *part, const tn_solid_part *before)
{
    bool clips = part->kind == TN_SOLID_CLIP_NORMAL || part->kind == TN_SOLID_CLIP_ANGLES;
    tn_diagnostic *d = clips ? report(check, E_SOLID_CLIP, part->span, "this box is clipped twice")
                             : report(check, E_SOLID_TWICE, part->span, "this part of the box is given twice");
    tn_note(check->diagnostics, d, &before->span, "the first is here");
    tn_help(check->diagnostics, d, "%s",
            clips ? "a box has one plane: split it into two boxes that meet, and clip each" : "leave one of them out");
}

/* The parts are listed from the last on. */
static parts sort_parts(tn_solid_check *check, const tn_solid_item *item)
{
    parts found = {{NULL}};
    for (const tn_solid_part *part = item->parts; part; part = part->next) {
        tn_solid_part_kind other = part->kind == TN_SOLID_CLIP_NORMAL   ? TN_SOLID_CLIP_ANGLES
                                   : part->kind == TN_SOLID_CLIP_ANGLES ? TN_SOLID_CLIP_NORMAL
                                                                        : part->kind;
        const tn_solid_part *later = found.of[part->kind] ? found.of[part->kind] : found.of[other];
        if (later)
            twice(check, later, part);
        found.of[part->kind] = part;
        if (other != part->kind)
            found.of[other] = NULL;
    }
    return found;
}

static bool says_where(tn_solid_check *check, const tn_solid_item *item, const parts *p)
{
    const tn_solid_part *at = p->of[TN_SOLID_AT], *size = p->of[TN_SOLID_SIZE], *from = p->of[TN_SOLID_FROM];
    if (from && !at && !size)
        return true;
    if (at && size && !from)
        return true;
    tn_diagnostic *d;
    if (from)
        d = report(check, E_SOLID_BOX, (at ? at : size)->span, "this box has its corners already");
    else if (at || size)
        d = report(check, E_SOLID_BOX, item->span, at ? "this box has no size" : "this box has a size but no place");
    else
        d = report(check, E_SOLID_BOX, item->span, "this box does not say where it is");
    tn_help(check->diagnostics, d, "a box is `at (x, y, z) size (w, h, d)`, or `from (x, y, z) to (x, y, z)`");
    return false;
}

static void add(tn_solid_check *check, const tn_solid_item *item, tn_box_record record)
{
    tn_checked_box *box = TN_NEW(check->arena, tn_checked_box);
    if (!box)
        return;
    record.file = item->span.file;
    record.begin = item->span.begin;
    record.end = item->span.end;
    box->item = item;
    box->record = record;
    TN_CHAIN(check->solid, box);
}

void tn_check_box(tn_solid_check *check, const tn_solid_item *item)
{
    parts p = sort_parts(check, item);
    tn_box_record box = {.normal_x = 1};
    bool before = check->solid->wrong;
    check->solid->wrong = false;
    if (says_where(check, item, &p)) {
        faces of = {0};
        if (p.of[TN_SOLID_FROM])
            faces_of_corners(check, &of, p.of[TN_SOLID_FROM]);
        else
            faces_of_centre(check, &of, p.of[TN_SOLID_AT], p.of[TN_SOLID_SIZE]);
        make_flat(check, &of);
        take_faces(check, item, &of, &box);
        const tn_solid_part *clip =
            p.of[TN_SOLID_CLIP_NORMAL] ? p.of[TN_SOLID_CLIP_NORMAL] : p.of[TN_SOLID_CLIP_ANGLES];
        if (clip && !check->solid->wrong)
            check_plane(check, &box, clip);
        box.flags |= p.of[TN_SOLID_RIGID] ? TN_BOX_RIGID : 0;
        add(check, item, box);
    }
    check->solid->wrong |= before;
}

/* Nine genes are taken as they come: sizes without their signs, and in a flat design the plane upright. */
void tn_check_genes(tn_solid_check *check, const tn_solid_item *item)
{
    enum { GENES = 9 };
    const tn_solid_number *gene[GENES];
    size_t count = 0;
    for (const tn_solid_entry *entry = item->entries.first; entry; entry = entry->next, count++)
        if (count < GENES)
            gene[count] = &entry->number;
    if (count != GENES) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_SOLID_GENES, item->span, "this list has %zu numbers", count);
        tn_help(check->diagnostics, d,
                "genes are x, y, z, width, height, depth, the plane's distance from the centre, and its two angles");
        check->solid->wrong = true;
        return;
    }
    tn_box_record box = {.flags = TN_BOX_CLIPPED | (item->parts ? TN_BOX_RIGID : 0)};
    faces of = {0};
    for (int axis = 0; axis < 3; axis++) {
        int outward = gene[3 + axis]->negative ? -1 : 1;
        if (!tn_solid_face(check, gene[axis], gene[3 + axis], -outward, &of.low[axis]) ||
            !tn_solid_face(check, gene[axis], gene[3 + axis], outward, &of.high[axis]))
            return;
    }
    make_flat(check, &of);
    take_faces(check, item, &of, &box);
    double angle = check->solid->flags & TN_SOLID_FLAT ? 90 : tn_solid_value(check, gene[7]);
    plane_of_angles(&box, tn_solid_value(check, gene[6]), angle, tn_solid_value(check, gene[8]));
    add(check, item, box);
}
