/* Draws rules in the manner of the paper. */
#include "runtime/plan/picture/draw_rule.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"
#include "runtime/plan/picture/draw_rule_data.h"

#define MARGIN 22.0
#define PADDING 9.0
#define SIGN_ROOM 15.0 /* above the parts of a box */
#define NAME_SIZE 12.0
#define DOC_SIZE 7.5
#define TITLE_ROOM 32.0
#define BETWEEN_RULES 26.0
#define NEIGHBOUR_GAP 1.0
#define TAG_HEIGHT 24.0
#define DISTANCE_SIDE 13.0 /* beside the sections: the arrows */
#define GREY 0.45

/* ---- measuring: every part before its parent */

static tn_size beside(tn_size a, tn_size b, double gap)
{
    return (tn_size){a.width + b.width + (a.width > 0 ? gap : 0), fmax(a.height, b.height)};
}

static tn_size above(tn_size a, tn_size b, double gap)
{
    return (tn_size){fmax(a.width, b.width), a.height + b.height + (a.height > 0 ? gap : 0)};
}

static tn_size measure_inside(const tn_rule_picture *p, const tn_rule_box *box)
{
    tn_size all = {0};
    for (uint32_t inner = box->first; inner != TN_NO_BOX; inner = tn_rule_box_at(p, inner)->next) {
        if (box->kind == TN_BOX_NEIGHBOUR)
            all = beside(all, p->sizes[inner], NEIGHBOUR_GAP);
        else if (box->kind == TN_BOX_STACK)
            all = above(all, p->sizes[inner], 2 * PADDING);
        else
            all = beside(all, p->sizes[inner], 2 * PADDING);
    }
    if (box->kind == TN_BOX_NEIGHBOUR) {
        all.width += (box->beginning + box->end) * TN_RULE_END_WIDTH;
        all.height = fmax(all.height, TAG_HEIGHT);
    }
    if (box->kind == TN_BOX_SYMMETRIC)
        all.height = 2 * all.height + 2 * PADDING;
    return all;
}

static double words_width(const tn_rule_picture *p, const tn_rule_box *box)
{
    tn_paint_face(p->paint, TN_RULE_SIGN_SIZE, true);
    return box->words ? tn_type_width(p->paint, box->words) : 0;
}

static void measure_box(tn_rule_picture *p, uint32_t number)
{
    const tn_rule_box *box = tn_rule_box_at(p, number);
    tn_size *made = &p->sizes[number];
    if (box->kind == TN_BOX_TRAY)
        tn_draw_spec_measure(p->paint, &p->roles, box->spec, &made->width, &made->height);
    else if (box->kind == TN_BOX_LABEL)
        tn_draw_label_measure(p->paint, &p->roles, box->words, &made->width, &made->height);
    else if (box->kind == TN_BOX_TAG)
        *made = (tn_size){words_width(p, box) + 20, TAG_HEIGHT};
    else
        *made = measure_inside(p, box);
    if (box->framed || box->separator)
        made->width = fmax(made->width, words_width(p, box));
    if (box->framed) {
        made->width += 2 * PADDING;
        made->height += 2 * PADDING + SIGN_ROOM;
    }
    if (box->kind == TN_BOX_DISTANCE)
        made->width += 2 * DISTANCE_SIDE;
    if (box->optional) {
        made->width += PADDING;
        made->height += SIGN_ROOM;
    }
}

static void measure(tn_rule_picture *p)
{
    for (uint32_t box = p->rule.boxes->count; box-- > 0;)
        measure_box(p, box);
}

/* ---- drawing */

static void draw_box(const tn_rule_picture *p, uint32_t number, double x, double y, bool mirrored);

/* The wall at an end of the plan, which is a part of its own where somebody edits it. */
static void draw_end(const tn_rule_picture *p, size_t number, double x, double y, double height, bool left)
{
    if (number != TN_NO_BOX_NUMBER) {
        tn_paint_group_begin(p->paint, TN_PAINT_PART, number);
        tn_paint_target(p->paint, x, y, TN_RULE_END_WIDTH, height);
    }
    tn_draw_plan_end(p->paint, x, y, height, left);
    if (number != TN_NO_BOX_NUMBER)
        tn_paint_group_end(p->paint);
}

/* The parts from left to right; mirrored, from right to left. Trays stand on one line. */
static void draw_neighbour(const tn_rule_picture *p, const tn_rule_box *box, double x, double y, tn_size room,
                           bool mirrored)
{
    bool left = mirrored ? box->end : box->beginning, right = mirrored ? box->beginning : box->end;
    double from = x + (left ? TN_RULE_END_WIDTH : 0), to = x + room.width - (right ? TN_RULE_END_WIDTH : 0);
    if (left)
        draw_end(p, mirrored ? box->end_number : box->beginning_number, x, y, room.height, true);
    if (right)
        draw_end(p, mirrored ? box->beginning_number : box->end_number, to, y, room.height, false);
    for (uint32_t inner = box->first; inner != TN_NO_BOX; inner = tn_rule_box_at(p, inner)->next) {
        tn_size one = p->sizes[inner];
        double down = y + (room.height - one.height) / 2;
        if (mirrored)
            to -= one.width;
        draw_box(p, inner, mirrored ? to : from, down, mirrored);
        from += one.width + NEIGHBOUR_GAP;
        to -= NEIGHBOUR_GAP;
    }
}

/* Boxes side by side or one above the other, and one alone in the middle; dashed lines between. */
static void draw_several(const tn_rule_picture *p, const tn_rule_box *box, double x, double y, tn_size room,
                         bool mirrored)
{
    bool down = box->kind == TN_BOX_STACK;
    double at = down ? y : x;
    if (box->alone && box->first != TN_NO_BOX)
        at = x + (room.width - p->sizes[box->first].width) / 2;
    for (uint32_t inner = box->first; inner != TN_NO_BOX; inner = tn_rule_box_at(p, inner)->next) {
        tn_size one = p->sizes[inner];
        if (inner != box->first && down)
            tn_draw_rule_dashes(p->paint, x - PADDING, at - PADDING, x + room.width + PADDING, at - PADDING);
        else if (inner != box->first)
            tn_draw_rule_dashes(p->paint, at - PADDING, y - SIGN_ROOM / 2, at - PADDING, y + room.height + PADDING);
        if (down)
            draw_box(p, inner, x + (room.width - one.width) / 2, at, mirrored);
        else
            draw_box(p, inner, at, y + (room.height - one.height) / 2, mirrored);
        at += (down ? one.height : one.width) + 2 * PADDING;
    }
}

/* The upper half as it is written, the lower, in grey, as it follows from it. */
static void draw_symmetric(const tn_rule_picture *p, const tn_rule_box *box, double x, double y, tn_size room,
                           bool mirrored)
{
    tn_size one = p->sizes[box->first];
    double left = x + (room.width - one.width) / 2, middle = y + room.height / 2;
    draw_box(p, box->first, left, y, mirrored);
    tn_draw_rule_dashes(p->paint, x - PADDING, middle, x + room.width + PADDING, middle);
    draw_box(p, box->first, left, middle + PADDING, !mirrored);
    tn_type_veil(p->paint, x - PADDING + 1, middle + 1, room.width + 2 * PADDING - 2, y + room.height - middle,
                 1 - GREY);
}

static void draw_sign(const tn_rule_picture *p, uint32_t number, double x, double y)
{
    const tn_rule_box *box = tn_rule_box_at(p, number);
    if (box->kind == TN_BOX_NEIGHBOUR)
        tn_draw_neighbour_sign(p->paint, x + 6, y + 5);
    if (box->kind == TN_BOX_SYMMETRIC)
        tn_draw_symmetric_sign(p->paint, x + 7, y + 4);
    tn_paint_face(p->paint, TN_RULE_SIGN_SIZE, true);
    tn_type_line(p->paint, box->centred ? x + p->sizes[number].width / 2 : x + 6, y + 12,
                 box->centred ? TN_ALIGN_CENTRE : TN_ALIGN_LEFT, box->words ? box->words : "");
}

/* Three sections: the source under its check mark, the separator, the destination; arrows out of the source's side of
 * the box and into the destination's, since what separates them may lie on either side (Fig. 8d). */
static void draw_distance(const tn_rule_picture *p, const tn_rule_box *box, double x, double y, tn_size room,
                          bool mirrored)
{
    uint32_t source = box->first, destination = tn_rule_box_at(p, source)->next,
             separator = tn_rule_box_at(p, destination)->next;
    const uint32_t order[3] = {source, separator, destination};
    double at = x, top = y - SIGN_ROOM - PADDING, middle = y + room.height / 2;
    tn_draw_check_mark(p->paint, x + p->sizes[source].width / 2, y - SIGN_ROOM + 1);
    for (int i = 0; i < 3; i++) {
        tn_size one = p->sizes[order[i]];
        if (i > 0)
            tn_draw_rule_dashes(p->paint, at - PADDING, top, at - PADDING, y + room.height + PADDING);
        if (tn_rule_box_at(p, order[i])->separator)
            draw_sign(p, order[i], at, y - SIGN_ROOM - 3);
        draw_box(p, order[i], at, y + (room.height - one.height) / 2, mirrored);
        at += one.width + 2 * PADDING;
    }
    double left = x - PADDING - DISTANCE_SIDE, right = x + room.width + PADDING + DISTANCE_SIDE;
    tn_draw_rule_arrow(p->paint, left + DISTANCE_SIDE, left, middle);
    tn_draw_rule_arrow(p->paint, right, right - DISTANCE_SIDE, middle);
}

static void draw_inside(const tn_rule_picture *p, const tn_rule_box *box, double x, double y, tn_size room,
                        bool mirrored)
{
    switch (box->kind) {
    case TN_BOX_TRAY:
        tn_draw_spec(p->paint, &p->roles, box->spec, x, y, (tn_spec_look){mirrored, p->rule.signs && !mirrored});
        break;
    case TN_BOX_LABEL:
        tn_draw_label(p->paint, &p->roles, box->words, x, y);
        break;
    case TN_BOX_TAG:
        tn_draw_tag(p->paint, box->words ? box->words : "", x, y, room);
        break;
    case TN_BOX_NEIGHBOUR:
        draw_neighbour(p, box, x, y, room, mirrored);
        break;
    case TN_BOX_SYMMETRIC:
        draw_symmetric(p, box, x, y, room, mirrored);
        break;
    case TN_BOX_DISTANCE:
        draw_distance(p, box, x, y, room, mirrored);
        break;
    case TN_BOX_ROW:
    case TN_BOX_STACK:
        draw_several(p, box, x, y, room, mirrored);
        break;
    }
}

/* What a box looks like where it may be left out, or has a frame. */
static void draw_framed(const tn_rule_picture *p, uint32_t number, double x, double y, bool mirrored)
{
    const tn_rule_box *box = tn_rule_box_at(p, number);
    tn_size s = p->sizes[number];
    if (box->optional) {
        tn_draw_optional(p->paint, x, y, s);
        x += PADDING / 2;
        y += SIGN_ROOM - 2;
        s.width -= PADDING;
        s.height -= SIGN_ROOM;
    }
    if (!box->framed) {
        draw_inside(p, box, x, y, s, mirrored);
        return;
    }
    tn_draw_rule_box(p->paint, x, y, s);
    draw_sign(p, number, x, y);
    double side = PADDING + (box->kind == TN_BOX_DISTANCE ? DISTANCE_SIDE : 0);
    draw_inside(p, box, x + side, y + PADDING + SIGN_ROOM,
                (tn_size){s.width - 2 * side, s.height - 2 * PADDING - SIGN_ROOM}, mirrored);
}

static void draw_box(const tn_rule_picture *p, uint32_t number, double x, double y, bool mirrored)
{
    size_t part = tn_rule_box_at(p, number)->number;
    if (part != TN_NO_BOX_NUMBER) {
        tn_paint_group_begin(p->paint, TN_PAINT_PART, part);
        tn_paint_target(p->paint, x, y, p->sizes[number].width, p->sizes[number].height);
    }
    draw_framed(p, number, x, y, mirrored);
    if (part != TN_NO_BOX_NUMBER)
        tn_paint_group_end(p->paint);
}

/* ---- a rule, a tn_rule_picture */

static double title_room(const tn_rule_picture *p)
{
    return *p->rule.name ? TITLE_ROOM : 0;
}

static double title_width(const tn_rule_picture *p)
{
    tn_paint_face(p->paint, NAME_SIZE, true);
    double name = tn_type_width(p->paint, p->rule.name);
    tn_paint_face(p->paint, DOC_SIZE, false);
    return fmax(name, tn_type_width(p->paint, p->rule.doc));
}

static void draw_rule(const tn_rule_picture *p, double x, double y)
{
    tn_paint_face(p->paint, NAME_SIZE, true);
    tn_type_line(p->paint, x, y + 10, TN_ALIGN_LEFT, p->rule.name);
    tn_paint_face(p->paint, DOC_SIZE, false);
    tn_type_line(p->paint, x, y + 21, TN_ALIGN_LEFT, p->rule.doc);
    draw_box(p, 0, x, y + title_room(p), false);
}

static tn_status picture_make(tn_rule_picture *p, const tn_schema *schema, const tn_drawn_boxes *rule, tn_paint *paint,
                              tn_error *error)
{
    *p = (tn_rule_picture){.paint = paint, .rule = *rule};
    tn_draw_roles_find(schema, &p->roles);
    p->sizes = calloc((size_t)rule->boxes->count + 1, sizeof *p->sizes);
    if (!p->sizes)
        return tn_fail_memory(error);
    measure(p);
    return TN_OK;
}

static tn_status draw_pictures(tn_rule_picture *pictures, size_t count, tn_size all, tn_picture *to, tn_error *error)
{
    tn_canvas *canvas = NULL;
    tn_status status = tn_canvas_begin(to, all.width, all.height, pictures[0].rule.name, &canvas, error);
    double y = MARGIN;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        pictures[i].paint = tn_canvas_paint(canvas);
        tn_paint_group_begin(pictures[i].paint, TN_PAINT_RULE, i);
        draw_rule(&pictures[i], MARGIN, y);
        tn_paint_group_end(pictures[i].paint);
        y += title_room(&pictures[i]) + pictures[i].sizes[0].height + BETWEEN_RULES;
    }
    if (status == TN_OK)
        status = tn_canvas_commit(canvas, error);
    tn_canvas_free(canvas);
    return status;
}

static tn_status check_size(tn_size all, tn_error *error)
{
    if (all.width <= TN_DRAW_RULE_SIDE_MAX && all.height <= TN_DRAW_RULE_SIDE_MAX)
        return TN_OK;
    tn_status status = tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE,
                               "the picture would be %.0f by %.0f points; the limit is %.0f a side", all.width,
                               all.height, TN_DRAW_RULE_SIDE_MAX);
    tn_error_help(error, "draw fewer rules at once, or give parts of the rule names of their own");
    return status;
}

static tn_status draw_all(const tn_schema *schema, const tn_drawn_boxes *rules, size_t count, tn_picture *to,
                          tn_error *error)
{
    tn_paint *paint = tn_paint_new(NULL);
    tn_rule_picture *pictures = calloc(count + 1, sizeof *pictures);
    tn_status status = paint && pictures ? TN_OK : tn_fail_memory(error);
    tn_size all = {0, 2 * MARGIN - BETWEEN_RULES};
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        status = picture_make(&pictures[i], schema, &rules[i], paint, error);
        if (status != TN_OK)
            continue;
        tn_size one = pictures[i].sizes[0];
        all.width = fmax(all.width, fmax(one.width, title_width(&pictures[i])) + 2 * MARGIN);
        all.height += title_room(&pictures[i]) + one.height + BETWEEN_RULES;
    }
    if (status == TN_OK)
        status = check_size(all, error);
    if (status == TN_OK)
        status = draw_pictures(pictures, count, all, to, error);
    for (size_t i = 0; pictures && i < count; i++)
        free(pictures[i].sizes);
    free(pictures);
    tn_paint_free(paint);
    return status;
}

tn_status tn_rule_boxes_draw(const tn_schema *schema, const tn_drawn_boxes *rule, tn_picture *to, tn_error *error)
{
    return draw_all(schema, rule, 1, to, error);
}

/* ---- rules of a module */

tn_drawn_rule tn_drawn_rule_of(const tn_module *module, uint32_t rule)
{
    const tn_rule_record *record = &module->RULE_records[rule];
    return (tn_drawn_rule){tn_text(module, record->name), tn_text(module, record->doc), record->whole};
}

tn_status tn_rules_draw(const tn_schema *schema, const tn_drawn_rule *rules, size_t count, tn_picture *to,
                        tn_error *error)
{
    tn_drawn_boxes *drawn = calloc(count + 1, sizeof *drawn);
    tn_rule_boxes *boxes = calloc(count + 1, sizeof *boxes);
    tn_status status = drawn && boxes ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        status = tn_rule_boxes_read(schema->module, rules[i].function, &boxes[i], error);
        drawn[i] = (tn_drawn_boxes){.name = rules[i].name, .doc = rules[i].doc, .boxes = &boxes[i]};
    }
    if (status == TN_OK)
        status = draw_all(schema, drawn, count, to, error);
    for (size_t i = 0; boxes && i < count; i++)
        tn_rule_boxes_clear(&boxes[i]);
    free(boxes);
    free(drawn);
    return status;
}
