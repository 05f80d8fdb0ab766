/* The parts of `tartan grow`. */
#ifndef TARTAN_CLI_GROWTH_GROW_H
#define TARTAN_CLI_GROWTH_GROW_H

#include "ask/growth/grow.h"
#include "cli/common/job.h"

/* Opens the file that grows: with statements, the study that they are, which uses the file. False if that failed. */
bool tn_grow_open(tn_job *job, const tn_grow_statements *said);

/* Writes a line for each step. */
void tn_grow_table(const tn_grown_shown *steps, FILE *out);

/* Says why the branches of a step did not join. */
void tn_grow_explain(const tn_grown_joins *joins, FILE *out);

#endif
