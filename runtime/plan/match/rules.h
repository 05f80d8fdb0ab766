/* A set of rules made ready for matching: one small minimal automaton a rule over a shared table of tray
 * classes, or, where a rule passes the state limit, the reference engine. The automata are packed into tables that step
 * many of them at once on eight plans side by side: match_shuffle.h, match_joint.h.
 *
 * A tn_rules is immutable and may be shared between threads; a tn_matcher belongs to one thread. Both borrow
 * the schema.
 */
#ifndef TARTAN_PLAN_MATCH_RULES_H
#define TARTAN_PLAN_MATCH_RULES_H

#include "runtime/plan/match/match_shuffle.h"

typedef enum tn_matching_engine { TN_ENGINE_AUTO, TN_ENGINE_VM, TN_ENGINE_DFA } tn_matching_engine;

typedef struct tn_rules_options {
    tn_matching_engine engine;
    uint32_t max_states; /* of any intermediate automaton; 0: TN_STATES_DEFAULT */
    size_t max_length;   /* of a plan, for the reference engine; 0: its default */
    bool any;            /* tn_match_any will be asked: makes the automaton of the rules' union where that is small */
    tn_simd simd;        /* the best instruction set to use: TN_SIMD_BEST but in tests. Decisions are the same */
} tn_rules_options;

typedef struct tn_rules tn_rules;

/* functions: indices of HOLDS functions, in the order of the result bits. With TN_ENGINE_AUTO a rule past the state
 * limit falls back to the reference engine; with TN_ENGINE_DFA that is TN_LIMIT (E0802). */
tn_status tn_rules_new(const tn_schema *schema, const uint32_t *functions, size_t count,
                       const tn_rules_options *options, tn_rules **rules, tn_error *error);
void tn_rules_free(tn_rules *rules);

size_t tn_rules_count(const tn_rules *rules);

/* States of the minimal complete automaton of rule i; 0 where it fell back. */
uint32_t tn_rules_states(const tn_rules *rules, size_t i);

/* Why rule i fell back to the reference engine (a sentence; its code_offset names the instruction), or NULL. */
const tn_error *tn_rules_fallback(const tn_rules *rules, size_t i);

typedef struct tn_matcher tn_matcher;
tn_status tn_matcher_new(const tn_rules *rules, tn_matcher **matcher, tn_error *error);
void tn_matcher_free(tn_matcher *matcher);

/* Which rules match the plan: sets bit i % 64 of bits[i / 64]; bits has (count + 63) / 64 words. */
tn_status tn_match(tn_matcher *matcher, const tn_tray *trays, size_t length, uint64_t *bits, tn_error *error);

/* The same for many plans, which is several times as fast a plan: bits has so many words a plan. *done: the plans
 * decided; on a failure, the plan it is about, and the caller may go on with those after it. */
tn_status tn_match_all(tn_matcher *matcher, const tn_plan_array *plans, uint64_t *bits, size_t *done, tn_error *error);

/* Whether any rule matches: matches[i] is 0 or 1. *done as above. */
tn_status tn_match_any(tn_matcher *matcher, const tn_plan_array *plans, uint8_t *matches, size_t *done,
                       tn_error *error);

#endif
