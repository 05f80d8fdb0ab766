#include "cli/plan_input.h"

#include <string.h>

#include "cli/library_session.h"

const char *tn_session_plans_path(tn_session *session)
{
    const tn_option_list *operands = &session->settings->operands;
    const char *path = operands->count > 1 ? operands->items[1] : "-";
    if (strcmp(path, "-") == 0 && strcmp(operands->items[0], "-") == 0) {
        tn_session_usage(session, "the rules and the plans cannot both come from standard input");
        return NULL;
    }
    return path;
}

bool tn_session_reader(tn_session *session, const tn_schema *schema, const char *path, tn_plan_reader **reader)
{
    tn_reader_options options = {.format = (tn_plan_format)session->settings->input_format,
                                 .max_length = tn_session_max_length(session->settings)};
    tn_error error;
    if (tn_plan_reader_open(schema, path, &options, reader, &error) == TN_OK)
        return true;
    tn_session_fail(session, &error);
    return false;
}

bool tn_session_bad_plan(tn_session *session, const char *path, const tn_error *error, const char *text, size_t size)
{
    tn_report_error(tn_session_diagnostics(session), error, strcmp(path, "-") == 0 ? "standard input" : path, text,
                    size);
    tn_session_status(session, error->status);
    return session->settings->on_error == 1 && error->status != TN_MEMORY && error->status != TN_INTERNAL;
}

void tn_session_fallbacks(tn_session *session, const tn_rules *rules, const char *(*name)(const void *, size_t),
                          const void *context)
{
    for (size_t i = 0; i < tn_rules_count(rules); i++) {
        const tn_error *reason = tn_rules_fallback(rules, i);
        if (!reason)
            continue;
        tn_diagnostic *note = tn_finding_note(&session->opened, reason);
        tn_note(tn_session_diagnostics(session), note, NULL, "`%s` is matched by the interpreter, which is slower",
                name(context, i));
    }
    tn_session_show(session);
}
