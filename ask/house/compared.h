/* What an edit does to a library of houses: counted, and shown. */
#ifndef TARTAN_ASK_HOUSE_COMPARED_H
#define TARTAN_ASK_HOUSE_COMPARED_H

#include "ask/house/numbered.h"
#include "runtime/plan/library/diff.h"

/* One of the two libraries. partner: for each clause the one of the other library that says the same. */
typedef struct tn_compared_side {
    tn_numbered n;
    uint32_t *partner; /* TN_NO_RECORD: none */
} tn_compared_side;

/* What is not the same in both: a clause, the plans (`plans`) or the form. removes: houses that it took away; adds:
 * that came with it. examples: of these, as lines; the caller of tn_houses_compare shows so many. */
typedef struct tn_house_edit {
    const char *name;
    tn_clause_change change;
    uint32_t clause[2]; /* of the old library, of the new one; TN_NO_RECORD where there is none */
    mpz_t houses[2];    /* that it removes, adds */
    char **examples[2];
    size_t example_count[2], example_room[2];
} tn_house_edit;

/* kept: by number of trays, from `low` on. */
typedef struct tn_compared_houses {
    tn_compared_side sides[2];
    tn_library_diff *plans;
    uint32_t low, high;
    mpz_t *before, *after, *kept;
    tn_house_edit *edits;
    size_t edit_count;
} tn_compared_houses;

typedef struct tn_compared_options {
    size_t shown;
    uint64_t seed, one_by_one;
} tn_compared_options;

/* Counts what is removed, added and kept, and finds examples. Both sides are open. The counts are exact. Where the form
 * is the same and one library has all the clauses of the other, they come from houses counted together; else houses on
 * plans that both libraries have are compared one by one: past options->one_by_one of them it is TN_LIMIT (E1641). */
tn_status tn_houses_compare(tn_compared_houses *c, const tn_compared_options *options, tn_error *error);
void tn_houses_compare_clear(tn_compared_houses *c);

/* ---- what these are made of: houses compared together, or one by one */

/* Are there plans that only one of the libraries has? */
bool tn_compared_other_plans(const tn_compared_houses *c);

/* Keeps an example of what the edit removes (0) or adds (1). */
tn_status tn_edit_example(tn_house_edit *edit, int which, const tn_house *house, tn_error *error);

/* Finds the edit of that name without a clause: "plans" or "form"; NULL if nothing about it is another. */
tn_house_edit *tn_compared_edit(const tn_compared_houses *c, const char *name);

/* Examples of an edit from a library of the houses that it removes or adds: the first and some at random. */
tn_status tn_edit_sample(tn_house_edit *edit, int which, tn_numbered *from, const tn_compared_options *options,
                         tn_error *error);

/* Counts the houses of a side on the plans that only it has, with examples. The trays have the same numbers in both. */
tn_status tn_compared_own_plans(const tn_compared_houses *c, int which, tn_house_edit *edit,
                                const tn_compared_options *options, tn_error *error);

tn_status tn_compare_together(tn_compared_houses *c, int strict, const tn_compared_options *options, tn_error *error);
tn_status tn_compare_each(tn_compared_houses *c, const tn_compared_options *options, tn_error *error);

#endif
