/* The states that the houses on one plan reach, and choosing one of these houses. Internal to runtime/house/rank. */
#ifndef TARTAN_HOUSE_RANK_PATH_H
#define TARTAN_HOUSE_RANK_PATH_H

#include "runtime/house/rank/rank.h"
#include "runtime/house/strip/houses_data.h"

/* A house by its number among those on the plan, or the number by the house. Choices are gone through in their order:
 * those before the house's are passed over. */
typedef struct tn_choosing {
    mpz_ptr number;         /* of the house among those that are left; with `wanted`: houses that are passed over */
    const tn_house *wanted; /* or NULL */
} tn_choosing;

/* Passes over so many houses, unless the house is among them; is_wanted: the wanted house is, where there is one. */
bool tn_choosing_passes(const tn_choosing *choosing, const mpz_t houses, bool is_wanted);

/* The states after so many trays of the plan. [of]: houses that go on from there; choices of the functions so far, and
 * of all else, that lead there; houses that go on from there with the functions, once they are chosen. */
typedef struct tn_path_states {
    tn_numbering of;
    mpz_t *ahead, *here, *like;
} tn_path_states;

/* The houses on a plan in one section. */
typedef struct tn_plan_path {
    tn_strip *strip;
    const tn_tray *trays;
    uint32_t length;
    tn_path_states *layers; /* [length + 1] */
    mpz_t one;              /* scratch */
} tn_plan_path;

void tn_path_init(tn_plan_path *path, const tn_tray *trays, uint32_t length);
void tn_path_clear(tn_plan_path *path);

/* Finds the states, and what is ahead of each. */
tn_status tn_path_find(tn_plan_path *path, tn_strip *strip, tn_error *error);

/* Houses that go on from a state by those of the next layer. next: NULL behind the last tray. */
typedef struct tn_path_sum {
    const tn_numbering *next;
    mpz_t *ahead; /* [next]; borrowed */
    mpz_t houses;
} tn_path_sum;
tn_status tn_path_add(void *sum, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                      tn_error *error);

/* Chooses the functions of the house, tray by tray. Then `here` is of houses with these; `of_tray` [length] the slices
 * of each tray that have them, which the caller frees. house: on the plan in the section. *found: is there one? */
typedef struct tn_path_slices {
    tn_strip_choice *items;
    size_t count;
} tn_path_slices;
tn_status tn_path_functions(tn_plan_path *path, const tn_choosing *choosing, tn_house *house, tn_path_slices *of_tray,
                            bool *found, tn_error *error);

/* Chooses what is in the faces of the house, whose functions are those. *found: is there one? */
tn_status tn_path_faces(tn_plan_path *path, const tn_choosing *choosing, tn_house *house, const tn_path_slices *of_tray,
                        bool *found, tn_error *error);

#endif
