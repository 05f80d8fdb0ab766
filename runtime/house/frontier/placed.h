/* What clauses ask of where in the row rooms and walks are ("placed" questions). Internal to runtime/house/frontier.
 *
 * What a room is, and whether a source is apart, is known trays later. Until then a slot stands for it: rooms.c and
 * walks.c say at each interface what becomes of the slots, and clause.c makes letters and relations of that. */
#ifndef TARTAN_HOUSE_FRONTIER_PLACED_H
#define TARTAN_HOUSE_FRONTIER_PLACED_H

#include "runtime/house/frontier/parts.h"

/* ---- what is seen of rooms and walks in the row: rooms.c, walks.c; read in clause.c */

/* Words of what is seen of a placed question at the right side of a tray. Rooms: how many lie in the tray alone; then
 * what each slot says. Walks: where the tray's own sources go, and what each slot says of those of trays before it. */
enum { SEEN_FIRST, SEEN_SLOTS, SEEN_WORDS = SEEN_SLOTS + TN_FRONTIER_SLOTS_MAX };

/* The first word where more is to be told apart than there are slots: nothing follows from such a tray. */
#define SEEN_TOO_MANY UINT32_MAX

/* Of a slot of rooms, which have one beginning. ENDS: one of them that is so ends here; then two, and so on. */
enum { SLOT_OFF, SLOT_ON, SLOT_BEGINS, SLOT_ENDS };

/* Of the sources of a tray, and of a slot of sources: none is apart; one is; or, for a slot, it goes on, or it becomes
 * one with the slot TO. The sources of a tray, if it is not known of them yet, go TO a slot. */
enum { WALK_NONE, WALK_APART, WALK_ON, WALK_TO };

/* Is it asked where in the row the walk's sources are? */
static inline bool tn_frontier_walk_placed(const tn_frontier *frontier, uint32_t walk)
{
    return frontier->questions.placed_walks >> walk & 1;
}

/* How many rooms of a tray, at most, can turn out to be what each placed question asks for. */
void tn_frontier_rooms_at_once(tn_frontier *frontier, uint32_t most[TN_FRONTIER_PLACED_MAX]);

/* ---- rooms.c: where in the row rooms began */

/* age: 0 for the first of the rooms of one function to begin, then those that began with the next tray. slots: of each
 * placed question, 1 and the slot; 0: none. */
typedef struct tn_frontier_place {
    uint32_t age, slots[TN_FRONTIER_PLACED_MAX];
} tn_frontier_place;

/* A room that goes on across the interface. open: a bit for each question that is not known to be false. */
typedef struct tn_frontier_going {
    tn_frontier_place *place;
    uint32_t function;
    uint64_t open;
} tn_frontier_going;

static inline size_t tn_frontier_place_words(const tn_frontier *frontier)
{
    return frontier->questions.placed_count > 0 ? 1 + (size_t)frontier->questions.placed_count : 0;
}

/* What is known of a room before the interface, from its words; of one that begins after it. */
void tn_frontier_place_load(const tn_frontier *frontier, const uint32_t *words, tn_frontier_place *place);
void tn_frontier_place_new(const tn_frontier *frontier, tn_frontier_place *place);

/* Two rooms are one: where the first of them began. */
void tn_frontier_place_join(const tn_frontier *frontier, tn_frontier_place *to, const tn_frontier_place *from);

/* A room ends at the interface. truth: a bit for each question. seen: [placed] SEEN_WORDS. */
void tn_frontier_place_end(const tn_frontier *frontier, const tn_frontier_place *place, uint64_t truth, uint32_t *seen);

/* Those that go on, after all that end. held: [placed] a bit for each slot that a room before the interface had. */
void tn_frontier_places_go_on(const tn_frontier *frontier, const tn_frontier_going *rooms, uint32_t count,
                              const uint32_t *held, uint32_t *seen);

/* ---- clause.c: what is seen of rooms and walks in the row, as letters and relations */

/* Finds the slots and the radix of each placed atom of a clause, so that there are not too many letters. at_once: of
 * each placed question about rooms. */
void tn_frontier_fit_slots(const tn_frontier *frontier, tn_frontier_clause *clause,
                           const uint32_t at_once[TN_FRONTIER_PLACED_MAX]);

/* One slot less. False: the clause can't do with fewer. */
bool tn_frontier_fewer_slots(tn_frontier_clause *clause);

/* What is seen, as a value of the atom below its radix; UINT32_MAX: it takes more slots than the atom has. */
uint32_t tn_frontier_span_value(const tn_frontier_atom *atom, const uint32_t *seen);

/* values: [letters but the marker] of the atom. */
tn_status tn_frontier_relate_spans(const tn_frontier *frontier, const tn_frontier_atom *atom, const tn_marked *marked,
                                   const uint32_t *values, tn_dfa **out, tn_error *error);

#endif
