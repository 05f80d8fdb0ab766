/* Where a picture goes and of which format it is: what whoever asks for one needs to know. runtime/draw draws it.
 */
#ifndef TARTAN_BASE_PICTURE_H
#define TARTAN_BASE_PICTURE_H

#include "runtime/base/watch.h"

typedef enum tn_canvas_format {
    TN_CANVAS_BY_PATH,
    TN_CANVAS_SVG,
    TN_CANVAS_PNG,
    TN_CANVAS_PDF,
    TN_CANVAS_DXF
} tn_canvas_format;

/* The format that a path's extension asks for (.svg, .png, .pdf, in any case); TN_INVALID (E0904) for another. */
tn_status tn_canvas_format_of(const char *path, tn_canvas_format *format, tn_error *error);

/* By whose custom an office draws: of ISO standards or of the US National CAD Standard. By measures: the latter if the
 * drawing is in feet and inches. */
typedef enum tn_profile { TN_PROFILE_BY_MEASURES, TN_PROFILE_ISO, TN_PROFILE_US } tn_profile;

static inline tn_profile tn_profile_of(tn_profile asked, bool feet)
{
    return asked != TN_PROFILE_BY_MEASURES ? asked : feet ? TN_PROFILE_US : TN_PROFILE_ISO;
}

/* Where a picture goes: to a file, into memory, or into an HTML page as an <svg> element. */
typedef struct tn_picture {
    const char *path;        /* a file; NULL: into memory or a page */
    tn_canvas_format format; /* BY_PATH: what the path's extension says, or, without a path, into a page */
    uint32_t dpi;            /* of a PNG; 0: 150 */
    tn_profile profile;      /* of what offices draw: units, paper, names of layers */
    unsigned number;         /* into a page: which of its pictures, so that no two ids are the same */
    char *element;           /* into memory or a page: what was drawn once it is committed, which the caller frees */
    size_t size;
    tn_watch *watch; /* or NULL: drawing is given up (TN_STOPPED) once this says so */
} tn_picture;

/* The format that a picture will have; TN_CANVAS_SVG into a page. Errors as in tn_canvas_format_of. */
tn_status tn_picture_format(const tn_picture *picture, tn_canvas_format *format, tn_error *error);

#endif
