#include "runtime/growth/model/records.h"

const char *const tn_measured_names[TN_MEASURED_COUNT] = {
    "size", "smoothness", "soft-boundary", "subdivisions", "symmetry", "undulation", "vertices", "edges", "faces"};
