/* The plain way of a pass, which the fast one is held against: every edge asks the guards' code for its successor, and
 * the turtle runs the successor's code for every edge that is replaced (internal to the growth engine).
 *
 * It has no table of templates by label, no bits of contexts, no chunks and no rows. Joining and all that follows is
 * the same for both ways.
 */
#ifndef TARTAN_GROWTH_PASS_INTERPRET_H
#define TARTAN_GROWTH_PASS_INTERPRET_H

#include "runtime/growth/pass/pass.h"

/* As tn_pass_match: all replacements, in order, in the pass's list. */
tn_status tn_interpret_match(tn_pass *pass, tn_error *error);

/* As tn_pass_rewrite, of that list. */
tn_status tn_interpret_rewrite(tn_pass *pass, tn_error *error);

#endif
