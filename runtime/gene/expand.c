#include "runtime/gene/mapper_edges.h"

/* `Edge`: its number is the codon mod the number of types there are, and one more: that one is new (5.1). */
static inline outcome draw_edge(tn_mapper *m, uint32_t *id, bool recorded, uint32_t depth, char letter)
{
    uint64_t codon;
    if (!read_codon(m, &codon))
        return NO_CODON;
    uint64_t modulus = (uint64_t)m->max_id + !m->frozen;
    *id = (uint32_t)(codon % modulus);
    bool is_new = *id == m->max_id;
    m->max_id += is_new;
    if (recorded && !record(m, (tn_event){.kind = TN_EVENT_EDGE,
                                          .letter = letter,
                                          .depth = depth,
                                          .symbol = is_new,
                                          .read = m->used - 1,
                                          .codon = codon,
                                          .modulus = modulus,
                                          .value = *id,
                                          .text_begin = m->text.size}))
        return NO_MEMORY;
    return RAN;
}

static bool edge_written(tn_mapper *m, uint32_t id)
{
    return mark_id(m, id, false) && (!m->in_predecessor || edge_in_predecessor(m, id));
}

/* Which production of the rule, at that depth. */
static inline outcome choose(tn_mapper *m, const tn_grammar *g, uint32_t index, uint32_t depth, bool genr8,
                             bool recorded, uint32_t *production)
{
    const tn_rule *rule = &g->rules[index];
    if (!genr8 && rule->count == 1 && g->skip_single) {
        *production = rule->first;
        return recorded && !record(m, (tn_event){.kind = TN_EVENT_EXPAND,
                                                 .depth = depth,
                                                 .symbol = index,
                                                 .production = rule->first,
                                                 .read = TN_NO_READ,
                                                 .text_begin = m->text.size})
                   ? NO_MEMORY
                   : RAN;
    }
    uint64_t codon;
    if (!read_codon(m, &codon))
        return NO_CODON;
    bool closed = genr8 && m->max_depth && depth >= m->max_depth && rule->closed_count;
    uint32_t modulus = closed ? rule->closed_count : rule->count;
    uint32_t choice = closed ? (uint32_t)(codon % modulus) : tn_codon_modulo(codon, modulus, rule->reciprocal);
    *production = closed ? g->closed[rule->closed_first + choice] : rule->first + choice;
    if (recorded && !record(m, (tn_event){.kind = TN_EVENT_EXPAND,
                                          .depth = depth,
                                          .symbol = index,
                                          .production = *production,
                                          .read = m->used - 1,
                                          .codon = codon,
                                          .modulus = modulus,
                                          .value = choice,
                                          .text_begin = m->text.size}))
        return NO_MEMORY;
    return RAN;
}

/* `{`: after `rounds` times, again if codon mod (rounds + 2) > rounds (5.1, with X = 2 and Y = 0). */
static outcome again(tn_mapper *m, uint32_t rounds, uint32_t depth, bool recorded, bool *goes_on)
{
    uint64_t codon, modulus = (uint64_t)rounds + 2;
    if (!read_codon(m, &codon))
        return NO_CODON;
    *goes_on = codon % modulus > rounds;
    if (recorded && !record(m, (tn_event){.kind = *goes_on ? TN_EVENT_AGAIN : TN_EVENT_STOP,
                                          .depth = depth,
                                          .symbol = rounds,
                                          .read = m->used - 1,
                                          .codon = codon,
                                          .modulus = modulus,
                                          .value = codon % modulus,
                                          .text_begin = m->text.size}))
        return NO_MEMORY;
    return RAN;
}

static outcome option(tn_mapper *m, uint32_t depth, bool recorded, bool *taken)
{
    uint64_t codon;
    if (!read_codon(m, &codon))
        return NO_CODON;
    *taken = codon & 1;
    if (recorded && !record(m, (tn_event){.kind = *taken ? TN_EVENT_TAKE : TN_EVENT_SKIP,
                                          .depth = depth,
                                          .read = m->used - 1,
                                          .codon = codon,
                                          .modulus = 2,
                                          .value = codon & 1,
                                          .text_begin = m->text.size}))
        return NO_MEMORY;
    return RAN;
}
/* Where the machine is. Each kind of word has a function below that moves it on; all are inlined into the loop, and the
 * two flags are constants in each caller, so that no dialect pays for the other one, nor either for recording. */
typedef struct place {
    const uint32_t *ip; /* next word */
    size_t top;         /* frames in use */
    uint32_t depth;     /* of the production that the word belongs to */
    uint32_t ids[TN_EDGE_LETTERS];
} place;

#define PART static inline __attribute__((always_inline)) outcome

PART run_terminal(tn_mapper *m, const place *at, uint32_t index, const bool genr8, const bool recorded)
{
    const tn_grammar *g = m->grammar;
    const tn_terminal *terminal = &g->terminals[index];
    size_t length = terminal->length;
    if (m->text.size + length + COPY + 1 > m->text.capacity &&
        !reserve(&m->text.data, &m->text.capacity, m->text.size, length + COPY + 1, 1))
        return NO_MEMORY;
    if (recorded && !record(m, (tn_event){.kind = TN_EVENT_TERMINAL,
                                          .depth = at->depth,
                                          .symbol = index,
                                          .read = TN_NO_READ,
                                          .text_begin = m->text.size}))
        return NO_MEMORY;
    if (genr8 && m->text.size)
        m->text.data[m->text.size++] = ' ';
    char *to = m->text.data + m->text.size;
    if (length <= COPY)
        memcpy(to, g->texts + terminal->offset, COPY);
    else
        memcpy(to, g->texts + terminal->offset, length);
    m->text.size += length;
    if (genr8 && m->in_predecessor) {
        m->has_less |= terminal->kind == TN_TERMINAL_LESS;
        m->has_greater |= terminal->kind == TN_TERMINAL_GREATER;
    }
    return RAN;
}

/* Nothing is kept to go back to where nothing is left to do there. */
PART keep_place(tn_mapper *m, place *at, uint32_t index, uint32_t mark, const bool genr8, const bool recorded)
{
    if (!recorded && TN_WORD_OP(*at->ip) == TN_WORD_DONE && !mark)
        return RAN;
    if (at->top == m->frame_capacity && !reserve(&m->frames, &m->frame_capacity, at->top, 1, sizeof *m->frames))
        return NO_MEMORY;
    frame *f = &m->frames[at->top++];
    f->ip = at->ip;
    f->depth = at->depth;
    f->mark = mark;
    f->rule = index;
    if (genr8)
        memcpy(f->ids, at->ids, sizeof at->ids);
    return RAN;
}

PART run_rule(tn_mapper *m, place *at, uint32_t index, const bool genr8, const bool recorded)
{
    const tn_grammar *g = m->grammar;
    uint32_t production, mark = genr8 ? g->rules[index].mark : TN_MARK_NONE;
    outcome result = keep_place(m, at, index, mark, genr8, recorded);
    if (result == RAN)
        result = choose(m, g, index, at->depth + 1, genr8, recorded, &production);
    if (result != RAN)
        return result;
    const tn_production *p = &g->productions[production];
    at->ip = g->words + p->words;
    at->depth++;
    if (genr8) {
        at->ids[0] = at->ids[1] = at->ids[2] = NO_ID;
        m->nodes++;
        m->depth = at->depth > m->depth ? at->depth : m->depth;
        if (mark == TN_MARK_PREDECESSOR)
            predecessor_begins(m);
        return RAN;
    }
    m->nodes += p->children ? p->children : 1;
    uint32_t deepest = at->depth + (p->symbols != 0);
    m->depth = deepest > m->depth ? deepest : m->depth;
    return m->max_depth && deepest > m->max_depth ? TOO_DEEP : RAN;
}

/* A production ends: back to what it was chosen in. */
PART run_done(tn_mapper *m, place *at, const bool genr8, const bool recorded)
{
    const frame *f = &m->frames[--at->top];
    if (recorded && !record(m, (tn_event){.kind = TN_EVENT_END,
                                          .depth = at->depth,
                                          .symbol = f->rule,
                                          .read = TN_NO_READ,
                                          .text_begin = m->text.size}))
        return NO_MEMORY;
    at->ip = f->ip;
    at->depth = f->depth;
    if (!genr8)
        return RAN;
    memcpy(at->ids, f->ids, sizeof at->ids);
    return f->mark && !rule_ends(m, f->mark) ? NO_MEMORY : RAN;
}

/* `Edge`, or with a letter `EdgeX` and its like, which repeat their number within a production. */
PART run_edge(tn_mapper *m, place *at, bool variable, uint32_t index, const bool recorded)
{
    bool bound = variable && at->ids[index] != NO_ID;
    uint32_t id = bound ? at->ids[index] : NO_ID;
    char letter = variable ? (char)('X' + index) : '\0';
    if (bound && recorded &&
        !record(m, (tn_event){.kind = TN_EVENT_EDGE,
                              .letter = letter,
                              .depth = at->depth,
                              .read = TN_NO_READ,
                              .value = id,
                              .text_begin = m->text.size}))
        return NO_MEMORY;
    outcome drawn = bound ? RAN : draw_edge(m, &id, recorded, at->depth, letter);
    if (drawn != RAN)
        return drawn;
    if (variable)
        at->ids[index] = id;
    if (!edge_written(m, id) || !reserve(&m->text.data, &m->text.capacity, m->text.size, EDGE_TEXT + COPY, 1))
        return NO_MEMORY;
    m->text.size = write_edge(m->text.data, m->text.size, id);
    return RAN;
}

/* A loop is met first, or its body has ended (TN_WORD_AGAIN). */
PART run_loop(tn_mapper *m, place *at, bool first, const bool recorded)
{
    if (first) {
        if (!reserve(&m->frames, &m->frame_capacity, at->top, 1, sizeof *m->frames))
            return NO_MEMORY;
        m->frames[at->top++] = (frame){.ip = at->ip - 1, .rule = 0};
    }
    frame *loop = &m->frames[at->top - 1];
    bool goes_on;
    outcome tested = again(m, loop->rule, at->depth, recorded, &goes_on);
    if (tested != RAN)
        return tested;
    loop->rule += goes_on;
    at->ip = goes_on ? loop->ip + 1 : loop->ip + 1 + TN_WORD_ARGUMENT(*loop->ip);
    at->top -= !goes_on;
    return RAN;
}

PART run_option(tn_mapper *m, place *at, uint32_t length, const bool recorded)
{
    bool taken;
    outcome tested = option(m, at->depth, recorded, &taken);
    if (tested == RAN && !taken)
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
    return RAN;
}

PART expand(tn_mapper *m, uint32_t start, uint32_t depth, const bool genr8, const bool recorded)
{
    const uint32_t opening[2] = {TN_WORD_RULE | start << TN_WORD_BITS, TN_WORD_DONE};
    place at = {.ip = opening, .depth = depth - 1, .ids = {NO_ID, NO_ID, NO_ID}};
    uint64_t steps = m->steps_left;
    for (;;) {
        if (steps-- == 0)
            return TOO_LONG;
        uint32_t word = *at.ip++;
        if (TN_WORD_OP(word) == TN_WORD_DONE && at.top == 0)
            break;
        outcome result = run_word(m, &at, word, genr8, recorded);
        if (result != RAN)
            return result;
    }
    m->steps_left = steps;
    return RAN;
}

static __attribute__((noinline)) outcome expand_recorded(tn_mapper *m, uint32_t rule, uint32_t depth)
{
    return m->grammar->dialect == TN_DIALECT_GENR8 ? expand(m, rule, depth, true, true)
                                                   : expand(m, rule, depth, false, true);
}

static __attribute__((noinline)) outcome expand_genr8(tn_mapper *m, uint32_t rule, uint32_t depth)
{
    return expand(m, rule, depth, true, false);
}

outcome tn_mapper_expand(tn_mapper *m, uint32_t rule, uint32_t depth, bool recorded)
{
    if (recorded)
        return expand_recorded(m, rule, depth);
    return m->grammar->dialect == TN_DIALECT_GENR8 ? expand_genr8(m, rule, depth) : tn_mapper_expand_ge(m);
}
