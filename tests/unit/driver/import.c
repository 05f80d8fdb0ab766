/* `use` of files: which file a path means, that each is read once, and what is recorded of it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "runtime/load.h"
#include "runtime/module/module.h"
#include "tests/support/compile_file.h"

#define SCHEMA "schema s { width = 4' | 8' }\n"

/* A folder of files, made for one test: top/ has the rule files, lib/ is the standard library. */
static char folder[64];

static void put(const char *name, const char *text)
{
    char path[160];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static int make_folder(void **state)
{
    (void)state;
    char path[160];
    snprintf(folder, sizeof folder, "/tmp/tartan-import-XXXXXX");
    if (!mkdtemp(folder))
        return -1;
    static const char *const parts[] = {"top", "top/inner", "lib", "lib2"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, parts[i]);
        if (mkdir(path, 0777) != 0)
            return -1;
    }
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[100];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command);
}

/* Compiles top/main.plan with lib/ and lib2/ as the standard library's folders. */
static tn_status compile_main(tn_compilation *compilation)
{
    char lib[100], lib2[100], path[100];
    snprintf(lib, sizeof lib, "%s/lib", folder);
    snprintf(lib2, sizeof lib2, "%s/lib2", folder);
    snprintf(path, sizeof path, "%s/top/main.plan", folder);
    const char *dirs[] = {lib, lib2};
    library_folders options = {.stdlib_dirs = dirs, .stdlib_dir_count = 2};
    return compile_file(path, &options, compilation);
}

static void diamond(void **state)
{
    (void)state;
    put("lib/base.plan", SCHEMA "rule low = tray(4')\n");
    put("top/inner/left.plan", "use \"base\"\nrule left = low\n");
    put("top/right.plan", "use \"base\"\nuse \"inner/left.plan\"\nrule right = not low\n");
    put("top/main.plan",
        "use \"inner/left.plan\"\nuse \"right.plan\"\nuse \"./right.plan\"\nrule top = left and right and low\n");
    tn_compilation c;
    tn_module *module;
    tn_error error;
    assert_int_equal(compile_main(&c), TN_OK);
    assert_int_equal(c.sources.count, 4);
    assert_int_equal(tn_module_load(c.module, c.module_size, NULL, &module, &error), TN_OK);
    static const char *const order[] = {"low", "left", "right", "top"};
    assert_int_equal(module->RULE_count, 4);
    for (size_t i = 0; i < 4; i++) {
        assert_string_equal(tn_text(module, module->RULE_records[i].name), order[i]);
        assert_int_equal(module->RULE_records[i].flags, i < 3 ? TN_IMPORTED : 0);
    }
    tn_module_free(module);
    tn_compilation_clear(&c);
}

/* Where the standard library is installed makes no difference to the module. */
static void recorded_paths(void **state)
{
    (void)state;
    put("lib2/other.plan", SCHEMA);
    put("top/main.plan", "use \"other\"\nrule a = any\n");
    tn_compilation c;
    tn_module *module;
    tn_error error;
    assert_int_equal(compile_main(&c), TN_OK);
    assert_int_equal(tn_module_load(c.module, c.module_size, NULL, &module, &error), TN_OK);
    assert_string_equal(tn_text(module, module->SOURCE_records[1].path), "<stdlib>/other.plan");
    tn_module_free(module);
    tn_compilation_clear(&c);
}

/* The first error's code and text. */
static void expect_error(tn_code code, const char *message)
{
    tn_compilation c;
    assert_int_equal(compile_main(&c), TN_INVALID);
    assert_true(c.diagnostics.count > 0);
    assert_int_equal(c.diagnostics.items[0].code, code);
    if (!strstr(c.diagnostics.items[0].message, message))
        fail_msg("%s", c.diagnostics.items[0].message);
    tn_compilation_clear(&c);
}

static void bare_names_are_the_library(void **state)
{
    (void)state;
    put("top/near.plan", SCHEMA);
    put("top/main.plan", "use \"near\"\nrule a = any\n");
    expect_error(E_IMPORT_NOT_FOUND, "the standard library has no `near`");
    put("top/main.plan", "use \"nowhere.plan\"\nrule a = any\n");
    expect_error(E_IMPORT_NOT_FOUND, "there is no file `nowhere.plan`");
    put("top/main.plan", "use \"\"\n");
    expect_error(E_CANNOT_READ, "cannot read");
}

/* A circle is found through whatever path leads round. */
static void circles(void **state)
{
    (void)state;
    put("top/main.plan", "use \"inner/a.plan\"\n");
    put("top/inner/a.plan", "use \"../inner/../b.plan\"\n");
    put("top/b.plan", "use \"inner/a.plan\"\n");
    expect_error(E_IMPORT_CYCLE, "a.plan uses ");
}

static void too_many_files(void **state)
{
    (void)state;
    for (int i = 0; i < 300; i++) {
        char name[40], text[60];
        snprintf(name, sizeof name, "top/f%d.plan", i);
        snprintf(text, sizeof text, "use \"f%d.plan\"\n", i + 1);
        put(name, text);
    }
    put("top/f300.plan", "");
    put("top/main.plan", "use \"f0.plan\"\n");
    expect_error(E_TOO_MANY, "the limit of 256 files");
}

/* A path of a text in memory is where its relative imports start. */
static void from_memory(void **state)
{
    (void)state;
    char path[100];
    put("top/near.plan", SCHEMA);
    snprintf(path, sizeof path, "%s/top/not-there.plan", folder);
    static const char text[] = "use \"near.plan\"\nrule a = tray(4')\n";
    tn_compilation c;
    assert_int_equal(compile_text(path, text, strlen(text), &(library_folders){0}, &c), TN_OK);
    tn_compilation_clear(&c);
}

/* What was found stays as it was read, until one begins anew. */
static void texts_are_kept(void **state)
{
    (void)state;
    char lib[100], user[100];
    snprintf(lib, sizeof lib, "%s/lib", folder);
    snprintf(user, sizeof user, "%s/top/main.plan", folder);
    char *dirs[] = {lib};
    tn_stdlib_dirs found = {dirs, 1};
    for (int round = 0; round < 2; round++) {
        tn_files files;
        tn_input first, second;
        char meant[TN_MEANT_SIZE] = "";
        tn_error error;
        tn_files_begin(&files, &found);
        tn_resolver resolver = tn_files_resolver(&files);
        tn_request request = {"kept", ".plan", user};
        put("lib/kept.plan", round ? "# later\n" : "# early\n");
        assert_int_equal(resolver.resolve(resolver.context, &request, &first, meant, &error), TN_OK);
        put("lib/kept.plan", "# changed\n");
        assert_int_equal(resolver.resolve(resolver.context, &request, &second, meant, &error), TN_OK);
        assert_ptr_equal(first.text, second.text);
        assert_memory_equal(first.text, round ? "# later\n" : "# early\n", 8);
        assert_string_equal(first.recorded, "<stdlib>/kept.plan");
        request.path = "ketp";
        assert_int_equal(resolver.resolve(resolver.context, &request, &second, meant, &error), TN_INVALID);
        assert_string_equal(meant, "kept");
        assert_string_equal(error.help, "did you mean `kept`?");
        tn_files_clear(&files);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(diamond, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(recorded_paths, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(bare_names_are_the_library, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(circles, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(too_many_files, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(from_memory, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(texts_are_kept, make_folder, remove_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
