/* What a library leans to without leaving plans out: weights, how much likelier each single tray of a kind makes a plan
 * in samples; and preferences, what plans should match, which together are a measure of it, `preference`. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/amount.h"

/* ---- numbers */

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

/* ---- weights */

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

static void put_weight(tn_check *check, tn_checked_library *library, tn_checked_weight *weight)
{
    tn_checked_weight **weights =
        tn_arena_room(check->arena, library->weights, library->weight_count, &library->weight_capacity);
    if (!weights)
        return;
    library->weights = weights;
    library->weights[library->weight_count++] = weight;
}

static void name_weight(tn_check *check, tn_checked_library *library, tn_checked_weight *weight, tn_span span)
{
    const tn_checked_rule *rule = tn_clause_rule((const tn_ast_expr *)weight->ast->expr->parts.first);
    if (rule)
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
        name_weight(check, library, weight, ast->node.span);
        put_weight(check, library, weight);
    }
}

/* ---- weights that are taken over */

/* A weight of a library for an older schema, for the schema of this one. */
static tn_checked_weight *renew_weight(tn_check *check, tn_checked_library *library, const tn_checked_weight *old)
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
        tn_checked_weight *weight = newer ? renew_weight(check, library, from->weights[i]) : from->weights[i];
        if (!weight)
            continue;
        put_weight(check, library, weight);
        tn_names_put(&library->weight_names, weight->name, weight);
    }
}

/* ---- preferences in a list */

static void put_preference(tn_check *check, tn_checked_library *library, tn_checked_preference *preference)
{
    tn_checked_preference **preferences =
        tn_arena_room(check->arena, library->preferences, library->preference_count, &library->preference_capacity);
    if (!preferences)
        return;
    library->preferences = preferences;
    library->preferences[library->preference_count++] = preference;
    tn_names_put(&library->preference_names, preference->name, preference);
}

/* ---- names of preferences */

/* Is the name free that the author gave, or that its rule has? A clause may have the name of a rule that is preferred,
 * too; but no two have one that was given. */
static bool name_is_free(tn_check *check, const tn_checked_library *library, const tn_checked_preference *preference)
{
    const tn_ast_word *given = preference->ast->name;
    const tn_checked_preference *before = tn_names_get(&library->preference_names, preference->name);
    const tn_checked_clause *clause = given ? tn_names_get(&library->clause_names, preference->name) : NULL;
    if (!before && !clause)
        return true;
    tn_span place = given ? given->node.span : preference->expr->node.span;
    tn_diagnostic *d = tn_report(check->diagnostics, E_DUPLICATE_CLAUSE, place, "library `%s` has a %s `%s` already",
                                 library->name, before ? "preference" : "clause", preference->name);
    tn_note(check->diagnostics, d, before ? &before->span : &clause->span, "it is here");
    tn_help(check->diagnostics, d, "give one of the two another name with `as`");
    return false;
}

static bool find_name(tn_check *check, const tn_checked_library *library, tn_checked_preference *preference)
{
    const tn_checked_rule *rule = tn_clause_rule(preference->expr);
    const tn_ast_word *given = preference->ast->name;
    if (rule) {
        preference->name = rule->name;
        if (!preference->doc && rule->ast->doc)
            preference->doc = rule->ast->doc->text;
    }
    if (given)
        preference->name = given->text;
    if (given && !tn_name_fits(check->diagnostics, given->text, given->node.span))
        return false;
    if (preference->name)
        return name_is_free(check, library, preference);
    preference->name = tn_clause_name(check, &library->preference_names, "prefer", preference->span);
    return preference->name != NULL;
}

/* ---- preferences: own ones, and those taken over */

void tn_check_preference(tn_check *check, tn_checked_library *library, tn_ast_clause *ast)
{
    if (!tn_check_room(check, library->preference_count, TN_CLAUSES_MAX, "clause", ast->node.span,
                       "join some of them by `or`"))
        return;
    tn_checked_preference *preference = TN_NEW(check->arena, tn_checked_preference);
    if (!preference)
        return;
    *preference = (tn_checked_preference){.ast = ast,
                                          .doc = ast->doc ? ast->doc->text : NULL,
                                          .worth = "1",
                                          .unit = library->unit,
                                          .older = library->schema,
                                          .written = ast->expr,
                                          .span = ast->node.span};
    tn_check_clause_expr(check, ast);
    preference->expr = ast->expr;
    if (ast->word)
        preference->worth = tn_check_positive(check, ast->word, "what a preference is worth",
                                              "leave out what is worth nothing; what should not be is `prefer not a`");
    if (preference->worth && find_name(check, library, preference))
        put_preference(check, library, preference);
}

/* A preference of a library for an older schema, for the schema of this one. */
static tn_checked_preference *renew_preference(tn_check *check, const tn_checked_library *library,
                                               const tn_checked_preference *old)
{
    tn_ast_clause *ast = TN_NEW(check->arena, tn_ast_clause);
    tn_checked_preference *preference = TN_NEW(check->arena, tn_checked_preference);
    if (!ast || !preference)
        return NULL;
    *preference = *old;
    *ast = *old->ast;
    preference->ast = ast;
    check->schema = library->schema;
    check->unit = old->unit;
    check->quiet = true;
    ast->expr = tn_expand_older(check, old->written, old->unit, old->older);
    if (ast->expr)
        tn_check_clause_expr(check, ast);
    preference->expr = ast->expr;
    check->quiet = false;
    return preference->expr ? preference : NULL;
}

void tn_check_preferences_of(tn_check *check, tn_checked_library *library, const tn_checked_library *from, bool newer)
{
    for (size_t i = 0; i < from->preference_count; i++) {
        tn_checked_preference *preference =
            newer ? renew_preference(check, library, from->preferences[i]) : from->preferences[i];
        if (preference)
            put_preference(check, library, preference);
    }
}

/* ---- the measure that they are together */

/* A measure of the author's would be told apart from it by nothing. */
static void refuse_own_measure(tn_check *check, const tn_checked_library *library)
{
    const tn_checked_name *name = tn_names_get(&check->names, TN_PREFERENCE_NAME);
    const tn_checked_rule *measure = name && name->rule && name->rule->is_measure ? name->rule : NULL;
    bool same = measure && measure->schema && !measure->form && library->schema &&
                (measure->schema == library->schema || tn_schema_extends(library->schema, measure->schema));
    if (!same || (library->from && library->from->preference_count > 0))
        return;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_OWN_PREFERENCE, name->span,
                  "library `%s` prefers, so that `%s` is a measure of it already", library->name, TN_PREFERENCE_NAME);
    tn_note(check->diagnostics, d, &library->preferences[0]->span, "its first preference is here");
    tn_help(check->diagnostics, d, "give this measure another name, such as `my-preference`");
}

void tn_check_preferred(tn_check *check, tn_checked_library *library)
{
    size_t count = library->preference_count;
    tn_checked_sum *sum = count > 0 ? TN_NEW(check->arena, tn_checked_sum) : NULL;
    tn_checked_term *terms = sum ? TN_NEW_ARRAY(check->arena, tn_checked_term, count) : NULL;
    if (!terms)
        return;
    for (size_t i = 0; i < count; i++) {
        tn_checked_preference *preference = library->preferences[i];
        bool named = preference->expr->kind == TN_EXPR_NAME;
        terms[i] = (tn_checked_term){.kind = TN_TERM_MATCHES,
                                     .factor = preference->worth,
                                     .part = named ? NULL : preference->expr,
                                     .rule = named ? preference->expr->rule : NULL,
                                     .span = preference->expr->node.span};
    }
    *sum = (tn_checked_sum){.schema = library->schema,
                            .terms = terms,
                            .count = count,
                            .constant = "0",
                            .whole = true,
                            .span = library->ast->name->node.span,
                            .index = TN_NONE};
    library->preferred = sum;
    refuse_own_measure(check, library);
}

void tn_check_name_preference(tn_check *check, tn_checked_library *library)
{
    if (!library->preferred || tn_names_get(&check->names, TN_PREFERENCE_NAME))
        return;
    const tn_ast_word *word = library->ast->name;
    tn_ast_rule *ast = TN_NEW(check->arena, tn_ast_rule);
    tn_ast_expr *body = TN_NEW(check->arena, tn_ast_expr);
    tn_checked_rule *measure = TN_NEW(check->arena, tn_checked_rule);
    tn_checked_name *name = TN_NEW(check->arena, tn_checked_name);
    if (!ast || !body || !measure || !name)
        return;
    *body = (tn_ast_expr){.node.span = word->node.span, .kind = TN_EXPR_BROKEN};
    *ast = (tn_ast_rule){.top = {.node.span = word->node.span, .kind = TN_ITEM_MEASURE}, .name = word, .body = body};
    *measure = (tn_checked_rule){.ast = ast,
                                 .name = TN_PREFERENCE_NAME,
                                 .unit = check->unit,
                                 .schema = library->schema,
                                 .meaning = body,
                                 .is_measure = true,
                                 .sum = library->preferred};
    *name = (tn_checked_name){.rule = measure, .span = word->node.span, .unit = check->unit};
    tn_names_put(&check->names, TN_PREFERENCE_NAME, name);
}
