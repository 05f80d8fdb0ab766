/* The clauses of a library as a set of rules to match plans against, for telling which of them drop a plan. */
#ifndef TARTAN_DRIVER_PLAN_CLAUSES_H
#define TARTAN_DRIVER_PLAN_CLAUSES_H

#include "runtime/plan/match/rules.h"

/* Rules in the order of the library's clauses. */
tn_status tn_clause_rules_new(const tn_schema *schema, const tn_library_record *library,
                              const tn_rules_options *options, tn_rules **rules, tn_error *error);

/* Does clause i (of the library's) drop a plan with these result bits? */
static inline bool tn_clause_drops(const tn_module *module, const tn_library_record *library, size_t i,
                                   const uint64_t *bits)
{
    bool holds = bits[i / 64] >> (i % 64) & 1;
    return holds == (module->CLAUSE_records[library->clause_first + i].kind == TN_CLAUSE_PRUNE);
}

#endif
