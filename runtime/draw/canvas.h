/* A picture under construction: SVG, PNG, PDF or DXF by the file's extension, one tn_paint for all.
 *
 * Units are points (1/72 inch), y downwards. The file is written beside its target and renamed. The same drawing gives
 * the same bytes: of an SVG and a DXF on every machine, of the others for one version of cairo and one set of fonts
 * (dates in a PDF are constant). A canvas owns its paint and its file; free it in any case.
 */
#ifndef TARTAN_DRAW_CANVAS_H
#define TARTAN_DRAW_CANVAS_H

#include "runtime/base/picture.h"
#include "runtime/draw/paint.h"

typedef struct tn_canvas tn_canvas;

/* The longest side of a page, in points: 70 metres. */
#define TN_CANVAS_SIDE_MAX 200000.0

typedef struct tn_canvas_options {
    double width, height; /* of the first page, in points */
    uint32_t dpi;         /* of a PNG; 0: 150 */
    const char *title;    /* for the file's metadata; or NULL */
    double scale;         /* 1:scale, of the views (tn_paint_view_begin); 0: there are none */
    bool feet;            /* it is measured in feet and inches; otherwise metric */
} tn_canvas_options;

/* Starts a picture. E0902 if the file cannot be written, E0820 if its page or its PNG would be too large, E0907
 * for a PNG or a PDF in a build without the part `draw`. */
tn_status tn_canvas_new(const char *path, tn_canvas_format format, const tn_canvas_options *options, tn_canvas **canvas,
                        tn_error *error);

/* Starts a picture that goes there (its dpi is the options'); `picture` stays the caller's until the canvas is freed,
 * and is filled when it is committed. Errors as in tn_canvas_new. */
tn_status tn_canvas_open(tn_picture *picture, const tn_canvas_options *options, tn_canvas **canvas, tn_error *error);

/* The same, with the picture's dpi. */
tn_status tn_canvas_begin(tn_picture *picture, double width, double height, const char *title, tn_canvas **canvas,
                          tn_error *error);

/* Draw with this. White to begin with, black lines. */
tn_paint *tn_canvas_paint(const tn_canvas *canvas);

/* Ends the page and starts another of this size. Only PDF has pages: TN_INTERNAL for the others. */
tn_status tn_canvas_page(tn_canvas *canvas, double width, double height, tn_error *error);

/* Is the drawing given up? Then what is left need not be drawn: committing fails with TN_STOPPED. */
bool tn_canvas_stopped(const tn_canvas *canvas);

/* Writes the file. E0902 if that fails; the target is then as it was. */
tn_status tn_canvas_commit(tn_canvas *canvas, tn_error *error);

void tn_canvas_free(tn_canvas *canvas);

#endif
