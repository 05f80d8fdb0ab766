/* Questions about rule files, as JSON: what commands answer with --json, by the same functions. docs/requests.md lists
 * the questions, what they are asked with and what they are answered with. Only libtartan has this. */
#ifndef TARTAN_ASK_H
#define TARTAN_ASK_H

#include "compile.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A rule file that is asked one question after another; what does not change between them is kept. It belongs to one
 * thread at a time. */
typedef struct tartan_session tartan_session;

/* Compiles a text as tartan_compile_text does; text NULL: the file at `path`. `path`, the text and the folders of
 * `options` are copied. A question with requirements of its own (`where`) compiles the text again, and `diff` asks for
 * the file before the edit as for one that is used: `resolve`, and what it needs, has to stay until the session is
 * freed. */
TARTAN_API tartan_status tartan_session_open(const char *path, const char *text, size_t size,
                                             const tartan_compile_options *options, tartan_session **session,
                                             tartan_error *error);
TARTAN_API void tartan_session_free(tartan_session *session);

/* Asks a question ("count"). request: a JSON object, such as {"library": "houses", "by": "cost"}, or NULL for one
 * without members. The answer is a JSON text; free it with tartan_text_free. Notes, and all that is wrong, go to
 * `report` (may be NULL), and the first error to `error`. TARTAN_INVALID also if there is no such question, or the
 * request has members that it does not know. `watch` may be NULL. */
TARTAN_API tartan_status tartan_ask(tartan_session *session, const char *question, const char *request,
                                    const tartan_watch *watch, tartan_report *report, void *report_context,
                                    char **answer, tartan_error *error);

/* Takes a file of an answer that is no text, such as a mesh or a picture in pixels: its format ("glb"), its name (NULL:
 * it is the only one) and its bytes, which are lent. If it returns anything but TARTAN_OK, that is how the question
 * ends, with what `error` says then. */
typedef tartan_status tartan_bytes_taker(void *context, const char *format, const char *name, const void *bytes,
                                         size_t size, tartan_error *error);

/* From now on files of answers that are no text go to `take` while questions are answered, in the order of the answers,
 * which then have their formats alone. take NULL: the answers have what is in them, too, in base64. */
TARTAN_API void tartan_session_take_bytes(tartan_session *session, tartan_bytes_taker *take, void *context);

#ifdef __cplusplus
}
#endif

#endif
