/* The format of a picture, told from its file's name. */
#include "runtime/base/picture.h"

#include <string.h>
#include <strings.h>

tn_status tn_canvas_format_of(const char *path, tn_canvas_format *format, tn_error *error)
{
    static const char *const extensions[] = {
        [TN_CANVAS_SVG] = ".svg", [TN_CANVAS_PNG] = ".png", [TN_CANVAS_PDF] = ".pdf"};
    const char *dot = strrchr(path, '.');
    for (size_t i = TN_CANVAS_SVG; dot && i < sizeof extensions / sizeof *extensions; i++) {
        if (strcasecmp(dot, extensions[i]) == 0) {
            *format = (tn_canvas_format)i;
            return TN_OK;
        }
    }
    tn_status status =
        tn_fail(error, TN_INVALID, E_USAGE, "%.200s does not say what kind of picture it is to be", path);
    tn_error_help(error, "end its name in .svg, .png or .pdf");
    return status;
}

tn_status tn_picture_format(const tn_picture *picture, tn_canvas_format *format, tn_error *error)
{
    if (picture->path && picture->format == TN_CANVAS_BY_PATH)
        return tn_canvas_format_of(picture->path, format, error);
    *format = picture->format == TN_CANVAS_BY_PATH ? TN_CANVAS_SVG : picture->format;
    return TN_OK;
}
