/* Combinations by what their numbers add up to: sets as those of choices.h.
 *
 * A sum has terms, each of which is a number for every combination of the values of a few fields. Combinations that add
 * up alike so far, and agree in what terms still need of them, are followed once; and none is followed further once
 * nothing that may come can change the sum's sign. So the work is about how many sums there are, and not about how many
 * combinations. */
#ifndef TARTAN_CHOICES_SUMS_H
#define TARTAN_CHOICES_SUMS_H

#include <gmp.h>

#include "runtime/choices/choices.h"

typedef enum tn_choice_outcome {
    TN_CHOICE_SAYS,     /* there is a number */
    TN_CHOICE_SILENT,   /* there is none: no comparison is so */
    TN_CHOICE_UNDEFINED /* it cannot be said whether a comparison is so */
} tn_choice_outcome;

typedef struct tn_choice_term {
    const uint32_t *fields; /* [field_count], ascending; none: a constant */
    uint32_t field_count;
    mpz_t *values;     /* of each combination of their values, that of the last field changing first */
    uint8_t *outcomes; /* of each: a tn_choice_outcome */
    size_t count;      /* how many combinations these are */
} tn_choice_term;

typedef enum tn_choice_signs { TN_CHOICE_BELOW = 1, TN_CHOICE_ZERO = 2, TN_CHOICE_ABOVE = 4 } tn_choice_signs;

/* The combinations whose sum has one of the signs, and those whose sum has another; where a term is undefined, neither.
 * LOST as in choices.h, and also if more than so many steps are needed: then *longer. */
void tn_choices_by_sum(tn_choice_diagram *choices, const tn_choice_term *terms, size_t term_count, unsigned signs,
                       size_t steps, tn_choice_set *yes, tn_choice_set *no, bool *longer);

#endif
