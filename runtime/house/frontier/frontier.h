/* Counts houses by a frontier method (transfer matrices): all houses of one section on all plans of a library, without
 * going through them one by one.
 *
 * A house stands on a row of trays, which is read from left to right. A slice is a tray with what is chosen inside it:
 * the functions of its cells, and what is in its inner faces (back, front, between storeys). Slices that nothing can
 * tell apart are one, with a number of choices. A slice shows an edge to its left, its entry, and one to its right, its
 * exit: its cells, as far as they can make a difference there, and where walls across end. An interface is all that can
 * stand between two edges; each of its outcomes has a number of choices. At both ends of the row there is an interface
 * to the outside.
 *
 * The frontier is the cut after the slice that was read last. A state is what the rest of the row can depend on there:
 * the exit of that slice; what is pending, because only the next interface decides it (how many tiles fit, what letter
 * the clauses read); the rooms and walks that cross the frontier; what each clause has read. A completion is what can
 * follow a state up to the end of the row. States with the same completions could be one, and as many of them as is
 * cheap to find are merged. A step goes from a state across an interface through a slice to the next state; its numbers
 * of choices are the entries of a transfer matrix. Houses are counted by taking steps from all states at once, or from
 * the end backwards, where each state has the number of its completions. Edges, slices, outcomes and states are
 * numbered by what they are (tn_interner), so that equal things are one. Before that, a first pass without tiles
 * (scouting) finds the interfaces that there are.
 *
 * ==== an example, counted by hand
 *
 * Each tray is one cell, a living room (L) or a store (S); what stands between two cells is a door or a wall; and from
 * every store one must be able to walk to a living room through doors:
 *
 *     schema row { bay role length = 3m  zone house = room(4m) }
 *     form two of row {
 *       storey floor 3m  wall 300mm  partition 100mm  deck 300mm  roof 200mm
 *       function living at cell(house)
 *       function store at cell(house)
 *       opening door wide 1m high 2m passage
 *       face cell(any) beside cell(any) = door | wall
 *     }
 *     rule cut-off = apart(cell(store), from cell(living), through cell(any), by door)
 *     library rows using row { trays 1..3 }
 *     library houses from rows in two { prune cut-off }
 *
 * There are two slices, L and S, of one choice each, and their edges are L and S. Between two edges an interface has
 * two outcomes of one choice each, a door and a wall; to the outside it has one. A state is an exit edge with what the
 * walk knows of its cell: a living room has been reached (g, for goal), or a store is pending (p). A wall after a
 * pending store is the end of it: no completion is kept, and the state is dropped. So the steps are
 *
 *     from       through a door    by a wall
 *     L g        L g, S g          L g, S p
 *     S g        L g, S g          L g, S p
 *     S p        L g, S p          none
 *
 * and the numbers of rows that lead to each state
 *
 *     trays      L g                   S g         S p             houses: rows that may end, those without p
 *     1          1                     0           1               1
 *     2          2 + 0 + 1 = 3         1 + 0 = 1   1 + 0 + 1 = 2   3 + 1 = 4
 *     3          6 + 2 + 2 = 10        3 + 1 = 4   3 + 1 + 2 = 6   10 + 4 = 14
 *
 * as `tartan count` says. Three states are enough for rows of any length, of which there are 4^n / 2.
 *
 * A step in four stages merges more (stage.c). By a wall L g and S g leave the same to the right side: nothing that it
 * can tell apart. So they lead to one exit state, which then goes on to the slices once.
 *
 * ==== files
 *
 * frontier.c makes the engine of a section ready and merges what no completion can tell apart; slice.c, edge.c and
 * interface.c make what a row consists of; rooms.c and walks.c follow what crosses interfaces; clause.c makes automata
 * of clauses, which reading.c reads; costs.c counts tiles and costs; step.c and stage.c go from state to state. The
 * headers are of what is asked (questions.h), of what a row consists of (slices.h), and of states and the whole engine
 * (states.h); each builds on the one before, and this one stands above all of them. runtime/house/count goes through
 * the states of all plans, runtime/house/rank through those of one house.
 */
#ifndef TARTAN_HOUSE_FRONTIER_FRONTIER_H
#define TARTAN_HOUSE_FRONTIER_FRONTIER_H

#include "runtime/house/house_names.h"
#include "runtime/house/measure/measure.h"

typedef struct tn_frontier tn_frontier;

/* A library of which a part is left out, for coverage. What the instructions at these code offsets make is empty in the
 * library's clauses from `first` on (counted within it; borrowed). differs: these keep the houses of which the clause
 * says otherwise then. */
typedef struct tn_frontier_without {
    const uint32_t *offsets;
    size_t count;
    uint32_t first;
    bool differs;
} tn_frontier_without;

/* The trays that plans of the library have. */
typedef struct tn_frontier_trays {
    bool *stand;       /* [trays of the schema] */
    uint64_t *follows; /* [trays][words]: a bit for each tray that can follow; NULL: each may follow each */
    size_t words;
} tn_frontier_trays;

/* The houses of the section, on trays of these, at least and at most so many. measures: NULL, or borrowed, as is
 * `added`; without: NULL, or borrowed until the frontier is made. Free with tn_frontier_free, also after a failure. */
tn_status tn_frontier_new(const tn_house_form *form, const tn_house_library_record *library, const uint32_t *shapes,
                          const tn_frontier_trays *trays, uint32_t trays_least, uint32_t trays_most,
                          const tn_house_measures *measures, const tn_house_added *added,
                          const tn_frontier_without *without, tn_frontier **frontier, tn_error *error);
void tn_frontier_free(tn_frontier *frontier);

/* What of the frontier has the most states, as the name of the clause that is about it; NULL if there is none. */
const char *tn_frontier_largest(const tn_frontier *frontier);

tn_status tn_frontier_limit(const tn_frontier *frontier, const char *clause, const char *what, tn_error *error);

/* Forgets all states: they are numbered anew. */
void tn_frontier_forget_states(tn_frontier *frontier);

/* Ends scouting: all interfaces of the library's houses are made. States are numbered anew. */
tn_status tn_frontier_merge(tn_frontier *frontier, tn_error *error);

#endif
