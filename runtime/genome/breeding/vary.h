/* Genetic operators of codons: how two genomes make two others, and how one is changed. Each is a function of its
 * inputs and of the draws of one tn_chance, so that a run's genealogy can be replayed. */
#ifndef TARTAN_GENOME_BREEDING_VARY_H
#define TARTAN_GENOME_BREEDING_VARY_H

#include "runtime/genome/breeding/chance.h"
#include "runtime/genome/breeding/kind.h"
#include "runtime/genome/mapping/genome.h"
#include "runtime/grammar/analysis.h"

/* First genomes: random codons, or codons of random derivation trees.
 *
 * A tree is made with its depth bounded, then written out in the order in which mapping reads, so that the genome leads
 * to the tree. Behind it random codons follow, for repair and for what crossover makes of it. */

typedef enum tn_tree_method {
    TN_TREE_GROW,    /* any production that still fits */
    TN_TREE_FULL,    /* recursive productions as long as they fit */
    TN_TREE_PI_GROW, /* position independent: expanded in random order, so that depth is reached anywhere (Fagan et al.,
                        2016) */
} tn_tree_method;

/* Which codons are written before each choice, for position-independent mapping. */
typedef enum tn_tree_places {
    TN_PLACES_NONE,     /* none: it is not mapped so */
    TN_PLACES_LEFTMOST, /* the leftmost non-terminal's, so that subtrees lie side by side */
    TN_PLACES_RANDOM,   /* any: the tree is expanded in random order */
} tn_tree_places;

typedef struct tn_tree_options {
    tn_tree_method method;
    uint32_t depth; /* levels, at least as many as the grammar needs: fewer count as that */
    uint32_t least; /* levels that a branch must reach, where the grammar has a tree that deep and no deeper than
                       `depth`; 0: none must */
    const tn_depths *depths; /* of the grammar, up to `depth`, where `least` is not 0; borrowed */
    uint32_t max_depth;      /* of mapping */
    uint64_t codon_limit;    /* codons are below it */
    double tail;             /* random codons behind the tree's, as a share of them */
    size_t max_codons;       /* a tree that needs more is cut there, and does not lead to itself */
    tn_tree_places places;
} tn_tree_options;

void tn_random_codons(tn_chance *chance, uint64_t codon_limit, uint64_t *codons, size_t count);

/* A tree from `rule` at `at_depth`; its codons (and the tail) replace the genome's. TN_MEMORY, or TN_OK. */
tn_status tn_random_tree(const tn_grammar *grammar, const tn_analysis *analysis, uint32_t rule, uint32_t at_depth,
                         const tn_tree_options *options, tn_chance *chance, tn_genome *genome, tn_error *error);

typedef enum tn_crossover {
    TN_CROSS_ONE_POINT,       /* each parent is cut at a place of its own */
    TN_CROSS_FIXED_ONE_POINT, /* both at the same */
    TN_CROSS_TWO_POINT,
    TN_CROSS_FIXED_TWO_POINT,
    TN_CROSS_SUBTREE, /* subtrees of the same rule change places; keeps sentences valid */
    TN_CROSS_COUNT
} tn_crossover;

typedef enum tn_mutation {
    TN_MUTATE_CODONS,  /* each codon with the rate's probability */
    TN_MUTATE_GENOME,  /* as many codons, anywhere, as the rate says */
    TN_MUTATE_SUBTREE, /* a subtree is replaced by a random one, with the rate's probability; keeps sentences valid */
    TN_MUTATE_COUNT
} tn_mutation;

typedef struct tn_vary_options {
    tn_crossover crossover;
    double crossover_rate; /* probability that a pair is crossed at all */
    tn_mutation mutation;
    double mutation_rate; /* negative: 1 / (codons used), or 1 codon of a genome */
    bool within_used;     /* points lie among the codons that mapping read */
    uint64_t codon_limit;
    size_t max_codons;
    uint32_t tree_depth; /* of the trees that subtree mutation makes, as a limit of the whole tree's depth */
} tn_vary_options;

/* One thread's means of varying: scratch memory. Borrows the grammar and its analysis. */
typedef struct tn_breeder tn_breeder;

tn_breeder *tn_breeder_new(const tn_grammar *grammar, const tn_analysis *analysis, const tn_mapping_options *mapping);
void tn_breeder_free(tn_breeder *breeder);
tn_mapper *tn_breeder_mapper(tn_breeder *breeder);

/* Makes two children of two parents, mutated already. `kinds` says what was done (tn_birth_kind, TN_BIRTH_MUTATED). */
tn_status tn_breed(tn_breeder *breeder, const tn_vary_options *options, tn_chance *chance, const tn_parent parents[2],
                   tn_genome *children[2], uint8_t kinds[2], tn_error *error);

#endif
