/* Coverage of rules: for each part of each rule of a file, how many plans' decisions would be others if the part never
 * matched, and whether some test case would notice.
 */
#ifndef TARTAN_DRIVER_COVERAGE_H
#define TARTAN_DRIVER_COVERAGE_H

#include "driver/findings.h"
#include "runtime/plan/text.h"

/* Appends a table of the rules of the file itself. Plans are those that the library named generates (NULL: the only one
 * of the file), or, where the file has none, all of up to TN_COVERAGE_TRAYS trays. A rule past the state limit is
 * reported (a note) and left out. max_states: 0 is the default. */
#define TN_COVERAGE_TRAYS 4u
tn_status tn_coverage_report(tn_opened *opened, const char *library, uint32_t max_states, tn_buffer *out);

#endif
