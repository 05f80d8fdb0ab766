/* How fast surfaces are bred: bench_breeding GRAMMAR.tnb STUDY
 *
 * A run of evolution whose first genomes all grow to about 1,000 faces, and what came of them, by 1, 2 and 4 threads:
 * all of the run (breeding, mapping, compiling, growing, the six fitness terms), the same sentences scored again, and
 * their rules, compiled beforehand, only grown. Prints a line a number of threads, each the best of some runs: what
 * else the machine does can only add. Processor time says what threads cost one another, also on a busy machine. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bench/bench.h"
#include "driver/breed/grower.h"
#include "driver/open/open.h"
#include "runtime/base/crew.h"
#include "runtime/genome/breeding/evolve.h"
#include "runtime/growth/study.h"
#include "runtime/mesh/openmesh.h"

enum { POPULATION = 400, GENERATIONS = 5, ROUNDS = 5, FACES_LOW = 500, FACES_HIGH = 2000, THREADS = 4 };

/* Seconds of the clock, and of all processors. */
typedef struct spent {
    double time, processors;
} spent;

static spent begin(void)
{
    return (spent){seconds(CLOCK_MONOTONIC), seconds(CLOCK_PROCESS_CPUTIME_ID)};
}

/* Keeps the least of each. */
static void end(spent began, spent *so_far)
{
    double time = seconds(CLOCK_MONOTONIC) - began.time;
    double processors = seconds(CLOCK_PROCESS_CPUTIME_ID) - began.processors;
    if (so_far->time == 0 || time < so_far->time)
        so_far->time = time;
    if (so_far->processors == 0 || processors < so_far->processors)
        so_far->processors = processors;
}

/* ---- growth alone */

typedef struct sample {
    char *sentence;
    size_t size;
    tn_opened opened;
    tn_growth_system *system; /* NULL: it does not compile */
    uint32_t faces;
} sample;

typedef struct bench {
    const tn_study *study;
    tn_growth **growths; /* by thread */
    tn_evaluator evaluator;
    sample *samples;
    size_t count;
} bench;

static void compile(sample *s)
{
    tn_error error;
    if (tn_open_text(TN_NOTATION(hemls), &(tn_input){.text = s->sentence, .size = s->size, .name = "a sentence"},
                     &(tn_compile_options){0}, &s->opened) == TN_OK &&
        tn_growth_system_read(s->opened.module, &s->system, &error) != TN_OK)
        stop(error.message);
}

static void clear(sample *s)
{
    tn_growth_system_free(s->system);
    tn_close(&s->opened);
    free(s->sentence);
}

static tn_status grow(void *context, unsigned thread, size_t item, tn_error *error)
{
    const bench *b = context;
    sample *s = &b->samples[item];
    tn_growth **growth = &b->growths[thread];
    const tn_study *study = b->study;
    if (!s->system)
        return TN_OK;
    tn_status status = *growth ? tn_growth_renew(*growth, s->system, &study->environment, &study->options, error)
                               : tn_growth_new(s->system, &study->environment, &study->options, growth, error);
    for (uint32_t step = 0; step < study->steps && status == TN_OK && !tn_growth_at_rest(*growth); step++)
        status = tn_growth_step(*growth, error);
    s->faces = tn_growth_map(*growth)->face_count - 1;
    return TN_OK;
}

static tn_status score(void *context, unsigned thread, size_t item, tn_error *error)
{
    const bench *b = context;
    tn_score score = {0};
    char message[200];
    return b->evaluator.evaluate(b->evaluator.context, thread, b->samples[item].sentence, b->samples[item].size, &score,
                                 message, error);
}

/* ---- first genomes of the wanted size */

static tn_genome *find_seeds(const bench *b, const tn_grammar *grammar)
{
    tn_genome *seeds = calloc(POPULATION, sizeof *seeds);
    tn_mapper *mapper = tn_mapper_new(grammar);
    tn_mapping_options options = tn_mapping_options_of(grammar);
    tn_tree_options tree = {.method = TN_TREE_GROW,
                            .depth = 6,
                            .max_depth = options.max_depth,
                            .codon_limit = 100000,
                            .tail = 2,
                            .max_codons = 2000};
    tn_analysis analysis;
    tn_error error;
    if (!seeds || !mapper || tn_analyse(grammar, &analysis, &error) != TN_OK)
        stop("out of memory");
    size_t found = 0;
    for (uint64_t i = 0; found < POPULATION; i++) {
        tn_chance chance = tn_chance_for(1, TN_PURPOSE_INITIALISE, 0, i);
        tn_mapping mapping;
        sample one = {0};
        tree.depth = 3 + i % 6;
        if (tn_random_tree(grammar, &analysis, 0, 1, &tree, &chance, &seeds[found], &error) != TN_OK ||
            tn_mapper_derive(mapper, seeds[found].codons, seeds[found].count, &options, &mapping, &error) != TN_OK)
            stop(error.message);
        if (!mapping.valid)
            continue;
        one.sentence = strdup(tn_mapping_sentence(&mapping, &one.size));
        bench alone = {.study = b->study, .growths = b->growths, .samples = &one};
        compile(&one);
        grow(&alone, 0, 0, &error);
        found += one.faces >= FACES_LOW && one.faces <= FACES_HIGH;
        clear(&one);
    }
    tn_analysis_clear(&analysis);
    tn_mapper_free(mapper);
    return seeds;
}

/* ---- the run */

static void breed(const tn_grammar *grammar, const tn_genome *seeds, const tn_evaluator *evaluator, unsigned threads,
                  spent *took)
{
    tn_evolution_settings settings = tn_evolution_settings_default();
    tn_evolution *evolution;
    tn_error error;
    settings.population = POPULATION;
    settings.threads = threads;
    settings.mapping = tn_mapping_options_of(grammar);
    settings.seeds = seeds;
    settings.seed_count = POPULATION;
    spent began = begin();
    if (tn_evolution_new(grammar, &settings, evaluator, &evolution, &error) != TN_OK)
        stop(error.message);
    for (int g = 0; g <= GENERATIONS; g++)
        if (tn_evolution_step(evolution, &error) != TN_OK)
            stop(error.message);
    end(began, took);
    tn_evolution_free(evolution);
}

/* An evaluator for one thread that keeps what it is asked. */
static tn_status keep_and_score(void *context, unsigned thread, const char *sentence, size_t size, tn_score *result,
                                char message[200], tn_error *error)
{
    bench *b = context;
    b->samples = realloc(b->samples, (b->count + 1) * sizeof *b->samples);
    if (!b->samples)
        stop("out of memory");
    sample *one = &b->samples[b->count++];
    *one = (sample){.sentence = strdup(sentence), .size = size};
    compile(one);
    return b->evaluator.evaluate(b->evaluator.context, thread, sentence, size, result, message, error);
}

static void time_crew(bench *b, unsigned threads, tn_crew_work *work, spent *took)
{
    tn_crew *crew = tn_crew_new(threads, NULL);
    if (!crew)
        stop("out of memory");
    spent began = begin();
    tn_crew_run(crew, b->count, 1, work, b, NULL);
    end(began, took);
    tn_crew_free(crew);
}

static double mean_faces(const bench *b)
{
    double sum = 0, grown = 0;
    for (size_t i = 0; i < b->count; i++) {
        sum += b->samples[i].faces;
        grown += b->samples[i].faces > 0;
    }
    return sum / grown;
}

static void report(bench *b, const tn_grammar *grammar, const tn_genome *seeds, unsigned threads)
{
    spent bred = {0}, scored = {0}, grown = {0};
    double n = (double)b->count;
    for (int round = 0; round < ROUNDS; round++) {
        breed(grammar, seeds, &b->evaluator, threads, &bred);
        time_crew(b, threads, score, &scored);
        time_crew(b, threads, grow, &grown);
    }
    printf("breed %u threads: %6.0f evaluations a second of the run, %6.0f scored, %6.0f only grown (%.0f faces); "
           "%.0f us of processors each, %.2f x growth alone\n",
           threads, n / bred.time, n / scored.time, n / grown.time, mean_faces(b), 1e6 * bred.processors / n,
           bred.processors / grown.processors);
}

int main(int count, char **words)
{
    if (count != 3)
        stop("usage: bench_breeding GRAMMAR.tnb STUDY");
    tn_module *module = load_module(words[1]);
    tn_grammar *grammar;
    tn_error error;
    tn_opened opened;
    tn_study study;
    tn_grower *grower;
    if (tn_grammar_new(module, 0, &grammar, &error) != TN_OK ||
        tn_grower_new(words[2], false, false, THREADS, &grower, &error) != TN_OK)
        stop(error.message);
    if (tn_open(words[2], false, &opened) != TN_OK ||
        tn_study_read(opened.module, words[2], &tn_openmesh_reader, &study, &error) != TN_OK)
        stop("the study cannot be read");
    study.options.threads = 1;
    tn_growth *growths[THREADS] = {NULL};
    bench b = {.study = &study, .growths = growths, .evaluator = tn_grower_evaluator(grower)};
    tn_genome *seeds = find_seeds(&b, grammar);
    tn_evaluator keeping = {.context = &b, .objectives = b.evaluator.objectives, .evaluate = keep_and_score};
    breed(grammar, seeds, &keeping, 1, &(spent){0});
    for (unsigned threads = 1; threads <= THREADS; threads *= 2)
        report(&b, grammar, seeds, threads);
    for (size_t i = 0; i < b.count; i++)
        clear(&b.samples[i]);
    for (size_t i = 0; i < POPULATION; i++)
        tn_genome_clear(&seeds[i]);
    for (unsigned t = 0; t < THREADS; t++)
        tn_growth_free(growths[t]);
    free(b.samples);
    free(seeds);
    tn_study_clear(&study);
    tn_close(&opened);
    tn_grower_free(grower);
    tn_grammar_free(grammar);
    tn_module_free(module);
    return 0;
}
