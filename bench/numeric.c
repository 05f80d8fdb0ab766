/* How long elementary functions take: numeric RUNS
 *
 * Computes each function of runtime/math for rows of 256 numbers, and by the functions of version 1 of the
 * arithmetic (bench/before), one number at a time. Prints the function, the range of its arguments, and the nanoseconds
 * of one number by rows, one at a time, and by version 1: medians of RUNS. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench/before/numeric.h"
#include "bench/bench.h"
#include "runtime/base/random.h"
#include "runtime/math/elementary.h"

enum { ROW = 256, ROWS = 64, RUNS_MAX = 101 };

/* One of the functions: of one operand, or of two. */
typedef struct function {
    const char *name;
    double least, most; /* of the operands */
    void (*row)(const double *, double *, size_t);
    double (*one)(double), (*before)(double);
    void (*row_of_2)(const double *, const double *, double *, size_t);
    double (*one_of_2)(double, double), (*before_of_2)(double, double);
} function;

#define OF_1(NAME, LEAST, MOST)                                                                                        \
    {                                                                                                                  \
#NAME, LEAST, MOST, tn_##NAME##_row, tn_##NAME, before_##NAME, NULL, NULL, NULL                                \
    }
#define OF_2(NAME, LEAST, MOST)                                                                                        \
    {                                                                                                                  \
#NAME, LEAST, MOST, NULL, NULL, NULL, tn_##NAME##_row, tn_##NAME, before_##NAME                                \
    }

static const function functions[] = {
    OF_1(sin, -5, 5),  OF_1(sin, -100, 100), OF_1(cos, -5, 5),  OF_1(cos, -100, 100), OF_1(exp, -5, 5),
    OF_1(log, 0, 100), OF_1(tanh, -5, 5),    OF_2(pow, 0.1, 5), OF_2(atan2, -5, 5),
};

static double number_between(double least, double most, uint64_t stream, uint64_t index)
{
    return least + (most - least) * ((double)(tn_random64(1, stream, index) >> 11) * 0x1p-53);
}

static int compare(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

enum way { BY_ROWS, BY_ONE, BEFORE, WAYS };

static void compute(const function *f, enum way way, const double *a, const double *b, double *out)
{
    if (way == BY_ROWS && f->row)
        f->row(a, out, ROW);
    else if (way == BY_ROWS)
        f->row_of_2(a, b, out, ROW);
    else if (f->row) {
        double (*of_1)(double) = way == BY_ONE ? f->one : f->before;
        for (size_t i = 0; i < ROW; i++)
            out[i] = of_1(a[i]);
    } else {
        double (*of_2)(double, double) = way == BY_ONE ? f->one_of_2 : f->before_of_2;
        for (size_t i = 0; i < ROW; i++)
            out[i] = of_2(a[i], b[i]);
    }
}

int main(int argc, char **argv)
{
    int runs = argc > 1 ? atoi(argv[1]) : 0;
    if (runs < 1 || runs > RUNS_MAX)
        stop("usage: numeric RUNS (1 to 101)");
    static double a[ROWS][ROW], b[ROWS][ROW], out[ROW], times[WAYS][RUNS_MAX];
    double sum = 0;
    for (size_t k = 0; k < sizeof functions / sizeof *functions; k++) {
        const function *f = &functions[k];
        for (int i = 0; i < ROWS * ROW; i++) {
            a[i / ROW][i % ROW] = number_between(f->least, f->most, 2 * k, (uint64_t)i);
            b[i / ROW][i % ROW] = number_between(f->least, f->most, 2 * k + 1, (uint64_t)i);
        }
        for (int run = 0; run < runs; run++)
            for (enum way way = BY_ROWS; way < WAYS; way++) {
                double begun = seconds(CLOCK_THREAD_CPUTIME_ID);
                for (int i = 0; i < ROWS; i++) {
                    compute(f, way, a[i], b[i], out);
                    sum += out[i];
                }
                times[way][run] = (seconds(CLOCK_THREAD_CPUTIME_ID) - begun) / (ROWS * ROW) * 1e9;
            }
        printf("%s %g %g", f->name, f->least, f->most);
        for (enum way way = BY_ROWS; way < WAYS; way++) {
            qsort(times[way], (size_t)runs, sizeof **times, compare);
            printf(" %.3f", times[way][runs / 2]);
        }
        putchar('\n');
    }
    return sum == 0.123; /* the sum is used, so that nothing is left out */
}
