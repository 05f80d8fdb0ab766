/* tartan count: how many plans a library holds, exactly, without making one. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/option_rows.h"
#include "cli/common/progress.h"
#include "cli/place/count_kit.h"
#include "cli/plan/answers.h"
#include "cli/plan/count_by.h"
#include "driver/open/digits.h"
#include "driver/open/findings.h"
#include "runtime/base/utf8.h"

typedef struct count_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_count_options count;
    const char *plan; /* whose houses are counted */
    bool clauses;     /* and what each of theirs keeps out */
    const char *by;   /* the measure that is counted by */
    const char *step;
    tn_option_number bins;
    bool watch;
    const char *output;
    tn_count_kit_options kit;
} count_settings;

/* All counts of a library: one a length, and one (at the end) of all. */
typedef struct length_counts {
    mpz_t generated, kept, mirror;
} length_counts;

/* Of a clause: how many plans it keeps out, and only it; negative where that is not counted. */
typedef struct clause_counts {
    uint32_t states;
    mpz_t out, only;
} clause_counts;

typedef struct counts {
    const tn_ready_library *ready;
    bool mirror;
    uint32_t low;
    length_counts *lengths; /* the last is the total */
    size_t length_count;
    clause_counts *clauses;
    uint32_t clause_count;
} counts;

static bool counts_new(const tn_ready_library *ready, bool mirror, counts *c)
{
    uint32_t low = tn_library_min(ready->library), high = tn_library_max(ready->library);
    *c = (counts){.ready = ready,
                  .mirror = mirror,
                  .low = low,
                  .length_count = (size_t)high - low + 1,
                  .clause_count = ready->record->clause_count};
    c->lengths = malloc(sizeof *c->lengths * (c->length_count + 1));
    c->clauses = malloc(sizeof *c->clauses * ((size_t)c->clause_count + 1));
    if (!c->lengths || !c->clauses) {
        free(c->lengths);
        free(c->clauses);
        *c = (counts){0};
        return false;
    }
    for (size_t i = 0; i <= c->length_count; i++)
        mpz_inits(c->lengths[i].generated, c->lengths[i].kept, c->lengths[i].mirror, NULL);
    for (size_t i = 0; i < c->clause_count; i++)
        mpz_inits(c->clauses[i].out, c->clauses[i].only, NULL);
    return true;
}

static void counts_free(counts *c)
{
    for (size_t i = 0; c->lengths && i <= c->length_count; i++)
        mpz_clears(c->lengths[i].generated, c->lengths[i].kept, c->lengths[i].mirror, NULL);
    for (size_t i = 0; c->clauses && i < c->clause_count; i++)
        mpz_clears(c->clauses[i].out, c->clauses[i].only, NULL);
    free(c->lengths);
    free(c->clauses);
}

static const tn_clause_record *clause_record(const counts *c, uint32_t i)
{
    return &c->ready->schema->module->CLAUSE_records[c->ready->record->clause_first + i];
}

static const char *clause_name(const counts *c, uint32_t i)
{
    return tn_text(c->ready->schema->module, clause_record(c, i)->name);
}

/* A clause past a limit leaves the other counts as they are: a note says which it is. */
static tn_status count_clause(counts *c, tn_opened *opened, uint32_t i, tn_error *error)
{
    clause_counts *clause = &c->clauses[i];
    tn_status status = tn_library_effect(c->ready->library, i, clause->out, clause->only, &clause->states, error);
    if (status != TN_LIMIT)
        return status;
    tn_finding_uncounted(opened, clause_name(c, i), error);
    return TN_OK;
}

static tn_status count_lengths(counts *c, tn_error *error)
{
    const tn_library *library = c->ready->library;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i <= c->length_count; i++) {
        if (tn_interrupt_check(error) != TN_OK)
            return TN_STOPPED;
        uint32_t length = i == c->length_count ? TN_ALL_LENGTHS : c->low + (uint32_t)i;
        tn_library_kept(library, length, c->lengths[i].kept);
        status = tn_library_generated(library, length, c->lengths[i].generated, error);
        if (status == TN_OK && c->mirror)
            status = tn_library_kept_mirror(library, length, c->lengths[i].mirror, error);
    }
    return status;
}

static tn_status count_clauses(counts *c, tn_opened *opened, tn_error *error)
{
    tn_progress progress;
    tn_status status = TN_OK;
    tn_progress_watch(&progress, "clauses counted", tn_interrupt_waiting());
    for (uint32_t i = 0; status == TN_OK && i < c->clause_count; i++)
        status = count_clause(c, opened, i, error);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    return status;
}

static void write_number(const mpz_t number, int width, FILE *out)
{
    char *text = tn_digits(number, true);
    fprintf(out, "  %*s", width, mpz_sgn(number) < 0 ? "-" : text ? text : "?");
    free(text);
}

static void write_lengths(const counts *c, FILE *out)
{
    const length_counts *total = &c->lengths[c->length_count];
    int generated = tn_digits_width(total->generated, "generated"), kept = tn_digits_width(total->kept, "kept"),
        mirror = tn_digits_width(total->mirror, "up to mirror");
    fprintf(out, "%8s  %*s  %*s", "trays", generated, "generated", kept, "kept");
    if (c->mirror)
        fprintf(out, "  %*s", mirror, "up to mirror");
    fputc('\n', out);
    for (size_t i = 0; i <= c->length_count && !tn_interrupted(); i++) {
        if (i < c->length_count)
            fprintf(out, "%8zu", c->low + i);
        else
            fprintf(out, "%8s", "total");
        write_number(c->lengths[i].generated, generated, out);
        write_number(c->lengths[i].kept, kept, out);
        if (c->mirror)
            write_number(c->lengths[i].mirror, mirror, out);
        fputc('\n', out);
    }
}

/* The requirements, or the prunes. */
static void write_clauses(const counts *c, bool prunes, const char *what, const char *out_heading, FILE *out)
{
    int names = (int)strlen(what), outs = (int)strlen(out_heading), onlys = (int)strlen("only by it");
    bool any = false;
    for (uint32_t i = 0; i < c->clause_count; i++) {
        if ((clause_record(c, i)->kind == TN_CLAUSE_PRUNE) != prunes)
            continue;
        int name = (int)strlen(clause_name(c, i)), wide = tn_digits_width(c->clauses[i].out, out_heading),
            alone = tn_digits_width(c->clauses[i].only, "only by it");
        names = name > names ? name : names;
        outs = wide > outs ? wide : outs;
        onlys = alone > onlys ? alone : onlys;
        any = true;
    }
    if (any)
        fprintf(out, "\n%-*s  %*s  %*s  %6s\n", names, what, outs, out_heading, onlys, "only by it", "states");
    for (uint32_t i = 0; i < c->clause_count && !tn_interrupted(); i++) {
        if ((clause_record(c, i)->kind == TN_CLAUSE_PRUNE) != prunes)
            continue;
        fprintf(out, "%-*s", names, clause_name(c, i));
        write_number(c->clauses[i].out, outs, out);
        write_number(c->clauses[i].only, onlys, out);
        fprintf(out, "  %6u\n", c->clauses[i].states);
    }
}

static void write_text(const counts *c, FILE *out)
{
    const tn_module *module = c->ready->schema->module;
    const char *doc = tn_text(module, c->ready->record->doc);
    const length_counts *total = &c->lengths[c->length_count];
    mpz_t pruned;
    mpz_init(pruned);
    mpz_sub(pruned, total->generated, total->kept);
    char *text = tn_digits(pruned, true);
    fprintf(out, "%s%s", tn_text(module, c->ready->record->name), *doc ? ": " : "");
    tn_write_clean(out, doc, strlen(doc));
    fprintf(out, "\npruned: %s\nstates: %u%s\n\n", text ? text : "?", tn_library_states(c->ready->library),
            tn_library_within(c->ready->library) ? " within these lengths" : "");
    free(text);
    mpz_clear(pruned);
    write_lengths(c, out);
}

/* Below 0 it is not known. */
static void put_number(tn_json *json, const char *key, const mpz_t number)
{
    if (mpz_sgn(number) < 0)
        tn_json_null(json, key);
    else
        tn_json_digits(json, key, number);
}

static void lengths_json(const counts *c, tn_json *json)
{
    tn_json_list(json, "by_length");
    for (size_t i = 0; i < c->length_count && !tn_interrupted(); i++) {
        tn_json_object(json, NULL);
        tn_json_count(json, "length", c->low + i);
        put_number(json, "generated", c->lengths[i].generated);
        put_number(json, "kept", c->lengths[i].kept);
        if (c->mirror)
            put_number(json, "mirror", c->lengths[i].mirror);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static void clauses_json(const counts *c, bool prunes, tn_json *json)
{
    tn_json_list(json, prunes ? "rules" : "requirements");
    for (uint32_t i = 0; i < c->clause_count; i++) {
        if ((clause_record(c, i)->kind == TN_CLAUSE_PRUNE) != prunes)
            continue;
        tn_json_object(json, NULL);
        tn_json_string(json, "name", clause_name(c, i));
        put_number(json, prunes ? "prunes" : "keeps_out", c->clauses[i].out);
        put_number(json, "only", c->clauses[i].only);
        tn_json_count(json, "states", c->clauses[i].states);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static void write_json(const counts *c, bool effects, FILE *out)
{
    const length_counts *total = &c->lengths[c->length_count];
    tn_json json = tn_json_file(out, TN_JSON_LINES);
    char hash[33];
    mpz_t pruned;
    mpz_init(pruned);
    mpz_sub(pruned, total->generated, total->kept);
    tn_library_hash(c->ready->library, hash);
    tn_json_object(&json, NULL);
    tn_json_string(&json, "library", tn_text(c->ready->schema->module, c->ready->record->name));
    tn_json_string(&json, "hash", hash);
    if (tn_library_within(c->ready->library))
        tn_json_null(&json, "states");
    else
        tn_json_count(&json, "states", tn_library_states(c->ready->library));
    put_number(&json, "generated", total->generated);
    put_number(&json, "pruned", pruned);
    put_number(&json, "kept", total->kept);
    if (c->mirror)
        put_number(&json, "mirror", total->mirror);
    lengths_json(c, &json);
    if (effects) {
        clauses_json(c, false, &json);
        clauses_json(c, true, &json);
    }
    tn_json_object_end(&json);
    tn_json_end_line(&json);
    mpz_clear(pruned);
}

/* The counts first, and then what each clause does, which may take far longer. */
static tn_status write_counts(tn_job *job, counts *c, const tn_count_options *options, FILE *out, tn_error *error)
{
    tn_status status = TN_OK;
    if (!options->json)
        write_text(c, out);
    if (!options->json && !options->no_effects)
        fflush(out);
    if (!options->no_effects)
        status = count_clauses(c, &job->opened, error);
    if (status != TN_OK)
        return status;
    if (options->json) {
        write_json(c, !options->no_effects, out);
    } else if (!options->no_effects) {
        write_clauses(c, false, "requirement", "keeps out", out);
        write_clauses(c, true, "rule", "prunes", out);
    }
    return TN_OK;
}

void tn_job_count(tn_job *job, const tn_ready_library *ready, const tn_count_options *options, const char *path)
{
    counts c;
    tn_error error;
    tn_output output;
    if (!counts_new(ready, options->mirror, &c)) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
        return;
    }
    tn_job_show(job);
    if (count_lengths(&c, &error) != TN_OK) {
        tn_job_fail(job, &error);
    } else if (tn_job_output(job, path, &output)) {
        tn_status status = write_counts(job, &c, options, output.stream, &error);
        if (status == TN_OK)
            status = tn_interrupt_check(&error); /* long plans have long numbers, and take long to write */
        if (status != TN_OK)
            tn_job_fail(job, &error);
        tn_job_close(job, &output, status == TN_OK);
    }
    counts_free(&c);
}

/* Only a distribution is drawn. */
static bool may_draw(tn_job *job, const count_settings *settings)
{
    if (settings->by || !tn_job_draws(settings->output))
        return true;
    tn_diagnostic *d = tn_job_usage(job, "counts are text, and %.200s is a picture's name", settings->output);
    tn_help(tn_job_diagnostics(job), d, "give --by MEASURE to draw a histogram, or end the file's name otherwise");
    return false;
}

static void answer(tn_job *job, const tn_ready_library *ready, const count_settings *settings)
{
    if (settings->by)
        tn_count_by(job, ready, settings->by,
                    &(tn_count_by_options){settings->count.json, settings->step, settings->bins}, settings->output);
    else if (may_draw(job, settings))
        tn_job_count(job, ready, &settings->count, settings->output);
}

/* With --plan or --clauses, or where --library names a library of houses. */
static bool counts_houses(const tn_job *job, const count_settings *settings)
{
    return settings->plan || settings->clauses || tn_job_of_houses(job, &settings->plans);
}

/* What only libraries of plans are asked. */
static bool asks_library(tn_job *job, const count_settings *s)
{
    const char *option = s->plans.library        ? "library"
                         : s->plans.wheres.count ? "where"
                         : s->plans.trays.given  ? "trays"
                         : s->by                 ? "by"
                         : s->step               ? "step"
                         : s->bins.given         ? "bins"
                         : s->plan               ? "plan"
                         : s->clauses            ? "clauses"
                         : s->count.mirror       ? "mirror"
                         : s->count.no_effects   ? "no-effects"
                                                 : NULL;
    if (option)
        tn_job_usage(job, "--%s is about a library of plans, and %.200s is a kit", option, s->common.operands.items[0]);
    return option != NULL;
}

/* With --by, of houses. */
static void show_houses(tn_job *job, tn_spread *spread, const void *context)
{
    const count_settings *s = context;
    tn_show_spread(job, spread, &(tn_count_by_options){s->count.json, s->step, s->bins}, s->output);
}

static int count_once(const tn_settings *common, tn_files_read *read)
{
    const count_settings *settings = (const count_settings *)common;
    tn_job job;
    tn_ready_library ready = {0};
    tn_job_begin(&job, common);
    job.read = read;
    bool open = tn_job_open_plans(&job, common->operands.items[0], &settings->plans);
    bool of_kit = open && job.opened.module->KIT_count > 0;
    if (of_kit)
        open = !asks_library(&job, settings);
    else if (open)
        open = !tn_job_asks_kit(&job, &settings->kit);
    if (open && of_kit) {
        tn_count_kit_options kit = settings->kit;
        kit.json = settings->count.json;
        kit.threads = tn_job_threads(&settings->plans);
        tn_job_count_kit(&job, &kit, settings->output);
    } else if (open && counts_houses(&job, settings)) {
        const tn_house_settings houses = tn_job_houses(&settings->plans);
        const tn_house_counting counting = {.plan = settings->plan,
                                            .clauses = settings->clauses,
                                            .by = settings->by,
                                            .show = show_houses,
                                            .context = settings,
                                            .json = settings->count.json,
                                            .output = settings->output};
        if (settings->by || may_draw(&job, settings))
            tn_job_count_houses(&job, &houses, &counting);
    } else if (open && tn_job_opened_library(&job, &settings->plans, &ready)) {
        answer(&job, &ready, settings);
    }
    tn_library_close(&ready);
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
    FLAG("json", 0, count.json, "write JSON, every count as a string of digits"),
    TEXT("by", 0, "MEASURE", by, "how the plans are spread over the values of MEASURE, exactly"),
    TEXT("step", 0, "S", step, "with --by: show bins of S, in the measure's unit"),
    NUMBER("bins", 0, "N", bins, 1, 100000, "with --by: show at most N bins"),
    FLAG("no-effects", 0, count.no_effects,
         "leave out what each clause does, which may take far longer than the counts"),
    TEXT("plan", 0, "PLAN", plan, "count the houses on one plan: a plan line, or # and its rank"),
    FLAG("clauses", 0, clauses, "of houses: also count how many of all houses each clause keeps out"),
    FLAG("mirror", 0, count.mirror, "also count one of each pair of plans that mirror each other"),
    OPTIONS_KIT("count"),
    FLAG("watch", 0, watch, "count again whenever the file, or one that it uses, changes; Ctrl-C ends"),
    OPTION_OUTPUT_OR_PICTURE,
    OPTION_LDRAW,
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_count = {
    .name = "count",
    .summary = "count the plans of a library, exactly",
    .usage = "FILE [--library NAME] [--json] [--mirror] [--no-effects]\nFILE --by MEASURE [--step S | --bins N] "
             "[--json | -o HISTOGRAM.svg]\n"
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
        "Counts are exact, whatever their size. They are computed from the library's automaton, without "
        "listing plans.\n\n"
        "For a library of houses (docs/houses.md) it counts the plans, the houses, and what they are without their "
        "tiles; the plans that have a house, and with how many sections and functions; the houses by length, and by "
        "each "
        "value of each choice of the section. --plan counts those on one plan. "
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
