/* For tests of memory that runs out: include it after cmocka.h. */
#ifndef TARTAN_TESTS_FAIL_EACH_H
#define TARTAN_TESTS_FAIL_EACH_H

#include "runtime/base/error.h"
#include "tests/support/failing_memory.h"

/* Runs `what` with each of its allocations failing, alone and with all later ones: it says so, or does without one; with
 * `spares` also without all later ones. It succeeds where none fails. */
static inline void fail_each(tn_status (*what)(void), bool spares)
{
    assert_int_equal(what(), TN_OK);
    for (int all_after = 0; all_after < 2; all_after++) {
        for (size_t number = 0;; number++) {
            fail_allocation(number, all_after);
            tn_status status = what();
            if (stop_failing() <= number) {
                assert_int_equal(status, TN_OK);
                break;
            }
            assert_true(status == TN_MEMORY || ((spares || !all_after) && status == TN_OK));
        }
    }
}

#endif
