/* tartan check: says what is wrong with rule files, and what their rules mean. */
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "ask/source/check.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/option_rows.h"
#include "cli/common/progress.h"
#include "cli/plan/answers.h"
#include "cli/plan/relations_text.h"
#include "cli/plan/tested_text.h"
#include "cli/source/fix.h"
#include "cli/source/sarif.h"
#include "driver/solid/solid.h"

typedef struct check_settings {
    tn_settings common;
    tn_plan_settings plans;
    bool no_analysis, figures;
    bool relations, examples, json;
    const char *output; /* of the relations */
    bool with_tests, with_counts;
    const char *before; /* the file before an edit, to compare with */
    tn_option_number max_boxes;
    bool fix, yes, watch;
    const char *sarif; /* where a SARIF log goes */
} check_settings;

static const check_settings *settings_of(const tn_job *job)
{
    return (const check_settings *)job->settings;
}

static void run_tests(tn_job *job)
{
    const check_settings *settings = settings_of(job);
    const tn_test_request request = {.subject = {.max_states = settings->plans.max_states.value},
                                     .max_boxes = settings->max_boxes.value};
    tn_reply answer;
    tn_output output;
    bool answered = tn_job_answered(job, tn_ask_test(&job->session, &request, &answer));
    const tn_tested *tested = answer.value;
    if (tested && tested->failed > 0)
        tn_job_status(job, TN_INVALID);
    tn_job_show(job);
    if (answered && job->exit_code <= TN_EXIT_INVALID && tn_job_output(job, NULL, &output)) {
        if (settings->json) {
            tn_job_write_json(&answer, output.stream);
        } else {
            tn_tested_designs_text(tested, output.stream);
            tn_tested_counts_text(tested, output.stream);
        }
        tn_job_commit(job, &output);
    }
    tn_reply_clear(&answer);
}

/* What is found is shown with what compiling said, in the order of the text. library: the one that is counted too, or
 * NULL. */
static void find(tn_job *job, const tn_library *library)
{
    const check_settings *settings = settings_of(job);
    const tn_check_request request = {.figures = settings->figures,
                                      .has_max_states = settings->plans.max_states.given,
                                      .max_states = settings->plans.max_states.value,
                                      .has_max_boxes = settings->max_boxes.given,
                                      .max_boxes = settings->max_boxes.value,
                                      .has_threads = settings->plans.threads.given,
                                      .threads = settings->plans.threads.value};
    tn_reply answer;
    tn_job_answered(job, tn_check_beside(&job->session, &request, library, &answer));
    tn_reply_clear(&answer);
}

/* Of designs of boxes: with --test also what they require. */
static void check_solids(tn_job *job)
{
    const check_settings *settings = settings_of(job);
    if (!settings->no_analysis)
        find(job, NULL);
    if (settings->with_tests)
        run_tests(job);
}

/* Analyses the rules, too. */
static void relate(tn_job *job)
{
    const check_settings *settings = settings_of(job);
    const tn_relations_request request = {.examples = settings->examples,
                                          .has_max_states = settings->plans.max_states.given,
                                          .max_states = settings->plans.max_states.value,
                                          .has_threads = settings->plans.threads.given,
                                          .threads = settings->plans.threads.value};
    tn_reply answer;
    tn_output output;
    bool answered = tn_job_answered(job, tn_ask_relations(&job->session, &request, &answer));
    tn_job_show(job);
    if (answered && tn_job_output(job, settings->output, &output)) {
        if (settings->json)
            tn_job_write_json(&answer, output.stream);
        else
            tn_relations_text(TN_REPLY(relations, &answer), output.stream);
        tn_job_commit(job, &output);
    }
    tn_reply_clear(&answer);
}

static void analyse(tn_job *job, const tn_library *library)
{
    tn_progress progress;
    tn_progress_watch(&progress, "analysing the rules", tn_interrupt_waiting());
    find(job, library);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
}

/* ---- other questions about the same file */

/* The file before an edit is open at the same time, with diagnostics of its own. */
static void compare(tn_job *job)
{
    const check_settings *settings = settings_of(job);
    const tn_diff_request request = {.subject = tn_job_asked(&settings->plans),
                                     .before = settings->before,
                                     .no_measures = true}; /* they take most of the time */
    tn_job old;
    tn_job_begin(&old, job->settings);
    if (tn_job_open_plans(&old, settings->before, &settings->plans))
        tn_job_diff_text(job, &old.session, &request);
    int code = tn_job_end(&old);
    job->exit_code = code > job->exit_code ? code : job->exit_code;
}

/* Makes the library that is counted or compared, so that checking can take from it what it needs of it. */
static bool make_library(tn_job *job, const tn_ready_library **ready)
{
    const check_settings *settings = settings_of(job);
    const tn_library_asked asked = tn_job_asked(&settings->plans);
    *ready = NULL;
    return (!settings->with_counts && !settings->before) ||
           tn_job_answered(job, tn_session_library(&job->session, &asked, ready));
}

static void answer(tn_job *job)
{
    const check_settings *settings = settings_of(job);
    const tn_ready_library *ready;
    bool made = make_library(job, &ready);
    if (!settings->no_analysis)
        analyse(job, settings->with_counts && made ? ready->library : NULL);
    if (settings->with_tests)
        run_tests(job);
    if (made && settings->with_counts)
        tn_job_count(job, &(tn_count_request){.subject = tn_job_asked(&settings->plans)}, false, NULL);
    if (made && settings->before)
        compare(job);
}

static bool takes_standard_input(const tn_option_list *operands)
{
    for (size_t i = 0; i < operands->count; i++)
        if (strcmp(operands->items[i], "-") == 0)
            return true;
    return false;
}

static bool check_options(tn_job *job)
{
    const check_settings *settings = settings_of(job);
    if (settings->relations && settings->no_analysis)
        tn_job_usage(job, "--relations is part of the analysis that --no-analysis leaves out");
    else if (settings->relations && settings->common.operands.count > 1)
        tn_job_usage(job, "--relations takes one FILE");
    else if ((settings->with_counts || settings->before) && settings->common.operands.count > 1)
        tn_job_usage(job, "%s takes one FILE", settings->with_counts ? "--count" : "--diff");
    else if (settings->plans.library && !settings->with_counts && !settings->before)
        tn_job_usage(job, "--library is about --count and --diff: give one of them too");
    else if (settings->relations && (settings->with_tests || settings->with_counts || settings->before))
        tn_job_usage(job, "--relations is asked alone, without --test, --count and --diff");
    else if (!settings->relations && (settings->examples || settings->output))
        tn_job_usage(job, "%s is about --relations: give that too", settings->examples ? "--examples" : "--output");
    else if (settings->json && !settings->relations &&
             (!settings->with_tests || settings->with_counts || settings->before))
        tn_job_usage(job, "--json is about --relations, or --test alone: give one of them");
    else if (settings->json && settings->with_tests && settings->common.operands.count > 1)
        tn_job_usage(job, "--test --json takes one FILE; `tartan test --json` takes several");
    else if (settings->yes && !settings->fix)
        tn_job_usage(job, "--yes is about --fix: give that too");
    else if (settings->watch && (settings->fix || settings->output || settings->sarif))
        tn_job_usage(job, "--watch goes without --fix, --sarif and --output");
    else if (settings->fix && takes_standard_input(&settings->common.operands))
        tn_job_usage(job, "--fix is about files, and standard input is none");
    else
        return true;
    return false;
}

static void check(tn_job *job)
{
    const check_settings *settings = settings_of(job);
    const tn_module *module = job->opened.module;
    bool grammar = tn_module_has_grammar(module);
    if (settings->relations && (grammar || !settings->figures))
        relate(job);
    else if (settings->figures || grammar || !tn_notation_of_module(module))
        find(job, NULL);
    else if (tn_notation_of_module(module) == TN_NOTATION(pcfg))
        return;
    else if (module->SOLID_count)
        check_solids(job);
    else
        answer(job);
}

/* Opens operand i: with it, those further ones that are one text with it. */
static bool open_operand(tn_job *job, size_t i)
{
    const tn_option_list *operands = &job->settings->operands;
    const char *path = operands->items[i];
    if (i > 0)
        tn_job_next(job);
    if (!tn_path_joins(path))
        return tn_job_open(job, path);
    const char **joined = calloc(operands->count, sizeof *joined);
    tn_error error;
    size_t count = 0;
    if (!joined) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
        return false;
    }
    for (size_t k = i; k < operands->count; k++)
        if (tn_path_joins(operands->items[k]))
            joined[count++] = operands->items[k];
    bool open = tn_job_open_joined(job, joined, count);
    free(joined);
    return open;
}

static void check_all(tn_job *job)
{
    const check_settings *settings = settings_of(job);
    const tn_option_list *operands = &settings->common.operands;
    bool joined = false;
    for (size_t i = 0; i < operands->count; i++) {
        const char *path = operands->items[i];
        bool part = tn_path_joins(path);
        if (settings->fix && !tn_fix_file(job, path, settings->yes))
            return;
        if (settings->fix && tn_job_diagnostics(job)->count > 0)
            tn_job_next(job);
        if ((!part || !joined) && open_operand(job, i))
            check(job);
        joined |= part;
    }
}

static int check_once(const tn_settings *common, tn_files_read *read)
{
    const check_settings *settings = (const check_settings *)common;
    tn_job job;
    tn_sarif sarif;
    tn_job_begin(&job, common);
    job.read = read;
    if (settings->sarif) {
        tn_sarif_begin(&sarif);
        job.listener = &sarif.listener;
    }
    bool going = check_options(&job);
    if (going)
        check_all(&job);
    int exit_code = tn_job_end(&job);
    if (!settings->sarif)
        return exit_code;
    tn_error error;
    tn_status status = going ? tn_sarif_write(&sarif, settings->sarif, &error) : TN_OK;
    tn_sarif_clear(&sarif);
    if (status == TN_OK)
        return exit_code;
    tn_job_begin(&job, common);
    tn_job_fail(&job, &error);
    return tn_job_end(&job);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const check_settings *settings = (const check_settings *)common;
    bool watched = settings->watch && !settings->fix && !settings->sarif && !settings->output;
    return watched ? tn_watch_files(common, check_once) : check_once(common, NULL);
}

#define SETTINGS check_settings
static const tn_option options[] = {
    FLAG("no-analysis", 0, no_analysis, "say only what is wrong with the text: nothing about what the rules mean"),
    FLAG("relations", 0, relations,
         "print how the plans that each two rules match, and the houses of two clauses, lie to one another"),
    FLAG("examples", 0, examples,
         "with --relations: the shortest plan, or the first house, that both match, that only one does"),
    FLAG("json", 0, json, "with --relations or --test: write JSON"),
    OUTPUT(output, TN_WRITES_TEXT | TN_WRITES(JSON), "with --relations: write to FILE; .json is JSON"),
    FLAG("figures", 0, figures,
         "say of a grammar how deep its sentences are, how many there are, and how fast they grow"),
    FLAG("test", 0, with_tests, "also run the file's tests, as `tartan test` does"),
    FLAG("count", 0, with_counts, "also count the library's plans, as `tartan count` does"),
    TEXT("diff", 0, "OLD", before,
         "also compare the library with the one of OLD, as `tartan diff --no-measures OLD FILE` does"),
    FLAG("fix", 0, fix, "show what the suggested replacements change in FILE, ask, and write it"),
    FLAG("yes", 0, yes, "with --fix: write without asking"),
    FLAG("watch", 0, watch, "check again whenever a file that was read changes; Ctrl-C ends"),
    TEXT("sarif", 0, "LOG", sarif,
         "also write what is found to LOG in SARIF 2.1.0, for code hosts; - is standard output"),
    OPTION_LIBRARY,
    OPTION_SET,
    OPTION_LDRAW,
    OPTION_WERROR,
    OPTION_MAX_STATES,
    OPTION_MAX_BOXES(max_boxes),
    OPTION_THREADS(plans.threads),
};

const tn_command tn_command_check = {
    .name = "check",
    .summary = "check rule files for errors and warnings",
    .usage = "FILE... [--no-analysis] [--figures] [--test] [--watch] [--sarif LOG]\nFILE... --fix [--yes]\nFILE --test "
             "--json\nFILE [--test] [--count] [--diff OLD] "
             "[--library "
             "NAME]\nFILE --relations [--examples] [--json]",
    .description =
        "Compiles each rule file and all files that it uses, and shows every error and warning with its place and "
        "a suggested fix.\n\n"
        "Then it warns about rules that are probably wrong: a rule that matches no plan, every plan, or only what "
        "another rule matches; a pruning rule or requirement that changes nothing; a library without a plan, with "
        "the clauses that contradict each other; a distance that only holds where there is no destination. This "
        "is decided on the rules' automata, for plans of any length, and the shortest plan is shown as proof. A "
        "module (.tnb) is checked for loading. A grammar (.bnf) gets a warning if its sentences tend to grow "
        "without end, and a design of boxes (.solid) if boxes are squashed, clipped away or apart. Several "
        "connection grammars (.pcfg) are one grammar, in the order given.\n\n"
        "With --test, --count or --diff the answers of these commands are given too. That is faster than one "
        "command after another, because they share most of their work.\n\n"
        "--fix applies the replacements that errors and warnings suggest, the same that editors offer, and shows the "
        "difference first. It writes a file whole or not at all, and only after a person has said yes or with --yes. "
        "A suggestion can be wrong: read the difference. What is left is shown as without --fix.",
    .example = "$ tartan check houses.plan\n$ tartan check houses.plan --relations --examples\n$ tartan check "
               "houses.plan --test --count "
               "--diff old.plan\n$ tartan check houses.plan --fix",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "at least one FILE",
    .operands_min = 1,
    .operands_max = SIZE_MAX,
    .run = run,
};
