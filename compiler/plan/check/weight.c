/* Weights of a library: how much likelier each single tray of a kind makes a plan in samples. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/amount.h"

/* ---- the number */

static bool is_small_constant(const tn_ast_expr *expr)
{
    return expr->kind == TN_EXPR_NUMBER || expr->kind == TN_EXPR_NEGATIVE;
}

/* What is written between two places, if it is on one line; else `otherwise`. */
static void quote(const tn_check *check, tn_span span, const char *otherwise, char *text, size_t size)
{
    const char *from = check->diagnostics->sources->files[span.file].text + span.begin;
    size_t length = span.end - span.begin;
    bool fits = length + 1 < size && !memchr(from, '\n', length);
    snprintf(text, size, "%.*s", fits ? (int)length : (int)strlen(otherwise), fits ? from : otherwise);
}

/* Its number is missing: it may stand behind a sign that cannot be there (`weight a = 7`, `weight a -3`). */
static void report_missing(tn_check *check, const tn_ast_clause *ast)
{
    const tn_ast_expr *what = (const tn_ast_expr *)ast->expr->parts.first,
                      *left = (const tn_ast_expr *)what->parts.first, *right = (const tn_ast_expr *)what->parts.last;
    bool two = what->parts.count == 2 && (what->kind == TN_EXPR_COMPARE || tn_is_arithmetic(what->kind)) &&
               right->kind == TN_EXPR_NUMBER && !tn_is_constant(left);
    char trays[200];
    quote(check, two ? left->node.span : what->node.span, "tray(...)", trays, sizeof trays);
    if (two && what->kind == TN_EXPR_MINUS) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_WEIGHT, what->node.span, "a weight is a number above 0");
        tn_help(check->diagnostics, d, "what makes plans less likely is below 1: `weight %s 0.5`", trays);
        return;
    }
    tn_diagnostic *d =
        two ? tn_report(check->diagnostics, E_BAD_WEIGHT, what->node.span, "a weight has its number behind it alone")
            : tn_report(check->diagnostics, E_BAD_WEIGHT, ast->node.span, "this weight has no number");
    if (two) {
        tn_help(check->diagnostics, d, "write `weight %s %s`", trays, right->name->text);
        tn_replace_with(check->diagnostics, d, "%s %s", trays, right->name->text);
    } else {
        tn_help(check->diagnostics, d, "write how many times as likely each such tray makes a plan: `weight %s 3`",
                is_small_constant(what) ? "tray(...)" : trays);
    }
}

/* The number of a weight, or what a preference is worth: "p/q". NULL: reported. */
const char *tn_check_positive(tn_check *check, const tn_ast_word *word, const char *what, const char *none)
{
    tn_sum_amount amount = tn_amount_read(check, word);
    if (!amount.value)
        return NULL;
    if (amount.power != 0) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_WEIGHT, word->node.span,
                                     "%s is a number without a unit, and this is %s", what,
                                     amount.power == 1   ? "a length"
                                     : amount.power == 2 ? "an area"
                                                         : "a volume");
        size_t digits = strspn(word->text, "0123456789.");
        bool plain = digits > 0 && strspn(word->text, "0.") < digits && word->text[digits - 1] != '.';
        if (plain)
            tn_advise(check->diagnostics, d, "%.*s", (int)digits, word->text);
        else
            tn_help(check->diagnostics, d, "write a number such as 3 or 0.5");
        return NULL;
    }
    if (!tn_amount_is_zero(amount.value))
        return amount.value;
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_WEIGHT, word->node.span, "%s is a number above 0", what);
    tn_help(check->diagnostics, d, "%s", none);
    return NULL;
}

/* ---- what is weighed */

/* `weight quantity(tray(cafe)) 3`: a number of trays where trays are meant. */
static bool is_number(tn_check *check, tn_ast_expr *what)
{
    if (what->kind == TN_EXPR_NAME)
        tn_check_expr_name(check, what);
    if (!tn_is_sum(what))
        return false;
    tn_diagnostic *d = tn_report(check->diagnostics, E_RULE_OR_NUMBER, what->node.span,
                                 "a weight is about what single trays are, and this is a number");
    const tn_ast_expr *part = (const tn_ast_expr *)what->parts.first;
    char trays[200] = "tray(...)";
    if (what->kind == TN_EXPR_QUANTITY)
        quote(check, part->node.span, "tray(...)", trays, sizeof trays);
    tn_help(check->diagnostics, d, "each such tray counts: write `weight %s 3`", trays);
    if (what->kind == TN_EXPR_QUANTITY)
        tn_replace_with(check->diagnostics, d, "%s", trays);
    return true;
}

/* What is weighed is written out. */
static void check_trays(tn_check *check, tn_ast_clause *ast)
{
    size_t unit = check->unit;
    tn_checked_schema *schema = check->schema;
    tn_ast_list allow = check->allow;
    tn_check_settle(check);
    check->unit = unit;
    check->schema = schema;
    check->allow = allow;
    check->rule = NULL;
    tn_check_sum_expr(check, ast->expr);
    tn_check_meaning(check, ast->expr);
    tn_check_around(check, ast->expr);
    tn_check_whole(check, ast->expr);
    tn_check_weight_warnings(check, ast->expr);
}

static void put(tn_check *check, tn_checked_library *library, tn_checked_weight *weight)
{
    if (library->weight_count == library->weight_capacity) {
        size_t capacity = library->weight_capacity ? library->weight_capacity * 2 : 4;
        tn_checked_weight **weights = TN_NEW_ARRAY(check->arena, tn_checked_weight *, capacity);
        if (!weights)
            return;
        if (library->weight_count > 0)
            memcpy(weights, library->weights, library->weight_count * sizeof *weights);
        library->weights = weights;
        library->weight_capacity = capacity;
    }
    library->weights[library->weight_count++] = weight;
}

static void name(tn_check *check, tn_checked_library *library, tn_checked_weight *weight, tn_span span)
{
    const tn_ast_expr *what = (const tn_ast_expr *)weight->ast->expr->parts.first;
    const tn_checked_rule *rule = what->kind == TN_EXPR_NAME ? what->rule : NULL;
    if (rule && (!rule->hidden || !rule->of->is_template))
        weight->name = rule->name;
    else
        weight->name = tn_clause_name(check, &library->weight_names, "weight", span);
    if (weight->name)
        tn_names_put(&library->weight_names, weight->name, weight);
}

void tn_check_weight(tn_check *check, tn_checked_library *library, tn_ast_clause *ast)
{
    if (!tn_check_room(check, library->weight_count, TN_CLAUSES_MAX, "clause", ast->node.span,
                       "join some of them by `or`"))
        return;
    if (!ast->word) {
        report_missing(check, ast);
        return;
    }
    tn_checked_weight *weight = TN_NEW(check->arena, tn_checked_weight);
    if (!weight)
        return;
    *weight = (tn_checked_weight){
        .ast = ast, .unit = library->unit, .older = library->schema, .written = ast->expr, .span = ast->node.span};
    tn_expand(check, &ast->expr);
    if (is_number(check, (tn_ast_expr *)ast->expr->parts.first))
        return;
    weight->factor = tn_check_positive(check, ast->word, "a weight",
                                       "to leave out plans with such trays, write `prune` with what they are");
    check_trays(check, ast);
    weight->sum = library->schema ? tn_check_sum(check, ast->expr) : NULL;
    if (weight->factor && weight->sum && !weight->sum->houses) {
        name(check, library, weight, ast->node.span);
        put(check, library, weight);
    }
}

/* ---- taken over */

/* A weight of a library for an older schema, for the schema of this one. */
static tn_checked_weight *renew(tn_check *check, tn_checked_library *library, const tn_checked_weight *old)
{
    tn_ast_clause *ast = TN_NEW(check->arena, tn_ast_clause);
    tn_checked_weight *weight = TN_NEW(check->arena, tn_checked_weight);
    if (!ast || !weight)
        return NULL;
    *weight = *old;
    *ast = *old->ast;
    weight->ast = ast;
    check->schema = library->schema;
    check->unit = old->unit;
    check->quiet = true;
    ast->expr = tn_expand_older(check, old->written, old->unit, old->older);
    if (ast->expr)
        check_trays(check, ast);
    weight->sum = ast->expr ? tn_check_sum(check, ast->expr) : NULL;
    check->quiet = false;
    return weight->sum ? weight : NULL;
}

void tn_check_weights_of(tn_check *check, tn_checked_library *library, const tn_checked_library *from, bool newer)
{
    for (size_t i = 0; i < from->weight_count; i++) {
        tn_checked_weight *weight = newer ? renew(check, library, from->weights[i]) : from->weights[i];
        if (!weight)
            continue;
        put(check, library, weight);
        tn_names_put(&library->weight_names, weight->name, weight);
    }
}
