/* A generation on a sheet, to choose from. */
#ifndef TARTAN_DRIVER_SHEET_SHEET_PICTURE_H
#define TARTAN_DRIVER_SHEET_SHEET_PICTURE_H

#include "driver/breed/evolve.h"

#define TN_SHEET_NAME_SIZE 32

/* Draws all members, numbered from 1, to `files` or (NULL) into the run's folder: sheet-0000.svg for the first
 * generation, and so on, which is its name. */
tn_status tn_run_sheet(const tn_run *run, const tn_run_files *files, char name[TN_SHEET_NAME_SIZE], tn_error *error);

#endif
