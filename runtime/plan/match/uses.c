/* Follows a rule's code from its result back to the instructions about houses. */
#include "runtime/plan/match/uses.h"

#include <stdlib.h>

#include "runtime/automata/numbering.h"

enum { USES = TN_USE_STRETCHES + 1 };

typedef struct tn_use_node {
    tn_instruction op;
    size_t start; /* of its own code and that of its operands, as a node */
    tn_relation_use use;
} tn_use_node;

typedef struct tn_use_finder {
    const tn_module *module;
    tn_use_seen *seen;
    void *context;
    uint8_t *met;   /* [functions][USES] */
    tn_key pending; /* functions * USES + use */
    tn_use_node *nodes;
    size_t *open; /* the operands on the stack, as nodes */
    size_t count;
} tn_use_finder;

/* How the operands of an instruction are used. */
static tn_relation_use below(tn_opcode opcode, tn_relation_use use)
{
    switch (opcode) {
    case TN_OP_AND:
    case TN_OP_NOT:
        return use == TN_USE_WHOLE ? use : TN_USE_STRETCHES;
    case TN_OP_OR:
    case TN_OP_ONCE:
        return use;
    case TN_OP_SOMEWHERE:
        return TN_USE_SOMEWHERE == use || use == TN_USE_WHOLE ? TN_USE_SOMEWHERE : TN_USE_STRETCHES;
    case TN_OP_NONEMPTY:
        return use == TN_USE_SOMEWHERE ? use : TN_USE_STRETCHES;
    default:
        return TN_USE_STRETCHES;
    }
}

/* Reads a function's code; the result is its last node. */
static void read_nodes(tn_use_finder *finder, uint32_t function)
{
    const tn_function_record *record = &finder->module->FUNCTION_records[function];
    size_t depth = 0;
    finder->count = 0;
    for (uint32_t at = record->code_begin; at < record->code_end;) {
        tn_instruction op = tn_code_read(finder->module->code, at);
        if (op.opcode == TN_OP_RETURN)
            break;
        size_t first = finder->count;
        for (uint8_t p = tn_code_effect((uint8_t)op.opcode).pops; p > 0; p--)
            first = finder->open[--depth];
        finder->open[depth++] = first;
        finder->nodes[finder->count++] = (tn_use_node){.op = op, .start = first};
        at += op.length;
    }
}

static tn_status meet(tn_use_finder *finder, uint32_t function, tn_relation_use use, tn_error *error)
{
    uint32_t wanted = function * USES + (uint32_t)use;
    if (finder->met[wanted])
        return TN_OK;
    finder->met[wanted] = 1;
    return tn_key_push(&finder->pending, wanted) ? TN_OK : tn_fail_memory(error);
}

/* An instruction without operands: what it calls, or what it asks. */
static tn_status follow(tn_use_finder *finder, const tn_use_node *node, tn_error *error)
{
    const tn_module *module = finder->module;
    if (tn_code_asks_house(node->op.opcode))
        return finder->seen(finder->context, &node->op, node->use, error);
    if (tn_code_calls(node->op.opcode))
        return meet(finder, (uint32_t)node->op.first, node->use, error);
    tn_status status = TN_OK;
    if (!tn_code_compares(node->op.opcode))
        return status;
    const tn_sum_record *sum = &module->SUM_records[node->op.first];
    for (uint32_t i = 0; status == TN_OK && i < sum->term_count; i++)
        status = meet(finder, module->TERM_records[sum->term_first + i].part, TN_USE_STRETCHES, error);
    return status;
}

static tn_status walk(tn_use_finder *finder, uint32_t function, tn_relation_use use, tn_error *error)
{
    tn_status status = TN_OK;
    read_nodes(finder, function);
    if (finder->count > 0)
        finder->nodes[finder->count - 1].use = use;
    for (size_t i = finder->count; status == TN_OK && i-- > 0;) {
        const tn_use_node *node = &finder->nodes[i];
        size_t operand = i; /* the end of the operand's nodes */
        for (uint8_t p = tn_code_effect((uint8_t)node->op.opcode).pops; p > 0; p--) {
            finder->nodes[operand - 1].use = below(node->op.opcode, node->use);
            operand = finder->nodes[operand - 1].start;
        }
        status = follow(finder, node, error);
    }
    return status;
}

tn_status tn_rule_uses(const tn_module *module, uint32_t function, tn_use_seen *seen, void *context, tn_error *error)
{
    tn_use_finder finder = {.module = module, .seen = seen, .context = context};
    size_t longest = 0;
    for (uint32_t f = 0; f < module->FUNCTION_count; f++) {
        size_t bytes = module->FUNCTION_records[f].code_end - module->FUNCTION_records[f].code_begin;
        longest = bytes > longest ? bytes : longest;
    }
    finder.met = calloc(module->FUNCTION_count * USES + 1, 1);
    finder.nodes = malloc((longest + 1) * sizeof *finder.nodes);
    finder.open = malloc((longest + 1) * sizeof *finder.open);
    tn_status status = finder.met && finder.nodes && finder.open ? meet(&finder, function, TN_USE_WHOLE, error)
                                                                 : tn_fail_memory(error);
    while (status == TN_OK && finder.pending.size > 0) {
        uint32_t wanted = finder.pending.data[--finder.pending.size];
        status = walk(&finder, wanted / USES, (tn_relation_use)(wanted % USES), error);
    }
    free(finder.pending.data);
    free(finder.met);
    free(finder.nodes);
    free(finder.open);
    return status;
}
