/* Models that were drawn, written as a connection grammar and as a kit, with each allocation failing once. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "driver/open/open.h"
#include "driver/place/drawn.h"
#include "tests/support/fail_each.h"

static const char kit[] = "unit 10 x 8 x 10;\n"
                          "connector stud joins tube turns 4; connector tube joins stud turns 4;\n"
                          "part 3005 { fill 20 x 24 x 20; stud up; tube down at (0, -24, 0); }\n"
                          "part 3024 { fill 20 x 8 x 20; stud up; tube down at (0, -8, 0); }\n";
static const char drawn[] = "1 4 0 0 0 1 0 0 0 1 0 0 0 1 3005.dat\n"
                            "1 14 0 -8 0 1 0 0 0 1 0 0 0 1 3024.dat\n";
static char folder[] = "/tmp/tartan-drawn-XXXXXX", kit_path[64], drawn_path[64];
static tn_opened opened;

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static int open_kit(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return 1;
    snprintf(kit_path, sizeof kit_path, "%s/own.kit", folder);
    snprintf(drawn_path, sizeof drawn_path, "%s/drawn.ldr", folder);
    write_file(kit_path, kit);
    write_file(drawn_path, drawn);
    return tn_open_bytes(kit_path, (const uint8_t *)kit, sizeof kit - 1, false, &opened) != TN_OK;
}

static int close_kit(void **state)
{
    (void)state;
    tn_close(&opened);
    return unlink(kit_path) || unlink(drawn_path) || rmdir(folder);
}

static tn_status as_grammar(void)
{
    char *text = NULL;
    size_t size;
    tn_drawn_changes changes;
    tn_error error;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return TN_MEMORY;
    tn_status status = tn_drawn_pcfg(drawn, sizeof drawn - 1, NULL, out, &changes, &error);
    if (fclose(out) != 0)
        status = TN_MEMORY;
    if (status == TN_OK)
        assert_non_null(strstr(text, "3024"));
    free(text);
    return status;
}

static tn_status as_kit(void)
{
    char *text = NULL, path[80];
    tn_ldraw ldraw = {0};
    tn_drawn_changes changes = {0};
    tn_error error;
    snprintf(path, sizeof path, "%s/again.kit", folder);
    tn_status status = tn_drawn_read(drawn_path, opened.module, &ldraw, &error);
    if (status == TN_OK)
        status = tn_drawn_kit(opened.module, &ldraw.model, "own.kit", path, NULL, &text, &changes, &error);
    if (status == TN_OK) {
        assert_int_equal(changes.left_out, 0);
        assert_non_null(strstr(text, "3024"));
    }
    free(text);
    tn_ldraw_clear(&ldraw);
    return status;
}

static void grammar_of_a_model(void **state)
{
    (void)state;
    fail_each(as_grammar, false);
}

static void kit_of_a_model(void **state)
{
    (void)state;
    fail_each(as_kit, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(grammar_of_a_model), cmocka_unit_test(kit_of_a_model)};
    return cmocka_run_group_tests_name("memory_drawn", tests, open_kit, close_kit);
}
