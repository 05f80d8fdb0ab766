/* Expressions of fields as genomes: trees, as the paper that first bred them has them (Evolutionary surfaces, 2.1).
 *
 * A tree is binary. A call is a node with one operand, the chain of its arguments, in which a comma joins what stands
 * before it to the next: min(a, b, c) is min over ((a , b) , c). A genome holds the tree as prefix tokens: a symbol's
 * number, and behind a number its bits, behind a named constant its index in the table of constants.
 *
 * A tn_gene_tree lists the nodes in the same order, so that a subtree is a stretch of the list. It owns the list; clear
 * it in any case.
 */
#ifndef TARTAN_GENOME_TREE_GENE_TREE_H
#define TARTAN_GENOME_TREE_GENE_TREE_H

#include "runtime/genome/breeding/chance.h"
#include "runtime/genome/mapping/genome.h"

/* What may be exchanged for what: operators for operators, what holds a value for what holds one, commas for nothing.
 */
typedef enum tn_gene_class { TN_CLASS_OPERATOR, TN_CLASS_VALUE, TN_CLASS_COMMA } tn_gene_class;

/* Symbols in the order of their numbers, which stored runs hold: new ones go to the end. A call of several arguments
 * has a comma below it. name, how it is written, operands, class */
#define TN_GENE_SYMBOLS(X)                                                                                             \
    X(NUMBER, "", 0, VALUE)                                                                                            \
    X(CONSTANT, "", 0, VALUE)                                                                                          \
    X(X, "x", 0, VALUE)                                                                                                \
    X(Y, "y", 0, VALUE)                                                                                                \
    X(Z, "z", 0, VALUE)                                                                                                \
    X(COMMA, ", ", 2, COMMA)                                                                                           \
    X(NEGATE, "-", 1, OPERATOR)                                                                                        \
    X(ADD, " + ", 2, OPERATOR)                                                                                         \
    X(SUBTRACT, " - ", 2, OPERATOR)                                                                                    \
    X(MULTIPLY, "*", 2, OPERATOR)                                                                                      \
    X(DIVIDE, "/", 2, OPERATOR)                                                                                        \
    X(MODULO, "%", 2, OPERATOR)                                                                                        \
    X(POWER, "pow", 1, VALUE)                                                                                          \
    X(ROOT, "sqrt", 1, VALUE)                                                                                          \
    X(SQUARE, "square", 1, VALUE)                                                                                      \
    X(ABSOLUTE, "abs", 1, VALUE)                                                                                       \
    X(LEAST, "min", 1, VALUE)                                                                                          \
    X(MOST, "max", 1, VALUE)                                                                                           \
    X(CLAMP, "clamp", 1, VALUE)                                                                                        \
    X(MIX, "mix", 1, VALUE)                                                                                            \
    X(BLEND, "blend", 1, VALUE)                                                                                        \
    X(SINE, "sin", 1, VALUE)                                                                                           \
    X(COSINE, "cos", 1, VALUE)                                                                                         \
    X(TANGENT, "tan", 1, VALUE)                                                                                        \
    X(ARC_TANGENT, "atan2", 1, VALUE)                                                                                  \
    X(EXPONENTIAL, "exp", 1, VALUE)                                                                                    \
    X(LOGARITHM, "log", 1, VALUE)                                                                                      \
    X(HYPERBOLIC_TANGENT, "tanh", 1, VALUE)                                                                            \
    X(FLOOR, "floor", 1, VALUE)                                                                                        \
    X(NOISE, "noise", 1, VALUE)

typedef enum tn_gene_symbol {
#define X(NAME, TEXT, OPERANDS, CLASS) TN_GENE_##NAME,
    TN_GENE_SYMBOLS(X)
#undef X
        TN_GENE_SYMBOL_COUNT
} tn_gene_symbol;

typedef struct tn_gene_symbol_row {
    const char *text;
    uint32_t operands;
    tn_gene_class class_;
} tn_gene_symbol_row;

extern const tn_gene_symbol_row tn_gene_symbols[TN_GENE_SYMBOL_COUNT];

static inline bool tn_gene_is_call(tn_gene_symbol symbol)
{
    return tn_gene_symbols[symbol].operands == 1 && tn_gene_symbols[symbol].class_ == TN_CLASS_VALUE;
}

typedef struct tn_gene_node {
    tn_gene_symbol symbol;
    uint32_t size;  /* nodes of its subtree, itself among them: the stretch of the list that it takes */
    uint32_t depth; /* from the root, which is at 0 */
    uint64_t value; /* of a number its bits, of a constant its index */
} tn_gene_node;

typedef struct tn_gene_tree {
    tn_gene_node *nodes; /* owned */
    uint32_t count;
    uint32_t height; /* the largest depth */
    size_t capacity;
} tn_gene_tree;

#define TN_GENE_NODES_MAX 100000u /* of any tree */
#define TN_GENE_HEIGHT_MAX 200u   /* so that its text can be read: expressions nest at most 256 deep */

void tn_gene_tree_clear(tn_gene_tree *tree);

/* Reads a genome; `constants`: how many the table has. TN_INVALID (E1251) if it is no tree. */
tn_status tn_gene_tree_read(const tn_genome *genome, uint32_t constants, tn_gene_tree *tree, tn_error *error);
tn_status tn_gene_tree_write(const tn_gene_tree *tree, tn_genome *genome, tn_error *error);

tn_status tn_gene_tree_copy(const tn_gene_tree *tree, tn_gene_tree *copy, tn_error *error);

/* Makes `child` of a tree, with the subtree at `at` replaced by that of another tree at `from`. `child` is neither. */
tn_status tn_gene_tree_graft(const tn_gene_tree *tree, uint32_t at, const tn_gene_tree *other, uint32_t from,
                             tn_gene_tree *child, tn_error *error);

/* Picking the node of a tree at which it is crossed or mutated.
 *
 * A node at depth H of a tree of height Hmax is taken with probability H / Hmax * maxprob (Evolutionary surfaces,
 * 2.2.1), so that the larger maxprob is, the more is exchanged. The tree is walked from its root on until a node is
 * taken; a walk that takes none begins again. The root is taken only where there is nothing else, and a comma never. */

typedef enum tn_pick_order {
    TN_PICK_FAIR,     /* a node before what is below it, and a fair draw says which operand comes first */
    TN_PICK_PREORDER, /* the left operand always first */
    TN_PICK_LEVEL,    /* by depth */
    TN_PICK_ROULETTE, /* no walk: in proportion to the depth */
    TN_PICK_COUNT
} tn_pick_order;

#define TN_PICK_NONE UINT32_MAX
#define TN_PICK_ANY TN_CLASS_COMMA /* either class */

/* The node taken among those of a class, or TN_PICK_NONE if none can be. */
uint32_t tn_pick_node(const tn_gene_tree *tree, tn_pick_order order, double maxprob, tn_gene_class wanted,
                      tn_chance *chance);

#endif
