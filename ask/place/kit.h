/* Questions about the buildings of a kit's parts: counted, and given one after another. */
#ifndef TARTAN_ASK_PLACE_KIT_H
#define TARTAN_ASK_PLACE_KIT_H

#include "ask/session/session.h"
#include "runtime/place/count/count.h"
#include "runtime/place/grow.h"
#include "runtime/place/model/rules.h"

/* The buildings of a kit's parts that a question finds: given one after another to whoever takes them, or put into the
 * answer. */

/* Whoever takes buildings (tn_session.buildings). Each says whether the question goes on; if it does not, it ends well,
 * and whoever said so knows why. */
typedef struct tn_building_taker {
    bool (*begins)(void *context, uint64_t from, uint64_t to); /* before the first; ranks, `to` one past the last */
    /* The building of that rank; NULL: it is before the first that was asked for, and was passed over. */
    bool (*takes)(void *context, uint64_t rank, const tn_placed_model *building);
    void *context;
} tn_building_taker;

/* TN_INVALID, and says it, if something is asked that only kits answer: the file is none. */
tn_status tn_kit_none_asked(tn_session *session, const tn_kit_asked *asked);

/* count: the buildings of a kit's parts. */
tn_status tn_count_kit(tn_session *session, const tn_count_request *request, tn_reply *answer);

/* enumerate: the buildings themselves. Its ranks are digits, and in order. */
tn_status tn_enumerate_kit(tn_session *session, const tn_enumerate_request *request, tn_reply *answer);

#endif
