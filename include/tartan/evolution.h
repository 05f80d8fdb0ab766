/* Evolution: a population of genomes, mapped to sentences, scored by the caller, and bred, generation after
 * generation. A run depends on its options, its seed and its scores alone, never on threads, nor on whether it was
 * saved and restored in between. */
#ifndef TARTAN_EVOLUTION_H
#define TARTAN_EVOLUTION_H

#include "genome.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TARTAN_OBJECTIVES_MAX 8
#define TARTAN_POPULATION_MAX 1000000

typedef struct tartan_sentence {
    const char *text; /* zero-ended */
    size_t size;
} tartan_sentence;

typedef enum tartan_score_state {
    TARTAN_SCORED,
    TARTAN_NO_SENTENCE,   /* the genome is not valid: nobody is asked to score it */
    TARTAN_SCORE_FAILED,  /* it cannot be scored */
    TARTAN_SCORE_LIMITED, /* scoring it took too much */
} tartan_score_state;

typedef struct tartan_score {
    double objectives[TARTAN_OBJECTIVES_MAX]; /* lower is better; one that is not a number makes it FAILED */
    tartan_score_state state;                 /* SCORED to begin with; otherwise FAILED or LIMITED */
    char message[200];                        /* why it is not SCORED; zeros to begin with */
} tartan_score;

/* Scores `count` sentences, all different from each other and from those scored before. Called by up to `threads`
 * threads at once, each with its own `thread` from 0 on, so that the caller can keep memory for each; the first is the
 * thread that called tartan_evolution_step. A sentence that cannot be scored has that as its state. Any status but
 * TARTAN_OK ends the step, which returns it, with what the callback wrote into `error` (never NULL). The callback may
 * not use the evolution. Scores must depend on the sentences alone. */
typedef tartan_status tartan_evaluate(void *context, unsigned thread, const tartan_sentence *sentences, size_t count,
                                      tartan_score *scores, tartan_error *error);

/* Gives the errors of one sentence that was SCORED in all `cases`; lower is better, and what is not a number counts as
 * infinite. For lexicase selection: of every member of a generation before it has children, also where it was asked
 * before. Threads, errors and what may be used are as for tartan_evaluate. */
typedef tartan_status tartan_evaluate_cases(void *context, unsigned thread, const tartan_sentence *sentence,
                                            double *errors, tartan_error *error);

typedef enum tartan_initialisation {
    TARTAN_INITIALISE_DEFAULT, /* RAMPED */
    TARTAN_INITIALISE_RANDOM,
    TARTAN_INITIALISE_RAMPED,
    TARTAN_INITIALISE_GROW,
    TARTAN_INITIALISE_PI_GROW,
} tartan_initialisation;

typedef enum tartan_selection {
    TARTAN_SELECT_DEFAULT, /* TOURNAMENT; with several objectives NSGA2 */
    TARTAN_SELECT_TOURNAMENT,
    TARTAN_SELECT_TRUNCATION,
    TARTAN_SELECT_ROULETTE,
    TARTAN_SELECT_NSGA2,
    TARTAN_SELECT_LEXICASE, /* this and the next: by errors in single cases, which `evaluate_cases` gives */
    TARTAN_SELECT_EPSILON_LEXICASE,
} tartan_selection;

typedef enum tartan_crossover {
    TARTAN_CROSS_DEFAULT, /* ONE_POINT */
    TARTAN_CROSS_ONE_POINT,
    TARTAN_CROSS_FIXED_ONE_POINT,
    TARTAN_CROSS_TWO_POINT,
    TARTAN_CROSS_FIXED_TWO_POINT,
    TARTAN_CROSS_SUBTREE,
} tartan_crossover;

typedef enum tartan_mutation {
    TARTAN_MUTATE_DEFAULT, /* CODONS */
    TARTAN_MUTATE_CODONS,
    TARTAN_MUTATE_GENOME,
    TARTAN_MUTATE_SUBTREE,
} tartan_mutation;

typedef struct tartan_genome {
    const uint64_t *codons;
    size_t count;
} tartan_genome;

/* docs/evolution.md says more of each. Zeros are defaults, those of a study (.study); where it is in parentheses. */
typedef struct tartan_evolution_options {
    size_t size;
    tartan_evaluate *evaluate; /* must be there */
    void *context;
    uint32_t objectives; /* 1 to TARTAN_OBJECTIVES_MAX (1) */
    uint32_t batch;      /* sentences that a call of `evaluate` gets at most (64) */
    uint32_t threads;    /* (one a processor) */
    uint64_t seed;       /* 0 is a seed like any other */
    uint32_t population; /* 2 to TARTAN_POPULATION_MAX (500) */
    tartan_initialisation initialisation;
    uint32_t codons;                /* of a RANDOM genome (200) */
    uint32_t depth_low, depth_high; /* of first trees, where the grammar has such; up to 10,000 (2, 10) */
    double tail;                    /* further codons of a first tree, in its own length; negative: none (0.5) */
    const tartan_genome *seeds;     /* first genomes; copied */
    size_t seed_count;
    tartan_selection selection;
    uint32_t tournament; /* how many are drawn (2) */
    double truncation;   /* the share of the best, up to 1 (0.5) */
    tartan_crossover crossover;
    double crossover_rate; /* probability that a pair is crossed, up to 1; negative: never (0.75) */
    tartan_mutation mutation;
    double mutation_rate; /* probability of a codon or tree; of GENOME, how many codons; negative: never (one codon) */
    bool points_anywhere; /* crossing and mutating also past the codons that mapping read */
    uint64_t codon_limit; /* codons are below this (100,000) */
    uint32_t max_codons;  /* of a genome (5,000) */
    uint32_t tree_depth;  /* of trees that subtree mutation makes (depth_high) */
    uint32_t elites;      /* the best that stay as they are (1) */
    bool no_elites;
    bool steady_state;                     /* each child takes the worst one's place, if it is better */
    const tartan_map_options *mapping;     /* (as the module's study and its grammar say); copied */
    tartan_evaluate_cases *evaluate_cases; /* must be there for selection by cases, and only then */
    size_t cases;                          /* how many there are, at least 1 then; members * cases up to 2^27 */
    bool keep_copies; /* a child may have the sentence of another of its generation; otherwise it is bred again, from
                         the same parents, a few times */
    uint32_t islands; /* equal parts of the population, which breed by themselves (1) */
    uint32_t migrants, migrate_every; /* how many of each island's best move on, after how many generations (1, 10) */
} tartan_evolution_options;
TARTAN_SIZED(tartan_evolution_options)

/* Sets what the evolution block of a module says, of those that say how to breed; the others stay. What is to be bred
 * for (`match`, `grow` and so on) is the command's business: here it is `evaluate`. TARTAN_INVALID where the module has
 * no such block. */
TARTAN_API tartan_status tartan_evolution_options_of(const tartan_module *module, tartan_evolution_options *options,
                                                     tartan_error *error);

typedef struct tartan_evolution tartan_evolution;

/* An evolution without generations yet, over the module's grammar, which is copied: it borrows nothing. */
TARTAN_API tartan_status tartan_evolution_new(const tartan_module *module, const tartan_evolution_options *options,
                                              tartan_evolution **evolution, tartan_error *error);
TARTAN_API void tartan_evolution_free(tartan_evolution *evolution);

/* Makes the next generation; the first call the first. The watch (may be NULL) is told how many sentences of those to
 * be scored are, as batches come back. A step that failed or was stopped has changed nothing, and may be tried again.
 * After TARTAN_MEMORY that may not hold any more: then every call is TARTAN_INVALID. */
TARTAN_API tartan_status tartan_evolution_step(tartan_evolution *evolution, const tartan_watch *watch,
                                               tartan_error *error);

/* How many generations have been made. */
TARTAN_API uint32_t tartan_evolution_done(const tartan_evolution *evolution);

/* The parents of the next generation, as a person chose them: places of members, each as often as it shall have
 * children. */
TARTAN_API tartan_status tartan_evolution_choose(tartan_evolution *evolution, const uint32_t *places, size_t count,
                                                 tartan_error *error);

#define TARTAN_NO_PARENT UINT64_MAX

typedef struct tartan_individual {
    size_t size;
    uint64_t id;         /* generation of its birth * population + place */
    uint64_t parents[2]; /* or TARTAN_NO_PARENT */
    const uint64_t *codons;
    size_t codon_count;
    const char *sentence; /* zero-ended; "" where the genome is not valid */
    size_t sentence_size;
    uint64_t used; /* codons */
    uint32_t depth;
    tartan_map_reason reason;
    tartan_score_state state;
    double objectives[TARTAN_OBJECTIVES_MAX]; /* infinite where it is not SCORED */
} tartan_individual;
TARTAN_SIZED(tartan_individual)

/* A member of the newest generation, the best at place 0; with several objectives the first tartan_evolution_front are
 * those that no other is better than in all. Past the end, TARTAN_INVALID. Pointers are valid until the next step. */
TARTAN_API size_t tartan_evolution_members(const tartan_evolution *evolution);
TARTAN_API size_t tartan_evolution_front(const tartan_evolution *evolution);
TARTAN_API tartan_status tartan_evolution_member(const tartan_evolution *evolution, size_t place,
                                                 tartan_individual *individual, tartan_error *error);

typedef struct tartan_generation {
    size_t size;
    uint32_t number;                               /* from 0 */
    double best[TARTAN_OBJECTIVES_MAX];            /* of each objective */
    double mean;                                   /* of the first objective, of those scored */
    uint32_t scored, no_sentence, failed, limited; /* of the members */
    uint32_t distinct;                             /* sentences */
    uint64_t evaluations, births;                  /* of the run so far */
    double mean_codons, mean_depth;
} tartan_generation;
TARTAN_SIZED(tartan_generation)

/* The newest generation as a whole. TARTAN_INVALID before the first step. */
TARTAN_API tartan_status tartan_evolution_generation(const tartan_evolution *evolution, tartan_generation *generation,
                                                     tartan_error *error);

/* The run so far, as bytes to be kept. */
TARTAN_API tartan_status tartan_evolution_save(const tartan_evolution *evolution, void **bytes, size_t *size,
                                               tartan_error *error);

/* Goes on with such a run: its generations are made again, without evaluating. The module's grammar and the options
 * must be those that it was started with, but for evaluate, evaluate_cases, context, batch and threads; otherwise, or
 * where the bytes are damaged, TARTAN_INVALID. */
TARTAN_API tartan_status tartan_evolution_restore(const tartan_module *module, const tartan_evolution_options *options,
                                                  const void *bytes, size_t size, tartan_evolution **evolution,
                                                  tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
