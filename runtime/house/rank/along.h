/* Where the trays of a plan lead, one after another, in a kind of section whose steps have stages. The number of
 * choices that lead to each node is kept for the nodes of a layer as a whole; many states are then gone on from at
 * once. */
#ifndef TARTAN_HOUSE_RANK_ALONG_H
#define TARTAN_HOUSE_RANK_ALONG_H

#include "runtime/house/count/data.h"

typedef struct tn_plan_along {
    tn_houses view; /* the houses, with ways by tray; borrows all that they have */
    tn_houses_kind *kind;
    tn_tray *trays; /* [count]: those taken; the nodes may be further on */
    uint32_t count, layer;
    mpz_t *here;    /* [nodes of the layer]: choices that lead there */
    mpz_t *by_tray; /* [trays of the schema]: houses that go on by each */
    bool summed;    /* these are of the trays taken so far */
} tn_plan_along;

/* Begins before the first tray. Both are borrowed. End it also after a failure. */
tn_status tn_plan_along_begin(const tn_houses *houses, tn_houses_kind *kind, tn_plan_along *along, tn_error *error);
void tn_plan_along_end(tn_plan_along *along);

void tn_plan_along_take(tn_plan_along *along, tn_tray tray);

/* *houses: of one section, on plans of the length that go on by the tray; good until the next call. Those by all trays
 * are found at once, and kept with the kind by the beginning of the plan, as many plans begin alike. */
tn_status tn_plan_along_houses(tn_plan_along *along, uint32_t length, tn_tray tray, mpz_ptr *houses, tn_error *error);

#endif
