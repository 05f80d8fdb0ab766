/* Faults of a grown surface, whose map is right all the same: faces whose outline crosses itself, and faces
 * turned over onto their neighbours. Growing prevents neither (docs/growth.md); whoever grows wants to know. */
#ifndef TARTAN_GROWTH_FAULTS_H
#define TARTAN_GROWTH_FAULTS_H

#include "runtime/growth/growth.h"

typedef struct tn_fault {
    uint32_t count;  /* faces */
    double place[3]; /* the middle of the first of them, as faces are written, in model units */
} tn_fault;

typedef struct tn_faults {
    tn_fault crossed;  /* the outline crosses itself, seen along the face's normal; touching is none */
    tn_fault inverted; /* the normal points against that of the faces around, by more than 150 degrees */
} tn_faults;

/* Looks at every face of the growth as it stands: linear in edges, on as many threads as it grows with. TN_MEMORY. */
tn_status tn_faults_find(const tn_growth *growth, tn_faults *faults, tn_error *error);

#endif
