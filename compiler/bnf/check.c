/* Checks a grammar (.bnf): names, rules that never end, what cannot be reached, what repair needs. */
#include "compiler/bnf/check.h"

#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

/* ---- names */

static bool same(tn_bnf_text a, tn_bnf_text b)
{
    return a.length == b.length && memcmp(a.text, b.text, a.length) == 0;
}

static size_t place_of(const tn_bnf_grammar *g, tn_bnf_text name)
{
    size_t place = (size_t)XXH3_64bits(name.text, name.length) & (g->names_size - 1);
    while (g->names[place] != TN_BNF_NONE && !same(g->rules[g->names[place]]->name, name))
        place = (place + 1) & (g->names_size - 1);
    return place;
}

uint32_t tn_bnf_find(const tn_bnf_grammar *grammar, tn_bnf_text name)
{
    return grammar->names[place_of(grammar, name)];
}

static void enter_names(tn_bnf_grammar *g)
{
    for (g->names_size = 16; g->names_size < g->rule_count * 2;)
        g->names_size *= 2;
    g->names = TN_NEW_ARRAY(g->reader->arena, uint32_t, g->names_size);
    if (!g->names)
        return;
    memset(g->names, 0xFF, g->names_size * sizeof *g->names);
    for (size_t r = 0; r < g->rule_count; r++) {
        tn_bnf_rule *rule = g->rules[r];
        size_t place = place_of(g, rule->name);
        if (g->names[place] == TN_BNF_NONE) {
            g->names[place] = (uint32_t)r;
            continue;
        }
        tn_diagnostic *diagnostic = tn_report(g->reader->diagnostics, E_GRAMMAR_DUPLICATE, rule->name_span,
                                              "%.*s has a rule already", (int)rule->name.length, rule->name.text);
        tn_note(g->reader->diagnostics, diagnostic, &g->rules[g->names[place]]->name_span, "it is here");
        tn_help(g->reader->diagnostics, diagnostic, "put the alternatives together, separated by |");
    }
}

#define SUGGESTIONS_MAX 1000u /* rules looked through for a name that is nearly right */

static void undefined(tn_bnf_grammar *g, const tn_bnf_item *item)
{
    tn_diagnostics *list = g->reader->diagnostics;
    tn_diagnostic *diagnostic = tn_report(list, E_GRAMMAR_UNDEFINED, item->span, "there is no rule %.*s",
                                          (int)item->text.length, item->text.text);
    size_t count = g->rule_count < SUGGESTIONS_MAX ? g->rule_count : SUGGESTIONS_MAX;
    const char **names = TN_NEW_ARRAY(g->reader->arena, const char *, count);
    const char *wanted = tn_arena_copy(g->reader->arena, item->text.text, item->text.length);
    if (!names || !wanted)
        return;
    for (size_t r = 0; r < count; r++)
        if (!(names[r] = tn_arena_copy(g->reader->arena, g->rules[r]->name.text, g->rules[r]->name.length)))
            return;
    const char *near = tn_nearest(wanted, names, count);
    if (near)
        tn_help(list, diagnostic, "did you mean %s?", near);
    else if (g->reader->ast.dialect == TN_DIALECT_GE)
        tn_help(list, diagnostic, "if it is meant as text, quote it: \"%s\"", wanted);
}

static void find_names(tn_bnf_grammar *g, tn_bnf_items items)
{
    for (tn_bnf_item *item = items.first; item; item = item->next) {
        if (item->kind == TN_BNF_NAME && (item->rule = tn_bnf_find(g, item->text)) == TN_BNF_NONE)
            undefined(g, item);
        find_names(g, item->body);
    }
}

/* ---- which rules can end */

/* A rule can end if one of its alternatives needs only rules that can; what is in a group is not needed. Each
 * alternative waits for a number of names, and a rule that is found to end wakes the alternatives that wait for it:
 * linear time. */
typedef struct ending {
    tn_bnf_grammar *grammar;
    uint32_t *rule_of;     /* by alternative */
    uint32_t *waits_for;   /* by alternative: names still open */
    uint32_t *first, *use; /* by rule: where its uses start; alternatives that name it */
    bool *ends;
    uint32_t *ready; /* rules found to end, to be worked off */
    size_t ready_count;
} ending;

static bool ending_init(ending *e, tn_bnf_grammar *g)
{
    size_t uses = 0;
    for (size_t r = 0; r < g->rule_count; r++)
        for (const tn_bnf_alternative *a = g->rules[r]->alternatives.first; a; a = a->next)
            for (const tn_bnf_item *item = a->items.first; item; item = item->next)
                uses += item->kind == TN_BNF_NAME;
    tn_arena *arena = g->reader->arena;
    e->grammar = g;
    e->rule_of = TN_NEW_ARRAY(arena, uint32_t, g->production_count + 1);
    e->waits_for = TN_NEW_ARRAY(arena, uint32_t, g->production_count + 1);
    e->first = TN_NEW_ARRAY(arena, uint32_t, g->rule_count + 2);
    e->use = TN_NEW_ARRAY(arena, uint32_t, uses + 1);
    e->ends = TN_NEW_ARRAY(arena, bool, g->rule_count + 1);
    e->ready = TN_NEW_ARRAY(arena, uint32_t, g->rule_count + 1);
    return e->rule_of && e->waits_for && e->first && e->use && e->ends && e->ready;
}

static void rule_ends(ending *e, uint32_t rule)
{
    if (!e->ends[rule]) {
        e->ends[rule] = true;
        e->ready[e->ready_count++] = rule;
    }
}

/* Twice over all alternatives: to count each rule's uses, then to list them. */
static void list_uses(ending *e)
{
    tn_bnf_grammar *g = e->grammar;
    for (int pass = 0; pass < 2; pass++) {
        uint32_t production = 0;
        for (size_t r = 0; r < g->rule_count; r++)
            for (const tn_bnf_alternative *a = g->rules[r]->alternatives.first; a; a = a->next, production++) {
                e->rule_of[production] = (uint32_t)r;
                for (const tn_bnf_item *item = a->items.first; item; item = item->next) {
                    if (item->kind != TN_BNF_NAME || item->rule == TN_BNF_NONE)
                        continue;
                    if (pass == 0) {
                        e->first[item->rule + 2]++;
                    } else {
                        e->use[e->first[item->rule + 1]++] = production;
                        e->waits_for[production]++;
                    }
                }
                if (pass == 1 && e->waits_for[production] == 0)
                    rule_ends(e, (uint32_t)r);
            }
        for (size_t r = 0; pass == 0 && r < g->rule_count; r++)
            e->first[r + 2] += e->first[r + 1];
    }
}

static void check_ends(tn_bnf_grammar *g)
{
    ending e = {0};
    if (!ending_init(&e, g))
        return;
    list_uses(&e);
    while (e.ready_count) {
        uint32_t rule = e.ready[--e.ready_count];
        for (uint32_t i = e.first[rule]; i < e.first[rule + 1]; i++)
            if (--e.waits_for[e.use[i]] == 0)
                rule_ends(&e, e.rule_of[e.use[i]]);
    }
    for (size_t r = 0; r < g->rule_count; r++) {
        const tn_bnf_rule *rule = g->rules[r];
        if (e.ends[r] || rule->broken)
            continue;
        tn_diagnostic *diagnostic =
            tn_report(g->reader->diagnostics, E_GRAMMAR_NEVER_ENDS, rule->name_span,
                      "%.*s can never end: each of its alternatives leads back to it, or to a rule that never ends",
                      (int)rule->name.length, rule->name.text);
        tn_help(g->reader->diagnostics, diagnostic, "add an alternative of terminals");
    }
}

/* ---- which rules can be reached */

static void reach(tn_bnf_items items, bool *reached, uint32_t *pending, size_t *count)
{
    for (const tn_bnf_item *item = items.first; item; item = item->next) {
        if (item->kind == TN_BNF_NAME && item->rule != TN_BNF_NONE && !reached[item->rule]) {
            reached[item->rule] = true;
            pending[(*count)++] = item->rule;
        }
        reach(item->body, reached, pending, count);
    }
}

static void check_reached(tn_bnf_grammar *g)
{
    bool *reached = TN_NEW_ARRAY(g->reader->arena, bool, g->rule_count);
    uint32_t *pending = TN_NEW_ARRAY(g->reader->arena, uint32_t, g->rule_count);
    if (!reached || !pending)
        return;
    size_t count = 1;
    reached[0] = true;
    pending[0] = 0;
    while (count) {
        const tn_bnf_rule *rule = g->rules[pending[--count]];
        for (const tn_bnf_alternative *a = rule->alternatives.first; a; a = a->next)
            reach(a->items, reached, pending, &count);
    }
    for (size_t r = 0; r < g->rule_count; r++) {
        const tn_bnf_rule *rule = g->rules[r];
        bool repairs = g->reader->ast.dialect == TN_DIALECT_GENR8 && g->reader->ast.repair != TN_REPAIR_OFF &&
                       same(rule->name, (tn_bnf_text){"<Successor>", 11});
        if (!reached[r] && !repairs && tn_bnf_find(g, rule->name) == r)
            tn_report(g->reader->diagnostics, W_GRAMMAR_UNREACHABLE, rule->name_span,
                      "%.*s cannot be reached from the start symbol %.*s", (int)rule->name.length, rule->name.text,
                      (int)g->rules[0]->name.length, g->rules[0]->name.text);
    }
}

/* ---- what repair needs */

static void check_repair(tn_bnf_grammar *g)
{
    static const char *const names[] = {"<RewriteRule>", "<Predecessor>", "<Successor>"};
    const tn_bnf_file *ast = &g->reader->ast;
    if (ast->dialect == TN_DIALECT_GE) {
        if (ast->says_repair)
            tn_report(g->reader->diagnostics, E_GRAMMAR_DIRECTIVE, ast->repair_span,
                      "%%repair is of the genr8 dialect, which this file is not in");
        return;
    }
    for (size_t i = 0; ast->repair != TN_REPAIR_OFF && i < 3; i++) {
        if (tn_bnf_find(g, (tn_bnf_text){names[i], strlen(names[i])}) != TN_BNF_NONE)
            continue;
        tn_diagnostic *diagnostic =
            tn_report(g->reader->diagnostics, E_GRAMMAR_REPAIR, g->rules[0]->name_span,
                      "repair gives a rule to edge types that have none, and needs a rule %s", names[i]);
        tn_help(g->reader->diagnostics, diagnostic, "write that rule, or begin the file with `%%repair off`");
    }
}

/* Position-independent mapping reads two codons for each non-terminal, and none within a production. */
static void check_mapping(tn_bnf_grammar *g)
{
    const tn_bnf_file *ast = &g->reader->ast;
    bool genr8 = ast->dialect == TN_DIALECT_GENR8;
    if (!ast->position_independent || (!genr8 && !ast->skip_single))
        return;
    tn_diagnostic *diagnostic =
        tn_report(g->reader->diagnostics, E_MAPPING_ORDER, ast->mapping_span,
                  genr8 ? "position-independent mapping is for the dialect ge, and this grammar is in genr8"
                        : "position-independent mapping reads two codons for every non-terminal, also for a single "
                          "choice");
    tn_help(g->reader->diagnostics, diagnostic,
            genr8 ? "leave it out: genomes are then mapped leftmost"
                  : "leave out `%%single-choice skip` of the grammar");
}

void tn_bnf_check(tn_bnf_grammar *g)
{
    enter_names(g);
    if (!g->names)
        return;
    bool broken = false;
    for (size_t r = 0; r < g->rule_count; r++) {
        broken |= g->rules[r]->broken;
        for (const tn_bnf_alternative *a = g->rules[r]->alternatives.first; a; a = a->next)
            find_names(g, a->items);
    }
    if (g->reader->diagnostics->error_count == 0 || !broken)
        check_ends(g);
    check_reached(g);
    check_repair(g);
    check_mapping(g);
}
