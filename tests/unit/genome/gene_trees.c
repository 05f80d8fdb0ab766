/* Trees of fields as genomes: they read back as they were, the share of a tree that is exchanged is what the choice of
 * nodes was settled by, classes hold, and no comma is ever chosen. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "runtime/base/bytes.h"
#include "runtime/genome/tree/tree_kind.h"
#include "tests/support/test_grammar.h"

/* Arguments of each call. */
static uint32_t arguments_of(tn_gene_symbol symbol)
{
    switch (symbol) {
    case TN_GENE_POWER:
    case TN_GENE_LEAST:
    case TN_GENE_MOST:
    case TN_GENE_ARC_TANGENT:
        return 2;
    case TN_GENE_CLAMP:
    case TN_GENE_MIX:
    case TN_GENE_BLEND:
    case TN_GENE_NOISE:
        return 3;
    default:
        return 1;
    }
}

static void add(tn_genome *genome, uint64_t token)
{
    assert_true(tn_genome_reserve(genome, genome->count + 1));
    genome->codons[genome->count++] = token;
}

static void grow(tn_genome *genome, tn_chance *chance, int depth)
{
    uint64_t kind = depth == 0 ? 0 : tn_chance_below(chance, 4);
    if (kind == 0) {
        uint64_t symbol = tn_chance_below(chance, 5);
        add(genome, symbol);
        if (symbol == TN_GENE_NUMBER)
            add(genome, tn_bits_of(0.125 * (double)tn_chance_below(chance, 1000)));
        else if (symbol == TN_GENE_CONSTANT)
            add(genome, tn_chance_below(chance, 2));
    } else if (kind == 1) {
        tn_gene_symbol symbol =
            (tn_gene_symbol)(TN_GENE_POWER + tn_chance_below(chance, TN_GENE_SYMBOL_COUNT - TN_GENE_POWER));
        add(genome, symbol);
        for (uint32_t i = 1; i < arguments_of(symbol); i++)
            add(genome, TN_GENE_COMMA);
        for (uint32_t i = 0; i < arguments_of(symbol); i++)
            grow(genome, chance, depth - 1);
    } else {
        tn_gene_symbol symbol = (tn_gene_symbol)(TN_GENE_NEGATE + tn_chance_below(chance, 6));
        add(genome, symbol);
        for (uint32_t i = 0; i < tn_gene_symbols[symbol].operands; i++)
            grow(genome, chance, depth - 1);
    }
}

static tn_gene_tree random_tree(uint64_t number, int depth)
{
    tn_genome genome = {0};
    tn_gene_tree tree = {0};
    tn_chance chance = tn_chance_for(7, TN_PURPOSE_INITIALISE, 0, number);
    grow(&genome, &chance, depth);
    assert_int_equal(tn_gene_tree_read(&genome, 2, &tree, NULL), TN_OK);
    tn_genome_clear(&genome);
    return tree;
}

/* A call has as many arguments as ever, and commas stand nowhere else. */
static void check(const tn_gene_tree *tree)
{
    for (uint32_t i = 0; i < tree->count; i++) {
        tn_gene_symbol symbol = tree->nodes[i].symbol;
        bool chain =
            i > 0 && (tn_gene_is_call(tree->nodes[i - 1].symbol) || tree->nodes[i - 1].symbol == TN_GENE_COMMA);
        assert_true(symbol != TN_GENE_COMMA || chain);
        if (!tn_gene_is_call(symbol))
            continue;
        uint32_t commas = 0;
        while (tree->nodes[i + 1 + commas].symbol == TN_GENE_COMMA)
            commas++;
        assert_int_equal(commas + 1, arguments_of(symbol));
    }
}

static bool same_node(const tn_gene_node *a, const tn_gene_node *b)
{
    return a->symbol == b->symbol && a->size == b->size && a->depth == b->depth && a->value == b->value;
}

static void test_genomes(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 2000; i++) {
        tn_gene_tree tree = random_tree(i, 7), again = {0};
        tn_genome genome = {0};
        assert_int_equal(tn_gene_tree_write(&tree, &genome, NULL), TN_OK);
        assert_int_equal(tn_gene_tree_read(&genome, 2, &again, NULL), TN_OK);
        assert_int_equal(again.count, tree.count);
        for (uint32_t k = 0; k < tree.count; k++)
            assert_true(same_node(&again.nodes[k], &tree.nodes[k]));
        genome.count--; /* something is missing now */
        assert_int_equal(tn_gene_tree_read(&genome, 2, &again, NULL), TN_INVALID);
        tn_genome_clear(&genome);
        tn_gene_tree_clear(&tree);
        tn_gene_tree_clear(&again);
    }
}

static void test_varying(void **state)
{
    (void)state;
    tn_tree_variation how = {.maxprob = 0.5, .mutation_rate = 1, .shares = {6, 3, 1, 1}, .max_nodes = 300};
    size_t crossed_count = 0, mutated_count = 0;
    for (uint64_t i = 0; i < 4000; i++) {
        tn_gene_tree parents[2] = {random_tree(2 * i, 6), random_tree(2 * i + 1, 6)}, children[2] = {0}, spare = {0};
        tn_chance chance = tn_chance_for(9, TN_PURPOSE_BIRTH, 0, i);
        const double weights[2] = {1, 0.4};
        bool crossed[2];
        assert_int_equal(tn_tree_cross(&how, &chance, parents, weights, children, crossed, NULL), TN_OK);
        if (crossed[0] && crossed[1])
            assert_int_equal(children[0].count + children[1].count, parents[0].count + parents[1].count);
        for (int k = 0; k < 2; k++) {
            bool mutated;
            crossed_count += crossed[k];
            assert_true(children[k].count <= how.max_nodes || !crossed[k]);
            check(&children[k]);
            assert_int_equal(tn_tree_mutate(&how, &chance, &children[k], &spare, &mutated, NULL), TN_OK);
            mutated_count += mutated;
            check(&children[k]);
            tn_gene_tree_clear(&children[k]);
            tn_gene_tree_clear(&parents[k]);
        }
        tn_gene_tree_clear(&spare);
    }
    assert_true(crossed_count > 7000);
    assert_true(mutated_count > 4000);
}

/* Prefix of a tree in letters: x, y, z, numbers n, calls of pow with their comma p, operators. */
static tn_gene_tree tree_of(const char *prefix)
{
    static const char letters[] = "n?xyz,_+-*/%";
    tn_genome genome = {0};
    tn_gene_tree tree = {0};
    for (const char *at = prefix; *at; at++) {
        const char *found = strchr(letters, *at);
        add(&genome, *at == 'p' ? TN_GENE_POWER : (uint64_t)(found - letters));
        if (*at == 'n')
            add(&genome, tn_bits_of(2));
        if (*at == 'p')
            add(&genome, TN_GENE_COMMA);
    }
    assert_int_equal(tn_gene_tree_read(&genome, 0, &tree, NULL), TN_OK);
    tn_genome_clear(&genome);
    return tree;
}

/* The shares by which the order of walking was chosen: the mean part of the heart that is exchanged at each maxprob. */
static void test_shares(void **state)
{
    (void)state;
    static const double maxprobs[] = {0.05, 0.08, 0.2, 0.5, 1}, shares[] = {0.072, 0.078, 0.097, 0.114, 0.155};
    enum { DRAWS = 8000 };
    tn_gene_tree heart = tree_of("--p-++*np/xnnp/ynnp/znnnn**np/xnnp/znn*p/ynnp/znn");
    for (size_t m = 0; m < 5; m++) {
        tn_chance chance = tn_chance_for(3, TN_PURPOSE_BIRTH, 0, m);
        double sum = 0;
        size_t right = 0;
        for (int i = 0; i < DRAWS; i++) {
            uint32_t at = tn_pick_node(&heart, TN_PICK_FAIR, maxprobs[m], TN_PICK_ANY, &chance);
            sum += heart.nodes[at].size;
            right += at >= heart.count / 2;
            assert_true(at > 0 && heart.nodes[at].symbol != TN_GENE_COMMA);
        }
        double share = sum / heart.count / DRAWS;
        assert_true(fabs(share - shares[m]) < 0.1 * shares[m]);
        assert_true(right > DRAWS * 0.34 && right < DRAWS * 0.78);
    }
    tn_gene_tree_clear(&heart);
}

static void test_single_node(void **state)
{
    (void)state;
    tn_gene_tree single = tree_of("x");
    tn_chance chance = tn_chance_for(3, TN_PURPOSE_BIRTH, 0, 0);
    assert_int_equal(tn_pick_node(&single, TN_PICK_FAIR, 0.2, TN_PICK_ANY, &chance), 0);
    assert_int_equal(tn_pick_node(&single, TN_PICK_FAIR, 0.2, TN_CLASS_OPERATOR, &chance), TN_PICK_NONE);
    tn_gene_tree_clear(&single);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_genomes),
        cmocka_unit_test(test_varying),
        cmocka_unit_test(test_shares),
        cmocka_unit_test(test_single_node),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
