/* Reads the code of rule functions as nodes, and goes through these with a stack. */
#include "runtime/plan/match/postfix.h"

#include <stdlib.h>

/* At the plan's level AND, OR and NOT are about the plan, so their operands are wanted plain too. Code is in postfix
 * order: the operands of a node are found from its end backwards. `start` of a node is where its own code begins. */
static void mark_plain(tn_postfix *code, const size_t *start, bool plain)
{
    if (code->count == 0)
        return;
    code->nodes[code->count - 1].plain = plain;
    for (size_t i = code->count; i-- > 0;) {
        tn_opcode opcode = code->nodes[i].code.opcode;
        if (!code->nodes[i].plain || (opcode != TN_OP_AND && opcode != TN_OP_OR && opcode != TN_OP_NOT))
            continue;
        code->nodes[i - 1].plain = true;
        if (opcode != TN_OP_NOT)
            code->nodes[start[i - 1] - 1].plain = true;
    }
}

/* Where each node's code begins, from the stack's effects. */
static bool find_starts(const tn_postfix *code, size_t *start)
{
    size_t *open = malloc((code->count + 1) * sizeof *open);
    if (!open)
        return false;
    size_t depth = 0;
    for (size_t i = 0; i < code->count; i++) {
        tn_opcode_effect effect = tn_code_effect((uint8_t)code->nodes[i].code.opcode);
        size_t first = i;
        for (uint8_t p = 0; p < effect.pops; p++)
            first = open[--depth];
        start[i] = first;
        open[depth++] = first;
    }
    free(open);
    return true;
}

void tn_postfix_clear(tn_postfix *code)
{
    while (code->depth > 0)
        tn_dfa_free(code->stack[--code->depth]);
    free(code->stack);
    free(code->nodes);
    *code = (tn_postfix){0};
}

tn_status tn_postfix_read_range(const tn_module *module, uint32_t begin, uint32_t end, uint32_t deepest, bool plain,
                                tn_postfix *code, tn_error *error)
{
    size_t bytes = end - begin;
    *code = (tn_postfix){0};
    code->nodes = calloc(bytes + 1, sizeof *code->nodes);
    code->stack = calloc((size_t)deepest + 1, sizeof *code->stack);
    size_t *start = malloc((bytes + 1) * sizeof *start);
    bool ok = code->nodes && code->stack && start;
    for (uint32_t offset = begin; ok && offset < end;) {
        tn_instruction instruction = tn_code_read(module->code, offset);
        if (instruction.opcode == TN_OP_RETURN)
            break;
        code->nodes[code->count++] = (tn_postfix_node){.code = instruction, .offset = offset};
        offset += instruction.length;
    }
    ok = ok && find_starts(code, start);
    if (ok)
        mark_plain(code, start, plain);
    free(start);
    if (ok)
        return TN_OK;
    tn_postfix_clear(code);
    return tn_fail_memory(error);
}

tn_status tn_postfix_read(const tn_module *module, uint32_t function, bool plain, tn_postfix *code, tn_error *error)
{
    const tn_function_record *record = &module->FUNCTION_records[function];
    return tn_postfix_read_range(module, record->code_begin, record->code_end, record->stack_max, plain, code, error);
}

tn_status tn_postfix_fold(tn_postfix *code, tn_postfix_make *make, void *context, tn_dfa **out, tn_error *error)
{
    for (size_t i = 0; i < code->count; i++) {
        const tn_postfix_node *node = &code->nodes[i];
        uint8_t pops = tn_code_effect((uint8_t)node->code.opcode).pops;
        tn_dfa **in = code->stack + (code->depth - pops);
        tn_dfa *result = NULL;
        tn_status status = make(context, node, in, &result, error);
        if (status != TN_OK) {
            if (error)
                error->code_offset = node->offset;
            return status;
        }
        for (; pops > 0; pops--)
            tn_dfa_free(code->stack[--code->depth]);
        code->stack[code->depth++] = result;
    }
    *out = code->stack[--code->depth];
    return TN_OK;
}
