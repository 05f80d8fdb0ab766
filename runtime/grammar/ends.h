/* Whether every non-terminal of a module's grammars has a sentence: expanding, growing trees and analysing rely on it.
 */
#ifndef TARTAN_GRAMMAR_ENDS_H
#define TARTAN_GRAMMAR_ENDS_H

#include "runtime/module/verify.h"

/* Refuses a module in which each production of some non-terminal leads back to it, or to another such. What
 * { } and [ ] hold may be left out. The productions' code has been verified. Linear in their size. */
tn_status tn_grammar_check_ends(const tn_checker *checker);

#endif
