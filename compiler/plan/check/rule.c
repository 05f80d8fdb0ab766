/* Rule expressions: what may stand where, and what names mean. */
#include <ctype.h>
#include <string.h>

#include "compiler/plan/check/amount.h"
#include "runtime/base/nearest.h"

/* ---- names */

static void add_use(tn_check *check, tn_ast_expr *expr)
{
    tn_checked_rule *rule = check->rule;
    if (!rule) { /* in a library */
        expr->rule->used = true;
        return;
    }
    if (rule->use_count == rule->use_capacity) {
        size_t capacity = rule->use_capacity ? rule->use_capacity * 2 : 4;
        tn_checked_rule **uses = TN_NEW_ARRAY(check->arena, tn_checked_rule *, capacity);
        tn_ast_expr **places = TN_NEW_ARRAY(check->arena, tn_ast_expr *, capacity);
        if (!uses || !places)
            return;
        if (rule->use_count > 0) {
            memcpy(uses, rule->uses, rule->use_count * sizeof *uses);
            memcpy(places, rule->use_places, rule->use_count * sizeof *places);
        }
        rule->uses = uses;
        rule->use_places = places;
        rule->use_capacity = capacity;
    }
    rule->uses[rule->use_count] = expr->rule;
    rule->use_places[rule->use_count++] = expr;
}

void tn_check_expr_name(tn_check *check, tn_ast_expr *expr)
{
    if (expr->resolved)
        return;
    expr->resolved = true;
    if (!expr->rule) {
        size_t unit = check->unit;
        check->unit = expr->unit ? expr->unit - 1 : unit;
        const tn_checked_name *name = tn_check_name(check, expr->name, TN_WANT_RULE);
        check->unit = unit;
        expr->rule = name ? name->rule : NULL;
    }
    if (expr->rule)
        add_use(check, expr);
}

/* ---- parts of a neighbour */

static bool is_edge(const tn_ast_expr *expr)
{
    return expr->kind == TN_EXPR_BEGINNING || expr->kind == TN_EXPR_END;
}

static void report_edge(tn_check *check, const tn_ast_expr *edge)
{
    bool beginning = edge->kind == TN_EXPR_BEGINNING;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_MISPLACED_END, edge->node.span, "`%s` can only be the %s part of a neighbour",
                  beginning ? "beginning" : "end", beginning ? "first" : "last");
    tn_help(check->diagnostics, d,
            beginning ? "write `neighbour(beginning, tray(...))`" : "write `neighbour(tray(...), end)`");
}

/* `repeat(a, 0..3)` is `optional(repeat(a, 1..3))`. */
static void make_optional(tn_check *check, tn_ast_expr *repeat)
{
    tn_ast_expr *inner = TN_NEW(check->arena, tn_ast_expr);
    if (!inner)
        return;
    *inner = *repeat;
    inner->node.next = NULL;
    inner->least = 1;
    repeat->kind = TN_EXPR_OPTIONAL;
    repeat->parts = tn_ast_one(inner);
}

static void check_repeat(tn_check *check, tn_ast_expr *repeat)
{
    tn_check_expr(check, (tn_ast_expr *)repeat->parts.first);
    if (repeat->least > 0)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_MISPLACED_OPTIONAL, repeat->node.span,
                                 "what may be left out can only be a part of a neighbour");
    tn_help(check->diagnostics, d, "begin with 1, or write `neighbour(tray(...), repeat(..., 0..))`");
}

static void check_neighbour(tn_check *check, tn_ast_expr *neighbour)
{
    size_t trays = 0, optional = 0;
    for (TN_EACH(tn_ast_expr, part, neighbour->parts)) {
        if (part->kind == TN_EXPR_REPEAT && part->least == 0)
            make_optional(check, part);
        bool first = (tn_ast_node *)part == neighbour->parts.first, last = (tn_ast_node *)part == neighbour->parts.last;
        if (is_edge(part)) {
            if (part->kind == TN_EXPR_BEGINNING ? !first : !last)
                report_edge(check, part);
            continue;
        }
        trays++;
        optional += part->kind == TN_EXPR_OPTIONAL;
        tn_check_expr(check, part->kind == TN_EXPR_OPTIONAL ? (tn_ast_expr *)part->parts.first : part);
    }
    if (trays == 0) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_EMPTY_NEIGHBOUR, neighbour->node.span, "this neighbour asks for no tray");
        tn_help(check->diagnostics, d,
                "write what stands there: `neighbour(beginning, any, end)` is a plan of one tray");
    } else if (optional == trays) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_EMPTY_NEIGHBOUR, neighbour->node.span,
                                     "all parts of this neighbour are optional");
        tn_help(check->diagnostics, d, "one part at least has to be there: write it without `optional`");
    }
}

/* ---- sums */

bool tn_check_detail(tn_check *check, const tn_checked_field *field, const tn_ast_word *detail)
{
    if (!detail || (field->kind == TN_FIELD_ZONE && tn_word_is(detail, "depth")))
        return true;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_NOT_A_LENGTH, detail->node.span, "`%s` is too much here", detail->text);
    tn_help(check->diagnostics, d,
            field->kind == TN_FIELD_ZONE ? "of a zone only the `depth` can be added up"
                                         : "write the field's name alone");
    return false;
}

/* A sum of one field with a condition; other sums are comparisons (comparison.c). */
static void check_sum(tn_check *check, tn_ast_expr *sum)
{
    tn_sum_amount amount;
    if (tn_sums_areas(sum)) {
        tn_check_areas(check, sum);
        return;
    }
    sum->field = tn_field_find(check->schema, sum->name->text);
    bool lengths = tn_check_figure(check, check->schema, sum->figure, &amount);
    if (!sum->parts.first)
        sum->spec = tn_check_any(check, check->schema, sum->node.span);
    sum->condition_checked = lengths ? tn_check_condition(check, sum->condition, sum->field) : NULL;
    for (TN_EACH(tn_ast_expr, part, sum->parts))
        tn_check_expr(check, part);
}

/* Does it add up one field of the schema, as sums did before there was arithmetic? */
static bool is_field_sum(const tn_check *check, const tn_ast_expr *sum)
{
    const tn_checked_schema *schema = check->schema;
    bool number = sum->name && tn_schema_number(schema, sum->name->text);
    uint32_t field = sum->name ? tn_field_find(schema, sum->name->text) : TN_NONE;
    bool places = field != TN_NONE && schema->fields[field].ordered;
    return sum->figure->kind == TN_EXPR_FIGURE && !number && !places;
}

/* ---- expressions */

static void check_parts(tn_check *check, tn_ast_expr *expr)
{
    for (TN_EACH(tn_ast_expr, part, expr->parts))
        tn_check_expr(check, part);
}

static void check_leaf(tn_check *check, tn_ast_expr *expr)
{
    if (expr->kind == TN_EXPR_NAME)
        tn_check_expr_name(check, expr);
    else if (!check->schema)
        return;
    else if (expr->kind == TN_EXPR_TRAY) {
        if (tn_check_sums_of_tray(check, expr))
            return;
        tn_check_tests_of_numbers(check, expr);
        expr->spec = tn_check_spec(check, check->schema, expr->older, expr);
    } else
        expr->spec = tn_check_any(check, check->schema, expr->node.span);
}

uint32_t tn_check_field_named(tn_check *check, const tn_ast_word *name)
{
    const tn_checked_schema *schema = check->schema;
    uint32_t field = tn_field_find(schema, name->text);
    if (field != TN_NONE || schema->broken)
        return field;
    const char **names = TN_NEW_ARRAY(check->arena, const char *, schema->field_count + 1);
    tn_diagnostic *d = tn_report(check->diagnostics, E_UNKNOWN_WORD, name->node.span,
                                 "`%s` is not a field of schema `%s`", name->text, schema->name);
    tn_note(check->diagnostics, d, &schema->ast->name->node.span, "schema `%s` is here", schema->name);
    for (uint32_t f = 0; names && f < schema->field_count; f++)
        names[f] = schema->fields[f].name;
    const char *near = names ? tn_nearest(name->text, names, schema->field_count) : NULL;
    if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else if (schema->field_count > 0)
        tn_help(check->diagnostics, d, "name a field, such as `%s`", schema->fields[0].name);
    return TN_NONE;
}

static void check_mirrored(tn_check *check, const tn_ast_expr *mirrored)
{
    for (TN_EACH(const tn_ast_word, name, mirrored->names))
        if (check->schema)
            tn_check_field_named(check, name);
}

/* `210,000`: a comma directly between two digits. */
static bool follows_number(const tn_check *check, tn_span span)
{
    const char *text = check->diagnostics->sources->files[span.file].text;
    return span.begin >= 2 && text[span.begin - 1] == ',' && isdigit((unsigned char)text[span.begin - 2]);
}

static void report_number(tn_check *check, const tn_ast_expr *expr)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_RULE_OR_NUMBER, expr->node.span,
                                 "a rule has to stand here, and this is a number");
    if (expr->kind == TN_EXPR_NUMBER && follows_number(check, expr->node.span))
        tn_help(check->diagnostics, d, "a number is written without marks between its digits: `1200`");
    else if (expr->kind == TN_EXPR_NUMBER)
        tn_help(check->diagnostics, d,
                "each side of `and` and `or` compares: `quantity(a) = 2 or quantity(a) = 3`, or `quantity(a) in 2..3`");
    else
        tn_help(check->diagnostics, d, "compare it with another number: `quantity(tray(...)) > 1`");
}

/* Recursion is as deep as expressions nest: at most TN_NESTING_MAX. */
void tn_check_expr(tn_check *check, tn_ast_expr *expr)
{
    if (expr->kind == TN_EXPR_NAME)
        tn_check_expr_name(check, expr);
    if (tn_is_sum(expr)) {
        report_number(check, expr);
        return;
    }
    tn_check_expr_known(check, expr);
}

/* What a value of a param leaves out: nothing is warned of. */
static void check_idle(tn_check *check, const tn_ast_expr *expr)
{
    bool quiet = check->quiet;
    check->quiet = true;
    for (TN_EACH(tn_ast_expr, part, expr->idle))
        tn_check_expr(check, part);
    check->quiet = quiet;
}

void tn_check_expr_known(tn_check *check, tn_ast_expr *expr)
{
    check_idle(check, expr);
    switch (expr->kind) {
    case TN_EXPR_TRAY:
    case TN_EXPR_ANY:
    case TN_EXPR_NAME:
    case TN_EXPR_TRUE:
    case TN_EXPR_FALSE:
        check_leaf(check, expr);
        break;
    case TN_EXPR_COMPARE:
    case TN_EXPR_WITHIN:
    case TN_EXPR_REMAINDER:
        for (TN_EACH(tn_ast_expr, part, expr->parts))
            tn_check_sum_expr(check, part);
        break;
    case TN_EXPR_MIRRORED:
        check_mirrored(check, expr);
        break;
    case TN_EXPR_REPEAT:
        check_repeat(check, expr);
        break;
    case TN_EXPR_PLAN:
        if (check->schema)
            expr->spec = tn_check_any(check, check->schema, expr->node.span);
        for (TN_EACH(tn_ast_expr, part, expr->parts))
            tn_check_expr_known(check, part->kind == TN_EXPR_OPTIONAL ? (tn_ast_expr *)part->parts.first : part);
        break;
    case TN_EXPR_EVERY:
        if (check->schema)
            expr->spec = tn_check_any(check, check->schema, expr->node.span);
        check_parts(check, expr);
        break;
    case TN_EXPR_BEGINNING:
    case TN_EXPR_END:
        report_edge(check, expr);
        break;
    case TN_EXPR_NEIGHBOUR:
        check_neighbour(check, expr);
        break;
    case TN_EXPR_OPTIONAL: {
        tn_diagnostic *d = tn_report(check->diagnostics, E_MISPLACED_OPTIONAL, expr->node.span,
                                     "`optional` can only be a part of a neighbour");
        tn_help(check->diagnostics, d, "write `neighbour(tray(...), optional(...), tray(...))`");
        check_parts(check, expr);
        break;
    }
    case TN_EXPR_SUM:
        if (!check->schema)
            check_parts(check, expr);
        else if (is_field_sum(check, expr) && expr->region == TN_AST_STRETCH)
            check_sum(check, expr);
        else
            tn_check_sum_condition(check, expr);
        break;
    case TN_EXPR_QUANTITY:
    case TN_EXPR_OCCURRENCES:
        if (expr->region != TN_AST_STRETCH) {
            tn_check_sum_condition(check, expr);
            break;
        }
        check_parts(check, expr);
        expr->condition_checked = tn_check_count(check, expr);
        break;
    case TN_EXPR_NEAR:
    case TN_EXPR_EVERY_NEAR:
        tn_check_near(check, expr);
        break;
    case TN_EXPR_AND:
    case TN_EXPR_OR:
    case TN_EXPR_NOT:
    case TN_EXPR_SYMMETRIC:
    case TN_EXPR_MANY:
    case TN_EXPR_DISTANCE:
    case TN_EXPR_IMPLIES:
    case TN_EXPR_WHERE:
        check_parts(check, expr);
        break;
    case TN_EXPR_CELL:
    case TN_EXPR_ROOM:
    case TN_EXPR_SECTION:
    case TN_EXPR_TOUCH:
    case TN_EXPR_APART:
        tn_check_ask(check, expr);
        break;
    default: /* already reported, or written out before */
        break;
    }
}

/* ---- what needs the named rules */

/* The expression that is meant, through names; NULL where it is not known because of errors already reported. */
static const tn_ast_expr *meaning(const tn_ast_expr *expr)
{
    if (expr->kind == TN_EXPR_NAME)
        expr = expr->rule ? expr->rule->meaning : NULL;
    return expr && expr->kind != TN_EXPR_BROKEN ? expr : NULL;
}

static void check_same_schema(tn_check *check, const tn_ast_expr *name)
{
    if (!name->rule || !name->rule->schema || !check->schema || name->rule->schema == check->schema)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_OTHER_SCHEMA, name->node.span,
                                 "`%s` is a rule for schema `%s`, and this is for `%s`", name->rule->name,
                                 name->rule->schema->name, check->schema->name);
    tn_note(check->diagnostics, d, &name->rule->ast->name->node.span, "`%s` is here", name->rule->name);
    tn_help(check->diagnostics, d,
            "use rules of one schema together; `using %s` after the name says which schema counts",
            name->rule->schema->name);
}

static void check_same(tn_check *check, const tn_ast_expr *name)
{
    check_same_schema(check, name);
    tn_check_same_form(check, name);
}

static void note_name(tn_check *check, tn_diagnostic *d, const tn_ast_expr *expr)
{
    if (expr->kind == TN_EXPR_NAME)
        tn_note(check->diagnostics, d, &expr->rule->ast->name->node.span, "`%s` is here", expr->rule->name);
}

static void check_symmetric(tn_check *check, const tn_ast_expr *symmetric)
{
    const tn_ast_expr *part = (const tn_ast_expr *)symmetric->parts.first;
    const tn_ast_expr *meant = meaning(part);
    if (!meant || meant->kind == TN_EXPR_NEIGHBOUR || meant->kind == TN_EXPR_OCCURRENCES)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_SYMMETRIC_OF, part->node.span,
                                 "`symmetric` is for a neighbour, and this is not one");
    note_name(check, d, part);
    tn_help(check->diagnostics, d,
            "write `symmetric neighbour(...)`, or leave `symmetric` out: only an order can be mirrored");
}

/* Is it decided by numbers alone? */
static bool is_counting(const tn_ast_expr *expr)
{
    const tn_ast_expr *meant = meaning(expr);
    if (!meant)
        return true;
    bool joined = meant->kind == TN_EXPR_AND || meant->kind == TN_EXPR_OR || meant->kind == TN_EXPR_NOT;
    for (TN_EACH(const tn_ast_expr, part, meant->parts))
        joined = joined && meant->from_sum;
    return joined || meant->kind == TN_EXPR_QUANTITY || meant->kind == TN_EXPR_REMAINDER ||
           meant->kind == TN_EXPR_SUM || meant->kind == TN_EXPR_OCCURRENCES || meant->kind == TN_EXPR_COMPARE ||
           meant->kind == TN_EXPR_WITHIN;
}

static void check_distance(tn_check *check, const tn_ast_expr *distance)
{
    const tn_ast_expr *by = (const tn_ast_expr *)distance->parts.last;
    const tn_ast_expr *meant = meaning(by);
    if (!meant || is_counting(meant))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_DISTANCE_BY, by->node.span,
                                 "what a distance is measured by has to be a number");
    note_name(check, d, by);
    tn_help(check->diagnostics, d, "write `by quantity(..., n >= 2)` or `by sum(..., w > 12')`");
}

static void check_idle_meaning(tn_check *check, const tn_ast_expr *expr)
{
    bool quiet = check->quiet;
    check->quiet = true;
    for (TN_EACH(tn_ast_expr, part, expr->idle))
        tn_check_meaning(check, part);
    check->quiet = quiet;
}

void tn_check_meaning(tn_check *check, tn_ast_expr *expr)
{
    check_idle_meaning(check, expr);
    if (expr->kind == TN_EXPR_NAME)
        check_same(check, expr);
    else if (expr->kind == TN_EXPR_SYMMETRIC)
        check_symmetric(check, expr);
    else if (expr->kind == TN_EXPR_DISTANCE)
        check_distance(check, expr);
    for (TN_EACH(tn_ast_expr, test, expr->tests))
        tn_check_meaning(check, test);
    for (TN_EACH(tn_ast_expr, part, expr->parts))
        tn_check_meaning(check, part);
    if (expr->kind == TN_EXPR_COMPARE || expr->kind == TN_EXPR_WITHIN)
        tn_check_comparison(check, expr);
    else if (expr->kind == TN_EXPR_REMAINDER)
        tn_check_remainder(check, expr);
}

/* ---- sizes */

/* min_trays of all parts: their sum in a neighbour, the greatest of an `and`, the least of an `or`. */
static uint32_t min_of_parts(const tn_ast_expr *expr)
{
    uint32_t sum = 0, least = TN_NONE, greatest = 0;
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        uint32_t trays = tn_min_trays(part);
        sum = sum + trays < sum ? TN_NONE : sum + trays;
        least = trays < least ? trays : least;
        greatest = trays > greatest ? trays : greatest;
    }
    return expr->kind == TN_EXPR_NEIGHBOUR || expr->kind == TN_EXPR_PLAN ? sum
           : expr->kind == TN_EXPR_OR                                    ? least
                                                                         : greatest;
}

uint32_t tn_min_trays(const tn_ast_expr *expr)
{
    switch (expr->kind) {
    case TN_EXPR_NAME:
        return expr->rule ? expr->rule->min_trays : 1;
    case TN_EXPR_OPTIONAL:
    case TN_EXPR_BEGINNING:
    case TN_EXPR_END:
        return 0;
    case TN_EXPR_NEIGHBOUR:
    case TN_EXPR_PLAN:
    case TN_EXPR_AND:
    case TN_EXPR_OR:
        return min_of_parts(expr);
    case TN_EXPR_REPEAT: {
        uint64_t trays = (uint64_t)expr->least * tn_min_trays((const tn_ast_expr *)expr->parts.first);
        return trays < TN_NONE ? (uint32_t)trays : TN_NONE;
    }
    case TN_EXPR_SYMMETRIC:
    case TN_EXPR_DISTANCE:
    case TN_EXPR_NEAR:
    case TN_EXPR_WHERE:
        return tn_min_trays((const tn_ast_expr *)expr->parts.first);
    default:
        return 1;
    }
}

/* ---- numbers that stand only in some places: what speaks of the whole plan (comparisons with `matches`, or of numbers
 * of houses) where the plan is meant, and what lies before or behind a stretch where a `where` says of which */

static const tn_ast_expr *comparison_in(const tn_ast_expr *expr);

/* Rules may be in a circle: each is looked through once on the way. */
static const tn_ast_expr *comparison_of(tn_checked_rule *rule)
{
    if (!rule || !rule->about_plan || rule->looked)
        return NULL;
    rule->looked = true;
    const tn_ast_expr *found = comparison_in(rule->ast->body);
    rule->looked = false;
    return found;
}

static const tn_ast_expr *comparison_in(const tn_ast_expr *expr)
{
    if (expr->whole)
        return expr;
    if (expr->kind == TN_EXPR_NAME)
        return comparison_of(expr->rule);
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        const tn_ast_expr *found = comparison_in(part);
        if (found)
            return found;
    }
    return NULL;
}

static void report_whole(tn_check *check, const tn_ast_expr *expr)
{
    const tn_ast_expr *comparison = comparison_in(expr);
    bool houses =
        comparison && comparison->sum && (comparison->sum->houses || (comparison->high && comparison->high->houses));
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_WHOLE_PLAN, expr->node.span,
                  "this is about the whole %s, and stands where a part of it is meant", houses ? "house" : "plan");
    if (comparison && comparison != expr)
        tn_note(check->diagnostics, d, &comparison->node.span, "because of this comparison, which %s",
                houses ? "adds up over the house" : "has `matches` in it");
    if (houses)
        tn_help(check->diagnostics, d,
                "about a part of it write a condition, such as `quantity(cell(...), n > 1)`; or join this to other "
                "rules by `and`, `or`, `not` and `implies` only");
    else
        tn_help(check->diagnostics, d, "join it to other rules by `and`, `or`, `not` and `implies` only");
}

/* level: is the plan as a whole meant? */
static bool walk_whole(tn_check *check, const tn_ast_expr *expr, bool level)
{
    bool whole =
        expr->whole || (expr->kind == TN_EXPR_NAME && expr->rule && !expr->rule->is_measure && expr->rule->about_plan);
    if (whole && !level)
        report_whole(check, expr);
    bool plan = expr->kind == TN_EXPR_MATCHES;
    bool through = level && (expr->kind == TN_EXPR_AND || expr->kind == TN_EXPR_OR || expr->kind == TN_EXPR_NOT ||
                             expr->kind == TN_EXPR_IMPLIES);
    for (TN_EACH(const tn_ast_expr, part, expr->idle)) /* what a value of a param leaves out stands here, too */
        walk_whole(check, part, level);
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        bool inside = walk_whole(check, part, plan || through);
        whole = whole || (inside && !plan);
    }
    return whole;
}

bool tn_check_whole(tn_check *check, const tn_ast_expr *expr)
{
    return walk_whole(check, expr, true);
}

static void report_around(tn_check *check, const tn_ast_expr *expr)
{
    const char *word = expr->region == TN_AST_BEFORE ? "before" : "after";
    tn_diagnostic *d = tn_report(check->diagnostics, E_AROUND_WHAT, expr->node.span,
                                 "this counts what lies %s a stretch, and it is not said which", word);
    tn_help(check->diagnostics, d,
            "say it behind `where`, joined by `and`, `or`, `not` and `implies` only: `tray(...) where quantity(any %s) "
            "= 2`",
            word);
}

/* Is the expression, if a `where` reaches it, still about the same stretch with all that is in it? */
static bool goes_through(tn_expr_kind kind)
{
    bool joined = kind == TN_EXPR_AND || kind == TN_EXPR_OR || kind == TN_EXPR_NOT || kind == TN_EXPR_IMPLIES;
    return joined || tn_compares_numbers(kind) || tn_is_arithmetic(kind);
}

static void walk_around(tn_check *check, const tn_ast_expr *expr, bool reached)
{
    if (expr->region != TN_AST_STRETCH && !reached)
        report_around(check, expr);
    for (TN_EACH(const tn_ast_expr, part, expr->idle)) /* what a value of a param leaves out stands here, too */
        walk_around(check, part, reached);
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        bool second = expr->kind == TN_EXPR_WHERE && (const tn_ast_node *)part != expr->parts.first;
        walk_around(check, part, second || (reached && goes_through(expr->kind)));
    }
}

void tn_check_around(tn_check *check, const tn_ast_expr *expr)
{
    walk_around(check, expr, false);
}
