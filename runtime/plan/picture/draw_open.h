/* An open plan as a picture: its written trays side by side, and under each what may stand there: every field's values,
 * how many completions have them, and perhaps the best that each still allows. */
#ifndef TARTAN_PLAN_PICTURE_DRAW_OPEN_H
#define TARTAN_PLAN_PICTURE_DRAW_OPEN_H

#include "runtime/base/picture.h"
#include "runtime/plan/schema/schema.h"

/* A value at a written tray. */
typedef struct tn_drawn_choice {
    const char *count; /* in digits, their groups apart */
    const char *best;  /* or NULL */
    double share;      /* of all completions; 0: the value cannot stand there, and is drawn grey */
} tn_drawn_choice;

typedef struct tn_drawn_open {
    const char *title, *doc;   /* of the library */
    const char *about;         /* how many plans complete it */
    const char *best_name;     /* what the best is of: "least cost"; or NULL */
    const uint32_t *functions; /* the pattern: of M, or TN_NO_RECORD for a gap */
    size_t count;
    const tn_drawn_choice *choices; /* [written trays][values of the schema] */
} tn_drawn_open;

/* The trays of a picture stand in rows of this width, in points. */
#define TN_DRAW_OPEN_WIDTH 1100.0

/* Errors as in tn_plans_draw, and as in tn_parts_read. */
tn_status tn_open_plan_draw(const tn_schema *schema, const tn_drawn_open *open, tn_picture *to, tn_error *error);

#endif
