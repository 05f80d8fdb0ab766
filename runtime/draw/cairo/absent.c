/* PNG and PDF pictures in a build without the part `draw`: there are none. */
#include "runtime/base/error.h"
#include "runtime/draw/cairo/cairo.h"

static tn_status refuse(const char *wanted, tn_device **device, tn_error *error)
{
    *device = NULL;
    tn_status status = tn_part_absent(TN_WITH_DRAW, wanted, error);
    tn_error_help(error, "make an .svg, or build it with -DTARTAN_WITH_DRAW=ON, which needs cairo (libcairo2-dev)");
    return status;
}

tn_status tn_png_new(FILE *out, const tn_cairo_options *options, tn_watch *watch, tn_device **device, tn_error *error)
{
    (void)out, (void)options, (void)watch;
    return refuse("a picture as PNG", device, error);
}

tn_status tn_pdf_new(FILE *out, const tn_cairo_options *options, tn_watch *watch, tn_device **device, tn_error *error)
{
    (void)out, (void)options, (void)watch;
    return refuse("a picture as PDF", device, error);
}
