/* Breeds trees of fields for evolution. */
#include "runtime/genome/tree/tree_kind.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/buffer.h"
#include "runtime/base/bytes.h"
#include "runtime/genome/breeding/chance.h"
#include "runtime/module/values.h"

/* ==== writes trees as expressions of the language of fields */

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

/* ==== crosses two trees, and mutates one */

#define CROSSINGS_MAX 20 /* until no child is too large */
#define SWAPS_MAX 64     /* until two subtrees lie apart */

/* ---- crossing */

static tn_gene_class class_of(const tn_gene_tree *tree, uint32_t node)
{
    return tn_gene_symbols[tree->nodes[node].symbol].class_;
}

/* The first parent's node, then the second's of the same class; where that has none, the first's again, of the other
 * class. */
static bool pick_pair(const tn_tree_variation *how, tn_chance *chance, const tn_gene_tree parents[2],
                      const double weights[2], uint32_t at[2])
{
    const double prob[2] = {how->maxprob * weights[0], how->maxprob * weights[1]};
    tn_gene_class wanted = TN_PICK_ANY;
    for (int attempt = 0; attempt < 2; attempt++) {
        at[0] = tn_pick_node(&parents[0], how->order, prob[0], wanted, chance);
        if (at[0] == TN_PICK_NONE)
            return false;
        tn_gene_class class_ = class_of(&parents[0], at[0]);
        at[1] = tn_pick_node(&parents[1], how->order, prob[1], class_, chance);
        if (at[1] != TN_PICK_NONE)
            return true;
        wanted = class_ == TN_CLASS_OPERATOR ? TN_CLASS_VALUE : TN_CLASS_OPERATOR;
    }
    return false;
}

static bool fits(const tn_tree_variation *how, const tn_gene_tree *tree)
{
    return tree->count <= how->max_nodes && tree->height <= TN_GENE_HEIGHT_MAX;
}

tn_status tn_tree_cross(const tn_tree_variation *how, tn_chance *chance, const tn_gene_tree parents[2],
                        const double weights[2], tn_gene_tree children[2], bool crossed[2], tn_error *error)
{
    tn_status status = TN_OK;
    crossed[0] = crossed[1] = false;
    for (int i = 0; i < CROSSINGS_MAX && status == TN_OK && !(crossed[0] && crossed[1]); i++) {
        uint32_t at[2];
        if (!pick_pair(how, chance, parents, weights, at))
            break;
        for (int k = 0; k < 2 && status == TN_OK; k++) {
            status = tn_gene_tree_graft(&parents[k], at[k], &parents[1 - k], at[1 - k], &children[k], error);
            crossed[k] = status == TN_OK && fits(how, &children[k]);
        }
    }
    for (int k = 0; k < 2 && status == TN_OK; k++)
        if (!crossed[k])
            status = tn_gene_tree_copy(&parents[k], &children[k], error);
    return status;
}

/* ---- two nodes */

/* Nodes whose labels may change places: binary operators, and terminals. */
static bool may_swap(const tn_gene_node *node)
{
    return node->symbol != TN_GENE_COMMA && tn_gene_symbols[node->symbol].operands != 1;
}

static bool differ(const tn_gene_node *a, const tn_gene_node *b)
{
    return a->symbol != b->symbol || a->value != b->value;
}

/* Draws evenly among the nodes that may change places with `other` (NULL: with any). */
static uint32_t draw_label(const tn_gene_tree *tree, const tn_gene_node *other, tn_chance *chance)
{
    for (int counting = 1, count = 0, at = 0; counting >= 0; counting--) {
        for (uint32_t i = 0; i < tree->count; i++) {
            const tn_gene_node *node = &tree->nodes[i];
            bool same_class = !other || tn_gene_symbols[node->symbol].class_ == tn_gene_symbols[other->symbol].class_;
            if (!may_swap(node) || !same_class || (other && !differ(node, other)))
                continue;
            if (counting)
                count++;
            else if (at-- == 0)
                return i;
        }
        if (count == 0)
            return TN_PICK_NONE;
        if (counting)
            at = (int)tn_chance_below(chance, (uint64_t)count);
    }
    return TN_PICK_NONE;
}

static bool swap_nodes(tn_gene_tree *tree, tn_chance *chance)
{
    uint32_t a = draw_label(tree, NULL, chance);
    uint32_t b = a == TN_PICK_NONE ? a : draw_label(tree, &tree->nodes[a], chance);
    if (b == TN_PICK_NONE)
        return false;
    tn_gene_node first = tree->nodes[a], second = tree->nodes[b];
    tree->nodes[a].symbol = second.symbol;
    tree->nodes[a].value = second.value;
    tree->nodes[b].symbol = first.symbol;
    tree->nodes[b].value = first.value;
    return true; /* sizes stay: both have as many operands */
}

/* ---- subtrees */

static bool holds(const tn_gene_tree *tree, uint32_t outer, uint32_t inner)
{
    return inner >= outer && inner < outer + tree->nodes[outer].size;
}

static tn_status swap_subtrees(const tn_tree_variation *how, tn_gene_tree *tree, tn_gene_tree *spare, tn_chance *chance,
                               bool *mutated, tn_error *error)
{
    uint32_t a = tn_pick_node(tree, how->order, how->maxprob, TN_PICK_ANY, chance), b = TN_PICK_NONE;
    bool apart = false;
    for (int i = 0; i < SWAPS_MAX && !apart && a != TN_PICK_NONE; i++) {
        b = tn_pick_node(tree, how->order, how->maxprob, class_of(tree, a), chance);
        apart = b != TN_PICK_NONE && !holds(tree, a, b) && !holds(tree, b, a);
    }
    if (!apart)
        return TN_OK;
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    tn_gene_tree part = {0};
    tn_status status = tn_gene_tree_graft(tree, high, tree, low, &part, error);
    if (status == TN_OK)
        status = tn_gene_tree_graft(&part, low, tree, high, spare, error);
    tn_gene_tree_clear(&part);
    if (status != TN_OK || !fits(how, spare))
        return status;
    *mutated = true;
    return tn_gene_tree_copy(spare, tree, error);
}

/* ---- destruction */

/* A terminal: x, y, z, or one of the tree's numbers and constants, each as likely. */
static tn_status draw_terminal(const tn_gene_tree *tree, tn_chance *chance, tn_gene_node *terminal, tn_error *error)
{
    tn_gene_node *known = malloc((tree->count + 3u) * sizeof *known);
    uint32_t count = 0;
    if (!known)
        return tn_fail_memory(error);
    for (int axis = 0; axis < 3; axis++)
        known[count++] = (tn_gene_node){.symbol = (tn_gene_symbol)(TN_GENE_X + axis)};
    for (uint32_t i = 0; i < tree->count; i++) {
        const tn_gene_node *node = &tree->nodes[i];
        bool fresh = node->symbol == TN_GENE_NUMBER || node->symbol == TN_GENE_CONSTANT;
        for (uint32_t k = 3; k < count && fresh; k++)
            fresh = differ(node, &known[k]);
        if (fresh)
            known[count++] = *node;
    }
    *terminal = known[tn_chance_below(chance, count)];
    terminal->size = 1;
    free(known);
    return TN_OK;
}

static tn_status destroy(const tn_tree_variation *how, tn_gene_tree *tree, tn_gene_tree *spare, tn_chance *chance,
                         bool *mutated, tn_error *error)
{
    uint32_t at = tn_pick_node(tree, how->order, how->maxprob, TN_PICK_ANY, chance);
    tn_gene_node terminal;
    tn_gene_tree single = {.nodes = &terminal, .count = 1};
    if (at == TN_PICK_NONE)
        return TN_OK;
    tn_status status = draw_terminal(tree, chance, &terminal, error);
    if (status == TN_OK)
        status = tn_gene_tree_graft(tree, at, &single, 0, spare, error);
    *mutated = status == TN_OK;
    return status == TN_OK ? tn_gene_tree_copy(spare, tree, error) : status;
}

/* ---- numbers */

/* Numbers are written without a sign, so that what is written reads back as the same tree. */
static bool nudge(tn_gene_tree *tree, tn_chance *chance)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < tree->count; i++)
        count += tree->nodes[i].symbol == TN_GENE_NUMBER;
    uint64_t at = tn_chance_below(chance, count);
    for (uint32_t i = 0; i < tree->count; i++) {
        tn_gene_node *node = &tree->nodes[i];
        if (node->symbol != TN_GENE_NUMBER || at-- > 0)
            continue;
        double value = fabs(tn_double_of(node->value) * (1 + 0.2 * tn_chance_normal(chance)));
        if (!isfinite(value))
            return false;
        node->value = tn_bits_of(value);
        return true;
    }
    return false;
}

/* ---- mutation */

/* The kind of mutation, by its share; TN_TREE_MUTATION_COUNT if all shares are 0. */
static tn_tree_mutation draw_kind(const tn_tree_variation *how, tn_chance *chance)
{
    double total = 0;
    for (int i = 0; i < TN_TREE_MUTATION_COUNT; i++)
        total += how->shares[i];
    double at = tn_chance_unit(chance) * total;
    int kind = 0;
    while (kind < TN_TREE_MUTATION_COUNT && at >= how->shares[kind])
        at -= how->shares[kind++];
    return (tn_tree_mutation)kind;
}

tn_status tn_tree_mutate(const tn_tree_variation *how, tn_chance *chance, tn_gene_tree *tree, tn_gene_tree *spare,
                         bool *mutated, tn_error *error)
{
    *mutated = false;
    if (!tn_chance_is(chance, how->mutation_rate))
        return TN_OK;
    switch (draw_kind(how, chance)) {
    case TN_TREE_SWAP_NODES:
        *mutated = swap_nodes(tree, chance);
        return TN_OK;
    case TN_TREE_SWAP_SUBTREES:
        return swap_subtrees(how, tree, spare, chance, mutated, error);
    case TN_TREE_DESTROY:
        return destroy(how, tree, spare, chance, mutated, error);
    case TN_TREE_NUDGE:
        *mutated = nudge(tree, chance);
        return TN_OK;
    default:
        return TN_OK;
    }
}

#define NAME "bred"

typedef struct workplace {
    const tn_tree_breeding *of;
    tn_gene_tree parents[2], children[2], spare;
    char *text;
    size_t size;
} workplace;

static void *workplace_new(const void *context)
{
    workplace *w = calloc(1, sizeof *w);
    if (w)
        w->of = context;
    return w;
}

static void workplace_free(void *place)
{
    workplace *w = place;
    if (!w)
        return;
    for (int i = 0; i < 2; i++) {
        tn_gene_tree_clear(&w->parents[i]);
        tn_gene_tree_clear(&w->children[i]);
    }
    tn_gene_tree_clear(&w->spare);
    free(w->text);
    free(w);
}

/* ---- breeding */

static tn_status breed(void *place, tn_chance *chance, const tn_parent parents[2], tn_genome *children[2],
                       uint8_t kinds[2], tn_error *error)
{
    workplace *w = place;
    const tn_tree_variation *how = &w->of->how;
    const double weights[2] = {parents[0].weight, parents[1].weight};
    bool crossed[2] = {false, false};
    tn_status status = TN_OK;
    for (int i = 0; i < 2 && status == TN_OK; i++)
        status = tn_gene_tree_read(parents[i].genome, w->of->constant_count, &w->parents[i], error);
    if (status == TN_OK)
        status = tn_tree_cross(how, chance, w->parents, weights, w->children, crossed, error);
    for (int i = 0; i < 2 && status == TN_OK; i++) {
        bool mutated;
        status = tn_tree_mutate(how, chance, &w->children[i], &w->spare, &mutated, error);
        if (status == TN_OK)
            status = tn_gene_tree_write(&w->children[i], children[i], error);
        kinds[i] = (uint8_t)((crossed[i] ? TN_BIRTH_CROSSED : TN_BIRTH_CLONE) | (mutated ? TN_BIRTH_MUTATED : 0));
    }
    return status;
}

/* Two places among the parents, different ones where there are several. */
static void draw_parents(const tn_tree_breeding *of, tn_chance *chance, size_t drawn[2])
{
    size_t count = of->parent_count;
    drawn[0] = (size_t)tn_chance_below(chance, count);
    drawn[1] = count > 1 ? (drawn[0] + 1 + (size_t)tn_chance_below(chance, count - 1)) % count : drawn[0];
}

/* Those that are no parents are children of them, two and two of one crossing, which depends on their pair alone. */
static tn_status first(void *place, uint64_t number, tn_chance *chance, tn_genome *genome, tn_birth *birth,
                       tn_error *error)
{
    workplace *w = place;
    const tn_tree_breeding *of = w->of;
    uint64_t child = number - of->parent_count;
    size_t drawn[2];
    uint8_t kinds[2];
    *chance = tn_chance_for(chance->seed, TN_PURPOSE_INITIALISE, 1, child / 2);
    draw_parents(of, chance, drawn);
    tn_parent parents[2];
    for (int i = 0; i < 2; i++)
        parents[i] = (tn_parent){&of->parents[drawn[i]], 0, of->weights[drawn[i]]};
    tn_genome other = {0};
    tn_genome *children[2] = {child % 2 ? &other : genome, child % 2 ? genome : &other};
    tn_status status = breed(w, chance, parents, children, kinds, error);
    birth->kind = kinds[child % 2];
    birth->parents[0] = drawn[child % 2];
    birth->parents[1] = drawn[1 - child % 2];
    tn_genome_clear(&other);
    return status;
}

/* ---- sentences */

static bool uses(const tn_gene_tree *tree, uint32_t constant)
{
    for (uint32_t i = 0; i < tree->count; i++)
        if (tree->nodes[i].symbol == TN_GENE_CONSTANT && tree->nodes[i].value == constant)
            return true;
    return false;
}

static bool is_constant(const tn_tree_breeding *of, const char *name)
{
    for (uint32_t i = 0; i < of->constant_count; i++)
        if (strcmp(of->constants[i].name, name) == 0)
            return true;
    return false;
}

/* A constant may have the name that bred surfaces have; then they get another. */
static void name_surface(const tn_tree_breeding *of, char name[24])
{
    strcpy(name, NAME);
    for (unsigned i = 2; is_constant(of, name); i++)
        snprintf(name, 24, NAME "_%u", i);
}

/* The language takes no numbers past TN_COORDINATE_MAX, but quotients of its numbers pass it: a power of two divides
 * without rounding. */
static void print_constant(const tn_gene_constant *constant, FILE *out)
{
    char number[TN_NUMBER_TEXT_SIZE];
    int exponent = 0;
    double value = constant->value;
    bool large = fabs(value) > TN_COORDINATE_MAX;
    if (large)
        value = frexp(value, &exponent);
    fprintf(out, "let %s = %s", constant->name, tn_number_text(value, number));
    if (large)
        fprintf(out, " / %s", tn_number_text(ldexp(1, -exponent), number));
    fputc('\n', out);
}

static void print(const workplace *w, const tn_gene_tree *tree, FILE *out)
{
    const tn_tree_breeding *of = w->of;
    for (uint32_t i = 0; i < of->constant_count; i++)
        if (uses(tree, i))
            print_constant(&of->constants[i], out);
    char name[24];
    name_surface(of, name);
    int column = fprintf(out, "surface %s = ", name);
    tn_gene_tree_print(out, tree, of->constants, column > 0 ? (size_t)column : 0);
    fprintf(out, "\n%s", of->footer);
}

static tn_status write(void *place, const tn_genome *genome, tn_written *written, tn_error *error)
{
    workplace *w = place;
    tn_gene_tree *tree = &w->parents[0];
    tn_status status = tn_gene_tree_read(genome, w->of->constant_count, tree, error);
    if (status != TN_OK)
        return status;
    free(w->text);
    w->text = NULL;
    FILE *out = open_memstream(&w->text, &w->size);
    if (!out)
        return tn_fail_memory(error);
    print(w, tree, out);
    bool printed = !ferror(out);
    if (fclose(out) != 0 || !printed)
        return tn_fail_memory(error);
    *written = (tn_written){
        .sentence = w->text, .size = w->size, .used = tree->count, .depth = tree->height, .reason = TN_MAPPING_VALID};
    return TN_OK;
}

tn_genome_kind tn_tree_kind(tn_tree_breeding *breeding)
{
    return (tn_genome_kind){.context = breeding,
                            .workplace_new = workplace_new,
                            .workplace_free = workplace_free,
                            .first = first,
                            .breed = breed,
                            .write = write,
                            .weighs = true,
                            .parents_stay = true};
}
