/* Crosses and mutates genomes. */
#include "runtime/genome/breeding/vary.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

#define ATTEMPTS 8 /* at finding subtrees that can change places */

struct tn_breeder {
    const tn_grammar *grammar;
    const tn_analysis *analysis;
    tn_mapping_options mapping;
    tn_mapper *mapper;
    tn_genome straight[2], part, tree;
    tn_spans spans[2];
    tn_event *events[2]; /* copies, since one mapper's events last until its next use */
    size_t event_capacity[2];
};

tn_breeder *tn_breeder_new(const tn_grammar *grammar, const tn_analysis *analysis, const tn_mapping_options *mapping)
{
    tn_breeder *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    b->grammar = grammar;
    b->analysis = analysis;
    b->mapping = *mapping;
    b->mapper = tn_mapper_new(grammar);
    if (!b->mapper) {
        free(b);
        return NULL;
    }
    return b;
}

void tn_breeder_free(tn_breeder *b)
{
    if (!b)
        return;
    tn_mapper_free(b->mapper);
    for (int i = 0; i < 2; i++) {
        tn_genome_clear(&b->straight[i]);
        tn_spans_clear(&b->spans[i]);
        free(b->events[i]);
    }
    tn_genome_clear(&b->part);
    tn_genome_clear(&b->tree);
    free(b);
}

tn_mapper *tn_breeder_mapper(tn_breeder *b)
{
    return b->mapper;
}

/* ---- putting genomes together */

/* Appends `count` codons of another genome, from its codon `first` on. A genome without codons has no array. */
static bool append(tn_genome *genome, const tn_genome *from, size_t first, size_t count, size_t max_codons)
{
    if (genome->count + count > max_codons)
        count = max_codons - genome->count;
    if (!tn_genome_reserve(genome, genome->count + count))
        return false;
    if (count)
        memcpy(genome->codons + genome->count, from->codons + first, count * sizeof *from->codons);
    genome->count += count;
    return true;
}

static bool copy(tn_genome *to, const tn_genome *from)
{
    to->count = 0;
    return append(to, from, 0, from->count, SIZE_MAX);
}

/* to = a[0, a0) b[b0, b1) a[a1, end) */
static bool splice(tn_genome *to, const tn_genome *a, size_t a0, size_t a1, const tn_genome *b, size_t b0, size_t b1,
                   size_t max_codons)
{
    to->count = 0;
    return append(to, a, 0, a0, max_codons) && append(to, b, b0, b1 - b0, max_codons) &&
           append(to, a, a1, a->count - a1, max_codons);
}

/* ---- linear crossover */

static size_t part_of(const tn_parent *parent, bool within_used)
{
    size_t count = parent->genome->count;
    return within_used && parent->used && parent->used < count ? (size_t)parent->used : count;
}

static void two_points(tn_chance *chance, size_t length, size_t unit, size_t points[2])
{
    points[0] = unit * (size_t)tn_chance_below(chance, length / unit + 1);
    points[1] = unit * (size_t)tn_chance_below(chance, length / unit + 1);
    if (points[0] > points[1]) {
        size_t swap = points[0];
        points[0] = points[1];
        points[1] = swap;
    }
}

/* Genomes are cut between `unit` codons, which are read together. */
static bool cross_linear(const tn_vary_options *o, size_t unit, tn_chance *chance, const tn_parent parents[2],
                         tn_genome *children[2])
{
    const tn_genome *a = parents[0].genome, *b = parents[1].genome;
    size_t la = part_of(&parents[0], o->within_used), lb = part_of(&parents[1], o->within_used), pa[2], pb[2];
    bool fixed = o->crossover == TN_CROSS_FIXED_ONE_POINT || o->crossover == TN_CROSS_FIXED_TWO_POINT;
    if (fixed)
        la = lb = la < lb ? la : lb;
    if (o->crossover == TN_CROSS_ONE_POINT || o->crossover == TN_CROSS_FIXED_ONE_POINT) {
        pa[0] = unit * (size_t)tn_chance_below(chance, la / unit + 1);
        pb[0] = fixed ? pa[0] : unit * (size_t)tn_chance_below(chance, lb / unit + 1);
        pa[1] = a->count;
        pb[1] = b->count;
    } else {
        two_points(chance, la, unit, pa);
        if (fixed)
            memcpy(pb, pa, sizeof pa);
        else
            two_points(chance, lb, unit, pb);
    }
    return splice(children[0], a, pa[0], pa[1], b, pb[0], pb[1], o->max_codons) &&
           splice(children[1], b, pb[0], pb[1], a, pa[0], pa[1], o->max_codons);
}

/* ---- subtrees */

/* Derives a genome's sentence and finds its subtrees; *valid says whether it has a sentence. */
static tn_status find_subtrees(tn_breeder *b, int which, const tn_genome *genome, bool *valid, tn_error *error)
{
    tn_mapping_options options = b->mapping;
    tn_mapping mapping;
    options.record = true;
    options.repair = TN_REPAIR_OFF;
    tn_status status = tn_mapper_derive(b->mapper, genome->codons, genome->count, &options, &mapping, error);
    if (status != TN_OK)
        return status;
    *valid = mapping.valid;
    if (!mapping.valid)
        return TN_OK;
    if (!tn_array_reserve(&b->events[which], &b->event_capacity[which], 0, mapping.event_count, sizeof *mapping.events))
        return tn_fail_memory(error);
    memcpy(b->events[which], mapping.events, mapping.event_count * sizeof *mapping.events);
    mapping.events = b->events[which];
    tn_genome *straight = &b->straight[which];
    bool well = options.position_independent
                    ? tn_events_straighten(b->events[which], mapping.event_count, genome->codons, genome->count,
                                           mapping.used, straight)
                    : tn_genome_straighten(genome->codons, genome->count, &mapping, straight);
    return well && tn_spans_find(&mapping, &b->spans[which]) ? TN_OK : tn_fail_memory(error);
}

/* The codons of a subtree, changed so that they make the same choices at another depth; false if they cannot. */
static bool moved(tn_breeder *b, int which, const tn_span_of *span, uint32_t depth, tn_genome *part, bool *well)
{
    part->count = 0;
    *well = append(part, &b->straight[which], (size_t)span->begin, (size_t)(span->end - span->begin), SIZE_MAX);
    if (!*well || b->grammar->dialect == TN_DIALECT_GE || depth == span->depth)
        return *well;
    size_t open = 0;
    for (uint32_t e = span->event;; e++) {
        const tn_event *event = &b->events[which][e];
        open += event->kind == TN_EVENT_EXPAND;
        open -= event->kind == TN_EVENT_END;
        if (event->kind == TN_EVENT_EXPAND &&
            !tn_choice_codon(b->grammar, event->production, event->depth - span->depth + depth, b->mapping.max_depth,
                             &part->codons[event->read - span->begin]))
            return false;
        if (open == 0)
            return true;
    }
}

/* Has the genome a sentence, before repair? */
static tn_status is_valid(tn_breeder *b, const tn_genome *genome, bool *valid, tn_error *error)
{
    tn_mapping_options options = b->mapping;
    tn_mapping mapping;
    options.repair = TN_REPAIR_OFF;
    tn_status status = tn_mapper_derive(b->mapper, genome->codons, genome->count, &options, &mapping, error);
    *valid = status == TN_OK && mapping.valid;
    return status;
}

/* child = the genome `which` with its subtree `at` replaced by the subtree `from` of the other one; the child must be
 * valid. */
static tn_status graft(tn_breeder *b, const tn_vary_options *o, int which, const tn_span_of *at, const tn_span_of *from,
                       tn_genome *child, bool *done, tn_error *error)
{
    bool well;
    *done = moved(b, 1 - which, from, at->depth, &b->part, &well);
    if (!well)
        return tn_fail_memory(error);
    if (!*done)
        return TN_OK;
    if (!splice(child, &b->straight[which], (size_t)at->begin, (size_t)at->end, &b->part, 0, b->part.count,
                o->max_codons))
        return tn_fail_memory(error);
    return is_valid(b, child, done, error);
}

/* A subtree of `spans` with that rule, or NULL. */
static const tn_span_of *same_rule(const tn_spans *spans, uint32_t rule, tn_chance *chance)
{
    uint64_t count = 0, chosen;
    for (size_t i = 0; i < spans->count; i++)
        count += spans->items[i].rule == rule;
    if (!count)
        return NULL;
    chosen = tn_chance_below(chance, count);
    for (size_t i = 0;; i++)
        if (spans->items[i].rule == rule && chosen-- == 0)
            return &spans->items[i];
}

static tn_status cross_subtrees(tn_breeder *b, const tn_vary_options *o, tn_chance *chance, const tn_parent parents[2],
                                tn_genome *children[2], bool *crossed, tn_error *error)
{
    *crossed = false;
    for (int i = 0; i < 2; i++) {
        bool valid;
        tn_status status = find_subtrees(b, i, parents[i].genome, &valid, error);
        if (status != TN_OK || !valid)
            return status;
    }
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        /* the start symbol's own tree is left out where there are others: changing it changes everything */
        size_t first = b->spans[0].count > 1;
        const tn_span_of *at = &b->spans[0].items[first + tn_chance_below(chance, b->spans[0].count - first)];
        const tn_span_of *other = same_rule(&b->spans[1], at->rule, chance);
        bool done[2] = {false, false};
        if (!other)
            continue;
        tn_status status = graft(b, o, 0, at, other, children[0], &done[0], error);
        if (status == TN_OK && done[0])
            status = graft(b, o, 1, other, at, children[1], &done[1], error);
        if (status != TN_OK)
            return status;
        if (done[0] && done[1]) {
            *crossed = true;
            return TN_OK;
        }
    }
    return TN_OK;
}

/* ---- mutation */

static void mutate_codon(const tn_vary_options *o, tn_chance *chance, tn_genome *genome, size_t place)
{
    tn_random_codons(chance, o->codon_limit, &genome->codons[place], 1);
}

static bool mutate_codons(const tn_vary_options *o, tn_chance *chance, size_t part, tn_genome *genome)
{
    double rate = o->mutation_rate < 0 ? (part ? 1.0 / (double)part : 0) : o->mutation_rate;
    bool mutated = false;
    /* rate as a threshold of 64-bit draws: one draw a codon */
    uint64_t threshold = rate >= 1 ? UINT64_MAX : (uint64_t)(rate * 0x1p64);
    for (size_t i = 0; i < part; i++)
        if (tn_chance_next(chance) < threshold) {
            mutate_codon(o, chance, genome, i);
            mutated = true;
        }
    return mutated;
}

static bool mutate_genome(const tn_vary_options *o, tn_chance *chance, size_t part, tn_genome *genome)
{
    uint64_t times = o->mutation_rate < 0 ? 1 : (uint64_t)o->mutation_rate;
    for (uint64_t i = 0; part && i < times; i++)
        mutate_codon(o, chance, genome, (size_t)tn_chance_below(chance, part));
    return part && times;
}

static tn_status mutate_subtree(tn_breeder *b, const tn_vary_options *o, tn_chance *chance, tn_genome *genome,
                                bool *mutated, tn_error *error)
{
    bool valid;
    *mutated = false;
    if (!tn_chance_is(chance, o->mutation_rate < 0 ? 1 : o->mutation_rate))
        return TN_OK;
    tn_status status = find_subtrees(b, 0, genome, &valid, error);
    if (status != TN_OK || !valid)
        return status;
    tn_tree_options tree = {.method = TN_TREE_GROW,
                            .depth = o->tree_depth,
                            .max_depth = b->mapping.max_depth,
                            .codon_limit = o->codon_limit,
                            .places = b->mapping.position_independent ? TN_PLACES_LEFTMOST : TN_PLACES_NONE,
                            .max_codons = o->max_codons};
    for (int attempt = 0; attempt < ATTEMPTS && !*mutated; attempt++) {
        const tn_span_of *at = &b->spans[0].items[tn_chance_below(chance, b->spans[0].count)];
        status = tn_random_tree(b->grammar, b->analysis, at->rule, at->depth, &tree, chance, &b->tree, error);
        if (status != TN_OK)
            return status;
        if (!splice(&b->part, &b->straight[0], (size_t)at->begin, (size_t)at->end, &b->tree, 0, b->tree.count,
                    o->max_codons))
            return tn_fail_memory(error);
        status = is_valid(b, &b->part, mutated, error);
        if (status != TN_OK)
            return status;
    }
    return !*mutated || copy(genome, &b->part) ? TN_OK : tn_fail_memory(error);
}

static tn_status mutate(tn_breeder *b, const tn_vary_options *o, tn_chance *chance, uint64_t used, tn_genome *genome,
                        bool *mutated, tn_error *error)
{
    tn_parent child = {genome, used, 1};
    size_t part = part_of(&child, o->within_used);
    switch (o->mutation) {
    case TN_MUTATE_CODONS:
        *mutated = mutate_codons(o, chance, part, genome);
        return TN_OK;
    case TN_MUTATE_GENOME:
        *mutated = mutate_genome(o, chance, part, genome);
        return TN_OK;
    default:
        return mutate_subtree(b, o, chance, genome, mutated, error);
    }
}

tn_status tn_breed(tn_breeder *b, const tn_vary_options *o, tn_chance *chance, const tn_parent parents[2],
                   tn_genome *children[2], uint8_t kinds[2], tn_error *error)
{
    bool crossed = false;
    tn_status status = TN_OK;
    if (tn_chance_is(chance, o->crossover_rate)) {
        if (o->crossover == TN_CROSS_SUBTREE)
            status = cross_subtrees(b, o, chance, parents, children, &crossed, error);
        else if (!(crossed = cross_linear(o, b->mapping.position_independent ? 2 : 1, chance, parents, children)))
            status = tn_fail_memory(error);
    }
    for (int i = 0; i < 2 && status == TN_OK; i++) {
        bool mutated;
        if (!crossed && !copy(children[i], parents[i].genome))
            return tn_fail_memory(error);
        /* where linear crossover changed what is read, the parent's number of codons read is the nearest guess */
        status = mutate(b, o, chance, parents[i].used, children[i], &mutated, error);
        kinds[i] = (uint8_t)((crossed ? TN_BIRTH_CROSSED : TN_BIRTH_CLONE) | (mutated ? TN_BIRTH_MUTATED : 0));
    }
    return status;
}
