/* Draws why a plan is kept or dropped. */
#include "runtime/plan/picture/draw_explain.h"

#include <math.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/scales.h"
#include "runtime/draw/type.h"
#include "runtime/plan/picture/draw_parts.h"

#define MARGIN 24.0
#define ALONE_MARGIN 6.0 /* of a plan without reasons, which stands in a text */
#define TITLE_SIZE 11.0
#define TITLE_ROOM 20.0
#define TEXT_SIZE 7.0
#define RULE_SIZE 8.0
#define ROW_HEIGHT 13.0
#define RULE_ROOM 9.0 /* above a rule */
#define LABEL_WIDTH 250.0
#define EVIDENCE_WIDTH 200.0
#define INDENT 10.0
#define GAP 12.0
#define TRAY_MIN 14.0    /* the narrowest tray, in points: marks stay visible */
#define TRAY_MAX 1440.0  /* the widest and deepest, where another is so narrow that TRAY_MIN would ask for more */
#define PLAN_WIDTH 420.0 /* about how wide the plan is */
#define BAR_INSET 1.6
#define CAPTION_ROOM 12.0 /* above a plan to compare with */

static const double green[3] = {0.36, 0.66, 0.38}, pale[3] = {0.80, 0.91, 0.80}, red[3] = {0.78, 0.20, 0.17},
                    rose[3] = {0.96, 0.80, 0.78}, grey[3] = {0.62, 0.62, 0.62};

/* What a rule that is to be met says yes to is green, and what it lacks red. What a rule says yes to that prunes the
 * plan for it is red, and what it does not find there is no fault. */
static const double *colour_of(const tn_drawn_reason *reason, bool matched)
{
    return matched ? (reason->drops ? red : green) : (reason->drops ? grey : red);
}

typedef struct picture {
    tn_paint *paint;
    const tn_schema *schema;
    const tn_drawn_reasons *drawn;
    const tn_drawn_plan *plan;
    const char *title;
    tn_draw_roles roles;
    tn_draw_extent extent;
    tn_draw_table table;
    double scale; /* points a nanometre */
    double margin;
    double left; /* of the plan */
    double plan_width, plan_height;
    double width, height;
} picture;

/* Where tray i starts, from the left end of the plan. */
static double tray_at(const picture *p, size_t i)
{
    if (!p->roles.to_scale)
        return p->table.box_width * (double)i;
    double x = 0;
    for (size_t k = 0; k < i; k++)
        x += (double)tn_tray_value_record(p->schema, p->plan->trays[k], p->roles.length)->length * p->scale;
    return x;
}

static void measure_to_scale(picture *p)
{
    int64_t narrowest = INT64_MAX, widest = 1;
    for (size_t i = 0; i < p->plan->length; i++) {
        int64_t length = tn_tray_value_record(p->schema, p->plan->trays[i], p->roles.length)->length;
        narrowest = length > 0 && length < narrowest ? length : narrowest;
        widest = length > widest ? length : widest;
    }
    tn_draw_measure(&p->roles, p->plan, &p->extent);
    for (size_t i = 0; i < p->drawn->near_count; i++)
        tn_draw_measure(&p->roles, &p->drawn->near[i], &p->extent);
    p->scale = p->extent.width > 0 ? PLAN_WIDTH / p->extent.width : 1e-9;
    p->scale = fmin(p->scale, 72.0 / 3657600000.0 * 1.2); /* a 12' tray is at most 1.2 inches */
    if (narrowest != INT64_MAX)
        p->scale = fmax(p->scale, fmin(TRAY_MIN / (double)narrowest,
                                       TRAY_MAX / fmax((double)widest, p->extent.above + p->extent.below)));
    p->plan_width = fmax(p->extent.width * p->scale, 40);
    p->plan_height =
        (p->extent.above + p->extent.below) * p->scale + tn_draw_dimension_room(&p->extent) + 2 * TN_MARK_ROOM;
}

/* The most trays of any plan of the picture. */
static size_t longest(const picture *p)
{
    size_t most = p->plan->length;
    for (size_t i = 0; i < p->drawn->near_count; i++)
        most = p->drawn->near[i].length > most ? p->drawn->near[i].length : most;
    return most;
}

/* False: out of memory. */
static bool measure(picture *p, const tn_drawn_reason *reasons, size_t count)
{
    tn_paint *paint = tn_paint_new(NULL);
    if (!paint)
        return false;
    if (p->roles.to_scale) {
        measure_to_scale(p);
    } else {
        tn_draw_table_measure(paint, &p->roles, &p->table);
        p->plan_width = fmax(p->table.box_width * (double)longest(p), 40);
        p->plan_height = tn_draw_table_height(&p->table, &p->roles) + GAP;
    }
    tn_paint_free(paint);
    /* beside a plan alone there is nothing to say */
    p->margin = count > 0 || p->title ? MARGIN : ALONE_MARGIN;
    p->left = p->margin + (count > 0 ? LABEL_WIDTH + GAP + TN_MARK_ROOM : fmax(TN_MARK_ROOM, p->table.name_width));
    p->width = p->left + p->plan_width + TN_MARK_ROOM + p->margin + (count > 0 ? GAP + EVIDENCE_WIDTH : 0);
    p->height = 2 * p->margin + (p->title ? TITLE_ROOM : 0) + p->plan_height;
    for (size_t i = 0; i < count; i++)
        p->height += ROW_HEIGHT + (reasons[i].depth == 0 ? RULE_ROOM : 0);
    if (p->drawn->near_count > 0)
        p->height += TITLE_ROOM + 2 * RULE_ROOM + (CAPTION_ROOM + p->plan_height) * (double)p->drawn->near_count;
    return true;
}

static void draw_trays(const picture *p, const tn_drawn_plan *plan, double y)
{
    if (!p->roles.to_scale) {
        tn_draw_table_plan(p->paint, &p->roles, &p->table, plan, p->left - p->table.name_width, y);
        return;
    }
    double spine = y + TN_MARK_ROOM + p->extent.above * p->scale;
    tn_draw_plan(p->paint, &p->roles, plan, p->scale, p->left, spine, spine + p->extent.below * p->scale, &p->extent);
}

static void draw_plan(const picture *p, const tn_drawn_plan *plan, size_t number, double y)
{
    tn_paint_group_begin(p->paint, TN_PAINT_PLAN, number);
    draw_trays(p, plan, y);
    tn_paint_group_end(p->paint);
}

static void bars(const picture *p, const tn_stretch *stretches, size_t count, double y, const double colour[3],
                 bool filled)
{
    for (size_t i = 0; i < count; i++) {
        if (stretches[i].begin >= stretches[i].end)
            continue;
        double from = p->left + tray_at(p, stretches[i].begin) + 1, to = p->left + tray_at(p, stretches[i].end) - 1;
        tn_paint_rectangle(p->paint, from, y + BAR_INSET, to - from, ROW_HEIGHT - 2 * BAR_INSET);
    }
    tn_paint_colour(p->paint, colour[0], colour[1], colour[2]);
    tn_paint_line_width(p->paint, 1.1);
    if (filled)
        tn_paint_fill(p->paint);
    else
        tn_paint_stroke(p->paint);
    tn_paint_colour(p->paint, 0, 0, 0);
}

/* Where the part was looked for in vain. */
static void line_of_absence(const picture *p, const tn_drawn_reason *reason, double y)
{
    tn_stretch region = reason->region;
    const double *colour = colour_of(reason, false);
    double middle = y + ROW_HEIGHT / 2;
    tn_paint_move_to(p->paint, p->left + tray_at(p, region.begin) + 1, middle);
    tn_paint_line_to(p->paint, p->left + tray_at(p, region.end) - 1, middle);
    tn_paint_colour(p->paint, colour[0], colour[1], colour[2]);
    tn_paint_line_width(p->paint, 0.7);
    tn_paint_stroke(p->paint);
    tn_paint_colour(p->paint, 0, 0, 0);
}

static void draw_marks(const picture *p, const tn_drawn_reason *reason, double y)
{
    bars(p, reason->marks, reason->mark_count, y, colour_of(reason, true), true);
    if (reason->matched)
        return;
    if (reason->region.begin < reason->region.end && reason->mark_count == 0)
        line_of_absence(p, reason, y);
    bars(p, &reason->partly, 1, y, reason->drops ? rose : pale, true);
    bars(p, &reason->lacking, 1, y, colour_of(reason, false), false);
}

/* A sign before the text: a filled square where the part matches, an open one where it does not. */
static void draw_sign(const picture *p, const tn_drawn_reason *reason, double x, double y)
{
    const double *colour = colour_of(reason, reason->matched);
    tn_paint_rectangle(p->paint, x, y + 4.2, 4.6, 4.6);
    tn_paint_colour(p->paint, colour[0], colour[1], colour[2]);
    tn_paint_line_width(p->paint, 1);
    if (reason->matched)
        tn_paint_fill(p->paint);
    else
        tn_paint_stroke(p->paint);
    tn_paint_colour(p->paint, 0, 0, 0);
}

static void draw_rule(const picture *p, const tn_drawn_reason *reason, double y)
{
    tn_paint_move_to(p->paint, MARGIN, y);
    tn_paint_line_to(p->paint, p->width - MARGIN, y);
    tn_paint_weight(p->paint, TN_WEIGHT_HATCH);
    tn_paint_stroke(p->paint);
    tn_paint_face(p->paint, RULE_SIZE, true);
    tn_type_fit(p->paint, MARGIN, y + 9.5, TN_ALIGN_LEFT, LABEL_WIDTH, reason->text);
    tn_paint_face(p->paint, TEXT_SIZE, false);
    if (reason->evidence)
        tn_type_fit(p->paint, p->left, y + 9.5, TN_ALIGN_LEFT, p->width - MARGIN - p->left, reason->evidence);
}

static void draw_part(const picture *p, const tn_drawn_reason *reason, double y)
{
    double x = MARGIN + INDENT * (fmin(reason->depth, 14) - 1);
    draw_sign(p, reason, x, y);
    tn_paint_face(p->paint, TEXT_SIZE, false);
    tn_type_fit(p->paint, x + 8, y + 9, TN_ALIGN_LEFT, MARGIN + LABEL_WIDTH - x - 8, reason->text);
    draw_marks(p, reason, y);
    if (reason->evidence)
        tn_type_fit(p->paint, p->width - MARGIN - EVIDENCE_WIDTH, y + 9, TN_ALIGN_LEFT, EVIDENCE_WIDTH,
                    reason->evidence);
}

/* How many rows stand below that of a rule. */
static size_t parts_of(const tn_drawn_reason *reasons, size_t count, size_t rule)
{
    size_t end = rule + 1;
    while (end < count && reasons[end].depth > 0)
        end++;
    return end - rule - 1;
}

/* The limits between trays, through the rows of a rule. */
static void draw_grid(const picture *p, double from, double to)
{
    for (size_t i = 0; i <= p->plan->length; i++) {
        tn_paint_move_to(p->paint, p->left + tray_at(p, i), from);
        tn_paint_line_to(p->paint, p->left + tray_at(p, i), to);
    }
    tn_paint_colour(p->paint, 0.8, 0.8, 0.8);
    tn_paint_weight(p->paint, TN_WEIGHT_HATCH);
    tn_paint_stroke(p->paint);
    tn_paint_colour(p->paint, 0, 0, 0);
}

/* A rule, and a row for each of its parts. */
static void draw_reason(const picture *p, const tn_drawn_reason *rule, size_t parts, double y)
{
    tn_paint_group_begin(p->paint, TN_PAINT_RULE, rule->number);
    draw_rule(p, rule, y);
    draw_grid(p, y + ROW_HEIGHT, y + ROW_HEIGHT * (1 + (double)parts));
    for (size_t i = 1; i <= parts; i++) {
        double top = y + ROW_HEIGHT * (double)i;
        tn_paint_group_begin(p->paint, TN_PAINT_PART, rule[i].number);
        tn_paint_target(p->paint, MARGIN, top, p->width - 2 * MARGIN, ROW_HEIGHT);
        draw_part(p, &rule[i], top);
        tn_paint_group_end(p->paint);
    }
    tn_paint_group_end(p->paint);
}

static void draw_near(const picture *p, double y)
{
    if (p->drawn->near_count == 0)
        return;
    y += 2 * RULE_ROOM;
    tn_paint_face(p->paint, TITLE_SIZE, true);
    tn_type_fit(p->paint, p->margin, y + TITLE_SIZE, TN_ALIGN_LEFT, p->width - 2 * p->margin, p->drawn->near_title);
    y += TITLE_ROOM;
    for (size_t i = 0; i < p->drawn->near_count; i++) {
        const tn_drawn_plan *plan = &p->drawn->near[i];
        tn_paint_face(p->paint, RULE_SIZE, false);
        if (plan->caption)
            tn_type_fit(p->paint, p->left, y + RULE_SIZE, TN_ALIGN_LEFT, p->width - p->margin - p->left, plan->caption);
        draw_plan(p, plan, i + 1, y + CAPTION_ROOM);
        y += CAPTION_ROOM + p->plan_height;
    }
}

static void draw_all(const picture *p, const tn_drawn_reason *reasons, size_t count)
{
    double y = p->margin;
    if (p->title) {
        tn_paint_face(p->paint, TITLE_SIZE, true);
        tn_type_fit(p->paint, MARGIN, y + TITLE_SIZE, TN_ALIGN_LEFT, p->width - 2 * MARGIN, p->title);
        y += TITLE_ROOM;
    }
    draw_plan(p, p->plan, 0, y);
    y += p->plan_height;
    for (size_t i = 0; i < count;) {
        size_t parts = parts_of(reasons, count, i);
        y += RULE_ROOM;
        draw_reason(p, &reasons[i], parts, y);
        y += ROW_HEIGHT * (1 + (double)parts);
        i += 1 + parts;
    }
    draw_near(p, y);
}

tn_status tn_reasons_draw(const tn_schema *schema, const tn_drawn_reasons *drawn, tn_picture *to, tn_error *error)
{
    picture p = {.schema = schema, .drawn = drawn, .plan = &drawn->plan, .title = drawn->title};
    tn_canvas *canvas = NULL;
    if (drawn->count > TN_DRAW_REASONS_MAX)
        return tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE, "there are %zu parts to draw; the limit is %u",
                       drawn->count, TN_DRAW_REASONS_MAX);
    tn_draw_roles_find(schema, &p.roles);
    if (!measure(&p, drawn->reasons, drawn->count))
        return tn_fail_memory(error);
    tn_status status = tn_canvas_begin(to, p.width, p.height, drawn->title, &canvas, error);
    if (status == TN_OK) {
        p.paint = tn_canvas_paint(canvas);
        draw_all(&p, drawn->reasons, drawn->count);
        status = tn_canvas_commit(canvas, error);
    }
    tn_canvas_free(canvas);
    return status;
}
