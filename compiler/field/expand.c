/* Puts functions, surfaces and constants in their places: a field becomes one expression of coordinates, in which equal
 * parts are there once and numbers are computed. None of this changes a bit of a value. */
#include <math.h>
#include <string.h>

#include "compiler/field/field.h"
#include "runtime/base/bytes.h"
#include "runtime/module/code.h"

#define WHOLE_POWER_MAX 64 /* above, an exponent is like any other */

/* What names stand for where an expression is. */
typedef struct place {
    const uint32_t *arguments;
    uint32_t coordinates[3];
    uint32_t depth;
} place;

static uint32_t expand(tn_field_nodes *nodes, const tn_expression *e, const place *at);

/* ---- sharing */

static bool is_commutative(tn_opcode op)
{
    return op == TN_OP_ADD || op == TN_OP_MULTIPLY;
}

static uint64_t hash(const tn_field_node *node)
{
    uint64_t h = tn_bits_of(node->number) ^ (uint64_t)node->op * 0x9E3779B97F4A7C15u;
    const uint32_t parts[] = {node->in[0], node->in[1], node->in[2], node->index};
    for (size_t i = 0; i < 4; i++)
        h = (h ^ (h >> 29) ^ parts[i]) * 0xBF58476D1CE4E5B9u;
    return h ^ (h >> 32);
}

static bool same(const tn_field_node *a, const tn_field_node *b)
{
    return a->op == b->op && a->index == b->index && memcmp(a->in, b->in, sizeof a->in) == 0 &&
           tn_bits_of(a->number) == tn_bits_of(b->number);
}

typedef struct wanted_node {
    const tn_field_nodes *nodes;
    const tn_field_node *node;
} wanted_node;

static bool is_wanted(const void *context, uint32_t number)
{
    const wanted_node *w = context;
    return same(&w->nodes->items[number], w->node);
}

static bool grow(tn_field_nodes *nodes)
{
    uint32_t capacity = nodes->capacity ? nodes->capacity * 2 : 256;
    tn_field_node *items = TN_NEW_ARRAY(nodes->arena, tn_field_node, capacity);
    if (!items)
        return false;
    if (nodes->count)
        memcpy(items, nodes->items, nodes->count * sizeof *items);
    nodes->items = items;
    nodes->capacity = capacity;
    return true;
}

/* The node that is the same, or a new one. */
static uint32_t find(tn_field_nodes *nodes, const tn_field_node *node)
{
    if (nodes->count == nodes->capacity && !grow(nodes))
        return 0;
    uint32_t number = nodes->count;
    wanted_node wanted = {nodes, node};
    nodes->index.make = tn_arena_make;
    nodes->index.from = nodes->arena;
    if (nodes->count == TN_FIELD_NODES_MAX) {
        number = tn_hash_find(&nodes->index, hash(node), is_wanted, &wanted);
        if (number == TN_HASH_NONE)
            nodes->fits = TN_FIELD_TOO_LARGE;
        return number == TN_HASH_NONE ? 0 : number;
    }
    if (tn_hash_enter(&nodes->index, hash(node), is_wanted, &wanted, &number, NULL) != TN_OK)
        return 0;
    if (number == nodes->count)
        nodes->items[nodes->count++] = *node;
    return number;
}

static uint32_t number(tn_field_nodes *nodes, double value)
{
    return find(nodes, &(tn_field_node){.op = TN_OP_NUMBER, .number = value});
}

/* An operation; computed, where its operands are numbers and its value is finite. */
static uint32_t operation(tn_field_nodes *nodes, tn_opcode op, const uint32_t *in)
{
    uint32_t arity = tn_code_effect((uint8_t)op).pops;
    tn_field_node node = {.op = op};
    double operands[TN_ARITY_MAX];
    bool known = true;
    for (uint32_t i = 0; i < arity && nodes->count > in[i]; i++) {
        node.in[i] = in[i];
        operands[i] = nodes->items[in[i]].number;
        known = known && nodes->items[in[i]].op == TN_OP_NUMBER;
    }
    double value = known && nodes->count ? tn_operation_apply(op, operands) : INFINITY;
    if (isfinite(value))
        return number(nodes, value);
    if (is_commutative(op) && node.in[0] > node.in[1]) {
        uint32_t first = node.in[1];
        node.in[1] = node.in[0];
        node.in[0] = first;
    }
    return find(nodes, &node);
}

static uint32_t of_two(tn_field_nodes *nodes, tn_opcode op, uint32_t a, uint32_t b)
{
    return operation(nodes, op, (uint32_t[]){a, b});
}

/* ---- powers */

/* Is this exponent written as a whole number that multiplications are made of? */
static bool is_whole_power(const tn_expression *e, int *power)
{
    bool negative = e->op == TN_OP_NEGATE && e->first->op == TN_OP_NUMBER;
    double value = negative ? e->first->number : e->number;
    if ((!negative && e->op != TN_OP_NUMBER) || value != floor(value) || value > WHOLE_POWER_MAX)
        return false;
    *power = negative ? -(int)value : (int)value;
    return true;
}

/* By the exponent's binary digits, the highest first. */
static uint32_t whole_power(tn_field_nodes *nodes, uint32_t base, int power)
{
    unsigned size = (unsigned)(power < 0 ? -power : power), digit = WHOLE_POWER_MAX;
    if (size == 0)
        return number(nodes, 1);
    while (!(size & digit))
        digit >>= 1;
    uint32_t result = base;
    for (digit >>= 1; digit; digit >>= 1) {
        result = of_two(nodes, TN_OP_MULTIPLY, result, result);
        if (size & digit)
            result = of_two(nodes, TN_OP_MULTIPLY, result, base);
    }
    return power < 0 ? of_two(nodes, TN_OP_DIVIDE, number(nodes, 1), result) : result;
}

/* ---- expressions */

static uint32_t expand_definition(tn_field_nodes *nodes, const tn_expression *e, const place *at)
{
    const tn_field_definition *of = nodes->checked->definitions[e->term];
    uint32_t *arguments = of->parameters.count ? TN_NEW_ARRAY(nodes->arena, uint32_t, of->parameters.count) : NULL;
    if (of->parameters.count && !arguments)
        return 0;
    uint32_t i = 0;
    for (const tn_expression *argument = e->first; argument; argument = argument->next)
        arguments[i++] = expand(nodes, argument, at);
    place inside = {arguments, {at->coordinates[0], at->coordinates[1], at->coordinates[2]}, at->depth};
    return expand(nodes, of->body, &inside);
}

/* The coordinates are the first three operands, the surface is the last. */
static uint32_t expand_at(tn_field_nodes *nodes, const tn_expression *e, const place *at)
{
    place there = {.arguments = at->arguments, .depth = at->depth};
    const tn_expression *coordinate = e->first;
    for (int axis = 0; axis < 3; axis++, coordinate = coordinate->next)
        there.coordinates[axis] = expand(nodes, coordinate, at);
    return expand(nodes, e->last, &there);
}

static uint32_t expand_distance(tn_field_nodes *nodes, const tn_expression *e, const place *at)
{
    tn_field_node node = {.op = TN_OP_MESH_DISTANCE};
    memcpy(node.in, at->coordinates, sizeof node.in);
    while (node.index < nodes->mesh_count && strcmp(nodes->mesh_paths[node.index], e->name) != 0)
        node.index++;
    return find(nodes, &node);
}

static uint32_t expand_operation(tn_field_nodes *nodes, const tn_expression *e, const place *at)
{
    int power;
    if (e->op == TN_OP_POWER && is_whole_power(e->last, &power))
        return whole_power(nodes, expand(nodes, e->first, at), power);
    uint32_t in[TN_ARITY_MAX] = {0}, arity = tn_code_effect((uint8_t)e->op).pops, i = 0;
    const tn_expression *operand = e->first;
    for (; operand && i < arity; operand = operand->next)
        in[i++] = expand(nodes, operand, at);
    uint32_t result = operation(nodes, e->op, in);
    for (; operand; operand = operand->next) /* of `min` and `max` */
        result = of_two(nodes, e->op, result, expand(nodes, operand, at));
    return result;
}

static uint32_t expand(tn_field_nodes *nodes, const tn_expression *e, const place *outer)
{
    place inner = *outer, *at = &inner;
    if (++nodes->steps > TN_FIELD_STEPS_MAX)
        nodes->fits = TN_FIELD_TOO_LARGE;
    else if (++inner.depth > TN_FIELD_EXPAND_MAX)
        nodes->fits = TN_FIELD_TOO_DEEP;
    if (nodes->fits != TN_FIELD_FITS || tn_arena_failed(nodes->arena))
        return 0;
    switch (e->op) {
    case TN_OP_NUMBER:
        return number(nodes, e->number);
    case TN_OP_TERM:
        return at->arguments[e->term];
    case TN_OP_COORDINATE:
        return at->coordinates[e->term];
    case TN_OP_MESH_DISTANCE:
        return expand_distance(nodes, e, at);
    case TN_OPCODE_COUNT:
        return tn_field_is_at(e) ? expand_at(nodes, e, at) : expand_definition(nodes, e, at);
    default:
        return expand_operation(nodes, e, at);
    }
}

uint32_t tn_field_expand(tn_field_nodes *nodes, const tn_expression *expression)
{
    place at = {0};
    for (uint32_t axis = 0; axis < 3; axis++)
        at.coordinates[axis] = find(nodes, &(tn_field_node){.op = TN_OP_COORDINATE, .index = axis});
    return expand(nodes, expression, &at);
}
