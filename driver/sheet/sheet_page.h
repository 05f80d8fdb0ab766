/* A generation as a page of HTML that needs nothing else: each member's form turns in space, with its number, parents
 * and surroundings. */
#ifndef TARTAN_DRIVER_SHEET_SHEET_PAGE_H
#define TARTAN_DRIVER_SHEET_SHEET_PAGE_H

#include "driver/breed/evolve.h"

/* A generation on a sheet, to choose from. */

#define TN_SHEET_NAME_SIZE 32

/* Draws all members, numbered from 1, to `files` or (NULL) into the run's folder: sheet-0000.svg for the first
 * generation, and so on, which is its name. */
tn_status tn_run_sheet(const tn_run *run, const tn_run_files *files, char name[TN_SHEET_NAME_SIZE], tn_error *error);

#define TN_SHEET_PAGE "sheet.html"

/* Writes it to `files` or (NULL) into the run's folder. *written: false if what is bred has no forms in space. */
tn_status tn_sheet_page(const tn_run *run, const tn_run_files *files, bool *written, tn_error *error);

#endif
