/* Goals that a study writes itself, `fitness volume target 200 weight 1`: arithmetic over measures, or one of them.
 * Clear them in any case. */
#ifndef TARTAN_DRIVER_BREED_GOALS_H
#define TARTAN_DRIVER_BREED_GOALS_H

#include <stdio.h>

#include "runtime/genome/settings.h"
#include "runtime/number/formula.h"

typedef struct tn_goal {
    const char *text; /* the study's */
    tn_formula formula;
    double target, weight;
} tn_goal;

typedef struct tn_goals {
    tn_goal *items; /* owned */
    size_t count;
} tn_goals;

/* Reads the `fitness` lines of a study. names: of the measures, whose values are given in this order. TN_INVALID
 * (E1248) where one is wrong; *blamed is then its number among study->each. */
tn_status tn_goals_read(const tn_evolution_study *study, const char *const *names, size_t name_count, tn_goals *goals,
                        uint32_t *blamed, tn_error *error);
void tn_goals_clear(tn_goals *goals);

/* Bit i: the goals ask for measure i. */
uint64_t tn_goals_ask(const tn_goals *goals);

/* How far a goal is missed, weighted: a share of its target, or of 1 where that is larger. */
double tn_goal_part(const tn_goal *goal, const double *values);
double tn_goal_share(double value, double target, double weight);

/* Does "volume target 3 weight 2" change one of the goals, as their lines write them? Then it has. */
bool tn_goals_adjust(tn_goals *goals, const char *change);

/* ---- what a bred form does not meet of what is required of it, in words */

/* The measures that requirements speak of, and what was found of them, by their numbers. */
typedef struct tn_unmet_found {
    const tn_module *module; /* that holds the requirements, and their source */
    const char *const *names;
    size_t count;
    const double *values;
} tn_unmet_found;

/* A requirement's function of how far it is from holding, and where it is written. */
typedef struct tn_unmet_requirement {
    uint32_t violation, file, begin, end;
} tn_unmet_requirement;

/* Writes a line, "`require angle >= 25` (line 7): angle is 12.4", unless the requirement is met. */
void tn_unmet_write(FILE *out, const tn_unmet_found *found, const tn_unmet_requirement *requirement);

#endif
