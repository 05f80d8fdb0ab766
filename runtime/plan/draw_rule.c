#include "runtime/plan/draw_rule.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"
#include "runtime/vm/condition_text.h"

#define MARGIN 22.0
#define PADDING 9.0
#define SIGN_ROOM 15.0 /* above the parts of a box */
#define SIGN_SIZE 8.0
#define NAME_SIZE 12.0
#define DOC_SIZE 7.5
#define TITLE_ROOM 32.0
#define BETWEEN_RULES 26.0
#define NEIGHBOUR_GAP 1.0
#define END_WIDTH 13.0 /* of the mark of the plan's beginning or end */
#define TAG_HEIGHT 24.0
#define DISTANCE_SIDE 13.0 /* beside the sections: the arrows */
#define GREY 0.45

typedef struct size {
    double width, height;
} size;

/* One rule being drawn. */
typedef struct picture {
    cairo_t *context;
    const tn_schema *schema;
    tn_draw_roles roles;
    tn_parts parts;
    size *sizes; /* [part] */
    uint32_t rule;
} picture;

static const tn_part *part_at(const picture *p, uint32_t part)
{
    return &p->parts.parts[part];
}

static const char *sign_of(tn_part_kind kind)
{
    switch (kind) {
    case TN_PART_AND:
        return "and";
    case TN_PART_OR:
        return "or";
    case TN_PART_NOT:
        return "not";
    case TN_PART_MANY:
        return "one or more, each:";
    default:
        return "";
    }
}

/* The condition as its author wrote it, after the last comma: "n >= 2" rather than "not n < 2". */
static void own_condition(const picture *p, uint32_t part, char condition[TN_CONDITION_TEXT_MAX])
{
    char text[TN_PART_TEXT_MAX];
    tn_part_text(&p->parts, part, text, sizeof text);
    const char *comma = strrchr(text, ',');
    size_t length = strlen(text);
    if (comma && text[length - 1] == ')' && length < sizeof text - 8)
        snprintf(condition, TN_CONDITION_TEXT_MAX, "%.*s", (int)(text + length - 1 - (comma + 2)), comma + 2);
}

/* Is the part a distance's separator, whose condition stands on top of its section? */
static bool is_separator(const picture *p, uint32_t part)
{
    const tn_part *it = part_at(p, part);
    return it->parent != TN_NO_PART && part_at(p, it->parent)->kind == TN_PART_DISTANCE && it->next == TN_NO_PART &&
           it->kind != TN_PART_RULE;
}

/* A neighbour has a box of its own only where it is the whole rule ("the box and symbol are omitted", section 3.2). */
static bool is_boxed(const picture *p, uint32_t part)
{
    const tn_part *it = part_at(p, part);
    return it->kind != TN_PART_TRAY && it->kind != TN_PART_RULE && !is_separator(p, part) &&
           (it->kind != TN_PART_NEIGHBOUR || it->parent == TN_NO_PART);
}

/* What stands on top of a box: the sign of its kind, or its condition. */
static void write_sign(const picture *p, uint32_t part, char text[TN_CONDITION_TEXT_MAX + 80])
{
    const tn_part *it = part_at(p, part);
    char condition[TN_CONDITION_TEXT_MAX];
    size_t room = TN_CONDITION_TEXT_MAX + 80;
    snprintf(text, room, "%s", sign_of(it->kind));
    if (it->kind != TN_PART_QUANTITY && it->kind != TN_PART_SUM && it->kind != TN_PART_OCCURRENCES)
        return;
    tn_condition_text(p->schema->module, it->condition, condition);
    own_condition(p, part, condition);
    if (it->kind == TN_PART_SUM)
        snprintf(text, room, "\xce\xa3 %.60s: %s",
                 tn_text(p->schema->module, p->schema->module->FIELD_records[it->field].name), condition);
    else
        snprintf(text, room, "%s%s", it->kind == TN_PART_OCCURRENCES ? "places: " : "", condition);
}

/* ---- measuring: every part before its parent */

static size beside(size a, size b, double gap)
{
    return (size){a.width + b.width + (a.width > 0 ? gap : 0), fmax(a.height, b.height)};
}

static size above(size a, size b, double gap)
{
    return (size){fmax(a.width, b.width), a.height + b.height + (a.height > 0 ? gap : 0)};
}

static size measure_children(const picture *p, uint32_t part)
{
    const tn_part *it = part_at(p, part);
    size all = {0};
    for (uint32_t child = it->first; child != TN_NO_PART; child = part_at(p, child)->next) {
        size one = p->sizes[child];
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
        all.width += (it->beginning + it->end) * END_WIDTH;
        all.height = fmax(all.height, TAG_HEIGHT);
    }
    if (it->kind == TN_PART_SYMMETRIC)
        all.height = 2 * all.height + 2 * PADDING;
    return all;
}

static void measure_part(picture *p, uint32_t part)
{
    const tn_part *it = part_at(p, part);
    size *made = &p->sizes[part];
    char text[TN_CONDITION_TEXT_MAX + 80];
    if (it->kind == TN_PART_TRAY) {
        tn_draw_spec_measure(p->context, &p->roles, it->spec, &made->width, &made->height);
    } else if (it->kind == TN_PART_RULE) {
        char name[TN_PART_TEXT_MAX];
        tn_part_text(&p->parts, part, name, sizeof name);
        tn_type_face(p->context, SIGN_SIZE, true);
        *made = (size){tn_type_width(p->context, name) + 20, TAG_HEIGHT};
    } else {
        *made = measure_children(p, part);
    }
    write_sign(p, part, text);
    tn_type_face(p->context, SIGN_SIZE, true);
    if (is_boxed(p, part) || is_separator(p, part))
        made->width = fmax(made->width, tn_type_width(p->context, text));
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

static void measure(picture *p)
{
    for (uint32_t part = p->parts.count; part-- > 0;)
        measure_part(p, part);
}

/* ---- drawing */

static void draw_part(const picture *p, uint32_t part, double x, double y, bool mirrored);

static void draw_box(const picture *p, double x, double y, size s)
{
    cairo_rectangle(p->context, x, y, s.width, s.height);
    cairo_set_line_width(p->context, 0.9);
    cairo_stroke(p->context);
}

static void dashed(const picture *p, double x1, double y1, double x2, double y2)
{
    static const double dashes[] = {4, 3};
    cairo_save(p->context);
    cairo_set_dash(p->context, dashes, 2, 0);
    cairo_move_to(p->context, x1, y1);
    cairo_line_to(p->context, x2, y2);
    cairo_set_line_width(p->context, 0.6);
    cairo_stroke(p->context);
    cairo_restore(p->context);
}

/* A head at (x, y) that points to the left or right. */
static void arrow_head(const picture *p, double x, double y, double direction)
{
    cairo_move_to(p->context, x, y);
    cairo_line_to(p->context, x - direction * 5, y - 2.6);
    cairo_line_to(p->context, x - direction * 5, y + 2.6);
    cairo_close_path(p->context);
    cairo_fill(p->context);
}

static void draw_arrow(const picture *p, double from, double to, double y)
{
    cairo_move_to(p->context, from, y);
    cairo_line_to(p->context, to, y);
    cairo_set_line_width(p->context, 0.8);
    cairo_stroke(p->context);
    arrow_head(p, to, y, to > from ? 1 : -1);
}

/* Two trays side by side: the sign of a neighbour. */
static void neighbour_sign(const picture *p, double x, double y)
{
    cairo_rectangle(p->context, x, y, 5, 7.5);
    cairo_rectangle(p->context, x + 5, y, 5, 7.5);
    cairo_set_line_width(p->context, 0.9);
    cairo_stroke(p->context);
}

/* `or` under an arrow both ways: a row or its mirror image. */
static void symmetric_sign(const picture *p, double x, double y)
{
    tn_type_face(p->context, SIGN_SIZE, true);
    tn_type_line(p->context, x + 2, y + 9.5, TN_ALIGN_LEFT, "or");
    draw_arrow(p, x + 7, x + 15, y);
    draw_arrow(p, x + 7, x - 1, y);
}

/* The plan's outer wall, with the side beyond it struck out. */
static void draw_end(const picture *p, double x, double y, double height, bool left)
{
    double wall = left ? x + END_WIDTH - 2 : x + 2, out = left ? -5 : 5;
    cairo_move_to(p->context, wall, y);
    cairo_line_to(p->context, wall, y + height);
    cairo_set_line_width(p->context, 2.2);
    cairo_stroke(p->context);
    for (double at = y + 3; at < y + height - 1; at += 5) {
        cairo_move_to(p->context, wall, at);
        cairo_line_to(p->context, wall + out, at + 4);
    }
    cairo_set_line_width(p->context, 0.5);
    cairo_stroke(p->context);
}

/* The parts from left to right; mirrored, from right to left. Trays stand on one line. */
static void draw_neighbour(const picture *p, uint32_t part, double x, double y, size room, bool mirrored)
{
    const tn_part *it = part_at(p, part);
    bool left = mirrored ? it->end : it->beginning, right = mirrored ? it->beginning : it->end;
    double from = x + (left ? END_WIDTH : 0), to = x + room.width - (right ? END_WIDTH : 0);
    if (left)
        draw_end(p, x, y, room.height, true);
    if (right)
        draw_end(p, to, y, room.height, false);
    for (uint32_t child = it->first; child != TN_NO_PART; child = part_at(p, child)->next) {
        size one = p->sizes[child];
        double down = y + (room.height - one.height) / 2;
        if (mirrored)
            to -= one.width;
        draw_part(p, child, mirrored ? to : from, down, mirrored);
        from += one.width + NEIGHBOUR_GAP;
        to -= NEIGHBOUR_GAP;
    }
}

/* The parts of an `and` or `or`, and those of one part alone, centred; dashed lines between. */
static void draw_parts(const picture *p, uint32_t part, double x, double y, size room, bool mirrored)
{
    const tn_part *it = part_at(p, part);
    bool down = it->kind == TN_PART_OR;
    double at = down ? y : x;
    if (it->child_count == 1)
        at = x + (room.width - p->sizes[it->first].width) / 2;
    for (uint32_t child = it->first; child != TN_NO_PART; child = part_at(p, child)->next) {
        size one = p->sizes[child];
        if (tn_part_unwritten(&p->parts, child))
            continue;
        if (child != it->first && down)
            dashed(p, x - PADDING, at - PADDING, x + room.width + PADDING, at - PADDING);
        else if (child != it->first)
            dashed(p, at - PADDING, y - SIGN_ROOM / 2, at - PADDING, y + room.height + PADDING);
        if (down)
            draw_part(p, child, x + (room.width - one.width) / 2, at, mirrored);
        else
            draw_part(p, child, at, y + (room.height - one.height) / 2, mirrored);
        at += (down ? one.height : one.width) + 2 * PADDING;
    }
}

/* The upper half as it is written, the lower, in grey, as it follows from it. */
static void draw_symmetric(const picture *p, uint32_t part, double x, double y, size room, bool mirrored)
{
    uint32_t child = part_at(p, part)->first;
    size one = p->sizes[child];
    double left = x + (room.width - one.width) / 2, middle = y + room.height / 2;
    draw_part(p, child, left, y, mirrored);
    dashed(p, x - PADDING, middle, x + room.width + PADDING, middle);
    draw_part(p, child, left, middle + PADDING, !mirrored);
    cairo_rectangle(p->context, x - 1, middle + 1, room.width + 2, y + room.height - middle);
    cairo_set_source_rgba(p->context, 1, 1, 1, 1 - GREY); /* a veil */
    cairo_fill(p->context);
    cairo_set_source_rgb(p->context, 0, 0, 0);
}

static void check_mark(const picture *p, double x, double y)
{
    cairo_move_to(p->context, x - 4, y + 3);
    cairo_line_to(p->context, x - 1, y + 6.5);
    cairo_line_to(p->context, x + 5, y - 1);
    cairo_set_line_width(p->context, 1.4);
    cairo_stroke(p->context);
}

static void draw_sign(const picture *p, uint32_t part, double x, double y)
{
    char text[TN_CONDITION_TEXT_MAX + 80];
    tn_part_kind kind = part_at(p, part)->kind;
    if (kind == TN_PART_NEIGHBOUR)
        neighbour_sign(p, x + 6, y + 5);
    if (kind == TN_PART_SYMMETRIC)
        symmetric_sign(p, x + 7, y + 4);
    bool centred = kind == TN_PART_QUANTITY || kind == TN_PART_SUM || kind == TN_PART_OCCURRENCES;
    write_sign(p, part, text);
    tn_type_face(p->context, SIGN_SIZE, true);
    tn_type_line(p->context, centred ? x + p->sizes[part].width / 2 : x + 6, y + 12,
                 centred ? TN_ALIGN_CENTRE : TN_ALIGN_LEFT, text);
}

/* Three sections: the source under its check mark, the separator, the destination; arrows out of the source's side of
 * the box and into the destination's, since what separates them may lie on either side (Fig. 8d). */
static void draw_distance(const picture *p, uint32_t part, double x, double y, size room, bool mirrored)
{
    uint32_t source = part_at(p, part)->first, destination = part_at(p, source)->next,
             separator = part_at(p, destination)->next;
    const uint32_t order[3] = {source, separator, destination};
    double at = x, top = y - SIGN_ROOM - PADDING, middle = y + room.height / 2;
    check_mark(p, x + p->sizes[source].width / 2, y - SIGN_ROOM + 1);
    for (int i = 0; i < 3; i++) {
        size one = p->sizes[order[i]];
        if (i > 0)
            dashed(p, at - PADDING, top, at - PADDING, y + room.height + PADDING);
        if (is_separator(p, order[i]))
            draw_sign(p, order[i], at, y - SIGN_ROOM - 3);
        draw_part(p, order[i], at, y + (room.height - one.height) / 2, mirrored);
        at += one.width + 2 * PADDING;
    }
    double left = x - PADDING - DISTANCE_SIDE, right = x + room.width + PADDING + DISTANCE_SIDE;
    draw_arrow(p, left + DISTANCE_SIDE, left, middle);
    draw_arrow(p, right, right - DISTANCE_SIDE, middle);
}

static void draw_tag(const picture *p, uint32_t part, double x, double y, size s)
{
    char name[TN_PART_TEXT_MAX];
    double r = 6;
    tn_part_text(&p->parts, part, name, sizeof name);
    cairo_new_sub_path(p->context);
    cairo_arc(p->context, x + s.width - 2 - r, y + 2 + r, r, -1.5707963, 0);
    cairo_arc(p->context, x + s.width - 2 - r, y + s.height - 2 - r, r, 0, 1.5707963);
    cairo_arc(p->context, x + 2 + r, y + s.height - 2 - r, r, 1.5707963, 3.1415927);
    cairo_arc(p->context, x + 2 + r, y + 2 + r, r, 3.1415927, 4.712389);
    cairo_close_path(p->context);
    cairo_set_line_width(p->context, 0.9);
    cairo_stroke(p->context);
    tn_type_face(p->context, SIGN_SIZE, true);
    tn_type_line(p->context, x + s.width / 2, y + s.height / 2 + 3, TN_ALIGN_CENTRE, name);
}

/* Brackets, and that it may be left out. */
static void draw_optional(const picture *p, double x, double y, size s)
{
    static const double dashes[] = {2, 2};
    cairo_save(p->context);
    cairo_set_dash(p->context, dashes, 2, 0);
    cairo_rectangle(p->context, x + 1, y + 1, s.width - 2, s.height - 2);
    cairo_set_line_width(p->context, 0.8);
    cairo_stroke(p->context);
    cairo_restore(p->context);
    tn_type_face(p->context, SIGN_SIZE - 1.5, false);
    tn_type_line(p->context, x + s.width / 2, y + 9, TN_ALIGN_CENTRE, "or none");
}

static void draw_inside(const picture *p, uint32_t part, double x, double y, size room, bool mirrored)
{
    switch (part_at(p, part)->kind) {
    case TN_PART_TRAY:
        tn_draw_spec(p->context, &p->roles, part_at(p, part)->spec, x, y, mirrored);
        break;
    case TN_PART_RULE:
        draw_tag(p, part, x, y, room);
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

static void draw_part(const picture *p, uint32_t part, double x, double y, bool mirrored)
{
    const tn_part *it = part_at(p, part);
    size s = p->sizes[part];
    if (it->optional) {
        draw_optional(p, x, y, s);
        x += PADDING / 2;
        y += SIGN_ROOM - 2;
        s.width -= PADDING;
        s.height -= SIGN_ROOM;
    }
    if (!is_boxed(p, part)) {
        draw_inside(p, part, x, y, s, mirrored);
        return;
    }
    draw_box(p, x, y, s);
    draw_sign(p, part, x, y);
    double side = PADDING + (it->kind == TN_PART_DISTANCE ? DISTANCE_SIDE : 0);
    draw_inside(p, part, x + side, y + PADDING + SIGN_ROOM,
                (size){s.width - 2 * side, s.height - 2 * PADDING - SIGN_ROOM}, mirrored);
}

/* ---- a rule, a picture */

static double title_width(const picture *p)
{
    const tn_rule_record *rule = &p->schema->module->RULE_records[p->rule];
    tn_type_face(p->context, NAME_SIZE, true);
    double name = tn_type_width(p->context, tn_text(p->schema->module, rule->name));
    tn_type_face(p->context, DOC_SIZE, false);
    return fmax(name, tn_type_width(p->context, tn_text(p->schema->module, rule->doc)));
}

static void draw_rule(const picture *p, double x, double y)
{
    const tn_rule_record *rule = &p->schema->module->RULE_records[p->rule];
    tn_type_face(p->context, NAME_SIZE, true);
    tn_type_line(p->context, x, y + 10, TN_ALIGN_LEFT, tn_text(p->schema->module, rule->name));
    tn_type_face(p->context, DOC_SIZE, false);
    tn_type_line(p->context, x, y + 21, TN_ALIGN_LEFT, tn_text(p->schema->module, rule->doc));
    draw_part(p, 0, x, y + TITLE_ROOM, false);
}

static tn_status picture_make(picture *p, const tn_schema *schema, uint32_t rule, cairo_t *context, tn_error *error)
{
    *p = (picture){.context = context, .schema = schema, .rule = rule};
    tn_draw_roles_find(schema, &p->roles);
    tn_status status = tn_parts_read(schema->module, schema->module->RULE_records[rule].whole, &p->parts, error);
    if (status != TN_OK)
        return status;
    p->sizes = calloc((size_t)p->parts.count + 1, sizeof *p->sizes);
    if (!p->sizes)
        return tn_fail_memory(error);
    measure(p);
    return TN_OK;
}

static tn_status draw_pictures(picture *pictures, size_t count, size all, const char *path, uint32_t dpi,
                               tn_error *error)
{
    tn_canvas_format format;
    tn_canvas *canvas = NULL;
    const tn_module *module = pictures[0].schema->module;
    tn_canvas_options options = {all.width, all.height, dpi,
                                 tn_text(module, module->RULE_records[pictures[0].rule].name)};
    tn_status status = tn_canvas_format_of(path, &format, error);
    if (status == TN_OK)
        status = tn_canvas_new(path, format, &options, &canvas, error);
    double y = MARGIN;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        pictures[i].context = tn_canvas_context(canvas);
        draw_rule(&pictures[i], MARGIN, y);
        y += TITLE_ROOM + pictures[i].sizes[0].height + BETWEEN_RULES;
    }
    if (status == TN_OK)
        status = tn_canvas_commit(canvas, error);
    tn_canvas_free(canvas);
    return status;
}

tn_status tn_rules_draw(const tn_schema *schema, const uint32_t *rules, size_t count, const char *path, uint32_t dpi,
                        tn_error *error)
{
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
    cairo_t *context = cairo_create(surface);
    picture *pictures = calloc(count + 1, sizeof *pictures);
    tn_status status = pictures ? TN_OK : tn_fail_memory(error);
    size all = {0, 2 * MARGIN - BETWEEN_RULES};
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        status = picture_make(&pictures[i], schema, rules[i], context, error);
        if (status != TN_OK)
            continue;
        size one = pictures[i].sizes[0];
        all.width = fmax(all.width, fmax(one.width, title_width(&pictures[i])) + 2 * MARGIN);
        all.height += TITLE_ROOM + one.height + BETWEEN_RULES;
    }
    if (status == TN_OK && !(all.width <= TN_DRAW_RULE_SIDE_MAX && all.height <= TN_DRAW_RULE_SIDE_MAX)) {
        status = tn_fail(error, TN_LIMIT, 820, "the picture would be %.0f by %.0f points; the limit is %.0f a side",
                         all.width, all.height, TN_DRAW_RULE_SIDE_MAX);
        tn_error_help(error, "draw fewer rules at once, or give parts of the rule names of their own");
    }
    if (status == TN_OK)
        status = draw_pictures(pictures, count, all, path, dpi, error);
    for (size_t i = 0; pictures && i < count; i++) {
        tn_parts_clear(&pictures[i].parts);
        free(pictures[i].sizes);
    }
    free(pictures);
    cairo_destroy(context);
    cairo_surface_destroy(surface);
    return status;
}
