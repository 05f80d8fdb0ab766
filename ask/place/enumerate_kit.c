/* Lists the buildings of a kit's parts, one by one. */
#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/place/buildings.h"
#include "ask/place/kit.h"
#include "runtime/place/count/count.h"
#include "runtime/place/write.h"

typedef struct enumeration {
    tn_session *session;
    const tn_enumerate_request *request;
    tn_found_buildings *found;            /* of the answer */
    uint64_t rank, from, to, most, given; /* rank: of the next; from, to: those that are asked for */
    bool enough;
} enumeration;

/* ---- one building */

static tn_status add_part(const enumeration *e, const tn_placed_part *from, tn_found_building *building,
                          tn_error *error)
{
    double at[3];
    tn_building_part *part = TN_ADD(building_part, building->parts, error);
    if (!part)
        return TN_MEMORY;
    tn_place_at(e->session->opened->module, &from->frame, at);
    part->part = strdup(from->name);
    part->at.x = at[0];
    part->at.y = at[1];
    part->at.z = at[2];
    part->turn = from->frame.heading;
    return part->part ? TN_OK : tn_fail_memory(error);
}

static tn_status add_building(const enumeration *e, const tn_placed_model *model, tn_error *error)
{
    tn_found_building *building = TN_ADD(found_building, e->found->buildings, error);
    tn_status status = building ? TN_OK : TN_MEMORY;
    if (building)
        building->building = e->rank;
    for (size_t i = 0; status == TN_OK && i < model->count; i++)
        status = add_part(e, &model->parts[i], building, error);
    return status;
}

/* wanted: it is not before the first that is asked for. */
static tn_status give(enumeration *e, const tn_placed_model *model, bool wanted, tn_error *error)
{
    const tn_building_taker *taker = e->session->buildings;
    if (!taker)
        return wanted ? add_building(e, model, error) : TN_OK;
    e->enough = !taker->takes(taker->context, e->rank, wanted ? model : NULL);
    return TN_OK;
}

static tn_status visit(void *context, const tn_placed_model *model, tn_error *error)
{
    enumeration *e = context;
    e->enough = e->enough || e->rank >= e->to || e->given >= e->most;
    if (e->enough)
        return tn_fail(error, TN_STOPPED, TN_CODE_NONE, "all that were asked for are found");
    bool wanted = e->rank >= e->from;
    tn_status status = give(e, model, wanted, error);
    e->given += wanted;
    e->rank++;
    return status;
}

/* ---- all of them */

/* Ranks past 2^64 are past the last: so many buildings nobody lists. */
static uint64_t rank_of(const char *digits, uint64_t otherwise)
{
    if (!digits || !*digits)
        return otherwise;
    errno = 0;
    unsigned long long rank = strtoull(digits, NULL, 10);
    return errno == ERANGE ? UINT64_MAX : rank;
}

static tn_status list(enumeration *e, const bool *wanted, const tn_place_rules *rules, tn_error *error)
{
    const tn_enumerate_request *r = e->request;
    const tn_building_list asked = {.rules = rules,
                                    .wanted = wanted,
                                    .parts = (uint32_t)r->kit.parts,
                                    .kind = r->kit.inside  ? TN_BUILDINGS_INSIDE
                                            : r->kit.fixed ? TN_BUILDINGS_FIXED
                                                           : TN_BUILDINGS_TURNED,
                                    .visit = visit,
                                    .context = e};
    const tn_building_taker *taker = e->session->buildings;
    if (taker && taker->begins && !taker->begins(taker->context, e->from, e->to))
        return TN_OK;
    if (!taker)
        tn_session_begins(e->session, "buildings listed");
    tn_status status = tn_list_buildings(&asked, e->session->opened->module->watch, error);
    if (!taker)
        tn_session_ends(e->session);
    if (status == TN_OK && e->given == 0)
        tn_session_note(e->session, "there are %" PRIu64 " buildings, none of them from rank %" PRIu64 " on", e->rank,
                        e->from);
    return e->enough ? TN_OK : status;
}

static tn_status answer_list(enumeration *e, const bool *wanted, const tn_place_rules *rules, tn_reply *answer)
{
    tn_error error;
    tn_status status = tn_reply_new(&tn_message_found_buildings, answer, &error);
    e->found = answer->value;
    if (status == TN_OK)
        status = list(e, wanted, rules, &error);
    if (status != TN_OK)
        return tn_session_fail(e->session, &error);
    e->found->has_next = e->enough && e->rank < e->to;
    e->found->next = e->rank;
    return TN_OK;
}

tn_status tn_enumerate_kit(tn_session *session, const tn_enumerate_request *request, tn_reply *answer)
{
    tn_place_rules rules = {.module = session->opened->module};
    enumeration e = {.session = session,
                     .request = request,
                     .from = rank_of(request->from, 0),
                     .to = rank_of(request->to, UINT64_MAX),
                     .most = request->has_limit   ? request->limit
                             : session->buildings ? UINT64_MAX
                                                  : TN_ROWS_DEFAULT};
    bool *wanted;
    tn_status status = tn_kit_asked_parts(session, &request->kit, &wanted);
    if (status != TN_OK)
        return status;
    if (request->kit.inside)
        status = tn_kit_asked_space(session, request->kit.inside, &rules);
    if (status == TN_OK) {
        status = answer_list(&e, wanted, &rules, answer);
        if (request->kit.inside)
            tn_place_rules_clear(&rules);
    }
    free(wanted);
    return status;
}
