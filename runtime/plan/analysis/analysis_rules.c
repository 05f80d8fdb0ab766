/* Rules alone and in pairs: never, always, and how the plans that two of them match lie to one another. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/base/hash_table.h"
#include "runtime/base/random.h"
#include "runtime/plan/analysis/analysis_data.h"

/* Most pairs of rules overlap, and a few short plans show it: a pair is searched only for what they leave open. */
#define PROBES 256u
#define PROBE_LENGTH_MAX 6u

/* Rules of one meaning have one automaton: what is found of it holds for all of them. */
typedef struct meanings {
    size_t count;
    size_t *of;        /* [rules] */
    size_t *first;     /* [count] the first rule of each */
    bool *own, *named; /* [count] some rule of it is */
} meanings;

typedef struct probes {
    size_t count, words;
    uint64_t *matches; /* [meanings][words] */
} probes;

/* ---- meanings */

static uint64_t hash_of(const tn_dfa *dfa)
{
    uint64_t hash = tn_mix64(dfa->states ^ (uint64_t)dfa->columns << 32);
    for (size_t i = 0; i < (size_t)dfa->states * dfa->columns; i++)
        hash = tn_mix64(hash ^ dfa->delta[i]);
    for (uint32_t i = 0; i < dfa->states; i++)
        hash = tn_mix64(hash ^ dfa->accept[i]);
    return hash;
}

typedef struct wanted_meaning {
    const tn_plan_analysis *analysis;
    const meanings *meanings;
    const tn_dfa *dfa;
} wanted_meaning;

static bool is_wanted(const void *context, uint32_t meaning)
{
    const wanted_meaning *w = context;
    return tn_dfa_equal(w->analysis->rules[w->meanings->first[meaning]].dfa, w->dfa);
}

/* A rule past the limit has a meaning of its own, of a number that nothing finds. */
static tn_status add_meaning(const tn_plan_analysis *analysis, meanings *m, tn_hash_table *table, size_t rule,
                             tn_error *error)
{
    wanted_meaning wanted = {analysis, m, analysis->rules[rule].dfa};
    uint32_t found = (uint32_t)m->count;
    tn_status status =
        wanted.dfa ? tn_hash_enter(table, hash_of(wanted.dfa), is_wanted, &wanted, &found, error) : TN_OK;
    if (status != TN_OK)
        return status;
    if (found == m->count)
        m->first[m->count++] = rule;
    m->of[rule] = found;
    m->own[found] |= analysis->rules[rule].own;
    m->named[found] |= analysis->rules[rule].named;
    return TN_OK;
}

static void clear_meanings(meanings *m)
{
    free(m->of);
    free(m->first);
    free(m->own);
    free(m->named);
}

static tn_status find_meanings(const tn_plan_analysis *analysis, meanings *m, tn_error *error)
{
    size_t n = analysis->rule_count;
    tn_hash_table index = {0};
    *m = (meanings){.of = calloc(n + 1, sizeof *m->of),
                    .first = calloc(n + 1, sizeof *m->first),
                    .own = calloc(n + 1, sizeof *m->own),
                    .named = calloc(n + 1, sizeof *m->named)};
    tn_status status = m->of && m->first && m->own && m->named ? TN_OK : tn_fail_memory(error);
    for (size_t r = 0; r < n && status == TN_OK; r++)
        status = add_meaning(analysis, m, &index, r, error);
    tn_hash_clear(&index);
    return status;
}

/* ---- probing */

static void probe(const tn_plan_analysis *analysis, const meanings *m, probes *p, const uint32_t *word, size_t length)
{
    if (length == 0)
        return;
    size_t at = p->count++;
    for (size_t i = 0; i < m->count; i++) {
        const tn_dfa *dfa = analysis->rules[m->first[i]].dfa;
        if (dfa && tn_dfa_accepts(dfa, word, length))
            p->matches[i * p->words + at / 64] |= UINT64_C(1) << (at % 64);
    }
}

/* Probes with the shortest plans of each meaning and with random ones. */
static tn_status probe_all(const tn_plan_analysis *analysis, const meanings *m, probes *p, tn_error *error)
{
    *p = (probes){.words = (2 * m->count + PROBES) / 64 + 1};
    p->matches = calloc(tn_size_of(m->count, p->words) + 1, sizeof *p->matches);
    if (!p->matches)
        return tn_fail_memory(error);
    for (size_t i = 0; i < m->count; i++) {
        const tn_plan_analysed_rule *rule = &analysis->rules[m->first[i]];
        probe(analysis, m, p, rule->match.data, rule->match.size);
        probe(analysis, m, p, rule->reject.data, rule->reject.size);
    }
    for (uint32_t i = 0; i < PROBES; i++) {
        uint32_t word[PROBE_LENGTH_MAX], length = i % PROBE_LENGTH_MAX + 1;
        for (uint32_t k = 0; k < length; k++)
            word[k] = (uint32_t)(tn_random64(0, i, k) % analysis->classes->count);
        probe(analysis, m, p, word, length);
    }
    return TN_OK;
}

/* ---- pairs */

typedef struct comparing {
    tn_plan_analysis *analysis;
    const meanings *meanings;
    const probes *probes;
    uint8_t *relations; /* [meanings][meanings] */
} comparing;

/* Is there a plan on which rules of the two meanings answer so? */
static tn_status exists(const comparing *c, const size_t pair[2], const bool wanted[2], bool *found, tn_error *error)
{
    const probes *p = c->probes;
    for (size_t w = 0; w < p->words; w++) {
        uint64_t a = p->matches[pair[0] * p->words + w], b = p->matches[pair[1] * p->words + w];
        if ((wanted[0] ? a : ~a) & (wanted[1] ? b : ~b) & (a | b)) {
            *found = true;
            return TN_OK;
        }
    }
    const tn_plan_analysed_rule *rules = c->analysis->rules;
    const size_t *first = c->meanings->first;
    tn_search_part parts[2] = {{rules[first[pair[0]]].dfa, wanted[0]}, {rules[first[pair[1]]].dfa, wanted[1]}};
    tn_key word;
    tn_status status =
        tn_plan_analysis_search(c->analysis, parts, 2, 1, UINT32_MAX, "comparison", 0, &word, found, error);
    free(word.data);
    return status;
}

static tn_rule_relation relation_of(bool both, bool only_first, bool only_second)
{
    if (!only_first && !only_second)
        return TN_RULES_EQUAL;
    if (!both)
        return TN_RULES_APART;
    return only_first && only_second ? TN_RULES_OVERLAP : only_first ? TN_RULES_CONTAINS : TN_RULES_INSIDE;
}

static tn_status compare(const comparing *c, const size_t pair[2], tn_rule_relation *relation, tn_error *error)
{
    static const bool wanted[3][2] = {{true, true}, {true, false}, {false, true}};
    const tn_plan_analysed_rule *rules = c->analysis->rules;
    bool found[3];
    *relation = TN_RULES_UNKNOWN;
    if (!rules[c->meanings->first[pair[0]]].dfa || !rules[c->meanings->first[pair[1]]].dfa)
        return TN_OK;
    for (int i = 0; i < 3; i++) {
        tn_status status = exists(c, pair, wanted[i], &found[i], error);
        if (status != TN_OK)
            return status == TN_LIMIT ? TN_OK : status;
    }
    *relation = relation_of(found[0], found[1], found[2]);
    return TN_OK;
}

static tn_rule_relation turned(tn_rule_relation relation)
{
    return relation == TN_RULES_INSIDE ? TN_RULES_CONTAINS : relation == TN_RULES_CONTAINS ? TN_RULES_INSIDE : relation;
}

/* A meaning and those behind it, if rules of both are related. */
static tn_status compare_meaning(void *context, unsigned thread, size_t i, tn_error *error)
{
    const comparing *c = context;
    const meanings *m = c->meanings;
    tn_status status = TN_OK;
    (void)thread;
    for (size_t j = i + 1; status == TN_OK && j < m->count; j++) {
        tn_rule_relation relation;
        if (!m->own[i] && !m->own[j] && !(m->named[i] && m->named[j]))
            continue;
        status = compare(c, (size_t[2]){i, j}, &relation, error);
        c->relations[i * m->count + j] = (uint8_t)relation;
        c->relations[j * m->count + i] = (uint8_t)turned(relation);
    }
    return status;
}

/* All pairs with at least one rule of the named file, and of those that are shown. Own rules come first. */
static void relate_rules(tn_plan_analysis *analysis, const comparing *c)
{
    const meanings *m = c->meanings;
    size_t n = analysis->rule_count;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i; j < n; j++) {
            const tn_plan_analysed_rule *a = &analysis->rules[i], *b = &analysis->rules[j];
            size_t x = m->of[i], y = m->of[j];
            if (!a->own && !(a->named && b->named))
                continue;
            analysis->relations[i * n + j] = x == y ? TN_RULES_EQUAL : c->relations[x * m->count + y];
            analysis->relations[j * n + i] = x == y ? TN_RULES_EQUAL : c->relations[y * m->count + x];
        }
    }
}

/* Each by itself, so that the order in which threads take them changes nothing. */
static tn_status compare_all(tn_plan_analysis *analysis, const meanings *m, const probes *p, tn_error *error)
{
    size_t n = analysis->rule_count;
    comparing c = {analysis, m, p, calloc(tn_size_of(m->count, m->count) + 1, 1)};
    analysis->relations = calloc(tn_size_of(n, n) + 1, sizeof *analysis->relations);
    tn_status status = c.relations && analysis->relations
                           ? tn_crew_run(analysis->crew, m->count, 1, compare_meaning, &c, error)
                           : tn_fail_memory(error);
    if (status == TN_OK)
        relate_rules(analysis, &c);
    free(c.relations);
    return status;
}

static tn_rule_relation related(const tn_plan_analysis *analysis, size_t i, size_t j)
{
    return (tn_rule_relation)analysis->relations[i * analysis->rule_count + j];
}

/* ---- findings */

static tn_status find_extremes(tn_plan_analysis *analysis, tn_error *error)
{
    for (size_t r = 0; r < analysis->rule_count; r++) {
        tn_plan_analysed_rule *rule = &analysis->rules[r];
        if (!rule->dfa)
            continue;
        for (int matching = 0; matching < 2; matching++) {
            tn_search_part part = {rule->dfa, matching};
            bool found;
            tn_status status = tn_plan_analysis_search(analysis, &part, 1, 1, UINT32_MAX, "rule", 0,
                                                       matching ? &rule->match : &rule->reject, &found, error);
            if (status != TN_OK)
                return status;
            if (found || !rule->own)
                continue;
            tn_plan_analysis_finding *finding =
                tn_plan_analysis_add(analysis, matching ? TN_FOUND_NEVER : TN_FOUND_ALWAYS, 0);
            if (!finding)
                return tn_fail_memory(error);
            finding->rule = rule->record;
        }
    }
    return TN_OK;
}

/* Matches some plans, but not all: its relations are worth a word. */
static bool is_telling(const tn_plan_analysed_rule *rule)
{
    return rule->match.size > 0 && rule->reject.size > 0;
}

/* Rules of which one is made from the other are related on purpose. */
static bool is_on_purpose(const tn_plan_analysis *analysis, size_t i, size_t j)
{
    return (analysis->rules[i].uses[j / 64] >> (j % 64) & 1) || (analysis->rules[j].uses[i / 64] >> (i % 64) & 1);
}

static tn_status report_pair(tn_plan_analysis *analysis, size_t rule, size_t other, bool equal, tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    const tn_plan_analysed_rule *a = &analysis->rules[rule], *b = &analysis->rules[other];
    tn_plan_analysis_finding *finding =
        tn_plan_analysis_add(analysis, equal ? TN_FOUND_EQUIVALENT : TN_FOUND_SUBSUMED, 1);
    if (!finding)
        return tn_fail_memory(error);
    finding->rule = a->record;
    finding->other = b->record;
    tn_search_part parts[2] = {{a->dfa, equal}, {b->dfa, true}};
    tn_key word;
    bool found;
    tn_status status =
        tn_plan_analysis_search(analysis, parts, 2, 1, UINT32_MAX, "comparison", 0, &word, &found, error);
    if (status == TN_OK && found)
        status = tn_plan_analysis_show(analysis, &word, finding->plans, error);
    free(word.data);
    if (status == TN_OK)
        status =
            tn_plan_analysis_confirm(analysis, finding->plans, module->RULE_records[a->record].holds, equal, error);
    if (status == TN_OK)
        status = tn_plan_analysis_confirm(analysis, finding->plans, module->RULE_records[b->record].holds, true, error);
    return status == TN_LIMIT ? TN_OK : status;
}

/* The first rule before this one, or else the first used one, that is equal to it; rule_count where there is none. */
static size_t first_equal(const tn_plan_analysis *analysis, size_t r)
{
    for (size_t other = 0; other < analysis->rule_count; other++) {
        if (analysis->rules[other].own && other >= r)
            continue;
        if (related(analysis, r, other) == TN_RULES_EQUAL && !is_on_purpose(analysis, r, other))
            return other;
    }
    return analysis->rule_count;
}

/* A rule that others are made of is a notion, not something to prune by: that they lie inside it says nothing. */
static bool is_notion(const tn_plan_analysis *analysis, size_t r)
{
    for (size_t other = 0; other < analysis->own_count; other++)
        if (!analysis->rules[r].named && (analysis->rules[other].uses[r / 64] >> (r % 64) & 1))
            return true;
    return false;
}

/* The first rule of the file that contains this one and no other such rule. */
static size_t tightest(const tn_plan_analysis *analysis, size_t r)
{
    size_t best = analysis->rule_count;
    for (size_t other = 0; other < analysis->own_count; other++) {
        if (related(analysis, r, other) != TN_RULES_INSIDE || !is_telling(&analysis->rules[other]) ||
            is_on_purpose(analysis, r, other) || is_notion(analysis, other) ||
            first_equal(analysis, other) < analysis->own_count)
            continue;
        if (best == analysis->rule_count || related(analysis, other, best) == TN_RULES_INSIDE)
            best = other;
    }
    return best;
}

static tn_status find_pairs(tn_plan_analysis *analysis, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t r = 0; status == TN_OK && r < analysis->own_count; r++) {
        if (!is_telling(&analysis->rules[r]))
            continue;
        size_t equal = first_equal(analysis, r), wider = tightest(analysis, r);
        if (equal < analysis->rule_count)
            status = report_pair(analysis, r, equal, true, error);
        if (status == TN_OK && wider < analysis->rule_count)
            status = report_pair(analysis, r, wider, false, error);
    }
    return status;
}

tn_status tn_plan_analysis_rules(tn_plan_analysis *analysis, tn_error *error)
{
    meanings m = {0};
    probes p = {0};
    tn_status status = find_extremes(analysis, error);
    if (status == TN_OK)
        status = find_meanings(analysis, &m, error);
    if (status == TN_OK)
        status = probe_all(analysis, &m, &p, error);
    if (status == TN_OK)
        status = compare_all(analysis, &m, &p, error);
    free(p.matches);
    clear_meanings(&m);
    return status == TN_OK ? find_pairs(analysis, error) : status;
}

/* ---- relations, for those who ask */

size_t tn_plan_analysis_rule_count(const tn_plan_analysis *analysis)
{
    return analysis->shown_count;
}

uint32_t tn_plan_analysis_rule(const tn_plan_analysis *analysis, size_t i)
{
    return analysis->rules[analysis->shown[i]].record;
}

tn_rule_relation tn_plan_analysis_relation(const tn_plan_analysis *analysis, size_t i, size_t j)
{
    return related(analysis, analysis->shown[i], analysis->shown[j]);
}

tn_status tn_plan_analysis_examples(const tn_plan_analysis *analysis, size_t i, size_t j, tn_shown_plan examples[3],
                                    tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    const tn_plan_analysed_rule *a = &analysis->rules[analysis->shown[i]], *b = &analysis->rules[analysis->shown[j]];
    tn_status status = TN_OK;
    for (int e = 0; e < 3; e++)
        examples[e] = (tn_shown_plan){0};
    for (int e = 0; status == TN_OK && e < 3 && a->dfa && b->dfa; e++) {
        tn_search_part parts[2] = {{a->dfa, e != 2}, {b->dfa, e != 1}};
        tn_key word;
        bool found;
        status = tn_plan_analysis_search(analysis, parts, 2, 1, UINT32_MAX, "comparison", 0, &word, &found, error);
        if (status == TN_OK && found)
            status = tn_plan_analysis_show(analysis, &word, &examples[e], error);
        free(word.data);
        if (status == TN_OK)
            status =
                tn_plan_analysis_confirm(analysis, &examples[e], module->RULE_records[a->record].holds, e != 2, error);
        if (status == TN_OK)
            status =
                tn_plan_analysis_confirm(analysis, &examples[e], module->RULE_records[b->record].holds, e != 1, error);
        if (status == TN_LIMIT)
            status = TN_OK;
    }
    return status;
}
