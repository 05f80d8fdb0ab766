/* Rules that are legal, but hardly say what was meant. */
#include <stdio.h>
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/check.h"

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

static bool lets_all_in(const tn_checked_spec *spec, uint32_t field)
{
    const tn_checked_field *f = &spec->schema->fields[field];
    bool all = true;
    for (uint32_t bit = f->first_bit; bit < f->first_bit + f->value_count; bit++)
        all = all && spec->mask[bit / 64] >> (bit % 64) & 1;
    return all;
}

/* Do both ask for one field? In one specifier that would be asking twice. */
static bool share_field(const tn_checked_spec *a, const tn_checked_spec *b)
{
    for (uint32_t f = 0; f < a->schema->field_count; f++)
        if (!lets_all_in(a, f) && !lets_all_in(b, f))
            return true;
    return false;
}

/* ---- the author's own words, for fixes */

typedef struct words {
    const char *text;
    size_t size;
} words;

/* The source from one place to another, without the blanks at its ends. */
static words words_between(const tn_check *check, uint32_t file, uint32_t begin, uint32_t end)
{
    const char *text = check->diagnostics->sources->files[file].text;
    while (begin < end && strchr(" \t\r\n", text[begin]))
        begin++;
    while (end > begin && strchr(" \t\r\n", text[end - 1]))
        end--;
    return (words){text + begin, end - begin};
}

/* What stands inside `tray(...)` or `many(...)`; nothing where it does not fit into a line. */
static words inside_call(const tn_check *check, const tn_ast_expr *call)
{
    tn_span span = call->node.span;
    words all = words_between(check, span.file, span.begin, span.end);
    const char *open = memchr(all.text, '(', all.size);
    if (!open || all.text[all.size - 1] != ')' || memchr(all.text, '\n', all.size))
        return (words){0};
    uint32_t begin = span.begin + (uint32_t)(open + 1 - all.text);
    return words_between(check, span.file, begin, span.begin + (uint32_t)all.size - 1);
}

static bool is_word(words w, const char *word)
{
    return w.size == strlen(word) && strncmp(w.text, word, w.size) == 0;
}

/* ---- warnings */

/* `tray(a) and tray(b)`: one specifier for both, where the two stand side by side. */
static void help_two_trays(tn_check *check, tn_diagnostic *d, const tn_ast_expr *first, const tn_ast_expr *second)
{
    words between = words_between(check, first->node.span.file, first->node.span.end, second->node.span.begin);
    words a = inside_call(check, first), b = inside_call(check, second);
    if (share_field(first->spec, second->spec)) {
        tn_help(check->diagnostics, d, "for one tray that is both write one specifier, which asks for each field once");
        return;
    }
    if (!is_word(between, "and") || !a.size || !b.size) {
        tn_help(check->diagnostics, d, "for one tray that is both write one specifier: `tray(..., ...)`");
        return;
    }
    tn_help(check->diagnostics, d, "for one tray that is both write one specifier: `tray(%.*s, %.*s)`", (int)a.size,
            a.text, (int)b.size, b.text);
    tn_replace_with(check->diagnostics, d, "tray(%.*s, %.*s)", (int)a.size, a.text, (int)b.size, b.text);
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
        help_two_trays(check, d, first, part);
        return;
    }
}

static void warn_not_tray(tn_check *check, const tn_ast_expr *part)
{
    if (!tn_check_wanted(check, W_NOT_TRAY_PART))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, W_NOT_TRAY_PART, part->node.span,
                                 "this part fits any number of trays, none of which is like that");
    const tn_ast_expr *tray = (const tn_ast_expr *)part->parts.first;
    words inside = inside_call(check, tray);
    words before = words_between(check, part->node.span.file, part->node.span.begin, tray->node.span.begin);
    bool one = inside.size && !memchr(inside.text, ' ', inside.size) && !memchr(inside.text, ',', inside.size);
    if (!one || !is_word(before, "not") || part->node.span.end != tray->node.span.end) {
        tn_help(check->diagnostics, d, "for one tray that is not like that, put the `not` inside: `tray(not 8')`");
        return;
    }
    tn_help(check->diagnostics, d, "for one tray that is not like that, put the `not` inside: `tray(not %.*s)`",
            (int)inside.size, inside.text);
    tn_replace_with(check->diagnostics, d, "tray(not %.*s)", (int)inside.size, inside.text);
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
    words inside = expr->kind == TN_EXPR_MANY ? inside_call(check, expr) : (words){0};
    tn_span keyword = expr->node.span;
    if (!inside.size)
        keyword.end = keyword.begin + (uint32_t)strlen(what);
    tn_diagnostic *d = tn_report(check->diagnostics, W_NEVER_ONE_TRAY, keyword,
                                 "`%s` looks at single trays, and its part takes %u or more", what, (unsigned)trays);
    if (inside.size) {
        tn_help(check->diagnostics, d, "stretches of several trays side by side are `repeat(%.*s, 1..)`",
                (int)inside.size, inside.text);
        tn_replace_with(check->diagnostics, d, "repeat(%.*s, 1..)", (int)inside.size, inside.text);
    } else if (expr->kind == TN_EXPR_QUANTITY) {
        tn_help(check->diagnostics, d, "did you mean `occurrences`, which counts the places where it starts?");
        tn_replace_with(check->diagnostics, d, "occurrences");
    } else {
        tn_help(check->diagnostics, d, "name what a single tray has to be");
    }
}

/* `every(tray(cafe), beside(tray(cafe), tray(hall)))`: what takes two trays is asked of each single one, so that there
 * may be none at all. */
static void warn_every(tn_check *check, const tn_ast_expr *every)
{
    const tn_ast_expr *part = (const tn_ast_expr *)every->parts.first, *asked = NULL;
    for (TN_EACH(const tn_ast_expr, other, every->parts))
        asked = other == part ? asked : other;
    uint32_t trays = asked ? tn_min_trays(asked) : 1;
    if (trays < 2 || !tn_check_wanted(check, W_EVERY_NEVER))
        return;
    tn_span keyword = every->node.span;
    keyword.end = keyword.begin + (uint32_t)strlen("every");
    tn_diagnostic *d = tn_report(check->diagnostics, W_EVERY_NEVER, keyword,
                                 "this says that there is none: `every` asks of each single tray what takes %u or more",
                                 (unsigned)trays);
    tn_help(check->diagnostics, d,
            "what stands beside each, or near it, is asked by `every A beside B`, `every A within 2 of B`");
}

/* The tray as a plan of its own. */
static void say_tray(const tn_checked_schema *schema, const uint8_t *values, char *text, size_t size)
{
    size_t used = 0;
    *text = '\0';
    for (uint32_t f = 0; f < schema->field_count && used < size; f++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", f ? " " : "",
                                 schema->fields[f].values[values[f]].spelling);
}

/* `every tray(cafe) within 12m of tray(public)`, and a café may be public: it is not near itself. */
static void warn_near(tn_check *check, const tn_ast_expr *near)
{
    const tn_ast_expr *a = (const tn_ast_expr *)near->parts.first, *b = (const tn_ast_expr *)a->node.next;
    uint8_t values[TN_FIELDS_MAX];
    bool trays = b && a->kind == TN_EXPR_TRAY && b->kind == TN_EXPR_TRAY && a->spec && b->spec && !a->tests.first &&
                 !b->tests.first && !a->spec->broken && !b->spec->broken;
    if (!trays || a->spec == b->spec || !tn_check_wanted(check, W_NEAR_ITSELF) ||
        !tn_check_both(check, a->spec, b->spec, values))
        return;
    char line[200];
    say_tray(a->spec->schema, values, line, sizeof line);
    bool far = near->near == TN_NEAR_APART, every = near->kind == TN_EXPR_EVERY_NEAR;
    tn_diagnostic *d = tn_report(check->diagnostics, W_NEAR_ITSELF, near->node.span,
                                 "a tray may be both, and is then not near itself: the plan `%s` %s this", line,
                                 far ? "matches" : "does not match");
    tn_help(check->diagnostics, d, "%s",
            every && !far
                ? "if that is not meant, ask it of those alone that are not both: `tray(..., not ...)`; else write "
                  "`allow W022`"
                : "if that is not meant, say what a tray that is both is to be; else write `allow W022`");
}

static bool is_number_of_stretch(const tn_ast_expr *expr)
{
    bool more = expr->op == TN_AT_LEAST || expr->op == TN_GREATER;
    return (expr->kind == TN_EXPR_COMPARE && more && !expr->whole) || expr->kind == TN_EXPR_QUANTITY ||
           expr->kind == TN_EXPR_SUM;
}

/* The specifier of the trays that a number counts or adds up; NULL: all of them, or it is no specifier. */
static const tn_checked_spec *counted_by(const tn_ast_expr *number)
{
    const tn_ast_expr *sum = number->kind == TN_EXPR_COMPARE ? (const tn_ast_expr *)number->parts.first : number;
    const tn_ast_expr *of = (const tn_ast_expr *)sum->parts.first;
    bool counts = sum->kind == TN_EXPR_QUANTITY || sum->kind == TN_EXPR_SUM;
    return counts && of && of->kind == TN_EXPR_TRAY && !of->tests.first ? of->spec : NULL;
}

/* Is there a plan that tells "nowhere such a tray" from "a stretch without one"? It has what is counted without being
 * such a tray, as often as needed, and such a tray behind that. */
static bool is_told_apart(tn_check *check, const tn_ast_expr *number, const tn_ast_expr *tray)
{
    uint8_t values[TN_FIELDS_MAX];
    const tn_checked_spec *such = tray->spec, *counted = counted_by(number);
    if (!such || such->broken || tray->tests.first || (counted && counted->broken))
        return false;
    return tn_check_both(check, such, such, values) && tn_check_one_alone(check, counted, such, values);
}

/* `sum(beds) > 2 and not tray(firedoor)` as a rule: in the whole plan there is no such tray. Whoever means a stretch
 * without one says so by `where`. */
static void warn_and_not(tn_check *check, const tn_ast_expr *conjunction)
{
    const tn_ast_expr *number = (const tn_ast_expr *)conjunction->parts.first,
                      *not = (const tn_ast_expr *)conjunction->parts.last;
    const tn_ast_expr *tray = (const tn_ast_expr *)not ->parts.first;
    if (!check->rule || check->rule->ast->body != conjunction || conjunction->parts.count != 2 ||
        not ->kind != TN_EXPR_NOT || tray->kind != TN_EXPR_TRAY || !is_number_of_stretch(number) ||
        !tn_check_wanted(check, W_NOT_IN_STRETCH) || !is_told_apart(check, number, tray))
        return;
    tn_span a = not ->node.span, b = number->node.span;
    words none = words_between(check, a.file, a.begin, a.end), count = words_between(check, b.file, b.begin, b.end);
    tn_diagnostic *d = tn_report(check->diagnostics, W_NOT_IN_STRETCH, conjunction->node.span,
                                 "this is about the whole plan: there is no such tray anywhere in it");
    if (!memchr(none.text, '\n', none.size) && !memchr(count.text, '\n', count.size)) {
        tn_help(check->diagnostics, d, "a stretch without one is `%.*s where %.*s`", (int)none.size, none.text,
                (int)count.size, count.text);
        tn_replace_with(check->diagnostics, d, "%.*s where %.*s", (int)none.size, none.text, (int)count.size,
                        count.text);
    } else {
        tn_help(check->diagnostics, d, "a stretch without one is `not ... where ...`");
    }
}

/* `somewhere`: is the expression about the plan (judgement H), where the parts of an `and` need not be met in one
 * place? */
static void warn(tn_check *check, const tn_ast_expr *expr, bool somewhere)
{
    switch (expr->kind) {
    case TN_EXPR_AND:
        if (somewhere)
            warn_two_trays(check, expr);
        warn_and_not(check, expr);
        break;
    case TN_EXPR_NEAR:
    case TN_EXPR_EVERY_NEAR:
        warn_near(check, expr);
        somewhere = false;
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
    case TN_EXPR_EVERY:
        warn_every(check, expr);
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

void tn_check_weight_warnings(tn_check *check, const tn_ast_expr *quantity)
{
    const tn_ast_expr *part = (const tn_ast_expr *)quantity->parts.first;
    uint32_t trays = tn_min_trays(part);
    warn(check, part, false);
    if (trays < 2 || !tn_check_wanted(check, W_NEVER_ONE_TRAY))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, W_NEVER_ONE_TRAY, part->node.span,
                                 "a weight looks at single trays, and this takes %u or more", (unsigned)trays);
    tn_help(check->diagnostics, d,
            "name what a single tray has to be; one that stands beside another is `tray(...) beside tray(...)`");
}

void tn_check_warnings(tn_check *check, const tn_ast_expr *expr)
{
    warn(check, expr, true);
}

/* ---- rules of a file with libraries that nothing uses: no library prunes, requires or calls them, and no measure
 * counts them */

/* Marks what the rule names, and what that names. Recursion is as deep as rules name each other, which have an order;
 * a rule is entered once. */
static void mark(tn_checked_rule *rule)
{
    if (rule->seen)
        return;
    rule->seen = rule->used = true;
    if (rule->of)
        rule->of->used = true;
    for (size_t i = 0; i < rule->use_count; i++)
        mark(rule->uses[i]);
}

/* Says the rule that it is for others? Then so is what it names. */
static bool is_meant(tn_check *check, const tn_checked_rule *rule)
{
    check->allow = rule->ast->allow;
    return !tn_check_wanted(check, W_UNUSED_RULE);
}

/* The rules that nothing uses. */
typedef struct unused_rules {
    const tn_checked_rule *first;
    size_t count;
    char names[240]; /* of those after the first, as many as there is room for */
    size_t named;
} unused_rules;

static void add(tn_check *check, unused_rules *unused, const tn_checked_rule *rule)
{
    if (rule->used || is_meant(check, rule))
        return;
    size_t used = strlen(unused->names), size = strlen(rule->name) + sizeof ", ``";
    if (unused->count++ == 0) {
        unused->first = rule;
    } else if (unused->named + 2 == unused->count && used + size < sizeof unused->names) {
        snprintf(unused->names + used, sizeof unused->names - used, "%s`%s`", used ? ", " : "", rule->name);
        unused->named++;
    }
}

static void warn_of_unused(tn_check *check, const unused_rules *unused)
{
    const tn_checked_rule *first = unused->first;
    if (!first)
        return;
    size_t others = unused->count - 1, more = others - unused->named;
    tn_diagnostic *d = tn_report(check->diagnostics, W_UNUSED_RULE, first->ast->name->node.span,
                                 "no library of this file prunes, requires or calls `%s`", first->name);
    if (more > 0)
        tn_note(check->diagnostics, d, NULL, "nor %s and %zu more", unused->names, more);
    else if (others > 0)
        tn_note(check->diagnostics, d, NULL, "nor %s", unused->names);
    tn_help(check->diagnostics, d,
            "write `prune %s` or `require %s` in a library; a rule that is meant for others has `allow W019` before "
            "its `=`",
            first->name, first->name);
}

void tn_check_unused(tn_check *check)
{
    const tn_checked *result = check->result;
    size_t own = check->imports->count - 1;
    bool library = false;
    unused_rules unused = {0};
    for (size_t i = 0; i < result->library_count; i++)
        library |= result->libraries[i]->unit == own;
    if (!library || check->diagnostics->error_count > 0)
        return;
    for (size_t i = 0; i < result->rule_count; i++)
        if (result->rules[i]->used || result->rules[i]->is_measure || is_meant(check, result->rules[i]))
            mark(result->rules[i]);
    for (size_t i = 0; i < result->rule_count; i++)
        if (result->rules[i]->unit == own && !result->rules[i]->hidden && !result->rules[i]->is_measure)
            add(check, &unused, result->rules[i]);
    for (size_t i = 0; i < check->template_count; i++)
        if (check->templates[i]->unit == own && !check->templates[i]->is_measure)
            add(check, &unused, check->templates[i]);
    warn_of_unused(check, &unused);
}
