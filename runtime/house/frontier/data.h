/* What a tn_strip is made of: the houses of one section, read tray by tray. Internal to runtime/house/frontier;
 * parts.h has what is done with it.
 *
 * A slice is a tray with functions and what is in its inner faces (back, front, between storeys), as far as anything
 * can tell it apart. An edge is what a slice shows the plane at its left or at its right: its cells, as far as that can
 * make a difference there, and where walls across end. A plane is what can stand between two edges: its outcomes, each
 * with the number of choices that have it. A state is what has to be known after a slice whose right side is not
 * decided: edge, tiles that wait for that side, rooms, walks, and the states of the clauses. Everything is numbered by
 * what it is (tn_interner), so that equal things are one.
 */
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

#define TN_STRIP_NONE UINT32_MAX        /* no edge: the house begins or ends */
#define TN_STRIP_CELLS_MAX 60u          /* of a tray: sets of cells are words */
#define TN_STRIP_MEETINGS_MAX 30u       /* that clauses walk by */
#define TN_STRIP_QUESTIONS_MAX 32u      /* about rooms */
#define TN_STRIP_KINDS_MAX 64u          /* that these ask for */
#define TN_STRIP_RATIOS_MAX 4u          /* of glass to floor, that these ask for */
#define TN_STRIP_PLACED_MAX 8u          /* questions about rooms that ask where in the row these are */
#define TN_STRIP_SLOTS_MAX 4u           /* beginnings of rooms, or sources of a walk, that are told apart at a plane */
#define TN_STRIP_LETTERS_MAX 65536u     /* of a clause */
#define TN_STRIP_FUNCTIONS_MAX 1000000u /* ways to give a tray's cells their functions */
#define TN_STRIP_SLICES_MAX 200000u     /* choices of trays that are told apart */
#define TN_STRIP_CHOICES_MAX 4000000u   /* of a tray's functions and faces, or of a plane's */

/* ---- frontier.c: what clauses and face lines ask */

typedef struct tn_strip_room {
    uint32_t function;   /* of kind ROOM */
    uint64_t all, kinds; /* which of the ALL_CELLS functions and the kinds below it asks for */
    bool area, cells;
    uint32_t ratios; /* a bit for each of the ratios below */
} tn_strip_room;

/* Of an APART or MEETS: places of decisions. any: all cells are walked through. */
typedef struct tn_strip_walk {
    size_t first, second, through;
    bool any;
} tn_strip_walk;

typedef struct tn_strip_questions {
    uint32_t *decisions; /* functions of kind CELL that are asked of cells at a plane, or of cells of rooms */
    size_t decision_count, decision_room;
    uint32_t meetings[64];           /* MEETING records that MEETS asks for */
    tn_strip_walk meeting_parts[64]; /* the same */
    uint32_t meeting_count;
    uint32_t walks[TN_STRIP_MEETINGS_MAX];           /* MEETING records that APART asks for */
    tn_strip_walk walk_parts[TN_STRIP_MEETINGS_MAX]; /* the same */
    uint32_t walk_count;
    uint32_t placed_walks; /* a bit for each of the walks: clauses ask where in the row its sources are */
    tn_strip_room rooms[TN_STRIP_QUESTIONS_MAX];
    uint32_t room_count;
    uint32_t placed_rooms[TN_STRIP_PLACED_MAX]; /* of `rooms`: clauses ask where in the row they are */
    uint32_t placed_count;
    uint32_t all[64];         /* decisions that rooms ask of all cells */
    size_t all_decisions[64]; /* their places */
    uint32_t all_count;
    uint32_t kinds[TN_STRIP_KINDS_MAX];
    uint32_t kind_count;
    int64_t ratios[TN_STRIP_RATIOS_MAX]; /* as in the code: of << 32 | to */
    uint32_t ratio_count;
    tn_int128 area_most; /* more than this is not told apart */
    uint32_t cells_most;
} tn_strip_questions;

/* ---- clause.c */

/* An instruction about houses that a clause depends on. radix: how many values a letter has for it that are known only
 * at the right side of the tray; 1: none. */
enum { TRUTH_LATER, TRUTH_YES, TRUTH_NO, TN_STRIP_TRUTHS }; /* of a comparison: it is known at the end of the row */
typedef struct tn_strip_atom {
    tn_instruction op;
    uint32_t of; /* MEETS: of `meetings`; APART: of `walks`; SOME_ROOM, ROOMS: of `rooms` */
    uint32_t radix;
    bool placed;    /* where in the row matters: clause.c */
    uint32_t place; /* placed rooms: of `placed_rooms` */
    uint32_t slots; /* placed: how many are told apart, */
    uint32_t most;  /* and how many rooms that end in one tray with each */
} tn_strip_atom;

/* What a clause can still tell apart after so many letters. pairs: {its state, the base of the last tray, whose value
 * is not known yet}. */
typedef struct tn_strip_horizon {
    uint32_t *alike; /* [states]: the first that keeps the same; TN_NO_STATE: it keeps nothing */
    tn_numbering pairs;
    uint64_t *of_pair;   /* [pairs]: the first that leads to the same states; TN_STRIP_NO_PAIR: none keeps anything */
    tn_interner classes; /* where the values lead */
    uint64_t *first;     /* [classes] */
    size_t pair_room, first_room;
} tn_strip_horizon;

/* What a slice is to one clause: {class of its tray, then a word or four for each atom}. */
typedef struct tn_strip_clause {
    uint32_t holds; /* function */
    bool prunes;
    bool without, differs; /* see tn_strip_without */
    tn_classes *classes;   /* of trays */
    tn_strip_atom *atoms;
    size_t atom_count, atom_room;
    uint32_t radix;             /* letters of one base: the product over the atoms */
    tn_interner bases;          /* of slices */
    tn_dfa *dfa;                /* of what the clause keeps, over letters base * radix + value */
    tn_strip_horizon *horizons; /* [trays_most + 1] */
} tn_strip_clause;

/* Where an edge is met: from its left, at the slice's entry, or from its right. */
typedef enum tn_strip_role_at { TN_STRIP_ENTRY, TN_STRIP_EXIT, TN_STRIP_ROLES } tn_strip_role_at;

/* What can be in a cell's faces at a plane: kinds that rooms ask for, that walks step through (a bit each), that
 * meetings ask for; nothing at all, so that rooms go on; glass to the outside. */
typedef struct tn_strip_reach {
    uint64_t marks, meetings;
    uint32_t walks;
    bool open, glazed;
} tn_strip_reach;

/* What lines of faces can tell of cells at planes: edge.c. */
typedef struct tn_strip_borders {
    tn_interner descriptions;
    uint32_t *classes[TN_STRIP_ROLES];     /* [descriptions] */
    tn_strip_reach *reach[TN_STRIP_ROLES]; /* the same */
    uint64_t *matter[TN_STRIP_ROLES];      /* [descriptions][answer_words]: decisions that can matter there */
} tn_strip_borders;

/* The trays that plans of the library have. */
typedef struct tn_strip_trays {
    bool *stand;       /* [trays of the schema] */
    uint64_t *follows; /* [trays][words]: a bit for each tray that can follow; NULL: each may follow each */
    size_t words;
} tn_strip_trays;

/* any: it may be what a question asks for, for which its faces of these kinds, its area and its glass can matter. */
typedef struct tn_room_open {
    bool any, area, glass;
    uint64_t kinds;
} tn_room_open;

/* What a cell is to a walk; as a word: bits in this order. ends: no step leads on to the right. */
typedef struct tn_strip_role {
    bool through, goal, source, ends;
} tn_strip_role;
enum { ROLE_THROUGH = 1, ROLE_GOAL = 2, ROLE_SOURCE = 4, ROLE_ENDS = 8, ROLES_APART = 16 };

/* ---- edges, slices, planes */

typedef struct tn_strip_cell {
    int64_t y0, y1;
    uint32_t storey, function;
    bool open, tiled;
} tn_strip_cell;

/* What a slice shows the plane at its left, or at its right. Cells with their functions, and what is in the inner faces
 * of the house of one tray, in their order, are those of the first slice that has the edge. */
typedef struct tn_strip_edge {
    tn_tray tray;
    uint32_t count; /* cells */
    tn_strip_cell *cells;
    uint64_t *answers; /* [count][answer_words] of the decisions */
    uint32_t asked;    /* which cells are open, the answers, and where rooms are placed, which cells have one function,
                          by number: all that rooms and walks know of the edge */
    uint32_t *inner;
    size_t inner_count;
    uint32_t shape, cost; /* where costs are asked for: what its planes' costs depend on; of the house of one tray */
} tn_strip_edge;

/* One of a tray's slices, and how many choices have it. */
typedef struct tn_strip_choice {
    uint32_t slice;
    uint64_t times;
} tn_strip_choice;

typedef struct tn_strip_list {
    tn_strip_choice *items; /* by slice: of a tray; by outcome: of a plane */
    size_t count, room;
    bool made;
} tn_strip_list;

/* Slices or outcomes, one for each choice, in the order of the choices. */
typedef struct tn_strip_ordered {
    uint32_t *items;
    size_t count, room;
} tn_strip_ordered;

/* Cells with these functions (of `functions`) can be the slice, with so many choices of what is in the inner faces. */
typedef struct tn_strip_furnished {
    uint32_t functions, slice;
    uint64_t times;
} tn_strip_furnished;

typedef struct tn_strip_furnished_list {
    tn_strip_furnished *items; /* of a tray: by functions, in the order of houses */
    size_t count, room;
} tn_strip_furnished_list;

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

/* Words of an outcome's key: the meetings across the plane (two words), the number of steps and STEP_WORDS for each,
 * then SIDE_WORDS for each cell of the left and of the right edge, then the number of cells of the left one; then,
 * where costs are asked for, the number of the plane's. FIT: 0 for a cell without tiles, or 1 and what of the side
 * matters to them. */
enum { SIDE_MARKS, SIDE_MARKS_HIGH, SIDE_FIT, SIDE_GLASS, SIDE_WORDS };

/* What parts of a slice are, by number: equal parts are one. Lists of fits have a word for each cell: 0, or 1 and what
 * matters to its tiles. */
typedef struct tn_strip_slice {
    uint32_t entry, exit;        /* edges: at its left, at its right */
    uint32_t bases;              /* of all clauses: of `letters` */
    uint32_t tiles;              /* what of its own walls matters to each cell's tiles: of `fit_lists` */
    uint32_t inside;             /* its edge, and what rooms and walks meet in it: of `insides` */
    uint32_t met;                /* the same, but of its edge only what is asked: of `mets` */
    uint32_t plain;              /* the first slice that can differ from it only in tiles and what is added up */
    uint32_t group;              /* its entry, what is met in it, its bases: of `groups` */
    uint32_t cost;               /* where costs are asked for: the number of the tray's */
    int64_t gains[TN_ADDED_MAX]; /* what its cells, and its tray, add to each number that is added up */
} tn_strip_slice;

/* The same of an outcome. */
typedef struct tn_strip_outcome {
    uint32_t left_fits, right_fits; /* of `fit_lists` */
    uint32_t through;               /* what rooms and walks meet at the plane: of `throughs` */
    uint32_t left, right, plain;    /* of `lefts` and `rights` of the stages; plain: as if nothing mattered to tiles */
    uint32_t cost;                  /* where costs are asked for: the number of the plane's */
} tn_strip_outcome;

/* Words of a state: edge, rooms, each walk, what the clauses have read, what waits for its right side; then, where
 * clauses compare, the number of the totals. */
enum { STATE_EDGE, STATE_ROOMS, STATE_WALKS };

/* What came of pairs of numbers. */
typedef struct tn_strip_known {
    tn_numbering pairs; /* first << 32 | second */
    uint32_t *results;  /* [pairs][words] */
    size_t room;
} tn_strip_known;

/* A step in four stages, so that what is equal half way is gone on from once (stage.c).
 *
 * What is behind a plane, as it is seen from there, is words: 0 (TN_STRIP_NONE: the row begins), a view of the rooms
 * and of each walk, and what the clauses have read, in the places where these are in a state. What faces it, at the
 * plane's right side, is an entry and what can be seen of the plane from there. In between an outlook stands for all
 * that can face it. So a leaving is {what is behind, an outlook}; a threshold, where the plane is known and the slice
 * is not, {what is behind, what faces it}. Words of an arrival, where all of the slice is known but its exit and its
 * tiles: the slice's group, rooms, walks and what the clauses have read; then what of the plane matters to its tiles.
 */
enum { BEHIND_BEGUN, ARRIVAL_GROUP = BEHIND_BEGUN };

/* Words of what can be seen of a plane from its right: the meetings (two words), marks and glass of each cell there (of
 * `views`), what matters to the tiles there. */
enum { RIGHT_MEETINGS, RIGHT_SIDES = RIGHT_MEETINGS + 2, RIGHT_FITS, RIGHT_WORDS };

/* Words of each part of an outlook: what faces the plane, and how many choices have it (two words). */
enum { OUTLOOK_FACING, OUTLOOK_TIMES, OUTLOOK_WORDS = OUTLOOK_TIMES + 2 };

/* What can be seen of a plane from its left, and all that then can stand at its right. */
typedef struct tn_strip_prospect {
    uint32_t left, fits; /* of `lefts`; of `fit_lists`: for the tiles that wait */
    uint32_t outlook;
} tn_strip_prospect;

typedef struct tn_strip_prospects {
    tn_strip_prospect *items;
    size_t count;
} tn_strip_prospects;

/* The first state that led to a leaving, and what it saw of the plane. Crossing is the same from all. */
typedef struct tn_strip_leaving {
    uint32_t state, left, fits;
} tn_strip_leaving;

/* The same of a threshold, with an outcome of the plane. */
typedef struct tn_strip_threshold {
    uint32_t state, outcome;
} tn_strip_threshold;

typedef struct tn_strip_span {
    size_t first, count;
} tn_strip_span;

/* What thresholds lead to by groups of slices (stage.c). */
typedef struct tn_strip_entered {
    uint32_t trays;       /* 1 and how many are before the step; 0: nothing is known */
    tn_numbering keys;    /* threshold << 32 | groups */
    tn_strip_span *spans; /* [keys]: of arrivals */
    uint32_t *arrivals;
    size_t span_room, arrival_count, arrival_room;
} tn_strip_entered;

typedef struct tn_strip_stages {
    tn_interner groups; /* of slices */
    uint32_t *slices;   /* [groups]: the first of each */
    size_t slice_room;
    tn_interner lefts, rights;     /* what can be seen of outcomes from the left, from the right */
    tn_interner lists;             /* of entries, of groups, of both, that can follow */
    tn_numbering facings;          /* entry << 32 | right */
    tn_interner outlooks;          /* OUTLOOK_WORDS for each facing, ascending */
    tn_numbering prospect_keys;    /* left edge << 32 | entries */
    tn_strip_prospects *prospects; /* [prospect_keys] */
    size_t prospect_room;
    tn_interner behinds;
    tn_numbering leavings, thresholds; /* behind << 32 | outlook; behind << 32 | facing */
    tn_strip_leaving *left_by;         /* [leavings] */
    tn_strip_threshold *crossed_by;    /* [thresholds] */
    size_t leaving_room, threshold_room;
    tn_strip_entered entered;
    tn_interner arrivals;
    tn_interner views; /* of rooms, of walks; of cells at the right of a plane */
    tn_strip_known room_views, walk_views[TN_STRIP_MEETINGS_MAX];       /* {before, left} */
    tn_strip_known crossed_rooms, crossed_walks[TN_STRIP_MEETINGS_MAX]; /* {view, what it meets} */
    tn_numbering sided;                                                 /* sides of the right << 32 | met in a slice */
    uint32_t left;                               /* 1 and the state that was left last; 0: none */
    uint32_t befores[1 + TN_STRIP_MEETINGS_MAX]; /* of its rooms, then of each walk */
} tn_strip_stages;

/* Words of what came of an outcome: what it is to the clauses (of `values`; TN_STRIP_NONE: the row begins), rooms, each
 * walk, then how many rooms have ended and are what each question asks for. */
enum { CROSSED_VALUES, CROSSED_ROOMS, CROSSED_WALKS };

/* What came of the planes that states with the same before them have met. mark: the stamp where that is known. */
typedef struct tn_strip_row {
    uint32_t *before; /* the words of the states up to the last walk; first TN_STRIP_NONE: the row begins */
    uint32_t stamp;
    uint32_t *mark;       /* [insides + 1]: by what is inside the slice; last: the end */
    tn_strip_list *plane; /* the same: borrowed from `planes` */
    size_t *first;        /* the same: of words, those of each outcome in order */
    uint32_t *words;
    size_t used, room;
} tn_strip_row;

/* The tiles of a cell that wait for what stands at its right. Their numbers are `factor` times those of the class.
 * class: TN_STRIP_NONE: none fits, whatever stands there. ever: false where it makes no difference what stands there.
 */
typedef struct tn_strip_wait {
    uint32_t class, factor;
    bool ever;
} tn_strip_wait;

/* A cell of which a class is, by its base and what stands at its left, and its factor. */
typedef struct tn_strip_one {
    uint32_t base, left, factor;
} tn_strip_one;

/* What nothing that follows can tell apart (frontier.c). */
typedef struct tn_strip_merged {
    uint32_t *edges;      /* [edges]: the first that meets all neighbours as this one does; NULL: each is by itself */
    size_t *first;        /* [bases + 1]: its part of sides */
    uint32_t *sides;      /* what can stand at the right of a cell of the base */
    tn_numbering pairs;   /* base << 32 | what stands at its left */
    tn_strip_wait *waits; /* [pairs] */
    tn_interner tiles;    /* of classes: {what stands at the right, how many fit} */
    tn_strip_one *one;    /* [classes] */
    size_t wait_room, one_room;
} tn_strip_merged;

/* Words of tiles that wait, for each: the place of the cell, the class. */
enum { WAIT_CELL, WAIT_CLASS, WAIT_WORDS };

/* What a number of arrangements of tiles cost. */
typedef struct tn_strip_sum {
    tn_int128 cost;
    uint64_t times;
} tn_strip_sum;

/* The sums of the tiles of a tray, by cost (costs.c). */
typedef struct tn_strip_sums {
    tn_strip_sum *items, *more; /* scratch */
    size_t count, room, more_room;
    tn_strip_known places; /* {waiting, left fits}: their sums that are kept, once costs are known */
    tn_strip_sum *kept;
    size_t kept_count, kept_room;
    const tn_strip_sum *found; /* those asked for last, until the next are */
    size_t found_count;
} tn_strip_sums;

/* Numbers of costs by what they depend on. */
typedef struct tn_strip_keyed {
    tn_interner keys;
    uint32_t *costs; /* [keys] */
    size_t room;
} tn_strip_keyed;

/* What houses cost, in parts that add up (costs.c). Exact costs are numbered; their steps are known when all are. */
typedef struct tn_strip_prices {
    bool asked, items, across; /* items: these have prices. across: so goes a roof that has one */
    tn_interner numbers;
    mpq_t *exact;
    size_t room;
    tn_int128 *steps;             /* [numbers], or NULL */
    tn_strip_keyed alone, planes; /* by {tray, what is in its inner faces}; by {shapes, what is in it} */
    tn_interner shapes;
    tn_interner lists; /* of tiles that fit in a cell: {cost, how many} by cost */
    tn_key key;
} tn_strip_prices;

/* What each number that is added up is in, once all costs are known: steps so small that all are whole. */
typedef struct tn_strip_units {
    mpq_t cost, measures[TN_ADDED_MAX];
    tn_int128 others[TN_ADDED_MAX], costs[TN_ADDED_MAX]; /* steps of its other numbers' steps, and of the costs' */
} tn_strip_units;

/* What steps add to a compared number: from, to. */
typedef struct tn_strip_range {
    bool any;
    tn_int128 from, to;
} tn_strip_range;

/* What may still be added to each compared number after so many trays: by another tray, by the end of the row, in all.
 */
typedef struct tn_strip_ahead {
    tn_strip_range tray[TN_COMPARED_MAX], end[TN_COMPARED_MAX], all[TN_COMPARED_MAX];
} tn_strip_ahead;

typedef struct tn_strip {
    const tn_house_form *form;
    const tn_house_library_record *library;
    uint32_t shapes[TN_CHOICES_MAX];
    uint32_t trays_least, trays_most;
    tn_watch *watch;
    const tn_house_measures *measures; /* or NULL */
    const tn_house_added *added;       /* these, and what clauses compare */
    const tn_strip_without *without;   /* or NULL; only while the clauses are made */
    const tn_strip_units *units;       /* NULL: not known yet, and nothing is gained */
    tn_strip_prices prices;
    tn_strip_sums sums;
    uint32_t *weighed_rooms[TN_ADDED_MAX]; /* [terms of the number]: of the questions about rooms */
    tn_plan_vm *plan_vm;                   /* what comparisons add up of trays; NULL: none does */
    tn_interner totals;                    /* what compared numbers come to so far: reading.c */
    tn_strip_ahead *ahead;                 /* [trays_most + 1], once it is known or being found */
    bool looking_ahead;                    /* totals are left aside: reading.c */
    tn_strip_questions questions;
    size_t answer_words;
    tn_numbering fails;       /* of rooms, that were met: tn_strip_room_open */
    tn_room_open *open_rooms; /* [fails] */
    size_t open_room;
    bool *tiled, any_tiled; /* [functions] */
    bool *asked_function;   /* [functions]: can something be asked of rooms with this function? */
    bool scouting;          /* tiles are left aside: see frontier.c */
    tn_strip_merged merged;
    tn_strip_clause *clauses;
    uint32_t clause_count;
    tn_strip_list *of_tray;             /* [trays of the schema] */
    tn_strip_furnished_list *furnished; /* the same */
    tn_interner functions;              /* of the cells of a tray */
    tn_strip_orders slice_orders, outcome_orders;
    tn_strip_borders borders;
    uint8_t *ends; /* [states]: may the row end there? see tn_strip_ends */
    size_t end_room;
    tn_strip_ways ways;
    tn_interner edge_keys, slice_keys, outcome_keys, areas, bases, sides, waiting, rooms, walks, states;
    tn_strip_edge *edges;
    size_t edge_room;
    tn_interner parts, combined; /* of planes: what comes of their storeys; these together: plane.c */
    uint32_t *of_combined;       /* [combined]: outcomes */
    size_t combined_room;
    tn_numbering plane_keys;
    tn_strip_list *planes;
    size_t plane_room;
    uint64_t plane_outcomes;  /* of all planes */
    tn_numbering fit_keys[2]; /* {base, left side}, then {that, right side} */
    uint32_t *fits;           /* [fit_keys[1]]: tiles */
    size_t fit_room;
    tn_strip_slice *slices;     /* [slices] */
    tn_strip_outcome *outcomes; /* [outcomes] */
    size_t slice_room, outcome_room;
    tn_interner letters, fit_lists, asked, insides, mets, throughs;
    tn_interner plain_keys;
    uint32_t *plains; /* [plain_keys]: slices */
    size_t plain_room;
    tn_strip_row row;
    tn_strip_stages stages;
    tn_interner readings, between, values;     /* see reading.c */
    tn_strip_known *after_slice, *after_plane; /* [trays_most + 1] */
    tn_strip_known tiles;                      /* {waiting, left fits}: how many, unless they have prices */
    tn_strip_known waits;                      /* {tiles of a slice, right fits}: what waits; how many times that */
    tn_numbering befores;                      /* what is asked of the edge << 32 | rooms or a walk */
    tn_numbering moves;                        /* through << 32 | what is met in the slice */
    tn_strip_known crossed_rooms, crossed_walks[TN_STRIP_MEETINGS_MAX]; /* {before, move} */
    tn_key key, joined;                                                 /* scratch */
    uint32_t *scratch;                                                  /* [2 * clauses] */
} tn_strip;

static inline bool tn_strip_ordered_add(tn_strip_ordered *ordered, uint32_t item)
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
static inline uint32_t tn_strip_waiting_word(const tn_strip *strip)
{
    return STATE_WALKS + strip->questions.walk_count + 1;
}

static inline size_t tn_strip_crossed_words(const tn_strip *strip)
{
    return CROSSED_WALKS + (size_t)strip->questions.walk_count + strip->questions.room_count;
}

/* The answers of an edge's cell. */
static inline const uint64_t *tn_edge_answers(const tn_strip *strip, const tn_strip_edge *edge, uint32_t cell)
{
    return edge->answers + cell * strip->answer_words;
}

static inline bool tn_answers(const uint64_t *answers, size_t decision)
{
    return answers[decision / 64] >> decision % 64 & 1;
}

static inline bool tn_strip_reaches_rooms(const tn_strip_reach *reach)
{
    return reach->open || reach->glazed || reach->marks != 0;
}

/* What a cell of a tray with one function is. */
typedef struct tn_strip_cut {
    bool known;
    uint32_t description;
    uint64_t *answers; /* [answer_words] of the decisions */
} tn_strip_cut;

/* A tray as a house of its own. */
typedef struct tn_inside {
    tn_strip *strip;
    tn_tray tray;
    tn_house house;
    const tn_strip_cut *cells[TN_STRIP_CELLS_MAX];
} tn_inside;

static inline const tn_strip_reach *tn_inside_reach(const tn_inside *inside, tn_strip_role_at role, uint32_t cell)
{
    return &inside->strip->borders.reach[role][inside->cells[cell]->description];
}

static inline bool tn_face_is_inner(const tn_face *face)
{
    return face->relation == TN_FACE_UNDER || face->side == TN_HOUSE_BACK || face->side == TN_HOUSE_FRONT;
}

#endif
