/* Works out rules on a plan whose trays are gates: calls, circles, and instructions one after another. */
#include "runtime/plan/search/unroll.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/search/unroll_data.h"

#define CELLS_MAX (UINT64_C(1) << 26) /* of all relations together: 256 MB */

/* ---- relations */

static tn_status too_large(const tn_unrolled *u, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_SEARCH_TOO_LARGE,
            "rules on the stretches of %u trays have more than the limit of %llu gates", (unsigned)u->length,
            (unsigned long long)CELLS_MAX);
    tn_error_help(error, "give fewer trays with --trays");
    return TN_LIMIT;
}

tn_status tn_symbolic_new(tn_unrolled *u, bool plain, tn_symbolic *relation, tn_error *error)
{
    size_t cells = plain ? 1 : u->cells;
    if (cells > u->room)
        return too_large(u, error);
    *relation = (tn_symbolic){.cells = calloc(cells, sizeof *relation->cells), .plain = plain};
    if (!relation->cells)
        return tn_fail_memory(error);
    u->room -= cells;
    return TN_OK;
}

void tn_symbolic_free(tn_unrolled *u, tn_symbolic *relation)
{
    if (relation->cells)
        u->room += relation->plain ? 1 : u->cells;
    free(relation->cells);
    *relation = (tn_symbolic){0};
}

/* *relation := { [N - j, N - i) : [i, j) in it }. */
static void turn(const tn_unrolled *u, const tn_symbolic *from, const tn_symbolic *to)
{
    if (from->plain) {
        to->cells[0] = from->cells[0];
        return;
    }
    for (uint32_t i = 0; i <= u->length; i++)
        for (uint32_t j = i; j <= u->length; j++)
            to->cells[u->row[u->length - j] + u->length - i] = from->cells[u->row[i] + j];
}

static tn_status push(tn_unrolled *u, tn_symbolic relation, tn_error *error)
{
    if (!tn_array_reserve(&u->stack, &u->stack_capacity, u->depth, 1, sizeof *u->stack)) {
        tn_symbolic_free(u, &relation);
        return tn_fail_memory(error);
    }
    u->stack[u->depth++] = relation;
    return TN_OK;
}

/* ---- frames */

static tn_status add_frame(tn_unrolled *u, uint32_t function, bool plain, bool reversed, tn_error *error)
{
    if (!tn_array_reserve(&u->frames, &u->frame_capacity, u->frame_count, 1, sizeof *u->frames))
        return tn_fail_memory(error);
    unroll_frame frame = {.memo = tn_unroll_memo(function, plain, reversed), .reversed = reversed};
    tn_status status = tn_postfix_read(u->module, function, plain, &frame.code, error);
    if (status == TN_OK)
        u->frames[u->frame_count++] = frame;
    return status;
}

static void drop_frame(tn_unrolled *u)
{
    tn_postfix_clear(&u->frames[--u->frame_count].code);
}

/* ---- circles of functions: as the interpreter goes round them */

static bool is_member(const tn_unrolled *u, size_t first, uint32_t function)
{
    for (size_t i = first; i < u->member_count; i++)
        if (u->members[i] == function)
            return true;
    return false;
}

static tn_status add_member(tn_unrolled *u, uint32_t function, bool reversed, tn_error *error)
{
    if (!tn_array_reserve(&u->members, &u->member_capacity, u->member_count, 1, sizeof *u->members))
        return tn_fail_memory(error);
    u->members[u->member_count++] = function;
    tn_symbolic *memo = &u->memos[tn_unroll_memo(function, false, reversed)];
    tn_symbolic_free(u, memo);
    return tn_symbolic_new(u, false, memo, error);
}

/* Nothing is known of any function of the circle. */
static tn_status begin_circle(tn_unrolled *u, uint32_t function, bool reversed, tn_error *error)
{
    unroll_circle circle = {.first = u->member_count, .reversed = reversed, .frame = u->frame_count};
    if (!tn_array_reserve(&u->circles, &u->circle_capacity, u->circle_count, 1, sizeof *u->circles))
        return tn_fail_memory(error);
    tn_status status = add_member(u, function, reversed, error);
    for (size_t i = circle.first; status == TN_OK && i < u->member_count; i++) {
        const tn_function_record *record = &u->module->FUNCTION_records[u->members[i]];
        for (uint32_t at = record->code_begin; status == TN_OK && at < record->code_end;) {
            tn_instruction op = tn_code_read(u->module->code, at);
            if (op.opcode == TN_OP_AGAIN && !is_member(u, circle.first, (uint32_t)op.first))
                status = add_member(u, (uint32_t)op.first, reversed, error);
            at += op.length;
        }
    }
    circle.count = u->member_count - circle.first;
    if (status != TN_OK)
        return status;
    u->circles[u->circle_count++] = circle;
    return add_frame(u, u->members[circle.first], false, reversed, error);
}

static tn_status begin_function(tn_unrolled *u, uint32_t function, bool plain, bool reversed, tn_error *error)
{
    if (u->module->FUNCTION_records[function].kind == TN_FUNCTION_CIRCLE)
        return begin_circle(u, function, reversed, error);
    return add_frame(u, function, plain, reversed, error);
}

static unroll_circle *circle_at(const tn_unrolled *u)
{
    unroll_circle *circle = u->circle_count > 0 ? &u->circles[u->circle_count - 1] : NULL;
    return circle && circle->frame + 1 == u->frame_count ? circle : NULL;
}

/* The relation is what the circle's function says now: on to the next, until a round changes no gate. That ends, since
 * a stretch depends on shorter ones alone. */
static tn_status go_round(tn_unrolled *u, unroll_circle *circle, tn_symbolic now, tn_error *error)
{
    tn_symbolic *known = &u->memos[u->frames[u->frame_count - 1].memo];
    bool reversed = circle->reversed;
    circle->changed |= memcmp(known->cells, now.cells, u->cells * sizeof *now.cells) != 0;
    tn_symbolic_free(u, known);
    *known = now;
    drop_frame(u);
    if (++circle->next == circle->count && circle->changed) {
        circle->next = 0;
        circle->changed = false;
    }
    if (circle->next < circle->count)
        return add_frame(u, u->members[circle->first + circle->next], false, reversed, error);
    u->member_count = circle->first;
    u->circle_count--;
    return TN_OK;
}

/* ---- instructions */

/* The relation of a function, if it is known, in the form that is wanted or as a relation on all stretches. */
static const tn_symbolic *find_known(const tn_unrolled *u, uint32_t function, bool plain, bool reversed)
{
    const tn_symbolic *all = &u->memos[tn_unroll_memo(function, false, reversed)];
    const tn_symbolic *one = &u->memos[tn_unroll_memo(function, true, reversed)];
    return all->cells ? all : plain && one->cells ? one : NULL;
}

/* CALL, MIRROR, AGAIN: the relation that is found already, or starts finding it, to come back to this node. */
static tn_status run_call(tn_unrolled *u, unroll_frame *frame, const tn_postfix_node *node, tn_error *error)
{
    bool mirror = node->code.opcode == TN_OP_MIRROR, reversed = frame->reversed != mirror;
    uint32_t function = (uint32_t)node->code.first;
    const tn_symbolic *known = find_known(u, function, node->plain, reversed);
    tn_symbolic made = {0};
    if (!known)
        return begin_function(u, function, node->plain, reversed, error);
    tn_status status = tn_symbolic_new(u, node->plain, &made, error);
    if (status != TN_OK)
        return status;
    if (node->plain)
        made.cells[0] = tn_symbolic_at(u, known, 0, u->length);
    else if (mirror)
        turn(u, known, &made);
    else
        memcpy(made.cells, known->cells, u->cells * sizeof *made.cells);
    frame->at++;
    return push(u, made, error);
}

/* Starts finding a relation that the sum counts, if one is not known: *ready is false then. */
static tn_status find_parts(tn_unrolled *u, const tn_sum *sum, bool reversed, bool *ready, tn_error *error)
{
    *ready = false;
    for (uint32_t i = 0; i < sum->count; i++) {
        if (tn_term_is_gap(sum->terms[i].kind))
            return tn_fail(error, TN_LIMIT, E_SEARCH_TOO_LARGE, "gaps are measured of plans alone, not searched");
        if (!tn_unroll_known(u, sum->terms[i].part, reversed)->cells)
            return begin_function(u, sum->terms[i].part, false, reversed, error);
    }
    *ready = true;
    return TN_OK;
}

static tn_status run_compare(tn_unrolled *u, unroll_frame *frame, const tn_postfix_node *node, tn_error *error)
{
    const tn_sum *sum = NULL;
    bool ready = false, reversed = frame->reversed;
    tn_symbolic made = {0};
    tn_status status = tn_unroll_summed(u, (uint32_t)node->code.first, &sum, error);
    if (status == TN_OK)
        status = find_parts(u, sum, reversed, &ready, error);
    if (status != TN_OK || !ready)
        return status;
    status = tn_symbolic_new(u, node->plain, &made, error);
    if (status == TN_OK)
        status = tn_unroll_compare(u, &node->code, sum, reversed, &made, error);
    if (status == TN_OK) {
        frame->at++;
        return push(u, made, error);
    }
    tn_symbolic_free(u, &made);
    return status;
}

static tn_status run_operation(tn_unrolled *u, unroll_frame *frame, const tn_postfix_node *node, tn_error *error)
{
    uint8_t pops = tn_code_effect((uint8_t)node->code.opcode).pops;
    tn_symbolic made = {0};
    tn_status status = tn_symbolic_new(u, node->plain, &made, error);
    if (status == TN_OK)
        status = tn_unroll_operate(u, node, frame->reversed, u->stack + (u->depth - pops), &made, error);
    if (status == TN_OK)
        status = tn_circuit_status(u->circuit, error);
    if (status != TN_OK) {
        tn_symbolic_free(u, &made);
        return status;
    }
    for (; pops > 0; pops--)
        tn_symbolic_free(u, &u->stack[--u->depth]);
    frame->at++;
    return push(u, made, error);
}

/* The frame's one relation becomes the function's. */
static tn_status run_return(tn_unrolled *u, tn_error *error)
{
    unroll_circle *circle = circle_at(u);
    tn_symbolic made = u->stack[--u->depth];
    if (circle)
        return go_round(u, circle, made, error);
    u->memos[u->frames[u->frame_count - 1].memo] = made;
    drop_frame(u);
    return TN_OK;
}

static tn_status run_node(tn_unrolled *u, tn_error *error)
{
    unroll_frame *frame = &u->frames[u->frame_count - 1];
    if (frame->at == frame->code.count)
        return run_return(u, error);
    const tn_postfix_node *node = &frame->code.nodes[frame->at];
    tn_opcode opcode = node->code.opcode;
    if (tn_code_calls(opcode))
        return run_call(u, frame, node, error);
    if (tn_code_compares(opcode))
        return run_compare(u, frame, node, error);
    if (opcode == TN_OP_IMAGE || tn_code_asks_house(opcode))
        return tn_fail(error, TN_LIMIT, E_SEARCH_TOO_LARGE,
                       "whether a plan is the image of another is asked of plans alone, not searched");
    return run_operation(u, frame, node, error);
}

/* After a failure: what is half done is forgotten. */
static void unwind(tn_unrolled *u)
{
    for (; u->circle_count > 0; u->circle_count--) {
        const unroll_circle *circle = &u->circles[u->circle_count - 1];
        for (size_t i = 0; i < circle->count; i++)
            tn_symbolic_free(u, &u->memos[tn_unroll_memo(u->members[circle->first + i], false, circle->reversed)]);
    }
    u->member_count = 0;
    while (u->frame_count > 0)
        drop_frame(u);
    while (u->depth > 0)
        tn_symbolic_free(u, &u->stack[--u->depth]);
    tn_circuit_go_on(u->circuit);
}

static tn_status run_frames(tn_unrolled *u, tn_error *error)
{
    tn_status status = TN_OK;
    tn_watch *watch = u->module->watch;
    while (status == TN_OK && u->frame_count > 0) {
        status = run_node(u, error);
        if (status == TN_OK)
            status = tn_watch_check(watch, error);
    }
    return status;
}

/* ---- asked */

tn_status tn_unrolled_holds(tn_unrolled *u, uint32_t function, tn_signal *gate, tn_error *error)
{
    tn_status status = TN_OK;
    if (!find_known(u, function, true, false)) {
        status = begin_function(u, function, true, false, error);
        if (status == TN_OK)
            status = run_frames(u, error);
    }
    if (status == TN_OK)
        *gate = tn_symbolic_at(u, find_known(u, function, true, false), 0, u->length);
    else
        unwind(u);
    return status;
}

tn_status tn_unrolled_value(tn_unrolled *u, const tn_sum *sum, tn_adder *adder, tn_signal *has, tn_error *error)
{
    bool ready = false;
    tn_status status = TN_OK;
    while (status == TN_OK && !ready) {
        status = find_parts(u, sum, false, &ready, error);
        if (status == TN_OK && !ready)
            status = run_frames(u, error);
    }
    if (status == TN_OK)
        status = tn_unroll_values(u, sum, adder, has, error);
    if (status != TN_OK)
        unwind(u);
    return status;
}

/* ---- making */

static void find_rows(tn_unrolled *u)
{
    size_t begin = 0;
    for (uint32_t i = 0; i <= u->length; i++) {
        u->row[i] = begin - i; /* may wrap: with j added it does not */
        begin += u->length + 1 - i;
    }
    u->cells = begin;
}

tn_status tn_unrolled_new(const tn_letters *letters, tn_unrolled **out, tn_error *error)
{
    tn_unrolled *u = calloc(1, sizeof *u);
    if (!u)
        return tn_fail_memory(error);
    u->circuit = letters->circuit;
    u->letters = letters;
    u->schema = letters->schema;
    u->module = letters->schema->module;
    u->length = letters->length;
    u->room = CELLS_MAX;
    u->adder.circuit = u->circuit;
    u->row = tn_array_new((uint64_t)u->length + 1, sizeof *u->row);
    if (u->row)
        find_rows(u);
    if (u->cells > CELLS_MAX) {
        tn_status status = too_large(u, error);
        tn_unrolled_free(u);
        return status;
    }
    u->memos = calloc(4 * u->module->FUNCTION_count + 1, sizeof *u->memos);
    u->truths = tn_array_new((uint64_t)u->length + 1, sizeof *u->truths);
    u->gates = u->row ? tn_array_new((uint64_t)u->cells + 2 * (uint64_t)u->length + 4, sizeof *u->gates) : NULL;
    if (!u->row || !u->memos || !u->truths || !u->gates) {
        tn_unrolled_free(u);
        return tn_fail_memory(error);
    }
    *out = u;
    return TN_OK;
}

void tn_unrolled_free(tn_unrolled *u)
{
    if (!u)
        return;
    unwind(u);
    for (size_t i = 0; u->memos && i < 4 * u->module->FUNCTION_count; i++)
        tn_symbolic_free(u, &u->memos[i]);
    tn_unroll_clear_sums(u);
    free(u->memos);
    free(u->frames);
    free(u->stack);
    free(u->circles);
    free(u->members);
    free(u->row);
    free(u->truths);
    free(u->gates);
    free(u);
}
