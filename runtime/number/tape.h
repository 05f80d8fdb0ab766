/* The code of a field as a tape: what it is lowered to where it is run for many points.
 *
 * A tape's steps work on registers instead of a stack, each a row of TN_ROW points: registers 0, 1 and 2 hold the
 * coordinates, those after them the code's numbers, and the others are used again as soon as nothing needs them any
 * more. A tape has stages. A step belongs to the first stage whose coordinates it needs no others than; so what does
 * not depend on the coordinate that changes is computed once, and kept. Rows give at each point the bits that
 * tn_number_run gives.
 *
 * A tape is immutable once made, and may be shared between threads; each has its own tn_tape_rows.
 */
#ifndef TARTAN_NUMBER_TAPE_H
#define TARTAN_NUMBER_TAPE_H

#include <stdio.h>

#include "runtime/base/error.h"
#include "runtime/number/interval.h"
#include "runtime/number/operation.h"
#include "runtime/number/run.h"

#define TN_STAGES_MAX 3u

/* Coordinates that a stage may need. */
#define TN_NEEDS_X 1u
#define TN_NEEDS_Y 2u
#define TN_NEEDS_Z 4u
#define TN_NEEDS_ALL 7u

typedef struct tn_tape_step {
    tn_opcode opcode;
    uint32_t out;
    uint32_t in[TN_ARITY_MAX];
    uint32_t mesh; /* of TN_OP_MESH_DISTANCE */
} tn_tape_step;

typedef struct tn_tape {
    tn_tape_step *steps;               /* owned; stage after stage */
    uint32_t stage_end[TN_STAGES_MAX]; /* the first step that is no more of it */
    uint32_t stage_count;
    double *numbers; /* owned: of registers 3 and up */
    uint32_t number_count, register_count, result;
} tn_tape;

/* Lowers verified code of a FIELD function. needs[stage]: the coordinates; the last stage needs all. Clear the tape in
 * any case. */
tn_status tn_tape_new(const uint8_t *code, uint32_t offset, const unsigned *needs, uint32_t stage_count, tn_tape *tape,
                      tn_error *error);
void tn_tape_clear(tn_tape *tape);

/* Lists the tape that rows of samples along x are computed by. */
tn_status tn_tape_list(const uint8_t *code, uint32_t offset, FILE *out, tn_error *error);

typedef struct tn_tape_rows {
    double *memory;       /* owned: the coordinates' rows, then those of all registers */
    const double **where; /* owned: [registers] */
    double *coordinates[3];
} tn_tape_rows;

tn_status tn_tape_rows_new(const tn_tape *tape, tn_tape_rows *rows, tn_error *error);
void tn_tape_rows_clear(tn_tape_rows *rows);

/* Runs the steps of one stage on rows->coordinates, which the caller has filled. After the last stage the result is
 * returned: TN_ROW numbers, valid until the next run. */
const double *tn_tape_run(const tn_tape *tape, uint32_t stage, const tn_distances *distances, tn_tape_rows *rows);

/* An interval that holds all values over a box. `registers`: room for tape->register_count. */
tn_interval tn_tape_bounds(const tn_tape *tape, const double low[3], const double high[3],
                           const tn_distances *distances, tn_interval *registers);

/* The value at a point and its gradient. `registers`: room for four times tape->register_count. */
double tn_tape_gradient(const tn_tape *tape, const double point[3], const tn_distances *distances, double *registers,
                        double gradient[3]);

#endif
