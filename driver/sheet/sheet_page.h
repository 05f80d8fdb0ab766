/* A generation as a page of HTML that needs nothing else: each member's form turns in space, with its number, parents
 * and surroundings. */
#ifndef TARTAN_DRIVER_SHEET_SHEET_PAGE_H
#define TARTAN_DRIVER_SHEET_SHEET_PAGE_H

#include "driver/breed/evolve.h"

#define TN_SHEET_PAGE "sheet.html"

/* Writes it to `files` or (NULL) into the run's folder. *written: false if what is bred has no forms in space. */
tn_status tn_sheet_page(const tn_run *run, const tn_run_files *files, bool *written, tn_error *error);

#endif
