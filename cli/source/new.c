/* tartan new: a rule file to start from. */
#include <errno.h>
#include <string.h>

#include "cli/common/job.h"
#include "cli/common/options.h"

#define TN_START_NAMES "own|lahave|terrace"

/* ---- the texts that it writes: each compiles, counts and passes its tests without a warning */

/* The texts that `tartan new` writes. */

static const char own[] =
    "# A plan is a row of trays: slices of a building, one beside the other.\n"
    "# The language is described in docs/plan-language.md. `tartan check --watch FILE` checks this file whenever it is "
    "saved.\n"
    "\n"
    "# What a tray can be. Each field has one of its values in every tray; the first value is meant where nothing is "
    "said.\n"
    "schema strip \"bays along a corridor\" {\n"
    "  use    \"what the bay is for\" = room | store | stair\n"
    "  width  = 3.6m | 4.8m | 6m\n"
    "  glazed \"a window to the street\" = flag\n"
    "  forbid tray(stair, 6m)  # no such tray exists\n"
    "}\n"
    "\n"
    "# Rules say what a plan may have. `neighbour` is an order of trays; `quantity` counts them.\n"
    "rule dark-room \"a room without a window\" =\n"
    "  tray(room, not glazed)\n"
    "\n"
    "rule stores-together \"two stores side by side\" =\n"
    "  neighbour(tray(store), tray(store))\n"
    "\n"
    "rule far-stair \"a room with more than two bays between it and every stair\" =\n"
    "  distance(from tray(room), to tray(stair), by quantity(any, n > 2))\n"
    "\n"
    "# A measure is a number of each plan: `tartan best FILE 5 --most floor`.\n"
    "measure floor \"the floor area, 6 m deep\" =\n"
    "  sum(width * 6m)\n"
    "\n"
    "# A library is all plans that meet its requirements, without those that a pruning rule matches: `tartan count "
    "FILE`.\n"
    "library strips \"strips of four to six bays\" {\n"
    "  trays 4..6\n"
    "  total width 18m..30m\n"
    "  require quantity(tray(stair), n = 1), tray(store)\n"
    "  prune dark-room, stores-together, far-stair\n"
    "}\n"
    "\n"
    "# Tests hold the library to what is meant, also when a rule changes: `tartan test FILE`.\n"
    "test strips {\n"
    "  keep [room glazed 6m | stair | store | room glazed 6m]\n"
    "  drop [room 6m | stair | store | room glazed 6m] by dark-room\n"
    "  drop [room glazed 6m | room glazed 6m | stair | store | store] by stores-together\n"
    "}\n";

static const char lahave[] =
    "# Houses in the manner of the LaHave House grammar: a row of trays, each 4', 8' or 12' long.\n"
    "# `use \"lahave\"` brings the trays. The language is described in docs/plan-language.md.\n"
    "# `tartan check --watch FILE` checks this file whenever it is saved.\n"
    "\n"
    "use \"lahave\"\n"
    "\n"
    "# Rules say what a plan may have. `neighbour` is an order of trays; `quantity` counts them.\n"
    "rule one-hall \"a great hall in one tray or two side by side\" =\n"
    "  quantity(tray(great), n = 1)\n"
    "  or neighbour(tray(great), tray(great)) and quantity(tray(great), n = 2)\n"
    "\n"
    "rule public-end \"one end of the house is public, and nothing else is\" =\n"
    "  symmetric neighbour(beginning, tray(public)) and quantity(tray(public), n = 1)\n"
    "\n"
    "rule dark-hall \"a great hall without outlook\" =\n"
    "  tray(great, bay empty)\n"
    "\n"
    "rule narrow-hall \"a great hall in a tartan, where people walk\" =\n"
    "  tray(4', great)\n"
    "\n"
    "rule wide-pair \"two 12' trays side by side\" =\n"
    "  neighbour(tray(12'), tray(12'))\n"
    "\n"
    "# A measure is a number of each plan: `tartan best FILE 5 --most area`.\n"
    "measure area \"the floor area of both zones\" =\n"
    "  sum(width * (machine + body))\n"
    "\n"
    "# A library is all plans that meet its requirements, without those that a pruning rule matches: `tartan count "
    "FILE`.\n"
    "library small-houses \"houses of four to six trays\" {\n"
    "  trays 4..6\n"
    "  total width 28'..40'\n"
    "  require one-hall, public-end\n"
    "  prune dark-hall, narrow-hall, wide-pair\n"
    "}\n"
    "\n"
    "# Tests hold the library to what is meant, also when a rule changes: `tartan test FILE`.\n"
    "# A tray in brackets names what differs from the first values of the fields.\n"
    "test small-houses {\n"
    "  keep [8' public | 8' great bay open | 4' | 8']\n"
    "  drop [8' public | 8' great bay empty | 4' | 8'] by dark-hall\n"
    "  drop [8' public | 8' great bay open | 8' | 8' great bay open] by one-hall\n"
    "}\n";

static const char terrace[] =
    "# A terrace of row houses along a street, in metres: one tray is one house.\n"
    "# `use \"terrace\"` brings the trays, and rules of its own. The language is described in docs/plan-language.md.\n"
    "# `tartan check --watch FILE` checks this file whenever it is saved.\n"
    "\n"
    "use \"terrace\"\n"
    "\n"
    "# Rules say what a plan may have. `neighbour` is an order of trays; `quantity` counts them.\n"
    "rule low \"more than two storeys anywhere\" =\n"
    "  tray(three or four)\n"
    "\n"
    "rule stray-shop \"a shop with no end house beside it\" =\n"
    "  neighbour(tray(not end), tray(shop), tray(not end))\n"
    "  or symmetric neighbour(beginning, tray(shop), tray(not end))\n"
    "  or neighbour(beginning, tray(shop), end)\n"
    "\n"
    "# A library is all plans that meet its requirements, without those that a pruning rule matches: `tartan count "
    "FILE`.\n"
    "# `closed` and `restless-line` are rules of the file that is used.\n"
    "library mews \"a low terrace of five or six houses\" {\n"
    "  trays 5..6\n"
    "  total front 24m..36m\n"
    "  require closed\n"
    "  prune low, stray-shop, restless-line\n"
    "}\n"
    "\n"
    "# A measure of the file that is used: `tartan best FILE 5 --most floors-in-all`.\n"
    "measure floors-in-all = sum(floors)\n"
    "\n"
    "# Tests hold the library to what is meant, also when a rule changes: `tartan test FILE`.\n"
    "# A tray in brackets names what differs from the first values of the fields.\n"
    "test mews {\n"
    "  keep [6m end | 6m | 6m | 6m | 6m end]\n"
    "  drop [6m end | 6m | 6m three | 6m | 6m end] by low\n"
    "  drop [6m end | 6m shop | 6m | 6m shop | 6m | 6m end] by stray-shop  \"one of two\"\n"
    "}\n";

static const char *const starts[] = {own, lahave, terrace};

/* ---- the command */

typedef struct new_settings {
    tn_settings common;
    int schema; /* of the starts */
} new_settings;

/* Writes the file, where there is none of the name: two who begin at the same moment do not overwrite each other. */
static tn_status create(const char *path, const char *text, tn_error *error)
{
    FILE *file = fopen(path, "wx");
    if (!file && errno == EEXIST) {
        tn_fail(error, TN_IO, E_CANNOT_WRITE, "there is a file %.300s already, and it stays as it is", path);
        tn_error_help(error, "give another name");
        return TN_IO;
    }
    bool good = file && fputs(text, file) >= 0;
    int reason = errno;
    if (file && fclose(file) != 0 && good) {
        good = false;
        reason = errno;
    }
    if (good)
        return TN_OK;
    if (file)
        remove(path);
    return tn_fail(error, TN_IO, E_CANNOT_WRITE, "cannot write %.300s: %s", path, strerror(reason));
}

static bool is_plan(const char *path)
{
    size_t size = strlen(path);
    return size > 5 && strcmp(path + size - 5, ".plan") == 0 && path[size - 6] != '/';
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const new_settings *settings = (const new_settings *)common;
    const char *path = common->operands.items[0], *text = starts[settings->schema];
    tn_job job;
    tn_output output;
    tn_error error;
    tn_job_begin(&job, common);
    if (strcmp(path, "-") == 0) {
        if (tn_job_output(&job, NULL, &output)) {
            fputs(text, output.stream);
            tn_job_commit(&job, &output);
        }
    } else if (!is_plan(path)) {
        tn_diagnostic *d = tn_job_usage(&job, "a file of rules for plans ends with .plan, and %.300s does not", path);
        tn_help(tn_job_diagnostics(&job), d, "`tartan new houses.plan`");
    } else if (create(path, text, &error) != TN_OK) {
        tn_job_fail(&job, &error);
    } else {
        tn_job_note(&job,
                    "%.300s is written; `tartan check --test %.300s` and `tartan count %.300s` are the next steps",
                    path, path, path);
    }
    return tn_job_end(&job);
}

#define SETTINGS new_settings
static const tn_option options[] = {
    CHOICE("schema", 0, "NAME", schema, TN_START_NAMES,
           "whose trays: own (a small schema of the file's own, in metres), lahave or terrace"),
};

const tn_command tn_command_new = {
    .name = "new",
    .summary = "write a rule file to start from",
    .usage = "FILE [--schema NAME]",
    .description =
        "Writes a short .plan file with comments: a schema or the use of one, rules, a measure, a library and tests. "
        "It "
        "compiles, counts and passes its tests as it is; change what you need. A file that exists is not overwritten. "
        "For - it is written to standard output.",
    .example = "$ tartan new clinic.plan\n$ tartan new houses.plan --schema lahave",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
