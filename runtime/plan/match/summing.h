/* Sums of several terms, while a plan with a marked stretch is read from left to right: a machine whose states are keys
 * and which says at each step by how much the sum has grown for certain.
 *
 * What a tray decides alone is added when it is read; places that what follows may still decide wait in the key, each
 * kind with the steps that it would add. A tn_summing borrows the sum, the classes and the automata; it belongs to one
 * thread. Clear it after use.
 */
#ifndef TARTAN_PLAN_MATCH_SUMMING_H
#define TARTAN_PLAN_MATCH_SUMMING_H

#include "runtime/automata/guesses.h"
#include "runtime/automata/marked.h"
#include "runtime/module/code.h"
#include "runtime/plan/schema/classes.h"
#include "runtime/plan/schema/sum.h"

typedef struct tn_summing_term {
    tn_guesses guesses;
    uint32_t phase;  /* in which its places lie: how many markers have been read there */
    int64_t *weight; /* [columns]: steps of a place that the column's tray makes */
} tn_summing_term;

typedef struct tn_summing_pending {
    uint32_t term, set;
    int64_t steps;
} tn_summing_pending;

typedef struct tn_summing {
    tn_join join;
    uint32_t marker; /* column of the join */
    int64_t *local;  /* [3][columns]: steps of a tray, by the terms that it decides alone: before the stretch, in it,
                        behind it */
    tn_summing_term *terms; /* those that the trays around decide too */
    uint32_t count;
    uint64_t *present;          /* [columns]: a bit for each term that wants such a tray in the stretch */
    int64_t *present_steps;     /* [present_count] */
    uint32_t present_count;     /* at most TN_PRESENT_MAX */
    bool behind;                /* does a term count what lies behind the stretch? */
    int64_t most_up, most_down; /* by how much a tray can raise or lower the sum, both at least 0 */
    tn_summing_pending *pending;
    size_t pending_size, pending_capacity;
    uint64_t effort;
    bool failed;
} tn_summing;

#define TN_PRESENT_MAX 64u /* terms of a sum that are there or not: more are E0802 */

/* Does the relation of a function say of one tray alone whether it is in it, whatever stands around it? known: zeroed
 * to begin with, [FUNCTION records]: what has been found so far. */
bool tn_summing_is_local(const tn_module *module, uint32_t function, uint8_t *known);

/* parts: the automaton of each term's part, [sum->count]; NULL for singles whose part is local, and for `matches`,
 * which is left out. reversed: the automata are of the reversed plan. */
tn_status tn_summing_make(tn_summing *summing, const tn_sum *sum, const tn_marked *marked, const tn_classes *classes,
                          tn_dfa *const *parts, bool reversed, tn_error *error);
void tn_summing_clear(tn_summing *summing);

/* Appends the state before everything to the key; false where out of memory. */
bool tn_summing_start(const tn_summing *summing, tn_key *key);

/* Appends the state after a column to `next`; *gain: what has become certain. */
bool tn_summing_step(tn_summing *summing, const uint32_t *key, size_t size, uint32_t column, tn_key *next,
                     int64_t *gain);

/* Does a key of this size hold places that what follows may still decide? */
bool tn_summing_waits(const tn_summing *summing, size_t size);

/* What is added where the plan ends in this state. */
int64_t tn_summing_rest(const tn_summing *summing, const uint32_t *key, size_t size);

/* The stretches on which the sum, with its constant, compares so with 0, or is a multiple: `compare` is BELOW, ZERO,
 * ABOVE or MULTIPLE. max_trays: of the plans that will be asked about, or 0 where that is not known: then sums that
 * rise and fall are E0802. */
tn_status tn_relate_sum(const tn_marked *marked, const tn_classes *classes, const tn_sum *sum, tn_dfa *const *parts,
                        bool reversed, const tn_instruction *compare, uint32_t max_trays, tn_dfa **out,
                        tn_error *error);

#endif
