/* Expands one symbol of a grammar: reads a codon at each choice and writes terminals. */
#include "runtime/genome/mapping/mapper_state.h"

static bool repair_waits(tn_mapper *mapper, uint32_t id);

static inline bool edge_mark(tn_mapper *m, uint32_t id, bool ruled)
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
    return !waits || repair_waits(m, id);
}

static inline bool edge_in_predecessor(tn_mapper *m, uint32_t id)
{
    if (!tn_array_reserve(&m->predecessor, &m->predecessor_capacity, m->predecessor_count, 1, sizeof *m->predecessor))
        return false;
    m->predecessor[m->predecessor_count++] = id;
    return true;
}

static inline void predecessor_begins(tn_mapper *m)
{
    m->in_predecessor = true;
    m->has_less = m->has_greater = false;
    m->predecessor_count = 0;
}

/* The edges that a predecessor rewrites, its contexts left out (4.5): A in `A > B`, B in `A < B` and in `A < B > C`,
 * all without. */
static inline bool predecessor_ends(tn_mapper *m)
{
    size_t from = m->has_less ? 1 : 0;
    size_t to = m->has_less || m->has_greater ? from + 1 : m->predecessor_count;
    m->in_predecessor = false;
    for (size_t i = from; i < to && i < m->predecessor_count; i++)
        if (!edge_mark(m, m->predecessor[i], true))
            return false;
    return true;
}

static inline bool rewrite_rule_ends(tn_mapper *m, uint32_t mark)
{
    if (mark == TN_MARK_PREDECESSOR)
        return predecessor_ends(m);
    m->rule_end = m->text.size;
    return true;
}

/* Writes the digits of `value` before `end`; returns the first. */
static inline char *digits_before(uint32_t value, char *end)
{
    do
        *--end = (char)('0' + value % 10);
    while (value /= 10);
    return end;
}

/* Room for an edge is the caller's to have made. */
static inline size_t edge_write(char *text, size_t size, uint32_t id)
{
    char number[10], *end = number + sizeof number, *start = digits_before(id, end);
    if (size)
        text[size++] = ' ';
    memcpy(text + size, "Edge", 4);
    memcpy(text + size + 4, start, (size_t)(end - start));
    return size + 4 + (size_t)(end - start);
}

/* ==== adds a rule for each edge type that a sentence uses and does not rewrite */

#define REPAIR_DEPTH 3u /* of a repairing rule's successor: below the start symbol and a rewrite rule */

/* ---- edge types that wait for their rule: a heap, so that many types take no longer to find than few */

/* While repairing: an edge type occurs for the first time. */
static bool repair_waits(tn_mapper *m, uint32_t id)
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
        if (m->seen[id] && !m->ruled[id] && !repair_waits(m, (uint32_t)id))
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
    m->text.size = edge_write(m->text.data, 0, id);
    memcpy(m->text.data + m->text.size, " ->", 3);
    m->text.size += 3;
    if (options->repair == TN_REPAIR_IDENTITY) {
        m->text.size = edge_write(m->text.data, m->text.size, id);
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
    if (!edge_mark(m, id, true) || !tn_text_append(&m->added, " ", 1) ||
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

/* ==== the loop that a run of evolution spends its time of mapping in. What changes lives in a struct that is never
 * anywhere but in registers, what does not is copied to another: a byte written to the text could, for all the compiler
 * knows, change what pointers lead to */

#define GE_PART static inline __attribute__((always_inline))

typedef struct ge_tables {
    const tn_rule *rules;
    const tn_production *productions;
    const uint32_t *words;
    const tn_terminal *terminals;
    const char *texts;
    const uint64_t *codons, *codons_end;
    uint32_t max_depth;
    bool skip_single;
} ge_tables;

typedef struct ge_run {
    const uint32_t *ip; /* next word */
    const uint64_t *codon;
    char *data; /* the text's */
    size_t capacity, size;
    size_t top;           /* frames in use */
    uint64_t left, steps; /* codons that may be read, steps that may be made */
    uint64_t nodes;
    uint32_t depth, deepest;
} ge_run;

/* Room for a terminal behind `size` bytes of text. Kept out of the loop, whose variables then can stay in registers. */
static __attribute__((noinline)) bool make_room(tn_mapper *m, size_t size, size_t length)
{
    return tn_array_reserve(&m->text.data, &m->text.capacity, size, length + TN_COPY + 1, 1);
}

static __attribute__((noinline)) bool make_frame(tn_mapper *m, size_t top)
{
    return tn_array_reserve(&m->frames, &m->frame_capacity, top, 1, sizeof *m->frames);
}

GE_PART tn_expansion run_ge_terminal(tn_mapper *m, const ge_tables *t, ge_run *r, uint32_t index)
{
    const tn_terminal *terminal = &t->terminals[index];
    const size_t length = terminal->length;
    if (r->steps-- == 0)
        return TN_EXPAND_TOO_LONG;
    if (r->size + length + TN_COPY + 1 > r->capacity) {
        if (!make_room(m, r->size, length))
            return TN_EXPAND_NO_MEMORY;
        r->data = m->text.data;
        r->capacity = m->text.capacity;
    }
    char *to = r->data + r->size;
    const char *from = t->texts + terminal->offset;
    r->size += length;
    if (length <= TN_COPY) {
        memcpy(to, from, TN_COPY);
        return TN_EXPANDED;
    }
    memcpy(to, from, length);
    return tn_pay_for_text(&r->steps, length) ? TN_EXPANDED : TN_EXPAND_TOO_LONG;
}

GE_PART tn_expansion run_ge_rule(tn_mapper *m, const ge_tables *t, ge_run *r, uint32_t index)
{
    const tn_rule *rule = &t->rules[index];
    if (r->steps-- == 0)
        return TN_EXPAND_TOO_LONG;
    if (TN_WORD_OP(*r->ip) != TN_WORD_DONE) { /* nothing to go back to behind a last word */
        if (r->top == m->frame_capacity && !make_frame(m, r->top))
            return TN_EXPAND_NO_MEMORY;
        m->frames[r->top].ip = r->ip;
        m->frames[r->top++].depth = r->depth;
    }
    uint32_t choice = 0;
    if (rule->count > 1 || !t->skip_single) {
        if (r->left == 0)
            return TN_EXPAND_NO_CODON;
        r->left--;
        r->codon = r->codon == t->codons_end ? t->codons : r->codon;
        choice = tn_codon_modulo(*r->codon++, rule->count, rule->reciprocal);
    }
    const tn_production *production = &t->productions[rule->first + choice];
    r->ip = t->words + production->words;
    r->depth++;
    r->nodes += production->children ? production->children : 1;
    const uint32_t level = r->depth + (production->symbols != 0);
    r->deepest = level > r->deepest ? level : r->deepest;
    return level > t->max_depth ? TN_EXPAND_TOO_DEEP : TN_EXPANDED;
}

GE_PART tn_expansion run_ge(tn_mapper *m, const ge_tables *t, ge_run *r)
{
    for (;;) {
        const uint32_t word = *r->ip++, argument = TN_WORD_ARGUMENT(word);
        tn_expansion result = TN_EXPANDED;
        if (TN_WORD_OP(word) == TN_WORD_TERMINAL) {
            result = run_ge_terminal(m, t, r, argument);
        } else if (TN_WORD_OP(word) == TN_WORD_RULE) {
            result = run_ge_rule(m, t, r, argument);
        } else if (r->top == 0) {
            return TN_EXPANDED;
        } else {
            r->ip = m->frames[--r->top].ip;
            r->depth = m->frames[r->top].depth;
        }
        if (result != TN_EXPANDED)
            return result;
    }
}

/* What tn_mapper_expand(mapper, 0, 1, false) does of a ge grammar, faster. */
static tn_expansion mapper_expand_ge(tn_mapper *m)
{
    static const uint32_t opening[2] = {TN_WORD_RULE, TN_WORD_DONE};
    const tn_grammar *g = m->grammar;
    const ge_tables t = {.rules = g->rules,
                         .productions = g->productions,
                         .words = g->words,
                         .terminals = g->terminals,
                         .texts = g->texts,
                         .codons = m->codons,
                         .codons_end = m->count ? m->codons + m->count : m->codons,
                         .max_depth = m->max_depth ? m->max_depth : UINT32_MAX,
                         .skip_single = g->skip_single};
    ge_run r = {.ip = opening,
                .codon = m->codons,
                .data = m->text.data,
                .capacity = m->text.capacity,
                .left = m->readable,
                .steps = m->steps_left,
                .nodes = 1,
                .deepest = 1};
    tn_expansion result = run_ge(m, &t, &r);
    m->text.size = r.size;
    m->used = m->readable - r.left;
    m->nodes = r.nodes;
    m->depth = r.deepest;
    return result;
}

/* ==== position-independent mapping (O'Neill, Brabazon, Nicolau, Mc Garraghy and Keenan, "Pi Grammatical Evolution",
 * 2004): codons are read in pairs. The first says which non-terminal of the sentential form is replaced, the second by
 * what. The derivation is kept as a tree, since its text can only be written when it is whole */

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

/* `Edge`: its number is the codon mod the number of types there are, and one more: that one is new (5.1). */
static inline tn_expansion draw_edge(tn_mapper *m, uint32_t *id, bool recorded, uint32_t depth, char letter)
{
    uint64_t codon;
    if (!tn_mapper_read(m, &codon))
        return TN_EXPAND_NO_CODON;
    uint64_t modulus = (uint64_t)m->max_id + !m->frozen;
    *id = (uint32_t)(codon % modulus);
    bool is_new = *id == m->max_id;
    m->max_id += is_new;
    if (recorded && !tn_mapper_record(m, (tn_event){.kind = TN_EVENT_EDGE,
                                                    .letter = letter,
                                                    .depth = depth,
                                                    .symbol = is_new,
                                                    .read = m->used - 1,
                                                    .codon = codon,
                                                    .modulus = modulus,
                                                    .value = *id,
                                                    .text_begin = m->text.size}))
        return TN_EXPAND_NO_MEMORY;
    return TN_EXPANDED;
}

static bool edge_written(tn_mapper *m, uint32_t id)
{
    return edge_mark(m, id, false) && (!m->in_predecessor || edge_in_predecessor(m, id));
}

/* Which production of the rule, at that depth. */
static inline tn_expansion choose(tn_mapper *m, const tn_grammar *g, uint32_t index, uint32_t depth, bool genr8,
                                  bool recorded, uint32_t *production)
{
    const tn_rule *rule = &g->rules[index];
    if (!genr8 && rule->count == 1 && g->skip_single) {
        *production = rule->first;
        return recorded && !tn_mapper_record(m, (tn_event){.kind = TN_EVENT_EXPAND,
                                                           .depth = depth,
                                                           .symbol = index,
                                                           .production = rule->first,
                                                           .read = TN_NO_READ,
                                                           .text_begin = m->text.size})
                   ? TN_EXPAND_NO_MEMORY
                   : TN_EXPANDED;
    }
    uint64_t codon;
    if (!tn_mapper_read(m, &codon))
        return TN_EXPAND_NO_CODON;
    bool closed = genr8 && m->max_depth && depth >= m->max_depth && rule->closed_count;
    uint32_t modulus = closed ? rule->closed_count : rule->count;
    uint32_t choice = closed ? (uint32_t)(codon % modulus) : tn_codon_modulo(codon, modulus, rule->reciprocal);
    *production = closed ? g->closed[rule->closed_first + choice] : rule->first + choice;
    if (recorded && !tn_mapper_record(m, (tn_event){.kind = TN_EVENT_EXPAND,
                                                    .depth = depth,
                                                    .symbol = index,
                                                    .production = *production,
                                                    .read = m->used - 1,
                                                    .codon = codon,
                                                    .modulus = modulus,
                                                    .value = choice,
                                                    .text_begin = m->text.size}))
        return TN_EXPAND_NO_MEMORY;
    return TN_EXPANDED;
}

/* `{`: after `rounds` times, again if codon mod (rounds + 2) > rounds (5.1, with X = 2 and Y = 0). */
static tn_expansion again(tn_mapper *m, uint32_t rounds, uint32_t depth, bool recorded, bool *goes_on)
{
    uint64_t codon, modulus = (uint64_t)rounds + 2;
    if (!tn_mapper_read(m, &codon))
        return TN_EXPAND_NO_CODON;
    *goes_on = codon % modulus > rounds;
    if (recorded && !tn_mapper_record(m, (tn_event){.kind = *goes_on ? TN_EVENT_AGAIN : TN_EVENT_STOP,
                                                    .depth = depth,
                                                    .symbol = rounds,
                                                    .read = m->used - 1,
                                                    .codon = codon,
                                                    .modulus = modulus,
                                                    .value = codon % modulus,
                                                    .text_begin = m->text.size}))
        return TN_EXPAND_NO_MEMORY;
    return TN_EXPANDED;
}

static tn_expansion option(tn_mapper *m, uint32_t depth, bool recorded, bool *taken)
{
    uint64_t codon;
    if (!tn_mapper_read(m, &codon))
        return TN_EXPAND_NO_CODON;
    *taken = codon & 1;
    if (recorded && !tn_mapper_record(m, (tn_event){.kind = *taken ? TN_EVENT_TAKE : TN_EVENT_SKIP,
                                                    .depth = depth,
                                                    .read = m->used - 1,
                                                    .codon = codon,
                                                    .modulus = 2,
                                                    .value = codon & 1,
                                                    .text_begin = m->text.size}))
        return TN_EXPAND_NO_MEMORY;
    return TN_EXPANDED;
}
/* Where the machine is. Each kind of word has a function below that moves it on; all are inlined into the loop, and the
 * two flags are constants in each caller, so that no dialect pays for the other one, nor either for recording. */
typedef struct place {
    const uint32_t *ip; /* next word */
    size_t top;         /* frames in use */
    uint64_t steps;     /* that may be made */
    uint32_t depth;     /* of the production that the word belongs to */
    uint32_t ids[TN_EDGE_LETTERS];
} place;

#define PART static inline __attribute__((always_inline)) tn_expansion

PART run_terminal(tn_mapper *m, place *at, uint32_t index, const bool genr8, const bool recorded)
{
    const tn_grammar *g = m->grammar;
    const tn_terminal *terminal = &g->terminals[index];
    size_t length = terminal->length;
    if (m->text.size + length + TN_COPY + 1 > m->text.capacity &&
        !tn_array_reserve(&m->text.data, &m->text.capacity, m->text.size, length + TN_COPY + 1, 1))
        return TN_EXPAND_NO_MEMORY;
    if (recorded && !tn_mapper_record(m, (tn_event){.kind = TN_EVENT_TERMINAL,
                                                    .depth = at->depth,
                                                    .symbol = index,
                                                    .read = TN_NO_READ,
                                                    .text_begin = m->text.size}))
        return TN_EXPAND_NO_MEMORY;
    if (genr8 && m->text.size)
        m->text.data[m->text.size++] = ' ';
    char *to = m->text.data + m->text.size;
    if (length <= TN_COPY)
        memcpy(to, g->texts + terminal->offset, TN_COPY);
    else
        memcpy(to, g->texts + terminal->offset, length);
    m->text.size += length;
    if (genr8 && m->in_predecessor) {
        m->has_less |= terminal->kind == TN_TERMINAL_LESS;
        m->has_greater |= terminal->kind == TN_TERMINAL_GREATER;
    }
    return tn_pay_for_text(&at->steps, length) ? TN_EXPANDED : TN_EXPAND_TOO_LONG;
}

/* Nothing is kept to go back to where nothing is left to do there. */
PART keep_place(tn_mapper *m, place *at, uint32_t index, uint32_t mark, const bool genr8, const bool recorded)
{
    if (!recorded && TN_WORD_OP(*at->ip) == TN_WORD_DONE && !mark)
        return TN_EXPANDED;
    if (at->top == m->frame_capacity &&
        !tn_array_reserve(&m->frames, &m->frame_capacity, at->top, 1, sizeof *m->frames))
        return TN_EXPAND_NO_MEMORY;
    tn_mapping_frame *f = &m->frames[at->top++];
    f->ip = at->ip;
    f->depth = at->depth;
    f->mark = mark;
    f->rule = index;
    if (genr8)
        memcpy(f->ids, at->ids, sizeof at->ids);
    return TN_EXPANDED;
}

PART run_rule(tn_mapper *m, place *at, uint32_t index, const bool genr8, const bool recorded)
{
    const tn_grammar *g = m->grammar;
    uint32_t production, mark = genr8 ? g->rules[index].mark : TN_MARK_NONE;
    tn_expansion result = keep_place(m, at, index, mark, genr8, recorded);
    if (result == TN_EXPANDED)
        result = choose(m, g, index, at->depth + 1, genr8, recorded, &production);
    if (result != TN_EXPANDED)
        return result;
    const tn_production *p = &g->productions[production];
    at->ip = g->words + p->words;
    at->depth++;
    if (genr8) {
        at->ids[0] = at->ids[1] = at->ids[2] = TN_NO_EDGE_ID;
        m->nodes++;
        m->depth = at->depth > m->depth ? at->depth : m->depth;
        if (mark == TN_MARK_PREDECESSOR)
            predecessor_begins(m);
        return TN_EXPANDED;
    }
    m->nodes += p->children ? p->children : 1;
    uint32_t deepest = at->depth + (p->symbols != 0);
    m->depth = deepest > m->depth ? deepest : m->depth;
    return m->max_depth && deepest > m->max_depth ? TN_EXPAND_TOO_DEEP : TN_EXPANDED;
}

/* A production ends: back to what it was chosen in. */
PART run_done(tn_mapper *m, place *at, const bool genr8, const bool recorded)
{
    const tn_mapping_frame *f = &m->frames[--at->top];
    if (recorded && !tn_mapper_record(m, (tn_event){.kind = TN_EVENT_END,
                                                    .depth = at->depth,
                                                    .symbol = f->rule,
                                                    .read = TN_NO_READ,
                                                    .text_begin = m->text.size}))
        return TN_EXPAND_NO_MEMORY;
    at->ip = f->ip;
    at->depth = f->depth;
    if (!genr8)
        return TN_EXPANDED;
    memcpy(at->ids, f->ids, sizeof at->ids);
    return f->mark && !rewrite_rule_ends(m, f->mark) ? TN_EXPAND_NO_MEMORY : TN_EXPANDED;
}

/* `Edge`, or with a letter `EdgeX` and its like, which repeat their number within a production. */
PART run_edge(tn_mapper *m, place *at, bool variable, uint32_t index, const bool recorded)
{
    bool bound = variable && at->ids[index] != TN_NO_EDGE_ID;
    uint32_t id = bound ? at->ids[index] : TN_NO_EDGE_ID;
    char letter = variable ? (char)('X' + index) : '\0';
    if (bound && recorded &&
        !tn_mapper_record(m, (tn_event){.kind = TN_EVENT_EDGE,
                                        .letter = letter,
                                        .depth = at->depth,
                                        .read = TN_NO_READ,
                                        .value = id,
                                        .text_begin = m->text.size}))
        return TN_EXPAND_NO_MEMORY;
    tn_expansion drawn = bound ? TN_EXPANDED : draw_edge(m, &id, recorded, at->depth, letter);
    if (drawn != TN_EXPANDED)
        return drawn;
    if (variable)
        at->ids[index] = id;
    if (!edge_written(m, id) ||
        !tn_array_reserve(&m->text.data, &m->text.capacity, m->text.size, TN_EDGE_TEXT + TN_COPY, 1))
        return TN_EXPAND_NO_MEMORY;
    m->text.size = edge_write(m->text.data, m->text.size, id);
    return TN_EXPANDED;
}

/* A loop is met first, or its body has ended (TN_WORD_AGAIN). */
PART run_loop(tn_mapper *m, place *at, bool first, const bool recorded)
{
    if (first) {
        if (!tn_array_reserve(&m->frames, &m->frame_capacity, at->top, 1, sizeof *m->frames))
            return TN_EXPAND_NO_MEMORY;
        m->frames[at->top++] = (tn_mapping_frame){.ip = at->ip - 1, .rule = 0};
    }
    tn_mapping_frame *loop = &m->frames[at->top - 1];
    bool goes_on;
    tn_expansion tested = again(m, loop->rule, at->depth, recorded, &goes_on);
    if (tested != TN_EXPANDED)
        return tested;
    loop->rule += goes_on;
    at->ip = goes_on ? loop->ip + 1 : loop->ip + 1 + TN_WORD_ARGUMENT(*loop->ip);
    at->top -= !goes_on;
    return TN_EXPANDED;
}

PART run_option(tn_mapper *m, place *at, uint32_t length, const bool recorded)
{
    bool taken;
    tn_expansion tested = option(m, at->depth, recorded, &taken);
    if (tested == TN_EXPANDED && !taken)
        at->ip += length;
    return tested;
}

PART run_word(tn_mapper *m, place *at, uint32_t word, const bool genr8, const bool recorded)
{
    uint32_t argument = TN_WORD_ARGUMENT(word);
    switch (TN_WORD_OP(word)) {
    case TN_WORD_TERMINAL:
        return run_terminal(m, at, argument, genr8, recorded);
    case TN_WORD_RULE:
        return run_rule(m, at, argument, genr8, recorded);
    case TN_WORD_DONE:
        return run_done(m, at, genr8, recorded);
    case TN_WORD_EDGE:
    case TN_WORD_SAME:
        return run_edge(m, at, TN_WORD_OP(word) == TN_WORD_SAME, argument, recorded);
    case TN_WORD_REPEAT:
    case TN_WORD_AGAIN:
        return run_loop(m, at, TN_WORD_OP(word) == TN_WORD_REPEAT, recorded);
    case TN_WORD_MAYBE:
        return run_option(m, at, argument, recorded);
    }
    return TN_EXPANDED;
}

PART expand(tn_mapper *m, uint32_t start, uint32_t depth, const bool genr8, const bool recorded)
{
    const uint32_t opening[2] = {TN_WORD_RULE | start << TN_WORD_BITS, TN_WORD_DONE};
    place at = {.ip = opening,
                .steps = m->steps_left,
                .depth = depth - 1,
                .ids = {TN_NO_EDGE_ID, TN_NO_EDGE_ID, TN_NO_EDGE_ID}};
    for (;;) {
        uint32_t word = *at.ip++;
        bool done = TN_WORD_OP(word) == TN_WORD_DONE;
        if (done && at.top == 0)
            break;
        /* ends are no steps: not every form of the machine keeps a frame for each */
        if (!done && at.steps-- == 0)
            return TN_EXPAND_TOO_LONG;
        tn_expansion result = run_word(m, &at, word, genr8, recorded);
        if (result != TN_EXPANDED)
            return result;
    }
    m->steps_left = at.steps;
    return TN_EXPANDED;
}

static __attribute__((noinline)) tn_expansion expand_recorded(tn_mapper *m, uint32_t rule, uint32_t depth)
{
    return m->grammar->dialect == TN_DIALECT_GENR8 ? expand(m, rule, depth, true, true)
                                                   : expand(m, rule, depth, false, true);
}

static __attribute__((noinline)) tn_expansion expand_genr8(tn_mapper *m, uint32_t rule, uint32_t depth)
{
    return expand(m, rule, depth, true, false);
}

tn_expansion tn_mapper_expand(tn_mapper *m, uint32_t rule, uint32_t depth, bool recorded)
{
    if (recorded)
        return expand_recorded(m, rule, depth);
    return m->grammar->dialect == TN_DIALECT_GENR8 ? expand_genr8(m, rule, depth) : mapper_expand_ge(m);
}
