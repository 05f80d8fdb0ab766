/* Houses that were found are judged by the interpreter of rules before they are shown. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ask/house/numbered.h"
#include "tests/support/test_house.h"

static const char text[] = "schema hut { width role length = 8' zone body role band = room(10') }\n"
                           "form huts of hut {\n"
                           "  storey ground 9' wall 6\" partition 4\" floor 10\" roof 8\"\n"
                           "  option body roof = gable(9:12) | vault(3')\n"
                           "  function bed at cell(body)\n"
                           "  face cell(bed) beside cell(bed) = open\n"
                           "}\n"
                           "library rows using hut { trays 1 }\n"
                           "library all from rows in huts { }\n"
                           "library some from rows in huts { prune option(body roof vault) as round }\n";

/* Both libraries as if counting had taken one for the other: the houses found are those of `all`. */
static void test_contradiction(void **state)
{
    (void)state;
    test_house made;
    tn_error error = {0};
    tn_numbered opened, n;
    tn_session session = {0};
    tn_library *plans;
    tn_house house;
    const tn_library_options options = {0};
    const tn_tray trays[] = {0};
    mpz_t number;
    mpz_init(number);
    test_house_compile(&made, text);
    assert_int_equal(tn_library_new(made.schema, made.some->plans, &options, &plans, &error), TN_OK);
    opened = (tn_numbered){.session = &session, .schema = made.schema, .form = made.form};
    tn_numbered_other(&opened, made.module, made.all, plans, &n);
    for (unsigned long i = 0; i < 2; i++) {
        mpz_set_ui(number, i);
        n.record = made.all;
        assert_int_equal(tn_numbered_at(&n, trays, 1, number, &house, &error), TN_OK);
        n.record = made.some;
        assert_int_equal(tn_numbered_judge(&n, &house, &error), i == 0 ? TN_OK : TN_INTERNAL);
        tn_house_clear(&house);
    }
    assert_non_null(strstr(error.message, "was found in `some`, though the rules of the library keep it out"));
    assert_non_null(strstr(error.message, "vault"));
    assert_non_null(strstr(error.help, "please report it"));
    tn_numbered_other_close(&n);
    tn_library_free(plans);
    test_house_clear(&made);
    mpz_clear(number);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_contradiction)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
