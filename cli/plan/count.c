/* tartan count: how many plans, houses or buildings there are, exactly, without making one. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "ask/session/requests.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/plan/answers.h"
#include "cli/plan/library_job.h"
#include "driver/house/judge.h"
#include "driver/measure/spread.h"
#include "driver/open/digits.h"
#include "runtime/base/utf8.h"
#include "runtime/module/module.h"

/* ---- counts as tables for people */

/* ---- plans */

/* A number that is not known is a dash. */
static void write_number(bool known, const mpz_t number, int width, FILE *out)
{
    char *text = known ? tn_digits(number, true) : NULL;
    fprintf(out, "  %*s", width, !known ? "-" : text ? text : "?");
    free(text);
}

static void write_lengths(const tn_counted_plans *c, FILE *out)
{
    int generated = tn_digits_width(c->generated, "generated"), kept = tn_digits_width(c->kept, "kept"),
        mirror = tn_digits_width(c->mirror, "up to mirror"), rows = tn_digits_width(c->rows_of_plans, "rows of plans");
    fprintf(out, "%8s  %*s  %*s", "trays", generated, "generated", kept, "kept");
    if (c->has_mirror)
        fprintf(out, "  %*s", mirror, "up to mirror");
    if (c->has_rows_of_plans)
        fprintf(out, "  %*s", rows, "rows of plans");
    fputc('\n', out);
    for (size_t i = 0; i < c->by_length.count && !tn_interrupted(); i++) {
        const tn_plans_of_length *length = &c->by_length.items[i];
        fprintf(out, "%8" PRIu64, length->length);
        write_number(length->has_generated, length->generated, generated, out);
        write_number(length->has_kept, length->kept, kept, out);
        if (c->has_mirror)
            write_number(true, length->mirror, mirror, out);
        if (c->has_rows_of_plans)
            write_number(true, length->rows_of_plans, rows, out);
        fputc('\n', out);
    }
    fprintf(out, "%8s", "total");
    write_number(c->has_generated, c->generated, generated, out);
    write_number(c->has_kept, c->kept, kept, out);
    if (c->has_mirror)
        write_number(true, c->mirror, mirror, out);
    if (c->has_rows_of_plans)
        write_number(true, c->rows_of_plans, rows, out);
    fputc('\n', out);
}

/* The plans of a library: all but what its clauses do, and that. */
static void count_plans_text(const tn_counted_plans *c, FILE *out)
{
    char *pruned = tn_digits(c->pruned, true);
    fprintf(out, "%s%s", c->library, *c->doc ? ": " : "");
    tn_write_clean(out, c->doc, strlen(c->doc));
    fprintf(out, "\npruned: %s\nstates: %" PRIu64 "%s\n", pruned ? pruned : "?", c->states,
            c->has_states ? "" : " within these lengths");
    if (c->has_apart)
        fprintf(out, "counted apart: %s\n", c->apart);
    fputc('\n', out);
    free(pruned);
    write_lengths(c, out);
}

/* What a clause of either kind does. */
typedef struct clause_row {
    const char *name;
    bool has_out, has_only;
    mpz_srcptr out, only;
    uint64_t states;
} clause_row;

static clause_row rule_row(const tn_counted_plans *c, size_t i)
{
    const tn_rule_effect *r = &c->rules.items[i];
    return (clause_row){r->name, r->has_prunes, r->has_only, r->prunes, r->only, r->states};
}

static clause_row requirement_row(const tn_counted_plans *c, size_t i)
{
    const tn_requirement_effect *r = &c->requirements.items[i];
    return (clause_row){r->name, r->has_keeps_out, r->has_only, r->keeps_out, r->only, r->states};
}

static int wider(int width, int other)
{
    return width > other ? width : other;
}

static void write_clauses(const tn_counted_plans *c, size_t count, clause_row (*row)(const tn_counted_plans *, size_t),
                          const char *what, const char *heading, FILE *out)
{
    int names = (int)strlen(what), outs = (int)strlen(heading), onlys = (int)strlen("only by it");
    for (size_t i = 0; i < count; i++) {
        const clause_row r = row(c, i);
        names = wider(names, (int)strlen(r.name));
        outs = wider(outs, tn_digits_width(r.out, heading));
        onlys = wider(onlys, tn_digits_width(r.only, "only by it"));
    }
    if (count > 0)
        fprintf(out, "\n%-*s  %*s  %*s  %6s\n", names, what, outs, heading, onlys, "only by it", "states");
    for (size_t i = 0; i < count && !tn_interrupted(); i++) {
        const clause_row r = row(c, i);
        fprintf(out, "%-*s", names, r.name);
        write_number(r.has_out, r.out, outs, out);
        write_number(r.has_only, r.only, onlys, out);
        fprintf(out, "  %6" PRIu64 "\n", r.states);
    }
}

static void count_clauses_text(const tn_counted_plans *c, FILE *out)
{
    write_clauses(c, c->requirements.count, requirement_row, "requirement", "keeps out", out);
    write_clauses(c, c->rules.count, rule_row, "rule", "prunes", out);
}

/* ---- in how many ways plans are derived */

static void write_distribution(const tn_counted_ways *c, FILE *out)
{
    int ways = tn_digits_width(c->has_most ? c->most : c->ways, "ways"), plans = tn_digits_width(c->plans, "plans");
    fprintf(out, "\n%*s  %*s\n", ways, "ways", plans, "plans");
    for (size_t i = 0; i < c->distribution.count && !tn_interrupted(); i++) {
        char *of = tn_digits(c->distribution.items[i].ways, true);
        fprintf(out, "%*s", ways, of ? of : "?");
        write_number(true, c->distribution.items[i].plans, plans, out);
        fputc('\n', out);
        free(of);
    }
    if (!c->has_distribution)
        fprintf(out, "%*s  %*s\n", ways, "-", plans, "-");
}

static void write_total(const char *label, const mpz_t number, FILE *out)
{
    char *digits = tn_digits(number, true);
    fprintf(out, "%-6s  %s\n", label, digits ? digits : "?");
    free(digits);
}

static void count_ways_text(const tn_counted_ways *c, FILE *out)
{
    char *most = tn_digits(c->most, true);
    tn_buffer mean = {0};
    if (c->has_generate)
        fprintf(out, "%s, generated by %s\n\n", c->library, c->generate);
    else if (c->has_projected)
        fprintf(out, "%s, projected from %s\n\n", c->library, c->projected);
    else
        fprintf(out, "%s has no `generate`: each of its plans is made in one way\n\n", c->library);
    write_total("plans", c->plans, out);
    write_total("ways", c->ways, out);
    if (c->has_mean && tn_amount_write_about((tn_amount_unit){0}, c->mean, &mean))
        fprintf(out, "%-6s  %s\n", "mean", mean.data);
    if (c->has_most)
        fprintf(out, "%-6s  %s: %s\n", "most", most ? most : "?", *c->first ? c->first : "the empty plan");
    else
        fprintf(out, "%-6s  -\n", "most");
    free(most);
    free(mean.data);
    if (!c->has_distribution)
        fprintf(out, "\nHow many plans have how many ways is not known: telling them apart passes a limit.\n");
    else if (c->distribution.count > 0)
        write_distribution(c, out);
}

/* ---- how plans or houses are spread over the values of a measure */

static const char *things(const tn_spread *p)
{
    return strcmp(p->of, "plan") == 0 ? "plans" : "houses";
}

static void write_statistics(const tn_spread *p, FILE *out)
{
    for (unsigned i = 0; i < TN_SPREAD_FACTS; i++)
        fprintf(out, "%-20s  %s\n", p->names[i], p->facts[i]);
    fputc('\n', out);
}

static void put_bound(const tn_spread *p, const mpq_t value, tn_buffer *text)
{
    tn_amount_unit plain = {.feet = p->bins.unit.feet};
    tn_amount_write(plain, value, text);
}

/* The row of the plans that have no value. */
static void write_without(const tn_spread *p, FILE *out)
{
    char *plans = mpz_sgn(p->d.without) > 0 ? tn_digits(p->d.without, true) : NULL;
    if (plans)
        fprintf(out, "%24s  %24s\n", "none", plans);
    free(plans);
}

static void write_rows(const tn_spread *p, FILE *out)
{
    mpz_t running;
    tn_bin_row r;
    mpz_init(running);
    tn_bin_row_init(&p->bins, &r);
    tn_buffer heading = {0};
    if (p->bins.binned) {
        put_bound(p, p->bins.step, &heading);
        const char *unit = tn_amount_unit_name(p->bins.unit);
        fprintf(out, "%zu values, in bins of %s%s%s\n", p->d.count, heading.data ? heading.data : "", *unit ? " " : "",
                unit);
    }
    free(heading.data);
    fprintf(out, "%24s  %24s  %7s  %7s\n", p->bins.binned ? "from, to below" : "value", things(p), "share", "so far");
    while (tn_bin_row_next(&p->bins, &r)) {
        tn_buffer text = {0};
        put_bound(p, r.from, &text);
        if (p->bins.binned) {
            tn_buffer_printf(&text, " .. ");
            put_bound(p, r.to, &text);
        }
        char *plans = tn_digits(r.plans, true);
        mpz_add(running, running, r.plans);
        fprintf(out, "%24s  %24s  %6.2f%%  %6.2f%%\n", text.data ? text.data : "", plans ? plans : "",
                100 * tn_bins_share(r.plans, p->d.all), 100 * tn_bins_share(running, p->d.all));
        free(plans);
        free(text.data);
    }
    tn_bin_row_clear(&r);
    mpz_clear(running);
    write_without(p, out);
}

static void write_spread(const tn_spread *p, FILE *out)
{
    const char *doc = p->doc, *unit = tn_amount_unit_name(p->bins.unit);
    char *all = tn_digits(p->d.all, true);
    fprintf(out, "%s%s%s%s%s%s of %s %s of %s\n\n", p->name, *doc ? " " : "", doc, *unit ? " (" : "", unit,
            *unit ? ")" : "", all ? all : "", mpz_cmp_ui(p->d.all, 1) == 0 ? p->of : things(p), p->library);
    free(all);
    if (p->d.count == 0) {
        write_without(p, out);
        return;
    }
    write_statistics(p, out);
    write_rows(p, out);
}

static void count_spread_text(const tn_counted_values *values, FILE *out)
{
    write_spread(values->spread.value, out);
}

/* ---- houses */

enum { LABEL_WIDTH = 24, COUNT_WIDTH = 24 };

/* Indented by two, and a blank after it. */
static int widest(int width, const char *name)
{
    return wider(width, (int)strlen(name) + 3);
}

/* Of the labels of the text: of the values and the library's clauses, or more. */
static int label_width(const tn_counted_houses *c, const tn_module *module)
{
    const tn_house_library_record *library = &module->HOUSE_LIBRARY_records[tn_house_library_find(module, c->library)];
    int width = LABEL_WIDTH;
    for (size_t i = 0; i < c->by_section.count; i++)
        for (size_t k = 0; k < c->by_section.items[i].values.count && c->by_section.items[i].values.count > 1; k++)
            width = widest(width, c->by_section.items[i].values.items[k].name);
    for (uint32_t i = 0; i < library->clause_count; i++)
        width = widest(width, tn_text(module, module->HOUSE_CLAUSE_records[library->clause_first + i].name));
    return width;
}

/* At least `width` characters, with blanks behind it. */
static void write_digits(const mpz_t number, int width, FILE *out)
{
    int written = (int)mpz_out_str(out, 10, number);
    fprintf(out, "%*s", written < width ? width - written : 0, "");
}

static void write_label(const char *label, const mpz_t number, int labels, FILE *out)
{
    fprintf(out, "%-*s", labels, label);
    write_digits(number, 0, out);
    fputc('\n', out);
}

static void write_house_lengths(const tn_counted_houses *c, int labels, FILE *out)
{
    for (size_t i = 0; i < c->by_length.count; i++) {
        const tn_named_big *length = &c->by_length.items[i];
        char label[40];
        snprintf(label, sizeof label, "  of %.16s tray%s", length->name, strcmp(length->name, "1") == 0 ? "" : "s");
        write_label(label, length->value, labels, out);
    }
}

static void write_named(const tn_named_big *named, int labels, FILE *out)
{
    fprintf(out, "  %-*s ", labels - 3, named->name);
    write_digits(named->value, 0, out);
    fputc('\n', out);
}

/* Choices that leave nothing to choose are left out. */
static void write_sections(const tn_counted_houses *c, int labels, FILE *out)
{
    for (size_t i = 0; i < c->by_section.count; i++) {
        const tn_named_bigs *choice = &c->by_section.items[i];
        if (choice->values.count <= 1)
            continue;
        fprintf(out, "%s\n", choice->name);
        for (size_t k = 0; k < choice->values.count; k++)
            write_named(&choice->values.items[k], labels, out);
    }
}

static void write_house_states(const tn_counted_houses *c, int labels, FILE *out)
{
    fprintf(out, "%-*s%s\n  %-*s%" PRIu64 "\n", labels, "clause by itself", "states", labels - 2, "none",
            c->states_of_none);
    for (size_t i = 0; i < c->states_of.count; i++)
        fprintf(out, "  %-*s %" PRIu64 "\n", labels - 3, c->states_of.items[i].name, c->states_of.items[i].value);
    fprintf(out, "  %-*s%" PRIu64 "\n", labels - 2, "all of them", c->states);
}

static void write_house_clauses(const tn_counted_houses *c, int labels, FILE *out)
{
    write_label("without clauses", c->without_clauses, labels, out);
    fprintf(out, "%-*s%-*s%s\n", labels, "clause", COUNT_WIDTH, "keeps out", "only by it");
    for (size_t i = 0; i < c->kept_out.count; i++) {
        fprintf(out, "  %-*s ", labels - 3, c->kept_out.items[i].name);
        write_digits(c->kept_out.items[i].value, COUNT_WIDTH - 1, out);
        fputc(' ', out);
        write_digits(c->only.items[i].value, 0, out);
        fputc('\n', out);
    }
    if (c->has_states_of)
        write_house_states(c, labels, out);
}

/* The houses of a library of this module. */
static void count_houses_text(const tn_counted_houses *c, const tn_module *module, FILE *out)
{
    int labels = label_width(c, module);
    write_label("plans", c->plans, labels, out);
    if (c->has_zoned) {
        write_label("with a house", c->plans_with_houses, labels, out);
        write_label("with options", c->with_sections, labels, out);
        write_label("with functions", c->zoned, labels, out);
    }
    if (c->has_faced)
        write_label("with openings", c->faced, labels, out);
    write_label("houses", c->houses, labels, out);
    write_house_lengths(c, labels, out);
    write_sections(c, labels, out);
    if (c->has_kept_out)
        write_house_clauses(c, labels, out);
}

/* ---- buildings */

static void count_buildings_text(const tn_counted_buildings *c, FILE *out)
{
    fprintf(out, "%" PRIu64 "\n", c->has_inside ? c->inside : c->has_buildings ? c->buildings : c->fixed);
}

typedef struct count_settings {
    tn_settings common;
    tn_plan_settings plans;
    bool json, mirror, no_effects, ways;
    const char *plan; /* whose houses are counted */
    bool clauses;     /* and what each of theirs keeps out */
    const char *by;   /* the measure that is counted by */
    const char *step;
    tn_option_number bins;
    bool watch;
    const char *output;
    tn_kit_options kit;
} count_settings;

static tn_count_request request_of(const count_settings *s)
{
    return (tn_count_request){.subject = tn_job_asked(&s->plans),
                              .by = s->by,
                              .step = s->step,
                              .has_bins = s->bins.given,
                              .bins = s->bins.value,
                              .values = s->json,
                              .drawn = {.picture = s->by && !s->json ? tn_answer_picture_choice(s->output) : 0},
                              .plan = s->plan,
                              .clauses = s->clauses,
                              .no_effects = s->no_effects,
                              .mirror = s->mirror,
                              .ways = s->ways,
                              .kit = tn_kit_options_asked(&s->kit)};
}

/* ---- what is written, and when: the plans first, and then what each clause does, which may take far longer */

typedef struct showing {
    tn_job *job;
    bool json;
    const char *path;
    bool open; /* what stands so far is written to: */
    tn_output output;
} showing;

static void show_so_far(void *context, const tn_reply *answer)
{
    showing *s = context;
    const tn_counted_plans *plans = TN_REPLY(counted_plans, answer);
    if (s->json || !plans)
        return;
    tn_job_show(s->job);
    s->open = tn_job_output(s->job, s->path, &s->output);
    if (!s->open)
        return;
    count_plans_text(plans, s->output.stream);
    fflush(s->output.stream);
}

static void write_answer(const showing *s, const tn_reply *answer, FILE *out)
{
    if (s->json)
        tn_job_write_json(answer, out);
    else if (TN_REPLY(counted_ways, answer))
        count_ways_text(TN_REPLY(counted_ways, answer), out);
    else if (TN_REPLY(counted_values, answer))
        count_spread_text(TN_REPLY(counted_values, answer), out);
    else if (TN_REPLY(counted_houses, answer))
        count_houses_text(TN_REPLY(counted_houses, answer), s->job->opened.module, out);
    else if (TN_REPLY(counted_buildings, answer))
        count_buildings_text(TN_REPLY(counted_buildings, answer), out);
}

/* Nothing is left to write of plans but their clauses. */
static void show_rest(showing *s, const tn_reply *answer, bool answered)
{
    tn_error error;
    bool complete = answered;
    if (answered)
        count_clauses_text(TN_REPLY(counted_plans, answer), s->output.stream);
    if (answered && tn_interrupt_check(&error) != TN_OK) { /* long plans have long numbers, and take long to write */
        tn_job_fail(s->job, &error);
        complete = false;
    }
    tn_job_close(s->job, &s->output, complete);
}

static void show(showing *s, const tn_reply *answer)
{
    tn_job_show(s->job);
    bool drawn = TN_REPLY(counted_values, answer) && tn_job_draws(s->path);
    if (!drawn && tn_job_output(s->job, s->path, &s->output)) {
        write_answer(s, answer, s->output.stream);
        tn_job_commit(s->job, &s->output);
    }
}

void tn_job_count(tn_job *job, const tn_count_request *request, bool json, const char *path)
{
    tn_reply answer;
    showing s = {.job = job, .json = json, .path = path};
    tn_made_outputs outputs;
    tn_job_files(job, &outputs, &path, 1, false);
    job->session.so_far = show_so_far;
    job->session.so_far_context = &s;
    bool answered = tn_job_answered(job, tn_ask_count(&job->session, request, &answer));
    job->session.so_far = NULL;
    tn_job_files_end(&outputs);
    if (s.open)
        show_rest(&s, &answer, answered);
    else if (answered && (json || !TN_REPLY(counted_plans, &answer)))
        show(&s, &answer);
    tn_reply_clear(&answer);
}

/* Only a distribution is drawn. */
static bool may_draw(tn_job *job, const count_settings *settings)
{
    if (!tn_job_draws(settings->output) || (settings->by && !settings->json))
        return true;
    if (settings->by || job->opened.module->KIT_count > 0)
        return tn_job_takes_text(job, settings->output);
    tn_diagnostic *d = tn_job_usage(job, "counts are text, and %.200s is a picture's name", settings->output);
    tn_help(tn_job_diagnostics(job), d, "give --by MEASURE to draw a histogram, or end the file's name otherwise");
    return false;
}

static int count_once(const tn_settings *common, tn_files_read *read)
{
    const count_settings *settings = (const count_settings *)common;
    const tn_count_request request = request_of(settings);
    tn_job job;
    tn_job_begin(&job, common);
    job.read = read;
    if (tn_job_open_plans(&job, common->operands.items[0], &settings->plans) && may_draw(&job, settings))
        tn_job_count(&job, &request, settings->json, settings->output);
    return tn_job_end(&job);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    if (!((const count_settings *)common)->watch)
        return count_once(common, NULL);
    return tn_watch_files(common, count_once);
}

#define SETTINGS count_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    FLAG("json", 0, json, "write JSON, every count as a string of digits"),
    TEXT("by", 0, "MEASURE", by, "how the plans are spread over the values of MEASURE, exactly"),
    TEXT("step", 0, "S", step, "with --by: show bins of S, in the measure's unit"),
    NUMBER("bins", 0, "N", bins, 1, TN_BINS_MAX, "with --by: show at most N bins"),
    FLAG("no-effects", 0, no_effects, "leave out what each clause does, which may take far longer than the counts"),
    TEXT("plan", 0, "PLAN", plan, "count the houses on one plan: a plan in any spelling, or # and its rank"),
    FLAG("clauses", 0, clauses, "of houses: also count how many of all houses each clause keeps out"),
    FLAG("ways", 0, ways,
         "in how many ways the plans are derived by what the library generates, in place of the counts"),
    FLAG("mirror", 0, mirror, "also count one of each pair of plans that mirror each other"),
    OPTIONS_KIT("count"),
    FLAG("watch", 0, watch, "count again whenever the file, or one that it uses, changes; Ctrl-C ends"),
    OPTION_OUTPUT_OR_PICTURE,
    OPTION_LDRAW,
    OPTION_MAX_HOUSES(WALKED_HOUSES_HELP),
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_count = {
    .name = "count",
    .summary = "count the plans of a library, exactly",
    .usage = "FILE [--library NAME] [--json] [--mirror] [--no-effects]\nFILE --by MEASURE [--step S | --bins N] "
             "[--json | -o HISTOGRAM.svg]\nFILE --ways [--json]\n"
             "FILE --library HOUSES [--plan PLAN] [--clauses | --by MEASURE] [--json]\n"
             "FILE.kit --parts N [--part NAME]... [--fixed | --inside MODEL] [--json]",
    .description =
        "Counts the plans that the library generates, prunes and keeps, for each number of trays and in all. For "
        "each pruning rule it counts the generated plans that the rule prunes; for each requirement, the plans of "
        "these lengths that it keeps out. For both it counts how many more plans there would be without that "
        "clause. The counts are written first. What each clause does may take far longer for hundreds of clauses, so "
        "each clause has an equal share of the work, and one that needs more is not counted, with a note. "
        "--no-effects leaves this out.\n\n"
        "With --by, the plans are counted by the values of a measure, with the least, the most, the mean and the "
        "quartiles. With -o and the name of a picture (.svg, .png or .pdf) that is drawn as a histogram.\n\n"
        "With --ways it counts in how many ways the plans are derived by what the library generates: in all, on "
        "average, "
        "at most, with the first such plan, and how many plans are derived in how many ways; of a library that is "
        "projected, how many plans of the other library its plans are. In the other counts each plan is one.\n\n"
        "Counts are exact, whatever their size. They are computed from the library's automaton, without "
        "listing plans.\n\n"
        "For a library of houses (docs/houses.md) it counts the plans, the houses, and what they are without their "
        "tiles; the plans that have a house, and with how many options and functions; the houses by length, and by "
        "each "
        "value of each option. --plan counts those on one plan. "
        "--clauses counts how many of the houses that the form allows each clause keeps out, and how many only it "
        "keeps out; where the houses are counted together, also how many states that takes for each clause by itself. "
        "--by counts the houses by a measure of houses or of plans.\n\n"
        "For a kit (docs/kit-language.md) it counts buildings: sets of N parts that hang together by their connectors. "
        "Two that differ by where they stand, or by a turn about the vertical, are one; --fixed tells turns apart. "
        "--inside counts those in the space of a model of the kit, each where it stands.",
    .example = "$ tartan count lahave-houses --json",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "give fewer trays with --trays",
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
