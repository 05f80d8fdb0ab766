/* Draws open plans. */
#include "runtime/plan/picture/draw_open.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"
#include "runtime/plan/match/parts.h"
#include "runtime/plan/picture/draw_rule_data.h"

#define MARGIN 26.0
#define TITLES 40.0 /* the titles' room */
#define TEXT 7.5
#define LEADING 11.0
#define FIELD_ROOM 15.0 /* a field's name */
#define CARD_GAP 18.0
#define ROW_GAP 26.0
#define SYMBOL_GAP 12.0 /* between a tray and its table */
#define GAP_WIDTH 26.0  /* of trays that are not written */
#define APART 10.0      /* between the columns of a table */
#define NUMBER_ROOM 14.0

/* A written tray, or a gap. */
typedef struct card {
    uint32_t spec;   /* SPEC record; TN_NO_RECORD: a gap */
    uint32_t number; /* of the written tray, from 0 */
    double symbol_width, symbol_height;
    double x, y; /* its upper left corner */
} card;

typedef struct picture {
    tn_paint *paint;
    const tn_schema *schema;
    const tn_drawn_open *open;
    tn_draw_roles roles;
    card *cards;
    double values, counts, bests; /* widths of the columns */
    double width;                 /* of a card */
    double symbols;               /* the tallest symbol */
    double height, wide;          /* of all */
} picture;

static const tn_drawn_choice *choice_at(const picture *p, uint32_t tray, uint32_t value)
{
    return &p->open->choices[(size_t)tray * p->schema->value_count + value];
}

static const char *spelling(const picture *p, uint32_t value)
{
    return tn_text(p->schema->module, p->schema->values[value].spelling);
}

static tn_status find_spec(const picture *p, uint32_t function, card *c, tn_error *error)
{
    tn_parts parts;
    tn_status status = tn_parts_read(p->schema->module, function, &parts, error);
    if (status == TN_OK && parts.parts[0].kind != TN_PART_TRAY)
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a tray of an open plan is not a tray specifier");
    if (status == TN_OK) {
        c->spec = parts.parts[0].spec;
        tn_draw_spec_measure(p->paint, &p->roles, c->spec, &c->symbol_width, &c->symbol_height);
    }
    tn_parts_clear(&parts);
    return status;
}

/* ---- layout */

static double table_height(const picture *p)
{
    return p->schema->field_count * FIELD_ROOM + p->schema->value_count * LEADING;
}

static double card_height(const picture *p)
{
    return NUMBER_ROOM + p->symbols + SYMBOL_GAP + table_height(p);
}

static void measure_columns(picture *p, uint32_t trays)
{
    tn_paint_face(p->paint, TEXT, false);
    for (uint32_t v = 0; v < p->schema->value_count; v++) {
        p->values = fmax(p->values, tn_type_width(p->paint, spelling(p, v)));
        for (uint32_t t = 0; t < trays; t++) {
            const tn_drawn_choice *choice = choice_at(p, t, v);
            p->counts = fmax(p->counts, tn_type_width(p->paint, choice->count));
            p->bests = choice->best ? fmax(p->bests, tn_type_width(p->paint, choice->best)) : p->bests;
        }
    }
    tn_paint_face(p->paint, TEXT - 1, false);
    if (p->open->best_name)
        p->bests = fmax(p->bests, tn_type_width(p->paint, p->open->best_name));
    p->width = p->values + APART + p->counts + (p->bests > 0 ? APART + p->bests : 0);
}

static double width_of(const picture *p, const card *c)
{
    return c->spec == TN_NO_RECORD ? GAP_WIDTH : p->width;
}

/* In rows, as text is. */
static void place_cards(picture *p)
{
    double x = MARGIN, y = MARGIN + TITLES;
    for (size_t i = 0; i < p->open->count; i++) {
        double width = width_of(p, &p->cards[i]);
        if (x > MARGIN && x + width > TN_DRAW_OPEN_WIDTH - MARGIN) {
            x = MARGIN;
            y += card_height(p) + ROW_GAP;
        }
        p->cards[i].x = x;
        p->cards[i].y = y;
        x += width + CARD_GAP;
        p->wide = fmax(p->wide, x - CARD_GAP + MARGIN);
    }
    p->height = y + card_height(p) + MARGIN;
    tn_paint_face(p->paint, 9, false);
    p->wide = fmax(p->wide, fmin(TN_DRAW_OPEN_WIDTH, tn_type_width(p->paint, p->open->about) + 2 * MARGIN + 10));
}

static tn_status lay_out(picture *p, tn_error *error)
{
    uint32_t trays = 0;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < p->open->count; i++) {
        card *c = &p->cards[i];
        *c = (card){.spec = TN_NO_RECORD};
        if (p->open->functions[i] == TN_NO_RECORD)
            continue;
        c->number = trays++;
        status = find_spec(p, p->open->functions[i], c, error);
        p->symbols = fmax(p->symbols, c->symbol_height);
    }
    measure_columns(p, trays);
    for (size_t i = 0; i < p->open->count; i++)
        p->width = fmax(p->width, p->cards[i].symbol_width);
    place_cards(p);
    return status;
}

/* ---- drawing */

static void ink(const picture *p, double grey)
{
    tn_paint_colour(p->paint, grey, grey, grey);
}

static void draw_choice(const picture *p, const card *c, uint32_t value, double y)
{
    const tn_drawn_choice *choice = choice_at(p, c->number, value);
    double baseline = y + LEADING - 3, right = c->x + p->width;
    if (choice->share > 0) {
        tn_paint_colour(p->paint, 0.80, 0.88, 0.76);
        tn_paint_rectangle(p->paint, c->x, y + 0.8, fmax(0.8, p->width * choice->share), LEADING - 1.6);
        tn_paint_fill(p->paint);
    }
    ink(p, choice->share > 0 ? 0 : 0.72);
    tn_paint_face(p->paint, TEXT, false);
    tn_type_line(p->paint, c->x + 2, baseline, TN_ALIGN_LEFT, spelling(p, value));
    if (choice->best)
        tn_type_line(p->paint, right, baseline, TN_ALIGN_RIGHT, choice->best);
    tn_type_line(p->paint, right - (p->bests > 0 ? p->bests + APART : 0), baseline, TN_ALIGN_RIGHT, choice->count);
}

static void draw_table(const picture *p, const card *c, double y)
{
    const tn_schema *schema = p->schema;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        ink(p, 0);
        tn_paint_face(p->paint, TEXT, true);
        tn_type_line(p->paint, c->x, y + FIELD_ROOM - 4, TN_ALIGN_LEFT,
                     tn_text(schema->module, schema->fields[f].name));
        tn_paint_face(p->paint, TEXT - 1, false);
        ink(p, 0.4);
        if (f == 0 && p->open->best_name)
            tn_type_line(p->paint, c->x + p->width, y + FIELD_ROOM - 4, TN_ALIGN_RIGHT, p->open->best_name);
        tn_paint_move_to(p->paint, c->x, y + FIELD_ROOM - 1);
        tn_paint_line_to(p->paint, c->x + p->width, y + FIELD_ROOM - 1);
        tn_paint_weight(p->paint, TN_WEIGHT_HATCH);
        tn_paint_stroke(p->paint);
        y += FIELD_ROOM;
        for (uint32_t v = schema->value_start[f]; v < schema->value_start[f + 1]; v++, y += LEADING)
            draw_choice(p, c, v, y);
    }
}

/* Dots where any number of trays may stand. */
static void draw_gap(const picture *p, const card *c)
{
    double y = c->y + NUMBER_ROOM + p->symbols / 2;
    ink(p, 0);
    for (int i = -1; i <= 1; i++) {
        tn_paint_arc(p->paint, c->x + GAP_WIDTH / 2 + 7 * i, y, 1.6, 0, 2 * 3.14159265358979323846);
        tn_paint_fill(p->paint);
    }
}

static void draw_tray(const picture *p, const card *c)
{
    char number[24];
    tn_paint_target(p->paint, c->x, c->y, p->width, card_height(p));
    ink(p, 0);
    snprintf(number, sizeof number, "%u", c->number + 1);
    tn_paint_face(p->paint, TEXT, true);
    tn_type_line(p->paint, c->x, c->y + TEXT, TN_ALIGN_LEFT, number);
    tn_draw_spec(p->paint, &p->roles, c->spec, c->x + (p->width - c->symbol_width) / 2,
                 c->y + NUMBER_ROOM + (p->symbols - c->symbol_height) / 2, (tn_spec_look){0});
    draw_table(p, c, c->y + NUMBER_ROOM + p->symbols + SYMBOL_GAP);
}

static void draw_card(const picture *p, const card *c)
{
    if (c->spec == TN_NO_RECORD) {
        draw_gap(p, c);
        return;
    }
    tn_paint_group_begin(p->paint, TN_PAINT_TRAY, c->number);
    draw_tray(p, c);
    tn_paint_group_end(p->paint);
}

static void draw_titles(const picture *p)
{
    double width = p->wide - 2 * MARGIN;
    ink(p, 0);
    tn_paint_face(p->paint, 13, true);
    double used = tn_type_width(p->paint, p->open->title) + 8;
    tn_type_fit(p->paint, MARGIN, MARGIN + 6, TN_ALIGN_LEFT, width, p->open->title);
    tn_paint_face(p->paint, 9, false);
    if (used < width)
        tn_type_fit(p->paint, MARGIN + used, MARGIN + 6, TN_ALIGN_LEFT, width - used, p->open->doc);
    ink(p, 0.3);
    tn_type_fit(p->paint, MARGIN, MARGIN + 21, TN_ALIGN_LEFT, width, p->open->about);
}

static tn_status draw(picture *p, tn_picture *to, tn_error *error)
{
    tn_canvas *canvas = NULL;
    if (p->height > TN_DRAW_RULE_SIDE_MAX) {
        tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE, "the picture would be %.0f points high; the limit is %.0f",
                p->height, TN_DRAW_RULE_SIDE_MAX);
        tn_error_help(error, "write `...` for some of the trays");
        return TN_LIMIT;
    }
    tn_status status = tn_canvas_begin(to, p->wide, p->height, p->open->title, &canvas, error);
    if (status != TN_OK)
        return status;
    p->paint = tn_canvas_paint(canvas);
    draw_titles(p);
    for (size_t i = 0; i < p->open->count; i++)
        draw_card(p, &p->cards[i]);
    status = tn_canvas_commit(canvas, error);
    tn_canvas_free(canvas);
    return status;
}

tn_status tn_open_plan_draw(const tn_schema *schema, const tn_drawn_open *open, tn_picture *to, tn_error *error)
{
    picture p = {.paint = tn_paint_new(NULL), .schema = schema, .open = open};
    tn_paint *scratch = p.paint;
    tn_draw_roles_find(schema, &p.roles);
    p.cards = calloc(open->count + 1, sizeof *p.cards);
    tn_status status = scratch && p.cards ? lay_out(&p, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = draw(&p, to, error);
    free(p.cards);
    tn_paint_free(scratch);
    return status;
}
