/* Pictures of forms, and how a picture becomes an answer. */
#ifndef TARTAN_ASK_FORM_DRAW_H
#define TARTAN_ASK_FORM_DRAW_H

#include "ask/session/made.h"
#include "ask/session/requests.h"

/* The words of `show`, in their order. */
typedef enum tn_draw_show { TN_DRAW_VIEW, TN_DRAW_SHEET, TN_DRAW_BEFORE, TN_DRAW_EXPLODED, TN_DRAW_HISTORY } tn_draw_show;

/* The format of the picture that is asked for. */
tn_file_format tn_draw_format(const tn_draw_request *request);

/* Puts a picture into the answer, unless drawing it failed with that error, which is said. Frees the picture. */
tn_status tn_draw_give(tn_session *session, const tn_draw_request *request, tn_picture *drawn, tn_status status,
                       tn_error *error, tn_drawn_picture *made);

/* Draws a surface, or a design of boxes. */
tn_status tn_draw_form(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made);

#endif
