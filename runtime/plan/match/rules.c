/* Makes rules ready for matching, and matches plans. */
#include "runtime/plan/match/rules.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/match_any.h"
#include "runtime/plan/match/match_joint.h"
#include "runtime/plan/match/vm.h"
#include "runtime/plan/schema/classes.h"

/* Up to so many trays, the matchers' tables have a row for each, and plans need no translation into classes. */
#define TRAY_ROWS_MAX 512u

/* Plans whose bits tn_match_any holds at a time, where there is no automaton for it. */
#define PLANS_AT_ONCE 256u

struct tn_rules {
    const tn_schema *schema;
    tn_classes *classes; /* NULL where no rule has an automaton */
    size_t count;
    size_t words;  /* of a plan's result bits */
    size_t fallen; /* rules that the reference engine decides */
    size_t max_length;
    uint32_t *functions;
    uint32_t *states;     /* [count]: of the rule's automaton; 0: it has none */
    tn_error **fallbacks; /* [count]: NULL, or why */
    tn_row_map map;
    uint32_t *letters; /* [classes]: each its own letter, where rows are classes */
    tn_shuffles shuffles;
    tn_joints joints;
    tn_any any;
};

struct tn_matcher {
    const tn_rules *rules;
    tn_plan_vm *vm; /* NULL where no rule needs it */
    tn_lanes lanes;
    uint64_t *found; /* [TN_LANES][words]: of the last plans, where they are fewer than the lanes */
    uint64_t *some;  /* [PLANS_AT_ONCE][words], for tn_match_any without an automaton; NULL before */
};

/* ---- making */

static tn_status fall_back(tn_rules *rules, size_t i, const tn_error *why, tn_error *error)
{
    rules->fallbacks[i] = malloc(sizeof **rules->fallbacks);
    if (!rules->fallbacks[i])
        return tn_fail_memory(error);
    *rules->fallbacks[i] = *why;
    rules->fallen++;
    return TN_OK;
}

static tn_status lower_rules(tn_rules *rules, tn_lowering *lowering, tn_matching_engine engine, tn_dfa **dfas,
                             tn_error *error)
{
    for (size_t i = 0; i < rules->count; i++) {
        tn_error why;
        tn_status status = tn_lower(lowering, rules->functions[i], &dfas[i], &why);
        if (status == TN_OK)
            rules->states[i] = dfas[i]->states;
        else if (status == TN_LIMIT && engine == TN_ENGINE_AUTO)
            status = fall_back(rules, i, &why, error);
        else if (error)
            *error = why;
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status map_rows(tn_rules *rules, tn_error *error)
{
    const tn_classes *classes = rules->classes;
    if (classes->of_tray && rules->schema->tray_count <= TRAY_ROWS_MAX) {
        rules->map = (tn_row_map){.rows = rules->schema->tray_count, .letter = classes->of_tray};
        return TN_OK;
    }
    rules->letters = malloc((classes->count + 1) * sizeof *rules->letters);
    if (!rules->letters)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < classes->count; i++)
        rules->letters[i] = i;
    rules->map = (tn_row_map){.rows = classes->count, .letter = rules->letters, .classes = classes};
    return TN_OK;
}

/* The tables that match: by shuffles what they can take, by look-ups the rest. */
static tn_status make_tables(tn_rules *rules, const tn_rules_options *options, tn_dfa *const *dfas, tn_error *error)
{
    tn_simd simd = tn_simd_choose(options->simd);
    bool *taken = calloc(rules->count + 1, sizeof *taken);
    tn_status status = taken ? map_rows(rules, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_shuffles_make(&rules->shuffles, simd, &rules->map, dfas, rules->count, taken, error);
    if (status == TN_OK)
        status = tn_joints_make(&rules->joints, &rules->map, dfas, rules->count, taken, error);
    if (status == TN_OK && options->any && rules->fallen == 0)
        status = tn_any_make(&rules->any, &rules->map, dfas, rules->count, error);
    free(taken);
    return status;
}

static tn_status compile(tn_rules *rules, const tn_rules_options *options, tn_error *error)
{
    if (options->engine == TN_ENGINE_VM) {
        rules->fallen = rules->count;
        return TN_OK;
    }
    tn_status status = tn_classes_new(rules->schema, rules->functions, rules->count, &rules->classes, error);
    if (status != TN_OK)
        return status;
    tn_lowering *lowering = NULL;
    tn_dfa **dfas = calloc(rules->count + 1, sizeof *dfas);
    status = dfas ? tn_lowering_new(rules->classes, options->max_states, &lowering, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = lower_rules(rules, lowering, options->engine, dfas, error);
    tn_lowering_free(lowering);
    if (status == TN_OK)
        status = make_tables(rules, options, dfas, error);
    for (size_t i = 0; dfas && i < rules->count; i++)
        tn_dfa_free(dfas[i]);
    free(dfas);
    return status;
}

tn_status tn_rules_new(const tn_schema *schema, const uint32_t *functions, size_t count,
                       const tn_rules_options *options, tn_rules **out, tn_error *error)
{
    static const tn_rules_options defaults = {.engine = TN_ENGINE_AUTO};
    tn_rules *rules = calloc(1, sizeof *rules);
    if (!rules)
        return tn_fail_memory(error);
    options = options ? options : &defaults;
    rules->schema = schema;
    rules->max_length = options->max_length;
    rules->functions = calloc(count + 1, sizeof *rules->functions);
    rules->states = calloc(count + 1, sizeof *rules->states);
    rules->fallbacks = calloc(count + 1, sizeof *rules->fallbacks);
    tn_status status = TN_OK;
    if (!rules->functions || !rules->states || !rules->fallbacks) {
        status = tn_fail_memory(error);
    } else {
        rules->count = count;
        rules->words = (count + 63) / 64;
        if (count > 0)
            memcpy(rules->functions, functions, count * sizeof *functions);
        status = compile(rules, options, error);
    }
    if (status != TN_OK) {
        tn_rules_free(rules);
        return status;
    }
    *out = rules;
    return TN_OK;
}

void tn_rules_free(tn_rules *rules)
{
    if (!rules)
        return;
    tn_shuffles_clear(&rules->shuffles);
    tn_joints_clear(&rules->joints);
    tn_any_clear(&rules->any);
    for (size_t i = 0; i < rules->count; i++)
        free(rules->fallbacks[i]);
    free(rules->letters);
    free(rules->states);
    free(rules->fallbacks);
    free(rules->functions);
    tn_classes_free(rules->classes);
    free(rules);
}

size_t tn_rules_count(const tn_rules *rules)
{
    return rules->count;
}

uint32_t tn_rules_states(const tn_rules *rules, size_t i)
{
    return rules->states[i];
}

const tn_error *tn_rules_fallback(const tn_rules *rules, size_t i)
{
    return rules->fallbacks[i];
}

/* ---- matching */

tn_status tn_matcher_new(const tn_rules *rules, tn_matcher **out, tn_error *error)
{
    tn_matcher *matcher = calloc(1, sizeof *matcher);
    if (!matcher)
        return tn_fail_memory(error);
    matcher->rules = rules;
    matcher->lanes.masked = rules->shuffles.simd == TN_SIMD_AVX512;
    matcher->found = malloc((TN_LANES * rules->words + 1) * sizeof *matcher->found);
    tn_status status = matcher->found ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && rules->fallen > 0)
        status = tn_plan_vm_new(rules->schema, rules->max_length, &matcher->vm, error);
    if (status != TN_OK) {
        tn_matcher_free(matcher);
        return status;
    }
    *out = matcher;
    return TN_OK;
}

void tn_matcher_free(tn_matcher *matcher)
{
    if (!matcher)
        return;
    tn_plan_vm_free(matcher->vm);
    free(matcher->lanes.rows);
    free(matcher->found);
    free(matcher->some);
    free(matcher);
}

/* Plans [first, first + TN_LANES) through all the tables; their bits are clear before. */
static tn_status match_lanes(tn_matcher *matcher, const tn_plan_array *plans, size_t first, uint64_t *bits,
                             tn_error *error)
{
    const tn_rules *rules = matcher->rules;
    size_t left = plans->count - first, words = rules->words;
    if (!tn_lanes_fill(&matcher->lanes, &rules->map, plans, first))
        return tn_fail_memory(error);
    uint64_t *found = left < TN_LANES ? matcher->found : bits + first * words;
    if (left < TN_LANES)
        memset(found, 0, TN_LANES * words * sizeof *found);
    for (size_t i = 0; i < rules->shuffles.count; i++)
        tn_shuffle_walk(&rules->shuffles, i, &matcher->lanes, found, words);
    for (size_t i = 0; i < rules->joints.count; i++)
        tn_joint_walk(&rules->joints.items[i], &matcher->lanes, found, words);
    if (left < TN_LANES)
        memcpy(bits + first * words, found, left * words * sizeof *found);
    return TN_OK;
}

/* Adds the bits of the rules that the reference engine decides. */
static tn_status interpret(tn_matcher *matcher, const tn_tray *trays, size_t length, uint64_t *bits, tn_error *error)
{
    const tn_rules *rules = matcher->rules;
    tn_status status = tn_plan_vm_plan(matcher->vm, trays, length, error);
    for (size_t i = 0; status == TN_OK && i < rules->count; i++) {
        bool matches = false;
        if (rules->states[i] > 0)
            continue;
        status = tn_plan_vm_holds(matcher->vm, rules->functions[i], &matches, error);
        bits[i / 64] |= (uint64_t)matches << (i % 64);
    }
    return status;
}

tn_status tn_match_all(tn_matcher *matcher, const tn_plan_array *plans, uint64_t *bits, size_t *done, tn_error *error)
{
    const tn_rules *rules = matcher->rules;
    *done = 0;
    memset(bits, 0, plans->count * rules->words * sizeof *bits);
    for (size_t i = 0; rules->fallen < rules->count && i < plans->count; i += TN_LANES) {
        tn_status status = match_lanes(matcher, plans, i, bits, error);
        if (status != TN_OK)
            return status;
    }
    for (; rules->fallen > 0 && *done < plans->count; ++*done) {
        size_t begin = *done ? plans->ends[*done - 1] : plans->begin;
        tn_status status =
            interpret(matcher, plans->trays + begin, plans->ends[*done] - begin, bits + *done * rules->words, error);
        if (status != TN_OK)
            return status;
    }
    *done = plans->count;
    return TN_OK;
}

static tn_status walk_any(tn_matcher *matcher, const tn_plan_array *plans, uint8_t *matches, size_t *done,
                          tn_error *error)
{
    const tn_rules *rules = matcher->rules;
    const tn_any *any = &rules->any;
    bool glance = !rules->map.classes && any->sink != UINT16_MAX;
    for (size_t i = 0; i < plans->count; i += TN_LANES) {
        uint8_t found[TN_LANES];
        size_t left = plans->count - i;
        if (glance && left >= TN_LANES && tn_any_glance(any, plans, i, matches + i))
            continue;
        if (!tn_lanes_fill(&matcher->lanes, &rules->map, plans, i))
            return tn_fail_memory(error);
        tn_any_walk(any, &matcher->lanes, found);
        memcpy(matches + i, found, left < TN_LANES ? left : TN_LANES);
    }
    *done = plans->count;
    return TN_OK;
}

/* By the bits of all rules, some plans at a time. */
static tn_status any_of_all(tn_matcher *matcher, const tn_plan_array *plans, uint8_t *matches, size_t *done,
                            tn_error *error)
{
    size_t words = matcher->rules->words;
    if (!matcher->some && !(matcher->some = malloc((PLANS_AT_ONCE * words + 1) * sizeof *matcher->some)))
        return tn_fail_memory(error);
    while (*done < plans->count) {
        size_t left = plans->count - *done, decided;
        tn_plan_array some = {.trays = plans->trays,
                              .begin = *done ? plans->ends[*done - 1] : plans->begin,
                              .ends = plans->ends + *done,
                              .count = left < PLANS_AT_ONCE ? left : PLANS_AT_ONCE};
        tn_status status = tn_match_all(matcher, &some, matcher->some, &decided, error);
        for (size_t i = 0; i < decided; i++) {
            uint64_t bits = 0;
            for (size_t w = 0; w < words; w++)
                bits |= matcher->some[i * words + w];
            matches[*done + i] = bits != 0;
        }
        *done += decided;
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

tn_status tn_match_any(tn_matcher *matcher, const tn_plan_array *plans, uint8_t *matches, size_t *done, tn_error *error)
{
    *done = 0;
    return matcher->rules->any.table ? walk_any(matcher, plans, matches, done, error)
                                     : any_of_all(matcher, plans, matches, done, error);
}

tn_status tn_match(tn_matcher *matcher, const tn_tray *trays, size_t length, uint64_t *bits, tn_error *error)
{
    size_t done;
    return tn_match_all(matcher, &(tn_plan_array){.trays = trays, .ends = &length, .count = 1}, bits, &done, error);
}
