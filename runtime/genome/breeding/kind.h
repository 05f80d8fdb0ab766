/* A kind of genome: where evolution ends and what it breeds begins.
 *
 * Evolution (evolve.h) holds populations, draws parents, recalls scores, and keeps the order of merit. It never looks
 * into a genome: a genome is an array of 64-bit numbers (tn_genome), and all that is done with one is done by its kind.
 *
 *   first   makes a genome of the first generation that no seed gives: a random one, or a child of the seeds
 *   breed   crosses two parents and mutates their two children
 *   write   says which sentence a genome stands for. The sentence is what is scored, stored and saved as a file, and
 *           its hash is what the cache of scores goes by: two genomes of one sentence are scored once
 *
 * Each is a function of its arguments and of the draws of one tn_chance, so that a run is the same with any number of
 * threads, and can be made again from its settings, seeds and seed alone. None of them evaluates anything. Each thread
 * has a workplace of its own: scratch memory, and whatever the last sentence was written into.
 *
 * Genomes that come from files are read by whoever knows the notation (the driver), and given as seeds.
 *
 * There are three kinds: strings of codons, which a grammar maps (codon_kind.c); expressions of fields as trees
 * (runtime/genome/tree); and lists of boxes (runtime/genome/boxes).
 */
#ifndef TARTAN_GENOME_BREEDING_KIND_H
#define TARTAN_GENOME_BREEDING_KIND_H

#include "runtime/genome/breeding/chance.h"
#include "runtime/genome/mapping/genome.h"
#include "runtime/genome/mapping/mapper.h"

typedef struct tn_parent {
    const tn_genome *genome;
    uint64_t used; /* codons that mapping read; 0 if it is not valid (then all count) */
    double weight; /* how much of it the children shall have: 1, or less; of codons, nobody asks */
} tn_parent;

typedef enum tn_birth_kind {
    TN_BIRTH_RANDOM,
    TN_BIRTH_TREE,
    TN_BIRTH_SEED,
    TN_BIRTH_CLONE,
    TN_BIRTH_CROSSED,
    TN_BIRTH_INSERTED /* a person wrote it */
} tn_birth_kind;

#define TN_BIRTH_MUTATED 16 /* is added to the kind */

/* What is known of a genome when it is born. */
typedef struct tn_birth {
    uint8_t kind;        /* tn_birth_kind, TN_BIRTH_MUTATED */
    uint64_t parents[2]; /* of a child of the seeds: their numbers; otherwise TN_NO_PARENT */
} tn_birth;

#define TN_NO_PARENT UINT64_MAX

/* A sentence; the text belongs to the workplace and is valid until its next use. */
typedef struct tn_written {
    const char *sentence; /* `size` bytes; empty where the genome stands for none */
    size_t size;
    uint64_t used;            /* how much of the genome was read */
    uint32_t depth;           /* of the tree that it stands for */
    tn_mapping_reason reason; /* why there is no sentence */
} tn_written;

typedef struct tn_genome_kind {
    void *context; /* whoever made the kind owns it; workplaces borrow it, and none changes it */
    void *(*workplace_new)(const void *context); /* NULL if out of memory */
    void (*workplace_free)(void *workplace);
    tn_status (*first)(void *workplace, uint64_t number, tn_chance *chance, tn_genome *genome, tn_birth *birth,
                       tn_error *error);
    tn_status (*breed)(void *workplace, tn_chance *chance, const tn_parent parents[2], tn_genome *children[2],
                       uint8_t kinds[2], tn_error *error);
    tn_status (*write)(void *workplace, const tn_genome *genome, tn_written *written, tn_error *error);
    bool weighs;       /* it asks how much of each parent the children shall have */
    bool parents_stay; /* parents that a person chose stay in the next generation, before their children */
} tn_genome_kind;

#endif
