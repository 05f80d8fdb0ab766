/* Lists the changes of a file's rules, and opens the file with one of them. */
#include "driver/coverage/changes_walk.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/open/open.h"
#include "runtime/base/array.h"
#include "runtime/base/length.h"

/* ---- offering */

static bool add(tn_change_walk *walk, tn_change change, const char *to)
{
    tn_changes *list = walk->list;
    if (list->count == walk->scope->most) {
        list->more++;
        return true;
    }
    if (!tn_array_reserve(&list->items, &list->capacity, list->count, 1, sizeof *list->items))
        return false;
    change.name = strdup(walk->in.name);
    change.to = to ? strdup(to) : NULL;
    list->items[list->count++] = change;
    return change.name && (!to || change.to);
}

static const char *word_of(tn_rule_change_kind kind, const char *part)
{
    switch (kind) {
    case TN_CHANGE_LEFT_OUT:
        return "item";
    case TN_CHANGE_REPLACED:
        return "value";
    case TN_CHANGE_CLAUSE:
        return "clause";
    default:
        return part;
    }
}

bool tn_change_offer(tn_change_walk *walk, tn_rule_change_kind kind, tn_span span, const char *to)
{
    if (walk->list) {
        tn_change change = walk->in;
        change.kind = kind;
        change.what = word_of(kind, walk->in.what);
        change.span = span;
        change.around = kind == TN_CHANGE_LEFT_OUT || kind == TN_CHANGE_REPLACED ? walk->around : span;
        walk->failed = walk->failed || !add(walk, change, to);
        return false;
    }
    if (walk->made || walk->number++ != walk->wanted)
        return false;
    walk->made = true;
    return true;
}

static bool offer(tn_change_walk *walk, tn_rule_change_kind kind, const tn_ast_node *node, const char *to)
{
    return tn_change_offer(walk, kind, node->span, to);
}

tn_ast_list tn_change_without(tn_ast_list list, const void *node)
{
    tn_ast_list left = tn_ast_empty();
    for (tn_ast_node *item = list.first, *next; item; item = next) {
        next = item->next;
        item->next = NULL;
        if (item != node)
            left = tn_ast_append(left, item);
    }
    return left;
}

/* ---- bounds */

static tn_ast_word *changed_word(tn_change_walk *walk, const tn_ast_word *word, const char *text, int64_t value)
{
    tn_ast_word *changed = TN_NEW(walk->arena, tn_ast_word);
    if (!changed)
        return NULL;
    *changed = *word;
    changed->node.next = NULL;
    changed->value = value;
    changed->text = tn_arena_copy(walk->arena, text, strlen(text));
    changed->exact = NULL;
    return changed->text ? changed : NULL;
}

static void bound_to(tn_change_walk *walk, const tn_ast_word **word, int64_t value)
{
    char text[64];
    if (value < 0 || value > TN_LENGTH_MAX)
        return;
    if ((*word)->kind == TN_WORD_LENGTH)
        tn_length_write_style(value, tn_length_style_of((*word)->text), text, sizeof text);
    else
        snprintf(text, sizeof text, "%lld", (long long)value);
    if (!offer(walk, TN_CHANGE_REPLACED, &(*word)->node, text))
        return;
    const tn_ast_word *changed = changed_word(walk, *word, text, value);
    if (changed)
        *word = changed;
}

void tn_change_bound(tn_change_walk *walk, const tn_ast_word **word)
{
    int64_t step = (*word)->kind == TN_WORD_LENGTH ? walk->step : 1;
    if (!tn_change_is_bound(*word) || step <= 0)
        return;
    int64_t value = (*word)->value;
    bound_to(walk, word, value - step);
    bound_to(walk, word, value + step);
}

static void change_range(tn_change_walk *walk, tn_ast_range *range)
{
    const tn_ast_word *both = range->low == range->high ? range->low : NULL;
    tn_change_bound(walk, &range->low);
    if (both)
        range->high = range->low;
    else
        tn_change_bound(walk, &range->high);
}

/* The common step of a field's lengths. */
static int64_t step_of(const tn_change_walk *walk, const char *name)
{
    const tn_schema_record *schema = &walk->module->SCHEMA_records[walk->schema];
    int64_t step = 0;
    bool found = false;
    for (uint32_t f = 0; f < schema->field_count && !found; f++) {
        const tn_field_record *field = &walk->module->FIELD_records[schema->field_first + f];
        found = name ? strcmp(tn_text(walk->module, field->name), name) == 0 : field->kind == TN_FIELD_LENGTH;
        for (uint32_t v = 0; found && v < field->value_count; v++)
            for (int64_t rest = walk->module->VALUE_records[field->value_first + v].length; rest != 0;) {
                int64_t left = step % rest;
                step = rest;
                rest = left;
            }
    }
    return step;
}

/* ---- conditions */

/* A remainder may be any other one below its divisor. */
static void change_remainder(tn_change_walk *walk, tn_ast_cond *cond)
{
    int64_t step = cond->right->kind == TN_WORD_LENGTH ? walk->step : 1;
    if (!tn_change_is_bound(cond->modulus) || !tn_change_is_bound(cond->right) || step <= 0)
        return;
    int64_t modulus = cond->modulus->value, rest = cond->right->value;
    if (rest >= step)
        bound_to(walk, &cond->right, rest - step);
    if (rest + step < modulus)
        bound_to(walk, &cond->right, rest + step);
    if (modulus - step > 0)
        bound_to(walk, &cond->modulus, modulus - step);
    bound_to(walk, &cond->modulus, modulus + step);
}

static void change_condition(tn_change_walk *walk, tn_ast_cond *cond)
{
    switch (cond->kind) {
    case TN_COND_COMPARE:
        tn_change_bound(walk, tn_change_is_bound(cond->left) ? &cond->left : &cond->right);
        break;
    case TN_COND_WITHIN:
        change_range(walk, &cond->range);
        break;
    case TN_COND_REMAINDER:
        change_remainder(walk, cond);
        break;
    case TN_COND_AND:
    case TN_COND_OR:
    case TN_COND_NOT:
        for (TN_EACH(tn_ast_cond, part, cond->parts))
            change_condition(walk, part);
        break;
    }
}

/* ---- expressions */

static void become(tn_ast_expr *expr, tn_expr_kind kind)
{
    *expr = (tn_ast_expr){.node = expr->node, .kind = kind, .depth = expr->depth};
}

/* Is it a number, or something that only a neighbour has? */
static bool is_rule(const tn_ast_expr *expr)
{
    switch (expr->kind) {
    case TN_EXPR_BEGINNING:
    case TN_EXPR_END:
    case TN_EXPR_OPTIONAL:
    case TN_EXPR_TRUE:
    case TN_EXPR_FALSE:
    case TN_EXPR_BROKEN:
    case TN_EXPR_RANGE:
    case TN_EXPR_NUMBER:
    case TN_EXPR_TRAYS:
    case TN_EXPR_MATCHES:
    case TN_EXPR_VALUES:
    case TN_EXPR_EXTREME:
    case TN_EXPR_GAP:
    case TN_EXPR_WALK:
    case TN_EXPR_EXITS:
    case TN_EXPR_PLUS:
    case TN_EXPR_MINUS:
    case TN_EXPR_TIMES:
    case TN_EXPR_OVER:
    case TN_EXPR_NEGATIVE:
    case TN_EXPR_FIGURE:
    case TN_EXPR_LEAST:
    case TN_EXPR_MOST:
        return false;
    case TN_EXPR_QUANTITY:
    case TN_EXPR_OCCURRENCES:
    case TN_EXPR_SUM:
        return expr->condition != NULL;
    default:
        return true;
    }
}

/* Which of the two whole changes a part has that are not those of what it stands in. */
typedef enum tn_wholes { NEITHER = 0, NEVER = 1, ALWAYS = 2, EITHER = 3 } tn_wholes;

static void change_expr(tn_change_walk *walk, tn_ast_expr *expr, tn_wholes wholes);

static void change_parts(tn_change_walk *walk, tn_ast_expr *expr, tn_wholes wholes)
{
    walk->in.depth++;
    for (TN_EACH(tn_ast_expr, part, expr->parts))
        change_expr(walk, part, wholes);
    walk->in.depth--;
}

/* Parts of which one that never matches is as the whole that never does; an optional one is not. */
static void change_neighbour(tn_change_walk *walk, tn_ast_expr *expr)
{
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        if ((part->kind == TN_EXPR_BEGINNING || part->kind == TN_EXPR_END) &&
            tn_change_offer(walk, TN_CHANGE_LEFT_OUT, part->node.span, NULL)) {
            expr->parts = tn_change_without(expr->parts, part);
            return;
        }
    walk->in.depth++;
    for (TN_EACH(tn_ast_expr, part, expr->parts)) {
        bool optional = part->kind == TN_EXPR_OPTIONAL;
        tn_ast_expr *asked = optional ? (tn_ast_expr *)part->parts.first : part;
        if (asked)
            change_expr(walk, asked, optional ? EITHER : ALWAYS);
    }
    walk->in.depth--;
}

static void change_symmetric(tn_change_walk *walk, tn_ast_expr *expr)
{
    if (offer(walk, TN_CHANGE_WRITTEN, &expr->node, NULL))
        expr->sides = TN_SIDES_WRITTEN;
    if (offer(walk, TN_CHANGE_MIRRORED, &expr->node, NULL))
        expr->sides = TN_SIDES_MIRRORED;
    change_parts(walk, expr, NEITHER);
}

/* The first sum of a field in a number says what its lengths are; "" where none does. */
static const char *field_of(const tn_ast_expr *sum)
{
    if (sum->kind == TN_EXPR_SUM)
        return sum->name ? sum->name->text : "";
    const char *found = "";
    for (TN_EACH(const tn_ast_expr, part, sum->parts))
        if (!*found)
            found = field_of(part);
    return found;
}

/* Bounds are the constants of a side that are not multiplied. *any: was there one? */
static void change_bounds(tn_change_walk *walk, tn_ast_expr *sum, bool *any)
{
    if (sum->kind == TN_EXPR_NUMBER && sum->name && tn_change_is_bound(sum->name)) {
        *any = true;
        tn_change_bound(walk, &sum->name);
    } else if (sum->kind == TN_EXPR_PLUS || sum->kind == TN_EXPR_MINUS || sum->kind == TN_EXPR_RANGE) {
        for (TN_EACH(tn_ast_expr, part, sum->parts))
            change_bounds(walk, part, any);
    }
}

/* The greatest becomes the least, and the other way round. */
static void change_extreme(tn_change_walk *walk, tn_ast_expr *expr)
{
    bool most = expr->extreme == TN_EXTREME_MOST;
    tn_span word = expr->node.span;
    word.end = word.begin + (uint32_t)strlen("max");
    if (tn_change_offer(walk, TN_CHANGE_REPLACED, word, most ? "min" : "max"))
        expr->extreme = most ? TN_EXTREME_LEAST : TN_EXTREME_MOST;
}

/* The rules that a number counts by. */
static void change_counted(tn_change_walk *walk, tn_ast_expr *sum)
{
    bool extreme = sum->kind == TN_EXPR_EXTREME || sum->kind == TN_EXPR_GAP;
    if (extreme)
        change_extreme(walk, sum);
    walk->in.depth++;
    for (TN_EACH(tn_ast_expr, part, sum->parts)) {
        if (is_rule(part) && sum->kind >= TN_EXPR_NUMBER && sum->kind != TN_EXPR_MATCHES && !extreme)
            continue; /* the name of a number */
        if (is_rule(part))
            change_expr(walk, part, EITHER);
        else
            change_counted(walk, part);
    }
    walk->in.depth--;
}

const char *tn_change_other_sign(tn_operator op, tn_operator *other)
{
    static const struct {
        tn_operator op;
        const char *sign;
    } others[] = {
        [TN_LESS] = {TN_AT_MOST, "<="},    [TN_AT_MOST] = {TN_LESS, "<"},      [TN_EQUAL] = {TN_EQUAL, NULL},
        [TN_UNEQUAL] = {TN_UNEQUAL, NULL}, [TN_GREATER] = {TN_AT_LEAST, ">="}, [TN_AT_LEAST] = {TN_GREATER, ">"},
    };
    *other = others[op].op;
    return others[op].sign;
}

static void change_sign(tn_change_walk *walk, tn_ast_expr *expr)
{
    tn_operator other;
    const char *sign = tn_change_other_sign(expr->op, &other);
    if (sign && offer(walk, TN_CHANGE_COMPARED, &expr->node, sign))
        expr->op = other;
}

/* A comparison of two sums, or of one with a range. */
static void change_comparison(tn_change_walk *walk, tn_ast_expr *expr)
{
    int64_t before = walk->step;
    bool any = false;
    const char *field = "";
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        field = *field ? field : field_of(part);
    walk->step = *field ? step_of(walk, field) : step_of(walk, NULL);
    for (TN_EACH(tn_ast_expr, part, expr->parts))
        change_bounds(walk, part, &any);
    walk->step = before;
    if (!any && expr->kind == TN_EXPR_COMPARE)
        change_sign(walk, expr);
    change_counted(walk, expr);
}

static void change_counting(tn_change_walk *walk, tn_ast_expr *expr)
{
    int64_t before = walk->step;
    if (expr->kind == TN_EXPR_SUM)
        walk->step = step_of(walk, expr->name ? expr->name->text : NULL);
    change_condition(walk, expr->condition);
    walk->step = before;
    change_parts(walk, expr, EITHER);
}

static void change_each(tn_change_walk *walk, tn_ast_expr *expr, const tn_wholes *wholes, size_t count)
{
    size_t i = 0;
    walk->in.depth++;
    for (TN_EACH(tn_ast_expr, part, expr->parts)) {
        change_expr(walk, part, i < count ? wholes[i] : EITHER);
        i++;
    }
    walk->in.depth--;
}

/* What is asked of what lies around a stretch: the stretch, what may lie there, and how far. */
static void change_near(tn_change_walk *walk, tn_ast_expr *expr)
{
    static const tn_wholes one[] = {ALWAYS, ALWAYS, NEITHER}, other[] = {ALWAYS, EITHER, NEITHER};
    bool every = expr->kind == TN_EXPR_EVERY_NEAR, apart = expr->near == TN_NEAR_APART;
    int64_t before = walk->step;
    bool any = false;
    if (expr->parts.count > 2) {
        walk->step = step_of(walk, NULL);
        change_bounds(walk, (tn_ast_expr *)expr->parts.last, &any);
        walk->step = before;
    }
    change_each(walk, expr, every == apart ? one : other, 3);
}

/* A sum mod a number, compared with a rest. */
static void change_rest(tn_change_walk *walk, tn_ast_expr *expr)
{
    tn_ast_expr *sum = (tn_ast_expr *)expr->parts.first;
    const char *field = field_of(sum);
    int64_t before = walk->step;
    bool any = false;
    walk->step = step_of(walk, *field ? field : NULL);
    for (TN_EACH(tn_ast_expr, part, expr->parts))
        if (part != sum)
            change_bounds(walk, part, &any);
    walk->step = before;
    change_counted(walk, sum);
}

/* `repeat(a, 2..4)`, as it is written: what stands there, and how often. */
static void change_repeat(tn_change_walk *walk, tn_ast_expr *expr)
{
    bool any = false;
    walk->in.depth++;
    change_expr(walk, (tn_ast_expr *)expr->parts.first, ALWAYS);
    walk->in.depth--;
    change_bounds(walk, (tn_ast_expr *)expr->parts.last, &any);
}

static bool is_repeat(const tn_ast_expr *expr)
{
    return expr->kind == TN_EXPR_CALL && expr->parts.count == 2 && strcmp(expr->name->text, "repeat") == 0;
}

/* Of several fields each may be left out. */
static void change_mirrored(tn_change_walk *walk, tn_ast_expr *expr)
{
    for (TN_EACH(const tn_ast_word, name, expr->names))
        if (expr->names.count > 1 && tn_change_offer(walk, TN_CHANGE_LEFT_OUT, name->node.span, NULL)) {
            expr->names = tn_change_without(expr->names, name);
            return;
        }
}

/* What is in a rule's expression. */
static void change_inside(tn_change_walk *walk, tn_ast_expr *expr)
{
    static const tn_wholes implied[] = {ALWAYS, NEVER}, every[] = {ALWAYS, NEVER}, far[] = {ALWAYS, EITHER, EITHER};
    switch (expr->kind) {
    case TN_EXPR_TRAY:
        tn_change_items(walk, &expr->items);
        break;
    case TN_EXPR_AND:
        change_parts(walk, expr, ALWAYS);
        break;
    case TN_EXPR_OR:
        change_parts(walk, expr, NEVER);
        break;
    case TN_EXPR_NOT:
    case TN_EXPR_SOME:
    case TN_EXPR_EACH:
        change_parts(walk, expr, NEITHER);
        break;
    case TN_EXPR_MANY:
        change_parts(walk, expr, ALWAYS);
        break;
    case TN_EXPR_NEIGHBOUR:
    case TN_EXPR_PLAN:
        change_neighbour(walk, expr);
        break;
    case TN_EXPR_SYMMETRIC:
        change_symmetric(walk, expr);
        break;
    case TN_EXPR_IMPLIES:
        change_each(walk, expr, implied, 2);
        break;
    case TN_EXPR_EVERY:
        change_each(walk, expr, every, 2);
        break;
    case TN_EXPR_DISTANCE:
        change_each(walk, expr, far, 3);
        break;
    case TN_EXPR_NEAR:
    case TN_EXPR_EVERY_NEAR:
        change_near(walk, expr);
        break;
    case TN_EXPR_WHERE:
        change_parts(walk, expr, ALWAYS);
        break;
    case TN_EXPR_REMAINDER:
        change_rest(walk, expr);
        break;
    case TN_EXPR_MIRRORED:
        change_mirrored(walk, expr);
        break;
    case TN_EXPR_QUANTITY:
    case TN_EXPR_OCCURRENCES:
    case TN_EXPR_SUM:
        change_counting(walk, expr);
        break;
    case TN_EXPR_COMPARE:
    case TN_EXPR_WITHIN:
        change_comparison(walk, expr);
        break;
    case TN_EXPR_CELL: /* rules about houses are measured in their own way */
    case TN_EXPR_SECTION:
    case TN_EXPR_ROOM:
    case TN_EXPR_TOUCH:
    case TN_EXPR_APART:
        break;
    case TN_EXPR_CALL:
        if (is_repeat(expr)) {
            change_repeat(walk, expr);
            break;
        }
        change_parts(walk, expr, EITHER);
        break;
    default:
        change_parts(walk, expr, EITHER);
        break;
    }
}

static const char *word_of_expr(tn_expr_kind kind)
{
    switch (kind) {
    case TN_EXPR_TRAY:
        return "tray";
    case TN_EXPR_ANY:
        return "any";
    case TN_EXPR_NAME:
    case TN_EXPR_CALL:
        return "rule";
    case TN_EXPR_AND:
        return "and";
    case TN_EXPR_OR:
        return "or";
    case TN_EXPR_NOT:
        return "not";
    case TN_EXPR_NEIGHBOUR:
        return "neighbour";
    case TN_EXPR_SYMMETRIC:
        return "symmetric";
    case TN_EXPR_QUANTITY:
        return "quantity";
    case TN_EXPR_SUM:
        return "sum";
    case TN_EXPR_OCCURRENCES:
        return "occurrences";
    case TN_EXPR_MANY:
        return "many";
    case TN_EXPR_DISTANCE:
        return "distance";
    case TN_EXPR_IMPLIES:
        return "implies";
    case TN_EXPR_EVERY:
    case TN_EXPR_EACH:
        return "every";
    case TN_EXPR_SOME:
        return "some";
    case TN_EXPR_PLAN:
        return "plan";
    case TN_EXPR_COMPARE:
    case TN_EXPR_WITHIN:
    case TN_EXPR_REMAINDER:
        return "comparison";
    case TN_EXPR_NEAR:
    case TN_EXPR_EVERY_NEAR:
        return "near";
    case TN_EXPR_WHERE:
        return "where";
    case TN_EXPR_MIRRORED:
        return "mirrored";
    default:
        return "part";
    }
}

/* Any tray, or any trays: what always matches is that already. */
static bool is_any(const tn_ast_expr *expr)
{
    const tn_ast_expr *part = (const tn_ast_expr *)expr->parts.first;
    return expr->kind == TN_EXPR_ANY || (expr->kind == TN_EXPR_MANY && part && part->kind == TN_EXPR_ANY);
}

/* Recursion is as deep as expressions nest. */
static void change_expr(tn_change_walk *walk, tn_ast_expr *expr, tn_wholes wholes)
{
    if (walk->made || walk->failed)
        return;
    tn_span around = walk->around;
    bool rule = is_rule(expr), tray = expr->kind == TN_EXPR_TRAY, any = is_any(expr);
    walk->in.what = word_of_expr(expr->kind);
    if (rule && (wholes & NEVER) && offer(walk, TN_CHANGE_NEVER, &expr->node, NULL)) {
        become(expr, TN_EXPR_FALSE);
        return;
    }
    if (rule && !tray && !any && (wholes & ALWAYS) && offer(walk, TN_CHANGE_ALWAYS, &expr->node, NULL)) {
        become(expr, TN_EXPR_TRUE);
        return;
    }
    if (tray && (wholes & ALWAYS) && expr->items.count > 1 && offer(walk, TN_CHANGE_ANY_TRAY, &expr->node, NULL)) {
        expr->items = tn_ast_empty();
        return;
    }
    walk->around = expr->node.span;
    change_inside(walk, expr);
    walk->around = around;
}

/* ---- items of a file */

static bool is_at(const tn_span *span, uint32_t file, uint32_t begin)
{
    return span->file == file && span->begin == begin;
}

static bool clause_names(const tn_change_walk *walk, uint32_t holds)
{
    const tn_library_record *library = walk->scope->library;
    for (uint32_t i = 0; library && i < library->clause_count; i++)
        if (walk->module->CLAUSE_records[library->clause_first + i].holds == holds)
            return true;
    return false;
}

static bool is_let(const tn_ast_rule *rule)
{
    return rule->top.kind == TN_ITEM_LET || rule->top.kind == TN_ITEM_PARAM;
}

/* Sets what the changes of the rule have in common. False: the rule is not one whose changes are wanted. */
static bool enter_rule(tn_change_walk *walk, const tn_ast_rule *rule, bool main)
{
    const tn_module *module = walk->module;
    const tn_span *span = &rule->top.node.span;
    walk->in = (tn_change){.rule = TN_NO_RECORD, .clause = TN_NO_RECORD, .name = (char *)(uintptr_t)rule->name->text};
    walk->around = *span;
    walk->schema = walk->scope->schema;
    for (uint32_t i = 0; i < module->HOUSE_RULE_count; i++)
        if (is_at(span, module->HOUSE_RULE_records[i].file, module->HOUSE_RULE_records[i].begin))
            return false;
    for (uint32_t i = 0; i < module->RULE_count; i++) {
        const tn_rule_record *record = &module->RULE_records[i];
        if (!is_at(span, record->file, record->begin))
            continue;
        walk->in.rule = i;
        bool wanted = !(record->flags & TN_IMPORTED) || (walk->scope->imported && clause_names(walk, record->holds));
        return wanted && record->schema == walk->schema;
    }
    return main && (is_let(rule) || rule->params.count > 0);
}

static void change_let(tn_change_walk *walk, tn_ast_expr *body)
{
    walk->step = step_of(walk, NULL);
    if (body->kind == TN_EXPR_NUMBER && body->name)
        tn_change_bound(walk, &body->name);
    else if (body->kind == TN_EXPR_NAME && body->name) {
        tn_ast_word *word = changed_word(walk, body->name, body->name->text, body->name->value);
        if (word) {
            body->name = word;
            tn_change_value(walk, word);
        }
    }
    walk->step = 0;
}

/* The CLAUSE record of a clause, in the library that is measured; TN_NO_RECORD: it has no such clause. */
static uint32_t clause_at(const tn_change_walk *walk, const tn_ast_clause *clause)
{
    const tn_library_record *library = walk->scope->library;
    for (uint32_t i = 0; library && i < library->clause_count; i++) {
        const tn_clause_record *record = &walk->module->CLAUSE_records[library->clause_first + i];
        if (is_at(&clause->node.span, record->file, record->begin))
            return library->clause_first + i;
    }
    return TN_NO_RECORD;
}

/* A clause that is left out keeps its name, which tests may say. */
static void leave_out(tn_change_walk *walk, tn_ast_clause *clause)
{
    if (clause->expr) {
        if (clause->expr->kind == TN_EXPR_NAME && !clause->name)
            clause->name = clause->expr->name;
        become(clause->expr, clause->form == TN_FORM_PRUNE ? TN_EXPR_FALSE : TN_EXPR_TRUE);
        return;
    }
    const tn_ast_word *word = clause->form == TN_FORM_TOTAL_COMPARE ? clause->word : clause->range.low;
    const tn_ast_word *nothing = changed_word(walk, word, "0", 0);
    if (!nothing)
        return;
    clause->form = TN_FORM_TOTAL_COMPARE; /* every total is at least 0 */
    clause->op = TN_AT_LEAST;
    clause->word = nothing;
}

static void change_total(tn_change_walk *walk, tn_ast_clause *clause)
{
    walk->step = step_of(walk, clause->field ? clause->field->text : NULL);
    if (clause->form == TN_FORM_TOTAL_RANGE)
        change_range(walk, &clause->range);
    else
        tn_change_bound(walk, &clause->word);
    walk->step = 0;
}

static void change_clause(tn_change_walk *walk, tn_ast_clause *clause)
{
    uint32_t record = clause_at(walk, clause);
    bool trays = clause->form == TN_FORM_TRAYS;
    if (clause->form == TN_FORM_ALLOW || (!trays && record == TN_NO_RECORD) || !walk->scope->library)
        return;
    const char *name = trays ? "trays" : tn_text(walk->module, walk->module->CLAUSE_records[record].name);
    walk->in = (tn_change){.rule = TN_NO_RECORD, .clause = record, .name = (char *)(uintptr_t)name};
    walk->schema = walk->scope->schema;
    walk->around = clause->node.span;
    if (trays) {
        change_range(walk, &clause->range);
        return;
    }
    if (offer(walk, TN_CHANGE_CLAUSE, &clause->node, NULL)) {
        leave_out(walk, clause);
        return;
    }
    if (!clause->expr)
        change_total(walk, clause);
    else if (clause->expr->kind != TN_EXPR_NAME) /* its rule has changes of its own */
        change_expr(walk, clause->expr, clause->form == TN_FORM_PRUNE ? ALWAYS : NEVER);
}

static void change_item(tn_change_walk *walk, tn_ast_top *item, bool main)
{
    tn_ast_rule *rule = (tn_ast_rule *)item;
    switch (item->kind) {
    case TN_ITEM_RULE:
        if (rule->body && enter_rule(walk, rule, main))
            change_expr(walk, rule->body, EITHER);
        break;
    case TN_ITEM_LET:
    case TN_ITEM_PARAM:
        if (rule->body && !rule->words.first && enter_rule(walk, rule, main))
            change_let(walk, rule->body);
        break;
    case TN_ITEM_LIBRARY:
        for (TN_EACH(tn_ast_clause, clause, ((tn_ast_library *)item)->clauses))
            if (main && !walk->made && !walk->failed)
                change_clause(walk, clause);
        break;
    default:
        break;
    }
}

static void change_tree(void *context, tn_arena *arena, void *tree, bool main)
{
    tn_change_walk *walk = context;
    walk->arena = arena;
    for (TN_EACH(tn_ast_top, item, ((tn_ast_file *)tree)->items))
        if (!walk->made && !walk->failed)
            change_item(walk, item, main);
}

/* ---- compiling again */

static tn_status open_walked(const tn_change_scope *scope, tn_change_walk *walk, tn_opened *opened)
{
    walk->scope = scope;
    walk->module = scope->opened->module;
    return tn_open_again(scope->opened, change_tree, walk, walk->test, opened);
}

tn_status tn_changes_list(const tn_change_scope *scope, tn_changes *changes, tn_error *error)
{
    tn_change_walk walk = {.list = changes};
    tn_opened opened;
    tn_status status = open_walked(scope, &walk, &opened);
    if (status != TN_OK)
        status = tn_open_error(&opened, status, error);
    tn_close(&opened);
    return walk.failed ? tn_fail_memory(error) : status;
}

void tn_changes_clear(tn_changes *changes)
{
    for (size_t i = 0; i < changes->count; i++) {
        free(changes->items[i].to);
        free(changes->items[i].name);
    }
    free(changes->items);
    *changes = (tn_changes){0};
}

/* The same trays, rules and libraries? A `let` may also stand in the schema. */
static bool is_comparable(const tn_module *a, const tn_module *b)
{
    bool same = a->SCHEMA_count == b->SCHEMA_count && a->FIELD_count == b->FIELD_count &&
                a->VALUE_count == b->VALUE_count && a->RULE_count == b->RULE_count &&
                a->LIBRARY_count == b->LIBRARY_count && a->CLAUSE_count == b->CLAUSE_count;
    for (size_t i = 0; same && i < a->VALUE_count; i++)
        same = a->VALUE_records[i].length == b->VALUE_records[i].length &&
               strcmp(tn_text(a, a->VALUE_records[i].name), tn_text(b, b->VALUE_records[i].name)) == 0;
    return same;
}

tn_status tn_change_open(const tn_change_scope *scope, size_t number, size_t test, tn_opened *changed)
{
    tn_change_walk walk = {.wanted = number, .test = test};
    tn_status status = open_walked(scope, &walk, changed);
    bool comparable = status != TN_OK || (walk.made && is_comparable(scope->opened->module, changed->module));
    if (status == TN_OK)
        changed->module->watch = scope->opened->module->watch;
    return comparable ? status : TN_INVALID;
}
