/* Counts the buildings of a kit's parts. */
#include <stdlib.h>

#include "ask/place/kit.h"

/* Which parts lie on the lattice, the model that is named says. */
static tn_status count(tn_session *session, const tn_count_request *r, const tn_place_rules *rules, const bool *wanted,
                       tn_building_counts *counts, tn_error *error)
{
    uint32_t parts = (uint32_t)r->kit.parts;
    unsigned threads = tn_asked_threads(&r->subject);
    tn_watch *watch = session->opened->module->watch;
    tn_session_begins(session, "buildings counted");
    tn_status status = r->kit.inside
                           ? tn_count_inside(rules, wanted, parts, threads, watch, &counts->fixed, error)
                           : tn_count_buildings(rules, wanted, parts, r->kit.fixed, threads, watch, counts, error);
    tn_session_ends(session);
    return status;
}

static void give(const tn_count_request *r, const tn_building_counts *counts, tn_counted_buildings *counted)
{
    counted->parts = r->kit.parts;
    counted->has_inside = r->kit.inside != NULL;
    counted->has_fixed = !r->kit.inside;
    counted->inside = counted->fixed = counts->fixed;
    counted->has_buildings = counted->has_half_turn = counted->has_quarter_turn = !r->kit.inside && !r->kit.fixed;
    counted->buildings = counts->buildings;
    counted->half_turn = counts->half;
    counted->quarter_turn = counts->quarter;
}

tn_status tn_count_kit(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    tn_place_rules rules = {.module = session->opened->module};
    tn_building_counts counts;
    tn_error error;
    bool *wanted;
    tn_status status = tn_kit_asked_parts(session, &request->kit, &wanted);
    if (status != TN_OK)
        return status;
    if (request->kit.inside)
        status = tn_kit_asked_space(session, request->kit.inside, &rules);
    if (status == TN_OK) {
        status = count(session, request, &rules, wanted, &counts, &error);
        if (status == TN_OK)
            status = tn_reply_new(&tn_message_counted_buildings, answer, &error);
        if (status == TN_OK)
            give(request, &counts, answer->value);
        else
            tn_session_fail(session, &error);
        if (request->kit.inside)
            tn_place_rules_clear(&rules);
    }
    free(wanted);
    return status;
}
