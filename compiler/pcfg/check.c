/* Checks a connection grammar: symbols, terminals, probabilities, what can be reached. */
#include "compiler/pcfg/check.h"

#include <string.h>

#include "compiler/pcfg/terminal.h"

/* ---- symbols */

static tn_pcfg_symbol *symbol_named(tn_pcfg_grammar *g, const tn_pcfg_rule *rule)
{
    char *name = tn_arena_copy(g->arena, rule->name.text, rule->name.length);
    tn_pcfg_symbol *symbol = name ? tn_names_get(&g->names, name) : NULL;
    if (symbol || !name)
        return symbol;
    symbol = TN_NEW(g->arena, tn_pcfg_symbol);
    if (!symbol)
        return NULL;
    symbol->name = name;
    symbol->span = rule->name_span;
    symbol->index = g->count;
    g->symbols[g->count++] = symbol;
    tn_names_put(&g->names, name, symbol);
    if (rule->name.length > TN_NAME_MAX)
        tn_report(g->diagnostics, E_NAME_TOO_LONG, rule->name_span, "a name of %zu bytes; the limit is %u",
                  rule->name.length, TN_NAME_MAX);
    return symbol;
}

/* The alternatives of all lines of a symbol, in their order. */
static void collect(tn_pcfg_grammar *g, const tn_pcfg_file *file)
{
    size_t rules = 0;
    for (const tn_pcfg_rule *rule = file->first; rule; rule = rule->next)
        rules++;
    g->names.arena = g->arena;
    g->symbols = TN_NEW_ARRAY(g->arena, tn_pcfg_symbol *, rules + 1);
    for (const tn_pcfg_rule *rule = file->first; g->symbols && rule; rule = rule->next) {
        tn_pcfg_symbol *symbol = symbol_named(g, rule);
        if (!symbol)
            return;
        if (symbol->alternatives.last)
            symbol->alternatives.last->next = rule->alternatives.first;
        else
            symbol->alternatives.first = rule->alternatives.first;
        symbol->alternatives.last = rule->alternatives.last;
        for (const tn_pcfg_alternative *a = rule->alternatives.first; a; a = a->next)
            symbol->count++;
    }
}

static void read_items(tn_pcfg_grammar *g, tn_pcfg_alternative *alternative)
{
    for (tn_pcfg_item *item = alternative->first; item; item = item->next) {
        if (item->kind == TN_PCFG_TERMINAL) {
            tn_pcfg_read_terminal(g->arena, g->diagnostics, item);
            continue;
        }
        char *name = tn_arena_copy(g->arena, item->text.text, item->text.length);
        const tn_pcfg_symbol *symbol = name ? tn_names_get(&g->names, name) : NULL;
        item->unknown = !symbol;
        item->step.kind = TN_STEP_EXPAND;
        item->step.index = symbol ? symbol->index : 0;
    }
}

/* ---- what can be reached */

static void reach(tn_pcfg_grammar *g)
{
    uint32_t *pending = TN_NEW_ARRAY(g->arena, uint32_t, g->count + 1), count = 0;
    if (!pending)
        return;
    g->symbols[0]->reached = true;
    pending[count++] = 0;
    while (count > 0) {
        const tn_pcfg_symbol *symbol = g->symbols[pending[--count]];
        for (const tn_pcfg_alternative *a = symbol->alternatives.first; a; a = a->next) {
            for (const tn_pcfg_item *item = a->first; item; item = item->next) {
                if (item->kind != TN_PCFG_NAME || item->unknown || tn_pcfg_symbol_of(g, item)->reached)
                    continue;
                tn_pcfg_symbol_of(g, item)->reached = true;
                pending[count++] = item->step.index;
            }
        }
    }
}

static bool is_epsilon(tn_pcfg_text text)
{
    return text.length == 2 && (memcmp(text.text, "\xc9\x9b", 2) == 0 || memcmp(text.text, "\xce\xb5", 2) == 0);
}

/* A note instead of what the code says. */
static void soften(tn_diagnostics *list, tn_diagnostic *diagnostic)
{
    if (diagnostic->severity == TN_WARNING)
        list->warning_count--;
    diagnostic->severity = TN_NOTE;
}

/* In an editor, a file may be a part of a grammar. */
static void report_unknown(tn_pcfg_grammar *g, const tn_pcfg_item *item, bool reached)
{
    enum { NAMES_MAX = 1000 };
    tn_diagnostics *list = g->diagnostics;
    bool error = reached && !g->partial;
    tn_diagnostic *d = tn_report(list, error ? E_PLACE_UNDEFINED : W_PLACE_NO_RULE, item->span,
                                 g->partial ? "%.*s has no rule in this file" : "%.*s has no rule",
                                 (int)item->text.length, item->text.text);
    if (g->partial)
        soften(list, d);
    if (is_epsilon(item->text)) {
        tn_help(list, d, "an alternative that does nothing is left empty");
        return;
    }
    uint32_t count = g->count < NAMES_MAX ? g->count : NAMES_MAX;
    const char **names = TN_NEW_ARRAY(g->arena, const char *, count + 1);
    const char *wanted = tn_arena_copy(g->arena, item->text.text, item->text.length);
    if (!names || !wanted)
        return;
    for (uint32_t i = 0; i < count; i++)
        names[i] = g->symbols[i]->name;
    const char *near = tn_nearest(wanted, names, count);
    if (near)
        tn_suggest(list, d, "%s", near);
    else if (error)
        tn_help(list, d, "write a rule for it, or give the file that has it too: all files given are one grammar");
}

static void check_reached(tn_pcfg_grammar *g)
{
    for (uint32_t s = 0; s < g->count; s++) {
        const tn_pcfg_symbol *symbol = g->symbols[s];
        for (const tn_pcfg_alternative *a = symbol->alternatives.first; a; a = a->next)
            for (const tn_pcfg_item *item = a->first; item; item = item->next)
                if (item->kind == TN_PCFG_NAME && item->unknown)
                    report_unknown(g, item, symbol->reached);
        if (!symbol->reached && !g->partial)
            tn_report(g->diagnostics, W_GRAMMAR_UNREACHABLE, symbol->span,
                      "%s cannot be reached from the start symbol %s", symbol->name, g->symbols[0]->name);
    }
}

/* ---- probabilities */

static void warn_of_lost(const tn_pcfg_grammar *g, const tn_pcfg_probability *p)
{
    tn_diagnostics *list = g->diagnostics;
    if (p->lost == TN_PCFG_COUNTS || p->value == 0)
        return;
    tn_diagnostic *d =
        tn_report(list, W_PLACE_PROBABILITY_LOST, p->span,
                  p->lost == TN_PCFG_LATER   ? "a later probability of this alternative counts, not this one"
                  : p->lost == TN_PCFG_BLANK ? "this probability is not read: a blank follows it on its line"
                                             : "this probability is not read: it does not end its line");
    tn_help(list, d,
            p->lost == TN_PCFG_BLANK   ? "leave out the blank behind it"
            : p->lost == TN_PCFG_LATER ? "leave out one of the two"
                                       : "put it behind everything else on the line");
}

/* In the order in which the engine adds them. */
static void check_probabilities(const tn_pcfg_grammar *g, tn_pcfg_symbol *symbol)
{
    tn_diagnostics *list = g->diagnostics;
    double sum = 0;
    for (const tn_pcfg_alternative *a = symbol->alternatives.first; a; a = a->next) {
        for (const tn_pcfg_probability *p = a->first_probability; p; p = p->next)
            warn_of_lost(g, p);
        sum += a->probability;
    }
    symbol->drawn = tn_place_draws(sum);
    if (sum >= 3) {
        tn_report(list, E_PLACE_PROBABILITY, symbol->span, "the probabilities of %s sum to %.15g, which is more than 1",
                  symbol->name, sum);
    } else if (sum > 0 && !symbol->drawn && !g->partial) {
        tn_diagnostic *d = tn_report(list, W_PLACE_PROBABILITY_SUM, symbol->span,
                                     "the probabilities of %s sum to %.15g, not to 1: its alternatives are tried in "
                                     "order, and none is drawn",
                                     symbol->name, sum);
        tn_help(list, d, "let them sum to 1, or leave them all out");
    }
}

void tn_pcfg_check(tn_pcfg_grammar *g, const tn_pcfg_file *file)
{
    collect(g, file);
    if (tn_arena_failed(g->arena) || g->count == 0)
        return;
    for (uint32_t s = 0; s < g->count; s++)
        for (tn_pcfg_alternative *a = g->symbols[s]->alternatives.first; a; a = a->next)
            read_items(g, a);
    reach(g);
    check_reached(g);
    for (uint32_t s = 0; s < g->count; s++)
        check_probabilities(g, g->symbols[s]);
}
