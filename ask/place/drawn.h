/* Models that were drawn, as requests give them: by their text, or by the name of a file. */
#ifndef TARTAN_ASK_PLACE_DRAWN_H
#define TARTAN_ASK_PLACE_DRAWN_H

#include "ask/session/session.h"
#include "driver/place/drawn.h"

/* The text of one, at hand. */
typedef struct tn_drawn_text {
    const char *name; /* what messages call it */
    const char *text; /* `size` bytes */
    size_t size;
    uint8_t *bytes; /* of a file that was read; owned */
} tn_drawn_text;

/* Does the request have one? */
bool tn_drawn_given(const tn_drawn_asked *asked);

/* Reads the file, unless the text was given; free its bytes after TN_OK. Errors as of tn_file_read. */
tn_status tn_drawn_find(const tn_session *session, const tn_drawn_asked *asked, tn_drawn_text *drawn, tn_error *error);

/* The model, in cells of the session's kit, as tn_drawn_read has it. Clear it in any case. */
tn_status tn_drawn_model(const tn_session *session, const tn_drawn_asked *asked, tn_ldraw *ldraw, tn_error *error);

#endif
