/* What a tn_frontier is made of: the houses of one section, read tray by tray. Internal to runtime/house/frontier;
 * parts.h has what is done with it.
 *
 * A slice is a tray with functions and what is in its inner faces (back, front, between storeys), as far as anything
 * can tell it apart. An edge is what a slice shows the interface at its left or at its right: its cells, as far as that
 * can make a difference there, and where walls across end. An interface is what can stand between two edges: its
 * outcomes, each with the number of choices that have it. A state is what has to be known after a slice whose right
 * side is not decided: edge, tiles that are pending on that side, rooms, walks, and the states of the clauses.
 * Everything is numbered by what it is (tn_interner), so that equal things are one. */
#ifndef TARTAN_HOUSE_FRONTIER_DATA_H
#define TARTAN_HOUSE_FRONTIER_DATA_H

#include "runtime/base/array.h"
#include "runtime/base/int128.h"
#include "runtime/house/frontier/kept.h"
#include "runtime/house/frontier/without.h"
#include "runtime/house/house.h"
#include "runtime/house/measure/measure.h"
#include "runtime/plan/automata/numbering.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/uses.h"
#include "runtime/plan/match/vm.h"

#define TN_FRONTIER_NONE UINT32_MAX   /* no edge: the house begins or ends */
#define TN_FRONTIER_CELLS_MAX 60u     /* of a tray: sets of cells are words */
#define TN_FRONTIER_MEETINGS_MAX 30u  /* that clauses walk by */
#define TN_FRONTIER_QUESTIONS_MAX 32u /* about rooms */
#define TN_FRONTIER_KINDS_MAX 64u     /* that these ask for */
#define TN_FRONTIER_RATIOS_MAX 4u     /* of glass to floor, that these ask for */
#define TN_FRONTIER_PLACED_MAX 8u     /* questions about rooms that ask where in the row these are */
#define TN_FRONTIER_SLOTS_MAX 4u /* beginnings of rooms, or sources of a walk, that are told apart at an interface */
#define TN_FRONTIER_LETTERS_MAX 65536u     /* of a clause */
#define TN_FRONTIER_FUNCTIONS_MAX 1000000u /* ways to give a tray's cells their functions */
#define TN_FRONTIER_SLICES_MAX 200000u     /* choices of trays that are told apart */
#define TN_FRONTIER_CHOICES_MAX 4000000u   /* of a tray's functions and faces, or of an interface's */

/* ---- frontier.c: what clauses and face lines ask */

typedef struct tn_frontier_room {
    uint32_t function;   /* of kind ROOM */
    uint64_t all, kinds; /* which of the ALL_CELLS functions and the kinds below it asks for */
    bool area, cells;
    uint32_t ratios; /* a bit for each of the ratios below */
} tn_frontier_room;

/* Of an APART or MEETS: places of decisions. any: all cells are walked through. */
typedef struct tn_frontier_walk {
    size_t first, second, through;
    bool any;
} tn_frontier_walk;

typedef struct tn_frontier_questions {
    uint32_t *decisions; /* functions of kind CELL that are asked of cells at an interface, or of cells of rooms */
    size_t decision_count, decision_room;
    uint32_t meetings[64];              /* MEETING records that MEETS asks for */
    tn_frontier_walk meeting_parts[64]; /* the same */
    uint32_t meeting_count;
    uint32_t walks[TN_FRONTIER_MEETINGS_MAX];              /* MEETING records that APART asks for */
    tn_frontier_walk walk_parts[TN_FRONTIER_MEETINGS_MAX]; /* the same */
    uint32_t walk_count;
    uint32_t placed_walks; /* a bit for each of the walks: clauses ask where in the row its sources are */
    tn_frontier_room rooms[TN_FRONTIER_QUESTIONS_MAX];
    uint32_t room_count;
    uint32_t placed_rooms[TN_FRONTIER_PLACED_MAX]; /* of `rooms`: clauses ask where in the row they are */
    uint32_t placed_count;
    uint32_t all[64];         /* decisions that rooms ask of all cells */
    size_t all_decisions[64]; /* their places */
    uint32_t all_count;
    uint32_t kinds[TN_FRONTIER_KINDS_MAX];
    uint32_t kind_count;
    int64_t ratios[TN_FRONTIER_RATIOS_MAX]; /* as in the code: of << 32 | to */
    uint32_t ratio_count;
    tn_int128 area_most; /* more than this is not told apart */
    uint32_t cells_most;
} tn_frontier_questions;

/* ---- clause.c */

/* An instruction about houses that a clause depends on. radix: how many values a letter has for it that are known only
 * at the right side of the tray; 1: none. */
enum { TRUTH_LATER, TRUTH_YES, TRUTH_NO, TN_FRONTIER_TRUTHS }; /* of a comparison: it is known at the end of the row */
typedef struct tn_frontier_atom {
    tn_instruction op;
    uint32_t of; /* MEETS: of `meetings`; APART: of `walks`; SOME_ROOM, ROOMS: of `rooms` */
    uint32_t radix;
    bool placed;    /* where in the row matters: clause.c */
    uint32_t place; /* placed rooms: of `placed_rooms` */
    uint32_t slots; /* placed: how many are told apart, */
    uint32_t most;  /* and how many rooms that end in one tray with each */
} tn_frontier_atom;

/* The completions that a clause's states keep after so many letters. pairs: {its state, the base of the last tray,
 * whose value is not known yet}. */
typedef struct tn_frontier_completions {
    uint32_t *alike; /* [states]: the first that keeps the same completions; TN_NO_STATE: it keeps none */
    tn_numbering pairs;
    uint64_t *of_pair; /* [pairs]: the first that leads to the same states; TN_FRONTIER_NO_PAIR: none keeps anything */
    tn_interner classes; /* where the values lead */
    uint64_t *first;     /* [classes] */
    size_t pair_room, first_room;
} tn_frontier_completions;

/* What a slice is to one clause: {class of its tray, then a word or four for each atom}. */
typedef struct tn_frontier_clause {
    uint32_t holds; /* function */
    bool prunes;
    bool without, differs; /* see tn_frontier_without */
    tn_classes *classes;   /* of trays */
    tn_frontier_atom *atoms;
    size_t atom_count, atom_room;
    uint32_t radix;                       /* letters of one base: the product over the atoms */
    tn_interner bases;                    /* of slices */
    tn_dfa *dfa;                          /* of what the clause keeps, over letters base * radix + value */
    tn_frontier_completions *completions; /* [trays_most + 1] */
} tn_frontier_clause;

/* Where an edge is met: from its left, at the slice's entry, or from its right. */
typedef enum tn_frontier_role_at { TN_FRONTIER_ENTRY, TN_FRONTIER_EXIT, TN_FRONTIER_ROLES } tn_frontier_role_at;

/* What can be in a cell's faces at an interface: kinds that rooms ask for, that walks step through (a bit each), that
 * meetings ask for; nothing at all, so that rooms go on; glass to the outside. */
typedef struct tn_frontier_reach {
    uint64_t marks, meetings;
    uint32_t walks;
    bool open, glazed;
} tn_frontier_reach;

/* What lines of faces can tell of cells at interfaces: edge.c. */
typedef struct tn_frontier_borders {
    tn_interner descriptions;
    uint32_t *classes[TN_FRONTIER_ROLES];        /* [descriptions] */
    tn_frontier_reach *reach[TN_FRONTIER_ROLES]; /* the same */
    uint64_t *matter[TN_FRONTIER_ROLES];         /* [descriptions][answer_words]: decisions that can matter there */
} tn_frontier_borders;

/* The trays that plans of the library have. */
typedef struct tn_frontier_trays {
    bool *stand;       /* [trays of the schema] */
    uint64_t *follows; /* [trays][words]: a bit for each tray that can follow; NULL: each may follow each */
    size_t words;
} tn_frontier_trays;

/* any: it may be what a question asks for, for which its faces of these kinds, its area and its glass can matter. */
typedef struct tn_room_open {
    bool any, area, glass;
    uint64_t kinds;
} tn_room_open;

/* What a cell is to a walk; as a word: bits in this order. ends: no step leads on to the right. */
typedef struct tn_frontier_role {
    bool through, goal, source, ends;
} tn_frontier_role;
enum { ROLE_THROUGH = 1, ROLE_GOAL = 2, ROLE_SOURCE = 4, ROLE_ENDS = 8, ROLES_APART = 16 };

/* ---- edges, slices, interfaces */

typedef struct tn_frontier_cell {
    int64_t y0, y1;
    uint32_t storey, function;
    bool open, tiled;
} tn_frontier_cell;

/* What a slice shows the interface at its left, or at its right. Cells with their functions, and what is in the inner
 * faces of the house of one tray, in their order, are those of the first slice that has the edge. */
typedef struct tn_frontier_edge {
    tn_tray tray;
    uint32_t count; /* cells */
    tn_frontier_cell *cells;
    uint64_t *answers; /* [count][answer_words] of the decisions */
    uint32_t asked;    /* which cells are open, the answers, and where rooms are placed, which cells have one function,
                          by number: all that rooms and walks know of the edge */
    uint32_t *inner;
    size_t inner_count;
    uint32_t shape,
        cost; /* where costs are asked for: what its interfaces' costs depend on; of the house of one tray */
} tn_frontier_edge;

/* One of a tray's slices, and how many choices have it. */
typedef struct tn_frontier_choice {
    uint32_t slice;
    uint64_t times;
} tn_frontier_choice;

typedef struct tn_frontier_list {
    tn_frontier_choice *items; /* by slice: of a tray; by outcome: of an interface */
    size_t count, room;
    bool made;
} tn_frontier_list;

/* Slices or outcomes, one for each choice, in the order of the choices. */
typedef struct tn_frontier_ordered {
    uint32_t *items;
    size_t count, room;
} tn_frontier_ordered;

/* Cells with these functions (of `functions`) can be the slice, with so many choices of what is in the inner faces. */
typedef struct tn_frontier_furnished {
    uint32_t functions, slice;
    uint64_t times;
} tn_frontier_furnished;

typedef struct tn_frontier_furnished_list {
    tn_frontier_furnished *items; /* of a tray: by functions, in the order of houses */
    size_t count, room;
} tn_frontier_furnished_list;

/* Words of a slice's key: its edges at the left and at the right, then CELL_WORDS for each cell, then the number of its
 * steps and STEP_WORDS for each, then the base of each clause; then two words for each measure of what its cells add to
 * it; then, where costs are asked for, the number of the tray's. */
enum { SLICE_ENTRY, SLICE_EXIT, SLICE_CELLS };
enum {
    CELL_TILE,
    CELL_AREA,
    CELL_GLASS,
    CELL_MARKS,
    CELL_FAILS = CELL_MARKS + 2, /* of `all`, what it is not */
    CELL_ROOM = CELL_FAILS + 2,
    CELL_ROOM_IS, /* ROOM_GOES_ON: TRUTH is not known yet */
    CELL_TRUTH,   /* a bit for each question about rooms: is it so? */
    CELL_WORDS
};
enum { ROOM_IS_VOID, ROOM_GOES_ON, ROOM_IS_KNOWN };
enum { STEP_FROM, STEP_TO, STEP_HOW, STEP_WORDS }; /* HOW: bit 0: one room; bit w + 1: a step of walk w */

/* Words of an outcome's key: the meetings across the interface (two words), the number of steps and STEP_WORDS for
 * each, then SIDE_WORDS for each cell of the left and of the right edge, then the number of cells of the left one;
 * then, where costs are asked for, the number of the interface's. FIT: 0 for a cell without tiles, or 1 and what of the
 * side matters to them. */
enum { SIDE_MARKS, SIDE_MARKS_HIGH, SIDE_FIT, SIDE_GLASS, SIDE_WORDS };

/* What parts of a slice are, by number: equal parts are one. Lists of fits have a word for each cell: 0, or 1 and what
 * matters to its tiles. */
typedef struct tn_frontier_slice {
    uint32_t entry, exit;        /* edges: at its left, at its right */
    uint32_t bases;              /* of all clauses: of `letters` */
    uint32_t tiles;              /* what of its own walls matters to each cell's tiles: of `fit_lists` */
    uint32_t inside;             /* its edge, and what rooms and walks meet in it: of `insides` */
    uint32_t met;                /* the same, but of its edge only what is asked: of `mets` */
    uint32_t plain;              /* the first slice that can differ from it only in tiles and what is added up */
    uint32_t group;              /* its entry, what is met in it, its bases: of `groups` */
    uint32_t cost;               /* where costs are asked for: the number of the tray's */
    int64_t gains[TN_ADDED_MAX]; /* what its cells, and its tray, add to each number that is added up */
} tn_frontier_slice;

/* The same of an outcome. */
typedef struct tn_frontier_outcome {
    uint32_t left_fits, right_fits; /* of `fit_lists` */
    uint32_t through;               /* what rooms and walks meet at the interface: of `throughs` */
    uint32_t left, right, plain;    /* of `lefts` and `rights` of the stages; plain: as if nothing mattered to tiles */
    uint32_t cost;                  /* where costs are asked for: the number of the interface's */
} tn_frontier_outcome;

/* Words of a state: edge, rooms, each walk, what the clauses have read, the tiles that are pending on its right side;
 * then, if clauses compare, the number of the totals. */
enum { STATE_EDGE, STATE_ROOMS, STATE_WALKS };

/* What came of pairs of numbers. */
typedef struct tn_frontier_known {
    tn_numbering pairs; /* first << 32 | second */
    uint32_t *results;  /* [pairs][words] */
    size_t room;
} tn_frontier_known;

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
    uint32_t left, fits; /* of `lefts`; of `fit_lists`: for the pending tiles */
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
    uint32_t left;                                  /* 1 and the state that was left last; 0: none */
    uint32_t befores[1 + TN_FRONTIER_MEETINGS_MAX]; /* of its rooms, then of each walk */
} tn_frontier_stages;

/* Words of what came of an outcome: what it is to the clauses (of `values`; TN_FRONTIER_NONE: the row begins), rooms,
 * each walk, then how many rooms have ended and are what each question asks for. */
enum { CROSSED_VALUES, CROSSED_ROOMS, CROSSED_WALKS };

/* What came of the interfaces that states with the same before them have met. mark: the stamp where that is known. */
typedef struct tn_frontier_row {
    uint32_t *before; /* the words of the states up to the last walk; first TN_FRONTIER_NONE: the row begins */
    uint32_t stamp;
    uint32_t *mark;              /* [insides + 1]: by what is inside the slice; last: the end */
    tn_frontier_list *interface; /* the same: borrowed from `interfaces` */
    size_t *first;               /* the same: of words, those of each outcome in order */
    uint32_t *words;
    size_t used, room;
} tn_frontier_row;

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

/* What steps add to a compared number: from, to. */
typedef struct tn_frontier_range {
    bool any;
    tn_int128 from, to;
} tn_frontier_range;

/* What may still be added to each compared number after so many trays: by another tray, by the end of the row, in all.
 */
typedef struct tn_frontier_ahead {
    tn_frontier_range tray[TN_COMPARED_MAX], end[TN_COMPARED_MAX], all[TN_COMPARED_MAX];
} tn_frontier_ahead;

typedef struct tn_frontier {
    const tn_house_form *form;
    const tn_house_library_record *library;
    uint32_t shapes[TN_CHOICES_MAX];
    uint32_t trays_least, trays_most;
    tn_watch *watch;
    const tn_house_measures *measures;  /* or NULL */
    const tn_house_added *added;        /* these, and what clauses compare */
    const tn_frontier_without *without; /* or NULL; only while the clauses are made */
    const tn_frontier_units *units;     /* NULL: not known yet, and nothing is gained */
    tn_frontier_prices prices;
    tn_frontier_sums sums;
    uint32_t *weighed_rooms[TN_ADDED_MAX]; /* [terms of the number]: of the questions about rooms */
    tn_plan_vm *plan_vm;                   /* what comparisons add up of trays; NULL: none does */
    tn_interner totals;                    /* what compared numbers come to so far: reading.c */
    tn_frontier_ahead *ahead;              /* [trays_most + 1], once it is known or being found */
    bool looking_ahead;                    /* totals are left aside: reading.c */
    tn_frontier_questions questions;
    size_t answer_words;
    tn_numbering fails;       /* of rooms, that were met: tn_frontier_room_open */
    tn_room_open *open_rooms; /* [fails] */
    size_t open_room;
    bool *tiled, any_tiled; /* [functions] */
    bool *asked_function;   /* [functions]: can something be asked of rooms with this function? */
    bool scouting;          /* tiles are left aside: see frontier.c */
    tn_frontier_merged merged;
    tn_frontier_clause *clauses;
    uint32_t clause_count;
    tn_frontier_list *of_tray;             /* [trays of the schema] */
    tn_frontier_furnished_list *furnished; /* the same */
    tn_interner functions;                 /* of the cells of a tray */
    tn_frontier_orders slice_orders, outcome_orders;
    tn_frontier_borders borders;
    uint8_t *ends; /* [states]: may the row end there? see tn_frontier_ends */
    size_t end_room;
    tn_frontier_ways ways;
    tn_interner edge_keys, slice_keys, outcome_keys, areas, bases, sides, pending, rooms, walks, states;
    tn_frontier_edge *edges;
    size_t edge_room;
    tn_interner parts, combined; /* of interfaces: what comes of their storeys; these together: interface.c */
    uint32_t *of_combined;       /* [combined]: outcomes */
    size_t combined_room;
    tn_numbering interface_keys;
    tn_frontier_list *interfaces;
    size_t interface_room;
    uint64_t interface_outcomes; /* of all interfaces */
    tn_numbering fit_keys[2];    /* {base, left side}, then {that, right side} */
    uint32_t *fits;              /* [fit_keys[1]]: tiles */
    size_t fit_room;
    tn_frontier_slice *slices;     /* [slices] */
    tn_frontier_outcome *outcomes; /* [outcomes] */
    size_t slice_room, outcome_room;
    tn_interner letters, fit_lists, asked, insides, mets, throughs;
    tn_interner plain_keys;
    uint32_t *plains; /* [plain_keys]: slices */
    size_t plain_room;
    tn_frontier_row row;
    tn_frontier_stages stages;
    tn_interner readings, between, values;            /* see reading.c */
    tn_frontier_known *after_slice, *after_interface; /* [trays_most + 1] */
    tn_frontier_known tiles;                          /* {pending, left fits}: how many, unless they have prices */
    tn_frontier_known pending_of; /* {tiles of a slice, right fits}: what is pending; how many times that */
    tn_numbering befores;         /* what is asked of the edge << 32 | rooms or a walk */
    tn_numbering moves;           /* through << 32 | what is met in the slice */
    tn_frontier_known crossed_rooms, crossed_walks[TN_FRONTIER_MEETINGS_MAX]; /* {before, move} */
    tn_key key, joined;                                                       /* scratch */
    uint32_t *scratch;                                                        /* [2 * clauses] */
} tn_frontier;

static inline bool tn_frontier_ordered_add(tn_frontier_ordered *ordered, uint32_t item)
{
    if (!tn_array_reserve(&ordered->items, &ordered->room, ordered->count, 1, sizeof *ordered->items))
        return false;
    ordered->items[ordered->count++] = item;
    return true;
}

/* ---- words */

static inline uint32_t tn_low(uint64_t word)
{
    return (uint32_t)word;
}

static inline uint32_t tn_high(uint64_t word)
{
    return (uint32_t)(word >> 32);
}

static inline uint64_t tn_both(const uint32_t *words)
{
    return words[0] | (uint64_t)words[1] << 32;
}

static inline bool tn_push_long(tn_key *key, uint64_t word)
{
    return tn_key_push(key, tn_low(word)) && tn_key_push(key, tn_high(word));
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
    return edge->answers + cell * frontier->answer_words;
}

static inline bool tn_answers(const uint64_t *answers, size_t decision)
{
    return answers[decision / 64] >> decision % 64 & 1;
}

static inline bool tn_frontier_reaches_rooms(const tn_frontier_reach *reach)
{
    return reach->open || reach->glazed || reach->marks != 0;
}

/* What a cell of a tray with one function is. */
typedef struct tn_frontier_cut {
    bool known;
    uint32_t description;
    uint64_t *answers; /* [answer_words] of the decisions */
} tn_frontier_cut;

/* A tray as a house of its own. */
typedef struct tn_inside {
    tn_frontier *frontier;
    tn_tray tray;
    tn_house house;
    const tn_frontier_cut *cells[TN_FRONTIER_CELLS_MAX];
} tn_inside;

static inline const tn_frontier_reach *tn_inside_reach(const tn_inside *inside, tn_frontier_role_at role, uint32_t cell)
{
    return &inside->frontier->borders.reach[role][inside->cells[cell]->description];
}

static inline bool tn_face_is_inner(const tn_face *face)
{
    return face->relation == TN_FACE_UNDER || face->side == TN_HOUSE_BACK || face->side == TN_HOUSE_FRONT;
}

#endif
