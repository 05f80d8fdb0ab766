/* Position-independent mapping (O'Neill, Brabazon, Nicolau, Mc Garraghy and Keenan, "Pi Grammatical Evolution", 2004):
 * codons are read in pairs. The first says which non-terminal of the sentential form is replaced, the second by what.
 *
 * The derivation is kept as a tree, since its text can only be written when it is whole. */
#include "runtime/genome/mapping/mapper_state.h"

#define ROOT 0u
#define NOT_READ UINT64_MAX

static bool add_node(tn_mapper *m, uint32_t rule, uint32_t depth)
{
    if (!tn_array_reserve(&m->nodes_of, &m->node_capacity, m->node_count, 1, sizeof *m->nodes_of) ||
        !tn_sentential_put(&m->pending, (uint32_t)m->node_count))
        return false;
    m->nodes_of[m->node_count++] = (tn_mapping_node){.rule = rule, .depth = depth, .read = NOT_READ};
    return true;
}

static tn_expansion add_children(tn_mapper *m, const tn_production *production, uint32_t depth)
{
    const tn_grammar *g = m->grammar;
    for (const uint32_t *ip = g->words + production->words; TN_WORD_OP(*ip) != TN_WORD_DONE; ip++) {
        uint32_t argument = TN_WORD_ARGUMENT(*ip);
        if (m->steps_left == 0)
            return TN_EXPAND_TOO_LONG;
        m->steps_left--;
        if (TN_WORD_OP(*ip) == TN_WORD_TERMINAL ? !tn_pay_for_text(&m->steps_left, g->terminals[argument].length)
                                                : m->node_count == UINT32_MAX)
            return TN_EXPAND_TOO_LONG;
        if (TN_WORD_OP(*ip) == TN_WORD_RULE && !add_node(m, argument, depth))
            return TN_EXPAND_NO_MEMORY;
    }
    return TN_EXPANDED;
}

/* Reads a pair, and replaces the non-terminal that it says. */
static tn_expansion replace_one(tn_mapper *m)
{
    uint64_t place, choice;
    uint32_t open = (uint32_t)m->pending.count;
    if (!tn_mapper_read(m, &place) || !tn_mapper_read(m, &choice))
        return TN_EXPAND_NO_CODON;
    tn_mapping_node *node = &m->nodes_of[tn_sentential_take(&m->pending, (size_t)(place % open))];
    const tn_rule *rule = &m->grammar->rules[node->rule];
    const uint32_t production = rule->first + tn_codon_modulo(choice, rule->count, rule->reciprocal);
    const tn_production *p = &m->grammar->productions[production];
    const uint32_t depth = node->depth, deepest = depth + (p->symbols != 0);
    *node = (tn_mapping_node){.rule = node->rule,
                              .production = production,
                              .first_child = (uint32_t)m->node_count,
                              .depth = depth,
                              .open = open,
                              .read = m->used - 2,
                              .place = place,
                              .choice = choice};
    m->nodes += p->children ? p->children : 1;
    m->depth = deepest > m->depth ? deepest : m->depth;
    return m->max_depth && deepest > m->max_depth ? TN_EXPAND_TOO_DEEP : add_children(m, p, depth + 1);
}

/* ---- writing what was derived, also where it is not whole */

static bool write_terminal(tn_mapper *m, uint32_t index, uint32_t depth, bool recorded)
{
    const tn_terminal *terminal = &m->grammar->terminals[index];
    size_t begin = m->text.size;
    return tn_text_append(&m->text, m->grammar->texts + terminal->offset, terminal->length) &&
           (!recorded || tn_mapper_record(m, (tn_event){.kind = TN_EVENT_TERMINAL,
                                                        .depth = depth,
                                                        .symbol = index,
                                                        .read = TN_NO_READ,
                                                        .text_begin = begin}));
}

static bool record_choice(tn_mapper *m, const tn_mapping_node *node)
{
    tn_event event = {.kind = TN_EVENT_PLACE,
                      .depth = node->depth,
                      .symbol = node->rule,
                      .read = node->read,
                      .codon = node->place,
                      .modulus = node->open,
                      .value = node->place % node->open,
                      .text_begin = m->text.size};
    if (!tn_mapper_record(m, event))
        return false;
    const tn_rule *rule = &m->grammar->rules[node->rule];
    event.kind = TN_EVENT_EXPAND;
    event.production = node->production;
    event.read++;
    event.codon = node->choice;
    event.modulus = rule->count;
    event.value = node->production - rule->first;
    return tn_mapper_record(m, event);
}

static bool enter(tn_mapper *m, size_t *top, uint32_t index, bool recorded)
{
    const tn_mapping_node *node = &m->nodes_of[index];
    if (node->read == NOT_READ)
        return true;
    if (!tn_array_reserve(&m->frames, &m->frame_capacity, *top, 1, sizeof *m->frames))
        return false;
    m->frames[(*top)++] = (tn_mapping_frame){.ip = m->grammar->words + m->grammar->productions[node->production].words,
                                             .depth = node->depth,
                                             .rule = node->rule,
                                             .mark = node->first_child};
    return !recorded || record_choice(m, node);
}

static bool leave(tn_mapper *m, const tn_mapping_frame *frame, bool recorded)
{
    return !recorded || tn_mapper_record(m, (tn_event){.kind = TN_EVENT_END,
                                                       .depth = frame->depth,
                                                       .symbol = frame->rule,
                                                       .read = TN_NO_READ,
                                                       .text_begin = m->text.size});
}

/* A frame's `mark` is here the next of its children. */
static bool write_derivation(tn_mapper *m, bool recorded)
{
    size_t top = 0;
    bool well = enter(m, &top, ROOT, recorded);
    while (well && top > 0) {
        tn_mapping_frame *frame = &m->frames[top - 1];
        const uint32_t word = *frame->ip++;
        if (TN_WORD_OP(word) == TN_WORD_TERMINAL)
            well = write_terminal(m, TN_WORD_ARGUMENT(word), frame->depth, recorded);
        else if (TN_WORD_OP(word) == TN_WORD_RULE && frame->mark < m->node_count)
            well = enter(m, &top, frame->mark++, recorded);
        else if (TN_WORD_OP(word) == TN_WORD_DONE)
            well = leave(m, &m->frames[--top], recorded);
    }
    return well;
}

tn_expansion tn_mapper_expand_places(tn_mapper *m, bool recorded)
{
    tn_sentential_reset(&m->pending);
    m->node_count = 0;
    if (m->steps_left-- == 0)
        return TN_EXPAND_TOO_LONG;
    tn_expansion result = add_node(m, ROOT, 1) ? TN_EXPANDED : TN_EXPAND_NO_MEMORY;
    while (result == TN_EXPANDED && m->pending.count)
        result = replace_one(m);
    bool writes = result == TN_EXPANDED || (recorded && result != TN_EXPAND_NO_MEMORY);
    return writes && !write_derivation(m, recorded) ? TN_EXPAND_NO_MEMORY : result;
}
