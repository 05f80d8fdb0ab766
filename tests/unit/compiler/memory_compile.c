/* Out of memory while compiling and while making a module ready to run: each allocation fails once, and then once
 * together with all after it. Nothing may crash, leak or pretend to have worked. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/load.h"
#include "runtime/module/module.h"
#include "runtime/plan/match/rules.h"
#include "tests/support/compile_file.h"
#include "tests/support/failing_memory.h"

static const char *const stdlib_dir = TARTAN_SOURCE_DIR "/stdlib";
static const library_folders options = {.stdlib_dirs = &stdlib_dir, .stdlib_dir_count = 1};

static const char *const good = "use \"lahave\"\n"
                                "rule a \"a rule\" = neighbour(tray(4'), optional(many(tray(8'))), tray(12'))\n"
                                "rule b = not a and quantity(tray(double), n > 1 or n mod 3 = 1)\n"
                                "rule c = distance(from tray(4'), to tray(public), by sum(width, w >= 8'))\n"
                                "library l using lahave { trays 2..5 total width 8'..48' require b prune a, c\n"
                                "  prefer a worth 2, tray(4') beside tray(8') as near weight tray(great) 3 }\n"
                                "test a { match [4' | 12'] reject [8'] \"no\" }\n"
                                "test l { keep [4' | 8' double | 8' double] }\n";

static const char *const bad = "use \"nowhere\"\n"
                               "schema s { width = 4' | 48\" colour = red | red }\n"
                               "rule a = neighbour(tray(5'), end, traay(4'))\n"
                               "rule b = quantity(tray(8', n > 1\n"
                               "library l using t { trays 4-9 }\n"
                               "\"open\n";

static const char *const params[] = {"side=right", "lot=10m"};
static const library_folders with_params = {.params = {params, 2}};

/* Compiles under a failing allocation; true where a module came out. */
static bool compile(const char *path, const char *text)
{
    tn_compilation compilation;
    const library_folders *how = strncmp(path, "params", strlen("params")) == 0 ? &with_params : &options;
    tn_status status = compile_text(path, text, strlen(text), how, &compilation);
    assert_int_equal(status == TN_OK, compilation.module != NULL);
    char *shown = NULL;
    size_t size;
    FILE *out = open_memstream(&shown, &size);
    tn_diagnostics_sort(&compilation.diagnostics);
    tn_diagnostics_show(&compilation.diagnostics, &(tn_show_options){0}, out);
    fclose(out);
    if (status != TN_OK)
        assert_true(size > 0); /* somebody says why */
    free(shown);
    tn_compilation_clear(&compilation);
    return status == TN_OK;
}

static void compile_with_failures(const char *path, const char *text, bool is_good)
{
    assert_int_equal(compile(path, text), is_good);
    for (int all_after = 0; all_after < 2; all_after++) {
        for (size_t number = 0;; number++) {
            fail_allocation(number, all_after);
            bool worked = compile(path, text);
            if (stop_failing() <= number) {
                assert_int_equal(worked, is_good);
                assert_true(number > 10); /* it allocates, or the test tests nothing */
                break;
            }
            assert_true(is_good || !worked);
        }
    }
}

/* What is said of single trays, in a schema of few combinations and in one of many. */
static void test_trays(void **state)
{
    (void)state;
    static const char few[] =
        "schema s { w = 1m | 2m | 3m  h = one < two  zone z = full(1m, 2m) | none\n"
        "  number n = 2 where tray(w > 2 * z) | 1 where tray(h * 1m < w) | 0\n"
        "  only tray(z none) or tray(w / z >= 1, z not none)  forbid not tray(n > h) and tray(one, 3m) }\n"
        "rule r = tray(w + z > 2 * w - 1m, n >= 1, not h * 1m > z)\n"
        "library l { trays 1..2 prune r }\n";
    static const char many[] = "schema s { a = flag b = flag c = flag d = flag e = flag f = flag g = flag h = flag i = "
                               "flag j = flag k = flag\n"
                               "  l = flag m = flag n = flag o = flag p = flag q = flag r = flag s = flag t = flag\n"
                               "  number u = 2 where tray(a) | 1 where tray(b) | 0 where tray(not a)\n"
                               "  only tray(c, d, e, f, g, h, i, j, k, l, m, n, o, p, q) and tray(r) }\n"
                               "rule x = every tray(a, s) beside tray(b, t) and max(u) >= 1\n"
                               "library y { trays 1..2 require x }\n";
    static const char wrong[] = "schema s { w = 1m | 2m  zone z = full(1m) | none  only tray(w / z > 1) }\n"
                                "schema t { w = 1m | 2m  only tray(w > 3m - w) and not tray(2m) }\n"
                                "schema u { w = 1m  only r  forbid quantity(any) > 1 }\nrule r = tray(w > )\n";
    compile_with_failures("few.plan", few, true);
    compile_with_failures("many.plan", many, true);
    compile_with_failures("wrong.plan", wrong, false);
}

static void test_good_source(void **state)
{
    (void)state;
    compile_with_failures("a.plan", good, true);
}

static void test_bad_source(void **state)
{
    (void)state;
    compile_with_failures("a.plan", bad, false);
}

static void test_schema_made_from_another(void **state)
{
    static const char newer[] =
        "schema old { w = 1m | 2m  use = room | store  zone z = full(1m) | none  forbid tray(store, 2m)\n"
        "  number k = 1 where tray(room) | 0 }\n"
        "let rooms = room or store\n"
        "rule beside(a, b) using old = symmetric neighbour(a, b)\n"
        "rule far using old = beside(tray(rooms), tray(2m)) or some v in w (quantity(tray(v), n > 1))\n"
        "measure floor using old = sum(w * z)\n"
        "library l using old { trays 2 total w <= 3m prune far require sum(k) >= 1 }\n"
        "schema new from old { use = ... | lab  w = ... | 3m  zone z = ... | full(2m) | wet(1m)  lit = flag }\n"
        "library m using new from l { prune beside(tray(lab), tray(lit)) require floor <= 9m2 }\n";
    static const char wrong[] = "schema a from b { w = ... | 3m }\nschema b from a { }\n"
                                "schema c { w = 1m }\nschema d from c { v = ... | 2m  w = ... | 1m  w = 3m }\n";
    (void)state;
    compile_with_failures("a.plan", newer, true);
    compile_with_failures("b.plan", wrong, false);
}

static void test_params(void **state)
{
    static const char rules[] =
        "schema s { w = 1m | 2m  use = a | b }\n"
        "param lot \"the lot\" = 12m in 9m..20m\nparam side = left | right\nparam kind = a | b\nlet half = lot / 2\n"
        "rule wide = sum(w) > lot or sum(w, x > half)\n"
        "rule right = side = right and tray(kind) or not side != left and wide\n"
        "library l { trays 1..3 prune wide require side = left implies right }\n"
        "test wide, right with lot = 9m, side = left { match reject [2m | 2m] }\n";
    static const char wrong[] = "schema s { w = 1m | lot }\nparam lot = 12m in 14m..10m\nparam side = left | left\n"
                                "param low = 3 in 4..5\nparam none = other\nrule a = side\nrule b = side = rigth\n"
                                "test a with lost = 3, low = 3m, side = up, side = left { match [1m] }\n";
    (void)state;
    compile_with_failures("params.plan", rules, true);
    compile_with_failures("params-wrong.plan", wrong, false);
}

static void test_other_notations(void **state)
{
    (void)state;
    compile_with_failures("a.hemls", "A + B + A + B\nA -> A [ + B ] A Weight 2\n -> A\nAngle 90\nBranchAngle 90\n",
                          true);
    compile_with_failures("b.hemls", "A + A + A\nA = A\nAgnle 60\n", false);
    compile_with_failures("a.study", "rules \"square\"\nsteps 3\nattractor at 1 2 3\nfitness size target 3\n", true);
    compile_with_failures("b.study", "rules \"square\"\nstpes 3\n", false);
    compile_with_failures(
        "a.kit",
        "unit 10 x 8 x 10;\nconnector a joins a every 20;\npart p { fill 40 x 8 x 20; a up 2 x 1; a down; }\n"
        "rule r at a = p | {p, p at (0, 8, 0)} | (p [1]);\n"
        "model m { inside box(80, 80, 80); start a at (0, 0, 0) by r; require count(p) > 1; }\n",
        true);
    compile_with_failures(
        "b.kit", "unit 10 x 8 x 10;\nconnector a joins b;\npart p { fill 4 x 8 x 9; c up; }\nrule r at a = q;\n",
        false);
    compile_with_failures(
        "a.solid",
        "solid one { symmetry x; box b at (1, 1, 1) size (1, 2, 1) clip normal (1, 1, 0) through (1, 1, "
        "0); measure volume  / area, parts; require parts = 1; fitness volume target 3; }\n"
        "solid two from one { genes (0, 0, 0, 1, 1, 1, 0, 0, 0) rigid; measure volume; }\n",
        true);
    compile_with_failures("a.field", "let r = 2\nfn f(a) = a*a\nsurface s = f(x) + f(y) at (x, z, y) - r\ngrid 9\n",
                          true);
    compile_with_failures("a.bnf", "<e> ::= <e> + <v> | <v>\n<v> ::= x | y\n", true);
    compile_with_failures("b.bnf", "%dialct ge\n<e> ::= <f>\n", false);
    compile_with_failures("c.study", "evolution { grammar \"words\"; match \"hello\"; population 20 }\n", true);
    compile_with_failures("d.study", "evolution { grammar \"words\"; match \"hello\"; popultion 20 }\n", false);
}

/* ---- from memory alone */

static tn_status resolve(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    static const char text[] = "schema s { width = 4' | 8' }\nrule low = tray(4')\n";
    (void)context, (void)meant;
    if (strcmp(request->path, "base") != 0)
        return tn_fail(error, TN_INVALID, E_IMPORT_NOT_FOUND, "there is no `%s`", request->path);
    *found = (tn_input){.text = text, .size = sizeof text - 1, .name = "base", .recorded = "<base>"};
    return TN_OK;
}

static void test_resolved_source(void **state)
{
    static const char *const texts[] = {"use \"base\"\nrule a = not low\n", "use \"base\"\nuse \"bsae\"\n"};
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        tn_input input = {.text = texts[i], .size = strlen(texts[i]), .name = "a text"};
        tn_compile_options how = {.resolver = {resolve, NULL}};
        bool failing = true;
        for (size_t number = 0; failing; number++) {
            tn_compilation compilation;
            fail_allocation(number, true);
            tn_status status = tn_compile_text(TN_NOTATION(plan), &input, &how, &compilation);
            failing = stop_failing() > number;
            assert_int_equal(status, failing ? TN_MEMORY : i == 0 ? TN_OK : TN_INVALID);
            assert_int_equal(status == TN_OK, compilation.module != NULL);
            tn_compilation_clear(&compilation);
        }
    }
}

/* ---- running */

static tn_status match(const tn_module *module, tn_matching_engine engine, uint64_t *bits)
{
    static const tn_tray trays[] = {0, 5, 9, 3};
    tn_schema *schema = NULL;
    tn_rules *rules = NULL;
    tn_matcher *matcher = NULL;
    uint32_t functions[8];
    size_t count = 0;
    for (size_t i = 0; i < module->RULE_count && count < 8; i++)
        if (!(module->RULE_records[i].flags & TN_IMPORTED))
            functions[count++] = module->RULE_records[i].holds;
    tn_rules_options how = {.engine = engine};
    tn_error error = {0};
    tn_status status = tn_schema_new(module, 0, 0, &schema, &error);
    if (status == TN_OK)
        status = tn_rules_new(schema, functions, count, &how, &rules, &error);
    if (status == TN_OK)
        status = tn_matcher_new(rules, &matcher, &error);
    if (status == TN_OK)
        status = tn_match(matcher, trays, 4, bits, &error);
    tn_matcher_free(matcher);
    tn_rules_free(rules);
    tn_schema_free(schema);
    return status;
}

static void match_with_failures(tn_matching_engine engine)
{
    tn_compilation compilation;
    tn_module *module;
    assert_int_equal(compile_text("a.plan", good, strlen(good), &options, &compilation), TN_OK);
    assert_int_equal(tn_module_load(compilation.module, compilation.module_size, NULL, &module, NULL), TN_OK);
    uint64_t wanted = 0;
    assert_int_equal(match(module, engine, &wanted), TN_OK);
    for (int all_after = 0; all_after < 2; all_after++) {
        for (size_t number = 0;; number++) {
            uint64_t bits = 0;
            fail_allocation(number, all_after);
            tn_status status = match(module, engine, &bits);
            bool reached = stop_failing() > number;
            if (status == TN_OK) /* an engine may do with less; what it decides stays the same */
                assert_int_equal(bits, wanted);
            else
                assert_int_equal(status, TN_MEMORY);
            if (!reached) {
                assert_int_equal(status, TN_OK);
                break;
            }
        }
    }
    tn_module_free(module);
    tn_compilation_clear(&compilation);
}

static void test_reference_engine(void **state)
{
    (void)state;
    match_with_failures(TN_ENGINE_VM);
}

static void test_automata(void **state)
{
    (void)state;
    match_with_failures(TN_ENGINE_DFA);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_good_source),     cmocka_unit_test(test_trays),
        cmocka_unit_test(test_bad_source),      cmocka_unit_test(test_schema_made_from_another),
        cmocka_unit_test(test_params),          cmocka_unit_test(test_other_notations),
        cmocka_unit_test(test_resolved_source), cmocka_unit_test(test_reference_engine),
        cmocka_unit_test(test_automata),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
