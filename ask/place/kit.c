/* The buildings of a kit's parts: which parts and which space are asked about; how many buildings there are; each of
 * them. */
#include "ask/place/kit.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "driver/place/kit.h"
#include "runtime/place/count/count.h"
#include "runtime/place/joints.h"
#include "runtime/place/write.h"

tn_status tn_kit_none_asked(tn_session *session, const tn_kit_asked *asked)
{
    const char *option = asked->parts        ? "parts"
                         : asked->fixed      ? "fixed"
                         : asked->inside     ? "inside"
                         : asked->part.count ? "part"
                                             : NULL;
    return option ? tn_session_refuse(session, NULL, "--%s is about a kit, and %.200s is none", option,
                                      session->opened->path)
                  : TN_OK;
}

static tn_status unknown_part(tn_session *session, const char *name)
{
    const tn_module *module = session->opened->module;
    tn_error error;
    tn_fail(&error, TN_INVALID, E_KIT_UNKNOWN, "the kit has no part `%.100s`", name);
    tn_error_help(&error, "--part takes the name of one of its parts, such as %.100s",
                  tn_text(module, module->KIT_PART_records[0].name));
    return tn_session_fail(session, &error);
}

/* *wanted: NULL if none is named, so that all are. */
static tn_status choose_parts(tn_session *session, const tn_kit_asked *asked, bool **wanted)
{
    const tn_module *module = session->opened->module;
    tn_error error;
    if (asked->part.count == 0)
        return TN_OK;
    bool *chosen = calloc((size_t)module->KIT_PART_count + 1, sizeof *chosen);
    if (!chosen) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    for (size_t i = 0; i < asked->part.count; i++) {
        const tn_kit_part_record *part = tn_kit_part_named(module, asked->part.items[i]);
        if (!part) {
            free(chosen);
            return unknown_part(session, asked->part.items[i]);
        }
        chosen[part - module->KIT_PART_records] = true;
    }
    *wanted = chosen;
    return TN_OK;
}

/* Checks what is asked of a kit and finds which of its parts are wanted: *wanted is [part of the kit], or NULL for all;
 * the caller frees it. */
static tn_status kit_asked_parts(tn_session *session, const tn_kit_asked *asked, bool **wanted)
{
    tn_error error;
    *wanted = NULL;
    if (asked->parts == 0)
        return tn_session_refuse(session, "say how many: --parts 3",
                                 "of a kit, buildings of so many parts are counted");
    if (asked->parts > TN_COUNT_PARTS_MAX)
        return tn_session_refuse(session, NULL, "buildings have at most %d parts here", TN_COUNT_PARTS_MAX);
    if (asked->inside && asked->fixed)
        return tn_session_refuse(
            session, NULL,
            "--fixed and --inside do not go together: inside of a space each building counts where it stands");
    if (session->opened->module->KIT_PART_count > 0)
        return choose_parts(session, asked, wanted);
    tn_fail(&error, TN_INVALID, E_KIT_UNKNOWN, "the kit has no parts to count buildings of");
    tn_error_help(&error, "tell them by `part 3005 { ... }`, or `use \"bricks\";`");
    return tn_session_fail(session, &error);
}

/* The rules of the model whose space is named, to be cleared after TN_OK. */
static tn_status kit_asked_space(tn_session *session, const char *name, tn_place_rules *rules)
{
    tn_error error;
    uint32_t model;
    tn_status status = tn_kit_choose(session->opened, name, &model);
    if (status != TN_OK)
        return status;
    status = tn_place_rules_of_model(session->opened->module, model, rules, &error);
    if (status == TN_OK)
        return TN_OK;
    tn_place_rules_clear(rules);
    return tn_session_fail(session, &error);
}

/* ---- how many buildings */

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

static void give_counts(const tn_count_request *r, const tn_building_counts *counts, tn_counted_buildings *counted)
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
    tn_status status = kit_asked_parts(session, &request->kit, &wanted);
    if (status != TN_OK)
        return status;
    if (request->kit.inside)
        status = kit_asked_space(session, request->kit.inside, &rules);
    if (status == TN_OK) {
        status = count(session, request, &rules, wanted, &counts, &error);
        if (status == TN_OK)
            status = tn_reply_new(&tn_message_counted_buildings, answer, &error);
        if (status == TN_OK)
            give_counts(request, &counts, answer->value);
        else
            tn_session_fail(session, &error);
        if (request->kit.inside)
            tn_place_rules_clear(&rules);
    }
    free(wanted);
    return status;
}

/* ---- each building */

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
    tn_status status = kit_asked_parts(session, &request->kit, &wanted);
    if (status != TN_OK)
        return status;
    if (request->kit.inside)
        status = kit_asked_space(session, request->kit.inside, &rules);
    if (status == TN_OK) {
        status = answer_list(&e, wanted, &rules, answer);
        if (request->kit.inside)
            tn_place_rules_clear(&rules);
    }
    free(wanted);
    return status;
}
