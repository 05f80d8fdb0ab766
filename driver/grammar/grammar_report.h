/* What analysing a grammar finds, as diagnostics with their places. */
#ifndef TARTAN_DRIVER_GRAMMAR_GRAMMAR_REPORT_H
#define TARTAN_DRIVER_GRAMMAR_GRAMMAR_REPORT_H

#include "driver/open/open.h"

/* Warns (W155) where the sentences of the opened file's grammar tend to grow without end; with `figures` also notes its
 * sizes, its shallowest sentence, and how many derivations there are. */
tn_status tn_grammar_report(tn_opened *opened, bool figures, tn_error *error);

#endif
