/* Writes a checked connection grammar as records and code. What cannot be reached is left out. */
#include <stdio.h>

#include "compiler/pcfg/check.h"

typedef struct emitting {
    const tn_pcfg_grammar *grammar;
    tn_builder *builder;
    tn_names vectors; /* by their text: a number above their index */
    uint32_t first_symbol;
} emitting;

static uint32_t vector(emitting *e, const tn_step *step)
{
    char text[64];
    int length = snprintf(text, sizeof text, "%d,%d,%d", step->a[0], step->a[1], step->a[2]);
    const void *known = tn_names_get(&e->vectors, text);
    if (known)
        return (uint32_t)((uintptr_t)known - 1);
    tn_vector_record record = {.x = step->a[0], .y = step->a[1], .z = step->a[2]};
    uint32_t index = tn_builder_add_VECTOR(e->builder, &record);
    const char *name = tn_arena_copy(e->grammar->arena, text, (size_t)length);
    if (name)
        tn_names_put(&e->vectors, name, (void *)((uintptr_t)index + 1));
    return index;
}

static void emit_step(emitting *e, const tn_step *step)
{
    static const tn_opcode opcodes[] = {
        [TN_STEP_PUSH] = TN_OP_PUSH,
        [TN_STEP_POP] = TN_OP_POP,
        [TN_STEP_MOVE] = TN_OP_MOVE,
        [TN_STEP_TURN] = TN_OP_HEADING,
        [TN_STEP_COLOUR] = TN_OP_COLOUR,
        [TN_STEP_PART] = TN_OP_PART,
        [TN_STEP_FILL] = TN_OP_FILL,
        [TN_STEP_FILL_OVER] = TN_OP_FILL_OVER,
        [TN_STEP_TOUCH] = TN_OP_TOUCH,
        [TN_STEP_BOUND_BOX] = TN_OP_BOUND_BOX,
        [TN_STEP_BOUND_BALL] = TN_OP_BOUND_BALL,
        [TN_STEP_EXPAND] = TN_OP_DERIVE,
    };
    tn_opcode opcode = opcodes[step->kind];
    int64_t operand = 0;
    switch (tn_opcode_describe((uint8_t)opcode)->operands) {
    case TN_OPERANDS_VECTOR:
        operand = vector(e, step);
        break;
    case TN_OPERANDS_AMOUNT:
        operand = step->a[0];
        break;
    case TN_OPERANDS_PART:
        operand = tn_builder_string(e->builder, step->text);
        break;
    case TN_OPERANDS_SYMBOL:
        operand = e->first_symbol + e->grammar->symbols[step->index]->emitted;
        break;
    default:
        break;
    }
    tn_builder_emit(e->builder, opcode, operand, 0);
}

static void emit_alternative(emitting *e, const tn_pcfg_alternative *alternative)
{
    tn_builder *builder = e->builder;
    tn_production_record production = {.code_begin = tn_builder_offset(builder),
                                       .file = alternative->span.file,
                                       .begin = alternative->span.begin,
                                       .end = alternative->span.end,
                                       .weight = alternative->probability};
    for (const tn_pcfg_item *item = alternative->first; item; item = item->next) {
        tn_builder_add_SOURCE_MAP(builder, &(tn_source_map_record){.offset = tn_builder_offset(builder),
                                                                   .file = item->span.file,
                                                                   .begin = item->span.begin,
                                                                   .end = item->span.end});
        emit_step(e, &item->step);
    }
    tn_builder_emit(builder, TN_OP_PLACED, 0, 0);
    production.code_end = tn_builder_offset(builder);
    tn_builder_add_PRODUCTION(builder, &production);
}

static void emit_symbol(emitting *e, const tn_pcfg_symbol *symbol)
{
    tn_nonterminal_record record = {.name = tn_builder_string(e->builder, symbol->name),
                                    .production_first = (uint32_t)tn_builder_count(e->builder, TN_SECTION_PRODUCTION),
                                    .production_count = symbol->count,
                                    .file = symbol->span.file,
                                    .begin = symbol->span.begin,
                                    .end = symbol->span.end};
    for (const tn_pcfg_alternative *a = symbol->alternatives.first; a; a = a->next)
        emit_alternative(e, a);
    tn_builder_add_NONTERMINAL(e->builder, &record);
}

void tn_pcfg_emit(const tn_pcfg_grammar *grammar, const char *name, size_t length, tn_builder *builder)
{
    emitting e = {.grammar = grammar,
                  .builder = builder,
                  .vectors = {.arena = grammar->arena},
                  .first_symbol = (uint32_t)tn_builder_count(builder, TN_SECTION_NONTERMINAL)};
    uint32_t count = 0;
    for (uint32_t s = 0; s < grammar->count; s++)
        if (grammar->symbols[s]->reached)
            grammar->symbols[s]->emitted = count++;
    for (uint32_t s = 0; s < grammar->count; s++)
        if (grammar->symbols[s]->reached)
            emit_symbol(&e, grammar->symbols[s]);
    const tn_pcfg_symbol *start = grammar->symbols[0];
    tn_builder_add_GRAMMAR(builder, &(tn_grammar_record){.name = tn_builder_string_n(builder, name, length),
                                                         .dialect = TN_DIALECT_PLACE,
                                                         .repair = TN_REPAIR_OFF,
                                                         .rule_first = e.first_symbol,
                                                         .rule_count = count,
                                                         .rewrite_rule = TN_NO_RECORD,
                                                         .predecessor = TN_NO_RECORD,
                                                         .successor = TN_NO_RECORD,
                                                         .file = start->span.file,
                                                         .begin = start->span.begin,
                                                         .end = start->span.end});
}
