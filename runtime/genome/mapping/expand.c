/* Expands one symbol of a grammar: reads a codon at each choice and writes terminals. */
#include "runtime/genome/mapping/mapper_edges.h"

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
    return tn_edge_mark(m, id, false) && (!m->in_predecessor || tn_edge_in_predecessor(m, id));
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
            tn_predecessor_begins(m);
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
    return f->mark && !tn_rewrite_rule_ends(m, f->mark) ? TN_EXPAND_NO_MEMORY : TN_EXPANDED;
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
    m->text.size = tn_edge_write(m->text.data, m->text.size, id);
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
    return m->grammar->dialect == TN_DIALECT_GENR8 ? expand_genr8(m, rule, depth) : tn_mapper_expand_ge(m);
}
