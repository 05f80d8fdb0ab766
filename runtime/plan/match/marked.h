/* Relations over the stretches of plans, as automata: the fast engine's form of what opcodes.def calls a relation.
 *
 * That [i, j) of a plan is in a relation may depend on the whole plan (beginning, end, distances), so an automaton
 * reads the whole plan with the stretch marked in it: the word u x v y z, where u v z is the plan in tray classes, v
 * the stretch, and x and y are markers. The usual construction puts marker bits into every letter, which makes four
 * letters of each class and needs an end mark for j = N. Here the markers are one further letter, the last, read twice:
 * a state knows its phase (before x, between, after y), so it has one column more than there are classes instead of
 * four times as many, an empty stretch is simply x followed by y, and the plan's end needs no letter. Every automaton
 * accepts only words with exactly two markers ("marked words"); complements are within them.
 *
 * All functions return minimal canonical automata, which the caller owns; operands are only read. TN_LIMIT is E0802,
 * its code_offset is the caller's to set. Rules' equations: plan-language documentation, "Semantics" (M and H).
 */
#ifndef TARTAN_PLAN_MATCH_MARKED_H
#define TARTAN_PLAN_MATCH_MARKED_H

#include "runtime/plan/automata/dfa.h"
#include "runtime/plan/schema/classes.h"

/* What all constructions of one set of rules share: a few fixed automata. Free with tn_marked_clear. */
typedef struct tn_marked {
    const tn_classes *classes;
    uint32_t letters; /* classes and the marker */
    tn_bounds *bounds;
    tn_dfa *all;       /* every marked word */
    tn_dfa *nonempty;  /* those whose stretch has a tray */
    tn_dfa *empty;     /* those whose stretch has none */
    tn_dfa *single;    /* those whose stretch is one tray */
    tn_dfa *beginning; /* those that start with x */
    tn_dfa *end;       /* those that end with y */
} tn_marked;

tn_status tn_marked_make(tn_marked *marked, const tn_classes *classes, tn_bounds *bounds, tn_error *error);
void tn_marked_clear(tn_marked *marked);

/* TRAY: stretches of one tray that meets the specifier. */
tn_status tn_marked_tray(const tn_marked *marked, uint32_t spec, tn_dfa **out, tn_error *error);

/* NOT: complement within the marked words. */
tn_status tn_marked_not(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error);

/* CHAIN: v = v1 v2 with v1 in a and v2 in b; guesses the cut. */
tn_status tn_marked_chain(const tn_marked *marked, const tn_dfa *a, const tn_dfa *b, tn_dfa **out, tn_error *error);

/* SOMEWHERE: stretches that contain a non-empty stretch of a. */
tn_status tn_marked_somewhere(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error);

/* MANY: non-empty stretches whose single trays are all in a. */
tn_status tn_marked_many(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error);

/* DISTANCE: source less the stretches with some destination at a gap that fails the separator. The gap of an overlap is
 * the empty stretch at the source's start (`mirrored`: at its end). */
tn_status tn_marked_distance(const tn_marked *marked, const tn_dfa *source, const tn_dfa *destination,
                             const tn_dfa *separator, bool mirrored, tn_dfa **out, tn_error *error);

/* Counting conditions. */
typedef enum tn_tally {
    TN_TALLY_SINGLES, /* QUANTITY and SUM: k in [i, j) with [k, k + 1) in the relation */
    TN_TALLY_STARTS,  /* OCCURRENCES: k in [i, j) where some non-empty [k, b) within is */
    TN_TALLY_ENDS,    /* OCCURRENCES mirrored: k in (i, j] where some non-empty [a, k) within is */
} tn_tally;

#define TN_NO_FIELD UINT32_MAX

/* Stretches whose tally meets a condition function; a field (index within the schema) other than TN_NO_FIELD: each
 * counts as much as its tray's length in that field. */
tn_status tn_marked_count(const tn_marked *marked, const tn_dfa *a, tn_tally tally, uint32_t condition, uint32_t field,
                          tn_dfa **out, tn_error *error);

/* The plans whose whole stretch is in a relation: an automaton over the classes alone. */
tn_status tn_marked_whole(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error);

/* The plans that contain a non-empty stretch of a relation: tn_marked_whole of tn_marked_somewhere, without the detour.
 */
tn_status tn_marked_anywhere(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error);

#endif
