/* Rules of plans as modules, for tests: include it after cmocka.h. */
#ifndef TARTAN_TESTS_LOAD_PLAN_H
#define TARTAN_TESTS_LOAD_PLAN_H

#include "runtime/load.h"
#include "tests/support/compile_file.h"

/* The module of a text without mistakes. The compilation has its bytes, and is cleared after it. */
static inline tn_module *load_plan(const char *text, tn_compilation *compilation)
{
    const library_folders none = {0};
    tn_module *module = NULL;
    assert_int_equal(compile_text("test.plan", text, strlen(text), &none, compilation), TN_OK);
    assert_int_equal(tn_module_load(compilation->module, compilation->module_size, NULL, &module, NULL), TN_OK);
    return module;
}

#endif
