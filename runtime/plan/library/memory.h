/* What was found out about sets of plans, to be found again when the same question is asked of the same automata: after
 * an edit that left them as they were.
 *
 * A key is a hash of 128 bits of all that an answer depends on. It is taken over the automata themselves, which are
 * canonical, so that nothing about how rules are written, named or placed can make an answer wrong. Threads may share a
 * tn_plan_memory. It holds up to a bound of bytes and then starts anew; an answer that cannot be kept is not kept.
 */
#ifndef TARTAN_PLAN_LIBRARY_MEMORY_H
#define TARTAN_PLAN_LIBRARY_MEMORY_H

#include "runtime/automata/dfa.h"

typedef struct tn_plan_memory tn_plan_memory;

typedef struct tn_memory_key {
    uint64_t low, high;
} tn_memory_key;

/* One part of a question. `subject`: what is asked, numbers that the answer depends on; then automata with what is
 * asked of each. */
typedef struct tn_memory_part {
    const tn_dfa *dfa;
    uint32_t role;
} tn_memory_part;

tn_memory_key tn_memory_key_make(const uint64_t *subject, size_t subject_count, const tn_memory_part *parts,
                                 size_t count);

/* bytes: what the answers may take together; 0: 16 MB. NULL where out of memory. */
tn_plan_memory *tn_plan_memory_new(size_t bytes);
void tn_plan_memory_free(tn_plan_memory *memory);

/* Copies an answer of exactly so many bytes; false where there is none. */
bool tn_plan_memory_find(tn_plan_memory *memory, tn_memory_key key, void *answer, size_t size);

/* Keeps an answer. */
void tn_plan_memory_keep(tn_plan_memory *memory, tn_memory_key key, const void *answer, size_t size);

/* How many answers were found, and how many looked for: for tests. */
void tn_plan_memory_looks(tn_plan_memory *memory, size_t *found, size_t *looked);

#endif
