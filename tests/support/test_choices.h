/* Choices few enough to try all of their combinations, which have codes in their order, the first field most
 * significant. */
#ifndef TARTAN_TESTS_TEST_CHOICES_H
#define TARTAN_TESTS_TEST_CHOICES_H

#include <stdbool.h>
#include <stdint.h>

enum { TEST_FIELDS = 4 };
static const uint32_t test_choice_counts[TEST_FIELDS] = {3, 2, 5, 4};
enum { TEST_CHOICE_BITS = 3 + 2 + 5 + 4, TEST_COMBINATIONS = 3 * 2 * 5 * 4 };

/* The values of the combination of a code. */
static inline void test_choice_values(uint32_t code, uint8_t *values)
{
    for (uint32_t f = TEST_FIELDS; f-- > 0;) {
        values[f] = (uint8_t)(code % test_choice_counts[f]);
        code /= test_choice_counts[f];
    }
}

/* Has each field a value whose bit is set (as of tn_choices_box)? */
static inline bool test_choice_is_within(const uint8_t *values, uint64_t mask)
{
    uint32_t start = 0;
    for (uint32_t f = 0; f < TEST_FIELDS; f++) {
        if (!(mask >> (start + values[f]) & 1))
            return false;
        start += test_choice_counts[f];
    }
    return true;
}

#endif
