#include "compiler/plan/edit/rule_layout.h"

#include <stdlib.h>
#include <string.h>

#include "compiler/format.h"

/* The text as it is laid out (malloc); *laid_out is NULL if it cannot be. TN_MEMORY. */
static tn_status lay_out(const char *text, size_t size, char **laid_out, size_t *laid_size, tn_error *error)
{
    tn_sources sources = {0};
    tn_diagnostics said;
    *laid_out = NULL;
    tn_diagnostics_init(&said, &sources);
    tn_status status = tn_format_text(&said, TN_NOTATION(plan), "rule.plan", text, size, laid_out, laid_size);
    tn_diagnostics_clear(&said);
    tn_sources_clear(&sources);
    return status == TN_MEMORY ? tn_fail_memory(error) : TN_OK;
}

/* Where the rule stands in a text; empty if it does not. */
static tn_status find(const char *text, size_t size, const char *rule, tn_span *place, tn_error *error)
{
    tn_rule_text read = {0};
    *place = (tn_span){0};
    tn_status status = tn_rule_text_read(text, size, &read, error);
    const tn_ast_rule *found = status == TN_OK ? tn_rule_text_find(&read, rule) : NULL;
    if (found)
        *place = found->top.node.span;
    tn_rule_text_clear(&read);
    return status;
}

/* The rule as it is laid out, alone: what stands around it takes no part in that (malloc); NULL if it cannot be. */
static tn_status lay_out_rule(const char *text, tn_span place, const char *rule, char **laid_out, tn_span *there,
                              tn_error *error)
{
    size_t size = 0;
    *there = (tn_span){0};
    tn_status status = lay_out(text + place.begin, place.end - place.begin, laid_out, &size, error);
    if (status == TN_OK && *laid_out)
        status = find(*laid_out, size, rule, there, error);
    return status;
}

/* The next byte, or -1: the carriage returns of lines that end with them are left out when they are laid out. */
static int next_byte(const char *text, tn_span *left)
{
    while (left->begin < left->end && text[left->begin] == '\r')
        left->begin++;
    return left->begin < left->end ? (unsigned char)text[left->begin++] : -1;
}

static bool same(const char *a, tn_span x, const char *b, tn_span y)
{
    int byte;
    if (x.begin == x.end || y.begin == y.end)
        return false;
    while ((byte = next_byte(a, &x)) == next_byte(b, &y))
        if (byte < 0)
            return true;
    return false;
}

/* *was: it stands as it is laid out. */
static tn_status was_laid_out(const char *text, size_t size, const char *rule, bool *was, tn_error *error)
{
    char *laid_out = NULL;
    tn_span here, there;
    *was = false;
    tn_status status = find(text, size, rule, &here, error);
    if (status == TN_OK && here.end > here.begin)
        status = lay_out_rule(text, here, rule, &laid_out, &there, error);
    *was = status == TN_OK && laid_out && same(text, here, laid_out, there);
    free(laid_out);
    return status;
}

/* Puts the rule as it stands in one text into another. */
static tn_status replace(const char *laid_out, tn_span there, tn_buffer *changed, tn_span here, tn_error *error)
{
    tn_buffer made = {0};
    tn_buffer_append(&made, changed->data, here.begin);
    tn_buffer_append(&made, laid_out + there.begin, there.end - there.begin);
    tn_buffer_append(&made, changed->data + here.end, changed->size - here.end);
    free(changed->data);
    *changed = made;
    return made.failed ? tn_fail_memory(error) : TN_OK;
}

tn_status tn_rule_lay_out(const char *old, size_t old_size, const char *rule, tn_buffer *changed, tn_error *error)
{
    char *laid_out = NULL;
    tn_span here, there;
    bool was;
    tn_status status = was_laid_out(old, old_size, rule, &was, error);
    if (status != TN_OK || !was)
        return status;
    status = find(changed->data, changed->size, rule, &here, error);
    if (status == TN_OK && here.end > here.begin)
        status = lay_out_rule(changed->data, here, rule, &laid_out, &there, error);
    if (status == TN_OK && laid_out && there.end > there.begin)
        status = replace(laid_out, there, changed, here, error);
    free(laid_out);
    return status;
}
