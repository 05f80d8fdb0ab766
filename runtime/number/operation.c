/* Computes the operations of operations.def, for one point and for rows of points, and finds them by their names.
 *
 * Rows have one length, so that compilers turn the loops of simple operations into vector code; each element is
 * computed by itself, by the expression that a single point takes, so that both give the same bits.
 */
#include "runtime/number/operation.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "runtime/math/any_width.h"
#include "runtime/math/elementary.h"

/* ==== computes gradient noise (Perlin, "Improving noise", 2002) over a lattice whose gradients are chosen by a hash */

#define LIMIT 2147483648.0 /* 2^31: beyond, the lattice's points would not be told apart */

/* A place in its cell of the lattice. */
typedef struct cell_place {
    uint32_t corner[3]; /* modulo 2^32 */
    double from[3];     /* the place, from the corner on */
} cell_place;

static bool find_cell(double x, double y, double z, cell_place *cell)
{
    double place[3] = {x, y, z};
    for (int k = 0; k < 3; k++) {
        if (!(fabs(place[k]) < LIMIT))
            return false;
        double corner = floor(place[k]);
        cell->corner[k] = (uint32_t)(int64_t)corner;
        cell->from[k] = place[k] - corner;
    }
    return true;
}

/* The gradient of the cell's corner k, whose bits say on which side it is. */
static const signed char *gradient(const cell_place *cell, unsigned k)
{
    static const signed char gradients[12][3] = {{1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0},
                                                 {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
                                                 {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}};
    uint32_t h = (cell->corner[0] + (k & 1)) * 0x9E3779B1u ^ (cell->corner[1] + (k >> 1 & 1)) * 0x85EBCA77u ^
                 (cell->corner[2] + (k >> 2)) * 0xC2B2AE3Du;
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    h ^= h >> 12;
    h *= 0x297A2D39u;
    h ^= h >> 15;
    return gradients[h % 12];
}

static double corner_value(const cell_place *cell, unsigned k)
{
    const signed char *g = gradient(cell, k);
    const double *q = cell->from;
    return (g[0] * (q[0] - (k & 1)) + g[1] * (q[1] - (k >> 1 & 1))) + g[2] * (q[2] - (k >> 2));
}

static double fade(double t)
{
    return t * t * t * (t * (t * 6 - 15) + 10);
}

/* Between -1.1 and 1.1; no value from a coordinate of 2^31 on. */
static double noise(double x, double y, double z)
{
    cell_place cell;
    double values[8];
    if (!find_cell(x, y, z, &cell))
        return NAN;
    for (unsigned k = 0; k < 8; k++)
        values[k] = corner_value(&cell, k);
    for (unsigned axis = 0, count = 4; axis < 3; axis++, count /= 2) {
        double share = fade(cell.from[axis]);
        for (unsigned i = 0; i < count; i++)
            values[i] = values[2 * i] + (values[2 * i + 1] - values[2 * i]) * share;
    }
    return values[0];
}

/* Its derivative along the direction. */
static double noise_slope(double x, double y, double z, double dx, double dy, double dz)
{
    cell_place cell;
    double along[3] = {dx, dy, dz}, share[3], steep[3], slope = 0;
    if (!find_cell(x, y, z, &cell))
        return NAN;
    for (int k = 0; k < 3; k++) {
        double t = cell.from[k];
        share[k] = fade(t);
        steep[k] = 30 * t * t * (t - 1) * (t - 1) * along[k];
    }
    for (unsigned k = 0; k < 8; k++) {
        const signed char *g = gradient(&cell, k);
        double weight[3], value = corner_value(&cell, k);
        for (int axis = 0; axis < 3; axis++)
            weight[axis] = k >> axis & 1 ? share[axis] : 1 - share[axis];
        slope += weight[0] * weight[1] * weight[2] * (g[0] * dx + g[1] * dy + g[2] * dz);
        for (int axis = 0; axis < 3; axis++)
            slope += (k >> axis & 1 ? 1 : -1) * steep[axis] * weight[(axis + 1) % 3] * weight[(axis + 2) % 3] * value;
    }
    return slope;
}

/* The least violation of a condition that excludes its bound. */
#define STRICT 1e-9

/* Exact but for the last addition: fmod is. */
static double floored_remainder(double a, double b)
{
    double rest = fmod(a, b);
    return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}

/* What the table's rows are made of. No operand has a side effect. */
#define SMALLER(X, Y) ((X) != (X) || (X) < (Y) ? (X) : (Y))
#define LARGER(X, Y) ((X) != (X) || (X) > (Y) ? (X) : (Y))
#define OVERLAP(X, Y, K) LARGER((K)-__builtin_fabs((X) - (Y)), 0.0)
#define JUDGED(TEST) (((a != a) | (b != b)) ? a + b : (TEST) ? 1.0 : 0.0)
#define SHORT_AT_MOST(X, Y) ((X) <= (Y) ? 0 : (X) - (Y))
#define SHORT_BELOW(X, Y) ((X) < (Y) ? 0 : (X) == (Y) || (X) - (Y) < STRICT ? STRICT : (X) - (Y))

const tn_operation tn_operations[TN_OPERATION_COUNT] = {
#define OPERATION(NAME, NUMBER, WORD, WORDS, ARITY, LOOP, VALUE, BOUNDS, SLOPE, DOC)                                   \
    {TN_OP_##NAME, WORD, TN_WORDS_##WORDS, ARITY, DOC},
#include "runtime/module/operations.def"
#undef OPERATION
};

/* ---- names */

const tn_operation *tn_function_named(tn_words words, const char *name, size_t size)
{
    for (size_t i = 0; i < TN_OPERATION_COUNT; i++) {
        const char *word = tn_operations[i].word;
        if ((tn_operations[i].words & words) && strlen(word) == size && memcmp(word, name, size) == 0)
            return &tn_operations[i];
    }
    return NULL;
}

size_t tn_function_names(tn_words words, const char *names[TN_OPERATION_COUNT])
{
    size_t count = 0;
    for (size_t i = 0; i < TN_OPERATION_COUNT; i++)
        if (tn_operations[i].words & words)
            names[count++] = tn_operations[i].word;
    return count;
}

/* ---- values */

#define TAKE_1 double a = operands[0];
#define TAKE_2 TAKE_1 double b = operands[1];
#define TAKE_3 TAKE_2 double c = operands[2];

double tn_operation_apply(tn_opcode opcode, const double *operands)
{
    switch (opcode) {
#define OPERATION(NAME, NUMBER, WORD, WORDS, ARITY, LOOP, VALUE, BOUNDS, SLOPE, DOC)                                   \
    case TN_OP_##NAME: {                                                                                               \
        TAKE_##ARITY return VALUE;                                                                                     \
    }
#include "runtime/module/operations.def"
#undef OPERATION
    default:
        return 0;
    }
}

/* ---- derivatives */

#define SLOPELESS __builtin_nan("")
#define SLOPES_1 double da = slopes[0];
#define SLOPES_2 SLOPES_1 double db = slopes[1];
#define SLOPES_3 SLOPES_2 double dc = slopes[2];

static double slope_blend(double a, double b, double c, double da, double db, double dc)
{
    double overlap = OVERLAP(a, b, c), least = a < b ? da : db;
    if (!(overlap > 0))
        return least;
    double slope = dc - (a < b ? db - da : da - db); /* of the overlap */
    return least - overlap * slope / (2 * c) + overlap * overlap * dc / (4 * c * c);
}

/* Of the sum, the product and so on, not all the operands' values matter. */
#define UNUSED_1 (void)a, (void)da;
#define UNUSED_2 UNUSED_1(void) b, (void)db;
#define UNUSED_3 UNUSED_2(void) c, (void)dc;

double tn_operation_slope(tn_opcode opcode, const double *operands, const double *slopes)
{
    switch (opcode) {
#define OPERATION(NAME, NUMBER, WORD, WORDS, ARITY, LOOP, VALUE, BOUNDS, SLOPE, DOC)                                   \
    case TN_OP_##NAME: {                                                                                               \
        TAKE_##ARITY SLOPES_##ARITY double v = operands[ARITY];                                                        \
        (void)v;                                                                                                       \
        UNUSED_##ARITY return SLOPE;                                                                                   \
    }
#include "runtime/module/operations.def"
#undef OPERATION
    default:
        return 0;
    }
}

/* ---- rows */

#define ROWS_1 const double *x = operands[0];
#define ROWS_2 ROWS_1 const double *y = operands[1];
#define ROWS_3 ROWS_2 const double *z = operands[2];
#define LOAD_1 double a = x[i];
#define LOAD_2 LOAD_1 double b = y[i];
#define LOAD_3 LOAD_2 double c = z[i];
#define EACH(ARITY, VALUE)                                                                                             \
    {                                                                                                                  \
        ROWS_##ARITY for (size_t i = 0; i < TN_ROW; i++)                                                               \
        {                                                                                                              \
            LOAD_##ARITY out[i] = VALUE;                                                                               \
        }                                                                                                              \
        break;                                                                                                         \
    }

/* A row of operations.def belongs to one of the three functions below, by its LOOP. */
#define IF_SIMPLE_SIMPLE(...) __VA_ARGS__
#define IF_SIMPLE_CALL(...)
#define IF_SIMPLE_ROW(...)
#define IF_CALL_SIMPLE(...)
#define IF_CALL_CALL(...) __VA_ARGS__
#define IF_CALL_ROW(...)
#define IF_ROW_SIMPLE(...)
#define IF_ROW_CALL(...)
#define IF_ROW_ROW(...) __VA_ARGS__

/* Functions of one operand that elementary.h has for rows. */
#define ROW_OF(NAME, FUNCTION)                                                                                         \
    static void row_##NAME(const double *const *operands, double *restrict out)                                        \
    {                                                                                                                  \
        FUNCTION(operands[0], out, TN_ROW);                                                                            \
    }
ROW_OF(SINE, tn_sin_row)
ROW_OF(COSINE, tn_cos_row)
ROW_OF(EXPONENTIAL, tn_exp_row)
ROW_OF(LOGARITHM, tn_log_row)
ROW_OF(HYPERBOLIC_TANGENT, tn_tanh_row)

static void row_TANGENT(const double *const *operands, double *restrict out)
{
    double cosines[TN_ROW];
    tn_cos_row(operands[0], cosines, TN_ROW);
    tn_sin_row(operands[0], out, TN_ROW);
    for (size_t i = 0; i < TN_ROW; i++)
        out[i] /= cosines[i];
}

static void row_ARC_TANGENT(const double *const *operands, double *restrict out)
{
    tn_atan2_row(operands[0], operands[1], out, TN_ROW);
}

static void row_POWER(const double *const *operands, double *restrict out)
{
    tn_pow_row(operands[0], operands[1], out, TN_ROW);
    for (size_t i = 0; i < TN_ROW; i++) {
        double a = operands[0][i], b = operands[1][i];
        out[i] = a != a ? a : b != b ? b : out[i];
    }
}

static void row_PROTECTED_LOGARITHM(const double *const *operands, double *restrict out)
{
    double sizes[TN_ROW];
    for (size_t i = 0; i < TN_ROW; i++)
        sizes[i] = __builtin_fabs(operands[0][i]);
    tn_log_row(sizes, out, TN_ROW);
    for (size_t i = 0; i < TN_ROW; i++)
        out[i] = sizes[i] == 0 ? 0 : out[i];
}

static void compute_rows(tn_opcode opcode, const double *const *operands, double *restrict out)
{
    switch (opcode) {
#define OPERATION(NAME, NUMBER, WORD, WORDS, ARITY, LOOP, VALUE, BOUNDS, SLOPE, DOC)                                   \
    IF_ROW_##LOOP(case TN_OP_##NAME : row_##NAME(operands, out); break;)
#include "runtime/module/operations.def"
#undef OPERATION
    default:
        break;
    }
}

/* Functions that are more than one operation, element by element. */
static void compute_calls(tn_opcode opcode, const double *const *operands, double *restrict out)
{
    switch (opcode) {
#define OPERATION(NAME, NUMBER, WORD, WORDS, ARITY, LOOP, VALUE, BOUNDS, SLOPE, DOC)                                   \
    IF_CALL_##LOOP(case TN_OP_##NAME : EACH(ARITY, VALUE))
#include "runtime/module/operations.def"
#undef OPERATION
    default:
        compute_rows(opcode, operands, out);
        break;
    }
}

TN_ANY_WIDTH static void compute(tn_opcode opcode, const double *const *operands, double *restrict out)
{
    switch (opcode) {
#define OPERATION(NAME, NUMBER, WORD, WORDS, ARITY, LOOP, VALUE, BOUNDS, SLOPE, DOC)                                   \
    IF_SIMPLE_##LOOP(case TN_OP_##NAME : EACH(ARITY, VALUE))
#include "runtime/module/operations.def"
#undef OPERATION
    default:
        compute_calls(opcode, operands, out);
        break;
    }
}

void tn_operation_row(tn_opcode opcode, const double *const *operands, double *out)
{
    compute(opcode, operands, out);
}
