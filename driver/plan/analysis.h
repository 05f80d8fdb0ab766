/* What the rules and libraries of an opened file mean, said where they are written: the findings of
 * runtime/plan/analysis/analysis.h as warnings (W001 to W009) and notes, but for those that the author allows.
 *
 * Free a tn_plan_analyses before closing the file.
 */
#ifndef TARTAN_DRIVER_PLAN_ANALYSIS_H
#define TARTAN_DRIVER_PLAN_ANALYSIS_H

#include "driver/open/open.h"
#include "runtime/plan/analysis/analysis.h"

/* The schemas that the rules and libraries of the named file are about, and the analysis of each. */
typedef struct tn_plan_analyses {
    tn_schema **schemas;
    tn_plan_analysis **items;
    size_t count;
} tn_plan_analyses;

/* Analyses a rule file and adds what is found to its diagnostics; of a module, which says nothing of what its author
 * allows, only the relations are found. options as in tn_plan_analysis_new. On failure the diagnostics say why. */
tn_status tn_plan_analyse(tn_opened *opened, const tn_plan_analysis_options *options, tn_plan_analyses *analyses);
void tn_plan_analyses_free(tn_plan_analyses *analyses);

#endif
