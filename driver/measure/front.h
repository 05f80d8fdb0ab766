/* The picture of a front: its points over the distribution of the measures. */
#ifndef TARTAN_DRIVER_MEASURE_FRONT_H
#define TARTAN_DRIVER_MEASURE_FRONT_H

#include "driver/plan/library.h"
#include "runtime/base/picture.h"
#include "runtime/plan/measure/pareto.h"

/* Two or three measures of a library, and the front that was found by them. */
typedef struct tn_shown_front {
    const tn_ready_library *ready;
    uint32_t count;
    const uint32_t *measures; /* runtime/plan/measure/named.h */
    const bool *most;
    tn_weighed *weighed; /* by these measures */
    const tn_pareto_front *front;
} tn_shown_front;

/* Of two measures, one panel; of three, one for each two. The points are numbered in their order. What lies behind them
 * is a sample, always the same; the bars beside are of all plans. */
tn_status tn_front_picture(const tn_shown_front *shown, tn_picture *to, tn_error *error);

#endif
