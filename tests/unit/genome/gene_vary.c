/* First genomes and genetic operators: trees map to themselves within their depth, subtree operators keep sentences
 * valid, and everything depends on its draws alone. */
#include "runtime/genome/breeding/vary.h"
#include "tests/support/test_grammar.h"

#define STDLIB TARTAN_SOURCE_DIR "/stdlib/"

typedef struct fixture {
    tn_grammar *grammar;
    tn_analysis analysis;
    tn_mapping_options mapping;
    tn_mapper *mapper;
} fixture;

static fixture prepare(const char *path)
{
    fixture f = {.grammar = test_grammar_file(path)};
    assert_int_equal(tn_analyse(f.grammar, &f.analysis, NULL), TN_OK);
    f.mapping = tn_mapping_options_of(f.grammar);
    f.mapping.repair = TN_REPAIR_OFF;
    f.mapper = tn_mapper_new(f.grammar);
    return f;
}

/* The same, mapped independently of position; false where the grammar cannot be. */
static bool prepare_places(const char *path, fixture *f)
{
    *f = prepare(path);
    f->mapping.position_independent = tn_grammar_takes_places(f->grammar);
    return f->mapping.position_independent;
}

static void finish(fixture *f)
{
    tn_mapper_free(f->mapper);
    tn_analysis_clear(&f->analysis);
    tn_grammar_free(f->grammar);
}

static const char *const grammars[] = {STDLIB "arithmetic.bnf",      STDLIB "words.bnf",
                                       STDLIB "plan-rules.bnf",      STDLIB "genr8.bnf",
                                       STDLIB "genr8-symmetric.bnf", STDLIB "genr8-probabilistic.bnf"};

static void plant(const fixture *f, size_t g, tn_tree_places places)
{
    uint32_t least = f->analysis.rule_depth[0], reached = 0;
    for (uint64_t i = 0; i < 300; i++) {
        tn_genome genome = {0};
        tn_chance chance = tn_chance_for(3, TN_PURPOSE_INITIALISE, g, i);
        tn_tree_options options = {.method = (tn_tree_method)(i % 3),
                                   .depth = least + (uint32_t)(i % 7),
                                   .max_depth = f->mapping.max_depth,
                                   .codon_limit = 100000,
                                   .max_codons = 100000,
                                   .places = places};
        assert_int_equal(tn_random_tree(f->grammar, &f->analysis, 0, 1, &options, &chance, &genome, NULL), TN_OK);
        tn_mapping mapping;
        assert_int_equal(tn_mapper_derive(f->mapper, genome.codons, genome.count, &f->mapping, &mapping, NULL), TN_OK);
        assert_true(mapping.valid);
        assert_int_equal(mapping.used, genome.count); /* reads the tree's codons, each once */
        assert_true(mapping.depth <= options.depth);
        reached = mapping.depth > reached ? mapping.depth : reached;
        if (options.method == TN_TREE_FULL && g == 0)
            assert_int_equal(mapping.depth, options.depth);
        tn_genome_clear(&genome);
    }
    assert_true(reached >= least + (g == 4 ? 0 : 5));
}

static void test_trees(void **state)
{
    (void)state;
    for (size_t g = 0; g < sizeof grammars / sizeof *grammars; g++) {
        fixture f = prepare(grammars[g]);
        plant(&f, g, TN_PLACES_NONE);
        finish(&f);
        if (prepare_places(grammars[g], &f)) {
            plant(&f, g, TN_PLACES_LEFTMOST);
            plant(&f, g, TN_PLACES_RANDOM);
        }
        finish(&f);
    }
}

static void vary_all(fixture *f, tn_crossover crossover, tn_mutation mutation, bool keeps_valid)
{
    tn_breeder *breeder = tn_breeder_new(f->grammar, &f->analysis, &f->mapping);
    tn_breeder *again = tn_breeder_new(f->grammar, &f->analysis, &f->mapping);
    tn_genome genomes[40] = {0};
    tn_tree_options tree = {.depth = f->analysis.rule_depth[0] + 5,
                            .max_depth = f->mapping.max_depth,
                            .codon_limit = 1000,
                            .tail = 0.5,
                            .max_codons = 5000,
                            .places = f->mapping.position_independent ? TN_PLACES_RANDOM : TN_PLACES_NONE};
    tn_vary_options options = {.crossover = crossover,
                               .crossover_rate = 0.9,
                               .mutation = mutation,
                               .mutation_rate = mutation == TN_MUTATE_GENOME    ? 2
                                                : mutation == TN_MUTATE_SUBTREE ? 0.5
                                                                                : 0.02,
                               .within_used = true,
                               .codon_limit = 1000,
                               .max_codons = 5000,
                               .tree_depth = tree.depth};
    size_t crossed = 0;
    for (uint64_t i = 0; i < 40; i++) {
        tn_chance chance = tn_chance_for(5, TN_PURPOSE_INITIALISE, 0, i);
        assert_int_equal(tn_random_tree(f->grammar, &f->analysis, 0, 1, &tree, &chance, &genomes[i], NULL), TN_OK);
    }
    for (uint64_t round = 0; round < 400; round++) {
        uint64_t a = tn_random64(1, round, 0) % 40, b = tn_random64(1, round, 1) % 40;
        tn_genome children[2] = {0}, copies[2] = {0}, *into[2] = {&children[0], &children[1]},
                  *twice[2] = {&copies[0], &copies[1]};
        tn_mapping mapping;
        tn_mapper_derive(f->mapper, genomes[a].codons, genomes[a].count, &f->mapping, &mapping, NULL);
        tn_parent parents[2] = {{&genomes[a], mapping.used, 1}, {&genomes[b], 0, 1}};
        uint8_t kinds[2], same[2];
        tn_chance chance = tn_chance_for(5, TN_PURPOSE_BIRTH, 1, round), repeated = chance;
        assert_int_equal(tn_breed(breeder, &options, &chance, parents, into, kinds, NULL), TN_OK);
        assert_int_equal(tn_breed(again, &options, &repeated, parents, twice, same, NULL), TN_OK);
        crossed += (kinds[0] & 15) == TN_BIRTH_CROSSED;
        for (int i = 0; i < 2; i++) {
            assert_int_equal(kinds[i], same[i]);
            assert_int_equal(children[i].count, copies[i].count);
            assert_memory_equal(children[i].codons, copies[i].codons, children[i].count * sizeof(uint64_t));
            assert_int_equal(
                tn_mapper_derive(f->mapper, children[i].codons, children[i].count, &f->mapping, &mapping, NULL), TN_OK);
            assert_true(mapping.valid || !keeps_valid);
            tn_genome *place = &genomes[i ? b : a];
            if (mapping.valid && (i == 0 || a != b)) {
                tn_genome swap = *place;
                *place = children[i];
                children[i] = swap;
            }
            tn_genome_clear(&copies[i]);
        }
        tn_genome_clear(&children[0]);
        tn_genome_clear(&children[1]);
    }
    assert_true(crossed > 200);
    for (size_t i = 0; i < 40; i++)
        tn_genome_clear(&genomes[i]);
    tn_breeder_free(breeder);
    tn_breeder_free(again);
}

static void test_operators(void **state)
{
    (void)state;
    for (size_t g = 0; g < sizeof grammars / sizeof *grammars; g++) {
        fixture f = prepare(grammars[g]);
        for (int c = 0; c < TN_CROSS_COUNT; c++)
            vary_all(&f, (tn_crossover)c, (tn_mutation)(c % 2), false);
        vary_all(&f, TN_CROSS_SUBTREE, TN_MUTATE_SUBTREE, true);
        finish(&f);
        if (prepare_places(grammars[g], &f)) {
            for (int c = 0; c < TN_CROSS_COUNT; c++)
                vary_all(&f, (tn_crossover)c, (tn_mutation)(c % 2), false);
            vary_all(&f, TN_CROSS_SUBTREE, TN_MUTATE_SUBTREE, true);
        }
        finish(&f);
    }
}

/* Linear crossover of genomes that tell where each codon is from. */
static void test_linear_crossover(void **state)
{
    (void)state;
    fixture f = prepare(STDLIB "words.bnf");
    tn_breeder *breeder = tn_breeder_new(f.grammar, &f.analysis, &f.mapping);
    for (int c = 0; c < TN_CROSS_SUBTREE; c++) {
        for (uint64_t round = 0; round < 100; round++) {
            uint64_t first[10], second[7];
            for (uint64_t i = 0; i < 10; i++)
                first[i] = 100 + i;
            for (uint64_t i = 0; i < 7; i++)
                second[i] = 200 + i;
            tn_genome a = {first, 10, 10}, b = {second, 7, 7}, children[2] = {0},
                      *into[2] = {&children[0], &children[1]};
            tn_parent parents[2] = {{&a, 0, 1}, {&b, 0, 1}};
            tn_vary_options options = {.crossover = (tn_crossover)c,
                                       .crossover_rate = 1,
                                       .mutation = TN_MUTATE_CODONS,
                                       .mutation_rate = 0,
                                       .max_codons = 100};
            tn_chance chance = tn_chance_for(9, TN_PURPOSE_BIRTH, (uint64_t)c, round);
            uint8_t kinds[2];
            assert_int_equal(tn_breed(breeder, &options, &chance, parents, into, kinds, NULL), TN_OK);
            assert_int_equal(kinds[0], TN_BIRTH_CROSSED);
            assert_int_equal(children[0].count + children[1].count, 17); /* nothing lost, nothing twice */
            uint64_t seen[17] = {0};
            for (int k = 0; k < 2; k++)
                for (size_t i = 0; i < children[k].count; i++) {
                    uint64_t codon = children[k].codons[i];
                    seen[codon < 200 ? codon - 100 : codon - 190]++;
                }
            for (size_t i = 0; i < 17; i++)
                assert_int_equal(seen[i], 1);
            if (c == TN_CROSS_FIXED_ONE_POINT || c == TN_CROSS_FIXED_TWO_POINT)
                for (size_t i = 0; i < 7; i++)
                    assert_int_equal(children[0].codons[i] % 100, i);
            tn_genome_clear(&children[0]);
            tn_genome_clear(&children[1]);
        }
    }
    tn_breeder_free(breeder);
    finish(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_trees),
        cmocka_unit_test(test_operators),
        cmocka_unit_test(test_linear_crossover),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
