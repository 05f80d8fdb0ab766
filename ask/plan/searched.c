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

tn_status tn_searched_new(tn_session *session, const tn_ready_library *ready, const tn_library_asked *asked,
                          const tn_search_asked *search, tn_plan_search **made)
{
    const tn_search_options options = tn_asked_search(asked, search);
    tn_error error;
    tn_status status = tn_plan_search_new(ready->schema, ready->index, &options, made, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

tn_status tn_searched_instead(tn_session *session, tn_status status, const char *instead)
{
    tn_diagnostics *said = &session->opened->compilation.diagnostics;
    tn_diagnostic *last = said->count > 0 ? &said->items[said->count - 1] : NULL;
    if (status == TN_LIMIT && last && last->code == E_TOO_MANY_STATES)
        tn_note(said, last, NULL, "%s", instead);
    return status;
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

static tn_status add_line(const tn_searched_lines *to, const tn_tray *trays, uint32_t length, tn_error *error)
{
    char *line = NULL;
    tn_status status = tn_found_plan_texts(to->schema, trays, length, &line, NULL, error);
    return status == TN_OK ? tn_owneds_add(to->lines, line, error) : status;
}

tn_status tn_searched_list(tn_session *session, tn_plan_search *search, tn_searched_lines *to, tn_error *error)
{
    const tn_tray *trays = NULL;
    uint32_t length;
    tn_status status = TN_OK;
    bool ended = false;
    while (status == TN_OK && !ended && !to->more) {
        status = tn_plan_search_next(search, &trays, &length, error);
        ended = status == TN_OK && !trays;
        to->more = status == TN_OK && !ended && to->lines->count == to->most;
        if (status == TN_OK && !ended && !to->more)
            status = add_line(to, trays, length, error);
    }
    if (status != TN_LIMIT || (to->lines->count == 0 && !to->notes_limit))
        return status;
    to->more = true;
    tn_finding_note(session->opened, error);
    return TN_OK;
}
