/* Evolution: a population of genomes, turned into sentences, evaluated and bred, generation after generation. What a
 * genome is, its kind says (kind.h).
 *
 * Every draw is keyed by what it is for, so that a run depends on its settings and seed alone and never on the number
 * of threads. A run is replayed by running it again with the evaluations recalled instead of done; that is also how it
 * is resumed. What is evaluated, and how, the caller's tn_evaluator says: this engine knows sentences and numbers.
 *
 * Several processes (settings.ranks) breed one run together: each breeds all of it, evaluates some of the sentences,
 * and hears from the others what theirs scored. They call what moves the run on in the same order, and it fails for all
 * of them alike.
 */
#ifndef TARTAN_GENOME_BREEDING_EVOLVE_H
#define TARTAN_GENOME_BREEDING_EVOLVE_H

#include "runtime/base/watch.h"
#include "runtime/genome/breeding/select.h"
#include "runtime/genome/breeding/vary.h"
#include "runtime/ranks/ranks.h"

/* What became of an evaluation. All but TN_SCORED have infinity for every objective. */
typedef enum tn_score_state {
    TN_SCORED,
    TN_SCORE_NO_SENTENCE, /* the genome is not valid */
    TN_SCORE_FAILED,      /* the evaluator refused the sentence */
    TN_SCORE_LIMIT,       /* it passed a limit */
    TN_SCORE_STATE_COUNT
} tn_score_state;

/* The objectives; and behind them, where an evaluator finds a few errors in single cases with the score, these. */
#define TN_SCORE_NUMBERS_MAX (TN_OBJECTIVES_MAX + 2u)

typedef struct tn_score {
    double objectives[TN_SCORE_NUMBERS_MAX]; /* lower is better */
    double violation; /* how far from meeting what is required, where that is weighed apart from several objectives */
    tn_score_state state;
} tn_score;

struct tn_individual;

/* Gives sentences their scores, one at a time or (evaluate_many, at most `batch` at a time) many, whose `score` and
 * `message` it sets. May be called by several threads at once, each with its own `thread` from 0 on. A sentence that
 * cannot be scored is a state, not an error; the message (of 200 bytes) says why. TN_MEMORY and the like end the run.
 */
typedef struct tn_evaluator {
    void *context;
    size_t objectives;
    tn_status (*evaluate)(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                          char message[200], tn_error *error);
    /* Changes a target or weight, "NAME VALUE ..."; NULL if nothing can be changed. Never while evaluating. */
    tn_status (*adjust)(void *context, const char *change, tn_error *error);
    tn_status (*evaluate_many)(void *context, unsigned thread, struct tn_individual *const *individuals, size_t count,
                               tn_error *error); /* or NULL */
    size_t batch;
    /* How many cases a sentence is scored by, or 0: evaluate_cases gives its error in each, or where that is NULL they
     * stand behind the objectives of its score, and are stored with it. */
    size_t cases;
    tn_status (*evaluate_cases)(void *context, unsigned thread, const char *sentence, size_t size, double *errors,
                                tn_error *error);
} tn_evaluator;

/* How many numbers of a score say something. */
static inline size_t tn_evaluator_numbers(const tn_evaluator *evaluator)
{
    return evaluator->objectives + (evaluator->evaluate_cases ? 0 : evaluator->cases);
}

/* What a failed evaluation returns: running out of memory ends the run; anything else is the sentence's own fault,
 * whose score then says so. */
tn_status tn_score_refuse(tn_status status, const tn_error *why, tn_score *score, char message[200], tn_error *error);

typedef enum tn_initialisation {
    TN_INITIALISE_RANDOM,
    TN_INITIALISE_RAMPED,
    TN_INITIALISE_GROW,
    TN_INITIALISE_PI_GROW,
    TN_INITIALISE_COUNT
} tn_initialisation;
typedef enum tn_replacement { TN_REPLACE_GENERATION, TN_REPLACE_STEADY, TN_REPLACE_COUNT } tn_replacement;

typedef struct tn_evolution_settings {
    uint64_t seed;
    uint32_t population; /* 2 to TN_POPULATION_MAX */
    tn_initialisation initialisation;
    uint32_t codons;                /* of a random genome */
    uint32_t depth_low, depth_high; /* of first trees */
    double tail;                    /* random codons behind a tree's, as a share of them */
    const tn_genome *seeds;         /* first genomes that are given; borrowed */
    size_t seed_count;
    tn_select_options select;
    tn_vary_options vary;
    uint32_t elites; /* with generational replacement; of each island */
    tn_replacement replacement;
    tn_mapping_options mapping;
    uint32_t islands; /* equal parts of the population, which breed by themselves; 0 or 1: it is one */
    uint32_t migrants,
        every; /* how many of each island's best move to the next one, every so many generations (0: never) */
    const tn_genome_kind *kind; /* of other genomes than codons, or NULL; borrowed */
    bool keeps_copies;     /* a child may have the sentence of another of its generation; otherwise it is bred again */
    bool remembers;        /* every genome that was ever born can be chosen as a parent, by its id */
    unsigned threads;      /* 0: as many as there are */
    tn_watch *watch;       /* borrowed, or NULL: a step gives up (TN_STOPPED) once this says so */
    const tn_ranks *ranks; /* borrowed, or NULL: those that breed the same run, and share its evaluations */
} tn_evolution_settings;

#define TN_POPULATION_MAX 1000000u
#define TN_FIRST_DEPTH_MAX 10000u /* of first trees */
#define TN_CACHE_MAX (1u << 22)   /* phenotypes whose scores are kept; then all are forgotten */

/* A paper's or PonyGE2's usual settings. */
tn_evolution_settings tn_evolution_settings_default(void);

typedef struct tn_individual {
    uint64_t id;         /* as they are born; each generation takes as many as the population, used or not */
    uint64_t parents[2]; /* ids; TN_NO_PARENT in the first generation */
    uint8_t kind;        /* tn_birth_kind, TN_BIRTH_MUTATED */
    tn_genome genome;
    char *sentence; /* zero-ended; empty where not valid */
    size_t sentence_size, sentence_capacity;
    uint64_t hash[2]; /* of the sentence */
    uint64_t used;
    uint32_t depth;
    tn_mapping_reason reason;
    tn_score score;
    char message[200]; /* why it was not scored */
    bool member;
    bool stayed; /* a person chose it as a parent, and it is on the next sheet too */
} tn_individual;

typedef struct tn_generation_stats {
    uint32_t generation;
    double best[TN_OBJECTIVES_MAX];                /* the best of each objective */
    double mean;                                   /* of objective 0, of those scored; 0 if there is none */
    double quartiles[3];                           /* likewise: the lower, the median and the upper */
    uint32_t scored, no_sentence, failed, limited; /* of the members */
    uint32_t distinct;                             /* sentences among the members */
    uint64_t evaluations;                          /* of the run so far */
    uint64_t births;                               /* likewise */
    double mean_codons, mean_depth;                /* of the members with a sentence */
} tn_generation_stats;

typedef struct tn_evolution tn_evolution;

/* The population is a multiple of the islands, with at least two individuals on each, and fewer migrants than an island
 * has. Borrows grammar and settings' seeds, copies the rest. Where the settings have a kind of genome, the grammar is
 * NULL.
 */
tn_status tn_evolution_new(const tn_grammar *grammar, const tn_evolution_settings *settings,
                           const tn_evaluator *evaluator, tn_evolution **evolution, tn_error *error);
void tn_evolution_free(tn_evolution *evolution);

/* Where scores come from that are known already (a stored run): true and the score, or false. Called in order of ids,
 * by one thread. */
typedef bool tn_recall(void *context, uint64_t id, tn_score *score);
void tn_evolution_recall(tn_evolution *evolution, tn_recall *recall, void *context);

/* Where, besides, the parents of children come from that were selected by single cases, which are not stored: the ids
 * of both, or false. With the context of tn_evolution_recall, by several threads at once. */
typedef bool tn_recall_parents(void *context, uint64_t id, uint64_t parents[2]);
void tn_evolution_recall_parents(tn_evolution *evolution, tn_recall_parents *recall);

/* A parent that a person chose. */
typedef struct tn_chosen {
    bool by_id; /* `number` is an id of anybody who was ever born (settings.remembers), not a member's place */
    uint64_t number;
    double weight; /* of its material in its children; 1, or less */
} tn_chosen;

/* The parents of the next generation, chosen by a person, each as often as it shall have children. They are used for
 * the next step only. TN_INVALID (E1232) if there are islands. */
tn_status tn_evolution_choose(tn_evolution *evolution, const tn_chosen *chosen, size_t count, tn_error *error);

/* From here on genomes are remembered. Before the first step. */
void tn_evolution_remember(tn_evolution *evolution);

/* A person's genome becomes a member at once, in the place of the member with the id `out`, or where there is room
 * (tn_evolution_worst) TN_NO_PARENT. `parent`: the id of whom it was made from by hand, or TN_NO_PARENT. It is a score
 * that is recalled, where scores are. TN_INVALID (E1241) if there is no such member. */
tn_status tn_evolution_insert(tn_evolution *evolution, const tn_genome *genome, uint64_t out, uint64_t parent,
                              tn_error *error);

/* A member is one no more, and the next generation is bred without it. TN_INVALID (E1241) if there is no such
 * member, or as few as can be. */
tn_status tn_evolution_remove(tn_evolution *evolution, uint64_t id, tn_error *error);

/* The id of the worst member, or TN_NO_PARENT if there are fewer than the population. */
uint64_t tn_evolution_worst(const tn_evolution *evolution);

/* From here on the population has another size; where it is smaller, the best members stay. Of a change that is made
 * again, `left` are the ids of those that left then, in ascending order, and they leave; otherwise it is NULL.
 * TN_INVALID (E1240) if it cannot. */
tn_status tn_evolution_resize(tn_evolution *evolution, uint32_t population, const uint64_t *left, size_t left_count,
                              tn_error *error);

/* Those whom a person inserted before the newest generation, in order of their ids. Valid until the next step. */
const tn_individual *const *tn_evolution_inserted(const tn_evolution *evolution, size_t *count);

/* The id of whoever is born or inserted next: all ids that were given are smaller. */
uint64_t tn_evolution_next_id(const tn_evolution *evolution);

/* Makes the first generation, then at each call the next. With several ranks, together, and it fails for all alike. */
tn_status tn_evolution_step(tn_evolution *evolution, tn_error *error);

/* The same, where this rank may have failed on its way here: then `error` says how, and the step fails for all ranks.
 * So what only one of them does before a step, and may fail in, does not keep the others waiting. */
tn_status tn_evolution_step_after(tn_evolution *evolution, tn_status status, tn_error *error);

/* Scores all members again, after the evaluator's targets have changed. */
tn_status tn_evolution_rescore(tn_evolution *evolution, tn_error *error);

/* How genomes of codons vary; another way, from the next generation on. Genomes of another kind have none: NULL, and
 * nothing changes. */
const tn_vary_options *tn_evolution_varies(const tn_evolution *evolution);
void tn_evolution_vary(tn_evolution *evolution, const tn_vary_options *vary);

/* The members, the best first; and those born in the last step, in order of their ids. Valid until the next step. */
const tn_individual *const *tn_evolution_members(const tn_evolution *evolution, size_t *count);
const tn_individual *const *tn_evolution_born(const tn_evolution *evolution, size_t *count);

/* How many different sentences have scores: those that were ever scored, or scored again since targets changed. */
size_t tn_evolution_known(const tn_evolution *evolution);

/* The number of the newest generation; that after the first step is 0. */
uint32_t tn_evolution_generation(const tn_evolution *evolution);

tn_generation_stats tn_evolution_stats(const tn_evolution *evolution);

/* With several objectives: how many of the members, from the best on, are on the first front. */
size_t tn_evolution_front(const tn_evolution *evolution);

#endif
