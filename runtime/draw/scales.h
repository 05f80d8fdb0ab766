/* Paper sizes and drawing scales, as architects use them. Sizes in points, landscape. */
#ifndef TARTAN_DRAW_SCALES_H
#define TARTAN_DRAW_SCALES_H

#include <stddef.h>

#include "runtime/base/error.h"

typedef struct tn_paper {
    const char *name;
    double width, height;
} tn_paper;

/* The paper named so ("a3", "arch-c", "letter"); TN_INVALID (E0904) with the names there are. */
tn_status tn_paper_find(const char *name, const tn_paper **paper, tn_error *error);

/* The papers to choose from, the smallest first: ISO sizes for metric drawings, ARCH sizes for those in feet. */
size_t tn_paper_choices(bool metric, const tn_paper **papers);

/* The usual scales 1:n, the largest first. */
size_t tn_scale_choices(bool metric, const uint32_t **denominators);

/* How a scale is written on a drawing: 1/16" = 1'-0" or 1:200. */
void tn_scale_write(uint32_t denominator, bool metric, char *text, size_t size);

/* Points on paper for a nanometre in the drawing, at 1:1. */
#define TN_POINTS_PER_NM (72.0 / 25400000.0)

/* The scale of a chart's axis: where its marks stand and how they are written. */

/* 1, 2 or 5 times a power of ten, so that at most `marks` of them fit into the range. */
double tn_axis_step(double range, double marks);

/* Writes a mark that is a multiple of the step, its thousands apart: "1,250", "0.05". */
void tn_axis_write(double value, double step, char *text, size_t size);

#endif
