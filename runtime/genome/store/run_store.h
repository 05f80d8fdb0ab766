/* A run's database (SQLite): settings, generations, every birth with its parents and score, and what a person decided.
 *
 *   meta        key, value: what the run was started from: study text, grammar text, seed, compiler's version, hashes
 *   generation  number, best, mean, scored, no_sentence, failed, limited, distinct_sentences, evaluations, births,
 *               mean_codons, mean_depth, members (8 bytes an id, little-endian, the best first), lower_quartile,
 *               median, upper_quartile
 *   birth       id, kind, parent, other, state, fitness, more (the further numbers of the score, 8 bytes each), message
 *   event       generation, number, kind, text, before that generation is bred: choose (places, from 1), set (a target,
 *               weight or another number), left (who left by the change before it), inputs (what scores depend on),
 *               insert, edit and remove (driver/hand/hand.h); warning (what the first generation shows)
 *   rescore     generation, id, state, fitness, more: the members' scores after a set
 *
 * Genomes are not stored: births are functions of parents, settings and seed, and replaying is exact. Nothing stored
 * depends on the clock, the machine, or an interruption: a generation is one transaction, so that a run that was killed
 * and resumed ends with the same bytes as one that was not.
 */
#ifndef TARTAN_GENOME_STORE_RUN_STORE_H
#define TARTAN_GENOME_STORE_RUN_STORE_H

#include "runtime/genome/breeding/evolve.h"

typedef struct tn_run_store tn_run_store;

/* Makes a new database; TN_INVALID (E1250) if the file is there already. `durable` also survives the loss of power.
 */
tn_status tn_run_store_create(const char *path, bool durable, tn_run_store **store, tn_error *error);

/* Opens one that is there, to go on with (or only to read). TN_IO if it is not, TN_INVALID (E1251) if it is none.
 */
tn_status tn_run_store_open(const char *path, bool durable, bool read_only, tn_run_store **store, tn_error *error);
void tn_run_store_free(tn_run_store *store);

/* Does the file hold a run that has begun, or one that was killed before it did? TN_INVALID (E1251) if it is
 * something else, or damaged. */
tn_status tn_run_store_begun(const char *path, bool *begun, tn_error *error);

/* All meta values are written in one transaction, before the first generation. */
tn_status tn_run_store_put_meta(tn_run_store *store, const char *const *keys, const char *const *values, size_t count,
                                tn_error *error);
/* The caller frees *value; NULL if there is none. */
tn_status tn_run_store_get_meta(tn_run_store *store, const char *key, char **value, tn_error *error);

/* Why an individual that was evaluated had no score; empty where nothing is known of that. */
tn_status tn_run_store_message(tn_run_store *store, uint64_t id, char message[200], tn_error *error);

/* How many generations are stored, from 0 on. */
tn_status tn_run_store_generations(tn_run_store *store, uint32_t *count, tn_error *error);

typedef struct tn_run_event {
    uint32_t generation;
    char *kind, *text;
} tn_run_event;

typedef struct tn_rescored {
    uint64_t id;
    tn_score score;
} tn_rescored;

/* Stores an event before a generation that is not made yet, behind those that are there. */
tn_status tn_run_store_put_event(tn_run_store *store, uint32_t generation, const char *kind, const char *text,
                                 tn_error *error);

/* Stores the generation that was made last, and the events and scores that came before it, in one transaction. Scores
 * have `numbers` (tn_evaluator_numbers), here and where they are read. */
tn_status tn_run_store_put(tn_run_store *store, const tn_evolution *evolution, size_t numbers,
                           const tn_run_event *events, size_t event_count, const tn_rescored *rescored,
                           size_t rescored_count, tn_error *error);

/* The members' scores after the changes before a generation, in order of their ids. The caller frees *rescored. */
tn_status tn_run_store_rescored(tn_run_store *store, uint32_t generation, size_t numbers, tn_rescored **rescored,
                                size_t *count, tn_error *error);

/* All events, in order. The caller frees with tn_run_events_free. */
tn_status tn_run_store_events(tn_run_store *store, tn_run_event **events, size_t *count, tn_error *error);
void tn_run_events_free(tn_run_event *events, size_t count);

/* All scores, for tn_evolution_recall. */
typedef struct tn_run_scores {
    tn_score *scores;       /* by id; owned */
    uint64_t (*parents)[2]; /* owned; TN_NO_PARENT if there is none; NULL: not known here */
    uint8_t *known;
    size_t count;
} tn_run_scores;

tn_status tn_run_store_scores(tn_run_store *store, size_t numbers, tn_run_scores *scores, tn_error *error);
void tn_run_scores_clear(tn_run_scores *scores);
bool tn_run_scores_recall(void *scores, uint64_t id, tn_score *score);
bool tn_run_scores_recall_parents(void *scores, uint64_t id, uint64_t parents[2]);

/* Are these the members that the stored generation has, in this order? TN_INVALID (E1252) if not: then the database
 * is of another study, grammar or version. */
tn_status tn_run_store_check(tn_run_store *store, const tn_evolution *evolution, tn_error *error);

/* The statistics of all stored generations; the caller frees *stats. */
tn_status tn_run_store_stats(tn_run_store *store, tn_generation_stats **stats, size_t *count, tn_error *error);

#endif
