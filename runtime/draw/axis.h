/* The scale of a chart's axis: where its marks stand and how they are written. */
#ifndef TARTAN_DRAW_AXIS_H
#define TARTAN_DRAW_AXIS_H

#include <stddef.h>

/* 1, 2 or 5 times a power of ten, so that at most `marks` of them fit into the range. */
double tn_axis_step(double range, double marks);

/* Writes a mark that is a multiple of the step, its thousands apart: "1,250", "0.05". */
void tn_axis_write(double value, double step, char *text, size_t size);

#endif
