#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/evolve.h"
#include "runtime/vm/crew.h"
#include "runtime/vm/file.h"

#define DATA_BYTES_MAX ((size_t)256 << 20)

void tn_evolution_job_clear(tn_evolution_job *job)
{
    tn_problem_free(job->problem);
    tn_learner_free(job->learner);
    tn_grower_free(job->grower);
    tn_grammar_free(job->grammar);
    for (size_t i = 0; i < job->seed_count; i++)
        tn_genome_clear(&job->seeds[i]);
    free(job->seeds);
    free(job->identity);
    *job = (tn_evolution_job){0};
}

/* A path that a study names lies relative to the study. */
static char *beside(const char *study, const char *path)
{
    const char *slash = path[0] == '/' ? NULL : strrchr(study, '/');
    size_t folder = slash ? (size_t)(slash - study) + 1 : 0, size = folder + strlen(path) + 1;
    char *joined = malloc(size);
    if (joined)
        snprintf(joined, size, "%.*s%s", (int)folder, study, path);
    return joined;
}

/* Which of an engine's names a word is; the compiler has checked that it is one. */
static int number_of(const char *word, const char *const *names, int count)
{
    for (int i = 0; i < count; i++)
        if (strcmp(word, names[i]) == 0)
            return i;
    return 0;
}

/* ---- settings */

static void translate(const tn_evolution_study *s, const tn_grammar *grammar, const tn_evolution_job_options *options,
                      tn_evolution_settings *out)
{
    *out = tn_evolution_settings_default();
    out->seed = options->says_seed ? options->seed : s->seed;
    out->population = (uint32_t)s->population;
    out->initialisation = (tn_initialisation)number_of(s->initialise, tn_initialisation_names, TN_INITIALISE_COUNT);
    out->codons = (uint32_t)s->codons;
    out->depth_low = (uint32_t)s->depth_low;
    out->depth_high = (uint32_t)s->depth_high;
    out->tail = s->tail;
    out->select.selection = (tn_selection)number_of(s->selection, tn_selection_names, TN_SELECT_COUNT);
    bool tournament = out->select.selection == TN_SELECT_TOURNAMENT || out->select.selection == TN_SELECT_NSGA2;
    if (s->says_selection_value && tournament)
        out->select.tournament = s->selection_value < 1 ? 1 : (uint32_t)s->selection_value;
    else if (s->says_selection_value)
        out->select.truncation = s->selection_value;
    out->vary.crossover = (tn_crossover)number_of(s->crossover, tn_crossover_names, TN_CROSS_COUNT);
    out->vary.crossover_rate = s->crossover_rate;
    out->vary.mutation = (tn_mutation)number_of(s->mutation, tn_mutation_names, TN_MUTATE_COUNT);
    out->vary.mutation_rate = s->mutation_rate;
    out->vary.within_used = strcmp(s->points, "used") == 0;
    out->vary.codon_limit = s->codon_limit;
    out->vary.max_codons = s->max_codons;
    out->vary.tree_depth = (uint32_t)(s->says_tree_depth ? s->tree_depth : s->depth_high);
    out->elites = (uint32_t)s->elites;
    out->replacement = (tn_replacement)number_of(s->replacement, tn_replacement_names, TN_REPLACE_COUNT);
    out->mapping = tn_map_options_of(grammar);
    if (s->says_max_depth)
        out->mapping.max_depth = (uint32_t)s->max_depth;
    if (s->says_wraps)
        out->mapping.wraps = (uint32_t)s->wraps;
    out->mapping.max_steps = s->max_steps;
    out->threads = options->threads ? options->threads : tn_crew_default();
}

/* Everything that decides what the run does, but for how long: two runs of one identity are the same run. */
static char *identity_of(const tn_evolution_job *job)
{
    const tn_evolution_study *s = &job->study;
    const tn_evolution_settings *t = &job->settings;
    char *text = NULL;
    int length = asprintf(
        &text,
        "problem %d grow \"%s\" match \"%s\" fit \"%s\" keep \"%s\" drop \"%s\" schema \"%s\" seed %llu population %u "
        "initialise %s codons %u "
        "codon-limit %llu max-codons %zu depth %u..%u tail %.17g seeds %zu selection %s %u %.17g crossover %s %.17g "
        "mutation %s %.17g "
        "points %s elites %u replacement %s max-depth %u wraps %u tree-depth %u max-steps %llu length-weight %.17g",
        (int)s->problem, s->grow ? s->grow : "", s->match ? s->match : "", s->fit ? s->fit : "", s->keep ? s->keep : "",
        s->drop ? s->drop : "", s->schema, (unsigned long long)t->seed, t->population, s->initialise, t->codons,
        (unsigned long long)t->vary.codon_limit, t->vary.max_codons, t->depth_low, t->depth_high, t->tail,
        job->seed_count, s->selection, t->select.tournament, t->select.truncation, s->crossover, t->vary.crossover_rate,
        s->mutation, t->vary.mutation_rate, s->points, t->elites, s->replacement, t->mapping.max_depth,
        t->mapping.wraps, t->vary.tree_depth, (unsigned long long)t->mapping.max_steps, s->length_weight);
    return length < 0 ? NULL : text;
}

/* ---- the problem */

static tn_status read_data(const char *study, const char *name, uint8_t **bytes, size_t *size, tn_error *error)
{
    char *path = beside(study, name);
    tn_status status = path ? tn_file_read(path, DATA_BYTES_MAX, bytes, size, error) : tn_fail_memory(error);
    free(path);
    return status;
}

static tn_status make_fit(tn_evolution_job *job, const char *path, tn_error *error)
{
    uint8_t *bytes;
    size_t size;
    tn_status status = read_data(path, job->study.fit, &bytes, &size, error);
    if (status != TN_OK)
        return status;
    status = tn_problem_fit_csv((const char *)bytes, size, job->settings.threads, &job->problem, error);
    free(bytes);
    return status;
}

static tn_status make_learner(tn_evolution_job *job, const char *path, tn_error *error)
{
    char *keep = beside(path, job->study.keep), *drop = beside(path, job->study.drop);
    bool separately = job->settings.select.selection == TN_SELECT_NSGA2;
    tn_status status = keep && drop ? tn_learner_new(job->study.schema, keep, drop, job->study.length_weight,
                                                     separately, &job->learner, error)
                                    : tn_fail_memory(error);
    free(keep);
    free(drop);
    return status;
}

static tn_status make_grower(tn_evolution_job *job, const char *path, tn_error *error)
{
    char *study = beside(path, job->study.grow);
    bool separately = job->settings.select.selection == TN_SELECT_NSGA2;
    tn_status status =
        study ? tn_grower_new(study, separately, job->settings.threads, &job->grower, error) : tn_fail_memory(error);
    free(study);
    return status;
}

static tn_status never_evaluate(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                                char message[200], tn_error *error)
{
    (void)context, (void)thread, (void)sentence, (void)size, (void)score, (void)message;
    return tn_fail(error, TN_INTERNAL, 0, "a score is missing in the run's database");
}

static tn_status make_problem(tn_evolution_job *job, const char *path, bool only_replay, tn_error *error)
{
    tn_status status = TN_OK;
    size_t objectives = job->settings.select.selection == TN_SELECT_NSGA2 ? 2 : 1;
    job->extension = job->study.problem == TN_EVOLVE_LEARN  ? "plan"
                     : job->study.problem == TN_EVOLVE_GROW ? "hemls"
                                                            : "txt";
    if (only_replay) {
        job->evaluator = (tn_evaluator){NULL, objectives, never_evaluate, NULL};
        return TN_OK;
    }
    if (job->study.problem == TN_EVOLVE_MATCH)
        status = tn_problem_match(job->study.match, &job->problem, error);
    else if (job->study.problem == TN_EVOLVE_FIT)
        status = make_fit(job, path, error);
    else if (job->study.problem == TN_EVOLVE_GROW)
        status = make_grower(job, path, error);
    else
        status = make_learner(job, path, error);
    if (status == TN_OK)
        job->evaluator = job->grower    ? tn_grower_evaluator(job->grower)
                         : job->learner ? tn_learner_evaluator(job->learner)
                                        : tn_problem_evaluator(job->problem);
    return status;
}

/* First genomes from a file, one a line. */
static tn_status read_seeds(tn_evolution_job *job, const char *path, tn_error *error)
{
    uint8_t *bytes;
    size_t size, line = 0, capacity = 0;
    tn_status status = read_data(path, job->study.seeds, &bytes, &size, error);
    if (status != TN_OK)
        return status;
    for (size_t at = 0; at < size && status == TN_OK; at++) {
        const uint8_t *end = memchr(bytes + at, '\n', size - at);
        size_t length = end ? (size_t)(end - bytes) - at : size - at;
        line++;
        if (length && bytes[at] != '#' && job->seed_count < job->study.population) {
            if (job->seed_count == capacity) {
                capacity = capacity ? capacity * 2 : 16;
                tn_genome *grown = realloc(job->seeds, capacity * sizeof *grown);
                if (!grown) {
                    status = tn_fail_memory(error);
                    break;
                }
                job->seeds = grown;
            }
            job->seeds[job->seed_count] = (tn_genome){0};
            status = tn_genome_read((const char *)bytes + at, length, &job->seeds[job->seed_count++], error);
            if (status != TN_OK && error)
                error->line = line;
        }
        at += length;
    }
    free(bytes);
    return status;
}

tn_status tn_evolution_job_make(const tn_evolution_study *study, const char *path, const tn_module *module,
                                const tn_evolution_job_options *options, tn_evolution_job *job, tn_error *error)
{
    *job = (tn_evolution_job){.study = *study};
    tn_status status = tn_grammar_new(module, 0, &job->grammar, error);
    if (status == TN_OK)
        translate(study, job->grammar, options, &job->settings);
    if (status == TN_OK && study->seeds)
        status = read_seeds(job, path, error);
    if (status == TN_OK) {
        job->settings.seeds = job->seeds;
        job->settings.seed_count = job->seed_count;
        status = make_problem(job, path, options->only_replay, error);
    }
    if (status == TN_OK && !(job->identity = identity_of(job)))
        status = tn_fail_memory(error);
    return status;
}
