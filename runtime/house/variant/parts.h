/* What a tn_house_variants is made of, for the files that implement variant.h. */
#ifndef TARTAN_HOUSE_VARIANT_PARTS_H
#define TARTAN_HOUSE_VARIANT_PARTS_H

#include "runtime/automata/numbering.h"
#include "runtime/house/form/form.h"
#include "runtime/house/house.h"
#include "runtime/house/variant/variant.h"
#include "runtime/module/code.h"

/* When a clause of a house library can be asked: how much of a house has to be known for what it asks. */
typedef enum tn_clause_stage {
    TN_STAGE_SECTION,   /* the plan, the section, which cells there are */
    TN_STAGE_FUNCTIONS, /* their functions */
    TN_STAGE_FACES,     /* what is in the faces: rooms, walks, what touches what */
    TN_STAGE_TILES      /* what it costs, also what stands in its rooms */
} tn_clause_stage;

/* The functions of kind ROOM that ask for faces: all of the module, which is only too careful. Owns the array. */
typedef struct tn_room_questions {
    uint32_t *functions;
    size_t count;
} tn_room_questions;

/* How many tiles fit in a cell, kept for cells of one function and storey that are equally large and have the same in
 * and near their faces: plans of a library have few kinds of these. */
enum { TN_FITS_MAX = 1 << 16 }; /* kinds of cells: with more the counts are forgotten */

/* Owns its arrays. */
typedef struct tn_fits {
    bool *wanted; /* [functions] a tile is for it */
    tn_interner cells;
    tn_key key;
    size_t *counts; /* [cells] */
    size_t room;
} tn_fits;

/* A wheel of the counter: a cell's functions or a face's kinds, and which of them is set. */
typedef struct tn_wheel {
    uint32_t of; /* a cell or a face */
    uint32_t first, count, at;
} tn_wheel;

typedef struct tn_wheels {
    tn_wheel *items;
    uint32_t *choices; /* of all wheels, one after another */
    size_t count, room, choice_count, choice_room;
} tn_wheels;

/* What may be in a face when its cells have these functions. count: 0 where that is not known. */
enum {
    TN_KNOWN_KINDS_MAX = 6, /* of a face with more it is found out each time */
    TN_KNOWN_WAYS = 4       /* of a face: pairs of functions that are kept, each at its place */
};
typedef struct tn_known_face {
    uint32_t first, second; /* functions; second: TN_NO_FUNCTION outside */
    uint32_t count, kinds[TN_KNOWN_KINDS_MAX];
} tn_known_face;

struct tn_house_variants {
    const tn_house_form *form;
    const tn_house_library_record *library;
    tn_house_rules *rules;
    tn_clause_stage *stages;      /* of each clause: when it can be asked */
    struct tn_clause_memo *memos; /* of each clause: clauses.c */
    size_t turn_end; /* the wheels of functions from here on change nothing: a clause dropped all their houses */
    uint64_t work_limit, work;
    uint64_t step;  /* what a step takes of it: as much as the house is large */
    uint64_t *runs; /* of each clause, on the plan at hand: the dearest is named where the work is too much */
    tn_house house;
    bool stands;                /* or only its section is known */
    tn_house_known known;       /* of that house's cells */
    tn_known_face *known_faces; /* [faces][TN_KNOWN_WAYS] */
    tn_wheels functions, faces;
    size_t faces_set; /* of the wheels of faces, how many at the beginning are set while those after them are counted */
    tn_wheels shared, own; /* those of `faces` that clauses can depend on, and the others, by their cell: count.c */
    tn_room_questions questions;
    struct tn_sections *sections; /* what was counted on the plan at hand: section.h */
    tn_tray *counted;             /* that plan */
    size_t counted_length;
    tn_fits fits;
    size_t *tiles; /* how many fit in each cell; 1 where it has none */
    size_t tile_room;
    bool asks_costs;                      /* a clause is of the stage of tiles */
    mpq_t price;                          /* what the house costs, while these are asked */
    struct tn_combinations *combinations; /* furnish.h; NULL unless costs are asked for */
};

/* ---- wheels */

void tn_wheels_clear(tn_wheels *wheels);
tn_status tn_wheels_add(tn_wheels *wheels, uint32_t of, const uint32_t *choices, uint32_t count, tn_error *error);

static inline uint32_t tn_wheel_chosen(const tn_wheels *wheels, size_t i)
{
    return wheels->choices[wheels->items[i].first + wheels->items[i].at];
}

/* The last of the wheels [first, end) turns first. False: all have come round. */
bool tn_wheels_turn(tn_wheels *wheels, size_t first, size_t end);

/* ---- stages */

/* Steps of the work on a plan; TN_LIMIT (E1617) past the limit. */
tn_status tn_variants_spend(tn_house_variants *v, uint64_t steps, tn_error *error);

/* Do all clauses that can be asked at this stage, and not before, keep the house? */
tn_status tn_variants_keep(tn_house_variants *v, tn_clause_stage stage, bool *kept, tn_error *error);

/* How many tiles fit in each cell (v->tiles). fit: does one in each? */
tn_status tn_variants_count_tiles(tn_house_variants *v, bool *fit, tn_error *error);

/* The wheels of the faces, all at their first kind, none of them set. */
tn_status tn_variants_set_faces(tn_house_variants *v, tn_error *error);

/* ---- clauses.c: when a clause can be asked */

/* The stage of each clause of the library. */
tn_status tn_clause_stages(const tn_house_form *form, const tn_house_library_record *library, tn_clause_stage *stages,
                           tn_error *error);

/* ---- clauses.c: answers to functions
 *
 * Answers of clauses that ask for functions, kept by what they can tell apart.
 *
 * A clause sees the function of a cell only through decisions on cells (functions of kind CELL). Functions of one cell
 * on which all its decisions agree are one class; the answer is kept for each combination of classes, so that a clause
 * is run once for each of these and not once for each house. Where there are more than TN_MEMO_ANSWERS_MAX combinations
 * it is run each time. */

#define TN_MEMO_ANSWERS_MAX ((size_t)1 << 20)

/* Marks the functions that an instruction names. */
void tn_mark_operands(const tn_module *module, const tn_instruction *op, bool *reached);

/* Finds what the library's clauses ask, once for all houses. Free the memos in any case. */
tn_status tn_memos_begin(tn_house_variants *v, tn_error *error);

/* Makes the memos of all clauses that are asked with the functions, empty, for the wheels of the house at hand. */
tn_status tn_memos_make(tn_house_variants *v, tn_error *error);
void tn_memos_free(tn_house_variants *v);

/* Where the clause's answer to the functions at hand is kept; NULL where it is not. 0: it is not known yet. */
uint8_t *tn_memo_answer(const tn_house_variants *v, uint32_t clause);
enum { TN_MEMO_UNKNOWN, TN_MEMO_KEEPS, TN_MEMO_DROPS };

/* The wheels of functions from here on are none that the clause looks at: turning them does not change the answer. */
size_t tn_memo_end(const tn_house_variants *v, uint32_t clause);

/* ---- clauses.c: faces
 *
 * Which faces clauses can tell apart, when the functions are given.
 *
 * An outside face is never walked through and joins no rooms, so clauses see what is in it only through them:
 * `room(living, not by window)`. Where no such question is open about the room of its cell (the cell is no living
 * room), all of the face's kinds are the same to the clauses: they only change which tiles fit into that one cell
 * (where none of them is `open`). A void is of the room below it. */

tn_status tn_room_questions_find(const tn_module *module, tn_room_questions *questions, tn_error *error);
void tn_room_questions_clear(tn_room_questions *questions);

/* Can a clause depend on what is in the face? Cells have their functions. */
bool tn_face_relevant(const tn_house *house, const tn_room_questions *questions, const tn_face *face);

/* ---- count.c: tiles that fit in a cell */

/* TN_MEMORY. Clear it in any case. */
tn_status tn_fits_begin(const tn_house_form *form, tn_fits *fits, tn_error *error);
void tn_fits_clear(tn_fits *fits);

/* Does the cell have to have a tile? */
bool tn_fits_wanted(const tn_fits *fits, const tn_cell *cell);

/* How many tiles fit in such a cell of a house whose faces are all known. TN_MEMORY. */
tn_status tn_fits_count(tn_fits *fits, const tn_house *house, uint32_t cell, size_t *count, tn_error *error);

/* ---- count.c */

/* Adds the houses with the functions at hand: faces that clauses cannot tell apart are multiplied cell by cell. */
tn_status tn_variants_count_faces(tn_house_variants *v, tn_house_counts *counts, tn_error *error);

/* The same of the houses whose first faces_set wheels of faces are as they stand; the functions are kept. */
tn_status tn_variants_count_set(tn_house_variants *v, tn_house_counts *counts, tn_error *error);

/* Who looks at the houses. `count` is shown how many there are of a section, then of functions, then of the faces that
 * are set, one more at a time (where `by_faces` is set); it takes them all at once (*taken), or is shown fewer at a
 * time. `visit` is shown houses one by one, without tiles. *stop ends the going through. */
typedef enum tn_house_part { PART_SECTION, PART_FUNCTIONS, PART_FACES } tn_house_part;
typedef struct tn_house_visitor {
    const bool *by_faces; /* or NULL: never */
    void (*count)(tn_house_variants *v, void *context, tn_house_part part, const tn_house_counts *counts, bool *taken);
    tn_status (*visit)(tn_house_variants *v, void *context, bool *stop, tn_error *error);
    void *context;
} tn_house_visitor;

/* The house at hand becomes one like this, but for its tiles; work begins. */
tn_status tn_variants_take(tn_house_variants *variants, const tn_house *like, tn_error *error);

/* Shows the houses on a plan in the order of their numbers. */
tn_status tn_variants_go_through(tn_house_variants *variants, const tn_tray *trays, size_t length,
                                 const tn_house_visitor *visitor, tn_error *error);

#endif
