/* Builds the rules of a .pcfg file, and explains lines that are none. */
#include "compiler/pcfg/ast.h"

#include <string.h>

tn_pcfg_alternative *tn_pcfg_alternative_new(tn_pcfg_reader *reader, tn_span span)
{
    tn_pcfg_alternative *alternative = TN_NEW(reader->arena, tn_pcfg_alternative);
    if (alternative)
        alternative->span = span;
    return alternative;
}

/* The span of an alternative that grows; an empty one begins with its first item. */
static void extend(tn_pcfg_alternative *alternative, tn_span span)
{
    bool empty = !alternative->first && !alternative->first_probability;
    alternative->span = empty ? span : tn_span_join(alternative->span, span);
}

tn_pcfg_alternative *tn_pcfg_add(tn_pcfg_reader *reader, tn_pcfg_alternative *alternative, tn_pcfg_kind kind,
                                 tn_span span, tn_pcfg_text text)
{
    tn_pcfg_item *item = TN_NEW(reader->arena, tn_pcfg_item);
    if (!item || !alternative)
        return alternative;
    if (kind == TN_PCFG_TERMINAL)
        text = (tn_pcfg_text){text.text + 1, text.length - 2};
    item->kind = kind;
    item->span = span;
    item->text = text;
    extend(alternative, span);
    TN_CHAIN(alternative, item);
    alternative->step_count++;
    return alternative;
}

/* Digits with at most one point among them, and one digit at least. */
static bool is_number(const char *text, size_t length)
{
    size_t digits = 0, points = 0;
    for (size_t i = 0; i < length; i++) {
        digits += text[i] >= '0' && text[i] <= '9';
        points += text[i] == '.';
    }
    return digits > 0 && points <= 1 && digits + points == length;
}

tn_pcfg_alternative *tn_pcfg_add_probability(tn_pcfg_reader *reader, tn_pcfg_alternative *alternative, tn_span span,
                                             tn_pcfg_text text)
{
    tn_diagnostics *list = reader->diagnostics;
    tn_pcfg_probability *probability = TN_NEW(reader->arena, tn_pcfg_probability);
    if (!probability || !alternative)
        return alternative;
    bool number = is_number(text.text + 1, text.length - 2);
    probability->span = span;
    probability->value = number ? tn_decimal_value(text.text + 1, text.length - 2) : 0;
    if (!number) {
        tn_diagnostic *d = tn_report(list, E_PLACE_PROBABILITY, span, "this is no probability");
        tn_help(list, d, "it is written in digits, with a point and no blanks: [.25]");
    } else if (probability->value > 1) {
        tn_report(list, E_PLACE_PROBABILITY, span, "a probability is at most 1");
        probability->value = 0;
    }
    extend(alternative, span);
    if (alternative->last_probability)
        alternative->last_probability->next = probability;
    else
        alternative->first_probability = probability;
    alternative->last_probability = probability;
    return alternative;
}

tn_pcfg_alternatives tn_pcfg_first(tn_pcfg_alternative *alternative)
{
    return (tn_pcfg_alternatives){alternative, alternative};
}

tn_pcfg_alternatives tn_pcfg_next(tn_pcfg_alternatives list, tn_pcfg_alternative *alternative)
{
    if (!list.last)
        return tn_pcfg_first(alternative);
    if (alternative)
        TN_CHAIN(&list, alternative);
    return list;
}

static tn_pcfg_lost lost(const tn_pcfg_reader *reader, const tn_pcfg_alternative *alternative,
                         const tn_pcfg_probability *probability)
{
    if (probability != alternative->last_probability)
        return TN_PCFG_LATER;
    if (alternative->next || probability->span.end == reader->line_end)
        return TN_PCFG_COUNTS;
    return probability->span.end == alternative->span.end ? TN_PCFG_BLANK : TN_PCFG_INSIDE;
}

/* ` [0]` is put behind every line that does not end in `]`, and the last probability of an alternative counts: so that
 * of a line's last alternative counts only where it ends the line. */
static void settle_probabilities(const tn_pcfg_reader *reader, const tn_pcfg_rule *rule)
{
    for (tn_pcfg_alternative *a = rule->alternatives.first; a; a = a->next) {
        for (tn_pcfg_probability *p = a->first_probability; p; p = p->next)
            p->lost = lost(reader, a, p);
        if (a->last_probability && a->last_probability->lost == TN_PCFG_COUNTS)
            a->probability = a->last_probability->value;
    }
}

void tn_pcfg_rule_new(tn_pcfg_reader *reader, tn_span name_span, tn_pcfg_text name, tn_span span,
                      tn_pcfg_alternatives list)
{
    tn_pcfg_rule *rule = TN_NEW(reader->arena, tn_pcfg_rule);
    (void)span;
    if (!rule)
        return;
    rule->name = name;
    rule->name_span = name_span;
    rule->alternatives = list;
    settle_probabilities(reader, rule);
    TN_CHAIN(&reader->ast, rule);
}

/* ---- what is no rule */

static void explain_stray(tn_pcfg_reader *reader, tn_span span, bool arrow)
{
    tn_diagnostics *list = reader->diagnostics;
    const char *text = reader->text + span.begin;
    tn_diagnostic *d;
    switch (*text) {
    case '#':
        d = tn_report(list, E_PLACE_SYNTAX, span, "a comment stands on a line of its own");
        tn_help(list, d, "put it on the line before");
        break;
    case '%':
        d = tn_report(list, E_PLACE_SYNTAX, span, "a connection grammar has no directives");
        tn_help(list, d, "the first rule is that of the start symbol");
        break;
    case '\\':
        d = tn_report(list, E_PLACE_SYNTAX, span, "a rule does not go on in the next line");
        tn_help(list, d, "write it on one line, or give the symbol a second rule");
        break;
    case '\'':
    case '"':
        if (span.end - span.begin == 2) {
            d = tn_report(list, E_PLACE_TERMINAL, span, "a terminal without a step");
            tn_help(list, d, "an alternative that does nothing is left empty");
            break;
        }
        d = tn_report(list, E_UNTERMINATED_STRING, span, "this quote has no partner on its line");
        tn_help(list, d, "a terminal is written between two quotes, with something in it: 'Move(0,3,0)'");
        break;
    case '[':
        d = tn_report(list, E_PLACE_PROBABILITY, span, "this bracket is not closed");
        tn_help(list, d, "a probability is written [.25]");
        break;
    default:
        d = tn_report(list, E_STRAY_CHARACTER, span, "no token starts with this character");
        tn_help(list, d,
                arrow ? "a rule is written: Symbol -> 'Move(0,3,0)' Other"
                      : "steps stand between quotes: 'Move(0,3,0)'");
        break;
    }
}

void tn_pcfg_unexpected(tn_pcfg_reader *reader, tn_span span, const char *token, bool arrow)
{
    tn_diagnostics *list = reader->diagnostics;
    if (strcmp(token, "a stray character") == 0) {
        explain_stray(reader, span, arrow);
        return;
    }
    tn_diagnostic *d = tn_report(list, E_PLACE_SYNTAX, span, "%s stands where %s", token,
                                 arrow ? "a `->` should" : "no rule can have it");
    const char *text = reader->text;
    uint32_t name = span.begin;
    while (name > 0 && (text[name - 1] == ' ' || text[name - 1] == '\t'))
        name--;
    bool joined = arrow && name >= 2 && text[name - 2] == '-' && text[name - 1] == '>';
    if (joined)
        tn_help(list, d, "put a blank before `->`: without it, it is part of the symbol's name");
    else
        tn_help(list, d, "a rule is written: Symbol -> 'Move(0,3,0)' Other");
}
