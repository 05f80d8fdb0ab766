/* The relations of a file's rules, and of the clauses of its libraries of houses, to one another, as `check
 * --relations` prints them. */
#ifndef TARTAN_CLI_PLAN_RELATIONS_H
#define TARTAN_CLI_PLAN_RELATIONS_H

#include "cli/house/related.h"
#include "driver/plan/analysis.h"

typedef struct tn_relations_options {
    bool json;
    bool examples; /* with the shortest plans that show each relation */
} tn_relations_options;

/* Writes a matrix for each schema, and for each library of houses. */
tn_status tn_relations_write(const tn_plan_analyses *analyses, const tn_related_houses *houses, size_t house_count,
                             const tn_relations_options *options, FILE *out, tn_error *error);

#endif
