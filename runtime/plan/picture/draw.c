/* Draws plans on sheets. */
#include "runtime/plan/picture/draw.h"

#include <math.h>
#include <stdio.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/scales.h"
#include "runtime/draw/type.h"
#include "runtime/plan/picture/draw_parts.h"

#define MARGIN 34.0 /* from the paper's edge to the frame */
#define INSET 26.0  /* from the frame to the plans */
#define COLUMN_GAP 30.0
#define ROW_GAP 20.0
#define STRIP_PAPER 1296.0 /* width of the paper that the strip is made for: ARCH B, 18 inches */
#define NUMBER_ROOM 12.0
#define NUMBER_SIZE 6.2
#define HEADING_ROOM 22.0 /* above each row, where there are groups */
#define HEADING_SIZE 10.0
#define CAPTION_ROOM 15.0 /* above each plan, where there are captions */
#define CAPTION_SIZE 8.0
#define LEGIBLE_SIZE 5.5 /* of the dimensions, which with some room choose the smallest good scale */
#define LEGIBLE_ROOM 7.0

/* One drawing under way. */
typedef struct drawing {
    tn_draw_roles roles;
    const tn_drawn_plan *plans;
    size_t count;
    const tn_draw_options *options;
    tn_canvas_format format;
    tn_draw_extent extent;
    tn_draw_table table;
    /* the layout */
    double width, height; /* of a page */
    uint32_t scale;       /* 1:scale; 0 for a table */
    double factor;        /* points a nanometre; for a table, points a point */
    size_t columns, rows; /* of cells on a page */
    double cell_width, cell_height;
    bool grouped, captioned;
} drawing;

/* The place of the plan after one at `slot` (SIZE_MAX: none), counting cells along the rows: a group begins a row. */
static size_t next_slot(const drawing *d, size_t slot, const tn_drawn_plan *plan)
{
    size_t next = slot == SIZE_MAX ? 0 : slot + 1;
    return plan->heading ? (next + d->columns - 1) / d->columns * d->columns : next;
}

/* How many cells all plans take, with those left empty at the ends of groups. */
static size_t slots(const drawing *d)
{
    size_t slot = SIZE_MAX;
    for (size_t i = 0; i < d->count; i++)
        slot = next_slot(d, slot, &d->plans[i]);
    return slot + 1;
}

static double heading_room(const drawing *d)
{
    return (d->grouped ? HEADING_ROOM : 0) + (d->captioned ? CAPTION_ROOM : 0);
}

static double sides_room(const drawing *d)
{
    return tn_draw_two_sided(&d->roles) ? TN_SIDES_ROOM : 0;
}

/* The size of a cell at a scale: points a nanometre for a plan to scale, points a point for a table. */
static void size_cells(drawing *d, double factor)
{
    d->factor = factor;
    if (d->roles.to_scale) {
        double marks = d->roles.public_end == TN_NO_FIELD ? 0 : 2 * TN_MARK_ROOM;
        d->cell_width = d->extent.width * factor + marks + sides_room(d);
        d->cell_height = (d->extent.above + d->extent.below) * factor + tn_draw_dimension_room(&d->extent) +
                         NUMBER_ROOM + heading_room(d);
    } else {
        d->cell_width = d->extent.width * factor;
        d->cell_height = tn_draw_table_height(&d->table, &d->roles) * factor + NUMBER_ROOM + heading_room(d);
    }
}

static double room_across(double width)
{
    return width - 2 * (MARGIN + INSET);
}

/* The strip grows with the paper, as on sheets that are read from further away. */
static double strip_zoom(double width)
{
    return fmax(0.7, fmin(width / STRIP_PAPER, 1.6));
}

static double strip_height(double width)
{
    return TN_STRIP_HEIGHT * strip_zoom(width);
}

static double room_down(double width, double height)
{
    return height - 2 * (MARGIN + INSET) - strip_height(width);
}

/* How many cells of this size, with gaps between, there is room for. */
static size_t how_many(double room, double cell, double gap)
{
    return room + 0.01 < cell ? 0 : (size_t)((room + gap + 0.01) / (cell + gap));
}

static bool lay_out(drawing *d, const tn_paper *paper, double factor)
{
    size_cells(d, factor);
    d->width = paper->width;
    d->height = paper->height;
    d->columns = how_many(room_across(paper->width), d->cell_width, COLUMN_GAP);
    if (d->options->columns)
        d->columns = d->options->columns <= d->columns ? d->options->columns : 0;
    d->rows = how_many(room_down(paper->width, paper->height), d->cell_height, ROW_GAP);
    return d->columns > 0 && d->rows > 0;
}

static bool holds_all(const drawing *d)
{
    return d->columns > 0 && d->columns * d->rows >= slots(d);
}

static bool is_metric(const drawing *d)
{
    return d->roles.style != TN_STYLE_FEET;
}

/* How wide the widest name of what a tray is for is. */
static double widest_text(const drawing *d, tn_paint *paint)
{
    const tn_schema *schema = d->roles.schema;
    uint32_t field = d->roles.text;
    double widest = 0;
    tn_paint_face(paint, TN_INSIDE_LEAST, true);
    for (uint32_t v = 0; field != TN_NO_FIELD && v < schema->fields[field].value_count; v++)
        widest = fmax(widest, tn_type_width(paint, tn_text(schema->module,
                                                           schema->values[schema->value_start[field] + v].spelling)) +
                                  LEGIBLE_ROOM / 2);
    return widest;
}

/* The smallest scale 1:n at which each tray's length, and what it is for, can be written along it. */
static double legible_scale(const drawing *d, tn_paint *paint)
{
    const tn_schema *schema = d->roles.schema;
    double most = 1e9, text = widest_text(d, paint);
    tn_paint_face(paint, LEGIBLE_SIZE, false);
    for (uint32_t v = schema->value_start[d->roles.length]; v < schema->value_start[d->roles.length + 1]; v++) {
        double width = fmax(text, tn_type_width(paint, tn_text(schema->module, schema->values[v].name)) + LEGIBLE_ROOM);
        if (schema->values[v].length > 0)
            most = fmin(most, (double)schema->values[v].length * TN_POINTS_PER_NM / width);
    }
    return most;
}

/* The largest usual scale from 1:first_legible down at which the paper holds all (or, where `one` is enough, any). */
static bool choose_scale(drawing *d, const tn_paper *paper, double most, bool one)
{
    const uint32_t *scales;
    size_t count = tn_scale_choices(is_metric(d), &scales);
    for (size_t i = 0; i < count; i++) {
        d->scale = scales[i];
        if (scales[i] <= most && lay_out(d, paper, TN_POINTS_PER_NM / scales[i]) && (one || holds_all(d)))
            return true;
    }
    return false;
}

/* Where plans are too large for any usual scale: halves until one fits. */
static void force_scale(drawing *d, const tn_paper *paper)
{
    d->scale = 1000;
    while (!lay_out(d, paper, TN_POINTS_PER_NM / d->scale) && d->scale < UINT32_MAX / 2)
        d->scale *= 2;
}

/* Many plans: as many as can be read on each page (the smallest legible scale). */
static void choose_dense(drawing *d, const tn_paper *paper, double most)
{
    const uint32_t *scales;
    size_t count = tn_scale_choices(is_metric(d), &scales);
    for (size_t i = count; i-- > 0;) {
        d->scale = scales[i];
        if (scales[i] <= most && lay_out(d, paper, TN_POINTS_PER_NM / scales[i]))
            return;
    }
    if (!choose_scale(d, paper, 1e9, true))
        force_scale(d, paper);
}

static void lay_out_plans(drawing *d, const tn_paper *papers, size_t paper_count, double most)
{
    const tn_paper *usual = &papers[paper_count / 2]; /* for pages, where one does not hold all */
    for (size_t i = 0; i < paper_count; i++) {
        d->scale = d->options->scale;
        if (d->scale ? lay_out(d, &papers[i], TN_POINTS_PER_NM / d->scale) && holds_all(d)
                     : choose_scale(d, &papers[i], most, false))
            return;
    }
    if (!d->options->scale && d->options->paper && choose_scale(d, usual, 2 * most, false))
        return; /* the paper was asked for: rather a little too small than more paper */
    d->scale = d->options->scale;
    if (d->scale)
        lay_out(d, usual, TN_POINTS_PER_NM / d->scale);
    else
        choose_dense(d, usual, most);
}

static void lay_out_tables(drawing *d, const tn_paper *papers, size_t paper_count)
{
    static const double factors[] = {2, 1.6, 1.3, 1};
    d->scale = 0;
    for (size_t i = 0; i < paper_count; i++)
        for (size_t f = 0; f < sizeof factors / sizeof *factors; f++)
            if (lay_out(d, &papers[i], factors[f]) && holds_all(d))
                return;
    const tn_paper *usual = &papers[paper_count / 2];
    if (lay_out(d, usual, 1))
        return;
    double across = room_across(usual->width) / d->extent.width,
           down = (room_down(usual->width, usual->height) - NUMBER_ROOM - heading_room(d)) /
                  tn_draw_table_height(&d->table, &d->roles);
    lay_out(d, usual, fmin(across, down));
}

/* What the lettering asks for: of plans to scale the smallest scale 1:*most, of tables how wide they are. False: out of
 * memory. */
static bool measure_lettering(drawing *d, double *most)
{
    tn_paint *paint = tn_paint_new(NULL);
    size_t longest = 0;
    if (!paint)
        return false;
    for (size_t i = 0; i < d->count; i++)
        longest = d->plans[i].length > longest ? d->plans[i].length : longest;
    if (d->roles.to_scale) {
        *most = legible_scale(d, paint);
    } else {
        tn_draw_table_measure(paint, &d->roles, &d->table);
        d->extent.width = tn_draw_table_width(&d->table, longest > 0 ? longest : 2);
    }
    tn_paint_free(paint);
    return true;
}

static tn_status choose_layout(drawing *d, tn_error *error)
{
    const tn_paper *papers;
    size_t paper_count = tn_paper_choices(is_metric(d), &papers);
    if (d->options->paper) {
        tn_status status = tn_paper_find(d->options->paper, &papers, error);
        if (status != TN_OK)
            return status;
        paper_count = 1;
    }
    if (d->options->scale && !d->roles.to_scale) {
        tn_status status = tn_fail(error, TN_INVALID, E_USAGE,
                                   "the plans cannot be drawn to scale: the schema has no field of role length "
                                   "and zone of role band");
        tn_error_help(error,
                      "leave --scale out, or say in the schema which field is the length and which zones are bands");
        return status;
    }
    double most = 0;
    if (!measure_lettering(d, &most))
        return tn_fail_memory(error);
    if (d->roles.to_scale)
        lay_out_plans(d, papers, paper_count, most);
    else
        lay_out_tables(d, papers, paper_count);
    if (d->columns > 0 && (d->rows > 0 || d->format != TN_CANVAS_PDF))
        return TN_OK;
    tn_status status = tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE, "the plans do not fit on the paper as asked for");
    tn_error_help(error,
                  "choose a larger --paper, a smaller --scale (a larger number) or fewer --columns, or leave them out");
    return status;
}

/* A sheet that is not paged grows downwards until it holds all; rows on a single page are made equally long. */
static void fit_sheet(drawing *d)
{
    size_t needed = (slots(d) + d->columns - 1) / d->columns;
    if (needed > 0 && needed <= d->rows && !d->options->columns && !d->grouped)
        d->columns = (d->count + needed - 1) / needed;
    if (d->format == TN_CANVAS_PDF || needed <= d->rows)
        return;
    d->rows = needed;
    d->height = 2 * (MARGIN + INSET) + strip_height(d->width) + (double)needed * (d->cell_height + ROW_GAP) - ROW_GAP;
}

static void draw_frame(const drawing *d, tn_paint *paint, size_t page, size_t pages)
{
    double width = d->width - 2 * MARGIN, zoom = strip_zoom(d->width),
           strip = d->height - MARGIN - strip_height(d->width);
    tn_paint_layer(paint, TN_LAYER_TITLE);
    tn_paint_rectangle(paint, MARGIN, MARGIN, width, d->height - 2 * MARGIN);
    tn_paint_weight(paint, TN_WEIGHT_CUT);
    tn_paint_stroke(paint);
    tn_paint_move_to(paint, MARGIN, strip);
    tn_paint_line_to(paint, MARGIN + width, strip);
    tn_paint_stroke(paint);
    tn_paint_save(paint);
    tn_paint_translate(paint, MARGIN, strip);
    tn_paint_scale(paint, zoom);
    tn_draw_strip(paint, &d->roles, d->options, d->scale, zoom, page, pages, width / zoom);
    tn_paint_restore(paint);
}

static void draw_number(const drawing *d, tn_paint *paint, const tn_drawn_plan *plan, double x, double baseline,
                        double width)
{
    if (!plan->number)
        return;
    tn_paint_layer(paint, TN_LAYER_TEXT);
    tn_paint_face(paint, NUMBER_SIZE - 1, false);
    tn_type_line(paint, x, baseline, TN_ALIGN_LEFT, d->options->number_name);
    double used = tn_type_width(paint, d->options->number_name) + 3;
    tn_paint_face(paint, NUMBER_SIZE, true);
    tn_type_digits(paint, x + used, baseline, width - used, plan->number);
}

static void draw_table(const drawing *d, tn_paint *paint, const tn_drawn_plan *plan, double x, double y)
{
    tn_paint_save(paint);
    tn_paint_translate(paint, x, y);
    tn_paint_scale(paint, d->factor);
    tn_draw_table_plan(paint, &d->roles, &d->table, plan, 0, 0);
    tn_paint_restore(paint);
}

static void draw_cell(const drawing *d, tn_paint *paint, const tn_drawn_plan *plan, double x, double top)
{
    double y = top + heading_room(d), height = d->cell_height - heading_room(d);
    tn_paint_target(paint, x, y, d->cell_width, height);
    tn_paint_layer(paint, TN_LAYER_TEXT);
    if (plan->heading) {
        tn_paint_face(paint, HEADING_SIZE, true);
        tn_type_line(paint, x, top + HEADING_SIZE, TN_ALIGN_LEFT, plan->heading);
    }
    if (plan->caption) {
        tn_paint_face(paint, CAPTION_SIZE, true);
        tn_type_fit(paint, x, y - CAPTION_ROOM + CAPTION_SIZE, TN_ALIGN_LEFT, d->cell_width, plan->caption);
    }
    if (d->roles.to_scale) {
        double left = x + sides_room(d) + (d->roles.public_end == TN_NO_FIELD ? 0 : TN_MARK_ROOM);
        double above = d->extent.above * d->factor, spine = y + above, bottom = spine + d->extent.below * d->factor;
        const tn_drawn_view view = {plan->number, x, y, d->cell_width, height, {left, spine}, 1};
        tn_paint_view_begin(paint, &view);
        if (tn_draw_two_sided(&d->roles) && plan->length > 0)
            tn_draw_sides(paint, &d->roles, x, spine, above, bottom - spine);
        tn_draw_plan(paint, &d->roles, plan, d->factor, left, spine, bottom, &d->extent);
        draw_number(d, paint, plan, left, y + height - 2, d->cell_width - (left - x));
        tn_paint_view_end(paint);
        return;
    }
    draw_table(d, paint, plan, x, y);
    double indent = d->table.name_width * d->factor;
    draw_number(d, paint, plan, x + indent, y + height - 2, d->cell_width - indent);
}

/* The gap that spreads `count` cells over the room, between the usual gap and three times that. */
static double spread(double room, double cell, size_t count, double gap)
{
    if (count < 2)
        return gap;
    double even = (room - cell * (double)count) / (double)(count - 1);
    return fmax(gap, fmin(even, 3 * gap));
}

/* The page whose first cell is `first`. */
static void draw_page(const drawing *d, const tn_canvas *canvas, size_t first, size_t page, size_t pages)
{
    size_t on_page = d->columns * d->rows, left = slots(d) - first, here = left < on_page ? left : on_page;
    size_t columns = here < d->columns ? here : d->columns, rows = columns ? (here + d->columns - 1) / d->columns : 0;
    double across = room_across(d->width), down = room_down(d->width, d->height);
    double column_gap = spread(across, d->cell_width, d->columns, COLUMN_GAP),
           row_gap = spread(down, d->cell_height, rows, ROW_GAP);
    double used = d->cell_width * (double)columns + column_gap * (columns ? (double)columns - 1 : 0);
    double used_down = d->cell_height * (double)rows + row_gap * (rows ? (double)rows - 1 : 0);
    double x0 = MARGIN + INSET + fmax(0, (across - used) / 2);
    double y0 = MARGIN + INSET + (pages == 1 ? fmax(0, (down - used_down) / 2) : 0);
    tn_paint *paint = tn_canvas_paint(canvas);
    draw_frame(d, paint, page, pages);
    for (size_t i = 0, slot = SIZE_MAX; i < d->count && !tn_canvas_stopped(canvas); i++) {
        slot = next_slot(d, slot, &d->plans[i]);
        size_t at = slot - first; /* wraps where it is on an earlier page */
        if (at >= here)
            continue;
        tn_paint_group_begin(paint, TN_PAINT_PLAN, i);
        draw_cell(d, paint, &d->plans[i], x0 + (double)(at % d->columns) * (d->cell_width + column_gap),
                  y0 + (double)(at / d->columns) * (d->cell_height + row_gap));
        tn_paint_group_end(paint);
    }
}

static tn_status draw_pages(const drawing *d, tn_canvas *canvas, tn_error *error)
{
    size_t on_page = d->columns * d->rows, pages = d->count ? (slots(d) + on_page - 1) / on_page : 1;
    for (size_t page = 0; page < pages; page++) {
        tn_status status = page ? tn_canvas_page(canvas, d->width, d->height, error) : TN_OK;
        if (status != TN_OK)
            return status;
        draw_page(d, canvas, page * on_page, page + 1, pages);
    }
    return tn_canvas_commit(canvas, error);
}

static tn_status check_count(size_t count, const tn_draw_options *options, tn_error *error)
{
    size_t most = options->max_plans ? options->max_plans : TN_DRAW_PLANS_DEFAULT;
    if (count <= most)
        return TN_OK;
    tn_status status =
        tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE, "there are %zu plans to draw; the limit is %zu", count, most);
    tn_error_help(error, "raise it with --max-plans, or draw a --sample");
    return status;
}

tn_status tn_plans_draw(const tn_schema *schema, const tn_drawn_plan *plans, size_t count,
                        const tn_draw_options *options, tn_picture *to, tn_error *error)
{
    drawing d = {.plans = plans, .count = count, .options = options};
    tn_canvas *canvas;
    tn_status status = tn_picture_format(to, &d.format, error);
    if (status == TN_OK)
        status = check_count(count, options, error);
    if (status != TN_OK)
        return status;
    tn_draw_roles_find(schema, &d.roles);
    for (size_t i = 0; i < count; i++) {
        d.grouped = d.grouped || plans[i].heading;
        d.captioned = d.captioned || plans[i].caption;
        if (d.roles.to_scale)
            tn_draw_measure(&d.roles, &plans[i], &d.extent);
    }
    status = choose_layout(&d, error);
    if (status != TN_OK)
        return status;
    fit_sheet(&d);
    const tn_canvas_options canvas_options = {.width = d.width,
                                              .height = d.height,
                                              .dpi = options->dpi,
                                              .title = options->title,
                                              .scale = d.scale,
                                              .feet = !is_metric(&d)};
    status = tn_canvas_open(to, &canvas_options, &canvas, error);
    if (status != TN_OK)
        return status;
    status = draw_pages(&d, canvas, error);
    tn_canvas_free(canvas);
    return status;
}
