/* Functions that use themselves or each other (a circle): the automata of their relations, which are the least solution
 * of their equations.
 *
 * If every use stands at the left end of what it stands in, or every one at the right end, the equations are linear and
 * solved by elimination (equations.h), for plans of every length. Else the automata are made round by round for
 * stretches as long as the plans that are asked about: in round n all stretches of up to n trays are right.
 *
 * Clear a tn_circle in any case.
 */
#ifndef TARTAN_PLAN_MATCH_CIRCLE_H
#define TARTAN_PLAN_MATCH_CIRCLE_H

#include "runtime/automata/equations.h"
#include "runtime/automata/marked.h"
#include "runtime/plan/match/postfix.h"

typedef struct tn_circle {
    uint32_t *members; /* functions; owned */
    uint32_t count;
    tn_postfix *codes; /* [count] */
    tn_linear *sides;  /* [count]: of the equations */
    tn_dfa **empties;  /* [count]: the empty stretches of each relation, or NULL */
    bool left, right;  /* does an unknown stand before something, behind something? */
    bool linear;       /* and nowhere else? */
    tn_linear *stack;  /* of the function at hand */
    size_t depth, room;
} tn_circle;

/* Reads a function, and those that its circle leads to. */
tn_status tn_circle_read(const tn_module *module, uint32_t function, tn_circle *circle, tn_error *error);
void tn_circle_clear(tn_circle *circle);

/* What a circle is lowered with. */
typedef struct tn_circle_means {
    const tn_module *module;
    const tn_marked *marked;
    uint32_t max_trays; /* of the plans that are asked about; 0: not known */
    bool reversed;      /* the relations of the plan turned round are wanted */
    /* What an instruction makes of known operands, but for the uses within the circle, unless they are left out. */
    tn_postfix_make *make;
    bool (*left_out)(const void *context, uint32_t offset);
    void *context;
} tn_circle_means;

/* Makes the relation of each member: out [count], which the caller frees. TN_LIMIT (E0802) if one passes the bounds, or
 * the equations are not linear and it is not known how long plans are. */
tn_status tn_circle_lower(tn_circle *circle, const tn_circle_means *means, tn_dfa **out, tn_error *error);

#endif
