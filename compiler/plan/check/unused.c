/* Warns about rules of a file with libraries that nothing uses: no library prunes, requires or calls them, and no
 * measure counts them. */
#include <stdio.h>
#include <string.h>

#include "compiler/plan/check/check.h"

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

static void warn(tn_check *check, const unused_rules *unused)
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
    warn(check, &unused);
}
