/* What a tn_likelihood is made of. */
#ifndef TARTAN_PLAN_MEASURE_LIKELIHOOD_DATA_H
#define TARTAN_PLAN_MEASURE_LIKELIHOOD_DATA_H

#include "runtime/automata/walk.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/measure/likelihood.h"
#include "runtime/plan/measure/weighed.h"

/* By a letter from a state. */
typedef struct tn_likely_edge {
    uint32_t letter, target;
    uint32_t factor; /* of `factors` */
} tn_likely_edge;

/* What an edge multiplies by: up / down, of the weights that have become certain there. */
typedef struct tn_likely_factor {
    int64_t gain[TN_WEIGHED_MAX];
    mpz_t up, down;
} tn_likely_factor;

struct tn_likelihood {
    const tn_library *library;
    tn_weighed *weighed;                            /* by the weights that look at the trays around, if any */
    uint32_t around;                                /* how many those are */
    mpz_t up[TN_WEIGHED_MAX], down[TN_WEIGHED_MAX]; /* the weight of each: up / down */
    tn_classes *classes;                            /* trays that the other weights take for the same */
    mpz_t *alone;                                   /* [classes]: the weight of such a tray, times `common` */
    mpz_t common;                                   /* the denominator of those */
    uint32_t *letter_first;                         /* [letters + 1]: into the next two */
    tn_tray *trays;                                 /* [trays]: letter by letter */
    mpz_t *before;                                  /* [trays]: of the trays of the letter before it */
    mpz_t *letter;                                  /* [letters]: of all its trays */
    size_t *first;                                  /* [states + 1]: into `edges` */
    tn_likely_edge *edges;
    size_t edge_count, edge_room;
    tn_likely_factor *factors;
    size_t factor_count, factor_room;
    uint32_t states;
    uint32_t *depth; /* [states]: the fewest trays that lead there */
    size_t depth_room;
    tn_layers walk; /* by trays to come; layer n has the states of a depth up to n, and masses backwards */
    mpz_t *lengths; /* [max + 2]: where the plans of a length begin on the line of all */
    mpz_t scale;    /* a mass is the weight times this, on the line of all */
};

/* The trays of a class alone. */
static inline mpz_srcptr tn_likely_alone(const tn_likelihood *likelihood, tn_tray tray)
{
    return likelihood->alone[likelihood->classes->of_tray[tray]];
}

/* What the plans come to that go on from a state with so many trays: times the denominators of weights that look
 * around, to the power of the most trays. */
static inline mpz_srcptr tn_likely_mass(const tn_likelihood *likelihood, uint32_t left, uint32_t state)
{
    return tn_walk_backward_of(&likelihood->walk, likelihood->walk.last - left, state);
}

/* mass := mass * up / down, which is whole for what a plan can still become. */
static inline void tn_likely_apply(const tn_likelihood *likelihood, uint32_t factor, mpz_t mass)
{
    if (factor == 0)
        return;
    mpz_mul(mass, mass, likelihood->factors[factor].up);
    mpz_divexact(mass, mass, likelihood->factors[factor].down);
}

/* The plan at a place on the line of all masses, and the stretch that it has there: `begin` and `size` are initialised,
 * `trays` has room for the longest plan. TN_MEMORY. */
tn_status tn_likely_plan(const tn_likelihood *likelihood, const mpz_t place, tn_tray *trays, uint32_t *length,
                         mpz_t begin, mpz_t size, tn_error *error);

/* What plans of so many trays are multiplied by, for all lengths to be on one line. */
void tn_likely_scale(const tn_likelihood *likelihood, uint32_t length, mpz_t scale);

#endif
