/* How an edit changes what measures come to: least, mean and most of each that both files have. */
#ifndef TARTAN_CLI_PLAN_DIFF_MEASURES_H
#define TARTAN_CLI_PLAN_DIFF_MEASURES_H

#include <stdio.h>

#include "cli/plan/answers.h"

typedef struct tn_measure_changes tn_measure_changes;

/* Finds them for the two libraries. A measure that passes a limit is left out, with a note. Free in any case. */
tn_status tn_measure_changes_find(tn_job *job, const tn_compared *compared, tn_measure_changes **changes,
                                  tn_error *error);
void tn_measure_changes_free(tn_measure_changes *changes);

/* A table, or nothing where there is no such measure. false where out of memory. */
bool tn_measure_changes_write(const tn_measure_changes *changes, FILE *out);

/* The member "measures" of an object that is written into a text. */
void tn_measure_changes_json(const tn_measure_changes *changes, tn_json *json);

#endif
