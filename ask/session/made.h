/* The files that a question makes: written where whoever takes them says, or put into the answer. */
#ifndef TARTAN_ASK_SESSION_MADE_H
#define TARTAN_ASK_SESSION_MADE_H

#include <stdio.h>

#include "ask/session/session.h"
#include "runtime/base/formats.h"
#include "runtime/base/picture.h"

/* Whoever takes files (tn_session.files), one after another. */
typedef struct tn_file_taker {
    /* Gives the stream that the next file is written to. name: of one of several, otherwise NULL. */
    tn_status (*opens)(void *context, const char *name, FILE **stream, tn_error *error);
    /* Ends it; it is given up unless it is whole. */
    tn_status (*closes)(void *context, bool whole, tn_error *error);
    void *context;
} tn_file_taker;

/* Whoever takes what is in files of an answer that are no text (tn_session.bytes), instead of base64: in the order of
 * the files. The bytes are lent. */
typedef struct tn_bytes_taker {
    tn_status (*take)(void *context, const tn_made_file *file, const uint8_t *bytes, size_t size, tn_error *error);
    void *context;
} tn_bytes_taker;

/* A file on its way. */
typedef struct tn_making {
    const tn_file_taker *taker;  /* or NULL */
    const tn_bytes_taker *lends; /* or NULL */
    tn_made_file *to;            /* of the answer; its content is left out if there is a taker */
    tn_file_format format;
    FILE *stream; /* write here */
    char *bytes;
    size_t size;
} tn_making;

/* Begins a file; of the format TN_FILE_OTHER it is a text. `to` is an empty one of the answer; name (NULL if it is the
 * only one) is copied. */
tn_status tn_making_begin(tn_making *making, tn_session *session, tn_file_format format, const char *name,
                          tn_made_file *to, tn_error *error);

/* Ends it after that status, which it returns unless ending it fails. Call it if, and only if, beginning went well. */
tn_status tn_making_end(tn_making *making, tn_status status, tn_error *error);

/* Begins a picture, which is drawn into memory: `to` says in which format. Its resolution and watch are set by the
 * caller. tn_made_picture puts what was drawn into the answer, or gives it to the taker, and frees it. */
tn_picture tn_picture_asked(tn_file_format format);
tn_status tn_made_picture(tn_session *session, tn_picture *drawn, tn_file_format format, const char *name,
                          tn_made_file *to, tn_error *error);

/* Puts a picture, the only one of an answer, into its list of files, unless drawing it failed with that error, which is
 * said. Frees the picture. */
tn_status tn_picture_give(tn_session *session, tn_file_format format, tn_picture *drawn, tn_status status,
                          tn_error *error, tn_list *files);

/* Is a picture of an answer asked for, too? */
static inline bool tn_answer_has_picture(const tn_answer_picture *asked)
{
    return asked->picture != 0;
}

/* Such a picture, to be drawn; and then given as tn_picture_give does. The answer says nothing of a picture that went
 * to a taker: `has` says whether it does. */
tn_picture tn_answer_picture_begin(const tn_answer_picture *asked);
tn_status tn_answer_picture_give(tn_session *session, const tn_answer_picture *asked, tn_picture *drawn,
                                 tn_status status, tn_error *error, tn_list *files, bool *has);

#endif
