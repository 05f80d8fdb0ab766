/* What is worth saying of a run's first generation before more are bred from it. All else comes from these sentences: a
 * run that begins with a few different ones, or with none that looks at the data, finds little. */
#ifndef TARTAN_DRIVER_BREED_FIRST_LOOK_H
#define TARTAN_DRIVER_BREED_FIRST_LOOK_H

#include "driver/breed/evolve.h"

/* Finds it, of a run whose first generation was just made. A help says only what was tried: where it says that another
 * depth gives more, a generation of that depth was made. TN_MEMORY and the like, or TN_OK. */
tn_status tn_run_first_look(const tn_run *run, tn_first_look *look, tn_error *error);

#endif
