/* Draws pictures by cairo: PNG and PDF, the optional part `draw`. */
#ifndef TARTAN_DRAW_CAIRO_CAIRO_H
#define TARTAN_DRAW_CAIRO_CAIRO_H

#include <stdio.h>

#include "runtime/draw/device/device.h"

/* The most pixels of a PNG: 4 bytes each while it is drawn. A side is limited to 32,767 by cairo. */
#define TN_PNG_PIXELS_MAX UINT64_C(100000000)

typedef struct tn_cairo_options {
    double width, height; /* of the first page, in points */
    uint32_t dpi;         /* of a PNG */
    const char *title;    /* for a PDF's metadata; or NULL */
} tn_cairo_options;

/* Begins a picture with white ground, which is written to the stream; that stays the caller's. The watch, which may be
 * NULL, ends writing once it says so. E0820 if a PNG would be too large; TN_MEMORY; in a build without the part
 * `draw` TN_INVALID (E0907). Free the device in any case. */
tn_status tn_png_new(FILE *out, const tn_cairo_options *options, tn_watch *watch, tn_device **device, tn_error *error);
tn_status tn_pdf_new(FILE *out, const tn_cairo_options *options, tn_watch *watch, tn_device **device, tn_error *error);

#endif
