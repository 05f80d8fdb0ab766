/* How the houses that each two clauses of a library match lie to one another. */
#ifndef TARTAN_CLI_HOUSE_RELATED_H
#define TARTAN_CLI_HOUSE_RELATED_H

#include "cli/house/houses.h"
#include "runtime/plan/analysis/analysis.h"

/* The states of a pair of clauses, where nobody says another limit: some seconds. */
#define TN_RELATED_STATES 100000u

/* What two clauses make of a house. */
typedef enum tn_related_kind {
    TN_RELATED_BOTH,
    TN_RELATED_ONLY_A,
    TN_RELATED_ONLY_B,
    TN_RELATED_KINDS
} tn_related_kind;

/* The clauses of a library of houses, in its order: what they ask, not whether they require or prune it. All houses in
 * its form on its plans are looked at. */
typedef struct tn_related_houses {
    const char *library;
    size_t count;
    const char **names;          /* of the clauses */
    tn_rule_relation *relations; /* [count][count] */
    char **examples;             /* [count][count][TN_RELATED_KINDS]: lines of houses, of the pairs i < j, or NULL */
} tn_related_houses;

/* Relates the clauses by counting the houses that match each of them and each two. A pair that passes the limit of
 * states is TN_RULES_UNKNOWN, and a note says so. False: what was wrong is recorded. Clear in any case. */
bool tn_job_relate_houses(tn_job *job, const tn_house_settings *settings, bool examples, tn_related_houses *related);
void tn_related_houses_clear(tn_related_houses *related);

#endif
