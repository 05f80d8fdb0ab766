/* The order of the rules: what a rule names comes before it. Rules that name each other in a circle have none. */
#include "compiler/plan/check/check.h"

enum { UNSEEN, OPEN, DONE };

typedef struct tn_order_walk {
    tn_check *check;
    tn_checked_rule **stack; /* the rules whose uses are being followed */
    size_t depth;
    size_t ordered;
} tn_order_walk;

/* Reports the circle that leads from stack[start] through the top of the stack back to it. */
static void report_circle(tn_order_walk *walk, size_t start)
{
    tn_diagnostics *diagnostics = walk->check->diagnostics;
    tn_checked_rule *first = walk->stack[start];
    tn_diagnostic *d = tn_report(diagnostics, E_RULE_CYCLE, first->ast->name->node.span, "%s `%s` uses itself%s",
                                 first->is_measure ? "measure" : "rule", first->name,
                                 start + 1 == walk->depth ? "" : ", by way of others");
    enum { SHOWN = 8 };
    for (size_t i = start; i < walk->depth && i < start + SHOWN; i++) {
        tn_checked_rule *rule = walk->stack[i];
        tn_ast_expr *place = rule->use_places[rule->next_use - 1];
        tn_note(diagnostics, d, &place->node.span, "`%s` uses `%s` here", rule->name, place->rule->name);
    }
    tn_help(diagnostics, d, "write out what one of them means instead of naming the other");
}

/* Takes the next use of the rule on top: opens the rule that it names, or closes the circle. */
static void follow(tn_order_walk *walk, tn_checked_rule *rule)
{
    tn_ast_expr *place = rule->use_places[rule->next_use];
    tn_checked_rule *used = rule->uses[rule->next_use++];
    if (used->state == UNSEEN) {
        used->state = OPEN;
        walk->stack[walk->depth++] = used;
    } else if (used->state == OPEN) {
        size_t start = walk->depth;
        while (walk->stack[start - 1] != used)
            start--;
        if (!used->hidden || used->of->is_template) /* else it was, with the older rule */
            report_circle(walk, start - 1);
        place->rule = NULL;
    }
}

void tn_check_order(tn_check *check)
{
    tn_checked *result = check->result;
    tn_order_walk walk = {.check = check,
                          .ordered = result->ordered,
                          .stack = TN_NEW_ARRAY(check->arena, tn_checked_rule *, result->rule_count)};
    if (!walk.stack)
        return;
    for (size_t i = 0; i < result->rule_count; i++) {
        if (result->rules[i]->state != UNSEEN)
            continue;
        result->rules[i]->state = OPEN;
        walk.stack[walk.depth++] = result->rules[i];
        while (walk.depth > 0) {
            tn_checked_rule *rule = walk.stack[walk.depth - 1];
            if (rule->next_use < rule->use_count) {
                follow(&walk, rule);
            } else {
                rule->state = DONE;
                result->order[walk.ordered++] = rule;
                walk.depth--;
            }
        }
    }
    result->ordered = walk.ordered;
}
