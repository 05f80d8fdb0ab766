/* A library as one automaton: generator less the union of the prunes. Its paths are the library, so it is counted,
 * ranked, sampled and enumerated without generating and throwing away.
 *
 * The automaton is of plans of any length where that is little work, since then it has few states however many trays
 * there are. Otherwise it is of the library's lengths only (within them): what a rule could still remember or come to
 * demand past the longest plan then makes no states.
 *
 * Rank order: length, then tray by tray (tray numbers are schema order). Ranks start at 0.
 * A tn_library is immutable once opened and may be shared between threads; a tn_cursor belongs to one. It borrows the
 * schema.
 */
#ifndef TARTAN_PLAN_LIBRARY_LIBRARY_H
#define TARTAN_PLAN_LIBRARY_LIBRARY_H

#include <gmp.h>

#include "runtime/plan/library/memory.h"
#include "runtime/plan/schema/classes.h"

typedef struct tn_library tn_library;
typedef struct tn_sparse tn_sparse;

typedef struct tn_library_options {
    uint32_t max_states; /* of any intermediate automaton; 0: TN_STATES_DEFAULT for
                                 each clause, 1,000,000 for the clauses together */
    bool all_generated;  /* leave pruning out: the plans are all that are generated */
    bool only_counted;   /* plans are only counted, also those before a plan: a library whose clauses together pass a
                                 limit may then leave one of them out of its automaton (tn_library_apart) */
    bool override_trays; /* take the lengths below instead of the library's own */
    uint32_t trays_min, trays_max;
    uint32_t max_length;       /* the largest trays_max that is accepted; 0: 4,096 (E0805 past it) */
    uint64_t max_table;        /* bytes of the table of counts; 0: 4 GiB (E0806 past it) */
    uint64_t max_eager;        /* steps that combining the clauses may take before it is tried within the lengths; 0:
                                  3,000,000 */
    tn_plan_memory *memory;    /* where counts of clauses are found and kept, borrowed; or NULL */
    unsigned threads;          /* that may count clauses; 0: as many as there are processors */
    const tn_classes *classes; /* its automata are over these classes, as far as they are finer than what its clauses
                                  need: for who asks about other rules too; borrowed, or NULL */
} tn_library_options;

/* index: of the LIBRARY record. Fails with TN_LIMIT (E0802) naming the clause in the way. */
tn_status tn_library_new(const tn_schema *schema, uint32_t index, const tn_library_options *options,
                         tn_library **library, tn_error *error);

/* A library that is not written anywhere: the plans of min to max trays that `sparse` accepts. For counting, ranking
 * and sampling; it has no clauses and no record. Takes over the classes, also where it fails. */
tn_status tn_library_of(tn_classes *classes, const tn_sparse *sparse, uint32_t min, uint32_t max, uint64_t max_table,
                        tn_library **library, tn_error *error);
void tn_library_free(tn_library *library);

/* States of the minimal complete automaton of the kept plans: without the length bounds, or (tn_library_within) with
 * them. */
uint32_t tn_library_states(const tn_library *library);
bool tn_library_within(const tn_library *library);

/* The clause that its automaton leaves out, since with it that passes a limit; SIZE_MAX: none. If there is one, the
 * library has its lengths, the counts of tn_library_kept, tn_library_generated and tn_library_effect, tn_library_has
 * and tn_library_counted_rank. Nothing else may be asked. Only if the options said that this is enough. */
size_t tn_library_apart(const tn_library *library);
uint32_t tn_library_min(const tn_library *library);
uint32_t tn_library_max(const tn_library *library);
const tn_schema *tn_library_schema(const tn_library *library);

/* Its LIBRARY record; NULL where it is not written anywhere. */
const tn_library_record *tn_library_record_of(const tn_library *library);

/* Hash of the meaning: schema, lengths, set of kept plans, and of a library with weights or preferences these as they
 * are written. Equal meaning, equal hash, on every machine, however the rules are written and the automaton was built.
 */
void tn_library_hash(const tn_library *library, char hex[33]);

/* Kept plans of one length, or (length = TN_ALL_LENGTHS) in all. */
#define TN_ALL_LENGTHS UINT32_MAX
void tn_library_kept(const tn_library *library, uint32_t length, mpz_t count);
tn_status tn_library_generated(const tn_library *library, uint32_t length, mpz_t count, tn_error *error);

/* What clause i (of the LIBRARY record, in file order) does to the plans of the library's lengths. *out: how many it
 * keeps out; a requirement, of all plans of legal trays; a prune, of those generated. *only: how many it keeps out that
 * all other clauses keep. *states: of its minimal automaton. TN_LIMIT (E0802): what of these is negative is not
 * counted; a clause alone, so the others may be. Not for a prune of a library that leaves pruning out. */
tn_status tn_library_effect(const tn_library *library, uint32_t i, mpz_t out, mpz_t only, uint32_t *states,
                            tn_error *error);

/* How many plans rules match, that need not be clauses of the library: matched[2 i] of those generated and matched[2 i
 * + 1] of those kept, for functions[i] (of H); negative where that passes a limit. matched: an initialised array of 2
 * count. */
tn_status tn_library_matches(const tn_library *library, const uint32_t *functions, size_t count, mpz_t *matched,
                             tn_error *error);

/* The automaton of the kept plans, step by step, for what counts more than plans: 0 is the state before the first tray.
 * Does a plan of the library have `left` more trays from a state on? */
uint32_t tn_library_next(const tn_library *library, uint32_t state, tn_tray tray);
bool tn_library_lives(const tn_library *library, uint32_t left, uint32_t state);

/* One of each mirror pair: kept plans w such that the reversed plan is not kept, or has no lower rank. */
tn_status tn_library_kept_mirror(const tn_library *library, uint32_t length, mpz_t count, tn_error *error);

/* Is the plan in the library? */
bool tn_library_has(const tn_library *library, const tn_tray *trays, size_t length);

/* The plan's rank. false where it is not in the library. */
bool tn_library_rank(const tn_library *library, const tn_tray *trays, size_t length, mpz_t rank);

/* The same of any library, also of one that leaves a clause out of its automaton: the plans before the plan are then
 * counted by both, side by side, which takes about as long as counting all plans. *has: is it in the library? */
tn_status tn_library_counted_rank(const tn_library *library, const tn_tray *trays, size_t length, bool *has, mpz_t rank,
                                  tn_error *error);

/* The plan of a rank: fills trays (room for tn_library_max) and its length. false where rank >= the number kept. */
bool tn_library_unrank(const tn_library *library, const mpz_t rank, tn_tray *trays, uint32_t *length);

/* Draws `count` different numbers below `bound`, or all of them, each with the same probability: *found of them,
 * ascending. A function of seed and stream. `ranks` are initialised. */
tn_status tn_ranks_sample(uint64_t seed, uint64_t stream, const mpz_t bound, size_t count, mpz_t *ranks, size_t *found,
                          tn_error *error);

/* `count` distinct ranks, ascending, uniform over the plans of one length (or TN_ALL_LENGTHS): depends on (seed,
 * arguments) alone. ranks: an initialised array of `count`; *found < count where the library has fewer. */
tn_status tn_library_sample(const tn_library *library, uint64_t seed, uint32_t length, size_t count, mpz_t *ranks,
                            size_t *found, tn_error *error);

/* Walks the plans of the ranks [from, to) in order. */
typedef struct tn_cursor tn_cursor;
tn_status tn_cursor_new(const tn_library *library, const mpz_t from, const mpz_t to, tn_cursor **cursor,
                        tn_error *error);
void tn_cursor_free(tn_cursor *cursor);
/* The next plan, valid until the next call; false at the end. Ranks advance by one each time. */
bool tn_cursor_next(tn_cursor *cursor, const tn_tray **trays, uint32_t *length);

/* The lower rank of a mirror pair, or its sole member? (For --mirror in enumerate; w is in the library.) */
bool tn_library_mirror_first(const tn_library *library, const tn_tray *trays, uint32_t length);

#endif
