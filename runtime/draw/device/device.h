/* What draws a picture: the operations that tn_paint (runtime/draw/paint.h) is made of, which each kind of file does in
 * its own way.
 *
 * All places and lengths are in points of the page (1/72 inch), y downwards; no transformation is left to a device.
 * What is passed is the caller's and lasts for the call. An operation fails with TN_MEMORY, TN_IO or TN_INTERNAL;
 * `finish` alone has an error to fill. */
#ifndef TARTAN_DRAW_DEVICE_DEVICE_H
#define TARTAN_DRAW_DEVICE_DEVICE_H

#include "runtime/base/watch.h"
#include "runtime/draw/device/hatches.h"

/* What something that is drawn means (layers.def). */
typedef enum tn_layer {
#define LAYER(id, aia, iso, colour, weight) TN_LAYER_##id,
#include "runtime/draw/device/layers.def"
#undef LAYER
    TN_LAYER_COUNT
} tn_layer;

typedef enum tn_drawn_step_kind { TN_DRAWN_MOVE, TN_DRAWN_LINE, TN_DRAWN_ARC, TN_DRAWN_CLOSE } tn_drawn_step_kind;

/* A step of a path. An arc is one of a circle around (x, y), from an angle to another, in radians from the x axis
 * towards the y axis, and begins where the step before it ends; it runs backwards if `to` is less than `from`. */
typedef struct tn_drawn_step {
    tn_drawn_step_kind kind;
    double x, y;
    double radius, from, to; /* arc */
} tn_drawn_step;

/* Every path begins with a MOVE, and after a CLOSE there is another. */
typedef struct tn_drawn_path {
    const tn_drawn_step *steps;
    size_t count;
    bool even_odd; /* filled where it is wound around an odd number of times; otherwise any but 0 */
} tn_drawn_path;

/* Parts from 0 to 1. */
typedef struct tn_ink {
    double red, green, blue, opacity;
} tn_ink;

typedef enum tn_line_cap { TN_CAP_BUTT, TN_CAP_ROUND } tn_line_cap;
typedef enum tn_line_join { TN_JOIN_MITRE, TN_JOIN_ROUND } tn_line_join;

#define TN_DASHES_MAX 4u
#define TN_MITRE_LIMIT 10.0

typedef struct tn_pen {
    double width;
    tn_line_cap cap;
    tn_line_join join;
    double dashes[TN_DASHES_MAX]; /* lengths of dashes and gaps in turn */
    uint32_t dash_count;          /* 0: a whole line */
    double dash_offset;
} tn_pen;

typedef enum tn_align { TN_ALIGN_LEFT, TN_ALIGN_CENTRE, TN_ALIGN_RIGHT } tn_align;

/* A line of text: what of it stands at (x, y), which is on its baseline, and how far it is turned there, in radians. */
typedef struct tn_lettering {
    double x, y, angle;
    double size;
    bool bold;
    tn_align align;
    const char *text; /* UTF-8 */
} tn_lettering;

/* Pixels, as cairo's ARGB32 has them (premultiplied, 4 bytes in the machine's order, rows from above), drawn with the
 * upper left corner at (x, y), each a square with a side of `pixel`. */
typedef struct tn_pixels {
    const uint32_t *values;
    uint32_t width, height;
    double x, y, pixel;
} tn_pixels;

/* A pattern over a region: its lines, `scale` times as far apart, counted from (x, y). */
typedef struct tn_hatched {
    tn_hatch hatch;
    double x, y, angle, scale;
} tn_hatched;

/* Where a symbol is used: mirrored from left to right, then turned, then its origin at (x, y). */
typedef struct tn_symbol_place {
    double x, y, angle;
    bool mirrored;
} tn_symbol_place;

/* A drawing to scale: its frame on the page, and where its own origin stands, from which it is measured. smaller: how
 * many times smaller than the others of the page it is; 1: as large. */
typedef struct tn_drawn_view {
    const char *name;
    double x, y, width, height;
    double origin[2];
    double smaller;
} tn_drawn_view;

/* A length that is given: its ends, and those of the line that shows it. text_at: the middle of its text, if that is
 * moved away from the line. */
typedef struct tn_drawn_dimension {
    double from[2], to[2], line[2][2];
    const char *text;
    double text_at[2];
    bool moved;
} tn_drawn_dimension;

typedef struct tn_device tn_device;

typedef struct tn_device_operations {
    tn_status (*fill)(tn_device *device, const tn_drawn_path *path, const tn_ink *ink);
    tn_status (*stroke)(tn_device *device, const tn_drawn_path *path, const tn_pen *pen, const tn_ink *ink);
    tn_status (*text)(tn_device *device, const tn_lettering *lettering, const tn_ink *ink);
    tn_status (*pixels)(tn_device *device, const tn_pixels *pixels);
    /* From now on only within the path, too; ends what began last. */
    tn_status (*begin_clip)(tn_device *device, const tn_drawn_path *path);
    tn_status (*end_clip)(tn_device *device);
    /* A path filled with a pattern, by a pen. NULL: lines are drawn. */
    tn_status (*hatch)(tn_device *device, const tn_drawn_path *path, const tn_hatched *hatched, const tn_pen *pen,
                       const tn_ink *ink);
    /* What is drawn until its end, with its origin at (0, 0) of the page, is the symbol of that number, the first being
     * 0 and each begun once; NULL: symbols are drawn wherever they are used. */
    tn_status (*begin_symbol)(tn_device *device, size_t number, const char *name);
    tn_status (*end_symbol)(tn_device *device);
    tn_status (*use_symbol)(tn_device *device, size_t number, const tn_symbol_place *place);
    /* What is drawn until its end shows the dimension; NULL: nothing is said. */
    tn_status (*begin_dimension)(tn_device *device, const tn_drawn_dimension *dimension);
    tn_status (*end_dimension)(tn_device *device);
    /* What is drawn until its end belongs to a drawing to scale; NULL: nothing is said. */
    tn_status (*begin_view)(tn_device *device, const tn_drawn_view *view);
    tn_status (*end_view)(tn_device *device);
    /* What is drawn until its end is said to be that; NULL: nothing is said. */
    tn_status (*begin_group)(tn_device *device, const char *name, size_t number);
    tn_status (*end_group)(tn_device *device);
    /* A place that belongs to the group, though nothing is seen of it; NULL: nothing is said. */
    tn_status (*target)(tn_device *device, double x, double y, double width, double height);
    tn_status (*next_page)(tn_device *device, double width, double height); /* NULL: there is only one */
    /* Writes what is left to write. The watch, which may be NULL, may end that: TN_IO. */
    tn_status (*finish)(tn_device *device, tn_watch *watch, tn_error *error);
    void (*free)(tn_device *device);
} tn_device_operations;

/* Begins what a device is. */
struct tn_device {
    const tn_device_operations *operations;
    double pixel;   /* the side of a pixel, in points; 0: there are none */
    bool outlines;  /* what is filled does not cover what was drawn below it */
    tn_layer layer; /* of what is being drawn */
};

#endif
