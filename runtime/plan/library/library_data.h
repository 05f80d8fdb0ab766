/* What a tn_library is made of, and the steps of making it: for the files that answer the questions of library.h, and
 * those that walk over its automaton. */
#ifndef TARTAN_PLAN_LIBRARY_LIBRARY_DATA_H
#define TARTAN_PLAN_LIBRARY_LIBRARY_DATA_H

#include <math.h>
#include <pthread.h>

#include "runtime/automata/count.h"
#include "runtime/automata/numbering.h"
#include "runtime/automata/sparse.h"
#include "runtime/base/integers.h"
#include "runtime/plan/library/memory.h"
#include "runtime/plan/schema/classes.h"

#define TN_LIBRARY_STATES_DEFAULT 1000000u
#define TN_LIBRARY_LENGTH_DEFAULT 4096u
#define TN_LIBRARY_EAGER_DEFAULT 3000000u
#define TN_LIBRARY_TABLE_DEFAULT (UINT64_C(4) << 30)

typedef struct tn_library tn_library; /* library.h */

/* What one clause does to a library. */
typedef struct tn_effect {
    mpz_t out;        /* as in tn_library_effect; negative: not counted */
    mpz_t only;       /* where status is TN_OK */
    tn_key shortest;  /* the first of the shortest plans that only it keeps out, as letters; empty: there is none */
    bool looked;      /* is that known? */
    tn_status status; /* TN_LIMIT: not counted, or not yet */
    tn_error error;   /* why not */
} tn_effect;

typedef struct tn_others tn_others; /* others.h */

/* The clauses in a row, or why they could not be put in one. */
typedef struct tn_kept_others {
    bool made;
    tn_others *others;
    tn_status status; /* TN_OK or TN_LIMIT */
    tn_error error;
} tn_kept_others;

/* Found on demand, by whichever thread asks first (`lock` is held while it does): what only some commands need. */
typedef struct tn_library_late {
    pthread_mutex_t lock;
    tn_effect *effects;       /* [record->clause_count], NULL: not found yet */
    tn_kept_others others[2]; /* of plans of any length, and within the library's */
    tn_sparse **alone;        /* [record->clause_count]: what each clause alone keeps out; NULL: not kept */
    uint64_t alone_edges;     /* of those */
    tn_sparse *asked;         /* what was asked last and is not kept, */
    size_t asked_of;          /* of this clause */
    bool mirror_found;
    mpz_t *mirror; /* [max + 1]: plans of a length less the second ones of mirror pairs */
} tn_library_late;

struct tn_library {
    const tn_schema *schema;
    const tn_library_record *record;
    tn_classes *classes;
    uint32_t max_states; /* of a clause's automata */
    uint32_t max_joint;  /* of the automata of several clauses together */
    uint64_t max_table;
    uint32_t min, max; /* of trays; min > max: no plan at all */
    tn_dfa **clauses;  /* [record->clause_count], in file order */
    size_t *applied;   /* [applied_count]: which of the clauses, as they are applied: requirements, then prunes */
    size_t applied_count, required_count;
    tn_sparse *generator; /* of what the requirements and totals leave */
    tn_sparse *live;      /* of the kept plans, without a dead state */
    tn_dfa *kept;         /* the same, complete: its last state is the dead one; NULL: a clause is left out */
    size_t apart;         /* the clause that `live` leaves out, or SIZE_MAX */
    bool within;          /* generator and live hold only plans of min..max trays */
    tn_bounds bounds;     /* of combining the clauses */
    uint64_t *growth;     /* [record->clause_count]: by what, in thousandths, each has multiplied the states */
    uint64_t max_eager;
    unsigned threads;
    tn_plan_memory *memory; /* or NULL */
    mpz_t *generated;       /* [max + 1]: by length */
    uint32_t *tray_column;  /* [trays]: column of `kept`; NULL, and so the next, where trays are not listed */
    tn_tray *run_end;       /* [trays]: the next tray of another column, or the number of trays */
    tn_count_row *rows;     /* [max + 1]: kept plans by trays to come */
    double *nearly;         /* [max + 1][states]: the rows, nearly (tn_nearly) */
    uint64_t *alive;        /* [max + 1][alive_words]: bit s: rows[left] is not zero at s */
    uint32_t alive_words;
    mpz_t *before;        /* [max + 2]: kept plans of the lengths min..length - 1, so the first rank of a length */
    uint32_t stride;      /* trays between the marks of `passed` */
    uint32_t *passed;     /* [trays / stride + 1][columns]: trays of a column before tray mark * stride */
    uint64_t *hash_room;  /* for tn_library_hash, used under late->lock */
    uint64_t leanings[2]; /* a hash of its weights and preferences, if it has any */
    tn_library_late *late;
};

static inline bool tn_library_alive(const tn_library *library, uint32_t left, uint32_t state)
{
    return library->alive[(size_t)left * library->alive_words + state / 64] >> (state % 64) & 1;
}

static inline uint32_t tn_library_step(const tn_library *library, uint32_t state, tn_tray tray)
{
    uint32_t column =
        library->tray_column ? library->tray_column[tray] : library->kept->column[tn_class_of(library->classes, tray)];
    return library->kept->delta[(size_t)state * library->kept->columns + column];
}

/* A count divided by 2^(64 limbs), nearly: at most 1 for a count of so many limbs. Only ever guides exact arithmetic.
 */
static inline double tn_nearly(const mpz_t count, size_t limbs)
{
    long exponent;
    double fraction = mpz_get_d_2exp(&exponent, count);
    return ldexp(fraction, (int)(exponent - (long)(64 * limbs)));
}

static inline const tn_clause_record *tn_library_clause(const tn_library *library, size_t i)
{
    return &library->schema->module->CLAUSE_records[library->record->clause_first + i];
}

static inline bool tn_library_prunes(const tn_library *library, size_t i)
{
    return tn_library_clause(library, i)->kind == TN_CLAUSE_PRUNE;
}

/* What leaves of some plans those that clause i keeps; the other operation leaves those that it keeps out. */
static inline tn_dfa_operation tn_library_keeping(const tn_library *library, size_t i)
{
    return tn_library_prunes(library, i) ? TN_DFA_MINUS : TN_DFA_AND;
}

/* How many words hash_room has. */
uint64_t tn_library_hash_words(const tn_library *library);

/* Finds the hash of the library's weights and preferences. */
tn_status tn_library_hash_leanings(tn_library *library, tn_error *error);

/* Says in which clause it was that making automata passed a limit; returns the error's status. */
tn_status tn_library_name_clause(const tn_library *library, size_t i, tn_error *error);

/* Makes `generator`, `live` and `kept` of the clauses' automata (combine.c), the same for any number of threads.
 * TN_LIMIT (E0802) names a clause. only_counted: then one may be left out. */
tn_status tn_library_combine(tn_library *library, bool only_counted, tn_error *error);

/* What combining automata may cost: in proportion to the states that they may have. */
tn_bounds tn_library_bounds(const tn_library *library);

/* *sparse := *sparse with what a clause requires, or without what it prunes (operation), minimal. */
tn_status tn_library_apply(const tn_library *library, const tn_dfa *clause, tn_dfa_operation operation,
                           tn_bounds *bounds, tn_sparse **sparse, tn_error *error);

/* Every plan, to begin with: of the library's lengths, or of any. */
tn_status tn_library_everything(const tn_library *library, bool within, tn_sparse **out, tn_error *error);

/* Puts clauses in the order to apply them to an automaton in: those that multiply its states come last, when it is as
 * large as it gets anyway. base NULL: those with the fewest states first. */
tn_status tn_library_order(const tn_library *library, const tn_sparse *base, size_t *clauses, size_t count,
                           tn_error *error);

/* A copy of an automaton of the library's classes over others that are as fine or finer: its letters are those. map:
 * the library's tray for each of theirs, or NULL where trays are the same. */
tn_status tn_library_reletter(const tn_library *library, const tn_sparse *sparse, const tn_classes *classes,
                              const tn_tray *map, tn_sparse **out, tn_error *error);

/* Keeps the plans that clause i alone keeps out, if the memory for that holds them and they are not kept yet; false:
 * they stay the caller's. One thread at a time (alone.c). */
bool tn_library_keep_alone(const tn_library *library, size_t i, tn_sparse *plans);

/* Free `effects` of so many clauses; NULL is fine (effects.c). */
void tn_effects_free(tn_effect *effects, size_t count);

/* Fills rows, nearly, alive, before, generated and passed (tables.c); if a clause is left out, before and generated. */
tn_status tn_library_tables(tn_library *library, tn_error *error);

/* sum := plans that start in `state` with a tray before `tray`, `left` trays to come after it. */
void tn_plans_before(const tn_library *library, uint32_t state, tn_tray tray, uint32_t left, mpz_t sum);

#endif
