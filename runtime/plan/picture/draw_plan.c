/* One plan drawn to scale: masses, lines, marks and dimensions. */
#include <math.h>
#include <stdio.h>

#include "runtime/draw/type.h"
#include "runtime/math/elementary.h"
#include "runtime/plan/picture/draw_parts.h"

#define PI 3.14159265358979323846

/* ---- one plan as a table */

#define TABLE_SIZE 6.0
#define ROW_HEIGHT 10.0
#define BOX_MIN 22.0
#define HEAD_SIZE 7.6 /* of what a tray is for */
#define HEAD_HEIGHT 15.0

static const char *text_of(const tn_draw_roles *roles, tn_tray tray, uint32_t field)
{
    return tn_text(roles->schema->module, tn_tray_value_record(roles->schema, tray, field)->spelling);
}

void tn_draw_table_measure(tn_paint *paint, const tn_draw_roles *roles, tn_draw_table *table)
{
    const tn_schema *schema = roles->schema;
    *table = (tn_draw_table){.box_width = BOX_MIN, .row_height = ROW_HEIGHT};
    table->head_height = roles->text == TN_NO_FIELD ? 0 : HEAD_HEIGHT;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        tn_paint_face(paint, TABLE_SIZE, false);
        table->name_width =
            fmax(table->name_width, tn_type_width(paint, tn_text(schema->module, schema->fields[f].name)) + 6);
        tn_paint_face(paint, f == roles->text ? HEAD_SIZE : TABLE_SIZE, f == roles->text);
        for (uint32_t v = schema->value_start[f]; v < schema->value_start[f + 1]; v++)
            table->box_width =
                fmax(table->box_width, tn_type_width(paint, tn_text(schema->module, schema->values[v].spelling)) + 8);
    }
}

double tn_draw_table_width(const tn_draw_table *table, size_t length)
{
    return table->name_width + table->box_width * (double)length;
}

double tn_draw_table_height(const tn_draw_table *table, const tn_draw_roles *roles)
{
    return table->head_height + table->row_height * (roles->schema->field_count - (table->head_height > 0));
}

static void draw_lines(tn_paint *paint, const tn_draw_table *table, double x, double y, double width, double height,
                       size_t length)
{
    tn_paint_layer(paint, TN_LAYER_AREA);
    for (double row = table->head_height > 0 ? table->head_height : table->row_height; row < height - 0.01;
         row += table->row_height) {
        tn_paint_move_to(paint, x, y + row);
        tn_paint_line_to(paint, x + width, y + row);
    }
    tn_paint_weight(paint, TN_WEIGHT_HATCH);
    tn_paint_stroke(paint);
    for (size_t i = 1; i < length; i++) {
        tn_paint_move_to(paint, x + table->box_width * (double)i, y);
        tn_paint_line_to(paint, x + table->box_width * (double)i, y + height);
    }
    tn_paint_weight(paint, TN_WEIGHT_THIN);
    tn_paint_stroke(paint);
    tn_paint_rectangle(paint, x, y, width, height);
    tn_paint_weight(paint, TN_WEIGHT_CUT);
    tn_paint_stroke(paint);
}

/* A field's row, with its tones or hatches under the words. */
static void draw_row(tn_paint *paint, const tn_draw_roles *roles, const tn_draw_table *table, const tn_drawn_plan *plan,
                     uint32_t field, double left, double y)
{
    bool head = field == roles->text;
    double height = head ? table->head_height : table->row_height, size = head ? HEAD_SIZE : TABLE_SIZE;
    bool flag = roles->schema->fields[field].kind == TN_FIELD_FLAG;
    tn_paint_layer(paint, TN_LAYER_TEXT);
    tn_paint_face(paint, TABLE_SIZE - 0.8, head);
    tn_type_line(paint, left - 5, y + height / 2 + 2.1, TN_ALIGN_RIGHT,
                 tn_text(roles->schema->module, roles->schema->fields[field].name));
    for (size_t i = 0; i < plan->length; i++) {
        double x = left + table->box_width * (double)i;
        uint32_t value = tn_tray_value(roles->schema, plan->trays[i], field);
        if (field == roles->tone)
            tn_draw_tone(paint, roles, value, x, y, table->box_width, height);
        if (field == roles->hatch)
            tn_draw_hatch(paint, roles, value, x, y, table->box_width, height);
        tn_paint_layer(paint, head ? TN_LAYER_ROOM : TN_LAYER_TEXT);
        tn_paint_face(paint, size, head);
        if (!flag || value) /* a flag that is not set says nothing */
            tn_type_line(paint, x + table->box_width / 2, y + height / 2 + size * 0.36, TN_ALIGN_CENTRE,
                         text_of(roles, plan->trays[i], field));
    }
}

void tn_draw_table_plan(tn_paint *paint, const tn_draw_roles *roles, const tn_draw_table *table,
                        const tn_drawn_plan *plan, double x, double y)
{
    double left = x + table->name_width, row = y + table->head_height;
    for (uint32_t f = 0; f < roles->schema->field_count; f++) {
        bool head = f == roles->text;
        draw_row(paint, roles, table, plan, f, left, head ? y : row);
        row += head ? 0 : table->row_height;
    }
    if (plan->length > 0)
        draw_lines(paint, table, left, y, table->box_width * (double)plan->length, tn_draw_table_height(table, roles),
                   plan->length);
    else
        tn_type_line(paint, left, y + table->row_height - 2.6, TN_ALIGN_LEFT, "no trays");
    for (size_t i = 0; i < plan->length; i++) {
        tn_paint_group_begin(paint, TN_PAINT_TRAY, i);
        tn_paint_target(paint, left + table->box_width * (double)i, y, table->box_width,
                        tn_draw_table_height(table, roles));
        tn_paint_group_end(paint);
    }
}

#define DIMENSION_SIZE 5.5
#define WRITTEN_SIZE 4.6
#define WRITTEN_MIN 10.0 /* a tray narrower than this has no room for words */
#define WRITTEN_LEADING 5.8

#define DIMENSION_GAP 11.0 /* from the plan to the line that measures trays */
#define DIMENSION_OUT 4.5  /* how far above a line what it measures is marked */
#define OVERALL_GAP 10.5   /* from there to the line that measures the whole */

/* A band of one tray, in points. */
typedef struct rectangle {
    double x, y, width, height;
    uint32_t value; /* VALUE record */
} rectangle;

/* The plan being drawn. */
typedef struct picture {
    tn_paint *paint;
    const tn_draw_roles *roles;
    const tn_drawn_plan *plan;
    double scale, x, y;
} picture;

static const tn_value_record *value_of(const tn_draw_roles *roles, tn_tray tray, uint32_t field)
{
    return tn_tray_value_record(roles->schema, tray, field);
}

static int64_t depth_of(const tn_draw_roles *roles, tn_tray tray, uint32_t band)
{
    const tn_value_record *value = value_of(roles, tray, roles->bands[band]);
    return value->role == TN_FILL_ABSENT ? 0 : value->length;
}

static bool is_set(const tn_draw_roles *roles, tn_tray tray, uint32_t field)
{
    return field != TN_NO_FIELD && tn_tray_value(roles->schema, tray, field) == 1;
}

/* Is this field's value written below the tray? A flag only where it is set. */
static bool is_worth_writing(const tn_draw_roles *roles, tn_tray tray, uint32_t field)
{
    return tn_draw_written(roles, field) && field != roles->text &&
           (roles->schema->fields[field].kind != TN_FIELD_FLAG || is_set(roles, tray, field));
}

/* A tray without bands still has a place: as deep as the shallowest spine. */
static int64_t bare_depth(const tn_draw_roles *roles)
{
    const tn_schema *schema = roles->schema;
    int64_t least = 0;
    uint32_t field = roles->bands[roles->spine];
    for (uint32_t v = schema->value_start[field]; v < schema->value_start[field + 1]; v++)
        if (schema->values[v].length > 0 && (least == 0 || schema->values[v].length < least))
            least = schema->values[v].length;
    return least > 0 ? least : INT64_C(1000000000);
}

void tn_draw_measure(const tn_draw_roles *roles, const tn_drawn_plan *plan, tn_draw_extent *extent)
{
    double width = 0;
    for (size_t i = 0; i < plan->length; i++) {
        tn_tray tray = plan->trays[i];
        double above = 0, below = 0;
        unsigned lines = 0;
        width += (double)value_of(roles, tray, roles->length)->length;
        for (uint32_t b = 0; b < roles->band_count; b++)
            *(b < roles->spine ? &above : &below) += (double)depth_of(roles, tray, b);
        if (above + below <= 0)
            below = (double)bare_depth(roles);
        for (uint32_t f = 0; f < roles->schema->field_count; f++)
            lines += is_worth_writing(roles, tray, f);
        extent->above = fmax(extent->above, above);
        extent->below = fmax(extent->below, below);
        extent->written_lines = lines > extent->written_lines ? lines : extent->written_lines;
        if (i > 0 && i + 1 < plan->length && is_set(roles, tray, roles->public_end))
            extent->mark_below = true;
    }
    extent->width = fmax(extent->width, width);
}

double tn_draw_dimension_room(const tn_draw_extent *extent)
{
    return DIMENSION_GAP + OVERALL_GAP + extent->written_lines * WRITTEN_LEADING +
           (extent->mark_below ? TN_MARK_ROOM : 0) + 4;
}

/* Where a line from (x, y), so much across and down, is within a stretch of one axis: part of its length. */
static void within(double at, double by, double low, double high, double *from, double *to)
{
    if (fabs(by) < 1e-9) {
        if (at <= low || at >= high)
            *to = *from;
        return;
    }
    double a = (low - at) / by, b = (high - at) / by;
    *from = fmax(*from, fmin(a, b));
    *to = fmin(*to, fmax(a, b));
}

/* A line that leaves areas free. */
static void line_around(tn_paint *paint, double x, double y, double across, double down, const tn_draw_area *spared,
                        size_t count)
{
    for (double at = 0; at < 1;) {
        double until = 1, next = 1;
        for (size_t i = 0; i < count; i++) {
            double from = at, to = 1;
            within(x, across, spared[i].x, spared[i].x + spared[i].width, &from, &to);
            within(y, down, spared[i].y, spared[i].y + spared[i].height, &from, &to);
            if (from >= to || from >= until)
                continue;
            until = from;
            next = to;
        }
        if (until > at) {
            tn_paint_move_to(paint, x + at * across, y + at * down);
            tn_paint_line_to(paint, x + until * across, y + until * down);
        }
        at = next;
    }
}

void tn_draw_level_mark(tn_paint *paint, uint32_t levels, bool hatched, tn_draw_area area, const tn_draw_area *spared,
                        size_t count)
{
    static const double dashes[] = {3, 1.6};
    tn_paint_save(paint);
    tn_paint_layer(paint, TN_LAYER_OVERHEAD);
    tn_paint_dash(paint, dashes, 2, 0);
    tn_paint_weight(paint, TN_WEIGHT_HATCH);
    line_around(paint, area.x, area.y, area.width, area.height, spared, count);
    line_around(paint, area.x + area.width, area.y, -area.width, area.height, spared, count);
    tn_paint_stroke(paint);
    tn_paint_restore(paint);
    if (levels < 3)
        return;
    char text[16];
    bool beside = count > 0 && spared[0].width > 0 && spared[0].y < area.y + 7; /* of a name that reaches as high */
    double middle = beside ? (area.x + spared[0].x) / 2 : area.x + area.width / 2;
    snprintf(text, sizeof text, "%u", levels);
    tn_paint_layer(paint, TN_LAYER_SYMBOL);
    tn_paint_face(paint, DIMENSION_SIZE, false);
    double half = tn_type_width(paint, text) / 2 + 1;
    if (hatched)
        tn_type_veil(paint, middle - half, area.y + 7 - DIMENSION_SIZE * 0.9, 2 * half, DIMENSION_SIZE * 1.1, 0.8);
    tn_type_line(paint, middle, area.y + 7, TN_ALIGN_CENTRE, text);
}

static void draw_circle(tn_paint *paint, const void *of)
{
    tn_paint_new_sub_path(paint);
    tn_paint_arc(paint, 0, 0, *(const double *)of, 0, 2 * PI);
    tn_paint_colour(paint, 1, 1, 1);
    tn_paint_fill_keep(paint);
    tn_paint_colour(paint, 0, 0, 0);
    tn_paint_weight(paint, TN_WEIGHT_THIN);
    tn_paint_stroke(paint);
}

void tn_draw_hall_mark(tn_paint *paint, double x, double y, double radius)
{
    char name[40];
    snprintf(name, sizeof name, "GREAT-HALL-%.0f", radius * 1000);
    tn_paint_layer(paint, TN_LAYER_SYMBOL);
    tn_paint_symbol(paint, &(tn_drawn_symbol){name, draw_circle, &radius}, x, y, 0, false);
}

static void draw_arrow(tn_paint *paint, const void *of)
{
    const double length = 7, half = 3.4;
    (void)of;
    tn_paint_move_to(paint, 0, 0);
    tn_paint_line_to(paint, -length, half);
    tn_paint_line_to(paint, -length, -half);
    tn_paint_close_path(paint);
    tn_paint_fill(paint);
}

void tn_draw_public_mark(tn_paint *paint, double x, double y, double dx, double dy)
{
    tn_paint_layer(paint, TN_LAYER_SYMBOL);
    tn_paint_symbol(paint, &(tn_drawn_symbol){"PUBLIC-END", draw_arrow, NULL}, x, y, tn_atan2(dy, dx), false);
}

/* The rectangle of a band of a tray that starts at `x`; false where the band is absent there. */
static bool band_rectangle(const picture *p, tn_tray tray, uint32_t band, double x, rectangle *out)
{
    const tn_draw_roles *roles = p->roles;
    int64_t depth = depth_of(roles, tray, band), offset = 0;
    if (depth <= 0)
        return false;
    if (band < roles->spine) {
        for (uint32_t b = band; b < roles->spine; b++)
            offset -= depth_of(roles, tray, b);
    } else {
        for (uint32_t b = roles->spine; b < band; b++)
            offset += depth_of(roles, tray, b);
    }
    *out = (rectangle){x, p->y + (double)offset * p->scale,
                       (double)value_of(roles, tray, roles->length)->length * p->scale, (double)depth * p->scale,
                       roles->schema->value_start[roles->bands[band]] +
                           tn_tray_value(roles->schema, tray, roles->bands[band])};
    return true;
}

static double tray_width(const picture *p, size_t i)
{
    return (double)value_of(p->roles, p->plan->trays[i], p->roles->length)->length * p->scale;
}

/* How far a tray reaches up and down from the spine's upper edge, in nanometres: its bands lie one at the other. */
static void reach_of(const picture *p, size_t i, int64_t *above, int64_t *below)
{
    *above = *below = 0;
    for (uint32_t b = 0; b < p->roles->band_count; b++)
        *(b < p->roles->spine ? above : below) += depth_of(p->roles, p->plan->trays[i], b);
}

static double edge_of(const picture *p, size_t i, bool upper)
{
    int64_t above, below;
    reach_of(p, i, &above, &below);
    return p->y + (double)(upper ? -above : below) * p->scale;
}

/* The contour goes on at x as an edge at y; where it does already, nothing is to be done. */
static void go_on(const picture *p, double x, double y, double *last)
{
    if (y == *last)
        return;
    if (!isnan(*last))
        tn_paint_line_to(p->paint, x, *last);
    tn_paint_line_to(p->paint, x, y);
    *last = y;
}

/* Around the trays from `from` to `end`, which have bands: along the upper edges, and back along the lower ones.
 * Returns where the last of them ends. */
static double trace_contour(const picture *p, size_t from, size_t end, double x)
{
    double last = NAN, right;
    tn_paint_new_sub_path(p->paint);
    for (size_t i = from; i < end; x += tray_width(p, i++))
        go_on(p, x, edge_of(p, i, true), &last);
    right = x;
    for (size_t i = end; i > from; x -= tray_width(p, --i))
        go_on(p, x, edge_of(p, i - 1, false), &last);
    tn_paint_line_to(p->paint, x, last);
    tn_paint_close_path(p->paint);
    return right;
}

static bool has_bands(const picture *p, size_t i)
{
    int64_t above, below;
    reach_of(p, i, &above, &below);
    return above + below > 0;
}

/* The contour of what is built: of each row of trays that have bands. */
static void draw_contour(const picture *p)
{
    double x = p->x;
    for (size_t i = 0, end; i < p->plan->length; i = end) {
        for (end = i; end < p->plan->length && has_bands(p, end);)
            end++;
        if (end > i)
            x = trace_contour(p, i, end, x);
        else
            x += tray_width(p, end++);
    }
    tn_paint_layer(p->paint, TN_LAYER_WALL_CUT);
    tn_paint_weight(p->paint, TN_WEIGHT_CUT);
    tn_paint_stroke(p->paint);
}

/* The room of a tray, which height, public end and great hall are said of: its spine band, or, where that is absent,
 * the largest band there is (Fig. 7 of the paper: "an open, public end, double height, great hall, body zone"). */
static bool room_of(const picture *p, tn_tray tray, double x, rectangle *room)
{
    if (band_rectangle(p, tray, p->roles->spine, x, room))
        return true;
    double area = 0;
    rectangle r;
    for (uint32_t b = 0; b < p->roles->band_count; b++) {
        if (!band_rectangle(p, tray, b, x, &r) || r.width * r.height <= area)
            continue;
        *room = r;
        area = r.width * r.height;
    }
    return area > 0;
}

/* A tray that has no bands: its place, dashed. */
static void draw_bare(const picture *p, rectangle room)
{
    static const double dashes[] = {2.5, 2};
    tn_paint_save(p->paint);
    tn_paint_layer(p->paint, TN_LAYER_AREA);
    tn_paint_dash(p->paint, dashes, 2, 0);
    tn_paint_rectangle(p->paint, room.x, room.y, room.width, room.height);
    tn_paint_weight(p->paint, TN_WEIGHT_THIN);
    tn_paint_stroke(p->paint);
    tn_paint_restore(p->paint);
}

/* What the tray is for colours its room, under the fills. */
static void draw_room(const picture *p, tn_tray tray, double x, double width)
{
    const tn_draw_roles *roles = p->roles;
    rectangle room = {x, p->y, width, (double)bare_depth(roles) * p->scale, 0};
    bool bare = !room_of(p, tray, x, &room);
    if (roles->tone != TN_NO_FIELD)
        tn_draw_tone(p->paint, roles, tn_tray_value(roles->schema, tray, roles->tone), room.x, room.y, room.width,
                     room.height);
    if (roles->hatch != TN_NO_FIELD)
        tn_draw_hatch(p->paint, roles, tn_tray_value(roles->schema, tray, roles->hatch), room.x, room.y, room.width,
                      room.height);
    if (bare)
        draw_bare(p, room);
}

static void draw_masses(const picture *p)
{
    double x = p->x;
    rectangle r;
    for (size_t i = 0; i < p->plan->length; x += tray_width(p, i++)) {
        draw_room(p, p->plan->trays[i], x, tray_width(p, i));
        for (uint32_t b = 0; b < p->roles->band_count; b++)
            if (band_rectangle(p, p->plan->trays[i], b, x, &r))
                tn_draw_fill(p->paint, p->roles, r.value, r.x, r.y, r.width, r.height);
    }
    draw_contour(p);
}

static void draw_public_end(const picture *p, size_t i, const rectangle *room, double bottom)
{
    double middle = room->y + room->height / 2, gap = 4.5;
    if (i == 0)
        tn_draw_public_mark(p->paint, room->x - gap, middle, 1, 0);
    else if (i + 1 == p->plan->length)
        tn_draw_public_mark(p->paint, room->x + room->width + gap, middle, -1, 0);
    else
        tn_draw_public_mark(p->paint, room->x + room->width / 2, bottom + gap, 0, -1);
}

/* What the tray is for stands in its room, or where its room would be; NULL: nothing says it. */
static const char *find_text(const picture *p, tn_tray tray, double x, double width, tn_draw_area *area, bool *hatched)
{
    const tn_draw_roles *roles = p->roles;
    rectangle room = {x, p->y, width, (double)bare_depth(roles) * p->scale, 0};
    if (roles->text == TN_NO_FIELD)
        return NULL;
    bool bare = !room_of(p, tray, x, &room);
    *hatched = !bare && roles->schema->values[room.value].role == TN_FILL_SOLID;
    *area = (tn_draw_area){room.x, room.y, room.width, room.height};
    if (is_set(roles, tray, roles->great_hall)) { /* below its mark */
        area->y += area->height * 0.7;
        area->height *= 0.3;
    }
    return tn_text(roles->schema->module, value_of(roles, tray, roles->text)->spelling);
}

static double hall_radius(rectangle room)
{
    return fmin(9, fmin(room.width, room.height) * 0.27);
}

/* The cross of a room of several storeys goes round its name, and ends at the mark of the great hall. */
static void draw_levels(const picture *p, tn_tray tray, rectangle room, const char *text, tn_draw_area area)
{
    uint32_t levels = p->roles->level == TN_NO_FIELD ? 1 : tn_tray_value(p->roles->schema, tray, p->roles->level) + 1;
    tn_draw_area spared[TN_SPARED_MOST];
    size_t count = 0;
    if (levels < 2)
        return;
    if (text) {
        tn_draw_area *name = &spared[count++];
        *name = area;
        tn_draw_inside_room(p->paint, text, TN_INSIDE_SIZE, &name->width, &name->height);
        name->x += (area.width - name->width) / 2;
        name->y += (area.height - name->height) / 2;
    }
    if (is_set(p->roles, tray, p->roles->great_hall)) {
        double part = hall_radius(room) / hypot(room.width, room.height);
        spared[count++] = (tn_draw_area){room.x + room.width * (0.5 - part), room.y + room.height * (0.5 - part),
                                         room.width * 2 * part, room.height * 2 * part};
    }
    bool hatched = p->roles->schema->values[room.value].role == TN_FILL_SOLID;
    tn_draw_level_mark(p->paint, levels, hatched, (tn_draw_area){room.x, room.y, room.width, room.height}, spared,
                       count);
}

static void draw_marks(const picture *p, double bottom)
{
    const tn_draw_roles *roles = p->roles;
    double x = p->x;
    for (size_t i = 0; i < p->plan->length; x += tray_width(p, i++)) {
        tn_tray tray = p->plan->trays[i];
        tn_draw_area area;
        rectangle room;
        bool hatched;
        const char *text = find_text(p, tray, x, tray_width(p, i), &area, &hatched);
        if (text)
            tn_draw_inside(p->paint, text, TN_INSIDE_SIZE, hatched, area.x, area.y, area.width, area.height);
        if (!room_of(p, tray, x, &room))
            continue;
        draw_levels(p, tray, room, text, area);
        if (is_set(roles, tray, roles->great_hall))
            tn_draw_hall_mark(p->paint, room.x + room.width / 2, room.y + room.height / 2, hall_radius(room));
        if (is_set(roles, tray, roles->public_end))
            draw_public_end(p, i, &room, bottom);
    }
}

/* ---- what lies on which side */

bool tn_draw_two_sided(const tn_draw_roles *roles)
{
    return roles->to_scale && roles->spine > 0 && roles->spine + 1 < roles->band_count;
}

static void draw_side(tn_paint *paint, const tn_draw_roles *roles, uint32_t band, double x, double middle, double room)
{
    const tn_schema *schema = roles->schema;
    tn_paint_save(paint);
    tn_paint_translate(paint, x + TN_SIDES_ROOM / 2, middle);
    tn_paint_rotate(paint, -PI / 2);
    tn_paint_layer(paint, TN_LAYER_TEXT);
    tn_paint_face(paint, DIMENSION_SIZE, false);
    tn_type_fit(paint, 0, DIMENSION_SIZE * 0.36, TN_ALIGN_CENTRE, room,
                tn_text(schema->module, schema->fields[roles->bands[band]].name));
    tn_paint_restore(paint);
}

void tn_draw_sides(tn_paint *paint, const tn_draw_roles *roles, double x, double spine, double above, double below)
{
    const double least = 26; /* points: most names are read in it, where the depth is less */
    double upper = fmax(above, least), lower = fmax(below / 2, least);
    draw_side(paint, roles, 0, x, spine - above + upper / 2, upper);
    draw_side(paint, roles, roles->band_count - 1, x, spine + below - lower / 2, lower);
}

/* What no mark shows is written below the tray, a line for each field. */
static void write_values(const picture *p, size_t i, double x, double y, double width)
{
    tn_tray tray = p->plan->trays[i];
    const tn_schema *schema = p->roles->schema;
    if (width < WRITTEN_MIN)
        return;
    tn_paint_layer(p->paint, TN_LAYER_TEXT);
    tn_paint_face(p->paint, WRITTEN_SIZE, false);
    for (uint32_t f = 0; f < schema->field_count; f++) {
        if (!is_worth_writing(p->roles, tray, f))
            continue;
        tn_type_fit(p->paint, x + width / 2, y, TN_ALIGN_CENTRE, width - 1,
                    tn_text(schema->module, value_of(p->roles, tray, f)->spelling));
        y += WRITTEN_LEADING;
    }
}

/* Measures from x to `to` along a line at y. What is drawn out to it begins beside it, as from far trays it would look
 * like their sides. The text is left out without room for it. */
static void draw_dimension(const picture *p, double x, double to, double y, const char *text)
{
    tn_paint_layer(p->paint, TN_LAYER_DIMENSION);
    tn_paint_weight(p->paint, TN_WEIGHT_HATCH);
    tn_paint_face(p->paint, DIMENSION_SIZE, false);
    tn_paint_dimension(p->paint, &(tn_dimension){.from = {x, y - DIMENSION_OUT},
                                                 .to = {to, y - DIMENSION_OUT},
                                                 .offset = -DIMENSION_OUT,
                                                 .text = tn_type_width(p->paint, text) < to - x ? text : ""});
}

static void draw_dimensions(const picture *p, double bottom, const tn_draw_extent *extent)
{
    double y = bottom + DIMENSION_GAP, x = p->x;
    int64_t total = 0;
    char text[64];
    for (size_t i = 0; i < p->plan->length; i++) {
        const tn_value_record *value = value_of(p->roles, p->plan->trays[i], p->roles->length);
        double width = (double)value->length * p->scale;
        draw_dimension(p, x, x + width, y, tn_text(p->roles->schema->module, value->name));
        write_values(p, i, x, y + WRITTEN_LEADING + 0.5, width);
        total += value->length;
        x += width;
    }
    y += OVERALL_GAP + extent->written_lines * WRITTEN_LEADING;
    tn_draw_length(p->roles, total, text, sizeof text);
    draw_dimension(p, p->x, x, y, text);
}

/* Each tray's place, from its highest band to its lowest. */
static void mark_trays(const picture *p)
{
    double x = p->x;
    for (size_t i = 0; i < p->plan->length; x += tray_width(p, i++)) {
        rectangle r = {x, p->y, tray_width(p, i), (double)bare_depth(p->roles) * p->scale, 0}, band;
        double top = INFINITY, bottom = -INFINITY;
        for (uint32_t b = 0; b < p->roles->band_count; b++) {
            if (!band_rectangle(p, p->plan->trays[i], b, x, &band))
                continue;
            top = fmin(top, band.y);
            bottom = fmax(bottom, band.y + band.height);
        }
        tn_paint_group_begin(p->paint, TN_PAINT_TRAY, i);
        tn_paint_target(p->paint, r.x, top < bottom ? top : r.y, r.width, top < bottom ? bottom - top : r.height);
        tn_paint_group_end(p->paint);
    }
}

void tn_draw_plan(tn_paint *paint, const tn_draw_roles *roles, const tn_drawn_plan *plan, double scale, double x,
                  double y, double bottom, const tn_draw_extent *extent)
{
    picture p = {paint, roles, plan, scale, x, y};
    if (plan->length == 0) {
        tn_paint_layer(paint, TN_LAYER_TEXT);
        tn_paint_face(paint, DIMENSION_SIZE, false);
        tn_type_line(paint, x, y + 6, TN_ALIGN_LEFT, "no trays");
        return;
    }
    draw_masses(&p);
    draw_marks(&p, bottom);
    draw_dimensions(&p, bottom + (extent->mark_below ? TN_MARK_ROOM : 0), extent);
    mark_trays(&p);
}
