/* Tray specifiers as symbols (Fig. 6 and 7 of the paper): the zones one above the other, dense hatched, open white,
 * empty struck out, any fill dotted; depths beside them, the width below; marks for height, public end and great hall,
 * none where any value will do. Several fills stand side by side in their zone. What has no symbol is written below. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "runtime/draw/type.h"
#include "runtime/plan/picture/draw_rule_data.h"

/* ---- lines */

void tn_draw_rule_box(tn_paint *paint, double x, double y, tn_size s)
{
    tn_paint_rectangle(paint, x, y, s.width, s.height);
    tn_paint_line_width(paint, 0.9);
    tn_paint_stroke(paint);
}

void tn_draw_rule_dashes(tn_paint *paint, double x1, double y1, double x2, double y2)
{
    static const double dashes[] = {4, 3};
    tn_paint_save(paint);
    tn_paint_dash(paint, dashes, 2, 0);
    tn_paint_move_to(paint, x1, y1);
    tn_paint_line_to(paint, x2, y2);
    tn_paint_line_width(paint, 0.6);
    tn_paint_stroke(paint);
    tn_paint_restore(paint);
}

/* A head at (x, y) that points to the left or right. */
static void arrow_head(tn_paint *paint, double x, double y, double direction)
{
    tn_paint_move_to(paint, x, y);
    tn_paint_line_to(paint, x - direction * 5, y - 2.6);
    tn_paint_line_to(paint, x - direction * 5, y + 2.6);
    tn_paint_close_path(paint);
    tn_paint_fill(paint);
}

void tn_draw_rule_arrow(tn_paint *paint, double from, double to, double y)
{
    tn_paint_move_to(paint, from, y);
    tn_paint_line_to(paint, to, y);
    tn_paint_line_width(paint, 0.8);
    tn_paint_stroke(paint);
    arrow_head(paint, to, y, to > from ? 1 : -1);
}

void tn_draw_neighbour_sign(tn_paint *paint, double x, double y)
{
    tn_paint_rectangle(paint, x, y, 5, 7.5);
    tn_paint_rectangle(paint, x + 5, y, 5, 7.5);
    tn_paint_line_width(paint, 0.9);
    tn_paint_stroke(paint);
}

void tn_draw_symmetric_sign(tn_paint *paint, double x, double y)
{
    tn_paint_face(paint, TN_RULE_SIGN_SIZE, true);
    tn_type_line(paint, x + 2, y + 9.5, TN_ALIGN_LEFT, "or");
    tn_draw_rule_arrow(paint, x + 7, x + 15, y);
    tn_draw_rule_arrow(paint, x + 7, x - 1, y);
}

void tn_draw_plan_end(tn_paint *paint, double x, double y, double height, bool left)
{
    double wall = left ? x + TN_RULE_END_WIDTH - 2 : x + 2, out = left ? -5 : 5;
    tn_paint_move_to(paint, wall, y);
    tn_paint_line_to(paint, wall, y + height);
    tn_paint_line_width(paint, 2.2);
    tn_paint_stroke(paint);
    for (double at = y + 3; at < y + height - 1; at += 5) {
        tn_paint_move_to(paint, wall, at);
        tn_paint_line_to(paint, wall + out, at + 4);
    }
    tn_paint_line_width(paint, 0.5);
    tn_paint_stroke(paint);
}

void tn_draw_check_mark(tn_paint *paint, double x, double y)
{
    tn_paint_move_to(paint, x - 4, y + 3);
    tn_paint_line_to(paint, x - 1, y + 6.5);
    tn_paint_line_to(paint, x + 5, y - 1);
    tn_paint_line_width(paint, 1.4);
    tn_paint_stroke(paint);
}

void tn_draw_tag(tn_paint *paint, const char *name, double x, double y, tn_size s)
{
    double r = 6;
    tn_paint_new_sub_path(paint);
    tn_paint_arc(paint, x + s.width - 2 - r, y + 2 + r, r, -1.5707963, 0);
    tn_paint_arc(paint, x + s.width - 2 - r, y + s.height - 2 - r, r, 0, 1.5707963);
    tn_paint_arc(paint, x + 2 + r, y + s.height - 2 - r, r, 1.5707963, 3.1415927);
    tn_paint_arc(paint, x + 2 + r, y + 2 + r, r, 3.1415927, 4.712389);
    tn_paint_close_path(paint);
    tn_paint_line_width(paint, 0.9);
    tn_paint_stroke(paint);
    tn_paint_face(paint, TN_RULE_SIGN_SIZE, true);
    tn_type_line(paint, x + s.width / 2, y + s.height / 2 + 3, TN_ALIGN_CENTRE, name);
}

void tn_draw_optional(tn_paint *paint, double x, double y, tn_size s)
{
    static const double dashes[] = {2, 2};
    tn_paint_save(paint);
    tn_paint_dash(paint, dashes, 2, 0);
    tn_paint_rectangle(paint, x + 1, y + 1, s.width - 2, s.height - 2);
    tn_paint_line_width(paint, 0.8);
    tn_paint_stroke(paint);
    tn_paint_restore(paint);
    tn_paint_face(paint, TN_RULE_SIGN_SIZE - 1.5, false);
    tn_type_line(paint, x + s.width / 2, y + 9, TN_ALIGN_CENTRE, "or none");
}

#define TRAY_WIDTH 34.0
#define SPINE_HEIGHT 30.0
#define BAND_HEIGHT 18.0
#define MARK_ROOM 15.0 /* on both sides of the tray: the public end */
#define SIDE_ROOM 4.0  /* where there is no such mark */
#define DEPTH_GAP 3.0
#define TEXT_SIZE 6.0
#define TEXT_LEADING 7.6
#define WIDTH_ROOM 13.0
#define LABEL_SIZE 6.6
#define LABEL_LEADING 9.0
#define LABEL_PADDING 6.0
#define ITEM_MAX 160
#define FILLS_MAX 8 /* of a zone that are drawn */
#define PI 3.14159265358979323846
#define SIGN_SIDE 12.0 /* of the signs within the spine, to be clicked on */
#define DEPTH_SIDE 8.0

static bool allows(const tn_draw_roles *roles, uint32_t spec, uint32_t field, uint32_t value)
{
    uint32_t bit = roles->schema->value_start[field] + value;
    return tn_spec_word(roles->schema->module, spec, bit / 64) >> (bit % 64) & 1;
}

static uint32_t allowed(const tn_draw_roles *roles, uint32_t spec, uint32_t field)
{
    uint32_t count = 0;
    for (uint32_t v = 0; v < roles->schema->fields[field].value_count; v++)
        count += allows(roles, spec, field, v);
    return count;
}

static bool is_free(const tn_draw_roles *roles, uint32_t spec, uint32_t field)
{
    return field == TN_NO_FIELD || allowed(roles, spec, field) == roles->schema->fields[field].value_count;
}

static const tn_value_record *value_at(const tn_draw_roles *roles, uint32_t field, uint32_t value)
{
    return &roles->schema->values[roles->schema->value_start[field] + value];
}

/* Appends what fits. */
static void say(char text[ITEM_MAX], const char *more)
{
    size_t used = strlen(text);
    snprintf(text + used, ITEM_MAX - used, "%s", more);
}

/* "8' or 12'"; of names, where that is shorter, "not end". */
static void list_values(const tn_draw_roles *roles, uint32_t spec, uint32_t field, char text[ITEM_MAX])
{
    uint32_t count = roles->schema->fields[field].value_count, some = allowed(roles, spec, field);
    bool other = count - some < some && roles->schema->fields[field].kind != TN_FIELD_LENGTH;
    text[0] = '\0';
    if (other)
        say(text, "not ");
    bool first = true;
    for (uint32_t v = 0; v < count; v++) {
        if (allows(roles, spec, field, v) == other)
            continue;
        say(text, first ? "" : " or ");
        say(text, tn_text(roles->schema->module, value_at(roles, field, v)->spelling));
        first = false;
    }
    if (some == 0)
        snprintf(text, ITEM_MAX, "none");
}

/* "storeys two or three", "passage", "not passage". */
static void field_text(const tn_draw_roles *roles, uint32_t spec, uint32_t field, char text[ITEM_MAX])
{
    const tn_field_record *record = &roles->schema->fields[field];
    const char *name = tn_text(roles->schema->module, record->name);
    char values[ITEM_MAX];
    if (record->kind == TN_FIELD_FLAG && allowed(roles, spec, field) == 1) {
        snprintf(text, ITEM_MAX, "%s%s", allows(roles, spec, field, 1) ? "" : "not ", name);
        return;
    }
    list_values(roles, spec, field, values);
    snprintf(text, ITEM_MAX, "%.60s ", name);
    say(text, values);
}

/* ---- the sheet's colours: what the tray is for */

enum { TONES_MAX = 3 }; /* of a field, side by side; more say nothing at a glance */

/* Does the specifier say in few values what the field is? */
static bool is_told(const tn_draw_roles *roles, uint32_t spec, uint32_t field)
{
    return field != TN_NO_FIELD && !is_free(roles, spec, field) && allowed(roles, spec, field) >= 1 &&
           allowed(roles, spec, field) <= TONES_MAX;
}

/* As sheets colour and hatch a tray of that value; of a few values, each in its part. */
static void draw_tones(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, tn_draw_area at)
{
    uint32_t count = 0, field = roles->tone;
    for (uint32_t v = 0; is_told(roles, spec, field) && v < roles->schema->fields[field].value_count; v++) {
        double wide = at.width / allowed(roles, spec, field);
        if (allows(roles, spec, field, v))
            tn_draw_tone(paint, roles, v, at.x + wide * count++, at.y, wide, at.height);
    }
    field = roles->hatch;
    for (uint32_t v = 0; is_told(roles, spec, field) && v < roles->schema->fields[field].value_count; v++)
        if (allows(roles, spec, field, v) && allowed(roles, spec, field) == 1)
            tn_draw_hatch(paint, roles, v, at.x, at.y, at.width, at.height);
}

/* ---- what is clicked on */

/* Begins the sign of a field, which can be clicked on where nothing is drawn, too. */
static void begin_sign(tn_paint *paint, bool signs, tn_paint_subject subject, uint32_t field, tn_draw_area area)
{
    if (!signs || field == TN_NO_FIELD)
        return;
    tn_paint_group_begin(paint, subject, field);
    tn_paint_target(paint, area.x, area.y, area.width, area.height);
}

static void end_sign(tn_paint *paint, bool signs, uint32_t field)
{
    if (signs && field != TN_NO_FIELD)
        tn_paint_group_end(paint);
}

/* ---- zones */

/* The allowed depths of one fill of a zone: "4' or 8'", or nothing where all are. */
static void depth_text(const tn_draw_roles *roles, uint32_t spec, uint32_t field, uint32_t fill, char text[ITEM_MAX])
{
    const tn_module *module = roles->schema->module;
    bool all = true, first = true;
    text[0] = '\0';
    for (uint32_t v = 0; v < roles->schema->fields[field].value_count; v++) {
        const tn_value_record *value = value_at(roles, field, v);
        if (strcmp(tn_text(module, value->name), tn_text(module, value_at(roles, field, fill)->name)) != 0)
            continue;
        if (!allows(roles, spec, field, v)) {
            all = false;
            continue;
        }
        say(text, first ? "" : " or ");
        say(text, tn_text(module, value->measure));
        first = false;
    }
    if (all)
        text[0] = '\0';
}

/* The fills of a zone that a specifier allows: the first allowed value of each. */
static uint32_t list_fills(const tn_draw_roles *roles, uint32_t spec, uint32_t field, uint32_t fills[FILLS_MAX])
{
    const tn_module *module = roles->schema->module;
    uint32_t count = 0;
    for (uint32_t v = 0; v < roles->schema->fields[field].value_count && count < FILLS_MAX; v++) {
        bool known = !allows(roles, spec, field, v);
        for (uint32_t i = 0; i < count; i++)
            known = known || strcmp(tn_text(module, value_at(roles, field, fills[i])->name),
                                    tn_text(module, value_at(roles, field, v)->name)) == 0;
        if (!known)
            fills[count++] = v;
    }
    return count;
}

/* The depths of the fills once where all have the same, or those of each: "dense 4', empty". */
static void zone_text(const tn_draw_roles *roles, uint32_t spec, uint32_t field, char text[ITEM_MAX])
{
    uint32_t fills[FILLS_MAX], count = list_fills(roles, spec, field, fills);
    char depths[ITEM_MAX], first[ITEM_MAX] = "";
    bool same = true;
    text[0] = '\0';
    if (is_free(roles, spec, field))
        return;
    for (uint32_t i = 0; i < count; i++) {
        depth_text(roles, spec, field, fills[i], depths);
        same = same && (i == 0 || strcmp(depths, first) == 0);
        if (i == 0)
            snprintf(first, sizeof first, "%s", depths);
    }
    if (same)
        say(text, first);
    for (uint32_t i = 0; !same && i < count; i++) {
        depth_text(roles, spec, field, fills[i], depths);
        say(text, i ? ", " : "");
        say(text, tn_text(roles->schema->module, value_at(roles, field, fills[i])->name));
        say(text, *depths ? " " : "");
        say(text, depths);
    }
}

/* Is every fill allowed, of whatever depth? */
static bool any_fill(const tn_draw_roles *roles, uint32_t spec, uint32_t field)
{
    const tn_module *module = roles->schema->module;
    uint32_t fills[FILLS_MAX], count = list_fills(roles, spec, field, fills);
    for (uint32_t v = 0; v < roles->schema->fields[field].value_count; v++) {
        bool known = false;
        for (uint32_t i = 0; i < count && !known; i++)
            known = strcmp(tn_text(module, value_at(roles, field, fills[i])->name),
                           tn_text(module, value_at(roles, field, v)->name)) == 0;
        if (!known)
            return false;
    }
    return true;
}

/* Dotted, with nothing in it but what the tray is for: any fill will do. */
static void draw_any(tn_paint *paint, bool toned, double x, double y, double width, double height)
{
    static const double dots[] = {1, 2};
    tn_paint_save(paint);
    tn_paint_rectangle(paint, x, y, width, height);
    tn_paint_colour(paint, 0.94, 0.94, 0.94);
    if (!toned)
        tn_paint_fill_keep(paint);
    tn_paint_colour(paint, 0, 0, 0);
    tn_paint_dash(paint, dots, 2, 0);
    tn_paint_line_width(paint, 0.5);
    tn_paint_stroke(paint);
    tn_paint_restore(paint);
}

/* A circle struck through: nothing is there. */
static void draw_absent(tn_paint *paint, double x, double y, double width, double height)
{
    double cx = x + width / 2, cy = y + height / 2, r = 3.6;
    tn_paint_new_sub_path(paint);
    tn_paint_arc(paint, cx, cy, r, 0, 2 * PI);
    tn_paint_move_to(paint, cx - r, cy + r);
    tn_paint_line_to(paint, cx + r, cy - r);
    tn_paint_line_width(paint, 0.6);
    tn_paint_stroke(paint);
}

static void draw_fills(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, uint32_t field, tn_draw_area at)
{
    uint32_t fills[FILLS_MAX], count = list_fills(roles, spec, field, fills);
    bool any = any_fill(roles, spec, field), room = field == roles->bands[roles->spine];
    if (room)
        draw_tones(paint, roles, spec, at);
    if (any)
        draw_any(paint, room && is_told(roles, spec, roles->tone), at.x, at.y, at.width, at.height);
    double width = at.width / (count ? count : 1);
    for (uint32_t i = 0; i < count && !any; i++) {
        tn_fill_role role = (tn_fill_role)value_at(roles, field, fills[i])->role;
        if (role == TN_FILL_ABSENT)
            draw_absent(paint, at.x + width * i, at.y, width, at.height);
        else
            tn_draw_fill(paint, roles, roles->schema->value_start[field] + fills[i], at.x + width * i, at.y, width,
                         at.height);
    }
}

static void draw_zone(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, uint32_t field, double x, double y,
                      double height, bool signs)
{
    char text[ITEM_MAX];
    tn_draw_area area = {x, y, TRAY_WIDTH, height};
    begin_sign(paint, signs, TN_PAINT_ITEM, field, area);
    draw_fills(paint, roles, spec, field, area);
    end_sign(paint, signs, field);
    zone_text(roles, spec, field, text);
    tn_paint_face(paint, TEXT_SIZE, false);
    begin_sign(
        paint, signs, TN_PAINT_DEPTH, field,
        (tn_draw_area){x + TRAY_WIDTH - DEPTH_SIDE, y, DEPTH_SIDE + DEPTH_GAP + tn_type_width(paint, text), height});
    tn_type_line(paint, x + TRAY_WIDTH + DEPTH_GAP, y + height / 2 + 2, TN_ALIGN_LEFT, text);
    end_sign(paint, signs, field);
}

static double band_height(const tn_draw_roles *roles, uint32_t band)
{
    return band == roles->spine ? SPINE_HEIGHT : BAND_HEIGHT;
}

/* ---- marks */

static void strike(tn_paint *paint, double x, double y, double radius)
{
    tn_paint_move_to(paint, x - radius, y + radius);
    tn_paint_line_to(paint, x + radius, y - radius);
    tn_paint_line_width(paint, 0.9);
    tn_paint_stroke(paint);
}

static void draw_great_hall(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, double x, double y)
{
    if (is_free(roles, spec, roles->great_hall))
        return;
    tn_draw_hall_mark(paint, x, y, 6);
    if (!allows(roles, spec, roles->great_hall, 1))
        strike(paint, x, y, 7.5);
}

static void draw_public(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, double left, double y,
                        bool mirrored)
{
    if (is_free(roles, spec, roles->public_end))
        return;
    double x = mirrored ? left + TRAY_WIDTH + 11 : left - 3;
    tn_draw_public_mark(paint, x, y, mirrored ? -1 : 1, 0);
    if (!allows(roles, spec, roles->public_end, 1))
        strike(paint, mirrored ? x - 4 + 7 : x - 4, y, 5.5);
}

/* A bar for each storey, one above the other; of several numbers the highest, with the words. */
static void draw_levels(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, double left, double y,
                        double height)
{
    if (is_free(roles, spec, roles->level))
        return;
    uint32_t most = 0, count = roles->schema->fields[roles->level].value_count;
    for (uint32_t v = 0; v < count; v++)
        most = allows(roles, spec, roles->level, v) ? v + 1 : most;
    if (allowed(roles, spec, roles->level) == 1 && most > 1) {
        tn_draw_level_mark(paint, most, false, (tn_draw_area){left, y, TRAY_WIDTH, height}, NULL, 0);
        return;
    }
    for (uint32_t i = 0; i < most; i++)
        tn_paint_rectangle(paint, left + TRAY_WIDTH / 2 - 5, y + height - 7 - 5 * i, 10, 3);
    tn_paint_line_width(paint, 0.7);
    tn_paint_stroke(paint);
}

static void draw_width(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, double x, double y)
{
    char text[ITEM_MAX];
    if (is_free(roles, spec, roles->length))
        return;
    list_values(roles, spec, roles->length, text);
    for (int end = 0; end < 2; end++) {
        tn_paint_move_to(paint, x + end * TRAY_WIDTH, y + 1.5);
        tn_paint_line_to(paint, x + end * TRAY_WIDTH, y + 5.5);
    }
    tn_paint_move_to(paint, x, y + 3.5);
    tn_paint_line_to(paint, x + TRAY_WIDTH, y + 3.5);
    tn_paint_weight(paint, TN_WEIGHT_HATCH);
    tn_paint_stroke(paint);
    tn_paint_face(paint, TEXT_SIZE, true);
    tn_type_line(paint, x + TRAY_WIDTH / 2, y + 11.5, TN_ALIGN_CENTRE, text);
}

/* ---- what is written */

/* Is the field's restriction written out? */
static bool is_written(const tn_draw_roles *roles, uint32_t spec, uint32_t field)
{
    return !is_free(roles, spec, field) && (!roles->to_scale || tn_draw_written(roles, field));
}

/* What the tray is for is written first, in bold, as sheets write it; then the other fields in their order. Field
 * number `i` of these. */
static uint32_t written_field(const tn_draw_roles *roles, uint32_t i)
{
    if (roles->text == TN_NO_FIELD || i > roles->text)
        return i;
    return i == 0 ? roles->text : i - 1;
}

/* Its words: "kitchen or bath", "storeys two or three"; and the lettering for them. */
static void write_field(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, uint32_t field, char text[ITEM_MAX])
{
    bool head = field == roles->text;
    tn_paint_face(paint, roles->to_scale ? TEXT_SIZE : LABEL_SIZE, head);
    if (head)
        list_values(roles, spec, field, text);
    else
        field_text(roles, spec, field, text);
}

static double written_width(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, uint32_t *lines)
{
    double width = 0;
    *lines = 0;
    for (uint32_t f = 0; f < roles->schema->field_count; f++) {
        char text[ITEM_MAX];
        if (!is_written(roles, spec, f))
            continue;
        write_field(paint, roles, spec, f, text);
        width = fmax(width, tn_type_width(paint, text));
        ++*lines;
    }
    return width;
}

static void write_fields(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, double x, double y, double leading,
                         bool signs)
{
    for (uint32_t i = 0; i < roles->schema->field_count; i++) {
        char text[ITEM_MAX];
        uint32_t f = written_field(roles, i);
        if (!is_written(roles, spec, f))
            continue;
        write_field(paint, roles, spec, f, text);
        double width = tn_type_width(paint, text);
        begin_sign(paint, signs, TN_PAINT_ITEM, f, (tn_draw_area){x - width / 2, y - leading + 2, width, leading});
        tn_type_line(paint, x, y, TN_ALIGN_CENTRE, text);
        end_sign(paint, signs, f);
        y += leading;
    }
}

/* ---- the symbol */

static double mark_room(const tn_draw_roles *roles, uint32_t spec)
{
    return is_free(roles, spec, roles->public_end) ? SIDE_ROOM : MARK_ROOM;
}

/* What is beside the tray's middle: its half, marks and depths, and the words below it, which are centred. */
typedef struct sides {
    double left, right;
} sides;

static sides sides_of(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, uint32_t *lines)
{
    char text[ITEM_MAX];
    double words = written_width(paint, roles, spec, lines), depths = 0, room = mark_room(roles, spec);
    for (uint32_t b = 0; b < roles->band_count; b++) {
        zone_text(roles, spec, roles->bands[b], text);
        depths = fmax(depths, *text ? tn_type_width(paint, text) + DEPTH_GAP : 0);
    }
    if (!is_free(roles, spec, roles->length)) {
        list_values(roles, spec, roles->length, text);
        tn_paint_face(paint, TEXT_SIZE, true);
        words = fmax(words, tn_type_width(paint, text));
    }
    words += 2 * SIDE_ROOM;
    return (sides){fmax(room + TRAY_WIDTH / 2, words / 2), fmax(TRAY_WIDTH / 2 + fmax(depths, room), words / 2)};
}

void tn_draw_spec_measure(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, double *width, double *height)
{
    uint32_t lines;
    if (!roles->to_scale) {
        double written = written_width(paint, roles, spec, &lines);
        *width = fmax(written, 18) + 2 * LABEL_PADDING;
        *height = fmax(lines, 1) * LABEL_LEADING + 2 * LABEL_PADDING - 2;
        return;
    }
    sides beside = sides_of(paint, roles, spec, &lines);
    *width = beside.left + beside.right;
    *height = WIDTH_ROOM + lines * TEXT_LEADING;
    for (uint32_t b = 0; b < roles->band_count; b++)
        *height += band_height(roles, b);
}

static void draw_frame(tn_paint *paint, double x, double y, double width, double height)
{
    tn_paint_rectangle(paint, x, y, width, height);
    tn_paint_weight(paint, TN_WEIGHT_CUT);
    tn_paint_stroke(paint);
}

static void draw_written(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, double x, double y, bool signs)
{
    double width, height;
    uint32_t lines;
    tn_draw_spec_measure(paint, roles, spec, &width, &height);
    draw_tones(paint, roles, spec, (tn_draw_area){x, y, width, height});
    draw_frame(paint, x, y, width, height);
    written_width(paint, roles, spec, &lines);
    double baseline = y + LABEL_PADDING + LABEL_LEADING - 3;
    tn_paint_face(paint, LABEL_SIZE, false);
    if (lines == 0)
        tn_type_line(paint, x + width / 2, baseline, TN_ALIGN_CENTRE, "any");
    write_fields(paint, roles, spec, x + width / 2, baseline, LABEL_LEADING, signs);
}

/* The marks of the spine: on its left side the public end, in its middle the great hall, below it the storeys. */
static void draw_marks(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, double left, double spine,
                       tn_spec_look look)
{
    double middle = left + TRAY_WIDTH / 2, half = SIGN_SIDE / 2, y = spine + SPINE_HEIGHT / 2;
    double side = look.mirrored ? left + TRAY_WIDTH - half : left - half;
    begin_sign(paint, look.signs, TN_PAINT_ITEM, roles->level,
               (tn_draw_area){middle - half, spine + SPINE_HEIGHT - SIGN_SIDE * 3 / 4, SIGN_SIDE, SIGN_SIDE * 3 / 4});
    draw_levels(paint, roles, spec, left, spine, SPINE_HEIGHT);
    end_sign(paint, look.signs, roles->level);
    begin_sign(paint, look.signs, TN_PAINT_ITEM, roles->great_hall,
               (tn_draw_area){middle - half, y - half, SIGN_SIDE, SIGN_SIDE});
    draw_great_hall(paint, roles, spec, middle, y);
    end_sign(paint, look.signs, roles->great_hall);
    begin_sign(paint, look.signs, TN_PAINT_ITEM, roles->public_end,
               (tn_draw_area){side, y - half, SIGN_SIDE, SIGN_SIDE});
    draw_public(paint, roles, spec, left, y, look.mirrored);
    end_sign(paint, look.signs, roles->public_end);
}

void tn_draw_spec(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, double x, double y, tn_spec_look look)
{
    if (!roles->to_scale) {
        draw_written(paint, roles, spec, x, y, look.signs);
        return;
    }
    uint32_t lines;
    double left = x + sides_of(paint, roles, spec, &lines).left - TRAY_WIDTH / 2, at = y, spine = y;
    for (uint32_t b = 0; b < roles->band_count; b++) {
        double height = band_height(roles, b);
        draw_zone(paint, roles, spec, roles->bands[b], left, at, height, look.signs);
        spine = b == roles->spine ? at : spine;
        at += height;
    }
    draw_marks(paint, roles, spec, left, spine, look);
    begin_sign(paint, look.signs, TN_PAINT_ITEM, roles->length, (tn_draw_area){left, at, TRAY_WIDTH, WIDTH_ROOM});
    draw_width(paint, roles, spec, left, at);
    end_sign(paint, look.signs, roles->length);
    write_fields(paint, roles, spec, left + TRAY_WIDTH / 2, at + WIDTH_ROOM + TEXT_LEADING - 2, TEXT_LEADING,
                 look.signs);
}

/* ---- a tray that has no symbol */

/* The next line of the words, copied as far as there is room; NULL: there is none. */
static const char *next_line(const char *words, char line[ITEM_MAX])
{
    size_t size = strcspn(words, "\n");
    snprintf(line, ITEM_MAX, "%.*s", (int)size, words);
    return words[size] ? words + size + 1 : NULL;
}

void tn_draw_label_measure(tn_paint *paint, const tn_draw_roles *roles, const char *words, double *width,
                           double *height)
{
    char line[ITEM_MAX];
    uint32_t lines = 0;
    double widest = 18;
    tn_paint_face(paint, roles->to_scale ? TEXT_SIZE : LABEL_SIZE, false);
    for (const char *rest = words; rest; lines++) {
        rest = next_line(rest, line);
        widest = fmax(widest, tn_type_width(paint, line));
    }
    *width = widest + 2 * LABEL_PADDING;
    *height = fmax(lines, 1) * LABEL_LEADING + 2 * LABEL_PADDING - 2;
}

void tn_draw_label(tn_paint *paint, const tn_draw_roles *roles, const char *words, double x, double y)
{
    char line[ITEM_MAX];
    double width, height, baseline = y + LABEL_PADDING + LABEL_LEADING - 3;
    tn_draw_label_measure(paint, roles, words, &width, &height);
    draw_frame(paint, x, y, width, height);
    tn_paint_face(paint, roles->to_scale ? TEXT_SIZE : LABEL_SIZE, false);
    for (const char *rest = words; rest; baseline += LABEL_LEADING) {
        rest = next_line(rest, line);
        tn_type_line(paint, x + width / 2, baseline, TN_ALIGN_CENTRE, line);
    }
}
