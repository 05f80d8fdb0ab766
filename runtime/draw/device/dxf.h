/* Writes pictures as DXF of release 2007 (AC1021), for drawing programs: the same bytes on every machine.
 *
 * Views (tn_drawn_view) are drawn in model space, at their true size in millimetres or inches; what is in none is on a
 * layout, where a viewport shows each view. In a picture that is not to scale all is in model space, as large as on
 * paper. Strokes are lines, arcs and polylines on layers, in the colour of the layer unless they are on none; what is
 * filled is a solid hatch in its own colour, unless it is white or translucent; symbols are blocks that are inserted.
 * Nothing is clipped, and groups are not said. */
#ifndef TARTAN_DRAW_DEVICE_DXF_H
#define TARTAN_DRAW_DEVICE_DXF_H

#include <stdio.h>

#include "runtime/base/picture.h"
#include "runtime/draw/device/device.h"

typedef struct tn_dxf_options {
    double width, height; /* in points */
    const char *title;    /* of the layout; or NULL */
    double scale;         /* 1:scale, of the views; 0: there are none */
    bool feet;            /* in inches; otherwise in millimetres */
    tn_profile profile;   /* of the names of layers: ISO 13567, or AIA */
} tn_dxf_options;

/* Begins a picture, which is written to the stream when it is finished; that stays the caller's. Free the device in any
 * case. TN_MEMORY. Failures to write are left to the stream's owner. */
tn_status tn_dxf_new(FILE *out, const tn_dxf_options *options, tn_device **device, tn_error *error);

#endif
