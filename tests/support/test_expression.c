/* Random expressions of numbers: made, written, and evaluated by recursion over the tree. */
#include "tests/support/test_expression.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/base/random.h"
#include "runtime/math/elementary.h"

uint64_t test_draw(test_random *random, uint64_t below)
{
    return tn_random64(random->seed, 0, random->next++) % below;
}

const double test_specials[TEST_SPECIALS] = {0,        -0.0,  1,      -1,      0.5,       3,
                                             -7,       1e-10, -1e-10, DBL_MIN, DBL_MAX,   -DBL_MAX,
                                             INFINITY, 1e300, 5e-324, NAN,     -INFINITY, 100};

double test_number(test_random *random)
{
    uint64_t which = test_draw(random, 2 * TEST_SPECIALS);
    if (which < TEST_SPECIALS)
        return test_specials[which];
    return ((double)(test_draw(random, 1u << 20)) - 524288.0) / 65536.0;
}

/* ---- making */

typedef struct word {
    const char *text;
    uint32_t operands;
} word;

/* Those that both kinds of expressions have come first, then those that only studies have. */
static const word words[] = {{"+", 2},      {"-", 2},   {"*", 2},   {"/", 2},   {"-", 1},   {"abs", 1}, {"sqrt", 1},
                             {"square", 1}, {"min", 2}, {"max", 2}, {"exp", 1}, {"log", 1}, {"sin", 1}, {"cos", 1},
                             {"tanh", 1},   {"<", 2},   {"<=", 2},  {"=", 2},   {"!=", 2},  {">=", 2},  {">", 2},
                             {"in", 3},     {"and", 2}, {"or", 2},  {"not", 1}, {"and", 2}, {"or", 2},  {"not", 1}};
enum { WORDS = sizeof words / sizeof *words, SHARED = 15 };

test_expression *test_expression_new(test_random *random, unsigned depth, bool protected)
{
    static const char *const numbers[] = {"0", "1", "0.5", "2", "3.25", "10", "1000000", "0.001"};
    test_expression *e = calloc(1, sizeof *e);
    if (!e)
        abort();
    uint64_t kind = test_draw(random, depth > 1 ? 10 : 3);
    e->kind = kind == 0 ? TEST_NUMBER : kind <= 2 ? TEST_TERM : TEST_APPLY;
    if (e->kind == TEST_NUMBER) {
        e->text = numbers[test_draw(random, sizeof numbers / sizeof *numbers)];
    } else if (e->kind == TEST_TERM) {
        e->term = (uint32_t)test_draw(random, TEST_TERMS);
    } else {
        const word *drawn = &words[test_draw(random, protected ? SHARED : WORDS)];
        e->text = drawn->text;
        e->count = drawn->operands;
        for (uint32_t i = 0; i < e->count; i++)
            e->operands[i] = test_expression_new(random, depth - 1, protected);
        bool backward = strcmp(e->text, "in") == 0 && e->operands[1]->kind == TEST_NUMBER &&
                        e->operands[2]->kind == TEST_NUMBER &&
                        atof(e->operands[1]->text) > atof(e->operands[2]->text); /* which is refused */
        if (backward)
            e->operands[1]->text = e->operands[2]->text;
    }
    return e;
}

void test_expression_free(test_expression *e)
{
    for (uint32_t i = 0; i < e->count; i++)
        test_expression_free(e->operands[i]);
    free(e);
}

/* ---- writing */

enum { OR = 1, AND, NOT, COMPARISON, SUM, PRODUCT, SIGN, ATOM };

static int binding(const test_expression *e)
{
    static const struct {
        const char *word;
        int binding;
    } bindings[] = {{"or", OR},        {"and", AND},       {"not", NOT},       {"<", COMPARISON}, {"<=", COMPARISON},
                    {"=", COMPARISON}, {"!=", COMPARISON}, {">=", COMPARISON}, {">", COMPARISON}, {"in", COMPARISON},
                    {"+", SUM},        {"*", PRODUCT},     {"/", PRODUCT}};
    if (e->kind != TEST_APPLY)
        return ATOM;
    if (strcmp(e->text, "-") == 0)
        return e->count == 1 ? SIGN : SUM;
    for (size_t i = 0; i < sizeof bindings / sizeof *bindings; i++)
        if (strcmp(bindings[i].word, e->text) == 0)
            return bindings[i].binding;
    return ATOM;
}

static void write_within(const test_expression *e, const char *const *names, int least, FILE *out)
{
    bool open = binding(e) < least;
    if (open)
        fputc('(', out);
    test_expression_write(e, names, out);
    if (open)
        fputc(')', out);
}

static void write_call(const test_expression *e, const char *const *names, FILE *out)
{
    fprintf(out, "%s(", e->text);
    for (uint32_t i = 0; i < e->count; i++) {
        fputs(i ? ", " : "", out);
        test_expression_write(e->operands[i], names, out);
    }
    fputc(')', out);
}

void test_expression_write(const test_expression *e, const char *const *names, FILE *out)
{
    int own = binding(e);
    if (e->kind == TEST_NUMBER) {
        fputs(e->text, out);
    } else if (e->kind == TEST_TERM) {
        fputs(names[e->term], out);
    } else if (own == ATOM) {
        write_call(e, names, out);
    } else if (e->count == 1) {
        fprintf(out, "%s ", e->text);
        write_within(e->operands[0], names, own, out);
    } else {
        write_within(e->operands[0], names, own == COMPARISON ? own + 1 : own, out);
        fprintf(out, " %s ", e->text);
        write_within(e->operands[1], names, own + 1, out);
        if (e->count == 3) {
            fputs(" .. ", out);
            write_within(e->operands[2], names, own + 1, out);
        }
    }
}

/* ---- values */

static bool is(const test_expression *e, const char *text)
{
    return e->kind == TEST_APPLY && strcmp(e->text, text) == 0;
}

static bool compares(const test_expression *e, const double *x)
{
    return is(e, "<")    ? x[0] < x[1]
           : is(e, "<=") ? x[0] <= x[1]
           : is(e, "=")  ? x[0] == x[1]
           : is(e, "!=") ? x[0] != x[1]
           : is(e, ">=") ? x[0] >= x[1]
           : is(e, ">")  ? x[0] > x[1]
                         : x[1] <= x[0] && x[0] <= x[2];
}

static double function_of(const test_expression *e, double x, bool protected)
{
    if (is(e, "sqrt"))
        return sqrt(protected ? fabs(x) : x);
    if (is(e, "log"))
        return protected && x == 0 ? 0 : tn_log(protected ? fabs(x) : x);
    return is(e, "-")        ? -x
           : is(e, "abs")    ? fabs(x)
           : is(e, "square") ? x * x
           : is(e, "exp")    ? tn_exp(x)
           : is(e, "sin")    ? tn_sin(x)
           : is(e, "cos")    ? tn_cos(x)
                             : tn_tanh(x);
}

static double choice_of(const test_expression *e, double a, double b, bool protected)
{
    if (isnan(a) && !protected)
        return a;
    return (is(e, "min") ? a < b : a > b) ? a : b;
}

double test_expression_value(const test_expression *e, const double *terms, bool protected)
{
    double x[3] = {0};
    if (e->kind == TEST_NUMBER)
        return atof(e->text);
    if (e->kind == TEST_TERM)
        return terms[e->term];
    bool none = false;
    for (uint32_t i = 0; i < e->count; i++) {
        x[i] = test_expression_value(e->operands[i], terms, protected);
        none |= isnan(x[i]);
    }
    if (binding(e) >= SIGN && !is(e, "min") && !is(e, "max"))
        return function_of(e, x[0], protected);
    if (is(e, "min") || is(e, "max"))
        return choice_of(e, x[0], x[1], protected);
    if (is(e, "+"))
        return x[0] + x[1];
    if (is(e, "-"))
        return x[0] - x[1];
    if (is(e, "*"))
        return x[0] * x[1];
    if (is(e, "/"))
        return protected && x[1] == 0 ? 1 : x[0] / x[1];
    if (none)
        return NAN;
    if (is(e, "and"))
        return x[0] != 0 && x[1] != 0;
    if (is(e, "or"))
        return x[0] != 0 || x[1] != 0;
    if (is(e, "not"))
        return x[0] == 0;
    return compares(e, x);
}

/* ---- violations */

/* How far a is from being at most b, or below it. */
static double over(double a, double b, bool strict)
{
    if (isnan(a) || isnan(b))
        return NAN;
    if (strict ? a < b : a <= b)
        return 0;
    double far = a == b ? 0 : a - b;
    return strict && far < 1e-9 ? 1e-9 : far;
}

static double apart(double a, double b, bool wanted_equal)
{
    if (isnan(a) || isnan(b))
        return NAN;
    if (wanted_equal)
        return a == b ? 0 : fabs(a - b);
    return a == b ? 1e-9 : 0;
}

static double least(double a, double b)
{
    return isnan(a) || isnan(b) ? NAN : a < b ? a : b;
}

static bool names_a_term(const test_expression *e)
{
    bool names = e->kind == TEST_TERM;
    for (uint32_t i = 0; i < e->count; i++)
        names |= names_a_term(e->operands[i]);
    return names;
}

/* Of a distance between the first operand of a comparison and the one at `right`. */
static double share(const test_expression *e, const double *x, uint32_t right, double distance)
{
    bool left = e->count == 2 && names_a_term(e->operands[1]) && !names_a_term(e->operands[0]);
    double size = fabs(left ? x[0] : x[right]);
    return distance / (size > 1e300 ? 1e300 : size > 1 ? size : 1);
}

double test_expression_violation(const test_expression *e, const double *terms, bool wanted, bool shares)
{
    double x[3] = {0};
    if (is(e, "not"))
        return test_expression_violation(e->operands[0], terms, !wanted, shares);
    if (is(e, "and") || is(e, "or")) {
        double a = test_expression_violation(e->operands[0], terms, wanted, shares),
               b = test_expression_violation(e->operands[1], terms, wanted, shares);
        return is(e, "and") == wanted ? a + b : least(a, b);
    }
    if (binding(e) != COMPARISON)
        return apart(test_expression_value(e, terms, false), 0, !wanted);
    for (uint32_t i = 0; i < e->count; i++)
        x[i] = test_expression_value(e->operands[i], terms, false);
    if (is(e, "in")) {
        double low = wanted ? over(x[1], x[0], false) : over(x[0], x[1], true),
               high = wanted ? over(x[0], x[2], false) : over(x[2], x[0], true);
        low = shares ? share(e, x, 1, low) : low;
        high = shares ? share(e, x, 2, high) : high;
        return wanted ? low + high : least(low, high);
    }
    double distance;
    if (is(e, "=") || is(e, "!=")) {
        distance = apart(x[0], x[1], is(e, "=") == wanted);
    } else {
        bool strict = is(e, "<") || is(e, ">"), lower = is(e, "<") || is(e, "<=");
        strict = strict == wanted; /* the opposite of `<` is `>=` */
        distance = lower == wanted ? over(x[0], x[1], strict) : over(x[1], x[0], strict);
    }
    return shares ? share(e, x, 1, distance) : distance;
}

bool test_same(double a, double b)
{
    return (isnan(a) && isnan(b)) || tn_bits_of(a) == tn_bits_of(b);
}
