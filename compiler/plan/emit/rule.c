/* Rules, straight from the equations of docs/plan-language.md.
 *
 * A name is a call, never written out: thirty doublings stay thirty functions. Recursion here is as deep as expressions
 * nest, at most TN_NESTING_MAX.
 */
#include <stdio.h>

#include "compiler/plan/emit/emit.h"

uint32_t tn_emit_condition(tn_emit *emit, tn_checked_condition *condition)
{
    if (condition->function > 0)
        return condition->function - 1;
    tn_emit_begin(emit, 0);
    for (size_t i = 0; i < condition->count; i++)
        tn_emit_op(emit, condition->steps[i].span, condition->steps[i].opcode, condition->steps[i].first,
                   condition->steps[i].second);
    tn_emit_op(emit, condition->span, TN_OP_ANSWER, 0, 0);
    condition->function = tn_emit_end(emit, NULL, TN_FUNCTION_CONDITION) + 1;
    return condition->function - 1;
}

static const tn_ast_expr *first_part(const tn_ast_expr *expr)
{
    return (const tn_ast_expr *)expr->parts.first;
}

static uint32_t condition_of(const tn_ast_expr *expr)
{
    return expr->condition_checked->function - 1;
}

/* ---- M: the stretch taken whole */

/* What makes the neighbour of its parts has the neighbour's own place, so that explaining it can name it. */
static void emit_neighbour(tn_emit *emit, const tn_ast_expr *neighbour)
{
    tn_span span = neighbour->node.span;
    bool beginning = neighbour->kind == TN_EXPR_PLAN, end = beginning, chained = false;
    for (TN_EACH(const tn_ast_expr, part, neighbour->parts)) {
        beginning = beginning || part->kind == TN_EXPR_BEGINNING;
        end = end || part->kind == TN_EXPR_END;
        if (part->kind == TN_EXPR_BEGINNING || part->kind == TN_EXPR_END)
            continue;
        bool optional = part->kind == TN_EXPR_OPTIONAL;
        tn_emit_whole(emit, optional ? first_part(part) : part);
        tn_emit_op(emit, span, TN_OP_NONEMPTY, 0, 0);
        if (optional)
            tn_emit_op(emit, span, TN_OP_OPTIONAL, 0, 0);
        if (chained)
            tn_emit_op(emit, span, TN_OP_CHAIN, 0, 0);
        chained = true;
    }
    if (beginning)
        tn_emit_op(emit, span, TN_OP_BEGINNING, 0, 0);
    if (end)
        tn_emit_op(emit, span, TN_OP_END, 0, 0);
}

/* All parts by `emit_part`, joined. */
static void emit_joined(tn_emit *emit, const tn_ast_expr *expr, void (*emit_part)(tn_emit *, const tn_ast_expr *))
{
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        emit_part(emit, part);
        if ((const tn_ast_node *)part != expr->parts.first)
            tn_emit_op(emit, expr->node.span, expr->kind == TN_EXPR_AND ? TN_OP_AND : TN_OP_OR, 0, 0);
    }
}

/* What a symmetric mirrors: the function that tn_emit_needs made, or that of the rule it names. */
static uint32_t mirrored(const tn_ast_expr *symmetric)
{
    const tn_ast_expr *part = first_part(symmetric);
    return part->kind == TN_EXPR_NAME ? part->rule->whole : symmetric->function - 1;
}

static void emit_sum(tn_emit *emit, const tn_ast_expr *sum)
{
    const tn_ast_expr *part = first_part(sum);
    if (part)
        tn_emit_whole(emit, part);
    else
        tn_emit_op(emit, sum->node.span, TN_OP_TRAY, tn_emit_spec(emit, sum->spec), 0);
    uint32_t field = emit->checked->schemas[emit->schema]->field_first + sum->field;
    tn_emit_op(emit, sum->node.span, TN_OP_SUM, field, condition_of(sum));
}

/* What the code joins by OR or CHAIN, and no author by `or` or `neighbour`, is derived in one way. */
static void emit_once(tn_emit *emit, tn_span span)
{
    if (emit->derives)
        tn_emit_op(emit, span, TN_OP_ONCE, 0, 0);
}

/* `a implies b` is `not a or b`. */
static void emit_implies(tn_emit *emit, const tn_ast_expr *expr, void (*emit_part)(tn_emit *, const tn_ast_expr *))
{
    tn_emit_holds(emit, first_part(expr));
    tn_emit_op(emit, expr->node.span, TN_OP_NOT, 0, 0);
    emit_part(emit, (const tn_ast_expr *)expr->parts.last);
    tn_emit_op(emit, expr->node.span, TN_OP_OR, 0, 0);
    if (emit_part == tn_emit_whole)
        emit_once(emit, expr->node.span);
}

/* No single tray is `a` and not `b`. */
static void emit_every(tn_emit *emit, const tn_ast_expr *expr)
{
    tn_span span = expr->node.span;
    tn_emit_op(emit, span, TN_OP_TRAY, tn_emit_spec(emit, expr->spec), 0);
    tn_emit_whole(emit, first_part(expr));
    tn_emit_op(emit, span, TN_OP_AND, 0, 0);
    tn_emit_whole(emit, (const tn_ast_expr *)expr->parts.last);
    tn_emit_op(emit, span, TN_OP_NOT, 0, 0);
    tn_emit_op(emit, span, TN_OP_AND, 0, 0);
    tn_emit_op(emit, span, TN_OP_SOMEWHERE, 0, 0);
    tn_emit_op(emit, span, TN_OP_NOT, 0, 0);
}

/* Of several fields: each of them. */
static void emit_mirrored(tn_emit *emit, const tn_ast_expr *expr)
{
    const tn_checked_schema *schema = emit->checked->schemas[emit->schema];
    for (TN_EACH(const tn_ast_word, name, expr->names)) {
        uint32_t field = schema->field_first + tn_field_find(schema, name->text);
        tn_emit_op(emit, expr->node.span, TN_OP_MIRRORED, field, 0);
        if ((const tn_ast_node *)name != expr->names.first)
            tn_emit_op(emit, expr->node.span, TN_OP_AND, 0, 0);
    }
}

/* Source, destination, and the rule of the gap. `every` denies that one lies otherwise: for it, the rule of the gap is
 * what a gap must not be, and so what is asked of one destination is denied of all, and the other way round. */
static void emit_near(tn_emit *emit, const tn_ast_expr *expr)
{
    tn_span span = expr->node.span;
    bool every = expr->kind == TN_EXPR_EVERY_NEAR, all = (expr->near == TN_NEAR_APART) != every;
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        tn_emit_whole(emit, part);
    tn_emit_op(emit, span, all ? TN_OP_FAR : TN_OP_NEAR, 0, 0);
    if (!every)
        return;
    tn_emit_op(emit, span, TN_OP_SOMEWHERE, 0, 0);
    tn_emit_op(emit, span, TN_OP_NOT, 0, 0);
}

void tn_emit_whole(tn_emit *emit, const tn_ast_expr *expr)
{
    tn_span span = expr->node.span;
    switch (expr->kind) {
    case TN_EXPR_TRAY:
    case TN_EXPR_ANY:
        tn_emit_op(emit, span, TN_OP_TRAY, tn_emit_spec(emit, expr->spec), 0);
        for (TN_EACH(const tn_ast_expr, test, expr->tests)) {
            tn_emit_whole(emit, test);
            tn_emit_op(emit, span, TN_OP_AND, 0, 0);
        }
        break;
    case TN_EXPR_TRUE:
    case TN_EXPR_FALSE:
        tn_emit_op(emit, span, TN_OP_TRAY, tn_emit_spec(emit, expr->spec), 0);
        tn_emit_op(emit, span, TN_OP_NOT, 0, 0);
        tn_emit_op(emit, span, TN_OP_TRAY, tn_emit_spec(emit, expr->spec), 0);
        tn_emit_op(emit, span, expr->kind == TN_EXPR_TRUE ? TN_OP_OR : TN_OP_AND, 0, 0);
        break;
    case TN_EXPR_IMPLIES:
        emit_implies(emit, expr, tn_emit_whole);
        break;
    case TN_EXPR_EVERY:
        emit_every(emit, expr);
        break;
    case TN_EXPR_COMPARE:
        if (expr->over)
            tn_emit_quotient(emit, expr);
        else
            tn_emit_comparison(emit, span, expr->sum, expr->op);
        break;
    case TN_EXPR_WITHIN:
        if (expr->over) {
            tn_emit_quotient(emit, expr);
            break;
        }
        tn_emit_comparison(emit, span, expr->sum, TN_AT_LEAST);
        tn_emit_comparison(emit, span, expr->high, TN_AT_MOST);
        tn_emit_op(emit, span, TN_OP_AND, 0, 0);
        break;
    case TN_EXPR_REMAINDER:
        tn_emit_remainder(emit, expr);
        break;
    case TN_EXPR_WHERE:
        tn_emit_whole(emit, first_part(expr));
        tn_emit_whole(emit, (const tn_ast_expr *)expr->parts.last);
        tn_emit_op(emit, span, TN_OP_WHERE, 0, 0);
        break;
    case TN_EXPR_MIRRORED:
        emit_mirrored(emit, expr);
        break;
    case TN_EXPR_NAME:
        tn_emit_op(emit, span, expr->again && emit->in_circle ? TN_OP_AGAIN : TN_OP_CALL, expr->rule->whole, 0);
        break;
    case TN_EXPR_AND:
    case TN_EXPR_OR:
        emit_joined(emit, expr, tn_emit_whole);
        break;
    case TN_EXPR_NOT:
        tn_emit_holds(emit, first_part(expr));
        tn_emit_op(emit, span, TN_OP_NOT, 0, 0);
        break;
    case TN_EXPR_NEIGHBOUR:
        emit_neighbour(emit, expr);
        break;
    case TN_EXPR_PLAN:
        emit_neighbour(emit, expr);
        emit_once(emit, span);
        break;
    case TN_EXPR_SYMMETRIC:
        if (expr->sides != TN_SIDES_MIRRORED)
            tn_emit_op(emit, first_part(expr)->node.span, TN_OP_CALL, mirrored(expr), 0);
        if (expr->sides != TN_SIDES_WRITTEN)
            tn_emit_op(emit, span, TN_OP_MIRROR, mirrored(expr), 0);
        if (expr->sides == TN_SIDES_BOTH)
            tn_emit_op(emit, span, TN_OP_OR, 0, 0);
        break;
    case TN_EXPR_CELL:
    case TN_EXPR_ROOM:
    case TN_EXPR_SECTION:
    case TN_EXPR_TOUCH:
    case TN_EXPR_APART:
        tn_emit_ask(emit, expr);
        break;
    case TN_EXPR_QUANTITY:
    case TN_EXPR_OCCURRENCES:
        if (tn_emit_quantity(emit, expr))
            break;
        tn_emit_whole(emit, first_part(expr));
        tn_emit_op(emit, span, expr->kind == TN_EXPR_QUANTITY ? TN_OP_QUANTITY : TN_OP_OCCURRENCES, condition_of(expr),
                   0);
        break;
    case TN_EXPR_SUM:
        if (expr->ask)
            tn_emit_ask(emit, expr);
        else
            emit_sum(emit, expr);
        break;
    case TN_EXPR_MANY:
        tn_emit_whole(emit, first_part(expr));
        tn_emit_op(emit, span, TN_OP_MANY, 0, 0);
        break;
    case TN_EXPR_REPEAT:
        tn_emit_whole(emit, first_part(expr));
        tn_emit_op(emit, span, TN_OP_REPEATED, expr->least, expr->most);
        break;
    case TN_EXPR_NEAR:
    case TN_EXPR_EVERY_NEAR:
        emit_near(emit, expr);
        break;
    case TN_EXPR_DISTANCE:
        for (TN_EACH(const tn_ast_expr, part, expr->parts))
            tn_emit_whole(emit, part);
        tn_emit_op(emit, span, TN_OP_DISTANCE, 0, 0);
        break;
    default:
        break; /* checking has seen to it that they do not come here */
    }
}

/* ---- H: somewhere in the region */

/* Are M and H the same: does it say something of the stretch as a whole? */
static bool holds_is_whole(tn_expr_kind kind)
{
    switch (kind) {
    case TN_EXPR_QUANTITY:
    case TN_EXPR_SUM:
    case TN_EXPR_OCCURRENCES:
    case TN_EXPR_COMPARE:
    case TN_EXPR_WITHIN:
    case TN_EXPR_REMAINDER:
    case TN_EXPR_MIRRORED:
    case TN_EXPR_EVERY:
    case TN_EXPR_EVERY_NEAR:
    case TN_EXPR_PLAN:
    case TN_EXPR_TRUE:
    case TN_EXPR_FALSE:
        return true;
    default:
        return false;
    }
}

void tn_emit_holds(tn_emit *emit, const tn_ast_expr *expr)
{
    switch (expr->kind) {
    case TN_EXPR_NAME:
        tn_emit_op(emit, expr->node.span, TN_OP_CALL, expr->rule->holds, 0);
        break;
    case TN_EXPR_AND:
    case TN_EXPR_OR:
        emit_joined(emit, expr, tn_emit_holds);
        break;
    case TN_EXPR_NOT:
        tn_emit_holds(emit, first_part(expr));
        tn_emit_op(emit, expr->node.span, TN_OP_NOT, 0, 0);
        break;
    case TN_EXPR_IMPLIES:
        emit_implies(emit, expr, tn_emit_holds);
        break;
    default:
        tn_emit_whole(emit, expr);
        if (!holds_is_whole(expr->kind))
            tn_emit_op(emit, expr->node.span, TN_OP_SOMEWHERE, 0, 0);
        break;
    }
}

/* ---- functions */

void tn_emit_needs(tn_emit *emit, tn_ast_expr *expr, const char *name)
{
    for (TN_EACH(tn_ast_expr, part, expr->parts))
        tn_emit_needs(emit, part, name);
    for (TN_EACH(tn_ast_expr, test, expr->tests))
        tn_emit_needs(emit, test, name);
    if (expr->condition_checked)
        tn_emit_condition(emit, expr->condition_checked);
    tn_emit_ask_needs(emit, expr);
    tn_emit_sum_needs(emit, expr->sum, name);
    tn_emit_sum_needs(emit, expr->high, name);
    tn_emit_sum_needs(emit, expr->over, name);
    if (expr->kind != TN_EXPR_SYMMETRIC || first_part(expr)->kind == TN_EXPR_NAME)
        return;
    char label[TN_NAME_MAX + 1];
    static const char suffix[] = " (symmetric)";
    snprintf(label, sizeof label, "%.*s%s", (int)(TN_NAME_MAX - sizeof suffix), name, suffix);
    tn_emit_begin(emit, emit->schema);
    tn_emit_whole(emit, first_part(expr));
    tn_emit_op(emit, first_part(expr)->node.span, TN_OP_RETURN, 0, 0);
    expr->function = tn_emit_end(emit, label, TN_FUNCTION_WHOLE) + 1;
}

/* The judgement H of a whole rule: where it is "M somewhere", by a call of the function of M. */
static void emit_rule_holds(tn_emit *emit, const tn_checked_rule *rule)
{
    const tn_ast_expr *body = rule->ast->body;
    bool joined = body->kind == TN_EXPR_AND || body->kind == TN_EXPR_OR || body->kind == TN_EXPR_NOT ||
                  body->kind == TN_EXPR_NAME || body->kind == TN_EXPR_IMPLIES;
    if (joined) {
        tn_emit_holds(emit, body);
        return;
    }
    tn_emit_op(emit, body->node.span, TN_OP_CALL, rule->whole, 0);
    if (!holds_is_whole(body->kind))
        tn_emit_op(emit, body->node.span, TN_OP_SOMEWHERE, 0, 0);
}

static void emit_rule_whole(tn_emit *emit, tn_checked_rule *rule)
{
    tn_ast_expr *body = rule->ast->body;
    tn_emit_begin(emit, rule->schema->index);
    emit->in_circle = rule->circle != NULL;
    tn_emit_whole(emit, body);
    emit->in_circle = false;
    tn_emit_op(emit, body->node.span, TN_OP_RETURN, 0, 0);
    rule->whole = tn_emit_end(emit, rule->name, rule->circle ? TN_FUNCTION_CIRCLE : TN_FUNCTION_WHOLE);
}

/* Is a rule of the same circle, whose judgement H is asked as it is, still to be emitted? */
static bool waits(const tn_ast_expr *expr)
{
    bool waiting = expr->again && expr->rule->holds == 0; /* the circle's functions of M have the lower numbers */
    if (expr->kind == TN_EXPR_OR)
        for (TN_EACH(const tn_ast_expr, part, expr->parts))
            waiting = waiting || waits(part);
    return waiting;
}

static void emit_holds(tn_emit *emit, tn_checked_rule *rule)
{
    tn_emit_begin(emit, rule->schema->index);
    emit_rule_holds(emit, rule);
    tn_emit_op(emit, rule->ast->body->node.span, TN_OP_RETURN, 0, 0);
    rule->holds = tn_emit_end(emit, rule->name, TN_FUNCTION_HOLDS);
}

/* The rules of a circle take each other's functions before these are there: they have the next numbers, in order. */
static void emit_rules(tn_emit *emit, tn_checked_rule *const *rules, size_t count)
{
    emit->derives = rules[0]->generates;
    for (size_t i = 0; i < count; i++) {
        emit->schema = rules[i]->schema->index;
        tn_emit_needs(emit, rules[i]->ast->body, rules[i]->name);
    }
    for (size_t i = 0; i < count; i++)
        rules[i]->whole = (uint32_t)(tn_builder_count(emit->builder, TN_SECTION_FUNCTION) + i);
    for (size_t i = 0; i < count; i++)
        emit_rule_whole(emit, rules[i]);
    for (size_t left = count; left > 0;) /* names that take no tray do not go round: in each pass one goes on */
        for (size_t i = 0; i < count; i++) {
            if (rules[i]->holds != 0 || waits(rules[i]->ast->body))
                continue;
            emit_holds(emit, rules[i]);
            left--;
        }
    emit->derives = false;
}

void tn_emit_rules(tn_emit *emit)
{
    const tn_checked *checked = emit->checked;
    for (size_t i = 0; i < checked->rule_count;) {
        tn_checked_rule *rule = checked->order[i];
        size_t count = rule->circle ? rule->circle_size : 1;
        if (rule->is_measure)
            tn_emit_plan_measure(emit, rule);
        else
            emit_rules(emit, checked->order + i, count);
        i += count;
    }
    for (size_t i = 0; i < checked->rule_count; i++) {
        const tn_checked_rule *rule = checked->rules[i];
        if (rule->is_measure || rule->hidden)
            continue;
        if (rule->form) {
            tn_emit_house_rule(emit, rule);
            continue;
        }
        tn_span span = rule->ast->top.node.span;
        tn_builder_add_RULE(emit->builder,
                            &(tn_rule_record){
                                .name = tn_builder_string(emit->builder, rule->name),
                                .doc = tn_builder_string(emit->builder, rule->ast->doc ? rule->ast->doc->text : NULL),
                                .schema = rule->schema->index,
                                .whole = rule->whole,
                                .holds = rule->holds,
                                .flags = rule->unit + 1 < emit->imports->count ? TN_IMPORTED : 0,
                                .file = span.file,
                                .begin = span.begin,
                                .end = span.end,
                            });
    }
}
