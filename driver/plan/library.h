/* Choosing a library of a file by name, and making it ready.
 *
 * What is wrong goes to the diagnostics of the opened file.
 */
#ifndef TARTAN_DRIVER_PLAN_LIBRARY_H
#define TARTAN_DRIVER_PLAN_LIBRARY_H

#include "driver/open/open.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/match/rules.h"

/* The clauses of a library as a set of rules to match plans against, for telling which of them drop a plan. */

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

/* The LIBRARY record named so; for NULL the only one of the file itself, or, where it has none, the only one that it
 * uses. TN_INVALID (E0905) lists the names there are. */
tn_status tn_library_choose(tn_opened *opened, const char *name, uint32_t *index);

/* The RULE record named so, or TN_INVALID (E0905). */
tn_status tn_rule_choose(tn_opened *opened, const char *name, uint32_t *index);

/* The measure named so, of the library (runtime/plan/measure/named.h); or TN_INVALID (E0905). */
tn_status tn_measure_choose(tn_opened *opened, const char *name, const tn_library_record *library, uint32_t *measure);

/* A measure that the houses of a form have, by its name: as tn_house_measured_of numbers them. */
tn_status tn_house_measure_choose(tn_opened *opened, const char *name, uint32_t form, uint32_t *index);

/* A library made ready. Close it before the file it is from. */
typedef struct tn_ready_library {
    uint32_t index; /* of the LIBRARY record */
    const tn_library_record *record;
    tn_schema *schema;
    tn_library *library; /* NULL where only the schema was asked for, or what is asked is searched */
} tn_ready_library;

/* Chooses a library and makes its schema ready, and, where `options` is not NULL, its automaton. */
tn_status tn_library_ready(tn_opened *opened, const char *name, const tn_library_options *options,
                           tn_ready_library *ready);
/* The same for who can do without the automaton, by searching (runtime/plan/search/search.h): where it passes a limit
 * of states, ready->library is NULL, and *limit says which. Without a solver that fails as above, and names the part.
 */
tn_status tn_library_ready_or_searched(tn_opened *opened, const char *name, const tn_library_options *options,
                                       tn_ready_library *ready, tn_error *limit);
void tn_library_close(tn_ready_library *ready);

/* The SCHEMA record to read plans with: of the library named, or of the only one of the file itself, or else the only
  schema there is. TN_INVALID (E0905) where that is not clear. *library: that library, unchanged where there is none. */
tn_status tn_schema_choose(tn_opened *opened, const char *name, uint32_t *index, uint32_t *library);

#endif
