/* Lettering: setting short texts on a picture. Sizes in points; every text may be any bytes (what is not UTF-8 shows as
 * `?`). */
#ifndef TARTAN_DRAW_TYPE_H
#define TARTAN_DRAW_TYPE_H

#include <cairo.h>
#include <stdbool.h>
#include <stdio.h>

typedef enum tn_align { TN_ALIGN_LEFT, TN_ALIGN_CENTRE, TN_ALIGN_RIGHT } tn_align;

/* From now on lettering on this context is not drawn but written to `letters` as SVG text elements, black and
 * left-aligned where they do not say otherwise; the family is for what is around them to say. false where out of
 * memory. */
bool tn_type_as_text(cairo_t *context, FILE *letters);

/* Lays a white veil over a rectangle and what is drawn and lettered there so far; opacity 0 to 1. */
void tn_type_veil(cairo_t *context, double x, double y, double width, double height, double opacity);

/* Chooses the face: sans serif, unhinted, so that widths do not depend on the resolution. */
void tn_type_face(cairo_t *context, double size, bool bold);

double tn_type_width(cairo_t *context, const char *text);

/* Sets a line at its baseline. */
void tn_type_line(cairo_t *context, double x, double baseline, tn_align align, const char *text);

/* The same, cut off with an ellipsis where it is wider than `width`. */
void tn_type_fit(cairo_t *context, double x, double baseline, tn_align align, double width, const char *text);

/* Sets words in lines of at most `width`, `leading` apart, `max_lines` at most. Where there is more, the last ends with
 * a whole word and an ellipsis. Returns the number of lines set. */
unsigned tn_type_paragraph(cairo_t *context, double x, double baseline, double width, double leading,
                           unsigned max_lines, const char *text);

/* Sets digits in groups of three, kept apart by a little space; smaller where they are wider than `width`. */
void tn_type_digits(cairo_t *context, double x, double baseline, double width, const char *digits);

#endif
