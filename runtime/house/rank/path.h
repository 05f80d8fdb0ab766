/* The states that the houses on one plan reach, and choosing one of these houses. Internal to runtime/house/rank. */
#ifndef TARTAN_HOUSE_RANK_PATH_H
#define TARTAN_HOUSE_RANK_PATH_H

#include "runtime/house/count/data.h"
#include "runtime/house/line.h"
#include "runtime/house/rank/rank.h"

/* Shown a house without its tiles. It stays the shower's, and the callee may set its tiles. before: how many houses
 * with its functions and faces are passed over (those of choosing->number; with `wanted`, before the first of them). */
typedef tn_status tn_path_faced(void *context, tn_house *house, const mpz_t before, bool *stop, tn_error *error);

/* What is typed of the houses that are looked for. When their functions are known, so is which value of the line is
 * about which face and which cell. */
typedef struct tn_path_typed {
    const tn_line_asked *asked;
    uint64_t *work;     /* choices that may still be tried */
    size_t *face_value; /* [faces] of the line's part; SIZE_MAX: the face leaves no choice */
    size_t *tile_value; /* [cells] the same */
    size_t *known_with; /* [cells] the last face that its tiles depend on */
} tn_path_typed;

void tn_path_typed_clear(tn_path_typed *typed);

bool tn_path_typed_section(const tn_path_typed *typed, const tn_house *section);

/* May the tray have these functions? */
bool tn_path_typed_functions(const tn_path_typed *typed, const tn_house *house, uint32_t tray,
                             const uint32_t *functions);

/* The functions are known: *fits: may the house have them, by how many values the line has for faces and tiles? */
tn_status tn_path_typed_begin(tn_path_typed *typed, const tn_house *house, bool *fits, tn_error *error);

/* The faces up to this one are chosen: *fits: so far there is a tile that is typed in each cell that these decide. */
tn_status tn_path_typed_face(tn_path_typed *typed, tn_house *house, size_t face, bool *fits, tn_error *error);

/* Houses from a number on among those on the plan, or one house and its number, or those that have what is typed.
 * Choices are gone through in their order: those before the house's are passed over, each as a whole. */
typedef struct tn_choosing {
    mpz_ptr number;         /* of the first house among those that are left; with `wanted`: houses passed over */
    const tn_house *wanted; /* or NULL */
    tn_path_typed *typed;   /* or NULL */
    tn_path_faced *faced;
    void *context;
    bool shown, stop; /* a house was shown: there is nothing more to pass over; all ends */
    tn_house_alike
        alike; /* of houses that are alike so far only the first is shown: PLAN and SECTION are the same here */
    bool next; /* nothing more is shown until the next that is not alike */
} tn_choosing;

/* Passes over so many houses, unless the house is among them; is_wanted: the wanted house is, if there is one. */
bool tn_choosing_passes(const tn_choosing *choosing, const mpz_t houses, bool is_wanted);

/* How many houses go on from each node of the layers, for each length; the nodes are found. */
tn_status tn_houses_look_ahead(const tn_houses *houses, tn_houses_kind *kind, tn_error *error);

/* The same by a walk over the nodes (labels: tn_houses_edge). */
tn_status tn_houses_look_back(const tn_houses *houses, tn_houses_kind *kind, tn_key_walk *walk, tn_error *error);

/* Of each state after so many trays: choices of the functions so far, and of all else, that lead there; houses that go
 * on from there with the functions, once they are chosen. */
typedef struct tn_path_states {
    mpz_t *here, *like;
} tn_path_states;

/* Houses of one value are looked for, on a plan of a library whose values are known (houses.h). All is borrowed. */
typedef struct tn_path_aim {
    const tn_houses *houses;
    const tn_houses_kind *kind;
    const tn_house_gain *wanted;
    const uint32_t *plans;      /* [length + 1] the states of the plan */
    const tn_house_gain *gains; /* [length] what each tray adds to the plan's part */
} tn_path_aim;

/* A state of the frontier, and the value of what led there. */
typedef struct tn_path_valued {
    uint32_t state;
    tn_house_gain value;
} tn_path_valued;

/* Houses by what a tray can be, one number for each, as far as they were asked for. */
typedef struct tn_path_numbers {
    mpz_t *items;
    size_t count, room;
} tn_path_numbers;

/* The houses on a plan in one section: a library of this plan alone, and one kind of section, whose frontier is
 * borrowed. With an aim its states are those of the frontier with the value so far (valued.c). */
typedef struct tn_plan_path {
    tn_houses view;
    tn_houses_kind kind;
    uint32_t length, stages;
    const tn_path_aim *aim; /* or NULL */
    tn_interner numbers;    /* of {state, value} */
    tn_path_valued *valued; /* [numbers] */
    size_t valued_room;
    tn_path_states *states;        /* [length + 1] */
    tn_key beginning;              /* functions of the trays so far: a number for each tray */
    tn_interner beginnings;        /* those that were met */
    tn_path_numbers *by_functions; /* [beginnings]: of the next tray */
    size_t beginning_room, number_count;
} tn_plan_path;

/* Finds the states, and what is ahead of each. Borrows all. Clear it in any case. */
tn_status tn_path_find(tn_plan_path *path, const tn_houses *houses, const tn_houses_kind *kind, const tn_tray *trays,
                       uint32_t length, tn_error *error);
tn_status tn_path_find_valued(tn_plan_path *path, const tn_path_aim *aim, const tn_tray *trays, uint32_t length,
                              tn_error *error);
void tn_path_clear(tn_plan_path *path);

/* Room for what is found of each state, once the states are. */
tn_status tn_path_begin_states(tn_plan_path *path, tn_error *error);

/* Goes from a state of the path to those after one more slice, as tn_frontier_step does; only: the outcomes of the
 * interface that are looked at, or NULL. */
tn_status tn_path_step(tn_plan_path *path, uint32_t tray, uint32_t state, uint32_t slice, const tn_frontier_list *only,
                       tn_frontier_seen *seen, void *context, tn_error *error);

/* Can houses have the value that is aimed at, which are in a state of the frontier after so many trays, with this value
 * so far? */
bool tn_aim_leads_on(const tn_path_aim *aim, uint32_t trays, uint32_t length, uint32_t state,
                     const tn_house_gain *value);

void tn_path_forget_numbers(tn_plan_path *path);

/* The nodes after so many trays; what is ahead of them; the state of a node, and the node of a state. */
static inline const tn_houses_layer *tn_path_layer(const tn_plan_path *path, uint32_t trays)
{
    return &path->kind.layers[trays * path->stages];
}

static inline uint32_t tn_path_state(const tn_plan_path *path, uint32_t trays, uint32_t node)
{
    return (uint32_t)tn_path_layer(path, trays)->nodes.keys[node];
}

uint32_t tn_path_node(const tn_plan_path *path, uint32_t trays, uint32_t state); /* UINT32_MAX: none */

/* Houses that go on from a state by those after so many trays, of which so many houses are ahead (NULL: the row ends).
 */
typedef struct tn_path_sum {
    const tn_plan_path *path;
    uint32_t trays;
    mpz_t *ahead;
    mpz_t houses;
} tn_path_sum;
tn_status tn_path_add(void *sum, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                      tn_error *error);

/* houses := those that go on from a state after so many trays by one of these slices. sum: of those after one more. */
tn_status tn_path_count_on(tn_plan_path *path, uint32_t trays, uint32_t state, const tn_frontier_choice *slices,
                           size_t count, tn_path_sum *sum, mpz_t houses, tn_error *error);

/* Nodes that have been found for the plan. */
size_t tn_plan_houses_nodes(const tn_plan_houses *plan);

/* Chooses functions tray by tray, and then what is in the faces, for all houses from the first on, until one is the
 * last that is asked for. house: stands on the plan in the section. */
tn_status tn_path_choose(tn_plan_path *path, tn_choosing *choosing, tn_house *house, tn_error *error);

/* The slices of a tray that have the functions of the house. */
typedef struct tn_path_slices {
    tn_frontier_choice *items;
    size_t count;
} tn_path_slices;

/* Chooses what is in the faces of the house, whose functions are those of these slices [length]; `here` of the states
 * is of houses with these. */
tn_status tn_path_faces(tn_plan_path *path, tn_choosing *choosing, tn_house *house, const tn_path_slices *of_tray,
                        tn_error *error);

#endif
