/* tartan lsp: the language server. */
#include <unistd.h>

#include "cli/job.h"
#include "lsp/lsp.h"

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    tn_error error;
    tn_job_begin(&job, settings);
    tn_status status = tn_lsp_serve(STDIN_FILENO, stdout, &error);
    if (status != TN_OK) {
        tn_job_status(&job, status);
        tn_job_fail(&job, &error);
    }
    return tn_job_end(&job);
}

const tn_command tn_command_lsp = {
    .name = "lsp",
    .summary = "answer an editor's questions (language server)",
    .usage = "",
    .description =
        "Speaks the Language Server Protocol on standard input and output. Editors start it: for VS Code there is an "
        "extension in editors/vscode. It shows what is wrong as you type, completes fields, values and rules, says "
        "what a name means and what its rule prunes, finds and renames names, lists a file's contents, lays it out, "
        "and offers the fixes that diagnostics suggest.",
    .example = "$ tartan lsp 2>lsp.log",
    .operands = "no operands",
    .run = run,
};
