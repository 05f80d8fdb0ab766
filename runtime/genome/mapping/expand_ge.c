/* The loop that a run of evolution spends its time of mapping in. What changes lives in a struct that is never anywhere
 * but in registers, what does not is copied to another: a byte written to the text could, for all the compiler knows,
 * change what pointers lead to. */
#include "runtime/genome/mapping/mapper_state.h"

#define PART static inline __attribute__((always_inline))

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

PART tn_expansion run_terminal(tn_mapper *m, const ge_tables *t, ge_run *r, uint32_t index)
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

PART tn_expansion run_rule(tn_mapper *m, const ge_tables *t, ge_run *r, uint32_t index)
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

PART tn_expansion run(tn_mapper *m, const ge_tables *t, ge_run *r)
{
    for (;;) {
        const uint32_t word = *r->ip++, argument = TN_WORD_ARGUMENT(word);
        tn_expansion result = TN_EXPANDED;
        if (TN_WORD_OP(word) == TN_WORD_TERMINAL) {
            result = run_terminal(m, t, r, argument);
        } else if (TN_WORD_OP(word) == TN_WORD_RULE) {
            result = run_rule(m, t, r, argument);
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

tn_expansion tn_mapper_expand_ge(tn_mapper *m)
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
    tn_expansion result = run(m, &t, &r);
    m->text.size = r.size;
    m->used = m->readable - r.left;
    m->nodes = r.nodes;
    m->depth = r.deepest;
    return result;
}
