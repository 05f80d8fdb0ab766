/* Where a picture goes and of which format it is: what whoever asks for one needs to know. runtime/draw draws it.
 */
#ifndef TARTAN_BASE_PICTURE_H
#define TARTAN_BASE_PICTURE_H

#include "runtime/base/watch.h"

typedef enum tn_canvas_format { TN_CANVAS_BY_PATH, TN_CANVAS_SVG, TN_CANVAS_PNG, TN_CANVAS_PDF } tn_canvas_format;

/* The format that a path's extension asks for (.svg, .png, .pdf, in any case); TN_INVALID (E0904) for another. */
tn_status tn_canvas_format_of(const char *path, tn_canvas_format *format, tn_error *error);

/* Where a picture goes: to a file, into memory, or into an HTML page as an <svg> element. */
typedef struct tn_picture {
    const char *path;        /* a file; NULL: into memory or a page */
    tn_canvas_format format; /* BY_PATH: what the path's extension says, or, without a path, into a page */
    uint32_t dpi;            /* of a PNG; 0: 150 */
    unsigned number;         /* into a page: which of its pictures, so that no two ids are the same */
    char *element;           /* into memory or a page: what was drawn once it is committed, which the caller frees */
    size_t size;
    tn_watch *watch; /* or NULL: drawing is given up (TN_STOPPED) once this says so */
} tn_picture;

/* The format that a picture will have; TN_CANVAS_SVG into a page. Errors as in tn_canvas_format_of. */
tn_status tn_picture_format(const tn_picture *picture, tn_canvas_format *format, tn_error *error);

#endif
