/* How likely plans with weights are drawn: on the line of masses each plan has as many places as its weights say, which
 * the interpreter multiplies; and what is drawn one after another, without those before. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/open/open.h"
#include "runtime/base/integers.h"
#include "runtime/plan/match/vm.h"
#include "runtime/plan/measure/likelihood.h"
#include "tests/support/test_rule.h"

#define HEAD "schema stall { use = cafe | hall | shop  width = 3m | 6m }\nrule cafes using stall = tray(cafe)\n"

/* The last library of a text. */
typedef struct weighted {
    tn_opened opened;
    tn_schema *schema;
    tn_library *library;
    tn_likelihood *likelihood;
} weighted;

static void make(weighted *made, const char *text)
{
    tn_error error;
    assert_int_equal(tn_open_bytes("w.plan", (const uint8_t *)text, strlen(text), false, &made->opened), TN_OK);
    uint32_t last = (uint32_t)made->opened.module->LIBRARY_count - 1;
    uint32_t schema = made->opened.module->LIBRARY_records[last].schema;
    test_ok(tn_schema_new(made->opened.module, schema, 0, &made->schema, &error), &error);
    test_ok(tn_library_new(made->schema, last, NULL, &made->library, &error), &error);
    test_ok(tn_likelihood_new(made->library, &made->likelihood, &error), &error);
}

static void clear(weighted *made)
{
    tn_likelihood_free(made->likelihood);
    tn_library_free(made->library);
    tn_schema_free(made->schema);
    tn_close(&made->opened);
}

/* The product of each weight to the power of how many trays it is about. */
static void weigh(const weighted *made, tn_plan_vm *vm, const tn_tray *trays, uint32_t length, mpq_t weight)
{
    const tn_module *module = made->opened.module;
    const tn_library_record *record = tn_library_record_of(made->library);
    mpq_t count, factor;
    tn_error error;
    mpq_inits(count, factor, NULL);
    mpq_set_ui(weight, 1, 1);
    test_ok(tn_plan_vm_plan(vm, trays, length, &error), &error);
    for (uint32_t i = 0; i < record->weight_count; i++) {
        const tn_weight_record *w = &module->WEIGHT_records[record->weight_first + i];
        bool has;
        test_ok(tn_plan_vm_value(vm, w->sum, count, &has, &error), &error);
        mpq_set_str(factor, tn_text(module, w->factor), 10);
        for (unsigned long k = mpz_get_ui(mpq_numref(count)); k > 0; k--)
            mpq_mul(weight, weight, factor);
    }
    mpq_clears(count, factor, NULL);
}

/* The weights of all plans, by rank. */
static mpq_t *all_weights(const weighted *made, size_t *count)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(made->library, TN_ALL_LENGTHS, kept);
    *count = mpz_get_ui(kept);
    mpq_t *weights = calloc(*count + 1, sizeof *weights);
    tn_tray trays[16];
    tn_plan_vm *vm;
    tn_error error;
    assert_non_null(weights);
    test_ok(tn_plan_vm_new(made->schema, 0, &vm, &error), &error);
    for (size_t i = 0; i < *count; i++) {
        uint32_t length;
        mpz_set_ui(kept, i);
        mpq_init(weights[i]);
        assert_true(tn_library_unrank(made->library, kept, trays, &length));
        weigh(made, vm, trays, length, weights[i]);
    }
    tn_plan_vm_free(vm);
    mpz_clear(kept);
    return weights;
}

static void free_weights(mpq_t *weights, size_t count)
{
    for (size_t i = 0; i < count; i++)
        mpq_clear(weights[i]);
    free(weights);
}

static void check_totals(const weighted *made, mpq_t *weights, size_t count)
{
    mpq_t total, of_length;
    mpz_t rank;
    mpq_inits(total, of_length, NULL);
    mpz_init(rank);
    for (uint32_t n = 0; n <= tn_library_max(made->library) + 1; n++) {
        bool all = n > tn_library_max(made->library);
        mpq_set_ui(total, 0, 1);
        for (size_t i = 0; i < count; i++) {
            tn_tray trays[16];
            uint32_t length;
            mpz_set_ui(rank, i);
            tn_library_unrank(made->library, rank, trays, &length);
            if (all || length == n)
                mpq_add(total, total, weights[i]);
        }
        tn_likelihood_total(made->likelihood, all ? TN_ALL_LENGTHS : n, of_length);
        assert_true(mpq_equal(total, of_length));
    }
    mpz_clear(rank);
    mpq_clears(total, of_length, NULL);
}

/* Every place of the line means the plan in whose stretch it lies, and each plan's stretch is as large as it weighs. */
static void check_line(const weighted *made, mpq_t *weights, size_t count)
{
    mpz_t place, begin, size, rank, end, all, scale;
    mpq_t weight;
    tn_tray trays[16];
    tn_error error;
    size_t met = 0;
    mpz_inits(place, begin, size, rank, end, all, scale, NULL);
    mpq_init(weight);
    tn_likely_line(made->likelihood, all, scale);
    while (mpz_cmp(place, all) < 0) {
        uint32_t length;
        test_ok(tn_likely_plan(made->likelihood, place, trays, &length, begin, size, &error), &error);
        assert_true(mpz_cmp(begin, place) == 0);
        assert_true(tn_library_rank(made->library, trays, length, rank));
        mpq_set_num(weight, size);
        mpq_set_den(weight, scale);
        mpq_canonicalize(weight);
        assert_true(mpq_equal(weight, weights[mpz_get_ui(rank)]));
        mpz_add(end, begin, size);
        mpz_sub_ui(place, end, 1); /* its last place, and one in it, mean it too */
        for (int k = 0; k < 2; k++) {
            mpz_t again;
            mpz_init(again);
            test_ok(tn_likely_plan(made->likelihood, place, trays, &length, again, size, &error), &error);
            assert_int_equal(mpz_cmp(again, begin), 0);
            mpz_clear(again);
            mpz_add(place, begin, place);
            mpz_fdiv_q_2exp(place, place, 1);
        }
        mpz_set(place, end);
        met++;
    }
    assert_int_equal(met, count);
    mpq_clear(weight);
    mpz_clears(place, begin, size, rank, end, all, scale, NULL);
}

static void check_sample(const weighted *made, uint32_t length, size_t count)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(made->library, length, kept);
    size_t found = 0, again = 0, want = mpz_cmp_ui(kept, count) < 0 ? mpz_get_ui(kept) : count;
    mpz_t *ranks = tn_integers_new(count), *same = tn_integers_new(count);
    tn_error error;
    test_ok(tn_likelihood_sample(made->likelihood, 5, length, count, ranks, &found, &error), &error);
    test_ok(tn_likelihood_sample(made->likelihood, 5, length, count, same, &again, &error), &error);
    assert_int_equal(found, want);
    assert_int_equal(again, want);
    for (size_t i = 0; i < found; i++) {
        tn_tray trays[16];
        uint32_t size;
        assert_int_equal(mpz_cmp(ranks[i], same[i]), 0);
        assert_true(i == 0 || mpz_cmp(ranks[i - 1], ranks[i]) < 0);
        assert_true(tn_library_unrank(made->library, ranks[i], trays, &size));
        assert_true(length == TN_ALL_LENGTHS || length == size);
    }
    tn_integers_free(ranks, count);
    tn_integers_free(same, count);
    mpz_clear(kept);
}

static void masses_are_products_of_weights(void **state)
{
    (void)state;
    static const char *const texts[] = {
        HEAD "library l using stall { trays 0..3 }\n",
        HEAD "library l using stall { trays 1..3  weight tray(cafe) 7 }\n",
        HEAD "library l using stall { trays 0..4  require tray(hall)  weight cafes 0.5  weight tray(3m) 2.5 }\n",
        HEAD "library l using stall { trays 2..4  prune tray(hall, 3m)  weight any 0.3 }\n",
        HEAD "library l using stall { trays 1..4  weight tray(cafe) beside tray(hall) 3  weight tray(6m) 0.25 }\n",
        HEAD "library l using stall { trays 0..4  weight any where quantity(cafes before) > quantity(cafes after) 2.5\n"
             "  weight every(any, tray(hall)) 3  weight tray(shop) within 2 of tray(hall) 0.4\n"
             "  weight not tray(cafe) at least 2 from every cafes 7 }\n",
        HEAD "library a using stall { trays 1..3  weight cafes 2 }\n"
             "library l from a { prune neighbour(cafes, cafes)  weight tray(hall) 5  weight cafes 1.5 }\n",
        HEAD "schema newer from stall { high = flag }\nlibrary a using stall { trays 1..2  weight cafes 2 }\n"
             "library l using newer from a { weight tray(high) 5 }\n",
        HEAD "library l using stall { trays 1..3  require tray(hall) and not tray(hall)  weight cafes 2 }\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        weighted made;
        size_t count;
        make(&made, texts[i]);
        mpq_t *weights = all_weights(&made, &count);
        check_totals(&made, weights, count);
        check_line(&made, weights, count);
        check_sample(&made, TN_ALL_LENGTHS, count);
        check_sample(&made, TN_ALL_LENGTHS, count ? count - 1 : 0);
        check_sample(&made, TN_ALL_LENGTHS, count / 2);
        check_sample(&made, 2, 3);
        check_sample(&made, 9, 3);
        free_weights(weights, count);
        clear(&made);
    }
}

/* A draw leaves out those before: pairs of three plans of the weights 1, 2 and 5, as often as they are likely. */
static void draws_leave_out_those_before(void **state)
{
    (void)state;
    enum { DRAWS = 8000 };
    weighted made;
    double weight[3] = {5, 2, 1}, all = 8;
    size_t met[3] = {0}, alone[3] = {0}; /* of which plan is it that is left out; which is drawn alone */
    mpz_t *ranks = tn_integers_new(2);
    make(&made, "schema s { use = cafe | hall | shop }\n"
                "library l using s { trays 1  weight tray(cafe) 5  weight tray(hall) 2 }\n");
    for (uint64_t seed = 0; seed < DRAWS; seed++) {
        size_t found;
        tn_error error;
        test_ok(tn_likelihood_sample(made.likelihood, seed, TN_ALL_LENGTHS, 2, ranks, &found, &error), &error);
        assert_int_equal(found, 2);
        met[3 - mpz_get_ui(ranks[0]) - mpz_get_ui(ranks[1])]++;
        test_ok(tn_likelihood_sample(made.likelihood, seed, TN_ALL_LENGTHS, 1, ranks, &found, &error), &error);
        alone[mpz_get_ui(ranks[0])]++;
    }
    for (size_t out = 0; out < 3; out++) {
        size_t a = (out + 1) % 3, b = (out + 2) % 3;
        double chance =
            weight[a] / all * weight[b] / (all - weight[a]) + weight[b] / all * weight[a] / (all - weight[b]);
        double sixfold = 6 * sqrt(DRAWS * chance * (1 - chance)), one = weight[out] / all;
        assert_true(fabs((double)met[out] - DRAWS * chance) < sixfold);
        assert_true(fabs((double)alone[out] - DRAWS * one) < 6 * sqrt(DRAWS * one * (1 - one)));
    }
    tn_integers_free(ranks, 2);
    clear(&made);
}

/* Weights so far apart that rejecting would never end. */
static void draws_end_whatever_the_weights(void **state)
{
    (void)state;
    weighted made;
    make(&made, HEAD "library l using stall { trays 1..5  weight tray(cafe) 1000000000000000000  weight tray(hall, 3m) "
                     "0.00000000000000000001 }\n");
    check_sample(&made, TN_ALL_LENGTHS, 9000);
    clear(&made);
}

/* More than three that look around are a limit, which names the way out. */
static void few_weights_look_around(void **state)
{
    (void)state;
    weighted made;
    tn_error error = {0};
    const char *text = HEAD "library l using stall { trays 1..2\n"
                            "  weight cafes beside tray(hall) 2  weight cafes beside tray(shop) 2\n"
                            "  weight tray(hall) beside tray(shop) 2  weight tray(shop) beside tray(shop) 2 }\n";
    assert_int_equal(tn_open_bytes("w.plan", (const uint8_t *)text, strlen(text), false, &made.opened), TN_OK);
    test_ok(tn_schema_new(made.opened.module, 0, 0, &made.schema, &error), &error);
    test_ok(tn_library_new(made.schema, 0, NULL, &made.library, &error), &error);
    assert_int_equal(tn_likelihood_new(made.library, &made.likelihood, &error), TN_LIMIT);
    assert_non_null(strstr(error.help, "--uniform"));
    made.likelihood = NULL;
    clear(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(masses_are_products_of_weights),
        cmocka_unit_test(draws_leave_out_those_before),
        cmocka_unit_test(draws_end_whatever_the_weights),
        cmocka_unit_test(few_weights_look_around),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
