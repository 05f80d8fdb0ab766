/* Genetic operators of codons: how two genomes make two others, and how one is changed. Each is a function of its
 * inputs and of the draws of one tn_chance, so that a run's genealogy can be replayed. */
#ifndef TARTAN_GENOME_BREEDING_VARY_H
#define TARTAN_GENOME_BREEDING_VARY_H

#include "runtime/genome/breeding/initialise.h"
#include "runtime/genome/breeding/kind.h"
#include "runtime/genome/mapping/span.h"

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
