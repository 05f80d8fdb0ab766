/* Edge types while a sentence is written: which occur, which have a rule, and how they are spelled (Genr8 paper, 4.5
 * and 5.1). */
#ifndef TARTAN_GENOME_MAPPING_MAPPER_EDGES_H
#define TARTAN_GENOME_MAPPING_MAPPER_EDGES_H

#include "runtime/genome/mapping/mapper_state.h"

static inline bool tn_edge_mark(tn_mapper *m, uint32_t id, bool ruled)
{
    size_t old = m->id_capacity, capacity = old;
    if (id >= old) {
        if (!tn_array_reserve(&m->seen, &capacity, id, 1, 1))
            return false;
        size_t other = old;
        if (!tn_array_reserve(&m->ruled, &other, id, 1, 1))
            return false;
        memset(m->seen + old, 0, capacity - old);
        memset(m->ruled + old, 0, capacity - old);
        m->id_capacity = capacity;
    }
    bool waits = m->frozen && !ruled && !m->seen[id] && !m->ruled[id];
    (ruled ? m->ruled : m->seen)[id] = 1;
    return !waits || tn_repair_waits(m, id);
}

static inline bool tn_edge_in_predecessor(tn_mapper *m, uint32_t id)
{
    if (!tn_array_reserve(&m->predecessor, &m->predecessor_capacity, m->predecessor_count, 1, sizeof *m->predecessor))
        return false;
    m->predecessor[m->predecessor_count++] = id;
    return true;
}

static inline void tn_predecessor_begins(tn_mapper *m)
{
    m->in_predecessor = true;
    m->has_less = m->has_greater = false;
    m->predecessor_count = 0;
}

/* The edges that a predecessor rewrites, its contexts left out (4.5): A in `A > B`, B in `A < B` and in `A < B > C`,
 * all without. */
static inline bool tn_predecessor_ends(tn_mapper *m)
{
    size_t from = m->has_less ? 1 : 0;
    size_t to = m->has_less || m->has_greater ? from + 1 : m->predecessor_count;
    m->in_predecessor = false;
    for (size_t i = from; i < to && i < m->predecessor_count; i++)
        if (!tn_edge_mark(m, m->predecessor[i], true))
            return false;
    return true;
}

static inline bool tn_rewrite_rule_ends(tn_mapper *m, uint32_t mark)
{
    if (mark == TN_MARK_PREDECESSOR)
        return tn_predecessor_ends(m);
    m->rule_end = m->text.size;
    return true;
}

/* Writes the digits of `value` before `end`; returns the first. */
static inline char *tn_digits_before(uint32_t value, char *end)
{
    do
        *--end = (char)('0' + value % 10);
    while (value /= 10);
    return end;
}

/* Room for an edge is the caller's to have made. */
static inline size_t tn_edge_write(char *text, size_t size, uint32_t id)
{
    char number[10], *end = number + sizeof number, *start = tn_digits_before(id, end);
    if (size)
        text[size++] = ' ';
    memcpy(text + size, "Edge", 4);
    memcpy(text + size + 4, start, (size_t)(end - start));
    return size + 4 + (size_t)(end - start);
}

#endif
