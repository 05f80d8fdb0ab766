/* Patterns of hatches: what a region is filled with that shows a material. */
#ifndef TARTAN_DRAW_DEVICE_HATCHES_H
#define TARTAN_DRAW_DEVICE_HATCHES_H

#include <stddef.h>

typedef enum tn_hatch {
    TN_HATCH_DIAGONAL,   /* anything that is cut */
    TN_HATCH_MASONRY,    /* pairs of lines that rise to the right */
    TN_HATCH_CONCRETE,   /* a line and a dashed one in turn */
    TN_HATCH_TIMBER,     /* lines close together that fall to the right */
    TN_HATCH_INSULATION, /* crossed lines: a net */
    TN_HATCH_EARTH,      /* short lines in threes, across and upright */
    TN_HATCH_TILES,      /* squares */
    TN_HATCH_FALLING,    /* what only tells regions apart: lines that fall to the right */
    TN_HATCH_CROSSED,
    TN_HATCH_LEVEL,
    TN_HATCH_UPRIGHT,
    TN_HATCH_DOTTED,
    TN_HATCH_COUNT
} tn_hatch;

#define TN_HATCH_DASHES 2u

/* Parallel lines without end, in points, y downwards: one through (x, y), turned by `angle` degrees from the x axis
 * upwards; the next lies `apart` beside it, up from it as the line runs to the right, and begins its dashes `shift`
 * farther on. dashes: lengths of a dash and a gap; 0: whole lines. */
typedef struct tn_hatch_lines {
    int angle;
    double x, y;
    double shift, apart;
    double dashes[TN_HATCH_DASHES];
} tn_hatch_lines;

/* The lines that a pattern is made of. */
const tn_hatch_lines *tn_hatch_made_of(tn_hatch hatch, size_t *count);

/* Its name, as in "INSULATION"; that of a pattern that drawing programs know, "ANSI31", with its lines 1/8" apart. */
const char *tn_hatch_name(tn_hatch hatch);

#endif
