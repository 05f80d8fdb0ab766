/* Pictures of plans, rules and houses; and plans gathered for a picture before any is drawn, since all share one scale.
 */
#ifndef TARTAN_ASK_PLAN_DRAW_H
#define TARTAN_ASK_PLAN_DRAW_H

#include "ask/form/draw.h"
#include "ask/session/requests.h"
#include "driver/open/open.h"
#include "runtime/plan/picture/draw.h"

/* ---- plans gathered for a picture, before any is drawn, since all share one scale */

typedef struct tn_plan_sheet {
    tn_drawn_plan *plans; /* trays, numbers and captions owned */
    size_t count, room;
} tn_plan_sheet;

/* Adds a plan, whose trays are copied. Takes over `number`, which NULL says there was no memory for, and `caption`,
 * which may be NULL; borrows `heading`. */
tn_status tn_sheet_add(tn_plan_sheet *sheet, const tn_tray *trays, size_t length, char *number, const char *heading,
                       char *caption, tn_error *error);
void tn_sheet_clear(tn_plan_sheet *sheet);

/* Does all that is asked for go together, and is it about the file? Otherwise TN_INVALID, which is said. For whoever
 * has plans to read first. */
tn_status tn_draw_check(tn_session *session, const tn_draw_request *request);

#endif
