/* tartan disasm: lists what a rule file was compiled to. */
#include "runtime/vm/disasm.h"
#include "cli/option_rows.h"
#include "cli/session.h"

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_session session;
    tn_output output;
    tn_session_begin(&session, settings);
    if (tn_session_open(&session, settings->operands.items[0]) &&
        tn_session_output(&session, settings->output, &output)) {
        tn_module_disassemble(session.opened.module, output.stream);
        tn_session_commit(&session, &output);
    }
    return tn_session_end(&session);
}

static const tn_option options[] = {OPTION_OUTPUT};

const tn_command tn_command_disasm = {
    .name = "disasm",
    .summary = "list the bytecode of a rule file or module",
    .usage = "FILE [-o FILE.txt]",
    .description =
        "Lists the tables of a module and each function's bytecode beside the source lines it comes from. Takes a rule "
        "file (compiled on the way) or a module.",
    .example = "$ tartan disasm houses.plan | less",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
