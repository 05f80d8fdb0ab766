/* Makes pictures as SVG, PNG, PDF or DXF: opens what they are written to, and the device that writes them. */
#include "runtime/draw/canvas.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/file.h"
#include "runtime/draw/cairo/cairo.h"
#include "runtime/draw/device/dxf.h"
#include "runtime/draw/device/svg.h"

enum { DPI_DEFAULT = 150 };

struct tn_canvas {
    tn_canvas_format format;
    tn_profile profile;
    tn_paint *paint;
    tn_output output; /* of a picture in memory only its stream is used */
    char *path;       /* owned; NULL: in memory */
    tn_picture *memory;
    tn_watch *watch; /* or NULL */
};

/* What fills a page takes work and room by its size. */
static tn_status check_page(double width, double height, tn_error *error)
{
    if (width <= TN_CANVAS_SIDE_MAX && height <= TN_CANVAS_SIDE_MAX)
        return TN_OK;
    tn_status status = tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE,
                               "the picture would be %.0f x %.0f mm large; the limit is %.0f a side", width * 25.4 / 72,
                               height * 25.4 / 72, TN_CANVAS_SIDE_MAX * 25.4 / 72);
    tn_error_help(error, "draw less of it, or to a smaller scale");
    return status;
}

static tn_status new_device(const tn_canvas *canvas, const tn_canvas_options *options, tn_device **device,
                            tn_error *error)
{
    FILE *out = canvas->output.stream;
    const tn_cairo_options by_cairo = {options->width, options->height, options->dpi ? options->dpi : DPI_DEFAULT,
                                       options->title};
    if (canvas->format == TN_CANVAS_PNG)
        return tn_png_new(out, &by_cairo, canvas->watch, device, error);
    tn_status status = check_page(options->width, options->height, error);
    if (status != TN_OK)
        return status;
    if (canvas->format == TN_CANVAS_PDF)
        return tn_pdf_new(out, &by_cairo, canvas->watch, device, error);
    const tn_dxf_options as_dxf = {options->width, options->height, options->title,
                                   options->scale, options->feet,   tn_profile_of(canvas->profile, options->feet)};
    if (canvas->format == TN_CANVAS_DXF)
        return tn_dxf_new(out, &as_dxf, device, error);
    bool element = canvas->memory && canvas->memory->format == TN_CANVAS_BY_PATH;
    const tn_svg_options as_svg = {options->width, options->height, element, element ? canvas->memory->number : 0};
    return tn_svg_new(out, &as_svg, device, error);
}

/* The stream is there: a device that writes to it, and a paint on that. */
static tn_status start(tn_canvas *made, const tn_canvas_options *options, tn_canvas **canvas, tn_error *error)
{
    tn_device *device = NULL;
    tn_status status = new_device(made, options, &device, error);
    if (status == TN_OK && !(made->paint = tn_paint_new(device)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        *canvas = made;
    else
        tn_canvas_free(made);
    return status;
}

/* A canvas whose file is in memory. */
static tn_status new_in_memory(tn_picture *picture, const tn_canvas_options *options, tn_canvas **canvas,
                               tn_error *error)
{
    tn_canvas *made = calloc(1, sizeof *made);
    if (!made)
        return tn_fail_memory(error);
    made->format = picture->format == TN_CANVAS_BY_PATH ? TN_CANVAS_SVG : picture->format;
    made->profile = picture->profile;
    made->memory = picture;
    made->watch = picture->watch;
    made->output.stream = open_memstream(&picture->element, &picture->size);
    if (made->output.stream)
        return start(made, options, canvas, error);
    tn_canvas_free(made);
    return tn_fail_memory(error);
}

static tn_status new_file(const tn_picture *picture, tn_canvas_format format, const tn_canvas_options *options,
                          tn_canvas **canvas, tn_error *error)
{
    tn_canvas *made = calloc(1, sizeof *made);
    if (!made || !(made->path = strdup(picture->path))) {
        free(made);
        return tn_fail_memory(error);
    }
    made->format = format;
    made->profile = picture->profile;
    made->watch = picture->watch;
    tn_status status = tn_output_open(made->path, &made->output, error);
    if (status == TN_OK)
        return start(made, options, canvas, error);
    free(made->path);
    free(made);
    return status;
}

tn_status tn_canvas_open(tn_picture *picture, const tn_canvas_options *options, tn_canvas **canvas, tn_error *error)
{
    tn_canvas_format format;
    tn_status status = tn_picture_format(picture, &format, error);
    if (status != TN_OK)
        return status;
    return picture->path ? new_file(picture, format, options, canvas, error)
                         : new_in_memory(picture, options, canvas, error);
}

tn_status tn_canvas_begin(tn_picture *picture, double width, double height, const char *title, tn_canvas **canvas,
                          tn_error *error)
{
    const tn_canvas_options options = {.width = width, .height = height, .dpi = picture->dpi, .title = title};
    return tn_canvas_open(picture, &options, canvas, error);
}

tn_status tn_canvas_new(const char *path, tn_canvas_format format, const tn_canvas_options *options, tn_canvas **canvas,
                        tn_error *error)
{
    const tn_picture picture = {.path = path};
    return new_file(&picture, format, options, canvas, error);
}

bool tn_canvas_stopped(const tn_canvas *canvas)
{
    return tn_watch_stopped(canvas->watch);
}

tn_paint *tn_canvas_paint(const tn_canvas *canvas)
{
    return canvas->paint;
}

tn_status tn_canvas_page(tn_canvas *canvas, double width, double height, tn_error *error)
{
    if (canvas->format != TN_CANVAS_PDF)
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "only a PDF has more than one page");
    tn_status status = check_page(width, height, error);
    return status == TN_OK ? tn_paint_next_page(canvas->paint, width, height, error) : status;
}

/* The picture's bytes are the caller's now. */
static tn_status close_memory(tn_canvas *canvas, tn_error *error)
{
    bool failed = ferror(canvas->output.stream) != 0;
    failed |= fclose(canvas->output.stream) != 0;
    canvas->output.stream = NULL;
    if (!failed)
        canvas->memory = NULL;
    return failed ? tn_fail_memory(error) : TN_OK;
}

/* What was drawn into memory and not committed goes. */
static void discard_memory(tn_canvas *canvas)
{
    if (canvas->output.stream)
        fclose(canvas->output.stream);
    canvas->output.stream = NULL;
    free(canvas->memory->element);
    canvas->memory->element = NULL;
}

tn_status tn_canvas_commit(tn_canvas *canvas, tn_error *error)
{
    if (tn_canvas_stopped(canvas))
        return tn_fail_stopped(canvas->watch, error);
    tn_status drawn = tn_paint_finish(canvas->paint, canvas->watch, error);
    if (tn_canvas_stopped(canvas))
        return tn_fail_stopped(canvas->watch, error);
    if (drawn != TN_OK && drawn != TN_IO)
        return drawn;
    /* Committing knows better why something cannot be written. */
    tn_status status = canvas->memory ? close_memory(canvas, error) : tn_output_commit(&canvas->output, error);
    if (status == TN_OK && drawn == TN_IO)
        status = tn_fail(error, TN_IO, E_CANNOT_WRITE, "%.200s cannot be written",
                         canvas->path ? canvas->path : "the picture");
    return status;
}

void tn_canvas_free(tn_canvas *canvas)
{
    if (!canvas)
        return;
    tn_paint_free(canvas->paint);
    if (canvas->memory)
        discard_memory(canvas);
    else
        tn_output_discard(&canvas->output);
    free(canvas->path);
    free(canvas);
}
