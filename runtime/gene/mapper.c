#include "runtime/gene/mapper.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FIRST_IDS 2u    /* edge types that there are to begin with: Edge0 and Edge1 (5.2) */
#define REPAIR_DEPTH 3u /* of a repairing rule's successor: below the start symbol and a rewrite rule */
#define NO_ID UINT32_MAX
#define COPY 16u      /* short terminals are copied by this many bytes at once */
#define EDGE_TEXT 16u /* "Edge" and ten digits, at most */

/* What to go back to: a production after one of its non-terminals, or a loop. */
typedef struct frame {
    const uint32_t *ip; /* next word; of a loop: its first */
    uint32_t depth;
    uint32_t rule; /* that ends when this frame is popped (recording), of a loop: rounds so far */
    uint32_t ids[TN_EDGE_LETTERS];
    uint32_t mark; /* tn_rule_mark of the rule that ends when this frame is popped */
} frame;

typedef struct writing {
    char *data;
    size_t size, capacity;
} writing;

struct tn_mapper {
    const tn_grammar *grammar;
    frame *frames;
    size_t frame_capacity;
    writing text, added, repaired;
    tn_event *events;
    size_t event_count, event_capacity;
    /* genr8: edge types by number: does it occur, is there a rule for it */
    uint8_t *seen, *ruled;
    size_t id_capacity;
    uint32_t *repaired_ids;
    size_t repaired_count, repaired_capacity;
    /* the predecessor being written: its edges, and which context signs it has */
    uint32_t *predecessor;
    size_t predecessor_count, predecessor_capacity;
    bool in_predecessor, has_less, has_greater;
    size_t rule_end; /* where in the text the last rewrite rule ends */
    /* the genome, and how it is read */
    const uint64_t *codons;
    size_t count, position;
    uint64_t used, readable, steps_left;
    uint64_t nodes;
    uint32_t depth, max_depth, max_id;
    bool frozen; /* while repairing: no new edge types */
};

typedef enum outcome { RAN, NO_CODON, TOO_DEEP, TOO_LONG, NO_MEMORY } outcome;

tn_map_options tn_map_options_of(const tn_grammar *grammar)
{
    return (tn_map_options){.wraps = grammar->wraps, .max_depth = grammar->max_depth, .repair = grammar->repair};
}

const char *tn_map_reason_text(tn_map_reason reason)
{
    static const char *const texts[TN_MAP_REASON_COUNT] = {
        "", "out of codons", "too deep", "too long", "out of codons while repairing", "too long while repairing"};
    return texts[reason];
}

tn_mapper *tn_mapper_new(const tn_grammar *grammar)
{
    tn_mapper *mapper = calloc(1, sizeof *mapper);
    if (mapper)
        mapper->grammar = grammar;
    return mapper;
}

void tn_mapper_free(tn_mapper *mapper)
{
    if (!mapper)
        return;
    free(mapper->frames);
    free(mapper->text.data);
    free(mapper->added.data);
    free(mapper->repaired.data);
    free(mapper->events);
    free(mapper->seen);
    free(mapper->ruled);
    free(mapper->repaired_ids);
    free(mapper->predecessor);
    free(mapper);
}

/* Room for `more` items of `size` bytes after the first `used`, doubling. */
static bool reserve(void *items, size_t *capacity, size_t used, size_t more, size_t size)
{
    if (used + more <= *capacity)
        return true;
    size_t wanted = *capacity ? *capacity * 2 : 64;
    while (wanted < used + more)
        wanted *= 2;
    void *memory; /* `items` points to a pointer of any type */
    memcpy(&memory, items, sizeof memory);
    memory = realloc(memory, wanted * size);
    if (!memory)
        return false;
    memcpy(items, &memory, sizeof memory);
    *capacity = wanted;
    return true;
}

static bool append(writing *text, const char *data, size_t size)
{
    if (!reserve(&text->data, &text->capacity, text->size, size + 1, 1))
        return false;
    memcpy(text->data + text->size, data, size);
    text->size += size;
    text->data[text->size] = '\0';
    return true;
}

/* ---- edge types */

static bool mark_id(tn_mapper *m, uint32_t id, bool ruled)
{
    size_t old = m->id_capacity, capacity = old;
    if (id >= old) {
        if (!reserve(&m->seen, &capacity, id, 1, 1))
            return false;
        size_t other = old;
        if (!reserve(&m->ruled, &other, id, 1, 1))
            return false;
        memset(m->seen + old, 0, capacity - old);
        memset(m->ruled + old, 0, capacity - old);
        m->id_capacity = capacity;
    }
    (ruled ? m->ruled : m->seen)[id] = 1;
    return true;
}

static bool edge_in_predecessor(tn_mapper *m, uint32_t id)
{
    if (!reserve(&m->predecessor, &m->predecessor_capacity, m->predecessor_count, 1, sizeof *m->predecessor))
        return false;
    m->predecessor[m->predecessor_count++] = id;
    return true;
}

static void predecessor_begins(tn_mapper *m)
{
    m->in_predecessor = true;
    m->has_less = m->has_greater = false;
    m->predecessor_count = 0;
}

/* The edges that a predecessor rewrites, its contexts left out (4.5): A in `A > B`, B in `A < B` and in `A < B > C`,
 * all without. */
static bool predecessor_ends(tn_mapper *m)
{
    size_t from = m->has_less ? 1 : 0;
    size_t to = m->has_less || m->has_greater ? from + 1 : m->predecessor_count;
    m->in_predecessor = false;
    for (size_t i = from; i < to && i < m->predecessor_count; i++)
        if (!mark_id(m, m->predecessor[i], true))
            return false;
    return true;
}

static bool rule_ends(tn_mapper *m, uint32_t mark)
{
    if (mark == TN_MARK_PREDECESSOR)
        return predecessor_ends(m);
    m->rule_end = m->text.size;
    return true;
}

/* Writes the digits of `value` before `end`; returns the first. */
static char *digits(uint32_t value, char *end)
{
    do
        *--end = (char)('0' + value % 10);
    while (value /= 10);
    return end;
}

/* Room for an edge is the caller's to have made. */
static size_t write_edge(char *text, size_t size, uint32_t id)
{
    char number[10], *end = number + sizeof number, *start = digits(id, end);
    if (size)
        text[size++] = ' ';
    memcpy(text + size, "Edge", 4);
    memcpy(text + size + 4, start, (size_t)(end - start));
    return size + 4 + (size_t)(end - start);
}

/* ---- the derivation's record */

static bool record(tn_mapper *m, tn_event event)
{
    if (!reserve(&m->events, &m->event_capacity, m->event_count, 1, sizeof *m->events))
        return false;
    m->events[m->event_count++] = event;
    return true;
}

/* ---- the machine */

static inline bool read_codon(tn_mapper *m, uint64_t *codon)
{
    if (m->used >= m->readable)
        return false;
    if (m->position == m->count)
        m->position = 0;
    *codon = m->codons[m->position++];
    m->used++;
    return true;
}

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

/* Expands the rule `start` at `depth` to the end of the text. The two flags are constants in each caller, so that no
 * dialect pays for the other one, nor either for recording. */
static inline __attribute__((always_inline)) outcome expand(tn_mapper *m, uint32_t start, uint32_t depth,
                                                            const bool genr8, const bool recorded)
{
    const tn_grammar *g = m->grammar;
    const uint32_t opening[2] = {TN_WORD_RULE | start << TN_WORD_BITS, TN_WORD_DONE};
    const uint32_t *ip = opening;
    uint32_t ids[TN_EDGE_LETTERS] = {NO_ID, NO_ID, NO_ID};
    uint64_t steps = m->steps_left;
    size_t top = 0;
    depth--; /* that of the production which holds the start symbol */
    for (;;) {
        if (steps-- == 0)
            return TOO_LONG;
        uint32_t word = *ip++, argument = TN_WORD_ARGUMENT(word);
        switch (TN_WORD_OP(word)) {
        case TN_WORD_TERMINAL: {
            const tn_terminal *terminal = &g->terminals[argument];
            size_t length = terminal->length;
            if (m->text.size + length + COPY + 1 > m->text.capacity &&
                !reserve(&m->text.data, &m->text.capacity, m->text.size, length + COPY + 1, 1))
                return NO_MEMORY;
            if (recorded && !record(m, (tn_event){.kind = TN_EVENT_TERMINAL,
                                                  .depth = depth,
                                                  .symbol = argument,
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
            break;
        }
        case TN_WORD_RULE: {
            uint32_t production, child = depth + 1, mark = genr8 ? g->rules[argument].mark : TN_MARK_NONE;
            if (recorded || TN_WORD_OP(*ip) != TN_WORD_DONE || mark) {
                if (top == m->frame_capacity && !reserve(&m->frames, &m->frame_capacity, top, 1, sizeof *m->frames))
                    return NO_MEMORY;
                frame *f = &m->frames[top++];
                f->ip = ip;
                f->depth = depth;
                f->mark = mark;
                f->rule = argument;
                if (genr8)
                    memcpy(f->ids, ids, sizeof ids);
            }
            outcome chosen = choose(m, g, argument, child, genr8, recorded, &production);
            if (chosen != RAN)
                return chosen;
            const tn_production *p = &g->productions[production];
            ip = g->words + p->words;
            depth = child;
            if (genr8) {
                ids[0] = ids[1] = ids[2] = NO_ID;
                m->nodes++;
                m->depth = depth > m->depth ? depth : m->depth;
                if (mark == TN_MARK_PREDECESSOR)
                    predecessor_begins(m);
            } else {
                m->nodes += p->children ? p->children : 1;
                uint32_t deepest = depth + (p->symbols != 0);
                m->depth = deepest > m->depth ? deepest : m->depth;
                if (m->max_depth && deepest > m->max_depth)
                    return TOO_DEEP;
            }
            break;
        }
        case TN_WORD_DONE: {
            if (top == 0) {
                m->steps_left = steps;
                return RAN;
            }
            const frame *f = &m->frames[--top];
            if (recorded && !record(m, (tn_event){.kind = TN_EVENT_END,
                                                  .depth = depth,
                                                  .symbol = f->rule,
                                                  .read = TN_NO_READ,
                                                  .text_begin = m->text.size}))
                return NO_MEMORY;
            ip = f->ip;
            depth = f->depth;
            if (genr8) {
                memcpy(ids, f->ids, sizeof ids);
                if (f->mark && !rule_ends(m, f->mark))
                    return NO_MEMORY;
            }
            break;
        }
        case TN_WORD_EDGE:
        case TN_WORD_SAME: {
            bool variable = TN_WORD_OP(word) == TN_WORD_SAME, bound = variable && ids[argument] != NO_ID;
            uint32_t id = bound ? ids[argument] : NO_ID;
            char letter = variable ? (char)('X' + argument) : '\0';
            if (bound && recorded &&
                !record(m, (tn_event){.kind = TN_EVENT_EDGE,
                                      .letter = letter,
                                      .depth = depth,
                                      .read = TN_NO_READ,
                                      .value = id,
                                      .text_begin = m->text.size}))
                return NO_MEMORY;
            outcome drawn = bound ? RAN : draw_edge(m, &id, recorded, depth, letter);
            if (drawn != RAN)
                return drawn;
            if (variable)
                ids[argument] = id;
            if (!edge_written(m, id) || !reserve(&m->text.data, &m->text.capacity, m->text.size, EDGE_TEXT + COPY, 1))
                return NO_MEMORY;
            m->text.size = write_edge(m->text.data, m->text.size, id);
            break;
        }
        case TN_WORD_REPEAT:
            if (!reserve(&m->frames, &m->frame_capacity, top, 1, sizeof *m->frames))
                return NO_MEMORY;
            m->frames[top++] = (frame){.ip = ip - 1, .rule = 0};
            __attribute__((fallthrough));
        case TN_WORD_AGAIN: {
            frame *loop = &m->frames[top - 1];
            bool goes_on;
            outcome tested = again(m, loop->rule, depth, recorded, &goes_on);
            if (tested != RAN)
                return tested;
            loop->rule += goes_on;
            ip = goes_on ? loop->ip + 1 : loop->ip + 1 + TN_WORD_ARGUMENT(*loop->ip);
            top -= !goes_on;
            break;
        }
        case TN_WORD_MAYBE: {
            bool taken;
            outcome tested = option(m, depth, recorded, &taken);
            if (tested != RAN)
                return tested;
            if (!taken)
                ip += argument;
            break;
        }
        }
    }
}

/* Room for a terminal behind `size` bytes of text. Kept out of the loop, whose variables then can stay in registers. */
static __attribute__((noinline)) bool make_room(tn_mapper *m, size_t size, size_t length)
{
    return reserve(&m->text.data, &m->text.capacity, size, length + COPY + 1, 1);
}

static __attribute__((noinline)) bool make_frame(tn_mapper *m, size_t top)
{
    return reserve(&m->frames, &m->frame_capacity, top, 1, sizeof *m->frames);
}

/* What expand(m, 0, 1, false, false) does, from local variables: the ge dialect, nothing recorded. */
static outcome expand_ge(tn_mapper *m)
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

static __attribute__((noinline)) outcome expand_recorded(tn_mapper *m, uint32_t rule, uint32_t depth)
{
    return m->grammar->dialect == TN_DIALECT_GENR8 ? expand(m, rule, depth, true, true)
                                                   : expand(m, rule, depth, false, true);
}

static __attribute__((noinline)) outcome expand_genr8(tn_mapper *m, uint32_t rule, uint32_t depth)
{
    return expand(m, rule, depth, true, false);
}

static outcome derive(tn_mapper *m, uint32_t rule, uint32_t depth, bool recorded)
{
    if (recorded)
        return expand_recorded(m, rule, depth);
    return m->grammar->dialect == TN_DIALECT_GENR8 ? expand_genr8(m, rule, depth) : expand_ge(m);
}

/* ---- repair: every edge type that occurs gets a rule (5.1) */

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
    return derive(m, m->grammar->successor, REPAIR_DEPTH, options->record);
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

static outcome repair(tn_mapper *m, const tn_map_options *options)
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

/* ---- one mapping */

static void start(tn_mapper *m, const uint64_t *codons, size_t count, const tn_map_options *options)
{
    m->codons = codons;
    m->count = count;
    m->position = 0;
    m->used = 0;
    if (__builtin_mul_overflow((uint64_t)count, (uint64_t)options->wraps + 1, &m->readable))
        m->readable = UINT64_MAX;
    m->steps_left = options->max_steps ? options->max_steps : TN_MAP_STEPS;
    m->max_depth = options->max_depth;
    m->nodes = m->grammar->dialect == TN_DIALECT_GE ? 1 : 0;
    m->depth = 1;
    m->max_id = FIRST_IDS;
    m->frozen = m->in_predecessor = false;
    m->text.size = 0;
    m->event_count = 0;
    m->rule_end = SIZE_MAX;
    if (m->id_capacity) {
        memset(m->seen, 0, m->id_capacity);
        memset(m->ruled, 0, m->id_capacity);
    }
}

static tn_map_reason reason_for(outcome result, bool repairing)
{
    switch (result) {
    case RAN:
    case NO_MEMORY:
        return TN_MAP_VALID;
    case NO_CODON:
        return repairing ? TN_MAP_REPAIR_OUT_OF_CODONS : TN_MAP_OUT_OF_CODONS;
    case TOO_DEEP:
        return TN_MAP_TOO_DEEP;
    case TOO_LONG:
        return repairing ? TN_MAP_REPAIR_TOO_LONG : TN_MAP_TOO_LONG;
    }
    return TN_MAP_VALID;
}

static void describe(const tn_mapper *m, tn_mapping *mapping)
{
    mapping->has_phenotype = true;
    mapping->phenotype_size = m->text.size;
    mapping->used = m->used;
    mapping->nodes = m->nodes;
    mapping->depth = m->depth;
    mapping->wraps = m->used ? (m->used - 1) / m->count : 0;
    mapping->max_id = m->max_id;
}

tn_status tn_map_genome(tn_mapper *m, const uint64_t *codons, size_t count, const tn_map_options *options,
                        tn_mapping *mapping, tn_error *error)
{
    bool genr8 = m->grammar->dialect == TN_DIALECT_GENR8, repairing = false;
    memset(mapping, 0, sizeof *mapping);
    start(m, codons, count, options);
    outcome result = options->record || genr8 ? derive(m, 0, 1, options->record) : expand_ge(m);
    if (result == RAN && !reserve(&m->text.data, &m->text.capacity, m->text.size, 1, 1))
        result = NO_MEMORY;
    if (result == RAN) {
        m->text.data[m->text.size] = '\0';
        describe(m, mapping);
        repairing = genr8 && options->repair != TN_REPAIR_OFF && m->grammar->successor != TN_NO_RECORD;
        if (repairing)
            result = repair(m, options);
    }
    if (result == NO_MEMORY)
        return tn_fail_memory(error);
    mapping->reason = reason_for(result, repairing);
    mapping->valid = result == RAN;
    mapping->phenotype = mapping->has_phenotype ? m->text.data : "";
    if (repairing && mapping->valid) {
        mapping->repaired = true;
        mapping->repaired_phenotype = m->repaired.data;
        mapping->repaired_size = m->repaired.size;
        mapping->repaired_used = m->used;
        mapping->repaired_ids = m->repaired_ids;
        mapping->repaired_count = m->repaired_count;
    }
    mapping->events = m->events;
    mapping->event_count = m->event_count;
    return TN_OK;
}
