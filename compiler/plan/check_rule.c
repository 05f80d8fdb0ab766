/* Rule expressions: what may stand where, and what names mean. */
#include <string.h>

#include "compiler/plan/check.h"
#include "runtime/base/nearest.h"

/* ---- names */

static void add_use(tn_check *check, tn_ast_expr *expr)
{
    tn_checked_rule *rule = check->rule;
    if (!rule)
        return;
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

static void check_rule_name(tn_check *check, tn_ast_expr *expr)
{
    const tn_checked_name *name = tn_check_name(check, expr->name, TN_WANT_RULE);
    if (!name)
        return;
    expr->rule = name->rule;
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

static void check_neighbour(tn_check *check, tn_ast_expr *neighbour)
{
    size_t trays = 0, optional = 0;
    for (TN_EACH(tn_ast_expr, part, neighbour->parts)) {
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

/* The field that was likely meant, or all that could be. */
static void help_length_field(tn_check *check, tn_diagnostic *d, const char *word)
{
    const char *names[TN_FIELDS_MAX];
    size_t count = 0;
    char list[300] = "";
    for (uint32_t f = 0; f < check->schema->field_count; f++) {
        const tn_checked_field *field = &check->schema->fields[f];
        if (field->kind != TN_FIELD_LENGTH && field->kind != TN_FIELD_ZONE)
            continue;
        size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", count == 0 ? "" : ", ", field->name);
        names[count++] = field->name;
    }
    const char *near = tn_nearest(word, names, count);
    if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else
        tn_help(check->diagnostics, d, "the fields that have lengths are %s", list);
}

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

static void check_sum(tn_check *check, tn_ast_expr *sum)
{
    const tn_checked_schema *schema = check->schema;
    const tn_ast_word *name = sum->name;
    sum->field = tn_field_find(schema, name->text);
    const tn_checked_field *field = sum->field == TN_NONE ? NULL : &schema->fields[sum->field];
    bool lengths = field && (field->kind == TN_FIELD_LENGTH || field->kind == TN_FIELD_ZONE);
    if (!lengths && !schema->broken && !name->broken) {
        tn_diagnostic *d = field ? tn_report(check->diagnostics, E_NOT_A_LENGTH, name->node.span,
                                             "`%s` has no lengths to add up", name->text)
                                 : tn_report(check->diagnostics, E_NOT_A_LENGTH, name->node.span,
                                             "there is no field `%s` to add up", name->text);
        tn_note(check->diagnostics, d, &schema->ast->name->node.span, "schema `%s` is here", schema->name);
        if (field)
            tn_help(check->diagnostics, d,
                    "fields of lengths and the depths of zones can be added up; to count trays write "
                    "`quantity(tray(%s ...), n > 1)`",
                    name->text);
        else
            help_length_field(check, d, name->text);
    }
    lengths = lengths && tn_check_detail(check, field, sum->detail);
    if (!sum->parts.first)
        sum->spec = tn_check_any(check, check->schema, sum->node.span);
    sum->condition_checked = lengths ? tn_check_condition(check, sum->condition, sum->field) : NULL;
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
        check_rule_name(check, expr);
    else if (!check->schema)
        return;
    else if (expr->kind == TN_EXPR_TRAY)
        expr->spec = tn_check_spec(check, check->schema, expr);
    else if (expr->kind == TN_EXPR_ANY)
        expr->spec = tn_check_any(check, check->schema, expr->node.span);
}

/* Recursion is as deep as expressions nest: at most TN_NESTING_MAX. */
void tn_check_expr(tn_check *check, tn_ast_expr *expr)
{
    switch (expr->kind) {
    case TN_EXPR_TRAY:
    case TN_EXPR_ANY:
    case TN_EXPR_NAME:
        check_leaf(check, expr);
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
        if (check->schema)
            check_sum(check, expr);
        check_parts(check, expr);
        break;
    case TN_EXPR_QUANTITY:
    case TN_EXPR_OCCURRENCES:
        expr->condition_checked = tn_check_condition(check, expr->condition, TN_NONE);
        check_parts(check, expr);
        break;
    case TN_EXPR_AND:
    case TN_EXPR_OR:
    case TN_EXPR_NOT:
    case TN_EXPR_SYMMETRIC:
    case TN_EXPR_MANY:
    case TN_EXPR_DISTANCE:
        check_parts(check, expr);
        break;
    case TN_EXPR_CELL: /* of forms: the grammar has them nowhere else */
    case TN_EXPR_SECTION:
    case TN_EXPR_BROKEN:
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
                                 "`symmetric` is for a neighbour, and this is none");
    note_name(check, d, part);
    tn_help(check->diagnostics, d,
            "write `symmetric neighbour(...)`, or leave `symmetric` out: only an order can be mirrored");
}

static void check_distance(tn_check *check, const tn_ast_expr *distance)
{
    const tn_ast_expr *by = (const tn_ast_expr *)distance->parts.last;
    const tn_ast_expr *meant = meaning(by);
    if (!meant || meant->kind == TN_EXPR_QUANTITY || meant->kind == TN_EXPR_SUM || meant->kind == TN_EXPR_OCCURRENCES)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_DISTANCE_BY, by->node.span,
                                 "what a distance is measured by has to be a number");
    note_name(check, d, by);
    tn_help(check->diagnostics, d, "write `by quantity(..., n >= 2)` or `by sum(..., w > 12')`");
}

void tn_check_meaning(tn_check *check, tn_ast_expr *expr)
{
    if (expr->kind == TN_EXPR_NAME)
        check_same_schema(check, expr);
    else if (expr->kind == TN_EXPR_SYMMETRIC)
        check_symmetric(check, expr);
    else if (expr->kind == TN_EXPR_DISTANCE)
        check_distance(check, expr);
    for (TN_EACH(tn_ast_expr, part, expr->parts))
        tn_check_meaning(check, part);
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
    return expr->kind == TN_EXPR_NEIGHBOUR ? sum : expr->kind == TN_EXPR_OR ? least : greatest;
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
    case TN_EXPR_AND:
    case TN_EXPR_OR:
        return min_of_parts(expr);
    case TN_EXPR_SYMMETRIC:
    case TN_EXPR_DISTANCE:
        return tn_min_trays((const tn_ast_expr *)expr->parts.first);
    default:
        return 1;
    }
}
