/* Expressions, open plans and plans that the command line gives. */
#ifndef TARTAN_COMPILER_PLAN_ASK_H
#define TARTAN_COMPILER_PLAN_ASK_H

#include "compiler/plan/check/check.h"

/* Reads them as sources of their own, "--where" and what the questions call the plan; what is wrong is reported there.
 */
tn_status tn_ask(tn_arena *arena, tn_diagnostics *diagnostics, tn_sources *sources, const tn_questions *questions,
                 tn_asked_for *asked, tn_error *error);

#endif
