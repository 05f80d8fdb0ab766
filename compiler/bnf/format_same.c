/* Compares two grammars, so that a file that was laid out anew is known to say the same. */
#include <string.h>

#include "compiler/bnf/check.h"
#include "compiler/bnf/format.h"

static bool same_text(tn_bnf_text one, tn_bnf_text other)
{
    return one.length == other.length && (one.length == 0 || memcmp(one.text, other.text, one.length) == 0);
}

/* As deep as groups nest. */
static bool same_items(tn_bnf_items one, tn_bnf_items other)
{
    const tn_bnf_item *a = one.first, *b = other.first;
    for (; a && b; a = a->next, b = b->next)
        if (a->kind != b->kind || a->letter != b->letter || !same_text(a->text, b->text) ||
            !same_items(a->body, b->body))
            return false;
    return !a && !b;
}

static bool same_rule(const tn_bnf_rule *one, const tn_bnf_rule *other)
{
    const tn_bnf_alternative *a = one->alternatives.first, *b = other->alternatives.first;
    if (!same_text(one->name, other->name) || one->broken != other->broken)
        return false;
    for (; a && b; a = a->next, b = b->next)
        if (!same_items(a->items, b->items))
            return false;
    return !a && !b;
}

static bool same_settings(const tn_bnf_file *one, const tn_bnf_file *other)
{
    return one->dialect == other->dialect && one->says_dialect == other->says_dialect && one->repair == other->repair &&
           one->says_repair == other->says_repair && one->skip_single == other->skip_single &&
           one->says_max_depth == other->says_max_depth && one->max_depth == other->max_depth &&
           one->says_wraps == other->says_wraps && one->wraps == other->wraps;
}

/* What is wrong with terminals is no business of the formatter's. */
static bool make_terminals(tn_bnf_reader *reader)
{
    tn_diagnostics scratch;
    tn_bnf_grammar grammar = {.reader = reader};
    tn_diagnostics_init(&scratch, reader->diagnostics->sources);
    reader->diagnostics = &scratch;
    bool made = tn_bnf_collect_rules(&grammar);
    if (made)
        tn_bnf_make_terminals(&grammar);
    tn_diagnostics_clear(&scratch);
    return made && !tn_arena_failed(reader->arena);
}

bool tn_format_bnf_same(tn_bnf_reader *one, tn_bnf_reader *other)
{
    if (!make_terminals(one) || !make_terminals(other) || !same_settings(&one->ast, &other->ast))
        return false;
    const tn_bnf_rule *a = one->ast.first, *b = other->ast.first;
    for (; a && b; a = a->next, b = b->next)
        if (!same_rule(a, b))
            return false;
    return !a && !b;
}
