/* The strip along the bottom of a sheet: a key tray, the legend, the scale, the title and how the sheet was made. All
 * words are the schema's own. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "runtime/base/length.h"
#include "runtime/draw/scales.h"
#include "runtime/draw/type.h"
#include "runtime/plan/picture/draw_parts.h"

#define HEADING_SIZE 5.2
#define LABEL_SIZE 6.4
#define DOC_SIZE 5.6
#define TITLE_SIZE 15.0
#define KEY_WIDTH 132.0
#define TITLE_WIDTH 300.0
#define SCALE_WIDTH 128.0
#define PADDING 12.0
#define ENTRY_HEIGHT 15.5
#define SWATCH_WIDTH 20.0
#define SWATCH_HEIGHT 10.0
#define COLUMN_WIDTH 200.0 /* of the legend, about */

/* The strip being drawn. */
typedef struct strip {
    tn_paint *paint;
    const tn_draw_roles *roles;
    double x, y; /* upper left corner of the section being drawn */
    double width;
    unsigned entry, rows; /* of the legend */
} strip;

static const char *text_at(const strip *s, tn_string string)
{
    return tn_text(s->roles->schema->module, string);
}

/* What the strip says. What it shows is on the layers that it has in plans. */
static void begin_words(const strip *s)
{
    tn_paint_layer(s->paint, TN_LAYER_TITLE);
}

static void heading(const strip *s, const char *text)
{
    begin_words(s);
    tn_paint_face(s->paint, HEADING_SIZE, true);
    tn_type_line(s->paint, s->x + PADDING, s->y + 13, TN_ALIGN_LEFT, text);
}

static void divider(const strip *s, double x)
{
    begin_words(s);
    tn_paint_move_to(s->paint, x, s->y);
    tn_paint_line_to(s->paint, x, s->y + TN_STRIP_HEIGHT);
    tn_paint_weight(s->paint, TN_WEIGHT_THIN);
    tn_paint_stroke(s->paint);
}

/* The value that stands for a band in the key: the deepest, where the spine is void if it can be. */
static const tn_value_record *key_value(const strip *s, uint32_t field)
{
    const tn_schema *schema = s->roles->schema;
    const tn_value_record *best = NULL;
    for (uint32_t v = schema->value_start[field]; v < schema->value_start[field + 1]; v++) {
        const tn_value_record *value = &schema->values[v];
        bool better = !best || value->length > best->length ||
                      (value->length == best->length && value->role == TN_FILL_VOID && best->role == TN_FILL_SOLID);
        if (value->role != TN_FILL_ABSENT && better)
            best = value;
    }
    return best;
}

/* One tray with all of its bands, each named at its side. */
static void draw_key(const strip *s)
{
    const tn_draw_roles *roles = s->roles;
    const double room = TN_STRIP_HEIGHT - 36, tray = 34;
    double depth = 0, x = s->x + PADDING + 1, y = s->y + 22;
    for (uint32_t b = 0; b < roles->band_count; b++) {
        const tn_value_record *value = key_value(s, roles->bands[b]);
        depth += value ? (double)value->length : 0;
    }
    heading(s, "ONE TRAY");
    if (depth <= 0)
        return;
    for (uint32_t b = 0; b < roles->band_count; b++) {
        const tn_value_record *value = key_value(s, roles->bands[b]);
        if (!value)
            continue;
        double height = (double)value->length / depth * room;
        tn_draw_fill(s->paint, roles, (uint32_t)(value - roles->schema->values), x, y, tray, height);
        begin_words(s);
        tn_paint_move_to(s->paint, x + tray + 4, y + height / 2);
        tn_paint_line_to(s->paint, x + tray + 12, y + height / 2);
        tn_paint_weight(s->paint, TN_WEIGHT_HATCH);
        tn_paint_stroke(s->paint);
        tn_paint_face(s->paint, LABEL_SIZE, false);
        tn_type_fit(s->paint, x + tray + 15, y + height / 2 + 2.3, TN_ALIGN_LEFT, KEY_WIDTH - tray - 15 - 2 * PADDING,
                    text_at(s, roles->schema->fields[roles->bands[b]].name));
        y += height;
    }
    tn_paint_rectangle(s->paint, x, s->y + 22, tray, room);
    tn_paint_layer(s->paint, TN_LAYER_WALL_CUT);
    tn_paint_weight(s->paint, TN_WEIGHT_CUT);
    tn_paint_stroke(s->paint);
}

/* The place of the next entry's swatch; false where the legend is full. */
static bool next_entry(strip *s, double *x, double *y, double *width)
{
    unsigned column = s->entry / s->rows, row = s->entry % s->rows,
             columns = (unsigned)fmax(2, (s->width - PADDING) / COLUMN_WIDTH);
    double column_width = (s->width - PADDING) / columns;
    if (column >= columns)
        return false;
    s->entry++;
    *x = s->x + PADDING + column * column_width;
    *y = s->y + 20 + row * ENTRY_HEIGHT;
    *width = column_width - SWATCH_WIDTH - PADDING;
    return true;
}

static void label(const strip *s, double x, double y, double width, const char *name, const char *doc)
{
    begin_words(s);
    x += SWATCH_WIDTH + 6;
    tn_paint_face(s->paint, LABEL_SIZE, true);
    double used = tn_type_width(s->paint, name) + 4;
    tn_type_fit(s->paint, x, y + 7.3, TN_ALIGN_LEFT, width, name);
    tn_paint_face(s->paint, DOC_SIZE, false);
    if (used < width)
        tn_type_fit(s->paint, x + used, y + 7.3, TN_ALIGN_LEFT, width - used, doc);
}

/* Is `value` the first one of its name and role, over all bands? */
static bool is_first_fill(const strip *s, uint32_t band, uint32_t v)
{
    const tn_schema *schema = s->roles->schema;
    const tn_value_record *value = &schema->values[v];
    for (uint32_t b = 0; b <= band; b++) {
        uint32_t field = s->roles->bands[b];
        for (uint32_t u = schema->value_start[field]; u < schema->value_start[field + 1]; u++) {
            if (u == v)
                return true;
            if (schema->values[u].role == value->role &&
                strcmp(text_at(s, schema->values[u].name), text_at(s, value->name)) == 0)
                return false;
        }
    }
    return true;
}

/* Says in which bands a fill occurs: "machine, body". */
static void name_bands(const strip *s, const tn_value_record *value, char *text, size_t size)
{
    const tn_schema *schema = s->roles->schema;
    size_t used = 0;
    text[0] = '\0';
    for (uint32_t b = 0; b < s->roles->band_count && used + 2 < size; b++) {
        uint32_t field = s->roles->bands[b];
        bool has = false;
        for (uint32_t u = schema->value_start[field]; u < schema->value_start[field + 1]; u++)
            has |= schema->values[u].role == value->role &&
                   strcmp(text_at(s, schema->values[u].name), text_at(s, value->name)) == 0;
        if (has)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                     text_at(s, schema->fields[field].name));
    }
}

static void fill_entries(strip *s)
{
    const tn_schema *schema = s->roles->schema;
    for (uint32_t b = 0; b < s->roles->band_count; b++) {
        uint32_t field = s->roles->bands[b];
        for (uint32_t v = schema->value_start[field]; v < schema->value_start[field + 1]; v++) {
            const tn_value_record *value = &schema->values[v];
            char bands[128];
            double x, y, width;
            if (value->role == TN_FILL_ABSENT || value->length == 0 || !is_first_fill(s, b, v) ||
                !next_entry(s, &x, &y, &width))
                continue;
            tn_draw_fill(s->paint, s->roles, v, x, y, SWATCH_WIDTH, SWATCH_HEIGHT);
            name_bands(s, value, bands, sizeof bands);
            label(s, x, y, width, text_at(s, value->name), value->doc ? text_at(s, value->doc) : bands);
        }
    }
}

static void level_entries(strip *s)
{
    const tn_schema *schema = s->roles->schema;
    uint32_t field = s->roles->level;
    for (uint32_t v = schema->value_start[field] + 1; v < schema->value_start[field + 1]; v++) {
        double x, y, width;
        if (!next_entry(s, &x, &y, &width))
            return;
        tn_paint_rectangle(s->paint, x, y, SWATCH_WIDTH, SWATCH_HEIGHT);
        tn_paint_layer(s->paint, TN_LAYER_AREA);
        tn_paint_weight(s->paint, TN_WEIGHT_HATCH);
        tn_paint_stroke(s->paint);
        tn_draw_level_mark(s->paint, v - schema->value_start[field] + 1, false,
                           (tn_draw_area){x, y, SWATCH_WIDTH, SWATCH_HEIGHT}, NULL, 0);
        tn_string doc = schema->values[v].doc ? schema->values[v].doc : schema->fields[field].doc;
        label(s, x, y, width, text_at(s, schema->values[v].name), text_at(s, doc ? doc : schema->fields[field].name));
    }
}

static void flag_entry(strip *s, uint32_t field, bool hall)
{
    double x, y, width;
    if (field == TN_NO_FIELD || !next_entry(s, &x, &y, &width))
        return;
    if (hall)
        tn_draw_hall_mark(s->paint, x + SWATCH_WIDTH / 2, y + SWATCH_HEIGHT / 2, 4.4);
    else
        tn_draw_public_mark(s->paint, x + SWATCH_WIDTH / 2 + 3.5, y + SWATCH_HEIGHT / 2, 1, 0);
    const tn_field_record *record = &s->roles->schema->fields[field];
    label(s, x, y, width, text_at(s, record->name), text_at(s, record->doc));
}

/* The values that tones or hatches tell apart. */
static void choice_entries(strip *s, uint32_t field, bool tone)
{
    const tn_schema *schema = s->roles->schema;
    double x, y, width;
    if (field == TN_NO_FIELD)
        return;
    for (uint32_t v = 0; v < schema->fields[field].value_count && next_entry(s, &x, &y, &width); v++) {
        const tn_value_record *value = &schema->values[schema->value_start[field] + v];
        (tone ? tn_draw_tone : tn_draw_hatch)(s->paint, s->roles, v, x, y, SWATCH_WIDTH, SWATCH_HEIGHT);
        tn_paint_rectangle(s->paint, x, y, SWATCH_WIDTH, SWATCH_HEIGHT);
        tn_paint_layer(s->paint, TN_LAYER_AREA);
        tn_paint_weight(s->paint, TN_WEIGHT_HATCH);
        tn_paint_stroke(s->paint);
        label(s, x, y, width, text_at(s, value->name),
              value->doc ? text_at(s, value->doc) : text_at(s, schema->fields[field].name));
    }
}

static void draw_legend(strip *s)
{
    s->rows = (unsigned)((TN_STRIP_HEIGHT - 24) / ENTRY_HEIGHT);
    heading(s, "LEGEND");
    choice_entries(s, s->roles->tone, true);
    choice_entries(s, s->roles->hatch, false);
    fill_entries(s);
    if (s->roles->level != TN_NO_FIELD)
        level_entries(s);
    flag_entry(s, s->roles->public_end, false);
    flag_entry(s, s->roles->great_hall, true);
}

/* For a table: the fields with what they mean. */
static void list_fields(strip *s)
{
    const tn_schema *schema = s->roles->schema;
    s->rows = (unsigned)((TN_STRIP_HEIGHT - 24) / 10);
    heading(s, "FIELDS");
    double column = (s->width - PADDING) / (schema->field_count > s->rows ? 2 : 1);
    for (uint32_t f = 0; f < schema->field_count && f < 2 * s->rows; f++) {
        double x = s->x + PADDING + (f / s->rows) * column, baseline = s->y + 26 + (f % s->rows) * 10;
        const char *name = text_at(s, schema->fields[f].name);
        tn_paint_face(s->paint, LABEL_SIZE, true);
        double used = tn_type_width(s->paint, name) + 5;
        tn_type_fit(s->paint, x, baseline, TN_ALIGN_LEFT, column - PADDING, name);
        tn_paint_face(s->paint, DOC_SIZE, false);
        if (used < column - PADDING)
            tn_type_fit(s->paint, x + used, baseline, TN_ALIGN_LEFT, column - PADDING - used,
                        text_at(s, schema->fields[f].doc));
    }
}

/* The step of the scale bar: the schema's smallest length, or where that is longer than the bar, a foot or metre, or a
 * part of one. */
static int64_t bar_step(const tn_draw_roles *roles, double longest)
{
    static const int64_t metric[] = {1000000000, 100000000, 10000000, 1000000},
                         feet[] = {TN_FOOT_NM, TN_INCH_NM, TN_INCH_NM / 8};
    const tn_schema *schema = roles->schema;
    int64_t step = INT64_MAX;
    for (uint32_t v = schema->value_start[roles->length]; v < schema->value_start[roles->length + 1]; v++)
        if (schema->values[v].length > 0 && schema->values[v].length < step)
            step = schema->values[v].length;
    bool in_feet = roles->style == TN_STYLE_FEET;
    size_t count = in_feet ? sizeof feet / sizeof *feet : sizeof metric / sizeof *metric;
    for (size_t i = 0; i < count && (double)step > longest; i++)
        step = in_feet ? feet[i] : metric[i];
    return step;
}

/* The scale in words, and a bar of four steps at most. */
static void draw_scale(const strip *s, uint32_t scale, double zoom)
{
    const tn_draw_roles *roles = s->roles;
    char text[64];
    heading(s, "SCALE");
    tn_scale_write(scale, roles->style != TN_STYLE_FEET, text, sizeof text);
    tn_paint_face(s->paint, 9, false);
    tn_type_line(s->paint, s->x + PADDING, s->y + 32, TN_ALIGN_LEFT, text);
    double room = SCALE_WIDTH - 2 * PADDING - 4;
    int64_t step = bar_step(roles, room / (TN_POINTS_PER_NM / scale / zoom));
    double width = (double)step * TN_POINTS_PER_NM / scale / zoom;
    int steps = (int)fmin(4, floor(room / width));
    double x = s->x + PADDING + 1, y = s->y + 48;
    tn_paint_face(s->paint, HEADING_SIZE, false);
    double free_from = x - 10;
    for (int i = 0; steps > 0 && i <= steps; i++) {
        tn_draw_length(roles, step * i, text, sizeof text);
        double half = tn_type_width(s->paint, text) / 2, at = x + width * i;
        if (at - half > free_from) {
            tn_type_line(s->paint, at, y + 11, TN_ALIGN_CENTRE, text);
            free_from = at + half + 2;
        }
        if (i == steps)
            break;
        tn_paint_rectangle(s->paint, at, y, width, 3.4);
        tn_paint_weight(s->paint, TN_WEIGHT_THIN);
        if (i % 2 == 0)
            tn_paint_fill_keep(s->paint);
        tn_paint_stroke(s->paint);
    }
}

static void draw_title(const strip *s, const tn_draw_options *options, size_t page, size_t pages)
{
    double x = s->x + PADDING, width = s->width - 2 * PADDING, y = s->y + 26;
    const char *title = options->title ? options->title : text_at(s, s->roles->schema->record->name);
    begin_words(s);
    tn_paint_face(s->paint, TITLE_SIZE, true);
    tn_type_fit(s->paint, x, y, TN_ALIGN_LEFT, width, title);
    y += 13;
    if (options->doc) {
        tn_paint_face(s->paint, 7, false);
        y += 9 * tn_type_paragraph(s->paint, x, y, width, 9, 2, options->doc);
    }
    tn_paint_move_to(s->paint, x, y - 2);
    tn_paint_line_to(s->paint, x + width, y - 2);
    tn_paint_weight(s->paint, TN_WEIGHT_HATCH);
    tn_paint_stroke(s->paint);
    y += 8;
    tn_paint_face(s->paint, DOC_SIZE, false);
    for (size_t i = 0; i < options->note_count && y < s->y + TN_STRIP_HEIGHT - 5; i++) {
        bool last = y + 8 >= s->y + TN_STRIP_HEIGHT - 5;
        tn_type_fit(s->paint, x, y, TN_ALIGN_LEFT, last && pages > 1 ? width - 40 : width, options->notes[i]);
        y += 8;
    }
    char text[64];
    snprintf(text, sizeof text, "%zu / %zu", page, pages);
    if (pages > 1)
        tn_type_line(s->paint, x + width, s->y + TN_STRIP_HEIGHT - 8, TN_ALIGN_RIGHT, text);
}

void tn_draw_strip(tn_paint *paint, const tn_draw_roles *roles, const tn_draw_options *options, uint32_t scale,
                   double zoom, size_t page, size_t pages, double width)
{
    double key = scale ? KEY_WIDTH : 0, bar = scale ? SCALE_WIDTH : 0,
           title = fmin(TITLE_WIDTH, (width - key - bar) * 0.5);
    strip s = {paint, roles, .width = width - key - bar - title};
    if (scale) {
        draw_key(&s);
        s.x += key;
        divider(&s, s.x);
        draw_legend(&s);
    } else if (roles->tone == TN_NO_FIELD) {
        list_fields(&s);
    } else {
        s.width /= 2;
        list_fields(&s);
        s.x += s.width;
        draw_legend(&s);
    }
    s.x += s.width;
    divider(&s, s.x);
    if (scale) {
        draw_scale(&s, scale, zoom);
        s.x += bar;
        divider(&s, s.x);
    }
    s.width = title;
    draw_title(&s, options, page, pages);
}
