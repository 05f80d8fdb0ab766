/* A library with measures: its automaton joined with what the measures have to remember, each step with what it adds.
 *
 * A state is met when it is first asked for; its edges are found once. Values are whole steps of each measure's unit;
 * the constant of a measure is a start value. A tn_weighed borrows the library; it belongs to one thread.
 */
#ifndef TARTAN_PLAN_MEASURE_WEIGHED_H
#define TARTAN_PLAN_MEASURE_WEIGHED_H

#include "runtime/plan/library/library.h"

#define TN_WEIGHED_MAX 3 /* sums at a time: a measure is one, a quotient two */

/* Trays alike: from a state they lead to one state and add the same. */
typedef struct tn_weighed_edge {
    uint32_t target;
    tn_tray first;   /* the first of them */
    uint32_t letter; /* of the first */
    uint64_t trays;
    int64_t gain[TN_WEIGHED_MAX];
} tn_weighed_edge;

typedef struct tn_weighed tn_weighed;

/* measures: of the library (named.h), which has a record if its preference is among them. E0802 where they remember too
 * much, E0424 where their numbers are too fine, E0831 where they are of more than TN_WEIGHED_MAX sums. */
tn_status tn_weighed_new(const tn_library *library, const uint32_t *measures, uint32_t count, tn_weighed **weighed,
                         tn_error *error);

/* The same for SUM records of the library's schema that have these names. */
tn_status tn_weighed_of_sums(const tn_library *library, const uint32_t *sums, const char *const *names, uint32_t count,
                             tn_weighed **weighed, tn_error *error);
void tn_weighed_free(tn_weighed *weighed);

const tn_library *tn_weighed_library(const tn_weighed *weighed);

/* ---- sums, in the order of the measures; of a quotient what is divided, then what it is divided by */
uint32_t tn_weighed_count(const tn_weighed *weighed);
const char *tn_weighed_name(const tn_weighed *weighed, uint32_t sum);
mpq_srcptr tn_weighed_unit(const tn_weighed *weighed, uint32_t sum); /* a step, in nanometres to its power */
int64_t tn_weighed_start(const tn_weighed *weighed, uint32_t sum);   /* steps before the first tray */

/* ---- measures */
uint32_t tn_weighed_measures(const tn_weighed *weighed);
uint32_t tn_weighed_sum(const tn_weighed *weighed, uint32_t measure, bool *over); /* its first; over: is it of two? */
int tn_weighed_power(const tn_weighed *weighed, uint32_t measure);                /* of a length */
/* Of a plan with these values of the sums, in nanometres to its power; `value` is initialised. */
void tn_weighed_value(const tn_weighed *weighed, uint32_t measure, const int64_t *values, mpq_t value);

/* TN_STOPPED where whoever waits for the answer has ended the work. */
tn_status tn_weighed_check(const tn_weighed *weighed, tn_error *error);

/* The start state is 0. The edges of a state; valid until the next call for another state. Checks whether to go on. */
tn_status tn_weighed_edges(tn_weighed *weighed, uint32_t state, const tn_weighed_edge **edges, size_t *count,
                           tn_error *error);

/* Does a kept plan follow with so many trays to come? */
bool tn_weighed_alive(const tn_weighed *weighed, uint32_t left, uint32_t state);

/* Has a plan that ends in the state a value of each measure? */
bool tn_weighed_valued(const tn_weighed *weighed, uint32_t state);

/* What is added where the plan ends in the state. */
int64_t tn_weighed_rest(const tn_weighed *weighed, uint32_t state, uint32_t sum);

/* The trays of the schema by letters: trays of one letter are alike in every state. */
uint32_t tn_weighed_letter(const tn_weighed *weighed, tn_tray tray);
uint32_t tn_weighed_letters(const tn_weighed *weighed);

/* The first tray of a letter, and of a tray the next one that has its letter: the number of trays if there is none. */
tn_tray tn_weighed_first_tray(const tn_weighed *weighed, uint32_t letter);
tn_tray tn_weighed_next_tray(const tn_weighed *weighed, tn_tray tray);

/* Where a state leads by a letter: the target (UINT32_MAX: no kept plan follows) and what is added. */
tn_status tn_weighed_step(tn_weighed *weighed, uint32_t state, uint32_t letter, uint32_t *target, int64_t *gain,
                          tn_error *error);

#endif
