/* Test blocks: what is expected of which plan. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/amount.h"
#include "compiler/plan/check/form.h"
#include "runtime/base/nearest.h"

static bool expectation_fits(tn_check *check, const tn_ast_word *word, const tn_checked_name *subject)
{
    tn_expectation expectation = (tn_expectation)word->value;
    bool measure = subject->rule && subject->rule->is_measure;
    if (measure || expectation == TN_EXPECT_VALUE) {
        if (measure && expectation == TN_EXPECT_VALUE)
            return true;
        tn_diagnostic *wrong =
            measure ? tn_report(check->diagnostics, E_WRONG_EXPECTATION, word->node.span,
                                "a measure has values, it matches nothing")
                    : tn_report(check->diagnostics, E_WRONG_EXPECTATION, word->node.span, "only a measure has values");
        tn_note(check->diagnostics, wrong, &subject->span, "the %s is here",
                subject->library ? "library"
                : measure        ? "measure"
                                 : "rule");
        tn_help(check->diagnostics, wrong, measure ? "write `value [%s] = NUMBER`" : "write what is expected of it: %s",
                measure            ? (subject->rule->form ? "HOUSE" : "PLAN")
                : subject->library ? "`keep` or `drop`"
                                   : "`match` or `reject`");
        return false;
    }
    bool for_library = expectation == TN_EXPECT_KEEP || expectation == TN_EXPECT_DROP;
    if (for_library == (subject->library != NULL))
        return true;
    static const char *const words[] = {[TN_EXPECT_MATCH] = "match",
                                        [TN_EXPECT_REJECT] = "reject",
                                        [TN_EXPECT_KEEP] = "keep",
                                        [TN_EXPECT_DROP] = "drop"};
    static const tn_expectation others[] = {[TN_EXPECT_MATCH] = TN_EXPECT_DROP,
                                            [TN_EXPECT_REJECT] = TN_EXPECT_KEEP,
                                            [TN_EXPECT_KEEP] = TN_EXPECT_REJECT,
                                            [TN_EXPECT_DROP] = TN_EXPECT_MATCH};
    tn_diagnostic *d = subject->library ? tn_report(check->diagnostics, E_WRONG_EXPECTATION, word->node.span,
                                                    "a library keeps plans or drops them, it does not match")
                                        : tn_report(check->diagnostics, E_WRONG_EXPECTATION, word->node.span,
                                                    "a rule matches plans or rejects them, it does not prune");
    tn_note(check->diagnostics, d, &subject->span, "the %s is here", subject->library ? "library" : "rule");
    tn_advise(check->diagnostics, d, "%s", words[others[expectation]]);
    return false;
}

static void report_clause(tn_check *check, const tn_checked_library *library, const tn_ast_word *word)
{
    const char **names = TN_NEW_ARRAY(check->arena, const char *, library->clause_count + 1);
    if (!names || check->skipped || check->incomplete)
        return;
    for (size_t i = 0; i < library->clause_count; i++)
        names[i] = library->clauses[i]->name;
    names[library->clause_count] = "trays";
    tn_diagnostic *d = tn_report(check->diagnostics, E_UNKNOWN_CLAUSE, word->node.span,
                                 "library `%s` has no clause `%s`", library->name, word->text);
    tn_note(check->diagnostics, d, &library->ast->name->node.span, "library `%s` is here", library->name);
    const char *near = tn_nearest(word->text, names, library->clause_count + 1);
    if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else
        tn_help(check->diagnostics, d,
                "name a rule that it prunes, `trays`, `total`, or `require@` and `prune@` with a line's number");
}

/* The names after `by`; NULL where one is wrong. */
static const char *const *check_by(tn_check *check, const tn_ast_case *ast, tn_expectation expectation,
                                   const tn_checked_name *subject)
{
    const char **names = TN_NEW_ARRAY(check->arena, const char *, ast->by.count);
    size_t count = 0;
    bool good = names != NULL;
    if (ast->by.count > 0 && expectation != TN_EXPECT_DROP) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_WRONG_EXPECTATION, ast->by.first->span, "`by` is for `drop` alone");
        tn_help(check->diagnostics, d, "leave `by` out, or write `drop`");
        return NULL;
    }
    for (TN_EACH(const tn_ast_word, word, ast->by)) {
        if (!names)
            return NULL;
        const tn_checked_library *library = subject->library;
        const tn_checked_clause *clause = tn_names_get(&library->clause_names, word->text);
        if (!clause && library->plans)
            clause = tn_names_get(&library->plans->clause_names, word->text);
        if (clause || tn_word_is(word, "trays")) {
            names[count++] = clause ? clause->name : "trays";
        } else {
            report_clause(check, subject->library, word);
            good = false;
        }
    }
    return good ? names : NULL;
}

/* What a case expects of the subject at `column`; NULL where it says nothing of that one. */
static const tn_ast_word *expectation_at(const tn_ast_case *ast, size_t column)
{
    const tn_ast_node *node = ast->expectations.first;
    while (node && column-- > 0)
        node = node->next;
    return (const tn_ast_word *)node;
}

/* What the measure has to be: a constant of its dimension. */
static bool check_value(tn_check *check, const tn_ast_case *ast, const tn_checked_rule *measure, tn_test_case *result)
{
    tn_ast_expr *value = ast->value;
    tn_expand(check, &value);
    size_t errors = check->diagnostics->error_count;
    tn_check_sum_expr(check, value);
    tn_checked_sum *sum = check->diagnostics->error_count == errors ? tn_check_sum(check, value) : NULL;
    if (!sum || !measure->sum)
        return false;
    tn_sum_amount wanted = {.value = sum->constant, .power = sum->power, .any = sum->any},
                  of = {.power = measure->sum->power}, both;
    if (sum->count > 0) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_RULE_OR_NUMBER, value->node.span, "a constant has to stand here");
        tn_help(check->diagnostics, d, "write the value that the plan has, such as `31000` or `96ft2`");
        return false;
    }
    result->value = sum->constant;
    return tn_same_power(check, of, measure->ast->name->node.span, wanted, value->node.span, "the value of", &both);
}

/* A house where a plan is wanted. */
static bool not_a_plan(tn_check *check, const tn_ast_case *ast)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_NOT_A_HOUSE, ast->node.span,
                                 "what is tested is about plans, and this is a house");
    tn_help(check->diagnostics, d, "write the plan alone, up to the first `;`");
    return false;
}

/* A choice that every plan leaves, whatever its trays are; NULL where none is known. What is forbidden may decide it.
 */
static const tn_checked_choice *choice_left(const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->rule_count; i++)
        if (form->rules[i].kind == TN_CELL_FORBID)
            return NULL;
    for (uint32_t i = 0; i < form->choice_count; i++)
        if (form->choices[i].zone == TN_NONE && form->choices[i].shape_count > 1)
            return &form->choices[i];
    return NULL;
}

static bool not_a_house(tn_check *check, const tn_ast_case *ast, const tn_checked_choice *choice)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_NOT_A_HOUSE, ast->node.span,
                                 "what is tested is about houses, and this is a plan");
    if (choice)
        tn_note(check->diagnostics, d, &choice->ast->node.span, "the plan does not say which `%s` the house has",
                choice->name);
    tn_help(check->diagnostics, d,
            "write the line of a house: `[plan ; section ; functions ; faces]`; parts at the end may be left out if "
            "they leave no choice");
    return false;
}

/* The line of a house. A plan is one, too, where it leaves no choice; that is found out when the test is run. */
static bool read_house(tn_check *check, const tn_ast_case *ast, const tn_checked_form *form, tn_test_case *result)
{
    const tn_ast_list *trays = &ast->literal.trays;
    const tn_ast_word *house = ast->literal.house;
    if (house) {
        result->house = house->text;
        result->house_place = house->node.span;
        return true;
    }
    const tn_checked_choice *choice = choice_left(form);
    if (choice || !trays->first)
        return not_a_house(check, ast, choice);
    size_t length;
    if (!check->schema || !tn_check_plan(check, check->schema, *trays, &length))
        return false;
    tn_span place = tn_span_join(trays->first->span, trays->last->span);
    char *line = tn_arena_copy(check->arena, check->diagnostics->sources->files[place.file].text + place.begin,
                               place.end - place.begin);
    for (char *c = line; c && *c; c++)
        *c = *c == '\n' || *c == '\r' ? ' ' : *c;
    result->house = line;
    result->house_place = place;
    result->plan_alone = true;
    return line != NULL;
}

static bool check_case(tn_check *check, const tn_ast_case *ast, size_t column, const tn_checked_name *subject,
                       tn_test_case *result)
{
    const tn_ast_word *word = expectation_at(ast, column);
    if (!word || !expectation_fits(check, word, subject))
        return false;
    *result = (tn_test_case){.expectation = (tn_expectation)word->value,
                             .todo = ast->todo,
                             .span = ast->node.span,
                             .doc = ast->doc ? ast->doc->text : NULL};
    result->by = check_by(check, ast, result->expectation, subject);
    result->by_count = ast->by.count;
    const tn_checked_form *form = subject->rule ? subject->rule->form : subject->library->form;
    if (!form && ast->literal.house)
        return not_a_plan(check, ast);
    if (form && !read_house(check, ast, form, result))
        return false;
    if (!form)
        result->values =
            check->schema ? tn_check_plan(check, check->schema, ast->literal.trays, &result->length) : NULL;
    if (ast->value && !check_value(check, ast, subject->rule, result))
        return false;
    return result->by && (form || result->values);
}

/* One subject of a test with all cases. */
static void check_subject(tn_check *check, const tn_ast_test *ast, const tn_ast_word *word, size_t column,
                          tn_test_block *block)
{
    tn_test_case *cases = TN_NEW_ARRAY(check->arena, tn_test_case, ast->cases.count);
    const tn_checked_name *subject = cases ? tn_check_name(check, word, TN_WANT_EITHER) : NULL;
    if (!subject)
        return;
    check->schema = subject->rule ? subject->rule->schema : subject->library->schema;
    block->subject = word->text;
    block->is_library = subject->library != NULL;
    block->of_houses = subject->rule ? subject->rule->form != NULL : subject->library->form != NULL;
    block->is_measure = subject->rule && subject->rule->is_measure;
    block->index = subject->rule ? subject->rule->index : subject->library->index;
    block->schema = check->schema ? check->schema->index : 0;
    block->span = ast->top.node.span;
    block->cases = cases;
    if (subject->rule && (subject->rule->is_template || subject->rule->is_let)) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_WRONG_KIND, word->node.span, "`%s` cannot be tested", word->text);
        tn_note(check->diagnostics, d, &subject->span, "`%s` is here", word->text);
        tn_help(check->diagnostics, d, "give a call of it a name, as a rule, and test that");
        return;
    }
    for (TN_EACH(const tn_ast_case, c, ast->cases))
        block->case_count += check_case(check, c, column, subject, &cases[block->case_count]);
}

/* A table says of each plan what is expected of every subject, in their order. */
static void check_columns(tn_check *check, const tn_ast_test *ast)
{
    for (TN_EACH(const tn_ast_case, c, ast->cases)) {
        if (c->expectations.count == ast->subjects.count || !c->expectations.count)
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, E_WRONG_EXPECTATION, c->expectations.last->span,
                                     "the test is of %zu name%s, and this case says what is expected of %zu",
                                     ast->subjects.count, ast->subjects.count == 1 ? "" : "s", c->expectations.count);
        tn_help(check->diagnostics, d, "write one expectation for each name, in their order: match reject [...]");
    }
}

void tn_check_tests(tn_check *check)
{
    tn_checked *result = check->result;
    size_t count = 0;
    for (size_t u = 0; u < check->imports->count; u++)
        for (TN_EACH(const tn_ast_top, item, ((const tn_ast_file *)check->imports->units[u]->tree)->items))
            count += item->kind == TN_ITEM_TEST ? ((const tn_ast_test *)item)->subjects.count : 0;
    tn_test_block *blocks = TN_NEW_ARRAY(check->arena, tn_test_block, count);
    if (!blocks)
        return;
    check->rule = NULL;
    result->program->tests = blocks;
    for (check->unit = 0; check->unit < check->imports->count; check->unit++) {
        const tn_ast_file *file = check->imports->units[check->unit]->tree;
        size_t number = 0;
        for (TN_EACH(const tn_ast_top, item, file->items)) {
            const tn_ast_test *test = (const tn_ast_test *)item;
            size_t column = 0;
            if (item->kind != TN_ITEM_TEST)
                continue;
            number++;
            check_columns(check, test);
            tn_check_with(check, test);
            for (TN_EACH(const tn_ast_word, subject, test->subjects)) {
                if (!tn_check_room(check, result->program->test_count, TN_TESTS_MAX, "test", item->node.span,
                                   "one `test` can have many cases"))
                    break;
                tn_test_block *block = &blocks[result->program->test_count++];
                block->imported = check->unit + 1 < check->imports->count;
                if (test->settings.first) {
                    block->with = number;
                    block->settings = tn_span_join(test->settings.first->span, test->settings.last->span);
                }
                check_subject(check, test, subject, column++, block);
            }
        }
    }
}
