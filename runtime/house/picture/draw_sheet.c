/* Puts drawings of a house on paper: chooses scale and paper, sets them in rows, and writes what they are. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/draw/scales.h"
#include "runtime/draw/type.h"
#include "runtime/house/picture/draw_parts.h"
#include "runtime/house/picture/draw_tables.h"

#define MARGIN 28.0
#define GAP 14.0
#define CAPTION 22.0
#define HEADING 24.0
#define NOTE_LEADING 13.0
#define NOTE_LINES 3u
#define LEGIBLE_METRIC 100u /* scales at which a plan of a house can be read: 1:100, 1/8" */
#define LEGIBLE_FEET 96u
#define TN_SECTIONS_MOST 26 /* they have letters */
#define FOOT_GAP 12.0
/* Where room is short, the scale of views in which little is measured is so much smaller. */
#define SMALLER 2u
#define VIEW_WIDTH 820.0 /* the most that one drawing takes, in points */
#define VIEW_HEIGHT 620.0

typedef struct sheet {
    const tn_house *house;
    const tn_house_drawing *drawing;
    tn_house_drawn *drawn; /* [drawing->count]; owned */
    bool metric;
    tn_length_style lengths;
    tn_section_place sections[TN_SECTIONS_MOST];
    tn_mark_style style;
    uint32_t scale;
    double points;        /* a nanometre, in points */
    uint32_t smaller;     /* how much smaller views in space and the plan of the roof are */
    double width, height; /* of the page */
    double foot;          /* room for tables, notes, the title block or the scale bar */
    tn_sheet_tables tables;
    tn_title_block block;
    char kinds[128], measures[64], said[256];
    size_t deep;  /* rows of the tables */
    double spare; /* height of the page that nothing needs */
} sheet;

tn_status tn_house_view_take(const tn_solids *solids, const tn_aspect *aspect, const tn_house *house,
                             tn_house_drawn *drawn, tn_watch *watch, tn_error *error)
{
    tn_display_list display = {0};
    tn_grouping grouping;
    drawn->form = house->form;
    const tn_grouping *by = drawn->outlines ? NULL : tn_house_grouping(house->form, aspect->kind, &grouping);
    tn_status status = tn_house_projection_take(house, solids, aspect, by, &drawn->projection, error);
    if (status == TN_OK)
        status = tn_house_layer_colours(house, &drawn->layer_colours, error);
    if (status == TN_OK)
        status = tn_house_hatches(house, &drawn->projection, &drawn->hatches, error);
    if (status == TN_OK)
        status = tn_house_layer_hatches(house, &drawn->layer_hatches, error);
    if (status == TN_OK)
        status = tn_house_cuts_layers(house, &drawn->projection, &drawn->layer_least, error);
    if (status == TN_OK) {
        tn_house_projection *p = &drawn->projection;
        tn_house_colour_groups(&p->mesh);
        status = tn_lines_merge(p->lines, &p->line_count, drawn->outlines, error);
    }
    bool filled = !drawn->outlines && (aspect->kind == TN_ASPECT_ELEVATION || aspect->kind == TN_ASPECT_AXONOMETRIC);
    if (status == TN_OK && filled)
        status = tn_display_list_of_mesh(&drawn->projection.mesh, &display, error);
    if (status == TN_OK && filled) {
        display.closed = true;
        display.watch = watch;
        status = tn_view_take(&display, &drawn->projection.camera, &drawn->view, error);
    }
    tn_display_list_clear(&display);
    return status;
}

void tn_house_drawn_clear(tn_house_drawn *drawn)
{
    tn_view_free(drawn->view);
    free(drawn->layer_colours);
    free(drawn->hatches);
    free(drawn->layer_hatches);
    free(drawn->layer_least);
    tn_house_projection_clear(&drawn->projection);
}

static void clear(sheet *s)
{
    for (size_t i = 0; s->drawn && i < s->drawing->count; i++)
        tn_house_drawn_clear(&s->drawn[i]);
    free(s->drawn);
    tn_sheet_tables_clear(&s->tables);
}

/* ---- what is said of the drawings */

/* What those of a sheet are. */
static void name_kinds(sheet *s)
{
    static const char *const kinds[] = {
        [TN_ASPECT_PLAN] = "plans",         [TN_ASPECT_ROOF] = "plans",           [TN_ASPECT_SECTION_X] = "sections",
        [TN_ASPECT_SECTION_Y] = "sections", [TN_ASPECT_ELEVATION] = "elevations", [TN_ASPECT_AXONOMETRIC] = "views"};
    size_t used = 0;
    for (size_t i = 0; i < s->drawing->count; i++) {
        const char *kind = kinds[s->drawing->aspects[i].kind];
        if (!strstr(s->kinds, kind))
            used += (size_t)snprintf(s->kinds + used, sizeof s->kinds - used, "%s%s", used ? ", " : "", kind);
    }
}

static void say_all(sheet *s)
{
    name_kinds(s);
    snprintf(s->measures, sizeof s->measures, "areas are net, dimensions in %s",
             s->style.us            ? "feet and inches"
             : s->style.millimetres ? "millimetres"
                                    : "metres");
    tn_drawing_says_write(&s->drawing->says, s->said, sizeof s->said);
    s->block = (tn_title_block){.title = s->drawing->title,
                                .says = &s->drawing->says,
                                .kinds = s->kinds,
                                .measures = s->measures,
                                .metric = s->metric,
                                .style = s->lengths};
}

static bool is_section(const tn_aspect *aspect)
{
    return aspect->kind == TN_ASPECT_SECTION_X || aspect->kind == TN_ASPECT_SECTION_Y;
}

static bool may_be_smaller(const tn_aspect *aspect)
{
    return aspect->kind == TN_ASPECT_AXONOMETRIC || aspect->kind == TN_ASPECT_ROOF;
}

/* Where a side of the house looks if it is known where north is. On plans the front is below and the left at the right.
 */
static const char *compass_of(tn_house_side side, double north)
{
    static const char *const points[] = {"north", "north-east", "east", "south-east",
                                         "south", "south-west", "west", "north-west"};
    static const double sides[] = {
        [TN_HOUSE_BACK] = 0, [TN_HOUSE_LEFT] = 90, [TN_HOUSE_FRONT] = 180, [TN_HOUSE_RIGHT] = 270};
    double turn = fmod(sides[side] - north, 360);
    return points[(size_t)floor((turn + 360 + 22.5) / 45) % 8];
}

#define CAPTION_MAX 128

/* A drawing's title, with the letter of a section, the point of the compass of an elevation, and the scale if it is not
 * that of the sheet. */
static void write_caption(const sheet *s, size_t i, char caption[CAPTION_MAX])
{
    const tn_aspect *aspect = &s->drawing->aspects[i];
    const char *title = s->drawn[i].projection.title;
    char scale[32], at[32];
    size_t section = 0;
    for (size_t k = 0; k < i; k++)
        section += is_section(&s->drawing->aspects[k]);
    if (is_section(aspect) && section < s->style.section_count) {
        const tn_section_place *place = &s->sections[section];
        int used = snprintf(caption, CAPTION_MAX, "%c-%c  ", place->letter, place->letter);
        tn_mark_length(&s->style, fabs((double)place->at), at);
        if (s->lengths == tn_house_length_style(s->house))
            snprintf(caption + used, CAPTION_MAX - (size_t)used, "%s", title);
        else
            snprintf(caption + used, CAPTION_MAX - (size_t)used, "section %c = %s%s", place->across_x ? 'x' : 'y',
                     place->at < 0 ? "-" : "", at);
    } else if (aspect->kind == TN_ASPECT_ELEVATION && s->style.north) {
        snprintf(caption, CAPTION_MAX, "%s, %s", title, compass_of(aspect->side, *s->style.north));
    } else if (s->smaller > 1 && may_be_smaller(aspect)) {
        tn_scale_write(s->scale * s->smaller, s->metric, scale, sizeof scale);
        snprintf(caption, CAPTION_MAX, "%s, %s", title, scale);
    } else
        snprintf(caption, CAPTION_MAX, "%s", title);
}

/* ---- laying out */

#define BOLD_WIDTH 1.15 /* of bold lettering, in that of the other */

/* A nanometre of a drawing, in points. */
static double points_of(const sheet *s, const tn_house_drawn *d)
{
    return may_be_smaller(&d->projection.aspect) ? s->points / s->smaller : s->points;
}

static double wide_of(const sheet *s, const tn_house_drawn *d)
{
    return (d->high[0] - d->low[0]) * points_of(s, d);
}

/* Of a drawing with its caption. */
static double wide(const sheet *s, size_t i)
{
    char caption[CAPTION_MAX];
    write_caption(s, i, caption);
    return fmax(wide_of(s, &s->drawn[i]), BOLD_WIDTH * tn_mark_width(caption) * TN_LETTERING);
}

static double high(const sheet *s, const tn_house_drawn *d)
{
    return (d->high[1] - d->low[1]) * points_of(s, d);
}

/* Plans show where the sections of the sheet are cut, which have letters in their order. */
static void letter_sections(sheet *s)
{
    s->style.sections = s->sections;
    for (size_t i = 0; i < s->drawing->count && s->style.section_count < TN_SECTIONS_MOST; i++) {
        const tn_aspect *a = &s->drawing->aspects[i];
        if (!is_section(a))
            continue;
        char letter = (char)('A' + s->style.section_count);
        s->sections[s->style.section_count++] =
            (tn_section_place){.across_x = a->kind == TN_ASPECT_SECTION_X, .at = a->at, .letter = letter};
    }
}

/* What is written is of one size on paper. A plan that is smaller than the others has no dimensions. */
static tn_status mark(sheet *s, tn_house_drawn *d, tn_error *error)
{
    tn_mark_style style = s->style;
    bool smaller = s->smaller > 1 && may_be_smaller(&d->projection.aspect);
    style.lettering *= smaller ? s->smaller : 1;
    style.undimensioned = smaller;
    tn_status status = tn_house_projection_mark(s->house, &style, &d->projection, error);
    tn_house_projection_extent(&d->projection, d->low, d->high);
    return status;
}

/* How much smaller those are that may be; without marks views in space stay as they are. */
static tn_status set_smaller(sheet *s, uint32_t smaller, tn_error *error)
{
    tn_status status = TN_OK;
    bool same = s->smaller == smaller;
    s->smaller = smaller;
    for (size_t i = 0; !same && status == TN_OK && i < s->drawing->count; i++)
        if (s->drawing->aspects[i].kind == TN_ASPECT_ROOF)
            status = mark(s, &s->drawn[i], error);
    return status;
}

static tn_status mark_all(sheet *s, uint32_t scale, tn_error *error)
{
    tn_status status = TN_OK;
    s->scale = scale;
    s->points = TN_POINTS_PER_NM / scale;
    s->block.scale = scale;
    s->block.points = s->points;
    s->style.lettering = TN_LETTERING / s->points;
    s->style.coarse = scale > (s->metric ? LEGIBLE_METRIC : LEGIBLE_FEET);
    for (size_t i = 0; status == TN_OK && i < s->drawing->count; i++)
        status = mark(s, &s->drawn[i], error);
    return status;
}

/* How many drawings go into the row that starts with this one, no wider than `most`, and how high it becomes. */
static size_t measure_row(const sheet *s, size_t first, double most, double *across, double *down)
{
    size_t count = 0;
    *across = *down = 0;
    for (size_t i = first; i < s->drawing->count; i++, count++) {
        double w = wide(s, i) + (count ? GAP : 0);
        if (count && *across + w > most)
            break;
        *across += w;
        *down = fmax(*down, high(s, &s->drawn[i]));
    }
    return count;
}

/* One drawing has its title and what is said of it above it, a sheet a title block. */
static bool is_sheet(const sheet *s)
{
    return s->drawing->count > 1;
}

static double top_of(const sheet *s)
{
    if (is_sheet(s))
        return MARGIN;
    return MARGIN + (s->drawing->title ? HEADING : 0) + (s->said[0] ? NOTE_LEADING : 0);
}

/* Is x from the right to the left in it, and is it the only drawing in its row of the sheet? */
static bool is_alone_along_x(const sheet *s, size_t i)
{
    const tn_aspect *a = &s->drawing->aspects[i];
    bool along = a->kind == TN_ASPECT_PLAN || a->kind == TN_ASPECT_ROOF || a->kind == TN_ASPECT_SECTION_Y ||
                 (a->kind == TN_ASPECT_ELEVATION && a->side == TN_HOUSE_FRONT);
    bool first = i == 0 || s->drawn[i - 1].y < s->drawn[i].y;
    bool last = i + 1 == s->drawing->count || s->drawn[i].y < s->drawn[i + 1].y;
    return along && first && last;
}

/* Drawings that stand one above the other, such as the plans of two storeys, have each wall at the same place across
 * the sheet, however far their dimensions reach. Returns how wide they are together. */
static double align_rows(sheet *s, double room)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < s->drawing->count; i++)
        if (is_alone_along_x(s, i)) {
            low = fmin(low, s->drawn[i].low[0]);
            high = fmax(high, s->drawn[i].high[0]);
        }
    double across = low < high ? (high - low) * s->points : 0;
    for (size_t i = 0; i < s->drawing->count; i++)
        if (is_alone_along_x(s, i))
            s->drawn[i].x = MARGIN + (room - across) / 2 + (s->drawn[i].low[0] - low) * s->points;
    return across;
}

/* Sets the drawings in rows that are no wider than `wrap`, and spreads these over the room; how high and wide they
 * become. */
static void set_rows(sheet *s, double room, double wrap, double *most, double *down)
{
    double y = top_of(s);
    *most = 0;
    for (size_t first = 0; first < s->drawing->count;) {
        double across, row;
        size_t count = measure_row(s, first, wrap, &across, &row);
        double gap = count > 1 ? (room - across) / (double)(count + 1) : (room - across) / 2, x = MARGIN + gap;
        for (size_t i = first; i < first + count; i++) {
            s->drawn[i].x = x + (wide(s, i) - wide_of(s, &s->drawn[i])) / 2;
            s->drawn[i].y = y + row;
            x += wide(s, i) + GAP + (count > 1 ? gap : 0);
        }
        *most = fmax(*most, across);
        y += row + CAPTION + GAP;
        first += count;
    }
    *most = fmax(*most, align_rows(s, room));
    *down = y - GAP;
}

/* The foot of a page so wide: tables beside the title block, below both the notes. */
static void set_foot(sheet *s, double width)
{
    double high = tn_title_block_height(&s->block);
    s->deep = tn_sheet_tables_deep(&s->tables, width - 2 * MARGIN - TN_BLOCK_WIDTH - FOOT_GAP,
                                   (size_t)(high / TN_TABLE_LEADING));
    s->foot = 2 * FOOT_GAP + fmax(high, (double)s->deep * TN_TABLE_LEADING) +
              NOTE_LEADING * NOTE_LINES * (double)s->drawing->note_count;
}

/* Does everything fit on a page of this size, with some views so much smaller? */
static bool fits_so(sheet *s, const tn_paper *paper, uint32_t smaller, tn_status *status, tn_error *error)
{
    double most, down, room = paper->width - 2 * MARGIN;
    *status = set_smaller(s, smaller, error);
    if (*status != TN_OK)
        return false;
    set_foot(s, paper->width);
    set_rows(s, room, room, &most, &down);
    s->width = paper->width;
    s->height = paper->height;
    s->spare = paper->height - MARGIN - s->foot - down;
    return most <= room && s->spare >= 0;
}

static bool fits(sheet *s, const tn_paper *paper, tn_status *status, tn_error *error)
{
    return fits_so(s, paper, 1, status, error) || (*status == TN_OK && fits_so(s, paper, SMALLER, status, error));
}

/* Is there room for each drawing by itself, without its marks, at 1:scale? Where it is not, nothing else is asked. */
static bool may_fit(const sheet *s, const tn_paper *paper, uint32_t scale)
{
    for (size_t i = 0; i < s->drawing->count; i++) {
        const tn_house_projection *p = &s->drawn[i].projection;
        double points = TN_POINTS_PER_NM / scale / (may_be_smaller(&p->aspect) ? SMALLER : 1);
        if ((p->high[0] - p->low[0]) * points > paper->width || (p->high[1] - p->low[1]) * points > paper->height)
            return false;
    }
    return true;
}

#define WRAPS 48 /* widths of rows that are tried */

/* Full rows can leave half of a page empty below them. Shorter ones are taken where they leave room more evenly: the
 * rows that could be enlarged most. */
static void even_rows(sheet *s)
{
    double room = s->width - 2 * MARGIN, page = s->height - MARGIN - s->foot, best = 0, taken = room, most, down;
    for (int i = WRAPS; i > 0; i--) {
        double wrap = room * i / WRAPS;
        set_rows(s, room, wrap, &most, &down);
        double larger = fmin(room / most, (page - top_of(s)) / (down - top_of(s)));
        if (most <= room && down <= page && larger > best) {
            best = larger;
            taken = wrap;
        }
    }
    set_rows(s, room, taken, &most, &down);
    s->spare = page - down;
}

/* Puts what is left of the page's height between the rows, as much above the first and below the last. */
static void spread_rows(sheet *s)
{
    size_t rows = 0, row = 0;
    for (size_t i = 0; i < s->drawing->count; i++)
        rows += i == 0 || s->drawn[i].y > s->drawn[i - 1].y;
    for (size_t i = 0; i < s->drawing->count; i++) {
        double gap = s->spare / (double)(rows + 1);
        bool next = i + 1 < s->drawing->count && s->drawn[i + 1].y > s->drawn[i].y;
        s->drawn[i].y += gap * (double)(row + 1);
        row += next;
    }
}

/* Takes the smallest paper that holds everything at the scale that is set. */
static tn_status take_smallest(sheet *s, const tn_paper *papers, size_t count, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++)
        if (fits(s, &papers[i], &status, error))
            break;
    return status;
}

/* Does everything fit on the paper at a scale no smaller than that? The largest such is set then, or the drawing's. */
static bool fits_scaled(sheet *s, const tn_paper *paper, uint32_t smallest, tn_status *status, tn_error *error)
{
    const uint32_t *scales;
    size_t count = tn_scale_choices(s->metric, &scales);
    for (size_t i = 0; *status == TN_OK && i < count; i++) {
        uint32_t scale = s->drawing->scale ? s->drawing->scale : scales[i];
        if (s->drawing->scale ? i > 0 : scales[i] > smallest)
            return false;
        if (!may_fit(s, paper, scale))
            continue;
        *status = mark_all(s, scale, error);
        if (*status == TN_OK && fits(s, paper, status, error))
            return true;
    }
    return false;
}

/* Which papers are tried at which scales, the smallest first: a small paper with drawings that are half as large before
 * one that few can print. The largest paper comes before the middle one at half the scale, which it is as full as: its
 * names and furniture can be read, and printed at half its size it is the smallest paper at half the scale. On the last
 * paper any scale will do. */
static const struct tn_paper_order {
    size_t paper;
    enum { LEGIBLE, HALF, ANY } scale;
} paper_order[] = {{0, LEGIBLE}, {1, LEGIBLE}, {0, HALF}, {2, LEGIBLE}, {1, HALF}, {2, ANY}};

/* The smallest paper on which the drawings are legible. If they are on none, the largest scale that there is a paper
 * for, and the smallest paper at that scale. */
static tn_status choose_paper(sheet *s, tn_error *error)
{
    const tn_paper *papers;
    tn_paper_choices(s->metric, &papers);
    uint32_t legible = s->metric ? LEGIBLE_METRIC : LEGIBLE_FEET;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < sizeof paper_order / sizeof *paper_order; i++) {
        uint32_t smallest = paper_order[i].scale == LEGIBLE ? legible
                            : paper_order[i].scale == HALF  ? 2 * legible
                                                            : UINT32_MAX;
        if (!fits_scaled(s, &papers[paper_order[i].paper], smallest, &status, error))
            continue;
        status = take_smallest(s, papers, paper_order[i].paper + 1, error);
        even_rows(s);
        spread_rows(s);
        return status;
    }
    if (status != TN_OK)
        return status;
    status = tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE, "the drawings do not fit on a sheet of paper");
    tn_error_help(error, "choose a smaller --scale (a larger number), or write single drawings: --view");
    return status;
}

/* One drawing gets a page of its size. */
static tn_status choose_page(sheet *s, tn_error *error)
{
    const uint32_t *scales;
    size_t count = tn_scale_choices(s->metric, &scales);
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        status = mark_all(s, s->drawing->scale ? s->drawing->scale : scales[i], error);
        if (s->drawing->scale || (wide(s, 0) <= VIEW_WIDTH && high(s, &s->drawn[0]) <= VIEW_HEIGHT))
            break;
    }
    double most, down;
    s->width = fmax(wide(s, 0), 240) + 2 * MARGIN;
    set_rows(s, s->width - 2 * MARGIN, s->width - 2 * MARGIN, &most, &down);
    s->height = down + s->foot + MARGIN;
    return status;
}

/* ---- painting */

static void paint_caption(const sheet *s, tn_paint *paint, size_t i)
{
    const tn_house_drawn *d = &s->drawn[i];
    char caption[CAPTION_MAX];
    write_caption(s, i, caption);
    tn_paint_layer(paint, TN_LAYER_TITLE);
    tn_paint_colour(paint, 0, 0, 0);
    tn_paint_face(paint, TN_LETTERING, true);
    tn_type_line(paint, d->x + wide_of(s, d) / 2, d->y + CAPTION - 6, TN_ALIGN_CENTRE, caption);
}

/* A drawing to scale, with its caption. */
static void paint_drawing(const sheet *s, const tn_canvas *canvas, size_t i)
{
    const tn_house_drawn *d = &s->drawn[i];
    tn_paint *paint = tn_canvas_paint(canvas);
    double points = points_of(s, d);
    const tn_drawn_view view = {d->projection.title,  d->x,
                                d->y - high(s, d),    wide_of(s, d),
                                high(s, d) + CAPTION, {d->x - d->low[0] * points, d->y + d->low[1] * points},
                                s->points / points};
    tn_paint_view_begin(paint, &view);
    tn_draw_projection(canvas, d, points);
    paint_caption(s, paint, i);
    tn_paint_view_end(paint);
}

static void paint_foot(const sheet *s, tn_paint *paint)
{
    double y = s->height - MARGIN - s->foot + 14,
           bar = (double)(s->metric ? 1000000000 : TN_FOOT_NM * 4) * s->points * 4;
    double room = s->width - 2 * MARGIN - bar - 90;
    tn_scale_bar_paint(&s->block, paint, s->width - MARGIN, y);
    if (s->drawing->count == 1 && s->drawing->aspects[0].kind == TN_ASPECT_AXONOMETRIC && room < 120)
        room = 120;
    tn_paint_face(paint, TN_LETTERING, false);
    tn_paint_colour(paint, 0, 0, 0);
    y += 4;
    for (size_t i = 0; i < s->drawing->note_count && room > 60; i++)
        y += NOTE_LEADING * tn_type_paragraph(paint, MARGIN, y, room, NOTE_LEADING, NOTE_LINES, s->drawing->notes[i]);
}

static void paint_sheet_foot(const sheet *s, tn_paint *paint)
{
    double y = s->height - MARGIN - s->foot + FOOT_GAP, notes = y + s->foot - FOOT_GAP;
    tn_sheet_tables_paint(&s->tables, paint, MARGIN, y, s->deep, TN_LETTERING);
    tn_title_block_paint(&s->block, paint, s->width - MARGIN - TN_BLOCK_WIDTH, y);
    notes -= NOTE_LEADING * (NOTE_LINES * (double)s->drawing->note_count - 1);
    tn_paint_layer(paint, TN_LAYER_TEXT);
    tn_paint_face(paint, TN_LETTERING, false);
    for (size_t i = 0; i < s->drawing->note_count; i++)
        notes += NOTE_LEADING * tn_type_paragraph(paint, MARGIN, notes, s->width - 2 * MARGIN, NOTE_LEADING, NOTE_LINES,
                                                  s->drawing->notes[i]);
}

static void paint_all(const sheet *s, const tn_canvas *canvas)
{
    tn_paint *paint = tn_canvas_paint(canvas);
    tn_paint_layer(paint, TN_LAYER_TITLE);
    if (s->drawing->title && !is_sheet(s)) {
        tn_paint_face(paint, TN_NAME_LETTERING, true);
        tn_type_fit(paint, MARGIN, MARGIN + 6, TN_ALIGN_LEFT, s->width - 2 * MARGIN, s->drawing->title);
    }
    if (s->said[0] && !is_sheet(s)) {
        tn_paint_face(paint, TN_LETTERING, false);
        tn_type_fit(paint, MARGIN, MARGIN + 6 + (s->drawing->title ? HEADING - 6 : 0), TN_ALIGN_LEFT,
                    s->width - 2 * MARGIN, s->said);
    }
    for (size_t i = 0; i < s->drawing->count && !tn_canvas_stopped(canvas); i++)
        paint_drawing(s, canvas, i);
    if (is_sheet(s))
        paint_sheet_foot(s, paint);
    else
        paint_foot(s, paint);
}

/* Those of the form's author, or, if an office is used to others, feet or metres. */
static tn_length_style lengths_of(const tn_house *house, tn_profile profile)
{
    tn_length_style own = tn_house_length_style(house);
    bool us = tn_profile_of(profile, own == TN_STYLE_FEET) == TN_PROFILE_US;
    return us ? TN_STYLE_FEET : own == TN_STYLE_FEET ? TN_STYLE_METRES : own;
}

tn_status tn_house_draw(const tn_house *house, const tn_solids *solids, const tn_house_drawing *drawing, tn_picture *to,
                        tn_error *error)
{
    sheet s = {.house = house,
               .drawing = drawing,
               .smaller = 1,
               .drawn = calloc(drawing->count + 1, sizeof *s.drawn),
               .lengths = lengths_of(house, to->profile),
               .foot = 30 + NOTE_LEADING * NOTE_LINES * (double)drawing->note_count};
    s.metric = s.lengths != TN_STYLE_FEET;
    s.style.us = !s.metric;
    s.style.eighths = s.style.us && tn_house_length_style(house) != TN_STYLE_FEET;
    s.style.millimetres = s.lengths == TN_STYLE_MILLIMETRES;
    s.style.north = drawing->says.north;
    letter_sections(&s);
    say_all(&s);
    tn_canvas *canvas = NULL;
    tn_status status = s.drawn ? tn_sheet_tables_make(house, &s.style, &s.tables, error) : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < drawing->count; i++) {
        s.drawn[i].outlines = to->format == TN_CANVAS_DXF;
        status = tn_house_view_take(solids, &drawing->aspects[i], house, &s.drawn[i], to->watch, error);
    }
    if (status == TN_OK)
        status = drawing->count == 1 ? choose_page(&s, error) : choose_paper(&s, error);
    const tn_canvas_options options = {.width = s.width,
                                       .height = s.height,
                                       .dpi = to->dpi,
                                       .title = drawing->title,
                                       .scale = s.scale,
                                       .feet = !s.metric};
    if (status == TN_OK)
        status = tn_canvas_open(to, &options, &canvas, error);
    if (status == TN_OK) {
        paint_all(&s, canvas);
        status = tn_canvas_commit(canvas, error);
    }
    tn_canvas_free(canvas);
    clear(&s);
    return status;
}
