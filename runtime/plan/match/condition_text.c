/* Writes conditions as text. */
#include "runtime/plan/match/condition_text.h"

#include <stdio.h>
#include <string.h>

#include "runtime/module/code.h"

enum { PARTS_MAX = 8 };

/* How strongly a part binds: an operand that binds less than its operator needs parentheses. */
typedef enum condition_binding { BINDS_OR, BINDS_AND, BINDS_NOT, BINDS_COMPARISON } condition_binding;

typedef struct tn_condition_part {
    char text[TN_CONDITION_TEXT_MAX];
    condition_binding binding;
} tn_condition_part;

typedef struct tn_condition_parts {
    tn_condition_part items[PARTS_MAX];
    size_t count;
    bool overflow;
} tn_condition_parts;

/* Pushes what was printed; TN_CONDITION_TEXT_MAX or more means that it did not fit. */
static void push(tn_condition_parts *parts, const tn_condition_part *part, int printed)
{
    parts->overflow |= printed < 0 || printed >= TN_CONDITION_TEXT_MAX || parts->count == PARTS_MAX;
    if (!parts->overflow)
        parts->items[parts->count++] = *part;
}

static void combine(tn_condition_parts *parts, condition_binding binding, const char *operator)
{
    const tn_condition_part *right = &parts->items[--parts->count], *left = &parts->items[--parts->count];
    bool left_open = left->binding >= binding, right_open = right->binding >= binding;
    tn_condition_part part = {.binding = binding};
    int printed = snprintf(part.text, sizeof part.text, "%s%s%s %s %s%s%s", left_open ? "" : "(", left->text,
                           left_open ? "" : ")", operator, right_open ? "" : "(", right->text, right_open ? "" : ")");
    push(parts, &part, printed);
}

static void negate(tn_condition_parts *parts)
{
    const tn_condition_part *inner = &parts->items[--parts->count];
    bool open = inner->binding >= BINDS_NOT;
    tn_condition_part part = {.binding = BINDS_NOT};
    int printed = snprintf(part.text, sizeof part.text, "not %s%s%s", open ? "" : "(", inner->text, open ? "" : ")");
    push(parts, &part, printed);
}

static void compare(tn_condition_parts *parts, const tn_instruction *instruction)
{
    tn_condition_part part = {.binding = BINDS_COMPARISON};
    long long first = instruction->first, second = instruction->second;
    int printed = 0;
    switch (instruction->opcode) {
    case TN_OP_LESS:
        printed = snprintf(part.text, sizeof part.text, "n < %lld", first);
        break;
    case TN_OP_EQUAL:
        printed = snprintf(part.text, sizeof part.text, "n = %lld", first);
        break;
    case TN_OP_GREATER:
        printed = snprintf(part.text, sizeof part.text, "n > %lld", first);
        break;
    case TN_OP_WITHIN:
        printed = snprintf(part.text, sizeof part.text, "n in %lld..%lld", first, second);
        break;
    default:
        printed = snprintf(part.text, sizeof part.text, "n mod %lld = %lld", first, second);
        break;
    }
    push(parts, &part, printed);
}

void tn_condition_text(const tn_module *module, uint32_t function, char text[TN_CONDITION_TEXT_MAX])
{
    tn_condition_parts parts = {.count = 0};
    uint32_t offset = module->FUNCTION_records[function].code_begin;
    for (;;) {
        tn_instruction instruction = tn_code_read(module->code, offset);
        if (parts.overflow || instruction.opcode == TN_OP_ANSWER)
            break;
        if (instruction.opcode == TN_OP_BOTH)
            combine(&parts, BINDS_AND, "and");
        else if (instruction.opcode == TN_OP_EITHER)
            combine(&parts, BINDS_OR, "or");
        else if (instruction.opcode == TN_OP_NEITHER)
            negate(&parts);
        else
            compare(&parts, &instruction);
        offset += instruction.length;
    }
    strcpy(text, parts.overflow ? "..." : parts.items[0].text);
}
