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

/* Is the part drawn as a tag with its words? */
static bool is_named(const tn_rule_picture *p, uint32_t part)
{
    tn_part_kind kind = tn_rule_part(p, part)->kind;
    return kind == TN_PART_RULE || kind == TN_PART_COMPARISON || tn_rule_is_gap(p, part);
}

/* Is the part a distance's separator, whose condition stands on top of its section? */
static bool is_separator(const tn_rule_picture *p, uint32_t part)
{
    const tn_part *it = tn_rule_part(p, part);
    return it->parent != TN_NO_PART && tn_rule_part(p, it->parent)->kind == TN_PART_DISTANCE &&
           it->next == TN_NO_PART && !is_named(p, part);
}

/* A neighbour has a box of its own only where it is the whole rule ("the box and symbol are omitted", section 3.2). */
static bool is_boxed(const tn_rule_picture *p, uint32_t part)
{
    const tn_part *it = tn_rule_part(p, part);
    return it->kind != TN_PART_TRAY && !is_named(p, part) && !is_separator(p, part) &&
           (it->kind != TN_PART_NEIGHBOUR || it->parent == TN_NO_PART);
}

/* ---- measuring: every part before its parent */

static tn_size beside(tn_size a, tn_size b, double gap)
{
    return (tn_size){a.width + b.width + (a.width > 0 ? gap : 0), fmax(a.height, b.height)};
}

static tn_size above(tn_size a, tn_size b, double gap)
{
    return (tn_size){fmax(a.width, b.width), a.height + b.height + (a.height > 0 ? gap : 0)};
}

static tn_size measure_children(const tn_rule_picture *p, uint32_t part)
{
    const tn_part *it = tn_rule_part(p, part);
    tn_size all = {0};
    for (uint32_t child = it->first; child != TN_NO_PART; child = tn_rule_part(p, child)->next) {
        tn_size one = p->sizes[child];
        if (tn_part_unwritten(&p->parts, child))
            continue;
        if (it->kind == TN_PART_NEIGHBOUR)
            all = beside(all, one, NEIGHBOUR_GAP);
        else if (it->kind == TN_PART_OR)
            all = above(all, one, 2 * PADDING);
        else
            all = beside(all, one, 2 * PADDING);
    }
    if (it->kind == TN_PART_NEIGHBOUR) {
        all.width += (it->beginning + it->end) * TN_RULE_END_WIDTH;
        all.height = fmax(all.height, TAG_HEIGHT);
    }
    if (it->kind == TN_PART_SYMMETRIC)
        all.height = 2 * all.height + 2 * PADDING;
    return all;
}

static void measure_part(tn_rule_picture *p, uint32_t part)
{
    const tn_part *it = tn_rule_part(p, part);
    tn_size *made = &p->sizes[part];
    char text[TN_RULE_WORDS_MAX];
    if (it->kind == TN_PART_TRAY) {
        tn_draw_spec_measure(p->paint, &p->roles, it->spec, &made->width, &made->height);
    } else if (is_named(p, part)) {
        char name[TN_PART_TEXT_MAX];
        tn_part_text(&p->parts, part, name, sizeof name);
        tn_paint_face(p->paint, TN_RULE_SIGN_SIZE, true);
        *made = (tn_size){tn_type_width(p->paint, name) + 20, TAG_HEIGHT};
    } else {
        *made = measure_children(p, part);
    }
    tn_draw_rule_words(p, part, text);
    tn_paint_face(p->paint, TN_RULE_SIGN_SIZE, true);
    if (is_boxed(p, part) || is_separator(p, part))
        made->width = fmax(made->width, tn_type_width(p->paint, text));
    if (is_boxed(p, part)) {
        made->width += 2 * PADDING;
        made->height += 2 * PADDING + SIGN_ROOM;
    }
    if (it->kind == TN_PART_DISTANCE)
        made->width += 2 * DISTANCE_SIDE;
    if (it->optional) {
        made->width += PADDING;
        made->height += SIGN_ROOM;
    }
}

static void measure(tn_rule_picture *p)
{
    for (uint32_t part = p->parts.count; part-- > 0;)
        measure_part(p, part);
}

/* ---- drawing */

static void draw_part(const tn_rule_picture *p, uint32_t part, double x, double y, bool mirrored);

/* The parts from left to right; mirrored, from right to left. Trays stand on one line. */
static void draw_neighbour(const tn_rule_picture *p, uint32_t part, double x, double y, tn_size room, bool mirrored)
{
    const tn_part *it = tn_rule_part(p, part);
    bool left = mirrored ? it->end : it->beginning, right = mirrored ? it->beginning : it->end;
    double from = x + (left ? TN_RULE_END_WIDTH : 0), to = x + room.width - (right ? TN_RULE_END_WIDTH : 0);
    if (left)
        tn_draw_plan_end(p->paint, x, y, room.height, true);
    if (right)
        tn_draw_plan_end(p->paint, to, y, room.height, false);
    for (uint32_t child = it->first; child != TN_NO_PART; child = tn_rule_part(p, child)->next) {
        tn_size one = p->sizes[child];
        double down = y + (room.height - one.height) / 2;
        if (mirrored)
            to -= one.width;
        draw_part(p, child, mirrored ? to : from, down, mirrored);
        from += one.width + NEIGHBOUR_GAP;
        to -= NEIGHBOUR_GAP;
    }
}

/* The parts of an `and` or `or`, and those of one part alone, centred; dashed lines between. */
static void draw_parts(const tn_rule_picture *p, uint32_t part, double x, double y, tn_size room, bool mirrored)
{
    const tn_part *it = tn_rule_part(p, part);
    bool down = it->kind == TN_PART_OR;
    double at = down ? y : x;
    if (it->child_count == 1)
        at = x + (room.width - p->sizes[it->first].width) / 2;
    for (uint32_t child = it->first; child != TN_NO_PART; child = tn_rule_part(p, child)->next) {
        tn_size one = p->sizes[child];
        if (tn_part_unwritten(&p->parts, child))
            continue;
        if (child != it->first && down)
            tn_draw_rule_dashes(p->paint, x - PADDING, at - PADDING, x + room.width + PADDING, at - PADDING);
        else if (child != it->first)
            tn_draw_rule_dashes(p->paint, at - PADDING, y - SIGN_ROOM / 2, at - PADDING, y + room.height + PADDING);
        if (down)
            draw_part(p, child, x + (room.width - one.width) / 2, at, mirrored);
        else
            draw_part(p, child, at, y + (room.height - one.height) / 2, mirrored);
        at += (down ? one.height : one.width) + 2 * PADDING;
    }
}

/* The upper half as it is written, the lower, in grey, as it follows from it. */
static void draw_symmetric(const tn_rule_picture *p, uint32_t part, double x, double y, tn_size room, bool mirrored)
{
    uint32_t child = tn_rule_part(p, part)->first;
    tn_size one = p->sizes[child];
    double left = x + (room.width - one.width) / 2, middle = y + room.height / 2;
    draw_part(p, child, left, y, mirrored);
    tn_draw_rule_dashes(p->paint, x - PADDING, middle, x + room.width + PADDING, middle);
    draw_part(p, child, left, middle + PADDING, !mirrored);
    tn_type_veil(p->paint, x - PADDING + 1, middle + 1, room.width + 2 * PADDING - 2, y + room.height - middle,
                 1 - GREY);
}

static void draw_sign(const tn_rule_picture *p, uint32_t part, double x, double y)
{
    char text[TN_RULE_WORDS_MAX];
    tn_part_kind kind = tn_rule_part(p, part)->kind;
    if (kind == TN_PART_NEIGHBOUR)
        tn_draw_neighbour_sign(p->paint, x + 6, y + 5);
    if (kind == TN_PART_SYMMETRIC)
        tn_draw_symmetric_sign(p->paint, x + 7, y + 4);
    bool centred = kind == TN_PART_QUANTITY || kind == TN_PART_SUM || kind == TN_PART_OCCURRENCES;
    tn_draw_rule_words(p, part, text);
    tn_paint_face(p->paint, TN_RULE_SIGN_SIZE, true);
    tn_type_line(p->paint, centred ? x + p->sizes[part].width / 2 : x + 6, y + 12,
                 centred ? TN_ALIGN_CENTRE : TN_ALIGN_LEFT, text);
}

/* Three sections: the source under its check mark, the separator, the destination; arrows out of the source's side of
 * the box and into the destination's, since what separates them may lie on either side (Fig. 8d). */
static void draw_distance(const tn_rule_picture *p, uint32_t part, double x, double y, tn_size room, bool mirrored)
{
    uint32_t source = tn_rule_part(p, part)->first, destination = tn_rule_part(p, source)->next,
             separator = tn_rule_part(p, destination)->next;
    const uint32_t order[3] = {source, separator, destination};
    double at = x, top = y - SIGN_ROOM - PADDING, middle = y + room.height / 2;
    tn_draw_check_mark(p->paint, x + p->sizes[source].width / 2, y - SIGN_ROOM + 1);
    for (int i = 0; i < 3; i++) {
        tn_size one = p->sizes[order[i]];
        if (i > 0)
            tn_draw_rule_dashes(p->paint, at - PADDING, top, at - PADDING, y + room.height + PADDING);
        if (is_separator(p, order[i]))
            draw_sign(p, order[i], at, y - SIGN_ROOM - 3);
        draw_part(p, order[i], at, y + (room.height - one.height) / 2, mirrored);
        at += one.width + 2 * PADDING;
    }
    double left = x - PADDING - DISTANCE_SIDE, right = x + room.width + PADDING + DISTANCE_SIDE;
    tn_draw_rule_arrow(p->paint, left + DISTANCE_SIDE, left, middle);
    tn_draw_rule_arrow(p->paint, right, right - DISTANCE_SIDE, middle);
}

static void draw_name(const tn_rule_picture *p, uint32_t part, double x, double y, tn_size room)
{
    char name[TN_PART_TEXT_MAX];
    tn_part_text(&p->parts, part, name, sizeof name);
    tn_draw_tag(p->paint, name, x, y, room);
}

static void draw_inside(const tn_rule_picture *p, uint32_t part, double x, double y, tn_size room, bool mirrored)
{
    if (is_named(p, part)) {
        draw_name(p, part, x, y, room);
        return;
    }
    switch (tn_rule_part(p, part)->kind) {
    case TN_PART_TRAY:
        tn_draw_spec(p->paint, &p->roles, tn_rule_part(p, part)->spec, x, y, mirrored);
        break;
    case TN_PART_NEIGHBOUR:
        draw_neighbour(p, part, x, y, room, mirrored);
        break;
    case TN_PART_SYMMETRIC:
        draw_symmetric(p, part, x, y, room, mirrored);
        break;
    case TN_PART_DISTANCE:
        draw_distance(p, part, x, y, room, mirrored);
        break;
    default:
        draw_parts(p, part, x, y, room, mirrored);
        break;
    }
}

/* What a part looks like where it may be left out, or has a box. */
static void draw_framed(const tn_rule_picture *p, uint32_t part, double x, double y, bool mirrored)
{
    const tn_part *it = tn_rule_part(p, part);
    tn_size s = p->sizes[part];
    if (it->optional) {
        tn_draw_optional(p->paint, x, y, s);
        x += PADDING / 2;
        y += SIGN_ROOM - 2;
        s.width -= PADDING;
        s.height -= SIGN_ROOM;
    }
    if (!is_boxed(p, part)) {
        draw_inside(p, part, x, y, s, mirrored);
        return;
    }
    tn_draw_rule_box(p->paint, x, y, s);
    draw_sign(p, part, x, y);
    double side = PADDING + (it->kind == TN_PART_DISTANCE ? DISTANCE_SIDE : 0);
    draw_inside(p, part, x + side, y + PADDING + SIGN_ROOM,
                (tn_size){s.width - 2 * side, s.height - 2 * PADDING - SIGN_ROOM}, mirrored);
}

static void draw_part(const tn_rule_picture *p, uint32_t part, double x, double y, bool mirrored)
{
    tn_paint_group_begin(p->paint, TN_PAINT_PART, part);
    tn_paint_target(p->paint, x, y, p->sizes[part].width, p->sizes[part].height);
    draw_framed(p, part, x, y, mirrored);
    tn_paint_group_end(p->paint);
}

/* ---- a rule, a tn_rule_picture */

static double title_room(const tn_rule_picture *p)
{
    return *p->rule->name ? TITLE_ROOM : 0;
}

static double title_width(const tn_rule_picture *p)
{
    tn_paint_face(p->paint, NAME_SIZE, true);
    double name = tn_type_width(p->paint, p->rule->name);
    tn_paint_face(p->paint, DOC_SIZE, false);
    return fmax(name, tn_type_width(p->paint, p->rule->doc));
}

static void draw_rule(const tn_rule_picture *p, double x, double y)
{
    tn_paint_face(p->paint, NAME_SIZE, true);
    tn_type_line(p->paint, x, y + 10, TN_ALIGN_LEFT, p->rule->name);
    tn_paint_face(p->paint, DOC_SIZE, false);
    tn_type_line(p->paint, x, y + 21, TN_ALIGN_LEFT, p->rule->doc);
    draw_part(p, 0, x, y + title_room(p), false);
}

static tn_status picture_make(tn_rule_picture *p, const tn_schema *schema, const tn_drawn_rule *rule, tn_paint *paint,
                              tn_error *error)
{
    *p = (tn_rule_picture){.paint = paint, .schema = schema, .rule = rule};
    tn_draw_roles_find(schema, &p->roles);
    tn_status status = tn_parts_read(schema->module, rule->function, &p->parts, error);
    if (status != TN_OK)
        return status;
    p->sizes = calloc((size_t)p->parts.count + 1, sizeof *p->sizes);
    if (!p->sizes)
        return tn_fail_memory(error);
    measure(p);
    return TN_OK;
}

static tn_status draw_pictures(tn_rule_picture *pictures, size_t count, tn_size all, tn_picture *to, tn_error *error)
{
    tn_canvas *canvas = NULL;
    tn_status status = tn_canvas_begin(to, all.width, all.height, pictures[0].rule->name, &canvas, error);
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

tn_drawn_rule tn_drawn_rule_of(const tn_module *module, uint32_t rule)
{
    const tn_rule_record *record = &module->RULE_records[rule];
    return (tn_drawn_rule){tn_text(module, record->name), tn_text(module, record->doc), record->whole};
}

tn_status tn_rules_draw(const tn_schema *schema, const tn_drawn_rule *rules, size_t count, tn_picture *to,
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
    if (status == TN_OK && !(all.width <= TN_DRAW_RULE_SIDE_MAX && all.height <= TN_DRAW_RULE_SIDE_MAX)) {
        status = tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE,
                         "the picture would be %.0f by %.0f points; the limit is %.0f a side", all.width, all.height,
                         TN_DRAW_RULE_SIDE_MAX);
        tn_error_help(error, "draw fewer rules at once, or give parts of the rule names of their own");
    }
    if (status == TN_OK)
        status = draw_pictures(pictures, count, all, to, error);
    for (size_t i = 0; pictures && i < count; i++) {
        tn_parts_clear(&pictures[i].parts);
        free(pictures[i].sizes);
    }
    free(pictures);
    tn_paint_free(paint);
    return status;
}
