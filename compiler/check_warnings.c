/* Rules that are legal, but hardly say what was meant. */
#include "compiler/check.h"

/* Could one tray meet both? And does each leave trays out that the other lets in? (If not, one of them says nothing
 * new.) */
static bool both_and_neither(const tn_checked_spec *a, const tn_checked_spec *b)
{
    const tn_checked_schema *schema = a->schema;
    bool narrows_a = false, narrows_b = false;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        bool common = false;
        for (uint32_t v = 0; v < schema->fields[f].value_count; v++) {
            uint32_t bit = schema->fields[f].first_bit + v;
            bool in_a = a->mask[bit / 64] >> (bit % 64) & 1, in_b = b->mask[bit / 64] >> (bit % 64) & 1;
            common |= in_a && in_b;
            narrows_a |= in_a && !in_b;
            narrows_b |= in_b && !in_a;
        }
        if (!common)
            return false;
    }
    return narrows_a && narrows_b;
}

static void warn_two_trays(tn_check *check, const tn_ast_expr *conjunction)
{
    const tn_ast_expr *first = NULL;
    for (TN_EACH(const tn_ast_expr, part, conjunction->parts)) {
        if (part->kind != TN_EXPR_TRAY || !part->spec || part->spec->broken)
            continue;
        if (!first) {
            first = part;
            continue;
        }
        if (!both_and_neither(first->spec, part->spec) || !tn_check_wanted(check, W_TWO_TRAYS))
            return;
        tn_diagnostic *d = tn_report(check->diagnostics, W_TWO_TRAYS, tn_span_join(first->node.span, part->node.span),
                                     "these two may be met by two different trays of the plan");
        tn_help(check->diagnostics, d, "for one tray that is both write one specifier: `tray(..., ...)`");
        return;
    }
}

static void warn_not_tray(tn_check *check, const tn_ast_expr *part)
{
    if (!tn_check_wanted(check, W_NOT_TRAY_PART))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, W_NOT_TRAY_PART, part->node.span,
                                 "this part fits any number of trays, of which none is so");
    tn_help(check->diagnostics, d, "for one tray that is not so put the `not` inside: `tray(not 8')`");
}

static void warn_neighbour(tn_check *check, const tn_ast_expr *neighbour)
{
    for (TN_EACH(const tn_ast_expr, part, neighbour->parts)) {
        bool outer =
            (const tn_ast_node *)part == neighbour->parts.first || (const tn_ast_node *)part == neighbour->parts.last;
        if (!outer && part->kind == TN_EXPR_NOT && ((const tn_ast_expr *)part->parts.first)->kind == TN_EXPR_TRAY)
            warn_not_tray(check, part);
    }
}

static void warn_counted(tn_check *check, const tn_ast_expr *expr)
{
    const tn_ast_expr *part = (const tn_ast_expr *)expr->parts.first;
    uint32_t trays = part ? tn_min_trays(part) : 1;
    if (trays < 2 || !tn_check_wanted(check, W_NEVER_ONE_TRAY))
        return;
    const char *what = expr->kind == TN_EXPR_QUANTITY ? "quantity" : expr->kind == TN_EXPR_SUM ? "sum" : "many";
    tn_diagnostic *d = tn_report(check->diagnostics, W_NEVER_ONE_TRAY, part->node.span,
                                 "`%s` looks at single trays, and this takes %u or more", what, (unsigned)trays);
    if (expr->kind == TN_EXPR_QUANTITY)
        tn_help(check->diagnostics, d, "did you mean `occurrences`, which counts the places where it starts?");
    else
        tn_help(check->diagnostics, d, "name what a single tray has to be");
}

/* `somewhere`: is the expression about the plan (judgement H), where the parts of an `and` need not be met in one
 * place? */
static void warn(tn_check *check, const tn_ast_expr *expr, bool somewhere)
{
    switch (expr->kind) {
    case TN_EXPR_AND:
        if (somewhere)
            warn_two_trays(check, expr);
        break;
    case TN_EXPR_NEIGHBOUR:
        warn_neighbour(check, expr);
        somewhere = false;
        break;
    case TN_EXPR_QUANTITY:
    case TN_EXPR_SUM:
    case TN_EXPR_MANY:
        warn_counted(check, expr);
        somewhere = false;
        break;
    case TN_EXPR_NOT:
        somewhere = true; /* whatever it stands in, `not` denies that its part is somewhere in the stretch */
        break;
    case TN_EXPR_OR:
        break;
    default:
        somewhere = false;
        break;
    }
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        warn(check, part, somewhere);
}

void tn_check_warnings(tn_check *check, const tn_ast_expr *expr)
{
    warn(check, expr, true);
}
