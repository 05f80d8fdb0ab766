/* Analyses a grammar: depths, numbers of derivations, growth of sentences. */
#include "runtime/grammar/analysis.h"

#include <stdlib.h>
#include <string.h>

/* ---- walking a production's words */

/* The word after the one at `at`, groups left out: what they hold may be written not at all. */
static uint32_t past_group(const tn_grammar *g, uint32_t at)
{
    uint32_t word = g->words[at];
    bool group = TN_WORD_OP(word) == TN_WORD_REPEAT || TN_WORD_OP(word) == TN_WORD_MAYBE;
    return group ? at + 1 + TN_WORD_ARGUMENT(word) : at + 1;
}

bool tn_grammar_has_loops(const tn_grammar *grammar)
{
    for (size_t i = 0; i < grammar->word_count; i++)
        if (TN_WORD_OP(grammar->words[i]) == TN_WORD_REPEAT)
            return true;
    return false;
}

/* ---- shallowest sentences */

/* Rules are worked off in the order of their depths: a production's depth is known when the last of the rules it needs
 * is. */
typedef struct depths {
    const tn_grammar *grammar;
    tn_analysis *analysis;
    uint32_t *waits; /* by production: needed rules not known yet */
    uint32_t *first; /* by rule: its uses in `use` */
    uint32_t *use;   /* productions */
    uint32_t *queue; /* rules known */
    size_t known;
} depths;

static void production_known(depths *d, uint32_t production, uint32_t depth)
{
    uint32_t rule = d->grammar->productions[production].rule;
    d->analysis->production_depth[production] = depth;
    if (d->analysis->rule_depth[rule] != TN_DEPTH_ENDLESS)
        return;
    d->analysis->rule_depth[rule] = depth;
    d->queue[d->known++] = rule;
}

static void list_uses(depths *d)
{
    const tn_grammar *g = d->grammar;
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t p = 0; p < g->production_count; p++)
            for (uint32_t at = g->productions[p].words; TN_WORD_OP(g->words[at]) != TN_WORD_DONE;
                 at = past_group(g, at)) {
                if (TN_WORD_OP(g->words[at]) != TN_WORD_RULE)
                    continue;
                uint32_t rule = TN_WORD_ARGUMENT(g->words[at]);
                if (pass == 0) {
                    d->first[rule + 2]++;
                    d->waits[p]++;
                } else {
                    d->use[d->first[rule + 1]++] = p;
                }
            }
        for (size_t r = 0; pass == 0 && r < g->rule_count; r++)
            d->first[r + 2] += d->first[r + 1];
    }
}

static void find_depths(depths *d)
{
    const tn_grammar *g = d->grammar;
    uint32_t leaf = g->dialect == TN_DIALECT_GE ? 2 : 1; /* in ge, terminals count */
    list_uses(d);
    for (uint32_t p = 0; p < g->production_count; p++)
        if (d->waits[p] == 0)
            production_known(d, p, leaf);
    for (size_t i = 0; i < d->known; i++) {
        uint32_t rule = d->queue[i], depth = d->analysis->rule_depth[rule];
        for (uint32_t u = d->first[rule]; u < d->first[rule + 1]; u++)
            if (--d->waits[d->use[u]] == 0)
                production_known(d, d->use[u], depth + 1);
    }
}

/* ---- recursion: the strongly connected components of the rules (Tarjan 1972, with a stack of its own) */

typedef struct component_search {
    const tn_grammar *grammar;
    uint32_t *order, *low, *component; /* by rule; order 0: not seen */
    uint32_t *stack, *path, *at;       /* Tarjan's stack; the rules being visited; and the word each is at */
    size_t stacked, depth;
    uint32_t seen, components;
} component_search;

static void visit(component_search *s, uint32_t rule)
{
    s->order[rule] = s->low[rule] = ++s->seen;
    s->stack[s->stacked++] = rule;
    s->path[s->depth] = rule;
    s->at[s->depth++] = s->grammar->productions[s->grammar->rules[rule].first].words;
}

static uint32_t words_end(const tn_grammar *g, uint32_t rule)
{
    uint32_t next = g->rules[rule].first + g->rules[rule].count;
    return next < g->production_count ? g->productions[next].words : (uint32_t)g->word_count;
}

static void leave(component_search *s, uint32_t rule)
{
    s->depth--;
    if (s->depth) {
        uint32_t parent = s->path[s->depth - 1];
        if (s->low[rule] < s->low[parent])
            s->low[parent] = s->low[rule];
    }
    if (s->low[rule] != s->order[rule])
        return;
    uint32_t member;
    do {
        member = s->stack[--s->stacked];
        s->component[member] = s->components;
    } while (member != rule);
    s->components++;
}

static void search_from(component_search *s, uint32_t root)
{
    visit(s, root);
    while (s->depth) {
        uint32_t rule = s->path[s->depth - 1], *at = &s->at[s->depth - 1];
        if (*at == words_end(s->grammar, rule)) {
            leave(s, rule);
            continue;
        }
        uint32_t word = s->grammar->words[(*at)++];
        if (TN_WORD_OP(word) != TN_WORD_RULE)
            continue;
        uint32_t next = TN_WORD_ARGUMENT(word);
        if (s->order[next] == 0)
            visit(s, next);
        else if (s->component[next] == UINT32_MAX && s->order[next] < s->low[rule])
            s->low[rule] = s->order[next];
    }
}

static void mark_recursion(const tn_grammar *g, const uint32_t *component, tn_analysis *a)
{
    for (uint32_t p = 0; p < g->production_count; p++) {
        uint32_t rule = g->productions[p].rule;
        for (uint32_t at = g->productions[p].words; TN_WORD_OP(g->words[at]) != TN_WORD_DONE; at++) {
            uint32_t word = g->words[at];
            if (TN_WORD_OP(word) == TN_WORD_RULE && component[TN_WORD_ARGUMENT(word)] == component[rule])
                a->recursive[rule] = a->endless[p] = 1;
        }
    }
}

static tn_status find_recursion(const tn_grammar *g, uint32_t *component, tn_analysis *a, tn_error *error)
{
    size_t n = g->rule_count;
    uint32_t *memory = calloc(n * 5, sizeof *memory);
    if (!memory)
        return tn_fail_memory(error);
    component_search s = {.grammar = g,
                          .order = memory,
                          .low = memory + n,
                          .component = component,
                          .stack = memory + 2 * n,
                          .path = memory + 3 * n,
                          .at = memory + 4 * n};
    memset(component, 0xFF, n * sizeof *component);
    for (uint32_t r = 0; r < n; r++)
        if (s.order[r] == 0)
            search_from(&s, r);
    mark_recursion(g, component, a);
    free(memory);
    return TN_OK;
}

/* ---- growth: the largest eigenvalue of the matrix of mean children, within recursion */

#define GROWTH_ROUNDS 200
#define MEAN_ROUNDS 0.71828182845904524 /* of a loop: the sum of 1/(k+1)! from k = 1, e - 2 */
#define MEAN_TAKEN 0.5

/* next += (mean children) * weight, over one production. */
static void spread(const tn_grammar *g, uint32_t p, const uint32_t *component, double weight, double *next)
{
    double scale[TN_GROUP_DEPTH + 1] = {weight};
    uint32_t ends[TN_GROUP_DEPTH + 1] = {UINT32_MAX}, depth = 0;
    for (uint32_t at = g->productions[p].words; TN_WORD_OP(g->words[at]) != TN_WORD_DONE; at++) {
        while (ends[depth] == at)
            depth--;
        uint32_t word = g->words[at], argument = TN_WORD_ARGUMENT(word);
        if (TN_WORD_OP(word) == TN_WORD_REPEAT || TN_WORD_OP(word) == TN_WORD_MAYBE) {
            scale[depth + 1] = scale[depth] * (TN_WORD_OP(word) == TN_WORD_REPEAT ? MEAN_ROUNDS : MEAN_TAKEN);
            ends[++depth] = at + 1 + argument;
        } else if (TN_WORD_OP(word) == TN_WORD_RULE && component[argument] == component[g->productions[p].rule]) {
            next[argument] += scale[depth];
        }
    }
}

/* The productions that lead back to their own rule: few of a grammar's alternatives do. */
static uint32_t *list_endless(const tn_grammar *g, const tn_analysis *a, size_t *count)
{
    uint32_t *list = malloc((g->production_count + 1) * sizeof *list);
    *count = 0;
    for (uint32_t p = 0; list && p < g->production_count; p++)
        if (a->endless[p])
            list[(*count)++] = p;
    return list;
}

/* Power iteration on the matrix and the identity, whose largest eigenvalue is one more and which cannot swing. */
static tn_status find_growth(const tn_grammar *g, const uint32_t *component, tn_analysis *a, tn_error *error)
{
    size_t n = g->rule_count, endless_count;
    uint32_t *endless = list_endless(g, a, &endless_count);
    double *now = calloc(n * 2, sizeof *now), sum = 1;
    if (!now || !endless) {
        free(now);
        free(endless);
        return tn_fail_memory(error);
    }
    double *next = now + n;
    for (size_t r = 0; r < n; r++)
        now[r] = a->recursive[r] ? 1.0 : 0.0;
    for (int round = 0; round < GROWTH_ROUNDS; round++) {
        memcpy(next, now, n * sizeof *now);
        for (size_t i = 0; i < endless_count; i++) {
            uint32_t rule = g->productions[endless[i]].rule;
            spread(g, endless[i], component, now[rule] / g->rules[rule].count, next);
        }
        double before = 0;
        sum = 0;
        for (size_t r = 0; r < n; r++) {
            before += now[r];
            sum += next[r];
        }
        a->growth = before > 0 ? sum / before - 1 : 0;
        for (size_t r = 0; r < n && sum > 0; r++)
            now[r] = next[r] / sum;
    }
    a->growing_rule = TN_NO_RECORD;
    for (uint32_t r = 0; r < n; r++)
        if (a->recursive[r] && (a->growing_rule == TN_NO_RECORD || now[r] > now[a->growing_rule]))
            a->growing_rule = r;
    free(now);
    free(endless);
    return TN_OK;
}

/* ---- all */

void tn_analysis_clear(tn_analysis *analysis)
{
    free(analysis->rule_depth);
    free(analysis->production_depth);
    free(analysis->recursive);
    free(analysis->endless);
    *analysis = (tn_analysis){0};
}

static tn_status analyse_depths(const tn_grammar *g, tn_analysis *a, tn_error *error)
{
    size_t uses = 1;
    for (size_t i = 0; i < g->word_count; i++)
        uses += TN_WORD_OP(g->words[i]) == TN_WORD_RULE;
    size_t n = g->rule_count, p = g->production_count;
    uint32_t *memory = calloc(p + n + 2 + uses + n, sizeof *memory);
    if (!memory)
        return tn_fail_memory(error);
    depths d = {.grammar = g,
                .analysis = a,
                .waits = memory,
                .first = memory + p,
                .use = memory + p + n + 2,
                .queue = memory + p + n + 2 + uses};
    memset(a->rule_depth, 0xFF, n * sizeof *a->rule_depth);
    memset(a->production_depth, 0xFF, p * sizeof *a->production_depth);
    find_depths(&d);
    free(memory);
    return TN_OK;
}

tn_status tn_analyse(const tn_grammar *g, tn_analysis *a, tn_error *error)
{
    *a = (tn_analysis){0};
    a->rule_depth = calloc(g->rule_count, sizeof *a->rule_depth);
    a->production_depth = calloc(g->production_count, sizeof *a->production_depth);
    a->recursive = calloc(g->rule_count, 1);
    a->endless = calloc(g->production_count, 1);
    uint32_t *component = calloc(g->rule_count, sizeof *component);
    tn_status status =
        a->rule_depth && a->production_depth && a->recursive && a->endless && component ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = analyse_depths(g, a, error);
    if (status == TN_OK)
        status = find_recursion(g, component, a, error);
    if (status == TN_OK)
        status = find_growth(g, component, a, error);
    free(component);
    return status;
}
