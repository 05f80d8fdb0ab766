/* How good a model is for a search: first by how far it is from what is required, then by what is to be made small or
 * large. Lower is better.
 *
 * A scorer belongs to one thread. What can be told from the numbers of parts alone is told first; joints are found only
 * where a condition asks for them and nothing else has decided. */
#ifndef TARTAN_PLACE_SEARCH_SCORE_H
#define TARTAN_PLACE_SEARCH_SCORE_H

#include "runtime/place/measure.h"
#include "runtime/place/search/world.h"

typedef struct tn_model_score {
    double violation, value; /* value: of the objective, negated where it is to be large; 0 without one */
} tn_model_score;

typedef struct tn_scorer {
    const tn_site_choices *choices;
    uint64_t inside;                    /* cells of the space */
    uint64_t *cells;                    /* [kind]: of a part */
    bool rises;                         /* the value never falls while parts are added */
    double terms[TN_PLACED_TERM_COUNT]; /* those of the numbers of parts */
    tn_placed_model model;              /* room for the parts of a plan */
    tn_watch *watch;
} tn_scorer;

/* TN_MEMORY, TN_STOPPED or TN_OK; clear it in any case. */
tn_status tn_scorer_make(const tn_site_choices *choices, uint64_t inside, tn_watch *watch, tn_scorer *scorer,
                         tn_error *error);
void tn_scorer_clear(tn_scorer *scorer);

/* Scores what stands. Where it is sure to be above `bar` (or NULL), it may be told as an endless violation. */
tn_status tn_score_world(tn_scorer *scorer, const tn_world *world, const tn_model_score *bar, tn_model_score *score,
                         tn_error *error);

/* The score of a model of which all terms were measured. */
tn_model_score tn_score_terms(const tn_module *module, const tn_kit_model_record *model, const double *terms);

/* The value of the objective, as far as the numbers of parts tell it; only where it rises. */
double tn_score_value(tn_scorer *scorer, const tn_world *world);

/* Below 0 if a is better; not-a-number is worst. */
int tn_score_compare(const tn_model_score *a, const tn_model_score *b);

#endif
