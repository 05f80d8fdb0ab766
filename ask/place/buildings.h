/* The buildings of a kit's parts that a question finds: given one after another to whoever takes them, or put into the
 * answer. */
#ifndef TARTAN_ASK_PLACE_BUILDINGS_H
#define TARTAN_ASK_PLACE_BUILDINGS_H

#include "ask/session/session.h"
#include "runtime/place/grow.h"

/* Whoever takes buildings (tn_session.buildings). Each says whether the question goes on; if it does not, it ends well,
 * and whoever said so knows why. */
typedef struct tn_building_taker {
    bool (*begins)(void *context, uint64_t from, uint64_t to); /* before the first; ranks, `to` one past the last */
    /* The building of that rank; NULL: it is before the first that was asked for, and was passed over. */
    bool (*takes)(void *context, uint64_t rank, const tn_placed_model *building);
    void *context;
} tn_building_taker;

#endif
