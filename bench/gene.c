/* Times mapping and evolution in memory: bench_gene WORDS.tnb ARITHMETIC.tnb SMALL.tnb WIDE.tnb LONG.tnb
 *
 * Mapping: random genomes of 200 codons, one thread's processor time. Evolution: string match and Vladislavleva-4,
 * population 500, 50 generations, by 1, 2 and 4 threads. Prints one figure a line, the best of some runs. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "bench/bench.h"
#include "runtime/base/random.h"
#include "runtime/genome/breeding/evolve.h"
#include "runtime/genome/breeding/problem.h"

enum { GENOMES = 20000, CODONS = 200, ROUNDS = 9, REPEATS = 10, POINTS = 1024, VARIABLES = 5, GENERATIONS = 50 };

static tn_grammar *load(const char *path)
{
    tn_module *module = load_module(path);
    tn_grammar *grammar;
    tn_error error;
    if (tn_grammar_new(module, 0, &grammar, &error) != TN_OK)
        stop(error.message);
    tn_module_free(module);
    return grammar;
}

/* What else the machine does can only add. */
static double least(const double *values, size_t count)
{
    double best = values[0];
    for (size_t i = 1; i < count; i++)
        best = values[i] < best ? values[i] : best;
    return best;
}

static void bench_mapping(const char *name, const char *path)
{
    tn_grammar *grammar = load(path);
    tn_mapper *mapper = tn_mapper_new(grammar);
    uint64_t *codons = malloc(sizeof *codons * GENOMES * CODONS), used = 0, valid = 0;
    tn_mapping_options options = tn_mapping_options_of(grammar);
    tn_mapping mapping;
    double times[ROUNDS];
    if (!mapper || !codons)
        stop("out of memory");
    for (uint64_t i = 0; i < (uint64_t)GENOMES * CODONS; i++)
        codons[i] = tn_random64(1, 2, i) % 100000;
    for (int round = 0; round < ROUNDS; round++) {
        double start = seconds(CLOCK_THREAD_CPUTIME_ID);
        used = valid = 0;
        for (int repeat = 0; repeat < REPEATS; repeat++)
            for (size_t i = 0; i < GENOMES; i++) {
                tn_mapper_derive(mapper, codons + i * CODONS, CODONS, &options, &mapping, NULL);
                used += mapping.valid ? mapping.used : CODONS;
                valid += mapping.valid;
            }
        times[round] = seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    }
    double maps = (double)GENOMES * REPEATS;
    printf("map %-12s %8.2f million a second, %6.1f codons each, %3.0f %% valid\n", name,
           maps / least(times, ROUNDS) / 1e6, (double)used / maps, 100 * (double)valid / maps);
    free(codons);
    tn_mapper_free(mapper);
    tn_grammar_free(grammar);
}

/* 10 / (5 + sum (x - 3)^2) at random points of [0.05, 6.05]^5 (Vladislavleva et al., 2009, problem 4). */
static tn_problem *vladislavleva_4(unsigned threads)
{
    static double columns[VARIABLES + 1][POINTS];
    static const char *const names[] = {"x0", "x1", "x2", "x3", "x4"};
    const double *pointers[VARIABLES + 1];
    tn_problem *problem;
    for (uint64_t i = 0; i < POINTS; i++) {
        double sum = 5;
        for (uint64_t k = 0; k < VARIABLES; k++) {
            columns[k][i] = 0.05 + 6 * (double)(tn_random64(1, k, i) >> 11) * 0x1p-53;
            sum += (columns[k][i] - 3) * (columns[k][i] - 3);
        }
        columns[VARIABLES][i] = 10 / sum;
    }
    for (size_t k = 0; k <= VARIABLES; k++)
        pointers[k] = columns[k];
    if (tn_problem_fit(names, pointers, VARIABLES, POINTS, &(tn_fit_options){.threads = threads}, &problem, NULL) !=
        TN_OK)
        stop("out of memory");
    return problem;
}

static double run(const tn_grammar *grammar, tn_problem *problem, unsigned threads, bool fit, double *best)
{
    tn_evaluator evaluator = tn_problem_evaluator(problem);
    tn_evolution_settings settings = tn_evolution_settings_default();
    tn_evolution *evolution;
    settings.threads = threads;
    settings.mapping = tn_mapping_options_of(grammar);
    settings.mapping.max_depth = fit ? 17 : 0;
    settings.depth_low = fit ? 2 : 5;
    settings.depth_high = fit ? 8 : 20;
    double start = seconds(CLOCK_MONOTONIC);
    if (tn_evolution_new(grammar, &settings, &evaluator, &evolution, NULL) != TN_OK)
        stop("out of memory");
    for (int g = 0; g <= GENERATIONS; g++)
        if (tn_evolution_step(evolution, NULL) != TN_OK)
            stop("a generation failed");
    double time = seconds(CLOCK_MONOTONIC) - start;
    *best = tn_evolution_stats(evolution).best[0];
    tn_evolution_free(evolution);
    return time;
}

static void bench_evolution(const char *name, const char *path, bool fit)
{
    tn_grammar *grammar = load(path);
    for (unsigned threads = 1; threads <= 4; threads *= 2) {
        double times[ROUNDS], best = 0;
        for (int round = 0; round < ROUNDS; round++) {
            tn_problem *problem = NULL;
            if (fit)
                problem = vladislavleva_4(threads);
            else if (tn_problem_match("Hello world", &problem, NULL) != TN_OK)
                stop("out of memory");
            times[round] = run(grammar, problem, threads, fit, &best);
            tn_problem_free(problem);
        }
        printf("evolve %-16s %u threads %8.1f ms, best %.4g\n", name, threads, least(times, ROUNDS) * 1e3, best);
    }
    tn_grammar_free(grammar);
}

int main(int count, char **words)
{
    if (count != 6)
        stop("usage: bench_gene WORDS.tnb ARITHMETIC.tnb SMALL.tnb WIDE.tnb LONG.tnb");
    bench_mapping("4 rules", words[3]);
    bench_mapping("40 rules", words[4]);
    bench_mapping("long", words[5]);
    bench_evolution("string match", words[1], false);
    bench_evolution("Vladislavleva-4", words[2], true);
    return 0;
}
