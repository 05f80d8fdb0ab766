/* Sums over plans made ready to run: a SUM record's terms in whole steps of one unit, what each tray counts worked out.
 *
 * A tn_sum is immutable and may be shared between threads. It borrows the schema.
 */
#ifndef TARTAN_PLAN_SCHEMA_SUM_H
#define TARTAN_PLAN_SCHEMA_SUM_H

#include <gmp.h>

#include "runtime/plan/schema/kinds.h"

#define TN_SUM_STEPS_MAX (INT64_C(1) << 45) /* of one tray or place, so that sums of all places stay in 64 bits */

/* Where a term counts, of a stretch: in it, or in what lies before it or behind it. */
typedef enum tn_sum_region { TN_REGION_STRETCH, TN_REGION_BEFORE, TN_REGION_AFTER } tn_sum_region;

typedef struct tn_sum_term {
    tn_sum_kind kind; /* SINGLES, STARTS, MATCHES, PRESENT, NEEDED or a gap */
    tn_sum_region region;
    uint32_t part;   /* a rule function */
    uint32_t other;  /* of gaps: where they lead, a rule function */
    int64_t each;    /* steps of each place; singles, and trays of a gap: where `weight` is NULL */
    int64_t *weight; /* [trays]: steps of each tray, or NULL; where trays are not listed, [kinds]: */
    tn_kinds kinds;  /* trays of one kind count the same */
} tn_sum_term;

typedef struct tn_sum {
    const tn_schema *schema;
    const tn_sum_record *record;
    uint32_t count;
    tn_sum_term *terms;
    int64_t constant; /* steps */
    mpq_t unit;       /* a step, in nanometres to the sum's power; above 0 */
} tn_sum;

/* What the kind of a TERM record says: what is counted, and where. */
tn_sum_kind tn_term_counts(uint32_t kind);
tn_sum_region tn_term_region(uint32_t kind);
bool tn_term_is_gap(uint32_t kind);
bool tn_term_of_whole(uint32_t kind); /* it is asked of whole plans only */

/* What the preferences of a library that has some add up to: a SUM record. */
static inline uint32_t tn_preferred_sum(const tn_module *module, const tn_library_record *library)
{
    return module->PREFERENCE_records[library->preference_first].sum;
}

/* The term of its preference i: what it is worth, and its function of H. */
static inline const tn_term_record *tn_preferred_term(const tn_module *module, const tn_library_record *library,
                                                      uint32_t i)
{
    return &module->TERM_records[module->SUM_records[tn_preferred_sum(module, library)].term_first + i];
}

/* Makes the SUM record ready. E0419 (TN_INVALID) where it divides by zero for a tray that it counts, E0424 (TN_LIMIT)
 * where its numbers have no common step that is coarse enough. */
tn_status tn_sum_new(const tn_schema *schema, uint32_t index, tn_sum **sum, tn_error *error);
void tn_sum_free(tn_sum *sum);

/* The steps of a single tray. */
static inline int64_t tn_term_steps(const tn_sum_term *term, tn_tray tray)
{
    if (!term->weight)
        return term->each;
    return term->weight[term->kinds.schema ? tn_kind_of_tray(&term->kinds, tray) : tray];
}

/* The sum is a multiple of a number (above 0, in nanometres to the sum's power) if its steps are one of this. */
int64_t tn_sum_modulus(const tn_sum *sum, int64_t number);

#endif
