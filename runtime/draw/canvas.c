/* Makes pictures as SVG, PNG or PDF by cairo. */
#include "runtime/draw/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/file.h"
#include "runtime/draw/png.h"
#include "runtime/draw/svg_ids.h"
#include "runtime/draw/svg_page.h"
#include "runtime/draw/type.h"

enum { DPI_DEFAULT = 150, SIDE_MAX = 32767 };

/* Pictures carry no time, so that they can be made again bit for bit; PDF wants one, and this is the first it can hold.
 */
static const char constant_date[] = "2000-01-01T00:00:00Z";

struct tn_canvas {
    tn_canvas_format format;
    cairo_surface_t *surface;
    cairo_t *context;
    tn_output output;
    char *path;
    char *text; /* of an SVG, until its ids are numbered */
    size_t text_size, text_room;
    tn_picture *page;   /* or NULL */
    tn_picture *memory; /* or NULL */
    FILE *letters;      /* of a page: its lettering as it is set */
    char *lettering;
    size_t lettering_size;
    bool out_of_memory;
    tn_watch *watch; /* or NULL */
};

static cairo_status_t write_stream(void *closure, const unsigned char *data, unsigned int length)
{
    tn_canvas *canvas = closure;
    if (tn_canvas_stopped(canvas))
        return CAIRO_STATUS_WRITE_ERROR;
    return fwrite(data, 1, length, canvas->output.stream) == length ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

static cairo_status_t write_text(void *closure, const unsigned char *data, unsigned int length)
{
    tn_canvas *canvas = closure;
    if (tn_canvas_stopped(canvas))
        return CAIRO_STATUS_WRITE_ERROR;
    if (!tn_array_reserve(&canvas->text, &canvas->text_room, canvas->text_size, length, 1)) {
        canvas->out_of_memory = true;
        return CAIRO_STATUS_NO_MEMORY;
    }
    memcpy(canvas->text + canvas->text_size, data, length);
    canvas->text_size += length;
    return CAIRO_STATUS_SUCCESS;
}

static tn_status new_image(tn_canvas *canvas, const tn_canvas_options *options, tn_error *error)
{
    double dpi = options->dpi ? options->dpi : DPI_DEFAULT, width = ceil(options->width * dpi / 72),
           height = ceil(options->height * dpi / 72);
    if (width > SIDE_MAX || height > SIDE_MAX || width * height > (double)TN_CANVAS_PIXELS_MAX) {
        tn_status status = tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE,
                                   "the picture would have %.0f x %.0f pixels; the limit is %d a side and %llu in all",
                                   width, height, SIDE_MAX, (unsigned long long)TN_CANVAS_PIXELS_MAX);
        tn_error_help(error, "draw fewer plans, lower --dpi (now %.0f), or make a .pdf, which has pages", dpi);
        return status;
    }
    canvas->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
    cairo_surface_set_device_scale(canvas->surface, dpi / 72, dpi / 72);
    return TN_OK;
}

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

static void new_pdf(tn_canvas *canvas, const tn_canvas_options *options)
{
    canvas->surface = cairo_pdf_surface_create_for_stream(write_stream, canvas, options->width, options->height);
    cairo_pdf_surface_set_metadata(canvas->surface, CAIRO_PDF_METADATA_CREATE_DATE, constant_date);
    cairo_pdf_surface_set_metadata(canvas->surface, CAIRO_PDF_METADATA_MOD_DATE, constant_date);
    cairo_pdf_surface_set_metadata(canvas->surface, CAIRO_PDF_METADATA_CREATOR, "tartan");
    if (options->title)
        cairo_pdf_surface_set_metadata(canvas->surface, CAIRO_PDF_METADATA_TITLE, options->title);
}

static void begin_page(tn_canvas *canvas)
{
    cairo_set_source_rgb(canvas->context, 1, 1, 1);
    cairo_paint(canvas->context);
    cairo_set_source_rgb(canvas->context, 0, 0, 0);
}

static tn_status cairo_failed(tn_canvas *canvas, cairo_status_t status, tn_error *error)
{
    if (status == CAIRO_STATUS_NO_MEMORY || canvas->out_of_memory)
        return tn_fail_memory(error);
    if (status == CAIRO_STATUS_WRITE_ERROR)
        return tn_fail(error, TN_IO, E_CANNOT_WRITE, "%.200s cannot be written", canvas->path);
    return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "the picture cannot be drawn: %s", cairo_status_to_string(status));
}

static tn_status start(tn_canvas *canvas, const tn_canvas_options *options, tn_error *error)
{
    tn_status made = canvas->format == TN_CANVAS_PNG ? new_image(canvas, options, error)
                                                     : check_page(options->width, options->height, error);
    if (made != TN_OK)
        return made;
    if (canvas->format == TN_CANVAS_PDF)
        new_pdf(canvas, options);
    else if (canvas->format == TN_CANVAS_SVG)
        canvas->surface = cairo_svg_surface_create_for_stream(write_text, canvas, options->width, options->height);
    canvas->context = cairo_create(canvas->surface);
    begin_page(canvas);
    cairo_status_t status = cairo_status(canvas->context);
    return status == CAIRO_STATUS_SUCCESS ? TN_OK : cairo_failed(canvas, status, error);
}

/* A canvas that becomes an element of a page. */
static tn_status new_element(tn_picture *page, const tn_canvas_options *options, tn_canvas **canvas, tn_error *error)
{
    tn_canvas *made = calloc(1, sizeof *made);
    if (!made)
        return tn_fail_memory(error);
    made->format = TN_CANVAS_SVG;
    made->page = page;
    made->letters = open_memstream(&made->lettering, &made->lettering_size);
    tn_status status = made->letters ? start(made, options, error) : tn_fail_memory(error);
    if (status == TN_OK && !tn_type_as_text(made->context, made->letters))
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
    made->format = picture->format;
    made->memory = picture;
    made->output.stream = open_memstream(&picture->element, &picture->size);
    tn_status status = made->output.stream ? start(made, options, error) : tn_fail_memory(error);
    if (status == TN_OK)
        *canvas = made;
    else
        tn_canvas_free(made);
    return status;
}

tn_status tn_canvas_open(tn_picture *picture, const tn_canvas_options *options, tn_canvas **canvas, tn_error *error)
{
    tn_canvas_format format;
    tn_status status = tn_picture_format(picture, &format, error);
    if (status != TN_OK)
        return status;
    if (picture->path)
        status = tn_canvas_new(picture->path, format, options, canvas, error);
    else if (picture->format == TN_CANVAS_BY_PATH)
        status = new_element(picture, options, canvas, error);
    else
        status = new_in_memory(picture, options, canvas, error);
    if (status == TN_OK)
        (*canvas)->watch = picture->watch;
    return status;
}

bool tn_canvas_stopped(const tn_canvas *canvas)
{
    return tn_watch_stopped(canvas->watch);
}

tn_status tn_canvas_begin(tn_picture *picture, double width, double height, const char *title, tn_canvas **canvas,
                          tn_error *error)
{
    tn_canvas_options options = {width, height, picture->dpi, title};
    return tn_canvas_open(picture, &options, canvas, error);
}

tn_status tn_canvas_new(const char *path, tn_canvas_format format, const tn_canvas_options *options, tn_canvas **canvas,
                        tn_error *error)
{
    tn_canvas *made = calloc(1, sizeof *made);
    if (!made || !(made->path = strdup(path))) {
        free(made);
        return tn_fail_memory(error);
    }
    made->format = format;
    tn_status status = tn_output_open(made->path, &made->output, error);
    if (status != TN_OK) {
        free(made->path);
        free(made);
        return status;
    }
    status = start(made, options, error);
    if (status == TN_OK)
        *canvas = made;
    else
        tn_canvas_free(made);
    return status;
}

cairo_t *tn_canvas_context(const tn_canvas *canvas)
{
    return canvas->context;
}

tn_status tn_canvas_page(tn_canvas *canvas, double width, double height, tn_error *error)
{
    if (canvas->format != TN_CANVAS_PDF)
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "only a PDF has more than one page");
    tn_status fits = check_page(width, height, error);
    if (fits != TN_OK)
        return fits;
    cairo_show_page(canvas->context);
    cairo_pdf_surface_set_size(canvas->surface, width, height);
    begin_page(canvas);
    cairo_status_t status = cairo_status(canvas->context);
    return status == CAIRO_STATUS_SUCCESS ? TN_OK : cairo_failed(canvas, status, error);
}

static tn_status write_svg(tn_canvas *canvas, tn_error *error)
{
    char *text;
    size_t size;
    tn_status status = tn_svg_renumber(canvas->text, canvas->text_size, "i", &text, &size, error);
    if (status != TN_OK)
        return status;
    fwrite(text, 1, size, canvas->output.stream); /* committing reports what went wrong */
    free(text);
    return TN_OK;
}

/* Where a word stands first in a text that ends with a zero byte, or its end. */
static const char *find(const char *text, const char *word)
{
    const char *at = strstr(text, word);
    return at ? at : text + strlen(text);
}

/* The element: what cairo wrote, from its <svg> on, with the lettering before its end. */
static tn_status write_element(tn_canvas *canvas, tn_error *error)
{
    static const char opening[] = "<svg stroke-miterlimit=\"10\"";
    static const char before[] = "<g font-family=\"DejaVu Sans,Verdana,sans-serif\">\n", after[] = "</g>\n</svg>\n";
    char prefix[32], *text;
    size_t size;
    bool lettered = fclose(canvas->letters) == 0;
    canvas->letters = NULL;
    if (!lettered)
        return tn_fail_memory(error);
    snprintf(prefix, sizeof prefix, "p%u-", canvas->page->number);
    tn_status status = tn_svg_renumber(canvas->text, canvas->text_size, prefix, &text, &size, error);
    if (status != TN_OK)
        return status;
    tn_svg_shorten(text, size);
    const char *begin = find(text, "<svg") + strlen("<svg"), *end = find(begin, "</svg>");
    size_t room = sizeof opening + (size_t)(end - begin) + sizeof before + canvas->lettering_size + sizeof after;
    char *element = malloc(room);
    if (element) {
        int used = snprintf(element, room, "%s%.*s%s%s%s", opening, (int)(end - begin), begin, before,
                            canvas->lettering, after);
        canvas->page->element = element;
        canvas->page->size = (size_t)used;
    }
    free(text);
    return element ? TN_OK : tn_fail_memory(error);
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
    cairo_show_page(canvas->context);
    cairo_status_t drawn = cairo_status(canvas->context);
    if (drawn == CAIRO_STATUS_SUCCESS && canvas->format == TN_CANVAS_PNG)
        drawn = tn_png_write(canvas->surface, canvas->output.stream, canvas->watch);
    cairo_surface_finish(canvas->surface);
    if (drawn == CAIRO_STATUS_SUCCESS)
        drawn = cairo_surface_status(canvas->surface);
    if (tn_canvas_stopped(canvas))
        return tn_fail_stopped(canvas->watch, error);
    /* A write error is left to the commit, which knows the reason. */
    if (drawn != CAIRO_STATUS_SUCCESS && drawn != CAIRO_STATUS_WRITE_ERROR)
        return cairo_failed(canvas, drawn, error);
    if (canvas->page)
        return write_element(canvas, error);
    tn_status status = canvas->format == TN_CANVAS_SVG ? write_svg(canvas, error) : TN_OK;
    if (status == TN_OK)
        status = canvas->memory ? close_memory(canvas, error) : tn_output_commit(&canvas->output, error);
    if (status == TN_OK && drawn == CAIRO_STATUS_WRITE_ERROR)
        status = cairo_failed(canvas, drawn, error);
    return status;
}

void tn_canvas_free(tn_canvas *canvas)
{
    if (!canvas)
        return;
    if (canvas->context)
        cairo_destroy(canvas->context);
    if (canvas->surface)
        cairo_surface_destroy(canvas->surface);
    if (canvas->memory)
        discard_memory(canvas);
    tn_output_discard(&canvas->output);
    if (canvas->letters)
        fclose(canvas->letters);
    free(canvas->lettering);
    free(canvas->text);
    free(canvas->path);
    free(canvas);
}
