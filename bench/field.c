/* How long fields take: field FILE.tnb SAMPLES THREADS RUNS
 *
 * FILE.tnb is a module with surfaces. Meshes each from its code to indexed triangles, as often as RUNS says, and prints
 * its name, how many triangles it has, and the median of the seconds: of the thread's own time, or with several threads
 * by the clock. Behind the last, the seconds of a sample by rows and by the interpreter (surface klein, if there is
 * one), and the most memory that the process had, in bytes. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "bench/field_mesh.h"

enum { RUNS_MAX = 101 };

/* Seconds a sample, of a block of 64 x 16 rows of 256 samples. */
static double evaluate(const tn_module *module, uint32_t surface, bool interpret)
{
    enum { BATCHES = 64, ROWS = 16 };
    tn_field field;
    tn_field_runner runner;
    tn_error error;
    double sum = 0;
    if (tn_field_read(module, surface, NULL, &field, &error) != TN_OK ||
        tn_field_runner_new(&field, &field.samples, interpret, &runner, &error) != TN_OK)
        stop(error.message);
    double begun = seconds(CLOCK_THREAD_CPUTIME_ID);
    for (int batch = 0; batch < BATCHES; batch++) {
        for (uint32_t i = 0; i < TN_ROW; i++) {
            runner.rows.coordinates[1][i] = i / 8 * 0.01 + batch * 0.1 - 3;
            runner.rows.coordinates[2][i] = i % 8 * 0.01 - 1;
        }
        tn_field_prepare(&runner);
        for (int row = 0; row < ROWS; row++) {
            for (uint32_t i = 0; i < TN_ROW; i++)
                runner.rows.coordinates[0][i] = i * 0.01 + row * 0.3 - 3;
            sum += tn_field_run(&runner)[row];
        }
    }
    double took = seconds(CLOCK_THREAD_CPUTIME_ID) - begun;
    tn_field_runner_clear(&runner);
    tn_field_clear(&field);
    return took / (BATCHES * ROWS * TN_ROW) + (sum == 0.123 ? 1 : 0); /* the sum is used, so that nothing is left out */
}

static double median_evaluate(const tn_module *module, uint32_t surface, bool interpret, int runs)
{
    double times[RUNS_MAX];
    for (int i = 0; i < runs; i++)
        times[i] = evaluate(module, surface, interpret);
    return median(times, runs);
}

int main(int argc, char **argv)
{
    if (argc != 5)
        stop("usage: field FILE.tnb SAMPLES THREADS RUNS");
    tn_module *module = load_module(argv[1]);
    uint32_t samples = (uint32_t)atoi(argv[2]);
    unsigned threads = (unsigned)atoi(argv[3]);
    clockid_t clock = threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
    int runs = atoi(argv[4]) < RUNS_MAX ? atoi(argv[4]) : RUNS_MAX;
    if (runs < 1 || samples < 2)
        stop("give a grid and how many runs");
    for (uint32_t s = 0; s < module->SURFACE_count; s++) {
        double times[RUNS_MAX];
        size_t faces = 0;
        for (int i = 0; i < runs; i++)
            times[i] = mesh_once(module, s, samples, threads, clock, &faces);
        printf("%s %zu %.6f\n", tn_text(module, module->SURFACE_records[s].name), faces, median(times, runs));
    }
    for (uint32_t s = 0; s < module->SURFACE_count; s++)
        if (strcmp(tn_text(module, module->SURFACE_records[s].name), "klein") == 0)
            printf("sample rows %.12f interpreter %.12f\n", median_evaluate(module, s, false, runs),
                   median_evaluate(module, s, true, runs));
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    printf("memory %ld\n", usage.ru_maxrss * 1024);
    tn_module_free(module);
    return 0;
}
