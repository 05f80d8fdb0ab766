/* What `tartan test` answers, for people. */
#ifndef TARTAN_CLI_PLAN_TEST_H
#define TARTAN_CLI_PLAN_TEST_H

#include <stdio.h>

#include "ask/session/requests.h"

/* "7 passed, 1 failed, 2 to do" */
void tn_tested_counts_text(const tn_tested *tested, FILE *out);

/* What designs of boxes measure. */
void tn_tested_designs_text(const tn_tested *tested, FILE *out);

#endif
