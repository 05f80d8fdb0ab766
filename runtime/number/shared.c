/* Finds what formulas have in common, and evaluates each part once. */
#include "runtime/number/shared.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/module/code.h"
#include "runtime/number/operation.h"

#define NONE UINT32_MAX

typedef struct tn_shared_node {
    tn_opcode opcode;
    uint32_t in[TN_ARITY_MAX]; /* nodes; of TERM: in[0] is its number */
    uint64_t number;           /* of NUMBER: its bits */
    uint32_t last;             /* the last node that needs it; itself, where none does */
    uint32_t row;              /* where its values are; of a TERM: NONE */
} node;

void tn_shared_clear(tn_shared *s)
{
    free(s->nodes);
    tn_hash_clear(&s->index);
    free(s->stack);
    free(s->roots);
    free(s->heads);
    free(s->next);
    free(s->free);
    free(s->rows);
    *s = (tn_shared){0};
}

void tn_shared_begin(tn_shared *s)
{
    s->node_count = s->root_count = 0;
    tn_hash_forget(&s->index);
}

/* ---- nodes */

static uint64_t mix(uint64_t hash, uint64_t value)
{
    hash = (hash ^ value) * UINT64_C(0x9E3779B97F4A7C15); /* 2^64 / the golden ratio */
    return hash ^ hash >> 29;
}

static uint64_t hash_of(const node *n)
{
    uint64_t hash = mix((uint64_t)n->opcode + 1, n->number);
    for (size_t i = 0; i < TN_ARITY_MAX; i++)
        hash = mix(hash, n->in[i]);
    return hash;
}

static bool same(const node *a, const node *b)
{
    bool alike = a->opcode == b->opcode && a->number == b->number;
    for (size_t i = 0; i < TN_ARITY_MAX; i++)
        alike &= a->in[i] == b->in[i];
    return alike;
}

typedef struct wanted_node {
    const tn_shared *shared;
    const node *node;
} wanted_node;

static bool is_wanted(const void *context, uint32_t number)
{
    const wanted_node *w = context;
    return same(&w->shared->nodes[number], w->node);
}

/* The node that is like this one; false if out of memory. */
static bool enter(tn_shared *s, const node *n, uint32_t *index)
{
    if (!tn_array_reserve(&s->nodes, &s->node_capacity, s->node_count, 1, sizeof *s->nodes))
        return false;
    wanted_node wanted = {s, n};
    *index = (uint32_t)s->node_count;
    if (tn_hash_enter(&s->index, hash_of(n), is_wanted, &wanted, index, NULL) != TN_OK)
        return false;
    if (*index == s->node_count)
        s->nodes[s->node_count++] = *n;
    return true;
}

/* Both sides of a sum or a product may change places. */
static void order_operands(node *n)
{
    if ((n->opcode == TN_OP_ADD || n->opcode == TN_OP_MULTIPLY) && n->in[0] > n->in[1]) {
        uint32_t first = n->in[0];
        n->in[0] = n->in[1];
        n->in[1] = first;
    }
}

tn_status tn_shared_add(tn_shared *s, const uint8_t *code, tn_error *error)
{
    size_t height = 0;
    uint32_t offset = 0;
    for (tn_instruction i = tn_code_read(code, offset); i.opcode != TN_OP_VALUE; i = tn_code_read(code, offset)) {
        node n = {.opcode = i.opcode};
        uint32_t arity = tn_code_effect((uint8_t)i.opcode).pops;
        height -= arity;
        for (uint32_t k = 0; k < arity; k++)
            n.in[k] = s->stack[height + k];
        if (i.opcode == TN_OP_TERM)
            n.in[0] = (uint32_t)i.first;
        if (i.opcode == TN_OP_NUMBER)
            n.number = (uint64_t)i.first;
        order_operands(&n);
        if (!tn_array_reserve(&s->stack, &s->stack_capacity, height, 1, sizeof *s->stack) ||
            !enter(s, &n, &s->stack[height]))
            return tn_fail_memory(error);
        height++;
        offset += i.length;
    }
    if (!tn_array_reserve(&s->roots, &s->root_capacity, s->root_count, 1, sizeof *s->roots))
        return tn_fail_memory(error);
    s->roots[s->root_count++] = s->stack[0];
    return TN_OK;
}

static bool is_operation(const node *n)
{
    return n->opcode != TN_OP_TERM && n->opcode != TN_OP_NUMBER;
}

size_t tn_shared_operations(const tn_shared *s)
{
    size_t operations = 0;
    for (size_t i = 0; i < s->node_count; i++)
        operations += is_operation(&s->nodes[i]);
    return operations;
}

/* ---- rows */

/* Until when each node is needed, and how many rows that takes. What is the value of a formula is copied as soon as it
 * is there. */
static bool give_rows(tn_shared *s)
{
    s->row_count = s->free_count = 0;
    if (!tn_array_reserve(&s->free, &s->free_capacity, 0, s->node_count + 1, sizeof *s->free))
        return false;
    for (uint32_t i = 0; i < s->node_count; i++) {
        node *n = &s->nodes[i];
        n->last = i;
        for (uint32_t k = 0; is_operation(n) && k < tn_code_effect((uint8_t)n->opcode).pops; k++)
            s->nodes[n->in[k]].last = i;
    }
    for (uint32_t i = 0; i < s->node_count; i++) {
        node *n = &s->nodes[i];
        n->row = n->opcode == TN_OP_TERM ? NONE : s->free_count ? s->free[--s->free_count] : (uint32_t)s->row_count++;
        if (n->last == i && n->row != NONE)
            s->free[s->free_count++] = n->row;
        for (uint32_t k = 0; is_operation(n) && k < tn_code_effect((uint8_t)n->opcode).pops; k++) {
            node *operand = &s->nodes[n->in[k]];
            bool again = k > 0 && (n->in[k] == n->in[0] || (k > 1 && n->in[k] == n->in[1]));
            if (operand->last == i && operand->row != NONE && !again)
                s->free[s->free_count++] = operand->row;
        }
    }
    return tn_array_reserve(&s->rows, &s->row_capacity, 0, s->row_count * TN_ROW, sizeof *s->rows);
}

static const double *values_of(const tn_shared *s, uint32_t index, const double *const *columns, size_t from)
{
    const node *n = &s->nodes[index];
    return n->opcode == TN_OP_TERM ? columns[n->in[0]] + from : s->rows + (size_t)n->row * TN_ROW;
}

static void run_node(const tn_shared *s, const node *n, const double *const *columns, size_t from)
{
    double *out = s->rows + (size_t)n->row * TN_ROW;
    if (n->opcode == TN_OP_NUMBER) {
        double number = tn_double_of(n->number);
        for (size_t i = 0; i < TN_ROW; i++)
            out[i] = number;
        return;
    }
    const double *operands[TN_ARITY_MAX];
    for (uint32_t k = 0; k < tn_code_effect((uint8_t)n->opcode).pops; k++)
        operands[k] = values_of(s, n->in[k], columns, from);
    tn_operation_row(n->opcode, operands, out);
}

/* Formulas in the order of their nodes: where a node is the value of several, they follow one another. */
static bool order_roots(tn_shared *s)
{
    if (!tn_array_reserve(&s->heads, &s->head_capacity, 0, s->node_count + 1, sizeof *s->heads) ||
        !tn_array_reserve(&s->next, &s->next_capacity, 0, s->root_count + 1, sizeof *s->next))
        return false;
    memset(s->heads, 0xFF, s->node_count * sizeof *s->heads);
    for (uint32_t i = 0; i < s->root_count; i++) {
        s->next[i] = s->heads[s->roots[i]];
        s->heads[s->roots[i]] = i;
    }
    return true;
}

static void run_row(const tn_shared *s, const double *const *columns, size_t count, size_t from, double *values)
{
    size_t points = count - from < TN_ROW ? count - from : TN_ROW;
    for (uint32_t i = 0; i < s->node_count; i++) {
        if (s->nodes[i].opcode != TN_OP_TERM)
            run_node(s, &s->nodes[i], columns, from);
        for (uint32_t root = s->heads[i]; root != NONE; root = s->next[root])
            memcpy(values + (size_t)root * count + from, values_of(s, i, columns, from), points * sizeof *values);
    }
}

tn_status tn_shared_run(tn_shared *s, const double *const *columns, size_t count, double *values, tn_error *error)
{
    if (!give_rows(s) || !order_roots(s))
        return tn_fail_memory(error);
    for (size_t from = 0; from < count; from += TN_ROW)
        run_row(s, columns, count, from, values);
    return TN_OK;
}
