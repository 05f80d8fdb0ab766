/* Runs test blocks by both engines, and says why cases fail. */
#include "driver/plan/tests.h"

#include <stdlib.h>
#include <string.h>

#include "compiler/plan/syntax/program.h"
#include "driver/house/tests.h"
#include "driver/open/open.h"
#include "driver/plan/explain.h"
#include "driver/plan/library.h"
#include "runtime/plan/match/vm.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/named.h"
#include "runtime/plan/text/text.h"

typedef struct tn_with {
    size_t test; /* the number of the test that it is opened for; 0: of none */
    tn_opened opened;
} tn_with;

static void with_said(tn_with *with, tn_opened *opened, const tn_test_block *block);
static void with_clear(tn_with *with);

/* ---- does a case come out? */

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
    case TN_EXPECT_VALUE: /* tn_value_test */
        break;
    }
    for (size_t i = 0; i < test->by_count; i++)
        if (!is_reason(module, library, test, test->by[i], bits))
            return false;
    return is_dropped(module, library, test, bits);
}

/* ---- test cases of measures */

tn_status tn_value_tests_new(tn_value_tests *values, tn_opened *opened, const tn_test_block *tests, tn_error *error)
{
    size_t longest = 0;
    *values = (tn_value_tests){.opened = opened, .tests = tests};
    for (size_t i = 0; i < tests->case_count; i++)
        longest = tests->cases[i].length > longest ? tests->cases[i].length : longest;
    values->trays = malloc(sizeof *values->trays * (longest + 1));
    if (!values->trays)
        return tn_fail_memory(error);
    tn_status status = tn_schema_new(opened->module, tests->schema, 0, &values->schema, error);
    return status == TN_OK ? tn_plan_vm_new(values->schema, longest, &values->vm, error) : status;
}

void tn_value_tests_clear(tn_value_tests *values)
{
    tn_plan_vm_free(values->vm);
    tn_schema_free(values->schema);
    free(values->trays);
    *values = (tn_value_tests){0};
}

/* value: NULL where there is none. */
static const char *report(const tn_value_tests *values, const tn_test_case *test, mpq_srcptr value, const mpq_t wanted)
{
    const tn_measure_record *measure = &values->opened->module->MEASURE_records[values->tests->index];
    tn_amount_unit unit =
        tn_amount_unit_of(values->schema, tn_named_measure_power(values->opened->module, values->tests->index));
    tn_diagnostics *list = &values->opened->compilation.diagnostics;
    tn_buffer is = {0}, should = {0}, plan = {0};
    if (value)
        tn_amount_write(unit, value, &is);
    tn_amount_write(unit, wanted, &should);
    tn_diagnostic *d =
        tn_report(list, E_TEST_FAILED, test->span, "`%s` is %s for this plan, not %s", values->tests->subject,
                  is.data ? is.data : "nothing", should.data ? should.data : "?");
    if (test->doc)
        tn_note(list, d, NULL, "expected because: %s", test->doc);
    if (tn_plan_write_line(values->schema, values->trays, test->length, &plan))
        tn_note(list, d, NULL, "plan: %s", plan.data ? plan.data : "");
    tn_span place = {measure->file, measure->begin, measure->end};
    tn_note(list, d, &place, "`%s`", values->tests->subject);
    free(is.data);
    free(should.data);
    free(plan.data);
    return d->message;
}

tn_status tn_value_test(tn_value_tests *values, size_t i, bool *good, const char **message, tn_error *error)
{
    *message = NULL;
    const tn_test_case *test = &values->tests->cases[i];
    bool has = false;
    for (size_t k = 0; k < test->length; k++)
        values->trays[k] = tn_schema_tray(values->schema, test->values + k * values->schema->field_count);
    mpq_t value, wanted;
    mpq_inits(value, wanted, NULL);
    tn_status status = tn_plan_vm_plan(values->vm, values->trays, test->length, error);
    if (status == TN_OK)
        status = tn_plan_vm_measure(values->vm, values->tests->index, value, &has, error);
    if (status == TN_OK) {
        mpq_set_str(wanted, test->value, 10);
        *good = has && mpq_equal(value, wanted);
        if (!*good && !test->todo)
            *message = report(values, test, has ? value : NULL, wanted);
    }
    mpq_clears(value, wanted, NULL);
    return status;
}

/* ---- the file as it is for the cases of a test that gives params values: compiled once more, with these
 *
 * It borrows the file and is kept from one block of the same test to the next. Clear it in any case, before the file is
 * closed. */

/* Warnings are about the file as it is. */
static void forget_warnings(tn_opened *opened)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_diagnostics_clear(list);
    tn_diagnostics_init(list, &opened->compilation.sources);
}

/* Opens it for the block, unless it is. What does not compile so is said in the diagnostics of the file, TN_INVALID. */
static tn_status with_open(tn_with *with, tn_opened *opened, const tn_test_block *block, tn_error *error)
{
    if (with->test == block->with)
        return TN_OK;
    with_clear(with);
    with->test = block->with;
    tn_status status = tn_open_again(opened, NULL, NULL, block->with, &with->opened);
    if (status == TN_OK) {
        with->opened.module->watch = opened->module->watch;
        forget_warnings(&with->opened);
    } else if (status == TN_INVALID) {
        tn_diagnostics_keep_errors(&with->opened.compilation.diagnostics);
        with_said(with, opened, block);
        with_clear(with);
    } else {
        status = tn_open_error(&with->opened, status, error);
        with_clear(with);
    }
    return status;
}

/* Moves what was said since to the diagnostics of the file, with a note of the values. */
static void with_said(tn_with *with, tn_opened *opened, const tn_test_block *block)
{
    tn_diagnostics *list = &with->opened.compilation.diagnostics;
    for (size_t i = 0; i < list->count; i++)
        tn_note(list, &list->items[i], &block->settings, "with these values");
    tn_diagnostics_move(list, &opened->compilation.diagnostics, 0);
}

static void with_clear(tn_with *with)
{
    if (with->test)
        tn_close(&with->opened);
    *with = (tn_with){0};
}

/* ---- running blocks by both engines */

#define EXPLAINED_LINES 12 /* of one rule, in a failure */

/* One engine's rules and matcher, and what they said of the plan at hand. */
typedef struct engine {
    tn_rules *rules;
    tn_matcher *matcher;
    uint64_t *bits;
} engine;

/* A test block being run. */
typedef struct block {
    tn_opened *opened;
    const tn_module *module;
    const tn_test_block *tests;
    const tn_test_block *shown;       /* the same as the file itself has it: to whoever looks on */
    const tn_library_record *library; /* or NULL: a rule */
    size_t rule_count;
    tn_schema *schema;
    engine automata, interpreter;
    tn_tray *trays; /* room for the longest plan */
} block;

static tn_status engine_new(const block *b, tn_matching_engine which, uint32_t max_states, engine *made,
                            tn_error *error)
{
    tn_rules_options options = {.engine = which, .max_states = max_states};
    tn_status status;
    if (b->library)
        status = tn_clause_rules_new(b->schema, b->library, &options, &made->rules, error);
    else
        status =
            tn_rules_new(b->schema, &b->module->RULE_records[b->tests->index].holds, 1, &options, &made->rules, error);
    if (status == TN_OK)
        status = tn_matcher_new(made->rules, &made->matcher, error);
    if (status != TN_OK)
        return status;
    made->bits = calloc(b->rule_count / 64 + 1, sizeof *made->bits);
    return made->bits ? TN_OK : tn_fail_memory(error);
}

static void engine_free(engine *made)
{
    tn_matcher_free(made->matcher);
    tn_rules_free(made->rules);
    free(made->bits);
}

static tn_status block_new(block *b, uint32_t max_states, tn_error *error)
{
    size_t longest = 0;
    for (size_t i = 0; i < b->tests->case_count; i++)
        longest = b->tests->cases[i].length > longest ? b->tests->cases[i].length : longest;
    b->library = b->tests->is_library ? &b->module->LIBRARY_records[b->tests->index] : NULL;
    b->rule_count = b->library ? b->library->clause_count : 1;
    b->trays = malloc(sizeof *b->trays * (longest + 1));
    tn_status status =
        b->trays ? tn_schema_new(b->module, b->tests->schema, 0, &b->schema, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = engine_new(b, TN_ENGINE_VM, max_states, &b->interpreter, error);
    if (status == TN_OK)
        status = engine_new(b, TN_ENGINE_AUTO, max_states, &b->automata, error);
    return status;
}

static void block_free(block *b)
{
    engine_free(&b->interpreter);
    engine_free(&b->automata);
    tn_schema_free(b->schema);
    free(b->trays);
}

static const char *rule_name(const block *b, size_t i)
{
    return b->library ? tn_text(b->module, b->module->CLAUSE_records[b->library->clause_first + i].name)
                      : b->tests->subject;
}

/* Both engines on one case; a difference is a fault of ours. */
static tn_status match(block *b, const tn_test_case *test, tn_error *error)
{
    for (size_t i = 0; i < test->length; i++) {
        b->trays[i] = tn_schema_tray(b->schema, test->values + i * b->schema->field_count);
        if (b->trays[i] == TN_NO_TRAY)
            return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a test of `%.80s` holds a forbidden tray",
                           b->tests->subject);
    }
    tn_status status = tn_match(b->interpreter.matcher, b->trays, test->length, b->interpreter.bits, error);
    if (status == TN_OK)
        status = tn_match(b->automata.matcher, b->trays, test->length, b->automata.bits, error);
    for (size_t i = 0; status == TN_OK && i < b->rule_count; i++)
        if ((b->interpreter.bits[i / 64] ^ b->automata.bits[i / 64]) >> (i % 64) & 1)
            status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE,
                             "the two engines disagree about `%.80s`; please report this with the rule file",
                             rule_name(b, i));
    return status;
}

/* The names of all that drop the plan: "dense-end, narrow-pair". */
static void write_reasons(const block *b, const tn_test_case *test, tn_buffer *out)
{
    if (tn_length_drops(b->library, test))
        tn_buffer_printf(out, "trays");
    for (size_t i = 0; i < b->rule_count; i++)
        if (tn_clause_drops(b->module, b->library, i, b->interpreter.bits))
            tn_buffer_printf(out, "%s%s", out->size ? ", " : "", rule_name(b, i));
}

static void write_expectation(const block *b, const tn_test_case *test, tn_buffer *out)
{
    tn_buffer reasons = {0};
    const char *name = b->tests->subject;
    if (b->library)
        write_reasons(b, test, &reasons);
    if (test->expectation == TN_EXPECT_MATCH)
        tn_buffer_printf(out, "`%s` should match this plan, and does not", name);
    else if (test->expectation == TN_EXPECT_REJECT)
        tn_buffer_printf(out, "`%s` should not match this plan, and does", name);
    else if (test->expectation == TN_EXPECT_KEEP)
        tn_buffer_printf(out, "`%s` should keep this plan, and drops it by %s", name, reasons.data ? reasons.data : "");
    else if (reasons.size == 0)
        tn_buffer_printf(out, "`%s` should drop this plan, and keeps it", name);
    else
        tn_buffer_printf(out, "`%s` drops this plan, but by %s", name, reasons.data);
    free(reasons.data);
}

/* Where the rule or clause called `name` is written, and what its author says of it. */
static void note_place(const block *b, tn_diagnostic *diagnostic, const char *name, const char *doc, uint32_t file,
                       uint32_t begin, uint32_t end)
{
    tn_span span = {file, begin, end};
    bool known = file < b->opened->compilation.sources.count;
    tn_note(&b->opened->compilation.diagnostics, diagnostic, known ? &span : NULL, "`%s`%s%s", name, *doc ? ": " : "",
            doc);
}

/* The rule that a clause names, or NULL where it is an expression of its own. */
static const tn_rule_record *rule_of(const tn_module *module, const tn_clause_record *clause)
{
    for (size_t i = 0; i < module->RULE_count; i++)
        if (module->RULE_records[i].holds == clause->holds)
            return &module->RULE_records[i];
    return NULL;
}

static void note_rule(const block *b, const tn_test_case *test, tn_diagnostic *diagnostic)
{
    if (!b->library) {
        const tn_rule_record *rule = &b->module->RULE_records[b->tests->index];
        note_place(b, diagnostic, b->tests->subject, tn_text(b->module, rule->doc), rule->file, rule->begin, rule->end);
        return;
    }
    for (size_t i = 0; i < b->rule_count; i++) {
        const tn_clause_record *clause = &b->module->CLAUSE_records[b->library->clause_first + i];
        bool named = false;
        for (size_t k = 0; k < test->by_count; k++)
            named |= strcmp(test->by[k], rule_name(b, i)) == 0;
        if (!named && !tn_clause_drops(b->module, b->library, i, b->interpreter.bits))
            continue;
        const tn_rule_record *rule = rule_of(b->module, clause);
        if (rule)
            note_place(b, diagnostic, rule_name(b, i), tn_text(b->module, rule->doc), rule->file, rule->begin,
                       rule->end);
        else
            note_place(b, diagnostic, rule_name(b, i), tn_text(b->module, clause->doc), clause->file, clause->begin,
                       clause->end);
    }
}

/* The lines of one rule's explanation, each a note. */
static void note_lines(const block *b, tn_diagnostic *diagnostic, char *text)
{
    size_t lines = 0;
    for (char *line = text, *end; *line && lines < EXPLAINED_LINES; line = end, lines++) {
        end = line + strcspn(line, "\n");
        if (*end)
            *end++ = '\0';
        tn_note(&b->opened->compilation.diagnostics, diagnostic, NULL, "%s", line);
    }
}

/* Why it came out so: the rule, or the clauses that drop the plan, or those that were expected to and did not. */
static void note_why(const block *b, const tn_test_case *test, tn_diagnostic *diagnostic)
{
    tn_explained explained;
    tn_error error;
    tn_status status = tn_explained_make(&explained, b->opened, b->schema, b->library, &b->tests->index, 1, b->trays,
                                         test->length, test->length + 1, &error);
    for (size_t i = 0; status == TN_OK && i < explained.count; i++) {
        bool named = false;
        for (size_t k = 0; k < test->by_count; k++)
            named |= strcmp(test->by[k], explained.rules[i].name) == 0;
        if (b->library && !named && !explained.rules[i].drops)
            continue;
        tn_buffer text = {0};
        if (tn_explained_rule_text(&explained, &explained.rules[i], false, &text))
            note_lines(b, diagnostic, text.data);
        free(text.data);
    }
    tn_explained_clear(&explained);
}

/* A case marked `todo` that comes out: the mark has served. */
static const char *report_done(const block *b, const tn_test_case *test)
{
    tn_diagnostics *list = &b->opened->compilation.diagnostics;
    tn_diagnostic *d =
        tn_report(list, E_TEST_FAILED, test->span, "this test of `%s` is marked `todo` and passes", b->tests->subject);
    tn_help(list, d, "take `todo` away: it is done");
    return d->message;
}

static const char *report_failure(const block *b, const tn_test_case *test)
{
    tn_diagnostics *list = &b->opened->compilation.diagnostics;
    tn_buffer sentence = {0}, plan = {0};
    write_expectation(b, test, &sentence);
    tn_diagnostic *diagnostic =
        tn_report(list, E_TEST_FAILED, test->span, "%s", sentence.data ? sentence.data : "a test failed");
    if (test->doc)
        tn_note(list, diagnostic, NULL, "expected because: %s", test->doc);
    if (tn_plan_write_line(b->schema, b->trays, test->length, &plan))
        tn_note(list, diagnostic, NULL, "plan: %s", plan.data ? plan.data : "");
    note_rule(b, test, diagnostic);
    note_why(b, test, diagnostic);
    free(sentence.data);
    free(plan.data);
    return diagnostic->message;
}

/* Counts a case, and tells whoever looks on. message: why it failed, where that is reported already. */
static void count_case(const block *b, const tn_test_case *test, bool good, const char *message,
                       const tn_test_watcher *watcher, tn_test_counts *counts)
{
    tn_test_outcome outcome =
        good ? (test->todo ? TN_TEST_DONE : TN_TEST_PASSED) : (test->todo ? TN_TEST_TODO : TN_TEST_FAILED);
    counts->passed += outcome == TN_TEST_PASSED;
    counts->todo += outcome == TN_TEST_TODO;
    counts->failed += outcome == TN_TEST_FAILED || outcome == TN_TEST_DONE;
    if (outcome == TN_TEST_DONE)
        message = report_done(b, test);
    if (watcher)
        watcher->seen(watcher->context, b->shown, &b->shown->cases[test - b->tests->cases], outcome, message);
}

static tn_status run_block(block *b, uint32_t max_states, const tn_test_watcher *watcher, tn_test_counts *counts,
                           tn_error *error)
{
    tn_status status = block_new(b, max_states, error);
    for (size_t i = 0; status == TN_OK && i < b->tests->case_count; i++) {
        const tn_test_case *test = &b->tests->cases[i];
        status = tn_watch_check(b->module->watch, error);
        if (status == TN_OK)
            status = match(b, test, error);
        if (status != TN_OK)
            break;
        bool good = tn_case_comes_out(b->module, b->tests, test, b->interpreter.bits);
        count_case(b, test, good, good || test->todo ? NULL : report_failure(b, test), watcher, counts);
    }
    block_free(b);
    return status;
}

/* A measure's cases: each plan's value, found by the interpreter. */
static tn_status run_values(block *b, const tn_test_watcher *watcher, tn_test_counts *counts, tn_error *error)
{
    tn_value_tests values = {0};
    tn_status status = tn_value_tests_new(&values, b->opened, b->tests, error);
    for (size_t i = 0; status == TN_OK && i < b->tests->case_count; i++) {
        bool good;
        const char *message;
        status = tn_watch_check(b->module->watch, error);
        if (status == TN_OK)
            status = tn_value_test(&values, i, &good, &message, error);
        if (status == TN_OK)
            count_case(b, &b->tests->cases[i], good, message, watcher, counts);
    }
    tn_value_tests_clear(&values);
    return status;
}

static tn_status run_tests(block *b, uint32_t max_states, const tn_test_watcher *watcher, tn_test_counts *counts,
                           tn_error *error)
{
    if (b->tests->of_houses)
        return tn_house_tests_run(b->opened, b->tests, &counts->passed, &counts->failed, &counts->todo, error);
    return b->tests->is_measure ? run_values(b, watcher, counts, error)
                                : run_block(b, max_states, watcher, counts, error);
}

/* Block number i, in the file as it is, or with the values that it gives params. Failures are said. */
static tn_status run_in_turn(tn_opened *opened, size_t i, tn_with *with, uint32_t max_states,
                             const tn_test_watcher *watcher, tn_test_counts *counts)
{
    const tn_test_block *own = &opened->compilation.program->tests[i];
    block b = {.opened = opened, .module = opened->module, .tests = own, .shown = own};
    tn_error error = {0};
    if (own->with) {
        tn_status status = with_open(with, opened, own, &error);
        if (status == TN_INVALID) /* which is said */
            return status;
        if (status != TN_OK) {
            tn_finding_error(opened, &error);
            return status;
        }
        b.opened = &with->opened;
        b.module = b.opened->module;
        b.tests = &b.opened->compilation.program->tests[i];
    }
    tn_status status = run_tests(&b, max_states, watcher, counts, &error);
    if (status != TN_OK)
        tn_finding_error(b.opened, &error);
    if (own->with)
        with_said(with, opened, own);
    return status;
}

tn_status tn_tests_run(tn_opened *opened, uint32_t max_states, const tn_test_watcher *watcher, tn_test_counts *counts)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    if (!opened->compiled) {
        tn_diagnostic *none =
            tn_report_bare(list, TN_ERROR, E_NO_TESTS, "%s is a module, which holds no tests", opened->path);
        tn_help(list, none, "test the rule file that it was built from");
        return TN_INVALID;
    }
    const tn_program *program = opened->compilation.program;
    if (!program) { /* of a notation without tests */
        tn_diagnostic *none =
            tn_report_bare(list, TN_ERROR, E_NO_TESTS, "%s is no .plan file, and only those hold tests", opened->path);
        tn_help(list, none, "%s", tn_opened_help(opened, "test the rules that it is about").text);
        return TN_INVALID;
    }
    size_t failed = counts->failed;
    tn_with with = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < program->test_count; i++)
        if (!program->tests[i].imported)
            status = run_in_turn(opened, i, &with, max_states, watcher, counts);
    with_clear(&with);
    return status == TN_OK && counts->failed > failed ? TN_INVALID : status;
}

tn_status tn_tests_check(tn_opened *opened, tn_error *error)
{
    const tn_program *program = opened->compilation.program;
    tn_with with = {0};
    tn_status status = TN_OK;
    size_t seen = 0;
    for (size_t i = 0; program && status == TN_OK && i < program->test_count; i++) {
        const tn_test_block *own = &program->tests[i];
        if (own->imported || own->with <= seen)
            continue;
        seen = own->with;
        status = with_open(&with, opened, own, error);
        status = status == TN_INVALID ? TN_OK : status; /* which is said */
    }
    with_clear(&with);
    return status;
}
