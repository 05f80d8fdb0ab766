/* Tells whether a case of a test comes out. */
#include "driver/plan/outcome.h"

#include <string.h>

#include "driver/plan/clauses.h"

/* Is the clause called `name` among those that drop the plan? */
static bool is_reason(const tn_module *module, const tn_library_record *library, const tn_test_case *test,
                      const char *name, const uint64_t *bits)
{
    if (strcmp(name, "trays") == 0 && tn_length_drops(library, test))
        return true;
    for (size_t i = 0; i < library->clause_count; i++)
        if (strcmp(tn_text(module, module->CLAUSE_records[library->clause_first + i].name), name) == 0 &&
            tn_clause_drops(module, library, i, bits))
            return true;
    return false;
}

static bool is_dropped(const tn_module *module, const tn_library_record *library, const tn_test_case *test,
                       const uint64_t *bits)
{
    if (tn_length_drops(library, test))
        return true;
    for (size_t i = 0; i < library->clause_count; i++)
        if (tn_clause_drops(module, library, i, bits))
            return true;
    return false;
}

bool tn_case_comes_out(const tn_module *module, const tn_test_block *block, const tn_test_case *test,
                       const uint64_t *bits)
{
    const tn_library_record *library = block->is_library ? &module->LIBRARY_records[block->index] : NULL;
    bool matched = !library && (bits[0] & 1);
    switch (test->expectation) {
    case TN_EXPECT_MATCH:
        return matched;
    case TN_EXPECT_REJECT:
        return !matched;
    case TN_EXPECT_KEEP:
        return !is_dropped(module, library, test, bits);
    case TN_EXPECT_DROP:
    case TN_EXPECT_VALUE: /* value_tests.c */
        break;
    }
    for (size_t i = 0; i < test->by_count; i++)
        if (!is_reason(module, library, test, test->by[i], bits))
            return false;
    return is_dropped(module, library, test, bits);
}
