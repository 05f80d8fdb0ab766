/* Lettering: setting short texts on a picture. Sizes in points; every text may be any bytes (what is not UTF-8 shows as
 * `?`). Lines break where a table of DejaVu Sans says, in every kind of picture alike. */
#ifndef TARTAN_DRAW_TYPE_H
#define TARTAN_DRAW_TYPE_H

#include "runtime/draw/paint.h"

/* Lays a white veil over a rectangle and what is drawn there so far; opacity 0 to 1. Black is the colour after it. */
void tn_type_veil(tn_paint *paint, double x, double y, double width, double height, double opacity);

double tn_type_width(const tn_paint *paint, const char *text);

/* Sets a line at its baseline. */
void tn_type_line(tn_paint *paint, double x, double baseline, tn_align align, const char *text);

/* The same, cut off with an ellipsis where it is wider than `width`. */
void tn_type_fit(tn_paint *paint, double x, double baseline, tn_align align, double width, const char *text);

/* Sets words in lines of at most `width`, `leading` apart, `max_lines` at most. Where there is more, the last ends with
 * a whole word and an ellipsis. Returns the number of lines set. */
unsigned tn_type_paragraph(tn_paint *paint, double x, double baseline, double width, double leading, unsigned max_lines,
                           const char *text);

/* Sets digits in groups of three, kept apart by a little space; smaller where they are wider than `width`. */
void tn_type_digits(tn_paint *paint, double x, double baseline, double width, const char *digits);

#endif
