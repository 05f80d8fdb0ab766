/* Rules alone and in pairs: never, always, and how the plans that two of them match lie to one another. */
#include <stdlib.h>

#include "runtime/base/random.h"
#include "runtime/plan/analysis/analysis_data.h"

/* Most pairs of rules overlap, and a few short plans show it: a pair is searched only for what they leave open. */
#define PROBES 256u
#define PROBE_LENGTH_MAX 6u

typedef struct probes {
    size_t count, words;
    uint64_t *matches; /* [rules][words] */
} probes;

/* ---- probing */

static void probe(const tn_plan_analysis *analysis, probes *p, const uint32_t *word, size_t length)
{
    if (length == 0)
        return;
    size_t at = p->count++;
    for (size_t r = 0; r < analysis->rule_count; r++)
        if (analysis->rules[r].dfa && tn_dfa_accepts(analysis->rules[r].dfa, word, length))
            p->matches[r * p->words + at / 64] |= UINT64_C(1) << (at % 64);
}

/* Probes with each rule's shortest plans and with random ones. */
static tn_status probe_all(const tn_plan_analysis *analysis, probes *p, tn_error *error)
{
    *p = (probes){.words = (2 * analysis->rule_count + PROBES) / 64 + 1};
    p->matches = calloc(analysis->rule_count * p->words + 1, sizeof *p->matches);
    if (!p->matches)
        return tn_fail_memory(error);
    for (size_t r = 0; r < analysis->rule_count; r++) {
        probe(analysis, p, analysis->rules[r].match.data, analysis->rules[r].match.size);
        probe(analysis, p, analysis->rules[r].reject.data, analysis->rules[r].reject.size);
    }
    for (uint32_t i = 0; i < PROBES; i++) {
        uint32_t word[PROBE_LENGTH_MAX], length = i % PROBE_LENGTH_MAX + 1;
        for (uint32_t k = 0; k < length; k++)
            word[k] = (uint32_t)(tn_random64(0, i, k) % analysis->classes->count);
        probe(analysis, p, word, length);
    }
    return TN_OK;
}

/* ---- pairs */

/* Is there a plan on which the two rules answer so? */
static tn_status exists(const tn_plan_analysis *analysis, const probes *p, const size_t pair[2], const bool wanted[2],
                        bool *found, tn_error *error)
{
    for (size_t w = 0; w < p->words; w++) {
        uint64_t a = p->matches[pair[0] * p->words + w], b = p->matches[pair[1] * p->words + w];
        if ((wanted[0] ? a : ~a) & (wanted[1] ? b : ~b) & (a | b)) {
            *found = true;
            return TN_OK;
        }
    }
    tn_search_part parts[2] = {{analysis->rules[pair[0]].dfa, wanted[0]}, {analysis->rules[pair[1]].dfa, wanted[1]}};
    tn_key word;
    tn_status status = tn_plan_analysis_search(analysis, parts, 2, 1, UINT32_MAX, "comparison", 0, &word, found, error);
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

static tn_status compare(const tn_plan_analysis *analysis, const probes *p, const size_t pair[2],
                         tn_rule_relation *relation, tn_error *error)
{
    static const bool wanted[3][2] = {{true, true}, {true, false}, {false, true}};
    bool found[3];
    *relation = TN_RULES_UNKNOWN;
    if (!analysis->rules[pair[0]].dfa || !analysis->rules[pair[1]].dfa)
        return TN_OK;
    for (int i = 0; i < 3; i++) {
        tn_status status = exists(analysis, p, pair, wanted[i], &found[i], error);
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

typedef struct comparing {
    tn_plan_analysis *analysis;
    const probes *probes;
} comparing;

/* A rule and those behind it: all pairs with at least one rule of the named file, and of those that are shown. */
static tn_status compare_rule(void *context, unsigned thread, size_t i, tn_error *error)
{
    const comparing *c = context;
    tn_plan_analysis *analysis = c->analysis;
    size_t n = analysis->rule_count;
    tn_status status = TN_OK;
    (void)thread;
    for (size_t j = i; status == TN_OK && j < n; j++) {
        const tn_plan_analysed_rule *a = &analysis->rules[i], *b = &analysis->rules[j];
        tn_rule_relation relation = TN_RULES_EQUAL;
        if (!a->own && !(a->named && b->named))
            continue;
        if (i != j)
            status = compare(analysis, c->probes, (size_t[2]){i, j}, &relation, error);
        analysis->relations[i * n + j] = (uint8_t)relation;
        analysis->relations[j * n + i] = (uint8_t)turned(relation);
    }
    return status;
}

/* Each by itself, so that the order in which threads take them changes nothing. */
static tn_status compare_all(tn_plan_analysis *analysis, const probes *p, tn_error *error)
{
    size_t n = analysis->rule_count;
    comparing c = {analysis, p};
    analysis->relations = calloc(n * n + 1, sizeof *analysis->relations);
    if (!analysis->relations)
        return tn_fail_memory(error);
    return tn_crew_run(analysis->crew, n, 1, compare_rule, &c, error);
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
    probes p = {0};
    tn_status status = find_extremes(analysis, error);
    if (status == TN_OK)
        status = probe_all(analysis, &p, error);
    if (status == TN_OK)
        status = compare_all(analysis, &p, error);
    free(p.matches);
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
