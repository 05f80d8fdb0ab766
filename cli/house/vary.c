/* tartan vary: what else a house could be: each other value of one choice with which it stays in its library. */
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/options.h"

typedef struct vary_settings {
    tn_settings common;
    const char *library, *at, *output;
    tn_option_number max_length, max_states;
    bool json;
} vary_settings;

static void write_line(const tn_varied_house *h, FILE *out)
{
    double more = h->area_sf; /* both are the same number */
    fprintf(out, "%s  %s: %s for %s", h->house, h->where, h->to, h->from);
    if (more != 0)
        fprintf(out, ", %+.2f %s", more, h->has_area_sf ? "sf" : "m2");
    if (h->cost && strcmp(h->cost, "+0.00") != 0)
        fprintf(out, ", cost %s", h->cost);
    fputc('\n', out);
}

static void write(const tn_varied *varied, bool json, FILE *out)
{
    for (size_t i = 0; i < varied->houses.count; i++) {
        const tn_varied_house *house = &varied->houses.items[i];
        tn_json line = tn_json_file(out, TN_JSON_TIGHT);
        if (!json) {
            write_line(house, out);
            continue;
        }
        tn_message_write(&tn_message_varied_house, house, NULL, &line);
        tn_json_end_line(&line);
    }
}

static void vary(tn_job *job, const vary_settings *settings)
{
    const tn_vary_request request = {.subject = {.library = settings->library,
                                                 .has_max_length = settings->max_length.given,
                                                 .max_length = settings->max_length.value,
                                                 .has_max_states = settings->max_states.given,
                                                 .max_states = settings->max_states.value},
                                     .house = job->settings->operands.items[1],
                                     .at = settings->at};
    tn_reply answer;
    tn_output out;
    if (tn_job_answered(job, tn_ask_vary(&job->session, &request, &answer)) &&
        tn_job_output(job, settings->output, &out)) {
        write(answer.value, settings->json, out.stream);
        tn_job_commit(job, &out);
    }
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    tn_job_begin(&job, common);
    if (tn_job_open(&job, common->operands.items[0]))
        vary(&job, (const vary_settings *)common);
    return tn_job_end(&job);
}

#define SETTINGS vary_settings
static const tn_option options[] = {
    TEXT("at", 0, "CELL", at, "only what is about one cell: TRAY.ZONE.STOREY, trays from 1, such as 2.body.ground"),
    TEXT("library", 0, "NAME", library, "the library of houses; may be left out where the file has only one"),
    OPTION_SET,
    FLAG("json", 0, json, "write each change as a JSON object"),
    OUTPUT(output, TN_WRITES_TEXT | TN_WRITES(JSON), "write to FILE; .json is JSON"),
    NUMBER("max-length", 0, "N", max_length, 1, 1u << 24, "the longest plan that is accepted, in trays (default 4096)"),
    NUMBER("max-states", 0, "N", max_states, 1, UINT32_MAX, "the most states of an automaton of the library of plans"),
};

const tn_command tn_command_vary = {
    .name = "vary",
    .summary = "list what else a house could be",
    .usage = "FILE HOUSE [--at TRAY.ZONE.STOREY] [--library NAME] [--json]\nFILE '#P:V' [--at TRAY.ZONE.STOREY]",
    .description =
        "Lists each other value of one choice with which the house stays in its library: of the options, of the "
        "function of a cell, of what is in a face, of a tile. Each line has the number of the house that this makes, "
        "what changes, "
        "and the differences in floor area and cost, if there are any. All other choices stay as they are where they "
        "can; where a "
        "change takes away a "
        "tile or what is in a face, the first that fits takes its place. In HOUSE, a house line, values may be left "
        "out "
        "(docs/houses.md).",
    .example = "$ tartan vary cottage '#541:77' --at 1.body.ground",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE and a HOUSE",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
