/* Writes an image of cairo as a PNG, a few times as fast as cairo does: each row is what changed from the row above. */
#ifndef TARTAN_DRAW_CAIRO_PNG_H
#define TARTAN_DRAW_CAIRO_PNG_H

#include <cairo.h>
#include <stdio.h>

#include "runtime/base/watch.h"

/* The image is of CAIRO_FORMAT_RGB24. CAIRO_STATUS_WRITE_ERROR where the stream cannot be written, or the watch (or
 * NULL) says that it is time to end; CAIRO_STATUS_NO_MEMORY. */
cairo_status_t tn_png_write(cairo_surface_t *image, FILE *out, tn_watch *watch);

#endif
