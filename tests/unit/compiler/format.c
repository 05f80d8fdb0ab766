/* Formatting changes nothing but the layout: on every rule file of this repository, and on what fuzzing found worth
 * keeping. */
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "compiler/common/layout.h"
#include "compiler/format.h"
#include "runtime/base/file.h"
#include "runtime/load.h"
#include "runtime/module/code.h"
#include "runtime/module/module.h"
#include "runtime/module/records.h"
#include "tests/support/compile_file.h"

static const char *const stdlib_dirs[] = {TARTAN_SOURCE_DIR "/stdlib"};

/* NULL where it has errors. */
static char *formatted(const char *path, const char *text, size_t size)
{
    tn_sources sources = {0};
    tn_diagnostics diagnostics;
    char *result;
    size_t result_size;
    tn_diagnostics_init(&diagnostics, &sources);
    tn_status status =
        tn_format_text(&diagnostics, tn_notation_or_first(path, text, size), path, text, size, &result, &result_size);
    assert_true(status == TN_OK || status == TN_INVALID || status == TN_LIMIT);
    assert_int_equal(status == TN_OK, result != NULL);
    assert_int_equal(status == TN_OK, diagnostics.error_count == 0);
    if (result)
        assert_int_equal(strlen(result), result_size);
    tn_diagnostics_clear(&diagnostics);
    tn_sources_clear(&sources);
    return result;
}

static tn_module *compiled(const char *path, const char *text, size_t size)
{
    library_folders options = {.stdlib_dirs = stdlib_dirs, .stdlib_dir_count = 1};
    tn_compilation compilation;
    tn_module *module = NULL;
    tn_error error;
    if (compile_text(path, text, size, &options, &compilation) == TN_OK)
        assert_int_equal(tn_module_load(compilation.module, compilation.module_size, NULL, &module, &error), TN_OK);
    tn_compilation_clear(&compilation);
    return module;
}

/* Names made from a clause's line, as `prune@12`, are compared up to the line. */
static bool same_text(const char *a, const char *b)
{
    size_t size = strcspn(a, "@");
    return strcspn(b, "@") == size && memcmp(a, b, size) == 0 && a[size] == b[size];
}

/* A field that is neither a place nor a source, nor a hash of it. */
static void assert_same_fields(const tn_module *a, const tn_module *b, const void *one, const void *other,
                               const tn_member *member)
{
    switch (member->kind) {
    case TN_MEMBER_FILE:
    case TN_MEMBER_BEGIN:
    case TN_MEMBER_END:
        return;
    case TN_MEMBER_REAL:
        assert_true(tn_member_real(one, member) == tn_member_real(other, member));
        return;
    case TN_MEMBER_TEXT:
        if (strcmp(member->name, "text") != 0)
            assert_true(same_text(tn_text(a, (tn_string)tn_member_whole(one, member)),
                                  tn_text(b, (tn_string)tn_member_whole(other, member))));
        return;
    default:
        if (strcmp(member->name, "sources_hash") != 0)
            assert_int_equal(tn_member_whole(one, member), tn_member_whole(other, member));
    }
}

/* Texts are compared, not their offsets, which lie behind the sources. */
static void assert_same_code(const tn_module *a, const tn_module *b)
{
    assert_int_equal(a->code_size, b->code_size);
    for (uint32_t at = 0; at < a->code_size;) {
        tn_instruction x = tn_code_read(a->code, at), y = tn_code_read(b->code, at);
        assert_int_equal(x.opcode, y.opcode);
        if (tn_operand_slots[tn_opcode_describe((uint8_t)x.opcode)->operands][0].kind == TN_SLOT_STRING)
            assert_string_equal(tn_text(a, (tn_string)x.first), tn_text(b, (tn_string)y.first));
        else
            assert_int_equal(x.first, y.first);
        assert_int_equal(x.second, y.second);
        at += x.length;
    }
}

/* Everything but the sources and the places in them. */
static void assert_same_modules(const tn_module *a, const tn_module *b)
{
    assert_same_code(a, b);
    for (tn_section section = TN_SECTION_CODE + 1; section < TN_SECTION_COUNT; section++) {
        tn_section_info info = tn_section_describe(section);
        const char *one = a->tables[section].records, *other = b->tables[section].records;
        if (section == TN_SECTION_SOURCE_MAP)
            continue;
        assert_int_equal(a->tables[section].count, b->tables[section].count);
        for (size_t i = 0; i < a->tables[section].count; i++)
            for (size_t k = 0; k < info.members.count; k++)
                assert_same_fields(a, b, one + i * info.size, other + i * info.size, &info.members.items[k]);
    }
}

static size_t count_lines_longer(const char *text, size_t width)
{
    size_t count = 0;
    for (size_t size; *text; text += size + (text[size] == '\n')) {
        size = strcspn(text, "\n");
        count += size > width;
        assert_true(size == 0 || (text[size - 1] != ' ' && text[size - 1] != '\t'));
    }
    return count;
}

static size_t formatted_files, compiled_files;

static void check_text(const char *path, const char *text, size_t size)
{
    char *once = formatted(path, text, size);
    if (!once)
        return;
    char *twice = formatted(path, once, strlen(once));
    assert_non_null(twice);
    assert_string_equal(once, twice);
    formatted_files++;
    tn_module *before = compiled(path, text, size), *after = compiled(path, once, strlen(once));
    assert_int_equal(before != NULL, after != NULL);
    if (before) {
        assert_same_modules(before, after);
        compiled_files++;
    }
    tn_module_free(before);
    tn_module_free(after);
    free(once);
    free(twice);
}

/* `name`: what the text is called, or NULL. */
static void check_file(const char *path, const char *name)
{
    uint8_t *bytes;
    size_t size;
    tn_error error;
    assert_int_equal(tn_file_read(path, TN_SOURCE_BYTES_MAX, &bytes, &size, &error), TN_OK);
    check_text(name ? name : path, (const char *)bytes, size);
    free(bytes);
}

static void check_folder(const char *folder, const char *extension, const char *name)
{
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));) {
        char path[4096];
        struct stat status;
        size_t size = strlen(entry->d_name), end = strlen(extension);
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (entry->d_name[0] == '.' || stat(path, &status) != 0)
            continue;
        if (S_ISDIR(status.st_mode))
            check_folder(path, extension, name);
        else if (size >= end && strcmp(entry->d_name + size - end, extension) == 0)
            check_file(path, name);
    }
    closedir(directory);
}

static void test_rule_files(void **state)
{
    static const char *const folders[] = {"stdlib", "examples", "tests", "bench"};
    (void)state;
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
        char path[4096];
        snprintf(path, sizeof path, TARTAN_SOURCE_DIR "/%s", folders[i]);
        for (size_t n = 0; n < tn_notation_count; n++)
            if (tn_notation_is_main(&tn_notations[n]))
                check_folder(path, tn_notations[n].extension, NULL);
    }
    assert_true(formatted_files > 120);
    assert_true(compiled_files > 50);
}

static void test_fuzzed_files(void **state)
{
    (void)state;
    for (size_t i = 0; i < tn_notation_count; i++) {
        char path[4096], name[32];
        size_t before = formatted_files;
        snprintf(path, sizeof path, TARTAN_SOURCE_DIR "/tests/fuzz/corpus/%s", tn_notations[i].name);
        snprintf(name, sizeof name, "x%s", tn_notations[i].extension);
        check_folder(path, "", name);
        assert_true(formatted_files > before);
    }
}

static void assert_format_of(const char *path, const char *text, const char *wanted)
{
    char *once = formatted(path, text, strlen(text));
    assert_non_null(once);
    assert_string_equal(once, wanted);
    char *twice = formatted(path, once, strlen(once));
    assert_string_equal(twice, wanted);
    assert_int_equal(count_lines_longer(once, TN_FORMAT_WIDTH), 0);
    free(once);
    free(twice);
}

static void assert_format(const char *text, const char *wanted)
{
    assert_format_of("t.plan", text, wanted);
}

static void test_layout(void **state)
{
    (void)state;
    assert_format("", "");
    assert_format("USE \"lahave\"   # why\r\n\r\n\r\n\r\nuse\n\"b.plan\"", "use \"lahave\"  # why\n\nuse \"b.plan\"\n");
    assert_format("RULE a=Tray( 8' ,not  great )", "rule a = tray(8', not great)\n");
}

static void test_comments(void **state)
{
    (void)state;
    assert_format("# head\n\n\n# of a\nrule a \"t\" = # one\n# two\nany # three\nor  # four\n not any\n# end\n",
                  "# head\n\n# of a\nrule a \"t\" =  # one\n  # two\n  any  # three\n  or   # four\n"
                  "  not any\n# end\n");
    assert_format("library l {trays 1..2 # few\n # none\n\n prune a # the first\n,b}#end",
                  "library l {\n  trays 1..2  # few\n  # none\n\n  prune a,  # the first\n      b\n}  #end\n");
}

static void test_lengths_stay_apart(void **state)
{
    (void)state;
    assert_format("test a { match [4'\n6\"] }", "test a {\n  match [4'\n  6\"]\n}\n");
}

static void test_clauses_named_by_lines(void **state)
{
    (void)state;
    assert_format("schema s { w = 4' | 8' } library l { trays 1..2 prune tray(4') and tray(8') }\n\n\n"
                  "test l { drop [4' | 8'] by prune@1 }",
                  "schema s {\n  w = 4' | 8'\n}\n\nlibrary l {\n  trays 1..2\n  prune tray(4') and tray(8')\n}\n\n"
                  "test l {\n  drop [4' | 8'] by prune@7\n}\n");
}

static void test_tables(void **state)
{
    (void)state;
    assert_format("rule a=any rule b=any test a,b{match reject[4'] \"x\" todo  match match [8' | 4' ]\n}",
                  "rule a = any\nrule b = any\n\ntest a, b {\n  match reject [4']  \"x\"\n"
                  "  todo  match match [8' | 4']\n}\n");
}

static void test_hemls(void **state)
{
    (void)state;
    assert_format_of("t.hemls", "", "");
    assert_format_of("t.hemls",
                     "// seed\r\nA+B+A;;A->A[[+B]-B]A WEIGHT 3;-> A;  \tA<B>A->B IF i<-1 -> A\r\n\r\n\r\nangle 90",
                     "// seed\nA + B + A\nA -> A [ [ + B ] - B ] A Weight 3\n  -> A\n"
                     "A < B > A -> B If i < -1\n          -> A\n\nAngle 90\n");
    assert_format_of("t.hemls",
                     "Edge0+Edge1_i+1+Edge0\n\n\t// one\n// two\n\nEdge0 \xe2\x86\x92 Edge0//Edge0\n // three\n->Edge1",
                     "Edge0 + Edge1_i+1 + Edge0\n\n// one\n// two\n\nEdge0 \xe2\x86\x92 Edge0 / / Edge0\n"
                     "      // three\n      -> Edge1\n");
}

static void test_study(void **state)
{
    (void)state;
    assert_format_of("t.study",
                     "TITLE \"x\" rules#why\n\"square\" scale(1,2 , 3)\nattractor at 1 -22.5 3 strength 2\n"
                     "repeller at 0.25 1 1e3\n\n\n# end\n",
                     "title \"x\"\nrules  #why\n    \"square\"\nscale (1, 2, 3)\n"
                     "attractor at 1    -22.5 3   strength 2\nrepeller  at 0.25   1   1e3\n\n# end\n");
    assert_format_of("t.study",
                     "fitness size target 8 fitness symmetry weight 10 fitness raw\nfitness undulation target 2",
                     "fitness size target 8\nfitness symmetry weight 10\nfitness raw\nfitness undulation target 2\n");
    assert_format_of(
        "t.study",
        "boundary box from -100000.5 -100000.5 -100000.5 to 100000.25 100000.25 100000.25000000001 outside slide",
        "boundary box from -100000.5 -100000.5 -100000.5 to 100000.25 100000.25 100000.25000000001 outside\n"
        "    slide\n");
}

static void test_study_expressions(void **state)
{
    (void)state;
    assert_format_of(
        "t.study",
        "fitness slope=undulation/size target 0.2 weight 5 fitness over=max(0,-undulation - -2)*soft-boundary # why",
        "fitness slope = undulation / size target 0.2 weight 5\n"
        "fitness over = max(0, -undulation - -2) * soft-boundary  # why\n");
    assert_format_of(
        "t.study",
        "fitness long = undulation * undulation + size * size + soft-boundary * soft-boundary - smoothness * "
        "smoothness",
        "fitness long = undulation * undulation + size * size + soft-boundary * soft-boundary - smoothness\n"
        "    * smoothness\n");
}

static void test_evolution(void **state)
{
    (void)state;
    assert_format_of("t.study",
                     "# of\nSteps 3\nevolution{ grammar \"words\";;depth 2..8 # deep\n\n\n# what\nmatch \"x\";seed "
                     "-1\n#end\n}seed 2",
                     "# of\nsteps 3\n\nevolution {\n  grammar \"words\"\n  depth 2..8  # deep\n\n  # what\n"
                     "  match \"x\"\n  seed -1\n  #end\n}\n\nseed 2\n");
    assert_format_of("t.study",
                     "\xef\xbb\xbf"
                     "evolution {}",
                     "evolution {\n}\n");
}

static void test_bnf_sentences(void **state)
{
    (void)state;
    assert_format_of(
        "t.bnf", "some  text\n%max-depth\t 3 # why\n<a>::=  x y |<b>'|' \n\n<b>  ::= \"\"|  two\nlines \n  | it # c\n",
        "some  text\n%max-depth 3  # why\n\n<a> ::= x y | <b>'|'\n\n<b> ::= \"\"\n      | two\n        lines\n"
        "      | it  # c\n");
    assert_format_of("t.bnf", "<a> ::= one |  # after\n  two\n\t# own\n | three # c\n four | \t\n",
                     "<a> ::= one  # after\n      | two\n      # own\n      | three  # c\n        four\n      |\n");
    assert_format_of("t.bnf", "<a> ::= <b>\n\n\n::= c <d> ::= \\ \n", "<a> ::= <b>\n\n\n        ::= c\n<d> ::= \\\n");
}

static void test_bnf_tokens(void **state)
{
    (void)state;
    assert_format_of("t.bnf", "%dialect genr8\n<a> ::={ Edge  [ <b> ] } |   <b>\n::= # why\n | x#y",
                     "%dialect genr8\n\n<a> ::= { Edge [ <b> ] }\n      | <b>\n        ::=  # why\n      | x#y\n");
}

/* Comments, line ends and blanks at every place of a text: whatever comes of it is laid out, means the same, and has
 * its comments. */
static size_t count_marks(const char *text)
{
    size_t count = 0;
    for (; (text = strstr(text, "qq")); text++)
        count++;
    return count;
}

static void check_insertions(const char *path, const char *text, const char *const *pieces)
{
    size_t size = strlen(text);
    for (size_t at = 0; at <= size; at++)
        for (size_t i = 0; pieces[i]; i++) {
            char made[2000];
            int length = snprintf(made, sizeof made, "%.*s%s%s", (int)at, text, pieces[i], text + at);
            assert_true(length > 0 && (size_t)length < sizeof made);
            check_text(path, made, (size_t)length);
            char *once = formatted(path, made, (size_t)length);
            assert_true(!once || count_marks(once) == count_marks(made));
            free(once);
        }
}

static void test_insertions(void **state)
{
    static const char *const pieces[] = {"#qq\n", " # qq\n", "\n# qq\n",           "\r\n",         "\n\n\n", "\t",
                                         "  ",    ";",       " # qq\r\n\r\n#qq\n", "\xef\xbb\xbf", "\r",     "\f",
                                         "\v",    NULL};
    static const char *const hemls_pieces[] = {
        "\n// qq\n", "//qq\n", "\n\t//qq\r\n\n //qq\n", "\r\n", "\n\n\n", "\t", ";", " ", "\r", NULL};
    (void)state;
    size_t before = formatted_files;
    check_insertions(
        "t.plan",
        "schema s \"x\" { w = 4' | 8' zone bay = a(3') role void }\nrule r = symmetric neighbour(tray(4'), any) or\n"
        "not tray(8')\nlibrary l { trays 1..2 prune r, tray(4') as p }\ntest l { drop [4' | 8'] by p \"y\" }\n",
        pieces);
    check_insertions("t.hemls", "A + B + A\nA -> A [ + B ] A Weight 3\n-> B If i > -1;Angle 90\nB<A->B_i+1\nSync",
                     hemls_pieces);
    check_insertions(
        "t.study", "rules \"square\" scale (1, 2, 3)\nattractor at 1 2.5 3 strength 2\nrepeller at -1 2 3\nfitness raw",
        pieces);
    check_insertions("t.study", "seed 2\nevolution {\n  grammar \"words\"; match \"a\"\n  depth 2..3\n}\nsteps 3",
                     pieces);
    check_insertions("t.bnf", "%wraps 2\n<a> ::= x <b> y | '<' \"\" |\n  GE_RANGE:2\n  | \\n\n<b>::=<a>z\n | it\nis",
                     pieces);
    check_insertions(
        "t.bnf", "%dialect genr8\n%repair off\n<a> ::= { Edge [ <b> ] } | '|' |\n  x#y\n<b>::=EdgeX <a> |\n z", pieces);
    assert_true(formatted_files > before + 4000);
}

/* A grammar whose alternatives fit no line. */
static void test_long_rules(void **state)
{
    char text[4000] = "%dialect genr8\n<a> ::= ";
    (void)state;
    for (int i = 0; i < 60; i++)
        strcat(text, i % 7 ? "word { Edge x } " : "{ [ a b ] Edge } ");
    strcat(text, "{ ");
    for (int i = 0; i < 40; i++)
        strcat(text, "[ inner ] ");
    strcat(text, "} | b\n<n> ::= ");
    for (int i = 0; i < 100; i++)
        strcat(text, i ? "| 10 " : "10 ");
    check_text("t.bnf", text, strlen(text));
    char *once = formatted("t.bnf", text, strlen(text));
    assert_non_null(once);
    assert_int_equal(count_lines_longer(once, TN_FORMAT_WIDTH), 0);
    free(once);
}

static void test_errors_are_left_alone(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {{"t.hemls", "A -> $ A"},        {"t.hemls", "A ->"},
                                           {"t.study", "rules square"},    {"t.study", "title \"x"},
                                           {"t.study", "evolution { ) }"}, {"t.bnf", "%wrap 2\n<a> ::= x"},
                                           {"t.bnf", "<a> ::= it's"},      {"t.bnf", "%dialect genr8\n<a> ::= { x"},
                                           {"t.bnf", "<a> ::= \xff"},      {"t.study", "evolution { \xff }"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_null(formatted(wrong[i][0], wrong[i][1], strlen(wrong[i][1])));
    assert_null(formatted("t.bnf", "<a> ::= x\0y", 11));
    assert_null(formatted("t.plan", "rule a = ", 9));
    assert_null(formatted("t.plan", "rule a = \xff", 10));
    enum { DEPTH = 3000 };
    static char deep[9 + 2 * DEPTH + 4];
    memcpy(deep, "rule a = ", 9);
    memset(deep + 9, '(', DEPTH);
    memcpy(deep + 9 + DEPTH, "any", 3);
    memset(deep + 9 + DEPTH + 3, ')', DEPTH);
    assert_null(formatted("t.plan", deep, 9 + 2 * DEPTH + 3));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rule_files),
        cmocka_unit_test(test_fuzzed_files),
        cmocka_unit_test(test_layout),
        cmocka_unit_test(test_comments),
        cmocka_unit_test(test_lengths_stay_apart),
        cmocka_unit_test(test_clauses_named_by_lines),
        cmocka_unit_test(test_tables),
        cmocka_unit_test(test_hemls),
        cmocka_unit_test(test_study),
        cmocka_unit_test(test_study_expressions),
        cmocka_unit_test(test_evolution),
        cmocka_unit_test(test_bnf_sentences),
        cmocka_unit_test(test_bnf_tokens),
        cmocka_unit_test(test_insertions),
        cmocka_unit_test(test_long_rules),
        cmocka_unit_test(test_errors_are_left_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
