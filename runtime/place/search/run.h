/* A search under way: what beam, anneal and exact share. Internal to this folder. */
#ifndef TARTAN_PLACE_SEARCH_RUN_H
#define TARTAN_PLACE_SEARCH_RUN_H

#include "runtime/base/crew.h"
#include "runtime/place/search/search.h"

/* Each thread has a world and a scorer. */
typedef struct tn_place_search_run {
    const tn_site_choices *choices;
    const tn_kit_model_record *model;
    const tn_place_options *options;
    uint64_t model_limit;
    tn_crew *crew;
    tn_world *worlds;
    tn_scorer *scorers;
    tn_standing best; /* of all models looked at */
    tn_model_score best_score;
    bool has_best;
    uint64_t looked_at;
    bool proved;
    tn_error *error;
} tn_place_search_run;

tn_status tn_place_search_anneal(tn_place_search_run *run);

/* Keeps a plan that is better than the best. */
tn_status tn_place_search_keep(tn_place_search_run *run, const tn_standing *plan, const tn_model_score *score);

/* TN_LIMIT if so many models are more than may be looked at; TN_STOPPED if nobody waits any more. */
tn_status tn_place_search_check(tn_place_search_run *run, uint64_t looked_at, double done, double total);

#endif
