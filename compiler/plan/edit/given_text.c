#include "compiler/plan/edit/given_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/buffer.h"

/* What stands before and behind the text in the rule that it is tried in, and what it is called. */
static const struct {
    const char *before, *behind, *what;
} tried[] = {[TN_GIVEN_PART] = {"rule x = ", "", "a part of a rule, such as `tray()` or the name of a rule"},
             [TN_GIVEN_ITEM] = {"rule x = tray(", ")", "one item of a tray, such as a value of one of its fields"},
             [TN_GIVEN_CONDITION] = {"rule x = quantity(any, ", ")", "a condition, such as `n >= 2`"},
             [TN_GIVEN_NAME] = {"rule ", " = any", "a name, such as `wide-hall`"}};

/* Is the rule that it was tried in all that was read, and is it what was meant? */
static bool is_meant(tn_given_kind kind, const tn_rule_text *text, const tn_ast_rule *rule)
{
    const tn_ast_expr *body = rule->body;
    size_t end = text->size;
    while (end > 0 && strchr(" \t\r\n", text->text[end - 1]))
        end--;
    bool alone = rule->top.node.span.end == end && rule->params.count == 0 && !rule->doc && !rule->using &&
                 rule->allow.count == 0;
    switch (kind) {
    case TN_GIVEN_ITEM:
        return alone && body->kind == TN_EXPR_TRAY && body->items.count == 1;
    case TN_GIVEN_CONDITION:
        return alone && body->kind == TN_EXPR_QUANTITY && body->condition;
    default:
        return alone;
    }
}

static void judge(tn_given_kind kind, const char *given, const tn_rule_text *text, tn_binding *binds, char *why)
{
    const tn_ast_top *item = text->tree ? (const tn_ast_top *)text->tree->items.first : NULL;
    const tn_ast_rule *rule = item && item->kind == TN_ITEM_RULE ? (const tn_ast_rule *)item : NULL;
    bool good = text->parses && text->tree->items.count == 1 && rule && rule->body && text->comment_count == 0 &&
                is_meant(kind, text, rule);
    if (good)
        *binds = tn_expr_binds(rule->body);
    else if (text->comment_count > 0)
        snprintf(why, TN_WHY_MAX, "`%.100s` has a comment, and what is put into a rule has none", given);
    else
        snprintf(why, TN_WHY_MAX, "%s%.100s%s is not %s%s%.150s", *given ? "`" : "an empty text", given,
                 *given ? "`" : "", tried[kind].what, text->mistake ? ": " : "", text->mistake ? text->mistake : "");
}

tn_status tn_given_text_check(tn_given_kind kind, const char *text, tn_binding *binds, char why[TN_WHY_MAX],
                              tn_error *error)
{
    tn_rule_text read = {0};
    tn_buffer rule = {0};
    *why = '\0';
    *binds = TN_BINDS_PRIMARY;
    if (kind == TN_GIVEN_PART && strcmp(text, "...") == 0) /* only in a row, which the changed rule is asked about */
        return TN_OK;
    if (strlen(text) > TN_GIVEN_TEXT_MAX)
        return tn_fail(error, TN_LIMIT, E_USAGE, "the text is longer than %u bytes", TN_GIVEN_TEXT_MAX);
    tn_buffer_printf(&rule, "%s", tried[kind].before);
    tn_buffer_append(&rule, text, strlen(text));
    tn_buffer_printf(&rule, "%s", tried[kind].behind);
    tn_status status = rule.failed ? tn_fail_memory(error) : tn_rule_text_read(rule.data, rule.size, &read, error);
    if (status == TN_OK)
        judge(kind, text, &read, binds, why);
    tn_rule_text_clear(&read);
    free(rule.data);
    return status;
}
