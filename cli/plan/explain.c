/* tartan explain: why a plan is kept or dropped, rule by rule, tray by tray. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/option_rows.h"
#include "cli/house/judged.h"
#include "cli/plan/chosen_rules.h"
#include "cli/plan/library_job.h"
#include "cli/plan/plan_input.h"
#include "cli/solid/solid.h"
#include "driver/plan/explain.h"
#include "runtime/base/picture.h"
#include "runtime/base/utf8.h"

typedef struct explain_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_input_settings input;
    const char *plan_file, *solid;
    tn_option_list rules;
    bool full, json;
    const char *output;
    tn_option_number nearest, dpi, max_boxes;
} explain_settings;

static const explain_settings *settings_of(const tn_job *job)
{
    return (const explain_settings *)job->settings;
}

#define NEAREST_DEFAULT 3

/* What is explained, and against what. */
typedef struct explaining {
    tn_job *job;
    const explain_settings *settings;
    const tn_library_record *record; /* or NULL: rules by themselves */
    tn_chosen_rules rules;
    tn_schema *schema;
    tn_library *library;    /* for ranks; NULL where they are not asked for, or it passed a limit */
    tn_near_finder *finder; /* NULL where nobody asked, or a clause passed a limit */
    bool tried_library, tried_nearest;
    tn_output output;
} explaining;

static void fail_memory(tn_job *job)
{
    tn_error error;
    tn_fail_memory(&error);
    tn_job_fail(job, &error);
}

/* The library that --library names, or the only one; without any, or with --rule, rules by themselves. */
static bool choose(explaining *e)
{
    tn_opened *opened = &e->job->opened;
    uint32_t schema, library = UINT32_MAX;
    tn_error error;
    bool rules = e->settings->rules.count > 0;
    if (!rules && !e->settings->plans.library && opened->module->LIBRARY_count > 0) {
        tn_status status = tn_library_choose(opened, NULL, &library);
        tn_job_status(e->job, status);
        if (status != TN_OK)
            return false;
        schema = opened->module->LIBRARY_records[library].schema;
    } else if (!rules && e->settings->plans.library) {
        tn_status status = tn_schema_choose(opened, e->settings->plans.library, &schema, &library);
        tn_job_status(e->job, status);
        if (status != TN_OK)
            return false;
    } else {
        static const char otherwise[] = "name one of those it uses with --rule";
        if (!tn_job_choose_rules(e->job, &e->settings->rules, otherwise, &e->rules))
            return false;
        schema = e->rules.schema;
    }
    e->record = library == UINT32_MAX ? NULL : &opened->module->LIBRARY_records[library];
    if (tn_schema_new(opened->module, schema, 0, &e->schema, &error) == TN_OK)
        return true;
    tn_job_fail(e->job, &error);
    return false;
}

/* A limit that is passed while finding out what can be done without. */
static void note_limit(explaining *e, const tn_error *error, const char *consequence)
{
    tn_diagnostic *note = tn_finding_note(&e->job->opened, error);
    tn_note(tn_job_diagnostics(e->job), note, NULL, "%s", consequence);
}

static uint32_t library_index(const explaining *e)
{
    return (uint32_t)(e->record - e->job->opened.module->LIBRARY_records);
}

/* The library's automaton, for ranks: made once, and done without where it passes a limit. */
static void make_library(explaining *e)
{
    tn_error error;
    if (e->tried_library || !e->record)
        return;
    e->tried_library = true;
    tn_library_options options = {.max_states = (uint32_t)e->settings->plans.max_states.value,
                                  .max_length = (uint32_t)e->settings->plans.max_length.value};
    tn_status status = tn_library_new(e->schema, library_index(e), &options, &e->library, &error);
    if (status == TN_LIMIT)
        note_limit(e, &error, "so ranks are not known");
    else if (status != TN_OK)
        tn_job_fail(e->job, &error);
}

static void make_nearest(explaining *e)
{
    tn_error error;
    if (e->tried_nearest)
        return;
    e->tried_nearest = true;
    const tn_near_options options = {.max_states = (uint32_t)e->settings->plans.max_states.value};
    tn_status status = tn_near_finder_new(e->schema, library_index(e), &options, &e->finder, &error);
    if (status == TN_LIMIT)
        note_limit(e, &error, "so nearest plans are not known");
    else if (status != TN_OK)
        tn_job_fail(e->job, &error);
}

static void find_near(explaining *e, tn_explained *explained)
{
    tn_error error;
    size_t most = e->settings->nearest.given ? (size_t)e->settings->nearest.value : NEAREST_DEFAULT;
    if (most == 0 || !e->record || explained->kept)
        return;
    make_nearest(e);
    if (!e->finder)
        return;
    tn_status status = tn_explained_near(explained, e->finder, most, &error);
    if (status == TN_LIMIT)
        tn_finding_note(&e->job->opened, &error);
    else if (status != TN_OK)
        tn_job_fail(e->job, &error);
}

/* JSON keeps its bytes; what people read does not reach the terminal as it is. */
static void write_text(const explain_settings *settings, const tn_buffer *text, FILE *out)
{
    if (settings->json)
        fwrite(text->data, 1, text->size, out);
    else
        tn_write_shown(out, text->data, text->size);
}

static void write_explained(explaining *e, const tn_explained *explained)
{
    tn_error error;
    tn_buffer text = {0};
    const explain_settings *settings = e->settings;
    if (settings->output) {
        tn_picture to = {.path = settings->output, .dpi = (uint32_t)settings->dpi.value};
        if (tn_explained_draw(explained, settings->full, &to, &error) != TN_OK)
            tn_job_fail(e->job, &error);
    } else if (!(settings->json ? tn_explained_json(explained, &text)
                                : tn_explained_text(explained, settings->full, &text))) {
        fail_memory(e->job);
    } else {
        write_text(settings, &text, e->output.stream);
    }
    free(text.data);
}

static void explain_plan(explaining *e, const tn_tray *trays, size_t length)
{
    tn_explained explained;
    tn_error error;
    size_t longest =
        e->settings->plans.max_length.given ? (size_t)e->settings->plans.max_length.value : TN_EXPLAIN_LENGTH_DEFAULT;
    tn_status status = tn_explained_make(&explained, &e->job->opened, e->schema, e->record, e->rules.indices,
                                         e->rules.count, trays, length, longest, &error);
    if (e->settings->json || e->settings->full) /* ranks take several times as long as all the rest */
        make_library(e);
    explained.automaton = e->library;
    if (status == TN_OK)
        find_near(e, &explained);
    else
        tn_job_fail(e->job, &error);
    if (status == TN_OK && e->job->exit_code == TN_EXIT_DONE)
        write_explained(e, &explained);
    tn_explained_clear(&explained);
}

static void explain_rank(explaining *e, const char *digits)
{
    mpz_t rank;
    uint32_t length;
    if (!*digits || strspn(digits, "0123456789") != strlen(digits)) {
        tn_job_usage(e->job, "a rank is # and a whole number from 0, not `#%.60s`", digits);
        return;
    }
    if (!e->record) {
        tn_job_usage(e->job, "#%.60s is a plan's rank in a library, and rules alone are explained here", digits);
        return;
    }
    make_library(e);
    if (!e->library) {
        tn_job_status(e->job, TN_LIMIT);
        return;
    }
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(e->library) + 1));
    mpz_init_set_str(rank, digits, 10);
    if (!trays)
        fail_memory(e->job);
    else if (tn_library_unrank(e->library, rank, trays, &length))
        explain_plan(e, trays, length);
    else
        tn_job_no_rank(e->job, e->library, e->record, digits);
    mpz_clear(rank);
    free(trays);
}

static void explain_text(explaining *e, const char *text)
{
    size_t longest = tn_job_max_length(&e->settings->plans);
    tn_plan plan = {0};
    tn_error error;
    tn_status status = text[strspn(text, " ")] == '{'
                           ? tn_plan_parse_json(e->schema, text, strlen(text), longest, &plan, &error)
                           : tn_plan_parse_line(e->schema, text, strlen(text), longest, &plan, &error);
    if (status == TN_OK) {
        explain_plan(e, plan.trays, plan.length);
    } else {
        tn_error_place(&error, 1, error.column, error.column_end);
        tn_report_error(tn_job_diagnostics(e->job), &error, "PLAN", text, strlen(text));
        tn_job_status(e->job, status);
    }
    free(plan.trays);
}

/* The next plan of a file; NULL at its end, and where one cannot be read, which is recorded. */
static const tn_plan *next_plan(explaining *e, tn_plan_reader *reader, const tn_plans_source *source)
{
    const tn_plan *plan = NULL;
    tn_error error;
    size_t size = 0;
    if (tn_plan_reader_next(reader, &plan, &error) == TN_OK)
        return plan;
    const char *text = tn_plan_reader_text(reader, &size);
    tn_job_bad_plan(e->job, source, &error, text, size);
    return NULL;
}

/* The only plan of a file, for a picture. */
static void explain_only(explaining *e, tn_plan_reader *reader, const tn_plans_source *source)
{
    const tn_plan *plan = next_plan(e, reader, source);
    if (!plan) {
        if (e->job->exit_code == TN_EXIT_DONE)
            tn_job_usage(e->job, "there is no plan in %.200s to be drawn", source->path);
        return;
    }
    size_t length = plan->length;
    tn_tray *trays = malloc((length + 1) * sizeof *trays);
    if (!trays) {
        fail_memory(e->job);
        return;
    }
    memcpy(trays, plan->trays, length * sizeof *trays);
    if (next_plan(e, reader, source))
        tn_help(tn_job_diagnostics(e->job),
                tn_job_usage(e->job, "a picture shows one plan, and %.200s holds more", source->path),
                "give the plan itself, or leave out -o");
    else if (e->job->exit_code == TN_EXIT_DONE)
        explain_plan(e, trays, length);
    free(trays);
}

/* Every plan of a file, kept apart by a line that says which it is. */
static void explain_file(explaining *e, const char *path)
{
    tn_plan_reader *reader;
    const tn_plan *plan;
    const tn_plans_source source = {path, &e->settings->input, &e->settings->plans};
    if (!tn_job_reader(e->job, e->schema, &source, &reader))
        return;
    if (e->settings->output)
        explain_only(e, reader, &source);
    for (size_t count = 0; !e->settings->output && (plan = next_plan(e, reader, &source)); count++) {
        if (!e->settings->json)
            fprintf(e->output.stream, "%s%s:%" PRIu64 ": ", count ? "\n" : "", path, tn_plan_reader_line(reader));
        explain_plan(e, plan->trays, plan->length);
        if (e->job->exit_code != TN_EXIT_DONE)
            break;
    }
    tn_plan_reader_free(reader);
}

static bool check_options(tn_job *job)
{
    const explain_settings *settings = settings_of(job);
    if ((settings->common.operands.count > 1) == (settings->plan_file != NULL))
        tn_job_usage(job, "say which plan: a plan line, #RANK, or --plan FILE");
    else if (settings->output && settings->json)
        tn_job_usage(job, "either a picture (-o) or --json, not both");
    else
        return true;
    return false;
}

static void explain(tn_job *job)
{
    const explain_settings *settings = settings_of(job);
    explaining e = {.job = job, .settings = settings};
    const char *text = settings->common.operands.count > 1 ? settings->common.operands.items[1] : NULL;
    if (choose(&e) && tn_job_output(job, NULL, &e.output)) {
        tn_job_show(job);
        if (!text)
            explain_file(&e, settings->plan_file);
        else if (text[0] == '#')
            explain_rank(&e, text + 1);
        else
            explain_text(&e, text);
        tn_job_commit(job, &e.output);
    }
    tn_near_finder_free(e.finder);
    tn_library_free(e.library);
    tn_schema_free(e.schema);
    tn_chosen_rules_clear(&e.rules);
}

/* How the boxes of a design were squashed, step by step. */
static void draw_solid(tn_job *job)
{
    const explain_settings *settings = settings_of(job);
    const tn_solid_drawing drawing = {.views = TN_SOLID_HISTORY,
                                      .camera = tn_camera_default(),
                                      .dpi = (uint32_t)settings->dpi.value,
                                      .most = (uint32_t)settings->max_boxes.value};
    if (settings->json)
        tn_job_usage(job, "either a picture (-o) or --json, not both");
    else
        tn_job_draw_solid(job, settings->solid, &drawing, settings->output);
}

static void explain_house(tn_job *job, const char *line)
{
    const explain_settings *settings = settings_of(job);
    tn_job_explain_house(job, settings->plans.library, &settings->rules, line, settings->full, settings->json,
                         tn_job_max_length(&settings->plans));
}

/* A house by its name, #R or #P:V. */
static void explain_numbered(tn_job *job, const char *number)
{
    const tn_house_settings houses = tn_job_houses(&settings_of(job)->plans);
    tn_buffer line = {0};
    if (tn_job_house_line(job, &houses, number, &line))
        explain_house(job, line.data);
    free(line.data);
}

/* A plan for houses, by its line or as #P: with no house behind the colon. */
static void explain_for_houses(tn_job *job, const char *text)
{
    const explain_settings *settings = settings_of(job);
    const tn_house_settings houses = tn_job_houses(&settings->plans);
    size_t size = strlen(text) - (text[0] == '#');
    char *plan = strndup(text, size);
    if (plan)
        tn_job_explain_plan(job, &houses, plan, settings->json);
    else
        tn_job_fail(job, &(tn_error){.status = TN_MEMORY});
    free(plan);
}

/* What is said of a house is not drawn. */
static bool is_drawn(tn_job *job)
{
    if (!settings_of(job)->output)
        return false;
    tn_help(tn_job_diagnostics(job), tn_job_usage(job, "why a house is kept or dropped is not drawn: leave out -o"),
            "`tartan house FILE HOUSE -o NAME.svg` draws the house");
    return true;
}

static void explain_plan_or_house(tn_job *job)
{
    const explain_settings *settings = settings_of(job);
    const char *text = settings->common.operands.count > 1 ? settings->common.operands.items[1] : "";
    const char *library = settings->plans.library;
    bool of_houses = library && tn_house_library_find(job->opened.module, library) != TN_NO_RECORD;
    const char *colon = text[0] == '#' && job->opened.module->HOUSE_LIBRARY_count > 0 ? strchr(text, ':') : NULL;
    bool house = tn_is_house_line(text),
         for_houses = (colon && colon[1] == '\0') || (of_houses && *text && text[0] != '#'),
         numbered = colon || (of_houses && text[0] == '#');
    if ((house || for_houses || numbered) && is_drawn(job))
        return;
    if (house)
        explain_house(job, text);
    else if (for_houses)
        explain_for_houses(job, text);
    else if (numbered)
        explain_numbered(job, text);
    else
        explain(job);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    tn_job_begin(&job, common);
    bool alone = common->operands.count == 1 && !settings_of(&job)->plan_file; /* a design of boxes needs no plan */
    bool open = alone && tn_job_open(&job, common->operands.items[0]);
    if (open && job.opened.module->SOLID_count && settings_of(&job)->output)
        draw_solid(&job);
    else if (open && job.opened.module->SOLID_count)
        tn_job_explain_solid(&job, settings_of(&job)->solid, (uint32_t)settings_of(&job)->max_boxes.value,
                             settings_of(&job)->json);
    else if ((open || !alone) && check_options(&job) && tn_job_open(&job, common->operands.items[0]))
        explain_plan_or_house(&job);
    return tn_job_end(&job);
}

#define SETTINGS explain_settings
static const tn_option options[] = {
    TEXT("plan", 0, "FILE", plan_file, "explain every plan of FILE; - is standard input"),
    LIST("rule", 'r', "NAME", rules, "explain this rule, whatever a library says; may be repeated"),
    OPTION_LIBRARY,
    TEXT("solid", 0, "NAME", solid, "which design of the file; may be left out where the file has only one"),
    OPTION_WHERE,
    FLAG("full", 0, full, "every clause and every part, not only what decides"),
    FLAG("json", 0, json, "write JSON, everything in it"),
    OUTPUT(output, TN_WRITES_PICTURES, "draw it instead: .svg, .png or .pdf"),
    NUMBER("nearest", 0, "N", nearest, 0, 1000, "how many of the nearest kept plans to show (default 3)"),
    NUMBER("dpi", 0, "N", dpi, 10, 2400, "pixels an inch of a PNG (default 150)"),
    OPTION_INPUT_FORMAT,
    OPTION_MAX_LENGTH,
    OPTION_MAX_STATES,
    OPTION_MAX_BOXES(max_boxes),
};

const tn_command tn_command_explain = {
    .name = "explain",
    .summary = "explain why a library keeps or drops a plan",
    .usage = "FILE PLAN\nFILE HOUSE\nFILE '#RANK'\nFILE '#P:V'\nFILE '#P:' --library HOUSES\nFILE PLAN --library "
             "HOUSES\nFILE --plan PLANS\nFILE "
             "PLAN --rule NAME\nFILE [--solid NAME] [-o "
             "STEPS.svg]",
    .description =
        "Says which clauses of a library drop a plan, and shows for each clause which of its parts hold. + marks a "
        "part that matches, with its trays. - marks a part that does not match, with what comes closest. For a "
        "rule that does not match, the largest part that does is shown. A distance needs only one source that is "
        "far from every destination, so one is shown.\n\n"
        "For a dropped plan, the nearest plans that the library keeps follow. A changed field costs 1; a tray "
        "that is added or left out costs as much as it has fields. With --rule, or if the file has no library, "
        "rules are explained by themselves. PLAN is a plan line or a JSON object, in quotes.\n\n"
        "HOUSE is a house line (docs/houses.md) or a JSON object with one: explain says which clauses of a library of "
        "houses drop it, and "
        "whether its plan is one of the library's. The tiles may be left out. '#P:V' is a house by its name, and so is "
        "'#R' "
        "with --library and a library of houses. Of a PLAN (or '#P:', with nothing behind the colon) and a library of "
        "houses it says which cells keep all houses off the plan: no function may be "
        "there, or no tile of one stands.\n\n"
        "For a design of boxes it says how they were squashed, pair by pair; -o draws each step.",
    .example = "$ tartan explain terrace \"$(tartan unrank terrace 1000)\"",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE and a PLAN",
    .operands_min = 1,
    .operands_max = 2,
    .run = run,
};
