/* tartan explain: why a plan is kept or dropped, rule by rule, tray by tray. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/explain/explain.h"
#include "ask/form/draw.h"
#include "ask/house/numbered.h"
#include "ask/session/questions.h"
#include "ask/session/requests.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/house/judged.h"
#include "cli/plan/library_job.h"
#include "cli/plan/plan_input.h"
#include "driver/solid/solid.h"
#include "runtime/base/buffer.h"
#include "runtime/base/picture.h"
#include "runtime/base/utf8.h"

/* ---- explanations of houses as text */

/* A question a line, with what it finds. */
static void write_why(const tn_asked_of_house *questions, size_t count, tn_buffer *out)
{
    for (size_t i = 0; i < count; i++) {
        tn_buffer_printf(out, "    ");
        tn_explained_question_said(&questions[i], out);
        tn_buffer_printf(out, "\n");
    }
}

static void write_clause(const tn_explained_house_clause *clause, tn_buffer *out)
{
    tn_buffer_printf(out, "%s ", clause->drops ? "-" : "+");
    tn_explained_clause_said(clause, out);
    tn_buffer_printf(out, "\n");
    write_why(clause->why.items, clause->why.count, out);
}

static void write_bare(const tn_bare_cell *bare, bool of_house, tn_buffer *out)
{
    tn_buffer_printf(out, "- ");
    tn_explained_bare_said(bare, of_house, out);
    tn_buffer_printf(out, "\n");
    for (size_t i = 0; i < bare->tiles.count; i++) {
        tn_buffer_printf(out, "    ");
        tn_explained_tile_said(&bare->tiles.items[i], out);
        tn_buffer_printf(out, "\n");
    }
}

static void write_covered(const tn_explained_house *explained, tn_buffer *out)
{
    for (size_t i = 0; i < explained->behind_roofs.count; i++) {
        tn_buffer_printf(out, "%s    ", i ? "" : "behind lower roofs:\n");
        tn_explained_covered_said(&explained->behind_roofs.items[i], out);
        tn_buffer_printf(out, "\n");
    }
}

static void write_hanging(const tn_explained_house *explained, tn_buffer *out)
{
    for (size_t i = 0; i < explained->hanging.count; i++)
        tn_buffer_printf(out, "%s    %s\n", i ? "" : "walls over nothing thicker than a partition:\n",
                         explained->hanging.items[i].wall);
}

static void write_steps(const tn_nearest_house *near, tn_buffer *out)
{
    tn_buffer_printf(out, "kept with these changes together:\n");
    for (size_t i = 0; i < near->changes.count; i++) {
        const tn_house_step *step = &near->changes.items[i];
        tn_buffer_printf(out, "    %s: %s for %s\n", step->where, step->to, step->from);
    }
}

static void write_nearest(const tn_explained_house *explained, tn_buffer *out)
{
    if (explained->nearest.count == 0)
        tn_buffer_printf(out, "no house that differs by a few choices was found to be kept\n");
    for (size_t i = 0; i < explained->nearest.count; i++) {
        const tn_nearest_house *near = &explained->nearest.items[i];
        if (near->has_changes)
            write_steps(near, out);
        else
            tn_buffer_printf(out, "%s    %s: %s for %s\n", i ? "" : "kept with one change:\n", near->where, near->to,
                             near->from);
    }
    if (explained->more > 0)
        tn_buffer_printf(out, "    and %" PRIu64 " more\n", explained->more);
}

/* full: also clauses that keep the house. */
static void explain_house_text(const tn_explained_house *explained, bool full, tn_buffer *out)
{
    tn_buffer_printf(out, "`%s` %s this house\n", explained->library, explained->kept ? "keeps" : "drops");
    for (size_t i = 0; i < explained->clauses.count; i++)
        if (full || explained->clauses.items[i].drops)
            write_clause(&explained->clauses.items[i], out);
    for (size_t i = 0; i < explained->bare.count; i++)
        write_bare(&explained->bare.items[i], true, out);
    if (full)
        write_covered(explained, out);
    if (full)
        write_hanging(explained, out);
    if (explained->has_nearest)
        write_nearest(explained, out);
}

static void explain_house_rules_text(const tn_explained_house_by_rules *explained, tn_buffer *out)
{
    for (size_t i = 0; i < explained->rules.count; i++) {
        const tn_explained_house_rule *rule = &explained->rules.items[i];
        tn_buffer_printf(out, "%s ", rule->matches ? "+" : "-");
        tn_explained_rule_said(rule, out);
        tn_buffer_printf(out, "\n");
        write_why(rule->why.items, rule->why.count, out);
    }
}

static void explain_cells_text(const tn_explained_cells *explained, tn_buffer *out)
{
    tn_explained_cells_said(explained, out);
    tn_buffer_printf(out, "\n");
    if (!explained->sectionless && !explained->houseless && explained->bare.count == 0)
        tn_buffer_printf(out,
                         "`tartan count` with --library %s --plan PLAN --clauses says how many houses it has, and what "
                         "each clause keeps out\n",
                         explained->library);
    if (explained->houseless)
        tn_buffer_printf(out,
                         "`tartan explain` with a house on this plan, PLAN ; OPTIONS ; FUNCTIONS ; FACES, names the "
                         "cells that are at fault and what does not fit there\n");
    for (size_t i = 0; i < explained->bare.count; i++)
        write_bare(&explained->bare.items[i], false, out);
}

typedef struct explain_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_input_settings input;
    const char *plan_file, *solid;
    tn_option_list rules;
    bool full, json;
    const char *output;
    tn_option_number nearest, dpi, max_boxes;
    tn_search_settings search;
} explain_settings;

static const explain_settings *settings_of(const tn_job *job)
{
    return (const explain_settings *)job->settings;
}

/* What is explained, and where to. */
typedef struct explaining {
    tn_job *job;
    const explain_settings *settings;
    tn_explain_request request;
    tn_output output;
} explaining;

static tn_explain_request request_of(const explain_settings *s)
{
    return (tn_explain_request){
        .subject = tn_job_asked(&s->plans),
        .rules = {s->rules.items, s->rules.count},
        .has_nearest = s->nearest.given,
        .nearest = s->nearest.value,
        .search = tn_search_settings_asked(&s->search),
        .drawn = {.picture = tn_answer_picture_choice(s->output), .has_dpi = s->dpi.given, .dpi = s->dpi.value},
        .full = s->full,
        .solid = {.solid = s->solid, .has_max_boxes = s->max_boxes.given, .max_boxes = s->max_boxes.value}};
}

/* ---- written */

/* Of a plan; NULL: a house is explained. */
static const tn_plan_reasons *reasons_of(const tn_reply *answer)
{
    const tn_explained_plan *by_library = TN_REPLY(explained_plan, answer);
    const tn_explained_by_rules *by_rules = TN_REPLY(explained_by_rules, answer);
    return by_library ? by_library->reasons.value : by_rules ? by_rules->reasons.value : NULL;
}

static bool make_text(const explaining *e, const tn_reply *answer, tn_buffer *text)
{
    bool full = e->settings->full;
    const tn_plan_reasons *reasons = reasons_of(answer);
    if (reasons)
        return tn_explained_text(&reasons->explained, full, text);
    if (TN_REPLY(explained_house, answer))
        explain_house_text(TN_REPLY(explained_house, answer), full, text);
    else if (TN_REPLY(explained_house_by_rules, answer))
        explain_house_rules_text(TN_REPLY(explained_house_by_rules, answer), text);
    else
        explain_cells_text(TN_REPLY(explained_cells, answer), text);
    return !text->failed;
}

/* What people read does not reach the terminal as it is. */
static void write_text(explaining *e, const tn_reply *answer)
{
    tn_buffer text = {0};
    if (make_text(e, answer, &text))
        tn_write_shown(e->output.stream, text.data, text.size);
    else
        tn_job_fail(e->job, &(tn_error){.status = TN_MEMORY});
    free(text.data);
}

/* heading: of what is written, or "". Ranks take several times as long as all the rest: they are shown if all is. */
static void explain_one(explaining *e, const char *heading)
{
    tn_reply answer;
    const explain_settings *settings = e->settings;
    e->request.no_ranks = !settings->json && !settings->full;
    if (tn_job_answered(e->job, tn_ask_explain(&e->job->session, &e->request, &answer))) {
        if (settings->json)
            tn_job_write_json(&answer, e->output.stream);
        else if (!settings->output && fputs(heading, e->output.stream) >= 0)
            write_text(e, &answer);
    }
    tn_reply_clear(&answer);
}

/* ---- the plans of a file */

/* The next plan of a file as its line (malloc); NULL at its end, and where one cannot be read, which is recorded. */
static char *next_plan(explaining *e, tn_plan_reader *reader, const tn_schema *schema, const tn_plans_source *source)
{
    const tn_plan *plan = NULL;
    tn_error error;
    size_t size = 0;
    tn_buffer line = {0};
    if (tn_plan_reader_next(reader, &plan, &error) != TN_OK) {
        const char *text = tn_plan_reader_text(reader, &size);
        tn_job_bad_plan(e->job, source, &error, text, size);
    } else if (plan) {
        tn_plan_write_line(schema, plan->trays, plan->length, &line);
        tn_buffer_append(&line, "", 1);
        if (line.failed)
            tn_job_fail(e->job, &(tn_error){.status = TN_MEMORY});
    }
    return line.data;
}

/* The only plan of a file, for a picture. */
static void explain_only(explaining *e, tn_plan_reader *reader, const tn_schema *schema, const tn_plans_source *source)
{
    char *plan = next_plan(e, reader, schema, source);
    char *second = plan ? next_plan(e, reader, schema, source) : NULL;
    if (second) {
        tn_help(tn_job_diagnostics(e->job),
                tn_job_usage(e->job, "a picture shows one plan, and %.200s holds more", source->path),
                "give the plan itself, or leave out -o");
    } else if (e->job->exit_code == TN_EXIT_DONE) {
        e->request.plan = plan;
        if (plan)
            explain_one(e, "");
        else
            tn_job_usage(e->job, "there is no plan in %.200s to be drawn", source->path);
    }
    free(second);
    free(plan);
}

/* Every plan of a file, kept apart by a line that says which it is. */
static void explain_each(explaining *e, tn_plan_reader *reader, const tn_schema *schema, const tn_plans_source *source)
{
    tn_buffer heading = {0};
    char *plan;
    for (size_t count = 0; (plan = next_plan(e, reader, schema, source)); count++) {
        heading.size = 0;
        tn_buffer_printf(&heading, "%s%s:%" PRIu64 ": ", count ? "\n" : "", source->path, tn_plan_reader_line(reader));
        e->request.plan = plan;
        explain_one(e, heading.failed ? "" : heading.data);
        free(plan);
        if (e->job->exit_code != TN_EXIT_DONE)
            break;
    }
    free(heading.data);
}

static void explain_file(explaining *e)
{
    tn_plan_reader *reader;
    const tn_schema *schema;
    const tn_plans_source source = {e->settings->plan_file, &e->settings->input, &e->settings->plans};
    if (!tn_job_answered(e->job, tn_explain_schema(&e->job->session, &e->request, &schema)) ||
        !tn_job_reader(e->job, schema, &source, &reader))
        return;
    if (e->settings->output)
        explain_only(e, reader, schema, &source);
    else
        explain_each(e, reader, schema, &source);
    tn_plan_reader_free(reader);
}

/* ---- the command */

static bool check_options(tn_job *job)
{
    const explain_settings *settings = settings_of(job);
    if ((settings->common.operands.count > 1) == (settings->plan_file != NULL))
        tn_job_usage(job, "say which plan: a plan, #RANK, or --plan FILE");
    else if (settings->output && settings->json)
        tn_job_usage(job, "either a picture (-o) or --json, not both");
    else
        return true;
    return false;
}

/* How the boxes of a design were squashed, step by step. */
static void draw_solid(tn_job *job)
{
    const explain_settings *settings = settings_of(job);
    const tn_draw_request request = {.format = tn_picture_choice(settings->output),
                                     .solid = {.solid = settings->solid,
                                               .has_max_boxes = settings->max_boxes.given,
                                               .max_boxes = settings->max_boxes.value},
                                     .show = TN_DRAW_HISTORY,
                                     .has_dpi = settings->dpi.given,
                                     .dpi = settings->dpi.value};
    if (settings->json)
        tn_job_usage(job, "either a picture (-o) or --json, not both");
    else
        tn_job_draw(job, &request, settings->output);
}

static void write_squashes(const tn_explained_design *design, FILE *out)
{
    if (design->squashes.count == 0)
        fputs("no two boxes overlap: nothing was squashed\n", out);
    for (size_t i = 0; i < design->squashes.count; i++)
        fprintf(out, "%s\n", design->squashes.items[i].told);
}

/* Of a design of which nothing is left, there is an answer all the same. */
static void explain_solid(tn_job *job)
{
    const tn_explain_request request = request_of(settings_of(job));
    tn_reply answer;
    tn_output output;
    tn_job_answered(job, tn_ask_explain(&job->session, &request, &answer));
    const tn_explained_design *design = TN_REPLY(explained_design, &answer);
    if (design && tn_job_output(job, NULL, &output)) {
        if (settings_of(job)->json)
            tn_job_write_json(&answer, output.stream);
        else
            write_squashes(design, output.stream);
        tn_job_commit(job, &output);
    }
    tn_reply_clear(&answer);
}

/* A house line, or the name of a house: #P:V, or #R if --library names a library of houses. */
static bool is_house(const tn_job *job, const char *text)
{
    const char *colon = text[0] == '#' && job->opened.module->HOUSE_LIBRARY_count > 0 ? strchr(text, ':') : NULL;
    if (colon)
        return colon[1] != '\0';
    return tn_is_house_line(text) || (text[0] == '#' && tn_job_of_houses(job, &settings_of(job)->plans));
}

static void explain_text(explaining *e, const char *text)
{
    *(is_house(e->job, text) ? &e->request.house : &e->request.plan) = text;
    explain_one(e, "");
}

static void explain(tn_job *job)
{
    const explain_settings *settings = settings_of(job);
    explaining e = {.job = job, .settings = settings, .request = request_of(settings)};
    tn_made_outputs outputs;
    if (!tn_job_output(job, NULL, &e.output))
        return;
    tn_job_show(job);
    tn_job_files(job, &outputs, &settings->output, 1, false);
    if (settings->plan_file)
        explain_file(&e);
    else
        explain_text(&e, settings->common.operands.items[1]);
    tn_job_files_end(&outputs);
    tn_job_commit(job, &e.output);
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
        explain_solid(&job);
    else if ((open || !alone) && check_options(&job) &&
             tn_job_open_plans(&job, common->operands.items[0], &settings_of(&job)->plans))
        explain(&job);
    return tn_job_end(&job);
}

#define SETTINGS explain_settings
static const tn_option options[] = {
    TEXT("plan", 0, "FILE", plan_file, "explain every plan of FILE; - is standard input"),
    LIST("rule", 'r', "NAME", rules, "explain this rule, whatever a library says; may be repeated"),
    OPTION_LIBRARY,
    TEXT("solid", 0, "NAME", solid, "which design of the file; may be left out where the file has only one"),
    OPTION_WHERE,
    OPTION_SET,
    FLAG("full", 0, full, "every clause and every part, not only what decides"),
    FLAG("json", 0, json, "write JSON, everything in it"),
    OUTPUT(output, TN_WRITES_PICTURES, "draw it instead: .svg, .png or .pdf"),
    NUMBER("nearest", 0, "N", nearest, 0, TN_NEAREST_MAX, "how many of the nearest kept plans to show (default 3)"),
    NUMBER("dpi", 0, "N", dpi, 10, 2400, "pixels an inch of a PNG (default 150)"),
    OPTION_INPUT_FORMAT,
    OPTION_MAX_LENGTH,
    OPTION_MAX_STATES,
    OPTIONS_SEARCH,
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
        "rules are explained by themselves. PLAN is a plan line, a plan in brackets as tests have it, an open plan "
        "that stands for one, or a JSON object, in quotes.\n\n"
        "HOUSE is a house line (docs/houses.md) or a JSON object with one: explain says which clauses of a library of "
        "houses drop it, and "
        "whether its plan is one of the library's. The tiles may be left out, and so may other values: it is then the "
        "first house of the library that has what is typed, or of the form if the library has none. '#P:V' is a house "
        "by its name, and so is "
        "'#R' "
        "with --library and a library of houses. Of a PLAN (or '#P:', with nothing behind the colon) and a library of "
        "houses it says which cells keep all houses off the plan: no function may be "
        "there, or no tile of one stands. -o draws the plans of the house instead, and lights up on them what each "
        "clause "
        "that drops it finds (all clauses with --full): cells, rooms, walls, how far a walk comes.\n\n"
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
