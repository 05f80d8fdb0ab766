/* count: how many plans, houses or buildings there are. */
#include "ask/count.h"

#include "driver/house/judge.h"
#include "runtime/base/crew.h"
#include "runtime/plan/match/vm.h"

tn_library_options tn_asked_options(const tn_library_asked *asked)
{
    return (tn_library_options){.max_states = (uint32_t)asked->max_states,
                                .override_trays = asked->has_trays,
                                .trays_min = (uint32_t)asked->trays.from,
                                .trays_max = (uint32_t)asked->trays.to,
                                .max_length = (uint32_t)asked->max_length,
                                .threads = asked->has_threads ? (unsigned)asked->threads : tn_crew_default()};
}

size_t tn_asked_length(const tn_library_asked *asked)
{
    return asked->has_max_length ? (size_t)asked->max_length : TN_VM_LENGTH_DEFAULT;
}

/* What only libraries of plans and houses are asked, or NULL. */
static const char *asks_library(const tn_count_request *r)
{
    return r->subject.library       ? "library"
           : r->subject.where.count ? "where"
           : r->subject.has_trays   ? "trays"
           : r->by                  ? "by"
           : r->step                ? "step"
           : r->has_bins            ? "bins"
           : r->plan                ? "plan"
           : r->clauses             ? "clauses"
           : r->mirror              ? "mirror"
           : r->no_effects          ? "no-effects"
                                    : NULL;
}

/* What only kits are asked, or NULL. */
static const char *asks_kit(const tn_count_request *r)
{
    return r->has_parts ? "parts" : r->fixed ? "fixed" : r->inside ? "inside" : r->part.count ? "part" : NULL;
}

/* With a plan or clauses, or if the library named is one of houses. */
static bool counts_houses(const tn_session *session, const tn_count_request *r)
{
    const char *library = r->subject.library;
    return r->plan || r->clauses ||
           (library && tn_house_library_find(session->opened->module, library) != TN_NO_RECORD);
}

tn_status tn_ask_count(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    bool kit = session->opened->module->KIT_count > 0;
    const char *option = kit ? asks_library(request) : asks_kit(request);
    *answer = (tn_reply){0};
    if (option)
        return tn_session_refuse(session, NULL,
                                 kit ? "--%s is about a library of plans, and %.200s is a kit"
                                     : "--%s is about a kit, and %.200s is none",
                                 option, session->opened->path);
    if (kit)
        return tn_count_kit(session, request, answer);
    if (counts_houses(session, request))
        return tn_count_houses(session, request, answer);
    return request->by ? tn_count_plans_by(session, request, answer) : tn_count_plans(session, request, answer);
}
