/* Adds a rule for each edge type that a sentence uses and does not rewrite. */
#include "runtime/genome/mapping/mapper_edges.h"

#define REPAIR_DEPTH 3u /* of a repairing rule's successor: below the start symbol and a rewrite rule */

/* ---- edge types that wait for their rule: a heap, so that many types take no longer to find than few */

bool tn_repair_waits(tn_mapper *m, uint32_t id)
{
    if (!tn_array_reserve(&m->waiting, &m->waiting_capacity, m->waiting_count, 1, sizeof *m->waiting))
        return false;
    size_t at = m->waiting_count++;
    for (; at > 0 && m->waiting[(at - 1) / 2] > id; at = (at - 1) / 2)
        m->waiting[at] = m->waiting[(at - 1) / 2];
    m->waiting[at] = id;
    return true;
}

static uint32_t take_lowest(tn_mapper *m)
{
    uint32_t *heap = m->waiting, lowest = heap[0], moving = heap[--m->waiting_count];
    size_t at = 0, count = m->waiting_count;
    for (size_t child; (child = 2 * at + 1) < count; at = child) {
        child += child + 1 < count && heap[child + 1] < heap[child];
        if (moving <= heap[child])
            break;
        heap[at] = heap[child];
    }
    heap[at] = moving;
    return lowest;
}

/* Those of the sentence itself; in ascending order they are a heap. */
static bool list_waiting(tn_mapper *m)
{
    m->waiting_count = 0;
    for (size_t id = 0; id < m->id_capacity && id < m->max_id; id++)
        if (m->seen[id] && !m->ruled[id] && !tn_repair_waits(m, (uint32_t)id))
            return false;
    return true;
}

static bool next_without_rule(tn_mapper *m, uint32_t *id)
{
    while (m->waiting_count) {
        *id = take_lowest(m);
        if (!m->ruled[*id]) /* a grammar can have predecessors in successors, which then is what rules it */
            return true;
    }
    return false;
}

/* ---- their rules */

/* Writes "Edge<id> -> <successor>" to the empty text. */
static tn_expansion repairing_rule(tn_mapper *m, uint32_t id, const tn_mapping_options *options)
{
    m->text.size = 0;
    if (m->steps_left-- == 0)
        return TN_EXPAND_TOO_LONG;
    if (!tn_array_reserve(&m->text.data, &m->text.capacity, 0, 2 * TN_EDGE_TEXT + TN_COPY, 1))
        return TN_EXPAND_NO_MEMORY;
    if (options->record &&
        !tn_mapper_record(
            m, (tn_event){.kind = TN_EVENT_REPAIR, .depth = REPAIR_DEPTH - 1, .read = TN_NO_READ, .value = id}))
        return TN_EXPAND_NO_MEMORY;
    m->text.size = tn_edge_write(m->text.data, 0, id);
    memcpy(m->text.data + m->text.size, " ->", 3);
    m->text.size += 3;
    if (options->repair == TN_REPAIR_IDENTITY) {
        m->text.size = tn_edge_write(m->text.data, m->text.size, id);
        return TN_EXPANDED;
    }
    return tn_mapper_expand(m, m->grammar->successor, REPAIR_DEPTH, options->record);
}

/* The added rules go behind the separator that follows the last rewrite rule, or to the end where there is none. */
static bool join_repaired(tn_mapper *m, const tn_mapping_text *sentence, size_t rule_end)
{
    size_t at = rule_end < sentence->size ? rule_end + 1 : sentence->size;
    while (at < sentence->size && sentence->data[at] != ' ')
        at++;
    m->repaired.size = 0;
    if (!tn_text_append(&m->repaired, sentence->data, at))
        return false;
    if (m->added.size && at == sentence->size && !tn_text_append(&m->repaired, " ;", 2))
        return false;
    return tn_text_append(&m->repaired, m->added.data, m->added.size) &&
           tn_text_append(&m->repaired, sentence->data + at, sentence->size - at);
}

/* Keeps the rule that is in m->text. */
static bool add_rule(tn_mapper *m, uint32_t id)
{
    if (!tn_edge_mark(m, id, true) || !tn_text_append(&m->added, " ", 1) ||
        !tn_text_append(&m->added, m->text.data, m->text.size) || !tn_text_append(&m->added, " ;", 2) ||
        !tn_array_reserve(&m->repaired_ids, &m->repaired_capacity, m->repaired_count, 1, sizeof *m->repaired_ids))
        return false;
    m->repaired_ids[m->repaired_count++] = id;
    return true;
}

tn_expansion tn_mapper_repair(tn_mapper *m, const tn_mapping_options *options)
{
    tn_mapping_text sentence = m->text;
    size_t rule_end = m->rule_end;
    m->text = m->rule;
    m->frozen = true;
    m->added.size = 0;
    m->repaired_count = 0;
    tn_expansion result = tn_text_append(&m->added, "", 0) && list_waiting(m) ? TN_EXPANDED : TN_EXPAND_NO_MEMORY;
    uint32_t id;
    while (result == TN_EXPANDED && next_without_rule(m, &id)) {
        result = repairing_rule(m, id, options);
        if (result == TN_EXPANDED && !add_rule(m, id))
            result = TN_EXPAND_NO_MEMORY;
    }
    m->rule = m->text;
    m->text = sentence;
    if (result == TN_EXPANDED && !join_repaired(m, &sentence, rule_end))
        result = TN_EXPAND_NO_MEMORY;
    return result;
}
