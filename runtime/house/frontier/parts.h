/* What the files of a tn_frontier do for each other. Internal to runtime/house/frontier; data.h says what it is made
 * of.
 */
#ifndef TARTAN_HOUSE_FRONTIER_PARTS_H
#define TARTAN_HOUSE_FRONTIER_PARTS_H

#include "runtime/house/frontier/data.h"

/* ---- frontier.c */

/* The houses of the section, on trays of these, at least and at most so many. measures: NULL, or borrowed, as is
 * `added`; without: NULL, or borrowed until the frontier is made. Free with tn_frontier_free, also after a failure. */
tn_status tn_frontier_new(const tn_house_form *form, const tn_house_library_record *library, const uint32_t *shapes,
                          const tn_frontier_trays *trays, uint32_t trays_least, uint32_t trays_most,
                          const tn_house_measures *measures, const tn_house_added *added,
                          const tn_frontier_without *without, tn_frontier **frontier, tn_error *error);
void tn_frontier_free(tn_frontier *frontier);

/* What of the frontier has the most states, as the name of the clause that is about it; NULL where there is none. */
const char *tn_frontier_dearest(const tn_frontier *frontier);

tn_status tn_frontier_limit(const tn_frontier *frontier, const char *clause, const char *what, tn_error *error);

/* Finds them. TN_LIMIT (E1640) where there are too many, or one that is not known here, with the clause. */
tn_status tn_frontier_ask(tn_frontier *frontier, tn_error *error);

/* ---- edge.c */

/* The edge at the left or the right of the tray. cost: where costs are asked for, the number of the tray's. */
tn_status tn_frontier_find_edge(const tn_inside *inside, tn_frontier_role_at role, uint32_t cost, uint32_t *edge,
                                tn_error *error);

/* ---- edge.c */

/* Finds the classes of cells; before any slice is made. */
tn_status tn_frontier_borders_find(tn_frontier *frontier, const tn_frontier_trays *trays, tn_error *error);
void tn_frontier_borders_clear(tn_frontier_borders *borders);

/* What lines of faces at interfaces say of a cell with its function; UINT32_MAX is never one. */
tn_status tn_frontier_describe(tn_frontier *frontier, const tn_house *house, uint32_t cell, uint32_t *description,
                               tn_error *error);

/* ---- slice.c */

/* Makes the slices of a tray, if they are not made. */
tn_status tn_frontier_slices(tn_frontier *frontier, tn_tray tray, tn_error *error);

/* The slices of a tray whose cells have the functions of these [cells], one for each choice of what is in its inner
 * faces, in the order of houses: the last face changes first. */
tn_status tn_frontier_order_slices(tn_frontier *frontier, tn_tray tray, const tn_cell *like,
                                   tn_frontier_ordered *slices, tn_error *error);

/* ---- interface.c */

/* The outcomes between two edges; TN_FRONTIER_NONE: the outside. */
tn_status tn_frontier_interface(tn_frontier *frontier, uint32_t left, uint32_t right,
                                const tn_frontier_list **interface, tn_error *error);

/* The outcomes between two edges, whose cells, the left ones first, have the functions of these, one for each choice of
 * what is in the interface, in the order of houses. */
tn_status tn_frontier_order_outcomes(tn_frontier *frontier, uint32_t left, uint32_t right, const tn_cell *like,
                                     tn_frontier_ordered *outcomes, tn_error *error);
uint64_t tn_frontier_marks(const tn_frontier *frontier, uint32_t kind); /* the bit of a kind that rooms ask for */

uint32_t tn_frontier_number_area(tn_frontier *frontier, tn_int128 area); /* UINT32_MAX: out of memory */

/* May one step through this face on walk w? */
bool tn_frontier_steps(const tn_frontier *frontier, const tn_house *house, const tn_face *face, uint32_t walk);
bool tn_frontier_meets(const tn_frontier *frontier, const tn_house *house, const tn_face *face, uint32_t meeting);
bool tn_frontier_joins(const tn_house *house, const tn_face *face);

/* ---- slice.c */

/* Both, without finding again what has been asked for. cells: of the tray. Sequences are borrowed until the next trim,
 * which drops them where they take much. */
tn_status tn_frontier_slices_ordered(tn_frontier *frontier, tn_tray tray, const tn_cell *like, size_t cells,
                                     tn_frontier_sequence *slices, tn_error *error);
tn_status tn_frontier_outcomes_ordered(tn_frontier *frontier, uint32_t left, uint32_t right, const tn_cell *like,
                                       tn_frontier_sequence *outcomes, tn_error *error);
void tn_frontier_orders_trim(tn_frontier *frontier);
void tn_frontier_orders_clear(tn_frontier_orders *orders);

/* ---- costs.c */

/* What of a cell's own walls matters to its tiles, and what of a side. 0: nothing does. */
tn_status tn_frontier_fit_base(tn_frontier *frontier, const tn_house *house, uint32_t cell, uint32_t *base,
                               tn_error *error);
tn_status tn_frontier_fit_side(tn_frontier *frontier, const tn_house *house, uint32_t cell, tn_house_side side,
                               int64_t x, const tn_posts *posts, uint32_t *fit, tn_error *error);

/* How many tiles fit; where they have prices, the number of the list of what they cost, which is 0 where none fits. */
tn_status tn_frontier_fit(tn_frontier *frontier, uint32_t base, uint32_t left, uint32_t right, uint32_t *tiles,
                          tn_error *error);

/* ---- frontier.c */

void tn_frontier_forget_states(tn_frontier *frontier); /* they are numbered anew */

/* Ends scouting: all interfaces of the library's houses are made. States are numbered anew. */
tn_status tn_frontier_merge(tn_frontier *frontier, tn_error *error);
void tn_frontier_merged_clear(tn_frontier_merged *merged);

/* A cell's tiles, by what stands at its left. */
tn_status tn_frontier_pending_class(tn_frontier *frontier, uint32_t base, uint32_t left,
                                    tn_frontier_cell_class *class_of, tn_error *error);

/* ---- rooms.c, walks.c: the inside of a tray */

/* Appends CELL_WORDS for each cell, then the roles, then the steps. */
tn_status tn_frontier_push_inside(const tn_inside *inside, tn_key *key, tn_error *error);

/* Appends a word for each cell, for each walk; then the number of steps and STEP_WORDS for each. */
bool tn_frontier_push_walks(const tn_inside *inside, tn_key *key);

/* ---- rooms.c, walks.c: what is known before and after an interface */

/* What of `all` a cell is not, by its answers; what a cell of an edge is not, of a void the cell below it. */
uint64_t tn_frontier_answers_fail(const tn_frontier *frontier, const uint64_t *answers);
uint64_t tn_frontier_fails(const tn_frontier *frontier, const tn_frontier_edge *edge, uint32_t cell);

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
 * they go on alike with what is equal here. Where nothing asks where they are in the row. */
tn_status tn_frontier_rooms_view(const tn_frontier *frontier, uint32_t before, const tn_frontier_edge *left,
                                 const uint32_t *outcome, tn_key *key, tn_error *error);
tn_status tn_frontier_walk_view(const tn_frontier *frontier, uint32_t walk, uint32_t before,
                                const tn_frontier_edge *left, const uint32_t *outcome, tn_key *key, tn_error *error);

/* ---- clause.c */

tn_status tn_frontier_clauses_new(tn_frontier *frontier, tn_error *error);
void tn_frontier_clauses_free(tn_frontier *frontier);

/* What the house of one tray is to a clause. */
tn_status tn_frontier_base(tn_frontier *frontier, tn_frontier_clause *clause, const tn_house *house, uint32_t *base,
                           tn_error *error);

/* When all slices are made: their automata. */
tn_status tn_frontier_lower(tn_frontier *frontier, tn_error *error);

/* ---- reading.c */

#define TN_FRONTIER_NO_PAIR UINT64_MAX

/* When all automata are made. */
tn_status tn_frontier_find_completions(tn_frontier *frontier, tn_error *error);
void tn_frontier_completions_free(const tn_frontier *frontier, tn_frontier_clause *clause);

/* The first state and base, state << 32 | base, that cannot be told from these after so many trays. */
tn_status tn_frontier_pair(tn_frontier *frontier, tn_frontier_clause *clause, uint32_t trays, uint32_t state,
                           uint32_t base, uint64_t *pair, tn_error *error);

/* ---- reading.c */

/* What is known of two numbers, `words` long; not *met: it is for the caller to fill in. */
tn_status tn_frontier_known_at(tn_frontier_known *known, uint32_t first, uint32_t second, size_t words,
                               uint32_t **result, bool *met, tn_error *error);
void tn_frontier_known_clear(tn_frontier_known *known);

/* What the clauses have read after a slice (TN_FRONTIER_NONE: the end), by what they had read before (TN_FRONTIER_NONE:
 * the beginning); then after the interface before the slice, by what that is to them. trays: before the slice.
 * TN_FRONTIER_NONE: a clause keeps nothing of that. */
tn_status tn_frontier_read_slice(tn_frontier *frontier, uint32_t trays, uint32_t read, uint32_t slice,
                                 uint32_t *between, tn_error *error);
tn_status tn_frontier_read_interface(tn_frontier *frontier, uint32_t trays, uint32_t between, uint32_t values,
                                     uint32_t *read, tn_error *error);

/* ---- step.c */

/* What comes of the outcomes of the interface between a state (its words; NULL: the row begins) and a slice
 * (TN_FRONTIER_NONE: the end): so many words each. Both are good until the next call. */
tn_status tn_frontier_cross(tn_frontier *frontier, const uint32_t *state, uint32_t slice, tn_frontier_list *interface,
                            const uint32_t **crossed, tn_error *error);
void tn_frontier_row_clear(tn_frontier_row *row);

/* What comes of one outcome alone, before a slice: so many words, to be filled in. near_side: its words. */
tn_status tn_frontier_cross_outcome(tn_frontier *frontier, const uint32_t *state, uint32_t slice, uint32_t outcome,
                                    const uint32_t *near_side, uint32_t *crossed, tn_error *error);

/* ---- reading.c: what clauses compare with 0, which is known at the end of the row */

/* Does a clause compare anything? Before the units are known it cannot be said of what. */
static inline bool tn_frontier_compares(const tn_frontier *frontier)
{
    return frontier->added->count > frontier->added->measures;
}

/* The place of a HOUSE_SUM among what is added up. */
uint32_t tn_frontier_compared(const tn_frontier *frontier, uint32_t sum);

/* steps := what the tray of a house of one tray adds to a compared number by itself. */
tn_status tn_frontier_tray_adds(tn_frontier *frontier, uint32_t number, tn_tray tray, int64_t *steps, tn_error *error);

/* The totals before the first tray; after a step that adds so much to each compared number ([compared], in order), with
 * so many trays. Totals whose sign nothing that is ahead can change are one. */
tn_status tn_frontier_first_total(tn_frontier *frontier, uint32_t *total, tn_error *error);
tn_status tn_frontier_next_total(tn_frontier *frontier, uint32_t trays, uint32_t total, const tn_int128 *gains,
                                 uint32_t *next, tn_error *error);

/* Begins to find what is ahead: then all states are gone through, each step is noted, and it ends. */
tn_status tn_frontier_ahead_begin(tn_frontier *frontier, tn_error *error);
void tn_frontier_ahead_note(tn_frontier *frontier, uint32_t trays, bool end, uint32_t compared, tn_int128 from,
                            tn_int128 to);
void tn_frontier_ahead_end(tn_frontier *frontier);

/* The values of the last interface with what the totals say of each comparison; as long as the units are not known,
 * with what `guess` says: below tn_frontier_guesses. */
tn_status tn_frontier_end_values(tn_frontier *frontier, uint32_t values, uint32_t total, uint32_t guess, uint32_t *ends,
                                 tn_error *error);
uint32_t tn_frontier_guesses(const tn_frontier *frontier);

/* Does a house without trays meet the comparison? */
tn_status tn_frontier_empty_meets(tn_frontier *frontier, const tn_instruction *op, bool *meets, tn_error *error);

/* ---- step.c */

/* Calls `seen` for each state after another slice (TN_FRONTIER_NONE: the end, and the state 0), with the number of
 * choices that lead there, that of those that differ in more than tiles, and what the step adds to the measures. Where
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

/* ---- step.c */

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

/* ---- stage.c: a step in four stages; nothing is added up, and tiles have no prices */

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

/* May the row end in the state, after so many trays? */
tn_status tn_frontier_ends(tn_frontier *frontier, uint32_t trays, uint32_t state, bool *ends, tn_error *error);

/* ---- costs.c */

tn_status tn_frontier_prices_begin(tn_frontier *frontier, tn_error *error);

/* trays: of the library. E1685 (TN_LIMIT) where costs that are asked for do not add up in this section. */
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

/* ---- costs.c */

/* frontier->sums.found := what the pending tiles cost once the outcome of the interface at their right is known, and
 * how many arrangements cost that; no sum if a cell has no tile. Without prices it is one sum of nothing. */
tn_status tn_frontier_sum_tiles(tn_frontier *frontier, uint32_t pending, uint32_t left_fits, tn_error *error);
tn_status tn_frontier_sum_one(tn_frontier *frontier, uint64_t times,
                              tn_error *error); /* so many arrangements, of nothing */
void tn_frontier_sums_clear(tn_frontier_sums *sums);

/* The area that has this number, in square nanometres. */
tn_int128 tn_frontier_area(const tn_frontier *frontier, uint32_t number);

#endif
