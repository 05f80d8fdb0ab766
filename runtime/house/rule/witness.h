/* What of a house a rule's answer rests on: the cells, rooms, faces and walks that its questions find.
 *
 * The rules have been started on the house (tn_house_rules_start).
 */
#ifndef TARTAN_HOUSE_RULE_WITNESS_H
#define TARTAN_HOUSE_RULE_WITNESS_H

#include "runtime/house/rule/asked.h"
#include "runtime/house/walk/walk.h"

/* One thing that a question finds, or (first: TN_NO_CELL) the question before the first of them. SOME_CELL, CELLS,
 * AREAS: the cell `first`. SOME_ROOM, ROOMS: the room whose lowest cell that is. MEETS: the face `face`. APART: the
 * walk from `first` comes only to the cells `reached`. HOUSE_BELOW and the like: the cell whose walk or ways out a term
 * is about (a HOUSE_TERM), so long or so many; `lines` are that walk. number: TN_NO_PATH if the cell has no walk. offset:
 * of the question in the code. */
typedef struct tn_witness {
    uint32_t opcode, offset, first, face;
    const bool *reached; /* [cell] */
    const tn_house_term_record *term; /* NULL but for HOUSE_BELOW and the like */
    int64_t number;
    const tn_walk_line *lines;
    size_t line_count;
} tn_witness;

typedef tn_status tn_witness_seen(void *context, const tn_witness *witness, tn_error *error);

/* Goes through the questions of a function (of kind HOLDS) and of those that it calls, in the order of the code; each
 * is asked once. TN_MEMORY, or what `seen` returns. */
tn_status tn_house_rules_witness(tn_house_rules *rules, uint32_t function, tn_witness_seen *seen, void *context,
                                 tn_error *error);

#endif
