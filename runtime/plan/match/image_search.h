/* Searches for the first newer plan above a plan that meets the clauses of an IMAGE's library: follows the states of
 * the clauses' automata from tray to tray, and takes the first trays that lead on.
 *
 * A tn_image_search belongs to one thread; it borrows the schema.
 */
#ifndef TARTAN_PLAN_MATCH_IMAGE_SEARCH_H
#define TARTAN_PLAN_MATCH_IMAGE_SEARCH_H

#include "runtime/plan/schema/projection.h"

typedef struct tn_image_search tn_image_search;

#define TN_IMAGE_WORDS_MAX (1u << 24) /* numbers of states that are kept above one plan; past it E0808 */

tn_status tn_image_search_new(const tn_schema *schema, const tn_instruction *image, tn_image_search **search,
                              tn_error *error);
void tn_image_search_free(tn_image_search *search);

/* The schema and the library of the plans that are searched. */
const tn_projection *tn_image_search_projection(const tn_image_search *search);

/* *found: is there one? newer: room for as many trays, or NULL: the first such plan in the order of ranks. */
tn_status tn_image_search_find(tn_image_search *search, const tn_tray *trays, size_t length, bool *found,
                               tn_tray *newer, tn_error *error);

#endif
