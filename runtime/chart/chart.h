/* Charts of how plans, or whatever else is counted, are spread over numbers: a histogram, and a front over what lies
 * behind it.
 *
 * What is drawn comes as doubles, and what is read beside it as texts, which the caller has written exactly. Everything
 * is borrowed while it is drawn. Errors as in canvas.h.
 */
#ifndef TARTAN_CHART_CHART_H
#define TARTAN_CHART_CHART_H

#include "runtime/base/picture.h"

#define TN_CHART_FACTS_MAX 8u
#define TN_CHART_PANELS_MAX 3u
#define TN_CHART_COLUMNS_MAX 6u
#define TN_CHART_ROWS_SHOWN 40u /* of a table; what is below is counted */

/* A value (from = to) or a bin of values, and which share of all has it: 0 to 1. */
typedef struct tn_chart_bar {
    double from, to, share;
} tn_chart_bar;

/* A word and what it stands for: "most", "248.4 m2". */
typedef struct tn_chart_fact {
    const char *name, *value;
} tn_chart_fact;

typedef struct tn_histogram {
    const char *title, *doc;  /* of the measure */
    const char *about;        /* a line: how many there are, and of what */
    const char *unit;         /* "" of plain numbers */
    const tn_chart_bar *bars; /* ascending; none: nothing is counted */
    size_t count;
    double least, quartiles[3], most, mean;
    tn_chart_fact facts[TN_CHART_FACTS_MAX];
    size_t fact_count;
} tn_histogram;

tn_status tn_histogram_draw(const tn_histogram *histogram, tn_picture *to, tn_error *error);

/* A measure as an axis of a panel. */
typedef struct tn_chart_axis {
    const char *name, *unit;
    bool most;                /* more is better, else less */
    const tn_chart_bar *bars; /* all values, ascending */
    size_t count;
} tn_chart_axis;

typedef struct tn_chart_point {
    double x, y;
} tn_chart_point;

/* Two measures against each other. */
typedef struct tn_front_panel {
    tn_chart_axis across, up;
    const tn_chart_point *cloud; /* of a sample */
    size_t cloud_count;
    const tn_chart_point *front; /* numbered as the rows of the table */
    size_t front_count;
    bool stairs; /* the front is by these two alone: what lies beyond the steps is not reached */
} tn_front_panel;

typedef struct tn_front_drawing {
    const char *title, *about, *note;
    tn_front_panel panels[TN_CHART_PANELS_MAX];
    size_t panel_count;
    const char *headings[TN_CHART_COLUMNS_MAX]; /* of the table, besides the number of a point */
    const char *const *cells;                   /* [rows][columns] */
    size_t rows, columns;
} tn_front_drawing;

tn_status tn_front_draw(const tn_front_drawing *drawing, tn_picture *to, tn_error *error);

#endif
