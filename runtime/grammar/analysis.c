/* Analyses a grammar: depths, numbers of derivations, growth of sentences. */
#include "runtime/grammar/analysis.h"

#include <stdlib.h>
#include <string.h>

/* ==== finds the depths that derivations can have, the shallowest first */

static bool has(const tn_depths *h, uint32_t rule, uint32_t height)
{
    return h->bits[rule * h->row + height / 64] >> (height % 64) & 1;
}

/* Do all non-terminals of the words [at, end) end within `height` levels? */
static bool all_end(const tn_grammar *g, const tn_analysis *a, uint32_t at, uint32_t end, uint32_t height)
{
    for (; at < end; at++)
        if (TN_WORD_OP(g->words[at]) == TN_WORD_RULE && a->rule_depth[TN_WORD_ARGUMENT(g->words[at])] > height)
            return false;
    return true;
}

/* Has one of the production's non-terminals the depth `height`? Those of a group count where all that it holds can end
 * within that: then it can be written once. */
static bool leads(const tn_depths *h, const tn_grammar *g, const tn_analysis *a, uint32_t production, uint32_t height)
{
    uint32_t closed = 0; /* words before this one lie in a group that is left out */
    for (uint32_t at = g->productions[production].words; TN_WORD_OP(g->words[at]) != TN_WORD_DONE; at++) {
        uint32_t argument = TN_WORD_ARGUMENT(g->words[at]);
        switch (TN_WORD_OP(g->words[at])) {
        case TN_WORD_REPEAT:
        case TN_WORD_MAYBE:
            if (at >= closed && !all_end(g, a, at + 1, at + 1 + argument, height))
                closed = at + 1 + argument;
            break;
        case TN_WORD_RULE:
            if (at >= closed && has(h, argument, height))
                return true;
            break;
        default:
            break;
        }
    }
    return false;
}

static void find_of_height(tn_depths *h, const tn_grammar *g, const tn_analysis *a, uint32_t height)
{
    uint32_t leaf = g->dialect == TN_DIALECT_GE ? 2 : 1;
    for (uint32_t p = 0; p < g->production_count; p++) {
        uint32_t least = a->production_depth[p], rule = g->productions[p].rule;
        if (least == TN_DEPTH_ENDLESS || least > height || has(h, rule, height))
            continue;
        if ((height == leaf && least == leaf) || (height > leaf && leads(h, g, a, p, height - 1)))
            h->bits[rule * h->row + height / 64] |= UINT64_C(1) << (height % 64);
    }
}

tn_status tn_depths_find(const tn_grammar *grammar, const tn_analysis *analysis, uint32_t top, tn_depths *depths,
                         tn_error *error)
{
    *depths = (tn_depths){.top = top, .row = (size_t)top / 64 + 1};
    depths->bits = calloc(grammar->rule_count * depths->row, sizeof *depths->bits);
    if (!depths->bits)
        return tn_fail_memory(error);
    for (uint32_t height = 1; height <= top; height++)
        find_of_height(depths, grammar, analysis, height);
    return TN_OK;
}

void tn_depths_clear(tn_depths *depths)
{
    free(depths->bits);
    *depths = (tn_depths){0};
}

bool tn_depths_within(const tn_depths *h, uint32_t rule, uint32_t low, uint32_t high)
{
    for (uint32_t height = low; height <= high && height <= h->top; height++)
        if (has(h, rule, height))
            return true;
    return false;
}

/* ==== how many derivations a grammar has: by depth where that is finite, else by codons */

/* Numbers by rule: with `width` 1 those of the derivations of one depth; else polynomials, a coefficient for each
 * number of codons from 0 to width - 1. */
typedef struct counter {
    const tn_grammar *grammar;
    size_t width;
    mpz_t *now, *next;      /* [rule][width] */
    mpz_t *product, *spare; /* [width] */
    bool too_large, failed;
} counter;

static mpz_t *numbers_new(size_t count)
{
    mpz_t *numbers = malloc((count ? count : 1) * sizeof *numbers);
    for (size_t i = 0; numbers && i < count; i++)
        mpz_init(numbers[i]);
    return numbers;
}

static void numbers_free(mpz_t *numbers, size_t count)
{
    for (size_t i = 0; numbers && i < count; i++)
        mpz_clear(numbers[i]);
    free(numbers);
}

static void set_one(const counter *c, mpz_t *numbers)
{
    for (size_t i = 0; i < c->width; i++)
        mpz_set_ui(numbers[i], i == 0);
}

/* product *= factor, cut at the width. */
static void multiply(counter *c, mpz_t *product, mpz_t *factor)
{
    for (size_t i = 0; i < c->width; i++)
        mpz_set_ui(c->spare[i], 0);
    for (size_t i = 0; i < c->width; i++)
        for (size_t j = 0; mpz_sgn(product[i]) && i + j < c->width; j++)
            if (mpz_sgn(factor[j]))
                mpz_addmul(c->spare[i + j], product[i], factor[j]);
    for (size_t i = 0; i < c->width; i++) {
        mpz_swap(product[i], c->spare[i]);
        c->too_large |= mpz_sizeinbase(product[i], 2) > TN_DERIVATION_BITS;
    }
}

/* numbers *= x: one codon is read. By depth, codons do not count. */
static void read_codon(const counter *c, mpz_t *numbers)
{
    for (size_t i = c->width; c->width > 1 && i-- > 0;)
        if (i == 0)
            mpz_set_ui(numbers[0], 0);
        else
            mpz_set(numbers[i], numbers[i - 1]);
}

/* body -> x / (1 - x body), by the recurrence r = x + x body r: the loop `{ body }`. */
static void close_loop(counter *c, mpz_t *body)
{
    mpz_t *loop = numbers_new(c->width);
    if (!loop) {
        c->failed = true;
        return;
    }
    for (size_t round = 0; round < c->width; round++) {
        multiply(c, loop, body);
        mpz_add_ui(loop[0], loop[0], 1);
        read_codon(c, loop);
    }
    for (size_t i = 0; i < c->width; i++)
        mpz_swap(body[i], loop[i]);
    numbers_free(loop, c->width);
}

/* The numbers of words [at, end), into `product`. Groups nest at most TN_GROUP_DEPTH deep. */
static void count_words(counter *c, uint32_t at, uint32_t end, uint32_t *letters, mpz_t *product)
{
    const tn_grammar *g = c->grammar;
    set_one(c, product);
    while (at < end && !c->too_large && !c->failed) {
        uint32_t word = g->words[at], argument = TN_WORD_ARGUMENT(word);
        tn_word_op op = TN_WORD_OP(word);
        if (op == TN_WORD_RULE) {
            multiply(c, product, &c->now[argument * c->width]);
        } else if (op == TN_WORD_EDGE || (op == TN_WORD_SAME && !(*letters >> argument & 1))) {
            read_codon(c, product);
            *letters |= op == TN_WORD_SAME ? 1u << argument : 0;
        } else if (op == TN_WORD_REPEAT || op == TN_WORD_MAYBE) {
            mpz_t *body = numbers_new(c->width);
            if (!body) {
                c->failed = true;
                return;
            }
            count_words(c, at + 1, at + 1 + argument - (op == TN_WORD_REPEAT), letters, body);
            if (op == TN_WORD_REPEAT) {
                close_loop(c, body);
            } else {
                mpz_add_ui(body[0], body[0], 1);
                read_codon(c, body);
            }
            multiply(c, product, body);
            numbers_free(body, c->width);
            at += argument;
        }
        at++;
    }
}

static void count_rule(counter *c, uint32_t index, bool leaf_counts)
{
    const tn_rule *rule = &c->grammar->rules[index];
    mpz_t *sum = &c->next[index * c->width];
    for (size_t i = 0; i < c->width; i++)
        mpz_set_ui(sum[i], 0);
    for (uint32_t p = rule->first; p < rule->first + rule->count && !c->too_large; p++) {
        const tn_production *production = &c->grammar->productions[p];
        uint32_t letters = 0;
        if (!leaf_counts && production->symbols)
            continue;
        count_words(c, production->words, production->words + production->symbols, &letters, c->product);
        read_codon(c, c->product);
        for (size_t i = 0; i < c->width; i++)
            mpz_add(sum[i], sum[i], c->product[i]);
    }
}

tn_status tn_count_derivations(const tn_grammar *grammar, uint32_t depth, bool *by_codons, mpz_t total, tn_error *error)
{
    *by_codons = tn_grammar_has_loops(grammar);
    counter c = {.grammar = grammar, .width = *by_codons ? (size_t)depth + 1 : 1};
    size_t numbers = grammar->rule_count * c.width;
    c.now = numbers_new(numbers);
    c.next = numbers_new(numbers);
    c.product = numbers_new(c.width);
    c.spare = numbers_new(c.width);
    tn_status status = c.now && c.next && c.product && c.spare ? TN_OK : tn_fail_memory(error);
    /* at depth 1, a ge rule has no room for its terminals */
    for (uint32_t level = 1; status == TN_OK && level <= depth && !c.too_large; level++) {
        for (uint32_t r = 0; r < grammar->rule_count; r++)
            count_rule(&c, r, level > 1 || grammar->dialect == TN_DIALECT_GENR8);
        mpz_t *swap = c.now;
        c.now = c.next;
        c.next = swap;
    }
    if (status == TN_OK && c.failed)
        status = tn_fail_memory(error);
    else if (status == TN_OK && c.too_large)
        status = tn_fail(error, TN_LIMIT, E_TOO_MANY_DERIVATIONS,
                         "the number of derivations passes %u binary digits, the limit", TN_DERIVATION_BITS);
    if (status == TN_OK)
        mpz_set(total, c.now[c.width - 1]);
    numbers_free(c.now, numbers);
    numbers_free(c.next, numbers);
    numbers_free(c.product, c.width);
    numbers_free(c.spare, c.width);
    return status;
}

/* ==== analyses a grammar: depths, numbers of derivations, growth of sentences */

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
