/* What `tartan diff` answers, as tables for people. */
#ifndef TARTAN_CLI_PLAN_DIFF_TEXT_H
#define TARTAN_CLI_PLAN_DIFF_TEXT_H

#include <stdio.h>

#include "ask/session/requests.h"

/* Plans or houses. */
void tn_diff_text(const tn_compared *compared, FILE *out);

#endif
