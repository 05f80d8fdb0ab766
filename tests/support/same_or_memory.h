/* For tests of memory that runs out where something is written: include it after cmocka.h. */
#ifndef TARTAN_TESTS_SAME_OR_MEMORY_H
#define TARTAN_TESTS_SAME_OR_MEMORY_H

#include <stdlib.h>
#include <string.h>

#include "runtime/base/error.h"
#include "runtime/plan/text/text.h"
#include "tests/support/failing_memory.h"
#include "tests/support/test_schema.h"

typedef tn_status written_operation(void *context, tn_buffer *out, tn_error *error);

/* Runs the operation with each of its allocations failing, alone and with all later ones: it writes what it does with
 * memory enough, or says that memory ran out. step: of the allocations after the first, every one in this many more. */
static inline void same_or_memory(written_operation *operate, void *context, size_t step)
{
    tn_buffer expected = {0};
    size_t failures = 0;
    tn_error error = {0};
    test_ok(operate(context, &expected, &error), &error);
    for (int all_after = 0; all_after < 2; all_after++) {
        for (size_t number = 0, reached = 1; reached > 0; number += 1 + number / step) {
            tn_buffer out = {0};
            error = (tn_error){0};
            fail_allocation(number, all_after);
            tn_status status = operate(context, &out, &error);
            reached = stop_failing() > number;
            if (status == TN_OK && (out.size != expected.size || memcmp(out.data, expected.data, out.size) != 0))
                fail_msg("without allocation %zu what is written is another", number);
            if (status != TN_OK && (status != TN_MEMORY || error.code != E_OUT_OF_MEMORY))
                fail_msg("without allocation %zu: %s", number, error.message);
            failures += status != TN_OK;
            free(out.data);
        }
    }
    free(expected.data);
    assert_true(failures > 20);
}

#endif
