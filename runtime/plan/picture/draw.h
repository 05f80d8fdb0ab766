/* Plans as a picture sheet.
 *
 * A schema whose fields have roles (length, level, public-end, great-hall, band) is drawn to scale, like the figures of
 * the LaHave paper: each tray as wide as its length, its bands stacked in schema order from the spine (the first band
 * that is never absent, whose upper edge is straight) upwards and downwards, solid fills hatched, void ones white,
 * absent ones not drawn. A schema without is drawn as a table: a row of boxes with the values written in.
 */
#ifndef TARTAN_PLAN_PICTURE_DRAW_H
#define TARTAN_PLAN_PICTURE_DRAW_H

#include "runtime/base/picture.h"
#include "runtime/plan/schema/schema.h"

typedef struct tn_drawn_plan {
    const tn_tray *trays;
    size_t length;
    const char *number;  /* what stands under it: its rank or its line, in digits; or NULL */
    const char *heading; /* begins a group, in a row of its own below this; NULL: goes on with the one before */
    const char *caption; /* a line above it; or NULL */
} tn_drawn_plan;

/* The most plans of one drawing, unless more are allowed. */
#define TN_DRAW_PLANS_DEFAULT 5000u

typedef struct tn_draw_options {
    const char *title;        /* or NULL: the schema's name */
    const char *doc;          /* a line or two below it; or NULL */
    const char *number_name;  /* what the numbers are: "rank", "line" */
    const char *const *notes; /* how it was made, a line each */
    size_t note_count;
    const char *paper; /* see scales.h; NULL: the smallest of three that holds all */
    uint32_t scale;    /* 1:scale; 0: the largest usual one that fits */
    uint32_t columns;  /* plans in a row; 0: as many as fit */
    uint32_t dpi;      /* of a PNG; 0: 150 */
    size_t max_plans;  /* 0: TN_DRAW_PLANS_DEFAULT; E0820 past it */
} tn_draw_options;

/* Draws the plans. A PDF has as many pages as it takes; the
 * others are one sheet, as high as it takes. E0820 where a PNG would be too large, E0902 where the file cannot be
 * written, E0904 for another extension or an unknown paper. */
tn_status tn_plans_draw(const tn_schema *schema, const tn_drawn_plan *plans, size_t count,
                        const tn_draw_options *options, tn_picture *to, tn_error *error);

#endif
