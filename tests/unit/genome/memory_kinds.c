/* Breeding trees and boxes without memory: each allocation of a small run fails once, and then once together with all
 * after it. The run says so, leaves nothing behind (the sanitized build would see it), and the next one works. */
#include "runtime/base/bytes.h"
#include "runtime/genome/boxes/box_kind.h"
#include "runtime/genome/breeding/evolve.h"
#include "runtime/genome/tree/tree_kind.h"
#include "tests/support/failing_memory.h"
#include "tests/support/test_grammar.h"

static tn_status by_size(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                         char message[200], tn_error *error)
{
    (void)context, (void)thread, (void)sentence, (void)message, (void)error;
    score->objectives[0] = (double)size;
    return TN_OK;
}

/* Three generations, the last of parents that were chosen: a member, and one by its id. */
static tn_status run(const tn_genome_kind *kind, const tn_genome *seeds, size_t seed_count, tn_error *error)
{
    tn_evolution_settings settings = tn_evolution_settings_default();
    tn_evaluator evaluator = {.objectives = 1, .evaluate = by_size};
    tn_evolution *evolution = NULL;
    settings.population = 8;
    settings.kind = kind;
    settings.seeds = seeds;
    settings.seed_count = seed_count;
    settings.remembers = true;
    settings.threads = 1;
    tn_status status = tn_evolution_new(NULL, &settings, &evaluator, &evolution, error);
    for (int i = 0; i < 2 && status == TN_OK; i++)
        status = tn_evolution_step(evolution, error);
    const tn_chosen chosen[] = {{.number = 2, .weight = 1}, {.by_id = true, .number = 3, .weight = 0.4}};
    if (status == TN_OK)
        status = tn_evolution_choose(evolution, chosen, 2, error);
    if (status == TN_OK)
        status = tn_evolution_step(evolution, error);
    tn_evolution_free(evolution);
    return status;
}

static void expect_robust(const tn_genome_kind *kind, const tn_genome *seeds, size_t seed_count)
{
    for (int all_after = 0; all_after < 2; all_after++) {
        for (size_t number = 0;; number++) {
            tn_error error = {0};
            fail_allocation(number, all_after);
            tn_status status = run(kind, seeds, seed_count, &error);
            bool reached = stop_failing() > number;
            assert_int_equal(status, reached ? TN_MEMORY : TN_OK);
            assert_int_equal(run(kind, seeds, seed_count, &error), TN_OK);
            if (!reached) {
                assert_true(number > 20);
                break;
            }
        }
    }
}

static void test_trees(void **state)
{
    (void)state;
    uint64_t two = tn_bits_of(2);
    uint64_t ball[] = {TN_GENE_SUBTRACT, TN_GENE_ADD, TN_GENE_MULTIPLY, TN_GENE_X,        TN_GENE_X,
                       TN_GENE_MULTIPLY, TN_GENE_Y,   TN_GENE_Y,        TN_GENE_CONSTANT, 0},
             wall[] = {TN_GENE_SUBTRACT, TN_GENE_ABSOLUTE, TN_GENE_Z, TN_GENE_NUMBER, two};
    tn_genome parents[] = {{ball, sizeof ball / sizeof *ball, 0}, {wall, sizeof wall / sizeof *wall, 0}};
    const double weights[] = {1, 0.5};
    const tn_gene_constant radius = {"radius", 3};
    tn_tree_breeding breeding = {.how = {.maxprob = 0.5, .mutation_rate = 0.9, .shares = {1, 1, 1, 1}, .max_nodes = 50},
                                 .parents = parents,
                                 .weights = weights,
                                 .parent_count = 2,
                                 .constants = &radius,
                                 .constant_count = 1,
                                 .footer = "grid 20\n"};
    tn_genome_kind kind = tn_tree_kind(&breeding);
    expect_robust(&kind, parents, 2);
}

static void test_boxes(void **state)
{
    (void)state;
    tn_box_breeding breeding = {.low = {-6, 0, -4, 0.5, 0.5, 0.5, -5, -180, -90},
                                .high = {6, 7, 4, 7, 7, 7, 5, 180, 90},
                                .least = 1,
                                .most = 5,
                                .mutation_rate = -1,
                                .split = 0.5,
                                .delete_ = 0.3,
                                .head = "solid bred {\n",
                                .foot = "}\n"};
    tn_genome_kind kind = tn_box_kind(&breeding);
    expect_robust(&kind, NULL, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_trees),
        cmocka_unit_test(test_boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
