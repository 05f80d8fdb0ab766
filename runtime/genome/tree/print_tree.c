/* Writes trees as expressions of the language of fields. */
#include <stdio.h>
#include <string.h>

#include "runtime/base/buffer.h"
#include "runtime/base/bytes.h"
#include "runtime/genome/tree/tree_kind.h"

#define COLUMNS 80u /* a line ends at the next chance */

typedef struct printing {
    FILE *out;
    const tn_gene_tree *tree;
    const tn_gene_constant *constants;
    size_t column;
} printing;

/* How tight a node holds together what it is made of: sums least, then products, signs, all else. */
static int tightness(tn_gene_symbol symbol)
{
    switch (symbol) {
    case TN_GENE_COMMA:
        return 0;
    case TN_GENE_ADD:
    case TN_GENE_SUBTRACT:
        return 1;
    case TN_GENE_MULTIPLY:
    case TN_GENE_DIVIDE:
    case TN_GENE_MODULO:
        return 2;
    case TN_GENE_NEGATE:
        return 3;
    default:
        return 4;
    }
}

static void put(printing *p, const char *text)
{
    fputs(text, p->out);
    p->column += strlen(text);
}

/* An operator; a line that is full ends before one of a sum. */
static void put_operator(printing *p, tn_gene_symbol symbol)
{
    const char *text = tn_gene_symbols[symbol].text;
    bool sum = symbol == TN_GENE_ADD || symbol == TN_GENE_SUBTRACT;
    if (sum && p->column >= COLUMNS) {
        fputs("\n   ", p->out);
        p->column = 3;
    }
    put(p, text);
}

static void put_node(printing *p, uint32_t node);

static void put_operand(printing *p, uint32_t node, bool parentheses)
{
    if (parentheses)
        put(p, "(");
    put_node(p, node);
    if (parentheses)
        put(p, ")");
}

static void put_terminal(printing *p, const tn_gene_node *node)
{
    char text[TN_NUMBER_TEXT_SIZE];
    if (node->symbol == TN_GENE_NUMBER)
        put(p, tn_number_text(tn_double_of(node->value), text));
    else if (node->symbol == TN_GENE_CONSTANT)
        put(p, p->constants[node->value].name);
    else
        put(p, tn_gene_symbols[node->symbol].text);
}

/* Recursion is as deep as the tree: TN_GENE_HEIGHT_MAX. */
static void put_node(printing *p, uint32_t node)
{
    const tn_gene_node *nodes = p->tree->nodes, *it = &nodes[node];
    uint32_t first = node + 1;
    int tight = tightness(it->symbol);
    if (tn_gene_symbols[it->symbol].operands == 0) {
        put_terminal(p, it);
    } else if (tn_gene_is_call(it->symbol)) {
        put(p, tn_gene_symbols[it->symbol].text);
        put_operand(p, first, true);
    } else if (it->symbol == TN_GENE_NEGATE) {
        put(p, "-");
        put_operand(p, first, tightness(nodes[first].symbol) < tight);
    } else {
        uint32_t second = first + nodes[first].size;
        bool comma = it->symbol == TN_GENE_COMMA;
        put_operand(p, first, tightness(nodes[first].symbol) < tight);
        put_operator(p, it->symbol);
        put_operand(p, second, !comma && tightness(nodes[second].symbol) <= tight);
    }
}

void tn_gene_tree_print(FILE *out, const tn_gene_tree *tree, const tn_gene_constant *constants, size_t column)
{
    printing p = {out, tree, constants, column};
    put_node(&p, 0);
}
