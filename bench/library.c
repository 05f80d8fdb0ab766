/* Times walking a library in memory: bench_library MODULE PLANS
 *
 * Prints what was done and the median seconds a plan of several runs: enumerate (the next plan, in rank order, from the
 * middle of the library on), count (all lengths, of the plans counted anew each time).
 */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "bench/bench.h"
#include "runtime/plan/library/library.h"

enum { RUNS = 5 };

/* Of this thread's own: what else runs on the machine takes time, and is no part of this. */
static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Seconds for the next `count` plans from the middle on. */
static double walk(const tn_library *library, unsigned long count)
{
    tn_cursor *cursor;
    tn_error error;
    mpz_t from, to;
    mpz_inits(from, to, NULL);
    tn_library_kept(library, TN_ALL_LENGTHS, from);
    mpz_fdiv_q_ui(from, from, 2);
    mpz_add_ui(to, from, count);
    if (tn_cursor_new(library, from, to, &cursor, &error) != TN_OK)
        stop(error.message);
    const tn_tray *trays;
    uint32_t length;
    unsigned long walked = 0, sum = 0;
    double start = seconds(CLOCK_THREAD_CPUTIME_ID);
    for (; tn_cursor_next(cursor, &trays, &length); walked++)
        sum += trays[length - 1];
    double time = seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    if (walked != count || sum == 0)
        stop("the library has too few plans");
    tn_cursor_free(cursor);
    mpz_clears(from, to, NULL);
    return time;
}

int main(int argc, char **argv)
{
    if (argc != 3)
        stop("usage: bench_library MODULE PLANS");
    unsigned long count = strtoul(argv[2], NULL, 10);
    tn_error error;
    tn_module *module = load_module(argv[1]);
    tn_schema *schema;
    tn_library *library;
    if (tn_schema_new(module, module->LIBRARY_records[0].schema, 0, &schema, &error) != TN_OK ||
        tn_library_new(schema, 0, NULL, &library, &error) != TN_OK)
        stop(error.message);
    double times[RUNS];
    for (size_t run = 0; run < RUNS; run++)
        times[run] = walk(library, count);
    qsort(times, RUNS, sizeof *times, by_value);
    printf("enumerate %.12f\n", times[RUNS / 2] / (double)count);
    tn_library_free(library);
    tn_schema_free(schema);
    tn_module_free(module);
    return 0;
}
