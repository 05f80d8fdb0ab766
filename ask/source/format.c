/* format: the file's text in the canonical layout. */
#include "compiler/format.h"

#include <string.h>

#include "ask/session/questions.h"

/* The first of what is said where laying out fails; a text that compiles has no errors of syntax. */
static tn_status fail(tn_session *session, const tn_diagnostics *said, tn_status status)
{
    tn_error error;
    if (status == TN_MEMORY || said->count == 0)
        return tn_session_fail(session, (tn_fail_memory(&error), &error));
    tn_fail(&error, status, said->items[0].code, "%.479s", said->items[0].message);
    if (said->items[0].help)
        tn_error_help(&error, "%.319s", said->items[0].help);
    return tn_session_fail(session, &error);
}

/* The caller frees *text. */
static tn_status lay_out(tn_session *session, const tn_source *source, char **text, size_t *size)
{
    tn_sources sources = {0};
    tn_diagnostics said;
    tn_diagnostics_init(&said, &sources);
    tn_status status = tn_format_text(&said, tn_notation_or_first(source->path, source->text, source->size),
                                      source->path, source->text, source->size, text, size);
    if (status != TN_OK)
        status = fail(session, &said, status);
    tn_diagnostics_clear(&said);
    tn_sources_clear(&sources);
    return status;
}

tn_status tn_ask_format(tn_session *session, const tn_format_request *request, tn_reply *answer)
{
    const tn_opened *opened = session->opened;
    char *text = NULL;
    size_t size = 0;
    tn_error error;
    *answer = (tn_reply){0};
    if (!opened->compiled)
        return tn_session_refuse(session, "name the rule file that it was built from",
                                 "%.200s is a module, and only the text of a rule file is laid out", opened->path);
    const tn_source *source = &opened->compilation.sources.files[0];
    tn_status status = tn_reply_new(&tn_message_laid_out, answer, &error);
    if (status != TN_OK)
        return tn_session_fail(session, &error);
    status = lay_out(session, source, &text, &size);
    if (status != TN_OK)
        return status;
    tn_laid_out *to = answer->value;
    to->same = size == source->size && memcmp(text, source->text, size) == 0;
    to->has_text = !request->no_text;
    to->text = text; /* freed with the answer, also where it is not shown */
    return TN_OK;
}
