/* Counts the plans of libraries for schemas of libraries (tn_census_taker): loads what the compiler made so far, and
 * asks the engine of plans. */
#ifndef TARTAN_DRIVER_OPEN_CENSUS_H
#define TARTAN_DRIVER_OPEN_CENSUS_H

#include "compiler/common/compilation.h"

#define TN_CENSUS_ROWS_MAX 10000u     /* kinds of trays */
#define TN_CENSUS_BRIEF_STATES 20000u /* of automata, while an editor waits */
#define TN_CENSUS_BRIEF_VALUES 50000u /* the same of what is held of a joint distribution */

extern const tn_census_taker tn_plan_census;

#endif
