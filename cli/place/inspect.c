/* tartan inspect: what there is to find about a model of parts, whoever made it. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/option_rows.h"
#include "cli/place/place.h"
#include "driver/place/asked.h"
#include "driver/place/drawn.h"
#include "driver/place/shape.h"
#include "runtime/base/json.h"

typedef struct inspect_settings {
    tn_settings common;
    const char *kit, *model, *output, *require;
    bool json;
} inspect_settings;

typedef struct inspection {
    tn_job *job;
    const inspect_settings *settings;
    const tn_module *module;
    tn_ldraw ldraw;
    tn_placed_measures measures;
    uint32_t chosen; /* model of the kit whose conditions it is held to */
    tn_opened asked; /* --require */
} inspection;

/* ---- what is written */

static void write_text(const inspection *n, FILE *out)
{
    for (int i = 0; i < TN_PLACED_X; i++)
        if (i != TN_PLACED_FILL || n->settings->model)
            fprintf(out, "%12.10g  %s\n", n->measures.terms[i], tn_placed_terms[i]);
}

static void write_json(const inspection *n, FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    for (int i = 0; i < TN_PLACED_X; i++)
        tn_json_number(&json, tn_placed_terms[i], n->measures.terms[i]);
    tn_json_count(&json, "unknown", n->measures.joints.unknown);
    tn_json_count(&json, "snapped", n->ldraw.snapped);
    tn_json_count(&json, "tilted", n->ldraw.tilted);
    tn_json_count(&json, "beside", n->ldraw.beside);
    tn_json_list(&json, "findings");
    for (size_t i = 0; i < n->ldraw.model.count; i++) {
        bool unknown = !n->measures.joints.kinds[i];
        if (!n->measures.overlaps[i] && !n->measures.floating[i] && !n->measures.joints.cut[i] && !unknown)
            continue;
        tn_json_object(&json, NULL);
        tn_json_count(&json, "part", i);
        tn_json_bool(&json, "overlaps", n->measures.overlaps[i]);
        tn_json_bool(&json, "floating", n->measures.floating[i]);
        tn_json_bool(&json, "cut", n->measures.joints.cut[i]);
        tn_json_bool(&json, "unknown", unknown);
        tn_json_object_end(&json);
    }
    tn_json_list_end(&json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

/* Parts that the picture shows in red: those that overlap, or float. */
static void draw(inspection *n)
{
    size_t count = n->ldraw.model.count;
    bool *marked = malloc(count + 1);
    tn_error error;
    tn_status status = marked ? TN_OK : tn_fail_memory(&error);
    for (size_t i = 0; marked && i < count; i++)
        marked[i] = n->measures.overlaps[i] || n->measures.floating[i];
    if (status == TN_OK)
        status = tn_placed_draw(n->module, &n->ldraw.model, &n->measures, marked, NULL,
                                &(tn_picture){.path = n->settings->output}, &error);
    if (status != TN_OK)
        tn_job_fail(n->job, &error);
    free(marked);
}

static void write_findings(inspection *n)
{
    tn_output output;
    tn_error error;
    if (!tn_job_output(n->job, NULL, &output))
        return;
    if (n->settings->json) {
        write_json(n, output.stream);
    } else {
        tn_status status = tn_place_summary(&n->ldraw.model, output.stream, &error);
        if (status != TN_OK)
            tn_job_fail(n->job, &error);
        write_text(n, output.stream);
    }
    tn_job_commit(n->job, &output);
    if (n->settings->output)
        draw(n);
}

/* ---- what is said */

static void note_left_out(inspection *n, size_t count, const char *first, const char *why)
{
    if (count > 0)
        tn_job_note(n->job, "%zu part%s left out, the first a %.60s: %s", count, count == 1 ? " is" : "s are", first,
                    why);
}

/* A part that the kit lacks. */
typedef struct unknown_part {
    const char *name;
    size_t index;
} unknown_part;

static int by_name(const void *a, const void *b)
{
    const unknown_part *one = a, *other = b;
    int order = strcmp(one->name, other->name);
    return order != 0 ? order : (one->index > other->index) - (one->index < other->index);
}

static int by_index(const void *a, const void *b)
{
    const unknown_part *one = a, *other = b;
    return (one->index > other->index) - (one->index < other->index);
}

/* Each name once, in the order in which they come; not more than anybody reads. */
static void note_unknown(inspection *n)
{
    enum { NOTED_MAX = 20 };
    size_t count = 0, kept = 0;
    unknown_part *all = malloc((n->measures.joints.unknown + 1) * sizeof *all);
    tn_error error;
    if (!all) {
        tn_fail_memory(&error);
        tn_job_fail(n->job, &error);
        return;
    }
    for (size_t i = 0; i < n->ldraw.model.count; i++)
        if (!n->measures.joints.kinds[i])
            all[count++] = (unknown_part){n->ldraw.model.parts[i].name, i};
    qsort(all, count, sizeof *all, by_name);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || strcmp(all[i].name, all[kept - 1].name) != 0)
            all[kept++] = all[i];
    qsort(all, kept, sizeof *all, by_index);
    for (size_t i = 0; i < kept && i < NOTED_MAX; i++)
        tn_job_note(n->job, "the kit has no part %.60s: it joins nothing and fills nothing here", all[i].name);
    if (kept > NOTED_MAX)
        tn_job_note(n->job, "and %zu more parts that the kit does not have", kept - NOTED_MAX);
    free(all);
}

static void say(inspection *n)
{
    note_left_out(n, n->ldraw.tilted, n->ldraw.first_tilted, "it is turned in a way in which the kit turns no part");
    note_left_out(n, n->ldraw.beside, n->ldraw.first_beside, "it lies beside the kit's cells");
    if (n->ldraw.snapped)
        tn_job_note(n->job, "%zu part%s lay a little beside the cells, or were turned a little: this was set right",
                    n->ldraw.snapped, n->ldraw.snapped == 1 ? "" : "s");
    note_unknown(n);
}

/* ---- the run */

/* Reads --require before the model is read. */
static bool ask(inspection *n)
{
    const tn_module *module = n->module;
    tn_error error;
    const char **parts = calloc((size_t)module->KIT_PART_count + 1, sizeof *parts);
    if (!parts) {
        tn_fail_memory(&error);
        tn_job_fail(n->job, &error);
        return false;
    }
    for (uint32_t i = 0; i < module->KIT_PART_count; i++)
        parts[i] = tn_text(module, module->KIT_PART_records[i].name);
    tn_status status = tn_kit_ask("--require", n->settings->require, parts, module->KIT_PART_count, &n->asked);
    free(parts);
    if (status != TN_OK)
        tn_kit_ask_failed(&n->job->opened, &n->asked);
    tn_job_status(n->job, status);
    return status == TN_OK;
}

static void inspect(inspection *n)
{
    const tn_kit_model_record *space = NULL;
    tn_error error;
    tn_kit_tally tally = {0};
    n->module = n->job->opened.module;
    if (n->module->KIT_count == 0) {
        tn_job_usage(n->job, "%.200s is no kit", n->settings->kit);
        return;
    }
    if (n->settings->model) {
        tn_status chosen = tn_kit_choose(&n->job->opened, n->settings->model, &n->chosen);
        tn_job_status(n->job, chosen);
        if (chosen != TN_OK)
            return;
        space = &n->module->KIT_MODEL_records[n->chosen];
    }
    if (n->settings->require && !ask(n))
        return;
    tn_status status = tn_drawn_read(n->settings->common.operands.items[0], n->module, &n->ldraw, &error);
    if (status == TN_OK)
        status = tn_placed_measure(n->module, space, &n->ldraw.model, tn_interrupt_waiting(), &n->measures, &error);
    if (status != TN_OK) {
        tn_job_fail(n->job, &error);
        return;
    }
    say(n);
    write_findings(n);
    if (n->settings->require)
        tn_job_status(n->job, tn_kit_hold(&n->job->opened, &n->asked, &n->ldraw.model, &n->measures));
    if (space)
        tn_job_status(n->job, tn_kit_conditions(&n->job->opened, n->chosen, &n->measures, false, false, &tally));
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    inspection n = {.job = &job, .settings = (const inspect_settings *)common};
    tn_job_begin(&job, common);
    if (!n.settings->kit)
        tn_help(tn_job_diagnostics(&job), tn_job_usage(&job, "which kit are its parts of?"),
                "name one: `--kit bricks`");
    else if (tn_job_open(&job, n.settings->kit))
        inspect(&n);
    tn_placed_measures_clear(&n.measures);
    tn_ldraw_clear(&n.ldraw);
    tn_close(&n.asked);
    return tn_job_end(&job);
}

#define SETTINGS inspect_settings
static const tn_option options[] = {
    TEXT("kit", 'k', "FILE", kit,
         "the kit that knows the parts: a .kit file, a module, or one of the standard library"),
    TEXT("model", 'm', "NAME", model, "hold it to what this model of the kit requires; its space is what `fill` is of"),
    TEXT("require", 'r', "CONDITIONS", require,
         "conditions as in a kit, `components = 1, floating = 0`: exit code 1 where one fails"),
    OUTPUT(output, TN_WRITES_PICTURES, "draw it, by the file's ending .svg, .png or .pdf: red parts overlap or float"),
    FLAG("json", 0, json, "write JSON, with the parts that there is something to say about"),
    OPTION_LDRAW,
    OPTION_WERROR,
};

const tn_command tn_command_inspect = {
    .name = "inspect",
    .summary = "say what is wrong with a model of parts",
    .usage =
        "MODEL.ldr --kit KIT [--model NAME] [--require CONDITIONS] [-o FILE.svg|png|pdf]\nMODEL.mpd --kit KIT --json",
    .description =
        "Reads a model from an LDraw file, whoever made it, and measures it with the parts of a kit: pieces, joints "
        "and "
        "open connectors, parts that float or overlap, parts without which it falls apart, size, mass, price, balance. "
        "Sub-files are put in their places; parts that the kit lacks are named.\n\n"
        "With --model the exit code is 1 where the model does not meet what that model of the kit requires, with "
        "--require where it does not meet the conditions given.",
    .example = "$ tartan inspect wall.ldr --kit bricks -o wall.svg",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "one MODEL.ldr or .mpd",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
