/* Lists the steps of a tape. */
#include <stdio.h>

#include "runtime/base/buffer.h"
#include "runtime/module/code.h"
#include "runtime/number/tape.h"

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
