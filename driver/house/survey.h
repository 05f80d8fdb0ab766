/* What a form says that comes to nothing, found by going through all trays of its schema: functions that no cell may
 * have, tiles and openings that never fit, lines of faces that never apply, values that no section has, materials that
 * none uses (W201 to W207).
 *
 * A form whose trays and lines are too many to go through (a hundred million decisions) is left out without a word.
 */
#ifndef TARTAN_DRIVER_HOUSE_SURVEY_H
#define TARTAN_DRIVER_HOUSE_SURVEY_H

#include "driver/open/findings.h"

/* Warns about the forms of the opened file itself, not of those that it uses. TN_MEMORY. */
tn_status tn_house_survey(tn_opened *opened, tn_error *error);

#endif
