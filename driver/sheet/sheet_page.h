/* A generation as a page of HTML that needs nothing else: each member's form turns in space, with its number, parents
 * and surroundings. */
#ifndef TARTAN_DRIVER_SHEET_SHEET_PAGE_H
#define TARTAN_DRIVER_SHEET_SHEET_PAGE_H

#include "driver/breed/evolve.h"

/* Writes sheet.html into the run's folder. `path` (of `size` bytes) is where; "" where what is bred has no forms in
 * space. */
tn_status tn_sheet_page(const tn_run *run, char *path, size_t size, tn_error *error);

#endif
