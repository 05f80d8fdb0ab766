/* From a study to a run: the grammar, the problem and the settings put together; and a run in a folder, with its
 * database, resumed or new, generation by generation.
 *
 *   DIR/run.sqlite   the run (runtime/genome/store/run_store.h)
 *   DIR/best/        the best sentences as files, with pictures, and scores.csv
 *   DIR/stats.csv    a line a generation
 *   DIR/fitness.svg  the same, drawn
 */
#ifndef TARTAN_DRIVER_BREED_EVOLVE_H
#define TARTAN_DRIVER_BREED_EVOLVE_H

#include "driver/breed/builder.h"
#include "driver/breed/evolve_results.h"
#include "driver/breed/field_parents.h"
#include "driver/breed/field_scorer.h"
#include "driver/breed/grower.h"
#include "driver/breed/learn.h"
#include "driver/breed/skeleton.h"
#include "driver/hand/hand.h"
#include "driver/open/open.h"
#include "driver/place/placer.h"
#include "driver/program/program_scorer.h"
#include "runtime/genome/breeding/problem.h"
#include "runtime/genome/settings.h"
#include "runtime/genome/store/run_store.h"
#include "runtime/geometry/guide/guide.h"
#include "runtime/geometry/mesh.h"

/* What is bred, where it has a form that can be drawn: a surface, or a design of boxes. Functions as tn_grower_draw and
 * tn_grower_objective. */
typedef struct tn_bred_forms {
    const void *context; /* NULL: it has none */
    const char *what;    /* "surface", "form" or "model" */
    const char *picture; /* what files of pictures end in: ".svg" or ".png" */
    tn_status (*draw)(const void *context, const char *const *sentences, const char *const *labels, size_t count,
                      const char *title, tn_picture *to, tn_error *error);
    const char *(*objective)(const void *context, size_t i);
    /* A form as a mesh, z up, and what explains it (guides); NULL: there is none. The caller clears both. */
    tn_status (*mesh)(const void *context, const char *sentence, tn_mesh *mesh, tn_guides *guides, tn_error *error);
    /* As tn_grower_unmet; NULL: nothing can be required. */
    tn_status (*unmet)(const void *context, const char *sentence, char **text, tn_error *error);
} tn_bred_forms;

/* Those of designs of boxes, whether grammars write them or genes are them. The scorer is borrowed. */
tn_bred_forms tn_bred_designs(const tn_design_scorer *designs);

/* What is evolved. Zero it to begin with; clear it in any case. */
typedef struct tn_evolution_job {
    tn_evolution_study study; /* texts borrowed from where it was read */
    tn_setting blamed;        /* where making the job failed: the setting that named what is wrong, or
                                 TN_SETTING_COUNT */
    uint32_t blamed_each;     /* where that may be there more than once: its number among study.each */
    char *blamed_path;        /* and the file that it names, where an error has its place in that; or NULL */
    tn_grammar *grammar;      /* of codons; NULL: of forms */
    tn_genome_kind kind;      /* of forms */
    tn_field_parents *parents;
    tn_field_scorer *fields;
    tn_skeleton *skeleton;
    tn_evolution_settings settings;
    tn_evaluator evaluator;
    tn_problem *problem;
    tn_learner *learner;
    tn_grower *grower;
    tn_design_scorer *designs;
    tn_placer *placer;
    tn_program_scorer *program; /* that scores too, or NULL */
    tn_bred_forms forms;
    bool scored; /* there are goals; without them, forms with a surface score 0 */
    tn_genome *seeds;
    size_t seed_count;
    char *seeds_text;      /* the file that they are from, or NULL */
    char *identity;        /* all that decides what the run does, a setting a line */
    char *inputs;          /* what else scores depend on (inputs.h); NULL: nothing */
    const char *extension; /* of the files of best/ */
} tn_evolution_job;

typedef struct tn_evolution_job_options {
    unsigned threads;      /* 0: as many as there are */
    tn_watch *watch;       /* borrowed, or NULL: breeding gives up (TN_STOPPED) once this says so */
    const tn_ranks *ranks; /* borrowed, or NULL: those that make the same run together */
    bool says_seed;
    uint64_t seed;
    bool only_replay;         /* no evaluating: scores will be recalled */
    uint64_t objectives;      /* then: how many the run has */
    const char *stored_seeds; /* the text of the seeds' file, where it is known already; or NULL */
    bool run_programs;        /* the study's program may be run */
    bool remembers;           /* whoever was born can be chosen as a parent later */
    bool draws_open;          /* pictures of fields show forms that end at the box */
} tn_evolution_job_options;

/* Makes the job of a study at `path` (data files lie relative to it), with the module of it and of its grammar, if it
 * has one. */
tn_status tn_evolution_job_make(const tn_evolution_study *study, const char *path, const tn_module *module,
                                const tn_evolution_job_options *options, tn_evolution_job *job, tn_error *error);
void tn_evolution_job_clear(tn_evolution_job *job);

/* ---- a run */

typedef struct tn_run_options {
    bool resume;
    bool durable;
    bool rescore; /* where a resumed run's inputs have changed, all members are scored again; otherwise E1252 */
} tn_run_options;

/* What is worth saying of a run's first generation (evolve_begin.c). */
typedef struct tn_finding {
    tn_code code; /* of a warning */
    char message[200], help[300];
    char text[520]; /* both, as the database has them */
} tn_finding;

#define TN_FINDINGS_MAX 3u

typedef struct tn_first_look {
    tn_finding items[TN_FINDINGS_MAX];
    size_t count;
} tn_first_look;

typedef struct tn_run {
    tn_evolution_job *job; /* borrowed */
    char *dir;             /* NULL: it has no folder, and nothing is stored */
    char *study;           /* the name of its study's file, without folders */
    bool locked;           /* nobody else writes the folder: `lock` is its descriptor */
    int lock;
    tn_run_store *store; /* NULL without a folder, and on ranks but the first, which alone writes */
    tn_evolution *evolution;
    uint32_t generations;      /* done */
    tn_generation_stats *kept; /* without a folder: of each */
    size_t kept_count;
    tn_first_look look; /* once the first generation was made here; the database has it as events "warning" */
    tn_run_event *
        changes; /* of targets, weights and inputs: all that were made, the last `new_changes` of them not stored yet */
    size_t change_count, new_changes;
    tn_run_event *waiting; /* what was stored to be done by hand before the next generation */
    size_t waiting_count;
    bool idle;             /* the newest generation brought no sentence that had no score yet */
    size_t sentences;      /* of the grammar, once they were counted; SIZE_MAX: many */
    tn_rescored *rescored; /* by those */
    size_t rescored_count;
    tn_error
        store_failure; /* with several ranks: why the generation before could not be stored (status), not said yet */
} tn_run;

/* What of the study and its grammar a database keeps, so that a run can be replayed from it alone. */
typedef struct tn_run_texts {
    const char *study_path, *study_text, *grammar_path, *grammar_text;
} tn_run_texts;

/* With several ranks, these are called together, and fail for all of them alike: tn_run_begin, tn_run_step, tn_run_set,
 * tn_run_settle.
 *
 * Starts a run in the folder `dir`, which is made, or goes on with the one that is there: then all its generations are
 * made again, without evaluating. dir NULL: a run without a folder. */
tn_status tn_run_begin(tn_evolution_job *job, const char *dir, const tn_run_options *options, const tn_run_texts *texts,
                       tn_run *run, tn_error *error);

/* Makes and stores the next generation, bred from the parents chosen where a person chose (NULL: selection). With
 * several ranks, the others go on while the first one stores: that it could not is the failure of the next step. */
tn_status tn_run_step(tn_run *run, const tn_chosen *chosen, size_t chosen_count, tn_error *error);

/* After the last step that succeeded: is all that was bred stored? */
tn_status tn_run_settle(tn_run *run, tn_error *error);

/* Changes a target or weight of a run that has begun, as "length-weight 0.01": all members are scored again, and the
 * change is stored with the next generation. A change that holds already changes nothing, so that the same words may be
 * said at every resuming. */
tn_status tn_run_set(tn_run *run, const char *change, tn_error *error);

/* Inserts an individual, edits one or takes one out, as an event of hand.h says it; stored with the next generation.
 */
tn_status tn_run_by_hand(tn_run *run, const char *kind, const char *text, tn_error *error);

/* What sentences of the job are, for what a person writes (driver/hand/hand.h). */
tn_by_hand_language tn_evolution_job_language(const tn_evolution_job *job);

#define TN_SENTENCE_FILE_MAX ((size_t)1 << 20) /* bytes of a sentence that is inserted */

/* Stores such an event in the run of a folder, to be done when the run goes on: what a person has written goes to the
 * place of `member`, or (TN_NO_PARENT) of the worst; with `written` NULL the member is taken out. `left`: the event,
 * whose texts the caller frees. `sentence`: what was written, in one line, which an error may be about; the caller
 * frees it. The others are cleared as after a replay. */
tn_status tn_run_leave(const char *dir, const char *kind, const char *written, uint64_t member, tn_opened *opened,
                       tn_evolution_job *job, tn_run *run, tn_run_event *left, char **sentence, tn_error *error);

/* Is the best score as good as `stop` asks for? */
bool tn_run_reached(const tn_run *run);

/* Has every sentence of the grammar (run->sentences) been scored? It is said after a generation that brought none that
 * is new; only then are they counted. */
bool tn_run_exhausted(tn_run *run);

/* The statistics of its generations; the caller frees *stats. */
tn_status tn_run_stats(const tn_run *run, tn_generation_stats **stats, size_t *count, tn_error *error);

/* Writes best/, stats.csv and fitness.svg, to `files` or (NULL) into the run's folder: where several ranks made the
 * run, by the first. */
tn_status tn_run_results(tn_run *run, const tn_run_files *files, tn_error *error);
void tn_run_clear(tn_run *run);

/* The folder's database: DIR/run.sqlite. The caller frees it; NULL where out of memory. */
char *tn_run_database(const char *dir);

/* Makes generations again from a database until the one in which `id` was born; the individual is valid until run and
 * job are cleared. `opened` holds the grammar and must be closed after them. */
tn_status tn_run_replay(const char *dir, uint64_t id, tn_opened *opened, tn_evolution_job *job, tn_run *run,
                        const tn_individual **individual, tn_error *error);

#endif
