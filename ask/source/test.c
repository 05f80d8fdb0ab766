/* test, coverage: how the tests of a file come out, and what they tell apart. */
#include <stdlib.h>

#include "ask/session/questions.h"
#include "driver/coverage/coverage.h"
#include "driver/place/kit.h"
#include "driver/plan/tests.h"
#include "driver/solid/solid.h"

/* ---- coverage */

static void free_covered(void *made)
{
    tn_covered_clear(made);
    free(made);
}

static tn_status set_test(const tn_covered *covered, const tn_covered_part *from, tn_coverage_part *to, tn_error *error)
{
    tn_buffer text = {0};
    if (!from->telling.found)
        return TN_OK;
    const tn_covered_part *told = &covered->parts[from->telling.same_as];
    to->has_subject = to->has_test = true;
    to->subject = tn_covered_subject_name(covered, told);
    if (!tn_covered_case(covered, told, &text)) {
        free(text.data);
        return tn_fail_memory(error);
    }
    to->test = text.data;
    return TN_OK;
}

static tn_status set_part(const tn_covered *covered, const tn_covered_part *from, tn_coverage_part *to, tn_error *error)
{
    static const char *const outcomes[TN_FATE_COUNT] = {"noticed", "survives", "equal", "unknown"};
    tn_place place = tn_covered_place(covered, from->place);
    tn_buffer change = {0};
    to->text = from->text;
    to->kind = from->kind;
    to->depth = from->depth;
    to->has_file = to->has_line = to->has_column = place.line > 0;
    to->file = place.path;
    to->line = place.line;
    to->column = place.column;
    to->has_bytes = place.line > 0;
    to->bytes = from->place.end - from->place.begin;
    to->has_flips = from->counted;
    mpz_set(to->flips, from->flips);
    to->of = from->of_houses ? "houses" : "plans";
    to->noticed = from->noticed;
    to->to = from->change ? from->change->to : NULL;
    to->has_to = to->to != NULL;
    to->around = from->around;
    to->has_around = to->around != NULL;
    to->outcome = outcomes[from->fate];
    to->alone = from->alone;
    if (!tn_covered_change(from, &change)) {
        free(change.data);
        return tn_fail_memory(error);
    }
    to->change = change.data;
    return set_test(covered, from, to, error);
}

/* Parts come rule by rule. */
static tn_status set_rules(const tn_covered *covered, tn_measured_coverage *to, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0, next; status == TN_OK && i < covered->count; i = next) {
        tn_coverage_rule *rule = TN_ADD(coverage_rule, to->rules, error);
        if (!rule)
            return TN_MEMORY;
        next = tn_covered_rule_end(covered, i);
        rule->name = covered->parts[i].name;
        status = TN_NEW_LIST(coverage_part, rule->parts, next - i, error);
        for (size_t k = i; status == TN_OK && k < next; k++)
            status = set_part(covered, &covered->parts[k], &rule->parts.items[k - i], error);
    }
    return status;
}

static tn_status set_form(const tn_covered *covered, const tn_form_coverage *from, tn_coverage_form *to,
                          tn_error *error)
{
    to->name = from->name;
    to->tests = from->tests;
    to->reached = from->reached;
    tn_status status = TN_NEW_LIST(coverage_line, to->parts, from->count, error);
    for (size_t i = 0; status == TN_OK && i < from->count; i++) {
        const tn_form_line *part = &from->parts[i];
        const tn_place place = tn_covered_place(covered, part->place);
        to->parts.items[i] = (tn_coverage_line){.text = part->text,
                                                .kind = part->kind,
                                                .depth = part->depth,
                                                .has_file = true,
                                                .file = place.path,
                                                .has_line = place.line > 0,
                                                .line = place.line,
                                                .has_column = place.column > 0,
                                                .column = place.column,
                                                .houses = part->houses};
    }
    return status;
}

static tn_status set_coverage(const tn_covered *covered, tn_measured_coverage *to, tn_error *error)
{
    const tn_library_record *library = covered->library;
    to->has_library = library != NULL;
    to->library = library ? tn_text(covered->opened->module, library->name) : NULL;
    to->trays.from = covered->min;
    to->trays.to = covered->max;
    to->parts = covered->count;
    to->noticed = covered->noticed;
    to->survive =
        tn_covered_count(covered, false, TN_FATE_SURVIVES) + tn_covered_count(covered, true, TN_FATE_SURVIVES);
    to->equal = tn_covered_count(covered, false, TN_FATE_EQUAL) + tn_covered_count(covered, true, TN_FATE_EQUAL);
    to->untried = covered->changes.more;
    tn_status status = set_rules(covered, to, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(coverage_form, to->forms, covered->form_count, error);
    for (size_t i = 0; status == TN_OK && i < covered->form_count; i++)
        status = set_form(covered, &covered->forms[i], &to->forms.items[i], error);
    return status;
}

static tn_status measure(tn_session *session, const tn_coverage_request *request, tn_measured_coverage *to)
{
    const tn_coverage_options options = {
        .library = request->library, .max_states = (uint32_t)request->max_states, .houses = true, .tell = true};
    tn_covered *covered = calloc(1, sizeof *covered);
    tn_error error;
    if (!covered) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    tn_session_begins(session, "rules measured");
    tn_status status = tn_coverage_measure(session->opened, &options, covered);
    tn_session_ends(session);
    to->shown = (tn_boxed){covered, free_covered};
    if (status == TN_OK && set_coverage(covered, to, &error) != TN_OK)
        status = tn_session_fail(session, &error);
    return status;
}

tn_status tn_ask_coverage(tn_session *session, const tn_coverage_request *request, tn_reply *answer)
{
    tn_error error;
    *answer = (tn_reply){0};
    if (!session->opened->compilation.program)
        return tn_session_refuse(session, NULL, "only a .plan file has tests whose coverage is measured");
    tn_status status = tn_reply_new(&tn_message_measured_coverage, answer, &error);
    return status == TN_OK ? measure(session, request, answer->value) : tn_session_fail(session, &error);
}

/* ---- tests */

static tn_status add_design(void *context, const char *design, size_t count, const char *const *names,
                            const double *values, tn_error *error)
{
    tn_tested *to = context;
    tn_tested_design *added = TN_ADD(tested_design, to->solids, error);
    if (!added)
        return TN_MEMORY;
    added->name = design;
    tn_status status = TN_NEW_LIST(named_real, added->measures, count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        added->measures.items[i] = (tn_named_real){names[i], values[i]};
    return status;
}

static tn_status test_solids(tn_session *session, const tn_test_request *request, tn_tested *to)
{
    tn_solid_tally tally = {0};
    tn_status status = tn_solid_tests_run(session->opened, (uint32_t)request->max_boxes, add_design, to, &tally);
    to->has_solids = true;
    to->passed = tally.passed;
    to->failed = tally.failed;
    return status;
}

static tn_status test_kit(tn_session *session, tn_tested *to)
{
    tn_kit_tally tally = {0};
    tn_status status = tn_kit_tests_run(session->opened, session->opened->module->watch, &tally);
    to->passed = tally.passed;
    to->failed = tally.failed;
    return status;
}

static tn_status test_plans(tn_session *session, const tn_test_request *request, tn_tested *to)
{
    tn_test_counts counts = {0};
    tn_status status = tn_tests_run(session->opened, (uint32_t)request->subject.max_states, NULL, &counts);
    to->passed = counts.passed;
    to->failed = counts.failed;
    to->todo = counts.todo;
    return status;
}

static tn_status add_coverage(tn_session *session, const tn_test_request *request, tn_tested *to)
{
    tn_error error;
    tn_measured_coverage *added = TN_ADD(measured_coverage, to->coverage, &error);
    to->has_coverage = true;
    return added ? measure(session, &request->subject, added) : tn_session_fail(session, &error);
}

/* Tests that fail are an answer. */
tn_status tn_ask_test(tn_session *session, const tn_test_request *request, tn_reply *answer)
{
    const tn_module *module = session->opened->module;
    tn_error error;
    *answer = (tn_reply){0};
    if (request->coverage && (module->SOLID_count > 0 || module->KIT_count > 0))
        return tn_session_refuse(session, "run the tests without --coverage and --write-tests",
                                 "only a .plan file has tests whose coverage is measured");
    tn_status status = tn_reply_new(&tn_message_tested, answer, &error);
    if (status != TN_OK)
        return tn_session_fail(session, &error);
    tn_tested *to = answer->value;
    status = module->SOLID_count > 0 ? test_solids(session, request, to)
             : module->KIT_count > 0 ? test_kit(session, to)
                                     : test_plans(session, request, to);
    if (status == TN_INVALID && to->failed > 0)
        status = TN_OK;
    return status == TN_OK && request->coverage && session->opened->compilation.program
               ? add_coverage(session, request, to)
               : status;
}
