/* Writes pictures as SVG, by itself: the same bytes on every machine.
 *
 * Coordinates are thousandths of a point and paths have no transformation, since browsers lose thin lines of what is
 * drawn large and made small; symbols are defined once and turned. Strokes of one pen that follow one another are one
 * element, lettering is text in DejaVu Sans or what resembles it, hatches are patterns, and clips of one outline are
 * one clipPath. */
#ifndef TARTAN_DRAW_DEVICE_SVG_H
#define TARTAN_DRAW_DEVICE_SVG_H

#include <stdio.h>

#include "runtime/draw/device/device.h"

typedef struct tn_svg_options {
    double width, height; /* in points */
    bool element;         /* an element of an HTML page: without the line that begins a file */
    unsigned number;      /* of an element: which of the page's, so that no two ids are the same */
} tn_svg_options;

/* Begins a picture with white ground, which is written to the stream; that stays the caller's. Free the device in any
 * case. TN_MEMORY. Failures to write are left to the stream's owner. */
tn_status tn_svg_new(FILE *out, const tn_svg_options *options, tn_device **device, tn_error *error);

#endif
