/* Lays out .pcfg files, which are lines of tokens. */
#include "compiler/pcfg/format.h"

#include <string.h>

static size_t one_blank(const tn_format *format, size_t i)
{
    (void)format, (void)i;
    return 1;
}

/* Does a blank follow the token on its line? Tokens are followed by the line's end or by the text's two zero bytes. */
static bool has_blank(const tn_format_token *token)
{
    return strchr(" \t\f\v", token->text[token->size]) && token->text[token->size];
}

void tn_format_pcfg(tn_format *format)
{
    format->gap_before = one_blank;
    for (size_t first = 0, last; first < format->count; first = last) {
        for (last = first + 1; last < format->count && !format->tokens[last].line_ends;)
            last++;
        tn_format_gap(format, first, 0, false);
        tn_format_flat(format, first, last);
        const tn_format_token *end = &format->tokens[last - 1];
        if (end->kind == TN_TOKEN_NUMBER && has_blank(end))
            tn_layout_put(&format->layout, " [0]", 4);
    }
    tn_format_gap(format, format->count, 0, false);
}

static bool same_text(tn_pcfg_text one, tn_pcfg_text other)
{
    return one.length == other.length && memcmp(one.text, other.text, one.length) == 0;
}

static bool same_alternative(const tn_pcfg_alternative *one, const tn_pcfg_alternative *other)
{
    const tn_pcfg_item *a = one->first, *b = other->first;
    for (; a && b; a = a->next, b = b->next)
        if (a->kind != b->kind || !same_text(a->text, b->text))
            return false;
    return !a && !b && one->probability == other->probability;
}

static bool same_rule(const tn_pcfg_rule *one, const tn_pcfg_rule *other)
{
    const tn_pcfg_alternative *a = one->alternatives.first, *b = other->alternatives.first;
    for (; a && b; a = a->next, b = b->next)
        if (!same_alternative(a, b))
            return false;
    return !a && !b && same_text(one->name, other->name);
}

bool tn_format_pcfg_same(const tn_pcfg_reader *one, const tn_pcfg_reader *other)
{
    const tn_pcfg_rule *a = one->ast.first, *b = other->ast.first;
    for (; a && b; a = a->next, b = b->next)
        if (!same_rule(a, b))
            return false;
    return !a && !b;
}
