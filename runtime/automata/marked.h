/* Relations over the stretches of words, as automata: the fast engine's form of what opcodes.def calls a relation.
 *
 * That [i, j) of a word is in a relation may depend on the whole word (beginning, end, distances), so an automaton
 * reads the whole word with the stretch marked in it: u x v y z, where u v z is the word, v the stretch, and x and y
 * are markers. The usual construction puts marker bits into every letter, which makes four letters of each and needs an
 * end mark for j = N. Here the markers are one further letter, the last, read twice: a state knows its phase (before x,
 * between, after y), so it has one column more than there are letters instead of four times as many, an empty stretch
 * is simply x followed by y, and the word's end needs no letter. Every automaton accepts only words with exactly two
 * markers ("marked words"); complements are within them.
 *
 * All functions return minimal canonical automata, which the caller owns; operands are only read. TN_LIMIT is E0802,
 * its code_offset is the caller's to set. Rules' equations: plan-language documentation, "Semantics" (M and H).
 */
#ifndef TARTAN_AUTOMATA_MARKED_H
#define TARTAN_AUTOMATA_MARKED_H

#include "runtime/automata/dfa.h"

/* What all constructions over the same letters share: a few fixed automata. Free with tn_marked_clear. */
typedef struct tn_marked {
    uint32_t letters; /* with the marker */
    tn_bounds *bounds;
    tn_dfa *all;       /* every marked word */
    tn_dfa *nonempty;  /* those whose stretch has a letter */
    tn_dfa *empty;     /* those whose stretch has none */
    tn_dfa *single;    /* those whose stretch is one letter */
    tn_dfa *beginning; /* those that start with x */
    tn_dfa *end;       /* those that end with y */
} tn_marked;

/* letters: without the marker. */
tn_status tn_marked_make(tn_marked *marked, uint32_t letters, tn_bounds *bounds, tn_error *error);
void tn_marked_clear(tn_marked *marked);

/* Stretches of one letter that is chosen; chosen: 0 or 1 for each letter but the marker. */
tn_status tn_marked_letter(const tn_marked *marked, const uint8_t *chosen, tn_dfa **out, tn_error *error);

/* NOT: complement within the marked words. */
tn_status tn_marked_not(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error);

/* CHAIN: v = v1 v2 with v1 in a and v2 in b; guesses the cut. */
tn_status tn_marked_chain(const tn_marked *marked, const tn_dfa *a, const tn_dfa *b, tn_dfa **out, tn_error *error);

/* SOMEWHERE: stretches that contain a non-empty stretch of a. */
tn_status tn_marked_somewhere(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error);

/* MANY: non-empty stretches whose single letters are all in a. */
tn_status tn_marked_many(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error);

/* REPEATED: stretches cut into `least` to `most` non-empty stretches of a, one after another. most 0: into any number from
 * `least` on. least: at least 1. */
tn_status tn_marked_repeat(const tn_marked *marked, const tn_dfa *a, uint32_t least, uint32_t most, tn_dfa **out,
                           tn_error *error);

/* DISTANCE: source less the stretches with some destination at a gap that fails the separator. The gap of an overlap is
 * the empty stretch at the source's start (`mirrored`: at its end). */
tn_status tn_marked_distance(const tn_marked *marked, const tn_dfa *source, const tn_dfa *destination,
                             const tn_dfa *separator, bool mirrored, tn_dfa **out, tn_error *error);

/* NEAR: stretches of the source with a destination that shares no letter with them and whose gap is in the separator.
 */
tn_status tn_marked_near(const tn_marked *marked, const tn_dfa *source, const tn_dfa *destination,
                         const tn_dfa *separator, tn_dfa **out, tn_error *error);

/* FAR: stretches of the source such that the gap to every destination that shares no letter with them is in it. */
tn_status tn_marked_far(const tn_marked *marked, const tn_dfa *source, const tn_dfa *destination,
                        const tn_dfa *separator, tn_dfa **out, tn_error *error);

/* MIRRORED: stretches on which each letter has the value of the one as far from the other end. values: [letters], the
 * marker's is not looked at. longest: no word asked about has more letters. */
tn_status tn_marked_mirrored(const tn_marked *marked, const uint32_t *values, uint32_t longest, tn_dfa **out,
                             tn_error *error);

/* Counting conditions. */
typedef enum tn_tally {
    TN_TALLY_SINGLES, /* QUANTITY and SUM: k in [i, j) with [k, k + 1) in the relation */
    TN_TALLY_STARTS,  /* OCCURRENCES: k in [i, j) where some non-empty [k, b) within is */
    TN_TALLY_ENDS,    /* OCCURRENCES mirrored: k in (i, j] where some non-empty [a, k) within is */
} tn_tally;

/* A set of numbers that repeats from `threshold` on: n is in it where holds[n], and from threshold + period on where
 * n - period is. */
typedef struct tn_periodic_set {
    uint64_t threshold, period; /* the period is at least 1 */
    const uint8_t *holds;       /* [threshold + period] */
} tn_periodic_set;

/* Stretches whose tally is in the set. counts: how much each letter but the marker counts; NULL: one each. */
tn_status tn_marked_count(const tn_marked *marked, const tn_dfa *a, tn_tally tally, const tn_periodic_set *set,
                          const uint64_t *counts, tn_dfa **out, tn_error *error);

/* The words whose whole stretch is in a relation: an automaton without the marker. */
tn_status tn_marked_whole(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error);

/* The whole of each word that an automaton without the marker accepts. */
tn_status tn_marked_words(const tn_marked *marked, const tn_dfa *words, tn_dfa **out, tn_error *error);

/* The words that contain a non-empty stretch of a relation: tn_marked_whole of tn_marked_somewhere, without the detour.
 */
tn_status tn_marked_anywhere(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error);

#endif
