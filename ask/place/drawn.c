/* Finds the text of a model that was drawn, and reads it. */
#include "ask/place/drawn.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/file.h"

bool tn_drawn_given(const tn_drawn_asked *asked)
{
    return asked->ldraw || asked->path;
}

tn_status tn_drawn_find(const tn_session *session, const tn_drawn_asked *asked, tn_drawn_text *drawn, tn_error *error)
{
    *drawn = (tn_drawn_text){.name = asked->path ? asked->path : "the drawn model",
                             .text = asked->ldraw,
                             .size = asked->ldraw ? strlen(asked->ldraw) : 0};
    if (asked->ldraw)
        return TN_OK;
    tn_status status = session->reads
                           ? session->reads(session->reads_context, asked->path, &drawn->bytes, &drawn->size, error)
                           : tn_file_read(asked->path, TN_DRAWN_BYTES, &drawn->bytes, &drawn->size, error);
    drawn->text = (const char *)drawn->bytes;
    return status;
}

tn_status tn_drawn_model(const tn_session *session, const tn_drawn_asked *asked, tn_ldraw *ldraw, tn_error *error)
{
    tn_drawn_text drawn;
    *ldraw = (tn_ldraw){0};
    tn_status status = tn_drawn_find(session, asked, &drawn, error);
    if (status != TN_OK)
        return status;
    const char *beside = session->reads ? NULL : asked->path;
    status = tn_drawn_read_text(drawn.text, drawn.size, drawn.name, beside, session->opened->module, ldraw, error);
    free(drawn.bytes);
    return status;
}
