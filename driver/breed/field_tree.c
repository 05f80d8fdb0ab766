/* Makes trees of the expressions of .field files. */
#include "driver/breed/field_tree.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/bytes.h"

/* ---- constants */

void tn_constant_table_clear(tn_constant_table *table)
{
    for (uint32_t i = 0; i < table->count; i++)
        free((char *)(uintptr_t)table->items[i].name);
    free(table->items);
    *table = (tn_constant_table){0};
}

static uint32_t constant_named(const tn_constant_table *table, const char *name)
{
    uint32_t i = 0;
    while (i < table->count && strcmp(table->items[i].name, name) != 0)
        i++;
    return i;
}

uint32_t tn_constant_find(tn_constant_table *table, const char *name, double value)
{
    char other[TN_NAME_MAX + 8];
    snprintf(other, sizeof other, "%.*s", TN_NAME_MAX, name);
    for (unsigned number = 2;; number++) {
        uint32_t i = constant_named(table, other);
        if (i == table->count)
            break;
        if (tn_bits_of(table->items[i].value) == tn_bits_of(value))
            return i;
        snprintf(other, sizeof other, "%.*s_%u", TN_NAME_MAX - 4, name, number);
    }
    char *copy = strdup(other);
    if (!copy || !tn_array_reserve(&table->items, &table->capacity, table->count, 1, sizeof *table->items)) {
        free(copy);
        return UINT32_MAX;
    }
    table->items[table->count] = (tn_gene_constant){copy, value};
    return table->count++;
}

/* ---- expressions */

/* An expression, and where its own names are looked up. */
typedef struct place {
    const struct bound *arguments;      /* of the function that it stands in */
    const struct bound *coordinates[3]; /* NULL: the coordinate itself */
} place;

typedef struct bound {
    const tn_expression *expression;
    const place *at;
} bound;

typedef struct making {
    const tn_checked_fields *checked;
    tn_arena *arena;
    uint32_t most, nodes, depth;
    tn_constant_table *constants;
    tn_genome *genome;
    tn_status status;
    tn_error *error;
} making;

static void make(making *m, const tn_expression *e, const place *at);

static void fail(making *m, const char *what, const char *help)
{
    if (m->status != TN_OK)
        return;
    m->status = tn_fail(m->error, TN_INVALID, E_FIELD_PARENT, "%s", what);
    tn_error_help(m->error, "%s", help);
}

static void add(making *m, uint64_t token)
{
    if (m->status != TN_OK)
        return;
    if (!tn_genome_reserve(m->genome, m->genome->count + 1)) {
        m->status = tn_fail_memory(m->error);
        return;
    }
    m->genome->codons[m->genome->count++] = token;
}

static void node(making *m, tn_gene_symbol symbol)
{
    if (++m->nodes > m->most)
        fail(m, "it is larger than what is bred", "raise `max-nodes`, or breed from a simpler surface");
    add(m, symbol);
}

static void number(making *m, double value)
{
    if (value < 0 || (value == 0 && tn_bits_of(value)))
        node(m, TN_GENE_NEGATE);
    node(m, TN_GENE_NUMBER);
    add(m, tn_bits_of(__builtin_fabs(value)));
}

static tn_gene_symbol symbol_of(tn_opcode op)
{
    static const struct {
        tn_opcode op;
        tn_gene_symbol symbol;
    } pairs[] = {
        {TN_OP_NEGATE, TN_GENE_NEGATE},
        {TN_OP_ADD, TN_GENE_ADD},
        {TN_OP_SUBTRACT, TN_GENE_SUBTRACT},
        {TN_OP_MULTIPLY, TN_GENE_MULTIPLY},
        {TN_OP_DIVIDE, TN_GENE_DIVIDE},
        {TN_OP_MODULO, TN_GENE_MODULO},
        {TN_OP_POWER, TN_GENE_POWER},
        {TN_OP_ROOT, TN_GENE_ROOT},
        {TN_OP_SQUARE, TN_GENE_SQUARE},
        {TN_OP_ABSOLUTE, TN_GENE_ABSOLUTE},
        {TN_OP_LEAST, TN_GENE_LEAST},
        {TN_OP_MOST, TN_GENE_MOST},
        {TN_OP_CLAMP, TN_GENE_CLAMP},
        {TN_OP_MIX, TN_GENE_MIX},
        {TN_OP_BLEND, TN_GENE_BLEND},
        {TN_OP_SINE, TN_GENE_SINE},
        {TN_OP_COSINE, TN_GENE_COSINE},
        {TN_OP_TANGENT, TN_GENE_TANGENT},
        {TN_OP_ARC_TANGENT, TN_GENE_ARC_TANGENT},
        {TN_OP_EXPONENTIAL, TN_GENE_EXPONENTIAL},
        {TN_OP_LOGARITHM, TN_GENE_LOGARITHM},
        {TN_OP_HYPERBOLIC_TANGENT, TN_GENE_HYPERBOLIC_TANGENT},
        {TN_OP_FLOOR, TN_GENE_FLOOR},
        {TN_OP_NOISE, TN_GENE_NOISE},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        if (pairs[i].op == op)
            return pairs[i].symbol;
    return TN_GENE_SYMBOL_COUNT;
}

/* `let` names numbers that can be computed at once. One that is called as a function stays a number. */
static void make_constant(making *m, const tn_field_definition *definition)
{
    tn_field_nodes nodes = {.arena = m->arena, .checked = m->checked};
    uint32_t at = tn_field_expand(&nodes, definition->body);
    double value = nodes.count > at ? nodes.items[at].number : 0;
    const char *name = definition->name.text;
    if (tn_function_named(TN_WORDS_FIELD, name, strlen(name)) || strcmp(name, "distance") == 0) {
        number(m, value);
        return;
    }
    uint32_t index = tn_constant_find(m->constants, name, value);
    node(m, TN_GENE_CONSTANT);
    add(m, index);
    if (index == UINT32_MAX && m->status == TN_OK)
        m->status = tn_fail_memory(m->error);
}

static const bound *bind(making *m, const tn_expression *first, uint32_t count, const place *at)
{
    bound *bounds = TN_NEW_ARRAY(m->arena, bound, count + 1u);
    uint32_t i = 0;
    for (const tn_expression *e = first; bounds && e && i < count; e = e->next)
        bounds[i++] = (bound){e, at};
    if (!bounds && m->status == TN_OK)
        m->status = tn_fail_memory(m->error);
    return bounds;
}

static void make_definition(making *m, const tn_expression *e, const place *at)
{
    const tn_field_definition *of = m->checked->definitions[e->term];
    if (of->kind == TN_FIELD_LET) {
        make_constant(m, of);
        return;
    }
    place *inside = TN_NEW(m->arena, place);
    const bound *arguments = bind(m, e->first, of->parameters.count, at);
    if (!inside || !arguments)
        return;
    *inside = *at;
    inside->arguments = arguments;
    make(m, of->body, inside);
}

/* The coordinates are the first three operands, the surface is the last. */
static void make_at(making *m, const tn_expression *e, const place *at)
{
    place *there = TN_NEW(m->arena, place);
    const bound *coordinates = bind(m, e->first, 3, at);
    if (!there || !coordinates)
        return;
    *there = *at;
    for (int axis = 0; axis < 3; axis++)
        there->coordinates[axis] = &coordinates[axis];
    make(m, e->last, there);
}

static void make_operation(making *m, const tn_expression *e, const place *at)
{
    tn_gene_symbol symbol = symbol_of(e->op);
    if (symbol == TN_GENE_SYMBOL_COUNT) {
        fail(m, "it measures a distance from a mesh, and meshes are not bred",
             "name a surface without `distance(...)`");
        return;
    }
    node(m, symbol);
    bool call = tn_gene_is_call(symbol);
    for (uint32_t i = 1; call && i < e->operand_count; i++)
        node(m, TN_GENE_COMMA);
    for (const tn_expression *operand = e->first; operand; operand = operand->next)
        make(m, operand, at);
}

static void make(making *m, const tn_expression *e, const place *at)
{
    if (m->status != TN_OK)
        return;
    if (++m->depth > TN_FIELD_EXPAND_MAX)
        fail(m, "it nests too deep to be bred", "breed from a simpler surface");
    const bound *named = e->op == TN_OP_TERM         ? &at->arguments[e->term]
                         : e->op == TN_OP_COORDINATE ? at->coordinates[e->term]
                                                     : NULL;
    if (named)
        make(m, named->expression, named->at);
    else if (e->op == TN_OP_COORDINATE)
        node(m, (tn_gene_symbol)(TN_GENE_X + e->term));
    else if (e->op == TN_OP_NUMBER)
        number(m, e->number);
    else if (e->op == TN_OPCODE_COUNT && tn_field_is_at(e))
        make_at(m, e, at);
    else if (e->op == TN_OPCODE_COUNT)
        make_definition(m, e, at);
    else
        make_operation(m, e, at);
    m->depth--;
}

tn_status tn_field_tree(const tn_checked_fields *checked, tn_arena *arena, const tn_expression *body, uint32_t most,
                        tn_constant_table *constants, tn_genome *genome, tn_error *error)
{
    making m = {
        .checked = checked, .arena = arena, .most = most, .constants = constants, .genome = genome, .error = error};
    place outermost = {0};
    genome->count = 0;
    make(&m, body, &outermost);
    if (m.status == TN_OK && tn_arena_failed(arena))
        return tn_fail_memory(error);
    tn_gene_tree tree = {0};
    if (m.status == TN_OK)
        m.status = tn_gene_tree_read(genome, constants->count, &tree, error);
    if (m.status == TN_OK && tree.height > TN_GENE_HEIGHT_MAX)
        fail(&m, "it nests too deep to be bred", "breed from a simpler surface");
    tn_gene_tree_clear(&tree);
    return m.status;
}
