/* Lowers the code of a field to a tape, and runs that: by rows, for boxes, and with derivatives. */
#include "runtime/number/tape.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/buffer.h"
#include "runtime/module/code.h"

/* ---- lists the steps of a tape */

/* A register: a coordinate, a number of the code, or what a step gave. */
static void list_register(const tn_tape *tape, uint32_t at, FILE *out)
{
    char text[TN_NUMBER_TEXT_SIZE];
    if (at < 3)
        fprintf(out, " %c", "xyz"[at]);
    else if (at < 3 + tape->number_count)
        fprintf(out, " %s", tn_number_text(tape->numbers[at - 3], text));
    else
        fprintf(out, " r%u", at - 3 - tape->number_count);
}

static void list_step(const tn_tape *tape, const tn_tape_step *step, FILE *out)
{
    const tn_opcode_info *row = tn_opcode_describe((uint8_t)step->opcode);
    fprintf(out, "    r%-4u = %s", step->out - 3 - tape->number_count, row->name);
    if (step->opcode == TN_OP_MESH_DISTANCE)
        fprintf(out, " mesh %u of", step->mesh);
    for (uint32_t k = 0; k < tn_code_effect((uint8_t)step->opcode).pops; k++)
        list_register(tape, step->in[k], out);
    fputc('\n', out);
}

static void list_needs(unsigned needs, FILE *out)
{
    const char *between = "";
    for (unsigned axis = 0; axis < 3; axis++)
        if (needs >> axis & 1) {
            fprintf(out, "%s%c", between, "xyz"[axis]);
            between = ", ";
        }
}

static void list_tape(const tn_tape *tape, const unsigned *needs, FILE *out)
{
    uint32_t step = 0;
    for (uint32_t stage = 0; stage < tape->stage_count; stage++) {
        fputs("  what depends on ", out);
        list_needs(needs[stage], out);
        fprintf(out, stage ? " and is not above\n" : "\n");
        for (; step < tape->stage_end[stage]; step++)
            list_step(tape, &tape->steps[step], out);
    }
    fputs("  the value is", out);
    list_register(tape, tape->result, out);
    fprintf(out, "; %u registers of %u numbers\n", tape->register_count - 3 - tape->number_count, TN_ROW);
}

tn_status tn_tape_list(const uint8_t *code, uint32_t offset, FILE *out, tn_error *error)
{
    static const unsigned needs[] = {TN_NEEDS_Y | TN_NEEDS_Z, TN_NEEDS_ALL};
    tn_tape tape;
    tn_status status = tn_tape_new(code, offset, needs, 2, &tape, error);
    if (status == TN_OK)
        list_tape(&tape, needs, out);
    tn_tape_clear(&tape);
    return status;
}

#define NO_VALUE UINT32_MAX

/* ---- lowering */

/* What an instruction gives. Operands are earlier values. */
typedef struct value {
    tn_opcode opcode; /* TN_OP_COORDINATE: which is `mesh` */
    uint32_t in[TN_ARITY_MAX], arity, mesh;
    double number;
    unsigned needs; /* coordinates */
    uint32_t at;    /* its register */
    uint32_t last;  /* the last step that needs it; NO_VALUE: it is kept for a later stage */
} value;

typedef struct lowering {
    value *values;
    size_t count, capacity;
    uint32_t *stack, *kept, *order, *free;
    size_t stack_height, stack_capacity, kept_count, kept_capacity, free_count;
    const unsigned *needs;
    tn_tape *tape;
} lowering;

static bool push(lowering *l, uint32_t v)
{
    if (!tn_array_reserve(&l->stack, &l->stack_capacity, l->stack_height, 1, sizeof *l->stack))
        return false;
    l->stack[l->stack_height++] = v;
    return true;
}

static bool keep(lowering *l)
{
    if (!tn_array_reserve(&l->kept, &l->kept_capacity, l->kept_count, 1, sizeof *l->kept))
        return false;
    l->kept[l->kept_count++] = l->stack[--l->stack_height];
    return true;
}

/* The value of an instruction, pushed. */
static bool add(lowering *l, const tn_instruction *i)
{
    if (!tn_array_reserve(&l->values, &l->capacity, l->count, 1, sizeof *l->values))
        return false;
    value *v = &l->values[l->count];
    *v = (value){.opcode = i->opcode, .arity = tn_code_effect((uint8_t)i->opcode).pops, .mesh = (uint32_t)i->first};
    if (i->opcode == TN_OP_NUMBER)
        v->number = tn_double_of((uint64_t)i->first);
    if (i->opcode == TN_OP_COORDINATE)
        v->needs = 1u << i->first;
    l->stack_height -= v->arity;
    for (uint32_t k = 0; k < v->arity; k++) {
        v->in[k] = l->stack[l->stack_height + k];
        v->needs |= l->values[v->in[k]].needs;
    }
    return push(l, (uint32_t)l->count++);
}

/* Runs the code's stack with values instead of numbers. False if out of memory. */
static bool read_code(lowering *l, const uint8_t *code, uint32_t offset)
{
    for (tn_instruction i = tn_code_read(code, offset); i.opcode != TN_OP_VALUE; i = tn_code_read(code, offset)) {
        bool well = i.opcode == TN_OP_KEEP ? keep(l) : i.opcode == TN_OP_KEPT ? push(l, l->kept[i.first]) : add(l, &i);
        if (!well)
            return false;
        offset += i.length;
    }
    return true;
}

static bool is_step(const value *v)
{
    return v->opcode != TN_OP_NUMBER && v->opcode != TN_OP_COORDINATE;
}

static uint32_t stage_of(const lowering *l, const value *v)
{
    uint32_t stage = 0;
    while (v->needs & ~l->needs[stage])
        stage++;
    return stage;
}

/* Puts the steps in order, stage after stage, and finds until when each value is needed. */
static uint32_t order_steps(lowering *l)
{
    uint32_t steps = 0;
    for (uint32_t stage = 0; stage < l->tape->stage_count; stage++) {
        for (uint32_t i = 0; i < l->count; i++)
            if (is_step(&l->values[i]) && stage_of(l, &l->values[i]) == stage)
                l->order[steps++] = i;
        l->tape->stage_end[stage] = steps;
    }
    for (uint32_t step = 0; step < steps; step++) {
        const value *v = &l->values[l->order[step]];
        for (uint32_t k = 0; k < v->arity; k++) {
            value *operand = &l->values[v->in[k]];
            bool later = stage_of(l, operand) != stage_of(l, v) || operand->last == NO_VALUE;
            operand->last = later ? NO_VALUE : step + 1;
        }
    }
    return steps;
}

static uint32_t take_register(lowering *l)
{
    return l->free_count ? l->free[--l->free_count] : l->tape->register_count++;
}

/* Gives back the registers of operands that no later step needs. */
static void give_back(lowering *l, const value *v, uint32_t step)
{
    for (uint32_t k = 0; k < v->arity; k++) {
        value *operand = &l->values[v->in[k]];
        if (!is_step(operand) || operand->last != step + 1)
            continue;
        operand->last = 0; /* once, where it is an operand twice */
        l->free[l->free_count++] = operand->at;
    }
}

static bool write_tape(lowering *l, uint32_t steps)
{
    tn_tape *tape = l->tape;
    uint32_t result = l->stack[0];
    tape->steps = calloc(steps + 1, sizeof *tape->steps);
    tape->numbers = calloc(l->count + 1, sizeof *tape->numbers);
    l->free = calloc(l->count + 1, sizeof *l->free);
    if (!tape->steps || !tape->numbers || !l->free)
        return false;
    for (size_t i = 0; i < l->count; i++) {
        value *v = &l->values[i];
        if (v->opcode == TN_OP_NUMBER) {
            v->at = 3 + tape->number_count;
            tape->numbers[tape->number_count++] = v->number;
        } else if (v->opcode == TN_OP_COORDINATE) {
            v->at = v->mesh;
        }
    }
    l->values[result].last = NO_VALUE;
    tape->register_count = 3 + tape->number_count;
    for (uint32_t step = 0; step < steps; step++) {
        value *v = &l->values[l->order[step]];
        v->at = take_register(l); /* before its operands' are given back: a result is never an operand's register */
        tape->steps[step] = (tn_tape_step){.opcode = v->opcode, .out = v->at, .mesh = v->mesh};
        for (uint32_t k = 0; k < v->arity; k++)
            tape->steps[step].in[k] = l->values[v->in[k]].at;
        give_back(l, v, step);
    }
    tape->result = l->values[result].at;
    return true;
}

tn_status tn_tape_new(const uint8_t *code, uint32_t offset, const unsigned *needs, uint32_t stage_count, tn_tape *tape,
                      tn_error *error)
{
    *tape = (tn_tape){.stage_count = stage_count};
    lowering l = {.needs = needs, .tape = tape};
    bool well = read_code(&l, code, offset);
    if (well)
        well = (l.order = calloc(l.count + 1, sizeof *l.order)) != NULL;
    if (well)
        well = write_tape(&l, order_steps(&l));
    free(l.values);
    free(l.stack);
    free(l.kept);
    free(l.order);
    free(l.free);
    return well ? TN_OK : tn_fail_memory(error);
}

void tn_tape_clear(tn_tape *tape)
{
    free(tape->steps);
    free(tape->numbers);
    *tape = (tn_tape){0};
}

/* ---- rows */

tn_status tn_tape_rows_new(const tn_tape *tape, tn_tape_rows *rows, tn_error *error)
{
    *rows = (tn_tape_rows){.memory = calloc((size_t)tape->register_count * TN_ROW, sizeof *rows->memory),
                           .where = calloc(tape->register_count, sizeof *rows->where)};
    if (!rows->memory || !rows->where)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < tape->register_count; i++)
        rows->where[i] = rows->memory + (size_t)i * TN_ROW;
    for (uint32_t axis = 0; axis < 3; axis++)
        rows->coordinates[axis] = rows->memory + (size_t)axis * TN_ROW;
    for (uint32_t i = 0; i < tape->number_count; i++)
        for (size_t k = 0; k < TN_ROW; k++)
            rows->memory[(3 + i) * (size_t)TN_ROW + k] = tape->numbers[i];
    return TN_OK;
}

void tn_tape_rows_clear(tn_tape_rows *rows)
{
    free(rows->memory);
    free(rows->where);
    *rows = (tn_tape_rows){0};
}

static void run_distances(const tn_tape_step *step, const double *const *operands, const tn_distances *distances,
                          double *out)
{
    for (size_t i = 0; i < TN_ROW; i++)
        out[i] = distances->measure(distances->meshes, step->mesh,
                                    (double[3]){operands[0][i], operands[1][i], operands[2][i]}, NULL);
}

const double *tn_tape_run(const tn_tape *tape, uint32_t stage, const tn_distances *distances, tn_tape_rows *rows)
{
    for (uint32_t i = stage ? tape->stage_end[stage - 1] : 0; i < tape->stage_end[stage]; i++) {
        const tn_tape_step *step = &tape->steps[i];
        const double *operands[TN_ARITY_MAX] = {rows->where[step->in[0]], rows->where[step->in[1]],
                                                rows->where[step->in[2]]};
        double *out = rows->memory + (size_t)step->out * TN_ROW;
        if (step->opcode == TN_OP_MESH_DISTANCE)
            run_distances(step, operands, distances, out);
        else
            tn_operation_row(step->opcode, operands, out);
    }
    return rows->where[tape->result];
}

/* ---- boxes */

/* Distances differ by no more than their points are apart. */
static tn_interval bound_distance(const tn_tape_step *step, const tn_interval *const *place,
                                  const tn_distances *distances)
{
    double centre[3], radius = 0;
    for (int k = 0; k < 3; k++) {
        double half = place[k]->high / 2 - place[k]->low / 2;
        if (place[k]->fails || !(half < INFINITY))
            return (tn_interval){-INFINITY, INFINITY, true};
        centre[k] = place[k]->low / 2 + place[k]->high / 2;
        radius += half * half;
    }
    double at = distances->measure(distances->meshes, step->mesh, centre, NULL);
    double reach = sqrt(radius) * (1 + 1e-9) + 1e-9 * fabs(at) + 1e-12;
    return (tn_interval){at - reach, at + reach, at != at};
}

tn_interval tn_tape_bounds(const tn_tape *tape, const double low[3], const double high[3],
                           const tn_distances *distances, tn_interval *registers)
{
    for (int axis = 0; axis < 3; axis++)
        registers[axis] = (tn_interval){low[axis], high[axis], false};
    for (uint32_t i = 0; i < tape->number_count; i++)
        registers[3 + i] = tn_interval_of(tape->numbers[i]);
    for (uint32_t i = 0; i < tape->stage_end[tape->stage_count - 1]; i++) {
        const tn_tape_step *step = &tape->steps[i];
        const tn_interval *operands[TN_ARITY_MAX] = {&registers[step->in[0]], &registers[step->in[1]],
                                                     &registers[step->in[2]]};
        registers[step->out] = step->opcode == TN_OP_MESH_DISTANCE ? bound_distance(step, operands, distances)
                                                                   : tn_operation_bounds(step->opcode, operands);
    }
    return registers[tape->result];
}

/* ---- derivatives */

/* The gradient of a distance, of which `along` says how its place moves. */
static void slope_of_distance(const tn_tape_step *step, const double *const *in, const tn_distances *distances,
                              double *out)
{
    double steepest[3];
    out[0] = distances->measure(distances->meshes, step->mesh, (double[3]){in[0][0], in[1][0], in[2][0]}, steepest);
    for (int axis = 1; axis <= 3; axis++)
        out[axis] = steepest[0] * in[0][axis] + steepest[1] * in[1][axis] + steepest[2] * in[2][axis];
}

double tn_tape_gradient(const tn_tape *tape, const double point[3], const tn_distances *distances, double *registers,
                        double gradient[3])
{
    for (uint32_t i = 0; i < 3 + tape->number_count; i++) {
        double *r = registers + 4 * (size_t)i;
        r[0] = i < 3 ? point[i] : tape->numbers[i - 3];
        for (uint32_t axis = 0; axis < 3; axis++)
            r[1 + axis] = i == axis;
    }
    for (uint32_t i = 0; i < tape->stage_end[tape->stage_count - 1]; i++) {
        const tn_tape_step *step = &tape->steps[i];
        const double *in[TN_ARITY_MAX];
        double values[TN_ARITY_MAX + 1], *out = registers + 4 * (size_t)step->out;
        uint32_t arity = tn_code_effect((uint8_t)step->opcode).pops;
        for (uint32_t k = 0; k < TN_ARITY_MAX; k++) {
            in[k] = registers + 4 * (size_t)step->in[k];
            values[k] = in[k][0];
        }
        if (step->opcode == TN_OP_MESH_DISTANCE) {
            slope_of_distance(step, in, distances, out);
            continue;
        }
        out[0] = values[arity] = tn_operation_apply(step->opcode, values);
        for (int axis = 1; axis <= 3; axis++) {
            double slopes[TN_ARITY_MAX] = {in[0][axis], in[1][axis], in[2][axis]};
            out[axis] = tn_operation_slope(step->opcode, values, slopes);
        }
    }
    const double *result = registers + 4 * (size_t)tape->result;
    memcpy(gradient, result + 1, 3 * sizeof *gradient);
    return result[0];
}
