/* What an edit does to a library: the plans that only the old one holds, only the new one, and both, exactly.
 *
 * The three sets are libraries themselves (library.h), to be counted, ranked and sampled; trays are those of the old
 * library's schema. A tn_library_diff owns them and borrows both libraries, which may be of two modules as long as they
 * have the same trays.
 */
#ifndef TARTAN_PLAN_LIBRARY_DIFF_H
#define TARTAN_PLAN_LIBRARY_DIFF_H

#include "runtime/plan/library/library.h"

typedef enum tn_diff_part { TN_DIFF_REMOVED, TN_DIFF_ADDED, TN_DIFF_KEPT, TN_DIFF_PARTS } tn_diff_part;

typedef enum tn_clause_change {
    TN_CLAUSE_CHANGED, /* the same name means something else */
    TN_CLAUSE_ADDED,
    TN_CLAUSE_REMOVED,
} tn_clause_change;

/* A clause that is not the same in both: clauses are the same that have one name and one meaning, or, where they have
 * no name of their own, one meaning. */
typedef struct tn_changed_clause {
    tn_clause_change change;
    uint32_t before, after; /* CLAUSE records of the old and the new module; UINT32_MAX: none, or the number of trays */
    bool lengths;           /* it is how many trays there are */
    mpz_t removes;          /* removed plans that the new clause keeps out; several clauses may keep out one plan */
    mpz_t adds;             /* added plans that the old clause kept out */
} tn_changed_clause;

typedef struct tn_library_diff tn_library_diff;

/* max_states as in tn_library_options. `watch` (may be NULL) can end it (TN_STOPPED). TN_INVALID (E0508) where the
 * trays differ: the error says in what. */
tn_status tn_library_diff_new(const tn_library *before, const tn_library *after, uint32_t max_states, tn_watch *watch,
                              tn_library_diff **diff, tn_error *error);
void tn_library_diff_free(tn_library_diff *diff);

const tn_library *tn_library_diff_part(const tn_library_diff *diff, tn_diff_part part);

/* The rank that a plan of the part, in the old schema's trays, has in its own library: in the old one where it is
 * removed, else in the new one. `rank` is initialised. */
tn_status tn_library_diff_rank(const tn_library_diff *diff, tn_diff_part part, const tn_tray *trays, size_t length,
                               mpz_t rank, tn_error *error);

size_t tn_library_diff_clauses(const tn_library_diff *diff);
const tn_changed_clause *tn_library_diff_clause(const tn_library_diff *diff, size_t i);

/* Have trays of one number the same values, by their places, in both schemas? */
bool tn_same_trays(const tn_schema *a, const tn_schema *b);

/* Which tray of `to` each tray of `from` is, by the names of fields and values: the caller frees *map. NULL where trays
 * are not listed: each is the one of its number. TN_INVALID (E0508) where they do not have the same trays; TN_LIMIT
 * (E0803) where trays are not listed and fields or values come in another order. */
tn_status tn_tray_map(const tn_schema *from, const tn_schema *to, tn_tray **map, tn_error *error);

/* Which field of one schema each field of another is, and which of that field's values each value is. */
typedef struct tn_field_map {
    uint32_t *fields; /* [from->field_count] */
    uint8_t *values;  /* [from->value_count] */
} tn_field_map;

/* TN_INVALID (E0508) where `to` has not the same. Clear it in any case. */
tn_status tn_field_map_make(const tn_schema *from, const tn_schema *to, tn_field_map *map, tn_error *error);
void tn_field_map_clear(tn_field_map *map);

#endif
