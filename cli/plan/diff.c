/* tartan diff: what an edit does to a library. */
#include "ask/session/questions.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/requests.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/plan/answers.h"
#include "driver/open/digits.h"

/* ---- writes what an edit does to a library as tables */

enum { REMOVED, ADDED, KEPT, KINDS };
static const char *const kinds[KINDS] = {"removed", "added", "kept"};

static mpz_srcptr count_of(const tn_compared_counts *counts, int kind)
{
    return kind == REMOVED ? counts->removed : kind == ADDED ? counts->added : counts->kept;
}

static void write_number(const mpz_t number, int width, FILE *out)
{
    char *text = tn_digits(number, true);
    fprintf(out, "  %*s", width, text ? text : "?");
    free(text);
}

static void write_counts(const tn_compared_counts *counts, const int *widths, FILE *out)
{
    for (int i = 0; i < KINDS; i++)
        write_number(count_of(counts, i), widths[i], out);
    fputc('\n', out);
}

static void write_lengths(const tn_compared *c, FILE *out)
{
    int widths[KINDS];
    fprintf(out, "%8s", "trays");
    for (int i = 0; i < KINDS; i++) {
        widths[i] = tn_digits_width(count_of(&c->total, i), kinds[i]);
        fprintf(out, "  %*s", widths[i], kinds[i]);
    }
    fputc('\n', out);
    for (size_t i = 0; i < c->by_length.count; i++) {
        fprintf(out, "%8" PRIu64, c->by_length.items[i].length);
        write_counts(&c->by_length.items[i].counts, widths, out);
    }
    fprintf(out, "%8s", "total");
    write_counts(&c->total, widths, out);
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static void write_clauses(const tn_compared *c, FILE *out)
{
    int names = (int)strlen("clause"), removes = (int)strlen("removes"), adds = (int)strlen("adds");
    for (size_t i = 0; i < c->clauses.count; i++) {
        const tn_compared_clause *clause = &c->clauses.items[i];
        names = larger(names, (int)strlen(clause->name));
        removes = larger(removes, tn_digits_width(clause->removes, "removes"));
        adds = larger(adds, tn_digits_width(clause->adds, "adds"));
    }
    if (c->clauses.count > 0)
        fprintf(out, "\n%-*s  %-7s  %*s  %*s\n", names, "clause", "is", removes, "removes", adds, "adds");
    for (size_t i = 0; i < c->clauses.count; i++) {
        const tn_compared_clause *clause = &c->clauses.items[i];
        fprintf(out, "%-*s  %-7s", names, clause->name, clause->change);
        write_number(clause->removes, removes, out);
        write_number(clause->adds, adds, out);
        fputc('\n', out);
    }
}

/* ---- weights and preferences */

static void write_leanings(const char *kind, const tn_compared_weight *items, size_t count, FILE *out)
{
    int names = (int)strlen(kind);
    for (size_t i = 0; i < count; i++)
        names = larger(names, (int)strlen(items[i].name));
    if (count > 0)
        fprintf(out, "\n%-*s  %-7s  before  after\n", names, kind, "is");
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%-*s  %-7s  %6s  %5s\n", names, items[i].name, items[i].change,
                items[i].has_before ? items[i].shown_before : "-", items[i].has_after ? items[i].shown_after : "-");
}

/* ---- measures */

enum { NUMBERS = 3, CELL_SIZE = 256 };
static const char *const numbers[NUMBERS] = {"least", "mean", "most"};

/* "115.2 m2 -> 118.8 m2", or one of them if both are the same. */
static void make_cell(const tn_compared_measure *m, int number, char *cell)
{
    const char *before = m->before.shown.items[number], *after = m->after.shown.items[number];
    if (strcmp(before, after) == 0)
        snprintf(cell, CELL_SIZE, "%s", before);
    else
        snprintf(cell, CELL_SIZE, "%s -> %s", before, after);
}

static int cell_width(const tn_compared *c, int number)
{
    char cell[CELL_SIZE];
    int width = (int)strlen(numbers[number]);
    for (size_t i = 0; i < c->measures.count; i++) {
        make_cell(&c->measures.items[i], number, cell);
        width = larger(width, (int)strlen(cell));
    }
    return width;
}

static void write_measures(const tn_compared *c, FILE *out)
{
    int names = (int)strlen("measure"), widths[NUMBERS];
    char cell[CELL_SIZE];
    if (c->measures.count == 0)
        return;
    for (size_t i = 0; i < c->measures.count; i++)
        names = larger(names, (int)strlen(c->measures.items[i].name));
    fprintf(out, "\n%-*s", names, "measure");
    for (int n = 0; n < NUMBERS; n++) {
        widths[n] = cell_width(c, n);
        fprintf(out, "  %*s", widths[n], numbers[n]);
    }
    fputc('\n', out);
    for (size_t i = 0; i < c->measures.count; i++) {
        fprintf(out, "%-*s", names, c->measures.items[i].name);
        for (int n = 0; n < NUMBERS; n++) {
            make_cell(&c->measures.items[i], n, cell);
            fprintf(out, "  %*s", widths[n], cell);
        }
        fputc('\n', out);
    }
}

/* ---- examples */

static void write_plans(const char *kind, const tn_ranked_line *plans, size_t count, FILE *out)
{
    if (count > 0)
        fprintf(out, "\n%s, the first%s:\n", kind, count == 1 ? "" : " and some at random");
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s\n", plans[i].plan);
}

static void write_houses(const char *kind, const char *clause, const tn_owneds *houses, FILE *out)
{
    if (houses->count > 0)
        fprintf(out, "\n%s by %s, some of them:\n", kind, clause);
    for (size_t i = 0; i < houses->count; i++)
        fprintf(out, "%s\n", houses->items[i]);
}

/* Plans or houses. */
static void diff_text(const tn_compared *c, FILE *out)
{
    bool same = mpz_sgn(c->total.removed) == 0 && mpz_sgn(c->total.added) == 0;
    const char *what = c->has_plans ? "plans" : "houses";
    fprintf(out, "%s of %s, ", c->before.library, c->before.file);
    if (strcmp(c->before.library, c->after.library) != 0)
        fprintf(out, "%s of ", c->after.library);
    fprintf(out, "%s: %s%s\n\n", c->after.file, same ? "the same " : "what changes", same ? what : "");
    write_lengths(c, out);
    write_clauses(c, out);
    write_leanings("preference", c->preferences.items, c->preferences.count, out);
    write_leanings("weight", c->weights.items, c->weights.count, out);
    write_measures(c, out);
    write_plans(kinds[REMOVED], c->plans.removed.items, c->plans.removed.count, out);
    write_plans(kinds[ADDED], c->plans.added.items, c->plans.added.count, out);
    write_plans(kinds[KEPT], c->plans.kept.items, c->plans.kept.count, out);
    for (size_t i = 0; i < c->clauses.count; i++) {
        const tn_compared_clause *clause = &c->clauses.items[i];
        write_houses(kinds[REMOVED], clause->name, &clause->houses.removed, out);
        write_houses(kinds[ADDED], clause->name, &clause->houses.added, out);
    }
}

/* Of libraries that are searched. */
static void write_found(const char *kind, const tn_compared_found *found, FILE *out)
{
    size_t count = found->plans.count;
    if (count == 0)
        fprintf(out, "\n%s: none%s\n", kind, found->more ? " was found" : "");
    else
        fprintf(out, "\n%s, %s:\n", kind, found->more ? "the first" : "all");
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s\n", found->plans.items[i]);
}

static void searched_text(const tn_compared_searched *c, FILE *out)
{
    bool same = c->removed.plans.count + c->added.plans.count == 0 && !c->removed.more && !c->added.more;
    fprintf(out, "%s of %s, ", c->before.library, c->before.file);
    if (strcmp(c->before.library, c->after.library) != 0)
        fprintf(out, "%s of ", c->after.library);
    fprintf(out, "%s: %s\n", c->after.file, same ? "the same plans" : "what changes");
    write_found(kinds[REMOVED], &c->removed, out);
    write_found(kinds[ADDED], &c->added, out);
}

typedef struct diff_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_search_settings search;
    tn_option_number sample, seed;
    bool json, without_measures;
    const char *output, *title;
} diff_settings;

static const diff_settings *settings_of(const tn_job *job)
{
    return (const diff_settings *)job->settings;
}

static void write(tn_job *job, const tn_reply *answer, bool json)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    if (json)
        tn_job_write_json(answer, output.stream);
    else if (TN_REPLY(compared_searched, answer))
        searched_text(answer->value, output.stream);
    else
        diff_text(answer->value, output.stream);
    tn_job_commit(job, &output);
}

static tn_status give_other(void *context, const char *path, tn_session **other)
{
    (void)path; /* it is open there */
    *other = context;
    return TN_OK;
}

bool tn_job_diff(tn_job *job, tn_session *before, const tn_diff_request *request, tn_reply *answer)
{
    job->session.other = give_other;
    job->session.other_context = before;
    bool answered = tn_job_answered(job, tn_ask_diff(&job->session, request, answer));
    tn_job_show(job);
    return answered;
}

void tn_job_diff_text(tn_job *job, tn_session *before, const tn_diff_request *request)
{
    tn_reply answer;
    if (tn_job_diff(job, before, request, &answer))
        write(job, &answer, false);
    tn_reply_clear(&answer);
}

static void compare(tn_job *job, tn_session *before)
{
    const diff_settings *settings = settings_of(job);
    const tn_diff_request request = {.subject = tn_job_asked(&settings->plans),
                                     .before = settings->common.operands.items[0],
                                     .has_sample = settings->sample.given,
                                     .sample = settings->sample.value,
                                     .seed = settings->seed.value,
                                     .no_measures = settings->without_measures,
                                     .search = tn_search_settings_asked(&settings->search),
                                     .drawn = {.picture = tn_answer_picture_choice(settings->output)},
                                     .title = settings->title};
    tn_made_outputs outputs;
    tn_reply answer;
    tn_job_files(job, &outputs, &settings->output, 1, false);
    if (tn_job_diff(job, before, &request, &answer))
        write(job, &answer, settings->json);
    tn_job_files_end(&outputs);
    tn_reply_clear(&answer);
}

/* Is the library that is named one of houses, in either file? */
static bool is_about_houses(const tn_job jobs[2])
{
    const tn_plan_settings *plans = &settings_of(&jobs[0])->plans;
    return tn_job_of_houses(&jobs[0], plans) || tn_job_of_houses(&jobs[1], plans);
}

/* Two files are open at once, each with diagnostics of its own. */
static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const diff_settings *settings = (const diff_settings *)common;
    const char *const *paths = common->operands.items;
    tn_job jobs[2];
    tn_job_begin(&jobs[0], common);
    tn_job_begin(&jobs[1], common);
    bool open = tn_job_open_plans(&jobs[0], paths[0], &settings->plans) &&
                tn_job_open_plans(&jobs[1], paths[1], &settings->plans);
    if (open && settings->output && is_about_houses(jobs))
        tn_help(tn_job_diagnostics(&jobs[0]), tn_job_usage(&jobs[0], "houses that are compared are not drawn"),
                "leave out -o; `tartan house` draws a house by its line");
    else if (open)
        compare(&jobs[1], &jobs[0].session);
    int first = tn_job_end(&jobs[0]), second = tn_job_end(&jobs[1]);
    return first > second ? first : second;
}

#define SETTINGS diff_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    NUMBER("sample", 0, "N", sample, 0, TN_DIFF_SHOWN_MAX, "show the first plan of each and N at random (default 3)"),
    NUMBER("seed", 's', "S", seed, 0, 0, "which random ones (default 0)"),
    FLAG("json", 0, json, "write JSON, every count as a string of digits"),
    FLAG("no-measures", 0, without_measures, "leave out how measures change, which takes most of the time"),
    OUTPUT(output, TN_WRITES_PICTURES, "also draw the plans shown, removed, added and kept: .svg, .png or .pdf"),
    TEXT("title", 0, "TEXT", title, "the picture's title"),
    OPTION_MAX_HOUSES("the most houses that are compared one by one (default 1000000)"),
    OPTIONS_LIBRARY_LIMITS,
    OPTIONS_SEARCH,
};

const tn_command tn_command_diff = {
    .name = "diff",
    .summary = "compare a library before and after an edit",
    .usage = "OLD NEW [--library NAME] [--json] [-o SHEET.svg]\nOLD NEW --library HOUSES [--json] [--max-houses N]",
    .description =
        "Compares the plans of a library before and after an edit. It counts exactly how many plans the edit "
        "removes, adds and keeps, for each number of trays and in all. It shows the first plans of each kind and "
        "some at random, and the clauses that are responsible. Clauses are compared by their names. For each "
        "clause that is not the same, `removes` counts the removed plans that it keeps out now, and `adds` counts "
        "the added plans that it kept out before. Several clauses may keep out the same plan. Both libraries must "
        "have the same trays.\n\n"
        "Of each measure that both files have, it shows the least, the mean and the most before and after.\n\n"
        "With --library HOUSES it compares libraries of houses. A house is the same where its line is. Houses that "
        "only "
        "one library has are counted and shown by the clauses that keep them out of the other, or by `plans` or `form` "
        "where these differ. If the form is the same and one library has all clauses of the other, all houses are "
        "counted together. Otherwise the houses on plans of both are compared one by one, up to --max-houses.",
    .example = "$ tartan diff before.plan after.plan\n$ tartan diff before.plan after.plan --sample 12 -o edit.pdf",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "give fewer trays with --trays",
    .operands = "two files, OLD and NEW",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
