/* Tartan's own drawing interface: what every picture is drawn with, whatever kind of file it becomes.
 *
 * A tn_paint has a path under construction and a state: where the origin is, how large and how turned its axes are, the
 * colour, the pen, the face of lettering. Units are points (1/72 inch) unless the state is scaled, y downwards, angles
 * in radians from the x axis towards the y axis. What is drawn goes to a device (runtime/draw/device/), which the
 * tn_paint owns; without one it goes nowhere, and lettering can be measured.
 *
 * Drawing does not fail in place: after the first failure nothing more is drawn, and tn_paint_finish says why. */
#ifndef TARTAN_DRAW_PAINT_H
#define TARTAN_DRAW_PAINT_H

#include "runtime/draw/device/device.h"

typedef struct tn_paint tn_paint;

/* Takes the device over, which may be NULL; the state is as tn_paint_reset leaves it. NULL, and the device freed: out
 * of memory. Free the paint with what it owns. */
tn_paint *tn_paint_new(tn_device *device);
void tn_paint_free(tn_paint *paint);

/* Ends the picture. TN_IO if it could not be written, which the stream's owner may explain better; TN_MEMORY. */
tn_status tn_paint_finish(tn_paint *paint, tn_watch *watch, tn_error *error);

/* Ends the page and begins another, white, with a state as new. TN_INTERNAL if the device has no pages. */
tn_status tn_paint_next_page(tn_paint *paint, double width, double height, tn_error *error);

/* ---- the state: black, a line of 1 point, mitred and with butt ends, lettering of 10 points */

/* Restores what was saved last, and ends the clips since. */
void tn_paint_save(tn_paint *paint);
void tn_paint_restore(tn_paint *paint);

void tn_paint_translate(tn_paint *paint, double x, double y);
void tn_paint_scale(tn_paint *paint, double factor);
void tn_paint_rotate(tn_paint *paint, double angle);

void tn_paint_colour(tn_paint *paint, double red, double green, double blue);
void tn_paint_translucent(tn_paint *paint, double red, double green, double blue, double opacity);

void tn_paint_line_width(tn_paint *paint, double width);
void tn_paint_line_cap(tn_paint *paint, tn_line_cap cap);
void tn_paint_line_join(tn_paint *paint, tn_line_join join);

/* Lengths of dashes and gaps in turn, TN_DASHES_MAX at most; none: a whole line. */
void tn_paint_dash(tn_paint *paint, const double *dashes, size_t count, double offset);

void tn_paint_even_odd(tn_paint *paint, bool even_odd);

/* ---- what is drawn means something: layers, weights, hatches, symbols, dimensions and drawings to scale. A picture of
 * pixels or a PDF shows them as paths; a file for drawing programs (DXF) keeps what they are, and an SVG keeps symbols
 * and hatches. Nothing of it has to be said */

/* From now on, until the state is restored: the layer (runtime/draw/device/layers.def) of what is drawn. */
void tn_paint_layer(tn_paint *paint, tn_layer layer);

/* The widths of lines on paper: 0.5, 0.35, 0.25 and 0.18 mm. */
typedef enum tn_weight { TN_WEIGHT_CUT, TN_WEIGHT_SEEN, TN_WEIGHT_THIN, TN_WEIGHT_HATCH } tn_weight;

/* The pen is so wide, however the state is scaled. */
void tn_paint_weight(tn_paint *paint, tn_weight weight);

/* Does what is filled cover what was drawn below it? Otherwise (DXF) whatever is hidden should not be drawn: a face is
 * drawn by the lines that are seen of it. Nothing white and nothing translucent is filled there. */
bool tn_paint_covers(const tn_paint *paint);

/* Fills the path with a pattern (runtime/draw/device/hatches.h), by the pen and in the colour of the state, its lines
 * `size` times as far apart as the pattern has them and counted from the state's origin: regions that are hatched apart
 * fit together. The path is gone then. */
void tn_paint_hatch(tn_paint *paint, tn_hatch hatch, double size);

/* A symbol: a shape with a name, as a door or a bath. `draw` draws it about the origin, with a state that is new but
 * for its scale, without lettering, which would be mirrored. It is called once or often, and draws the same for one
 * name and scale within a picture: the name says all that its shape depends on ("DOOR-900", "BATH-1700x700"), in
 * letters, digits, `-` and `_`. */
typedef struct tn_drawn_symbol {
    const char *name;
    void (*draw)(tn_paint *paint, const void *of);
    const void *of;
} tn_drawn_symbol;

/* Draws a symbol with its origin at (x, y): mirrored from left to right if asked for, then turned. A path at hand is
 * lost. */
void tn_paint_symbol(tn_paint *paint, const tn_drawn_symbol *symbol, double x, double y, double angle, bool mirrored);

/* A dimension: the distance of two points along a line that is parallel to them, `offset` aside (to the left as one
 * goes from the first to the second; negative: to the right). text: above the line, or below it
 * and clear of its strokes, where a leader goes to it; or empty. */
typedef struct tn_dimension {
    double from[2], to[2];
    double offset;
    const char *text;
    bool below, heavy; /* heavy: its strokes are as wide as lines of what is cut */
} tn_dimension;

/* Draws it with the state's pen, colour and face: lines out from the points, the line between them, an oblique stroke
 * at each of its ends, and the text at its middle, to be read from below or from the right. A path at hand is lost.
 * The text is as it is given: a caller asks tn_paint_text_width whether it has room. */
void tn_paint_dimension(tn_paint *paint, const tn_dimension *dimension);

/* What is drawn until its end is a drawing to scale, that of the canvas (its options), with a frame and an origin in
 * the state's units: in a DXF it stands in model space at its true size, measured from the origin, and a viewport shows
 * it on the sheet. Views do not nest. What is drawn in none belongs to the sheet. */
void tn_paint_view_begin(tn_paint *paint, const tn_drawn_view *view);
void tn_paint_view_end(tn_paint *paint);

/* ---- paths */

void tn_paint_new_path(tn_paint *paint);
void tn_paint_new_sub_path(tn_paint *paint); /* what is added next does not go on from where the path is */

void tn_paint_move_to(tn_paint *paint, double x, double y);
void tn_paint_line_to(tn_paint *paint, double x, double y); /* of a path that is nowhere yet: moves there */
void tn_paint_close_path(tn_paint *paint);
void tn_paint_rectangle(tn_paint *paint, double x, double y, double width, double height);

/* An arc around (x, y), with a line to its beginning if the path goes on. `to` is passed in the direction of growing
 * angles or, by the second, of falling ones: it is taken as so many turns more or fewer. */
void tn_paint_arc(tn_paint *paint, double x, double y, double radius, double from, double to);
void tn_paint_arc_negative(tn_paint *paint, double x, double y, double radius, double from, double to);

/* Draw the path; what is not kept is gone then. */
void tn_paint_fill(tn_paint *paint);
void tn_paint_fill_keep(tn_paint *paint);
void tn_paint_stroke(tn_paint *paint);
void tn_paint_stroke_keep(tn_paint *paint);

/* From now on, until the state is restored, only what lies within the path, too, is drawn. The path is gone then. */
void tn_paint_clip(tn_paint *paint);

/* ---- lettering (runtime/draw/type.h sets it) */

void tn_paint_face(tn_paint *paint, double size, bool bold);

/* The same, by the height of capitals: 2.5 mm on paper are TN_POINTS_PER_MM * 2.5. */
#define TN_POINTS_PER_MM (72 / 25.4)
void tn_paint_capitals(tn_paint *paint, double height, bool bold);

/* Of a text in the face. */
double tn_paint_text_width(const tn_paint *paint, const char *text);
double tn_paint_line_height(const tn_paint *paint);

/* Writes a UTF-8 text at its baseline. */
void tn_paint_text(tn_paint *paint, double x, double y, tn_align align, const char *text);

/* ---- pixels */

/* Draws pixels (premultiplied, as 0xAARRGGBB) with their upper left corner at (x, y), each a square with a side of
 * `pixel`. Not into an SVG: TN_INTERNAL. */
void tn_paint_pixels(tn_paint *paint, const uint32_t *values, uint32_t width, uint32_t height, double x, double y,
                     double pixel);

/* The side of a pixel of the picture; 0 if it has none. */
double tn_paint_pixel(const tn_paint *paint);

/* ---- what is drawn, said for who clicks on it: in SVG alone, where a group has an attribute `data-plan` and so on */

typedef enum tn_paint_subject {
    TN_PAINT_PLAN,  /* of a sheet, from 0 */
    TN_PAINT_TRAY,  /* of a plan, from 0 */
    TN_PAINT_RULE,  /* of those drawn, or of those that an explanation is about, from 0 */
    TN_PAINT_PART,  /* of a rule: its root is 0, and what follows it are its parts, each before its own */
    TN_PAINT_ITEM,  /* of a tray that a rule asks for: the sign of a field, by its number in the schema */
    TN_PAINT_DEPTH, /* likewise the sign of a zone's depth */
    TN_PAINT_BAR,   /* of a histogram, from 0: a value of the distribution, or a bin of values */
    TN_PAINT_POINT, /* of a front, from 0, as the rows of its table */
    TN_PAINT_HOUSE  /* of a sheet of several, from 0 */
} tn_paint_subject;

/* What is drawn until the group ends is that. Groups nest, and end before a state that was saved before them is
 * restored. */
void tn_paint_group_begin(tn_paint *paint, tn_paint_subject subject, size_t number);
void tn_paint_group_end(tn_paint *paint);

/* A rectangle that belongs to the group though nothing is seen of it. */
void tn_paint_target(tn_paint *paint, double x, double y, double width, double height);

#endif
