#include "runtime/gene/mapper_state.h"

/* Room for a terminal behind `size` bytes of text. Kept out of the loop, whose variables then can stay in registers. */
static __attribute__((noinline)) bool make_room(tn_mapper *m, size_t size, size_t length)
{
    return reserve(&m->text.data, &m->text.capacity, size, length + COPY + 1, 1);
}

static __attribute__((noinline)) bool make_frame(tn_mapper *m, size_t top)
{
    return reserve(&m->frames, &m->frame_capacity, top, 1, sizeof *m->frames);
}

/* From local variables, in one piece: this loop is what a run of evolution spends its time of mapping in. */
outcome tn_mapper_expand_ge(tn_mapper *m)
{
    const tn_grammar *g = m->grammar;
    const uint32_t opening[2] = {TN_WORD_RULE, TN_WORD_DONE};
    const uint32_t *ip = opening;
    const uint64_t *codon = m->codons, *const end = m->codons + m->count;
    /* copies: a byte written to the text could, for all the compiler knows, change what pointers lead to */
    const tn_rule *const rules = g->rules;
    const tn_production *const productions = g->productions;
    const uint32_t *const words = g->words;
    const tn_terminal *const terminals = g->terminals;
    const char *const texts = g->texts;
    const uint64_t *const codons = m->codons;
    char *data = m->text.data;
    size_t capacity = m->text.capacity;
    const bool skip_single = g->skip_single;
    const uint32_t max_depth = m->max_depth ? m->max_depth : UINT32_MAX;
    uint64_t readable = m->readable, left = readable, steps = m->steps_left, nodes = 1;
    uint32_t depth = 0, deepest = 1;
    size_t top = 0, size = 0;
    outcome result = RAN;
    for (;;) {
        if (steps-- == 0) {
            result = TOO_LONG;
            break;
        }
        const uint32_t word = *ip++, argument = TN_WORD_ARGUMENT(word);
        if (TN_WORD_OP(word) == TN_WORD_TERMINAL) {
            const tn_terminal *terminal = &terminals[argument];
            const size_t length = terminal->length;
            if (size + length + COPY + 1 > capacity) {
                if (!make_room(m, size, length))
                    return NO_MEMORY;
                data = m->text.data;
                capacity = m->text.capacity;
            }
            char *to = data + size;
            const char *from = texts + terminal->offset;
            if (length <= COPY)
                memcpy(to, from, COPY);
            else
                memcpy(to, from, length);
            size += length;
        } else if (TN_WORD_OP(word) == TN_WORD_RULE) {
            const tn_rule *rule = &rules[argument];
            if (TN_WORD_OP(*ip) != TN_WORD_DONE) {
                if (top == m->frame_capacity && !make_frame(m, top))
                    return NO_MEMORY;
                m->frames[top].ip = ip;
                m->frames[top++].depth = depth;
            }
            uint32_t choice = 0;
            if (rule->count > 1 || !skip_single) {
                if (left-- == 0) {
                    left = 0;
                    result = NO_CODON;
                    break;
                }
                codon = codon == end ? codons : codon;
                choice = tn_codon_modulo(*codon++, rule->count, rule->reciprocal);
            }
            const tn_production *production = &productions[rule->first + choice];
            ip = words + production->words;
            depth++;
            nodes += production->children ? production->children : 1;
            const uint32_t level = depth + (production->symbols != 0);
            deepest = level > deepest ? level : deepest;
            if (level > max_depth) {
                result = TOO_DEEP;
                break;
            }
        } else if (top == 0) {
            break;
        } else {
            ip = m->frames[--top].ip;
            depth = m->frames[top].depth;
        }
    }
    m->text.size = size;
    m->used = readable - left;
    m->nodes = nodes;
    m->depth = deepest;
    return result;
}
