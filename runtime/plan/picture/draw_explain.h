/* Why a plan is as a rule says, as a picture: the plan, and under it a row for each part of the rules, with the trays
 * that it matched in green and what it lacks in red; of a rule that prunes the plan, what it matched in red. */
#ifndef TARTAN_PLAN_PICTURE_DRAW_EXPLAIN_H
#define TARTAN_PLAN_PICTURE_DRAW_EXPLAIN_H

#include "runtime/base/picture.h"
#include "runtime/plan/analysis/explain.h"
#include "runtime/plan/picture/draw.h"

/* A row. Depth 0 is a rule, whose evidence is what its author says of it. */
typedef struct tn_drawn_reason {
    const char *text, *evidence; /* evidence may be NULL */
    unsigned depth;
    bool matched;
    bool drops;              /* the rule prunes the plan: what matched is to blame */
    const tn_stretch *marks; /* where it matched */
    uint32_t mark_count;
    tn_stretch region;  /* where it was looked for */
    tn_stretch partly;  /* not matched: where a piece of it is; or empty */
    tn_stretch lacking; /* not matched: the tray that comes closest; or empty */
    uint32_t number;    /* of a rule among all that were asked; of a part in the rule's explanation, which is 0, each
                           before its own parts */
} tn_drawn_reason;

/* The most rows of a picture (E0820 past it). */
#define TN_DRAW_REASONS_MAX 2000u

/* A plan, why it is as it is, and perhaps plans to compare it with, each under its caption. */
typedef struct tn_drawn_reasons {
    const char *title; /* or NULL */
    tn_drawn_plan plan;
    const tn_drawn_reason *reasons;
    size_t count;
    const char *near_title;
    const tn_drawn_plan *near;
    size_t near_count;
} tn_drawn_reasons;

/* Errors as in tn_plans_draw. */
tn_status tn_reasons_draw(const tn_schema *schema, const tn_drawn_reasons *drawn, tn_picture *to, tn_error *error);

#endif
