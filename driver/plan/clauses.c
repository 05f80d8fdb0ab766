/* Makes rules of a library's clauses, and tells which of them drop a plan. */
#include "driver/plan/clauses.h"

#include <stdlib.h>

tn_status tn_clause_rules_new(const tn_schema *schema, const tn_library_record *library,
                              const tn_rules_options *options, tn_rules **rules, tn_error *error)
{
    uint32_t *functions = malloc(sizeof *functions * ((size_t)library->clause_count + 1));
    if (!functions)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < library->clause_count; i++)
        functions[i] = schema->module->CLAUSE_records[library->clause_first + i].holds;
    tn_status status = tn_rules_new(schema, functions, library->clause_count, options, rules, error);
    free(functions);
    return status;
}
