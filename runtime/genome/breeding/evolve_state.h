/* A run of evolution as its parts see it. Of no use elsewhere.
 *
 * - evolve.c: moves it on, generation by generation; keeps its islands, shares births and scores among several
 *   processes, and looks at it;
 * - evolve_birth.c: takes parents, also those that a person chose; makes genomes and their sentences, and others in
 *   place of copies;
 * - evolve_score.c: gives them their scores, and their errors in single cases;
 * - evolve_person.c: takes individuals that a person inserts, and takes others out.
 */
#ifndef TARTAN_GENOME_BREEDING_EVOLVE_STATE_H
#define TARTAN_GENOME_BREEDING_EVOLVE_STATE_H

#include "runtime/base/crew.h"
#include "runtime/base/hash_table.h"
#include "runtime/genome/breeding/evolve.h"
#include "runtime/genome/breeding/select.h"

/* Scores by sentence, so that no sentence is evaluated twice in a run. Sentences are known by 128 bits of hash. */

typedef struct tn_cached_score {
    uint64_t hash[2];
    tn_score score;
} tn_cached_score;

typedef struct tn_score_cache {
    tn_cached_score *entries;
    size_t count, capacity;
    tn_hash_table index;
} tn_score_cache;

void tn_score_cache_clear(tn_score_cache *cache);

/* Strings of codons as a kind of genome: a grammar maps them to sentences. */

/* Borrows the grammar and copies the settings. Free the kind in any case. */
tn_status tn_codon_kind_new(const tn_grammar *grammar, const tn_evolution_settings *settings, tn_genome_kind *kind,
                            tn_error *error);
void tn_codon_kind_free(tn_genome_kind *kind);

/* From here on children vary so. */
void tn_codon_kind_vary(tn_genome_kind *kind, const tn_vary_options *vary);

/* A parent that a person chose. */
typedef struct tn_chosen_parent {
    uint64_t id;
    double weight;
    tn_individual *member; /* or NULL: it is remembered */
} tn_chosen_parent;

/* A part of the population that breeds by itself. Where there are no islands, one is all of it. */
typedef struct tn_island {
    tn_individual **members; /* the best first */
    tn_merit *merits;        /* of the members, in that order */
    size_t count;
} tn_island;

struct tn_evolution {
    tn_genome_kind own; /* of codons, where the settings have no kind */
    const tn_genome_kind *kind;
    tn_evolution_settings settings;
    tn_evaluator evaluator;
    unsigned threads;
    tn_crew *crew;
    void **workplaces;  /* of the kind, by thread */
    tn_individual *all; /* twice the population */
    tn_individual **members, **born, **pool;
    size_t member_count, born_count;
    tn_island *islands;
    size_t island_count, births_each; /* births_each: of those to be born, on each island */
    tn_individual **residents;        /* of all islands, and their merits; those of all where there is one island */
    tn_merit *resident_merits;
    tn_merit *merits; /* of pool, or of members */
    uint32_t *scratch;
    uint32_t *todo; /* places in born that wait for their score */
    tn_score_cache cache;
    uint32_t generation; /* of the members */
    uint64_t next_id;
    tn_individual **guests;         /* inserted by a person, in order of their ids; owned */
    size_t guest_count, new_guests; /* new_guests: the last of them, since the newest generation was born */
    size_t shown_guests;            /* those inserted before the newest generation: the ones before the new */
    tn_chosen_parent *chosen;       /* by a person, or NULL */
    size_t chosen_count;
    tn_genome *album; /* by id, where genomes are remembered */
    size_t album_count;
    tn_lexicase lexicase; /* of the members, where parents are selected so */
    tn_recall *recall;
    tn_recall_parents *recall_parents;
    void *recall_context;
    uint64_t evaluations, births;
    uint64_t *hashes; /* of the members' sentences, while distinct ones are counted */
    double *scores;   /* of the members, while their quartiles are found */
};

/* Makes what is as large as the population. False: out of memory. */
bool tn_evolution_allocate(tn_evolution *evolution);
void tn_evolution_free_arrays(tn_evolution *evolution);

/* ---- islands */

size_t tn_island_size(const tn_evolution *evolution);

/* The best `keep` of `count` individuals become the island's members, the best first. `from` is not its own array. */
void tn_island_keep_best(tn_evolution *evolution, tn_island *island, tn_individual **from, size_t count, size_t keep);

/* Puts the members of all islands in one order, after the islands' own have changed. */
void tn_islands_order(tn_evolution *evolution);

/* ---- births */

/* Takes places for the next `count` to be born, as many on each island. */
void tn_evolution_take_places(tn_evolution *evolution, size_t count);

/* The children of one pair of parents: places in born. */
typedef struct tn_brood {
    size_t island, first, count; /* one child or two */
} tn_brood;

size_t tn_evolution_pairs(const tn_evolution *evolution);
tn_brood tn_evolution_pair(const tn_evolution *evolution, size_t pair);

/* Makes all to be born, with their sentences, in pairs, by all threads. `staying`: how many of the pool, from its first
 * on, are in the next generation, too, so that none of those born should have their sentences. */
tn_status tn_evolution_make(tn_evolution *evolution, bool first, size_t staying, tn_error *error);

/* Turns an individual's genome into its sentence. */
tn_status tn_evolution_write(tn_evolution *evolution, unsigned thread, tn_individual *individual, tn_error *error);

/* Remembers the genomes of those who were born, if that is wished. */
tn_status tn_evolution_keep_born(tn_evolution *evolution, tn_error *error);

/* Before a step: lets go of those inserted who were stored and are no members any more. */
void tn_evolution_part_from_guests(tn_evolution *evolution);

/* Remembers a genome by its id, if that is wished. */
tn_status tn_evolution_keep_genome(tn_evolution *evolution, const tn_individual *individual, tn_error *error);

bool tn_genome_take(tn_genome *to, const tn_genome *from);

/* Puts the chosen parents into the pool, each once, at most half a population: those that are no members any more come
 * back. Returns how many in *count. */
tn_status tn_evolution_bring_back(tn_evolution *evolution, size_t *count, tn_error *error);

/* Makes the children of one pair, with their sentences; `staying` as above. */
tn_status tn_evolution_make_pair(tn_evolution *evolution, size_t pair, size_t staying, tn_error *error);

/* The individuals that wait for their scores, in batches for the evaluator. */
typedef struct tn_scoring {
    tn_evolution *evolution;
    tn_individual **individuals;
    size_t todo, batch; /* places in evolution->todo; how many of them are evaluated at once */
} tn_scoring;

/* Evaluates one batch: those to do from item * batch on. */
tn_status tn_scoring_item(void *scoring, unsigned thread, size_t item, tn_error *error);

/* Items that ranks share, and how one tells the others what it found. */
typedef struct tn_shared_work {
    void *context;
    size_t items;
    tn_crew_work *work;                                                /* one item */
    size_t (*size)(const void *context, size_t item);                  /* bytes that its results take, at most */
    uint8_t *(*write)(const void *context, size_t item, uint8_t *end); /* where they end */
    const uint8_t *(*read)(void *context, const uint8_t *bytes);       /* one result; where the next begins */
} tn_shared_work;

/* With several ranks, the next four are called together. `status` says how this rank has fared since they last met: one
 * that failed then (`error` says how) does no work, and so fails all of them. */

/* Does the items with the other ranks of the settings, each once; then all know the results. */
tn_status tn_evolution_share(tn_evolution *evolution, tn_status status, const tn_shared_work *work, tn_error *error);

/* Evaluates all batches with the other ranks of the settings. */
tn_status tn_scoring_share(tn_scoring *scoring, tn_status status, tn_error *error);

/* Where parents are selected by single cases: the members' errors in them, unless the parents are recalled. It may fail
 * for this rank alone. */
tn_status tn_evolution_find_cases(tn_evolution *evolution, tn_status status, tn_error *error);

/* Gives scores to individuals that have a sentence. */
tn_status tn_evolution_score(tn_evolution *evolution, tn_status status, tn_individual **individuals, size_t count,
                             tn_error *error);

#endif
