/* Slices, their edges, and the interfaces between them; how rooms and walks cross these. Internal to
 * runtime/house/frontier. */
#ifndef TARTAN_HOUSE_FRONTIER_SLICES_H
#define TARTAN_HOUSE_FRONTIER_SLICES_H

#include "runtime/house/frontier/questions.h"

#define TN_FRONTIER_FUNCTIONS_MAX 1000000u /* ways to give a tray's cells their functions */
#define TN_FRONTIER_SLICES_MAX 200000u     /* choices of trays that are told apart */
#define TN_FRONTIER_CHOICES_MAX 4000000u   /* of a tray's functions and faces, or of an interface's */

/* ---- what a cell is to rooms and to walks */

/* What a cell is to a walk; as a word: bits in this order. ends: no step leads on to the right. */
typedef struct tn_frontier_role {
    bool through, goal, source, ends;
} tn_frontier_role;
enum { ROLE_THROUGH = 1, ROLE_GOAL = 2, ROLE_SOURCE = 4, ROLE_ENDS = 8, ROLES_APART = 16 };

/* What can still be asked of a room, some cells of which are not these. */
tn_status tn_frontier_room_open(tn_frontier *frontier, uint64_t fails, tn_room_open *open, tn_error *error);

/* A room that lies in one tray, and that nothing more is seen of. */
typedef struct tn_whole_room {
    uint64_t fails, kinds;
    tn_int128 area, glass;
    uint32_t cells;
} tn_whole_room;

/* Which questions it answers: a bit each. */
uint32_t tn_frontier_room_truth(const tn_frontier *frontier, const tn_whole_room *room);

/* What a cell is to a walk, by its answers. A source is no goal; a void is nothing. */
tn_frontier_role tn_frontier_role_of(const tn_frontier *frontier, uint32_t walk, const uint64_t *answers, bool open);

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

/* ---- edges: edge.c */

/* Where an edge is met: from its left, at the slice's entry, or from its right. */
typedef enum tn_frontier_role_at { TN_FRONTIER_ENTRY, TN_FRONTIER_EXIT, TN_FRONTIER_ROLES } tn_frontier_role_at;

/* What can be in a cell's faces at an interface: kinds that rooms ask for, that walks step through (a bit each), that
 * meetings ask for; nothing at all, so that rooms go on; glass to the outside. */
typedef struct tn_frontier_reach {
    uint64_t marks, meetings;
    uint32_t walks;
    bool open, glazed;
    bool ways; /* nothing at all, whatever is beyond: people come and go there, if the form asks for ways */
} tn_frontier_reach;

/* What lines of faces can tell of cells at interfaces: edge.c. */
typedef struct tn_frontier_borders {
    tn_interner descriptions;
    uint32_t *classes[TN_FRONTIER_ROLES];        /* [descriptions] */
    tn_frontier_reach *reach[TN_FRONTIER_ROLES]; /* the same */
    uint64_t *matter[TN_FRONTIER_ROLES];         /* [descriptions][answer_words]: decisions that can matter there */
} tn_frontier_borders;

static inline bool tn_frontier_reaches_rooms(const tn_frontier_reach *reach)
{
    return reach->open || reach->glazed || reach->marks != 0;
}

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
    uint32_t asked;    /* which cells are open, the answers, and if rooms are placed, which cells have one function,
                          by number: all that rooms and walks know of the edge */
    uint32_t *inner;
    size_t inner_count;
    uint32_t shape; /* if costs are asked for: what its interfaces' costs depend on */
    uint32_t cost;  /* the same: of the house of one tray */
} tn_frontier_edge;

typedef struct tn_frontier_edges {
    tn_interner keys;
    tn_frontier_edge *items; /* [keys] */
    size_t room;
    tn_interner asked; /* what is asked of the cells of edges */
    tn_frontier_borders borders;
} tn_frontier_edges;

/* The edge at the left or the right of the tray. cost: if costs are asked for, the number of the tray's. */
tn_status tn_frontier_find_edge(const tn_inside *inside, tn_frontier_role_at role, uint32_t cost, uint32_t *edge,
                                tn_error *error);

/* Finds the classes of cells; before any slice is made. */
tn_status tn_frontier_borders_find(tn_frontier *frontier, const tn_frontier_trays *trays, tn_error *error);
void tn_frontier_edges_clear(tn_frontier_edges *edges);

/* What lines of faces at interfaces say of a cell with its function; UINT32_MAX is never one. */
tn_status tn_frontier_describe(tn_frontier *frontier, const tn_house *house, uint32_t cell, uint32_t *description,
                               tn_error *error);

static inline bool tn_face_is_inner(const tn_face *face)
{
    return face->relation == TN_FACE_UNDER || face->side == TN_HOUSE_BACK || face->side == TN_HOUSE_FRONT;
}

/* ---- slices: slice.c */

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

void tn_frontier_lists_free(tn_frontier_list *lists, size_t count);

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
 * it; then, if costs are asked for, the number of the tray's. */
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

/* What parts of a slice are, by number: equal parts are one. Lists of fits have a word for each cell: 0, or 1 and what
 * matters to its tiles. */
typedef struct tn_frontier_slice {
    uint32_t entry, exit;        /* edges: at its left, at its right */
    uint32_t bases;              /* of all clauses: of `bases` */
    uint32_t tiles;              /* what of its own walls matters to each cell's tiles: of `lists` of tiles */
    uint32_t inside;             /* its edge, and what rooms and walks meet in it: of `insides` */
    uint32_t met;                /* the same, but of its edge only what is asked: of `mets` */
    uint32_t plain;              /* the first slice that can differ from it only in tiles and what is added up */
    uint32_t group;              /* its entry, what is met in it, its bases: of `groups` */
    uint32_t cost;               /* if costs are asked for: the number of the tray's */
    int64_t gains[TN_ADDED_MAX]; /* what its cells, and its tray, add to each number that is added up */
} tn_frontier_slice;

static inline bool tn_frontier_ordered_add(tn_frontier_ordered *ordered, uint32_t item)
{
    if (!tn_array_reserve(&ordered->items, &ordered->room, ordered->count, 1, sizeof *ordered->items))
        return false;
    ordered->items[ordered->count++] = item;
    return true;
}

/* Slices of a tray or outcomes of an interface, one for each choice, in the order of the choices. Kinds are what is in
 * it, ascending, each once; items are places in these. */
typedef struct tn_frontier_sequence {
    uint32_t *kinds, *items;
    size_t kind_count, count;
} tn_frontier_sequence;

/* Sequences by {tray, functions of its cells}, or {left edge, right edge, functions of both}. */
typedef struct tn_frontier_orders {
    tn_interner keys;
    tn_frontier_sequence *of; /* [keys]; without kinds: not known */
    size_t room, items;       /* items: of all */
} tn_frontier_orders;

typedef struct tn_frontier_slices_made {
    tn_interner keys;
    tn_frontier_slice *items; /* [keys] */
    size_t room;
    tn_frontier_list *of_tray;             /* [trays of the schema] */
    tn_frontier_furnished_list *furnished; /* the same */
    tn_interner functions;                 /* of the cells of a tray */
    tn_frontier_orders orders;
    tn_interner bases, insides, mets, areas;
    tn_interner plain_keys;
    uint32_t *plains; /* [plain_keys]: slices */
    size_t plain_room;
} tn_frontier_slices_made;

/* trays: of the schema. */
void tn_frontier_slices_clear(tn_frontier_slices_made *slices, size_t trays);

/* Makes the slices of a tray, if they are not made. */
tn_status tn_frontier_slices(tn_frontier *frontier, tn_tray tray, tn_error *error);

/* The slices of a tray whose cells have the functions of these [cells], one for each choice of what is in its inner
 * faces, in the order of houses: the last face changes first. */
tn_status tn_frontier_order_slices(tn_frontier *frontier, tn_tray tray, const tn_cell *like,
                                   tn_frontier_ordered *slices, tn_error *error);

/* Appends CELL_WORDS for each cell, then the roles, then the steps. */
tn_status tn_frontier_push_inside(const tn_inside *inside, tn_key *key, tn_error *error);

/* Appends a word for each cell, for each walk; then the number of steps and STEP_WORDS for each. */
bool tn_frontier_push_walks(const tn_inside *inside, tn_key *key);

/* ---- interfaces: interface.c */

/* Words of an outcome's key: the meetings across the interface (two words), the number of steps and STEP_WORDS for
 * each, then SIDE_WORDS for each cell of the left and of the right edge, then the number of cells of the left one;
 * then, if costs are asked for, the number of the interface's. FIT: 0 for a cell without tiles, or 1 and what of the
 * side matters to them. */
enum { SIDE_MARKS, SIDE_MARKS_HIGH, SIDE_FIT, SIDE_GLASS, SIDE_WORDS };

/* What parts of an outcome are, by number. */
typedef struct tn_frontier_outcome {
    uint32_t left_fits, right_fits; /* of `lists` of tiles */
    uint32_t through;               /* what rooms and walks meet at the interface: of `throughs` */
    uint32_t left, right, plain;    /* of `lefts` and `rights` of the stages; plain: as if nothing mattered to tiles */
    uint32_t cost;                  /* if costs are asked for: the number of the interface's */
} tn_frontier_outcome;

typedef struct tn_frontier_interfaces_made {
    tn_numbering keys;       /* left edge << 32 | right edge */
    tn_frontier_list *items; /* [keys] */
    size_t room;
    uint64_t outcomes;           /* of all */
    tn_interner parts, combined; /* what comes of their storeys; these together */
    uint32_t *of_combined;       /* [combined]: outcomes */
    size_t combined_room;
} tn_frontier_interfaces_made;

typedef struct tn_frontier_outcomes_made {
    tn_interner keys;
    tn_frontier_outcome *items; /* [keys] */
    size_t room;
    tn_interner throughs;
    tn_frontier_orders orders;
} tn_frontier_outcomes_made;

void tn_frontier_interfaces_clear(tn_frontier_interfaces_made *interfaces);
void tn_frontier_outcomes_clear(tn_frontier_outcomes_made *outcomes);

/* The outcomes between two edges; TN_FRONTIER_NONE: the outside. */
tn_status tn_frontier_interface(tn_frontier *frontier, uint32_t left, uint32_t right,
                                const tn_frontier_list **interface, tn_error *error);

/* The outcomes between two edges, whose cells, the left ones first, have the functions of these, one for each choice of
 * what is in the interface, in the order of houses. */
tn_status tn_frontier_order_outcomes(tn_frontier *frontier, uint32_t left, uint32_t right, const tn_cell *like,
                                     tn_frontier_ordered *outcomes, tn_error *error);
uint64_t tn_frontier_marks(const tn_frontier *frontier, uint32_t kind); /* the bit of a kind that rooms ask for */

uint32_t tn_frontier_number_area(tn_frontier *frontier, tn_int128 area); /* UINT32_MAX: out of memory */

/* The area that has this number, in square nanometres. */
tn_int128 tn_frontier_area(const tn_frontier *frontier, uint32_t number);

/* May one step through this face on walk w? */
bool tn_frontier_steps(const tn_frontier *frontier, const tn_house *house, const tn_face *face, uint32_t walk);
bool tn_frontier_meets(const tn_frontier *frontier, const tn_house *house, const tn_face *face, uint32_t meeting);
bool tn_frontier_joins(const tn_house *house, const tn_face *face);

/* ---- slices and outcomes in the order of houses: slice.c */

/* Both, without finding again what has been asked for. cells: of the tray. Sequences are borrowed until the next trim,
 * which drops them if they take much. */
tn_status tn_frontier_slices_ordered(tn_frontier *frontier, tn_tray tray, const tn_cell *like, size_t cells,
                                     tn_frontier_sequence *slices, tn_error *error);
tn_status tn_frontier_outcomes_ordered(tn_frontier *frontier, uint32_t left, uint32_t right, const tn_cell *like,
                                       tn_frontier_sequence *outcomes, tn_error *error);
void tn_frontier_orders_trim(tn_frontier *frontier);
void tn_frontier_orders_clear(tn_frontier_orders *orders);

/* ---- rooms and walks across an interface: rooms.c, walks.c */

/* What of `all` a cell is not, by its answers; what a cell of an edge is not, of a void the cell below it. */
uint64_t tn_frontier_answers_fail(const tn_frontier *frontier, const uint64_t *answers);
uint64_t tn_frontier_fails(const tn_frontier *frontier, const tn_frontier_edge *edge, uint32_t cell);

typedef struct tn_frontier_crossing {
    const tn_frontier_edge *left, *right; /* NULL: the outside */
    const uint32_t *slice;                /* of the right one, its key */
    const uint32_t *outcome;
} tn_frontier_crossing;

/* closed: [questions about rooms] how many rooms end at the interface and are so; then SEEN_WORDS for each that is
 * placed.
 */
tn_status tn_frontier_rooms_cross(tn_frontier *frontier, uint32_t before, const tn_frontier_crossing *crossing,
                                  uint32_t *after, uint32_t *closed, tn_error *error);

/* apart: does a source turn out to be apart from all goals? seen: SEEN_WORDS of a walk that is placed. */
tn_status tn_frontier_walk_cross(tn_frontier *frontier, uint32_t walk, uint32_t before,
                                 const tn_frontier_crossing *crossing, uint32_t *after, bool *apart, uint32_t *seen,
                                 tn_error *error);

/* Appends what an outcome (its words) leaves of the rooms, or of a walk, that were before it: before whatever slice
 * they go on alike with what is equal here. Only if nothing asks where they are in the row. */
tn_status tn_frontier_rooms_view(const tn_frontier *frontier, uint32_t before, const tn_frontier_edge *left,
                                 const uint32_t *outcome, tn_key *key, tn_error *error);
tn_status tn_frontier_walk_view(const tn_frontier *frontier, uint32_t walk, uint32_t before,
                                const tn_frontier_edge *left, const uint32_t *outcome, tn_key *key, tn_error *error);

#endif
