/* Names of what the growth sections number. */
#include "runtime/growth/model/records.h"

const char *const tn_measured_names[TN_MEASURED_COUNT] = {
    "size",     "smoothness",    "soft-boundary", "subdivisions",    "symmetry",    "undulation",
    "vertices", "edges",         "faces",         "width",           "depth",       "height",
    "area",     "volume",        "planarity",     "worst-planarity", "edge-spread", "smallest-angle",
    "span",     "crossed-faces", "turned-faces",  "crossings",       "sunlit",      "distance-to"};

const char *const tn_age_suffixes[TN_AGE_CHANGE_COUNT] = {"", "_i", "_i+1", "_i-1"};
