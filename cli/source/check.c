/* tartan check: says what is wrong with rule files, and what their rules mean. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "ask/session/questions.h"
#include "ask/session/requests.h"
#include "ask/source/check.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/line_diff.h"
#include "cli/common/options.h"
#include "cli/common/progress.h"
#include "cli/plan/answers.h"
#include "cli/plan/test.h"
#include "cli/source/sarif.h"
#include "driver/solid/solid.h"

/* ---- relations as matrices for people */

/* The relations of a file's rules, and of the clauses of its libraries of houses, as `check --relations` shows them. */

/* How a relation is written: the sign in the matrix, its word, and what it means of rules, and of clauses about houses.
 */
typedef struct sign {
    char letter;
    const char *word, *meaning, *of_houses;
} sign;

enum { UNKNOWN, EQUAL, APART, INSIDE, CONTAINS, OVERLAP, SIGNS };

static const sign signs[SIGNS] = {
    [UNKNOWN] = {'?', "unknown", "not analysed", "not found out"},
    [EQUAL] = {'=', "equal", "the same plans", "the same houses"},
    [APART] = {'/', "apart", "no plan in common", "no house in common"},
    [INSIDE] = {'<', "inside", "the column's rule matches all that the row's does",
                "the column's clause matches all that the row's does"},
    [CONTAINS] = {'>', "contains", "the row's rule matches all that the column's does",
                  "the row's clause matches all that the column's does"},
    [OVERLAP] = {'x', "overlap", "some plans in common", "some houses in common"},
};

static int sign_of(const char *word)
{
    for (int s = 0; s < SIGNS; s++)
        if (strcmp(signs[s].word, word) == 0)
            return s;
    return UNKNOWN;
}

static const tn_texts *names_of(const tn_related *related)
{
    return related->has_library ? &related->clauses : &related->rules;
}

/* Pairs are in the order of a row's cells behind the diagonal. */
static int relation(const tn_related *related, size_t i, size_t j)
{
    size_t count = names_of(related)->count, low = i < j ? i : j, high = i < j ? j : i;
    size_t before = low * count - low * (low + 1) / 2;
    int s = sign_of(related->relations.items[before + high - low - 1].relation);
    return i < j ? s : s == INSIDE ? CONTAINS : s == CONTAINS ? INSIDE : s;
}

static int name_width(const tn_texts *names)
{
    int width = 0;
    for (size_t i = 0; i < names->count; i++) {
        int length = (int)strlen(names->items[i]);
        width = length > width ? length : width;
    }
    return width;
}

/* Each has a number, which heads its column. */
static void write_matrix(const tn_related *related, FILE *out)
{
    const tn_texts *names = names_of(related);
    size_t count = names->count, cells[SIGNS] = {0};
    int width = name_width(names), digits = snprintf(NULL, 0, "%zu", count);
    fprintf(out, "%*s", digits + 1 + width, "");
    for (size_t j = 0; j < count; j++)
        fprintf(out, " %*zu", digits, j + 1);
    fputc('\n', out);
    for (size_t i = 0; i < count; i++) {
        fprintf(out, "%*zu %-*s", digits, i + 1, width, names->items[i]);
        for (size_t j = 0; j < count; j++) {
            int s = i == j ? EQUAL : relation(related, i, j);
            cells[s] += i != j;
            fprintf(out, " %*c", digits, i == j ? '.' : signs[s].letter);
        }
        fputc('\n', out);
    }
    for (int s = 0; s < SIGNS; s++)
        if (cells[s]) /* inside and contains are one relation seen from both */
            fprintf(out, "%c %s: %s (%zu)\n", signs[s].letter, signs[s].word,
                    related->has_library ? signs[s].of_houses : signs[s].meaning,
                    s == INSIDE || s == CONTAINS ? cells[s] : cells[s] / 2);
}

static void write_pair(const tn_related_pair *pair, FILE *out)
{
    if (!pair->has_both)
        return;
    fprintf(out, "\n%s, %s: %s\n", pair->a, pair->b, pair->relation);
    if (pair->both)
        fprintf(out, "  both: %s\n", pair->both);
    if (pair->only_a)
        fprintf(out, "  only %s: %s\n", pair->a, pair->only_a);
    if (pair->only_b)
        fprintf(out, "  only %s: %s\n", pair->b, pair->only_b);
}

/* A matrix for each schema, and for each library of houses; then the examples, if there are any. */
static void relations_text(const tn_relations *relations, FILE *out)
{
    size_t schemas = 0;
    const char *between = "";
    for (size_t i = 0; i < relations->items.count; i++)
        schemas += relations->items.items[i].has_schema;
    for (size_t i = 0; i < relations->items.count; i++) {
        const tn_related *related = &relations->items.items[i];
        if (related->has_schema && related->rules.count == 0)
            continue;
        if (related->has_library)
            fprintf(out, "%shouses that the clauses of %s match\n", between, related->library);
        else if (schemas > 1)
            fprintf(out, "%s%s\n", between, related->schema);
        write_matrix(related, out);
        for (size_t k = 0; k < related->relations.count; k++)
            write_pair(&related->relations.items[k], out);
        between = "\n";
    }
}

/* ---- --fix: the replacements that diagnostics suggest */

/* A replacement may uncover another mistake; more rounds than this mean that two of them undo each other. */
enum { ROUNDS_MAX = 20 };

typedef struct fixed_text {
    char *text; /* zero-ended; owned */
    size_t size, fixes;
} fixed_text;

/* The next replacement at or after `from` in the file itself (source 0), as sorted diagnostics have them. */
static const tn_diagnostic *next_fix(const tn_diagnostics *list, size_t from)
{
    const tn_diagnostic *first = NULL;
    for (size_t i = 0; i < list->count; i++) {
        const tn_diagnostic *item = &list->items[i];
        bool own = item->replacement && item->has_span && item->span.file == 0 && item->span.begin >= from;
        if (own && (!first || item->span.begin < first->span.begin))
            first = item;
    }
    return first;
}

/* Puts all replacements in place that do not overlap. False where out of memory. */
static bool apply(const tn_diagnostics *list, const fixed_text *old, fixed_text *made)
{
    *made = (fixed_text){.fixes = old->fixes};
    FILE *out = open_memstream(&made->text, &made->size);
    if (!out)
        return false;
    size_t at = 0;
    for (const tn_diagnostic *fix; (fix = next_fix(list, at)) != NULL;) {
        fwrite(old->text + at, 1, fix->span.begin - at, out);
        fputs(fix->replacement, out);
        at = fix->span.end > fix->span.begin ? fix->span.end : fix->span.begin + 1; /* one insertion at a place */
        if (fix->span.end == fix->span.begin && fix->span.begin < old->size)
            fputc(old->text[fix->span.begin], out);
        made->fixes++;
    }
    if (at < old->size)
        fwrite(old->text + at, 1, old->size - at, out);
    bool failed = ferror(out) != 0;
    if (fclose(out) == 0 && !failed)
        return true;
    free(made->text);
    made->text = NULL;
    return false;
}

/* One round: compiles the text, and applies what is suggested. *more: something was. */
static tn_status improve(const char *path, fixed_text *fixed, bool *more, tn_error *error)
{
    tn_opened opened = {0};
    fixed_text made;
    tn_diagnostics_init(&opened.compilation.diagnostics, &opened.compilation.sources);
    tn_open_bytes(path, (const uint8_t *)fixed->text, fixed->size, false, &opened);
    tn_diagnostics_sort(&opened.compilation.diagnostics);
    bool good = apply(&opened.compilation.diagnostics, fixed, &made);
    tn_close(&opened);
    if (!good)
        return tn_fail_memory(error);
    *more = made.fixes > fixed->fixes;
    free(fixed->text);
    *fixed = made;
    return TN_OK;
}

static tn_status fix_all(const char *path, fixed_text *fixed, tn_error *error)
{
    bool more = true;
    tn_status status = TN_OK;
    for (int round = 0; status == TN_OK && more && round < ROUNDS_MAX; round++)
        status = improve(path, fixed, &more, error);
    return status;
}

/* Asks a person. Only y and yes are yes. */
static bool asks_yes(const char *path)
{
    char *line = NULL;
    size_t capacity = 0;
    fprintf(stderr, "Write %s? [y/N] ", path);
    tn_interrupt_asking(true);
    bool read = !tn_interrupted() && getline(&line, &capacity, stdin) >= 0;
    tn_interrupt_asking(false);
    bool yes = read && !tn_interrupted() && (strcmp(line, "y\n") == 0 || strcmp(line, "yes\n") == 0);
    if (!read)
        fputc('\n', stderr);
    free(line);
    return yes;
}

/* Is the file on the disk still what was read? An editor may have saved it while a person thought. */
static bool still_same(tn_job *job, const char *path, const char *text, size_t size)
{
    uint8_t *bytes = NULL;
    size_t now = 0;
    tn_error error;
    if (tn_file_read(path, TN_SOURCE_BYTES_MAX, &bytes, &now, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return false;
    }
    bool same = now == size && memcmp(bytes, text, size) == 0;
    free(bytes);
    if (same)
        return true;
    tn_fail(&error, TN_IO, E_CANNOT_WRITE, "%.300s has changed meanwhile; nothing is written", path);
    tn_job_fail(job, &error);
    return false;
}

/* What was read is compared last, when all but the renaming is done: an edit in between would be lost. */
static void write_file(tn_job *job, const char *path, const char *text, size_t size, const fixed_text *fixed)
{
    tn_output output;
    tn_error error;
    if (!tn_job_output(job, path, &output))
        return;
    fwrite(fixed->text, 1, fixed->size, output.stream);
    fflush(output.stream);
    if (!still_same(job, path, text, size)) {
        tn_output_discard(&output);
        return;
    }
    if (tn_output_commit(&output, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return;
    }
    tn_job_note(job, "%.300s: %zu place%s replaced", path, fixed->fixes, fixed->fixes == 1 ? "" : "s");
}

static bool show_difference(tn_job *job, const char *path, const char *before, const char *after)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return false;
    bool good = tn_line_diff(path, "fixed", before, after, output.stream);
    tn_job_commit(job, &output);
    fflush(stdout);
    if (good)
        return !job->reader_gone;
    tn_error error;
    tn_fail_memory(&error);
    tn_job_fail(job, &error);
    return false;
}

static bool deliver(tn_job *job, const char *path, const char *text, size_t size, const fixed_text *fixed, bool yes)
{
    if (strcmp(text, fixed->text) == 0) {
        tn_job_note(job, "%.300s: no diagnostic suggests a replacement", path);
        return true;
    }
    if (!show_difference(job, path, text, fixed->text))
        return false;
    bool person = isatty(STDIN_FILENO) && isatty(STDERR_FILENO);
    if (yes || (person && asks_yes(path)))
        write_file(job, path, text, size, fixed);
    else if (person)
        tn_job_note(job, "%.300s stays as it is", path);
    else
        tn_job_note(job, "%.300s stays as it is: --yes writes it", path);
    return job->exit_code <= TN_EXIT_INVALID && !tn_interrupted();
}

/* The file is read several times and written, which a pipe or a device cannot be. What is not there is said by reading.
 */
static tn_status expect_file(const char *path, tn_error *error)
{
    struct stat found;
    if (stat(path, &found) != 0 || S_ISREG(found.st_mode) || S_ISDIR(found.st_mode))
        return TN_OK;
    tn_fail(error, TN_IO, E_CANNOT_WRITE, "cannot write %.300s: it is a pipe or a device, not a file", path);
    tn_error_help(error, "--fix reads a file and writes it again: name one");
    return TN_IO;
}

/* Shows what would change as a difference, and writes the file where `yes` says so or a person at the terminal does.
 * The file is replaced whole. What is wrong with it is left for the caller to say. False: do not go on. */
static bool fix_file(tn_job *job, const char *path, bool yes)
{
    uint8_t *bytes = NULL;
    size_t size = 0;
    tn_error error;
    if (expect_file(path, &error) != TN_OK || tn_file_read(path, TN_SOURCE_BYTES_MAX, &bytes, &size, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return false;
    }
    fixed_text fixed = {.text = strndup((const char *)bytes, size), .size = size};
    tn_status status = TN_OK;
    if (!fixed.text)
        status = tn_fail_memory(&error);
    else if (strlen(fixed.text) == size) /* else it is no text, which opening says */
        status = fix_all(path, &fixed, &error);
    bool going = status == TN_OK && deliver(job, path, (const char *)bytes, size, &fixed, yes);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    free(fixed.text);
    free(bytes);
    return going;
}

/* ---- the command */

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
            relations_text(TN_REPLY(relations, &answer), output.stream);
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
        if (settings->fix && !fix_file(job, path, settings->yes))
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
