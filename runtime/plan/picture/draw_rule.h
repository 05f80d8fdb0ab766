/* Rules as pictures, in the vocabulary of the paper's section 3.2 (Fig. 6 to 8): a box for a rule with a sign of its
 * kind; the parts of an `and` side by side and those of an `or` one above the other, dashed lines between; a neighbour
 * as its trays side by side, its box left out inside another rule; a quantity with its condition on top; a distance
 * with source, separator and destination; tray specifiers as the tray that they describe. What the paper does not have
 * (many, optional, occurrences, sum) is drawn in the same manner. Schemas without roles get labelled boxes for trays.
 */
#ifndef TARTAN_PLAN_PICTURE_DRAW_RULE_H
#define TARTAN_PLAN_PICTURE_DRAW_RULE_H

#include "runtime/base/picture.h"
#include "runtime/plan/picture/rule_boxes.h"
#include "runtime/plan/schema/schema.h"

/* The longest side of a picture, in points (E0820 past it): 200 inches, the most that a PDF page may have. */
#define TN_DRAW_RULE_SIDE_MAX 14400.0

/* A rule, or a clause written out in its library. */
typedef struct tn_drawn_rule {
    const char *name, *doc;
    uint32_t function; /* of either judgement */
} tn_drawn_rule;

tn_drawn_rule tn_drawn_rule_of(const tn_module *module, uint32_t rule); /* a RULE record */

/* Draws rules (of the schema) one below the other. Errors as in tn_plans_draw, and as in tn_parts_read. */
tn_status tn_rules_draw(const tn_schema *schema, const tn_drawn_rule *rules, size_t count, tn_picture *to,
                        tn_error *error);

/* A rule as boxes of its maker's, which it borrows: what else is drawn, and whether signs of trays say which field they
 * are of. */
typedef struct tn_drawn_boxes {
    const char *name, *doc;
    const tn_rule_boxes *boxes;
    bool signs; /* groups `data-item` and `data-depth`, with the field's number in its schema */
} tn_drawn_boxes;

/* Draws it as tn_rules_draw draws a rule alone. */
tn_status tn_rule_boxes_draw(const tn_schema *schema, const tn_drawn_boxes *rule, tn_picture *to, tn_error *error);

#endif
