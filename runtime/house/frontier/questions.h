/* What houses are asked: decisions on cells, rooms, meetings and walks; the clauses that ask, as automata; and how far
 * these have read. Internal to runtime/house/frontier. */
#ifndef TARTAN_HOUSE_FRONTIER_QUESTIONS_H
#define TARTAN_HOUSE_FRONTIER_QUESTIONS_H

#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"
#include "runtime/base/int128.h"
#include "runtime/house/house.h"
#include "runtime/house/measure/measure.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/uses.h"

typedef struct tn_plan_vm tn_plan_vm;                   /* runtime/plan/match/vm.h */
typedef struct tn_frontier tn_frontier;                 /* states.h */
typedef struct tn_frontier_without tn_frontier_without; /* frontier.h, as is the next */
typedef struct tn_frontier_trays tn_frontier_trays;

#define TN_FRONTIER_NONE UINT32_MAX /* no edge, no slice: the row begins or ends */

#define TN_FRONTIER_CELLS_MAX 60u     /* of a tray: sets of cells are words */
#define TN_FRONTIER_MEETINGS_MAX 30u  /* that clauses walk by */
#define TN_FRONTIER_QUESTIONS_MAX 32u /* about rooms */
#define TN_FRONTIER_KINDS_MAX 64u     /* that these ask for */
#define TN_FRONTIER_RATIOS_MAX 4u     /* of glass to floor, that these ask for */
#define TN_FRONTIER_PLACED_MAX 8u     /* questions about rooms that ask where in the row these are */
#define TN_FRONTIER_SLOTS_MAX 4u /* beginnings of rooms, or sources of a walk, that are told apart at an interface */
#define TN_FRONTIER_LETTERS_MAX 65536u /* of a clause */

/* ---- words and pairs */

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

/* What came of pairs of numbers. */
typedef struct tn_frontier_known {
    tn_numbering pairs; /* first << 32 | second */
    uint32_t *results;  /* [pairs][words] */
    size_t room;
} tn_frontier_known;

/* What is known of two numbers, `words` long; not *met: it is for the caller to fill in. */
tn_status tn_frontier_known_at(tn_frontier_known *known, uint32_t first, uint32_t second, size_t words,
                               uint32_t **result, bool *met, tn_error *error);
void tn_frontier_known_clear(tn_frontier_known *known);

/* ---- questions: frontier.c */

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

/* any: it may be what a question asks for, for which its faces of these kinds, its area and its glass can matter. */
typedef struct tn_room_open {
    bool any, area, glass;
    uint64_t kinds;
} tn_room_open;

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
    size_t answer_words;      /* a bit for each decision */
    bool *asked_function;     /* [functions]: can something be asked of rooms with this function? */
    tn_numbering fails;       /* of rooms, that were met: tn_frontier_room_open */
    tn_room_open *open_rooms; /* [fails] */
    size_t open_room;
} tn_frontier_questions;

static inline bool tn_answers(const uint64_t *answers, size_t decision)
{
    return answers[decision / 64] >> decision % 64 & 1;
}

/* ---- clauses: clause.c */

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

tn_status tn_frontier_clauses_new(tn_frontier *frontier, tn_error *error);
void tn_frontier_clauses_free(tn_frontier *frontier);

/* What the house of one tray is to a clause. */
tn_status tn_frontier_base(tn_frontier *frontier, tn_frontier_clause *clause, const tn_house *house, uint32_t *base,
                           tn_error *error);

/* When all slices are made: their automata. */
tn_status tn_frontier_lower(tn_frontier *frontier, tn_error *error);

/* ---- completions: reading.c */

#define TN_FRONTIER_NO_PAIR UINT64_MAX

/* When all automata are made. */
tn_status tn_frontier_find_completions(tn_frontier *frontier, tn_error *error);
void tn_frontier_completions_free(const tn_frontier *frontier, tn_frontier_clause *clause);

/* The first state and base, state << 32 | base, that cannot be told from these after so many trays. */
tn_status tn_frontier_pair(tn_frontier *frontier, tn_frontier_clause *clause, uint32_t trays, uint32_t state,
                           uint32_t base, uint64_t *pair, tn_error *error);

/* ---- reading: reading.c */

/* What the clauses have read, by number, and what comes next of each number. */
typedef struct tn_frontier_reading {
    tn_interner readings, between, values;            /* at a state; at an interface, the slice read; of an interface */
    tn_frontier_known *after_slice, *after_interface; /* [trays_most + 1] */
    uint32_t *scratch;                                /* [2 * clauses] */
} tn_frontier_reading;
void tn_frontier_reading_clear(tn_frontier_reading *reading, uint32_t trays_most);

/* What the clauses have read after a slice (TN_FRONTIER_NONE: the end), by what they had read before (TN_FRONTIER_NONE:
 * the beginning); then after the interface before the slice, by what that is to them. trays: before the slice.
 * TN_FRONTIER_NONE: a clause keeps nothing of that. */
tn_status tn_frontier_read_slice(tn_frontier *frontier, uint32_t trays, uint32_t read, uint32_t slice,
                                 uint32_t *between, tn_error *error);
tn_status tn_frontier_read_interface(tn_frontier *frontier, uint32_t trays, uint32_t between, uint32_t values,
                                     uint32_t *read, tn_error *error);

/* ---- comparisons with 0, which are known at the end of the row: reading.c */

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

typedef struct tn_frontier_comparisons {
    uint32_t *weighed_rooms[TN_ADDED_MAX]; /* [terms of the number]: of the questions about rooms */
    tn_plan_vm *plan_vm;                   /* what comparisons add up of trays; NULL: none does */
    tn_interner totals;                    /* what compared numbers come to so far */
    tn_frontier_ahead *ahead;              /* [trays_most + 1], once it is known or being found */
    bool looking_ahead;                    /* totals are left aside */
} tn_frontier_comparisons;
void tn_frontier_comparisons_clear(tn_frontier_comparisons *compared);

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

/* ---- placed questions, which ask where in the row rooms and walks are
 *
 * What a room is, and whether a source is apart, is known trays later. Until then a slot stands for it: rooms.c and
 * walks.c say at each interface what becomes of the slots, and clause.c makes letters and relations of that. */

/* ---- what is seen of rooms and walks in the row: rooms.c, walks.c; read in clause.c */

/* Words of what is seen of a placed question at the right side of a tray. Rooms: how many lie in the tray alone; then
 * what each slot says. Walks: where the tray's own sources go, and what each slot says of those of trays before it. */
enum { SEEN_FIRST, SEEN_SLOTS, SEEN_WORDS = SEEN_SLOTS + TN_FRONTIER_SLOTS_MAX };

/* The first word if more is to be told apart than there are slots: nothing follows from such a tray. */
#define SEEN_TOO_MANY UINT32_MAX

/* Of a slot of rooms, which have one beginning. ENDS: one of them that is so ends here; then two, and so on. */
enum { SLOT_OFF, SLOT_ON, SLOT_BEGINS, SLOT_ENDS };

/* Of the sources of a tray, and of a slot of sources: none is apart; one is; or, for a slot, it goes on, or it becomes
 * one with the slot TO. The sources of a tray, if it is not known of them yet, go TO a slot. */
enum { WALK_NONE, WALK_APART, WALK_ON, WALK_TO };

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
