/* tartan settings: the numbers that may be turned in a file. */
#include <inttypes.h>

#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/option_rows.h"

typedef struct settings_settings {
    tn_settings common;
    bool used, json;
} settings_settings;

static void write_setting(const tn_shown_setting *setting, FILE *out)
{
    fprintf(out, "%s:%" PRIu64 ":%" PRIu64 ": ", setting->place.file, setting->place.line, setting->place.column);
    if (setting->has_part)
        fprintf(out, "%s: ", setting->part);
    fprintf(out, "%s%s%s", setting->name, *setting->name ? " = " : "", setting->value);
    if (setting->has_least)
        fprintf(out, " in %s..%s", setting->least, setting->most);
    for (size_t i = 0; setting->has_words && i < setting->words.count; i++)
        fprintf(out, "%s%s", i == 0 ? ", one of " : ", ", setting->words.items[i]);
    if (setting->has_doc)
        fprintf(out, "  \"%s\"", setting->doc);
    fputc('\n', out);
}

static void show(tn_job *job, const settings_settings *settings)
{
    const tn_settings_request request = {.used = settings->used};
    tn_reply answer;
    tn_output output;
    if (tn_job_answered(job, tn_ask_settings(&job->session, &request, &answer)) && tn_job_output(job, NULL, &output)) {
        const tn_found_settings *found = answer.value;
        if (settings->json)
            tn_job_write_json(&answer, output.stream);
        for (size_t i = 0; !settings->json && i < found->settings.count; i++)
            write_setting(&found->settings.items[i], output.stream);
        tn_job_commit(job, &output);
    }
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    tn_job_begin(&job, common);
    if (tn_job_open(&job, common->operands.items[0]))
        show(&job, (const settings_settings *)common);
    return tn_job_end(&job);
}

#define SETTINGS settings_settings
static const tn_option options[] = {
    FLAG("used", 0, used, "also those of files that it uses"),
    OPTION_SET,
    FLAG("json", 0, json, "write JSON"),
};

const tn_command tn_command_settings = {
    .name = "settings",
    .summary = "list the numbers that may be turned in a rule file, with their places",
    .usage = "FILE [--used] [--json]",
    .description = "Lists the params of a .plan file, with their ranges or words, or each number of a file of another "
                   "notation with the statement that it belongs to: what an editor can show as sliders. Each line says "
                   "where the value is written.",
    .example = "$ tartan settings tower",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
