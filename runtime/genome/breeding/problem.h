/* Known problems that need nothing but numbers: matching a string, fitting data. Each gives a tn_evaluator. */
#ifndef TARTAN_GENOME_BREEDING_PROBLEM_H
#define TARTAN_GENOME_BREEDING_PROBLEM_H

#include "runtime/genome/breeding/evolve.h"

typedef struct tn_problem tn_problem;

/* How far a sentence is from the target: for each place of the longer one 1, less 1 where the bytes are equal, less
 * 1 / (1 + their difference) where they are not (PonyGE2's string_match). */
tn_status tn_problem_match(const char *target, tn_problem **problem, tn_error *error);

/* The root of the mean squared error of a sentence, read as arithmetic (runtime/number/sentence.h) in the variables named, at
 * points columns[variable][point]; the last column is the value wanted. Copies the numbers. */
tn_status tn_problem_fit(const char *const *names, const double *const *columns, size_t variables, size_t points,
                         unsigned threads, tn_problem **problem, tn_error *error);

/* The same from a CSV text: a first line of names, then numbers; the last column is the value wanted. E1243 with the
 * place. */
tn_status tn_problem_fit_csv(const char *text, size_t size, unsigned threads, tn_problem **problem, tn_error *error);

tn_evaluator tn_problem_evaluator(tn_problem *problem);
void tn_problem_free(tn_problem *problem);

#endif
