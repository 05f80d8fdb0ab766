/* What `tartan count` answers, as tables for people. */
#ifndef TARTAN_CLI_PLAN_COUNT_TEXT_H
#define TARTAN_CLI_PLAN_COUNT_TEXT_H

#include <stdio.h>

#include "ask/session/requests.h"
#include "runtime/module/module.h"

/* The plans of a library: all but what its clauses do, and that. */
void tn_count_plans_text(const tn_counted_plans *counted, FILE *out);
void tn_count_clauses_text(const tn_counted_plans *counted, FILE *out);

void tn_count_spread_text(const tn_counted_values *counted, FILE *out);
void tn_count_buildings_text(const tn_counted_buildings *counted, FILE *out);

/* The houses of a library of this module. */
void tn_count_houses_text(const tn_counted_houses *counted, const tn_module *module, FILE *out);

#endif
