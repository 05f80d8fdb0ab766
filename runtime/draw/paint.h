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
