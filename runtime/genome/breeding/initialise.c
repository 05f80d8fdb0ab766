/* Makes first populations. */
#include "runtime/genome/breeding/vary.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/genome/mapping/genome.h"
#include "runtime/genome/mapping/mapper.h"

#define NODES_MAX 100000u /* of one tree: loops and wide productions can make more than a depth limit bounds */

/* A node's expansion is a list of steps: a codon of its own, or a child. */
typedef struct step {
    bool is_child;
    uint64_t value; /* the codon, or the child's node */
} step;

typedef struct node {
    uint32_t rule, depth;
    bool reaches; /* may a branch from here get as deep as one must? */
    size_t steps, steps_end;
} node;

typedef struct planter {
    const tn_grammar *grammar;
    const tn_analysis *analysis;
    const tn_tree_options *options;
    tn_chance *chance;
    node *nodes;
    size_t node_count, node_capacity;
    step *steps;
    size_t step_count, step_capacity;
    uint32_t *pending; /* nodes to be expanded */
    size_t pending_count, pending_capacity;
    size_t reaching;  /* how many of them can get as deep as a branch must */
    uint32_t deepest; /* level reached so far, terminals counted where the dialect counts them */
    bool failed;
} planter;

static bool room(planter *p, void *items, size_t *capacity, size_t count, size_t size)
{
    bool fine = tn_array_reserve(items, capacity, count, 1, size);
    p->failed |= !fine;
    return fine;
}

void tn_random_codons(tn_chance *chance, uint64_t codon_limit, uint64_t *codons, size_t count)
{
    for (size_t i = 0; i < count; i++)
        codons[i] = codon_limit ? tn_chance_below(chance, codon_limit) : tn_chance_next(chance);
}

static uint64_t codon(planter *p)
{
    uint64_t value;
    tn_random_codons(p->chance, p->options->codon_limit, &value, 1);
    return value;
}

static void add_step(planter *p, bool is_child, uint64_t value)
{
    if (room(p, &p->steps, &p->step_capacity, p->step_count, sizeof *p->steps))
        p->steps[p->step_count++] = (step){is_child, value};
}

/* Until a branch is as deep as one must be, some pending node can still reach that depth: the last such node chooses a
 * production that keeps it so (find_way). */
static bool is_deep_enough(const planter *p)
{
    return p->deepest >= p->options->least;
}

static bool can_reach(const planter *p, uint32_t rule, uint32_t depth)
{
    const tn_tree_options *o = p->options;
    return o->least && depth <= o->depth &&
           tn_depths_within(o->depths, rule, o->least > depth ? o->least - depth + 1 : 1, o->depth - depth + 1);
}

static void add_child(planter *p, uint32_t rule, uint32_t depth)
{
    uint32_t level = p->grammar->dialect == TN_DIALECT_GE ? depth + 1 : depth;
    if (!room(p, &p->nodes, &p->node_capacity, p->node_count, sizeof *p->nodes) ||
        !room(p, &p->pending, &p->pending_capacity, p->pending_count, sizeof *p->pending))
        return;
    p->deepest = level > p->deepest ? level : p->deepest;
    p->nodes[p->node_count] = (node){rule, depth, !is_deep_enough(p) && can_reach(p, rule, depth), 0, 0};
    p->pending[p->pending_count++] = (uint32_t)p->node_count;
    p->reaching += p->nodes[p->node_count].reaches;
    add_step(p, true, p->node_count++);
}

/* ---- choosing a production that fits */

static bool fits(const planter *p, uint32_t production, uint32_t depth)
{
    uint32_t needed = p->analysis->production_depth[production];
    return needed != TN_DEPTH_ENDLESS && needed - 1 <= p->options->depth && depth <= p->options->depth - (needed - 1) &&
           tn_can_choose(p->grammar, production, depth, p->options->max_depth);
}

/* The shallowest production that can be chosen there: for where none fits. */
static uint32_t shallowest(const planter *p, uint32_t rule, uint32_t depth)
{
    const tn_rule *r = &p->grammar->rules[rule];
    uint32_t best = TN_NO_RECORD;
    for (uint32_t i = r->first; i < r->first + r->count; i++)
        if ((best == TN_NO_RECORD || p->analysis->production_depth[i] < p->analysis->production_depth[best]) &&
            tn_can_choose(p->grammar, i, depth, p->options->max_depth))
            best = i;
    return best;
}

/* May the words [at, end) be written at this depth? */
static bool body_fits(const planter *p, uint32_t at, uint32_t end, uint32_t depth)
{
    const tn_grammar *g = p->grammar;
    if (p->node_count >= NODES_MAX)
        return false;
    for (; at < end; at++) {
        if (TN_WORD_OP(g->words[at]) != TN_WORD_RULE)
            continue;
        uint32_t needed = p->analysis->rule_depth[TN_WORD_ARGUMENT(g->words[at])];
        if (needed == TN_DEPTH_ENDLESS || depth + needed > p->options->depth)
            return false;
    }
    return true;
}

/* The word of a non-terminal by which the production gets as deep as a branch must, one that is written in any case
 * where there is one; TN_NO_RECORD if there is none. */
static uint32_t find_way(const planter *p, uint32_t production, uint32_t depth)
{
    const tn_grammar *g = p->grammar;
    uint32_t found = TN_NO_RECORD, closed = 0, group = 0; /* ends of a group that cannot be written, and of any group */
    for (uint32_t at = g->productions[production].words; TN_WORD_OP(g->words[at]) != TN_WORD_DONE; at++) {
        tn_word_op op = TN_WORD_OP(g->words[at]);
        uint32_t argument = TN_WORD_ARGUMENT(g->words[at]), end = at + 1 + argument;
        if (op == TN_WORD_REPEAT || op == TN_WORD_MAYBE) {
            group = end > group ? end : group;
            if (at >= closed && !body_fits(p, at + 1, end, depth))
                closed = end;
        } else if (op == TN_WORD_RULE && at >= closed && can_reach(p, argument, depth + 1)) {
            if (at >= group)
                return at;
            found = found == TN_NO_RECORD ? at : found;
        }
    }
    return found;
}

/* What is asked of a production besides that it fits. */
typedef enum demand {
    WAY = 1,       /* that a branch can get deep enough by it */
    RECURSION = 2, /* that it leads back to its rule */
} demand;

static bool meets(const planter *p, uint32_t production, uint32_t depth, unsigned demands)
{
    return fits(p, production, depth) && (!(demands & RECURSION) || p->analysis->endless[production]) &&
           (!(demands & WAY) || find_way(p, production, depth) != TN_NO_RECORD);
}

/* One of the productions that meet the demands, each as likely; TN_NO_RECORD if there is none. */
static uint32_t draw(planter *p, uint32_t rule, uint32_t depth, unsigned demands)
{
    const tn_rule *r = &p->grammar->rules[rule];
    uint64_t count = 0;
    for (uint32_t i = r->first; i < r->first + r->count; i++)
        count += meets(p, i, depth, demands);
    if (!count)
        return TN_NO_RECORD;
    uint64_t chosen = tn_chance_below(p->chance, count);
    for (uint32_t i = r->first;; i++)
        if (meets(p, i, depth, demands) && chosen-- == 0)
            return i;
}

/* Where not all that is asked can be had, getting deep enough comes first. */
static uint32_t choose(planter *p, uint32_t rule, uint32_t depth, unsigned demands)
{
    const unsigned tries[] = {demands, demands & WAY, 0};
    uint32_t found = TN_NO_RECORD;
    for (size_t i = 0; i < sizeof tries / sizeof *tries && found == TN_NO_RECORD; i++)
        if (i == 0 || tries[i] != tries[i - 1])
            found = draw(p, rule, depth, tries[i]);
    return found == TN_NO_RECORD ? shallowest(p, rule, depth) : found;
}

/* ---- expanding it: its loops and options are decided at once */

typedef struct open_loop {
    uint32_t at, rounds;
} open_loop;

static void expand(planter *p, uint32_t index)
{
    const tn_grammar *g = p->grammar;
    uint32_t rule = p->nodes[index].rule, depth = p->nodes[index].depth;
    bool last = p->nodes[index].reaches && p->reaching == 0 && !is_deep_enough(p);
    uint32_t production =
        choose(p, rule, depth, (last ? WAY : 0) | (p->options->method == TN_TREE_FULL ? RECURSION : 0));
    uint32_t way = last ? find_way(p, production, depth) : TN_NO_RECORD;
    open_loop loops[TN_GROUP_DEPTH];
    size_t open = 0;
    bool bound[TN_EDGE_LETTERS] = {false};
    p->nodes[index].steps = p->step_count;
    if (g->dialect == TN_DIALECT_GENR8 || g->rules[rule].count > 1 || !g->skip_single) {
        uint64_t choice = codon(p);
        tn_choice_codon(g, production, depth, p->options->max_depth, &choice);
        add_step(p, false, choice);
    }
    for (uint32_t at = g->productions[production].words; TN_WORD_OP(g->words[at]) != TN_WORD_DONE && !p->failed;) {
        uint32_t word = g->words[at], argument = TN_WORD_ARGUMENT(word);
        uint64_t value;
        switch (TN_WORD_OP(word)) {
        case TN_WORD_RULE:
            add_child(p, argument, depth + 1);
            break;
        case TN_WORD_SAME:
            if (!bound[argument])
                add_step(p, false, codon(p));
            bound[argument] = true;
            break;
        case TN_WORD_EDGE:
            add_step(p, false, codon(p));
            break;
        case TN_WORD_REPEAT:
            loops[open++] = (open_loop){at, 0};
            __attribute__((fallthrough));
        case TN_WORD_AGAIN: {
            open_loop *loop = &loops[open - 1];
            uint64_t modulus = (uint64_t)loop->rounds + 2;
            uint32_t end = loop->at + TN_WORD_ARGUMENT(g->words[loop->at]);
            value = codon(p);
            if (!body_fits(p, loop->at + 1, end, depth))
                value -= value % modulus;
            else if (loop->rounds == 0 && way > loop->at && way < end)
                value |= 1; /* modulus 2: the loop is entered */
            add_step(p, false, value);
            bool goes_on = value % modulus > loop->rounds;
            at = goes_on ? loop->at : end;
            loop->rounds += goes_on;
            open -= !goes_on;
            break;
        }
        case TN_WORD_MAYBE:
            value = codon(p);
            if (!body_fits(p, at + 1, at + 1 + argument, depth))
                value &= ~UINT64_C(1);
            else if (way > at && way < at + 1 + argument)
                value |= 1;
            add_step(p, false, value);
            at += value & 1 ? 0 : argument;
            break;
        case TN_WORD_TERMINAL:
        case TN_WORD_DONE:
            break;
        }
        at++;
    }
    p->nodes[index].steps_end = p->step_count;
}

/* ---- the whole tree */

/* In random order, too, as long as no branch is deep enough: the one that must be may be any. */
static uint32_t take_pending(planter *p)
{
    size_t place = p->pending_count - 1;
    if (p->options->method == TN_TREE_PI_GROW || !is_deep_enough(p))
        place = (size_t)tn_chance_below(p->chance, p->pending_count);
    uint32_t index = p->pending[place];
    p->pending[place] = p->pending[--p->pending_count];
    p->reaching -= p->nodes[index].reaches;
    return index;
}

static bool put(tn_genome *genome, uint64_t value)
{
    if (!tn_genome_reserve(genome, genome->count + 1))
        return false;
    genome->codons[genome->count++] = value;
    return true;
}

/* Depth-first, leftmost; `pending` serves as the stack, holding the steps to go on from. */
static bool write_codons(planter *p, tn_genome *genome)
{
    genome->count = 0;
    size_t *cursor = calloc(p->node_count + 1, sizeof *cursor);
    if (!cursor)
        return false;
    for (size_t i = 0; i < p->node_count; i++)
        cursor[i] = p->nodes[i].steps;
    bool well = true;
    p->pending_count = 0;
    if (room(p, &p->pending, &p->pending_capacity, 0, sizeof *p->pending))
        p->pending[p->pending_count++] = 0;
    while (well && p->pending_count && genome->count < p->options->max_codons) {
        uint32_t top = p->pending[p->pending_count - 1];
        if (cursor[top] == p->nodes[top].steps_end) {
            p->pending_count--;
            continue;
        }
        const step *s = &p->steps[cursor[top]++];
        if (!s->is_child)
            well = (p->options->places == TN_PLACES_NONE || put(genome, 0)) && put(genome, s->value);
        else if ((well = room(p, &p->pending, &p->pending_capacity, p->pending_count, sizeof *p->pending)))
            p->pending[p->pending_count++] = (uint32_t)s->value;
    }
    free(cursor);
    return well;
}

/* The order in which the tree is expanded is what the codons of places say: they are drawn, and followed. A node's
 * steps are its choice and its children. */
static bool write_pairs(planter *p, tn_genome *genome)
{
    tn_sentential pending = {0};
    genome->count = 0;
    bool well = tn_sentential_put(&pending, 0);
    while (well && pending.count && genome->count + 2 <= p->options->max_codons) {
        uint64_t place = codon(p);
        const node *n = &p->nodes[tn_sentential_take(&pending, (size_t)(place % pending.count))];
        well = put(genome, place) && put(genome, p->steps[n->steps].value);
        for (size_t i = n->steps + 1; well && i < n->steps_end; i++)
            well = tn_sentential_put(&pending, (uint32_t)p->steps[i].value);
    }
    tn_sentential_clear(&pending);
    return well;
}

static bool add_tail(planter *p, tn_genome *genome)
{
    size_t tail = (size_t)((double)genome->count * p->options->tail);
    if (genome->count + tail > p->options->max_codons)
        tail = p->options->max_codons - genome->count;
    if (!tn_genome_reserve(genome, genome->count + tail))
        return false;
    if (tail > 0)
        tn_random_codons(p->chance, p->options->codon_limit, genome->codons + genome->count, tail);
    genome->count += tail;
    return true;
}

tn_status tn_random_tree(const tn_grammar *grammar, const tn_analysis *analysis, uint32_t rule, uint32_t at_depth,
                         const tn_tree_options *options, tn_chance *chance, tn_genome *genome, tn_error *error)
{
    tn_tree_options own = *options;
    planter p = {.grammar = grammar, .analysis = analysis, .options = &own, .chance = chance};
    uint32_t needed = analysis->rule_depth[rule] == TN_DEPTH_ENDLESS ? 0 : at_depth + analysis->rule_depth[rule] - 1;
    if (own.depth < needed)
        own.depth = needed;
    add_child(&p, rule, at_depth);
    while (p.pending_count && p.node_count < NODES_MAX * 2 && !p.failed)
        expand(&p, take_pending(&p));
    bool random = own.places == TN_PLACES_RANDOM;
    bool well = !p.failed && (random ? write_pairs(&p, genome) : write_codons(&p, genome)) && add_tail(&p, genome);
    free(p.nodes);
    free(p.steps);
    free(p.pending);
    return well ? TN_OK : tn_fail_memory(error);
}
