/* tartan complete: what may still be chosen in an open plan. */
#include <stdlib.h>
#include <string.h>

#include "ask/plan/best.h"
#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/plan/library_job.h"
#include "driver/open/digits.h"

typedef struct complete_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_search_settings search;
    tn_option_list wanted; /* wishes */
    bool json;
    const char *output;
} complete_settings;

static const complete_settings *settings_of(const tn_job *job)
{
    return (const complete_settings *)job->settings;
}

/* ---- as text */

static const char *spelling(const tn_open_choices *c, uint32_t field, uint32_t value)
{
    return tn_text(c->schema->module, c->schema->values[c->schema->value_start[field] + value].spelling);
}

static void write_field(const tn_open_choices *c, uint32_t tray, uint32_t field, FILE *out)
{
    fprintf(out, "  %-16s", tn_text(c->schema->module, c->schema->fields[field].name));
    bool any = false;
    for (uint32_t v = 0; v < c->schema->fields[field].value_count; v++) {
        size_t at = tn_open_choice_at(c, tray, field, v);
        if (mpz_sgn(c->found.counts[at]) == 0)
            continue;
        char *digits = tn_digits(c->found.counts[at], true), *best = tn_open_best_text(c, at);
        fprintf(out, "%s%s: %s%s%s%s", any ? ",  " : "", spelling(c, field, v), digits ? digits : "", best ? " (" : "",
                best ? best : "", best ? ")" : "");
        free(best);
        free(digits);
        any = true;
    }
    fputs(any ? "\n" : "-\n", out);
}

static void write_text(const tn_open_choices *c, const char *why_none, FILE *out)
{
    char *plans = tn_digits(c->found.plans, true);
    char best[256];
    bool one = mpz_cmp_ui(c->found.plans, 1) == 0;
    fprintf(out, "%s %.*s complete%s it", plans ? plans : "", (int)strlen(c->what) - one, c->what, one ? "s" : "");
    if (c->found.best) {
        tn_open_best_name(c, best, sizeof best);
        fprintf(out, "; in brackets the %s that is left", best);
    }
    fputc('\n', out);
    free(plans);
    for (uint32_t t = 0; t < c->found.trays && mpz_sgn(c->found.plans) > 0; t++) {
        fprintf(out, "\nwritten tray %u\n", t + 1);
        for (uint32_t f = 0; f < c->schema->field_count; f++)
            write_field(c, t, f, out);
    }
    if (why_none)
        fprintf(out, "%s\n", why_none);
}

/* ---- the command */

/* Of plans that are searched. */
static void write_searched(const tn_completed_searched *completed, FILE *out)
{
    size_t count = completed->first.count;
    if (count == 0)
        fputs("no plan completes it\n", out);
    else
        fprintf(out, "the first plan%s that complete%s it%s\n", count == 1 ? "" : "s", count == 1 ? "s" : "",
                completed->more ? "" : "; there are no others");
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s\n", completed->first.items[i]);
    if (completed->has_why_none)
        fprintf(out, "%s\n", completed->why_none);
}

static void show(tn_job *job, const tn_reply *answer)
{
    const complete_settings *settings = settings_of(job);
    const tn_completed *counted = TN_REPLY(completed, answer);
    const tn_completed_by *weighed = TN_REPLY(completed_by, answer);
    const tn_completed_searched *searched = TN_REPLY(completed_searched, answer);
    tn_output output;
    tn_job_show(job);
    if (!tn_job_draws(settings->output) && tn_job_output(job, settings->output, &output)) {
        if (settings->json)
            tn_job_write_json(answer, output.stream);
        else if (searched)
            write_searched(searched, output.stream);
        else
            write_text(counted ? counted->shown.value : weighed->shown.value,
                       counted ? counted->why_none : weighed->why_none, output.stream);
        tn_job_commit(job, &output);
    }
}

static void complete(tn_job *job, const char *pattern)
{
    const complete_settings *settings = settings_of(job);
    tn_wished wished = {0};
    tn_made_outputs outputs;
    tn_reply answer;
    if ((settings->json && !tn_job_takes_text(job, settings->output)) ||
        (settings->wanted.count > 0 && !tn_job_wishes(job, &settings->wanted, 1, &wished)))
        return;
    const tn_complete_request request = {.subject = tn_job_asked(&settings->plans),
                                         .pattern = pattern,
                                         .by = {wished.items, wished.count},
                                         .search = tn_search_settings_asked(&settings->search),
                                         .drawn = {.picture = tn_answer_picture_choice(settings->output)}};
    tn_job_files(job, &outputs, &settings->output, 1, false);
    if (tn_job_answered(job, tn_ask_complete(&job->session, &request, &answer)))
        show(job, &answer);
    tn_job_files_end(&outputs);
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const complete_settings *settings = (const complete_settings *)common;
    const char *pattern = common->operands.items[1];
    tn_job job;
    tn_job_begin(&job, common);
    if (tn_job_open_plans(&job, common->operands.items[0], &settings->plans))
        complete(&job, pattern);
    return tn_job_end(&job);
}

#define SETTINGS complete_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    WISH("least", wanted, "also say the least MEASURE that each value leaves"),
    WISH("most", wanted, "also say the most MEASURE that each value leaves"),
    FLAG("json", 0, json, "write JSON, every count as a string of digits"),
    OPTION_OUTPUT_OR_PICTURE,
    OPTION_MAX_HOUSES("if walks are asked for: the most houses that are gone through one by one (default 100000)"),
    OPTIONS_LIBRARY_LIMITS,
    OPTIONS_SEARCH,
};

const tn_command tn_command_complete = {
    .name = "complete",
    .summary = "count the plans that complete an open plan",
    .usage = "FILE PATTERN [--library NAME] [--least MEASURE | --most MEASURE] [--json]\nFILE PATTERN -o "
             "OPEN.svg\nFILE PATTERN --library "
             "HOUSES [--least MEASURE]",
    .description =
        "An open plan is trays between bars: what is written of a tray in the words of `tray(...)`, `?` for "
        "any tray, `...` "
        "for any number of trays, also none. Says how many plans of the library complete it, and of each "
        "written tray how "
        "many of these have which value there. PATTERN may also be one plan: a plan line, or in brackets as tests have "
        "it. Where a plan fits in several ways, the leftmost counts. To "
        "list completions, "
        "give other commands --where \"plan [PATTERN]\". With --least or --most, the best value of a measure that each "
        "choice "
        "still leaves is said too.\n\n"
        "With -o and the name of a picture (.svg, .png or .pdf) the open plan is drawn, and below each written tray "
        "its choices.\n\n"
        "With --library HOUSES it counts the houses whose plans complete it (docs/houses.md).",
    .example = "$ tartan complete lahave-houses \"8' public | ? | great | ...\"",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE and a PATTERN",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
