/* The code of a rule function, which is in postfix order, read as nodes: each an instruction with its operands before
 * it. Whoever says what an instruction makes of automata has the whole put together.
 *
 * A tn_postfix owns its nodes and the automata on its stack. Clear it in any case.
 */
#ifndef TARTAN_PLAN_MATCH_POSTFIX_H
#define TARTAN_PLAN_MATCH_POSTFIX_H

#include "runtime/automata/dfa.h"
#include "runtime/module/code.h"

/* An instruction, and in which form its result is wanted: of the plan as a whole (over the classes), or as a relation
 * (over marked words). */
typedef struct tn_postfix_node {
    tn_instruction code;
    uint32_t offset;
    bool plain;
} tn_postfix_node;

typedef struct tn_postfix {
    tn_postfix_node *nodes; /* in code order, without the final RETURN */
    size_t count;
    tn_dfa **stack;
    size_t depth;
} tn_postfix;

/* plain: is the whole wanted so? */
tn_status tn_postfix_read(const tn_module *module, uint32_t function, bool plain, tn_postfix *code, tn_error *error);
/* The same of code that leaves one automaton on the stack; `deepest` are on it at most. */
tn_status tn_postfix_read_range(const tn_module *module, uint32_t begin, uint32_t end, uint32_t deepest, bool plain,
                                tn_postfix *code, tn_error *error);
void tn_postfix_clear(tn_postfix *code);

/* What an instruction makes of its operands, which stay the caller's. */
typedef tn_status tn_postfix_make(void *context, const tn_postfix_node *node, tn_dfa *const *in, tn_dfa **out,
                                  tn_error *error);

/* *out := what the last node makes; the caller frees it. An error's code_offset is the instruction's. */
tn_status tn_postfix_fold(tn_postfix *code, tn_postfix_make *make, void *context, tn_dfa **out, tn_error *error);

#endif
