/* PNG and PDF pictures by the part `draw`, which is loaded when the first one is made. */
#include "runtime/base/part.h"
#include "runtime/draw/cairo/cairo.h"

typedef tn_status begin(FILE *out, const tn_cairo_options *options, tn_watch *watch, tn_device **device,
                        tn_error *error);

static begin *find(const char *function, const char *wanted, tn_error *error)
{
    tn_error why;
    begin *found = (begin *)tn_part_find(TN_WITH_DRAW, function, wanted, &why);
    if (!found && error) {
        *error = why;
        tn_error_help(error, "make an .svg, or %s", why.help);
    }
    return found;
}

tn_status tn_png_new(FILE *out, const tn_cairo_options *options, tn_watch *watch, tn_device **device, tn_error *error)
{
    *device = NULL;
    begin *png = find("tn_png_new", "a picture as PNG", error);
    return png ? png(out, options, watch, device, error) : TN_INVALID;
}

tn_status tn_pdf_new(FILE *out, const tn_cairo_options *options, tn_watch *watch, tn_device **device, tn_error *error)
{
    *device = NULL;
    begin *pdf = find("tn_pdf_new", "a picture as PDF", error);
    return pdf ? pdf(out, options, watch, device, error) : TN_INVALID;
}
