/* Interprets the code of rules over a plan. */
#include "runtime/plan/match/vm.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/match/relation.h"
#include "runtime/plan/match/vm_data.h"

/* ---- memory */

static tn_status out_of_room(const tn_plan_vm *vm, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_MATCHING_MEMORY,
            "matching a plan of %zu trays needs more memory than the limit of %llu bytes", vm->length,
            (unsigned long long)vm->memory_limit);
    tn_error_help(error, "match shorter plans, or by automata (--engine=dfa), which need neither");
    return TN_LIMIT;
}

/* Reallocates *block from `before` to `after` bytes, within the memory limit. */
static tn_status resize(tn_plan_vm *vm, void **block, uint64_t before, uint64_t after, tn_error *error)
{
    if (after > vm->memory_limit || vm->memory - before > vm->memory_limit - after)
        return out_of_room(vm, error);
    if (!tn_array_resize(block, tn_as_size(after), 1))
        return tn_fail_memory(error);
    vm->memory += after - before;
    return TN_OK;
}

/* Room for one more relation; the new one is the last and has no contents yet. */
static tn_status add_relation(tn_plan_vm *vm, vm_relations *relations, tn_error *error)
{
    size_t needed = (relations->count + 1) * vm->relation_size;
    if (needed > relations->capacity) {
        size_t capacity = needed + needed / 2 + 64;
        void *words = relations->words;
        tn_status status =
            resize(vm, &words, relations->capacity * sizeof(uint64_t), capacity * sizeof(uint64_t), error);
        if (status != TN_OK)
            return status;
        relations->words = words;
        relations->capacity = capacity;
    }
    relations->count++;
    return TN_OK;
}

static tn_status add_frame(tn_plan_vm *vm, uint32_t function, bool reversed, tn_error *error)
{
    if (vm->frame_count == vm->frame_capacity) {
        size_t capacity = vm->frame_capacity * 2 + 16;
        void *frames = vm->frames;
        tn_status status =
            resize(vm, &frames, vm->frame_capacity * sizeof *vm->frames, capacity * sizeof *vm->frames, error);
        if (status != TN_OK)
            return status;
        vm->frames = frames;
        vm->frame_capacity = capacity;
    }
    uint32_t begin = vm->module->FUNCTION_records[function].code_begin;
    vm->frames[vm->frame_count++] = (vm_frame){.function = function, .offset = begin, .reversed = reversed};
    return TN_OK;
}

/* ---- circles of functions */

static bool is_member(const uint32_t *members, size_t count, uint32_t function)
{
    for (size_t i = 0; i < count; i++)
        if (members[i] == function)
            return true;
    return false;
}

static tn_status add_member(tn_plan_vm *vm, uint32_t function, tn_error *error)
{
    if (!tn_array_reserve(&vm->members, &vm->member_capacity, vm->member_count, 1, sizeof *vm->members))
        return tn_fail_memory(error);
    vm->members[vm->member_count++] = function;
    return TN_OK;
}

/* Lists a function and all that it takes again, directly or not. */
static tn_status list_members(tn_plan_vm *vm, uint32_t function, tn_error *error)
{
    const tn_module *module = vm->module;
    size_t first = vm->member_count;
    tn_status status = add_member(vm, function, error);
    for (size_t i = first; status == TN_OK && i < vm->member_count; i++) {
        const tn_function_record *record = &module->FUNCTION_records[vm->members[i]];
        for (uint32_t at = record->code_begin; status == TN_OK && at < record->code_end;) {
            tn_instruction op = tn_code_read(module->code, at);
            if (op.opcode == TN_OP_AGAIN &&
                !is_member(vm->members + first, vm->member_count - first, (uint32_t)op.first))
                status = add_member(vm, (uint32_t)op.first, error);
            at += op.length;
        }
    }
    return status;
}

static uint64_t *found_relation(const tn_plan_vm *vm, const vm_memo *memo)
{
    return vm->found.words + memo->slot * vm->relation_size;
}

/* Starts going round the circle of a function: nothing is known of any of its functions. */
static tn_status begin_circle(tn_plan_vm *vm, uint32_t function, bool reversed, tn_error *error)
{
    vm_circle circle = {.first = vm->member_count, .reversed = reversed, .frame = vm->frame_count};
    if (!tn_array_reserve(&vm->circles, &vm->circle_capacity, vm->circle_count, 1, sizeof *vm->circles))
        return tn_fail_memory(error);
    tn_status status = list_members(vm, function, error);
    circle.count = vm->member_count - circle.first;
    for (size_t i = 0; status == TN_OK && i < circle.count; i++) {
        vm_memo *memo = &vm->memos[2 * (size_t)vm->members[circle.first + i] + reversed];
        status = add_relation(vm, &vm->found, error);
        if (status != TN_OK)
            return status;
        *memo = (vm_memo){.generation = vm->generation, .slot = (uint32_t)(vm->found.count - 1)};
        memset(found_relation(vm, memo), 0, vm->relation_size * sizeof(uint64_t));
    }
    if (status != TN_OK)
        return status;
    vm->circles[vm->circle_count++] = circle;
    return add_frame(vm, vm->members[circle.first], reversed, error);
}

/* Starts finding the relation of a function. */
static tn_status begin_function(tn_plan_vm *vm, uint32_t function, bool reversed, tn_error *error)
{
    bool circle = vm->module->FUNCTION_records[function].kind == TN_FUNCTION_CIRCLE;
    return (circle ? begin_circle : add_frame)(vm, function, reversed, error);
}

/* The circle whose function the last frame evaluates, or NULL. */
static vm_circle *circle_at(const tn_plan_vm *vm)
{
    vm_circle *circle = vm->circle_count > 0 ? &vm->circles[vm->circle_count - 1] : NULL;
    return circle && circle->frame + 1 == vm->frame_count ? circle : NULL;
}

/* The relation on top of the stack is what the circle's function says now: goes on to the next function of the circle,
 * or ends. */
static tn_status go_round(tn_plan_vm *vm, vm_circle *circle, const vm_frame *frame, tn_error *error)
{
    vm_memo *memo = &vm->memos[2 * (size_t)frame->function + frame->reversed];
    uint64_t *known = found_relation(vm, memo), *now = vm->stack.words + --vm->stack.count * vm->relation_size;
    bool changed = memcmp(known, now, vm->relation_size * sizeof *known) != 0;
    bool reversed = circle->reversed;
    memcpy(known, now, vm->relation_size * sizeof *known);
    circle->changed = circle->changed || changed;
    vm->frame_count--;
    if (++circle->next == circle->count && circle->changed) {
        circle->next = 0;
        circle->changed = false;
    }
    if (circle->next < circle->count)
        return add_frame(vm, vm->members[circle->first + circle->next], reversed, error);
    vm->member_count = circle->first;
    vm->circle_count--;
    return TN_OK;
}

/* Room for the plan and for one operation on it, in one block. */
static tn_status make_room(tn_plan_vm *vm, size_t length, tn_error *error)
{
    if (vm->room_block && length <= vm->room)
        return TN_OK;
    size_t count = length + length / 2 + 64, row_words = count / 64 + 1;
    size_t bytes = TN_VM_ROWS * row_words * sizeof(uint64_t) +
                   count * (sizeof(int64_t) + sizeof(size_t) + sizeof(tn_tray) + sizeof(uint8_t));
    tn_status status = resize(vm, &vm->room_block, vm->room_bytes, bytes, error);
    if (status != TN_OK)
        return status;
    vm->room_bytes = bytes;
    vm->room = count - 1;
    vm->rows = vm->room_block;
    vm->sums = (int64_t *)(vm->rows + TN_VM_ROWS * row_words);
    vm->places = (size_t *)(vm->sums + count);
    vm->trays = (tn_tray *)(vm->places + count);
    vm->truths = (uint8_t *)(vm->trays + count);
    return TN_OK;
}

/* ---- the interpreter */

/* How often it chains. */
static uint64_t times(const tn_plan_vm *vm, const tn_instruction *op)
{
    uint64_t most = op->second == 0 || (uint64_t)op->second > vm->length ? 2 : (uint64_t)op->second;
    return ((uint64_t)op->first > vm->length ? 0 : (uint64_t)op->first) + most;
}

/* About how many words an operation touches; conditions cost a word a byte of code. */
static uint64_t cost(const tn_plan_vm *vm, const tn_instruction *op)
{
    uint64_t rows = vm->length + 1;
    uint32_t condition = UINT32_MAX;
    uint64_t asked = rows;
    if (op->opcode == TN_OP_REPEATED)
        return vm->relation_size + rows * rows / 2 * vm->words * times(vm, op);
    if (op->opcode == TN_OP_CHAIN || op->opcode == TN_OP_MIRROR)
        return vm->relation_size + rows * rows / 2 * vm->words;
    if (op->opcode == TN_OP_QUANTITY || op->opcode == TN_OP_OCCURRENCES)
        condition = (uint32_t)op->first;
    if (op->opcode == TN_OP_SUM) {
        condition = (uint32_t)op->second;
        asked = rows * rows / 2 + rows;
    }
    if (op->opcode == TN_OP_MIRRORED)
        return vm->relation_size + rows * rows / 2;
    if (tn_code_compares(op->opcode))
        return rows * rows / 2 + rows * vm->module->SUM_records[op->first].term_count * (vm->words + 1);
    if (condition == UINT32_MAX)
        return vm->relation_size;
    const tn_function_record *record = &vm->module->FUNCTION_records[condition];
    return rows * rows / 2 + asked * (record->code_end - record->code_begin);
}

static tn_status spend(tn_plan_vm *vm, const tn_instruction *op, uint32_t offset, tn_error *error)
{
    uint64_t words = cost(vm, op);
    if (words <= vm->work) {
        vm->work -= words;
        return TN_OK;
    }
    tn_fail(error, TN_LIMIT, E_MATCHING_WORK, "matching a plan of %zu trays takes more than the limit of %llu steps",
            vm->length, (unsigned long long)vm->work_limit);
    tn_error_help(error, "match shorter plans, or by automata (--engine=dfa), which need neither");
    if (error)
        error->code_offset = offset;
    return TN_LIMIT;
}

static bool is_found(const tn_plan_vm *vm, const vm_memo *memo)
{
    return memo->generation == vm->generation;
}

/* CALL, MIRROR and AGAIN: pushes a relation that is found already, or starts finding it, to come back to this
 * instruction. */
static tn_status run_call(tn_plan_vm *vm, vm_frame *frame, const tn_instruction *op, tn_error *error)
{
    bool mirror = op->opcode == TN_OP_MIRROR;
    bool reversed = frame->reversed != mirror;
    uint32_t function = (uint32_t)op->first;
    const vm_memo *memo = &vm->memos[2 * (size_t)function + reversed];
    if (!is_found(vm, memo))
        return begin_function(vm, function, reversed, error);
    tn_status status = add_relation(vm, &vm->stack, error);
    if (status != TN_OK)
        return status;
    uint64_t *top = vm->stack.words + (vm->stack.count - 1) * vm->relation_size;
    const uint64_t *relation = found_relation(vm, memo);
    if (!mirror)
        memcpy(top, relation, vm->relation_size * sizeof *top);
    else if (vm->words == 1)
        tn_relation_turn(top, relation, vm->length, 1);
    else
        tn_relation_turn(top, relation, vm->length, vm->words);
    frame->offset += op->length;
    return TN_OK;
}

/* RETURN: the frame's one relation becomes the function's. */
static tn_status run_return(tn_plan_vm *vm, const vm_frame *frame, tn_error *error)
{
    vm_circle *circle = circle_at(vm);
    if (circle)
        return go_round(vm, circle, frame, error);
    tn_status status = add_relation(vm, &vm->found, error);
    if (status != TN_OK)
        return status;
    vm_memo *memo = &vm->memos[2 * (size_t)frame->function + frame->reversed];
    *memo = (vm_memo){.generation = vm->generation, .slot = (uint32_t)(vm->found.count - 1)};
    vm->stack.count--;
    memcpy(found_relation(vm, memo), vm->stack.words + vm->stack.count * vm->relation_size,
           vm->relation_size * sizeof(uint64_t));
    vm->frame_count--;
    return TN_OK;
}

/* The house is asked for the plain relation; a mirrored house has the same cells, rooms and faces, turned round. */
static tn_status run_house(tn_plan_vm *vm, vm_frame *frame, const tn_instruction *op, tn_error *error)
{
    if (!vm->ask) {
        tn_fail(error, TN_INVALID, E_NOT_A_HOUSE, "this asks for the cells and rooms of a house, and there is a plan");
        tn_error_help(error, "give a house line: `plan ; options ; functions ; faces ; tiles`");
        return TN_INVALID;
    }
    tn_status status = add_relation(vm, &vm->stack, error);
    if (status == TN_OK)
        status = add_relation(vm, &vm->stack, error); /* room to turn it */
    if (status != TN_OK)
        return status;
    uint64_t *top = vm->stack.words + (--vm->stack.count - 1) * vm->relation_size;
    uint64_t *plain = frame->reversed ? top + vm->relation_size : top;
    memset(plain, 0, vm->relation_size * sizeof *plain);
    status = vm->ask(vm->house, op, plain, vm->words, error);
    if (frame->reversed)
        tn_relation_turn(top, plain, vm->length, vm->words);
    frame->offset += op->length;
    return status;
}

/* IMAGE: the plan as a whole, or nothing. */
static tn_status run_image(tn_plan_vm *vm, vm_frame *frame, const tn_instruction *op, tn_error *error)
{
    bool found = false;
    tn_status status = add_relation(vm, &vm->stack, error);
    if (status == TN_OK)
        status = tn_plan_vm_image(vm, op, frame->reversed, &found, error);
    if (status != TN_OK) {
        if (error)
            error->code_offset = frame->offset;
        return status;
    }
    uint64_t *top = vm->stack.words + (vm->stack.count - 1) * vm->relation_size;
    memset(top, 0, vm->relation_size * sizeof *top);
    if (found)
        tn_relation_row_set(top, vm->length);
    frame->offset += op->length;
    return TN_OK;
}

const uint64_t *tn_plan_vm_found(const tn_plan_vm *vm, uint32_t function, bool reversed)
{
    const vm_memo *memo = &vm->memos[2 * (size_t)function + reversed];
    return is_found(vm, memo) ? found_relation(vm, memo) : NULL;
}

/* BELOW, ZERO, ABOVE: starts finding what the sum counts, to come back to this instruction, or compares. */
static tn_status run_compare(tn_plan_vm *vm, vm_frame *frame, const tn_instruction *op, tn_error *error)
{
    const tn_sum *sum;
    uint32_t function;
    tn_status status = tn_plan_vm_summed(vm, (uint32_t)op->first, &sum, error);
    if (status != TN_OK && error)
        error->code_offset = frame->offset;
    if (status != TN_OK)
        return status;
    bool reversed = frame->reversed;
    if (tn_plan_vm_sum_needs(vm, sum, reversed, &function))
        return begin_function(vm, function, reversed, error);
    status = add_relation(vm, &vm->stack, error);
    if (status != TN_OK)
        return status;
    tn_plan_vm_compare(vm, op, sum, vm->stack.words + (vm->stack.count - 1) * vm->relation_size, reversed);
    frame->offset += op->length;
    return TN_OK;
}

static tn_status run_instruction(tn_plan_vm *vm, tn_error *error)
{
    vm_frame *frame = &vm->frames[vm->frame_count - 1];
    tn_instruction op = tn_code_read(vm->module->code, frame->offset);
    tn_status status = spend(vm, &op, frame->offset, error);
    if (status != TN_OK)
        return status;
    if (tn_code_calls(op.opcode))
        return run_call(vm, frame, &op, error);
    if (tn_code_compares(op.opcode))
        return run_compare(vm, frame, &op, error);
    if (op.opcode == TN_OP_RETURN)
        return run_return(vm, frame, error);
    if (tn_code_asks_house(op.opcode))
        return run_house(vm, frame, &op, error);
    if (op.opcode == TN_OP_IMAGE)
        return run_image(vm, frame, &op, error);

    const tn_opcode_effect effect = tn_code_effect((uint8_t)op.opcode);
    if (effect.pops == 0 && (status = add_relation(vm, &vm->stack, error)) != TN_OK)
        return status;
    if (op.opcode == TN_OP_REPEATED && (status = add_relation(vm, &vm->stack, error)) != TN_OK) /* room for it */
        return status;
    vm->stack.count -= op.opcode == TN_OP_REPEATED;
    if (effect.pops > 0)
        vm->stack.count -= effect.pops - 1u;
    uint64_t *top = vm->stack.words + (vm->stack.count - 1) * vm->relation_size;
    tn_plan_vm_operate(vm, &op, top, frame->reversed);
    frame->offset += op.length;
    return TN_OK;
}

static bool is_disabled(const tn_plan_vm *vm, uint32_t offset)
{
    for (size_t i = 0; i < vm->disabled_count; i++)
        if (vm->disabled[i] == offset)
            return true;
    return false;
}

/* Runs the next instruction. One that is disabled makes an empty relation as soon as it makes one: a call that still
 * has to find the function's relation comes back to it. */
static tn_status step(tn_plan_vm *vm, tn_error *error)
{
    if (vm->disabled_count == 0)
        return run_instruction(vm, error);
    size_t frames = vm->frame_count;
    uint32_t offset = vm->frames[frames - 1].offset;
    tn_status status = run_instruction(vm, error);
    bool made = status == TN_OK && vm->frame_count == frames && vm->frames[frames - 1].offset != offset;
    if (made && is_disabled(vm, offset))
        memset(vm->stack.words + (vm->stack.count - 1) * vm->relation_size, 0,
               vm->relation_size * sizeof *vm->stack.words);
    return status;
}

/* Leaves behind what a failure may have left there. A circle that was not gone round to its end is found again. */
static void start_stack(tn_plan_vm *vm)
{
    for (size_t i = 0; i < vm->circle_count; i++)
        for (size_t k = 0; k < vm->circles[i].count; k++)
            vm->memos[2 * (size_t)vm->members[vm->circles[i].first + k] + vm->circles[i].reversed].generation = 0;
    vm->circle_count = vm->member_count = 0;
    vm->stack.count = 0;
    vm->frame_count = 0;
}

/* The relation of a function on the plan, found now or before. */
static tn_status evaluate(tn_plan_vm *vm, uint32_t function, const uint64_t **relation, tn_error *error)
{
    if (function >= vm->module->FUNCTION_count ||
        vm->module->FUNCTION_records[function].kind == TN_FUNCTION_CONDITION ||
        &vm->module->SCHEMA_records[vm->module->FUNCTION_records[function].schema] != vm->schema->record)
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "function %u is not a rule of the schema", (unsigned)function);
    const vm_memo *memo = &vm->memos[2 * (size_t)function];
    vm->work = vm->work_limit;
    vm->tries = vm->tries_limit;
    if (!is_found(vm, memo)) {
        start_stack(vm);
        tn_status status = begin_function(vm, function, false, error);
        while (status == TN_OK && vm->frame_count > 0)
            status = step(vm, error);
        if (status != TN_OK)
            return status;
    }
    *relation = found_relation(vm, memo);
    return TN_OK;
}

/* ---- the public face */

tn_status tn_plan_vm_new(const tn_schema *schema, size_t max_length, tn_plan_vm **out, tn_error *error)
{
    *out = NULL;
    tn_plan_vm *vm = calloc(1, sizeof *vm);
    if (!vm)
        return tn_fail_memory(error);
    vm->schema = schema;
    vm->module = schema->module;
    vm->max_length = max_length > 0 ? max_length : TN_VM_LENGTH_DEFAULT;
    vm->memory_limit = TN_VM_MEMORY_DEFAULT;
    vm->work_limit = TN_VM_WORK_DEFAULT;
    vm->tries_limit = TN_VM_TRIES_MAX;
    vm->memos = calloc(2 * vm->module->FUNCTION_count + 1, sizeof *vm->memos);
    vm->memory = 2 * vm->module->FUNCTION_count * sizeof *vm->memos;
    tn_status status = vm->memos ? tn_plan_vm_plan(vm, NULL, 0, error) : tn_fail_memory(error);
    if (status != TN_OK) {
        tn_plan_vm_free(vm);
        return status;
    }
    *out = vm;
    return TN_OK;
}

void tn_plan_vm_free(tn_plan_vm *vm)
{
    if (!vm)
        return;
    for (size_t i = 0; vm->summed && i < vm->module->SUM_count; i++)
        tn_sum_free(vm->summed[i]);
    tn_plan_vm_free_images(vm);
    free(vm->summed);
    free(vm->memos);
    free(vm->found.words);
    free(vm->stack.words);
    free(vm->frames);
    free(vm->circles);
    free(vm->members);
    free(vm->room_block);
    free(vm);
}

void tn_plan_vm_limit(tn_plan_vm *vm, uint64_t memory, uint64_t work)
{
    if (memory > 0)
        vm->memory_limit = memory;
    if (work > 0)
        vm->work_limit = work;
}

void tn_plan_vm_disable(tn_plan_vm *vm, const uint32_t *offsets, size_t count)
{
    vm->disabled = offsets;
    vm->disabled_count = count;
}

tn_status tn_plan_vm_plan(tn_plan_vm *vm, const tn_tray *trays, size_t length, tn_error *error)
{
    if (length > vm->max_length) {
        tn_fail(error, TN_LIMIT, E_PLAN_TOO_LONG, "a plan of %zu trays is longer than the limit of %zu", length,
                vm->max_length);
        tn_error_help(error, "--max-length raises the limit");
        return TN_LIMIT;
    }
    tn_status status = make_room(vm, length, error);
    if (status != TN_OK)
        return status;
    if (length > 0)
        memcpy(vm->trays, trays, length * sizeof *trays);
    vm->ask = NULL;
    vm->length = length;
    vm->words = length / 64 + 1;
    vm->relation_size = (length + 1) * vm->words;
    vm->found.count = 0;
    vm->stack.count = 0;
    if (++vm->generation == 0) { /* after 2^32 plans the stamps start again */
        memset(vm->memos, 0, 2 * vm->module->FUNCTION_count * sizeof *vm->memos);
        vm->generation = 1;
    }
    return TN_OK;
}

void tn_plan_vm_house(tn_plan_vm *vm, tn_plan_vm_ask *ask, void *house)
{
    vm->ask = ask;
    vm->house = house;
}

tn_status tn_plan_vm_relation(tn_plan_vm *vm, uint32_t function, size_t begin, size_t end, bool *in, tn_error *error)
{
    const uint64_t *relation = NULL;
    tn_status status = evaluate(vm, function, &relation, error);
    if (status == TN_OK)
        *in = tn_relation_row_has(relation + begin * vm->words, end);
    return status;
}

tn_status tn_plan_vm_term(tn_plan_vm *vm, uint32_t code_begin, uint32_t code_end, bool reversed,
                          const uint64_t **relation, size_t *words, tn_error *error)
{
    vm->work = vm->work_limit;
    vm->tries = vm->tries_limit;
    start_stack(vm);
    tn_status status = add_frame(vm, 0, reversed, error);
    if (status == TN_OK)
        vm->frames[0].offset = code_begin;
    while (status == TN_OK && (vm->frame_count > 1 || vm->frames[0].offset < code_end))
        status = step(vm, error);
    *relation = vm->stack.words;
    *words = vm->words;
    return status;
}

tn_status tn_plan_vm_holds(tn_plan_vm *vm, uint32_t function, bool *holds, tn_error *error)
{
    return tn_plan_vm_relation(vm, function, 0, vm->length, holds, error);
}
