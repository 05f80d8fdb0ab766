/* The relations of a file's rules, and of the clauses of its libraries of houses, as `check --relations` shows them. */
#ifndef TARTAN_CLI_PLAN_RELATIONS_TEXT_H
#define TARTAN_CLI_PLAN_RELATIONS_TEXT_H

#include "ask/session/requests.h"

/* A matrix for each schema, and for each library of houses; then the examples, if there are any. */
void tn_relations_text(const tn_relations *relations, FILE *out);

#endif
