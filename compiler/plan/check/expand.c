/* Calls of rules with parameters, `let` and quantifiers, written out.
 *
 * Names that are bound have to be new (names.c sees to it), so nothing is ever captured. A call becomes the name
 * of a rule made for it; equal calls share one. Recursion is as deep as calls are inside one another, which is limited.
 */
#include "compiler/plan/check/expand.h"

#include <string.h>

#include "compiler/plan/check/amount.h"

#include "compiler/common/limits.h"
#include "runtime/module/code.h"

enum { CALLS_DEEP = 64 };

tn_bound_name tn_bound(const tn_rule_expansion *expansion, const tn_ast_word *word)
{
    for (const tn_bound_name *b = expansion->bindings; b; b = b->outer)
        if (strcmp(b->word->text, word->text) == 0)
            return *b;
    const tn_check *check = expansion->check;
    const tn_checked_name *name = check->has_lets ? tn_names_get(&check->names, word->text) : NULL;
    if (!name || !name->rule || !name->rule->is_let || !tn_import_reaches(check->imports, expansion->unit, name->unit))
        return (tn_bound_name){0};
    tn_bound_name bound = {.word = word, .value = tn_let_value(expansion->check, name->rule), .let = name->rule};
    expansion->check->met_param |= name->rule->settable;
    return bound;
}

/* ---- does anything have to be written out? */

static tn_checked_rule *rule_named(const tn_rule_expansion *expansion, const tn_ast_word *word)
{
    const tn_checked_name *name = tn_names_get(&expansion->check->names, word->text);
    return name ? name->rule : NULL;
}

static bool needs_expansion(const tn_rule_expansion *expansion, const tn_ast_expr *expr)
{
    if (expr->kind == TN_EXPR_CALL || expr->kind == TN_EXPR_SOME || expr->kind == TN_EXPR_EACH ||
        expansion->check->extends) /* for another schema it is written out from what stands in the file */
        return true;
    if (expr->kind == TN_EXPR_NAME || expr->kind == TN_EXPR_FIGURE) {
        const tn_checked_rule *rule = expr->kind == TN_EXPR_NAME ? rule_named(expansion, expr->name) : NULL;
        if (tn_bound(expansion, expr->name).value || (rule && rule->is_template))
            return true;
    }
    for (TN_EACH(const tn_ast_item, item, tn_ast_tray_items(expr)))
        if (expansion->check->has_lets && tn_words_bound(expansion, item))
            return true;
    if (expr->condition && expansion->check->has_lets && tn_condition_bound(expansion, expr->condition))
        return true;
    if (expr->figure && needs_expansion(expansion, expr->figure))
        return true;
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        if (needs_expansion(expansion, part))
            return true;
    return false;
}

/* ---- copies */

static tn_ast_expr *expand(tn_rule_expansion *expansion, const tn_ast_expr *expr);

static tn_ast_expr *shallow(tn_rule_expansion *expansion, const tn_ast_expr *expr)
{
    tn_ast_expr *copy = TN_NEW(expansion->check->arena, tn_ast_expr);
    if (!copy)
        return NULL;
    *copy = *expr;
    copy->node.next = NULL;
    if (!copy->unit) {
        copy->unit = expansion->unit + 1;
        copy->older = expansion->older;
    }
    if (copy->rule && !copy->rule->hidden) /* it was checked where it was written; here it may mean something else */
        copy->rule = NULL;
    copy->spec = NULL;
    copy->ask = NULL;
    copy->sum = copy->high = NULL;
    copy->condition_checked = NULL;
    copy->tests = tn_ast_empty();
    copy->whole = copy->resolved = copy->settable = false;
    copy->idle = tn_ast_empty();
    return copy;
}

static tn_ast_expr *broken(tn_rule_expansion *expansion, const tn_ast_expr *expr)
{
    tn_ast_expr *copy = shallow(expansion, expr);
    if (copy) {
        copy->kind = TN_EXPR_BROKEN;
        copy->parts = tn_ast_empty();
    }
    return copy;
}

static tn_ast_list expand_parts(tn_rule_expansion *expansion, tn_ast_list parts)
{
    tn_ast_list made = tn_ast_empty();
    for (TN_EACH(const tn_ast_expr, part, parts))
        made = tn_ast_append(made, expand(expansion, part));
    return made;
}

/* Counts one more that is written out; the first past the limit is reported. */
static bool count_expansion(tn_check *check, tn_span span)
{
    return tn_check_room(check, check->expanded++, TN_EXPANSIONS_MAX, "expansion of a call or quantifier", span,
                         "quantify over fewer values at a time, or leave calls out");
}

/* ---- quantifiers */

/* What a param decides leaves the other parts out, which mean something with another value: they are kept to be
 * checked. Moves them from `parts`, but for `decides` (or NULL), to the end of a list. */
static tn_ast_list leave_out(tn_ast_list kept, tn_ast_list parts, const tn_ast_expr *decides)
{
    for (tn_ast_node *node = parts.first, *next; node; node = next) {
        tn_ast_expr *part = (tn_ast_expr *)node;
        next = node->next;
        node->next = NULL;
        kept = tn_ast_join(kept, part->idle);
        if (part != decides && part->kind != TN_EXPR_TRUE && part->kind != TN_EXPR_FALSE)
            kept = tn_ast_append(kept, part);
        part->idle = tn_ast_empty();
    }
    return kept;
}

/* The same, where a part of it is decided by a param. */
static tn_ast_expr *decided_by_param(tn_ast_expr *result, tn_expr_kind kind, tn_ast_list parts, tn_ast_list kept,
                                     const tn_ast_expr *decides)
{
    result->kind = kind;
    result->settable = true;
    result->parts = tn_ast_empty();
    result->idle = leave_out(kept, parts, decides);
    return result;
}

/* An `and` or `or` without the parts that change nothing; what is decided already is decided. */
static tn_ast_expr *joined(tn_rule_expansion *expansion, tn_expr_kind kind, const tn_ast_expr *place, tn_ast_list parts)
{
    tn_expr_kind decides = kind == TN_EXPR_OR ? TN_EXPR_TRUE : TN_EXPR_FALSE,
                 idle = kind == TN_EXPR_OR ? TN_EXPR_FALSE : TN_EXPR_TRUE;
    tn_ast_list left = tn_ast_empty(), kept = tn_ast_empty();
    tn_ast_expr *result = shallow(expansion, place);
    if (!result)
        return NULL;
    result->names = result->items = tn_ast_empty();
    result->name = NULL;
    for (tn_ast_node *node = parts.first, *next; node; node = next) {
        tn_ast_expr *part = (tn_ast_expr *)node;
        next = node->next;
        if (part->kind == decides && part->settable)
            return decided_by_param(result, decides, (tn_ast_list){node, parts.last, parts.count},
                                    tn_ast_join(kept, left), part);
        node->next = NULL;
        if (part->kind == idle) {
            kept = tn_ast_join(kept, part->idle);
            result->settable |= part->settable;
        }
        if (part->kind == decides) {
            result->kind = decides;
            result->parts = tn_ast_empty();
            return result;
        }
        if (part->kind != idle)
            left = tn_ast_append(left, part);
    }
    if (left.count == 1) {
        tn_ast_expr *only = (tn_ast_expr *)left.first;
        only->idle = tn_ast_join(only->idle, kept);
        return only;
    }
    result->kind = left.count ? kind : idle;
    result->parts = left;
    result->idle = kept;
    return result;
}

static bool by_param(const tn_ast_expr *part)
{
    return part && part->settable && (part->kind == TN_EXPR_TRUE || part->kind == TN_EXPR_FALSE);
}

/* `not a` and `a implies b` where a param decides a. NULL: none does. */
static tn_ast_expr *folded(tn_ast_expr *expr, tn_ast_list parts)
{
    tn_ast_expr *first = (tn_ast_expr *)parts.first, *last = (tn_ast_expr *)parts.last;
    bool implies = expr->kind == TN_EXPR_IMPLIES && parts.count == 2;
    if ((!implies && expr->kind != TN_EXPR_NOT) || !by_param(first))
        return NULL;
    bool holds = first->kind == TN_EXPR_TRUE;
    if (implies && holds) {
        last->idle = tn_ast_join(last->idle, first->idle);
        return last;
    }
    return decided_by_param(expr, implies || !holds ? TN_EXPR_TRUE : TN_EXPR_FALSE, parts, tn_ast_empty(), first);
}

static bool bound_names_good(tn_rule_expansion *expansion, const tn_ast_expr *quantifier)
{
    bool good = true;
    for (TN_EACH(const tn_ast_word, word, quantifier->names))
        good &= tn_check_new_word(expansion->check, expansion->older ? expansion->older : expansion->check->schema,
                                  word, expansion->bindings != NULL && tn_bound(expansion, word).value);
    return good;
}

static bool quantify(tn_rule_expansion *expansion, const tn_ast_expr *quantifier, const tn_ast_word *name,
                     const tn_checked_field *field, tn_ast_list *parts)
{
    if (!name) {
        if (!count_expansion(expansion->check, quantifier->node.span))
            return false;
        *parts = tn_ast_append(*parts, expand(expansion, (const tn_ast_expr *)quantifier->parts.first));
        return true;
    }
    const tn_bound_name *outer = expansion->bindings;
    bool good = true;
    for (uint32_t v = 0; good && v < field->value_count; v++) {
        tn_bound_name binding = {.outer = outer,
                                 .word = name,
                                 .value = tn_value_expression(expansion, quantifier, field, v),
                                 .field = field};
        expansion->bindings = &binding;
        good = binding.value && quantify(expansion, quantifier, (const tn_ast_word *)name->node.next, field, parts);
        expansion->bindings = outer;
    }
    return good;
}

static tn_ast_expr *expand_quantifier(tn_rule_expansion *expansion, const tn_ast_expr *expr)
{
    tn_check *check = expansion->check;
    const tn_checked_schema *schema = check->schema;
    tn_bound_name bound = tn_bound(expansion, expr->name);
    const char *name = bound.value && bound.value->kind == TN_EXPR_NAME ? bound.value->name->text : expr->name->text;
    uint32_t field = schema ? tn_field_find(schema, name) : TN_NONE;
    if (schema && field == TN_NONE && !schema->broken) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_UNKNOWN_WORD, expr->name->node.span,
                                     "`%s` is not a field of schema `%s`", expr->name->text, schema->name);
        tn_note(check->diagnostics, d, &schema->ast->name->node.span, "schema `%s` is here", schema->name);
        tn_help(check->diagnostics, d, "a quantifier goes through the values of a field: `some v in %s (...)`",
                schema->field_count ? schema->fields[0].name : "width");
    }
    tn_ast_list parts = tn_ast_empty();
    if (field == TN_NONE || !bound_names_good(expansion, expr) ||
        !quantify(expansion, expr, (const tn_ast_word *)expr->names.first, &schema->fields[field], &parts))
        return broken(expansion, expr);
    return joined(expansion, expr->kind == TN_EXPR_SOME ? TN_EXPR_OR : TN_EXPR_AND, expr, parts);
}

/* A comparison with the value of a quantifier, or with the word of a param: decided at once. NULL where none is. */
static tn_ast_expr *decide(tn_rule_expansion *expansion, const tn_ast_expr *expr)
{
    tn_expr_kind decided;
    bool words = tn_decide_words(expansion, expr, &decided);
    if (!words && !tn_decide_values(expansion, expr, &decided))
        return NULL;
    tn_ast_expr *made = shallow(expansion, expr);
    if (made) {
        made->kind = decided;
        made->settable = words;
        made->parts = tn_ast_empty();
    }
    return made;
}

/* ---- calls */

/* Where a stretch of blanks and remarks ends. */
static const char *past_blanks(const char *text, const char *end)
{
    while (text < end && (strchr(" \t\r\n\f\v", *text) || *text == '#')) {
        if (*text == '#')
            while (text < end && *text != '\n' && *text != '\r')
                text++;
        else
            text++;
    }
    return text;
}

/* What a call is named after: its text with blanks only where `fmt` has them between words, so that laying a file out
 * changes no name. */
static char *call_name(tn_check *check, const tn_ast_expr *call)
{
    const char *text = check->diagnostics->sources->files[call->node.span.file].text;
    const char *from = text + call->node.span.begin, *end = text + call->node.span.end;
    char name[TN_NAME_MAX];
    size_t size = 0;
    bool quoted = false;
    while (from < end && size + 3 <= sizeof name) {
        const char *next = quoted ? from : past_blanks(from, end);
        bool parts = next > from && size > 0 && !strchr("(.", name[size - 1]) && !strchr("),.", *next);
        if (parts)
            name[size++] = ' ';
        quoted ^= *next == '"' && (quoted || (size > 0 && strchr(" (,", name[size - 1])));
        name[size++] = *next;
        if (!quoted && *next == ',' && next + 1 < end && past_blanks(next + 1, end) == next + 1)
            name[size++] = ' ';
        from = next + 1;
    }
    return tn_arena_copy(check->arena, name, size);
}

static tn_checked_rule *new_rule(tn_rule_expansion *expansion, const tn_ast_expr *call, tn_checked_rule *of)
{
    tn_check *check = expansion->check;
    tn_checked *result = check->result;
    tn_ast_rule *ast = TN_NEW(check->arena, tn_ast_rule);
    tn_checked_rule *rule = TN_NEW(check->arena, tn_checked_rule);
    if (!ast || !rule)
        return NULL;
    *ast = *of->ast;
    ast->params = tn_ast_empty();
    *rule = (tn_checked_rule){.ast = ast,
                              .name = of->is_template ? call_name(check, call) : of->name,
                              .unit = of->unit,
                              .schema = check->schema,
                              .form = of->form,
                              .is_measure = of->is_measure,
                              .hidden = true,
                              .call = call,
                              .of = of,
                              .serial = (uint32_t)result->rule_count};
    if (result->rule_count == result->rule_capacity && !tn_check_grow_rules(check))
        return NULL;
    result->rules[result->rule_count++] = rule;
    return rule;
}

static void report_circle(tn_rule_expansion *expansion, const tn_ast_expr *call, const tn_checked_rule *of)
{
    tn_check *check = expansion->check;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_RULE_CYCLE, of->ast->name->node.span, "rule `%s` uses itself", of->name);
    tn_note(check->diagnostics, d, &call->node.span, "it is called here, while it is being written out");
    tn_help(check->diagnostics, d, "write out what one of them means instead of naming the other");
}

/* The schema, where that in use is made from it; else NULL. */
static const tn_checked_schema *older_schema(const tn_check *check, const tn_checked_schema *schema)
{
    return schema && tn_schema_extends(check->schema, schema) ? schema : NULL;
}

/* The rule made for the template, or for a rule of an older schema, with these arguments; NULL: reported. */
static tn_checked_rule *instance(tn_rule_expansion *expansion, const tn_ast_expr *call, tn_checked_rule *of,
                                 tn_ast_list arguments)
{
    tn_check *check = expansion->check;
    const char *key = tn_expression_key(check, check->schema, of->name, arguments);
    tn_checked_rule *rule = key ? tn_names_get(&check->calls, key) : NULL;
    if (rule || !key)
        return rule;
    size_t deep = 0;
    for (const tn_checked_rule *open = check->open; open; open = open->outer, deep++) {
        if (open->of != of || !of->is_template)
            continue;
        report_circle(expansion, call, of);
        return NULL;
    }
    if (deep > CALLS_DEEP) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_TOO_DEEP, call->node.span,
                                     "calls are nested more than %d deep", CALLS_DEEP);
        tn_help(check->diagnostics, d, "write out what some of the rules mean");
        return NULL;
    }
    if (!count_expansion(check, call->node.span))
        return NULL;
    rule = new_rule(expansion, call, of);
    if (!rule)
        return NULL;
    tn_names_put(&check->calls, key, rule);
    rule->outer = check->open;
    check->open = rule;
    tn_bound_name bindings[TN_PARAMETERS_MAX];
    size_t count = 0;
    tn_rule_expansion inner = {.check = check, .unit = of->unit, .older = older_schema(check, of->schema)};
    tn_ast_expr *argument = (tn_ast_expr *)arguments.first;
    for (TN_EACH(const tn_ast_word, word, of->ast->params)) {
        if (!argument) /* out of memory */
            break;
        bindings[count] = (tn_bound_name){.outer = inner.bindings, .word = word, .value = argument};
        inner.bindings = &bindings[count++];
        argument = (tn_ast_expr *)argument->node.next;
    }
    bool met = check->met_param;
    check->met_param = false;
    rule->ast->body = expand(&inner, of->written);
    rule->settable = check->met_param;
    check->met_param |= met;
    if (!rule->ast->body || tn_arena_failed(check->arena))
        rule->ast->body = of->written;
    check->open = rule->outer;
    return rule;
}

static tn_ast_expr *name_of(tn_rule_expansion *expansion, const tn_ast_expr *call, tn_checked_rule *rule)
{
    tn_ast_expr *name = shallow(expansion, call);
    if (!name || !rule)
        return name ? broken(expansion, call) : NULL;
    name->kind = TN_EXPR_NAME;
    name->parts = tn_ast_empty();
    name->rule = rule;
    return name;
}

static bool arguments_fit(tn_rule_expansion *expansion, const tn_ast_expr *call, const tn_checked_rule *rule,
                          size_t given)
{
    tn_check *check = expansion->check;
    size_t wanted = rule->ast->params.count;
    if (wanted == given)
        return true;
    tn_diagnostic *d = wanted == 0  ? tn_report(check->diagnostics, E_BAD_ARGUMENT, call->node.span,
                                                "`%s` has no parameters", rule->name)
                       : given == 0 ? tn_report(check->diagnostics, E_BAD_ARGUMENT, call->node.span,
                                                "`%s` needs %zu argument%s", rule->name, wanted, wanted == 1 ? "" : "s")
                                    : tn_report(check->diagnostics, E_BAD_ARGUMENT, call->node.span,
                                                "`%s` needs %zu argument%s, and this call has %zu", rule->name, wanted,
                                                wanted == 1 ? "" : "s", given);
    tn_note(check->diagnostics, d, &rule->ast->name->node.span, "`%s` is here", rule->name);
    tn_help(check->diagnostics, d,
            wanted == 0 ? "write its name alone" : "write one argument for each parameter, in their order");
    return false;
}

/* The field that an argument names; a word that is bound is the one that it stands for. NULL: reported. */
static tn_ast_word *field_of(tn_rule_expansion *expansion, const tn_ast_expr *call, const tn_ast_expr *argument)
{
    tn_bound_name bound = argument->kind == TN_EXPR_NAME ? tn_bound(expansion, argument->name) : (tn_bound_name){0};
    const tn_ast_expr *meant = bound.value ? bound.value : argument;
    if (meant->kind == TN_EXPR_NAME) {
        tn_ast_word *word = TN_NEW(expansion->check->arena, tn_ast_word);
        if (word)
            *word = *meant->name;
        if (word)
            word->node.next = NULL;
        return word;
    }
    if (meant->kind == TN_EXPR_BROKEN)
        return NULL;
    tn_diagnostic *d = tn_report(expansion->check->diagnostics, E_BAD_ARGUMENT, argument->node.span,
                                 "`%s` is about fields, and this is none", call->name->text);
    tn_help(expansion->check->diagnostics, d, "name a field of the schema: `%s(FIELD)`", call->name->text);
    return NULL;
}

static void report_repeat(const tn_rule_expansion *expansion, tn_span place)
{
    tn_diagnostics *diagnostics = expansion->check->diagnostics;
    tn_diagnostic *d =
        tn_report(diagnostics, E_BAD_ARGUMENT, place, "`repeat` needs what stands there, and how often side by side");
    tn_help(diagnostics, d, "write `repeat(tray(...), 2..4)`, `repeat(tray(...), 2..)` or `repeat(tray(...), 3)`");
}

/* The number that one end of a range comes to; false: reported. */
static bool times(tn_rule_expansion *expansion, const tn_ast_expr *written, uint32_t *number)
{
    tn_check *check = expansion->check;
    tn_ast_expr *made = expand(expansion, written);
    const tn_ast_word *word = made ? tn_expand_constant(expansion, made, written->node.span) : NULL;
    if (!word || word->broken)
        return false;
    if (word->kind != TN_WORD_NUMBER || word->value < 0) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_ARGUMENT, written->node.span,
                                     "how often something is repeated is a whole number");
        tn_help(check->diagnostics, d, "write `repeat(tray(...), 2..4)`");
        return false;
    }
    if (word->value > TN_REPEATED_MAX) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_TOO_MANY, written->node.span,
                                     "this is more often than the limit of %u times", TN_REPEATED_MAX);
        tn_help(check->diagnostics, d, "plans are shorter: `2..` is any number from two on");
        return false;
    }
    *number = (uint32_t)word->value;
    return true;
}

/* Fills least and most; false: reported. */
static bool read_times(tn_rule_expansion *expansion, const tn_ast_expr *written, tn_ast_expr *repeat)
{
    tn_diagnostics *diagnostics = expansion->check->diagnostics;
    bool range = written->kind == TN_EXPR_RANGE, open = range && written->parts.count == 1;
    const tn_ast_expr *low = range ? (const tn_ast_expr *)written->parts.first : written,
                      *high = range ? (const tn_ast_expr *)written->parts.last : written;
    if (!times(expansion, low, &repeat->least) || (!open && !times(expansion, high, &repeat->most)))
        return false;
    if (open || (repeat->most >= repeat->least && repeat->most > 0))
        return true;
    if (repeat->most > 0 || repeat->least > 0) {
        tn_diagnostic *d =
            tn_report(diagnostics, E_RANGE_BACKWARDS, written->node.span, "this range ends before it starts");
        tn_advise(diagnostics, d, "%u..%u", repeat->most, repeat->least);
        return false;
    }
    tn_diagnostic *d = tn_report(diagnostics, E_BAD_ARGUMENT, written->node.span, "this repeats nothing");
    tn_help(diagnostics, d, "write how often at least and at most: `1..3`");
    return false;
}

/* `repeat(a, 2..4)` */
static tn_ast_expr *expand_repeat(tn_rule_expansion *expansion, const tn_ast_expr *call)
{
    const tn_ast_expr *part = (const tn_ast_expr *)call->parts.first, *often = (const tn_ast_expr *)call->parts.last;
    if (call->parts.count != 2 || part->kind == TN_EXPR_RANGE) {
        report_repeat(expansion, call->node.span);
        return broken(expansion, call);
    }
    tn_ast_expr *made = shallow(expansion, call);
    if (!made)
        return NULL;
    made->kind = TN_EXPR_REPEAT;
    made->parts = tn_ast_one(expand(expansion, part));
    bool number = expansion->number;
    expansion->number = true;
    bool good = read_times(expansion, often, made);
    expansion->number = number;
    return good ? made : broken(expansion, call);
}

/* `values(f)`, `mirrored(f, g)`, `repeat(a, N)`: calls of what the language has itself. A rule with parameters of that
 * name hides it. */
static tn_ast_expr *expand_own_call(tn_rule_expansion *expansion, const tn_ast_expr *call)
{
    if (tn_word_is(call->name, "repeat"))
        return expand_repeat(expansion, call);
    bool values = tn_word_is(call->name, "values");
    tn_ast_expr *made = shallow(expansion, call);
    if (!made)
        return NULL;
    made->kind = values ? TN_EXPR_VALUES : TN_EXPR_MIRRORED;
    made->parts = made->names = tn_ast_empty();
    for (TN_EACH(const tn_ast_expr, argument, call->parts)) {
        tn_ast_word *field = field_of(expansion, call, argument);
        if (!field)
            return broken(expansion, call);
        made->names = tn_ast_append(made->names, field);
    }
    made->name = (const tn_ast_word *)made->names.first;
    if (!values || made->names.count == 1)
        return made;
    tn_check *check = expansion->check;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_BAD_ARGUMENT, call->node.span, "`values` counts the values of one field");
    tn_help(check->diagnostics, d, "add two of them up, or compare each");
    return broken(expansion, call);
}

static bool is_own_call(const tn_rule_expansion *expansion, const tn_ast_expr *call)
{
    const tn_checked_rule *rule = rule_named(expansion, call->name);
    bool own =
        tn_word_is(call->name, "values") || tn_word_is(call->name, "mirrored") || tn_word_is(call->name, "repeat");
    return call->kind == TN_EXPR_CALL && own && !(rule && rule->is_template);
}

/* Is a range one of the arguments? Then that is reported. */
static bool has_range(tn_rule_expansion *expansion, const tn_ast_expr *call)
{
    tn_diagnostics *diagnostics = expansion->check->diagnostics;
    for (TN_EACH(const tn_ast_expr, argument, call->parts)) {
        if (argument->kind != TN_EXPR_RANGE)
            continue;
        tn_diagnostic *d =
            tn_report(diagnostics, E_BAD_ARGUMENT, argument->node.span,
                      "a range is an argument of `repeat` alone, and this is a call of `%s`", call->name->text);
        tn_help(diagnostics, d, "a comparison takes a range: `quantity(...) in 2..4`");
        return true;
    }
    return false;
}

/* `name(...)` or `name` of a rule with parameters. */
static tn_ast_expr *expand_call(tn_rule_expansion *expansion, const tn_ast_expr *call)
{
    if (is_own_call(expansion, call))
        return expand_own_call(expansion, call);
    tn_check *check = expansion->check;
    size_t unit = check->unit;
    check->unit = call->unit ? call->unit - 1 : expansion->unit;
    const tn_checked_name *name =
        call->kind == TN_EXPR_CALL ? tn_check_call_name(check, call) : tn_check_name(check, call->name, TN_WANT_RULE);
    check->unit = unit;
    if (!name || !arguments_fit(expansion, call, name->rule, call->parts.count) || has_range(expansion, call))
        return broken(expansion, call);
    tn_ast_list arguments = expand_parts(expansion, call->parts);
    return name_of(expansion, call, instance(expansion, call, name->rule, arguments));
}

/* Is it a value of a field, or alternatives: words of a specifier? */
static bool is_word_value(const tn_rule_expansion *expansion, const tn_ast_expr *value)
{
    if (value->kind == TN_EXPR_NAME)
        return !rule_named(expansion, value->name);
    bool words = value->kind == TN_EXPR_OR || value->kind == TN_EXPR_NOT;
    for (TN_EACH(const tn_ast_expr, part, value->parts))
        words = words && (part->kind == TN_EXPR_NUMBER || is_word_value(expansion, part));
    return words;
}

static tn_ast_expr *expand_name(tn_rule_expansion *expansion, const tn_ast_expr *expr)
{
    tn_bound_name bound = tn_bound(expansion, expr->name);
    if (bound.let && !bound.value) /* it uses itself */
        return broken(expansion, expr);
    if (tn_refuse_words(expansion, bound, expr->node.span))
        return broken(expansion, expr);
    if (bound.value && expansion->number && bound.field && bound.field->ordered)
        return tn_place_expression(expansion, bound.field, bound.value);
    if (bound.value && (bound.value->kind == TN_EXPR_FIGURE || (bound.let && is_word_value(expansion, bound.value)))) {
        tn_check *check = expansion->check;
        tn_diagnostic *d = tn_report(check->diagnostics, E_RULE_OR_NUMBER, expr->node.span,
                                     "`%s` stands for values of a field", expr->name->text);
        tn_help(check->diagnostics, d, "write `tray(%s)`", expr->name->text);
        return broken(expansion, expr);
    }
    if (bound.value) {
        tn_rule_expansion none = {.check = expansion->check,
                                  .unit = expansion->unit,
                                  .older = expansion->older}; /* what is bound is written out already */
        return expand(&none, bound.value);
    }
    tn_checked_rule *rule = rule_named(expansion, expr->name);
    if (rule && rule->is_template)
        return expand_call(expansion, expr);
    if (rule && !rule->is_let && !rule->form && older_schema(expansion->check, rule->schema))
        return expand_call(expansion, expr);
    return shallow(expansion, expr);
}

/* `u - v <= 1` of values that a quantifier goes through: what is left of it is numbers, and so decided. false: it is
 * not. */
static bool decide_constants(tn_rule_expansion *expansion, tn_operator op, tn_ast_list parts, tn_ast_expr *made)
{
    tn_check *check = expansion->check;
    tn_ast_expr *left = (tn_ast_expr *)parts.first, *right = (tn_ast_expr *)parts.last;
    tn_sum_amount a, b, both;
    if (parts.count != 2 || !tn_is_constant(left) || !tn_is_constant(right) ||
        !tn_check_figure(check, NULL, left, &a) || !tn_check_figure(check, NULL, right, &b) || !a.value || !b.value)
        return false;
    if (!tn_same_power(check, a, left->node.span, b, right->node.span, "compared with", &both)) {
        made->kind = TN_EXPR_BROKEN;
        return true;
    }
    const char *more = tn_amount_apply(check, TN_EXPR_MINUS, a.value, b.value);
    if (!more)
        return false;
    made->kind = tn_decided(op, tn_amount_is_zero(more) ? 0 : *more == '-' ? -1 : 1);
    made->parts = tn_ast_empty();
    return true;
}

static tn_ast_expr *expand(tn_rule_expansion *expansion, const tn_ast_expr *expr)
{
    if (expr->rule && expr->rule->hidden) /* written out already */
        return shallow(expansion, expr);
    switch (expr->kind) {
    case TN_EXPR_NAME:
        return expand_name(expansion, expr);
    case TN_EXPR_CALL:
        return expand_call(expansion, expr);
    case TN_EXPR_SOME:
    case TN_EXPR_EACH:
        return expand_quantifier(expansion, expr);
    case TN_EXPR_COMPARE: {
        tn_ast_expr *decided = decide(expansion, expr);
        if (decided)
            return decided;
        break;
    }
    case TN_EXPR_FIGURE: {
        tn_bound_name bound = tn_bound(expansion, expr->name);
        if (!bound.value)
            break;
        if (tn_refuse_words(expansion, bound, expr->node.span))
            return broken(expansion, expr);
        if (bound.value->kind == TN_EXPR_NAME && !bound.let) { /* a field, for a parameter */
            tn_ast_expr *field = shallow(expansion, expr);
            if (field)
                field->name = bound.value->name;
            return field;
        }
        if (expr->detail)
            break;
        if (bound.field && bound.field->ordered)
            return tn_place_expression(expansion, bound.field, bound.value);
        tn_rule_expansion none = {.check = expansion->check, .unit = expansion->unit, .older = expansion->older};
        return expand(&none, bound.value);
    }
    default:
        break;
    }
    tn_ast_expr *copy = shallow(expansion, expr);
    if (!copy)
        return NULL;
    if (expr->kind != TN_EXPR_SECTION)
        copy->items = tn_expand_items(expansion, expr->items);
    copy->condition = expr->condition ? tn_expand_condition(expansion, expr->condition) : NULL;
    copy->figure = expr->figure ? expand(expansion, expr->figure) : NULL;
    bool number = expansion->number;
    expansion->number = tn_compares_numbers(expr->kind) || tn_is_arithmetic(expr->kind);
    tn_ast_list parts = expand_parts(expansion, expr->parts);
    expansion->number = number;
    if (expr->kind == TN_EXPR_COMPARE && expansion->bindings && decide_constants(expansion, expr->op, parts, copy))
        return copy;
    if (expr->kind == TN_EXPR_AND || expr->kind == TN_EXPR_OR)
        return joined(expansion, expr->kind, expr, parts);
    tn_ast_expr *decided = folded(copy, parts);
    if (decided)
        return decided;
    copy->parts = parts;
    return copy;
}

static void report_let_circle(tn_check *check, const tn_checked_rule *let)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_RULE_CYCLE, let->ast->name->node.span, "`%s %s` uses itself",
                                 let->param ? "param" : "let", let->name);
    tn_help(check->diagnostics, d, "write out what it means: constants, or values of a field");
}

/* One that uses itself means nothing, which is said once. */
tn_ast_expr *tn_let_value(tn_check *check, tn_checked_rule *let)
{
    enum { UNSEEN, OPEN, DONE };
    if (let->state == OPEN && !let->failed)
        report_let_circle(check, let);
    let->failed |= let->state == OPEN;
    if (let->state != UNSEEN)
        return let->meaning;
    let->state = OPEN;
    const tn_ast_rule *ast = let->ast;
    tn_rule_expansion expansion = {.check = check, .unit = ast->given ? ast->given_unit : let->unit};
    const tn_ast_expr *value = ast->given ? ast->given : ast->body;
    bool met = check->met_param;
    check->met_param = false;
    tn_ast_expr *meaning = ast->words.first ? shallow(&expansion, value) : expand(&expansion, value);
    let->meaning = let->failed ? broken(&expansion, value) : meaning;
    let->settable = let->param || check->met_param;
    check->met_param = met;
    let->state = DONE;
    return let->meaning;
}

void tn_expand(tn_check *check, tn_ast_expr **expr)
{
    tn_rule_expansion expansion = {.check = check, .unit = check->unit};
    if (!needs_expansion(&expansion, *expr))
        return;
    tn_ast_expr *made = expand(&expansion, *expr);
    if (made && !tn_arena_failed(check->arena)) /* parts of a copy may be missing */
        *expr = made;
}

tn_ast_expr *tn_expand_older(tn_check *check, const tn_ast_expr *written, size_t unit, const tn_checked_schema *older)
{
    tn_rule_expansion expansion = {.check = check, .unit = unit, .older = older};
    tn_ast_expr *made = expand(&expansion, written);
    return tn_arena_failed(check->arena) ? NULL : made; /* parts of a copy may be missing */
}

tn_checked_rule *tn_expand_older_measure(tn_check *check, tn_checked_rule *measure)
{
    tn_rule_expansion expansion = {.check = check, .unit = measure->unit};
    tn_ast_expr *place = TN_NEW(check->arena, tn_ast_expr);
    if (!place)
        return NULL;
    place->node.span = check->schema->ast->from->node.span;
    return instance(&expansion, place, measure, tn_ast_empty());
}
