/* A generation on a sheet, to choose from. */
#ifndef TARTAN_DRIVER_BREED_EVOLVE_SHEET_H
#define TARTAN_DRIVER_BREED_EVOLVE_SHEET_H

#include "driver/breed/evolve.h"

/* Draws all members, numbered from 1, into the run's folder: sheet-0000.svg for the first generation, and so on. `path`
 * (of `size` bytes) is where. */
tn_status tn_run_sheet(tn_run *run, char *path, size_t size, tn_error *error);

#endif
