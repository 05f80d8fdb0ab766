/* What questions about searched libraries share. */
#include "ask/plan/searched.h"

#include "runtime/base/array.h"

tn_search_options tn_asked_search(const tn_library_asked *asked, const tn_search_asked *search)
{
    return (tn_search_options){.override_trays = asked->has_trays,
                               .trays_min = (uint32_t)asked->trays.from,
                               .trays_max = (uint32_t)asked->trays.to,
                               .max_gates = (uint32_t)search->max_gates,
                               .max_conflicts = search->max_conflicts};
}

void tn_searched_note(tn_session *session, const tn_error *limit)
{
    tn_session_note(session, "plans are found by search, since %.400s", limit->message);
}

tn_status tn_searched_mirror_first(tn_plan_search *search, const tn_tray *trays, uint32_t length, bool *first,
                                   tn_error *error)
{
    tn_tray *turned = tn_array_new((uint64_t)length + 1, sizeof *turned);
    if (!turned)
        return tn_fail_memory(error);
    bool lower = false, keeps = false;
    for (uint32_t i = 0; i < length; i++)
        turned[i] = trays[length - 1 - i];
    for (uint32_t i = 0; i < length; i++)
        if (turned[i] != trays[i]) {
            lower = turned[i] < trays[i];
            break;
        }
    tn_status status = lower ? tn_plan_search_keeps(search, turned, length, &keeps, error) : TN_OK;
    *first = !(lower && keeps);
    free(turned);
    return status;
}
