/* Runs the code of expressions: of a module's function, or of a formula. One point at a time, or by rows of points;
 * both give the same bits. Where an expression has no value, as after the root of a negative number, what comes out is
 * not finite. */
#ifndef TARTAN_NUMBER_RUN_H
#define TARTAN_NUMBER_RUN_H

#include "runtime/base/error.h"
#include "runtime/module/module.h"
#include "runtime/number/interval.h"

#define TN_MEASURE_STACK_MAX 256u /* numbers that the code of a module's function holds at once */

/* The value of the verified code that begins at `offset`, where the stack is at most TN_MEASURE_STACK_MAX deep; terms:
 * what stands under each number of TERM. */
double tn_number_run(const uint8_t *code, uint32_t offset, const double *terms);

/* An interval that holds the code's values wherever each term lies in its interval; likewise. */
tn_interval tn_number_bounds(const uint8_t *code, uint32_t offset, const tn_interval *terms);

/* Which terms, below 64, the verified code of a function of the module takes: a bit for each. */
uint64_t tn_number_asked(const tn_module *module, uint32_t function);

/* The meshes that a field measures distances from: how far a place is from mesh number `mesh`, below 0 inside of a
 * closed one, and (where it is not NULL) the gradient of that. */
typedef struct tn_distances {
    double (*measure)(const void *meshes, uint32_t mesh, const double place[3], double gradient[3]);
    const void *meshes;
} tn_distances;

/* The value of a FIELD function's code at a point. `kept`: room for as many numbers as it keeps (tn_number_kept). */
double tn_number_run_at(const uint8_t *code, uint32_t offset, const double point[3], const tn_distances *distances,
                        double *kept);

/* How many numbers the code keeps. */
uint32_t tn_number_kept(const uint8_t *code, uint32_t offset);

/* Memory of running by rows. Zero it to begin with; it serves any code, one thread at a time. */
typedef struct tn_number_rows {
    double *stack;           /* owned: two rows a level */
    const double **operands; /* owned: the rows that are on the stack, a term's column or one of the above */
    size_t capacity;
} tn_number_rows;

void tn_number_rows_clear(tn_number_rows *rows);

/* The values at `count` points, columns[term][point], into `values`; `depth`: of the stack, at most. Columns are
 * readable (not changed, and not part of the result) up to the next multiple of TN_ROW points. TN_MEMORY, or TN_OK. */
tn_status tn_number_run_rows(tn_number_rows *rows, const uint8_t *code, uint32_t offset, size_t depth,
                             const double *const *columns, size_t count, double *values, tn_error *error);

/* What a requirement that is missed by all of its bound adds to a sum of goals. Of what was tried (1, 1 and a share, 4,
 * 10), ten lets most runs end with all requirements met, and goals come nearest to their targets. */
#define TN_REQUIREMENT_WEIGHT 10.0

#endif
