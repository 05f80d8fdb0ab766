/* What Prolog programs of rules begin with, and what names they may not define. */
#ifndef TARTAN_PLAN_TEXT_PROLOG_PRELUDE_H
#define TARTAN_PLAN_TEXT_PROLOG_PRELUDE_H

#include <stdbool.h>

/* The judgements of docs/plan-language.md that are not a rule's own. w(N, Plan) is a plan of N trays, [I, J) a stretch
 * of it. */
extern const char tn_prolog_prelude[];

/* Is this a built-in predicate of one argument, which a program may not define? */
bool tn_prolog_built_in(const char *name);

#endif
