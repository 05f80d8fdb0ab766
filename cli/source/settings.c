/* tartan settings: the numbers that may be turned in a file. */
#include <inttypes.h>

#include "ask/session/questions.h"
#include "cli/common/listed.h"
#include "cli/common/options.h"

static void write_setting(const tn_shown_setting *setting, FILE *out)
{
    fprintf(out, "%s:%" PRIu64 ":%" PRIu64 ": ", setting->place.file, setting->place.line, setting->place.column);
    if (setting->has_part)
        fprintf(out, "%s: ", setting->part);
    fprintf(out, "%s%s%s", setting->name, *setting->name ? " = " : "", setting->value);
    tn_listed_write_values(setting->least, setting->most, setting->words.items, setting->words.count, out);
    tn_listed_write_doc(setting->doc, out);
}

static void write_settings(const void *answer, FILE *out)
{
    const tn_found_settings *found = answer;
    for (size_t i = 0; i < found->settings.count; i++)
        write_setting(&found->settings.items[i], out);
}

static tn_status ask(tn_session *session, bool used, tn_reply *answer)
{
    return tn_ask_settings(session, &(tn_settings_request){.used = used}, answer);
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    return tn_listed_run(&(tn_listed){ask, write_settings}, settings);
}

#define SETTINGS tn_listed_settings
static const tn_option options[] = {
    FLAG("used", 0, used, "also those of files that it uses"),
    OPTION_SET,
    FLAG("json", 0, json, "write JSON"),
};

const tn_command tn_command_settings = {
    .name = "settings",
    .summary = "list the numbers that may be turned in a rule file, with their places",
    .usage = "FILE [--used] [--json]",
    .description =
        "Lists the params of a .plan file, with their ranges or words, or each number of a file of another "
        "notation with the statement that it belongs to, and the least and the most that it may be where that "
        "is laid down: what an editor can show as sliders. Each line says where the value is written.",
    .example = "$ tartan settings tower",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
