#include "runtime/gene/mapper_edges.h"

#define REPAIR_DEPTH 3u /* of a repairing rule's successor: below the start symbol and a rewrite rule */

static uint32_t first_without_rule(const tn_mapper *m)
{
    for (size_t id = 0; id < m->id_capacity; id++)
        if (m->seen[id] && !m->ruled[id])
            return (uint32_t)id;
    return NO_ID;
}

/* Writes "Edge<id> -> <successor>" to the empty text. */
static outcome repairing_rule(tn_mapper *m, uint32_t id, const tn_map_options *options)
{
    m->text.size = 0;
    if (!reserve(&m->text.data, &m->text.capacity, 0, 2 * EDGE_TEXT + COPY, 1))
        return NO_MEMORY;
    if (options->record &&
        !record(m, (tn_event){.kind = TN_EVENT_REPAIR, .depth = REPAIR_DEPTH - 1, .read = TN_NO_READ, .value = id}))
        return NO_MEMORY;
    m->text.size = write_edge(m->text.data, 0, id);
    memcpy(m->text.data + m->text.size, " ->", 3);
    m->text.size += 3;
    if (options->repair == TN_REPAIR_IDENTITY) {
        m->text.size = write_edge(m->text.data, m->text.size, id);
        return RAN;
    }
    return tn_mapper_expand(m, m->grammar->successor, REPAIR_DEPTH, options->record);
}

/* The added rules go behind the separator that follows the last rewrite rule, or to the end where there is none. */
static bool join_repaired(tn_mapper *m, const writing *sentence, size_t rule_end)
{
    size_t at = rule_end < sentence->size ? rule_end + 1 : sentence->size;
    while (at < sentence->size && sentence->data[at] != ' ')
        at++;
    m->repaired.size = 0;
    if (!append(&m->repaired, sentence->data, at))
        return false;
    if (m->added.size && at == sentence->size && !append(&m->repaired, " ;", 2))
        return false;
    return append(&m->repaired, m->added.data, m->added.size) &&
           append(&m->repaired, sentence->data + at, sentence->size - at);
}

outcome tn_mapper_repair(tn_mapper *m, const tn_map_options *options)
{
    writing sentence = m->text;
    size_t rule_end = m->rule_end;
    m->text = (writing){0};
    m->frozen = true;
    m->added.size = 0;
    m->repaired_count = 0;
    outcome result = append(&m->added, "", 0) ? RAN : NO_MEMORY;
    uint32_t id;
    while (result == RAN && (id = first_without_rule(m)) != NO_ID) {
        result = repairing_rule(m, id, options);
        if (result != RAN)
            break;
        if (!mark_id(m, id, true) || !append(&m->added, " ", 1) || !append(&m->added, m->text.data, m->text.size) ||
            !append(&m->added, " ;", 2) ||
            !reserve(&m->repaired_ids, &m->repaired_capacity, m->repaired_count, 1, sizeof *m->repaired_ids)) {
            result = NO_MEMORY;
            break;
        }
        m->repaired_ids[m->repaired_count++] = id;
    }
    free(m->text.data);
    m->text = sentence;
    if (result == RAN && !join_repaired(m, &sentence, rule_end))
        result = NO_MEMORY;
    return result;
}
