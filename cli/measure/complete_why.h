/* Why no plan of a library completes an open plan: the first written tray that leaves none. */
#ifndef TARTAN_CLI_MEASURE_COMPLETE_WHY_H
#define TARTAN_CLI_MEASURE_COMPLETE_WHY_H

#include <stdio.h>

#include "runtime/plan/measure/complete.h"

/* Writes a line or two. The open plan is one that nothing completes. */
tn_status tn_complete_why(const tn_library *library, const tn_open_plan *open, FILE *out, tn_error *error);

#endif
