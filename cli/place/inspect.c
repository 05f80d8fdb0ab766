/* tartan inspect: what there is to find about a model of parts, whoever made it. */
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/place/place.h"

typedef struct inspect_settings {
    tn_settings common;
    const char *kit, *model, *output, *require;
    bool json;
} inspect_settings;

static const inspect_settings *settings_of(const tn_job *job)
{
    return (const inspect_settings *)job->settings;
}

/* What is measured, a line each; `fill` if it is of a space. */
static void write_text(const tn_inspected *found, bool spaced, FILE *out)
{
    const tn_message *message = &tn_message_measured_parts;
    tn_parts_text(found->parts.items, found->parts.count, out);
    for (size_t i = 0; i < message->member_count; i++) {
        const tn_message_member *m = &message->members[i];
        if (m->kind == TN_MESSAGE_REAL && (spaced || strcmp(m->name, "fill") != 0))
            fprintf(out, "%12.10g  %s\n", *(const double *)((const char *)&found->measured + m->offset), m->name);
    }
}

static void write_json(const tn_inspected *found, FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_TIGHT);
    tn_message_write(&tn_message_measured_parts, &found->measured, NULL, &json);
    tn_json_end_line(&json);
}

static void write_findings(tn_job *job, const tn_inspected *found)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    if (settings_of(job)->json)
        write_json(found, output.stream);
    else
        write_text(found, settings_of(job)->model != NULL, output.stream);
    tn_job_commit(job, &output);
}

static void inspect(tn_job *job)
{
    const inspect_settings *s = settings_of(job);
    const char *format = s->output ? tn_file_format_word(tn_file_format_of(s->output)) : NULL;
    const tn_inspect_request request = {.drawn = {.path = s->common.operands.items[0]},
                                        .model = s->model,
                                        .require = s->require,
                                        .formats = {&format, s->output != NULL}};
    tn_made_outputs outputs;
    tn_reply answer;
    tn_job_files(job, &outputs, &s->output, 1, false);
    tn_job_answered(job, tn_ask_inspect(&job->session, &request, &answer));
    tn_job_files_end(&outputs);
    const tn_inspected *found = TN_REPLY(inspected, &answer);
    if (found)
        write_findings(job, found);
    if (found && found->has_meets && !found->meets)
        tn_job_status(job, TN_INVALID);
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const inspect_settings *s = (const inspect_settings *)common;
    tn_job job;
    tn_job_begin(&job, common);
    if (!s->kit)
        tn_help(tn_job_diagnostics(&job), tn_job_usage(&job, "which kit are its parts of?"),
                "name one: `--kit bricks`");
    else if (tn_job_open(&job, s->kit))
        inspect(&job);
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
