/* What the files of the C interface to evolution share.
 *
 * A tartan_evolution keeps the scores and parents of all births and what a person chose, so that its generations can be
 * made again: for a saved state, and where a step failed. */
#ifndef TARTAN_API_GENOME_EVOLUTION_H
#define TARTAN_API_GENOME_EVOLUTION_H

#include "api/genome/genome.h"
#include "runtime/genome/breeding/evolve.h"

/* Parents that a person chose for a generation. */
typedef struct tn_api_choice {
    uint32_t generation;
    uint32_t *places;
    size_t count;
} tn_api_choice;

/* What is kept of a birth: with it, it is made again without asking the caller. */
typedef struct tn_api_birth {
    tn_score score;
    uint64_t parents[2]; /* ids; selection by cases does not know them otherwise */
} tn_api_birth;

struct tartan_evolution {
    tn_grammar *grammar;
    tn_evolution_settings settings;
    tn_genome *seeds; /* over the caller's codons */
    tn_evaluator evaluator;
    tartan_evaluate *evaluate;
    tartan_evaluate_cases *evaluate_cases;
    void *context;
    tn_evolution *engine; /* NULL: broken */
    uint32_t done;        /* generations */
    tn_api_birth *births; /* by id, of all generations done */
    size_t room;          /* generations that they have room for */
    tn_api_choice *choices;
    size_t choice_count;
    bool chosen; /* the last choice is for the generation to come */
    /* of the step under way */
    tn_watch *watch;
    atomic_size_t evaluated;
    atomic_bool failed; /* a callback did: its error is `failure` */
    tn_error failure;
};

/* What the engine counts of a generation, under its public type. */
tartan_generation tn_api_generation(const tn_generation_stats *stats);

/* An evolution without an engine's generation. */
tartan_status tn_api_evolution_make(const tartan_module *module, const tartan_evolution_options *options,
                                    tartan_evolution **evolution, tartan_error *error);

/* Begins the engine anew, and makes the generations done again from their scores. TARTAN_INVALID where a generation
 * cannot be made so: the scores are another run's. */
tartan_status tn_api_evolution_replay(tartan_evolution *evolution, tartan_error *error);

/* Room for the births of so many generations. */
bool tn_api_evolution_reserve(tartan_evolution *evolution, size_t generations);

/* Adds a choice for the generation to come, which takes over `places` in any case; false where out of memory. */
bool tn_api_evolution_add_choice(tartan_evolution *evolution, uint32_t generation, uint32_t *places, size_t count);

#endif
