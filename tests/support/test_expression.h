/* Random expressions of numbers, evaluated by the book: what compiled code is held against. */
#ifndef TARTAN_TESTS_TEST_EXPRESSION_H
#define TARTAN_TESTS_TEST_EXPRESSION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { TEST_TERMS = 9, TEST_SPECIALS = 18 };

typedef enum test_kind { TEST_NUMBER, TEST_TERM, TEST_APPLY } test_kind;

typedef struct test_expression {
    test_kind kind;
    const char *text; /* of a number; the word of what is applied */
    uint32_t term;
    uint32_t count; /* of operands */
    struct test_expression *operands[3];
} test_expression;

/* A source of random numbers. */
typedef struct test_random {
    uint64_t seed, next;
} test_random;

uint64_t test_draw(test_random *random, uint64_t below);

/* Zeros, infinities, what has no value, the smallest and largest numbers, and common ones. */
extern const double test_specials[TEST_SPECIALS];

/* A special number, or one at random. */
double test_number(test_random *random);

/* An expression at most `depth` deep. `protected`: of the sentences of `fit`, else of studies, with conditions. */
test_expression *test_expression_new(test_random *random, unsigned depth, bool protected);
void test_expression_free(test_expression *expression);

/* As notations write it, with no parenthesis that can be left out. */
void test_expression_write(const test_expression *expression, const char *const *names, FILE *out);

double test_expression_value(const test_expression *expression, const double *terms, bool protected);

/* How far it is from holding, or from failing where it is not wanted; with `shares`, in the sizes of bounds. */
double test_expression_violation(const test_expression *expression, const double *terms, bool wanted, bool shares);

/* The same bits, or no value both? */
bool test_same(double a, double b);

#endif
