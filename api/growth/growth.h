/* What the files of the C interface to growing share. */
#ifndef TARTAN_API_GROWTH_GROWTH_H
#define TARTAN_API_GROWTH_GROWTH_H

#include "api/geometry/mesh.h"
#include "runtime/growth/growth.h"
#include "runtime/growth/study.h"

struct tartan_growth {
    tn_growth_system *system;
    tn_study study; /* what the module says, with the caller's options and surroundings */
    tn_growth *growth;
    uint32_t steps; /* complete ones */
    bool broken;    /* the map is not that of `steps`: a step failed */
};

/* Sees to it that the map is that of the last complete step. */
tartan_status tn_api_growth_mend(tartan_growth *growth, tartan_error *error);

#endif
