/* What a tn_house_rules is made of, for the files that implement asked.h. */
#ifndef TARTAN_HOUSE_RULE_ASKED_DATA_H
#define TARTAN_HOUSE_RULE_ASKED_DATA_H

#include "runtime/house/rule/asked.h"
#include "runtime/house/walk/walk.h"
#include "runtime/plan/match/vm.h"

/* A room: cells of one function that open faces join, with the voids above. It spans the trays [begin, end). */
typedef struct tn_room_span {
    uint32_t room; /* its lowest cell */
    uint32_t begin, end;
    uint32_t cells;   /* without voids */
    tn_int128 area;   /* likewise, in square nanometres */
    tn_int128 glazed; /* to the outside */
} tn_room_span;

struct tn_house_rules {
    const tn_house *house;
    size_t max_length;
    tn_plan_vm *vm;
    bool gathered;     /* the rooms are known */
    uint32_t *room_of; /* each cell's */
    tn_room_span *rooms;
    size_t room_count;
    bool *seen;
    uint8_t *near; /* [cells] on one walk: asked.c */
    uint32_t *todo;
    int64_t *sums;
    size_t capacity;     /* of each of the arrays, in items */
    tn_plan_vm *sums_vm; /* what comparisons add up of the plan, once one is asked; that of the rules is at work then */
    bool summed;         /* it has the plan */
    bool priced;         /* the cost is known */
    mpq_t cost;
    bool walked; /* the walks are known */
    tn_walks walks;
    tn_walk_floors floors;
};

/* ---- asked_rooms.c */
/* The rooms of the house, if they are not known. */
tn_status tn_rooms_gather(tn_house_rules *rules, tn_error *error);

/* ---- asked.c */
/* Is there no walk from the cell to one of the second kind? Cells between are of the third. Then rules->seen are the
 * cells that walks come to. */
bool tn_cell_apart(tn_house_rules *rules, const tn_meeting_record *walk, uint32_t from);

/* ---- walked.c */
/* A term about walks or ways out: its number, and the cell that it is of; TN_NO_WORTH: the first without a walk. */
typedef struct tn_walked {
    tn_worth worth;
    int64_t number;
    uint32_t cell;
} tn_walked;
tn_status tn_house_walked(tn_house_rules *rules, const tn_house_term_record *term, tn_walked *walked, tn_error *error);

/* The shortest walk from a cell, by a term about walks: none if it is where that leads. The caller frees *lines. */
tn_status tn_house_walk_lines(tn_house_rules *rules, const tn_house_term_record *term, uint32_t cell,
                              tn_walk_line **lines, size_t *count, tn_error *error);

/* ---- measured.c */
/* *so: does the number of the house compare so with 0 (HOUSE_BELOW and those after it)? */
tn_status tn_house_compare(tn_house_rules *rules, const tn_instruction *op, bool *so, tn_error *error);

/* ---- asked_rooms.c, again: what a function of kind ROOM decides on a room. */
bool tn_room_decide(const tn_house_rules *rules, uint32_t function, const tn_room_span *room);

#endif
