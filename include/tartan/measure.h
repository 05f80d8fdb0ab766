/* Measures of the plans of a library: how they are spread, which plans are best, fronts, and open plans. All answers
 * are exact, and found without listing plans.
 *
 * A measure is named as in the rule file; of a library that prefers there is `preference`, too. Values are texts, "p/q"
 * or "p", in the measure's unit: tartan_measure_unit. Where a measure's numbers are too many or too fine, functions
 * return TARTAN_LIMIT, and the error says what helps. */
#ifndef TARTAN_MEASURE_H
#define TARTAN_MEASURE_H

#include "plan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The unit of its values: "m", "ft2", "/m2", or "" for plain numbers; NULL where the library's trays have no such
 * measure. */
TARTAN_API const char *tartan_measure_unit(const tartan_library *library, const char *measure);

/* ---- of single plans, also of those that the library does not keep */

/* The value of the measure on a plan. *value is NULL if it has none: of nothing there is no greatest number, and
 * nothing is divided by 0. */
TARTAN_API tartan_status tartan_measure_plan(const tartan_library *library, const char *measure, const uint32_t *trays,
                                             size_t length, char **value, tartan_error *error);

/* The same of many plans, given as tartan_match_all takes them, into values[i], each rounded to the nearest double; not
 * a number if a plan has none. `watch` (may be NULL) is told how many plans are measured. */
TARTAN_API tartan_status tartan_measure_plans(const tartan_library *library, const char *measure, const uint32_t *trays,
                                              const size_t *ends, size_t count, const tartan_watch *watch,
                                              double *values, tartan_error *error);

/* ---- how plans are spread */

typedef struct tartan_distribution tartan_distribution;

typedef enum tartan_statistic {
    TARTAN_LEAST,
    TARTAN_FIRST_QUARTILE, /* the least value that at least a quarter of the plans do not pass */
    TARTAN_MEDIAN,
    TARTAN_THIRD_QUARTILE,
    TARTAN_MOST,
    TARTAN_MEAN,
    TARTAN_VARIANCE /* in the unit squared; of all plans, not of a sample */
} tartan_statistic;

/* How the plans of the library are spread over the values of a measure. */
TARTAN_API tartan_status tartan_distribution_new(const tartan_library *library, const char *measure,
                                                 tartan_distribution **distribution, tartan_error *error);
TARTAN_API void tartan_distribution_free(tartan_distribution *distribution);

/* Its values, ascending: how many, and each with the number of plans that have it, in decimal. */
TARTAN_API size_t tartan_distribution_count(const tartan_distribution *distribution);
TARTAN_API tartan_status tartan_distribution_value(const tartan_distribution *distribution, size_t i, char **value,
                                                   char **plans, tartan_error *error);

/* How many plans have no value, in decimal: of nothing there is no greatest number, and nothing is divided by 0. */
TARTAN_API tartan_status tartan_distribution_none(const tartan_distribution *distribution, char **plans,
                                                  tartan_error *error);

/* A number that sums them up. If no plan has a value there is none: TARTAN_INVALID. */
TARTAN_API tartan_status tartan_distribution_statistic(const tartan_distribution *distribution,
                                                       tartan_statistic statistic, char **value, tartan_error *error);

/* ---- best plans: those that have a value of each measure */

/* What is to be great, or, where `most` is false, small. */
typedef struct tartan_wish {
    const char *measure;
    bool most;
} tartan_wish;

typedef struct tartan_best tartan_best;

/* The plans in order: by the first wish, then by the next, then by rank. One to three wishes. */
TARTAN_API tartan_status tartan_best_new(const tartan_library *library, const tartan_wish *wishes, size_t count,
                                         tartan_best **best, tartan_error *error);
TARTAN_API void tartan_best_free(tartan_best *best);

/* Steps to the next plan, which stays valid until the next step; *found is false at the end. */
TARTAN_API tartan_status tartan_best_next(tartan_best *best, const uint32_t **trays, size_t *length, bool *found,
                                          tartan_error *error);

/* The value that the plan has by a wish, counted from 0. Before the first step TARTAN_INVALID. */
TARTAN_API tartan_status tartan_best_value(const tartan_best *best, size_t wish, char **value, tartan_error *error);

/* ---- fronts */

typedef struct tartan_front tartan_front;

/* The values by two or three wishes that no plan betters in one without losing in another, best first. */
TARTAN_API tartan_status tartan_front_new(const tartan_library *library, const tartan_wish *wishes, size_t count,
                                          tartan_front **front, tartan_error *error);
TARTAN_API void tartan_front_free(tartan_front *front);
TARTAN_API size_t tartan_front_count(const tartan_front *front);
TARTAN_API tartan_status tartan_front_value(const tartan_front *front, size_t point, size_t wish, char **value,
                                            tartan_error *error);

/* How many plans lie on the point, in decimal, and the first of them by rank, which the front keeps. */
TARTAN_API tartan_status tartan_front_plans(const tartan_front *front, size_t point, char **plans,
                                            const uint32_t **trays, size_t *length, tartan_error *error);

/* ---- open plans */

/* A place of an open plan: one tray, or any number of them. */
typedef struct tartan_open_tray {
    const bool *fits; /* for each tray of the schema whether it may stand here; NULL: every tray */
    bool gap;         /* any number of trays, also none; `fits` is not looked at */
} tartan_open_tray;

typedef struct tartan_completions tartan_completions;

/* One value of one field at a place that is no gap. */
typedef struct tartan_choice {
    const char *field, *value; /* as in the rule file; the schema's */
    const char *plans;         /* how many completions have it there, in decimal */
    const char *best;          /* the best that the wish's measure still can be with it; NULL: no wish, or no plan */
} tartan_choice;

/* Which plans of the library fit, and what may still be chosen. Where a plan fits in several ways, the leftmost counts.
 * `wish` may be NULL. At most 60 places that are no gaps (TARTAN_LIMIT). */
TARTAN_API tartan_status tartan_completions_new(const tartan_library *library, const tartan_open_tray *places,
                                                size_t count, const tartan_wish *wish, tartan_completions **completions,
                                                tartan_error *error);
TARTAN_API void tartan_completions_free(tartan_completions *completions);
TARTAN_API const char *tartan_completions_plans(const tartan_completions *completions); /* how many, in decimal */

/* The choices at a place, counted without the gaps; their number is the same at each, 0 past the last place. */
TARTAN_API size_t tartan_completions_count(const tartan_completions *completions, size_t place);
TARTAN_API tartan_status tartan_completions_choice(const tartan_completions *completions, size_t place, size_t i,
                                                   tartan_choice *choice, tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
