/* The table of notations: that its rows fit together, and which of them a text is taken for. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "compiler/compile.h"

static void test_rows(void **state)
{
    (void)state;
    assert_true(tn_notation_is_main(&tn_notations[0]));
    for (size_t i = 0; i < tn_notation_count; i++) {
        const tn_notation *row = &tn_notations[i];
        size_t mains = 0;
        for (size_t k = 0; k < tn_notation_count; k++) {
            assert_true(i == k || strcmp(row->name, tn_notations[k].name) != 0);
            mains += tn_notation_is_main(&tn_notations[k]) && strcmp(row->extension, tn_notations[k].extension) == 0;
        }
        assert_int_equal(mains, 1);
        assert_int_equal(row->extension[0], '.');
        /* a text that says nothing else is its own; --notation offers the row's name */
        if (tn_notation_is_main(row)) {
            assert_string_equal(tn_notation_language(row), row->name);
            assert_ptr_equal(tn_notation_of_language(row->name, "", 0), row);
        }
        assert_true(row->what[0] && row->commands[0]);
        const tn_front *front = row->front;
        assert_true(front->read && front->compile && front->made && front->lay_out && front->spell);
    }
}

static void assert_notation(const char *path, const char *text, const char *name)
{
    const tn_notation *found = tn_notation_of(path, text, strlen(text));
    if (!found || strcmp(found->name, name) != 0)
        fail_msg("%s: %s is %s, not %s", path, text, found ? found->name : "nothing", name);
}

static void test_by_name(void **state)
{
    (void)state;
    assert_notation("a.plan", "evolution {}", "plan");
    assert_notation("/x.y/a.hemls", "", "hemls");
    assert_notation("<stdlib>/a.bnf", "", "bnf");
    static const char *const nameless[] = {"-", "", "plan", "a.plans", "a.PLAN", "a.plan/b", "a.tnb", "a.plan.txt"};
    for (size_t i = 0; i < sizeof nameless / sizeof *nameless; i++) {
        assert_null(tn_notation_of(nameless[i], "", 0));
        assert_ptr_equal(tn_notation_or_first(nameless[i], "", 0), &tn_notations[0]);
    }
    assert_null(tn_notation_of_language("auto", "", 0));
    assert_null(tn_notation_of_language("evolution", "", 0));
}

/* Two notations have one extension: the word that heads a block tells, wherever it stands, but not in comments or
 * texts. */
static void test_by_word(void **state)
{
    (void)state;
    static const char *const evolutions[] = {
        "evolution {}",
        "\xEF\xBB\xBF"
        "evolution{",
        "# a comment\n\n  Evolution\n\t{ population 5 }",
        "rules \"square\"\nevolution { }",
        "title \"an open text\nevolution {",
        "title \"\" evolution {",
        "# rules \"\nevolution {",
    };
    static const char *const growths[] = {
        "",
        "evolution",
        "evolution steps 3",
        "# evolution {\nrules \"square\"",
        "title \"evolution {\"\nrules \"square\"",
        "title \"a\nb\" # evolution {",
        "evolutionary {",
        "my-evolution {",
        "evolution # {\n",
        "evolution \"{\"",
        "\"",
        "#",
    };
    for (size_t i = 0; i < sizeof evolutions / sizeof *evolutions; i++)
        assert_notation("a.study", evolutions[i], "evolution");
    for (size_t i = 0; i < sizeof growths / sizeof *growths; i++)
        assert_notation("a.study", growths[i], "study");
    assert_ptr_equal(tn_notation_of_language("study", "evolution {", 11), TN_NOTATION(evolution));
    /* no byte after the size is looked at */
    assert_ptr_equal(tn_notation_of("a.study", "evolution {", 10), TN_NOTATION(study));
}

static void test_what_takes_it(void **state)
{
    (void)state;
    char text[200];
    assert_true(tn_notation_takes(TN_NOTATION(evolution), "evolve"));
    assert_true(tn_notation_takes(TN_NOTATION(evolution), "breed"));
    assert_false(tn_notation_takes(TN_NOTATION(evolution), "evol"));
    assert_false(tn_notation_takes(TN_NOTATION(evolution), "grow"));
    assert_false(tn_notation_takes(TN_NOTATION(evolution), ""));
    tn_notation_help(TN_NOTATION(evolution), text, sizeof text);
    assert_string_equal(text, "it is a study to be evolved: `tartan evolve` and `tartan breed` take it");
    tn_notation_help(TN_NOTATION(bnf), text, sizeof text);
    assert_string_equal(text, "it is a grammar that genomes are mapped through: `tartan map` takes it");
    tn_notation_help(TN_NOTATION(bnf), text, 12);
    assert_string_equal(text, "it is a gra");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows),
        cmocka_unit_test(test_by_name),
        cmocka_unit_test(test_by_word),
        cmocka_unit_test(test_what_takes_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
