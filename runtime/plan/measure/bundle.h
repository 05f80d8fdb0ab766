/* The automaton of a library joined with any number of measures: what its plans come to, all measures together.
 *
 * Each measure has its own automaton joined with the library's; a state is one of each. So what measures remember is
 * multiplied only as far as plans of the library do. States are met when they are first asked for. The numbers that
 * trays add are whole steps of each sum's unit, in the order of the measures; of a quotient what is divided comes
 * first, then what it is divided by. A tn_bundle borrows the library; it belongs to one thread. */
#ifndef TARTAN_PLAN_MEASURE_BUNDLE_H
#define TARTAN_PLAN_MEASURE_BUNDLE_H

#include "runtime/automata/numbering.h"
#include "runtime/plan/library/library.h"

#define TN_BUNDLE_MEASURES_MAX 32u
#define TN_BUNDLE_SUMS_MAX (2 * TN_BUNDLE_MEASURES_MAX)

/* A measure: SUM records of the library's schema. over: what is divided by; TN_NO_RECORD: it is no quotient. */
typedef struct tn_bundle_measure {
    const char *name;
    uint32_t sum, over;
} tn_bundle_measure;

/* A measure of the library by its number (named.h). */
tn_bundle_measure tn_bundle_measure_of(const tn_module *module, const tn_library_record *library, uint32_t measure);

/* Trays alike: from a state they lead to one state and add the same. */
typedef struct tn_bundle_edge {
    uint32_t target;
    uint64_t trays;
    size_t gains; /* the first of their numbers (tn_bundle_gains) */
} tn_bundle_edge;

typedef struct tn_bundle tn_bundle;

/* Of at most TN_BUNDLE_MEASURES_MAX measures, or none. Otherwise as tn_weighed_new. */
tn_status tn_bundle_new(const tn_library *library, const tn_bundle_measure *measures, uint32_t count,
                        tn_bundle **bundle, tn_error *error);
void tn_bundle_free(tn_bundle *bundle);

const tn_library *tn_bundle_library(const tn_bundle *bundle);
uint32_t tn_bundle_sums(const tn_bundle *bundle);
uint32_t tn_bundle_states(const tn_bundle *bundle); /* that were met so far; 0 is the start */

/* What each sum begins with. */
int64_t tn_bundle_start(const tn_bundle *bundle, uint32_t sum);

/* The edges of a state, valid until more is asked for. */
tn_status tn_bundle_edges(tn_bundle *bundle, uint32_t state, const tn_bundle_edge **edges, size_t *count,
                          tn_error *error);
const int64_t *tn_bundle_gains(const tn_bundle *bundle, const tn_bundle_edge *edge);

/* Does a kept plan end in the state? */
bool tn_bundle_ends(const tn_bundle *bundle, uint32_t state);
/* Has such a plan a value of the measure? */
bool tn_bundle_valued(const tn_bundle *bundle, uint32_t state, uint32_t measure);
/* What is added to a sum where the plan ends. */
int64_t tn_bundle_rest(const tn_bundle *bundle, uint32_t state, uint32_t sum);

/* A measure has the sums from first(k) to first(k + 1). */
uint32_t tn_bundle_first(const tn_bundle *bundle, uint32_t measure);
/* Its value of a plan with these sums (of all measures), in nanometres to its power; `value` is initialised. */
void tn_bundle_value(const tn_bundle *bundle, uint32_t measure, const int64_t *sums, mpq_t value);

/* Trays of one letter are alike in every state. Where a state leads by one: the target (UINT32_MAX: no kept plan
 * follows), and what is added to each sum. */
uint32_t tn_bundle_letter(const tn_bundle *bundle, tn_tray tray);
uint32_t tn_bundle_letters(const tn_bundle *bundle);
tn_status tn_bundle_step(tn_bundle *bundle, uint32_t state, uint32_t letter, uint32_t *target, int64_t *gains,
                         tn_error *error);

/* ---- plans counted by what they come to */

/* Zero it to begin with. A key is a state, or another number, and two words for each sum. */
typedef struct tn_crowd {
    tn_interner keys;
    mpz_t *plans; /* [count] */
    size_t count, room;
} tn_crowd;

/* The plans of a key, which is new or not; NULL: out of memory. */
mpz_ptr tn_crowd_at(tn_crowd *crowd, const tn_key *key);
/* Those of a key that is there; NULL: there are none. */
mpz_srcptr tn_crowd_find(const tn_crowd *crowd, const tn_key *key);
void tn_crowd_forget(tn_crowd *crowd); /* its plans, and not its room */
void tn_crowd_clear(tn_crowd *crowd);

/* Sums in keys: false: out of memory. */
bool tn_key_push_sum(tn_key *key, int64_t sum);
static inline int64_t tn_key_sum(const uint32_t *words, size_t number)
{
    return (int64_t)((uint64_t)words[2 * number] << 32 | words[2 * number + 1]);
}

#endif
