/* Searching among the models that a kit's rules allow for one that meets what is required, and is best by the
 * objective.
 *
 * A model of the rules is complete: at no connector that it leaves open is there room for something that may come
 * there, unless the rule says so. Results depend on the rules, the seed and the amounts of the model's `search` alone,
 * not on the number of threads. */
#ifndef TARTAN_PLACE_SEARCH_SEARCH_H
#define TARTAN_PLACE_SEARCH_SEARCH_H

#include "runtime/place/search/score.h"

/* Does the model need a search to be placed, as it says how, has images, a stock, or an order of its own? */
static inline bool tn_place_needs_search(const tn_place_rules *rules)
{
    const tn_kit_model_record *model = rules->space;
    return model && (model->search != TN_SEARCH_GREEDY || model->symmetry != TN_SYMMETRY_NONE ||
                     model->stock_count > 0 || model->flags & TN_KIT_BREADTH);
}

/* Searches as the model says, and gives the best model found, the first of equals. Of the options: seed, part_limit,
 * search_limit, threads and watch. TN_LIMIT (E1313) if the search passes a limit, TN_STOPPED if the watch ends
 * it: the model is the best until then. The model is the caller's to clear in any case. */
tn_status tn_place_search(const tn_place_rules *rules, const tn_place_options *options, tn_placed_model *model,
                          tn_error *error);

/* Places a model as its rules say: by a search where it needs one, else as tn_place_derive does. TN_INVALID (E1314)
 * if no part is placed; else what these give. *fault is empty after a search. */
tn_status tn_place_run(const tn_place_rules *rules, const tn_place_options *options, tn_placed_model *model,
                       tn_place_fault *fault, tn_error *error);

#endif
