/* How wide lettering is: by a table of DejaVu Sans, so that every picture, on every machine, breaks its lines alike,
 * whatever fonts there are. */
#ifndef TARTAN_DRAW_DEVICE_LETTERING_H
#define TARTAN_DRAW_DEVICE_LETTERING_H

#include <stdbool.h>

/* The width of a UTF-8 text in its font's size: characters one beside the other, without kerning. */
double tn_lettering_width(const char *text, bool bold);

/* How high capitals are, in the font's size. */
#define TN_LETTERING_CAPITALS 0.729

/* From a line to the next, in the font's size. */
double tn_lettering_height(bool bold);

#endif
