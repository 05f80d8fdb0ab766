/* What the libraries of houses of an opened file mean, and its rules about houses, said where they are written: clauses
 * that contradict one another or change nothing (W005, W006, W008), values of the section that no house has (W213), and
 * rules that match no house, every house (W001, W002), or the same houses as another rule (W004).
 *
 * All of it is counted, so it is exact. What would take too many states is left out, and one note for each library says
 * so.
 */
#ifndef TARTAN_DRIVER_HOUSE_ANALYSIS_H
#define TARTAN_DRIVER_HOUSE_ANALYSIS_H

#include "driver/open/open.h"

/* The states of one count if nobody says another limit; of all counts of a library: driver/house/counter.h. */
#define TN_HOUSE_ANALYSIS_STATES 50000u

/* Adds what is found in libraries of the file itself to its diagnostics, after its forms were looked at
 * (driver/plan/analysis.h); of a module nothing is found. max_states: 0 is the default. On failure the diagnostics say
 * why. */
tn_status tn_house_analyse(tn_opened *opened, uint32_t max_states);

#endif
