/* What the files that draw rules share: the picture at hand, and the paper's signs (section 3.2). */
#ifndef TARTAN_PLAN_PICTURE_DRAW_RULE_DATA_H
#define TARTAN_PLAN_PICTURE_DRAW_RULE_DATA_H

#include "runtime/plan/picture/draw_parts.h"
#include "runtime/plan/picture/draw_rule.h"

#define TN_RULE_SIGN_SIZE 8.0
#define TN_RULE_END_WIDTH 13.0 /* of the mark of the plan's beginning or end */

typedef struct tn_size {
    double width, height;
} tn_size;

/* One rule being drawn. */
typedef struct tn_rule_picture {
    tn_paint *paint;
    tn_draw_roles roles;
    tn_drawn_boxes rule;
    tn_size *sizes; /* [box] */
} tn_rule_picture;

static inline const tn_rule_box *tn_rule_box_at(const tn_rule_picture *p, uint32_t box)
{
    return &p->rule.boxes->items[box];
}

void tn_draw_rule_box(tn_paint *paint, double x, double y, tn_size s);
void tn_draw_rule_dashes(tn_paint *paint, double x1, double y1, double x2, double y2);
void tn_draw_rule_arrow(tn_paint *paint, double from, double to, double y);

/* Two trays side by side: the sign of a neighbour. */
void tn_draw_neighbour_sign(tn_paint *paint, double x, double y);

/* `or` under an arrow both ways: a row or its mirror image. */
void tn_draw_symmetric_sign(tn_paint *paint, double x, double y);

/* The plan's outer wall, with the side beyond it struck out. */
void tn_draw_plan_end(tn_paint *paint, double x, double y, double height, bool left);

/* Above the source of a distance. */
void tn_draw_check_mark(tn_paint *paint, double x, double y);

/* A rule by its name. */
void tn_draw_tag(tn_paint *paint, const char *name, double x, double y, tn_size s);

/* Brackets, and that it may be left out. */
void tn_draw_optional(tn_paint *paint, double x, double y, tn_size s);

/* ---- tray specifiers (draw_rule_tray.c) */

/* How much room the symbol of a specifier needs. */
void tn_draw_spec_measure(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, double *width, double *height);

typedef struct tn_spec_look {
    bool mirrored;
    bool signs; /* its signs say which field they are of */
} tn_spec_look;
void tn_draw_spec(tn_paint *paint, const tn_draw_roles *roles, uint32_t spec, double x, double y, tn_spec_look look);

/* A tray that has no symbol: words of several lines in a box. */
void tn_draw_label_measure(tn_paint *paint, const tn_draw_roles *roles, const char *words, double *width,
                           double *height);
void tn_draw_label(tn_paint *paint, const tn_draw_roles *roles, const char *words, double x, double y);

#endif
