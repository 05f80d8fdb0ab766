/* What the question `export` does with kits and with models that were drawn; and such models as requests give them. */
#ifndef TARTAN_ASK_PLACE_EXPORT_H
#define TARTAN_ASK_PLACE_EXPORT_H

#include "ask/session/session.h"
#include "driver/place/drawn.h"
#include "runtime/base/formats.h"

/* ---- models that were drawn, as requests give them */

/* The text of one, at hand. */
typedef struct tn_drawn_text {
    const char *name; /* what messages call it */
    const char *text; /* `size` bytes */
    size_t size;
    uint8_t *bytes; /* of a file that was read; owned */
} tn_drawn_text;

/* Does the request have one? */
bool tn_drawn_given(const tn_drawn_asked *asked);

/* The model, in cells of the session's kit, as tn_drawn_read has it. Clear it in any case. */
tn_status tn_drawn_model(const tn_session *session, const tn_drawn_asked *asked, tn_ldraw *ldraw, tn_error *error);

/* The words of export_request.as. */
enum { TN_EXPORT_PROLOG, TN_EXPORT_REGEX, TN_EXPORT_PCFG, TN_EXPORT_KIT };

/* Is a model that was drawn exported? */
bool tn_export_is_drawn(const tn_export_request *request);

/* A model of a kit as a connection grammar. */
tn_status tn_export_kit(tn_session *session, const tn_export_request *request, tn_reply *answer);

/* A model that was drawn as a connection grammar, or as a kit that uses the session's. A grammar says nothing of the
 * session's file, which need not be open. */
tn_status tn_export_drawn(tn_session *session, const tn_export_request *request, tn_reply *answer);

/* Answers with a file of that text; what fails is said. */
tn_status tn_export_give(tn_session *session, tn_file_format format, const char *text, size_t size, tn_reply *answer);

#endif
