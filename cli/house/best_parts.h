/* A search for the best houses of a library. Internal to cli/house. */
#ifndef TARTAN_CLI_HOUSE_BEST_PARTS_H
#define TARTAN_CLI_HOUSE_BEST_PARTS_H

#include "cli/house/best.h"
#include "cli/house/houses.h"
#include "runtime/house/count/best.h"

/* The measures made ready, and what was found. */
typedef struct tn_best_houses {
    tn_numbered n;
    const tn_house_wishes *wishes;
    tn_plan plan; /* where one is given */
    tn_house_weights *weights[TN_WEIGHED_MAX];
    tn_amount_unit units[TN_WEIGHED_MAX];
    tn_house_measures measures;
    tn_houses *houses;
    int64_t values[TN_WEIGHED_MAX]; /* of the point at hand */
    mpz_t count;                    /* houses there */
    uint64_t given;                 /* houses so far */
    FILE *out;                      /* or NULL */
} tn_best_houses;

/* Opens the library and finds the values. False: what was wrong is recorded. End it in any case. */
bool tn_best_houses_begin(tn_best_houses *search, tn_job *job, const tn_house_settings *settings,
                          const tn_house_wishes *wishes, tn_houses_aim aim);
void tn_best_houses_end(tn_best_houses *search);

const char *tn_best_houses_measure(const tn_best_houses *search, uint32_t k);

/* Appends the value of measure k at the point at hand: "p/q" in its unit, or for people. False: out of memory. */
bool tn_best_houses_value(const tn_best_houses *search, uint32_t k, bool exact, tn_buffer *text);

/* Calls `each` with the best houses, by value and then by rank; it counts them in search->given, and stops at those
 * that are wanted. Of a front it stops at the first house of each point: search->count is how many there are. */
tn_status tn_best_houses_each(tn_best_houses *search, tn_house_each *each, void *context, tn_error *error);

#endif
