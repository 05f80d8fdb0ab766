/* Plans gathered for a picture, before any is drawn, since all share one scale. */
#ifndef TARTAN_ASK_PLAN_SHEET_H
#define TARTAN_ASK_PLAN_SHEET_H

#include "driver/open/open.h"
#include "runtime/plan/picture/draw.h"

typedef struct tn_plan_sheet {
    tn_drawn_plan *plans; /* trays, numbers and captions owned */
    size_t count, room;
} tn_plan_sheet;

/* Adds a plan, whose trays are copied. Takes over `number`, which NULL says there was no memory for, and `caption`,
 * which may be NULL; borrows `heading`. */
tn_status tn_sheet_add(tn_plan_sheet *sheet, const tn_tray *trays, size_t length, char *number, const char *heading,
                       char *caption, tn_error *error);
void tn_sheet_clear(tn_plan_sheet *sheet);

/* "ward.plan, rules 0123456789abcdef, tartan 1.0": the last note of a sheet. Only the file's name, so that the same
 * sheet can be made anywhere. */
void tn_sheet_note_rules(const tn_opened *opened, char *note, size_t size);

#endif
