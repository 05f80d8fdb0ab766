/* Sets of pairs of states: what is kept of one are its largest pairs, however these are found. */
#include "runtime/automata/operand.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/test_rule.h"

enum { STATES = 60, PAIRS = 300 };

/* An operand whose inclusions are a random order: each state is below a later one once in `rarely` times. */
static void make_order(test_random *random, uint32_t rarely, tn_dfa *dfa, tn_operand *operand)
{
    static uint8_t phases[STATES];
    bool below[STATES][STATES] = {{false}};
    for (uint32_t p = 0; p < STATES; p++)
        for (uint32_t q = p + 1; q < STATES; q++)
            below[p][q] = test_random_below(random, rarely) == 0;
    for (uint32_t middle = 0; middle < STATES; middle++)
        for (uint32_t p = 0; p < STATES; p++)
            for (uint32_t q = 0; q < STATES; q++)
                below[p][q] |= below[p][middle] && below[middle][q];
    *operand = (tn_operand){.dfa = dfa, .dead = TN_NO_STATE, .phase = phases, .compared = true, .words = 1};
    operand->exceeds = calloc(STATES, sizeof *operand->exceeds);
    operand->above_first = calloc(STATES + 1, sizeof *operand->above_first);
    operand->above = malloc(STATES * STATES * sizeof *operand->above);
    assert_true(operand->exceeds && operand->above_first && operand->above);
    uint32_t count = 0;
    for (uint32_t p = 0; p < STATES; p++) {
        operand->above_first[p] = count;
        for (uint32_t q = 0; q < STATES; q++)
            if (below[p][q])
                operand->above[count++] = q;
            else if (p != q)
                operand->exceeds[p] |= UINT64_C(1) << q;
    }
    operand->above_first[STATES] = count;
}

static void free_order(tn_operand *operand)
{
    free(operand->exceeds);
    free(operand->above_first);
    free(operand->above);
}

static bool covers(const tn_operand operands[2], const uint32_t a[2], const uint32_t b[2])
{
    return (a[0] != b[0] || a[1] != b[1]) && tn_operand_below(&operands[0], b[0], a[0]) &&
           tn_operand_below(&operands[1], b[1], a[1]);
}

static void check_set(test_random *random, tn_operand operands[2], uint32_t size)
{
    uint32_t all[PAIRS][2];
    tn_pairs pairs = {.first = &operands[0], .second = &operands[1]};
    tn_key key = {0};
    for (uint32_t i = 0; i < size; i++) {
        all[i][0] = test_random_below(random, STATES);
        all[i][1] = test_random_below(random, STATES);
        tn_pairs_add(&pairs, all[i][0], all[i][1]);
    }
    assert_true(tn_pairs_write(&pairs, &key));
    for (uint32_t i = 0; i < size; i++) {
        bool covered = false, kept = false;
        for (uint32_t j = 0; j < size; j++)
            covered |= covers(operands, all[j], all[i]);
        for (size_t k = 0; k < key.size; k += 2)
            kept |= key.data[k] == all[i][0] && key.data[k + 1] == all[i][1];
        assert_int_equal(kept, !covered);
    }
    for (size_t k = 2; k < key.size; k += 2)
        assert_true(key.data[k - 2] < key.data[k] ||
                    (key.data[k - 2] == key.data[k] && key.data[k - 1] < key.data[k + 1]));
    tn_pairs_clear(&pairs);
    free(key.data);
}

static void test_largest_pairs(void **state)
{
    (void)state;
    static const uint32_t rarely[] = {2, 20, 200, 5000}; /* from nearly a chain, to nothing below anything */
    test_random random = {.seed = 20};
    tn_dfa *dfa = tn_dfa_new(1, 1, STATES);
    assert_non_null(dfa);
    for (uint32_t round = 0; round < 400; round++) {
        tn_operand operands[2];
        make_order(&random, rarely[round % 4], dfa, &operands[0]);
        make_order(&random, rarely[round / 4 % 4], dfa, &operands[1]);
        check_set(&random, operands, 1 + test_random_below(&random, PAIRS));
        free_order(&operands[0]);
        free_order(&operands[1]);
    }
    tn_dfa_free(dfa);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_largest_pairs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
