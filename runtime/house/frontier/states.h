/* States and the steps between them: tiles that are pending, costs, steps as a whole and in stages; and the engine of a
 * section, which holds all of it. Internal to runtime/house/frontier, runtime/house/count and runtime/house/rank. */
#ifndef TARTAN_HOUSE_FRONTIER_STATES_H
#define TARTAN_HOUSE_FRONTIER_STATES_H

#include "runtime/house/frontier/slices.h"

/* Words of a state: edge, rooms, each walk, what the clauses have read, the tiles that are pending on its right side;
 * then, if clauses compare, the number of the totals. */
enum { STATE_EDGE, STATE_ROOMS, STATE_WALKS };

/* ---- tiles: costs.c; their classes: frontier.c */

/* The pending tiles of a cell: how many fit depends on what stands at its right. Their numbers are `factor` times those
 * of the class. class: TN_FRONTIER_NONE: none fits, whatever stands there. ever: false if it makes no difference what
 * stands there. */
typedef struct tn_frontier_cell_class {
    uint32_t class, factor;
    bool ever;
} tn_frontier_cell_class;

/* A cell of which a class is, by its base and what stands at its left, and its factor. */
typedef struct tn_frontier_one {
    uint32_t base, left, factor;
} tn_frontier_one;

/* What no completion can tell apart (frontier.c). */
typedef struct tn_frontier_merged {
    uint32_t *edges;    /* [edges]: the first that meets all neighbours as this one does; NULL: each is by itself */
    size_t *first;      /* [bases + 1]: its part of sides */
    uint32_t *sides;    /* what can stand at the right of a cell of the base */
    tn_numbering pairs; /* base << 32 | what stands at its left */
    tn_frontier_cell_class *of_pair; /* [pairs] */
    tn_interner tiles;               /* of classes: {what stands at the right, how many fit} */
    tn_frontier_one *one;            /* [classes] */
    size_t pair_room, one_room;
} tn_frontier_merged;

/* Words of pending tiles, for each: the place of the cell, the class. */
enum { PENDING_CELL, PENDING_CLASS, PENDING_WORDS };

typedef struct tn_frontier_tiles {
    bool *furnished;          /* [functions] tiles are for it */
    bool *tiled, any;         /* [functions] its cells are filled: by tiles or, where ways are asked for, as they are */
    tn_interner bases, sides; /* of cells: what of their own walls matters to tiles, and what of a side */
    tn_numbering fit_keys[2]; /* {base, left side}, then {that, right side} */
    uint32_t *fits;           /* [fit_keys[1]]: tiles */
    size_t fit_room;
    tn_interner lists;              /* of bases or sides: a word for each cell */
    tn_interner pending;            /* PENDING_WORDS for each cell */
    tn_frontier_known arrangements; /* {pending, left fits}: how many, unless they have prices */
    tn_frontier_known pending_of;   /* {tiles of a slice, right fits}: what is pending; how many times that */
} tn_frontier_tiles;

void tn_frontier_tiles_clear(tn_frontier_tiles *tiles);

/* Is the cell filled, in one of several ways or in none? Cells that flights join are filled together, at the lowest. */
bool tn_frontier_fills(const tn_frontier *frontier, const tn_house *house, uint32_t cell);

/* What of a cell's own walls matters to its tiles, and what of a side. 0: nothing does. */
tn_status tn_frontier_fit_base(tn_frontier *frontier, const tn_house *house, uint32_t cell, uint32_t *base,
                               tn_error *error);
tn_status tn_frontier_fit_side(tn_frontier *frontier, const tn_house *house, uint32_t cell, int64_t x,
                               const tn_posts *posts, uint32_t *fit, tn_error *error);

/* How many tiles fit; if they have prices, the number of the list of what they cost, which is 0 if none fits. */
tn_status tn_frontier_fit(tn_frontier *frontier, uint32_t base, uint32_t left, uint32_t right, uint32_t *tiles,
                          tn_error *error);

/* A cell's tiles, by what stands at its left. */
tn_status tn_frontier_pending_class(tn_frontier *frontier, uint32_t base, uint32_t left,
                                    tn_frontier_cell_class *class_of, tn_error *error);

void tn_frontier_merged_clear(tn_frontier_merged *merged);

/* Pending tiles: how many arrangements they have once the outcome of the interface at their right is known; and what is
 * pending after a slice, with how many arrangements each of that stands for. TN_FRONTIER_NONE: a cell has no tile.
 * Without prices. */
typedef struct tn_frontier_pending {
    uint32_t number;
    uint64_t times;
} tn_frontier_pending;
tn_status tn_frontier_end_pending(tn_frontier *frontier, uint32_t pending, uint32_t left_fits, uint64_t *times,
                                  tn_error *error);
tn_status tn_frontier_find_pending(tn_frontier *frontier, uint32_t slice, uint32_t right_fits,
                                   tn_frontier_pending *pending, tn_error *error);

/* What a number of arrangements of tiles cost. */
typedef struct tn_frontier_sum {
    tn_int128 cost;
    uint64_t times;
} tn_frontier_sum;

/* The sums of the tiles of a tray, by cost (costs.c). */
typedef struct tn_frontier_sums {
    tn_frontier_sum *items, *more; /* scratch */
    size_t count, room, more_room;
    tn_frontier_known places; /* {pending, left fits}: their sums that are kept, once costs are known */
    tn_frontier_sum *kept;
    size_t kept_count, kept_room;
    const tn_frontier_sum *found; /* those asked for last, until the next are */
    size_t found_count;
} tn_frontier_sums;

/* frontier->sums.found := what the pending tiles cost once the outcome of the interface at their right is known, and
 * how many arrangements cost that; no sum if a cell has no tile. Without prices it is one sum of nothing. */
tn_status tn_frontier_sum_tiles(tn_frontier *frontier, uint32_t pending, uint32_t left_fits, tn_error *error);
tn_status tn_frontier_sum_one(tn_frontier *frontier, uint64_t times,
                              tn_error *error); /* so many arrangements, of nothing */
void tn_frontier_sums_clear(tn_frontier_sums *sums);

/* ---- prices: costs.c */

/* Numbers of costs by what they depend on. */
typedef struct tn_frontier_keyed {
    tn_interner keys;
    uint32_t *costs; /* [keys] */
    size_t room;
} tn_frontier_keyed;

/* What houses cost, in parts that add up (costs.c). Exact costs are numbered; their steps are known when all are. */
typedef struct tn_frontier_prices {
    bool asked, items, across; /* items: these have prices. across: so goes a roof that has one */
    tn_interner numbers;
    mpq_t *exact;
    size_t room;
    tn_int128 *steps;                    /* [numbers], or NULL */
    tn_frontier_keyed alone, interfaces; /* by {tray, what is in its inner faces}; by {shapes, what is in it} */
    tn_interner shapes;
    tn_interner lists; /* of tiles that fit in a cell: {cost, how many} by cost */
    tn_key key;
} tn_frontier_prices;

/* What each number that is added up is in, once all costs are known: steps so small that all are whole. */
typedef struct tn_frontier_units {
    mpq_t cost, measures[TN_ADDED_MAX];
    tn_int128 others[TN_ADDED_MAX], costs[TN_ADDED_MAX]; /* steps of its other numbers' steps, and of the costs' */
} tn_frontier_units;

tn_status tn_frontier_prices_begin(tn_frontier *frontier, tn_error *error);

/* trays: of the library. E1685 (TN_LIMIT) if costs that are asked for do not add up in this section. */
tn_status tn_frontier_prices_check(const tn_frontier *frontier, const bool *trays, tn_error *error);
void tn_frontier_prices_clear(tn_frontier_prices *prices);

tn_status tn_frontier_cost_number(tn_frontier *frontier, const mpq_t cost, uint32_t *number, tn_error *error);

/* unit := what it and all costs so far are multiples of; it is not below 0. */
void tn_frontier_cost_unit(const tn_frontier *frontier, mpq_t unit);

/* All costs are known: from now on steps gain. units: borrowed. */
tn_status tn_frontier_settle(tn_frontier *frontier, const tn_frontier_units *units, tn_error *error);

/* What the house of one tray costs, without what stands in its rooms, between plain walls. */
tn_status tn_frontier_tray_cost(tn_frontier *frontier, const tn_house *house, uint32_t *number, tn_error *error);

/* Appends what the costs of interfaces beside the tray depend on, but for walls that end there. */
bool tn_frontier_push_shape(const tn_frontier *frontier, const tn_house *house, tn_key *key);

/* What an interface costs: by how much its one or two trays cost more together, or less, than by themselves. left,
 * right: NULL outside. faces: those of the house that are in the interface. */
typedef struct tn_frontier_border {
    const tn_frontier_edge *left, *right;
    const uint32_t *faces;
    size_t count;
} tn_frontier_border;
tn_status tn_frontier_interface_cost(tn_frontier *frontier, const tn_frontier_border *border, const tn_house *house,
                                     uint32_t *number, tn_error *error);

/* The list of what the tiles cost that fit in a cell. */
tn_status tn_frontier_list_tiles(tn_frontier *frontier, const tn_house *house, const tn_variants *variants,
                                 uint32_t *list, tn_error *error);

/* ---- crossing an interface: step.c */

/* Words of what came of an outcome: what it is to the clauses (of `values`; TN_FRONTIER_NONE: the row begins), rooms,
 * each walk, then how many rooms have ended and are what each question asks for. */
enum { CROSSED_VALUES, CROSSED_ROOMS, CROSSED_WALKS };

/* What came of the interfaces that states with the same before them have met. mark: the stamp if that is known. */
typedef struct tn_frontier_row {
    uint32_t *before; /* the words of the states up to the last walk; first TN_FRONTIER_NONE: the row begins */
    uint32_t stamp;
    uint32_t *mark;              /* [insides + 1]: by what is inside the slice; last: the end */
    tn_frontier_list *interface; /* the same: borrowed from `interfaces` */
    size_t *first;               /* the same: of words, those of each outcome in order */
    uint32_t *words;
    size_t used, room;
} tn_frontier_row;

/* What came of rooms and walks at interfaces. */
typedef struct tn_frontier_crossed {
    tn_interner rooms, walks;
    tn_numbering befores; /* what is asked of the edge << 32 | rooms or a walk */
    tn_numbering moves;   /* through << 32 | what is met in the slice */
    tn_frontier_known of_rooms, of_walks[TN_FRONTIER_MEETINGS_MAX]; /* {before, move} */
    tn_frontier_row row;
} tn_frontier_crossed;

/* What comes of the outcomes of the interface between a state (its words; NULL: the row begins) and a slice
 * (TN_FRONTIER_NONE: the end): so many words each. Both are good until the next call. */
tn_status tn_frontier_cross(tn_frontier *frontier, const uint32_t *state, uint32_t slice, tn_frontier_list *interface,
                            const uint32_t **crossed, tn_error *error);
void tn_frontier_crossed_clear(tn_frontier_crossed *crossed);

/* What comes of one outcome alone, before a slice: so many words, to be filled in. near_side: its words. */
tn_status tn_frontier_cross_outcome(tn_frontier *frontier, const uint32_t *state, uint32_t slice, uint32_t outcome,
                                    const uint32_t *near_side, uint32_t *crossed, tn_error *error);

/* ---- steps: step.c */

/* Calls `seen` for each state after another slice (TN_FRONTIER_NONE: the end, and the state 0), with the number of
 * choices that lead there, that of those that differ in more than tiles, and what the step adds to the measures. If
 * tiles cost more or less, it is called for each sum, and those that differ in more than tiles come with the first.
 * trays: before the slice; state: TN_FRONTIER_NONE before the first. */
typedef tn_status tn_frontier_seen(void *context, uint32_t state, uint64_t times, uint64_t faced,
                                   const tn_house_gain *gain, tn_error *error);
tn_status tn_frontier_step(tn_frontier *frontier, uint32_t trays, uint32_t state, uint32_t slice,
                           tn_frontier_seen *seen, void *context, tn_error *error);

/* The same, with these outcomes (in the order of their numbers) at the interface before the slice alone. */
tn_status tn_frontier_step_by(tn_frontier *frontier, uint32_t trays, uint32_t state, uint32_t slice,
                              const tn_frontier_list *interface, tn_frontier_seen *seen, void *context,
                              tn_error *error);

/* May the row end in the state, after so many trays? */
tn_status tn_frontier_ends(tn_frontier *frontier, uint32_t trays, uint32_t state, bool *ends, tn_error *error);

/* ---- steps that are kept for ranks, which ask for the same again and again: step.c */

/* A way that a step goes on: over an outcome of the interface, of which there are so many choices, to the state
 * `after`, with so many arrangements of tiles for each. */
typedef struct tn_frontier_way {
    uint32_t outcome, after;
    uint64_t choices, tiles;
} tn_frontier_way;

typedef struct tn_frontier_ways_of_step {
    size_t first, count; /* of the items; by outcome */
} tn_frontier_ways_of_step;

/* Those of the steps after so many trays. */
typedef struct tn_frontier_ways_after {
    tn_numbering keys;            /* state << 32 | slice */
    tn_frontier_ways_of_step *of; /* [keys] */
    size_t room;
} tn_frontier_ways_after;

typedef struct tn_frontier_ways {
    bool wanted;                   /* ranks have begun: counting goes each step once */
    tn_frontier_ways_after *after; /* [trays_most + 1] */
    tn_frontier_way *items;
    size_t first, count, room, steps; /* first: of the step that is being kept; steps: of all */
} tn_frontier_ways;

/* Ranks begin: from now on steps are kept. */
tn_status tn_frontier_ways_want(tn_frontier *frontier, tn_error *error);

/* Those of a step that is kept, good until the next step; NULL: it is not. */
const tn_frontier_ways_of_step *tn_frontier_ways_find(const tn_frontier *frontier, uint32_t trays, uint32_t state,
                                                      uint32_t slice);

/* Begins to keep the ways of a step. False: steps are not kept, as something is added up on the way, what is kept is
 * not final, there are too many, or they are not wanted. Then each is added, and they are of this step; or they are
 * dropped. */
bool tn_frontier_ways_begin(tn_frontier *frontier);
tn_status tn_frontier_ways_add(tn_frontier *frontier, const tn_frontier_way *way, tn_error *error);
tn_status tn_frontier_ways_end(tn_frontier *frontier, uint32_t trays, uint32_t state, uint32_t slice, tn_error *error);
void tn_frontier_ways_drop(tn_frontier *frontier);
void tn_frontier_ways_forget(tn_frontier *frontier); /* states are numbered anew */

/* ---- steps in four stages, if nothing is added up and tiles have no prices: stage.c */

/* A step in four stages (stage.c).
 *
 * The near side of an interface is words: 0 (TN_FRONTIER_NONE: the row begins), a view of the rooms and of each walk,
 * and what the clauses have read, in the places where these are in a state. A view is what the right side can still
 * tell of them. The far side is an entry edge and what can be seen of the interface from there. A far list is far sides
 * with the number of choices that each has.
 *
 * An exit state is {near side, far list}. An entry state is {near side, far side}: the interface is known, the slice is
 * not. Of a slice state all of the slice is known but its exit and its tiles; its words: the slice's group, rooms,
 * walks, what the clauses have read, and what of the interface matters to the slice's tiles. */
enum { NEAR_BEGUN, SLICE_STATE_GROUP = NEAR_BEGUN };

/* Words of what can be seen of an interface from its right: the meetings (two words), marks and glass of each cell
 * there (of `views`), what matters to the tiles there. */
enum { RIGHT_MEETINGS, RIGHT_SIDES = RIGHT_MEETINGS + 2, RIGHT_FITS, RIGHT_WORDS };

/* Words of each part of a far list: a far side, and how many choices have it (two words). */
enum { FAR_SIDE, FAR_TIMES, FAR_WORDS = FAR_TIMES + 2 };

/* Outcomes of interfaces that the left side cannot tell apart, and all far sides that they have. */
typedef struct tn_frontier_interface_group {
    uint32_t left, fits; /* of `lefts`; of `lists` of tiles: for the pending tiles */
    uint32_t far_list;
} tn_frontier_interface_group;

typedef struct tn_frontier_interface_groups {
    tn_frontier_interface_group *items;
    size_t count;
} tn_frontier_interface_groups;

/* The first state that led to an exit state, and its side of the interface. Crossing is the same from all states that
 * lead there. */
typedef struct tn_frontier_exit_state {
    uint32_t state, left, fits;
} tn_frontier_exit_state;

/* The same of an entry state, with an outcome of the interface. */
typedef struct tn_frontier_entry_state {
    uint32_t state, outcome;
} tn_frontier_entry_state;

typedef struct tn_frontier_span {
    size_t first, count;
} tn_frontier_span;

/* The slice states that entry states lead to, by groups of slices. */
typedef struct tn_frontier_entered {
    uint32_t trays;          /* 1 and how many are before the step; 0: nothing is known */
    tn_numbering keys;       /* entry state << 32 | groups */
    tn_frontier_span *spans; /* [keys]: of slice states */
    uint32_t *slice_states;
    size_t span_room, slice_state_count, slice_state_room;
} tn_frontier_entered;

typedef struct tn_frontier_stages {
    tn_interner groups; /* of slices */
    uint32_t *slices;   /* [groups]: the first of each */
    size_t slice_room;
    tn_interner lefts, rights;                      /* what can be seen of outcomes from the left, from the right */
    tn_interner lists;                              /* of entries, of groups, of both, that can follow */
    tn_numbering far_sides;                         /* entry << 32 | right */
    tn_interner far_lists;                          /* FAR_WORDS for each far side, ascending */
    tn_numbering interface_group_keys;              /* left edge << 32 | entries */
    tn_frontier_interface_groups *interface_groups; /* [interface_group_keys] */
    size_t interface_group_room;
    tn_interner near_sides;
    tn_numbering exit_states, entry_states; /* near side << 32 | far list; near side << 32 | far side */
    tn_frontier_exit_state *exit_from;      /* [exit_states] */
    tn_frontier_entry_state *entry_from;    /* [entry_states] */
    size_t exit_state_room, entry_state_room;
    tn_frontier_entered entered;
    tn_interner slice_states;
    tn_interner views; /* of rooms, of walks; of cells at the right of an interface */
    tn_frontier_known room_views, walk_views[TN_FRONTIER_MEETINGS_MAX];       /* {before, left} */
    tn_frontier_known crossed_rooms, crossed_walks[TN_FRONTIER_MEETINGS_MAX]; /* {view, what it meets} */
    tn_numbering sided;                             /* sides of the right << 32 | met in a slice */
    uint32_t last;                                  /* 1 and the state whose exit states were found last; 0: none */
    uint32_t befores[1 + TN_FRONTIER_MEETINGS_MAX]; /* of its rooms, then of each walk */
} tn_frontier_stages;

bool tn_frontier_has_stages(const tn_frontier *frontier);

/* From a state (TN_FRONTIER_NONE before the first slice) to exit states, for slices with one of these entries; from an
 * exit state across the interface to the entry states that lead on; from an entry state into slices of the groups that
 * its entry has, to slice states; from a slice state to the state after one of these slices. entries, entry_groups:
 * numbers of lists. Shown to `seen` as by tn_frontier_step; trays: before the slice. */
tn_status tn_frontier_stage_exit(tn_frontier *frontier, uint32_t state, uint32_t entries, tn_frontier_seen *seen,
                                 void *context, tn_error *error);
tn_status tn_frontier_stage_cross(tn_frontier *frontier, uint32_t trays, uint32_t exit_state, uint32_t entry_groups,
                                  tn_frontier_seen *seen, void *context, tn_error *error);
tn_status tn_frontier_stage_enter(tn_frontier *frontier, uint32_t trays, uint32_t entry_state, uint32_t entry_groups,
                                  tn_frontier_seen *seen, void *context, tn_error *error);
void tn_frontier_entered_forget(tn_frontier_entered *entered);
tn_status tn_frontier_stage_pass(tn_frontier *frontier, uint32_t slice_state, uint32_t slice, tn_frontier_seen *seen,
                                 void *context, tn_error *error);

/* The number of a list: of entries, ascending; of groups, those together of which clauses read the same; of pairs of an
 * entry and the list of its groups, by entry. UINT32_MAX: out of memory. */
uint32_t tn_frontier_number_list(tn_frontier *frontier, const uint32_t *items, size_t count);

/* What can be seen of an outcome from its right: of `rights`; what of it matters to the tiles at its left. */
uint32_t tn_frontier_right_seen(const tn_frontier *frontier, uint32_t outcome);
uint32_t tn_frontier_left_fits(const tn_frontier *frontier, uint32_t outcome);

/* The group of a slice state. */
uint32_t tn_frontier_slice_state_group(const tn_frontier *frontier, uint32_t slice_state);

void tn_frontier_stages_forget(tn_frontier_stages *stages); /* states are numbered anew; groups stay */
void tn_frontier_stages_clear(tn_frontier_stages *stages);

/* Finds the group of a slice; what can be seen of an outcome (its words) from both sides. False: out of memory. */
bool tn_frontier_find_group(tn_frontier *frontier, uint32_t slice);
bool tn_frontier_split_outcome(tn_frontier *frontier, const uint32_t *words, uint32_t left_cells, uint32_t right_cells,
                               tn_frontier_outcome *parts);

/* ---- the engine */

struct tn_frontier {
    const tn_house_form *form;
    const tn_house_library_record *library;
    uint32_t shapes[TN_CHOICES_MAX];
    uint32_t trays_least, trays_most;
    tn_watch *watch;
    const tn_house_measures *measures;  /* or NULL */
    const tn_house_added *added;        /* these, and what clauses compare */
    const tn_frontier_without *without; /* or NULL; only while the clauses are made */
    const tn_frontier_units *units;     /* NULL: not known yet, and nothing is gained */
    bool scouting;                      /* tiles are left aside: see frontier.c */
    tn_frontier_questions questions;
    tn_frontier_clause *clauses;
    uint32_t clause_count;
    tn_frontier_reading reading;
    tn_frontier_comparisons compared;
    tn_frontier_edges edges;
    tn_frontier_slices_made slices;
    tn_frontier_interfaces_made interfaces;
    tn_frontier_outcomes_made outcomes;
    tn_frontier_tiles tiles;
    tn_frontier_merged merged;
    tn_frontier_sums sums;
    tn_frontier_prices prices;
    tn_interner states;
    uint8_t *ends; /* [states]: may the row end there? see tn_frontier_ends */
    size_t end_room;
    tn_frontier_crossed crossed;
    tn_frontier_ways ways;
    tn_frontier_stages stages;
    tn_key key, joined; /* scratch */
};

/* Does a clause compare anything? Before the units are known it cannot be said of what. */
static inline bool tn_frontier_compares(const tn_frontier *frontier)
{
    return frontier->added->count > frontier->added->measures;
}

/* The place among the words of a state; what the clauses have read comes before it. */
static inline uint32_t tn_frontier_pending_word(const tn_frontier *frontier)
{
    return STATE_WALKS + frontier->questions.walk_count + 1;
}

static inline size_t tn_frontier_crossed_words(const tn_frontier *frontier)
{
    return CROSSED_WALKS + (size_t)frontier->questions.walk_count + frontier->questions.room_count;
}

/* The answers of an edge's cell. */
static inline const uint64_t *tn_edge_answers(const tn_frontier *frontier, const tn_frontier_edge *edge, uint32_t cell)
{
    return edge->answers + cell * frontier->questions.answer_words;
}

static inline const tn_frontier_reach *tn_inside_reach(const tn_inside *inside, tn_frontier_role_at role, uint32_t cell)
{
    return &inside->frontier->edges.borders.reach[role][inside->cells[cell]->description];
}

/* Is it asked where in the row the walk's sources are? */
static inline bool tn_frontier_walk_placed(const tn_frontier *frontier, uint32_t walk)
{
    return frontier->questions.placed_walks >> walk & 1;
}

static inline size_t tn_frontier_place_words(const tn_frontier *frontier)
{
    return frontier->questions.placed_count > 0 ? 1 + (size_t)frontier->questions.placed_count : 0;
}

#endif
