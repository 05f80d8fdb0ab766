/* The parts of a plan drawing, between its own files: what the roles say, one plan to scale, one as a table, the title
 * strip. Nothing here allocates or fails. All places are in points. */
#ifndef TARTAN_PLAN_PICTURE_DRAW_PARTS_H
#define TARTAN_PLAN_PICTURE_DRAW_PARTS_H

#include "runtime/base/length.h"
#include "runtime/draw/paint.h"
#include "runtime/plan/picture/draw.h"

#define TN_NO_FIELD UINT32_MAX
#define TN_BANDS_MAX 32u

/* What a schema's roles mean for drawing it. */
typedef struct tn_draw_roles {
    const tn_schema *schema;
    bool to_scale;                                  /* it has a length and at least one band */
    uint32_t length, level, public_end, great_hall; /* fields, or TN_NO_FIELD */
    uint32_t text, tone, hatch;                     /* the same: without such roles the first choice is text and tone */
    uint32_t bands[TN_BANDS_MAX];                   /* fields, top to bottom */
    uint32_t band_count;
    uint32_t spine; /* index into bands */
    tn_length_style style;
} tn_draw_roles;

void tn_draw_roles_find(const tn_schema *schema, tn_draw_roles *roles);

/* Has the field no role, so that its values can only be written? */
bool tn_draw_written(const tn_draw_roles *roles, uint32_t field);

/* Writes a length in the units that the author uses. */
void tn_draw_length(const tn_draw_roles *roles, int64_t nanometres, char *text, size_t size);

/* How much room plans need around their spine, at 1:1 in nanometres, and lines of writing below. */
typedef struct tn_draw_extent {
    double width, above, below;
    unsigned written_lines;
    bool mark_below; /* a public end in the middle, shown from below */
} tn_draw_extent;

void tn_draw_measure(const tn_draw_roles *roles, const tn_drawn_plan *plan,
                     tn_draw_extent *extent); /* takes the greater */

/* Room of the marks and dimensions around a plan to scale, in points. */
#define TN_MARK_ROOM 13.0
double tn_draw_dimension_room(const tn_draw_extent *extent);

/* Draws a plan with the left end of its spine at (x, y); `scale` is points a nanometre; `bottom` is where dimensions
 * start. */
void tn_draw_plan(tn_paint *paint, const tn_draw_roles *roles, const tn_drawn_plan *plan, double scale, double x,
                  double y, double bottom, const tn_draw_extent *extent);

/* Do plans have bands on both sides of their spine? Then a sheet says what lies on which, beside each plan: the
 * outermost bands, upright in a column of this width whose left edge is at x; above and below: the depths there. */
#define TN_SIDES_ROOM 9.0
bool tn_draw_two_sided(const tn_draw_roles *roles);
void tn_draw_sides(tn_paint *paint, const tn_draw_roles *roles, double x, double spine, double above, double below);

/* The pieces of it that the legend shows too. */

/* A fill of a band: VALUE record `value`. Fills of one role but of different names are told apart. */
void tn_draw_fill(tn_paint *paint, const tn_draw_roles *roles, uint32_t value, double x, double y, double width,
                  double height);

/* The colour of the tray's value in the field of role tone, and the lines of that in the field of role hatch; nothing
 * where the schema has no such field. `value`: counted from the field's first. */
void tn_draw_tone(tn_paint *paint, const tn_draw_roles *roles, uint32_t value, double x, double y, double width,
                  double height);
void tn_draw_hatch(tn_paint *paint, const tn_draw_roles *roles, uint32_t value, double x, double y, double width,
                   double height);

/* Sets the text in the middle of the rectangle, upright where that is the only way that it fits; on a pale ground where
 * that is `hatched`. */
#define TN_INSIDE_SIZE 7.0  /* in a tray */
#define TN_INSIDE_LEAST 4.6 /* where that does not fit */
void tn_draw_inside(tn_paint *paint, const char *text, double size, bool hatched, double x, double y, double width,
                    double height);

/* The same text's own room, in the middle of a rectangle of that size. */
void tn_draw_inside_room(tn_paint *paint, const char *text, double size, double *width, double *height);

typedef struct tn_draw_area {
    double x, y, width, height;
} tn_draw_area;

/* A cross of dashes over the area, which leaves what is `spared` free (at most TN_SPARED_MOST), and from three storeys
 * on their number, beside what is spared first where that reaches as high, on a pale ground if the area is hatched. */
#define TN_SPARED_MOST 2u
void tn_draw_level_mark(tn_paint *paint, uint32_t levels, bool hatched, tn_draw_area area, const tn_draw_area *spared,
                        size_t count);
void tn_draw_hall_mark(tn_paint *paint, double x, double y, double radius);
void tn_draw_public_mark(tn_paint *paint, double x, double y, double dx,
                         double dy); /* tip at (x, y), pointing (dx, dy) */

/* A plan as a table of boxes. */
typedef struct tn_draw_table {
    double name_width; /* of the column of field names */
    double box_width, row_height;
    double head_height; /* of the row of the field of role text, on top; 0: there is none */
} tn_draw_table;

void tn_draw_table_measure(tn_paint *paint, const tn_draw_roles *roles, tn_draw_table *table);
double tn_draw_table_width(const tn_draw_table *table, size_t length);
double tn_draw_table_height(const tn_draw_table *table, const tn_draw_roles *roles);
void tn_draw_table_plan(tn_paint *paint, const tn_draw_roles *roles, const tn_draw_table *table,
                        const tn_drawn_plan *plan, double x, double y);

/* The strip along the bottom of a sheet: key, legend, title and how it was made. Its upper left corner is the origin.
 * `scale` 0: not to scale; otherwise the bar allows for the strip itself being drawn `zoom` times as large. */
#define TN_STRIP_HEIGHT 118.0
void tn_draw_strip(tn_paint *paint, const tn_draw_roles *roles, const tn_draw_options *options, uint32_t scale,
                   double zoom, size_t page, size_t pages, double width);

#endif
